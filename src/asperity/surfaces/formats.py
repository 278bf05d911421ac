"""Height maps in the files of instruments, channel by channel, through the reader library
SurfaceTopography."""

from __future__ import annotations

import logging
import re
import warnings
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import FileFormatError, InputError, UnitError
from ..core.hdf5_files import SIGNATURE, require_own_data
from ..core.status import Advice
from ..core.units import show, unit_factor
from .formats_mended import OwnReader, completed, mended, own_reader, stated_scale
from .prepare.level import value_findings
from .profile import Profile
from .profile_files import Units, profile_of_reader
from .reader_library import (
    TERRAIN,
    family_of,
    height_doubt,
    lateral_doubt,
    opened_by_first_reader,
    opened_by_library,
    scale_finding,
)
from .surface import Origin, Surface
from .text_files import text_end
from .text_points import LineScan

# What a file holds, before it is read.


HEIGHT = "height"
"""Kind of a channel of heights."""


@dataclass(frozen=True)
class ChannelInfo:
    """One data channel of a file.

    ``shape`` is (nx, ny), (n,) of a line scan; ``size`` is (Lx, Ly) or (L,) in m, or None if the
    file does not state it; ``unit`` is the unit of the data as written in the file, empty if
    unknown or if the data are no heights and the file calls them lengths all the same; ``default``
    marks the channel that is read when none is named; ``kind`` is ``"height"``, or what the data
    are instead, by their name or unit: ``"phase"``, ``"amplitude"``, ``"deflection"``, …
    """

    index: int
    name: str
    shape: tuple[int, ...]
    size: tuple[float, ...] | None
    unit: str
    default: bool
    kind: str = HEIGHT


_HEIGHT_NAMES = re.compile(r"height|topo|z[ _-]?sensor|\bz\b", re.IGNORECASE)
_OTHER_NAMES = tuple(
    (re.compile(pattern, re.IGNORECASE), kind)
    for pattern, kind in (
        (r"phase", "phase"),
        (r"amplitude|\bamp\b|\b(calc)?mag\b", "amplitude"),
        (r"deflection|\bdefl\b|\bdfl\b", "deflection"),
        (r"friction|lateral|torsion|\blfm\b|\bffm\b", "friction"),
        (r"potential|\bkpfm\b|\bskpm\b|voltage|\bbias\b", "potential"),
        (r"current", "current"),
        (r"error", "error signal"),
        (r"adhesion|stiffness|modulus|dissipation|deformation|indentation|elasticity", "property of the material"),
        (r"frequency|capacitance|temperature|\bcount\b|q[ _-]?factor", "other signal"),
        (r"\bfb-out\b|\brms\b|\bex[12]\b|\bhv[xy]\b|\bsnap back\b", "other signal"),
        (r"intensity|brightness|reflect|contrast|colou?r|\brgb\b|\bccd\b|quality|confidence|laser", "intensity"),
    )
)


def kind_of(name: str) -> str:
    """What a channel holds by its ``name``; heights unless the name says something else."""
    if _HEIGHT_NAMES.search(name) and not re.search(r"error", name, re.IGNORECASE):
        return HEIGHT
    return next((kind for pattern, kind in _OTHER_NAMES if pattern.search(name)), HEIGHT)


def preferred(names: Sequence[str], default: int) -> int:
    """Place among the ``names`` of channels of heights of the one that is read if none is named.

    Heights of a sensor before those of the voltage of the scanner, the way back before the way
    there where the names tell them apart; else the ``default`` of the reader.
    """

    def rank(place: int) -> tuple[int, int, bool]:
        name = names[place].lower()
        sensor = bool(re.search(r"sensor|measured", name))
        back = "retrace" in name
        return -sensor, -back, place != default

    return min(range(len(names)), key=rank)


def chosen(channels: Sequence[ChannelInfo], channel: str | int | None, path: object) -> ChannelInfo:
    """The ``channel`` named by text (the first of equal names) or index, the default one for None.

    Raises FileFormatError if there is no such channel; the message lists those that exist.
    """
    if channel is None:
        return next(info for info in channels if info.default)
    for info in channels:
        if info.name == channel:
            return info
    index = int(channel) if str(channel).isdecimal() and len(str(channel)) < 10 else -1
    for info in channels:
        if info.index == index:
            return info
    listed = ", ".join(f"{info.index} = {info.name!r}" for info in channels)
    raise FileFormatError(f"channel of file {path} must be one of {listed}, but is {channel!r}.")


def chosen_in_words(channels: Sequence[ChannelInfo], info: ChannelInfo) -> str:
    """Which channel is read and why, for a file that has several; empty for one that has not."""
    if len(channels) == 1:
        return ""
    heights = [item for item in channels if item.kind == HEIGHT]
    again = Counter(item.name for item in channels)[info.name] > 1
    number = f", number {info.index} of that name" if again else ""
    if not info.default:
        return f"{number}, one of {len(channels)} channels"
    words = (
        f"{len(heights)} of {len(channels)} channels hold heights" if len(heights) > 1 else "the only one of heights"
    )
    return f"{number}, the default: {words}"


SQUARE = 1e-3
"""Relative difference of dx and dy up to which a pixel counts as square."""


def checked_size(size: tuple[float, ...] | None, what: str, shape: tuple[int, ...]) -> tuple[float, float]:
    """``size`` of ``what`` as two positive finite lengths in m; one length written for both sides
    needs square pixels."""
    try:
        length_x, length_y = (float(length) for length in size or ())
    except (TypeError, ValueError):
        length_x = length_y = 0.0
    if not (0.0 < length_x < np.inf and 0.0 < length_y < np.inf):
        raise FileFormatError(
            f"size of {what} must be two positive lengths (Lx, Ly) in m, but is {size!r}. Give for example "
            f"{{give_size}}."
        )
    text = getattr(size, "text", "x")  # of a size that was written, as in a document or an option
    if shape[0] != shape[1] and "x" not in text and "×" not in text:
        nx, ny = shape
        raise FileFormatError(
            f"size of {what} must be two lengths, since it has {nx} x {ny} points, but is {text!r}: pixels would be "
            f"{show(length_x / nx, 'm')} x {show(length_y / ny, 'm')}. For square pixels write "
            f'"{text.strip()} x {show(length_x * ny / nx, "m", 6)}", for these "{text.strip()} x {text.strip()}".'
        )
    return length_x, length_y


# Instrument files through the reader library SurfaceTopography (Roettger et al. 2022).


_Read = TypeVar("_Read")


def instrument_channels(file: Path) -> tuple[ChannelInfo, ...]:
    """Maps and line scans of an instrument file."""
    return _read_with(file, lambda reader: _listed(reader, file))


@dataclass(frozen=True)
class Asked:
    """What a caller states of a file: channel, size in m, unit of heights, numbers that stand for
    missing points, and the unit along a line scan."""

    channel: str | int | None = None
    size: tuple[float, float] | None = None
    height_unit: str | None = None
    missing: tuple[float | str, ...] = ()
    lateral_unit: str | None = None


def read_instrument(file: Path, asked: Asked) -> Surface | Profile:
    """Map or line scan of one channel of an instrument file, with what is doubtful in it as
    findings of its origin.

    Size and units may be ``asked`` only where the file lacks them, or states some that cannot be.
    """
    return _read_with(file, lambda reader: _surface(reader, file, asked))


def _surface(reader: Any, file: Path, asked: Asked) -> Surface | Profile:
    listed = _listed(reader, file)
    info = chosen(listed, asked.channel, file)
    raw = next(c for c in reader.channels if c.index == info.index)
    size = asked.size
    if _name(reader) == "AscReader":
        size = _require_whole(info, raw.info.get("raw_metadata", {}), file, size)
    if info.kind != HEIGHT:
        others = [item for item in listed if item.kind == HEIGHT]
        names = ", ".join(f"{item.index} = {item.name!r}" for item in others) or "none of this file"
        raise FileFormatError(
            f"channel {info.name!r} of file {file} must hold heights, but holds another signal ({info.kind}). "
            f"Choose one of heights ({{channel}}): {names}."
        )
    if len(info.shape) == 1:
        return _line(raw, info, file, asked, chosen_in_words(listed, info), _name(reader))
    if asked.lateral_unit is not None:
        raise FileFormatError(
            f"file {file} is no list of points x y z, so {{lateral_unit}} must be left out.",
            subject=f"lateral unit of file {file}",
        )
    given = {} if raw.physical_sizes is not None else {"physical_sizes": size or info.size or (1.0, 1.0)}
    topography, name = raw.topography(**given), _name(reader)
    heights: RealArray = np.ma.filled(np.ma.asarray(topography.heights(), dtype=np.float64), np.nan)
    if heights.shape != info.shape:
        raise FileFormatError(
            f"file {file} states {info.shape} points for channel {info.name!r}, but holds {heights.shape}.",
            subject=f"points of file {file}",
        )
    if name not in _ARRAYS:
        heights = heights[:, ::-1]  # the library counts y downwards from the top row of the picture
    heights = _without(heights, asked.missing)
    scale, doubt = _scales(info, file, replace(asked, size=size), name, heights)
    findings = [*([doubt] if doubt else []), *value_findings(heights, info.unit or str(asked.height_unit or ""))]
    nx, ny = heights.shape
    words = _AXES.get(name, "")
    words = chosen_in_words(listed, info) + words + scale.words
    if asked.missing:
        words += f"; missing: {', '.join(map(str, asked.missing))}"
    history = f"read: channel {info.name!r} of {file.name}{words}"
    periodic, metadata = bool(topography.is_periodic), _metadata(topography.info)
    origin = Origin(file.name, info.name, metadata, (history,), ("Roettger2022",), tuple(findings))
    try:
        return Surface(heights * scale.factor, scale.size[0] / nx, scale.size[1] / ny, periodic=periodic, origin=origin)
    except InputError as exc:
        raise FileFormatError(f"file {file} does not hold a usable map: {exc}", subject=exc.subject) from exc


_ARRAYS = ("NPZReader", "NPYReader", "MatReader", "H5Reader")
"""Readers of bare arrays, which are taken as [x, y], as everywhere in this package; those of a
picture have a top row."""

_AXES = {
    **dict.fromkeys(_ARRAYS, "; the first index of the array is x, the second y"),
    "NCReader": "; x and y are the dimensions of these names, y downwards",
}
"""Words on the axes of files that are no pictures."""


def _line(raw: Any, info: ChannelInfo, file: Path, asked: Asked, words: str, reader: str) -> Profile:
    """Line scan of the channel ``raw`` of a ``reader``; ``words`` say why it is the one."""
    if asked.size is not None:
        raise FileFormatError(
            f"channel {info.name!r} of file {file} is a line scan, so {{size}} must be left out.",
            subject=f"size of file {file}",
        )
    scan = raw.topography()
    heights = _without(np.ma.filled(np.ma.asarray(scan.heights(), dtype=np.float64), np.nan), asked.missing)
    if asked.missing:
        words += f"; missing: {', '.join(map(str, asked.missing))}"
    along = raw.unit[0] if isinstance(raw.unit, tuple) else raw.unit
    held = LineScan(np.asarray(scan.positions(), dtype=np.float64), heights, str(along or ""), info.unit)
    history = f"read: line scan {info.name!r} of {file.name}{words}"
    origin = Origin(file.name, info.name, _metadata(scan.info), (history,), ("Roettger2022",))
    return profile_of_reader(file, held, Units(asked.height_unit, asked.lateral_unit), family_of(reader), origin, scan)


def _without(heights: RealArray, missing: Sequence[float | str]) -> RealArray:
    """``heights`` without the numbers that stand for ``missing`` points."""
    for code in missing:
        heights = np.where(np.isclose(heights, _number(code), rtol=1e-6, atol=0.0), np.nan, heights)
    return heights


def _number(code: float | str) -> float:
    """A code of missing points as a number; texts stand in text files only."""
    try:
        return float(code)
    except ValueError:
        return np.nan


_MOST_ASPECT = 16.5
"""Ratio of the sides of a pixel up to which whole ones are of a scan with fewer lines; others are
of a text that was cut."""


def _require_whole(
    info: ChannelInfo, header: Mapping[str, Any], file: Path, size: tuple[float, float] | None
) -> tuple[float, float] | None:
    """Refuse text that may be cut short: broken lines, and where the header does not count them, no
    last line break or pixels whose sides are no whole multiples. Returns the ``size`` that is still
    to be used: None if it confirms the one in the file.
    """
    line, lines, ended = text_end(file)
    if line:
        raise FileFormatError(
            f"file {file} was cut short or is damaged: line {line} is no complete row of numbers.",
            subject=f"file {file}",
        )
    if lines is not None and lines != info.shape[1]:
        raise FileFormatError(
            f"file {file} was cut short or is damaged: it has {info.shape[1]} of {lines} lines.", subject=f"file {file}"
        )
    if info.size is None or lines is not None or header.get("nb_grid_pts_y") is not None:
        return size
    if size is not None and np.allclose(size, info.size, rtol=SQUARE, atol=0.0):
        return None
    (length_x, length_y), (nx, ny) = info.size, info.shape
    dx, dy = length_x / nx, length_y / ny
    times = max(dx, dy) / min(dx, dy)
    whole = abs(times - round(times)) <= SQUARE * times and times < _MOST_ASPECT
    if not ended or not whole:
        lengths = f"{show(length_x, 'm', 6)} x {show(length_y, 'm', 6)}"
        raise FileFormatError(
            f"file {file} holds {nx} x {ny} points on {lengths}, pixels of {show(length_x / nx, 'm')} x "
            f"{show(length_y / ny, 'm')}{'' if ended else ' without a last line break'}, and may be cut short. "
            f"If it is complete, confirm its size, {lengths} ({{give_size}}).",
            subject=f"size of file {file}",
        )
    return size


def _read_with(file: Path, use: Callable[[Any], _Read]) -> _Read:
    """What ``use`` makes of the reader of ``file``; whatever the library raises becomes one
    sentence.

    What cannot be read with the parts of the library that the reader imports is read with all of
    it.
    """
    failure: Exception | None = None
    _require_own_data(file)
    with file.open("rb") as stream:
        start = stream.read(8)
    with _quiet(), mended(file) if start.startswith(b"PK") else nullcontext(file) as path:
        own = _own(path) if start.startswith(_OWN) or file.suffix.lower() == ".nhf" else None
        if own is not None:
            return use(own)
        for opened in (opened_by_first_reader, opened_by_library):
            try:
                with opened(path) as reader:
                    _require_signature(reader, file, start)
                    passed_over = type(reader).__name__ == "GWYReader" and not list(reader.channels)
                    return use(completed(reader, path) if passed_over else reader)
            except InputError:
                raise
            except Exception as exc:  # its readers raise many types on damaged files
                failure = exc
    assert failure is not None
    reason = "no reader recognises its content"  # of a failed detection without the list of readers that were tried
    if type(failure).__name__ != "CannotDetectFileFormat":
        text = " ".join(str(failure).split())[:160].rstrip(".")
        reason = f"{type(failure).__name__}: {text}" if text else type(failure).__name__
    raise FileFormatError(
        f"file {file} must be an instrument file, text matrix, .npy array or picture of heights, "
        f"but cannot be read ({reason}). {_remedy(start)}"
    ) from failure


_NT_MDT = b"\x01\xb0\x93\xff"
"""Beginning of the files of NT-MDT, of which the library reads the older kind of frames only."""


def _remedy(start: bytes) -> str:
    """What may be done about a file with this ``start`` that cannot be read."""
    if start.startswith(_NT_MDT):
        return (
            "It is of NT-MDT, and either cut short or without images in frames of the older kind: open it in "
            "Gwyddion and export its heights as a simple field (.gsf)."
        )
    return "It may be damaged or of an unknown format."


_OWN = (b"Gwyddion", b"CDF")
"""Beginnings of files for which there may be a reader of our own."""


def _own(file: Path) -> Any:
    """A reader of our own for ``file``; None where it has none, or is damaged: what is wrong is
    said by the library."""
    try:
        return own_reader(file)
    except FileFormatError:
        raise
    except Exception:  # many types on damaged bytes
        return None


def _require_own_data(path: Path) -> None:
    """Refuse the file ``path`` if it is of HDF5 and ``require_own_data`` refuses it, or the library
    cannot list what it holds."""
    what = f"file {path}"
    size, place, found = path.stat().st_size, 0, False
    with path.open("rb") as file:  # a superblock where the library looks for one
        while place + len(SIGNATURE) <= size and not found:
            file.seek(place)
            found, place = file.read(len(SIGNATURE)) == SIGNATURE, 2 * place or 512
    if not found:
        return
    import h5py

    try:
        with h5py.File(path, "r") as content:
            require_own_data(content, what)
    except FileFormatError:
        raise
    except Exception as error:  # the library raises many types on damaged bytes
        reason = " ".join(str(error).split())[:160]
        raise FileFormatError(f"{what} must be a whole HDF5 file, but cannot be read ({reason}).") from error


def _require_signature(reader: Any, file: Path, start: bytes) -> None:
    """Refuse a format without signature unless the ending of the file names it.

    The library takes any bytes whose number is twice a square for an SRTM terrain tile (.hgt).
    """
    if type(reader).__name__ == "HGTReader" and file.suffix.lower() != ".hgt":
        raise FileFormatError(
            f"file {file} must be an instrument file, text matrix, .npy array or picture of heights, "
            f"but cannot be read (no reader recognises its content). {_remedy(start)}"
        )


@contextmanager
def _quiet() -> Iterator[None]:
    """Drop warnings and log entries of the reader library: deprecations, and readers that tried a
    foreign format."""
    loggers = [logging.getLogger(name) for name in ("SurfaceTopography", "igor2")]
    levels = [logger.level for logger in loggers]
    try:
        for logger in loggers:
            logger.setLevel(logging.CRITICAL + 1)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        for logger, level in zip(loggers, levels, strict=True):
            logger.setLevel(level)


def _name(reader: Any) -> str:
    """Name of a reader of the library or of our own."""
    return reader.name if isinstance(reader, OwnReader) else type(reader).__name__


def _listed(reader: Any, file: Path) -> tuple[ChannelInfo, ...]:
    name = _name(reader)
    kept = (2,) if name in _ARRAYS else (1, 2)  # an array of one dimension states no spacing
    found = [_described(channel, name) for channel in reader.channels if channel.dim in kept]
    if not found:
        raise FileFormatError(f"file {file} must hold a map or a line scan, but holds none. It may be cut short.")
    if name in _ARRAYS and all(item.kind != HEIGHT for item in found):  # the name of an array may be anything
        found = [replace(item, kind=HEIGHT) for item in found]
    maps = [item for item in found if len(item.shape) == 2] or found
    heights = [item for item in maps if item.kind == HEIGHT] or maps
    usual = [item.index for item in heights]
    index = reader.default_channel.index if reader.default_channel is not None else usual[0]
    place = preferred([item.name for item in heights], usual.index(index) if index in usual else 0)
    return tuple(replace(item, default=item.index == heights[place].index) for item in found)


def _described(channel: Any, reader: str) -> ChannelInfo:
    """What the library knows of a ``channel``, mended where it is known to be wrong."""
    lateral, unit = channel.unit if isinstance(channel.unit, tuple) else (channel.unit, channel.unit)
    stated, kind, name = str(unit or ""), kind_of(str(channel.name)), str(channel.name)
    by_library = getattr(getattr(channel, "data_kind", None), "value", HEIGHT)
    if kind == HEIGHT and by_library != HEIGHT:
        kind = str(by_library)
    if kind != HEIGHT:
        # the unit of lengths that the library gives is that of the sides, or one that the file has
        # for all channels
        stated = getattr(channel, "data_unit", None) or ""
        stated = str(stated[1] or "") if isinstance(stated, tuple) else str(stated)
        stated = "" if _is_length(stated) else stated
    size: tuple[float, ...] | None = None
    if channel.physical_sizes is not None and lateral:
        metre = unit_factor(str(lateral), "length", f"lateral unit of channel {channel.name!r}")
        size = tuple(float(length) * metre for length in channel.physical_sizes)
    size = stated_scale(reader, channel, size) if reader == "NMSReader" else size
    return ChannelInfo(int(channel.index), name, tuple(int(n) for n in channel.nb_grid_pts), size, stated, False, kind)


def _is_length(unit: str) -> bool:
    try:
        unit_factor(unit, "length", "unit of a channel")
    except UnitError:
        return False
    return True


@dataclass(frozen=True)
class _Scale:
    """``size`` in m and metres per unit of height, and ``words`` on what was stated instead of what
    the file says."""

    size: tuple[float, float]
    factor: float
    words: str


def _scales(
    info: ChannelInfo, file: Path, asked: Asked, reader: str, heights: RealArray
) -> tuple[_Scale, Advice | None]:
    """Size and unit, from the file or, where it states none or one that cannot be, from the caller;
    and what is doubtful."""
    size, height_unit = asked.size, asked.height_unit
    lacking = []
    if info.size is None and size is None:
        lacking.append("{give_size}")
    if not info.unit and height_unit is None:
        lacking.append("{give_height_unit}")
    if lacking:
        raise FileFormatError(
            f"channel {info.name!r} of file {file} does not state its size or unit: give {' and '.join(lacking)}.",
            subject=f"size and unit of channel {info.name!r} of file {file}",
        )
    family, lateral, vertical = family_of(reader), "", ""
    known = reader.removesuffix("Reader") != TERRAIN
    if info.size is not None and known:
        lateral = lateral_doubt(family, info.size, info.shape)
    if info.size is not None and size is not None and not lateral:
        raise FileFormatError(
            f"file {file} states its own size {info.size[0]:g} x {info.size[1]:g} m, so {{size}} must be left out.",
            subject=f"size of file {file}",
        )
    if info.unit:
        try:
            factor = unit_factor(info.unit, "length", "height_unit")
        except UnitError as exc:
            raise FileFormatError(
                f"channel {info.name!r} of file {file} must hold heights, but its unit is {info.unit}. "
                "Choose another channel ({channel})."
            ) from exc
        vertical = height_doubt(family, heights * factor) if known else ""
        if height_unit is not None and not vertical:
            raise FileFormatError(
                f"file {file} states its own unit {info.unit}, so {{height_unit}} must be left out.",
                subject=f"height unit of file {file}",
            )
    if height_unit is not None:
        factor = unit_factor(height_unit, "length", "height_unit")
    lengths = checked_size(size if size is not None else info.size, f"file {file}", info.shape)
    words = (
        f"; size as given, the file states {info.size[0]:g} x {info.size[1]:g} m"
        if lateral and size and info.size
        else ""
    )
    words += f"; heights in {height_unit} as given, the file states {info.unit}" if vertical and height_unit else ""
    left = ("" if size is not None else lateral, "" if height_unit is not None else vertical)
    return _Scale(lengths, factor, words), scale_finding(*left) if any(left) else None


def _metadata(info: Mapping[str, Any], prefix: str = "") -> Mapping[str, str]:
    """Short metadata as strings, nested keys joined by a dot; the raw header of the file is left
    out."""
    flat: dict[str, str] = {}
    for key, value in info.items():
        if key == "raw_metadata":
            continue
        if isinstance(value, Mapping):
            flat.update(_metadata(value, f"{prefix}{key}."))
        else:
            flat[f"{prefix}{key}"] = str(value)
    return flat
