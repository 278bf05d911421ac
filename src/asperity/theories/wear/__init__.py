"""Theories of wear: laws, pins and tracks, running-in of waves, punches and spheres."""
