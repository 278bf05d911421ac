"""The stresses that are asked for of a contact: sections, profiles and maxima, from planes that need not fit in memory together."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any, Literal, Protocol, TypeAlias

import numpy as np

from ..core import units
from ..core.arrays import BoolArray, RealArray
from ..core.citations import citation_keys
from ..core.errors import InputError
from ..core.grid import Grid
from ..core.status import NoProgress, Progress
from ..core.tensor import STRESSES, StressTensor
from ..solids.elastic import Rigid
from .boundaries import require_held
from .compute import Loaded, papers, stress_planes
from .criteria import Criterion, VonMises
from .field import InterfaceMaxima, Maxima, Peak, RegionMaxima, StressField
from .regions import (
    DepthProfile,
    Plane,
    Position,
    Section,
    Where,
    depths_through,
    planes,
    regions,
    selection,
)
from .tractions import LoadedBody, Sliding, Tractions
from .yielding import YieldReport, first_yield

Place: TypeAlias = float | Literal["max", "pressure"]
"""Position in m as in figures (in the middle of a pixel), of the largest stress, or of the highest pressure."""


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
    """Strengths in Pa with which the largest tension, shear and peel are compared; NaN where not given."""

    tensile: float = math.nan
    interface_shear: float = math.nan
    interface_peel: float = math.nan


@dataclass(frozen=True)
class StressRequest:
    """Stresses that are asked for, all values SI.

    Attributes
    ----------
    friction, direction, coupled
        Friction coefficient, angle in rad of the shear traction on the body, and whether it may change the pressure.
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
        Whether the shear traction of a contact with stick and slip, which takes the place of ``friction``, loads the body.
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

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers on what is done with the stresses: principal ones, those in sections, coupling, criterion."""
        drawn = ("Peng2001",) if self.sections else ()
        return ("Eberly2014", *drawn, *(("Dundurs1969",) if self.coupled else ()), *self.criterion.citation_keys)

    def check(self, problem: Any) -> None:
        """Refuse what ``problem`` has no stress for, before it is solved.

        InputError if the body does not deform, a depth lies below its rigid base, a position outside the grid, or
        nothing would hold sheared layers (see ``require_held``).
        """
        body, grid = getattr(problem, self.of), problem.grid
        if isinstance(body, Rigid):
            asked = self.of.replace("_", " ")
            raise InputError(
                f"body in which stresses are asked must deform, but the {asked} is rigid; ask for them in the other body."
            )
        planes(body, self.depths or (0.0,))
        boundary: Any = problem.boundary.name
        require_held(Tractions(grid, np.ones(grid.shape), Sliding(self.friction), boundary), body)
        for section in self.sections:
            _require_within(section.place, section.axis, "section", grid)
            if grid.shape["yx".index(section.axis)] == 1:
                raise InputError(
                    f"stress section must hold more than one point, but that at {section.axis} = const is one point wide "
                    f"on this surface of {grid.shape[0]} x {grid.shape[1]} points."
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


# Depths of the planes of a survey: dense against the contact spots, both faces of every layer, and what is asked for.


RATIO = 1.25
"""Depths below a contact grow by this factor: the largest √J2 under a sphere is at most 0.7 % low on them."""

SHALLOWEST, DEEPEST = 0.1, 3.0
"""First depth over the mean radius of contact spots, and last over the largest; √J2 of a sphere is largest at 0.48."""

PIXELS = 0.5
"""First depth in pixels at least: shallower the trigonometric interpolation of pressures ripples as it does on the surface."""

INTERVALS = 64
"""Number of intervals of planes in all layers together, at most 4 and at least 1 in each."""

SAME, CLOSE = 1e-9, 0.1
"""Relative differences of depths that are one and the same, and so close that no plane is needed between."""

FAR_LAYERS = 6.0
"""Layers that end within this many radii of the largest spot are sampled to their end."""


def survey_depths(request: StressRequest, result: Contact) -> RealArray:
    """Increasing depths (m) of all planes: those asked for, and for sections and profiles those that show the contact.

    To the latter belong all interfaces, however deep.
    """
    if not wants_lines(request):
        return _distinct(np.array(request.depths), SAME)
    interfaces = [
        region.bottom for region in regions(getattr(result.problem, request.of)) if math.isfinite(region.bottom)
    ]
    return _distinct(np.array([*line_depths(request, result), *interfaces, *request.depths]), SAME)


def line_depths(request: StressRequest, result: Contact) -> RealArray:
    """Increasing depths (m) of sections and profiles: dense against the contact spots, and both faces of each layer."""
    body = getattr(result.problem, request.of)
    small, large = _spot_radii(result)
    layers = [region.bottom for region in regions(body) if math.isfinite(region.bottom)]
    near = max((bottom for bottom in layers if bottom <= FAR_LAYERS * large), default=0.0)
    # where stresses have mostly decayed, below the layers that are not far below the contact
    bottom = request.deepest or max(DEEPEST * large, 1.5 * near)
    layered = depths_through(body, bottom, per_region=max(1, min(4, INTERVALS // len(regions(body)))))
    asked = [depth for depth in request.depths if depth <= layered[-1]]
    needed = _distinct(np.array([*layered, *asked]), SAME)
    grid = result.problem.grid
    pixels = [step for step, n in zip(grid.spacing, grid.shape, strict=True) if n > 1] or [grid.spacing[0]]
    shallow = max(SHALLOWEST * small, PIXELS * max(pixels))
    count = max(0, math.ceil(math.log(layered[-1] / shallow, RATIO) - 0.5))
    graded = shallow * RATIO ** np.arange(count)
    away = [depth for depth in graded if np.abs(needed - depth).min() > CLOSE * depth]
    return np.unique([*needed, *away])


def wants_lines(request: StressRequest) -> bool:
    """Whether sections or profiles are asked for."""
    return bool(request.sections or request.profiles)


def _spot_radii(result: Contact) -> tuple[float, float]:
    """Mean and largest radius (m) of circles as large as the contact spots, at least half a pixel.

    On a grid of one row spots are strips, and half their widths take the place of radii.
    """
    grid = result.problem.grid
    least = 0.5 * min(
        (step for step, n in zip(grid.spacing, grid.shape, strict=True) if n > 1), default=grid.spacing[0]
    )
    if not result.spot_areas.size:
        return least, least
    if 1 in grid.shape:
        radii = 0.5 * result.spot_areas / grid.spacing[grid.shape.index(1)]
    else:
        radii = np.sqrt(result.spot_areas / math.pi)
    return max(float(radii.mean()), least), max(float(radii.max()), least)


def _distinct(depths: RealArray, tolerance: float) -> RealArray:
    """Sorted ``depths`` without those that differ from the one before by a relative ``tolerance`` at most."""
    ordered = np.unique(depths)
    return ordered[np.diff(ordered, prepend=-1.0) > tolerance * np.abs(ordered)]


# Vertical sections and depth profiles through the maxima of a survey, cut out of whole planes as they pass.


def wanted_lines(request: StressRequest, result: Contact, peaks: dict[str, Peak]) -> dict[Where, tuple[str, ...]]:
    """Sections and profiles at positions of nodes, each with what it is to show.

    A section through the maximum is one for each stress, on the plane through its own largest magnitude.
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
    """Position of a node: the user's is that of figures, where a node owns the pixel that begins there."""
    if place == "pressure":
        return "max"  # as the library calls the place of the highest pressure
    assert isinstance(place, float)
    return place - 0.5 * grid.spacing["xy".index(axis)] if isinstance(wanted, float) else place


def cut(planes: Iterator[StressField], lines: list[Where], result: Contact) -> list[StressField]:
    """The ``lines`` out of whole planes."""
    places = [selection(line, result.problem.grid, result.pressure) for line in lines]
    cuts: list[list[StressField]] = [[] for _ in lines]
    for field in planes:
        for place, found in zip(places, cuts, strict=True):
            part = (slice(None), *place.index)
            tensor = field.tensor.map(lambda component, part=part: component[part].copy())  # type: ignore[misc]
            found.append(replace(field, tensor=tensor, x=place.x, y=place.y, dims=("plane", *place.dims)))
    for found in cuts:
        if found[-1].planes[0].side == "below":  # the region that begins at the last depth is not shown
            found.pop()
    joined = []
    for found in cuts:
        tensors = (np.concatenate([getattr(f.tensor, name) for f in found]) for name in vars(found[0].tensor))
        planes_of = tuple(f.planes[0] for f in found)
        joined.append(replace(found[0], planes=planes_of, tensor=StressTensor(*tensors)))
    return joined


@dataclass(frozen=True, eq=False)
class SurveyedSection:
    """A vertical plane: its stresses, and the ``quantities`` that it is to show."""

    field: StressField
    quantities: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class StressSurvey:
    """What was asked for, and found.

    ``depths`` are those of all planes, on which the maxima and the onset of yield rest. Sections and profiles end where
    the contact is no longer felt, or as asked; the interfaces below that are planes, too.
    """

    request: StressRequest
    result: Contact
    depths: RealArray
    sections: tuple[SurveyedSection, ...]
    profiles: tuple[StressField, ...]
    maxima: tuple[RegionMaxima, ...]
    interfaces: tuple[InterfaceMaxima, ...]
    yielding: YieldReport
    citation_keys: tuple[str, ...]
    threads: int | None = None

    def planes(self, depths: Iterable[float]) -> Iterator[StressField]:
        """Whole planes at ``depths`` in m, one by one, computed anew."""
        return _planes(self.request, self.result, depths, self.threads)

    def wanted_planes(self) -> Iterator[StressField]:
        """The whole planes that were asked for, one by one."""
        return self.planes(self.request.depths) if self.request.depths else iter(())


def survey(
    request: StressRequest,
    result: Contact,
    *,
    lines: bool = True,
    threads: int | None = None,
    progress: Progress = NoProgress(),
) -> StressSurvey:
    """Compute the stresses of ``request`` in the contact ``result``.

    Sections and profiles through the maxima are cut out of the planes of which these were found, if these take at most
    ``MOST_KEPT`` bytes; else the planes are computed a second time.

    ``request``, ``result``: what is wanted, and of what contact; ``lines``: whether to keep sections and profiles, or
    only the maxima on the same planes; ``threads``: number of threads; ``progress``: called after each plane with the number
    of planes done, and as error the share of all that is left.

    Raises
    ------
    InputError
        As of ``stress``.
    """
    depths = survey_depths(request, result)
    maxima = Maxima(threads)
    shown = line_depths(request, result) if lines and wants_lines(request) else np.zeros(0)
    body = getattr(result.problem, request.of)
    first, second = (planes(body, d) if d.size else () for d in (depths, shown))
    size = len(STRESSES) * result.problem.grid.n_points * np.dtype(request.dtype).itemsize
    once = frozenset(second if len(second) * size <= MOST_KEPT and set(second) <= set(first) else ())
    kept: list[StressField] = []
    tracked = _Tracked(progress, len(first) + len(second) - len(once))
    found = _keeping(tracked.planes(_planes(request, result, depths, threads)), once, kept)
    report = first_yield(maxima.watching(found), request.criterion)
    wanted = wanted_lines(request, result, maxima.drawn) if shown.size else {}
    again = iter(kept) if kept or not wanted else tracked.planes(_planes(request, result, shown, threads))
    named = list(zip(wanted.values(), cut(again, list(wanted), result), strict=True))
    return StressSurvey(
        request,
        result,
        depths,
        tuple(SurveyedSection(field, quantities) for quantities, field in named if len(field.dims) == 2),
        tuple(field for _, field in named if len(field.dims) == 1),
        maxima.regions(),
        maxima.interfaces(),
        report,
        citation_keys(maxima, request),
        threads,
    )


MOST_KEPT = 400_000_000
"""Bytes of whole planes that are kept for sections: those of a coated contact of 512² points in double precision."""


def _keeping(fields: Iterable[StressField], wanted: frozenset[Plane], kept: list[StressField]) -> Iterator[StressField]:
    """The same ``fields``; those of the planes ``wanted`` are appended to ``kept``."""
    for field in fields:
        if field.planes[0] in wanted:
            kept.append(field)
        yield field


def _planes(
    request: StressRequest, result: Contact, depths: Iterable[float], threads: int | None
) -> Iterator[StressField]:
    own: Any = {"friction": request.friction, "direction": request.direction}
    if isinstance(result, LoadedBody) or (request.sheared and getattr(result, "stick_slip", None) is not None):
        own = {}  # they bring their own
    return stress_planes(
        result,
        [float(depth) for depth in depths],
        **own,
        of=request.of,
        dtype=request.dtype,
        threads=threads,
    )


class _Tracked:
    """Count of planes done, passed on to the progress."""

    def __init__(self, progress: Progress, total: int) -> None:
        self._progress, self._total, self._done = progress, total, 0

    def planes(self, fields: Iterator[StressField]) -> Iterator[StressField]:
        """The same ``fields``."""
        for field in fields:
            yield field
            self._done += 1
            self._progress.update(self._done, 1.0 - self._done / self._total, 0.0)
