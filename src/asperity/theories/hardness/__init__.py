"""Hardness of layered bodies and plasticity indices."""
