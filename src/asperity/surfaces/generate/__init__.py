"""Generated surfaces: deterministic shapes and textures, spectra, Gaussian and other random
roughness."""
