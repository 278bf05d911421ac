"""Onset of yield: where a body fails first, at how many times the stress, and how much of it is
beyond its strength."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import numpy as np

from ...core import require
from ...core.errors import InputError, NoSolutionError
from ...core.late import Shown
from ...core.units import show
from .criteria import Criterion, Limit, VonMises
from .field import StressField
from .peaks import Peak, SurfaceMaxima
from .regions import Region


@dataclass(frozen=True, eq=False)
class RegionYield:
    """State of one region against its strength.

    Attributes
    ----------
    region
        The layer or substrate.
    limit
        Its strength; NaN where unknown.
    peak
        Largest equivalent stress in Pa, and where.
    load_factor
        Strength over that stress: the factor on all stresses at which the region begins to yield.
        NaN where the strength is unknown.
    yielded_volume
        Volume in m³ (area in m² of a section, length in m of a profile) where the equivalent stress
        exceeds the strength: pixels counted on each plane, trapezoidal rule between the planes.
    """

    region: Region
    limit: Limit
    peak: Peak
    load_factor: float
    yielded_volume: float

    @property
    def load_factor_error(self) -> float:
        """Error of the load factor by that of the peak; NaN where that is not known. With
        ``peak.doubt`` the load factor is an upper bound."""
        return self.load_factor * self.peak.error / self.peak.value if self.peak.value > 0.0 else math.nan

    @property
    def place(self) -> str:
        """Where the peak lies, for people."""
        side = self.peak.side
        if side in ("surface", "inside"):
            return f"{side} of {self.region.name}" if side == "surface" else f"inside {self.region.name}"
        return f"interface at {'the lower' if side == 'above' else 'the upper'} side of {self.region.name}"


def factor_text(part: RegionYield) -> str:
    """Load factor of a region, with its error or as an upper bound."""
    text = f"{part.load_factor:.3g}"
    if part.peak.doubt:
        return f"< {text}"
    return text if math.isnan(part.load_factor_error) else f"{text} ± {part.load_factor_error:.2g}"


@dataclass(frozen=True, eq=False, repr=False)
class YieldReport(Shown):
    """Onset of yield in a stress field, region by region.

    The load factor scales the stresses of one contact. A load changes the contact itself unless its
    area is full or it is a bonded one, so for a rough contact or a sphere the factor is no factor
    on the load; ``load_at_yield`` finds that by solving again.
    """

    criterion: Criterion
    regions: tuple[RegionYield, ...]

    def line(self) -> str:
        """Largest stress, strength and place."""
        worst = self.first or max(self.regions, key=lambda part: part.peak.value)
        stress = f"{self.criterion.name} {show(worst.peak.value, 'Pa')}"
        limit = f"of {show(worst.limit.value, 'Pa')}, load factor {worst.load_factor:.3g}"
        return f"YieldReport: {stress} {limit if self.first else 'of unknown strength'}, {worst.place}"

    @property
    def first(self) -> RegionYield | None:
        """The region that yields first; None where no strength is known."""
        known = [part for part in self.regions if not math.isnan(part.load_factor)]
        return min(known, key=lambda part: part.load_factor) if known else None

    @property
    def load_factor(self) -> float:
        """Factor on all stresses at which the body begins to yield; NaN where no strength is
        known."""
        return math.nan if self.first is None else self.first.load_factor

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers the criterion rests on."""
        return self.criterion.citation_keys

    @property
    def yields(self) -> bool:
        """Whether some point is at its strength or beyond."""
        return self.load_factor <= 1.0


def equivalent_at(surface: SurfaceMaxima, criterion: Criterion, peak: Peak) -> Peak:
    """The larger equivalent stress of ``criterion`` at the surface and of ``peak``, the largest at
    points, which there it replaces."""
    measure = getattr(criterion, "measure", "")
    if not hasattr(surface, measure):
        return peak
    factor = 2.0 if measure == "shear" else 1.0
    found = surface.joined(measure, replace(peak, value=peak.value / factor))
    return replace(found, value=factor * found.value, error=factor * found.error)


def first_yield(fields: StressField | Iterable[StressField], criterion: Criterion = VonMises()) -> YieldReport:
    """Where and at what multiple of the stresses a body begins to yield.

    ``fields``: a stress field, or the planes of one from ``stress_planes``, of which only one is
    held at a time; ``criterion``: ``VonMises()``, ``Tresca()``, ``MaxPrincipal(strength)`` or
    anything alike.

    InputError if there are no fields.
    """
    parts: dict[Region, Gathered] = {}
    peaks: dict[Region, Peak] = {}
    for field in [fields] if isinstance(fields, StressField) else fields:
        equivalent = criterion.equivalent(field.tensor)
        for number, plane in enumerate(field.planes):
            part = parts.setdefault(plane.region, Gathered(criterion.limit(plane.region.material)))
            part.note(plane.depth, float(np.count_nonzero(equivalent[number] > part.limit.value)) * field.cell)
            peak = field.peak(equivalent, plane=number)
            if plane.side == "surface" and (surface := field.surface_maxima) is not None:
                peak = equivalent_at(surface, criterion, peak)
            if plane.region not in peaks or peak.value > peaks[plane.region].value:
                peaks[plane.region] = peak
    if not parts:
        raise InputError("fields of a yield report must hold at least one plane, but are empty.")
    return YieldReport(criterion, tuple(part.report(region, peaks[region]) for region, part in parts.items()))


@dataclass(eq=False)
class Gathered:
    """How much of one region is beyond its ``limit``, plane by plane."""

    limit: Limit
    _depths: list[float] = dataclasses.field(default_factory=list, init=False)
    _extents: list[float] = dataclasses.field(default_factory=list, init=False)

    def note(self, depth: float, extent: float) -> None:
        """Take in a plane, with the area (length, number) beyond the limit."""
        self._depths.append(depth)
        self._extents.append(extent)

    def report(self, region: Region, peak: Peak) -> RegionYield:
        """The region's entry, with its largest equivalent stress."""
        factor = self.limit.value / peak.value if peak.value > 0.0 else math.inf
        order = np.argsort(self._depths, kind="stable")
        volume = float(np.trapezoid(np.array(self._extents)[order], np.array(self._depths)[order]))
        known = not math.isnan(self.limit.value)
        return RegionYield(region, self.limit, peak, factor if known else math.nan, volume if known else math.nan)


@dataclass(frozen=True, eq=False)
class LoadAtYield:
    """Load at which a body begins to yield, in the unit that the caller's function takes; the
    report there.

    ``evaluations`` is the number of contacts solved on the way.
    """

    load: float
    report: YieldReport
    evaluations: int


def load_at_yield(
    field_at: Callable[[float], StressField | Iterable[StressField]],
    load: float,
    *,
    criterion: Criterion = VonMises(),
    tolerance: float = 1e-3,
    max_evaluations: int = 30,
) -> LoadAtYield:
    """Load at which a body begins to yield, found by computing the stress at other loads.

    ``field_at``: stress field at a given load, for example ``lambda force:
    asp.stress(asp.solve(problem, asp.Force(force)),
    depths)``; ``load``: first guess, > 0; ``criterion``: as for ``first_yield``; ``tolerance``:
    relative error of the load factor (that is, of the stress) at which to stop;
    ``max_evaluations``: largest number of loads tried.

    NoSolutionError if no strength is known, or the load factor does not come near one.

    Notes
    -----
    Secants in the logarithms of load and factor, from the exponent 1/3 of a Hertz contact. The
    depths must hold the place of first yield at every load, and be fine enough for the accuracy
    asked for.
    """
    require.positive(tolerance, "tolerance of a load at yield")
    at, slope = math.log(require.positive(load, "first guess of the load at yield")), -1.0 / 3.0
    previous: tuple[float, float] | None = None
    for evaluation in range(1, require.integer(max_evaluations, 1, "number of loads tried") + 1):
        report = first_yield(field_at(math.exp(at)), criterion)
        if math.isnan(report.load_factor):
            raise NoSolutionError(
                "no material of the body has a known strength; give yield_stress or hardness.",
                subject="strength of the body",
            )
        miss = math.log(report.load_factor) if math.isfinite(report.load_factor) else 3.0
        if abs(miss) <= tolerance:
            return LoadAtYield(math.exp(at), report, evaluation)
        if previous is not None and previous[0] != at:
            # the stress grows with the load, by some power between 1/20 and 2, else the two loads
            # are too near to tell
            slope = min(-0.05, max(-2.0, (miss - previous[1]) / (at - previous[0])))
        previous = at, miss
        at -= max(-5.0, min(5.0, miss / slope))
    raise NoSolutionError(
        f"no load at yield was found in {max_evaluations} loads; the last load factor is {report.load_factor:.4g}. "
        "Check that the depths hold the place of first yield, or start nearer.",
        subject="load at yield",
    )


# Indicators of fracture: tension at the surface, shear and peel of interfaces, each against a given
# strength.


@dataclass(frozen=True)
class Indicator:
    """A largest stress with its place and error, and the ``ratio`` to the strength given for it
    (NaN where none was).

    Where ``peak.doubt`` says that the stress is but a lower bound, so is the ratio.
    """

    name: str
    peak: Peak
    ratio: float


def fracture_indicators(
    field: StressField,
    *,
    tensile: float = math.nan,
    interface_shear: float = math.nan,
    interface_peel: float = math.nan,
) -> tuple[Indicator, ...]:
    """Largest tension on the surface, largest tension in each region, and shear and peel of each
    interface of ``field``.

    Tension is the largest principal stress. Strengths ``tensile``, ``interface_shear`` and
    ``interface_peel`` in Pa give the ratios; a ratio of one or more means failure. Only planes of
    the field count: it needs depth 0 for the surface and the depths of the interfaces.
    """
    found: list[Indicator] = []

    def add(name: str, peaks: Iterable[Peak], strength: float) -> None:
        worst = max(peaks, key=lambda peak: peak.value)
        found.append(Indicator(name, worst, worst.value / strength))

    surface = [number for number, plane in enumerate(field.planes) if plane.side == "surface"]
    if surface:
        add("tension at the surface", (field.largest("tension", plane=number) for number in surface), tensile)
    for region in field.regions:
        inside = [number for number, plane in enumerate(field.planes) if plane.region == region]
        add(f"tension in {region.name}", (field.largest("tension", plane=number) for number in inside), tensile)
    shear, peel = np.hypot(field.shear_xz, field.shear_yz), field.normal_zz
    for number, plane in enumerate(field.planes):
        if plane.side == "above":
            below = next(
                (p.region.name for p in field.planes if p.region.index == plane.region.index + 1), "rigid base"
            )
            pair = f"{plane.region.name}/{below}"
            add(f"shear of the interface {pair}", [field.peak(shear, plane=number)], interface_shear)
            add(f"peel of the interface {pair}", [field.peak(peel, plane=number)], interface_peel)
    return tuple(found)
