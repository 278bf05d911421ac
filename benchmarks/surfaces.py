"""The surfaces and loads of every benchmark."""

from __future__ import annotations

import asperity as asp

LOADS = (0.01, 0.05, 0.2)
"""Mean pressure over contact modulus, at unit rms slope."""

BODY = asp.Elastic(0.91, 0.3)
"""Elastic body of contact modulus 1 against a rigid one, so that pressures come in units of E*."""


def self_affine(n: int, seed: int = 1) -> asp.Surface:
    """Periodic surface of n x n unit pixels: Hurst 0.8, roll-off L/4, cut-off 8 pixels, unit rms
    slope."""
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(1.0), hurst=0.8, rolloff_wavelength=n / 4, shortest_wavelength=8.0
    )
    return asp.generate.gaussian(asp.Grid((n, n), (1.0, 1.0)), spectrum, seed=seed)
