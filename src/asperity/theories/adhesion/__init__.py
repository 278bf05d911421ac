"""Adhesive spheres and rough surfaces."""
