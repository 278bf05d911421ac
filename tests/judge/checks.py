"""Errors of equations beside what is stated of them, and what rounding alone makes of an
equation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

LARGEST_RATIO = 10.0
"""Error over what is stated above which a solution was wrongly called converged."""

EPS = float(np.finfo(float).eps)

ROUNDING = 64.0 * EPS
"""Relative rounding of a sum or a transform of the sizes of the judge's grids, in double
precision."""


@dataclass(frozen=True)
class Check:
    """``error`` of the equation ``name``, and what the result states of it; both relative, or in
    the same unit."""

    name: str
    error: float
    stated: float

    @property
    def ratio(self) -> float:
        """Error over what is stated; infinite for one that is no number."""
        if not np.isfinite(self.error) or not np.isfinite(self.stated):
            return float("inf") if not np.isfinite(self.error) else 0.0
        if self.error <= 0.0:
            return 0.0
        return self.error / self.stated if self.stated > 0.0 else float("inf")


def over(value: float, size: float) -> float:
    """``value`` over ``size``; nothing over nothing is nothing."""
    return value / size if size > 0.0 else (0.0 if value == 0.0 else float("inf"))


def norm(field: object) -> float:
    """Euclidean norm of all of a field."""
    return float(np.linalg.norm(np.ravel(np.asarray(field, dtype=float))))
