"""Preconditioned conjugate gradients on a working set."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from ...core.engine import Face
from .preconditioner import preconditioner
from .workspace import Bench


@dataclass(frozen=True, eq=False)
class Direction:
    """Last search direction ``t`` on its ``face``, K t, their product and the sum of K t."""

    face: Face
    t: Any
    kt: Any
    curvature: float
    total: float


class Effort(NamedTuple):
    """When to stop: at this ``reduction`` of the residual, or after a ``limit`` of steps."""

    reduction: float
    limit: int


class Correction(NamedTuple):
    """Vector ``d``, None where no step was possible; FFT ``pairs`` it took; ``last`` search direction; whether ``reached``."""

    d: Any
    pairs: float
    last: Direction | None
    reached: bool


def carried(tools: Bench, face: Face, last: Direction) -> Direction:
    """Search direction ``last`` on the new ``face``."""
    last.face.lay(last.t, tools.field)
    nothing = face.zeros()
    t = face.gather(tools.field, nothing, nothing, face.zeros()).vector
    last.face.lay(last.kt, tools.field)
    kt, total, curvature, _ = face.gather(tools.field, t, t, nothing)
    tools.engine.release(last.face, tools.field)
    return Direction(face, t, kt, curvature, total)


def correction(
    tools: Bench, face: Face, r: Any, last: Direction | None, effort: Effort, *, centred: bool
) -> Correction:
    """Solve K d = r on ``face`` with this ``effort``; if ``centred`` up to a constant, d summing to zero.

    ``r`` may be overwritten, as may the vectors of ``last``, a search direction to begin with.
    """
    inverse = preconditioner(tools, face)
    d, z = face.zeros(), face.zeros()
    first, pairs, taken, reached = 0.0, 0.0, 0, False
    while taken < effort.limit:
        z, total, product, overlap = inverse.solve(r, r if last is None else last.kt, z)
        pairs += inverse.pairs
        mean = total / face.size if centred else 0.0
        reached = product <= 0.0 or (taken > 0 and product < effort.reduction**2 * first)
        if reached:
            break
        first = first or product
        ratio = 0.0
        if last is not None and last.curvature > 0.0:
            ratio = -(overlap - mean * last.total) / last.curvature
        t, kt = (face.zeros(), face.zeros()) if last is None else (last.t, last.kt)
        t, slope = face.direct(z, mean, ratio, t, r, tools.field)
        tools.fast.apply(tools.field, tools.response)
        pairs += tools.operator.pairs_per_application
        kt, total, curvature, _ = face.gather(tools.response, t, t, kt)
        if curvature <= 0.0:
            last = None
            break
        last = Direction(face, t, kt, curvature, total)
        taken += 1
        d, r = face.advance(slope / curvature, t, kt, total / face.size if centred else 0.0, d, r)
    return Correction(d if taken else None, pairs, last, reached)
