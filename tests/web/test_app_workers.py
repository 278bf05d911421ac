"""Workers of the application end at their limits, and what the pages show of hostile text is
text."""

from __future__ import annotations

import asyncio
import json
import os
import signal
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from refusals import refused

pytest.importorskip("nicegui", reason="the extra web is not installed")

from asperity.core.errors import InputError, OutputError
from asperity.io.schemas.surfaces import SURFACE_TABLES
from asperity.physics.stress.part import StressSettings
from asperity.web.draft import Draft, forms_of
from asperity.web.drawing import drawn, stack_of
from asperity.web.forms import asked_of
from asperity.web.resolved import Materials
from asperity.web.session import Place, Session
from asperity.web.workers import Limits, Worker

SURFACE = {"kind": "flat", "points": "16x16", "size": "1 um x 1 um"}


def preview(folder: Path, **more: Any) -> dict[str, Any]:
    return {"table": SURFACE | more, "steps": None, "folder": str(folder), "out": str(folder / "map.bin")}


def answer(limits: Limits, task: dict[str, Any], then: Any = None) -> list[dict[str, Any]]:
    """Answers of one worker to a task, and again after what ``then`` does to its process."""

    async def work() -> list[dict[str, Any]]:
        worker = Worker(limits, 1)
        try:
            found = [await worker.call("surface", **task)]
            if then is not None:
                call = asyncio.create_task(
                    worker.call("surface", **task | {"table": {**SURFACE, "points": "6000x6000"}})
                )
                await asyncio.sleep(0.15)
                then(worker)
                found += [await call, await worker.call("surface", **task)]
            return found
        finally:
            await worker.end()
            await asyncio.sleep(0.2)

    with ThreadPoolExecutor(1) as thread:  # the loop of Playwright may be running in this one
        return thread.submit(lambda: asyncio.run(work())).result()


@pytest.mark.slow
def test_a_worker_that_is_killed_or_cancelled_is_replaced(tmp_path: Path) -> None:
    def kill(worker: Worker) -> None:
        assert worker._process is not None
        os.kill(worker._process.pid, signal.SIGKILL)

    for end, word in ((kill, "signal 9"), (Worker.cancel, "Cancelled")):
        first, lost, again = answer(Limits.usual(), preview(tmp_path), end)
        assert first["full"] == again["full"] == [16, 16]
        assert word in lost["error"]


@pytest.mark.slow
def test_an_answer_that_nobody_waits_for_any_more_is_not_that_of_the_next_task(tmp_path: Path) -> None:
    """A page that is closed gives up what it asked for; another one of the same session asks on."""

    async def work() -> list[dict[str, Any]]:
        worker, found = Worker(Limits.usual(), 1), []
        task = preview(tmp_path)
        try:
            for points, delay in (("1000x1000", 0.0), ("2000x2000", 0.1), ("1000x1000", 1.0)):
                call = asyncio.create_task(worker.call("surface", **preview(tmp_path, points=points)))
                await asyncio.sleep(delay)
                call.cancel()
                found.append(await worker.call("surface", **task))
            return found
        finally:
            await worker.end()
            await asyncio.sleep(0.2)

    with ThreadPoolExecutor(1) as thread:
        answers = thread.submit(lambda: asyncio.run(work())).result()
    assert [each["full"] for each in answers] == [[16, 16]] * 3


@pytest.mark.slow
def test_limits_of_memory_and_time_are_sentences(tmp_path: Path) -> None:
    large = preview(tmp_path, points="9000x9000")
    assert "memory" in answer(Limits(4e8, 60.0), large)[0]["error"].lower()
    assert "--time-limit" in answer(Limits(float("inf"), 0.05), preview(tmp_path))[0]["error"]


def test_what_an_entry_shows_is_what_its_declaration_reads() -> None:
    """Values of a document as lists come back from their text in the form."""
    rough = {item.name: item for item in asked_of(SURFACE_TABLES["rough"])}
    assert rough["points"].text_of([256, 128]) == "256x128"
    assert rough["points"].problem("256x128") is None
    assert "points" in str(rough["points"].problem("256, 128")).lower()
    crop = {item.name: item for item in asked_of((rough["prepare"].tables or {})["crop"])}
    shown = crop["x"].text_of(["0 um", "5 um"])
    assert crop["x"].problem(shown) is None
    stress = {item.name: item for item in asked_of(StressSettings)}
    assert stress["depths"].problem(stress["depths"].text_of(["1 nm", "5 nm"])) is None
    assert "nm" in str(stress["depths"].problem("1, 5 nm"))


HOSTILE = (
    "<script>alert(1)</script>",
    '"><img src=x onerror=alert(1)>',
    "]]></svg><svg onload=alert(1)>",
    "'''\nEND_OF_DOCUMENT\nrm -rf ~",
)


def test_hostile_materials_are_drawn_as_text(tmp_path: Path) -> None:
    for text in HOSTILE:
        graded = {"kind": "linear", "top": text, "bottom": {"name": text}, "thickness": "1e300 m"}
        body = {
            "layers": [{"material": text, "thickness": text}, {"name": text, "thickness": "5 nm"}, graded],
            "base": {"name": text},
        }
        for item in (body, text, {"material": text}, {"layers": [text], "base": text}, [text], {"layers": text}):
            shown = drawn(stack_of(item, Materials(tmp_path)), "body")
            assert "<script" not in shown
            assert "<img" not in shown
            assert shown.count("<svg") == 1


def test_hostile_text_stays_within_its_quotes_when_it_is_copied() -> None:
    for text in HOSTILE:
        table = {"version": 2, "title": text, "surface": SURFACE, "body": {"material": text}}
        forms = forms_of(table, {})
        code = compile(forms.python, "copied", "exec").co_consts
        assert any(text == constant or (isinstance(constant, tuple) and text in constant) for constant in code)
        assert forms.command.splitlines().count("END_OF_DOCUMENT") == 1
        assert forms.command.splitlines()[-2:] == ["END_OF_DOCUMENT", forms.command.splitlines()[-1]]


def test_files_are_called_by_what_their_owner_knows() -> None:
    table = {"version": 2, "surface": {"kind": "file", "path": "/private/0123.di"}}
    forms = forms_of(table, {"/private/0123.di": "scan.di"})
    for text in (forms.python, forms.command, forms.document):
        assert "scan.di" in text
        assert "/private" not in text


def test_changes_are_undone_and_done_again() -> None:
    draft = Draft()
    draft.set(("body", "layers", 0, "thickness"), "5 nm")
    draft.set(("body", "layers", 1, "thickness"), "7 nm")
    assert draft.get("body", "layers", 1, "thickness") == "7 nm"
    draft.set(("body", "layers", 0), None)
    assert draft.get("body", "layers") == [{"thickness": "7 nm"}]
    for _ in range(5):
        draft.undo()
    assert draft.table == {"version": 2}
    for _ in range(5):
        draft.redo()
    assert draft.get("body", "layers") == [{"thickness": "7 nm"}]
    assert any("surface" in line for line in draft.problems())


def test_a_session_moves_into_a_folder_and_comes_back_from_it(tmp_path: Path) -> None:
    (tmp_path / "private").mkdir()
    session = Session(tmp_path / "private", Limits.usual(), 1, kept=False)
    path = session.add_file("scan.txt")
    path.write_text("1 2\n3 4\n", encoding="utf-8")
    session.draft.set(("surface",), {"kind": "file", "path": str(path)})
    run = session.new_run("run", "first", session.draft.table)
    with refused(InputError, "session"):
        session.save_as(tmp_path / "kept")
    run.state = "done"
    session.folder_of(run).mkdir()
    (session.folder_of(run) / "report.html").write_text("report", encoding="utf-8")
    session.save_as(tmp_path / "kept")
    moved = str(session.draft.get("surface", "path"))
    assert moved.startswith(str(tmp_path / "kept"))
    assert session.labels == {moved: "scan.txt"}
    assert str(tmp_path) not in json.dumps(
        json.loads((tmp_path / "kept" / "session.json").read_text(encoding="utf-8"))["files"]
    )
    session.close()
    (tmp_path / "kept").rename(tmp_path / "elsewhere")
    again = Session(tmp_path / "elsewhere", Limits.usual(), 1, kept=True)
    again.reopen()
    assert Path(str(again.draft.get("surface", "path"))).read_text(encoding="utf-8") == "1 2\n3 4\n"
    assert again.given_out(run.key).keys() == {"report.html"}
    with refused(OutputError, "folder of a session"):
        again.save_as(tmp_path / "elsewhere")


def test_folders_of_others_stay_within_the_working_folder(tmp_path: Path) -> None:
    place = Place(tmp_path / "p", Limits.usual(), 1, 1, roots=(tmp_path / "work",))
    assert place.allowed(str(tmp_path / "work" / "a")) == tmp_path / "work" / "a"
    for text in ("/etc", str(tmp_path / "work" / ".." / "x"), ""):
        with refused(InputError, "folder of a session"):
            place.allowed(text)
