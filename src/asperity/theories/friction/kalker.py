"""Coefficients of linear rolling contact: Kalker's table (Kalker 1967; 1990, appendix E) where it
was at hand, our own solution elsewhere."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core import require
from ...core.errors import InputError

_TENTHS = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9)
RATIOS = (*_TENTHS, *(1.0 / part for part in (1.0, *reversed(_TENTHS))))
"""a/b of the rows; from 1 on the table is in tenths of b/a."""


_TABLE = {
    "C11": (
        (2.51, 2.59, 2.68, 2.78, 2.88, 2.98, 3.09, 3.19, 3.29, 3.40, 3.51, 3.65, 3.82, 4.06, 4.37, 4.85, 5.57, 7.00, 10.7),
        (3.32, 3.38, 3.44, 3.54, 3.63, 3.72, 3.81, 3.92, 4.02, 4.12, 4.23, 4.36, 4.54, 4.78, 5.10, 5.57, 6.34, 7.81, 11.8),
        (4.85, 4.82, 4.80, 4.83, 4.87, 4.91, 4.98, 5.05, 5.12, 5.21, 5.30, 5.42, 5.58, 5.80, 6.10, 6.57, 7.34, 8.82, 13.0),
    ),
    "C22": (
        (2.51, 2.59, 2.68, 2.78, 2.88, 2.98, 3.09, 3.19, 3.29, 3.40, 3.51, 3.65, 3.82, 4.06, 4.37, 4.85, 5.57, 7.00, 10.7),
        (2.53, 2.63, 2.75, 2.88, 3.01, 3.14, 3.28, 3.41, 3.54, 3.67, 3.81, 3.99, 4.21, 4.51, 4.90, 5.48, 6.40, 8.19, 12.9),
        (2.53, 2.66, 2.81, 2.98, 3.14, 3.31, 3.48, 3.65, 3.82, 3.98, 4.17, 4.39, 4.67, 5.04, 5.58, 6.31, 7.51, 9.79, 16.2),
    ),
    "C23": (
        (0.335, 0.483, 0.607, 0.720, 0.827, 0.930, 1.03, 1.13, 1.23, 1.33, 1.44, 1.58, 1.76, 2.01, 2.35, 2.88, 3.79, 5.72, 12.2),
        (0.472, 0.603, 0.715, 0.823, 0.929, 1.03, 1.14, 1.25, 1.36, 1.47, 1.59, 1.75, 1.95, 2.23, 2.62, 3.24, 4.32, 6.63, 14.6),
        (0.731, 0.806, 0.889, 0.976, 1.07, 1.18, 1.28, 1.40, 1.51, 1.63, 1.77, 1.94, 2.18, 2.50, 2.97, 3.70, 5.01, 7.89, 18.0),
    ),
    "C33": (
        (6.46, 3.46, 2.49, 2.02, 1.74, 1.56, 1.44, 1.34, 1.27, 1.21, 1.16, 1.10, 1.05, 1.01, 0.958, 0.917, 0.868, 0.835, 0.795),
        (8.33, 4.30, 2.96, 2.33, 1.94, 1.68, 1.50, 1.37, 1.27, 1.19, 1.11, 1.04, 0.965, 0.895, 0.819, 0.747, 0.674, 0.606, 0.529),
        (11.7, 5.70, 3.72, 2.79, 2.22, 1.86, 1.61, 1.42, 1.27, 1.16, 1.06, 0.958, 0.852, 0.751, 0.653, 0.549, 0.446, 0.341, 0.227),
    ),
}  # fmt: skip
"""Rows of ν = 0, 1/4, 1/2, three digits: Kalker's, but for those of ``COMPUTED`` and for C11 at
a/b = ν = 0.5, printed as 4.83 against the trend of its neighbours, which is 4.870 ± 0.005 here."""

COMPUTED = {0.0: (0, 6, 7, 15, 17), 0.25: (0, 1, 3, 4, 7, 8, 10, 13, 17, 18), 0.5: (1, 3, 6, 9, 10, 11, 14, 18)}
"""Places in their row, by ν, of the coefficients that are not Kalker's. They are steady rolling of
a punch that sticks, on five grids of 40² to 160² pixels, with a parabola in the pixel taken to zero
(``validation/kalker_table.py``). Other fits differ by 0.1 % (C33 0.3 %, 1.5 % at a/b = 10); from
the rows of Kalker's so found differ by 0.2 % on the average (C33 0.5 %) and by 1 % at most, at
a/b = 10."""

SMALLEST_RATIO, LARGEST_RATIO = 0.1, 10.0
"""a/b at which the table ends."""


@dataclass(frozen=True)
class KalkerCoefficients:
    """Coefficients of the forces of creepage, see ``KalkerLinear``."""

    C11: float
    C22: float
    C23: float
    C33: float


def kalker_coefficients(ratio: float, nu: float) -> KalkerCoefficients:
    """Coefficients for the ``ratio`` a/b of the semi-axes along and across the direction of
    rolling, and Poisson's ratio.

    Between the rows of the table, whose three digits they keep: cubic splines of the logarithms
    over ln(a/b), and parabolas in ν.

    InputError if the ratio is not from 0.1 to 10, or ν not from 0 to 0.5.
    """
    at = require.positive(ratio, "ratio of the semi-axes")
    if not SMALLEST_RATIO * (1.0 - 1e-12) <= at <= LARGEST_RATIO * (1.0 + 1e-12):
        raise InputError(f"ratio of the semi-axes must be from 0.1 to 10, where the table ends, but is {at:g}.")
    if not 0.0 <= require.finite(nu, "Poisson's ratio") <= 0.5:
        raise InputError(f"Poisson's ratio must be from 0 to 0.5, but is {nu:g}.")
    s = nu / 0.5
    parabola = np.array([(1.0 - s) * (1.0 - 2.0 * s), 4.0 * s * (1.0 - s), s * (2.0 * s - 1.0)])
    from scipy.interpolate import CubicSpline

    logs = np.log(np.moveaxis(np.array(list(_TABLE.values())), -1, 0))  # (ratios, coefficients, ν)
    columns = np.exp(CubicSpline(np.log(RATIOS), logs)(np.log(at)))
    return KalkerCoefficients(*(float(value) for value in columns @ parabola))
