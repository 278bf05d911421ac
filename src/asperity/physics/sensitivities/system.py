"""The linear system of a contact on its fixed set, and the state polished on it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple, TypeAlias

import numpy as np

from ...contact.measure import Response
from ...contact.operators import Operator
from ...contact.solvers.active_set.linear_system import Stopping
from ...core.arrays import BoolArray, RealArray
from ...core.errors import ConvergenceError, InputError
from .outputs import State

Held: TypeAlias = Literal["load", "approach"]
"""What stays as it is while a parameter changes."""

RESIDUAL = 1e-8
"""Residual of the linear system over its right-hand side that is asked for, as largest entries."""

_MARGIN, _MOST_STEPS = 0.25, 500
"""Reduction in the norm of conjugate gradients over that of the largest entry that is asked for,
with which at most one step follows in vain; steps at most."""

_CARRIED = 1e-9
"""Residual down to which conjugate gradients carry it along in double precision as it is; below it
is computed."""

_REFINEMENTS = 1
"""Further solves for the residual that is left: usually there is none."""

_NO_BETTER, _WORST = 0.5, 1e-6
"""Reduction of the residual by a further solve above which no other follows; residual above which
the solution is refused."""

POLISHED = 1e-8
"""Residual of the contact over the rms height above which its pressure is corrected on its set, to
a tenth of it."""


class Solved(NamedTuple):
    """``values`` (nx, ny), zero off the set, the ``multiplier`` of the load, the relative
    ``residual`` and the FFT ``pairs`` that it took."""

    values: RealArray
    multiplier: float
    residual: float
    pairs: float


@dataclass(frozen=True, eq=False)
class FixedSet:
    """The operator K on the points ``free`` (nx, ny): the system K a + μ = r on them, with the sum
    of a prescribed where the load is ``held``; at given position without μ (Giles &
    Pierce 2000)."""

    operator: Operator
    free: BoolArray
    held: Held

    def __post_init__(self) -> None:
        if not self.free.any():
            raise InputError(
                "contact of sensitivities must have a point that touches without yielding, but has none. Take "
                "another load ({load})."
            )
        if self.held == "approach" and self.free.all() and self.operator.zero_mean_mode:
            raise InputError(
                "contact of sensitivities at a held approach must be partial, but is full and periodic, whose approach "
                "does not depend on the load. Hold the load."
            )

    def solve(self, right: RealArray, total: float = 0.0, enough: float = RESIDUAL) -> Solved:
        """Solution for ``right`` (nx, ny; off the set it does not matter), whose values sum to
        ``total`` where the load is held, to the relative residual ``enough``.

        Raises
        ------
        ConvergenceError
            If conjugate gradients do not reach the tolerance.
        """
        free, operator, load = self.free, self.operator, self.held == "load"
        size, values, pairs, prepared = int(free.sum()), np.zeros(free.shape), 0.0, None
        scale, least = float(np.abs(right[free]).max()), np.inf
        if load and total and float(np.ptp(right[free])) == 0.0 and not (free.all() and operator.zero_mean_mode):
            return self._uniform(float(right[free][0]), total, enough)
        if load and total:
            values[free] = total / size
        for left_over in range(_REFINEMENTS + 1, -1, -1):
            left = right
            if values.any():
                deflection = operator.apply(values)
                scale = max(scale, float(np.abs(deflection[free]).max()))
                left, pairs = right - deflection, pairs + operator.pairs_per_application
            left, multiplier = self._centred(left)
            residual = float(np.abs(left).max()) / scale if scale else 0.0
            if residual <= enough or not left_over or residual > _NO_BETTER * least:
                break
            least, prepared = residual, prepared or Response.of(operator, free, "float64")
            stopping = Stopping(min(_MARGIN * enough / residual, _MARGIN), _MOST_STEPS)
            found = prepared.solved(left, zero_sum=load, stopping=stopping)
            pairs += found.pairs
            if found.values is None:
                break
            values = values + found.pressure
            if enough >= _CARRIED and found.error <= enough * scale:
                residual, multiplier = found.error / scale, multiplier + found.level
                break
        if residual > max(_WORST, enough):
            raise ConvergenceError(
                f"The linear system of the sensitivities did not converge: its relative residual is {residual:.1e}."
            )
        return Solved(values, multiplier if load else 0.0, residual, pairs)

    def _uniform(self, rise: float, total: float, enough: float) -> Solved:
        """The same for a right-hand side that is ``rise`` everywhere: by the pressure that moves
        the set by one."""
        one = FixedSet(self.operator, self.free, "approach").solve(np.where(self.free, 1.0, 0.0), enough=enough)
        stiffness = float(one.values.sum())
        return Solved(one.values * (total / stiffness), rise - total / stiffness, one.residual, one.pairs)

    def _centred(self, field: RealArray) -> tuple[RealArray, float]:
        """``field`` on the set, zero elsewhere, less its mean there where the load is held; and
        that mean."""
        on_set = np.where(self.free, field, 0.0)
        if self.held == "approach":
            return on_set, 0.0
        mean = float(on_set.sum()) / int(self.free.sum())
        return np.where(self.free, on_set - mean, 0.0), mean


class Polished(NamedTuple):
    """``state`` on the set with the exact pressure there; ``before``, as the solver left it; its
    ``error``, the largest residual on the set over the rms height; points ``changed`` whose
    pressure or gap has the wrong sign on the set; FFT ``pairs``."""

    state: State
    before: State
    error: float
    changed: int
    pairs: float


def polished(state: State, fixed: FixedSet, total: float | None, enough: float = POLISHED) -> Polished:
    """``state`` with its residual on the set solved for; ``total``: sum of all pressures where the
    load is held; ``enough``: residual over the rms height, and lack of load over that, which need
    no correction."""
    operator = fixed.operator
    lack = 0.0 if total is None else total - float(state.pressure.sum())
    residual = np.where(state.free, -state.gap, 0.0)
    scale = float(state.profile.std()) or float(np.abs(state.deflection).max()) or 1.0
    error, pairs, found = float(np.abs(residual).max()) / scale, 0.0, state
    if error > enough or (total is not None and abs(lack) > enough * total):
        unbalanced = abs(lack) / total if total else 0.0
        solved = fixed.solve(residual, lack, 0.1 * enough / max(error, unbalanced))
        pressure = state.pressure + solved.values
        deflection = operator.apply(pressure)
        pairs = solved.pairs + operator.pairs_per_application
        found = state._replace(pressure=pressure, deflection=deflection, offset=state.offset + solved.multiplier)
    tolerance = 1e-9 * scale
    wrong = (found.free & (found.pressure < 0.0)) | (found.open & (found.gap < -tolerance))
    wrong |= found.capped & (found.gap > tolerance)
    return Polished(found, state, error, int(wrong.sum()), pairs)
