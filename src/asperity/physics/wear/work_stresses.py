"""Stresses and yielding of a contact as it wears, in numbers and words."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ...contact.result import ContactResult
from ...core.arrays import RealArray
from ...core.units import show, times
from ...parts.part import Rows, Solved, Table
from .history import WearHistory
from .part import STRESS_COLUMNS, STRESS_SCALARS, Wears
from .stresses import WornStresses, layer_names, stresses_of

NAMES = {"stress_x": "x", "stress_y": "y", "stress_depth": "depth"}
"""Columns whose names in the stresses are others."""


def stress_values(ask: Wears, solved: Solved, history: WearHistory) -> dict[str, Any]:
    """Stresses as it wears, if they are asked for: ``STRESS_SCALARS``, NaN where there are none,
    and ``STRESS_COLUMNS``."""
    values: dict[str, Any] = {item.name: math.nan for item in STRESS_SCALARS}
    names = {item.name for item in (*STRESS_SCALARS, *STRESS_COLUMNS)}
    if ask.stresses is None or (solved.wanted is not None and not solved.wanted & names):
        return values
    layers = layer_names(getattr(solved.problem, ask.stresses.of))
    with solved.stage("stresses as it wears") as progress:
        found = stresses_of(history.kept, layers, ask.stresses, solved.threads, progress)
    return values | _numbers(found, fretting=history.fretting) | _columns(found, history.kept, history.course)


def _numbers(found: WornStresses, *, fretting: bool) -> dict[str, float]:
    """``STRESS_SCALARS``."""
    used, factor = np.fmax.reduce(found["utilisation"], axis=1), found.load_factor
    numbers: dict[str, float] = {}
    for when, at in (("first", 0), ("last", -1)):
        numbers |= {f"wear_max_{name}_{when}": float(np.nanmax(found[name][at])) for name in ("von_mises", "tension")}
        numbers |= {f"wear_utilisation_{when}": float(used[at]), f"wear_yield_load_factor_{when}": float(factor[at])}
    numbers |= {
        "wear_utilisation_largest": float(np.fmax.reduce(used)),
        "wear_yield_load_factor_least": float(np.fmin.reduce(factor)),
    }
    layers = [layer for layer in range(len(found.layers)) if found.yields[:, layer].any()]
    ends = {
        "wear_yield_begins": min((found.yields_from(layer) for layer in layers), default=math.nan),
        "wear_yield_ends": max((found.yields_until(layer) for layer in layers), default=math.nan),
    }
    for name, way in ends.items():
        there = way if math.isfinite(way) else math.nan
        numbers |= {name: math.nan if fretting else there, f"{name}_cycles": there if fretting else math.nan}
    return numbers


def _columns(found: WornStresses, kept: Sequence[tuple[float, ContactResult]], course: RealArray) -> dict[str, Any]:
    """``STRESS_COLUMNS``: NaN after steps of the ``course`` whose contacts were not ``kept``."""
    rows = np.searchsorted(course, [way for way, _ in kept])
    many = {name: np.full((len(course), len(found.layers)), math.nan) for name in _LAYERED}
    for name, array in many.items():
        array[rows] = found[NAMES.get(name, name)]
    lines = {"course_coating": found.coating, "course_yield_load_factor": found.load_factor}
    single = {name: np.full(len(course), math.nan) for name in lines}
    for name, line in single.items():
        line[rows] = lines[name]
    columns = {f"course_{name}": array for name, array in many.items()}
    return {"wear_layer": np.array(found.layers, object), **single, **columns}


_LAYERED = tuple(item.name.removeprefix("course_") for item in STRESS_COLUMNS if len(item.dims) == 2)


def along_layers(values: Mapping[str, Any], facts: Mapping[str, Any]) -> WornStresses | None:
    """The stresses as it wears of stored ``values``; None where there are none."""
    if "wear_layer" not in values:
        return None
    way = np.atleast_1d(np.asarray(values["course_cycles" if facts["fretting"] else "course_distance"], float))
    coating = np.atleast_1d(np.asarray(values["course_coating"], float))
    rows = np.flatnonzero(np.isfinite(coating))
    columns = {
        NAMES.get(name, name): np.asarray(values[f"course_{name}"], float).reshape(len(way), -1)[rows]
        for name in _LAYERED
    }
    layers = tuple(str(name) for name in np.atleast_1d(values["wear_layer"]))
    return WornStresses(way[rows], coating[rows], layers, columns, str(facts["criterion"]))


# In words and tables.


def yielding_text(values: Mapping[str, Any], facts: Mapping[str, Any]) -> tuple[str, bool]:
    """Which layer yields from where to where, and whether one does."""
    found = along_layers(values, facts)
    if found is None or not np.isfinite(found["utilisation"]).any():
        return "", False
    texts = []
    for layer, name in enumerate(found.layers):
        text = _when(found, layer, facts)
        texts += [f"{name} yields {text}"] if text else []
    if texts:
        return f"As it wears: {'; '.join(texts)}.", True
    row, column = np.unravel_index(int(np.nanargmax(found["utilisation"])), found["utilisation"].shape)
    used = times(float(found["utilisation"][row, column]), 3)
    where = f"in {found.layers[int(column)]} {_after(float(found.way[row]), facts)}"
    return f"As it wears no part of known strength yields: at most {used} times the yield stress, {where}.", False


def _when(found: WornStresses, layer: int, facts: Mapping[str, Any]) -> str:
    """From where to where a ``layer`` yields; empty where it does not."""
    if not found.yields[:, layer].any():
        return ""
    begins, ends = found.yields_from(layer), found.yields_until(layer)
    first = begins <= float(found.way[0])
    if math.isinf(ends):
        return "all the way" if first else f"from {_way(begins, facts)} on"
    gone = np.isnan(found["von_mises"][-1, layer])
    last = f"until {'it is gone after ' if gone else ''}{_way(ends, facts)}"
    return last if first else f"from {_way(begins, facts)} {last}"


def _way(way: float, facts: Mapping[str, Any]) -> str:
    return f"{way:.3g} cycles" if facts["fretting"] else show(way, "m", 3)


def _after(way: float, facts: Mapping[str, Any]) -> str:
    return f"after {_way(way, facts)}" if way > 0.0 else "at the start"


def stress_table(values: Mapping[str, Any], facts: Mapping[str, Any]) -> Table:
    """Largest stresses of each layer at first and in the end, and when it yields."""
    found, cells = along_layers(values, facts), []
    for layer, name in enumerate(() if found is None else found.layers):
        assert found is not None
        stress, tension, used = (found[name][:, layer] for name in ("von_mises", "tension", "utilisation"))
        known = bool(np.isfinite(used).any())
        cells.append(
            (
                name,
                _pair(stress[0], stress[-1]),
                _pair(tension[0], tension[-1]),
                f"{np.fmax.reduce(used):.3g} {_after(float(found.way[np.nanargmax(used)]), facts)}"
                if known
                else "not known",
                (_when(found, layer, facts) or "no") if known else "not known",
            )
        )
    heads = ("Layer", "Largest von Mises stress", "Largest tension", "Most of the yield stress", "Yields")
    return Table(heads, tuple(cells))


def _pair(first: float, last: float) -> str:
    """A stress at first and in the end, of which the layer may be gone."""
    return f"{show(float(first), 'Pa', 3)} → {show(float(last), 'Pa', 3) if math.isfinite(last) else 'gone'}"


def stress_rows(values: Mapping[str, Any], facts: Mapping[str, Any]) -> Rows:
    """With what the stresses are computed."""
    found = along_layers(values, facts)
    if found is None:
        return []
    rows: Rows = [("criterion of yield as it wears", found.criterion)]
    if found.coating[0] > 0.0:
        rows.append(
            ("coating in the stresses", f"{show(found.coating[0], 'm', 3)} → {show(found.coating[-1], 'm', 3)}")
        )
    return rows


EVEN = (
    "Stresses as it wears are those of a coating of one thickness, the mean of what is left under the pressure; depths "
    "count from the worn surface."
)
"""What they are computed with."""
