"""Height maps in files: instrument formats, NetCDF, text matrices, arrays and pictures, channel by channel."""

from __future__ import annotations

import json
import logging
import re
import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import FileFormatError, InputError, UnitError
from ..core.units import unit_factor
from .surface import Origin, Surface

# What a file holds, before it is read.


@dataclass(frozen=True)
class ChannelInfo:
    """One data channel of a file.

    ``shape`` is (nx, ny); ``size`` is (Lx, Ly) in m, or None if the file does not state it; ``unit`` is the unit of the
    data as written in the file, empty if unknown; ``default`` marks the channel that is read when none is named.
    """

    index: int
    name: str
    shape: tuple[int, ...]
    size: tuple[float, float] | None
    unit: str
    default: bool


def chosen(channels: Sequence[ChannelInfo], channel: str | int | None, path: object) -> ChannelInfo:
    """The ``channel`` named by text (the first of equal names) or index, the default one for None.

    Raises
    ------
    FileFormatError
        If there is no such channel; the message lists those that exist.
    """
    if channel is None:
        return next(info for info in channels if info.default)
    for info in channels:
        if info.name == channel:
            return info
    index = int(channel) if str(channel).isdigit() else -1
    for info in channels:
        if info.index == index:
            return info
    listed = ", ".join(f"{info.index} = {info.name!r}" for info in channels)
    raise FileFormatError(f"channel of file {path} must be one of {listed}, but is {channel!r}.")


# Instrument files through the reader library SurfaceTopography (Roettger et al. 2022).


def instrument_channels(file: Path) -> tuple[ChannelInfo, ...]:
    """Two-dimensional channels of an instrument file."""
    with _library(file) as reader:
        return _listed(reader, file)


def read_instrument(
    file: Path, *, channel: str | int | None, size: tuple[float, float] | None, height_unit: str | None
) -> Surface:
    """Surface from one channel of an instrument file; ``size`` and ``height_unit`` only where the file lacks them."""
    with _library(file) as reader:
        info = chosen(_listed(reader, file), channel, file)
        size, factor = _scales(info, file, size, height_unit)
        raw = next(c for c in reader.channels if c.index == info.index)
        given = {} if raw.physical_sizes is not None else {"physical_sizes": size}
        topography = reader.topography(channel_index=info.index, **given)
        values = topography.heights()
        periodic, metadata = bool(topography.is_periodic), _metadata(topography.info)
    heights = _right_handed(values, info, file) * factor
    nx, ny = heights.shape
    history = f"read: channel {info.name!r} of {file.name}"
    origin = Origin(file.name, info.name, metadata, (history,), ("Roettger2022",))
    try:
        return Surface(heights, size[0] / nx, size[1] / ny, periodic=periodic, origin=origin)
    except InputError as exc:
        raise FileFormatError(f"file {file} does not hold a usable map: {exc}") from exc


@contextmanager
def _library(file: Path) -> Iterator[Any]:
    """Open reader of ``file``; whatever the library raises becomes one sentence."""
    with _quiet():
        try:
            from SurfaceTopography.IO import open_topography

            with open_topography(str(file)) as reader:
                _require_signature(reader, file)
                yield reader
        except InputError:
            raise
        except Exception as exc:  # its readers raise many types on damaged files
            raise FileFormatError(
                f"file {file} must be an instrument file, text matrix, .npy array or picture of heights, "
                f"but cannot be read ({_reason(exc)}). It may be damaged or of an unknown format."
            ) from exc


def _require_signature(reader: Any, file: Path) -> None:
    """Refuse a format without signature unless the name of the file vouches for it.

    The library takes any bytes whose number is twice a square for an SRTM terrain tile (.hgt).
    """
    if type(reader).__name__ == "HGTReader" and file.suffix.lower() != ".hgt":
        raise FileFormatError(
            f"file {file} must be an instrument file, text matrix, .npy array or picture of heights, "
            "but cannot be read (no reader recognises its content). It may be damaged or of an unknown format."
        )


@contextmanager
def _quiet() -> Iterator[None]:
    """Drop warnings and log entries of the reader library: deprecations, and readers that tried a foreign format."""
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


def _reason(exc: Exception) -> str:
    """Short reason for a failure; a failed detection lists every reader it tried, which helps nobody."""
    if type(exc).__name__ == "CannotDetectFileFormat":
        return "no reader recognises its content"
    text = " ".join(str(exc).split())[:160].rstrip(".")
    return f"{type(exc).__name__}: {text}" if text else type(exc).__name__


def _listed(reader: Any, file: Path) -> tuple[ChannelInfo, ...]:
    maps = [channel for channel in reader.channels if channel.dim == 2]
    if not maps:
        raise FileFormatError(
            f"file {file} must hold a two-dimensional map, but holds none. It may be cut short, or hold line scans only."
        )
    heights = [channel for channel in maps if isinstance(channel.unit, str)] or maps
    preferred = reader.default_channel.index
    default = preferred if preferred in [channel.index for channel in heights] else heights[0].index
    return tuple(_info(channel, default) for channel in maps)


def _info(channel: Any, default: int) -> ChannelInfo:
    lateral, unit = channel.unit if isinstance(channel.unit, tuple) else (channel.unit, channel.unit)
    size = None
    if channel.physical_sizes is not None and lateral:
        metre = unit_factor(str(lateral), "length", f"lateral unit of channel {channel.name!r}")
        size = (float(channel.physical_sizes[0]) * metre, float(channel.physical_sizes[1]) * metre)
    shape = tuple(int(n) for n in channel.nb_grid_pts)
    return ChannelInfo(
        int(channel.index), str(channel.name), shape, size, str(unit or ""), int(channel.index) == default
    )


def _scales(
    info: ChannelInfo, file: Path, size: tuple[float, float] | None, height_unit: str | None
) -> tuple[tuple[float, float], float]:
    """Size in m and metres per unit of height, from the file or, where it is silent, from the caller."""
    lacking = []
    if info.size is None and size is None:
        lacking.append('size=(Lx, Ly) in m (--size "20 um x 20 um")')
    if not info.unit and height_unit is None:
        lacking.append('height_unit="nm" (--height-unit nm)')
    if lacking:
        raise FileFormatError(
            f"channel {info.name!r} of file {file} does not state its size or unit: pass {' and '.join(lacking)}."
        )
    if info.size is not None and size is not None:
        raise FileFormatError(
            f"file {file} states its own size {info.size[0]:g} x {info.size[1]:g} m, so size (--size) must be left out."
        )
    if info.unit and height_unit is not None:
        raise FileFormatError(
            f"file {file} states its own unit {info.unit}, so height_unit (--height-unit) must be left out."
        )
    try:
        factor = unit_factor(info.unit or str(height_unit), "length", "height_unit")
    except UnitError as exc:
        if not info.unit:
            raise
        raise FileFormatError(
            f"channel {info.name!r} of file {file} must hold heights, but its unit is {info.unit}. "
            "Choose another channel with channel=... (--channel)."
        ) from exc
    return checked_size(size if info.size is None else info.size, file), factor


def checked_size(size: tuple[float, float] | None, file: Path) -> tuple[float, float]:
    """``size`` as two positive finite lengths in m."""
    try:
        length_x, length_y = (float(length) for length in size or ())
    except (TypeError, ValueError):
        length_x = length_y = 0.0
    if not (0.0 < length_x < np.inf and 0.0 < length_y < np.inf):
        raise FileFormatError(
            f"size of file {file} must be two positive lengths (Lx, Ly) in m, but is {size!r}. "
            'Pass for example size=(20e-6, 20e-6) (--size "20 um x 20 um").'
        )
    return length_x, length_y


def _right_handed(values: Any, info: ChannelInfo, file: Path) -> RealArray:
    """Heights [x, y] with y upwards; the library counts y downwards from the top row of the picture."""
    if values.shape != info.shape:
        raise FileFormatError(
            f"file {file} states {info.shape} points for channel {info.name!r}, but holds {values.shape}."
        )
    heights: RealArray = np.ma.filled(np.ma.asarray(values, dtype=np.float64), np.nan)
    return heights[:, ::-1]


def _metadata(info: Mapping[str, Any], prefix: str = "") -> Mapping[str, str]:
    """Short metadata as strings, nested keys joined by a dot; the raw header of the file is left out."""
    flat: dict[str, str] = {}
    for key, value in info.items():
        if key == "raw_metadata":
            continue
        if isinstance(value, Mapping):
            flat.update(_metadata(value, f"{prefix}{key}."))
        else:
            flat[f"{prefix}{key}"] = str(value)
    return flat


# Surfaces in classic NetCDF files, in the layout of SurfaceTopography and contact.engineering, with our own record beside.
#
# Dimensions x, y; variable heights(x, y) with the attribute unit, x and y with length, unit and periodic; missing points in
# the variable mask. The global attribute ``asperity_surface`` holds what the layout lacks, so that a file of our own comes
# back exactly.


RECORD = "asperity_surface"
"""Global attribute that marks a surface written here: JSON of the pixel, the period and the origin."""

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


def read_netcdf(file: Path) -> Surface:
    """Surface that :func:`write_netcdf` wrote to ``file``, equal to the last bit.

    Raises
    ------
    FileFormatError
        If the file is damaged.
    """
    record = json.loads(_attributes(file)[RECORD])
    try:
        with _opened(file, "r") as data:
            values = np.array(data.variables["heights"][:])
        heights = values.astype(values.dtype.newbyteorder("="))
        history, keys = tuple(record["history"]), tuple(record["citation_keys"])
        origin = Origin(record["source"], record["channel"], record["instrument"], history, keys)
        return Surface(heights, record["dx"], record["dy"], periodic=record["periodic"], origin=origin)
    except (KeyError, ValueError, TypeError, IndexError) as error:
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
    except (ValueError, TypeError, IndexError, KeyError, EOFError):
        return {}
    return {key: value.decode("utf-8") if isinstance(value, bytes) else value for key, value in found.items()}


def _opened(path: Path, mode: Literal["r", "w"]) -> Any:
    """SciPy's file object, whose attributes are those of the file and hence of any name."""
    from scipy.io import netcdf_file

    return netcdf_file(path, mode, mmap=False, version=2)


# Plain files without units: text matrices, NumPy arrays and grey-scale pictures.


_TEXT = (".txt", ".dat", ".asc", ".csv", ".tsv")
_PICTURES = (".png", ".tif", ".tiff", ".jpg", ".jpeg", ".bmp")
_FULL_SCALE = {"1": 1.0, "L": 255.0, "LA": 255.0, "I;16": 65535.0, "I;16B": 65535.0, "I;16L": 65535.0}
_PARK_TAG = 50432  # private tag of Park Systems AFM files, which are TIFF files with a preview picture
_SEPARATOR = re.compile(r"[\s,;]+")


def is_plain(file: Path) -> bool:
    """Whether ``file`` is a text matrix, NumPy array or picture without units, by its ending and its beginning."""
    ending = file.suffix.lower()
    if ending in _TEXT:
        return _starts_with_number(file)
    if ending in (".tif", ".tiff"):
        with _reported(file), _picture(file) as picture:
            return _PARK_TAG not in getattr(picture, "tag_v2", {})
    return ending == ".npy" or ending in _PICTURES


def plain_channels(file: Path) -> tuple[ChannelInfo, ...]:
    """The one channel of a plain file; its size and unit are unknown."""
    values, _ = _values(file)
    return (_only_channel(values),)


def read_plain(
    file: Path,
    *,
    channel: str | int | None,
    size: tuple[float, float] | None,
    height_unit: str | None,
    z_scale: float | None,
) -> Surface:
    """Surface from a plain file; see :func:`asperity.surfaces.read.read` for scales and orientation."""
    values, full_scale = _values(file)
    chosen((_only_channel(values),), channel, file)
    length_x, length_y = _given_size(file, size)
    factor, words = _height_factor(file, full_scale, height_unit, z_scale)
    nx, ny = values.shape
    origin = Origin(source=file.name, channel="heights", history=(f"read: {file.name}, {words}",))
    try:
        return Surface(values * factor, length_x / nx, length_y / ny, origin=origin)
    except InputError as exc:
        raise FileFormatError(f"file {file} does not hold a usable map: {exc}") from exc


def _values(file: Path) -> tuple[RealArray, float | None]:
    """Array [x, y] with y upwards, and the number of the full grey scale (None if the numbers are heights)."""
    ending, full_scale = file.suffix.lower(), None
    with _reported(file):
        if ending == ".npy":
            values = np.load(file, allow_pickle=False)
        elif ending in _TEXT:
            values = np.flipud(_matrix(file)).T
        else:
            picture, full_scale = _grey_levels(file)
            values = np.flipud(picture).T
        return require.field(values, f"content of file {file}"), full_scale


def _only_channel(values: RealArray) -> ChannelInfo:
    return ChannelInfo(0, "heights", values.shape, None, "", True)


def _matrix(file: Path) -> RealArray:
    text = file.read_text(encoding="utf-8-sig")
    first = next(line for line in text.splitlines() if line.strip())
    delimiter = next((mark for mark in (";", ",", "\t") if mark in first), None)
    matrix: RealArray = np.loadtxt(text.splitlines(), delimiter=delimiter, ndmin=2)
    return matrix


def _grey_levels(file: Path) -> tuple[RealArray, float | None]:
    """Rows of the picture from top to bottom, and the number of the full grey scale (None for floating point)."""
    with _picture(file) as picture:
        if picture.mode == "F":
            return np.asarray(picture, dtype=np.float64), None
        if picture.mode in ("RGB", "RGBA", "P"):
            colours = np.asarray(picture.convert("RGB"))
            if (colours != colours[:, :, :1]).any():
                raise InputError("it is a colour picture, and heights cannot be told from colours; export it in grey")
            return colours[:, :, 0].astype(np.float64), 255.0
        if picture.mode not in _FULL_SCALE:
            raise InputError(f"its pixels are of type {picture.mode}; use 8 or 16 bit grey or floating point")
        levels = np.asarray(picture.convert("L") if picture.mode == "LA" else picture)
        return levels.astype(np.float64), _FULL_SCALE[picture.mode]


def _given_size(file: Path, size: tuple[float, float] | None) -> tuple[float, float]:
    if size is None:
        raise FileFormatError(
            f'file {file} does not state its size: pass size=(Lx, Ly) in m (--size "20 um x 20 um") '
            f"and {'z_scale=... (--z-scale)' if file.suffix.lower() in _PICTURES else 'height_unit=... (--height-unit)'}."
        )
    return checked_size(size, file)


def _height_factor(
    file: Path, full_scale: float | None, height_unit: str | None, z_scale: float | None
) -> tuple[float, str]:
    """Metres per number in the file, with the words for the history."""
    if full_scale is None:
        if height_unit is None:
            raise FileFormatError(
                f'file {file} does not state the unit of its heights: pass height_unit="nm" (--height-unit nm).'
            )
        if z_scale is not None:
            raise FileFormatError(f"file {file} holds heights, not grey levels: leave out z_scale (--z-scale).")
        return unit_factor(height_unit, "length", "height_unit"), f"heights in {height_unit}"
    if z_scale is None or height_unit is not None:
        raise FileFormatError(
            f"file {file} is a picture with grey levels: pass z_scale=... in m for its full scale "
            '(--z-scale "100 nm") instead of a height_unit.'
        )
    z_scale = require.positive(z_scale, "z_scale (m)")
    return z_scale / full_scale, f"full grey scale {full_scale:g} = {z_scale:g} m"


def _starts_with_number(file: Path) -> bool:
    with file.open("rb") as stream:
        start = stream.read(4096)
    line = next((line for line in start.decode("utf-8-sig", "replace").splitlines() if line.strip()), "")
    first = _SEPARATOR.split(line.strip(" \t,;"))[0]
    try:
        float(first)
    except ValueError:
        return False
    return b"\0" not in start


@contextmanager
def _picture(file: Path) -> Iterator[Any]:
    from PIL import Image

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # remarks on metadata and on very large pictures, which maps may be
        with Image.open(file) as picture:
            yield picture


@contextmanager
def _reported(file: Path) -> Iterator[None]:
    """Turn every failure to read ``file`` into one sentence."""
    try:
        yield
    except Exception as exc:  # decoders raise many types on damaged files
        reason = " ".join(str(exc).split())[:200].rstrip(".")
        raise FileFormatError(f"file {file} cannot be read as a map of heights: {reason}.") from exc
