"""Whether the numbers of a contact in a file agree with each other: a damaged or forged field must not load as a converged result."""

from __future__ import annotations

import math

import numpy as np

from ..contact.result import ContactResult
from ..core.arrays import RealArray


def sound(result: ContactResult) -> ContactResult:
    """``result`` if its fields are finite, pressure, gap and indentation not negative, and its scalars those of its fields.

    Scalars agree to the root of the rounding of the fields, 1e-8 or, in single precision, 3e-4: they were summed in the order of the solver.

    Raises
    ------
    ValueError
        If not; it names the field or scalar, and what it is.
    """
    p, gap = result.pressure, result.gap
    for name, field in (("pressure", p), ("gap", gap), ("permanent_indentation", result.permanent_indentation)):
        _require_finite(name, field)
        if (least := float(field.min())) < 0.0:
            raise ValueError(f"{name} must not be negative, but is {least:g} somewhere")
    _require_finite("displacement", result.displacement)
    grid, total = result.problem.grid, float(p.sum(dtype=np.float64))
    pixels = int(np.count_nonzero(p))
    close = math.sqrt(np.finfo(p.dtype).eps)
    expected = {
        "force": total * grid.pixel_area,
        "mean_pressure": total / grid.n_points,
        "max_pressure": float(p.max()),
        "mean_gap": float(gap.mean(dtype=np.float64)),
        "area_fraction": pixels / grid.n_points,
    }
    for name, value in expected.items():
        stated = float(getattr(result, name))
        if not abs(stated - value) <= close * max(abs(value), abs(stated)):
            raise ValueError(f"{name} is stated as {stated:g}, but its field gives {value:g}")
    for name in ("approach", "offset"):
        if not math.isfinite(stated := float(getattr(result, name))):
            raise ValueError(f"{name} must be finite, but is {stated:g}")
    return result


def _require_finite(name: str, field: RealArray) -> None:
    if not np.isfinite(field).all():
        raise ValueError(f"{name} must be finite, but is not at {np.count_nonzero(~np.isfinite(field))} points")
