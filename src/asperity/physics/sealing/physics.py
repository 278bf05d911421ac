"""A fluid that flows through the gap and presses on both bodies, as a physics of a problem."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ...contact.problem import ContactProblem, Physics, Preparing
from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.units import show
from .flow import WAYS, Way
from .fluids import IdealGas, ViscousLiquid
from .leak import DRIVEN, Driven, Fluid, drives

if TYPE_CHECKING:
    from ...contact.couplings.protocol import Coupling
    from ...contact.operators import Operator
    from ...contact.result import ContactResult


@dataclass(frozen=True)
class FluidPressure:
    """A fluid that flows through the gap between two pressures, and whose pressure acts on both
    bodies.

    The load is the force on the back of the bodies: it is borne by the touching surfaces and the
    fluid between the others. Pressures are those of ``leakage``. Closed pools hold the pressure of
    the fluid around them.

    Parameters
    ----------
    fluid
        ``ViscousLiquid(viscosity)`` or ``IdealGas(viscosity, mean_free_path)``.
    inlet, outlet
        Pressures in Pa where the fluid enters and leaves.
    way
        ``"x"`` or ``"y"``, along which the pressure falls over the length of the grid.
    driven
        ``"sides"``, ``"gradient"`` or ``"auto"``, as of ``leakage``. Under a mean gradient the
        bodies bear the mean of inlet and outlet and what the flow changes in it, not the part that
        falls steadily, which would not repeat with them. Between two sides of a surface that
        repeats, so do the sides.
    back
        Pressure in Pa of a fluid on the back of the bodies, beside the load: the outlet's, where
        they stand in it.

    Raises
    ------
    InputError
        If the inlet is not above the outlet, or another value is out of range.
    """

    fluid: Fluid
    inlet: float
    outlet: float = 0.0
    way: Way = "x"
    driven: Driven = "auto"
    back: float = 0.0

    def __post_init__(self) -> None:
        require.one_of(self.way, WAYS, "direction of flow")
        require.one_of(self.driven, DRIVEN, "way of driving the flow")
        if not isinstance(self.fluid, Fluid):
            raise InputError(
                f"fluid that presses must be a ViscousLiquid or IdealGas, but is {type(self.fluid).__name__}."
            )
        require.finite(self.back, "pressure on the back (Pa)")
        require.finite(self.outlet, "pressure at the outlet (Pa)")
        if not require.finite(self.inlet, "pressure at the inlet (Pa)") > self.outlet:
            raise InputError(
                f"pressure at the inlet must be above that at the outlet, {self.outlet:g} Pa, but is {self.inlet:g} Pa."
            )
        if isinstance(self.fluid, IdealGas) and self.outlet < 0.0:
            raise InputError(f"pressure of a gas must be at least zero, but is {self.outlet:g} Pa.")

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers behind it."""
        return (*self.fluid.citation_keys, "Dapp2012")


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
