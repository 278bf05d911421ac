"""Whether the numbers of a contact in a file agree with each other: a damaged or forged field must
not load as a converged result."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..contact.result import ContactResult, Later

FIELDS = ("pressure", "gap", "permanent_indentation", "displacement")
"""Fields that are checked where they are at hand; what comes back later is checked then."""


def sound(result: ContactResult) -> ContactResult:
    """``result`` if its fields are finite, pressure, gap and indentation not negative, and its
    scalars those of its fields.

    Scalars agree to the root of the rounding of the fields, 1e-8 or, in single precision, 3e-4:
    they were summed in the order of the solver.

    Raises
    ------
    ValueError
        If not; it names the field or scalar, and what it is.
    """
    p = result.pressure
    here = {name: field for name in FIELDS if not isinstance(field := vars(result)[name], Later)}
    for name, field in here.items():
        if not np.isfinite(field).all():
            raise ValueError(f"{name} must be finite, but is not at {np.count_nonzero(~np.isfinite(field))} points")
        if name != "displacement" and (least := float(field.min())) < 0.0:
            raise ValueError(f"{name} must not be negative, but is {least:g} somewhere")
    grid, total = result.problem.grid, float(p.sum(dtype=np.float64))
    pixels = int(np.count_nonzero(p))
    expected = {
        "force": total * grid.pixel_area,
        "mean_pressure": total / grid.n_points,
        "max_pressure": float(p.max()),
        "area_fraction": pixels / grid.n_points,
    }
    expected |= {"mean_gap": float(here["gap"].mean(dtype=np.float64))} if "gap" in here else {}
    for name, value in expected.items():
        stated = float(getattr(result, name))
        if not agrees(stated, value, p.dtype):
            raise ValueError(f"{name} is stated as {stated:g}, but its field gives {value:g}")
    for answer in result.answers:
        answer.require_sound()
    for name in ("approach", "offset", "mean_gap"):
        if not math.isfinite(stated := float(getattr(result, name))):
            raise ValueError(f"{name} must be finite, but is {stated:g}")
    return result


def agrees(stated: float, value: float, kind: np.dtype[Any], error: float = 0.0) -> bool:
    """Whether what is ``stated`` is the ``value`` that a field of this ``kind`` gives, to the root
    of its rounding and an ``error``."""
    return abs(stated - value) <= math.sqrt(np.finfo(kind).eps) * max(abs(value), abs(stated)) + error
