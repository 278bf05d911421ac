"""Impact and motion."""
