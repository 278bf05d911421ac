"""What a person works on: one document, the files it needs, runs and sweeps; kept in a folder that
can be opened again."""

from __future__ import annotations

import json
import re
import secrets
import shutil
import tempfile
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Literal

from ..core.errors import FileFormatError, InputError, OutputError
from ..core.words import printable
from ..io.atomic import atomic_file
from .draft import Draft
from .workers import Limits, Worker

STATE = "session.json"
"""File of a session in its folder; the rest are the folders ``files``, ``runs`` and ``sweeps``."""

Kind = Literal["run", "sweep"]


@dataclass
class Run:
    """One run, or one sweep, in its own folder under that of the session.

    ``state`` is ``"running"``, ``"done"``, ``"cancelled"`` or ``"failed"``; ``message`` says more.
    """

    key: str
    kind: Kind
    title: str
    table: dict[str, Any]
    state: str = "running"
    message: str = ""
    converged: bool = True


@dataclass(frozen=True)
class Kept:
    """A file that the document may name: the ``path`` at which it lies and the ``label`` by which
    its owner knows it."""

    path: str
    label: str


class Session:
    """A document with its history, files, runs and the workers that serve it."""

    def __init__(self, folder: Path, limits: Limits, threads: int, *, kept: bool) -> None:
        self.folder, self.limits, self.threads, self.kept = folder, limits, threads, kept
        self.draft = Draft()
        self.files: list[Kept] = []
        self.runs: dict[str, Run] = {}
        self.helper = Worker(limits, threads)
        self.workers: dict[str, Worker] = {}
        self.tasks: list[Any] = []
        self.version, self.changed_by = 0, ""
        self.scratch = Path(tempfile.mkdtemp(prefix="scratch-", dir=folder if kept else None))

    @property
    def labels(self) -> dict[str, str]:
        """Label of every file by its path."""
        return {item.path: item.label for item in self.files}

    def said(self, text: str) -> str:
        """``text`` of a message with the labels of files in place of their paths."""
        for item in self.files:
            text = text.replace(item.path, item.label)
        return text

    def folder_of(self, run: Run) -> Path:
        """Folder of the results of ``run``."""
        return self.folder / f"{run.kind}s" / run.key

    def views_of(self, run: Run) -> Path:
        """Beginning of the names of the files that the page of ``run`` shows."""
        return self.folder / f"{run.kind}s" / run.key

    def progress_of(self, run: Run) -> Path:
        """File in which the worker of ``run`` reports."""
        return self.scratch / f"{run.key}.progress"

    def touched(self, by: str = "") -> None:
        """Note a change of the document ``by`` a window, which others then show, and keep the
        session in its own folder."""
        self.version += 1
        self.changed_by = by
        if self.kept:
            self.save()

    def add_file(self, name: str) -> Path:
        """Place for the content of an upload called ``name``, which is only a label: the file gets
        a random name.

        Readers recognise some formats by the ending, which is kept if it is plain letters and
        digits.
        """
        folder = self.folder / "files"
        folder.mkdir(parents=True, exist_ok=True)
        ending = re.search(r"\.[A-Za-z0-9]{1,12}$", name)
        path = folder / f"{secrets.token_hex(8)}{ending[0].lower() if ending else ''}"
        self.files.append(Kept(str(path), label_of(name)))
        return path

    def new_run(self, kind: Kind, title: str, table: Mapping[str, Any]) -> Run:
        """A run that begins now."""
        number = 1 + max((int(run.key.split("-")[0]) for run in self.runs.values()), default=0)
        run = Run(f"{number:03d}-{secrets.token_hex(3)}", kind, title, dict(table))
        self.runs[run.key] = run
        (self.folder / f"{kind}s").mkdir(parents=True, exist_ok=True)
        self.touched()
        return run

    def given_out(self, run: str) -> dict[str, Path]:
        """Files of a run, or of the roughness, by the names under which they are given out; no name
        is ever used as a path."""
        known = self.runs.get(run)
        folder = self.scratch / "roughness" if run == "roughness" else None if known is None else self.folder_of(known)
        if folder is None or not folder.is_dir():
            return {}
        files = [path for path in folder.rglob("*") if path.is_file() and not path.is_symlink()]
        return {path.relative_to(folder).as_posix(): path for path in files}

    # Kept and opened again.

    def save(self) -> None:
        """Write the state of the session into its folder."""
        state = {
            "asperity_session": 1,
            "table": self.draft.table,
            "before": self.draft.before[-20:],
            "files": [asdict(item) for item in self.files],
            "runs": [asdict(run) for run in self.runs.values()],
        }
        moved = _replaced(state, str(self.folder), ".")
        with atomic_file(self.folder / STATE, overwrite=True) as partial:
            partial.write_text(json.dumps(moved, indent=1), encoding="utf-8")

    def save_as(self, folder: Path) -> None:
        """Keep the session in ``folder`` from now on, with all its files and results.

        Raises
        ------
        OutputError
            If the folder holds something else, or cannot be written.
        InputError
            If a run is under way.
        """
        if any(run.state == "running" for run in self.runs.values()):
            raise InputError("session must have no run under way while it is moved; wait for it or cancel it.")
        target = folder.absolute()
        if target.exists() and (not target.is_dir() or any(target.iterdir())):
            raise OutputError(f"folder of a session must be new or empty, but {target} is not; choose another.")
        try:
            target.mkdir(parents=True, exist_ok=True)
            for name in ("files", "runs", "sweeps"):
                if (self.folder / name).is_dir():
                    shutil.copytree(self.folder / name, target / name)
        except OSError as error:
            raise OutputError(f"folder {target} cannot be written: {error.strerror}; choose another.") from None
        state = {
            "table": self.draft.table,
            "before": self.draft.before,
            "files": [asdict(item) for item in self.files],
            "runs": [asdict(run) for run in self.runs.values()],
        }
        old, self.folder, self.kept = self.folder, target, True
        self._take(_replaced(state, str(old), str(target)))
        self.touched()

    def reopen(self) -> None:
        """Take the state in the folder.

        Raises
        ------
        FileFormatError
            If there is none, or it is damaged.
        """
        file = self.folder / STATE
        try:
            state = json.loads(file.read_text(encoding="utf-8"))
            if state["asperity_session"] != 1:
                raise ValueError
            self._take(_replaced(state, ".", str(self.folder)))
        except (OSError, ValueError, KeyError, TypeError):
            raise FileFormatError(
                f"folder of a session must hold a whole {STATE}, but {self.folder} does not; choose the folder "
                "that was named."
            ) from None
        for run in self.runs.values():
            if run.state == "running":
                run.state, run.message = "cancelled", "The application ended before this run did."

    def _take(self, state: Mapping[str, Any]) -> None:
        self.draft = Draft(dict(state["table"]), list(state["before"]))
        self.files = [Kept(**item) for item in state["files"]]
        self.runs = {item["key"]: Run(**item) for item in state["runs"]}

    def close(self) -> None:
        """Stop the workers and remove what is not to be kept."""
        for worker in (self.helper, *self.workers.values()):
            worker.cancel()
        shutil.rmtree(self.scratch, ignore_errors=True)


def label_of(name: str) -> str:
    """Name of an upload as it is shown and proposed for a file: no folders, no control characters,
    not long."""
    plain = printable(name.replace("\\", "/").rpartition("/")[2]).strip() or "file"
    return plain if len(plain) <= 80 else f"{plain[:60]}…{plain[-18:]}"


def _replaced(value: Any, old: str, new: str) -> Any:
    """Nested ``value`` in which paths of files below the folder ``old`` lead below ``new``."""
    if isinstance(value, dict):
        return {key: _replaced(item, old, new) for key, item in value.items()}
    if isinstance(value, list):
        return [_replaced(item, old, new) for item in value]
    if isinstance(value, str) and value.startswith(f"{old}/files/"):
        return f"{new}{value[len(old) :]}"
    return value


@dataclass
class Place:
    """Where sessions live: a private temporary ``folder``, and those that are open, by their
    keys."""

    folder: Path
    limits: Limits
    threads: int
    largest: int
    roots: tuple[Path, ...] = ()
    sessions: dict[str, Session] = field(default_factory=dict)

    def new(self, folder: Path | None = None) -> tuple[str, Session]:
        """A new session, in a private folder or in ``folder``, where one may be already; its key is
        random."""
        key = secrets.token_urlsafe(9)
        private = self.folder / key
        own = private if folder is None else folder.absolute()
        if folder is not None:
            for other, open_one in self.sessions.items():
                if open_one.folder == own:
                    return other, open_one
        own.mkdir(parents=True, exist_ok=True)
        if folder is not None and any(own.iterdir()) and not (own / STATE).is_file():
            raise OutputError(f"folder of a session must be new, empty, or hold one, but {own} holds something else.")
        session = Session(own, self.limits, self.threads, kept=folder is not None)
        if (own / STATE).is_file():
            session.reopen()
        elif folder is not None:
            session.save()  # from now on the folder holds a session, whatever comes of it
        self.sessions[key] = session
        return key, session

    def allowed(self, text: str) -> Path:
        """Folder that a person has typed; with ``roots`` it must lie in one of them.

        Raises
        ------
        InputError
            If it does not.
        """
        path = Path(text).expanduser().absolute()
        path = path.resolve() if path.exists() else path.parent.resolve() / path.name
        if not text.strip() or (self.roots and not any(path.is_relative_to(root) for root in self.roots)):
            where = " or ".join(str(root) for root in self.roots) or "this machine"
            raise InputError(f"folder of a session must be a folder in {where}, but is {text!r}.")
        return path

    def close(self) -> None:
        """Close all sessions; those in private folders are gone."""
        for session in self.sessions.values():
            session.close()
        shutil.rmtree(self.folder, ignore_errors=True)
