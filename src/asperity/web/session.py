"""What a person works on: one document, the files it needs, runs and sweeps; kept in a folder that
can be opened again."""

from __future__ import annotations

import asyncio
import json
import math
import secrets
import shutil
import tempfile
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass, field
from itertools import count
from pathlib import Path
from typing import Any, Literal

from ..core.errors import InputError, OutputError
from ..io.atomic import atomic_file
from ..report.folder import ALL_NAMES
from ..run.archive import write_archive
from ..run.document import PROBLEM, files_of, load_document
from .draft import Draft, relabelled
from .kept import LOCK, STATE, Held, is_within, label_of, state_in
from .views import ARRAYS, SCENE
from .workers import Limits, Worker

SCRATCH = "scratch-"
"""Beginning of the name of the folder of what only the open application needs."""

PATIENCE = 120.0
"""Seconds for which a file is waited for that the page of a run fetches."""

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
        self.glances: dict[str, Any] = {}
        self.room: Callable[[], float] = lambda: math.inf
        self.version, self.changed_by = 0, ""
        self._held = Held(folder) if kept else None
        self.scratch = Path(tempfile.mkdtemp(prefix=SCRATCH, dir=folder))

    @property
    def labels(self) -> dict[str, str]:
        """Label of every file by its path."""
        return {item.path: item.label for item in self.files}

    def owns(self, path: str) -> bool:
        """Whether the file at ``path`` lies in the folder of the session."""
        return Path(path).is_relative_to(self.folder)

    def said(self, text: str) -> str:
        """``text`` of a message with the labels of files in place of their paths."""
        for item in self.files:
            text = text.replace(item.path, item.label)
        return text

    def folder_of(self, run: Run) -> Path:
        """Folder of the results of ``run``."""
        return self.folder / f"{run.kind}s" / run.key

    def views_of(self, run: Run) -> Path:
        """Beginning of the names of the files that the page of ``run`` shows; they are made again
        where a session is opened again."""
        return self.scratch / run.key

    def explorable(self, run: Run) -> bool:
        """Whether there is something to show of ``run``."""
        views = self.views_of(run)
        going = run.state == "running" and views.with_name(views.name + SCENE).is_file()
        return run.kind == "run" and (run.state == "done" or going)

    def shown(self, run: Run, name: str) -> Path | None:
        """The file of that ``name`` that the page of ``run`` fetches, once it is there."""
        folder = self.scratch / f"{run.key}{ARRAYS}"
        there = {path.name for path in folder.iterdir()} if folder.is_dir() else set()
        return folder / name if name in there else None

    async def made(self, run: Run, name: str, wanted: Callable[[], bool] = lambda: True) -> Path | None:
        """The same, waited for as long as it is ``wanted``; None if it is still not there then, or
        after ``PATIENCE``."""
        end = time.monotonic() + PATIENCE
        while (file := self.shown(run, name)) is None and wanted() and time.monotonic() < end:
            await asyncio.sleep(0.02)
        return file

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
        """Place for the content of an upload called ``name``, of which the last part becomes the
        name of the file, so that every report calls it as its owner does."""
        folder = self.folder / "files"
        folder.mkdir(parents=True, exist_ok=True)
        label = self._free(label_of(name))
        self.files.append(Kept(str(folder / label), label))
        return folder / label

    def forget_file(self, path: Path) -> None:
        """Remove an upload."""
        self.files = [item for item in self.files if item.path != str(path)]
        if path.parent == self.folder / "files":
            path.unlink(missing_ok=True)

    def _free(self, label: str) -> str:
        """``label``, or one like it that no other file and nothing that a run leaves has."""
        taken = {item.label.casefold() for item in self.files} | {name.casefold() for name in ALL_NAMES}
        stem, dot, ending = label.rpartition(".") if "." in label[1:] else (label, "", "")
        numbered = (f"{stem} ({number}){dot}{ending}" for number in count(2))
        return label if label.casefold() not in taken else next(one for one in numbered if one.casefold() not in taken)

    def take_file(self, file: Path) -> str:
        """Path of the session's own ``file`` from outside, which is copied where the session is
        kept.

        Raises
        ------
        OutputError
            If it cannot be copied.
        """
        path = str(file.absolute())
        if path in self.labels:
            return path
        if not self.kept:
            self.files.append(Kept(path, self._free(label_of(file.name))))
            return path
        own = self.add_file(file.name)
        try:
            shutil.copyfile(file, own)
        except OSError as error:
            raise OutputError(f"{own} cannot be written: {error.strerror}; choose another folder.") from None
        return str(own)

    def from_sweeps(self, path: str) -> str:
        """``path`` of a file as studies name it, from the folder of any sweep, with which it moves;
        files from elsewhere stay where they are."""
        return f"../../{Path(path).relative_to(self.folder).as_posix()}" if self.owns(path) else path

    def named_from_sweeps(self, table: Mapping[str, Any]) -> dict[str, Any]:
        """``table`` with its files as studies name them."""
        found: dict[str, Any] = relabelled(table, {path: self.from_sweeps(path) for path in self.labels})
        return found

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
        if folder is None or not folder.is_dir() or not is_within(folder, self.folder):
            return {}
        files = [path for path in folder.rglob("*") if path.is_file() and is_within(path, folder)]
        return {path.relative_to(folder).as_posix(): path for path in files}

    def shared(self, run: Run) -> Path:
        """Archive with document, files and report of ``run``, for others.

        Raises
        ------
        InputError
            If its document is damaged, or names a file that is not of this session.
        OutputError
            If the archive cannot be written.
        """
        given, archive = self.given_out(run.key), self.scratch / f"{run.key}.zip"
        if not archive.is_file():
            document = load_document(given.get(PROBLEM, self.folder_of(run) / PROBLEM))
            for file in files_of(document, self.folder_of(run)):
                if not is_within(file, self.folder) and str(file) not in self.labels:
                    raise InputError(
                        f"files of a run must be those of its session, but {file} is none of them. Open its document "
                        "where that file may be read."
                    )
            report = {name: path for name, path in given.items() if name == "report.html"}
            write_archive(archive, document, self.folder_of(run), report, overwrite=True)
        return archive

    # Kept and opened again.

    def save(self) -> None:
        """Write the state of the session into its folder."""
        names = {item.path: f"./files/{Path(item.path).name}" for item in self.files}
        state = {
            "asperity_session": 1,
            "table": relabelled(self.draft.table, names),
            "before": relabelled(self.draft.before[-20:], names),
            "files": [{"path": names[item.path], "label": item.label} for item in self.files],
            "runs": [asdict(run) | {"table": relabelled(run.table, names)} for run in self.runs.values()],
        }
        with atomic_file(self.folder / STATE, overwrite=True) as partial:
            partial.write_text(json.dumps(state, indent=1), encoding="utf-8")

    def save_as(self, folder: Path) -> None:
        """Keep the session in ``folder`` from now on, with all its files and results; those that
        lie elsewhere are copied.

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
        new = {item.path: str(target / "files" / item.label) for item in self.files}
        try:
            target.mkdir(parents=True, exist_ok=True)
            for name in ("runs", "sweeps"):
                if (self.folder / name).is_dir():
                    shutil.copytree(self.folder / name, target / name)
            (target / "files").mkdir()
            for item in self.files:
                if Path(item.path).is_file():
                    shutil.copyfile(item.path, new[item.path])
        except OSError as error:
            raise OutputError(f"folder {target} cannot be written: {error.strerror}; choose another.") from None
        self.files = [Kept(new[item.path], item.label) for item in self.files]
        self.draft.rename(new)
        for run in self.runs.values():
            run.table = relabelled(run.table, new)
        self.folder, self.kept, self._held = target, True, Held(target)
        self.touched()

    def reopen(self) -> None:
        """Take the state in the folder.

        Raises
        ------
        FileFormatError
            If there is none, it is damaged, or anything of it leads out of the folder.
        """
        state = state_in(self.folder)
        for left in self.folder.glob(f"{SCRATCH}*"):  # of an application that was killed
            if left != self.scratch:
                shutil.rmtree(left, ignore_errors=True)
        names = {item["path"]: str(self.folder / item["path"]) for item in state["files"]}
        self.draft = Draft(relabelled(state["table"], names), relabelled(state["before"], names))
        self.files = [Kept(names[item["path"]], item["label"]) for item in state["files"]]
        self.runs = {item["key"]: Run(**item | {"table": relabelled(item["table"], names)}) for item in state["runs"]}
        for run in self.runs.values():
            if run.state == "running":
                run.state, run.message = "cancelled", "The application ended before this run did."

    def close(self) -> None:
        """Save what is kept, stop the workers and remove the rest."""
        if self.kept:
            with suppress(OutputError):  # its folder may have been taken away
                self.save()
        self.abandon()

    def abandon(self) -> None:
        """Stop the workers, remove what is not to be kept, and let others have the folder."""
        for worker in (self.helper, *self.workers.values()):
            worker.cancel()
        shutil.rmtree(self.scratch, ignore_errors=True)
        if self._held is not None:
            self._held.release()


@dataclass
class Place:
    """Where sessions live: a private temporary ``folder``, and those that are open, by their keys.

    ``largest`` is the most bytes of one upload, ``quota`` of all that the sessions have; ``ends``
    tells whether the application is being ended.
    """

    folder: Path
    limits: Limits
    threads: int
    largest: int
    roots: tuple[Path, ...] = ()
    quota: float = math.inf
    sessions: dict[str, Session] = field(default_factory=dict)
    ends: Callable[[], bool] = lambda: False

    def new(self, folder: Path | None = None) -> tuple[str, Session]:
        """A new session, in a private folder or in ``folder``, where one may be already; its key is
        random."""
        key = secrets.token_urlsafe(9)
        own = self.folder / key if folder is None else folder.absolute()
        if folder is not None:
            for other, open_one in self.sessions.items():
                if open_one.folder.resolve() == own.resolve():
                    return other, open_one
        try:
            own.mkdir(parents=True, exist_ok=True)
            there = {entry.name for entry in own.iterdir()}
        except OSError as error:
            raise OutputError(f"folder {own} cannot be written: {error.strerror}; choose another.") from None
        if folder is not None and there - {LOCK} and not (own / STATE).is_file():
            raise OutputError(
                f"folder of a session must be new, empty, or hold one, but {own} holds something else; choose another."
            )
        session = Session(own, self.limits, self.threads, kept=folder is not None)
        session.room = self.room
        try:
            if folder is not None and STATE in there:
                session.reopen()
            elif folder is not None:
                own.chmod(0o700)
                session.save()  # from now on the folder holds a session, whatever comes of it
        except BaseException:
            session.abandon()
            raise
        self.sessions[key] = session
        return key, session

    def run_of(self, key: str, run: str) -> tuple[Session | None, Run | None]:
        """The session of that ``key``, and its ``run``, as far as they are known."""
        session = self.sessions.get(key)
        return session, None if session is None else session.runs.get(run)

    def room(self) -> float:
        """Bytes that may still be uploaded."""
        sessions = self.sessions.values()
        files = [Path(item.path) for session in sessions for item in session.files if session.owns(item.path)]
        return self.quota - sum(path.stat().st_size for path in files if path.is_file())

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
