"""Sealing: what leaks through the gap of the contact, and where it is decided."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Choice, NonNegativeLength, Number, StepOfPath, Viscosity
from ...parts.part import Part

KNOWN = ("water", "liquid", "air", "nitrogen", "helium", "hydrogen", "argon", "gas")
"""Fluids by their names; a liquid and a gas are those of a given viscosity."""

Named = Annotated[str, Choice({name: name for name in KNOWN})]
Way = Annotated[str, Choice({name: name for name in ("x", "y")})]
Driven = Annotated[str, Choice({name: name for name in ("auto", "sides", "gradient")})]
Inlet = Annotated[float, Number("pressure", above=0.0)]
Outlet = Annotated[float, Number("pressure", least=0.0)]
VolumeRate = Annotated[float, Number("m**3/s", above=0.0)]
Throughput = Annotated[float, Number("Pa*m**3/s", above=0.0)]


class SealingSettings(Settings):
    """What leaks through the gap of the contact between two pressures, along x or y.

    A liquid is incompressible, a gas ideal and at one temperature, with absolute pressures and slip
    at the walls. The pressure falls over the length of the surface, between two ``sides`` or as the
    mean ``gradient`` of a contact that repeats. The gap is that of the contact alone, or of contact
    and flow together (``two_way``): the load is then the force on the back, which touching surfaces
    and fluid bear, with the pressure of a fluid on the ``back`` beside it.
    """

    fluid: Named = setting(
        "water", option="--leak-fluid", help="water, liquid, air, nitrogen, helium, hydrogen, argon, gas"
    )
    viscosity: Viscosity | None = setting(
        None, option="--leak-viscosity", help="Of the fluid; needed for liquid and gas: 1mPa*s"
    )
    mean_free_path: NonNegativeLength | None = setting(
        None, option="--gas-mean-free-path", help="Of a gas at one atmosphere, for its slip: 65nm; 0nm for none"
    )
    inlet: Inlet = setting("200 kPa", option="--inlet-pressure", help="Of the fluid where it enters")
    outlet: Outlet = setting("100 kPa", option="--outlet-pressure", help="Of the fluid where it leaves")
    two_way: bool = setting(
        False, option="--fluid-pressure", help="Whether the pressure of the fluid acts on both bodies"
    )
    back: Inlet | None = setting(
        None, option="--back-pressure", help="Of the fluid on the back of the bodies, beside the load; none by default"
    )
    direction: Way = setting("x", option="--leak-direction", help="Where the fluid flows to: x or y")
    driven: Driven = setting(
        "auto", option="--leak-driven", help="By pressures at two sides, or by a mean gradient: sides, gradient or auto"
    )
    step: StepOfPath = setting(
        "last",
        option="--leak-step",
        help="Of a load path: peak for that of the largest load, last, or its number from 1",
    )
    closing: bool = setting(
        False, option="--closing-load", help="Find the mean pressure at which the gap closes, by some ten solves"
    )
    allowed_rate: VolumeRate | None = setting(
        None, option="--allowed-leak-rate", help="Of a liquid, to compare with: 1mm^3/s"
    )
    allowed_throughput: Throughput | None = setting(
        None, option="--allowed-throughput", help="Of a gas, to compare with: 1e-6mbar*l/s"
    )

    @model_validator(mode="after")
    def _whole(self) -> SealingSettings:
        if self.inlet <= self.outlet:
            raise InputError(
                f".inlet must be above the pressure at the outlet, {self.outlet:g} Pa, but is {self.inlet:g} Pa."
            )
        if self.back is not None and not self.two_way:
            raise InputError(
                f".back must be left out where the fluid does not press on the bodies, but is {self.back:g} Pa; let it "
                "({sealing.two_way=true})."
            )
        if self.fluid in ("liquid", "gas") and self.viscosity is None:
            like, known = ("18uPa*s", "air") if self.fluid == "gas" else ("1mPa*s", "water")
            raise InputError(
                f".viscosity must be given for a {self.fluid} ({{sealing.viscosity={like}}}), but is not; or name a "
                f"fluid that is known ({{sealing.fluid={known}}})."
            )
        if self.fluid == "gas" and self.mean_free_path is None:
            raise InputError(
                ".mean_free_path must be given for a gas ({sealing.mean_free_path=65nm}), but is not; 0nm is a gas "
                "without slip."
            )
        gas = self.fluid not in ("water", "liquid")
        for key, wrong in (("mean_free_path", not gas), ("allowed_throughput", not gas), ("allowed_rate", gas)):
            if wrong and getattr(self, key) is not None:
                kind = "a gas" if gas else "a liquid"
                raise InputError(f".{key} must be left out for {kind}, but is given with {self.fluid}.")
        return self


_GRID = ("x", "y")
SCALARS = (
    Quantity("leak_rate", "m**3/s", "leak rate, of a gas at one atmosphere"),
    Quantity("leak_throughput", "Pa*m**3/s", "leak rate of a gas, pressure times volume"),
    Quantity("leak_lower_factor", "1", "lower bound of the leak rate by the pixels / leak rate"),
    Quantity("leak_upper_factor", "1", "upper bound of the leak rate by the pixels / leak rate"),
    Quantity("transmissivity", "m**3", "transmissivity of the gap, 12 η Q L / (W ΔP)"),
    Quantity("equivalent_gap", "m", "even gap that lets as much through"),
    Quantity("critical_gap", "m", "gap of the constriction that decides"),
    Quantity("leak_throat_pixels", "1", "pixels across the narrowest throat"),
    Quantity("leak_throats", "1", "number of throats that carry half of the dissipation"),
    Quantity("leak_refinement", "1", "refinement of the grid that the throats need"),
    Quantity("leak_knudsen", "1", "Knudsen number in the throats"),
    Quantity("leak_slip_factor", "1", "leak rate / that without slip"),
    Quantity("leak_section_error", "1", "difference between the flows through cross-sections / flow"),
    Quantity("fluid_force", "N", "force of the fluid on the bodies"),
    Quantity("transmissivity_lower", "m**3", "transmissivity of layers across the flow"),
    Quantity("transmissivity_upper", "m**3", "transmissivity of layers along the flow"),
    Quantity("transmissivity_medium", "m**3", "transmissivity by Bruggeman's effective medium"),
    Quantity("transmissivity_junction", "m**3", "transmissivity by the critical junction"),
    Quantity("sealing_pressure", "Pa", "mean contact pressure at which the gap closes"),
)
"""Numbers of a leak; NaN where there is no such thing."""

FIELDS = (
    Quantity("fluid_pressure", "Pa", "pressure of the fluid", _GRID),
    Quantity("leak_gap", "m", "gap that leaks", _GRID),
    *(Quantity(f"leak_flux_{a}", "1", f"flow per width along {a} / mean flow per width", _GRID) for a in "xy"),
    Quantity("leak_dissipation", "1", "dissipation of the flow / its mean", _GRID),
)
"""Fields of a leak."""

OF_THROATS = (
    Quantity("throat_x", "m", "x of the throat", ("throat",)),
    Quantity("throat_y", "m", "y of the throat", ("throat",)),
    Quantity("throat_share", "1", "share of the dissipation in the throat", ("throat",)),
    Quantity("throat_pixels", "1", "pixels across the throat", ("throat",)),
    Quantity("throat_gap", "m", "largest gap in the throat", ("throat",)),
    Quantity("throat_carried", "1", "flow through the throat / all flow", ("throat",)),
)
PATH = (
    Quantity("path_leak_load", "Pa", "mean contact pressure at each step", ("step",)),
    Quantity("path_leak_rate", "m**3/s", "leak rate at each step", ("step",)),
    Quantity("path_transmissivity", "m**3", "transmissivity at each step", ("step",)),
)
CLOSED = (
    Quantity("closed_path_x", "m", "x of the path of contact that closes the gap", ("closed_path",)),
    Quantity("closed_path_y", "m", "y of the path of contact that closes the gap", ("closed_path",)),
)


class Sealing(Part):
    """What leaks through the gap of the contact."""

    name = "sealing"
    title = "Sealing"
    purpose = "How much fluid leaks through the gap between two pressures, and where it passes."
    table = "sealing"
    settings = SealingSettings
    basic = ("fluid", "inlet", "outlet")
    quantities = (*SCALARS, *FIELDS, *OF_THROATS, *PATH, *CLOSED)
    work = "physics.sealing.work:SealingWork"
    headline = "leak_rate"
    whole_path = True

    def coupling(self, ask: SealingSettings) -> Mapping[str, Any]:
        """The pressure of the fluid joins the solve, where it is asked for."""
        made: Any = self.at_work
        return made.joined(ask) if ask.two_way else {}
