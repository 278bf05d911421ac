"""(1) The free set: which points of an iterate the next step of the fast solver may change; constants and cases as in ``solver``."""

from __future__ import annotations

import numpy as np

from ....core.arrays import RealArray
from ....core.engine import FreeSet, Survey

_PRIOR = 4.0
"""Loaded points as which the mean over the wider square counts in that of a square, so that few points do not decide alone.
Pairs for 1, 2, 8, 16: elastic 13.9 and free 43.8 for all; film 22.2, 22.8, 22.8, 23.0; cap 16.1, 16.0, 16.0, 16.0."""

_SCATTER_SHARE = 0.5
"""Share of the scatter by which a point must stand out to enter. Pairs for 0, 0.3, 0.7, 1: elastic 14.1, 13.9, 13.9, 14.4; film
22.4, 22.7, 22.0, 21.7; tight 23.4, 23.4, 23.2, 24.7. Film of E 10, h 4 pixels at 1024²: 32, 31, 30, 29 (0.5: 28), and with every
iterate within its bounds 64, 42, 34, 35 (36)."""

_RESOLVED = 1e-14
"""Scatter² over mean square below which it is lost in the rounding of sums of squares."""


def free_set(survey: Survey, level: float, scale: float, dtype: str) -> FreeSet:
    """Free set of an iterate at the plane ``level``, with the residual (level - r) / ``scale``.

    Points at a bound enter by the mean residual of the loaded points near them: while an iterate is not yet solved for,
    its residual is smooth, whole regions being too high or too low. Judged by the plane level, too many points would enter
    in the one and too few in the other, and the set would follow the error instead of the surface. At the solution all
    means are the plane level.

    What the residual scatters about that mean from point to point is error as well: a step on points that enter by less
    than it is mostly undone by the next, and a stiff film, whose pressures change sign within a few pixels, may never
    settle. Points enter that are beyond the mean by half of the scatter, which vanishes at the solution.
    """
    return survey.free_set(entering_levels(survey.squares, level), level, scale, dtype)


def entering_levels(squares: RealArray, level: float) -> RealArray:
    """Levels of r for each square (..., 2): unloaded points enter below the first, points at their cap above the second.

    ``squares`` holds the number of its points strictly between the bounds, their sum of r and of r². Where there are few, the square of twice
    the side counts as well, and so on; where there are none at all the levels are ``level``.
    """
    from ....core.engine import kernels

    nx, ny, _ = squares.shape
    sums, levels = np.empty((2 * (nx + 1) * (ny + 1) + 64, 3)), np.empty((nx, ny, 2))
    kernels.entering_levels(squares, level, _PRIOR, _SCATTER_SHARE, _RESOLVED, sums, levels)
    return levels
