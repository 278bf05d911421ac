"""Theories of rough surfaces: by their summits, their spectrum, their fractal dimension."""
