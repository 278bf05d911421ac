"""A problem with the files that it names, in one folder or one archive, so that it is solved again
on another machine.

An archive is a zip file with ``problem.toml`` at its root. It may come from a stranger: only that
document and the files that it names are taken out, and they lie in the folder that is meant.
"""

from __future__ import annotations

import os
import shutil
import stat
import zipfile
import zlib
from collections.abc import Collection, Mapping
from itertools import count
from pathlib import Path, PurePosixPath

from ..core.errors import FileFormatError, OutputError
from ..core.words import printable
from ..io.atomic import atomic_file
from .document import PROBLEM, ProblemDocument, dumps, files_named, files_of, read_table, with_paths

LARGEST_DOCUMENT = 2**24
"""Bytes of a document in an archive."""


def gathered(
    document: ProblemDocument, base: Path, taken: Collection[str] = (), within: Path | None = None
) -> tuple[ProblemDocument, dict[str, Path]]:
    """``document``, whose relative paths start at ``base``, for a folder that holds its files under
    their own names, and these files by the names.

    Files that do not lie ``within`` a folder stay where they are, if one is given. A file whose
    name is ``taken``, or that of another one, gets a number.
    """
    names: dict[Path, str] = {}
    used = {name.casefold() for name in (PROBLEM, *taken)}
    for file in files_of(document, base):
        source = file.resolve()
        if source in names or (within is not None and not source.is_relative_to(within.resolve())):
            continue
        stem, suffix = file.stem, file.suffix
        wanted = (file.name if number == 1 else f"{stem} ({number}){suffix}" for number in count(1))
        names[source] = next(name for name in wanted if name.casefold() not in used)
        used.add(names[source].casefold())

    def moved(path: str) -> str:
        source = (base / path).resolve()
        return names.get(source, str(source))

    return with_paths(document, moved), {name: source for source, name in names.items()}


def carried(
    document: ProblemDocument, base: Path, folder: Path, taken: Collection[str] = (), within: Path | None = None
) -> ProblemDocument:
    """Put the files of ``document`` into ``folder``; the document for it, see :func:`gathered`.

    Raises
    ------
    OutputError
        If that fails.
    """
    found, files = gathered(document, base, taken, within)
    for name, source in files.items():
        try:
            try:
                os.link(source, folder / name)
            except OSError:  # another file system
                shutil.copyfile(source, folder / name)
        except OSError as error:
            raise OutputError(
                f"file {name} cannot be put into {folder}: {error.strerror}; check rights and free space."
            ) from None
    return found


def write_archive(
    target: Path, document: ProblemDocument, base: Path, more: Mapping[str, Path], *, overwrite: bool = False
) -> None:
    """Write ``document``, whose relative paths start at ``base``, its files and ``more`` of them by
    their names to the archive ``target``.

    Raises
    ------
    OutputError
        If it exists and ``overwrite`` is false, a file is gone, or it cannot be written.
    """
    found, files = gathered(document, base, more)
    with (
        atomic_file(target, overwrite=overwrite) as partial,
        zipfile.ZipFile(partial, "w", zipfile.ZIP_DEFLATED) as archive,
    ):
        archive.writestr(PROBLEM, dumps(found))
        for name, source in (files | dict(more)).items():
            archive.write(source, name)


def unpack(file: Path, folder: Path, largest: float = float("inf")) -> Path:
    """Take the document of the archive ``file``, and what it names, out into the empty ``folder``;
    the path of the document there.

    Raises
    ------
    FileFormatError
        If it is damaged or no archive of a problem, its document names a file that it does not
        hold, or it would have more than ``largest`` bytes, or more than are free.
    """
    try:
        with zipfile.ZipFile(file) as archive:
            document = _taken_out(archive, PROBLEM, folder, LARGEST_DOCUMENT)
            names = dict.fromkeys(files_named(read_table(document)))
            free = min(largest, shutil.disk_usage(folder).free)
            for name in names:
                free -= _taken_out(archive, name, folder, free).stat().st_size
    except (OSError, zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, ValueError, RuntimeError) as error:
        if isinstance(error, FileFormatError):
            raise
        said = getattr(error, "strerror", None) or error
        raise FileFormatError(
            f"archive of a problem must be a whole zip file, but {file} is not: {said}; copy it again."
        ) from None
    return document


def _taken_out(archive: zipfile.ZipFile, name: str, folder: Path, largest: float) -> Path:
    """The entry ``name`` of the ``archive`` as a file in ``folder``."""
    parts = PurePosixPath(name).parts
    plain = parts and "/".join(parts) == name and ".." not in parts and not set(name) & set("\\:\0")
    found = [entry for entry in archive.infolist() if entry.filename == name] if plain and parts[0] != "/" else []
    whole = len(found) == 1 and not found[0].is_dir() and stat.S_IFMT(found[0].external_attr >> 16) in (0, stat.S_IFREG)
    where = archive.filename
    if not whole or found[0].flag_bits & 1:
        raise FileFormatError(
            f"archive of a problem must hold {PROBLEM} and the files that it names, plain and once, but {where} does "
            f"not hold {printable(name)} so. Pack the document with its files, and name them as they lie there."
        )
    if found[0].file_size > largest:
        raise FileFormatError(
            f"archive of a problem must unpack to what there is room for, but {printable(name)} of {where} has "
            f"{found[0].file_size:.4g} bytes and {max(largest, 0):.4g} are left. Make room, or leave the file out."
        )
    target = folder.joinpath(*parts)
    target.parent.mkdir(parents=True, exist_ok=True)
    with archive.open(found[0]) as source, target.open("xb") as copy:
        shutil.copyfileobj(source, copy, 2**20)
    return target
