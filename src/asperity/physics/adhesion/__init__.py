"""Adhesion: surfaces attract each other where they do not touch, or hold together where they do."""
