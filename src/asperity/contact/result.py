"""The answer to a contact problem: fields, scalars and status, with a certificate."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import Any, Generic, Literal, TypeVar

import numpy as np

from ..core import require
from ..core.arrays import BoolArray, RealArray
from ..core.engine import Engine
from ..core.errors import InputError
from ..core.late import Advised, Stored
from ..core.quantity import Quantity
from ..core.registry import OUTCOMES, PHYSICS
from ..core.status import Status
from ..surfaces.pair import composite
from ..surfaces.surface import Surface
from . import measure
from .answer import Answer, outside
from .certificate import Certificate
from .controls import Control
from .couplings.protocol import Contact, Deflections, Memory
from .edge_tables import PATCHES, WAVES
from .edges import Edges, Kind, PeakPressure, RealArea, Setting, edges_of, peak_pressure, real_area
from .found import ResultNames
from .operators import Operator, prepare_operator
from .problem import ContactProblem
from .state import InterfaceState

PLASTIC_FRACTION = 0.02
"""Share of plastic in real area above which a contact is called plastic (Greenwood & Williamson
1966)."""


AREA_ERROR = Quantity("area_fraction_error", "1", "error of the real contact area / nominal area (95 %)")

OF_EDGES = (
    "area_fraction_corrected",
    AREA_ERROR.name,
    "contact_area",
    "mean_real_pressure",
    "n_spots",
    "mean_spot_area",
    "contact_perimeter",
)
"""Scalars that follow from the edges in the fields of a result, and are not read from files."""

SCALARS = (
    Quantity("mean_pressure", "Pa", "mean (nominal) pressure"),
    Quantity("force", "N", "force"),
    Quantity("area_fraction", "1", "real contact area / nominal area (pixels)"),
    Quantity("area_fraction_corrected", "1", "real contact area / nominal area (edges between pixels)"),
    AREA_ERROR,
    Quantity("contact_area", "m**2", "real contact area (edges between pixels)"),
    Quantity("mean_real_pressure", "Pa", "mean real pressure"),
    Quantity("max_pressure", "Pa", "maximum pressure"),
    Quantity("approach", "m", "approach from first touch"),
    Quantity("mean_gap", "m", "mean gap"),
    Quantity("elastic_energy", "J", "elastic energy"),
    Quantity("plastic_work", "J", "plastic work of this load"),
    Quantity("total_plastic_work", "J", "plastic work since the virgin surface"),
    Quantity("plastic_area_fraction", "1", "plastic area / real contact area"),
    Quantity("indented_area", "m**2", "area ever at the hardness (pixels)"),
    Quantity("plastic_volume", "m**3", "volume of the permanent indentation"),
    Quantity("max_permanent_indentation", "m", "maximum permanent indentation"),
    Quantity("normal_stiffness", "Pa/m", "normal stiffness per nominal area", costly=True),
    Quantity("n_spots", "1", "number of contact spots"),
    Quantity("mean_spot_area", "m**2", "mean area of a contact spot"),
    Quantity("contact_perimeter", "m", "contact perimeter"),
)
"""Every scalar of a result in the order of tables."""


Value = TypeVar("Value")


@dataclass(frozen=True)
class Later:
    """Value that takes long: ``compute`` makes it, from the object whose field it is."""

    compute: Callable[[Any], Any]


class Late(Generic[Value]):
    """Field of a dataclass that takes a value or a ``Later``, which is computed when the field is
    first read."""

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, owner: Any, kind: type | None = None) -> Value:
        if owner is None:
            raise AttributeError(self._name)  # so that the field has no default
        values = vars(owner)
        if isinstance(values[self._name], Later):
            values[self._name] = values[self._name].compute(owner)
        found: Value = values[self._name]
        return found

    def __set__(self, owner: Any, value: Value | Later) -> None:
        vars(owner)[self._name] = value


class WithOutcomes:
    """Attributes of a result by the names of its couplings, None where it has none;
    ``require_name()`` refuses None."""

    couplings: Mapping[str, Any]

    def __getattr__(self, name: str) -> Any:
        found = vars(self).get("couplings", {})
        if name in OUTCOMES or name in found:
            return found.get(name)
        if name.startswith("require_") and name.removeprefix("require_") in OUTCOMES:
            return lambda: self.require(name.removeprefix("require_"))
        raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *OUTCOMES, *self.couplings]

    def require(self, name: str) -> Any:
        """What the coupling of that ``name`` has found.

        Raises
        ------
        InputError
            If the result has none.
        """
        found = self.couplings.get(name)
        if found is None:
            said = {key: sentence for known in PHYSICS.values() for key, sentence in known.absent.items()}
            raise InputError(
                said.get(name, f"couplings of the result must hold {name!r}, but hold {sorted(self.couplings)}.")
            )
        return found

    @property
    def answers(self) -> tuple[Answer, ...]:
        """What the couplings have found."""
        return tuple(item for item in self.couplings.values() if isinstance(item, Answer))


@dataclass(frozen=True, eq=False, repr=False)
class ContactResult(ResultNames, WithOutcomes, Advised, Stored):
    """Solution of a contact problem. Fields are (nx, ny) arrays, all values SI.

    Attributes
    ----------
    problem, control
        What was solved.
    pressure
        Contact pressure in Pa, >= 0.
    displacement
        Sum of the normal displacements of both surfaces in m; relative to its mean for periodic
        half-spaces.
    gap
        Distance of the deformed surfaces in m, >= 0, zero in contact.
    permanent_indentation
        Plastic change of the composite profile in m since the virgin surface, >= 0.
    plastic
        True where the pressure is at its limit.
    offset
        Rigid-body position in m: gap = offset + displacement - profile + permanent_indentation.
    mean_pressure, force
        Load per nominal area (Pa) and load (N) reached.
    area_fraction, area_fraction_corrected, contact_area
        Real over nominal area by counting pixels; the same by the place of the edges between the
        pixels (``edges``), not less than force over hardness; that area in m². The last two, and
        what follows from them, are computed when one is first read.
    mean_real_pressure, max_pressure
        Force over ``contact_area``; largest pressure; Pa.
    approach, mean_gap
        Approach from first touch of the virgin surfaces (see ``Approach``); mean of the gap; m.
    elastic_energy
        Half of pressure times displacement, J; periodic: without the (unbounded) part of the mean
        mode.
    plastic_work, total_plastic_work
        Integral of the hardness over the volume of the indentation: of what this load added, and
        since the virgin surface, J.
    plastic_area_fraction
        Area at the pressure cap over real contact area.
    indented_area, plastic_volume
        Area (m²) of the pixels with permanent indentation, so ever at the cap; volume (m³) below
        the surface before of the indentation and of the imprint of plastic flow in the volume.
    max_permanent_indentation
        Largest depth of both, m.
    normal_stiffness
        d(mean pressure)/d(approach), Pa/m, computed when it is first read; NaN where left out
        (``Keep``); infinite in periodic full contact.
    contact_perimeter
        Length of the edges, m.
    spot_areas
        Areas of the contact spots, largest first, m²; they add up to ``contact_area``.
    certificate, status
        Error bounds and work; how the solver and the couplings ended.
    couplings
        What each coupling found, by its name: ``adhesion``, ``menisci``, ``plastic_flow``,
        ``sliding``, ``stick_slip``, ``fluid``.
    memory
        Memory of each coupling for the next step, by its name, beside the fields here.
    earlier
        Pressure (nx, ny) in Pa of the load before, from which the next one is extrapolated; None
        for a first load.
    deflections
        Displacements by ``pressure`` and by ``earlier`` for the next load (see ``InterfaceState``);
        not saved.
    """

    problem: ContactProblem
    control: Control
    pressure: RealArray
    plastic: BoolArray
    offset: float
    mean_pressure: float
    force: float
    area_fraction: float
    max_pressure: float
    approach: float
    elastic_energy: float
    plastic_work: float
    total_plastic_work: float
    plastic_area_fraction: float
    indented_area: float
    plastic_volume: float
    max_permanent_indentation: float
    certificate: Certificate
    status: Status
    citation_keys: tuple[str, ...]
    displacement: Late[RealArray] = Late()
    permanent_indentation: Late[RealArray] = Late()
    gap: Late[RealArray] = Late()
    mean_gap: Late[float] = Late()
    normal_stiffness: Late[float] = Late()
    couplings: Mapping[str, Any] = field(default_factory=dict)
    memory: Mapping[str, Memory] = field(default_factory=dict)
    earlier: RealArray | None = None
    deflections: Deflections | None = field(default=None, repr=False)

    def __getstate__(self) -> dict[str, Any]:
        """What a pickle or a copy is made from: all numbers, for the machine that would compute one
        cannot go with them."""
        late = ("displacement", "gap", "mean_gap", "normal_stiffness", "permanent_indentation")
        return vars(self) | {name: getattr(self, name) for name in late}

    @property
    def n_spots(self) -> int:
        """Number of contact spots."""
        return int(self.spot_areas.size)

    @property
    def mean_spot_area(self) -> float:
        """Mean area of a contact spot, m²; zero without contact."""
        return float(self.spot_areas.mean()) if self.n_spots else 0.0

    @property
    def external_force(self) -> float:
        """Force in N that is applied from outside: ``force`` less what menisci and adhesion
        pull."""
        return outside(self.answers, self.force)

    @property
    def contact(self) -> BoolArray:
        """(nx, ny), True where the bodies touch (pressure > 0)."""
        return self.pressure > 0.0

    @cached_property
    def edges(self) -> Edges:
        """Where the edges of the contact run between the pixels."""
        return edges_in(self.problem, self.pressure, passing_gap(self), self.plastic)

    @cached_property
    def _real_area(self) -> RealArea:
        edges = vars(self).get("edges") or edges_in(self.problem, self.pressure, passing_gap(self), self.plastic)
        return real_area(self.pressure, self.plastic, edges, self.problem.boundary.wraps)

    @property
    def contact_area(self) -> float:
        """Real contact area in m²."""
        return self._real_area.total

    @property
    def area_fraction_corrected(self) -> float:
        """``contact_area`` over nominal area."""
        return self.contact_area / self.problem.grid.area

    @property
    def area_fraction_error(self) -> float:
        """Error of ``area_fraction_corrected`` by the size of the pixels (see ``RealArea``)."""
        return self._real_area.error / self.problem.grid.area

    @property
    def mean_real_pressure(self) -> float:
        """Force over ``contact_area`` in Pa; zero without contact."""
        return self.force / self.contact_area if self.contact_area else 0.0

    @property
    def peak_pressure(self) -> PeakPressure:
        """Largest pressure between the pixels with its error and place; ``max_pressure`` is that of
        the largest pixel."""
        return peak_pressure(self.pressure, self.plastic, self.problem.grid, self.problem.boundary.wraps)

    @property
    def contact_perimeter(self) -> float:
        """Length of the edges of the contact in m."""
        return self._real_area.perimeter

    @property
    def spot_areas(self) -> RealArray:
        """Areas of the contact spots in m², largest first."""
        return self._real_area.spots

    @property
    def indented(self) -> BoolArray:
        """(nx, ny), True where the surface was ever indented for good."""
        return self.permanent_indentation > 0.0

    @property
    def is_plastic(self) -> bool:
        """Whether more than 2 % of the real area is plastic."""
        return self.plastic_area_fraction > PLASTIC_FRACTION

    @property
    def converged(self) -> bool:
        """Whether solver and couplings reached their tolerances."""
        return self.status.converged

    @property
    def state(self) -> InterfaceState:
        """State to go on from, in the middle of a leg as well.

        Raises
        ------
        InputError
            If it is one of the earlier steps of a viscoelastic history from a file, which keeps the
            past of the last step only.
        """
        if self.creep is not None and "creep" not in self.memory:
            raise InputError(
                "step to go on from must be the last one of a viscoelastic history from a file, but is an "
                "earlier one, whose past the file does not hold. Solve the history up to it again."
            )
        indentation = {"indentation": self.permanent_indentation, "work": np.asarray(self.total_plastic_work)}
        return InterfaceState(self.pressure, {**self.memory, "hardness": indentation}, self.earlier, self.deflections)

    def residual_surface(self, part: Literal["composite", "body", "counter_body"] = "composite") -> Surface:
        """Surface that is left when the load is taken away: the one before less the permanent
        indentation and the imprint of plastic flow.

        The imprint is that of the plastic strain so far: what flows in reverse while the load is
        taken away is not in it. Its zero is that of the displacement by plastic strain, and around
        it the surface may be piled up.

        Parameters
        ----------
        part
            ``"composite"``, the sum of both surfaces, which holds whichever body yields; or the
            surface of the ``"body"`` or ``"counter_body"`` if that is the softer one, which takes
            all of the indentation. Of plastic flow in the volume the body that flows takes the
            imprint, and the other one keeps its surface.

        Raises
        ------
        InputError
            If ``part`` is none of these.
        """
        require.one_of(part, ("composite", "body", "counter_body"), "part of a residual surface")
        problem = self.problem
        surface, counter = problem.surface, problem.counter_surface
        if part == "counter_body":
            before = counter if isinstance(counter, Surface) else surface.with_heights(0.0 * surface.heights, "flat")
        else:
            pair = part == "composite" and isinstance(counter, Surface)
            before = composite(surface, counter) if pair else surface  # type: ignore[arg-type]
        load = f"{self.mean_pressure:.6g} Pa"
        left: RealArray = before.heights - self.permanent_indentation
        for imprint in (answer.imprint(part) for answer in self.answers):
            left = left if imprint is None else left - imprint
        return before.with_heights(left, f"indented for good, last load {load}")


def added(fields: Iterable[RealArray | None]) -> RealArray | None:
    """Sum (nx, ny) of the ``fields`` that are there; None if there is none."""
    there = [field for field in fields if field is not None]
    return sum(there[1:], there[0]) if there else None


def assemble(
    problem: ContactProblem,
    found: Contact,
    *,
    before: InterfaceState | None,
    memories: Mapping[str, Memory],
    lift: RealArray | None,
    attraction: RealArray | None,
    stiffness: bool,
    certificate: Certificate,
    outcomes: Mapping[str, Any],
    citations: tuple[str, ...],
) -> ContactResult:
    """Fields and scalars of the contact ``found``.

    ``before`` is the interface before this load, ``memories`` what the couplings leave,
    ``outcomes`` what they found, ``lift`` the elastic displacement (nx, ny) in m that is not by
    pressure; with one the stiffness is left out, which would follow from both. ``attraction`` (nx,
    ny) in Pa is the part of the traction beside the pressure.
    """
    p, u, grid, operator = found.pressure, found.solution.state.deflection, problem.grid, found.qp.operator
    answers = [outcome for outcome in outcomes.values() if isinstance(outcome, Answer)]
    beside = [lift, *(answer.retarded() for answer in answers)]
    displacement = sum((part for part in beside if part is not None), u)
    springs = [energy for energy in (answer.springs() for answer in answers) if energy is not None]
    pairs = [(p, u)]  # by the pressures from which the next one is extrapolated
    if before is not None and before.deflections is not None:
        known = before.deflections.by(before.pressure, operator)
        pairs += [] if known is None else [(before.pressure, known)]
    capped = np.zeros(p.shape, dtype=bool) if found.qp.elastic else (p > 0.0) & (p >= found.cap)
    yielding = 0 if found.qp.elastic else int(np.count_nonzero(capped))
    computed = found.qp.as_computed(found.solution.state)[0]  # a GPU takes a hundredth of the time
    pixels = int(np.count_nonzero(computed > 0.0))
    load, work = found.totals.pressure, found.totals.deflected
    if lift is not None:
        work += float(np.multiply(p, lift, dtype=np.float64).sum())
    if attraction is not None:
        work -= float((attraction * displacement).sum())
    later = Later(partial(stiffness_of, engine=operator.engine)) if stiffness and lift is None else np.nan
    return ContactResult(
        problem=problem,
        control=found.posed.control,
        pressure=p,
        displacement=displacement,
        gap=Later(partial(_gap, u, found.qp.profile)),
        plastic=capped,
        offset=-found.level,
        mean_pressure=load / grid.n_points,
        force=load * grid.pixel_area,
        area_fraction=pixels / grid.n_points,
        max_pressure=float(computed.max()),
        approach=found.posed.top + found.level,
        mean_gap=Later(lambda result: float(passing_gap(result).mean())),
        elastic_energy=springs[0] if springs else 0.5 * work * grid.pixel_area,
        plastic_area_fraction=yielding / pixels if pixels else 0.0,
        normal_stiffness=later,
        certificate=certificate,
        status=found.solution.status,
        citation_keys=citations,
        couplings=outcomes,
        memory={name: memory for name, memory in memories.items() if memory and name != "hardness"},
        earlier=before.pressure if before is not None and before.pressure.any() else None,
        deflections=Deflections(operator.compliance, operator.boundary, operator.grid, tuple(pairs))
        if found.qp.elastic and attraction is None
        else None,
        **_indentation(problem, before, memories["hardness"], added(answer.imprint() for answer in answers)),
    )


def _gap(deflection: RealArray, profile: RealArray, result: ContactResult) -> RealArray:
    """Distance of the surfaces whose pressed ``profile`` rises by the ``deflection`` less; not
    below zero, where the error of a solve takes it."""
    gap = deflection - profile
    gap += result.offset
    return np.maximum(gap, 0.0, out=gap)


def unindented(result: ContactResult) -> RealArray:
    """Permanent indentation (nx, ny) in m of a surface that was never indented."""
    return np.zeros(result.problem.grid.shape)


def passing_gap(result: ContactResult) -> RealArray:
    """Gap (nx, ny) in m; one that is not at hand is not kept, nor are the edges that follow: a path
    may hold many."""
    gap = vars(result)["gap"]
    found: RealArray = gap.compute(result) if isinstance(gap, Later) else gap
    return found


def stiffness_of(result: ContactResult, *, engine: Engine | None = None, operator: Operator | None = None) -> float:
    """Incremental stiffness of ``result`` in Pa/m, from one linear solve by its ``operator``, made
    on ``engine`` if there is none."""
    problem = result.problem
    operator = operator or prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=engine)
    return measure.normal_stiffness(operator, result.contact & ~result.plastic)


def follows_from_pressure(result: ContactResult) -> bool:
    """Whether the displacement of ``result`` is by the pressure alone, so that it has a
    ``stiffness_of`` its own."""
    lifts = (answer.lifted() for answer in result.answers)
    sheared = any(lift is not None and lift.any() for lift in lifts)
    return not sheared and all(answer.traction_beside() is None for answer in result.answers)


def _indentation(
    problem: ContactProblem, state: InterfaceState | None, memory: Memory, imprint: RealArray | None
) -> dict[str, Any]:
    """Values of a result for the permanent indentation in ``memory``, which takes the place of that
    of ``state``, and the ``imprint`` (nx, ny) in m of flow in the volume."""
    known, total, pixel = memory.get("indentation"), float(memory["work"]), problem.grid.pixel_area
    permanent = np.zeros(1) if known is None else known
    dent = permanent if imprint is None else np.maximum(permanent + imprint, 0.0)
    virgin = imprint is None and not permanent.any()
    return {
        "permanent_indentation": Later(unindented) if known is None else known,
        "plastic_work": total - (0.0 if state is None else state.plastic_work),
        "total_plastic_work": total,
        "indented_area": 0.0 if virgin else int(np.count_nonzero(permanent)) * pixel,
        "plastic_volume": 0.0 if virgin else float(dent.sum()) * pixel,
        "max_permanent_indentation": 0.0 if virgin else float(dent.max()),
    }


def edges_in(problem: ContactProblem, pressure: RealArray, gap: RealArray, plastic: BoolArray) -> Edges:
    """Edges of a contact of ``problem`` with these fields, (nx, ny) each."""
    table = WAVES if problem.boundary.name == "periodic" else PATCHES
    kinds = (physics.edges(problem) for physics in problem.physics)
    kind = next((found for found in kinds if found is not None), Kind.elastic)
    setting = Setting(problem.grid, problem.boundary.wraps, problem.contact_modulus, table, kind)
    return edges_of(pressure, gap, plastic, setting)


# Overlap of the undeformed bodies, and the complementary energy.


@dataclass(frozen=True, eq=False)
class Interference:
    """Overlap of the undeformed bodies at the approach of a contact (Peng 2001, fig. 3.8).

    Attributes
    ----------
    overlapping
        (nx, ny), True where they overlap; an area of contact lies within, but for adhesion.
    area
        Area in m², by points; NaN where the approach is not known.
    volume
        Volume in m³.
    """

    overlapping: BoolArray
    area: float
    volume: float


def interference(result: ContactResult) -> Interference:
    """Overlap of the virgin bodies at the ``approach`` δ of ``result``: points of heights
    h > h_max - δ.

    For a sphere 2 π a² and π R δ², twice the area of Hertz. Where nothing lies outside the grid and
    nothing pulls, the contact lies within. On a periodic map the approach is that of the mean
    planes, without the mean displacement: some points of the contact may lie outside.
    """
    profile, approach = result.problem.profile(), result.approach
    depth = profile - (float(profile.max()) - approach)
    overlapping = depth > 0.0
    if not math.isfinite(approach):
        return Interference(overlapping, math.nan, math.nan)
    pixel = result.problem.grid.pixel_area
    return Interference(overlapping, pixel * float(overlapping.sum()), pixel * float(depth[overlapping].sum()))


def complementary_energy(result: ContactResult) -> float:
    """V* = U - ∫ p u* dA in J, with u* the displacement on the contact and U the elastic energy
    (Peng 2001, eqs 3.3-3.10, 3.27 and 3.28).

    u* is the elastic displacement and the permanent indentation w_p. With pressures that vanish
    outside the contact and a first load V* = -U - H ∫ w_p dA: minus the elastic energy where
    nothing yields. NaN with attraction or creep, whose energies it does not hold.
    """
    if result.creep is not None or any(answer.traction_beside() is not None for answer in result.answers):
        return math.nan
    work = float(np.sum(result.pressure * (result.displacement + result.permanent_indentation)))
    return float(result.elastic_energy) - work * result.problem.grid.pixel_area
