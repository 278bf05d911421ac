"""Theories of one contact."""
