"""The pressure of a fluid in the gap as a coupling: it bears a part of the load and displaces both
surfaces, and flows through the gap that they leave.

The unknown is the pressure at every cell (``acting_pressure``). With it the contact problem is one
of the contact pressure above that of the fluid: under an even pressure of the fluid it is the dry
contact under the load that is left.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from ...contact.answer import Answer
from ...contact.certificate import Certificate
from ...contact.couplings.protocol import Contact, Coupling, Exchange, Memory, Posed, Share
from ...contact.operators import Operator
from ...core.arrays import RealArray
from ...core.errors import NoSolutionError
from ...core.late import Shown
from ...core.quantity import Quantity, given, measured, measured_as
from ...core.status import Advice, Outcome, Status
from ...core.units import percent, show
from .acting import acting_pressure
from .flow import UNEVEN, WAYS, GapFlow, drives, gap_flow
from .fluids import IdealGas
from .law import FluidPressure

TOLERANCE = 1e-6
"""Rms change of the pressure of the fluid from round to round over the rms traction."""

_ACCURACY = 1e-4
_FIRST = 0.5
"""Share of the load that the fluid bears at most in the first round, so that the surfaces touch."""

_LIFTS, _FOUND = 5, 1e-2
"""Rounds in a row in which the fluid bears all of the load, and the residual in one, from which it
lifts the bodies off: a single round may have led too far."""

LIFTED = 0.9
"""Share of the load borne by the fluid from which the contact is near to lifting off."""

_CHECKED = 10.0
"""Tolerances within which the pressure of the fluid agrees that is computed again at the end."""

TABLE = (
    Quantity("external_force", "N", "external force"),
    Quantity("solid_force", "N", "force between the touching surfaces"),
    Quantity("borne_by_fluid", "N", "force of the fluid between the surfaces that do not touch"),
    Quantity("uplift", "N", "force by which the fluid relieves the contact"),
    Quantity("mean_fluid_pressure", "Pa", "mean pressure of the fluid in the gap"),
)
"""Numbers of the fluid, in the order of tables."""

_EXTERNAL, _SOLID, _FLUID, _UPLIFT, _MEAN = TABLE


@dataclass(frozen=True, eq=False, repr=False)
class FluidContact(Answer, Shown):
    """What the pressure of a fluid does in a contact, all values SI.

    The ``pressure`` of the result is that of the contact above the fluid's, at least zero; the
    traction of touching surfaces is the sum of both.

    Attributes
    ----------
    fluid_pressure
        Fluid and pressures.
    pressure
        (nx, ny) in Pa of the fluid on both bodies; where they touch what it would have there.
    external_force
        Load on the back in N, without the pressure of a fluid on it.
    solid_force, borne_by_fluid
        Forces in N of the touching surfaces and of the fluid between the others; they add up to
        the load with what presses on the back.
    uplift
        Pressure of the fluid over the nominal area less that on the back, N.
    mean_fluid_pressure
        Mean of the pressure in the gap, Pa.
    residual
        Change of the pressure by one more solution of the flow, rms over that of the traction.
    tolerance
        Residual at which it is settled.
    section_error
        Difference between the flows through cross-sections, over the flow.
    """

    fluid_pressure: FluidPressure = given("fluid_pressure")
    pressure: RealArray = measured("Pa", "pressure of the fluid on both bodies", "x", "y")
    external_force: float = measured_as(_EXTERNAL)
    solid_force: float = measured_as(_SOLID)
    borne_by_fluid: float = measured_as(_FLUID)
    uplift: float = measured_as(_UPLIFT)
    mean_fluid_pressure: float = measured_as(_MEAN)
    residual: float = measured("1", "change of the pressure of the fluid / traction")
    tolerance: float = measured("1", "change at which it is settled")
    section_error: float = measured("1", "difference between the flows through cross-sections / flow")
    quantities: ClassVar[tuple[Quantity, ...]] = TABLE

    @property
    def share(self) -> float:
        """Force of the fluid over that of fluid and touching surfaces."""
        whole = self.borne_by_fluid + self.solid_force
        return self.borne_by_fluid / whole if whole else math.nan

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers the numbers rest on."""
        return self.fluid_pressure.citation_keys

    def line(self) -> str:
        """What fluid and surfaces bear."""
        solid, fluid = show(self.solid_force, "N"), show(self.borne_by_fluid, "N")
        return f"FluidContact: the surfaces bear {solid} and the fluid {fluid} ({percent(self.share)})"

    def traction_beside(self) -> RealArray:
        """The pressure of the fluid, which pushes."""
        return -self.pressure

    def pulls(self) -> float:
        """The uplift, which pushes."""
        return -self.uplift

    def outside(self, force: float, *, alone: bool) -> float:
        """The load, which is known to the last digit."""
        return self.external_force if alone else super().outside(force, alone=alone)

    def remembered(self, approach: float) -> Memory:
        """The pressure."""
        return {"pressure": self.pressure}

    def ended(self) -> Status | None:
        """Whether the flow through the gap that is left makes this pressure."""
        if self.residual <= _CHECKED * self.tolerance and self.section_error <= UNEVEN:
            return None
        message = (
            f"Not converged: the flow through the gap of the solution changes the pressure of the fluid by "
            f"{self.residual:.1e} of the traction, and the flows through its cross-sections differ by "
            f"{self.section_error:.1e}."
        )
        return Status(Outcome.STAGNATED, message, _REMEDY)

    def findings(self, certificate: Certificate) -> Iterator[Advice]:
        """A contact that is near to lifting off."""
        if self.share > LIFTED:
            fact = (
                f"The fluid bears {percent(self.share)} of the force: the contact is near to lifting off, where small "
                "changes of pressures and load change contact and leak by much."
            )
            yield Advice("warning", "contact near lifting off", fact, "", {"share": self.share, "largest": LIFTED})


_REMEDY = "Raise the load, lower the pressures of the fluid, take a finer grid ({resample}), or allow more rounds."


@dataclass(frozen=True)
class FluidCoupling(Coupling):
    """Pressure of the fluid that is ``given`` on the bodies of ``operator``; the unknown is that
    pressure at every cell."""

    given: FluidPressure
    operator: Operator
    tolerance: float = TOLERANCE
    name: ClassVar[str] = "fluid"
    feedback: ClassVar[bool] = True
    remedy: ClassVar[str] = _REMEDY
    settled_text: ClassVar[str] = "The pressure of the fluid is steady"
    unsettled_text: ClassVar[str] = "The pressure of the fluid still changes by {change:.1e} of the traction"

    def begin(self, posed: Posed, memory: Memory) -> Exchange:
        """The pressure remembered; of a first load the even fall, and not more than half of the
        load."""
        x = np.array(memory["pressure"], dtype=float) if memory else self._even_fall()
        load = self._load(posed)
        if load is not None and not memory and (mean := float(x.mean())) > _FIRST * load > 0.0:
            x *= _FIRST * load / mean
        scale = max(abs(self.given.inlet), abs(self.given.outlet))
        return Exchange(x, x, np.inf, self.tolerance, scale=scale, accuracy=_ACCURACY, note=0)

    def share(self, exchange: Exchange) -> Share:
        """The pressure as a load that is taken from the contact, and as displacement."""
        relieved = (float(exchange.x.mean()) - self.given.back) * self.operator.grid.area
        return Share(load=-relieved, lift=self.operator.apply(exchange.x), attraction=-exchange.x)

    def reply(self, exchange: Exchange, contact: Contact) -> Exchange:
        """The pressure of the flow through the gap of ``contact``.

        Raises
        ------
        NoSolutionError
            If the fluid bears all of the load as the surfaces just touch.
        """
        target, _ = self._flowing(contact, exchange.x)
        load, residual = self._load(contact.posed), _change(target, exchange.x, contact)
        borne = load is not None and not contact.touching.any() and float(target.mean()) >= load
        rounds = exchange.note + 1 if borne else 0
        if load is not None and borne and (rounds >= _LIFTS or residual <= _FOUND):
            raise self._lifted(load, float(target.mean()))
        return replace(exchange, target=target, residual=residual, note=rounds)

    def apart(self, exchange: Exchange, contact: Contact) -> Exchange:
        """The fluid presses on surfaces that do not touch, too."""
        return self.reply(exchange, contact)

    def end(self, exchange: Exchange, contact: Contact) -> tuple[Memory, FluidContact]:
        """The pressure, and what it does; the flow is solved again through the gap of
        ``contact``."""
        x, cell = exchange.x, self.operator.grid.pixel_area
        target, flow = self._flowing(contact, exchange.x)
        touching = contact.touching
        fluid = float(x[~touching].sum()) * cell
        solid = float((contact.pressure + x)[touching].sum()) * cell
        back = self.given.back * self.operator.grid.area
        external = contact.posed.external_force
        found = FluidContact(
            fluid_pressure=self.given,
            pressure=x,
            external_force=fluid + solid - back if external is None else external,
            solid_force=solid,
            borne_by_fluid=fluid,
            uplift=float(x.sum()) * cell - back,
            mean_fluid_pressure=float(x[~touching].mean()) if not touching.all() else math.nan,
            residual=_change(target, x, contact),
            tolerance=self.tolerance,
            section_error=flow.section_error,
        )
        return {"pressure": x}, found

    def _flowing(self, contact: Contact, before: RealArray) -> tuple[RealArray, GapFlow]:
        """Pressure (nx, ny) in Pa of the fluid through the gap of ``contact`` after that
        ``before``, and its flow."""
        given, operator = self.given, self.operator
        gap = np.asarray(contact.gap, dtype=float)
        flow = gap_flow(gap, contact.touching, operator.grid, operator.boundary.wraps, given.way, given.driven)
        leak = given.fluid.leak(flow, given.inlet, given.outlet)
        return acting_pressure(flow, leak, given, before), flow

    def _load(self, posed: Posed) -> float | None:
        """Mean pressure (Pa) on the back; None where the position is prescribed."""
        external = posed.external_force
        return None if external is None else external / self.operator.grid.area + self.given.back

    def _even_fall(self) -> RealArray:
        """Pressure (nx, ny) in Pa of the fluid in an even gap."""
        given, shape = self.given, self.operator.grid.shape
        if drives(given.driven, given.way, self.operator.boundary.wraps):
            return np.full(shape, 0.5 * (given.inlet + given.outlet))
        axis = WAYS.index(given.way)
        count, power = shape[axis], 2.0 if isinstance(given.fluid, IdealGas) else 1.0
        share = (np.arange(count) + 0.5) / count
        fall = ((1.0 - share) * given.inlet**power + share * given.outlet**power) ** (1.0 / power)
        return np.ascontiguousarray(np.broadcast_to(fall[:, None] if axis == 0 else fall[None], shape))

    def _lifted(self, load: float, mean: float) -> NoSolutionError:
        return NoSolutionError(
            f"fluid pressure must be below the mean pressure on the back, {show(load, 'Pa')}, when the bodies just "
            f"touch, but is {show(mean, 'Pa')} on average: the fluid lifts them off, and a film without contact is not "
            "solved. Raise the load, lower the pressure at the inlet ({sealing.inlet}), or give that of the fluid on "
            "the back ({sealing.back}).",
            subject="fluid pressure",
        )


def _change(target: RealArray, x: RealArray, contact: Contact) -> float:
    """Rms difference of two pressures of the fluid over the rms traction."""
    whole = float(np.sqrt(np.mean((contact.pressure + x) ** 2)))
    return float(np.sqrt(np.mean((target - x) ** 2))) / (whole or 1.0)
