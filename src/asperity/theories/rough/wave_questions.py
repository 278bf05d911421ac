"""What is asked of the waves of a rough contact; it imports nothing, for the declarations that name
it."""

from __future__ import annotations

from types import MappingProxyType

QUESTIONS = MappingProxyType(
    {
        "height": "rms height",
        "slope": "rms slope",
        "curvature": "rms curvature",
        "area": "real area",
        "plastic": "plastic area",
        "mean_gap": "mean gap",
        "compliance": "contact compliance",
    }
)
"""Names of the answers and what they are called: rms height (m0), rms slope (m2), rms curvature
(m4), real area, plastic part of it, mean gap, and compliance 1/K, to which the conductance is
inverse."""
