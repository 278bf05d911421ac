"""Layer 0: grids, transforms, units, errors, status, citations and progress, shared by everything
above."""
