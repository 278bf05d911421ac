"""Statistics of rough surfaces that theories use: moments, summits, distributions of heights."""
