"""Temperature of one source of heat on a half-space whose material moves by to +x."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from .pixel import rectangle


@dataclass(frozen=True)
class Rectangle:
    """Uniform flux on |x| < a, |y| < b.

    Parameters
    ----------
    half_length
        a in m, along the motion.
    half_width
        b in m.
    """

    half_length: float
    half_width: float

    def __post_init__(self) -> None:
        """InputError for values that cannot be."""
        require.positive(self.half_length, "half length of a source (m)")
        require.positive(self.half_width, "half width of a source (m)")

    def rise(
        self, x: ArrayLike, y: ArrayLike, peclet: float, *, depth: float = 0.0, fourier: float = math.inf
    ) -> RealArray:
        """θ = k T/(q a) at (``x``, ``y``) and ``depth`` in units of a; ``fourier`` = κ t/a²."""
        sides = (1.0, self.half_width / self.half_length)
        return rectangle(np.asarray(x), np.asarray(y), sides, 1.0, 1.0, 2.0 * peclet, depth=depth, time=fourier)
