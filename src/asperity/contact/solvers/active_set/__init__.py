"""The default solver: an active set with a preconditioned linear system, on nested grids."""
