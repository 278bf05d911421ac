"""What users of the application read of sessions, archives, uploads and limits: a file, compared as
a whole.

``ASPERITY_WRITE_MESSAGES=1 pytest tests/messages`` writes it anew.
"""

from __future__ import annotations

import json
import os
import re
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import CliRunner

from asperity.cli.main import app
from asperity.core.errors import AsperityError
from asperity.run.archive import unpack
from asperity.web.beginning import fill
from asperity.web.kept import LOCK, STATE, Held
from asperity.web.security import NO_TOKEN, cap_text, quota_text
from asperity.web.session import Place
from asperity.web.workers import Limits

WRITTEN = Path(__file__).with_name("app.txt")

PROBLEM = '[surface]\nkind = "file"\npath = "scan.txt"\n'


def place(name: str) -> Place:
    Path(name).mkdir(exist_ok=True)
    return Place(Path(name), Limits(1e9, 60.0), 1, 2**20)


def kept(name: str) -> Path:
    """A session with a file that was kept in the folder ``name``."""
    Path("scan.txt").write_text("1 2\n3 4\n", encoding="utf-8")
    first = place("first")
    _, session = first.new(Path(name))
    fill(session, files=[Path("scan.txt")])
    first.close()
    return Path(name)


def two_at_once() -> None:
    folder = kept("twice")
    first = Held(folder)
    try:
        place("second").new(folder)
    finally:
        first.release()


def lock_elsewhere() -> None:
    folder = kept("locked")
    (folder / LOCK).symlink_to("elsewhere")
    place("second").new(folder)


def link_elsewhere() -> None:
    folder = kept("linked")
    (folder / "files" / "scan.txt").unlink()
    (folder / "files" / "scan.txt").symlink_to("/etc/passwd")
    place("second").new(folder)


def path_elsewhere() -> None:
    folder = kept("named")
    state = json.loads((folder / STATE).read_text(encoding="utf-8"))
    state["table"]["surface"]["path"] = "../secret.txt"
    (folder / STATE).write_text(json.dumps(state), encoding="utf-8")
    place("second").new(folder)


def damaged() -> None:
    folder = kept("damaged")
    (folder / STATE).write_text("{", encoding="utf-8")
    place("second").new(folder)


def something_else() -> None:
    Path("other").mkdir()
    Path("other/a.txt").write_text("1", encoding="utf-8")
    place("second").new(Path("other"))


def kept_in_a_full_folder() -> None:
    _, session = place("second").new()
    session.save_as(Path("other"))


def kept_amid_a_run() -> None:
    _, session = place("second").new()
    session.new_run("run", "a", {})
    session.save_as(Path("new"))


def missing_file() -> None:
    Path("problem.toml").write_text('version = 2\n[surface]\nkind = "file"\npath = "lost.di"\n', encoding="utf-8")
    fill(place("second").new()[1], files=[Path("problem.toml")])


def shared_of_others() -> None:
    _, session = place("second").new(Path("theirs"))
    run = session.new_run("run", "a", {})
    folder = session.folder_of(run)
    folder.mkdir()
    text = f'version = 2\nbody = "DLC"\n{PROBLEM.replace("scan.txt", "/home/me/scan.txt")}'
    (folder / "problem.toml").write_text(f'{text}[control]\nmean_pressure = "1 MPa"\n', encoding="utf-8")
    session.shared(run)


def packed(entries: dict[str, str], largest: float = float("inf")) -> None:
    with zipfile.ZipFile("a.zip", "w") as archive:
        for name, content in entries.items():
            archive.writestr(name, content)
    Path("out").mkdir(exist_ok=True)
    for left in Path("out").iterdir():
        left.unlink()
    unpack(Path("a.zip"), Path("out"), largest)


def no_zip() -> None:
    Path("b.zip").write_bytes(b"PK" + bytes(100))
    unpack(Path("b.zip"), Path("out"))


def command(*arguments: str) -> str:
    result = CliRunner().invoke(app, list(arguments))
    assert result.exit_code == 2, result.output
    return " ".join(result.stderr.split())


def document_of_an_archive() -> str:
    with zipfile.ZipFile("c.zip", "w") as archive:
        archive.writestr("problem.toml", f'version = 2\nbody = "DLC"\n{PROBLEM}[control]\nmean_pressure = "1 MPa"\n')
        archive.writestr("scan.txt", "1 2\n3 4\n")
    return command("contact", "c.zip", "--save-document", "new.toml")


RAISED: dict[str, Callable[[], object]] = {
    "a session that is open elsewhere": two_at_once,
    "a session whose lock is a link": lock_elsewhere,
    "a session with a link": link_elsewhere,
    "a session that names a file elsewhere": path_elsewhere,
    "a damaged session": damaged,
    "a folder with something else": something_else,
    "a session kept in a folder that is full": kept_in_a_full_folder,
    "a session kept amid a run": kept_amid_a_run,
    "a document whose file is missing": missing_file,
    "an archive of a run that names a file elsewhere": shared_of_others,
    "an archive without its scan": lambda: packed({"problem.toml": PROBLEM}),
    "an archive that leads elsewhere": lambda: packed({"problem.toml": PROBLEM.replace("scan", "../scan")}),
    "an archive without a document": lambda: packed({"scan.txt": "1"}),
    "an archive that is too large": lambda: packed({"problem.toml": PROBLEM, "scan.txt": "1" * 100}, 90),
    "an archive that is no zip file": no_zip,
}

SAID: dict[str, Callable[[], str]] = {
    "asperity contact c.zip --save-document new.toml": document_of_an_archive,
    "asperity app --at-once 0": lambda: command("app", "--at-once", "0"),
    "asperity app --all-uploads 0": lambda: command("app", "--all-uploads", "0"),
    "a request without a token": lambda: NO_TOKEN,
    "an upload that is too large": lambda: cap_text(2**29),
    "an upload for which there is no room": lambda: quota_text(2**32),
}


def raised(call: Callable[[], object]) -> str:
    try:
        call()
    except AsperityError as error:
        return f"{type(error).__name__}: {error}"
    raise AssertionError(f"{call} raises nothing")


@pytest.mark.skipif(os.name == "nt", reason="links and locks of POSIX systems")
def test_messages_of_the_application_are_those_of_the_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("nicegui", reason="the extra web is not installed")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("NO_COLOR", "1")
    entries = [(what, raised(call)) for what, call in RAISED.items()]
    entries += [(what, call()) for what, call in SAID.items()]
    text = "\n".join(f"{what}\n    {message}\n" for what, message in entries).replace(f"{tmp_path}{os.sep}", "")
    text = re.sub(r"the application of .*? since [0-9: -]+\.", "the application of (who and since when).", text)
    if os.environ.get("ASPERITY_WRITE_MESSAGES"):
        WRITTEN.write_text(text, encoding="utf-8")
    assert text == WRITTEN.read_text(encoding="utf-8"), "read the difference; ASPERITY_WRITE_MESSAGES=1 accepts it"
