"""What the page of a run shows, as files: the scene of its maps with an array for each, the surface
in space, spots, words, theories.

The page can be opened while the run goes on: a scene is written as soon as there is a step to show,
arrays follow on a thread of their own, those first that are shown first.
"""

from __future__ import annotations

import base64
import json
import math
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from ..contact.measure import labelled
from ..contact.problem import ContactProblem
from ..contact.result import ContactResult
from ..core.arrays import RealArray
from ..io.atomic import atomic_file
from ..io.words import HEADLINE, certificate_rows, result_rows
from ..parts.part import Solved
from ..physics.stress.figures import map_figure
from ..plots.comparison import nearest, within_limits
from ..plots.contact import contact_figures
from ..plots.picture import Figure
from ..report.blocks import reduced
from ..report.comparison import comparison_sentence
from ..report.scene import Stored, contact_scene
from ..report.write import where
from ..run.execute import Outcome
from ..run.verdict import verdict
from ..studies.compare import compare

SCENE, SHOWN, THEORIES = ".maps.json", ".page.json", ".curves.json"
"""Endings of the files; each is named after the run."""

ARRAYS = ".arrays"
"""Ending of the folder of what is fetched when it is shown."""

SPACE = "space.json"
"""The surface in space, in that folder."""

PLANES = 12
"""Planes in the body that are computed for the slider through the depth."""

IN_SPACE = 220
"""Points along the longer side of the surface in space."""

MOST_SPOTS = 300
"""Rows of the table of contact spots, the largest first."""


def spots_file(step: int) -> str:
    """Name of the file with the spots of a ``step``; 0 where there is but one load."""
    return f"spots-{step}.json"


class Views:
    """Writes what the page of a run shows to files whose names begin with ``views``; a store of a
    scene."""

    def __init__(self, views: Path) -> None:
        self._views, self._pool = views, ThreadPoolExecutor(1)
        self._folder = views.with_name(views.name + ARRAYS)
        self._folder.mkdir(parents=True, exist_ok=True)
        self._asked: dict[str, Future[None]] = {}

    def array(self, name: str, make: Callable[[], Stored]) -> dict[str, Any]:
        """Entry of the array ``name``, which ``make`` gives in its turn."""
        self._later(name, partial(_write_array, make, self._folder / name))
        return {"url": name}

    def maps(self, solved: Solved, figures: Iterable[Figure] | None = None) -> dict[str, Any]:
        """Write the scene of a ``solved`` contact from its ``figures``, by default those of the
        contact itself; the steps of its slider."""
        shown = contact_figures(solved.at().result) if figures is None else figures
        made = contact_scene(solved, shown, store=self)
        steps = (made or {}).get("steps") or {"numbers": [0], "first": 0, "texts": [""]}
        _write(self._views.with_name(self._views.name + SCENE), made)
        return steps

    def page(self, outcome: Outcome) -> None:
        """Write scene and words of an ``outcome``; the surface in space follows."""
        steps = self.maps(outcome.solved, outcome.all_figures)
        first, decisive = steps["numbers"][steps["first"]], outcome.solved.at().result
        self._later(SPACE, lambda: _write(self._folder / SPACE, _in_space(decisive)))
        for number in sorted(steps["numbers"], key=lambda number: abs(number - first)):
            result = outcome.solved.at(number or "peak").result
            self._later(spots_file(number), partial(_write_spots, result, self._folder / spots_file(number)))
        shown = {
            "places": steps["numbers"],
            "step": steps["first"],
            "step_texts": steps["texts"],
            "stressed": "stress" in outcome.found,
            **_words(outcome),
        }
        _write(self._views.with_name(self._views.name + SHOWN), shown)

    def planes(self, outcome: Outcome) -> None:
        """Write the scene of an ``outcome`` again, with planes at depths of its survey of
        stresses."""
        if more := list(_planes(outcome)):
            self.maps(outcome.solved, [*outcome.all_figures, *more])

    def page_first(self, outcome: Outcome, whole: Callable[[], Outcome]) -> None:
        """The ``page`` of an ``outcome``; the ``planes`` of the ``whole`` one follow in their turn,
        after which nothing more may be asked for."""
        self.page(outcome)
        self._pool.submit(self._rest, whole)

    def _rest(self, whole: Callable[[], Outcome]) -> None:
        self.planes(whole())
        self._pool.shutdown(wait=False)

    def _later(self, name: str, work: Callable[[], None]) -> None:
        """Do ``work``, which writes the file ``name``, unless it is there, after what was asked for
        before."""
        if name not in self._asked and not (self._folder / name).is_file():
            self._asked[name] = self._pool.submit(work)

    def end(self) -> None:
        """Wait until everything is written.

        Raises
        ------
        Exception
            Whatever has kept one of them from being written.
        """
        self._pool.shutdown()
        for asked in self._asked.values():
            asked.result()


def _write_array(make: Callable[[], Stored], file: Path) -> None:
    """A line of JSON with what the array is, and its numbers, to ``file``."""
    about, numbers = make()
    with atomic_file(file, overwrite=True) as partial_file, partial_file.open("wb") as target:
        target.write(json.dumps(about, allow_nan=False).encode("ascii") + b"\n")
        target.write(numbers.astype(numbers.dtype.newbyteorder("<"), copy=False).tobytes())


def _write_spots(result: ContactResult, file: Path) -> None:
    _write(file, _spots(result))


def _in_space(result: ContactResult) -> dict[str, Any]:
    """Heights, pressure and plastic state of blocks of points, single precision, rows of y."""
    heights = np.asarray(result.problem.surface.heights, dtype=float)
    block = max(1, math.ceil(max(heights.shape) / IN_SPACE))
    state = result.contact.astype(float) + result.plastic
    fields = {"height": (heights, "mean"), "pressure": (result.pressure, "max"), "plastic": (state, "max")}
    space: dict[str, Any] = {"block": block, "cell": [block * side for side in result.problem.grid.spacing]}
    for name, (values, how) in fields.items():
        rows = np.ascontiguousarray(reduced(np.asarray(values, float), block, how).T, dtype="<f4")
        space[name] = base64.b64encode(rows.tobytes()).decode("ascii")
        space["shape"] = list(rows.shape)
    return space


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
    with atomic_file(file, overwrite=True) as partial_file:
        partial_file.write_text(json.dumps(content, allow_nan=False), encoding="utf-8")


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
