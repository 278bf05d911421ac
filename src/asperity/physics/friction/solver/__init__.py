"""Tangential problem of one step with a given bound on the shear traction, and its fast solver."""
