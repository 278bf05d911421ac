"""Approach and retraction of adhesive contacts: the loop of force and approach, pull-off,
hysteresis, effective work of adhesion."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ...contact.controls import FixedGrips
from ...contact.result import ContactResult
from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.quantity import Quantity, stored_quantities
from .answer import AdhesiveContact

if TYPE_CHECKING:
    from .branch import Jump

_STORED = {item.name: item for item in stored_quantities(AdhesiveContact)}

ADHESION_SCALARS = (
    Quantity("adhesive_external_force", "N", "external force of the adhesive contact, pull negative"),
    _STORED["attractive_force"],
    _STORED["adhesive_area_fraction"],
    _STORED["interface_energy"],
    replace(_STORED["margin"], name="stability_margin"),
    _STORED["cohesive_length"],
    Quantity("pixels_per_cohesive_length", "1", "cohesive length / pixel; without range radius of a spot / pixel"),
    Quantity("needed_pixel", "m", "largest pixel that resolves the attracting zone"),
    _STORED["jumps"],
)
"""Every scalar of an adhesive contact, in the order of tables."""

LOOP_SCALARS = (
    Quantity("pull_off_force", "N", "pull-off force, the largest tensile force on the way"),
    Quantity("pull_off_approach", "m", "approach at the pull-off force"),
    Quantity("hysteresis", "J", "energy dissipated along the path"),
    Quantity("hysteresis_error", "J", "bound of the error of that energy by the length of the steps"),
    Quantity("effective_work_of_adhesion", "J/m**2", "work to part the surfaces from zero load / nominal area"),
)
"""Every scalar of a path of adhesive contacts, in the order of tables."""


def adhesion_cycle(
    farthest: float, deepest: float, *, steps: int = 20, cycles: int = 1, stiffness: float = math.inf
) -> tuple[FixedGrips, ...]:
    """Controls of a history in which grips approach from ``farthest`` to ``deepest`` (m) and go
    back.

    Parameters
    ----------
    farthest, deepest
        Approach of the grips in m at the ends, farthest < deepest; negative where the surfaces are
        apart.
    steps
        Steps of each way.
    cycles
        Number of times.
    stiffness
        Stiffness of the machine in N/m.

    Raises
    ------
    InputError
        If the ends are not in order, or a number is out of range.
    """
    require.integer(steps, 2, "number of steps of each way")
    require.integer(cycles, 1, "number of cycles")
    if not require.finite(farthest, "farthest approach (m)") < require.finite(deepest, "deepest approach (m)"):
        raise InputError(f"deepest approach must be more than the farthest {farthest:g} m, but is {deepest:g} m.")
    way = np.linspace(farthest, deepest, steps + 1)
    values = np.concatenate([[farthest], *(part for _ in range(cycles) for part in (way[1:], way[-2::-1]))])
    return tuple(FixedGrips(float(value), stiffness) for value in values)


@dataclass(frozen=True, eq=False)
class AdhesionLoop:
    """External force over approach of the steps of a history.

    Attributes
    ----------
    approach, force
        Approach of the bodies (m) and external force (N, negative pulls) after each step.
    energy
        Elastic energy and that of the interface (J) after each step.
    lost, error
        Energy (J) that each step lost of the solids, without the liquid, and the bound of its
        error.
    pulled
        Force (N) with which what else pulls, menisci, holds the surfaces together after each step.
    grips
        Approach (m) of the machine that holds the bodies after each step.
    jumped
        Whether the contact jumped in each step.
    margin
        Stability margin after each step.
    area
        Nominal area in m².
    """

    approach: RealArray
    force: RealArray
    energy: RealArray
    lost: RealArray
    error: RealArray
    pulled: RealArray
    grips: RealArray
    jumped: RealArray
    margin: RealArray
    area: float

    @property
    def pull_off(self) -> int:
        """Step of the most tensile force."""
        return int(np.argmin(self.force))

    @property
    def pull_off_force(self) -> float:
        """Largest tensile force in N; zero where none was met."""
        return max(-float(self.force[self.pull_off]), 0.0)

    @property
    def pull_off_approach(self) -> float:
        """Approach in m at the pull-off force."""
        return float(self.approach[self.pull_off])

    @cached_property
    def work(self) -> RealArray:
        """∫F dδ (J) up to each step: what the solids store and lose, less what the menisci do, that
        by the trapezoidal rule."""
        liquid = 0.5 * (self.pulled[1:] + self.pulled[:-1]) * np.diff(self.approach)
        done = np.diff(self.energy) + self.lost[1:] - liquid
        return np.concatenate([[0.0], np.cumsum(done)])

    @property
    def dissipated(self) -> RealArray:
        """Energy (J) lost up to each step: the work less the change of the energy."""
        lost: RealArray = self.work - (self.energy - self.energy[0])
        return lost

    @property
    def hysteresis(self) -> float:
        """Energy (J) lost along the whole path; over a closed cycle that is ∮F dδ."""
        return float(self.dissipated[-1])

    @property
    def hysteresis_error(self) -> float:
        """Bound (J) of the error of the energy lost: of each step, and of the menisci half of the
        change of their force over it."""
        liquid = 0.5 * np.abs(np.diff(self.pulled) * np.diff(self.approach))
        return float(self.error[1:].sum() + liquid.sum())

    @property
    def jump_intervals(self) -> tuple[tuple[float, float], ...]:
        """Approaches (m) of the grips between which each jump begins, in the order of the path."""
        return tuple((float(self.grips[k - 1]), float(self.grips[k])) for k in np.flatnonzero(self.jumped))

    def closed_in(self, jumps: Sequence[Jump]) -> AdhesionLoop:
        """The same with the energies of ``jumps`` that were closed in on (``adhesive_jumps``),
        which are better known."""
        lost, error = self.lost.copy(), self.error.copy()
        for jump in jumps:
            lost[jump.step], error[jump.step] = jump.lost, jump.lost_error
        return replace(self, lost=lost, error=error)

    @property
    def effective_work(self) -> float:
        """Work (J/m²) of parting from the last step without tension: -∫F dδ from there over the
        nominal area; NaN if the path ends pressed.

        Of surfaces that part at the end of the path. Rough surfaces need less than their work of
        adhesion, or more where energy is lost in jumps.
        """
        pressed = np.flatnonzero(self.force >= 0.0)
        first = int(pressed[-1]) if pressed.size else 0
        if first >= self.force.size - 1:
            return math.nan
        start, f0, f1 = self.approach[first], self.force[first], self.force[first + 1]
        step = self.approach[first + 1] - start
        share = f0 / (f0 - f1) if f0 > 0.0 > f1 else 0.0
        work = 0.5 * (f1 + (f0 if share == 0.0 else 0.0)) * (1.0 - share) * step + (
            self.work[-1] - self.work[first + 1]
        )
        return float(work) / self.area


def adhesion_loop(steps: Sequence[ContactResult]) -> AdhesionLoop:
    """Loop of the ``steps`` of a history of an adhesive contact, ``HistoryResult.steps``.

    InputError if a step has no adhesion.
    """
    found = [step.require_adhesion() for step in steps]
    beside = [[answer.pulls() for answer in step.answers if answer.traction_beside() is None] for step in steps]
    return AdhesionLoop(
        approach=np.array([step.approach for step in steps]),
        force=np.array([step.external_force for step in steps]),
        energy=np.array([item.elastic_energy + item.interface_energy for item in found]),
        lost=np.array([item.dissipated for item in found]),
        error=np.array([item.dissipated_error for item in found]),
        pulled=np.array([float(sum(pulls)) for pulls in beside]),
        grips=np.array([item.grips for item in found]),
        jumped=np.array([item.jumped for item in found]),
        margin=np.array([item.margin for item in found]),
        area=steps[0].problem.grid.area,
    )
