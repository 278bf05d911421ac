"""What the page of a run shows, as files beside its folder: the scene of its maps, the surface in
space, spots, words, theories."""

from __future__ import annotations

import base64
import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Literal

import numpy as np

from ..contact.measure import labelled
from ..contact.problem import ContactProblem
from ..contact.result import ContactResult
from ..core.arrays import RealArray
from ..io.words import HEADLINE, certificate_rows, result_rows
from ..physics.stress.figures import map_figure
from ..plots.comparison import nearest, within_limits
from ..plots.picture import Figure
from ..report.comparison import comparison_sentence
from ..report.scene import reduced, scene_of
from ..report.write import where
from ..run.execute import Outcome
from ..run.verdict import verdict
from ..studies.compare import compare

SCENE, SHOWN, THEORIES = ".maps.json", ".page.json", ".curves.json"
"""Endings of the files; each is named after the folder of its run."""

BUDGET = 40_000_000
"""Characters of all arrays of a scene, which travel within this machine only."""

PLANES = 12
"""Planes in the body that are computed for the slider through the depth."""

IN_SPACE = 220
"""Points along the longer side of the surface in space."""

MOST_SPOTS = 300
"""Rows of the table of contact spots, the largest first."""


def write_views(outcome: Outcome, views: Path) -> None:
    """Write scene, surface in space, spots and words of ``outcome`` to files whose names begin with
    ``views``."""
    scene = scene_of(outcome, more=_planes(outcome), budget=BUDGET)
    _write(views.with_name(views.name + SCENE), scene)
    result = outcome.solved.at().result
    # in space: heights, pressure and plastic state of blocks of points, single precision, rows of y
    heights = np.asarray(result.problem.surface.heights, dtype=float)
    block = max(1, math.ceil(max(heights.shape) / IN_SPACE))
    state = result.contact.astype(float) + result.plastic
    fields = {"height": (heights, "mean"), "pressure": (result.pressure, "max"), "plastic": (state, "max")}
    space: dict[str, Any] = {"block": block, "cell": [block * side for side in result.problem.grid.spacing]}
    for name, (values, how) in fields.items():
        rows = np.ascontiguousarray(reduced(np.asarray(values, float), block, how).T, dtype="<f4")
        space[name] = base64.b64encode(rows.tobytes()).decode("ascii")
        space["shape"] = list(rows.shape)
    steps = scene["steps"] if scene else None
    numbers: list[int | Literal["peak"]] = steps["numbers"] if steps else ["peak"]
    shown = {
        "space": space,
        "spots": [_spots(outcome.solved.at(number).result) for number in numbers],
        "step": steps["first"] if steps else 0,
        "step_texts": steps["texts"] if steps else [""],
        "stressed": "stress" in outcome.found,
        "steps": 0 if outcome.path is None else len(outcome.path.steps),
        **_words(outcome),
    }
    _write(views.with_name(views.name + SHOWN), shown)


def _spots(result: ContactResult) -> dict[str, Any]:
    """Their ``count``, and place of the largest pressure, area, load, mean and largest pressure of
    the largest contact spots of ``result``, SI."""
    grid, there = result.problem.grid, np.flatnonzero(result.contact)
    labels, count = labelled(result.contact, wraps=result.problem.boundary.wraps)
    pressure, spot, pixel = (
        np.asarray(result.pressure, float).ravel()[there],
        labels.ravel()[there],
        math.prod(grid.spacing),
    )
    sizes = np.bincount(spot, minlength=count + 1)[1:]
    loads = np.bincount(spot, pressure, minlength=count + 1)[1:] * pixel
    order = np.argsort(pressure)  # the last of a label is its largest
    tops = np.zeros(count + 1, dtype=np.intp)
    tops[spot[order]] = order
    rows = []
    for number in np.argsort(-sizes, kind="stable")[:MOST_SPOTS]:
        top = tops[number + 1]
        places = np.unravel_index(there[top], grid.shape)
        place = [float((index + 0.5) * side) for index, side in zip(places, grid.spacing, strict=True)]
        area, load = float(sizes[number] * pixel), float(loads[number])
        rows.append([*place, area, load, load / area, float(pressure[top])])
    return {"count": int(count), "rows": rows}


def _write(file: Path, content: Any) -> None:
    partial = file.with_suffix(".part")
    partial.write_text(json.dumps(content, allow_nan=False), encoding="utf-8")
    partial.replace(file)


def _planes(outcome: Outcome) -> Iterator[Figure]:
    """Planes at depths of the survey of stresses, beside those that the document asks for."""
    survey = outcome.found["stress"].detail if "stress" in outcome.found else None
    depths = getattr(survey, "depths", None)
    if survey is None or depths is None:
        return
    asked = np.array(survey.request.depths)
    free = np.array([depth for depth in depths if not np.isclose(depth, asked, rtol=1e-6, atol=0.0).any()])
    chosen = free[np.unique(np.linspace(0, free.size - 1, PLANES).round().astype(int))] if free.size else free
    for number, plane in enumerate(survey.planes(chosen), start=1):
        yield map_figure(plane, number, outcome.result.problem.boundary, step=survey.step)


def _words(outcome: Outcome) -> dict[str, Any]:
    """Findings, headline, results, certificate, and the words of every part."""
    reached, given = outcome.solved.at(), verdict(outcome)
    result = reached.result
    return {
        "verdict": [list(row) for row in given.rows],
        "grade": given.grade,
        "fails": given.fails,
        "at": reached.where,
        "status": [outcome.status.message, outcome.status.remedy, outcome.converged],
        "findings": [
            [item.level, item.criterion, item.message, item.remedy, item in given.others] for item in given.findings
        ],
        "points": list(result.problem.grid.shape),
        "cell": list(result.problem.grid.spacing),
        "headline": [list(row) for row in given.headline],
        "numbers": [[name, *_finite(np.array([getattr(result, name)], float))] for name in HEADLINE],
        "results": [list(row) for row in result_rows(result, given.doubted)],
        "certificate": [list(row) for row in certificate_rows(result)],
        "parts": [
            {
                "title": f"{part.title} at {at}" if (at := where(outcome, part)) else part.title,
                "sentence": words.sentence,
                "rows": [list(row) for row in words.rows],
                "tables": [[title, list(t.headings), [list(row) for row in t.cells]] for title, t in words.tables],
                "remarks": list(words.remarks),
            }
            for part, words in outcome.sections
        ],
    }


def theory_curves(problem: ContactProblem, views: Path) -> dict[str, Any]:
    """Area by pressure of the theories and of the numerical solution; written beside the run as
    well."""
    found = compare(problem)
    exact = found.numerical
    areas = {c.name: within_limits(c.prediction.area_fraction, c.valid, share=True) for c in found.curves}
    answer = {
        "sentence": comparison_sentence(found),
        "pressures": _finite(found.pressures),
        "exact": None if exact is None else _finite(exact.area_fraction_corrected),
        "theories": [[name, _finite(area)] for name, area in areas.items() if np.isfinite(area).any()],
        "nearest": list(nearest(found.dataset)),
        "left_out": [[item.name, item.reason] for item in found.left_out],
        "remarks": list(found.remarks),
    }
    _write(views.with_name(views.name + THEORIES), answer)
    return answer


def _finite(values: RealArray) -> list[float | None]:
    return [float(value) if np.isfinite(value) else None for value in np.asarray(values, float)]
