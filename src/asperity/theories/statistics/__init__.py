"""What theories need to know of a rough surface: moments, summits, distributions of heights."""
