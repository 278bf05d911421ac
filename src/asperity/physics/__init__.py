"""THE place for physics of the interface: a folder each, listed in ``core/registry.py``."""
