"""Bodies that relax: steps of time, harmonic motion, and sliding with hysteresis."""
