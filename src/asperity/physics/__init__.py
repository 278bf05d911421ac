"""Physics of the interface and analyses of a contact: a folder each, listed in
``core/registry.py``."""
