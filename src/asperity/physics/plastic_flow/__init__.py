"""Plastic flow in the volume below the surface."""
