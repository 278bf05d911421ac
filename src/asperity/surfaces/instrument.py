"""Instrument files through the reader library SurfaceTopography (Roettger et al. 2022)."""

from __future__ import annotations

import logging
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import FileFormatError, InputError, UnitError
from ..core.units import unit_factor
from .channels import ChannelInfo, chosen
from .surface import Origin, Surface


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
