"""Stresses below one contact."""
