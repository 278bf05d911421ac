"""Leakage of a solved contact: the flow of a fluid through its gap, where that is decided, and how
far the number can be trusted."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ...contact.result import ContactResult
from ...core import require
from ...core.arrays import RealArray
from ...core.status import Advice
from ...core.units import percent
from ...theories.sealing.gaps import SLIP, Bounds
from .estimates import Estimates, estimates_of
from .flow import DRIVEN, UNEVEN, WAYS, Driven, GapFlow, Way, gap_flow
from .fluids import Fluid, Leak, with_dead_ends
from .throats import RESOLVED, Throats, throats, through_corners, through_noise

ONE_WAY = 0.05
"""Force of the fluid over the contact force up to which it does not change the contact by much."""


@dataclass(frozen=True, eq=False)
class Leakage:
    """What leaks through the gap of a contact.

    Attributes
    ----------
    result
        The contact, whose gap the fluid does not change unless it was solved with it
        (``FluidPressure``).
    fluid
        ViscousLiquid or gas.
    inlet, outlet
        Pressures in Pa; absolute ones of a gas.
    flow
        The flow for 12 η = 1 and one unit of pressure.
    leak
        Rate and pressure of this fluid.
    """

    result: ContactResult
    fluid: Fluid
    inlet: float
    outlet: float
    flow: GapFlow
    leak: Leak

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers behind the numbers."""
        return (*self.fluid.citation_keys, "Dapp2012", "PerssonYang2008")

    @property
    def sealed(self) -> bool:
        """Whether a path of contact closes the gap."""
        return self.flow.sealed

    @property
    def rate(self) -> float:
        """Leak rate: m³/s of a liquid, Pa m³/s of a gas."""
        return self.leak.rate

    @cached_property
    def throats(self) -> Throats:
        """Where half of the pressure is lost."""
        return throats(self.flow)

    @cached_property
    def bracket(self) -> Bounds:
        """Bounds of the rate by how the gap goes on between the pixels."""
        if self.sealed:
            return Bounds(0.0, 0.0)
        found, factor = self.throats.bracket, self.rate / self.flow.rate
        return Bounds(found.lower * factor, found.upper * factor)

    @cached_property
    def estimates(self) -> Estimates:
        """Transmissivities by simpler means."""
        return estimates_of(self.flow)

    @property
    def resolved(self) -> bool:
        """Whether throats are wide enough, and neither a corner nor noise decides."""
        return not self.at_corner and not self.in_noise and self.throats.resolved

    @cached_property
    def at_corner(self) -> bool:
        """Whether what seals are spots that meet at a corner of pixels only."""
        return through_corners(self.flow)

    @cached_property
    def in_noise(self) -> bool:
        """Whether all that flows passes a gap that is noise of the contact solver."""
        return through_noise(self.flow)

    @cached_property
    def fluid_pressure(self) -> RealArray:
        """(nx, ny) pressure of the fluid in Pa wherever it gets: in dead ends that of the side they
        open to, in closed pools and in contact zero."""
        return with_dead_ends(self.flow, self.leak, self.inlet, self.outlet)[1]

    @property
    def pressed(self) -> Any:
        """What the pressure of this fluid does in the contact, where that was solved with it; None
        where not."""
        found = self.result.couplings.get("fluid")
        same = found is not None and found.fluid_pressure
        own = self.fluid, self.inlet, self.outlet, self.flow.way
        return found if same and (same.fluid, same.inlet, same.outlet, same.way) == own else None

    @property
    def fluid_force(self) -> float:
        """Force of the fluid on either body in N; where it acts on them, with that of pools."""
        if self.pressed is not None:
            return float(self.pressed.borne_by_fluid)
        return float(self.fluid_pressure.sum() * self.flow.grid.pixel_area)

    @property
    def findings(self) -> tuple[Advice, ...]:
        """What to know before using the rate."""
        return found_of(self)


def leakage(
    result: ContactResult,
    fluid: Fluid,
    inlet: float,
    outlet: float = 0.0,
    *,
    way: Way = "x",
    driven: Driven = "auto",
) -> Leakage:
    """What leaks through the gap of a solved contact.

    Parameters
    ----------
    result
        The contact.
    fluid
        ``ViscousLiquid(viscosity)`` or ``IdealGas(viscosity, mean_free_path)``.
    inlet, outlet
        Pressures in Pa at the side where the fluid enters and where it leaves; absolute ones of a
        gas.
    way
        ``"x"`` or ``"y"``, along which the pressure falls over the length of the grid.
    driven
        ``"sides"`` for pressures at two sides, ``"gradient"`` for a mean gradient on a contact that
        repeats, which ``"auto"`` takes where it can.

    Raises
    ------
    InputError
        If a pressure, the direction or the way of driving does not fit.
    ConvergenceError
        If the pressure of a gas that slips is not found.
    """
    require.one_of(driven, DRIVEN, "way of driving the flow")
    require.one_of(way, WAYS, "direction of flow")
    problem = result.problem
    flow = gap_flow(result.gap, result.contact, problem.grid, problem.boundary.wraps, way, driven)
    return Leakage(result, fluid, inlet, outlet, flow, fluid.leak(flow, inlet, outlet))


RATES = ("leak_rate", "leak_throughput")
CONCERNS = (*RATES, "transmissivity", "equivalent_gap")
"""Quantities that findings doubt."""


def found_of(leak: Leakage) -> tuple[Advice, ...]:
    """Findings on a leakage."""
    return (*_resolution(leak), *_regime(leak))


def _resolution(leak: Leakage) -> list[Advice]:
    """Whether the pixels decide."""
    made: list[Advice] = []
    if leak.at_corner:
        fact = (
            "Sealed or not is not resolved: spots of contact that meet only at a corner of pixels close the gap, "
            "and nothing is taken to pass between them."
        )
        made.append(Advice("warning", "sealed at a corner", fact, "Take a finer grid ({resample}).", {}, CONCERNS))
    if leak.in_noise:
        fact = (
            "Sealed or not is not resolved: all that flows passes gaps below a thousandth of the rms gap, which "
            "are errors of the contact solution."
        )
        made.append(Advice("warning", "gap of the leak", fact, "Take a finer grid ({resample}).", {}, CONCERNS))
    found = leak.throats
    if not leak.sealed and not found.resolved:
        below = leak.bracket.lower / leak.rate, leak.bracket.upper / leak.rate
        fact = (
            f"The leak rate is not resolved: the narrowest throat is {found.pixels:.2g} pixels wide where {RESOLVED} "
            f"are needed, and such throats lose {percent(found.narrow)} of the pressure. With the saddle of the gap "
            f"in them the rate is from {below[0]:.2g} to {below[1]:.2g} times as large."
        )
        numbers = {
            "pixels": found.pixels,
            "least": float(RESOLVED),
            "refinement": float(found.refinement),
            "lower": below[0],
            "upper": below[1],
        }
        remedy = f"Take a grid that is {found.refinement} times finer ({{resample}})."
        made.append(Advice("warning", "pixels across the throats", fact, remedy, numbers, CONCERNS))
    if leak.flow.section_error > UNEVEN:
        fact = (
            f"The flow is not solved: the flow through cross-sections differs by {leak.flow.section_error:.1e} of it."
        )
        numbers = {"difference": leak.flow.section_error, "largest": UNEVEN}
        made.append(Advice("warning", "flow through cross-sections", fact, "", numbers, CONCERNS))
    return made


def _regime(leak: Leakage) -> list[Advice]:
    """Whether the model holds."""
    made: list[Advice] = []
    if leak.leak.knudsen > SLIP:
        fact = (
            f"The Knudsen number in the throats is {leak.leak.knudsen:.2g}: slip of first order holds to {SLIP:g}, and "
            "a rarer gas flows as its molecules do."
        )
        numbers = {"knudsen": leak.leak.knudsen, "largest": SLIP}
        made.append(Advice("warning", "rarefied gas", fact, "", numbers, RATES))
    load, force = leak.result.force, leak.fluid_force
    if leak.pressed is None and load > 0.0 and force > ONE_WAY * load:
        fact = (
            f"The force of the fluid is {percent(force / load)} of that of the contact: it lifts the bodies, which is "
            "not taken into account, and more leaks."
        )
        numbers = {"force": force, "load": load, "share": ONE_WAY}
        remedy = "Solve contact and flow together ({sealing.two_way=true})."
        made.append(Advice("warning", "pressure of the fluid", fact, remedy, numbers, CONCERNS))
    return made
