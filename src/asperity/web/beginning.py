"""The first content of a session: the demonstration, named files, or an empty document."""

from __future__ import annotations

import tempfile
import tomllib
from collections.abc import Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ..core.errors import InputError
from ..run.archive import unpack
from ..run.document import DEMO, built_in, files_named, is_archive, read_table
from .draft import relabelled
from .session import Session

LEVELLED = MappingProxyType({"step": "level", "form": "plane"})
FILLED = MappingProxyType({"step": "fill", "method": "harmonic"})
"""What is done to every measured surface unless it is removed, as on the command line."""

GRID = MappingProxyType({"points": "256x256", "size": "10 um x 10 um"})
"""Grid of a surface that is generated, until a person gives another one."""


def measured(path: str) -> dict[str, Any]:
    """Table of the surface in the file ``path``."""
    return {"kind": "file", "path": path, "prepare": [dict(LEVELLED), dict(FILLED)]}


def scanned(paths: Sequence[str]) -> dict[str, Any]:
    """Table of a surface that is generated from the scans in the files ``paths``."""
    spectrum = {"kind": "scans", "scans": [{"path": path} for path in paths]}
    return {"kind": "rough", **GRID, "seed": 1, "spectrum": spectrum}


def fill(session: Session, *, files: Sequence[Path] = (), demo: bool = False) -> None:
    """Fill the document of a new session with the demonstration, or the ``files`` that were named.

    Raises
    ------
    InputError
        If one is no file.
    """
    if demo:
        session.draft.replace(tomllib.loads(built_in(DEMO)))
    for file in files:
        if not file.is_file():
            raise InputError(
                f"FILE must be a file with heights or a problem document, but {file} is none; check the path."
            )
        if is_document(file):
            open_document(session, file)
            continue
        path = session.take_file(file)
        if session.draft.get("surface") is None:
            session.draft.set(("surface",), measured(path))


def is_document(file: Path) -> bool:
    """Whether ``file`` is a problem document, or an archive with one."""
    return file.suffix.lower() in (".toml", ".json") or is_archive(file)


def open_document(session: Session, file: Path) -> None:
    """Take the problem of the document or archive ``file``, with the files that it names, which
    become files of the ``session``.

    Raises
    ------
    InputError
        If it is damaged or too large, or names a file that is not there.
    """
    if is_archive(file):
        file = unpack(file, Path(tempfile.mkdtemp(prefix="archive-", dir=session.scratch)), session.room())
    table, paths = read_table(file), {}
    for name in files_named(table):
        if not (file.parent / name).is_file():
            raise InputError(
                f"problem document must name files that exist, but {name} of {file} is none; correct its path, which "
                "starts at the folder of the document."
            )
        paths[name] = session.take_file(file.parent / name)
    session.draft.replace(relabelled(table, paths))
