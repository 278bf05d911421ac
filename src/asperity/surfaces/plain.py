"""Plain files without units: text matrices, NumPy arrays and grey-scale pictures."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import FileFormatError, InputError
from ..core.units import unit_factor
from .channels import ChannelInfo, chosen
from .instrument import checked_size
from .surface import Origin, Surface

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
