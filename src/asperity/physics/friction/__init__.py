"""Friction: shear tractions of gross sliding, or of stick and slip."""
