"""Layer 1: surfaces as data, read from files or generated, prepared and characterised."""
