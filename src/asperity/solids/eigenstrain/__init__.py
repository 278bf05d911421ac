"""Plastic strain as an eigenstrain of a layered half-space: exact in depth, Fourier in the
plane."""
