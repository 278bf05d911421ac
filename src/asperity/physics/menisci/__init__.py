"""Menisci: a film of liquid holds the surfaces together."""
