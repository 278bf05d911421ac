"""Output appears whole or not at all: write beside the target, rename on success, clean up on any failure."""

from __future__ import annotations

import secrets
import shutil
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from ..core.errors import AsperityError, OutputError

OVERWRITE = "overwrite it with overwrite=True (--force)"
"""The fix where something exists already, in Python and on the command line."""


@contextmanager
def atomic_file(path: str | Path, *, overwrite: bool = False) -> Iterator[Path]:
    """Yield the path of a temporary file beside ``path``; rename it to ``path`` on success, else remove it.

    The temporary file has the suffix of ``path`` and exists already, so an unwritable folder fails before any work.

    Raises
    ------
    OutputError
        If ``path`` exists and ``overwrite`` is false, is a folder, lies in no folder, or cannot be written.
    """
    target = Path(path)
    require_new_file(target, overwrite=overwrite)
    with _partial(target) as partial:
        partial.touch()
        yield partial
        require_new_file(target, overwrite=overwrite)
        partial.replace(target)


@contextmanager
def atomic_folder(path: str | Path, *, overwrite: bool = False) -> Iterator[Path]:
    """Yield the path of a temporary folder beside ``path``; rename it to ``path`` on success, else remove it.

    Missing folders above ``path`` are made. With ``overwrite``, files of an existing folder are replaced by new ones
    of the same name; all others are kept. An existing empty folder needs no ``overwrite``.

    Raises
    ------
    OutputError
        If ``path`` holds anything and ``overwrite`` is false, is a file, or cannot be written.
    """
    target = Path(path)
    _require_new_folder(target, overwrite=overwrite)
    with _partial(target) as partial:
        partial.mkdir(parents=True)
        yield partial
        _require_new_folder(target, overwrite=overwrite)
        if target.exists():
            _move_contents(partial, target)
        else:
            partial.replace(target)


@contextmanager
def _partial(target: Path) -> Iterator[Path]:
    """A name beside ``target`` that is gone at the end, whatever happens; a failure to write is one sentence."""
    absolute = target.absolute()
    partial = absolute.with_name(f".{absolute.stem[:100]}.{secrets.token_hex(4)}.partial{absolute.suffix}")
    try:
        yield partial
    except AsperityError:
        raise
    except OSError as error:
        raise OutputError(
            f"{target} cannot be written: {error.strerror or error}; check rights, path and free space."
        ) from error
    finally:
        _remove(partial)


def require_new_file(target: Path, *, overwrite: bool) -> None:
    """Refuse a ``target`` that cannot be written as a new file.

    Raises
    ------
    OutputError
        If ``target`` exists and ``overwrite`` is false, is a folder, or lies in no folder.
    """
    if not target.parent.is_dir():
        raise OutputError(f"output file must lie in an existing folder, but {target.parent} is none; create it first.")
    if target.is_dir():
        raise OutputError(f"output file must not be a folder, but {target} is one; add a file name.")
    if target.exists() and not target.is_file():
        raise OutputError(f"output file must be an ordinary file, but {target} is a device; choose another name.")
    if target.exists() and not overwrite:
        raise OutputError(f"output file must not exist yet, but {target} does; choose another name or {OVERWRITE}.")


def require_new_files(targets: Sequence[Path], *, overwrite: bool) -> None:
    """Refuse ``targets`` of which two are the same, or one cannot be written as a new file.

    Raises
    ------
    OutputError
        As said.
    """
    for number, target in enumerate(targets):
        require_new_file(target, overwrite=overwrite)
        if target.absolute() in [other.absolute() for other in targets[:number]]:
            raise OutputError(f"output files must differ, but {target} is given twice; choose another name for one.")


def _require_new_folder(target: Path, *, overwrite: bool) -> None:
    if target.exists() and not target.is_dir():
        raise OutputError(f"output folder must not be a file, but {target} is one; choose another name.")
    if target.is_dir() and not overwrite and any(target.iterdir()):
        raise OutputError(f"output folder must be new or empty, but {target} is not; choose another or {OVERWRITE}.")


def _move_contents(source: Path, target: Path) -> None:
    for entry in sorted(source.iterdir()):
        destination = target / entry.name
        if entry.is_dir() and destination.is_dir():
            _move_contents(entry, destination)
        else:
            entry.replace(destination)


def _remove(partial: Path) -> None:
    if partial.is_dir():
        shutil.rmtree(partial, ignore_errors=True)
    with suppress(OSError):
        partial.unlink()
