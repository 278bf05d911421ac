"""Convergence of a quantity with grid, tolerance or domain: observed order and extrapolated
value."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from ..core.errors import InputError
from ..io.schemas.study import ConvergenceTable
from .axes import Axis, Base, Point
from .places import locate

HALVINGS = 60
"""Bisections of an interval of orders, which so shrinks below the rounding."""

HIGHEST_ORDER = 64.0
"""Beyond it the differences fall faster than any order that three levels could show."""


@dataclass(frozen=True)
class Convergence:
    """How a quantity converges.

    Attributes
    ----------
    steps, values
        Step sizes h, falling, and values Y(h).
    order
        p of Y(h) = Y(0) + C h^p from the three finest levels (Roache 1998); NaN where the values do
        not fall into line.
    extrapolated
        Y(0) by Richardson extrapolation; NaN without an order.
    error
        Relative difference of the finest value from the extrapolated one; NaN without an order.
    remark
        What keeps the order from being found; empty otherwise.
    """

    steps: tuple[float, ...]
    values: tuple[float, ...]
    order: float = math.nan
    extrapolated: float = math.nan
    error: float = math.nan
    remark: str = ""


def convergence(steps: Sequence[float], values: Sequence[float]) -> Convergence:
    """Observed order and extrapolated value of ``values`` at falling ``steps``, at least three.

    Raises
    ------
    InputError
        If there are fewer than three levels, not as many values as steps, or the steps do not fall.
    """
    h, y = tuple(map(float, steps)), tuple(map(float, values))
    if len(h) < 3 or len(h) != len(y):
        raise InputError(
            f"steps of a convergence study must be at least three, with as many values, but are {len(h)} and {len(y)}."
        )
    if any(b >= a for a, b in pairwise(h)) or h[-1] <= 0.0:
        raise InputError(f"steps of a convergence study must be positive and fall, but are {h}.")
    coarse, fine = y[-3] - y[-2], y[-2] - y[-1]
    remark = ""
    if not all(map(math.isfinite, y[-3:])):
        remark = "a level has failed"
    elif fine == 0.0:
        remark = "the two finest levels agree to the last digit"
    elif coarse == 0.0:
        remark = "the two coarser levels agree to the last digit"
    elif coarse * fine < 0.0:
        remark = "values swing from level to level"
    if remark:
        return Convergence(h, y, remark=remark)
    order = _order(h[-3] / h[-2], h[-2] / h[-1], coarse / fine)
    if math.isnan(order):
        return Convergence(h, y, remark="differences do not fall like a power of the step: finer levels are needed")
    limit = y[-1] - fine / ((h[-2] / h[-1]) ** order - 1.0)
    return Convergence(h, y, order, limit, abs(y[-1] - limit) / abs(limit) if limit != 0.0 else math.inf)


def level_axis(base: Base, table: ConvergenceTable) -> Axis:
    """Axis of the levels of a convergence study; a grid of one row stays one.

    Raises
    ------
    InputError
        If the problem has no grid that can be changed.
    """
    if table.of == "tolerance":
        place = locate(base.document, "solver.tolerance")
        return Axis("level", "1", place.path, [Point(level, (base.edit(place, level),)) for level in table.levels])
    points = getattr(base.document.surface, "points", None)
    if points is None:
        raise InputError(
            f"convergence of the {table.of} needs a generated surface, but the surface is read from a file. Vary the "
            "points of a step resample by an axis instead.",
            subject=f"convergence of the {table.of}",
        )
    place = locate(base.document, "surface.points")
    nx, ny = points
    made = []
    for level in table.levels:
        factor = level / nx if table.of == "grid" else level
        shape = [max(1, round(nx * factor)), ny if ny == 1 else max(1, round(ny * factor))]
        edits = [base.edit(place, shape)]
        if table.of == "domain":
            size = locate(base.document, "surface.size")
            length_x, length_y = size.content(getattr(base.document.surface, "size", ""), base.folder)
            edits.append(base.edit(size, f"{length_x * (shape[0] / nx)!r} m x {length_y * (shape[1] / ny)!r} m"))
        made.append(Point(float(level), tuple(edits)))
    return Axis("level", "1", place.path, made)


def step_sizes(of: str, levels: Sequence[float]) -> tuple[float, ...]:
    """Steps that fall with the ``levels``: inverse numbers of points, tolerances, inverse sizes."""
    return tuple(levels) if of == "tolerance" else tuple(1.0 / level for level in levels)


def _order(coarse: float, fine: float, differences: float) -> float:
    """Order p from d₁/d₂ = r₂^p (r₁^p - 1) / (r₂^p - 1), for ratios r of the steps ``coarse`` and
    ``fine`` (Roache 1998).

    The right side rises with p from ln r₁/ln r₂; below that there is no positive order.
    """

    def excess(p: float) -> float:
        growth = math.expm1(p * math.log(coarse)) / math.expm1(p * math.log(fine))
        return math.pow(fine, p) * growth - differences

    low, high = 1e-6, 1.0
    if excess(low) >= 0.0:
        return math.nan
    while excess(high) < 0.0:
        high *= 2.0
        if high > HIGHEST_ORDER:
            return math.nan
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(middle) < 0.0 else (low, middle)
    return 0.5 * (low + high)
