"""Hardness: a limit of the pressure that changes with depth, as of layers; the load at which a
contact becomes plastic."""
