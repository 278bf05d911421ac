"""Preconditioned conjugate gradients on a working set."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

from ...core.engine import Face
from .preconditioner import Preconditioner, preconditioner
from .workspace import Bench


class Direction(NamedTuple):
    """Search direction ``t``, K t, their product and the sum of K t."""

    t: Any
    kt: Any
    curvature: float
    total: float


@dataclass(frozen=True, eq=False)
class System:
    """Equations K d = r on a ``face``; if ``centred`` up to a constant, d summing to zero. ``tools`` to solve them with."""

    tools: Bench
    face: Face
    centred: bool

    def mean(self, total: float) -> float:
        """Mean of a vector that sums to ``total``, where it is to be taken out."""
        return total / self.face.size if self.centred else 0.0

    def direction(self, r: Any, found: tuple[Any, float, float], last: Direction | None) -> tuple[Any, float, Any]:
        """Search direction from the preconditioned residual ``found``, with its sum and its product with K ``last``.

        Laid out in the field; with its product with ``r`` and memory for its own product with K.
        """
        z, total, overlap = found
        mean, ratio = self.mean(total), 0.0
        if last is not None:
            ratio = -(overlap - mean * last.total) / last.curvature
        t, kt = (self.face.zeros(), self.face.zeros()) if last is None else (last.t, last.kt)
        t, slope = self.face.direct(z, mean, ratio, t, r, self.tools.field)
        return t, slope, kt


class Change(NamedTuple):
    """``values`` by which the pressure on the ``face`` has changed, in the units of a correction."""

    face: Face
    values: Any


class Beside(NamedTuple):
    """What goes on beside a correction.

    ``pending`` is a change whose deflection is not in the residual yet, None where there is none. ``follow`` is told the
    length of every step while its product with the compliance lies in the response of the bench.
    """

    pending: Change | None
    follow: Callable[[float], None]


class Effort(NamedTuple):
    """When to stop: at this ``reduction`` of the residual, or after a ``limit`` of steps."""

    reduction: float
    limit: int


class Correction(NamedTuple):
    """Vector ``d``, None where no step was possible; FFT ``pairs`` it took; whether the reduction was ``reached``."""

    d: Any
    pairs: float
    reached: bool


def correction(system: System, r: Any, effort: Effort, beside: Beside | None = None) -> Correction:
    """Solve the ``system`` for the residual ``r``, which may be overwritten, with this ``effort``."""
    tools, face = system.tools, system.face
    inverse = preconditioner(tools, face)
    d, z = face.zeros(), face.zeros()
    last: Direction | None = None
    first, pairs, taken, reached = 0.0, 0.0, 0, False
    if beside is not None and beside.pending is not None:
        d, r, first = _together(system, inverse, r, beside, (d, z))
        taken = 1
        pairs = tools.operator.pairs_per_application + (inverse.pairs if first else 0.0)
    while taken < effort.limit:
        z, total, product, overlap = inverse.solve(r, r if last is None else last.kt, z)
        pairs += inverse.pairs
        reached = product <= 0.0 or (taken > 0 and product < effort.reduction**2 * first)
        if reached:
            break
        first = first or product
        t, slope, kt = system.direction(r, (z, total, overlap), last)
        tools.fast.apply(tools.field, tools.response)
        pairs += tools.operator.pairs_per_application
        kt, total, curvature, _ = face.gather(tools.response, t, t, kt)
        if curvature <= 0.0:
            break
        last = Direction(t, kt, curvature, total)
        taken += 1
        if beside is not None:
            beside.follow(slope / curvature)
        d, r = face.advance(slope / curvature, t, kt, system.mean(total), d, r)
    return Correction(d if taken else None, pairs, reached)


def _together(
    system: System, inverse: Preconditioner, r: Any, beside: Beside, memory: tuple[Any, Any]
) -> tuple[Any, Any, float]:
    """First step d, of fixed length, by one product with the compliance that serves the pending change as well.

    The residual that the change will leave is foreseen where the preconditioner can, else the step is nothing. Returns d,
    the residual after both, and the foreseen one times its preconditioned self. ``memory``: for d (zeros), and to work in.
    """
    tools, face, pending = system.tools, system.face, beside.pending
    assert pending is not None
    foreseen = inverse.foreseen(r, *pending)
    if foreseen is None:
        t, kt, length, product = face.zeros(), face.zeros(), 1.0, 0.0
    else:
        z, total, product, overlap = inverse.solve(foreseen, foreseen, memory[1])
        t, _, kt = system.direction(r, (z, total, overlap), None)
        length = inverse.step
    pending.face.lay(pending.values, tools.field, added=1.0 / length)
    tools.fast.apply(tools.field, tools.response)
    tools.engine.release(pending.face, tools.field)
    kt, total, _, _ = face.gather(tools.response, t, t, kt)
    beside.follow(length)
    d, r = face.advance(length, t, kt, system.mean(total), memory[0], r)
    return d, r, product
