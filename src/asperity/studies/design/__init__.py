"""Designs: the variables of a contact that make an objective best while constraints hold."""
