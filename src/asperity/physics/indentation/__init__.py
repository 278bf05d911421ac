"""Indentation and repeated passes, by finite elements."""
