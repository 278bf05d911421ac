"""Sessions that are kept: one application has a folder, what was done last is there again, and a
folder of somebody else is read within itself only."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from refusals import refused

pytest.importorskip("nicegui", reason="the extra web is not installed")

from asperity.core.errors import FileFormatError, OutputError
from asperity.web.beginning import fill
from asperity.web.kept import LOCK, STATE
from asperity.web.session import Place
from asperity.web.workers import Limits

from .app_server import AppServer

FOLDER = "folder of a session"

posix = pytest.mark.skipif(os.name == "nt", reason="locks, links and signals of POSIX systems")


def place(folder: Path) -> Place:
    """Where one application has its sessions."""
    folder.mkdir(exist_ok=True)
    return Place(folder, Limits.usual(), 1, 2**20)


@pytest.fixture
def kept(tmp_path: Path) -> Path:
    """Folder of a session with a file and a run that is done."""
    scan = tmp_path / "scan.txt"
    scan.write_text("1 2\n3 4\n", encoding="utf-8")
    first = place(tmp_path / "first")
    _, session = first.new(tmp_path / "kept")
    fill(session, files=[scan])
    run = session.new_run("run", "first", session.draft.table)
    session.folder_of(run).mkdir(parents=True)
    (session.folder_of(run) / "report.html").write_text("report", encoding="utf-8")
    run.state = "done"
    first.close()
    return tmp_path / "kept"


@posix
def test_one_folder_is_open_in_one_application(kept: Path, tmp_path: Path) -> None:
    first, second = place(tmp_path / "a"), place(tmp_path / "b")
    key, session = first.new(kept)
    with refused(OutputError, FOLDER, str(kept), f"process {os.getpid()}"):
        second.new(kept)
    (tmp_path / "link").symlink_to(kept)
    assert first.new(tmp_path / "link") == (key, session), "the same application shows the session that is open"
    with refused(OutputError, FOLDER):
        second.new(tmp_path / "link")
    first.close()
    _, again = second.new(kept)
    assert again.labels.values() == session.labels.values() or [*again.labels.values()] == ["scan.txt"]
    second.close()
    assert not (kept / LOCK).exists()


@posix
def test_a_session_that_is_kept_later_is_held_from_then_on(tmp_path: Path) -> None:
    first, second = place(tmp_path / "a"), place(tmp_path / "b")
    _, session = first.new()
    session.save_as(tmp_path / "kept")
    with refused(OutputError, FOLDER):
        second.new(tmp_path / "kept")
    first.close()
    second.new(tmp_path / "kept")
    second.close()


@posix
@pytest.mark.slow
def test_two_applications_on_one_folder(kept: Path, open_page: Callable[..., Any]) -> None:
    command = [sys.executable, "-m", "asperity", "app", "--no-browser", "--folder", str(kept)]
    with AppServer(("--folder", str(kept))) as first, AppServer(("--demo",)) as other:
        answer = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
        assert answer.returncode == 2
        assert f"process {first.process.pid}" in answer.stderr
        page = open_page(other.address).page
        page.wait_for_url("**/s/**")
        page.click("a.brand")
        page.fill('input[placeholder="~/contacts/disk"]', str(kept))
        page.click("text=Open >> visible=true")
        page.wait_for_selector(f".q-notification:has-text('process {first.process.pid}')")
        first.process.send_signal(signal.SIGKILL)
        first.process.wait()
        page.click("text=Open >> visible=true")
        page.wait_for_url("**/surface")
        page.wait_for_selector("text=scan.txt")


@posix
@pytest.mark.slow
def test_the_title_that_was_typed_last_survives_the_end(tmp_path: Path, open_page: Callable[..., Any]) -> None:
    folder = tmp_path / "kept"
    with AppServer(("--demo", "--folder", str(folder))) as app:
        watched = open_page(app.address)
        page = watched.page
        page.wait_for_url("**/s/**")
        page.goto(page.url.replace("/surface", "/run"))
        page.fill("input[data-key=title]", "Disk 7 after the test")
        page.wait_for_timeout(1000)
        assert "Disk 7 after the test" in (folder / STATE).read_text(encoding="utf-8")
        app.process.send_signal(signal.SIGINT)
        app.process.wait(20.0)
        page.close()
    assert all("ERR_CONNECTION" in text for text in watched.errors)  # the page asked for what had ended
    watched.errors.clear()
    with AppServer(("--folder", str(folder))) as app:
        page = open_page(app.address).page
        page.wait_for_url("**/s/**")
        page.wait_for_selector(".of:has-text('Disk 7 after the test')")


def test_files_from_elsewhere_come_along_into_a_kept_session(kept: Path, tmp_path: Path) -> None:
    (tmp_path / "scan.txt").unlink()
    shutil.move(kept, tmp_path / "moved")
    own = place(tmp_path / "own")
    _, session = own.new(tmp_path / "moved")
    path = Path(str(session.draft.get("surface", "path")))
    assert path == tmp_path / "moved" / "files" / "scan.txt"
    assert path.read_text(encoding="utf-8") == "1 2\n3 4\n"
    assert session.draft.problems() != []
    assert [file for run in session.runs for file in session.given_out(run)] == ["report.html"]
    own.close()


def changed(folder: Path, change: Callable[[dict[str, Any]], object]) -> None:
    """Change the state that stands in ``folder``."""
    state = json.loads((folder / STATE).read_text(encoding="utf-8"))
    change(state)
    (folder / STATE).write_text(json.dumps(state), encoding="utf-8")


LEADING_OUT: dict[str, Callable[[dict[str, Any]], object]] = {
    "surface": lambda state: state["table"]["surface"].update(path="/etc/passwd"),
    "relative": lambda state: state["table"]["surface"].update(path="files/../../secret.txt"),
    "moduli": lambda state: state["table"].update(body={"relaxation": {"moduli_file": "/etc/passwd"}}),
    "before": lambda state: state["before"].append({"surface": {"path": "/etc/passwd"}}),
    "document of a run": lambda state: state["runs"][0].update(table={"materials_file": "../secret.txt"}),
    "line of text": lambda state: state["table"].update(spectrum={"scans": ["/etc/passwd, size=1um"]}),
    "text of a body": lambda state: state["table"].update(body="moduli=../secret.csv,nu=0.5"),
    "text of a layer": lambda state: state["table"].update(body={"layers": ["moduli=/etc/passwd,nu=0.5:1um"]}),
    "null": lambda state: state["table"]["surface"].update(path="files/a\0b"),
}
"""States that name files elsewhere."""

DAMAGED: dict[str, Callable[[dict[str, Any]], object]] = {
    "key of a run": lambda state: state["runs"][0].update(key="../../001-abcdef"),
    "key with more": lambda state: state["runs"][0].update(key="001-abcdef/../.."),
    "state of a run": lambda state: state["runs"][0].update(state="boom"),
    "kind of a run": lambda state: state["runs"][0].update(kind="../run"),
    "file": lambda state: state["files"][0].update(path="/etc/passwd"),
    "file above": lambda state: state["files"][0].update(path="./files/../../secret.txt"),
    "label": lambda state: state["files"][0].update(label="../../secret.txt"),
    "two labels": lambda state: state["files"].append(state["files"][0]),
    "table": lambda state: state.update(table=[]),
    "run": lambda state: state["runs"].append({}),
    "runs": lambda state: state.update(runs=7),
}
"""States that are none."""


@pytest.mark.parametrize("name", LEADING_OUT)
def test_a_state_that_leads_elsewhere_is_refused(name: str, kept: Path, tmp_path: Path) -> None:
    (tmp_path / "secret.txt").write_text("7 7\n7 7\n", encoding="utf-8")
    changed(kept, LEADING_OUT[name])
    with refused(FileFormatError, FOLDER, str(kept)):
        place(tmp_path / "own").new(kept)
    assert not (kept / LOCK).exists(), "who mends it can open it"


@pytest.mark.parametrize("name", DAMAGED)
def test_a_state_that_is_none_is_refused(name: str, kept: Path, tmp_path: Path) -> None:
    changed(kept, DAMAGED[name])
    with refused(FileFormatError, FOLDER, str(kept)):
        place(tmp_path / "own").new(kept)


def test_a_state_that_is_nested_without_end_is_refused(kept: Path, tmp_path: Path) -> None:
    (kept / STATE).write_text("[" * 100_000, encoding="utf-8")
    with refused(FileFormatError, FOLDER, str(kept)):
        place(tmp_path / "own").new(kept)


def run_folder(folder: Path) -> Path:
    return next((folder / "runs").iterdir())


def linked(path: Path, target: str) -> None:
    """A link in place of what is at ``path``."""
    shutil.rmtree(path) if path.is_dir() else path.unlink(missing_ok=True)
    path.symlink_to(target)


LINKS: dict[str, Callable[[Path], object]] = {
    "folder of a run": lambda folder: linked(run_folder(folder), "/etc"),
    "runs": lambda folder: linked(folder / "runs", "../other"),
    "files": lambda folder: linked(folder / "files", "/etc"),
    "file": lambda folder: linked(folder / "files" / "scan.txt", "/etc/passwd"),
    "report": lambda folder: linked(run_folder(folder) / "report.html", "../../../secret.txt"),
    "maps": lambda folder: linked(folder / "runs" / f"{run_folder(folder).name}.scene.json", "/etc/passwd"),
    "circle": lambda folder: linked(folder / "files" / "scan.txt", "scan.txt"),
    "device": lambda folder: os.mkfifo(folder / "files" / "pipe"),
}
"""What leads out of a folder, or to what is no file."""


@posix
@pytest.mark.parametrize("name", LINKS)
def test_links_that_lead_elsewhere_are_refused(name: str, kept: Path, tmp_path: Path) -> None:
    (tmp_path / "other").mkdir()
    LINKS[name](kept)
    with refused(FileFormatError, FOLDER, str(kept)):
        place(tmp_path / "own").new(kept)


@posix
def test_a_lock_that_is_a_link_is_not_followed(kept: Path, tmp_path: Path) -> None:
    mine = tmp_path / "mine.txt"
    mine.write_text("mine", encoding="utf-8")
    linked(kept / LOCK, str(mine))
    with refused(OutputError, FOLDER, str(kept / LOCK)):
        place(tmp_path / "own").new(kept)
    assert mine.read_text(encoding="utf-8") == "mine"


@posix
def test_links_that_are_made_later_are_not_followed(kept: Path, tmp_path: Path) -> None:
    own = place(tmp_path / "own")
    _, session = own.new(kept)
    run = next(iter(session.runs))
    assert [*session.given_out(run)] == ["report.html"]
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "secret.txt").write_text("secret", encoding="utf-8")
    linked(run_folder(kept) / "report.html", "/etc/passwd")
    (run_folder(kept) / "plots").symlink_to(tmp_path / "other")
    assert session.given_out(run) == {}
    linked(run_folder(kept), str(tmp_path / "other"))
    assert session.given_out(run) == {}
    own.close()
