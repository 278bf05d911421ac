"""The folder of a kept session: who has it open, and what is read of it.

A folder may come from somebody else. What it holds is read, and nothing that it leads to.
"""

from __future__ import annotations

import getpass
import json
import os
import re
import socket
import stat
import time
from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from ..core.errors import FileFormatError, OutputError
from ..core.words import printable
from ..io.atomic import lock
from ..run.document import files_named

STATE = "session.json"
"""File of a session in its folder; the rest are the folders ``files``, ``runs`` and ``sweeps``."""

LOCK = "session.lock"
"""File that the application that has a session open keeps locked, with its owner."""

NOT_FOLLOWED = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
"""How a file is opened that somebody else may have made a link or a pipe."""

LONGEST = 160
"""Bytes of the name of a file, to which systems set a limit."""

RUN_KEY = re.compile(r"[0-9]{3,9}-[0-9a-f]{6}")
"""Keys of runs, which are names of folders."""


class Held:
    """The right of this application to the session in ``folder``, until it is released.

    The lock is that of the system, so that it ends with this process, however it ends.

    Raises
    ------
    OutputError
        If another application has it, or the folder cannot be written.
    """

    def __init__(self, folder: Path) -> None:
        self._file, self._held = folder / LOCK, -1
        try:
            while not self._locked():
                pass  # whoever had it has removed it meanwhile
        except OutputError:
            raise
        except OSError as error:
            raise OutputError(
                f"folder of a session must be one that can be written, but {self._file} cannot: {error.strerror}; "
                "choose another."
            ) from None

    def _locked(self) -> bool:
        """Whether the file that was locked is still that of its name."""
        file = os.open(self._file, os.O_RDWR | os.O_CREAT | NOT_FOLLOWED, 0o600)
        try:
            if not stat.S_ISREG(os.fstat(file).st_mode):
                raise OSError(0, f"{LOCK} is no ordinary file")
            held = lock(self._file)
            if held == -1 and self._file.exists():
                owner = printable(os.read(file, 300).decode("utf-8", "replace").strip()) or "another application"
                raise OutputError(
                    f"folder of a session must be open in one application only, but {self._file.parent} is open in "
                    f"{owner}. End that one, or choose another folder.",
                    subject="folder of a session",
                )
            if held < 0:  # gone meanwhile, or a file system without locks, where nothing can be told of others
                return held == -2
            with suppress(OSError):
                if os.path.samestat(os.fstat(held), os.lstat(self._file)):
                    os.ftruncate(file, 0)
                    os.write(file, f"{owner_of_this()}\n".encode())
                    self._held = held
                    return True
            os.close(held)
            return False
        finally:
            os.close(file)

    def release(self) -> None:
        """Give the right back."""
        if self._held >= 0:
            with suppress(OSError):
                self._file.unlink()
            os.close(self._held)
            self._held = -1


def owner_of_this() -> str:
    """Who runs this application, since when."""
    try:
        user = getpass.getuser()
    except (OSError, KeyError):
        user = "unknown"
    began = time.strftime("%Y-%m-%d %H:%M")
    return f"the application of {user} on {socket.gethostname()}, process {os.getpid()}, since {began}"


def state_in(folder: Path) -> dict[str, Any]:
    """State of the session in ``folder``, which leads to nothing outside of it.

    Raises
    ------
    FileFormatError
        If there is none, it is damaged, or anything of it leads out of the folder.
    """
    for path in _all_in(folder):
        if path.is_symlink() and not is_within(path, folder):
            raise _leads_out(folder, str(path.relative_to(folder)), str(path.readlink()))
        if path.exists() and not path.is_file() and not path.is_dir():
            raise _leads_out(folder, str(path.relative_to(folder)), "a device")
    try:
        state = json.loads((folder / STATE).read_text(encoding="utf-8"))
        if state["asperity_session"] != 1:
            raise ValueError
        _check_shape(state)
        tables = [state["table"], *state["before"], *(run["table"] for run in state["runs"])]
        named = [*(item["path"] for item in state["files"]), *(name for table in tables for name in files_named(table))]
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        raise FileFormatError(
            f"folder of a session must hold a whole {STATE}, but {folder} does not; choose the folder that was named."
        ) from None
    for name in named:
        if not is_within(folder / name, folder):
            raise _leads_out(folder, STATE, name)
    found: dict[str, Any] = state
    return found


def is_within(path: Path, folder: Path) -> bool:
    """Whether ``path`` leads to a place in ``folder``, whatever links are on the way."""
    try:
        return path.resolve().is_relative_to(folder.resolve())
    except (OSError, ValueError, RuntimeError):  # no possible name, or links in a circle
        return False


def _all_in(folder: Path) -> Iterator[Path]:
    """Everything in ``folder``; links are not followed."""
    for above, folders, files in os.walk(folder):
        yield from (Path(above, name) for name in (*folders, *files))


def _leads_out(folder: Path, what: str, target: str) -> FileFormatError:
    return FileFormatError(
        f"folder of a session must lead to files within itself only, but {printable(what)} of {folder} leads to "
        f"{printable(target)}. Put a copy of what it needs into its folder files, or leave that out.",
        subject="folder of a session",
    )


def _check_shape(state: Mapping[str, Any]) -> None:
    """Raise ValueError, KeyError or TypeError if ``state`` is not that of a session."""
    labels = [item["label"] for item in state["files"]]
    names = [re.fullmatch(r"\./files/([^/\\\0]+)", item["path"]) for item in state["files"]]
    if len(set(labels)) < len(labels) or any(label != label_of(label) for label in labels) or not all(names):
        raise ValueError
    texts: list[Any] = []
    for run in state["runs"]:
        texts += [run["key"], run["kind"], run["title"], run["state"], run["message"]]
        known = run["kind"] in ("run", "sweep") and run["state"] in ("running", "done", "cancelled", "failed")
        if not known or RUN_KEY.fullmatch(run["key"]) is None or not isinstance(run["converged"], bool):
            raise ValueError
    tables = [state["table"], *state["before"], *(run["table"] for run in state["runs"])]
    if not all(isinstance(text, str) for text in texts) or not all(isinstance(table, dict) for table in tables):
        raise TypeError


def label_of(name: str) -> str:
    """Name of an upload as it is shown and as its file is called: no folders, no control
    characters, not long."""
    plain = printable(name.replace("\\", "/").rpartition("/")[2]).replace("\\", "_").strip().lstrip(". ") or "file"
    if len(plain) <= 80 and len(plain.encode()) <= LONGEST:
        return plain
    head, tail = plain[:60], plain[-18:]
    while len(f"{head}…{tail}".encode()) > LONGEST:
        head = head[:-1]
    return f"{head}…{tail}"
