"""What the viewer of a page shows, as JSON: maps of one grid, their steps and depths, sections
below the surface.

A scene is an object of these entries (lengths and values in SI, ``unit`` = {``symbol``, ``factor``}
is that of text):

========== =======================================================================================
size, cell sides of the grid, of a point; ``wraps``: whether it repeats along x and y; ``length``:
           unit of x and y
line       x and y of both ends of the section line at first
palettes   256 colours (base64 of red, green, blue bytes) by the name of a colour map
maps       ``name``, ``title``, ``alt``, ``kind`` values or classes, ``shown`` at first, ``blank`` =
           {``text``, ``value``}: what points without a number are, and count as along a line;
           ``reduce`` max, min or mean: what stands for several points; ``along`` null, steps or
           depths, and an array for each; ``step`` its place among ``steps`` where it is of that
           step only, or null; of values ``unit``, ``colours``, ``range``, ``log``, ``decades`` (0:
           never logarithmic); of classes ``classes`` = [{``text``, ``colour``}]
steps      ``label`` and ``texts`` of the slider through the steps of a load path, ``numbers`` of
           these from 1, and ``first``, the place of the decisive one, which is shown at first; or
           null. ``depths``: ``label`` and ``texts``, of planes in the body
below      of those planes: ``depths`` (m), unit of ``length``, ``layers``, ``interfaces``
sections   vertical sections with stored stresses: the entries of a map and of ``below``, ``axis`` x
           or y, ``start`` on it, one ``array``, ``step`` as of a map
spots      name of the map whose islands can be marked, or null
notes      sentences that stand under the maps
========== =======================================================================================

An array is ``shape`` [nx, ny], ``cell`` (sides of a point, m), ``bits`` 8 or 16, ``low``, ``step``
and ``data``: base64 of the numbers n, compressed by zlib. A value is low + step n; the largest n is
no value. Numbers stand in rows of y, x fastest. Those of 16 bits are stored as differences along y
of differences along x, the first of a row or column as it is, modulo 2¹⁶, with the sign in the
lowest bit (0, -1, 1, -2 … as 0, 1, 2, 3 …), all low bytes before all high bytes. ``shares`` are the
shares of the classes of the whole grid. An array that is only ``url`` is fetched when it is shown:
a line of JSON with its other entries, and the numbers n as they are.
"""

from __future__ import annotations

import base64
import json
import math
import zlib
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import pairwise
from typing import Any, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ..contact.result import ContactResult
from ..core.arrays import RealArray
from ..core.grid import Grid
from ..core.registry import STEP_TEXTS, home
from ..core.units import show
from ..parts.part import Solved
from ..plots.contact import row_of_section
from ..plots.maps import DECADES, Cut, Field, Kinds, Look, limits
from ..plots.picture import AxesCurves, Figure, colour_table, scale
from ..run.execute import Outcome
from .blocks import folded, reduced, whole_blocks

MOST_POINTS = 1024 * 1024
"""Points of an array; larger grids are shown coarser."""

BUDGET = 5_000_000
"""Characters that all arrays of a page take at most: with 3 to 4.5 MB of pictures and script a page
stays below 10 MB."""

MOST_STEPS = 60
"""Steps of a load path that are shown; of longer ones some are left out."""

FIRST = ("heights", "pressure", "contact", "gap")
"""Maps that are shown at first."""

COARSER, COARSEST = 16, 1024
"""How many times as coarse along a side as the decisive step other steps are shown, before that is
shown coarser than computed; and points along a side for which one value stands at most."""

MASKED = {8: 255, 16: 65535}
"""Number of a point without a value."""

REDUCED = {"max": "the largest", "min": "the smallest", "mean": "the mean"}


class Store(Protocol):
    """Keeps arrays of a scene elsewhere, from where they are fetched one by one."""

    def array(self, name: str, make: Callable[[], Stored]) -> dict[str, Any]:
        """Entry of the array ``name`` that ``make`` gives when it is needed; one name is one
        array."""


Classes: TypeAlias = tuple[tuple[str, str], ...]
"""Name and colour of each class of a map."""

Stored: TypeAlias = tuple[dict[str, Any], NDArray[Any]]
"""Entries of an array without its numbers, and these, in rows of y."""


def coded(values: RealArray, cell: Sequence[float], *, block: int = 1, how: str = "mean") -> dict[str, Any]:
    """Array of a scene with ``values`` (nx, ny), NaN for none, of points with the sides ``cell``;
    65 535 steps from low to high.

    Of every ``block`` × ``block`` points one value is kept (see ``reduced``).
    """
    described, rows = numbered(values, cell, block=block, how=how)
    along = np.diff(rows, axis=1, prepend=np.uint16(0))
    signed = np.diff(along, axis=0, prepend=np.uint16(0)).view(np.int16)
    folded = ((signed << 1) ^ (signed >> 15)).view(np.uint16)
    data = (folded & 255).astype(np.uint8).tobytes() + (folded >> 8).astype(np.uint8).tobytes()
    return described | _packed(data)


def numbered(values: RealArray, cell: Sequence[float], *, block: int = 1, how: str = "mean") -> Stored:
    """Entries and numbers of the array of ``coded``."""
    values = reduced(values, block, how)
    there, (low, high) = np.isfinite(values), _ends(values)
    step = (high - low) / (MASKED[16] - 1)
    scaled = np.subtract(values, low, dtype=np.float64)
    np.rint(np.divide(scaled, step or 1.0, out=scaled), out=scaled)
    if not there.all():
        scaled[~there] = MASKED[16]
    numbers = np.ascontiguousarray(scaled.astype(np.uint16).T)
    return _about(values.shape, cell, block, 16) | {"low": low, "step": step}, numbers


def _ends(values: RealArray) -> tuple[float, float]:
    """Smallest and largest of the finite ``values``; zero without any."""
    low, high = float(np.min(values, initial=math.inf)), float(np.max(values, initial=-math.inf))
    if not (math.isfinite(low) and math.isfinite(high)):
        there = values[np.isfinite(values)]
        low, high = (float(there.min()), float(there.max())) if there.size else (0.0, 0.0)
    return low, high


def coded_kinds(shown: Kinds, *, block: int = 1) -> dict[str, Any]:
    """Array of a scene with the classes that ``shown`` has."""
    about, rows = numbered_kinds(shown, block=block)
    return about | _packed(rows.tobytes())


def numbered_kinds(shown: Kinds, *, block: int = 1) -> Stored:
    """Entries and numbers of the array with the classes that ``shown`` has, 0 to 254; the largest
    of a block stands for it."""
    kinds = shown.kinds.astype(np.uint8, copy=False)
    numbers = kinds if block == 1 else folded(np.maximum, whole_blocks(kinds, block, 0), block)
    shares = [int(np.count_nonzero(kinds == kind)) / kinds.size for kind in range(len(shown.classes))]
    about = _about(numbers.shape, shown.grid.spacing, block, 8)
    return about | {"low": 0.0, "step": 1.0, "shares": shares}, np.ascontiguousarray(numbers.T)


def _about(shape: tuple[int, ...], cell: Sequence[float], block: int, bits: int) -> dict[str, Any]:
    return {"shape": list(shape), "cell": [block * side for side in cell], "bits": bits}


def _packed(data: bytes) -> dict[str, Any]:
    return {"data": base64.b64encode(zlib.compress(data, 1)).decode("ascii")}


def decoded(array: dict[str, Any]) -> RealArray:
    """Values (nx, ny) of an array of a scene, NaN where there is none."""
    data = np.frombuffer(zlib.decompress(base64.b64decode(array["data"])), np.uint8)
    nx, ny = array["shape"]
    if array["bits"] == 8:
        numbers = data.reshape(ny, nx).astype(np.uint16)
    else:
        folded = (data[: nx * ny] | (data[nx * ny :].astype(np.uint16) << 8)).reshape(ny, nx)
        signed = (folded >> 1).view(np.int16) ^ -(folded & 1).astype(np.int16)
        along = np.cumsum(signed, axis=0, dtype=np.int16)
        numbers = np.cumsum(along, axis=1, dtype=np.int16).view(np.uint16)
    values = array["low"] + array["step"] * numbers.astype(float)
    return np.where(numbers == MASKED[array["bits"]], np.nan, values).T


# The maps of an outcome, as coarse as their number requires.


@dataclass
class _Map:
    """A map of the scene: how it looks, what makes it for each step or depth, and how many points
    one value stands for: ``block`` along a side, at the ``decisive`` of several steps ``finest``.

    ``keys`` tell the arrays of one map apart, ``step`` is the place of the only step that it is of,
    ``looks`` are how those look that are made already.
    """

    name: str
    title: str
    alt: str
    makers: list[Callable[[], Field | Kinds]]
    keys: Sequence[str]
    along: str | None = None
    step: int | None = None
    decisive: int | None = None
    block: int = 1
    finest: int = 1
    looks: dict[int, Look | Classes] = field(default_factory=dict)

    @property
    def fine(self) -> list[int]:
        """Numbers of the arrays that stay as fine as can be: all but those of other steps."""
        return list(range(len(self.makers))) if self.decisive is None else [self.decisive]

    @property
    def rest(self) -> list[int]:
        """Numbers of the other arrays."""
        return [number for number in range(len(self.makers)) if number not in self.fine]

    def arrays(self, numbers: Iterable[int]) -> dict[int, dict[str, Any]]:
        """The arrays of these ``numbers``."""
        return {number: self.code(number) for number in numbers}

    def code(self, number: int) -> dict[str, Any]:
        """Array of one step or depth."""
        shown, block = self.makers[number](), self.finest if number in self.fine else self.block
        self.looks[number] = shown.classes if isinstance(shown, Kinds) else shown.look
        if isinstance(shown, Kinds):
            return coded_kinds(shown, block=block)
        return coded(shown.values, shown.grid.spacing, block=block, how=shown.look.reduced)

    def stored(self, number: int) -> Stored:
        """Entries and numbers of the array of one step or depth."""
        shown = self.makers[number]()
        if isinstance(shown, Kinds):
            return numbered_kinds(shown, block=self.block)
        return numbered(shown.values, shown.grid.spacing, block=self.block, how=shown.look.reduced)

    def samples(self) -> list[Field | Kinds]:
        """What is shown at a few steps: the decisive one, the first and the last."""
        ends = {0, len(self.makers) - 1}
        return [self.makers[number]() for number in sorted(ends | set(self.fine) if self.along == "steps" else ends)]


def scene_of(outcome: Outcome, *, more: Iterable[Figure] = (), **options: Any) -> dict[str, Any] | None:
    """Scene of an ``outcome``, from its figures and ``more``; ``options`` as for
    ``contact_scene``."""
    return contact_scene(outcome.solved, [*outcome.all_figures, *more], **options)


def contact_scene(
    solved: Solved,
    figures: Iterable[Figure],
    *,
    store: Store | None = None,
    budget: int = BUDGET,
    most_points: int = MOST_POINTS,
) -> dict[str, Any] | None:
    """Scene of a ``solved`` contact, from its ``figures`` and from the steps of its load path; None
    on a grid of one row.

    Arrays hold at most ``most_points`` points; they take at most ``budget`` characters together, or
    are kept by a ``store``.
    """
    result = solved.at().result
    made = scene(figures, result.problem.grid, solved=solved, store=store, budget=budget, most_points=most_points)
    if made is None:
        return None
    grid = result.problem.grid
    y = (row_of_section(result) + 0.5) * grid.spacing[1]
    half = 0.5 * grid.spacing[0]
    spots = "pressure" if any(item["name"] == "pressure" for item in made["maps"]) else None
    line = [half, y, grid.size[0] - half, y]
    return made | {"line": line, "wraps": list(result.problem.boundary.wraps), "spots": spots}


def scene(
    figures: Iterable[Figure],
    grid: Grid,
    *,
    solved: Solved | None = None,
    store: Store | None = None,
    budget: int = BUDGET,
    most_points: int = MOST_POINTS,
) -> dict[str, Any] | None:
    """Scene of the maps that ``figures`` show on ``grid``, and of other steps of the load path of a
    ``solved`` contact; None without any.

    Of many steps some are shown, evenly chosen, with number and load, and what the physics say of
    each; the decisive one and those of which there are figures are among them.
    """
    if 1 in grid.shape:
        return None
    figures = [figure for figure in figures if figure.shows is not None]
    steps = _Steps.of(figures, solved)
    maps, depths, cuts = _gathered(figures, grid, steps)
    if not maps:
        return None
    block = math.ceil(math.sqrt(grid.shape[0] * grid.shape[1] / most_points))
    for item in maps:
        item.block = item.finest = max(block, 1)
    arrays = _within(maps, budget) if store is None else _kept(maps, store)
    described = [_described(item, arrays[item.name], few=store is not None) for item in maps]
    sections = [_section(figure, cut) | {"step": steps.place(figure)} for figure, cut in cuts]
    colours = {item["colours"] for item in (*described, *sections) if "colours" in item}
    length = scale(max(grid.size), "m")
    places = [item.depth for item in depths if item.depth is not None]
    layers = list(dict.fromkeys(place.layer for place in places))
    first = [item["name"] for item in described if item["name"] in FIRST] or [described[0]["name"]]
    return {
        "size": list(grid.size),
        "cell": list(grid.spacing),
        "wraps": [False, False],
        "length": _unit(length),
        "line": [0.5 * grid.spacing[0], 0.5 * grid.size[1], grid.size[0] - 0.5 * grid.spacing[0], 0.5 * grid.size[1]],
        "palettes": {name: base64.b64encode(colour_table(name)).decode("ascii") for name in sorted(colours)},
        "maps": [item | {"shown": item["name"] in first} for item in described],
        "steps": steps.described(),
        "depths": {"label": "Depth", "texts": [place.words for place in places]} if places else None,
        "below": _layers(layers, [place.value for place in places]) if places else None,
        "sections": sections,
        "spots": None,
        "notes": _notes(maps, described, steps),
    }


@dataclass(frozen=True, eq=False)
class _Steps:
    """The steps of the load path of a ``solved`` contact that are shown, by their ``numbers`` from
    1; none where there is but one load."""

    solved: Solved | None
    numbers: tuple[int, ...] = ()

    @classmethod
    def of(cls, figures: Iterable[Figure], solved: Solved | None) -> _Steps:
        """Evenly chosen steps, the decisive one, and those of the ``figures``."""
        if solved is None or solved.path is None or (count := len(solved.path.steps)) < 2:
            return cls(None)
        needed = {solved.at().number, *(step for figure in figures if (step := solved.step_of(figure.of)))}
        even = min(count, MOST_STEPS)
        chosen = [1 + round(number * (count - 1) / (even - 1)) for number in range(even)]
        missing = needed - set(chosen)
        for number in sorted(missing):  # in place of the nearest that is not needed and no end
            free = [place for place in range(1, even - 1) if chosen[place] not in needed]
            chosen[min(free, key=lambda place: abs(chosen[place] - number))] = number
        return cls(solved, tuple(sorted(set(chosen))))

    @property
    def contacts(self) -> list[ContactResult]:
        """The contacts at these steps."""
        return [self.solved.at(number).result for number in self.numbers] if self.solved else []

    @property
    def many(self) -> int:
        """How many steps have been solved."""
        return len(self.solved.path.steps) if self.solved and self.solved.path else 1

    @property
    def decisive(self) -> int | None:
        """Place of the decisive step among them."""
        return self.numbers.index(self.solved.at().number) if self.solved else None

    def place(self, figure: Figure) -> int | None:
        """Place of the only step that a ``figure`` is of; None where it is of all."""
        number = self.solved.step_of(figure.of) if self.solved else None
        return None if number is None else self.numbers.index(number)

    def described(self) -> dict[str, Any] | None:
        """Entry of the slider through the steps."""
        if self.solved is None or self.solved.path is None:
            return None
        every = self.solved.path.steps
        said = [home(place)(every) for name, place in STEP_TEXTS.items() if name in every[-1].couplings]
        texts = []
        for number in self.numbers:
            text = f"{number} of {len(every)}: mean pressure {show(every[number - 1].mean_pressure, 'Pa', 4)}"
            texts.append(", ".join([text, *(one[number - 1] for one in said)]))
        return {"label": "Load step", "texts": texts, "numbers": list(self.numbers), "first": self.decisive}


def _gathered(
    figures: Iterable[Figure], grid: Grid, steps: _Steps
) -> tuple[list[_Map], list[Field], list[tuple[Figure, Cut]]]:
    """Maps, planes in the body and vertical sections of ``figures``."""
    maps: dict[str, _Map] = {}
    depths: list[tuple[Field, int | None]] = []
    cuts: list[tuple[Figure, Cut]] = []
    known: list[Any] = []
    for figure in figures:
        if figure.shows is None or (figure.of_step is not None and figure.of_step in known):
            continue  # the same values on another scale are no other map
        known.append(figure.of_step)
        shown = figure.shows()
        if isinstance(shown, Cut):
            cuts.append((figure, shown))
        elif isinstance(shown, Field) and shown.depth is not None:
            depths.append((shown, steps.place(figure)))
        elif shown.grid.shape == grid.shape and figure.name not in maps:
            alt = f"{figure.title}. {figure.text}"
            made = _Map(figure.name, figure.title, alt, [lambda shown=shown: shown], [f"-of-{steps.many}"])  # type: ignore[misc]
            if steps.numbers and figure.of_step is not None:
                by_step = figure.of_step
                made.makers = [lambda by=by_step, one=one: by(one) for one in steps.contacts]  # type: ignore[misc]
                made.keys = [f"-{number}" for number in steps.numbers]
                made.along, made.decisive = "steps", steps.decisive
            elif figure.of_step is not None or not isinstance(figure.of, ContactResult):
                made.step = steps.place(figure)
            maps[figure.name] = made
    planes = [field for field, _ in sorted(depths, key=lambda item: item[0].depth.value if item[0].depth else 0.0)]
    if planes:
        label = planes[0].look.label[:1].upper() + planes[0].look.label[1:]
        makers = [lambda item=item: item for item in planes]
        keys = [f"-{item.depth.value:.12g}" for item in planes if item.depth is not None]
        alt = f"{label} on planes in the body."
        maps["planes"] = _Map("planes", label, alt, makers, keys, "depths", depths[0][1])  # type: ignore[arg-type]
    return list(maps.values()), planes, cuts


def _kept(maps: Sequence[_Map], store: Store) -> dict[str, list[dict[str, Any]]]:
    """Arrays of all maps by name, kept by ``store``, which is asked first for what is shown
    first."""
    made: dict[str, dict[int, dict[str, Any]]] = {item.name: {} for item in maps}
    wanted = [(item, number) for item in maps for number in item.fine]
    wanted += [(item, number) for item in maps for number in item.rest]
    for item, number in wanted:
        key = f"{item.name}{item.keys[number]}"
        made[item.name][number] = store.array(key, partial(item.stored, number))
    return {name: [arrays[number] for number in sorted(arrays)] for name, arrays in made.items()}


def _within(maps: Sequence[_Map], budget: int) -> dict[str, list[dict[str, Any]]]:
    """Arrays of all maps by name, coarser where they would take more than ``budget`` characters.

    First all steps but the decisive one, of the map of which they take most; the decisive step and
    what is of one step only where the others are ``COARSER`` times as coarse already.
    """
    fine = {item.name: item.arrays(item.fine) for item in maps}
    rest = {item.name: len(item.rest) * _taken({"": fine[item.name]}) for item in maps}  # a guess
    every: dict[str, dict[int, dict[str, Any]]] = {}
    while True:
        over = _taken(fine) + sum(rest.values()) > budget
        free = [item for item in maps if item.rest and item.block < min(COARSER * item.finest, COARSEST)]
        finer = [item for item in maps if item.finest < COARSEST]
        if not every and not (over and free):
            every = {item.name: fine[item.name] | item.arrays(item.rest) for item in maps}
            rest = {name: _taken({"": made}) - _taken({"": fine[name]}) for name, made in every.items()}
        elif over and free:
            largest = max(free, key=lambda item: rest[item.name])
            largest.block *= 2
            rest[largest.name] //= 3
            every = {}
        elif over and finer:
            largest = max(finer, key=lambda item: _taken({"": fine[item.name]}))
            largest.finest *= 2
            largest.block = max(largest.block, largest.finest)
            fine[largest.name] = largest.arrays(largest.fine)
            every = {}
        else:
            return {name: [made[number] for number in sorted(made)] for name, made in every.items()}


def _taken(arrays: Mapping[str, Mapping[int, dict[str, Any]]]) -> int:
    """Characters of all ``arrays``."""
    return sum(len(array["data"]) for made in arrays.values() for array in made.values())


def _described(item: _Map, arrays: list[dict[str, Any]], *, few: bool) -> dict[str, Any]:
    """Entry of a map; of a ``few`` steps only the range of the colours, which the viewer widens."""
    shown = item.samples() if few else []
    looks = [one.classes if isinstance(one, Kinds) else one.look for one in shown]
    looks = looks or [item.looks[number] for number in range(len(item.makers))]
    last = looks[-1]
    made: dict[str, Any] = {"name": item.name, "title": item.title, "alt": item.alt}
    made |= {"along": item.along, "step": item.step}
    if not isinstance(last, Look):
        classes = max((look for look in looks if not isinstance(look, Look)), key=len)
        described = [{"text": name, "colour": colour} for name, colour in classes]
        blank = {"text": "no value", "value": None}
        return made | {"kind": "classes", "classes": described, "blank": blank, "reduce": "max", "arrays": arrays}
    if few:
        ends = [end for one in shown if isinstance(one, Field) for end in _ends(one.values)]
    else:
        ends = [end for array in arrays for end in (array["low"], array["low"] + (MASKED[16] - 1) * array["step"])]
    return made | _look(last, limits(np.array(ends), last)) | {"kind": "values", "arrays": arrays}


def _look(look: Look, ends: tuple[float, float]) -> dict[str, Any]:
    """Entries of a map of values between the ``ends`` of its colours."""
    return {
        "unit": _unit(scale(np.array(ends), look.unit)),
        "colours": look.colours,
        "range": list(ends),
        "log": look.log,
        "decades": DECADES if look.reduced == "max" else 0.0,
        "blank": {"text": look.blank, "value": look.blank_value},
        "reduce": look.reduced,
    }


def _unit(found: Any) -> dict[str, Any]:
    return {"symbol": found.symbol, "factor": found.factor}


def _layers(layers: Sequence[tuple[str, float, float]], depths: Sequence[float]) -> dict[str, Any]:
    """Entries on depths and layers."""
    known = [
        {"text": name, "top": top, "bottom": None if math.isinf(bottom) else bottom} for name, top, bottom in layers
    ]
    interfaces = [{"depth": below[1]} for above, below in pairwise(layers) if below[0] != above[0]]
    deepest = max(depths) or 1.0
    return {"depths": list(depths), "length": _unit(scale(deepest, "m")), "layers": known, "interfaces": interfaces}


def _section(figure: Figure, cut: Cut) -> dict[str, Any]:
    """Entry of a vertical section; its array holds the planes as rows."""
    field = cut.field
    axis = field.dims[1]
    line, step = getattr(field, axis), field.spacing["xy".index(axis)]
    places = {"axis": axis, "start": float(line[0]), "array": coded(cut.values.T, (step, 1.0))}
    look = _look(cut.look, cut.range)
    about = {"name": figure.name, "title": figure.title, "alt": f"{figure.title}. {figure.text}"}
    return about | places | look | _layers(cut.layers, [float(depth) for depth in field.depth])


# Steps of a load path, and what the reader must know.


def _notes(maps: Sequence[_Map], described: Sequence[dict[str, Any]], steps: _Steps) -> list[str]:
    """How exact the shown values are, what is shown coarser than it was computed, and which steps
    are left out."""
    notes = [
        "Values are stored in 65 534 equal steps between the smallest and the largest of each map; the last "
        "digit that is shown may be off by one. Zoomed out, the value of a map that stands for several points "
        "is chosen as for coarse maps: of pressures and other magnitudes the largest, of gaps the smallest, "
        "of heights the mean."
    ]
    for block in sorted({item.block for item in maps if item.block > 1}):
        names = []
        for item, entry in zip(maps, described, strict=True):
            if item.block != block:
                continue
            how = REDUCED[entry["reduce"]] if entry["kind"] == "values" else "the kind that is last in its key"
            if item.decisive is not None and item.finest < block:
                how += f", in all steps but step {steps.numbers[item.decisive]}"
                how += f", which has one for each {item.finest} × {item.finest}" if item.finest > 1 else ""
            names.append(f"{item.title} ({how})")
        notes.append(
            f"Shown coarser than computed, to keep this page small: one value for each {block} × {block} "
            f"points in {', '.join(names)}. Numbers and tables of this page are those of all points."
        )
    if steps.solved is not None and len(steps.numbers) < (count := steps.solved.at().many):
        notes.append(f"The slider shows {len(steps.numbers)} of the {count} steps, evenly chosen.")
    return notes


def as_json(value: Any) -> str:
    """``value`` as JSON that may stand within a page."""
    text = json.dumps(value, allow_nan=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def curves_of(curves: Iterable[AxesCurves]) -> list[dict[str, Any]]:
    """Points of the ``curves`` of a figure with the places of its axes, for the read-out on its
    picture."""

    def floats(values: RealArray) -> str:
        return base64.b64encode(np.asarray(values, dtype="<f4").tobytes()).decode("ascii")

    return [
        {
            "box": [round(side, 5) for side in axes.box],
            **{
                key: {"label": label, "limits": [float(end) for end in ends], "log": log}
                for key, (label, ends, log) in (("x", axes.x), ("y", axes.y))
            },
            "curves": [
                {"name": name, "x": floats(x), "y": floats(y)} | ({"texts": list(texts)} if texts else {})
                for (name, x, y), texts in zip(axes.curves, axes.texts or ((),) * len(axes.curves), strict=True)
            ],
        }
        | ({"cells": True} if axes.cells else {})
        for axes in curves
    ]
