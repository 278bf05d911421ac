"""Sealing: flow of liquids and gases through the gap of a solved contact, and leak rates."""
