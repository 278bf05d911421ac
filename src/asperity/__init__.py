"""Contact mechanics of layered rough surfaces."""
