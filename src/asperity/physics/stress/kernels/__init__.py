"""Stresses under elementary loads: pixels, waves, points of a plane."""
