"""The stresses that are asked for of a contact: sections, profiles and maxima, from planes that
need not fit in memory together."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal, Protocol, TypeAlias

import numpy as np

from ...core import units
from ...core.arrays import BoolArray, RealArray
from ...core.citations import citation_keys
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.status import NoProgress, Progress
from ...core.tensor import STRESSES, StressTensor
from ...solids.elastic import Rigid
from .boundaries import Reader, Rows, require_held
from .compute import Loaded, StressPlanes, at_edges, papers, residual_of, tractions_on
from .criteria import Criterion, VonMises
from .extremes import Extremes, InterfaceMaxima, RegionMaxima
from .field import StressField
from .peaks import Peak
from .regions import DepthProfile, Plane, Position, Section, Selection, Where, depths_through, planes, regions
from .tractions import LoadedBody, Sliding, Tractions
from .yielding import YieldReport

Place: TypeAlias = float | Literal["max", "pressure"]
"""Position in m as in figures (in the middle of a pixel), of the largest stress, or of the highest
pressure."""


class Contact(Loaded, Protocol):
    """What a survey needs of a contact result beside its pressure and problem."""

    @property
    def spot_areas(self) -> RealArray:
        """Areas of the contact spots in m², in any order."""

    @property
    def plastic(self) -> BoolArray:
        """(nx, ny), True where the pressure is at its limit."""


@dataclass(frozen=True)
class WantedSection:
    """Vertical plane at ``place`` of the ``axis`` "x" or "y"."""

    axis: Literal["x", "y"]
    place: Place


@dataclass(frozen=True)
class WantedProfile:
    """Line into the body at ``x`` and ``y``."""

    x: Place
    y: Place


@dataclass(frozen=True)
class Strengths:
    """Strengths in Pa with which the largest tension, shear and peel are compared; NaN where not
    given."""

    tensile: float = math.nan
    interface_shear: float = math.nan
    interface_peel: float = math.nan


@dataclass(frozen=True)
class StressRequest:
    """Stresses that are asked for, all values SI.

    Attributes
    ----------
    friction, direction, coupled
        Friction coefficient, angle in rad of the shear traction on the body, and whether it may
        change the pressure.
    of
        ``"body"`` or ``"counter_body"``.
    depths
        Depths in m of whole planes.
    sections, profiles
        Vertical planes and lines.
    deepest
        Depth in m at which those end; None for one that suits the contact.
    criterion, strengths
        What decides on yield, and strengths beside those of the materials.
    dtype
        Type of the numbers.
    sheared
        Whether the shear traction of a contact with stick and slip, which takes the place of
        ``friction``, loads the body.
    step
        Step of a load path: that of the largest load, the last one, or a number from 1.
    """

    friction: float = 0.0
    direction: float = 0.0
    coupled: bool = False
    of: Literal["body", "counter_body"] = "body"
    depths: tuple[float, ...] = ()
    sections: tuple[WantedSection, ...] = (WantedSection("y", "max"),)
    profiles: tuple[WantedProfile, ...] = ()
    deepest: float | None = None
    criterion: Criterion = VonMises()
    strengths: Strengths = Strengths()
    dtype: str = "float64"
    sheared: bool = True
    step: Literal["peak", "last"] | int = "peak"

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers on what is done with the stresses: principal ones, those in sections,
        coupling, criterion."""
        drawn = ("Peng2001",) if self.sections else ()
        return ("Eberly2014", *drawn, *(("Dundurs1969",) if self.coupled else ()), *self.criterion.citation_keys)

    def check(self, problem: Any) -> None:
        """Refuse what ``problem`` has no stress for, before it is solved.

        InputError if the body does not deform, a depth lies below its rigid base, a position
        outside the grid, or nothing would hold sheared layers (see ``require_held``).
        """
        body, grid = getattr(problem, self.of), problem.grid
        if isinstance(body, Rigid):
            asked = self.of.replace("_", " ")
            raise InputError(
                f"body in which stresses are asked must deform, but the {asked} is rigid; ask for them in the "
                "other body."
            )
        planes(body, self.depths or (0.0,))
        boundary: Any = problem.boundary.name
        require_held(Tractions(grid, np.ones(grid.shape), Sliding(self.friction), boundary), body)
        for section in self.sections:
            _require_within(section.place, section.axis, "section", grid)
            if grid.shape["yx".index(section.axis)] == 1:
                raise InputError(
                    f"stress section must hold more than one point, but that at {section.axis} = const is one "
                    f"point wide on this surface of {grid.shape[0]} x {grid.shape[1]} points."
                )
        for line in self.profiles:
            _require_within(line.x, "x", "profile", grid)
            _require_within(line.y, "y", "profile", grid)


@dataclass(frozen=True)
class Planned:
    """Stresses asked for in a ``problem``, before it is solved; for ``cite``."""

    request: StressRequest
    problem: Any

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers that the stresses will rest on."""
        body = getattr(self.problem, self.request.of)
        sheared = self.request.friction != 0.0
        return (*papers(body, self.problem.boundary.name, sheared=sheared), *self.request.citation_keys)


def _require_within(place: Place, axis: str, kind: str, grid: Grid) -> None:
    size = grid.size["xy".index(axis)]
    if isinstance(place, float) and place > size:
        raise InputError(
            f"{axis} of a stress {kind} must be at most the length {units.show(size, 'm')} of the surface, "
            f"but is {units.show(place, 'm')}."
        )


# Depths of the planes of a survey: dense against the contact spots, both faces of every layer, and
# what is asked for.


RATIO = 1.25
"""Depths below a contact grow by this factor: the largest √J2 under a sphere is at most 0.7 % low
on them."""

SHALLOWEST, DEEPEST = 0.1, 3.0
"""First depth over the mean radius of contact spots, and last over the largest; √J2 of a sphere is
largest at 0.48."""

PIXELS = 0.5
"""First depth in pixels at least: shallower the trigonometric interpolation of pressures ripples as
it does on the surface."""

INTERVALS = 64
"""Number of intervals of planes in all layers together, at most 4 and at least 1 in each."""

SAME, CLOSE = 1e-9, 0.1
"""Relative differences of depths that are one and the same, and so close that no plane is needed
between."""

FAR_LAYERS = 6.0
"""Layers that end within this many radii of the largest spot are sampled to their end."""


def survey_depths(request: StressRequest, result: Contact) -> RealArray:
    """Increasing depths (m) of all planes: those asked for, and for sections and profiles those
    that show the contact.

    To the latter belong all interfaces, however deep.
    """
    if not (request.sections or request.profiles):
        return _distinct(np.array(request.depths), SAME)
    interfaces = [
        region.bottom for region in regions(getattr(result.problem, request.of)) if math.isfinite(region.bottom)
    ]
    return _distinct(np.array([*line_depths(request, result), *interfaces, *request.depths]), SAME)


def line_depths(request: StressRequest, result: Contact) -> RealArray:
    """Increasing depths (m) of sections and profiles: dense against the contact spots, and both
    faces of each layer."""
    body, grid, areas = getattr(result.problem, request.of), result.problem.grid, result.spot_areas
    # mean and largest radius of circles as large as the contact spots; on a grid of one row half
    # the widths of strips
    small = large = 0.5 * min(grid.pixels)
    if areas.size:
        strips = 1 in grid.shape
        radii = 0.5 * areas / grid.spacing[grid.shape.index(1)] if strips else np.sqrt(areas / math.pi)
        small, large = max(float(radii.mean()), small), max(float(radii.max()), large)
    layers = [region.bottom for region in regions(body) if math.isfinite(region.bottom)]
    near = max((bottom for bottom in layers if bottom <= FAR_LAYERS * large), default=0.0)
    # where stresses have mostly decayed, below the layers that are not far below the contact
    bottom = request.deepest or max(DEEPEST * large, 1.5 * near)
    layered = depths_through(body, bottom, per_region=max(1, min(4, INTERVALS // len(regions(body)))))
    asked = [depth for depth in request.depths if depth <= layered[-1]]
    needed = _distinct(np.array([*layered, *asked]), SAME)
    shallow = max(SHALLOWEST * small, PIXELS * max(grid.pixels))
    count = max(0, math.ceil(math.log(layered[-1] / shallow, RATIO) - 0.5))
    graded = shallow * RATIO ** np.arange(count)
    flow = residual_of(result, request.of, None)
    cells = np.zeros(0) if flow is None else flow.yielding_depths()
    cells = cells[cells < layered[-1]]
    away = [depth for depth in graded if np.abs(needed - depth).min() > CLOSE * depth]
    if flow is not None:
        away = [depth for depth in away if flow.cell_at(depth, below=True) is None]
    return _distinct(np.array([*needed, *away, *cells]), SAME)


def _distinct(depths: RealArray, tolerance: float) -> RealArray:
    """Sorted ``depths`` without those that differ from the one before by a relative ``tolerance``
    at most."""
    ordered = np.unique(depths)
    return ordered[np.diff(ordered, prepend=-1.0) > tolerance * np.abs(ordered)]


# Vertical sections and depth profiles through the maxima of a survey, cut out of whole planes as
# they pass.


def wanted_lines(request: StressRequest, result: Contact, peaks: dict[str, Peak]) -> dict[Where, tuple[str, ...]]:
    """Sections and profiles at positions of nodes, each with what it is to show.

    A section through the maximum is one for each stress, on the plane through its own largest
    magnitude.
    """
    grid = result.problem.grid
    found: dict[Where, tuple[str, ...]] = {}
    for section in request.sections:
        for quantity in ("von_mises", "principal_tensile", "shear_xz" if section.axis == "y" else "shear_yz"):
            place = getattr(peaks[quantity], section.axis) if section.place == "max" else section.place
            where = Section(**{section.axis: _on_node(place, section.place, grid, section.axis)})
            found[where] = tuple(dict.fromkeys((*found.get(where, ()), quantity)))
    top = peaks["von_mises"]
    for line in request.profiles:
        x, y = (_on_node(getattr(top, a) if p == "max" else p, p, grid, a) for a, p in (("x", line.x), ("y", line.y)))
        found[DepthProfile(x, y)] = ()
    return found


def _on_node(place: Place, wanted: Place, grid: Grid, axis: str) -> Position:
    """Position of a node: the user's is that of figures, where a node owns the pixel that begins
    there."""
    if place == "pressure":
        return "max"  # as the library calls the place of the highest pressure
    assert isinstance(place, float)
    return place - 0.5 * grid.spacing["xy".index(axis)] if isinstance(wanted, float) else place


def joined(parts: list[StressField]) -> StressField:
    """One field of ``parts`` of one plane each, the region that begins at the last depth left
    out."""
    parts = parts[:-1] if parts[-1].planes[0].side == "below" else parts
    tensors = (np.concatenate([getattr(f.tensor, name) for f in parts]) for name in STRESSES)
    return replace(parts[0], planes=tuple(f.planes[0] for f in parts), tensor=StressTensor(*tensors))


@dataclass(frozen=True, eq=False)
class SurveyedSection:
    """A vertical plane: its stresses, and the ``quantities`` that it is to show."""

    field: StressField
    quantities: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class StressSurvey:
    """What was asked for, and found.

    ``depths`` are those of all planes, on which the maxima and the onset of yield rest. Sections
    and profiles end where the contact is no longer felt, or as asked; the interfaces below that are
    planes, too. ``whole`` holds the largest principal stress in planes parallel to the surface and
    the largest |σxz| and |σyz| of the whole body, by the name of the stress. ``where`` names the
    step of a load path in words, ``step`` is its number from 1.
    """

    request: StressRequest
    result: Contact
    depths: RealArray
    sections: tuple[SurveyedSection, ...]
    profiles: tuple[StressField, ...]
    maxima: tuple[RegionMaxima, ...]
    interfaces: tuple[InterfaceMaxima, ...]
    yielding: YieldReport
    whole: Mapping[str, Peak]
    citation_keys: tuple[str, ...]
    threads: int | None = None
    where: str = ""
    step: int = 0

    def planes(self, depths: Iterable[float]) -> Iterator[StressField]:
        """Whole planes at ``depths`` in m, one by one, computed anew."""
        return _job(self.request, self.result, depths, self.threads).each()

    def wanted_planes(self) -> Iterator[StressField]:
        """The whole planes that were asked for, one by one."""
        return self.planes(self.request.depths) if self.request.depths else iter(())

    def table(self) -> Iterator[tuple[Any, ...]]:
        """Maxima, interface tractions and load factors, one row each; x and y in the middle of a
        pixel, as in figures."""
        yield (
            "part",
            "name",
            "top",
            "bottom",
            "quantity",
            "value",
            "unit",
            "x",
            "y",
            "depth",
            "side",
            "error",
            "doubt",
        )
        grid, root = self.result.problem.grid, math.sqrt(1.0 / 3.0)

        def at(peak: Peak) -> tuple[Any, ...]:
            x, y = (place + 0.5 * step for place, step in zip((peak.x, peak.y), grid.spacing, strict=True))
            return peak.value, "Pa", x, y, peak.depth, peak.side, peak.error, peak.doubt

        for part in self.maxima:
            region = ("layer", part.region.name, part.region.top, part.region.bottom)
            yield (*region, "max_von_mises", *at(part.von_mises))
            yield (
                *region,
                "max_sqrt_J2",
                *at(replace(part.von_mises, value=root * part.von_mises.value, error=root * part.von_mises.error)),
            )
            yield (*region, "max_principal", *at(part.tension))
            yield (*region, "max_shear", *at(part.shear))
        for name, peak in self.whole.items():
            yield ("body", "", "", "", f"max_{name}", *at(peak))
        for item in self.interfaces:
            pair = ("interface", f"{item.above}/{item.below}", item.shear.depth, item.shear.depth)
            yield (*pair, "max_shear", *at(item.shear))
            yield (*pair, "max_peel", *at(item.peel))
        for state in self.yielding.regions:
            region = ("layer", state.region.name, state.region.top, state.region.bottom)
            place = (*at(state.peak)[2:6], state.load_factor_error, state.peak.doubt)
            yield (*region, "yield_stress", state.limit.value, "Pa", "", "", "", "", "", "")
            yield (*region, "load_factor_to_yield", state.load_factor, "1", *place)
            yield (*region, "yielded_volume", state.yielded_volume, "m**3", "", "", "", "", "", "")


def survey(
    request: StressRequest,
    result: Contact,
    *,
    lines: bool = True,
    threads: int | None = None,
    progress: Progress = NoProgress(),
) -> StressSurvey:
    """Compute the stresses of ``request`` in the contact ``result``.

    Planes are read a few rows at a time and not kept, but for sections and profiles through the
    maxima found so far; those that were found later are then computed by themselves on the planes
    that had passed.

    ``request``, ``result``: what is wanted, and of what contact; ``lines``: whether to keep
    sections and profiles, or only the maxima on the same planes; ``threads``: number of threads;
    ``progress``: called after each plane with the number of planes done, and as error the share of
    all that is left.

    Raises
    ------
    InputError
        As of ``stress``.
    """
    depths = survey_depths(request, result)
    drawing = lines and bool(request.sections or request.profiles)
    shown = line_depths(request, result) if drawing else np.zeros(0)
    job = _job(request, result, depths, threads)
    residual = residual_of(result, request.of, threads)
    edges = None
    if not isinstance(result, LoadedBody):
        edges = at_edges(result, _loads(request, result, residual), request.of, residual, threads)
    at_depths = None if residual is None else _job(request, result, depths, threads, over_cells=False).read
    again = planes(getattr(result.problem, request.of), shown) if shown.size else ()
    done, total = 0, len(job.planes) + len(again)

    def tracked(parts: Iterable[Plane]) -> Iterator[Plane]:
        nonlocal done
        for plane in parts:
            yield plane
            done += 1
            progress.update(done, 1.0 - done / total, 0.0)

    extremes, passed = Extremes(result.problem.grid, request.criterion), _Passed(job)
    named: dict[Where, tuple[str, ...]] = {}
    for plane in tracked(job.planes):
        extremes.take(plane, passed.cutting(list(named)) if plane in again else job.read, at_depths)
        named = wanted_lines(request, result, extremes.drawn) if again else {}
    if edges is not None and any(plane.side == "surface" for plane in job.planes):
        extremes.surface = edges()
    parts = [passed.along(list(named), plane) for plane in tracked(again)]
    drawn = [
        (names, joined(list(fields))) for names, fields in zip(named.values(), zip(*parts, strict=True), strict=True)
    ]
    return StressSurvey(
        request,
        result,
        depths,
        tuple(SurveyedSection(field, quantities) for quantities, field in drawn if len(field.dims) == 2),
        tuple(field for _, field in drawn if len(field.dims) == 1),
        extremes.regions(),
        extremes.interfaces(),
        extremes.yielding(),
        extremes.whole(),
        citation_keys(job, request),
        threads,
    )


@dataclass(eq=False)
class _Passed:
    """Sections and profiles that were cut out of planes as they were read, and those that were
    not."""

    _job: StressPlanes
    _cut: dict[tuple[Where, Plane], StressField] = dataclasses.field(default_factory=dict, init=False)
    _places: dict[Where, Selection] = dataclasses.field(default_factory=dict, init=False)

    def cutting(self, lines: list[Where]) -> Callable[[Plane, Reader], None]:
        """What reads planes for others and keeps their stress along ``lines``."""
        self._places |= {line: self._job.place(line) for line in lines if line not in self._places}
        places = [self._places[line] for line in lines]

        def read(plane: Plane, reader: Reader) -> None:
            fields = [np.empty((len(STRESSES), *place.shape), self._job.dtype) for place in places]

            def cut(rows: Rows) -> Rows:
                for first, part in rows:
                    count = part.shape[1]
                    for place, field in zip(places, fields, strict=True):
                        i, j = place.index
                        if isinstance(i, slice):
                            field[:, first : first + count] = part[:, :, j]
                        elif first <= i < first + count:
                            field[...] = part[:, i - first, j]
                    yield first, part

            self._job.read(plane, lambda rows: reader(cut(rows)))
            for line, place, field in zip(lines, places, fields, strict=True):
                self._cut[line, plane] = self._job.field(plane, place, field)

        return read

    def along(self, lines: list[Where], plane: Plane) -> list[StressField]:
        """Fields of ``plane`` along ``lines``."""
        missing = [line for line in lines if (line, plane) not in self._cut]
        found = zip(missing, self._job.along(missing, plane), strict=True) if missing else ()
        self._cut |= {(line, plane): field for line, field in found}
        return [self._cut[line, plane] for line in lines]


def _job(
    request: StressRequest, result: Contact, depths: Iterable[float], threads: int | None, *, over_cells: bool = True
) -> StressPlanes:
    """Planes of the stress that is requested; of a body that flows means over the cells of which
    yield is required, if ``over_cells``."""
    values = [float(depth) for depth in depths]
    options: Any = {"dtype": request.dtype, "threads": threads}
    if isinstance(result, LoadedBody):
        return StressPlanes(result.tractions, result.body, values, **options)
    residual = residual_of(result, request.of, threads)
    return StressPlanes(
        _loads(request, result, residual),
        getattr(result.problem, request.of),
        values,
        residual=residual,
        over_cells=over_cells,
        **options,
    )


def _loads(request: StressRequest, result: Contact, residual: Any) -> Tractions:
    """Tractions on the body in which stresses are asked."""
    found = residual is not None or getattr(result, "stick_slip", None) is not None  # with shear of its own
    friction = None if request.sheared and found else request.friction
    return tractions_on(result, friction, request.direction, request.of)
