"""The problem document: one versioned, schema-checked text that describes a contact problem, its
load and its solver.

Every shell (command line, study, web) is a way to fill in this document. Quantities are text with
units. Beside the core (``io.schemas.problem``) it holds the tables that the parts declare.
"""

from __future__ import annotations

import functools
import json
import os
import re
import tomllib
import zipfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from importlib import resources
from pathlib import Path
from types import MappingProxyType
from typing import Any, Optional, TypeVar

from pydantic import Field, create_model

from ..core.errors import FileFormatError, InputError
from ..core.settings import Settings, validated
from ..core.text import read_text
from ..io.atomic import atomic_file
from ..io.schemas.bodies import base_from_text, body_from_text
from ..io.schemas.problem import ProblemDocument
from ..io.schemas.surfaces import ScanFile
from ..parts.part import Part
from ..parts.registry import parts

__all__ = [
    "DEMO",
    "EXAMPLES",
    "PRESETS",
    "TRACTIONS",
    "ProblemDocument",
    "built_in",
    "checked",
    "checked_parts",
    "document_model",
    "dumps",
    "json_schema",
    "load_document",
    "loads",
    "picture",
    "read_table",
    "relocated",
    "renamed",
    "save_document",
    "tidy",
    "validated",
]


D = TypeVar("D", bound=Settings)

TRACTIONS = "tractions"
"""Table of documents that prescribe tractions and have no contact (``run.tractions``)."""


def renamed() -> dict[str, str]:
    """Keys of version 1, and where version 2 has them."""
    return {f"{part.table}.{key}": to for part in parts() for key, to in part.moved.items()}


@functools.lru_cache(maxsize=8)
def document_model(known: tuple[Part, ...] = ()) -> type[ProblemDocument]:
    """Model of the document: the core, and the table of every part, of those ``known`` or all that
    are installed."""
    tables = _tables(known or parts())
    made: Any = create_model("ProblemDocument", __base__=ProblemDocument, __doc__=ProblemDocument.__doc__, **tables)
    model: type[ProblemDocument] = made
    return model


def _tables(known: tuple[Part, ...]) -> dict[str, Any]:
    """Type and default of the table of each ``known`` part that declares settings."""
    made: dict[str, Any] = {}
    for part in known:
        settings: Any = part.settings
        if settings is not None:
            optional = (Optional[settings], None)  # noqa: UP045  (a value here, no annotation)
            made[part.table] = (settings, Field(default_factory=settings)) if part.in_every_document else optional
    return made


def load_document(path: str | os.PathLike[str]) -> ProblemDocument:
    """Document in the TOML file, or JSON file if its name ends in ``.json``, at ``path``.

    Raises
    ------
    FileFormatError
        If the file is missing, unreadable, or neither TOML nor JSON.
    InputError
        If the document has problems; the message has one line for each.
    """
    return checked(read_table(path), f"problem document {path}")


def loads(text: str, *, form: str = "toml") -> ProblemDocument:
    """Document in ``text``, which is ``toml`` or ``json``; errors as in :func:`load_document`."""
    return checked(_parsed(text, form, "problem document"), "problem document")


PRESETS = ("head-disk", "disk-and-slider", "mems")
"""Documents of this package, each with its source: interfaces of the literature with roughness,
bodies, film and load."""

EXAMPLES: Mapping[str, str] = MappingProxyType(
    {
        "coated-disk": "Which spots carry a sliding head, and does the coating under them yield?",
        "ball-on-coating": "How deep do the stresses of a ball reach below a hard coating?",
        "rubber-on-ground": "How do the spots grow, and run together, while the load rises?",
        "flattened-metal": "How much of a metal face flows, and what stays flat without the load?",
        "humid-air": "How much water condenses around the spots, and how hard does it pull?",
        "fretting": "Where do two faces stick, and where do they slip, when they are shifted?",
        "connector": "Through which spots does the current flow, and how many milliohms are left?",
        "metal-seal": "Which way does a liquid find through the gap, and how much of it leaks?",
        "running-in": "How do the summits of a coating wear flat, and how far do pressures and stresses fall?",
    }
)
"""Further documents of this package, each solved in a second or so, and the question that each of
them answers."""

DEMO = "coated-disk"
"""The document of the demonstration."""


def built_in(name: str) -> str:
    """Text of the document of this package that is called ``name``, of ``PRESETS`` or
    ``EXAMPLES``."""
    folder = "presets" if name in PRESETS else "examples"
    return resources.files("asperity").joinpath("data", folder, f"{name}.toml").read_text(encoding="utf-8")


def picture(name: str) -> bytes:
    """Picture (PNG) of the result of the example ``name``, of ``EXAMPLES``."""
    return resources.files("asperity").joinpath("data", "examples", f"{name}.png").read_bytes()


PROBLEM = "problem.toml"
"""The document in the folder of a run, and at the root of an archive of a problem."""


def is_archive(path: str | os.PathLike[str]) -> bool:
    """Whether the file at ``path`` is an archive of a problem."""
    if Path(path).suffix.lower() != ".zip" or not zipfile.is_zipfile(path):
        return False
    try:
        with zipfile.ZipFile(path) as archive:
            return PROBLEM in archive.namelist()
    except (OSError, zipfile.BadZipFile, NotImplementedError):
        return False


def read_table(path: str | os.PathLike[str], what: str = "problem document") -> dict[str, Any]:
    """Content of the file at ``path`` before any check of keys and values; ``what`` it is called in
    messages.

    A name of ``PRESETS`` or ``EXAMPLES`` stands for that document where there is no such file.

    Raises
    ------
    FileFormatError
        If the file is missing, unreadable, or neither TOML nor JSON.
    """
    if str(path) in {*PRESETS, *EXAMPLES} and not Path(path).exists():
        return _parsed(built_in(str(path)), "toml", f"{what} {path}")
    return _parsed(read_text(Path(path), what), _form(Path(path)), f"{what} {path}")


def checked(
    table: Mapping[str, Any],
    where: str = "problem document",
    names: Mapping[str, str] | None = None,
    known: tuple[Part, ...] = (),
) -> ProblemDocument:
    """Document made of the nested ``table``.

    Parameters
    ----------
    table
        Content of the document.
    where
        What is checked, for the message.
    names
        What to call a dotted key in messages instead, for example ``{"control.force": "--load"}``.
    known
        Parts whose tables it may hold; all that are installed by default.

    Raises
    ------
    InputError
        If anything is missing, unknown or out of range; the message has one line for each problem.
    """
    return validated(document_model(() if known == parts() else known), upgraded(table), where, names)


def checked_parts(table: Mapping[str, Any], where: str, names: Mapping[str, str] | None = None) -> Any:
    """The tables of parts in ``table``, which has no others; arguments and errors as for
    :func:`checked`."""
    model: type[Settings] = create_model("Parts", __base__=Settings, **_tables(parts()))
    return validated(model, table, where, names)


def upgraded(table: Mapping[str, Any]) -> dict[str, Any]:
    """``table`` of version 1 as version 2, in which friction has a table of its own; any other as
    it is.

    Raises
    ------
    InputError
        If two tables have different coefficients of friction.
    """
    new = dict(table)
    if table.get("version") != 1:
        return new
    new["version"] = 2
    friction: dict[str, Any] = {}
    moving = {part.table: part for part in parts() if part.moved and isinstance(table.get(part.table), Mapping)}
    before = {name: dict(table[name]) for name in moving}
    given = {name: own["friction"] for name, own in sorted(before.items(), reverse=True) if own.get("friction")}
    if any(value != next(iter(given.values())) for value in given.values()):
        (one, first), (other, second), *_ = given.items()
        raise InputError(
            f"{one}.friction must be {other}.friction, but they are {first!r} and {second!r}: "
            "there is one friction in a contact, friction.coefficient of version 2."
        )
    for name, part in moving.items():
        if given and name not in given:
            before[name] |= part.unmoved
        for old, key in part.moved.items():
            if old in before[name]:
                own, value = key.partition(".")[2], before[name].pop(old)
                friction[own] = value or friction.get(own, value)
    return {**new, **before, **({"friction": friction} if friction else {})}


def dumps(document: Settings, *, form: str = "toml") -> str:
    """Text of ``document`` as ``toml`` or ``json``; loading it gives an equal document."""
    table = tidy(document.model_dump(mode="json", exclude_none=True))
    if form == "json":
        return json.dumps(table, indent=2, ensure_ascii=False) + "\n"
    import tomli_w

    return tomli_w.dumps(table)


def save_document(document: ProblemDocument, path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
    """Write ``document`` to ``path`` as TOML, or JSON if the name ends in ``.json``, wholly or not
    at all.

    Relative file paths are written as they are; see :func:`relocated`.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    with atomic_file(Path(path), overwrite=overwrite) as partial:
        partial.write_text(dumps(document, form=_form(Path(path))), encoding="utf-8", newline="\n")


def json_schema() -> dict[str, Any]:
    """JSON schema of the document, for forms and editors."""
    return document_model().model_json_schema()


def relocated(document: D, source: Path, target: Path) -> D:
    """``document`` of the folder ``source`` for use in the folder ``target``: relative paths lead
    to the same files."""

    def moved(path: str) -> str:
        if Path(path).is_absolute():
            return path
        found = source.absolute() / path
        try:
            return Path(os.path.relpath(found, target.absolute())).as_posix()
        except ValueError:  # on Windows: another drive
            return str(found)

    elsewhere: D = with_paths(document, moved)
    return elsewhere


def files_of(document: ProblemDocument, folder: Path) -> list[Path]:
    """The files that ``document`` names, whose relative paths start at ``folder``."""
    found: list[Path] = []

    def seen(path: str) -> str:
        found.append(folder / path)
        return path

    with_paths(document, seen)
    return found


_MODULI = re.compile(r"moduli\s*=\s*([^,:}]+)")
"""File of moduli in the text of a body."""


def files_named(table: Any) -> Iterator[str]:
    """Names of files in the nested ``table``, which has not been checked; in doubt too many."""
    found: list[str] = []

    def seen(name: str) -> str:
        found.append(name)
        return name

    level = [with_files(table, seen)]
    yield from found
    while level:
        item = level.pop()
        if isinstance(item, str):
            yield from (name.strip() for name in _MODULI.findall(item))
        level += item.values() if isinstance(item, Mapping) else item if isinstance(item, list) else ()


def with_files(table: Any, moved: Callable[[str], str]) -> Any:
    """Nested ``table``, which has not been checked, with the file names in it replaced. The text of
    a body or a scan with a file becomes a table."""
    if isinstance(table, list):
        return [with_files(item, moved) for item in table]
    if not isinstance(table, Mapping):
        return table
    made: dict[str, Any] = {}
    for key, value in table.items():
        if isinstance(value, str) and names_file(key):
            made[key] = moved(value)
        elif key == "scans" and isinstance(value, list):
            made[key] = with_files([ScanFile.from_text(v) if isinstance(v, str) else v for v in value], moved)
        elif key in _BODIES and isinstance(value, str) and _MODULI.search(value):
            with suppress(InputError):
                value = with_files(_BODIES[key](value), moved)
            made[key] = value
        else:
            made[key] = with_files(value, moved)
    return made


_BODIES = MappingProxyType({"body": body_from_text, "counter_body": body_from_text, "base": base_from_text})
"""What reads the text at a key."""


def tidy(table: dict[str, Any]) -> dict[str, Any]:
    """``table`` without empty parts, the key of its kind first and the preparation last."""
    filled = {key: tidy(value) if isinstance(value, dict) else value for key, value in table.items()}
    kept = {key: value for key, value in filled.items() if value not in ({}, [], "")}
    return dict(sorted(kept.items(), key=lambda item: (item[0] != "kind") + (item[0] == "prepare")))


def names_file(key: str) -> bool:
    """Whether the text at ``key`` names a file."""
    return key == "path" or key.endswith("_file")


def with_paths(table: Any, moved: Callable[[str], str]) -> Any:
    """``table`` with the file names in it and in the tables within it replaced."""
    if type(table) is tuple and any(isinstance(item, Settings) for item in table):
        return tuple(with_paths(item, moved) for item in table)
    if not isinstance(table, Settings):
        return table
    changed: dict[str, Any] = {}
    for key in type(table).model_fields:
        value = getattr(table, key)
        if isinstance(value, Settings | tuple):
            changed[key] = with_paths(value, moved)
        elif value is not None and names_file(key):
            changed[key] = moved(value)
    return table.model_copy(update=changed) if changed else table


DEEPEST = 16
"""Tables within tables and lists; documents of this package have eight. Parsers take time that
grows with the square of it."""

_LONG_KEY = re.compile(r"""(?<![\w"'-])[\w"'-]+(?:[ \t]*\.[ \t]*[\w"'-]+){16,}""")


def _form(path: Path) -> str:
    return "json" if path.suffix.lower() == ".json" else "toml"


def _parsed(text: str, form: str, where: str) -> dict[str, Any]:
    try:
        if _LONG_KEY.search(text):
            raise ValueError(f"it has a key of more than {DEEPEST} parts")
        table = json.loads(text) if form == "json" else tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        raise FileFormatError(f"{where} must be valid {form.upper()}, but is not: {error}.") from None
    if not isinstance(table, dict):
        raise FileFormatError(f"{where} must hold a table of keys, but holds {type(table).__name__}.")
    level: list[Any] = [table]
    for _ in range(DEEPEST):
        level = [
            item
            for node in level
            for item in (node.values() if isinstance(node, dict) else node)
            if isinstance(item, dict | list)
        ]
    if level:
        raise FileFormatError(f"{where} must be nested at most {DEEPEST} deep, but is deeper.")
    return table
