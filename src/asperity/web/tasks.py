"""What workers do for the pages: plain values in, plain values and files out. A failure is an
answer with the key ``error``."""

from __future__ import annotations

import base64
import contextlib
import importlib.util
import math
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from pydantic import ValidationError, create_model

from ..core.errors import AsperityError
from ..core.settings import Settings, validated
from ..core.units import prefixed, show
from ..core.words import speaking
from ..io.atomic import atomic_folder
from ..io.export import export_vtk
from ..io.results import document_in
from ..io.schemas.surfaces import SurfaceTable
from ..io.words import surface_rows
from ..physics.stress.part import Stress, StressSettings, stress_request
from ..plots.picture import Figure, colour_table, encoded
from ..plots.profile import profile_figures
from ..plots.surface import roughness_figures
from ..plots.together import save_pictures
from ..report.folder import ALL_NAMES, write_run
from ..report.profile import profile_headline, profile_rows, write_profile_report
from ..report.roughness import headline_values, quantity_rows, write_roughness_report
from ..report.scans import ScansInWords, write_page_of_scans
from ..run.archive import carried
from ..run.build import build
from ..run.document import load_document, loads
from ..run.execute import Outcome, analysed, execute
from ..run.refusals import refusals
from ..run.stored import load_outcome
from ..studies.campaign import prepare_study
from ..surfaces.characterise.heights import height_parameters, peak_to_valley, rms_height
from ..surfaces.characterise.summary import characterise
from ..surfaces.profile import Profile
from ..surfaces.profile_summary import characterise_profile
from ..surfaces.read import channels
from ..surfaces.scans import Scans
from ..surfaces.surface import Surface
from .draft import Keys, place_in
from .previews import built, cutoffs, kept, stages, thinned
from .progress import Reported, Watch
from .views import Views, theory_curves

Task: TypeAlias = Mapping[str, Any]


def guarded(work: Callable[[Task], dict[str, Any]]) -> Callable[[Task], dict[str, Any]]:
    """``work`` under the limit of memory, whose failures are answers."""

    def call(task: Task) -> dict[str, Any]:
        _limit(task.get("memory"))
        try:
            with warnings.catch_warnings(), np.errstate(all="ignore"), speaking("form"):
                warnings.simplefilter("ignore")
                return work(task)
        except AsperityError as error:
            place = {"place": error.place} if error.place else {}
            return {"error": prefixed(str(error)), "kind": type(error).__name__, **place}
        except MemoryError:
            return {"error": "Not enough memory: crop the surface or resample it to fewer points."}
        except Exception as error:
            return {"error": f"Internal error, {type(error).__name__}: {' '.join(str(error).split())[:300]}"}

    return call


def _limit(memory: float | None) -> None:
    """Keep the data of this process below ``memory`` bytes, where systems can."""
    if memory is None or importlib.util.find_spec("resource") is None:
        return
    import resource

    _, hard = resource.getrlimit(resource.RLIMIT_DATA)
    wanted = int(memory) if hard == resource.RLIM_INFINITY else min(int(memory), hard)
    resource.setrlimit(resource.RLIMIT_DATA, (wanted, hard))


REPORT = ("roughness.html", "Report of the roughness")
"""Name and title of the page that is always there."""

# Files with heights, and surfaces on their way through the steps of preparation.


@guarded
def inspect(task: Task) -> dict[str, Any]:
    """Channels of the file at ``path``, and what it does not say itself."""
    found = []
    for item in channels(task["path"]):
        size = "" if item.size is None else f", {' × '.join(show(side, 'm', 3) for side in item.size)}"
        text = f"{item.name or item.index}: {' × '.join(map(str, item.shape))} points{size}"
        found.append({"index": item.index, "name": item.name, "text": text})
    return {"channels": found}


@guarded
def surface(task: Task) -> dict[str, Any]:
    """The surface of the document ``table`` after ``steps`` of its preparation, as a picture in
    numbers at ``out``, all its heights beside it.

    With ``since``, the number of steps before those that are looked at, also what these do, and
    instead of the surface after them that before, or the heights removed, as ``show`` says.
    """
    since, out, told = task.get("since"), Path(task["out"]), dict[str, Any]()
    shown: Surface | None
    if since is None:
        shown = _built(task)
    elif task["show"] == "before":  # it is there, whatever is wrong with what comes after
        shown = _built({**task, "steps": since})
        with contextlib.suppress(AsperityError):
            told = {"cutoffs": cutoffs(shown, _table(task).prepare[since:])}
    else:
        table = _table(task)
        found = stages(table, Path(task["folder"]), since, len(table.prepare))
        told = {"words": found.words(), "cutoffs": dict(found.cutoffs)}
        shown = found.removed if task["show"] == "removed" else found.after
    if shown is None:
        return {"nothing": told["words"]}
    heights = np.asarray(shown.heights, dtype=float)
    thin, step = thinned(heights)
    out.write_bytes(np.ascontiguousarray(thin.T).tobytes())
    kept(heights, out.with_suffix(".npy"))
    return {
        "shape": list(thin.shape),
        "full": list(heights.shape),
        "spacing": [step * spacing for spacing in shown.grid.spacing],
        "pixel": list(shown.grid.spacing),
        "size": list(shown.size),
        "step": step,
        "missing": shown.n_missing,
        "rows": [[str(label), str(text)] for label, text in surface_rows(shown)],
        "history": [str(text) for text in shown.origin.history],
        "Sq": rms_height(shown),
        "Sz": peak_to_valley(shown),
        **told,
    }


def _built(task: Task) -> Any:
    """The surface of ``table``, prepared by the first ``steps`` of its steps, or all."""
    return built(_table(task), Path(task["folder"]))


def _table(task: Task) -> Any:
    """``table`` of a surface, checked, with the first ``steps`` of its steps, or all."""
    table = dict(task["table"])
    if task.get("steps") is not None:
        table["prepare"] = list(table.get("prepare", ()))[: task["steps"]]
    alone: Any = create_model("Alone", __base__=Settings, surface=(SurfaceTable, ...))
    try:
        return validated(alone, {"surface": table}, "surface").surface
    except AsperityError as error:
        with contextlib.suppress(StopIteration):
            error.place = ".".join(map(str, next(_wrong(alone, table))))
        raise


def _wrong(alone: Any, table: dict[str, Any]) -> Iterator[Keys]:
    """Keys of the ``table`` of a surface at which something is wrong."""
    try:
        alone.model_validate({"surface": table})
    except ValidationError as error:
        for detail in error.errors(include_url=False, include_input=False):
            yield place_in(table, detail["loc"][1:])


@guarded
def glance(task: Task) -> dict[str, Any]:
    """A small picture of the surface of the first of ``tables`` that can be read, of so many
    ``points`` along its longer side, with its size; colours go between ``ends`` in m, if given, or
    to its own. With ``measured`` the numbers that people look for first."""
    first, *others = task["tables"]
    try:
        found, needed = _built({**task, "table": first}), False
    except AsperityError:
        if not others:
            raise
        found, needed = _built({**task, "table": others[0]}), True
    heights = np.asarray(found.heights, dtype=float) - float(np.nanmean(found.heights))
    step = max(1, math.ceil(max(heights.shape) / task["points"]))
    thin = heights[::step, ::step]
    low, high = task.get("ends") or (float(np.nanmin(thin)), float(np.nanmax(thin)))
    told: dict[str, Any] = {"ends": [float(np.nanmin(thin)), float(np.nanmax(thin))], "needed": needed}
    picture = _drawn_line(thin[:, 0], low, high) if heights.shape[1] == 1 else _drawn_map(thin, low, high)
    told |= {"picture": picture, "Sq": height_parameters(found).Sq}
    points = " × ".join(str(n) for n in heights.shape if n > 1)
    size = " × ".join(show(side, "m", 3) for side, n in zip(found.size, heights.shape, strict=True) if n > 1)
    told["text"] = f"{points} points, {size}"
    if task.get("measured"):
        line = heights.shape[1] == 1
        words = profile_headline(characterise_profile(found.row(0))) if line else headline_values(characterise(found))
        told["headline"] = [[name, text] for name, text in words]
    return told


def _drawn_map(heights: Any, low: float, high: float) -> str:
    """PNG of ``heights`` (nx, ny) as an address of data, y up."""
    share = (np.nan_to_num(heights, nan=low) - low) / ((high - low) or 1.0)
    colours = np.frombuffer(colour_table("cividis"), np.uint8).reshape(256, 3)
    pixels = colours[np.clip(255.0 * share, 0, 255).astype(np.uint8).T[::-1]]
    return f"data:image/png;base64,{base64.b64encode(encoded(pixels, 96.0)).decode('ascii')}"


def _drawn_line(heights: Any, low: float, high: float) -> str:
    """Curve of the ``heights`` of a line scan as an address of data."""
    along = np.linspace(1.0, 99.0, heights.size)
    up = 59.0 - 58.0 * (heights - low) / ((high - low) or 1.0)
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in zip(along, up, strict=True) if math.isfinite(y))
    line = f'<polyline points="{points}" fill="none" stroke="#00709a" stroke-width="1.2"/>'
    svg = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 60" width="320" height="192">{line}</svg>'
    return f"data:image/svg+xml;base64,{base64.b64encode(svg.encode()).decode('ascii')}"


@guarded
def roughness(task: Task) -> dict[str, Any]:
    """Roughness of the surface of ``table``: rows of the page, and the report and its pictures in
    the folder ``out``; of one generated from scans also what these are."""
    built, out = _built(task), Path(task["out"])
    if built.shape[1] == 1:
        return _line_scan(built.row(0), out)
    spectrum = getattr(_table(task), "spectrum", None)
    if getattr(spectrum, "kind", "") == "scans":
        told = _scans(spectrum, Path(task["folder"]), out)
        of_surface = _map(built, out)
        return of_surface | {key: told[key] + of_surface[key] for key in told}
    return _map(built, out)


def _map(built: Surface, out: Path) -> dict[str, Any]:
    """The same of a map."""
    found = characterise(built)
    figures = roughness_figures(found)
    page = _page(out, figures, headline_values(found), quantity_rows(found))
    write_roughness_report(found, out / REPORT[0], figures=figures, overwrite=True)
    return page


def _scans(spectrum: Any, folder: Path, out: Path) -> dict[str, Any]:
    """The same of the scans of a ``spectrum``, whose relative paths start at ``folder``."""
    scans = Scans(item.scan(folder) for item in spectrum.scans)
    told = ScansInWords(scans, scans.spectrum(corner=spectrum.corner))
    figures = tuple(replace(figure, name=f"scans_{figure.name}") for figure in told.figures())
    save_pictures(figures, out, overwrite=True)
    write_page_of_scans(told, out / "one_surface.html", figures=figures, overwrite=True)
    bands = told.bands()
    rows = [
        [row[0], ", ".join(map(" ".join, zip(bands.headings[1:], row[1:], strict=True))), ""] for row in bands.cells
    ]
    return {
        "reports": [["one_surface.html", "Report of the scans"]],
        "groups": [
            ["Spectrum of the scans", [[name, text, ""] for name, text in told.main_rows()]],
            ["Reliable waves of the scans", rows],
            ["Findings of the scans", [[item.criterion, item.message, item.level] for item in told.findings]],
        ],
        "figures": [[figure.name, figure.title, figure.caption] for figure in figures],
    }


def _line_scan(profile: Profile, out: Path) -> dict[str, Any]:
    """The same of a line scan."""
    found = characterise_profile(profile)
    figures = profile_figures(found)
    page = _page(out, figures, profile_headline(found), profile_rows(found))
    write_profile_report(found, out / REPORT[0], figures=figures, overwrite=True)
    return page


def _page(out: Path, figures: Sequence[Figure], headline: Iterable[Any], groups: Iterable[Any]) -> dict[str, Any]:
    """What the page on a roughness shows; its pictures are written into the folder ``out``."""
    save_pictures(figures, out, overwrite=True)
    return {
        "reports": [REPORT],
        "headline": [[name, text] for name, text in headline],
        "groups": [[title, [list(row) for row in rows]] for title, rows in groups],
        "figures": [[figure.name, figure.title, figure.caption] for figure in figures],
    }


# The contact itself: the one executor, and the folder that it leaves.


@guarded
def refused(task: Task) -> dict[str, Any]:
    """What the complete document ``table``, whose paths start at ``folder``, would be refused for
    before it is solved: place and text of each."""
    return {"refused": [list(item) for item in refusals(task["table"], Path(task["folder"]))]}


@guarded
def contact(task: Task) -> dict[str, Any]:
    """Run the document at ``document``, whose paths start at ``folder``, as ``asperity contact``
    does, into the folder ``out``; what the page of the run shows comes before the files."""
    base, out, views = Path(task["folder"]), Path(task["out"]), Views(Path(task["views"]))
    document = load_document(task["document"])
    watch = Watch(Path(task["progress"]), views.maps)
    with watch.stage("reading and preparing"):
        case = build(document, base)
    watch.steps = len(case.path)
    with atomic_folder(out) as folder:
        outcome = execute(case, stage=watch.stage, reached=watch.reached)
        with watch.stage("making it explorable"):
            views.page(outcome)
        with watch.stage("writing report and pictures"):
            found = carried(document, base, folder, ALL_NAMES, within=base)
            write_run(outcome, folder, found)
    with watch.stage("planes in the body"):
        views.planes(outcome)
        views.end()
    return {"converged": outcome.converged, "message": outcome.status.message, "remedy": outcome.status.remedy}


@guarded
def views(task: Task) -> dict[str, Any]:
    """What the page of a run shows, made again from its ``result``; with ``stresses`` in the body
    if these were not asked for."""
    outcome = load_outcome(task["result"])
    if task.get("stresses"):
        outcome = _stressed(outcome, task)
    again = "stress" in outcome.found and not task.get("stresses")  # a file keeps no fields at other depths
    Views(Path(task["views"])).page_first(outcome, lambda: _stressed(outcome, task) if again else outcome)
    return {}


def _stressed(outcome: Outcome, task: Task) -> Outcome:
    """The ``outcome`` in the file ``result`` with stresses in the body, computed now."""
    document = loads(str(document_in(task["result"])))
    settings: Any = getattr(document, "stress", None) or StressSettings()
    request = stress_request(settings, getattr(document, "friction"))  # noqa: B009
    Stress().at_work.check(request, outcome.result.problem)
    more = analysed(outcome.result, {"stress": request, "yielding": True}, outcome.path)
    return replace(more, found={**outcome.found, **more.found}, findings=outcome.findings)


@guarded
def theories(task: Task) -> dict[str, Any]:
    """Theories beside the numerical solution of the surfaces in the file ``result``."""
    return theory_curves(load_outcome(task["result"]).result.problem, Path(task["views"]))


@guarded
def vtk(task: Task) -> dict[str, Any]:
    """The fields of the file ``result`` as a VTK file ``out``."""
    export_vtk(load_outcome(task["result"]).result, task["out"], overwrite=True)
    return {}


@guarded
def study(task: Task) -> dict[str, Any]:
    """Run or resume the study ``table`` in the folder ``out``; its curves can be read while it
    grows."""
    file = Path(task["progress"])

    class Counted:
        def update(self, done: int, failed: int, found: int, total: int) -> None:
            text = f"{found + done} of {total} cases" + (f", {failed} failed" if failed else "")
            Reported("cases", (found + done) / max(total, 1), text).write(file)

    campaign = prepare_study(task["table"], task["out"], start=Path(task["folder"]))
    campaign.run(workers=task.get("workers"), watch=Counted())
    state = campaign.state()
    return {"done": state.done, "failed": state.failed, "missing": state.missing}
