"""The page on which a problem is solved: what is missing, runs with their progress, cancelled and
repeated."""

from __future__ import annotations

import asyncio
from pathlib import Path
from types import MappingProxyType
from typing import Any

from nicegui import ui

from ..core.errors import AsperityError
from ..run.build import large_grid, stated_points
from ..run.document import save_document
from . import maps
from .draft import plain_name
from .layout import failure
from .progress import reported
from .refused import Refused
from .session import Run, Session
from .widgets import Context
from .workers import CANCELLED, Worker

STATES = {"running": "sync", "done": "check_circle", "cancelled": "block", "failed": "error"}
"""Icon of each state of a run."""


def start(session: Session, title: str) -> Run:
    """Begin a run of the document as it stands.

    Raises
    ------
    InputError
        If the document is incomplete or wrong.
    """
    document = session.draft.document()
    run = session.new_run("run", title, session.draft.table)
    file = session.scratch / f"{run.key}.toml"
    save_document(document, file, overwrite=True)
    task = {"document": str(file), "folder": str(session.folder), "views": str(session.views_of(run))}
    _begin(session, run, "contact", task)
    return run


def start_sweep(session: Session, title: str, table: dict[str, Any]) -> Run:
    """Begin the sweep of a study ``table``, whose relative paths start at the folder of a sweep."""
    run = session.new_run("sweep", title, table)
    study = {**table, "problem": session.named_from_sweeps(table["problem"])}
    _begin(session, run, "study", {"table": study, "folder": str(session.folder_of(run)), "workers": None})
    return run


def _begin(session: Session, run: Run, function: str, task: dict[str, Any]) -> None:
    """Give ``task`` to a worker of its own; it goes on whatever windows are closed."""
    worker = session.workers[run.key] = Worker(session.limits, session.threads)
    out, progress = str(session.folder_of(run)), str(session.progress_of(run))

    async def work() -> None:
        answer = await worker.run(function, **task, out=out, progress=progress)
        await worker.end()  # a worker serves one run
        session.workers.pop(run.key, None)
        if "error" in answer:
            run.state = "cancelled" if answer.get("cancelled") else "failed"
            run.message = session.said(answer["error"])
        else:
            run.state, run.converged = "done", bool(answer.get("converged", True))
            run.message = " ".join(filter(None, (answer.get("message", ""), answer.get("remedy", ""))))
        session.touched()

    session.tasks.append(asyncio.get_running_loop().create_task(work()))


def cancel(session: Session, run: Run) -> None:
    """Stop ``run``; what it has not finished is lost, and nothing else."""
    if (worker := session.workers.get(run.key)) is not None:
        worker.cancel()
        run.message = CANCELLED


def run_page(key: str, session: Session) -> None:
    """Problems of the document, the button that starts it, and all runs."""
    drawn: dict[str, str] = {}
    context = Context(session, lambda keys: None)

    def begin(*, explore: bool = False) -> None:
        try:
            run = start(session, str(session.draft.get("title") or "Contact"))
        except AsperityError as error:
            ui.notify(str(error), type="negative", multi_line=True)
            return
        if explore:
            ui.navigate.to(f"/s/{key}/explore?run={run.key}")
        else:
            runs.refresh()

    with ui.element("div").classes("two"):
        with ui.element("section"):
            ui.input(
                "Title",
                value=str(session.draft.get("title") or ""),
                on_change=lambda e: context.set(("title",), e.value or None),
            ).props("dense debounce=300 data-key=title").classes("wide")
            missing = session.draft.problems()
            if missing:
                ui.label("Before it can run").classes("table-title")
                for text in missing:
                    failure(text)
            else:
                ui.label("The document is complete.").classes("numbers complete")
                Refused(session).slot("")
                if large := large_grid(stated_points(session.draft.document().surface)):
                    failure(large)
            with ui.row():
                first = ui.button("Run", icon="play_arrow", on_click=lambda: begin()).props("no-caps data-run")
                watched = ui.button("Run and explore", icon="travel_explore", on_click=lambda: begin(explore=True))
                watched.props("no-caps outline data-run-explore")
                watched.tooltip("the maps are shown as soon as the first step is solved; the files follow")
            for button in (first, watched):
                button.set_enabled(not missing)
            minutes = session.limits.seconds / 60.0
            memory = (
                f"{session.limits.memory / 2**30:.3g} GiB of memory" if session.limits.memory < 2**60 else "all memory"
            )
            ui.label(f"All runs together may take {memory}, each of them {minutes:.4g} minutes.").classes("hint")
        with ui.element("section"):

            @ui.refreshable
            def runs() -> None:
                found = [run for run in session.runs.values() if run.kind == "run"]
                drawn.update({run.key: _stand(session, run) for run in found})
                if not found:
                    ui.label("Runs appear here; several may go on side by side.").classes("hint")
                for run in reversed(found):
                    run_card(key, session, run)

            runs()

            def look() -> None:
                if any(
                    drawn.get(run.key) != _stand(session, run) for run in session.runs.values() if run.kind == "run"
                ):
                    runs.refresh()

            ui.timer(0.3, look)


def _stand(session: Session, run: Run) -> str:
    """What the card of ``run`` depends on."""
    return f"{run.state} {session.explorable(run)}"


def run_card(key: str, session: Session, run: Run) -> None:
    """State of one run, with what can be done with it."""
    with ui.card().classes("table run").props(f'flat bordered data-run-key="{run.key}" data-state="{run.state}"'):
        with ui.row().classes("item-head"):
            ui.icon(STATES[run.state])
            ui.label(f"{run.key.split('-')[0]}  {run.title}").classes("table-title")
            ui.space()
            if run.state == "running":
                ui.button("Cancel", icon="stop", on_click=lambda: cancel(session, run)).props("no-caps flat dense")
            if session.explorable(run):
                target = f"/s/{key}/explore?run={run.key}"
                ui.button("Explore", on_click=lambda: ui.navigate.to(target)).props("no-caps dense")
            if run.state in ("cancelled", "failed"):
                ui.button("Take its document again", on_click=lambda: _again(session, run)).props("no-caps flat dense")
        if run.state == "running":
            progress(session, run)
        elif run.message:
            ui.label(run.message).classes("hint" if run.state == "done" and run.converged else "failure")
        if run.state == "done":
            downloads(key, session, run)


DOWNLOADS = MappingProxyType(
    {
        "report.html": "report",
        "result.nc": "result (NetCDF)",
        "scalars.csv": "scalars (CSV)",
        "path.csv": "load path (CSV)",
        "stress.csv": "stresses (CSV)",
        "problem.toml": "document",
    }
)
"""What a run leaves to be taken away, and what it is called."""


def downloads(key: str, session: Session, run: Run) -> None:
    """Links to everything that the run has left."""
    files = session.given_out(run.key)
    with ui.element("div").classes("downloads"):
        for name, text in DOWNLOADS.items():
            if name in files:
                target = f"/files/{key}/{run.key}/{name}"
                ui.link(text, target, new_tab=True).props("" if name == "report.html" else f'download="{name}"')
        if run.kind == "run":
            name = f"{plain_name(run.title) or 'contact'}.zip"
            link = ui.link("Share", f"/share/{key}/{run.key}").props(f'download="{name}" data-share')
            link.tooltip("document, scans and report in one archive, which asperity contact and this application open")
    pictures = [name for name in files if name.startswith("plots/")]
    with ui.expansion(f"Pictures ({len(pictures)})").classes("wide"), ui.element("div").classes("gallery"):
        for name in sorted(pictures):
            ui.image(f"/files/{key}/{run.key}/{name}").props(f'loading=lazy alt="{name[6:-4].replace("_", " ")}"')


def progress(session: Session, run: Run, *, curve: bool = True) -> None:
    """Bar and words on how far ``run`` is, and the area by the load as far as it is known."""
    bar = ui.linear_progress(0.0, show_value=False).props('size=8px aria-label="progress"')
    text = ui.label("starting a worker").classes("hint state").props('role="status"')
    box = ui.element("div").classes("wide").props("data-curve-so-far")
    drawn: list[Any] = []
    file: Path = session.progress_of(run)

    def look() -> None:
        state = reported(file)
        bar.value = state.share
        worker = session.workers.get(run.key)
        if worker is not None and worker.waiting:
            text.text = "waiting until another run is done"
        elif state.stage:
            text.text = state.in_words
        if not curve or len(state.curve) < 2:
            return
        figure = maps.area_by_load(state.curve)
        if drawn:
            drawn[0].update_figure(figure)
        else:
            with box:
                plot = ui.plotly(figure).classes("so-far").props('role="img" aria-label="contact area by pressure"')
                drawn.append(plot)

    known = 0

    def often() -> None:
        nonlocal known
        changed = file.stat().st_mtime_ns if file.is_file() else 0
        if changed != known or not known:
            known = changed
            look()

    ui.timer(0.4, often)


def _again(session: Session, run: Run) -> None:
    session.draft.replace(run.table)
    session.touched()
    ui.navigate.reload()
