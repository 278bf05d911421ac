"""Layer 2: displacement and stress inside homogeneous and layered bodies under given surface
tractions."""
