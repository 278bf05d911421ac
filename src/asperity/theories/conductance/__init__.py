"""Theories of conductance: spots, and joints of rough surfaces."""
