"""A fluid that flows through the gap and presses on both bodies, as a physics of a problem."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ...contact.problem import ContactProblem, Physics, Preparing
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.units import show
from .flow import WAYS, drives
from .fluids import IdealGas, ViscousLiquid
from .law import FluidPressure

if TYPE_CHECKING:
    from ...contact.couplings.protocol import Coupling
    from ...contact.operators import Operator
    from ...contact.result import ContactResult


@dataclass(frozen=True)
class Pressed(Physics):
    """A fluid that presses on both bodies."""

    fluid_pressure: FluidPressure
    keyword: ClassVar[str] = "fluid_pressure"
    takes: ClassVar[Any] = FluidPressure
    types: ClassVar[tuple[type, ...]] = (FluidPressure, ViscousLiquid, IdealGas)
    moving: ClassVar[str] = "a fluid between moving surfaces would be dragged along"
    supplies: ClassVar[tuple[str, ...]] = ("fluid_work",)

    def check(self, problem: ContactProblem) -> None:
        """An axis without points has no flow, and what does not repeat no mean gradient."""
        given, axis = self.fluid_pressure, WAYS.index(self.fluid_pressure.way)
        if problem.grid.shape[axis] < 2:
            raise InputError(
                f"direction of flow must be along an axis with points, but there is one along {given.way}; take the "
                "other."
            )
        drives(given.driven, given.way, problem.boundary.wraps)

    def check_relaxing(self, problem: ContactProblem) -> None:
        """Creep under a fluid is not known."""
        raise InputError(
            "fluid pressure on viscoelastic bodies must be left out, but is given: bodies that relax under a fluid are "
            "not solved. Take elastic ones, or the leakage of the contact without it ({sealing.two_way=false})."
        )

    def couplings(self, problem: ContactProblem, operator: Operator, how: Preparing) -> Iterator[Coupling]:
        """The pressure of the fluid."""
        from .coupling import TOLERANCE, FluidCoupling

        yield FluidCoupling(self.fluid_pressure, operator, how.tolerances.get("fluid", TOLERANCE))

    def rows(self) -> list[tuple[str, str]]:
        """Pressures of the fluid."""
        given = self.fluid_pressure
        return [("fluid on both bodies", f"{show(given.inlet, 'Pa')} to {show(given.outlet, 'Pa')} along {given.way}")]

    def works(self, steps: Sequence[ContactResult]) -> Mapping[str, RealArray]:
        """What the fluid does in each step: its pressure over the opening of the gap, and that on
        the back over the approach; by the trapezoidal rule."""
        found, before = np.zeros(len(steps)), None
        area = steps[0].problem.grid.area
        for number, step in enumerate(steps):
            pressure, gap = step.require("fluid").pressure, step.gap
            if before is not None:
                opened = 0.5 * float(((before[0] + pressure) * (gap - before[1])).mean())
                found[number] = area * (opened + self.fluid_pressure.back * (step.approach - before[2]))
            before = pressure, gap, step.approach
        return {"fluid_work": found}
