"""Derivatives of the answers of a solved contact, by one linear solve each."""
