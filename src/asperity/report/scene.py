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
           depths, and an array for each; of values ``unit``, ``colours``, ``range``, ``log``,
           ``decades`` (0: never logarithmic); of classes ``classes`` = [{``text``, ``colour``}]
steps      ``label`` and ``texts`` of the slider through the steps of a load path, or null;
           ``depths`` likewise, of planes in the body
below      of those planes: ``depths`` (m), unit of ``length``, ``layers``, ``interfaces``
sections   vertical sections with stored stresses: the entries of a map and of ``below``, ``axis`` x
           or y, ``start`` on it, one ``array``
spots      name of the map whose islands can be marked, or null
notes      sentences that stand under the maps
========== =======================================================================================

An array is ``shape`` [nx, ny], ``cell`` (sides of a point, m), ``bits`` 8 or 16, ``low``, ``step``
and ``data``: base64 of the numbers n, compressed by zlib (or ``url``, an address of the compressed
bytes). A value is low + step n; the largest n is no value. Numbers stand in rows of y, x fastest.
Those of 16 bits are stored as differences along x, the first of a row as it is, modulo 2¹⁶, with
the sign in the lowest bit (0, -1, 1, -2 … as 0, 1, 2, 3 …), all low bytes before all high bytes.
``shares`` are the shares of the classes of the whole grid.
"""

from __future__ import annotations

import base64
import json
import math
import zlib
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from ..contact.history import HistoryResult
from ..core.arrays import RealArray
from ..core.grid import Grid
from ..core.registry import STEP_TEXTS, home
from ..core.units import show
from ..plots.contact import row_of_section
from ..plots.maps import DECADES, Cut, Field, Kinds, Look, limits
from ..plots.picture import AxesCurves, Figure, colour_table, scale
from ..run.execute import Outcome

MOST_POINTS = 1024 * 1024
"""Points of an array; larger grids are shown coarser."""

BUDGET = 5_000_000
"""Characters that all arrays of a page take at most: with 3 to 4.5 MB of pictures and script a page
stays below 10 MB."""

LAST_STEP = 16
"""Points along a side for which one value of a map of earlier steps stands, up to which the last
step is shown finely."""

MOST_STEPS = 60
"""Steps of a load path that are shown; of longer ones some are left out."""

FIRST = ("heights", "pressure", "contact", "gap")
"""Maps that are shown at first."""

MASKED = {8: 255, 16: 65535}
"""Number of a point without a value."""

REDUCED = {"max": "the largest", "min": "the smallest", "mean": "the mean"}


def reduced(values: RealArray, block: int, how: str) -> RealArray:
    """Largest, smallest or mean value of every block of ``block`` × ``block`` points, NaN where all
    are; the last may be incomplete."""
    if block == 1:
        return values
    nx, ny = values.shape
    padded = np.full((-(-nx // block) * block, -(-ny // block) * block), np.nan)
    padded[:nx, :ny] = values
    blocks = padded.reshape(padded.shape[0] // block, block, -1, block)
    there = np.isfinite(blocks)
    if how == "mean":
        count = there.sum(axis=(1, 3))
        return np.where(count > 0, np.where(there, blocks, 0.0).sum(axis=(1, 3)) / np.maximum(count, 1), np.nan)
    worst, extreme = (-np.inf, np.max) if how == "max" else (np.inf, np.min)
    found = extreme(np.where(there, blocks, worst), axis=(1, 3))
    return np.where(np.isfinite(found), found, np.nan)


def coded(values: RealArray, cell: Sequence[float], *, block: int = 1, how: str = "mean") -> dict[str, Any]:
    """Array of a scene with ``values`` (nx, ny), NaN for none, of points with the sides ``cell``;
    65 535 steps from low to high.

    Of every ``block`` × ``block`` points one value is kept (see ``reduced``).
    """
    values = reduced(values, block, how)
    there = np.isfinite(values)
    low = float(values.min(initial=math.inf, where=there)) if there.any() else 0.0
    high = float(values.max(initial=-math.inf, where=there)) if there.any() else 0.0
    step = (high - low) / (MASKED[16] - 1)
    numbers = np.full(values.shape, MASKED[16], dtype=np.uint16)
    if step > 0.0:
        numbers[there] = np.rint((values[there] - low) / step)
    else:
        numbers[there] = 0
    rows = np.ascontiguousarray(numbers.T)
    signed = np.diff(rows, axis=1, prepend=np.uint16(0)).view(np.int16)
    folded = ((signed << 1) ^ (signed >> 15)).view(np.uint16)
    data = (folded & 255).astype(np.uint8).tobytes() + (folded >> 8).astype(np.uint8).tobytes()
    return _array(values.shape, cell, block, 16, data) | {"low": low, "step": step}


def coded_kinds(kinds: RealArray, cell: Sequence[float], *, block: int = 1) -> dict[str, Any]:
    """Array of a scene with the numbers of classes, 0 to 254; the largest of a block stands for
    it."""
    numbers = reduced(kinds, block, "max").astype(np.uint8)
    return _array(numbers.shape, cell, block, 8, np.ascontiguousarray(numbers.T).tobytes()) | {"low": 0.0, "step": 1.0}


def _array(shape: tuple[int, ...], cell: Sequence[float], block: int, bits: int, data: bytes) -> dict[str, Any]:
    text = base64.b64encode(zlib.compress(data, 1)).decode("ascii")
    return {"shape": list(shape), "cell": [block * side for side in cell], "bits": bits, "data": text}


def decoded(array: dict[str, Any]) -> RealArray:
    """Values (nx, ny) of an array of a scene, NaN where there is none."""
    data = np.frombuffer(zlib.decompress(base64.b64decode(array["data"])), np.uint8)
    nx, ny = array["shape"]
    if array["bits"] == 8:
        numbers = data.reshape(ny, nx).astype(np.uint16)
    else:
        folded = (data[: nx * ny] | (data[nx * ny :].astype(np.uint16) << 8)).reshape(ny, nx)
        signed = (folded >> 1).view(np.int16) ^ -(folded & 1).astype(np.int16)
        numbers = np.cumsum(signed, axis=1, dtype=np.int16).view(np.uint16)
    values = array["low"] + array["step"] * numbers.astype(float)
    return np.where(numbers == MASKED[array["bits"]], np.nan, values).T


# The maps of an outcome, as coarse as their number requires.


@dataclass
class _Map:
    """A map of the scene: how it looks, what makes it for each step or depth, and how many points
    one value stands for."""

    name: str
    title: str
    alt: str
    makers: list[Callable[[], Field | Kinds]]
    along: str | None = None
    block: int = 1
    finest: int = 1

    @property
    def blocks(self) -> list[int]:
        """How many points along a side one value stands for, in each array."""
        found = [self.block] * len(self.makers)
        if self.along == "steps" and self.block <= LAST_STEP:
            found[-1] = self.finest
        return found

    def code(self, number: int) -> dict[str, Any]:
        """Array of one step or depth; the last step is that of the page and as fine as its other
        maps."""
        shown, block = self.makers[number](), self.blocks[number]
        if isinstance(shown, Kinds):
            shares = [float(np.mean(shown.kinds == kind)) for kind in range(len(shown.classes))]
            return coded_kinds(shown.kinds, shown.grid.spacing, block=block) | {"shares": shares}
        return coded(shown.values, shown.grid.spacing, block=block, how=shown.look.reduced)

    def size(self) -> int:
        """Characters of all arrays, from some of them."""
        count = len(self.makers)
        some = sorted({0, count // 2, count - 1})
        return count * max(len(self.code(number)["data"]) for number in some) if count > 3 else 0


def scene_of(
    outcome: Outcome, *, more: Iterable[Figure] = (), budget: int = BUDGET, most_points: int = MOST_POINTS
) -> dict[str, Any] | None:
    """Scene of an ``outcome``, from its figures and ``more``, and from the steps of its load path;
    None on a grid of one row.

    Arrays hold at most ``most_points`` points, and take at most ``budget`` characters together.
    """
    result = outcome.solved.at().result
    figures = [*outcome.all_figures, *more]
    made = scene(figures, result.problem.grid, path=outcome.path, budget=budget, most_points=most_points)
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
    path: HistoryResult | None = None,
    budget: int = BUDGET,
    most_points: int = MOST_POINTS,
) -> dict[str, Any] | None:
    """Scene of the maps that ``figures`` show on ``grid``, and of other steps of a ``path``; None
    without any.

    Of many steps some are shown, evenly chosen, with number and load, and what the physics say of
    each.
    """
    if 1 in grid.shape:
        return None
    steps: list[int] = []
    texts: list[str] = []
    if path is not None and (count := len(path.steps)) > 1:
        shown = min(count, MOST_STEPS)
        steps = sorted({round(number * (count - 1) / (shown - 1)) for number in range(shown)})
        more = [home(place)(path.steps) for name, place in STEP_TEXTS.items() if name in path.last.couplings]
        for number in steps:
            text = f"{number + 1} of {count}: mean pressure {show(path.steps[number].mean_pressure, 'Pa', 4)}"
            texts.append(", ".join([text, *(said[number] for said in more)]))
    maps, depths, cuts = _gathered(figures, grid, path, steps)
    if not maps:
        return None
    block = math.ceil(math.sqrt(grid.shape[0] * grid.shape[1] / most_points))
    for item in maps:
        item.block = item.finest = max(block, 1)
    arrays = _within(maps, budget)
    described = [_described(item, arrays[item.name]) for item in maps]
    sections = [_section(figure, cut) for figure, cut in cuts]
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
        "steps": {"label": "Load step", "texts": texts} if steps else None,
        "depths": {"label": "Depth", "texts": [place.words for place in places]} if places else None,
        "below": _layers(layers, [place.value for place in places]) if places else None,
        "sections": sections,
        "spots": None,
        "notes": _notes(maps, described, path, steps),
    }


def _gathered(
    figures: Iterable[Figure], grid: Grid, path: HistoryResult | None, steps: Sequence[int]
) -> tuple[list[_Map], list[Field], list[tuple[Figure, Cut]]]:
    """Maps, planes in the body and vertical sections of ``figures``."""
    maps: dict[str, _Map] = {}
    depths: list[Field] = []
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
            depths.append(shown)
        elif shown.grid.shape == grid.shape and figure.name not in maps:
            alt = f"{figure.title}. {figure.text}"
            made = _Map(figure.name, figure.title, alt, [lambda shown=shown: shown])  # type: ignore[misc]
            if path is not None and steps and figure.of_step is not None:
                by_step = figure.of_step
                made.makers = [lambda by=by_step, n=n: by(path.steps[n]) for n in steps]  # type: ignore[misc]
                made.along = "steps"
            maps[figure.name] = made
    depths.sort(key=lambda item: item.depth.value if item.depth else 0.0)
    if depths:
        label = depths[0].look.label[:1].upper() + depths[0].look.label[1:]
        planes = [lambda item=item: item for item in depths]
        maps["planes"] = _Map("planes", label, f"{label} on planes in the body.", planes, "depths")  # type: ignore[arg-type]
    return list(maps.values()), depths, cuts


def _within(maps: Sequence[_Map], budget: int) -> dict[str, list[dict[str, Any]]]:
    """Arrays of all maps by name, coarser where they would take more than ``budget`` characters:
    first those that take most."""
    sizes = {item.name: item.size() for item in maps}
    while True:
        while sum(sizes.values()) > budget and (largest := max(maps, key=lambda item: sizes[item.name])).block < 1024:
            largest.block *= 2
            sizes[largest.name] //= 3
        arrays = {item.name: [item.code(number) for number in range(len(item.makers))] for item in maps}
        sizes = {name: sum(len(array["data"]) for array in made) for name, made in arrays.items()}
        if sum(sizes.values()) <= budget or all(item.block >= 1024 for item in maps):
            return arrays


def _described(item: _Map, arrays: list[dict[str, Any]]) -> dict[str, Any]:
    """Entry of a map."""
    shown = [make() for make in ((item.makers[0], item.makers[-1]) if item.along != "steps" else item.makers)]
    last = shown[-1]
    made: dict[str, Any] = {"name": item.name, "title": item.title, "alt": item.alt, "along": item.along}
    if isinstance(last, Kinds):
        classes = max((one.classes for one in shown if isinstance(one, Kinds)), key=len)
        described = [{"text": name, "colour": colour} for name, colour in classes]
        blank = {"text": "no value", "value": None}
        return made | {"kind": "classes", "classes": described, "blank": blank, "reduce": "max", "arrays": arrays}
    ends = [end for array in arrays for end in (array["low"], array["low"] + (MASKED[16] - 1) * array["step"])]
    return made | _look(last.look, limits(np.array(ends), last.look)) | {"kind": "values", "arrays": arrays}


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


def _notes(
    maps: Sequence[_Map], described: Sequence[dict[str, Any]], path: HistoryResult | None, steps: Sequence[int]
) -> list[str]:
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
            last = item.blocks[-1]
            if last < block:
                how += ", in all steps but the last" + (f", which has one for each {last} × {last}" if last > 1 else "")
            names.append(f"{item.title} ({how})")
        notes.append(
            f"Shown coarser than computed, to keep this page small: one value for each {block} × {block} "
            f"points in {', '.join(names)}. Numbers and tables of this page are those of all points."
        )
    if path is not None and 0 < len(steps) < len(path.steps):
        notes.append(f"The slider shows {len(steps)} of the {len(path.steps)} steps, evenly chosen.")
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
            "curves": [{"name": name, "x": floats(x), "y": floats(y)} for name, x, y in axes.curves],
        }
        for axes in curves
    ]
