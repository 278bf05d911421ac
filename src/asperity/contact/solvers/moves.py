"""How the pressure follows a correction: freely for the time being, or clipped to its bounds at once."""

from __future__ import annotations

from typing import Any

from ...core.engine import Face, Load
from .correction import Change
from .protocol import FixedMean
from .workspace import Workspace

LEAST_SHARE = 0.1
"""Share of a clipped step that is worth taking."""

_LOAD_SWEEPS = 100
_LOAD_ROUNDING = 1e-14


def free_move(work: Workspace, face: Face, d: Any) -> tuple[int, float]:
    """Add ``d`` to the pressure as it is; the number of points that pull then, and the sum (Pa) of how much.

    They leave the working set with the next step, for which ``brought_back`` must clear them.
    """
    return face.shift(work.pressure, d, work.unit)


def brought_back(work: Workspace, face: Face, total: float) -> Change:
    """Clear the points of the ``face`` that pull and scale the others, of the sum ``total``, to the load; the change."""
    constraint, factor = work.qp.constraint, 1.0
    if isinstance(constraint, FixedMean) and total > 0.0:
        factor = constraint.mean_pressure * work.qp.profile.size / total
    return Change(face, face.press(work.pressure, factor, work.unit))


def bounded_move(work: Workspace, face: Face, d: Any, r: Any, total: float) -> tuple[int, float]:
    """Add ``d``, clipped and scaled to the load, to the pressure of sum ``total``: points clipped, share of the step taken.

    The deflection by the whole step is left in the response of the bench. The energy falls: it changes by
    -r·step + step·K step / 2, ``r`` being the residual on the ``face``, and the step is shortened to its minimum.
    """
    qp, tools, p = work.qp, work.bench, work.pressure
    old, load = face.pick(p)
    found, clipped = face.move(p, d, work.unit, work.cap)
    if isinstance(qp.constraint, FixedMean):
        missing = qp.constraint.mean_pressure * qp.profile.size - total
        _restore_load(face, p, work.cap, found, max(load + missing, 0.0))
    change, along = face.lay_change(old, p, r, tools.field)
    tools.fast.apply(tools.field, tools.response)
    reaction = face.gather(tools.response, change, change, d).first
    share = _share(-along * qp.height_scale, reaction * tools.scale)
    if share < 1.0:
        share = share if share >= LEAST_SHARE else 0.0
        face.blend(old, share, p)
    return clipped, share


def _share(slope: float, curvature: float) -> float:
    """How far to go along a step of this ``slope`` and ``curvature`` of the energy: all the way, or to its minimum."""
    if slope + 0.5 * curvature <= 0.0:
        return 1.0
    return -slope / curvature if slope < 0.0 else 0.0


def _restore_load(face: Face, pressure: Any, cap: Any, found: Load, target: float) -> None:
    """Scale the clipped ``pressure`` on the ``face`` (in place), where its sums are ``found``, to the sum ``target``.

    Where every loaded point is at its cap, the rest of the load is spread over the points below it.
    """
    for _ in range(_LOAD_SWEEPS):
        missing = target - found.pressure
        if abs(missing) <= _LOAD_ROUNDING * target:
            break
        if found.movable > 0.0 and found.movable + missing > 0.0:
            found = face.scale(pressure, (found.movable + missing) / found.movable, 0.0, cap)
        elif missing < 0.0:
            found = face.scale(pressure, target / found.pressure, 0.0, None)
        else:
            found = face.scale(pressure, 1.0, missing / found.below, cap)
