"""Preconditioned conjugate gradients on a working set."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from ...core.engine import Face
from .preconditioner import preconditioner
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
    last.face.lay(last.t, work.field)
    nothing = face.zeros()
    t = face.gather(work.field, nothing, nothing, face.zeros()).vector
    last.face.lay(last.kt, work.field)
    kt, total, curvature, _ = face.gather(work.field, t, t, nothing)
    work.engine.release(last.face, work.field)
    return Direction(face, t, kt, curvature, total)


def correction(
    qp: ContactQP, work: Workspace, face: Face, last: Direction | None, reduction: float, limit: int
) -> Correction:
    """Solve K d = residual on ``face``, d summing to zero under load, to ``reduction`` or for ``limit`` steps."""
    centred = isinstance(qp.constraint, FixedMean)
    inverse = preconditioner(work, face, qp.profile.size)
    r, d, z = face.residual(centred=centred), face.zeros(), face.zeros()
    first, pairs = 0.0, 0.0
    for step in range(limit):
        z, total, product, overlap = inverse.solve(r, r if last is None else last.kt, z)
        pairs += inverse.pairs
        mean = total / face.size if centred else 0.0
        if product <= 0.0 or (step and product < reduction**2 * first):
            return Correction(d if step else None, pairs, last)
        first = first or product
        ratio = 0.0
        if last is not None and last.curvature > 0.0:
            ratio = -(overlap - mean * last.total) / last.curvature
        t, kt = (face.zeros(), face.zeros()) if last is None else (last.t, last.kt)
        t, slope = face.direct(z, mean, ratio, t, r, work.field)
        work.fast.apply(work.field, work.response)
        pairs += qp.operator.pairs_per_application
        kt, total, curvature, _ = face.gather(work.response, t, t, kt)
        if curvature <= 0.0:
            return Correction(d if step else None, pairs, None)
        last = Direction(face, t, kt, curvature, total)
        d, r = face.advance(slope / curvature, t, kt, total / face.size if centred else 0.0, d, r)
    return Correction(d, pairs, last)
