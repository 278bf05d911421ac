"""Compliance at octaves of wavenumbers, for models of it that ask on every grid for much the same few."""

from __future__ import annotations

import numpy as np

from ...core.arrays import RealArray
from ...solids.compliance.protocol import Compliance

_AHEAD = 8


class Octaves:
    """Values of ``compliance`` that were asked for before, and those up to eight octaves beyond, which finer grids ask for.

    Few values cost as much as one: 3 ms for 32 sublayers, twenty times in one solve at 1024² if nothing is kept.
    """

    def __init__(self, compliance: Compliance) -> None:
        self._compliance = compliance
        self._known: dict[float, float] = {}

    def spectral(self, wavenumber: RealArray) -> RealArray:
        """Displacement per pressure (m/Pa) at each ``wavenumber`` (rad/m, one-dimensional), to 1e-9 of it."""
        keys = [_key(q) for q in wavenumber]
        if not all(key in self._known for key in keys):
            ahead = float(np.max(wavenumber)) * 2.0 ** np.arange(1, _AHEAD + 1)
            asked = np.concatenate([wavenumber, ahead])
            found = np.asarray(self._compliance.spectral(asked), dtype=float)
            self._known.update((_key(q), float(c)) for q, c in zip(asked, found, strict=True))
        return np.array([self._known[key] for key in keys])


def _key(wavenumber: float) -> float:
    """Equal for wavenumbers that differ by rounding."""
    return float(f"{wavenumber:.9e}")
