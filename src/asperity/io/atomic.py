"""Output appears whole or not at all: write beside the target, rename on success, clean up on
failure or in the next run."""

from __future__ import annotations

import ctypes
import importlib.util
import os
import re
import secrets
import shutil
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from ..core.errors import AsperityError, OutputError

OVERWRITE = "{overwrite}"
"""The fix where something exists already."""


@contextmanager
def atomic_file(path: str | Path, *, overwrite: bool = False) -> Iterator[Path]:
    """Yield the path of a temporary file beside ``path``; rename it to ``path`` on success, else
    remove it.

    The temporary file has the suffix of ``path`` and exists already, so an unwritable folder fails
    before any work. A file that is replaced leaves its mode to the new one; a symbolic link stays
    and leads to the new file.

    Raises
    ------
    OutputError
        If ``path`` exists and ``overwrite`` is false, is a folder, lies in no folder, or cannot be
        written.
    """
    target = Path(path)
    require_new_file(target, overwrite=overwrite)
    target = Path(os.path.realpath(target)) if target.is_symlink() else target
    with _partial(target) as partial:
        yield partial
        require_new_file(target, overwrite=overwrite)
        if target.exists():
            shutil.copymode(target, partial)
        partial.replace(target)


@contextmanager
def atomic_folder(path: str | Path, *, overwrite: bool = False) -> Iterator[Path]:
    """Yield the path of a temporary folder beside ``path``; rename it to ``path`` on success, else
    remove it.

    Missing folders above ``path`` are made. With ``overwrite``, an existing folder is exchanged at
    once for the new one, which takes over (by hard links) what it does not replace; only in the
    working folder files are replaced one by one. An existing empty folder needs no ``overwrite``.

    Raises
    ------
    OutputError
        If ``path`` holds anything and ``overwrite`` is false, is a file, or cannot be written.
    """
    target = Path(path)
    _require_new_folder(target, overwrite=overwrite)
    target = Path(os.path.realpath(target))
    with _partial(target, folder=True) as partial:
        yield partial
        _require_new_folder(target, overwrite=overwrite)
        if not target.exists():
            partial.replace(target)
        elif Path.cwd().is_relative_to(target):
            _move_contents(partial, target)
        else:
            _keep(target, partial)
            _exchange(partial, target)


@contextmanager
def _partial(target: Path, *, folder: bool = False) -> Iterator[Path]:
    """A new file or folder beside ``target`` that is gone at the end; a failure to write is one
    sentence.

    It is locked until this process ends, so that what a killed process has left can be recognised
    and removed.
    """
    absolute = target.absolute()
    held, partial = -1, absolute
    start, end = f".{absolute.stem[:30]}.", f".partial{absolute.suffix if len(absolute.suffix) < 20 else ''}"
    try:
        if folder:
            absolute.parent.mkdir(parents=True, exist_ok=True)
        name = re.compile(re.escape(start) + "[0-9a-f]{8}" + re.escape(end))
        with suppress(
            OSError
        ):  # what killed processes have left is removed, and a folder that one had moved away put back
            for entry in [entry.name for entry in os.scandir(absolute.parent) if entry.name.startswith(".")]:
                path = absolute.with_name(entry)
                if entry.endswith(_AWAY) and name.fullmatch(entry.removesuffix(_AWAY)):
                    path.rename(absolute) if not absolute.exists() else _remove(path)
                elif name.fullmatch(entry) and (left := lock(path)) >= 0:
                    _remove(path)
                    os.close(left)
        while held == -1:
            partial = absolute.with_name(f"{start}{secrets.token_hex(4)}{end}")
            partial.mkdir() if folder else partial.touch()
            held = lock(partial)
        yield partial
    except OutputError as error:  # of a file inside the folder: it will be where the folder is to be
        hidden, shown = str(partial), str(target)
        if hidden not in str(error):
            raise
        raise OutputError(str(error).replace(hidden, shown), subject=error.subject.replace(hidden, shown)) from error
    except AsperityError:
        raise
    except OSError as error:
        raise OutputError(
            f"{target} cannot be written: {error.strerror or error}; check rights, path and free space.",
            subject=str(target),
        ) from error
    finally:
        if partial != absolute:
            _remove(partial)
        if held >= 0:
            os.close(held)


def lock(path: Path) -> int:
    """Descriptor that locks ``path`` until it is closed; -1 if another process has it, -2 where
    there are no locks."""
    if importlib.util.find_spec("fcntl") is None:  # Windows
        return -2
    import fcntl

    try:
        held = os.open(path, os.O_RDONLY)
    except FileNotFoundError:  # taken for that of a killed process before it was locked
        return -1
    try:
        fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        os.close(held)
        return -1
    except OSError:  # a file system without locks
        os.close(held)
        return -2
    return held


_AWAY = ".old"
"""Ending of a folder that has been moved away to make room for the new one."""


def _exchange(new: Path, old: Path) -> None:
    """Let two folders change their names, at once where the system can."""
    names = [os.fsencode(path) for path in (new, old)]
    library: Any = ctypes.CDLL(None) if sys.platform != "win32" else None
    done = -1
    if hasattr(library, "renameat2"):  # Linux: AT_FDCWD, RENAME_EXCHANGE
        done = library.renameat2(-100, names[0], -100, names[1], 2)
    elif hasattr(library, "renamex_np"):  # macOS: RENAME_SWAP
        done = library.renamex_np(*names, 2)
    if done != 0:
        away = new.with_name(f"{new.name}{_AWAY}")
        old.rename(away)
        new.rename(old)
        away.rename(new)


def _keep(source: Path, target: Path) -> None:
    """Give the folder ``target`` all that ``source`` has and it lacks, and the modes of what it
    replaces."""
    for entry in source.iterdir():
        kept = target / entry.name
        if entry.is_dir() and not entry.is_symlink():
            if not kept.exists():
                kept.mkdir()
            _keep(entry, kept)
        elif kept.exists():
            shutil.copymode(entry, kept)
        else:
            try:
                os.link(entry, kept, follow_symlinks=False)
            except (OSError, NotImplementedError):  # a file system without hard links, or a system that follows all
                shutil.copy2(entry, kept, follow_symlinks=False)
    shutil.copymode(source, target)


def require_new_file(target: Path, *, overwrite: bool) -> None:
    """Refuse a ``target`` that cannot be written as a new file.

    Raises
    ------
    OutputError
        If ``target`` exists and ``overwrite`` is false, is a folder, lies in no folder, or is no
        possible name.
    """
    exists = _exists(target)
    if not target.parent.is_dir():
        raise OutputError(f"output file must lie in an existing folder, but {target.parent} is none; create it first.")
    if target.is_dir():
        raise OutputError(f"output file must not be a folder, but {target} is one; add a file name.")
    if exists and not target.is_file():
        raise OutputError(f"output file must be an ordinary file, but {target} is a device; choose another name.")
    if exists and not overwrite:
        raise OutputError(f"output file must not exist yet, but {target} does; choose another name or {OVERWRITE}.")


def require_new_files(targets: Sequence[Path], *, overwrite: bool, inputs: Sequence[Path] = ()) -> None:
    """Refuse ``targets`` of which two are the same, one is among the ``inputs``, or cannot be
    written as a new file.

    Raises
    ------
    OutputError
        If that is so.
    """
    for number, target in enumerate(targets):
        if _exists(target) and any(path.exists() and path.samefile(target) for path in inputs):
            raise OutputError(f"output file must not be the input, but {target} is; choose another name.")
        require_new_file(target, overwrite=overwrite)
        if os.path.realpath(target) in [os.path.realpath(other) for other in targets[:number]]:
            raise OutputError(f"output files must differ, but {target} is given twice; choose another name for one.")


def _require_new_folder(target: Path, *, overwrite: bool) -> None:
    if _exists(target) and not target.is_dir():
        raise OutputError(f"output folder must not be a file, but {target} is one; choose another name.")
    if target.is_dir() and not overwrite and any(target.iterdir()):
        raise OutputError(f"output folder must be new or empty, but {target} is not; choose another or {OVERWRITE}.")


def _exists(target: Path) -> bool:
    """Whether there is something; an ``OutputError`` if there cannot be, as its name is too long
    for one."""
    try:
        target.stat()
    except (FileNotFoundError, NotADirectoryError):
        return False
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise OutputError(f"{target} cannot be written: {reason}; choose another name.", subject=str(target)) from None
    return True


def _move_contents(source: Path, target: Path) -> None:
    for entry in sorted(source.iterdir()):
        destination = target / entry.name
        if entry.is_dir() and destination.is_dir():
            _move_contents(entry, destination)
        else:
            entry.replace(destination)


def _remove(partial: Path) -> None:
    if partial.is_dir() and not partial.is_symlink():
        shutil.rmtree(partial, ignore_errors=True)
    with suppress(OSError):
        partial.unlink()
