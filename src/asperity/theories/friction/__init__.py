"""Theories of contacts with stick and slip."""
