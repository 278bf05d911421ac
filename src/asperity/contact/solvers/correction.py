"""Preconditioned conjugate gradients on a working set (FFT preconditioner: the inverse compliance, restricted)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from ...core.engine import Face
from .protocol import ContactQP, FixedMean
from .workspace import Workspace


@dataclass(frozen=True, eq=False)
class Direction:
    """Last search direction ``t`` on its ``face``, K t, their product and the sum of K t."""

    face: Face
    t: Any
    kt: Any
    curvature: float
    total: float


class Correction(NamedTuple):
    """Vector ``d``, None where no step was possible; FFT ``pairs`` it took; ``last`` search direction."""

    d: Any
    pairs: float
    last: Direction | None


def carried(work: Workspace, face: Face, last: Direction) -> Direction:
    """Search direction ``last`` on the new ``face``."""
    moved = []
    for vector in (last.t, last.kt):
        last.face.lay(vector)
        values, (total, _) = face.gather(work.field, face.zeros())
        moved.append(face.copied(values))
    work.engine.release(last.face, work.field)
    t, kt = moved
    return Direction(face, t, kt, face.product(t, kt), total)


def correction(
    qp: ContactQP, work: Workspace, face: Face, last: Direction | None, reduction: float, limit: int
) -> Correction:
    """Solve K d = residual on ``face``, d summing to zero under load, to ``reduction`` or for ``limit`` steps."""
    centred = isinstance(qp.constraint, FixedMean)
    r, d = face.residual(centred=centred), face.zeros()
    first, pairs = 0.0, 0.0
    for step in range(limit):
        work.preconditioner.solve(work.field, work.response)
        pairs += 1.0
        z, (total, product) = face.gather(work.response, r)
        mean = total / face.size if centred else 0.0
        if product <= 0.0 or (step and product < reduction**2 * first):
            return Correction(d if step else None, pairs, last)
        first = first or product
        ratio = 0.0
        if last is not None and last.curvature > 0.0:
            ratio = -(face.product(z, last.kt) - mean * last.total) / last.curvature
        t = face.direct(z, mean, ratio, face.zeros() if last is None else last.t)
        work.fast.apply(work.field, work.response)
        pairs += qp.operator.pairs_per_application
        gathered, (total, curvature) = face.gather(work.response, t)
        kt = face.copied(gathered)
        if curvature <= 0.0:
            return Correction(d if step else None, pairs, None)
        last = Direction(face, t, kt, curvature, total)
        d, r = face.advance(face.product(r, t) / curvature, t, kt, total / face.size if centred else 0.0, d, r)
    return Correction(d, pairs, last)
