"""Electrical and thermal conductance through the contact."""
