"""Contacts with adhesion of infinitely short range: their edge moves point by point, by the energy
that it releases.

The points in contact are closed whatever their traction; the others bear none. A point comes loose
where its tension is above

    σ_c = sqrt(2w/s),

s the compliance of a point at a step of the edge while all points behind it stay closed. By the
theorem of Szegő, and that of Helson & Lowdenslager (1958) for two dimensions, this is the geometric
mean of the symbol of the discrete operator: no constant has to be fitted, and rectangular points,
layers, lines and periodic surfaces are covered. For a square grid of spectral coefficients it is
0.920 Δx/E*, near 2·0.4732 Δx/E* that Pohrt & Popov (2015) take from a single loaded square. A point
ahead of the edge closes where half the product of the tension behind the edge and the gap ahead of
it, the energy of closing, is below w.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from ....contact.operators import Operator
from ....core.arrays import RealArray
from ....core.status import Outcome, Status
from ..jkr import JKRAdhesion
from ..law import Adhesion
from .problem import Adhered, AdhesiveProblem
from .solver import FINEST, AdhesiveSolution, Work, minimised

_LOOSE = 1e-9
"""Error of the normal solves on the way; the tension is right to some 1e-4."""

_GRIP = 4.0
"""Pull that keeps points closed, over the tension at which they come loose."""

_LEFT = 1e-3
"""Pressure left to every point in contact, over that tension, so that it counts as touching."""

_SLACK = 1e-3
"""Share by which the tension of the confirming solve may be above that of the solve before."""

_AHEAD = 3.0
"""Gap ahead of the edge, over that at which a point would close at the critical tension, beyond
which it is not tried."""


def step_compliance(operator: Operator) -> float:
    """Compliance (m/Pa) of a point at a step of the edge of a contact, all points behind it closed.

    The geometric mean of the symbol of ``operator`` over all waves of the grid but the mean.
    """
    kernel, columns = operator.kernel, operator.padded[1]
    twice = np.full(kernel.shape[1], 2.0)
    twice[0] = 1.0
    if columns % 2 == 0 and columns > 1:
        twice[-1] = 1.0
    weight = np.broadcast_to(twice, kernel.shape).copy()
    weight[0, 0] = 0.0
    weight[kernel <= 0.0] = 0.0
    return float(np.exp((weight * np.log(np.where(weight > 0.0, kernel, 1.0))).sum() / weight.sum()))


@dataclass(frozen=True)
class MovingFront:
    """Contact whose edge is moved until no point of it would release more than the work of
    adhesion, nor close for less.

    First all points that bear too much come loose, again and again; this has one end, whatever the
    order, for at a given position the others then bear more. Then points ahead of the edge close
    where that releases energy, except those that came loose in this solve. Both are repeated until
    nothing moves. Only the energy of a whole step of the edge counts: straight edges along the axes
    hold on to more.

    Parameters
    ----------
    compliance
        That of a point at a step of the edge, ``step_compliance``, in m/Pa.
    max_steps
        Normal solves after which it gives up.
    """

    compliance: float
    max_steps: int = 2000
    name: ClassVar[str] = "moving front"
    citation_keys: ClassVar[tuple[str, ...]] = ("PohrtPopov2015", "Helson1958")

    def tension(self, law: Adhesion) -> float:
        """σ_c in Pa."""
        return math.sqrt(2.0 * law.work / self.compliance)

    def solve(self, problem: AdhesiveProblem, pull: RealArray, pressure: RealArray | None = None) -> AdhesiveSolution:
        """Equilibrium that is reached from the contact in which ``pull`` (nx, ny) is positive,
        started from this wall ``pressure``.

        Raises
        ------
        NoSolutionError
            If the load prescribed pulls the surfaces apart.
        """
        work, tolerance, count = Work(), _LOOSE, 0
        closed, parted = pull > 0.0, np.zeros(pull.shape, dtype=bool)
        most = self.tension(problem.law)
        closes = not isinstance(problem.law, JKRAdhesion) or problem.law.closes
        grip = _GRIP * most
        energies = []
        while True:
            count += 1
            # closed points are held together by more than they can bear
            cap = problem.cap
            if isinstance(cap, np.ndarray) or cap < np.inf:
                cap = np.where(closed, cap + grip, cap)
            state = minimised(replace(problem, cap=cap), np.where(closed, grip, 0.0), pressure, work, tolerance)
            closed, pressure = closed | (state.pressure > 0.0), state.pressure
            energies.append(problem.energy(state))
            loose = closed & ((-state.traction > most) | (state.pressure <= 0.0))
            ahead = loose
            if not loose.any() and closes:
                # open points next to closed ones whose closing releases energy
                behind = np.where(closed, np.maximum(-state.traction, 0.0), -1.0)
                tension = neighbouring(behind, wraps=problem.operator.boundary.wraps)
                near = state.gap < _AHEAD * most * self.compliance
                ahead = ~closed & near & (tension >= 0.0) & (0.5 * tension * state.gap < problem.law.work) & ~parted
            if count >= self.max_steps or (not ahead.any() and tolerance == FINEST):
                break
            if loose.any():
                closed, parted = closed & ~loose, parted | loose
            elif ahead.any():
                closed = closed | ahead
            else:
                tolerance = FINEST
        pixel = problem.operator.grid.pixel_area
        energy = problem.energy(state) * pixel
        scaled = tuple(value * pixel for value in energies)
        status = Status(Outcome.CONVERGED, f"The edge of the contact is at rest after {count} solves.")
        if ahead.any():
            text = f"{np.count_nonzero(ahead)} points at the edge of the contact still move after {count} solves."
            status = Status(Outcome.ITERATION_LIMIT, text, "Take smaller steps of load or position.")
        # no more pull than each point needs to stay closed
        traction = np.where(closed, state.traction, 0.0)
        pull = np.where(closed, np.maximum(-traction, 0.0) + _LEFT * most, 0.0)
        gap = np.where(closed, 0.0, state.gap)
        shown = Adhered(np.where(closed, traction + pull, 0.0), pull, state.deflection, gap, pull, state.offset)
        return AdhesiveSolution(shown, energy, scaled, count, 0, work.pairs, status)

    def miss(self, law: Adhesion, pull: RealArray, pressure: RealArray, gap: RealArray) -> float:
        """One where points would come loose or touch anew under this wall ``pressure`` (Pa) and
        ``pull``, else zero; fields (nx, ny)."""
        most, traction = self.tension(law), pressure - pull
        loose = (pull > 0.0) & ((traction < -(1.0 + _SLACK) * most) | (pressure <= 0.0))
        touches = (pull <= 0.0) & (pressure > _SLACK * most)
        return float((loose | touches).any())

    def margin(self, problem: AdhesiveProblem, state: Adhered) -> float:
        """1 less the energy that the most strained point would release over the work of
        adhesion."""
        most = max(float(-state.traction.min()), 0.0)
        return 1.0 - (most / self.tension(problem.law)) ** 2


def neighbouring(field: RealArray, *, wraps: tuple[bool, bool]) -> RealArray:
    """Largest value of ``field`` (nx, ny) among the four neighbours of each point, -1 where there
    are none."""
    found = np.full_like(field, -1.0)
    for axis in range(2):
        if field.shape[axis] == 1:
            continue
        for shift in (1, -1):
            moved = np.roll(field, shift, axis)
            if not wraps[axis]:
                edge: list[slice | int] = [slice(None), slice(None)]
                edge[axis] = 0 if shift == 1 else -1
                moved[tuple(edge)] = -1.0
            np.maximum(found, moved, out=found)
    return found
