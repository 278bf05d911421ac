"""Height maps in files: instrument formats, NetCDF, text, arrays and pictures, by channel."""

from __future__ import annotations

import json
import logging
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, TypeVar

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import AsperityError, FileFormatError, InputError, UnitError
from ..core.hdf5_files import SIGNATURE, require_own_data
from ..core.status import require_memory
from ..core.units import show, unit_factor
from .reader_library import opened_by_first_reader, opened_by_library
from .surface import Origin, Surface
from .text_files import gridded, is_table, table, text_end

# What a file holds, before it is read.


@dataclass(frozen=True)
class ChannelInfo:
    """One data channel of a file.

    ``shape`` is (nx, ny); ``size`` is (Lx, Ly) in m, None if the file does not state it; ``unit``
    is that of the data as written, empty if unknown; ``default``: read when no channel is named.
    """

    index: int
    name: str
    shape: tuple[int, ...]
    size: tuple[float, float] | None
    unit: str
    default: bool


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


# Instrument files through the reader library SurfaceTopography (Roettger et al. 2022).


_Read = TypeVar("_Read")


def instrument_channels(file: Path) -> tuple[ChannelInfo, ...]:
    """Two-dimensional channels of an instrument file."""
    return _read_with(file, lambda reader: _listed(reader, file))


def read_instrument(
    file: Path, *, channel: str | int | None, size: tuple[float, float] | None, height_unit: str | None
) -> Surface:
    """Surface from a channel of an instrument file; ``size`` and ``height_unit`` if it has none."""
    return _read_with(file, lambda reader: _surface(reader, file, channel, size, height_unit))


def _surface(
    reader: Any, file: Path, channel: str | int | None, size: tuple[float, float] | None, height_unit: str | None
) -> Surface:
    info = chosen(_listed(reader, file), channel, file)
    raw = next(c for c in reader.channels if c.index == info.index)
    if type(reader).__name__ == "AscReader":
        size = _require_whole(info, raw.info.get("raw_metadata", {}), file, size)
    size, factor = _scales(info, file, size, height_unit)
    given = {} if raw.physical_sizes is not None else {"physical_sizes": size}
    topography = reader.topography(channel_index=info.index, **given)
    values = topography.heights()
    periodic, metadata = bool(topography.is_periodic), _metadata(topography.info)
    if values.shape != info.shape:
        raise FileFormatError(
            f"file {file} states {info.shape} points for channel {info.name!r}, but holds {values.shape}.",
            subject=f"points of file {file}",
        )
    # the library counts y downwards from the top row of the picture
    heights = np.ma.filled(np.ma.asarray(values, dtype=np.float64), np.nan)[:, ::-1] * factor
    nx, ny = heights.shape
    history = f"read: channel {info.name!r} of {file.name}"
    origin = Origin(file.name, info.name, metadata, (history,), ("Roettger2022",))
    try:
        return Surface(heights, size[0] / nx, size[1] / ny, periodic=periodic, origin=origin)
    except InputError as exc:
        raise FileFormatError(f"file {file} does not hold a usable map: {exc}", subject=exc.subject) from exc


def _require_whole(
    info: ChannelInfo, header: Mapping[str, Any], file: Path, size: tuple[float, float] | None
) -> tuple[float, float] | None:
    """Refuse text that may be cut short: broken lines, and where the header does not count them, no
    last line break or pixels that are not square. Returns the ``size`` that is still to be used:
    None if it confirms the one in the file.
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
    if size is not None and np.allclose(size, info.size, rtol=_SQUARE, atol=0.0):
        return None
    (length_x, length_y), (nx, ny) = info.size, info.shape
    if not ended or abs(length_x / nx - length_y / ny) > _SQUARE * length_x / nx:
        lengths = f"{show(length_x, 'm', 6)} x {show(length_y, 'm', 6)}"
        raise FileFormatError(
            f"file {file} holds {nx} x {ny} points on {lengths}, pixels of {show(length_x / nx, 'm')} x "
            f"{show(length_y / ny, 'm')}{'' if ended else ' without a last line break'}, and may be cut short. "
            f"If it is complete, confirm its size, {lengths} ({{give_size}}).",
            subject=f"size of file {file}",
        )
    return size


def _read_with(file: Path, use: Callable[[Any], _Read]) -> _Read:
    """What ``use`` makes of the reader of ``file``; errors of the library become one sentence.

    What cannot be read with the parts of the library that the reader imports is read with all.
    """
    failure: Exception | None = None
    _require_own_data(file)
    with _quiet():
        for opened in (opened_by_first_reader, opened_by_library):
            try:
                with opened(file) as reader:
                    # the library takes any bytes whose number is twice a square for an SRTM terrain
                    # tile (.hgt)
                    if type(reader).__name__ == "HGTReader" and file.suffix.lower() != ".hgt":
                        raise _unreadable(file, _NO_READER)
                    return use(reader)
            except InputError:
                raise
            except Exception as exc:  # its readers raise many types on damaged files
                failure = exc
    assert failure is not None
    reason = _NO_READER  # of a failed detection without the list of readers that were tried
    if type(failure).__name__ != "CannotDetectFileFormat":
        text = " ".join(str(failure).split())[:160].rstrip(".")
        reason = f"{type(failure).__name__}: {text}" if text else type(failure).__name__
    raise _unreadable(file, reason) from failure


def _unreadable(file: Path, reason: str) -> FileFormatError:
    return FileFormatError(
        f"file {file} must be an instrument file, text matrix, .npy array or picture of heights, but cannot "
        f"be read ({reason}). It may be damaged or of an unknown format."
    )


_NO_READER = "no reader recognises its content"


def _require_own_data(path: Path) -> None:
    """Refuse the file ``path`` of HDF5 that ``require_own_data`` or the library refuses."""
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


@contextmanager
def _quiet() -> Iterator[None]:
    """Drop warnings and log entries of readers of the library that tried a foreign format."""
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


def _listed(reader: Any, file: Path) -> tuple[ChannelInfo, ...]:
    maps = [channel for channel in reader.channels if channel.dim == 2]
    if not maps:
        raise FileFormatError(
            f"file {file} must hold a two-dimensional map, but holds none. It may be cut short, or hold line "
            "scans only."
        )
    heights = [channel for channel in maps if isinstance(channel.unit, str)] or maps
    preferred = reader.default_channel.index
    default = preferred if preferred in [channel.index for channel in heights] else heights[0].index
    found = []
    for channel in maps:
        lateral, unit = channel.unit if isinstance(channel.unit, tuple) else (channel.unit, channel.unit)
        size = None
        if channel.physical_sizes is not None and lateral:
            metre = unit_factor(str(lateral), "length", f"lateral unit of channel {channel.name!r}")
            size = (float(channel.physical_sizes[0]) * metre, float(channel.physical_sizes[1]) * metre)
        shape, number = tuple(int(n) for n in channel.nb_grid_pts), int(channel.index)
        found.append(ChannelInfo(number, str(channel.name), shape, size, str(unit or ""), number == default))
    return tuple(found)


def _scales(
    info: ChannelInfo, file: Path, size: tuple[float, float] | None, height_unit: str | None
) -> tuple[tuple[float, float], float]:
    """Size in m and metres per unit of height, from the file or else from the caller."""
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
    if info.size is not None and size is not None:
        raise FileFormatError(
            f"file {file} states its own size {info.size[0]:g} x {info.size[1]:g} m, so {{size}} must be left out.",
            subject=f"size of file {file}",
        )
    if info.unit and height_unit is not None:
        raise FileFormatError(
            f"file {file} states its own unit {info.unit}, so {{height_unit}} must be left out.",
            subject=f"height unit of file {file}",
        )
    try:
        factor = unit_factor(info.unit or str(height_unit), "length", "height_unit")
    except UnitError as exc:
        if not info.unit:
            raise
        raise FileFormatError(
            f"channel {info.name!r} of file {file} must hold heights, but its unit is {info.unit}. "
            "Choose another channel ({channel})."
        ) from exc
    return checked_size(size if info.size is None else info.size, f"file {file}", info.shape), factor


_SQUARE = 1e-3
"""Relative difference of dx and dy up to which a pixel counts as square."""


def checked_size(size: tuple[float, float] | None, what: str, shape: tuple[int, ...]) -> tuple[float, float]:
    """``size`` of ``what`` as two positive lengths in m; one for both sides needs square pixels."""
    try:
        length_x, length_y = (float(length) for length in size or ())
    except (TypeError, ValueError):
        length_x = length_y = 0.0
    if not (0.0 < length_x < np.inf and 0.0 < length_y < np.inf):
        raise FileFormatError(
            f"size of {what} must be two positive lengths (Lx, Ly) in m, but is {size!r}. "
            "Give for example {give_size}."
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


def _metadata(info: Mapping[str, Any], prefix: str = "") -> Mapping[str, str]:
    """Short metadata as strings, nested keys joined by a dot, without the raw header."""
    flat: dict[str, str] = {}
    for key, value in info.items():
        if key == "raw_metadata":
            continue
        if isinstance(value, Mapping):
            flat.update(_metadata(value, f"{prefix}{key}."))
        else:
            flat[f"{prefix}{key}"] = str(value)
    return flat


# Surfaces in classic NetCDF files: layout of SurfaceTopography and contact.engineering, own record.
#
# Dimensions x, y; variable heights(x, y) with the attribute unit, x and y with length, unit,
# periodic; missing points in the variable mask. The global attribute ``asperity_surface`` holds
# what the layout lacks, so that a file of our own comes back exactly.


RECORD = "asperity_surface"
"""Global attribute of a surface written here: JSON of the pixel, the period and the origin."""

_MAGIC = b"CDF"


def is_own(file: Path) -> bool:
    """Whether ``file`` is a NetCDF file that :func:`write_netcdf` wrote."""
    if file.suffix.lower() != ".nc":
        return False
    with file.open("rb") as stream:
        if stream.read(3) != _MAGIC:
            return False
    return RECORD in _attributes(file)


def write_netcdf(surface: Surface, path: Path) -> None:
    """Write ``surface`` to ``path``, heights and lengths in m."""
    origin = surface.origin
    record = {
        "dx": surface.dx,
        "dy": surface.dy,
        "periodic": surface.periodic,
        "source": origin.source,
        "channel": origin.channel,
        "instrument": {str(key): str(value) for key, value in origin.instrument.items()},
        "history": list(origin.history),
        "citation_keys": list(origin.citation_keys),
    }
    with _opened(path, "w") as file:
        setattr(file, RECORD, json.dumps(record).encode("ascii"))
        file.history = "\n".join(origin.history).encode("utf-8")
        for name, n, d in zip("xy", surface.shape, surface.grid.spacing, strict=True):
            file.createDimension(name, n)
            axis = file.createVariable(name, "f8", (name,))
            axis[:] = np.arange(n) * d
            axis.length, axis.periodic = np.float64(n * d), np.int32(surface.periodic)
            axis.unit, axis.units = b"m", b"m"
        kind = "f4" if surface.heights.dtype == np.float32 else "f8"
        heights = file.createVariable("heights", kind, ("x", "y"))
        heights[:] = surface.heights
        heights.unit, heights.units, heights.long_name = b"m", b"m", b"heights, positive out of the solid"
        if surface.n_missing:
            file.createVariable("mask", "b", ("x", "y"))[:] = surface.mask


_DAMAGED = (LookupError, ValueError, TypeError, AttributeError, OverflowError, EOFError, OSError, RecursionError)
"""What SciPy and the reading of records raise on damaged files."""


def read_netcdf(file: Path) -> Surface:
    """Surface that :func:`write_netcdf` wrote to ``file``, equal to the last bit.

    Raises FileFormatError if the file is damaged.
    """
    try:
        record = json.loads(_attributes(file)[RECORD])
        with _opened(file, "r") as data:
            values = np.array(data.variables["heights"][:])
        heights = values.astype(values.dtype.newbyteorder("="))
        history, keys = tuple(record["history"]), tuple(record["citation_keys"])
        origin = Origin(record["source"], record["channel"], record["instrument"], history, keys)
        return Surface(heights, record["dx"], record["dy"], periodic=record["periodic"], origin=origin)
    except _DAMAGED as error:
        raise FileFormatError(f"file {file} must hold a whole surface, but is damaged ({error}).") from error


def netcdf_channel(file: Path) -> ChannelInfo:
    """The one channel of a file of our own."""
    surface = read_netcdf(file)
    return ChannelInfo(0, "heights", surface.shape, surface.size, "m", True)


def _attributes(file: Path) -> dict[str, Any]:
    """Global attributes of a classic NetCDF file, text decoded; empty if it is damaged."""
    try:
        with _opened(file, "r") as data:
            found = dict(data._attributes)
    except _DAMAGED:
        return {}
    return {
        key: value.decode("utf-8", "replace") if isinstance(value, bytes) else value for key, value in found.items()
    }


def _opened(path: Path, mode: Literal["r", "w"]) -> Any:
    """SciPy's file object, whose attributes are those of the file and hence of any name."""
    from scipy.io import netcdf_file

    return netcdf_file(path, mode, mmap=False, version=2)


# Plain files without units: text, NumPy arrays and grey-scale pictures.


_TEXT = (".txt", ".dat", ".asc", ".csv", ".tsv", ".xyz")
_PICTURES = (".png", ".tif", ".tiff", ".jpg", ".jpeg", ".bmp")
_FULL_SCALE = {"1": 1.0, "L": 255.0, "LA": 255.0, "I;16": 65535.0, "I;16B": 65535.0, "I;16L": 65535.0}
_MOST_PIXELS = 10**8  # of a picture: a compressed file of some kB may unpack to any size
_PARK_TAG = 50432  # private tag of Park Systems AFM files, which are TIFF files with a preview picture


@dataclass(frozen=True, eq=False)
class _Plain:
    """Numbers [x, y] of a plain file, y upwards: heights, or grey levels where ``full_scale`` is
    theirs.

    ``spacing`` is the pixel of a list of points x y z, in the unit of its coordinates.
    """

    values: RealArray
    full_scale: float | None = None
    spacing: tuple[float, float] | None = None


def is_plain(file: Path) -> bool:
    """Whether ``file`` is text, a NumPy array or a picture without units, by its ending and its
    beginning."""
    ending = file.suffix.lower()
    if ending in _TEXT:
        return is_table(file)
    if ending in (".tif", ".tiff"):
        with _reported(file), _picture(file) as picture:
            return _PARK_TAG not in getattr(picture, "tag_v2", {})
    return ending == ".npy" or ending in _PICTURES


def plain_channels(file: Path) -> tuple[ChannelInfo, ...]:
    """The one channel of a plain file; its size and unit are unknown."""
    return (ChannelInfo(0, "heights", _numbers(file).values.shape, None, "", True),)


def read_plain(
    file: Path,
    *,
    channel: str | int | None,
    size: tuple[float, float] | None,
    height_unit: str | None,
    z_scale: float | None,
    lateral_unit: str | None,
) -> Surface:
    """Surface from a plain file; see :func:`asperity.surfaces.read.read` for scales and
    orientation."""
    found = _numbers(file)
    nx, ny = found.values.shape
    chosen((ChannelInfo(0, "heights", (nx, ny), None, "", True),), channel, file)
    (length_x, length_y), lateral = _given_size(file, found, size, lateral_unit)
    if found.full_scale is None:
        if height_unit is None:
            raise FileFormatError(
                f"file {file} does not state the unit of its heights: give {{give_height_unit}}.",
                subject=f"height unit of file {file}",
            )
        if z_scale is not None:
            raise FileFormatError(
                f"file {file} holds heights, not grey levels: leave out {{z_scale}}.",
                subject=f"z_scale of file {file}",
            )
        factor, words = unit_factor(height_unit, "length", "height_unit"), f"heights in {height_unit}"
    else:
        if z_scale is None or height_unit is not None:
            raise FileFormatError(
                f"file {file} is a picture with grey levels: give {{give_z_scale}} for its full scale "
                "instead of {height_unit}.",
                subject=f"z_scale of file {file}",
            )
        full = require.positive(z_scale, "z_scale (m)")
        factor, words = full / found.full_scale, f"full grey scale {found.full_scale:g} = {full:g} m"
    dx, dy = length_x / nx, length_y / ny
    if abs(dx - dy) > _SQUARE * max(dx, dy):
        words += f", pixels of {show(dx, 'm')} x {show(dy, 'm')}"
    origin = Origin(source=file.name, channel="heights", history=(f"read: {file.name}, {lateral}{words}",))
    try:
        return Surface(found.values * factor, dx, dy, origin=origin)
    except InputError as exc:
        raise FileFormatError(f"file {file} does not hold a usable map: {exc}", subject=exc.subject) from exc


def _numbers(file: Path) -> _Plain:
    ending = file.suffix.lower()
    with _reported(file):
        if ending == ".npy":
            found = _Plain(np.load(file, allow_pickle=False))
        elif ending in _TEXT:
            rows = table(file)
            # three columns and more than three lines: a list of points, of which 2 x 2 is the
            # smallest
            listed = rows.shape[1] == 3 and rows.shape[0] > 3
            found = _Plain(*gridded(rows)) if listed else _Plain(np.flipud(rows).T)
        else:
            found = _grey_levels(file)
        require.field(found.values, f"content of file {file}")
        return found


def _grey_levels(file: Path) -> _Plain:
    """Grey levels of a picture, or its heights if they are of floating point."""
    with _picture(file) as picture:
        if picture.width * picture.height > _MOST_PIXELS:
            raise InputError(
                f"it states {picture.width} x {picture.height} pixels, above the limit of {_MOST_PIXELS:.0e} for a "
                "picture; save a map of that size as .npy",
                subject="pixels of the picture",
            )
        if picture.mode == "F":
            return _Plain(np.flipud(np.asarray(picture, dtype=np.float64)).T)
        if picture.mode in ("RGB", "RGBA", "P"):
            colours = np.asarray(picture.convert("RGB"))
            if (colours != colours[:, :, :1]).any():
                raise InputError(
                    "it is a colour picture, and colours are no heights; export it in grey",
                    subject="colours of the picture",
                )
            return _Plain(np.flipud(colours[:, :, 0].astype(np.float64)).T, 255.0)
        if picture.mode not in _FULL_SCALE:
            raise InputError(
                f"its pixels are of type {picture.mode}; use 8 or 16 bit grey or floating point",
                subject="pixels of the picture",
            )
        levels = np.asarray(picture.convert("L") if picture.mode == "LA" else picture)
        return _Plain(np.flipud(levels.astype(np.float64)).T, _FULL_SCALE[picture.mode])


def _given_size(
    file: Path, found: _Plain, size: tuple[float, float] | None, lateral_unit: str | None
) -> tuple[tuple[float, float], str]:
    """Lengths (Lx, Ly) in m, and words on their unit for the history."""
    if found.spacing is not None:
        if size is not None or lateral_unit is None:
            raise FileFormatError(
                f"file {file} is a list of points x y z on {found.values.shape[0]} x {found.values.shape[1]} nodes "
                f"with steps of {found.spacing[0]:.6g} x {found.spacing[1]:.6g} in a unit that it does not state: give "
                "{give_lateral_unit} instead of {size}.",
                subject=f"lateral unit of file {file}",
            )
        metre = unit_factor(lateral_unit, "length", "lateral_unit")
        nx, ny = found.values.shape
        return (found.spacing[0] * metre * nx, found.spacing[1] * metre * ny), f"points x y in {lateral_unit}, "
    if lateral_unit is not None:
        raise FileFormatError(
            f"file {file} is no list of points x y z, so {{lateral_unit}} must be left out.",
            subject=f"lateral unit of file {file}",
        )
    if size is None:
        raise FileFormatError(
            f"file {file} does not state its size: give {{give_size}} and "
            f"{'{give_z_scale}' if file.suffix.lower() in _PICTURES else '{give_height_unit}'}.",
            subject=f"size of file {file}",
        )
    return checked_size(size, f"file {file}", found.values.shape), ""


@contextmanager
def _picture(file: Path) -> Iterator[Any]:
    from PIL import Image

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # remarks on metadata and on very large pictures, which maps may be
        with Image.open(file) as picture:
            width, height = picture.size
            require_memory(
                32.0 * width * height, "pixels of the picture", f"{width} x {height}", "cut it or reduce it first"
            )
            yield picture


@contextmanager
def _reported(file: Path) -> Iterator[None]:
    """Turn every failure to read ``file`` into one sentence."""
    try:
        yield
    except Exception as exc:  # decoders raise many types on damaged files
        reason = " ".join(str(exc).split())[:200].rstrip(".")
        subject = exc.subject if isinstance(exc, AsperityError) else ""
        raise FileFormatError(
            f"file {file} cannot be read as a map of heights: {reason}.", subject=subject or f"file {file}"
        ) from exc
