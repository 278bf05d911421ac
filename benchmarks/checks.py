"""Do the solvers agree, and how accurate is each?"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from surfaces import BODY

import asperity as asp

AREA_LIMIT = 1e-3
"""Largest difference of the numbers of contact pixels, relative to ours."""

PRESSURE_LIMIT = 1e-4
"""Largest relative L2 difference of the pressures; a field's error of 1e-6 leaves about a tenth of
it."""


def field_error(heights: NDArray[np.float64], pressure: NDArray[np.float64]) -> float:
    """Customary error of the field, sum of p (gap - min gap) over total load times rms height, for
    anyone's pressure."""
    problem = asp.ContactProblem(asp.Surface(heights, 1.0, 1.0, periodic=True), BODY)
    operator = asp.solvers.prepare_operator(problem.compliance, problem.grid, problem.boundary)
    r = operator.apply(pressure) - heights
    return float((pressure * (r - r.min())).sum() / (pressure.sum() * heights.std()))


def contact_pixels(pressure: NDArray[np.float64]) -> int:
    """Number of points that carry pressure."""
    return int((pressure > 0.0).sum())


def relative_l2(pressure: NDArray[np.float64], reference: NDArray[np.float64]) -> float:
    """Relative L2 distance of two pressures."""
    return float(np.linalg.norm(pressure - reference) / np.linalg.norm(reference))


def disagreement(pressure: NDArray[np.float64], reference: NDArray[np.float64]) -> str:
    """What is wrong with ``pressure`` against ``reference``; empty if nothing is."""
    found, wanted = contact_pixels(pressure), contact_pixels(reference)
    faults = []
    if abs(found - wanted) > max(AREA_LIMIT * wanted, 2.0):
        faults.append(f"{found} contact pixels against {wanted}")
    distance = relative_l2(pressure, reference)
    if not distance <= PRESSURE_LIMIT:
        faults.append(f"pressure {distance:.1e} away")
    return ", ".join(faults)
