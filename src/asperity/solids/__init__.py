"""Layer 1: what the bodies are made of and how their surfaces yield."""
