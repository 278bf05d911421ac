"""What a physics of the interface changes in the normal contact, and how it follows from it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, NamedTuple, Protocol, TypeAlias, runtime_checkable

import numpy as np

from ...core.arrays import BoolArray, RealArray
from ...core.engine import Totals
from ...core.errors import NoSolutionError
from ...core.grid import Grid
from ...core.status import Progress, Status
from ...solids.compliance.halfspace import Compliance
from ..boundary import Boundary
from ..controls import Approach, Control, FixedGrips, Force, MeanGap, MeanPressure, Pull, Unloaded, mean_pressure
from ..operators.convolution import Operator
from ..solvers.protocol import Constraint, ContactQP, Solution, Solver, level_of
from ..tangential import Tangential

Memory: TypeAlias = Mapping[str, RealArray]
"""Memory of a coupling from one step to the next, by name; numbers are 0-d arrays."""


@dataclass(frozen=True, eq=False)
class Deflections:
    """Displacements (m) by pressures (Pa), both (nx, ny), as a solver left them: what the next one
    need not compute again.

    They hold for the very arrays of pressure in ``pairs``, and for operators of the same
    ``compliance``, ``boundary`` and ``grid``; the operator itself, whose buffers take as much
    memory as some steps, is not held. ``within`` a step, whose contacts no file comes between, one
    alone is taken, too; between steps a history that goes on from a file must give the same bits.
    """

    compliance: Compliance
    boundary: Boundary
    grid: Grid
    pairs: tuple[tuple[RealArray, RealArray], ...]
    within: bool = False

    def by(self, pressure: RealArray, operator: Operator) -> RealArray | None:
        """Displacement by ``pressure`` under ``operator``; None if it is not known."""
        own = self.compliance, self.boundary, self.grid
        if own != (operator.compliance, operator.boundary, operator.grid):
            return None
        return next((found for known, found in self.pairs if known is pressure), None)

    def __reduce__(self) -> tuple[type[None], tuple[()]]:
        """Copies and pickles are None: their arrays would be others, and the machine of the
        operator cannot go with them."""
        return type(None), ()


@dataclass(frozen=True, eq=False)
class Posed:
    """What stays the same through the rounds of one step.

    Attributes
    ----------
    operator
        Pressure (Pa) to displacement (m).
    profile
        Composite heights (nx, ny) in m of the virgin surfaces.
    dented
        The same less the permanent indentation and the retarded displacement before this step.
    control
        What is prescribed.
    height_scale
        Length in m by which errors are made relative.
    start
        Pressure (nx, ny) in Pa to start from; None where nothing is known.
    earlier
        That of the load before ``start`` on the same leg, beyond which both are extrapolated; None
        where there is none.
    tangential
        What is prescribed along the surfaces; None where that is as in the step before.
    deflections
        Displacements by ``start`` and by ``earlier``, where they are at hand.
    retarded
        Displacement (nx, ny) in m at the end of the step that earlier pressures leave in
        viscoelastic bodies; zero in elastic ones.
    ahead
        Length of this step of time over the one before, in which pressures are extrapolated to
        start from; None where it is not known.
    held
        Whether an approach is held by its offset, where the pressure is bounded; else the load that
        reaches it may be one more unknown.
    """

    operator: Operator
    profile: RealArray
    dented: RealArray
    control: Control
    height_scale: float
    start: RealArray | None = None
    earlier: RealArray | None = None
    tangential: Tangential | None = None
    retarded: RealArray | float = 0.0
    deflections: Deflections | None = None
    ahead: float | None = None
    held: bool = False

    @cached_property
    def top(self) -> float:
        """Highest point (m) of the virgin profile, from which the approach counts."""
        return float(self.operator.engine.resident(self.profile).max())

    @property
    def external_force(self) -> float | None:
        """Prescribed external force in N, zero if unloaded, negative if it pulls; None where the
        position is prescribed."""
        if isinstance(self.control, Pull):
            return -self.control.value
        if isinstance(self.control, Unloaded):
            return 0.0
        if isinstance(self.control, MeanPressure | Force):
            return mean_pressure(self.control, self.operator.grid) * self.operator.grid.area
        return None


def height_scale(virgin: RealArray, control: Control, operator: Operator) -> float:
    """Rms height (m); for flat bodies the length by which they deform, for there is no other."""
    rms = float(virgin.std())
    if rms > 0.0:
        return rms
    if isinstance(control, Approach | MeanGap):
        return control.value
    if isinstance(control, Unloaded | Pull | FixedGrips):
        return 1.0
    uniform = np.full(virgin.shape, mean_pressure(control, operator.grid))
    return float(np.abs(operator.apply(uniform)).max()) or 1.0


@dataclass(frozen=True, eq=False)
class Contact:
    """Normal contact of one round, solved.

    ``indentation`` (nx, ny) in m and ``attraction`` (nx, ny) in Pa are the sums of what its
    ``Share``s give.
    """

    posed: Posed
    qp: ContactQP
    solution: Solution
    indentation: RealArray | float = 0.0
    attraction: RealArray | float = 0.0

    @cached_property
    def cap(self) -> float | RealArray:
        """Largest pressure (Pa) at the indentation reached: where that was posed, the pressure
        found."""
        if not isinstance(self.indentation, np.ndarray):
            return self.qp.cap
        yields = (self.indentation > 0.0) & self.touching
        return np.where(yields, self.pressure, self.qp.cap) if yields.any() else self.qp.cap

    @property
    def pressure(self) -> RealArray:
        """Pressure (nx, ny) in Pa."""
        return self.solution.state.pressure

    @property
    def traction(self) -> RealArray:
        """Pressure less attraction (nx, ny) in Pa."""
        return self.pressure - self.attraction if isinstance(self.attraction, np.ndarray) else self.pressure

    @cached_property
    def totals(self) -> Totals:
        """Sums over pressure, deflection and profile."""
        return self.qp.survey(self.solution.state).totals

    @cached_property
    def level(self) -> float:
        """Level (m) of the contacting plane, see ``solvers.protocol.level``."""
        return level_of(self.qp, self.totals)

    @cached_property
    def overlap(self) -> RealArray:
        """Overlap (nx, ny) in m of the deformed bodies without the indentation of this step,
        negative where they are apart."""
        return self.level - (self.solution.state.deflection - self.qp.profile) + self.indentation

    @property
    def gap(self) -> RealArray:
        """Gap (nx, ny) in m of the deformed bodies, >= 0; zero where they overlap."""
        return np.maximum(self.solution.state.deflection - self.qp.profile - self.level, 0.0)

    @property
    def touching(self) -> BoolArray:
        """(nx, ny), True where the pressure is positive."""
        return self.pressure > 0.0

    @property
    def force(self) -> float:
        """Force in N that the bodies press each other with."""
        return float(self.pressure.sum(dtype=np.float64)) * self.posed.operator.grid.pixel_area

    def ended(self, status: Status) -> Contact:
        """The same with this ``status`` of its solution."""
        same = replace(self, solution=replace(self.solution, status=status))
        same.__dict__["totals"] = self.totals  # cached there: a survey of all points is not made twice
        return same

    def with_work_of(self, earlier: Contact | None, iterations: int = 0, pairs: float = 0.0) -> Contact:
        """The same with the work of the rounds before it added, and with ``iterations`` and FFT
        ``pairs`` of other methods."""
        own = self.solution.state
        iterations, applications, pairs = own.iterations + iterations, own.applications, own.extra_pairs + pairs
        if earlier is not None:
            before = earlier.solution.state
            iterations += before.iterations
            applications += before.applications
            pairs += before.extra_pairs
        state = replace(own, iterations=iterations, applications=applications, extra_pairs=pairs)
        return replace(self, solution=replace(self.solution, state=state))


@dataclass(frozen=True, eq=False)
class Share:
    """What one coupling adds to the normal problem gap = offset + K p + lift + indentation - h >=
    0, 0 <= p <= cap.

    Shares combine: loads (N), lifts and indentations (m) add, the smallest cap (Pa) holds at every
    point. At a prescribed position the loads are passive: they change what holds the bodies there,
    not the contact. An indentation is a lift at points that yield in this step: their pressure is
    then what the limit must be. A coupling that finds the position itself gives the ``constraint``
    that takes the place of the control. An attraction (Pa), whose displacement is in the lift,
    tells the other couplings what acts on the surfaces beside the pressure.
    """

    load: float = 0.0
    lift: RealArray | float = 0.0
    cap: RealArray | float = np.inf
    indentation: RealArray | float = 0.0
    constraint: Constraint | None = None
    attraction: RealArray | float = 0.0


@dataclass(frozen=True, eq=False)
class Exchange:
    """What a coupling carries through the rounds of one step.

    Attributes
    ----------
    x
        Its unknown: what the contact was posed with.
    target
        What it would have to be for the last contact.
    residual
        How far the two are apart, relative; the tolerance of the normal solves follows the largest
        of all couplings.
    tolerance
        Residual at which it is settled.
    smooth
        Whether the unknown follows the contact smoothly, so that it may be extrapolated. If not,
        the target is taken as it is.
    scale
        Size of a typical difference of unknowns, by which those of several couplings are made
        comparable.
    lowest, highest
        Bounds of the unknown.
    accuracy
        Largest error of the normal solve at which the reply still means something.
    final
        Largest error of the last normal solve.
    exact
        Whether the next solve must be to the full tolerance already, because what its error does to
        the unknown would stay.
    slowest
        Factor by which the residual is at best expected to fall in the next round; what has been
        observed counts where it is larger.
    stuck
        Whether no unknown can be right, so that it must be given up.
    pressure
        Pressure (nx, ny) in Pa to start the next normal solve from, where the coupling knows the
        contact; its target is then taken as it is.
    note
        What else it carries.
    """

    x: RealArray
    target: RealArray
    residual: float = 0.0
    tolerance: float = 0.0
    smooth: bool = True
    scale: float = 1.0
    lowest: RealArray | float = -np.inf
    highest: RealArray | float = np.inf
    accuracy: float = np.inf
    final: float = np.inf
    exact: bool = False
    slowest: float = 0.0
    stuck: bool = False
    pressure: RealArray | None = None
    note: Any = None

    @property
    def settled(self) -> bool:
        """Whether the last contact agrees with what it was posed with."""
        return self.residual <= self.tolerance


class Ahead(NamedTuple):
    """FFT ``pairs`` and ``iterations`` that a coupling has spent on the contact with its own
    unknown, and its ``exchange`` if that has found it; the ``deflection`` (nx, ny) in m by the
    pressure of that, where it is at hand."""

    pairs: float = 0.0
    iterations: int = 0
    exchange: Exchange | None = None
    deflection: RealArray | None = None


Ended: TypeAlias = "tuple[Memory, object]"
"""Memory for the next step, and what a coupling found."""


class Coupling(Protocol):
    """A physics that joins the normal contact: frozen settings, prepared once for a problem.

    ``begin`` is called once a step, then ``share``, a normal solve and ``reply`` alternate until
    every coupling is settled, then ``end``. All couplings reply to the same contact, so that their
    order does not matter. A coupling may inherit from this protocol to leave out what does not
    concern it.
    """

    settled_text: ClassVar[str] = ""
    """That nothing changes any more, where no more has to be said; by its name if empty."""
    unsettled_text: ClassVar[str] = ""
    """What still changes by the ``change``, its residual; by its name if empty."""

    @property
    def name(self) -> str:
        """Name in states, results and certificates."""

    @property
    def feedback(self) -> bool:
        """Whether the contact changes its share; if not, one round is enough."""

    @property
    def remedy(self) -> str:
        """What to do if it does not settle."""

    @property
    def positions(self) -> bool:
        """Whether its share holds the bodies at the position prescribed."""
        return False

    @property
    def bounds(self) -> bool:
        """Whether it bounds the pressure at every point."""
        return False

    @property
    def cap(self) -> RealArray | float | None:
        """Limit (Pa) that it sets to the pressure whatever the contact; None if it depends on the
        contact, or there is none."""
        return None

    def at(self, operator: Operator) -> Coupling:
        """The same with another ``operator`` of the bodies, that of a step of time, in its field of
        this name, if it has one."""
        own = is_dataclass(self) and any(field.name == "operator" for field in fields(self))
        return replace(self, operator=operator) if own else self  # type: ignore[type-var]

    def begin(self, posed: Posed, memory: Memory) -> Exchange:
        """Exchange before the first round, from the ``memory`` of the step before (empty for a
        virgin interface)."""

    def share(self, exchange: Exchange) -> Share:
        """What the next contact is posed with: the iterate, as a displacement that lifts the
        surface, unless it says otherwise."""
        return Share(lift=exchange.x)

    def reply(self, exchange: Exchange, contact: Contact) -> Exchange:
        """Target and residual for ``contact``. May raise NoSolutionError, explained, where there is
        no balance."""
        return exchange

    def rescued(self, exchange: Exchange, mean: float) -> Exchange | None:
        """Exchange that is nearer to bearing the ``mean`` pressure (Pa), which is above the last
        cap; None if it limits nothing."""
        return None

    def unbearable(self, exchange: Exchange, error: NoSolutionError) -> NoSolutionError | None:
        """The ``error`` that the load cannot be borne in words of this coupling, if it is the
        cause; else None."""
        return None

    def settled(self, exchange: Exchange) -> str:
        """That nothing changes any more: the beginning of a sentence that ends in "after 7
        rounds"."""
        return self.settled_text or f"The share of {self.name} is settled"

    def unsettled(self, exchange: Exchange) -> str:
        """What still changes and by how much: the beginning of a sentence that ends in "after 40
        rounds"."""
        text = self.unsettled_text or f"The share of {self.name} still changes by {{change:.1e}}"
        return text.format(change=exchange.residual)

    def apart(self, exchange: Exchange, contact: Contact) -> Exchange:
        """Exchange of surfaces that lie apart at the position prescribed."""
        return exchange

    def end(self, exchange: Exchange, contact: Contact) -> tuple[Memory, object]:
        """Memory for the next step, and what it found (None if that is all in the contact)."""
        return {}, None

    def end_in_time(self, exchange: Exchange, contact: Contact, ended: Ended, stored: float, heat: float) -> Ended:
        """The same of a step of time of bodies that hold the energy ``stored`` (J) after its
        ``heat`` (J), which ``ended`` so by itself."""
        return ended


@runtime_checkable
class Foreseeing(Protocol):
    """Coupling that may have a method of its own for the contact with its feedback."""

    def ahead(
        self, exchange: Exchange, qp: ContactQP, start: RealArray | None, solver: Solver, progress: Progress
    ) -> Ahead:
        """Unknown and pressure that nearly agree, where the coupling has a method for ``qp``, in
        which its share is, that finds them; asked if no other feeds back.

        ``start`` is a pressure (nx, ny) in Pa to start from, if one is known.
        """
