"""Archives of scans: compressed files (.gz), zip archives, and containers of
contact.engineering."""

from __future__ import annotations

import gzip
import json
import shutil
import zipfile
import zlib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

from ..core.errors import FileFormatError
from ..core.status import require_memory
from ..core.units import unit_factor

_INDICES = ("main.xml", "index.xml", "[content_types].xml", "scaninfo.ini", "topo.xml")
"""Members, in small letters, by which the formats of instruments that are archives are known."""

_CONTAINER = ("index.json", "meta.yml")
_PROBLEM = "problem.toml"
_NO_SCANS = (".json", ".yml", ".yaml", ".xml", ".md", ".html", ".pdf", ".ini", ".log", ".py", ".toml")
_ZIP = b"PK\x03\x04"
_GZIP = b"\x1f\x8b"


@dataclass(frozen=True)
class Scan:
    """A scan in an archive: its ``member``, its ``name``, and what the index of a container states
    of it.

    ``size`` (Lx, Ly) in m, ``height_unit`` and the factor ``height_scale`` hold where the file does
    not state its own.
    """

    member: str
    name: str
    size: tuple[float, float] | None = None
    height_unit: str | None = None
    height_scale: float = 1.0


class Unpacked(NamedTuple):
    """A file to read instead of one that is packed: its ``path``, how it is ``shown``, the
    ``channel`` in it that is asked for, its ``scan``."""

    path: Path
    shown: str
    channel: str | int | None
    scan: Scan = Scan("", "")


def scans(file: Path) -> tuple[Scan, ...] | None:
    """Scans of a zip archive or a container of contact.engineering, in its order; None for any
    other file and the archives of instruments.

    Raises FileFormatError for the archive of a problem, and for one that is damaged.
    """
    with file.open("rb") as stream:
        if stream.read(4) != _ZIP:
            return None
    try:
        with zipfile.ZipFile(file) as archive:
            names = [info.filename for info in archive.infolist() if not info.is_dir()]
            index = next((name for name in _CONTAINER if name in names and "main.xml" not in names), None)
            content = archive.read(index) if index is not None else b""
    except Exception as error:  # the library raises many types on damaged bytes
        raise FileFormatError(f"file {file} must be a whole zip archive, but cannot be opened ({error}).") from None
    if _PROBLEM in names:
        raise FileFormatError(
            f"file {file} must hold heights, but is a shared problem: unpack it and give its {_PROBLEM} to {{run}}."
        )
    if index is not None:
        return _of_container(file, index, content)
    bases = [PurePosixPath(name).name.lower() for name in names]
    if set(_INDICES) & set(bases) or all(name.endswith(".npy") for name in bases):
        return None
    if any(name.endswith((".raw", ".dat", ".bin")) for name in bases) and "data.xml" in bases:
        return None
    kept = [
        name
        for name, base in zip(names, bases, strict=True)
        if "." in base and not base.startswith((".", "readme")) and not base.endswith(_NO_SCANS)
    ]
    kept = [name for name in kept if not name.startswith("__MACOSX/")]
    if not kept and names and all(base.endswith(_NO_SCANS) or base.startswith("readme") for base in bases):
        raise FileFormatError(f"file {file} must hold scans, but holds {', '.join(names[:3])} only.")
    return tuple(Scan(name, name) for name in kept) or None


def _of_container(file: Path, index: str, content: bytes) -> tuple[Scan, ...]:
    """Scans of a container by its ``index`` file: the original data, or else the NetCDF file that
    was made of them."""
    try:
        described = json.loads(content) if index.endswith(".json") else _yaml(content)
        found = [scan for surface in described["surfaces"] for scan in surface["topographies"]]
        made = []
        for scan in found:
            files = scan["datafile"]
            member = files.get("original") or files["squeezed-netcdf"]
            size, unit = scan.get("size"), str(scan.get("unit") or "")
            metre = unit_factor(unit, "length", f"unit in {index} of file {file}") if unit else None
            sides = (float(size[0]) * metre, float(size[1]) * metre) if metre and size and len(size) == 2 else None
            name = str(scan.get("name") or member)
            made.append(Scan(member, name, sides, unit or None, float(scan.get("height_scale") or 1.0)))
    except Exception as error:  # as YAML does too
        raise FileFormatError(
            f"file {file} must be a whole container of contact.engineering, but its {index} is damaged ({error})."
        ) from None
    return tuple(made)


def _yaml(content: bytes) -> Any:
    """Plain values in ``content``, and the tuples of older containers; nothing else is made of a
    stranger's file."""
    import yaml  # type: ignore[import-untyped]

    class Plain(yaml.SafeLoader):  # type: ignore[misc]
        """Plain values and tuples."""

    def made(loader: Any, node: Any) -> tuple[Any, ...]:
        return tuple(loader.construct_sequence(node))

    Plain.add_constructor("tag:yaml.org,2002:python/tuple", made)
    return yaml.load(content, Loader=Plain)


def _place(members: Sequence[Scan], channel: str | int | None, file: Path) -> tuple[int, str | int | None]:
    """Number of the member that ``channel`` names, and the channel in it: a number, a name, or
    both: ``"1:Height"``."""
    listed = ", ".join(f"{number} = {scan.name}" for number, scan in enumerate(members))
    if channel is None:
        if len(members) == 1:
            return 0, None
        raise FileFormatError(
            f"channel of file {file} must be one of its {len(members)} scans, but none is chosen. Choose one "
            f"by its number ({{channel}}): {listed}."
        )
    text = str(channel)
    for number, scan in enumerate(members):
        for known in (str(number), scan.name, PurePosixPath(scan.member).name):
            if text == known:
                return number, None
            if text.startswith(f"{known}:"):
                return number, text.removeprefix(f"{known}:")
    if len(members) == 1:
        return 0, channel
    raise FileFormatError(f"channel of file {file} must be one of its scans, {listed}, but is {channel!r}.")


@contextmanager
def unpacked(file: Path, channel: str | int | None) -> Iterator[Unpacked]:
    """What is to be read of ``file``: itself, or what is packed in it, in a folder that lasts as
    long as this context.

    Errors on a packed file name the archive and the member.
    """
    with file.open("rb") as stream:
        packed = stream.read(2) == _GZIP
    members = None if packed else scans(file)
    if not packed and members is None:
        yield Unpacked(file, "", channel)
        return
    with TemporaryDirectory(prefix="asperity-") as folder:
        scan = Scan("", "")
        if members is None:
            name, inner = file.stem if file.suffix.lower() in (".gz", ".gzip") else file.name, channel
            path, shown = Path(folder) / name, str(file)
            _unzipped(file, path)
        else:
            number, inner = _place(members, channel, file)
            scan = members[number]
            path, shown = Path(folder) / PurePosixPath(scan.member).name, f"{file}/{scan.member}"
            _extracted(file, scan.member, path)
        try:
            yield Unpacked(path, shown, inner, scan)
        except FileFormatError as error:
            raise FileFormatError(
                str(error).replace(str(path), shown), subject=error.subject.replace(str(path), shown)
            ) from error


def _unzipped(file: Path, path: Path) -> None:
    """Write what is compressed in ``file`` to ``path``."""
    try:
        with gzip.open(file) as source, path.open("wb") as target:
            while block := source.read(1 << 24):
                target.write(block)
                require_memory(
                    float(target.tell()), "size of the file", f"{target.tell() / 1e6:.0f} MB", "unpack it first"
                )
    except (OSError, EOFError, zlib.error) as error:
        raise FileFormatError(f"file {file} must be a whole compressed file, but is not ({error}).") from None


def _extracted(file: Path, member: str, path: Path) -> None:
    """Write a ``member`` of the archive ``file`` to ``path``."""
    with zipfile.ZipFile(file) as archive:
        if member not in archive.namelist():
            raise FileFormatError(f"file {file} must hold {member}, which its index names, but does not.")
        size = archive.getinfo(member).file_size
        require_memory(float(size), f"size of {member} in file {file}", f"{size / 1e6:.0f} MB", "unpack it first")
        try:
            with archive.open(member) as source, path.open("wb") as target:
                shutil.copyfileobj(source, target)
        except (zipfile.BadZipFile, OSError, EOFError, RuntimeError, NotImplementedError, zlib.error) as error:
            raise FileFormatError(f"file {file}/{member} must be whole, but cannot be unpacked ({error}).") from None
