"""Heights in files without units: text, NumPy arrays and grey-scale pictures."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import AsperityError, FileFormatError, InputError
from ..core.status import Advice, require_memory
from ..core.units import show, unit_factor
from .formats import SQUARE, ChannelInfo, checked_size, chosen
from .prepare.level import value_findings
from .profile import Profile
from .profile_files import Units, profile_of_text
from .reader_library import ANY, height_doubt, lateral_doubt, scale_finding
from .surface import Origin, Surface
from .text_files import TextLayout, is_count, is_table, is_text, text_numbers
from .text_header import Stated
from .text_points import LineScan, gridded, line_scan, point_columns

_TEXT = (".txt", ".dat", ".asc", ".csv", ".tsv", ".xyz", ".prn", ".tab")
_PICTURES = (".png", ".tif", ".tiff", ".jpg", ".jpeg", ".bmp")
_FULL_SCALE = {"1": 1.0, "L": 255.0, "LA": 255.0, "I;16": 65535.0, "I;16B": 65535.0, "I;16L": 65535.0}
_MOST_PIXELS = 10**8  # of a picture: a compressed file of some kB may unpack to any size
_PARK_TAG = 50432  # private tag of Park Systems AFM files, which are TIFF files with a preview picture
_NPY = b"\x93NUMPY"
_PICTURE_MARKS = (b"\x89PNG\r\n", b"II*\0", b"MM\0*", b"\xff\xd8\xff", b"BM")


PLAIN_MARKS, PLAIN_ENDINGS = (_NPY, *_PICTURE_MARKS), frozenset((".npy", *_TEXT, *_PICTURES))
"""Beginnings and endings of files that may have no units."""


@dataclass(frozen=True)
class Scales:
    """What a caller states of a file without units: see :func:`asperity.surfaces.read.read`."""

    size: tuple[float, float] | None = None
    height_unit: str | None = None
    z_scale: float | None = None
    lateral_unit: str | None = None


@dataclass(frozen=True, eq=False)
class _Plain:
    """Numbers [x, y] of a plain file, y upwards: heights, or grey levels where ``full_scale`` is
    theirs.

    ``spacing`` is the pixel in the unit of the coordinates of the file, which is ``lateral_unit``
    if it states one; a size may be given instead where ``sized``, any where the coordinates are
    ``counted`` points. ``words`` say what was understood of the file, ``stated`` is what its header
    says.
    """

    values: RealArray
    full_scale: float | None = None
    spacing: tuple[float, float] | None = None
    sized: bool = True
    counted: bool = False
    lateral_unit: str = ""
    height_unit: str = ""
    words: str = ""
    stated: Stated = field(default_factory=Stated)


@dataclass(frozen=True, eq=False)
class _Line:
    """A line ``scan`` in a text, and ``words`` on how the text was understood."""

    scan: LineScan
    words: str


def is_plain(file: Path, layout: TextLayout) -> bool:
    """Whether ``file`` is a text, a NumPy array or a picture without units, by its beginning; by
    its ending where that is no mark.

    Text with a header may be that of an instrument: it is plain only if its ``layout`` is stated,
    or it is a mere table.
    """
    ending = file.suffix.lower()
    with file.open("rb") as stream:
        start = stream.read(16)
    if start.startswith(_NPY):
        return True
    if start.startswith((b"II*\0", b"MM\0*")):
        with _reported(file), _picture(file) as picture:
            return _PARK_TAG not in getattr(picture, "tag_v2", {})
    if start.startswith(_PICTURE_MARKS) and not (start[:2] == b"BM" and ending not in _PICTURES):
        return True
    if ending == ".npy" or ending in _PICTURES:
        return not is_text(file)
    return ending in _TEXT and is_text(file) and (layout.stated or is_table(file))


def plain_channels(
    file: Path, layout: TextLayout = TextLayout(), size: tuple[float, float] | None = None
) -> tuple[ChannelInfo, ...]:
    """The one channel of a plain file, a map if its ``size`` is given; its size and unit are
    unknown unless a header states them."""
    return (_channel(_numbers(file, layout, sized=size is not None)),)


def _channel(found: _Plain | _Line) -> ChannelInfo:
    if isinstance(found, _Line):
        return ChannelInfo(0, "heights", (len(found.scan.x),), None, found.scan.z_unit, True)
    return ChannelInfo(
        0, "heights", found.values.shape, _stated_size(found), found.stated.height_unit or found.height_unit, True
    )


def _stated_size(found: _Plain) -> tuple[float, float] | None:
    """Size in m that the file states itself."""
    nx, ny = found.values.shape
    if found.spacing is not None and found.lateral_unit:
        metre = unit_factor(found.lateral_unit, "length", "lateral_unit")
        return found.spacing[0] * metre * nx, found.spacing[1] * metre * ny
    if found.stated.pixel is not None:
        return found.stated.pixel[0] * nx, found.stated.pixel[1] * ny
    return found.stated.size


def read_plain(file: Path, *, channel: str | int | None, scales: Scales, layout: TextLayout) -> Surface | Profile:
    """Surface or line scan from a plain file; see :func:`asperity.surfaces.read.read` for scales
    and orientation."""
    found = _numbers(file, layout, sized=scales.size is not None)
    chosen((_channel(found),), channel, file)
    if isinstance(found, _Line):
        _refuse_grey_scale(file, scales)
        return profile_of_text(file, found.scan, found.words, Units(scales.height_unit, scales.lateral_unit))
    return _surface(file, found, scales, layout)


def _surface(file: Path, found: _Plain, scales: Scales, layout: TextLayout) -> Surface:
    nx, ny = found.values.shape
    (length_x, length_y), lateral = _given_size(file, found, scales)
    values, findings = found.values, list[Advice]()
    if found.full_scale is None:
        factor, words = _height_factor(file, found, scales)
        if layout.missing and not found.words:  # of a text they are missing already
            for code in layout.missing:
                values = np.where(values == code, np.nan, values)
            words += f", missing: {', '.join(map(str, layout.missing))}"
        findings += value_findings(values, found.height_unit or found.stated.height_unit or str(scales.height_unit))
    else:
        if scales.z_scale is None or scales.height_unit is not None:
            raise FileFormatError(
                f"file {file} is a picture with grey levels: give {{give_z_scale}} for its full scale "
                "instead of {height_unit}.",
                subject=f"z_scale of file {file}",
            )
        full = require.positive(scales.z_scale, "z_scale (m)")
        factor, words = full / found.full_scale, f"full grey scale {found.full_scale:g} = {full:g} m"
    dx, dy = length_x / nx, length_y / ny
    if abs(dx - dy) > SQUARE * max(dx, dy):
        words += f", pixels of {show(dx, 'm')} x {show(dy, 'm')}"
    if scales.size is None and (doubt := lateral_doubt(ANY, (length_x, length_y), (nx, ny))):
        findings.insert(0, scale_finding(doubt, ""))
    if scales.height_unit is None and found.full_scale is None and (doubt := height_doubt(ANY, values * factor)):
        findings.insert(0, scale_finding("", doubt))
    understood = f"; {found.words}" if found.words else ""
    history = (f"read: {file.name}, {lateral}{words}{understood}",)
    origin = Origin(source=file.name, channel="heights", history=history, findings=tuple(findings))
    try:
        return Surface(values * factor, dx, dy, origin=origin)
    except InputError as exc:
        raise FileFormatError(f"file {file} does not hold a usable map: {exc}", subject=exc.subject) from exc


def _height_factor(file: Path, found: _Plain, scales: Scales) -> tuple[float, str]:
    """Metres per unit of height of a file with numbers, and words on the unit for the history."""
    stated, given = found.height_unit or found.stated.height_unit, scales.height_unit
    if not stated and given is None:
        raise FileFormatError(
            f"file {file} does not state the unit of its heights: give {{give_height_unit}}.",
            subject=f"height unit of file {file}",
        )
    _refuse_grey_scale(file, scales)
    factor = unit_factor(given or stated, "length", "height_unit")
    if stated and given is not None and factor != unit_factor(stated, "length", "height_unit"):
        raise FileFormatError(
            f"file {file} states {stated} as the unit of its heights, but {given} is given: leave out "
            f"{{height_unit}}, or give the same.",
            subject=f"height unit of file {file}",
        )
    return factor, f"heights in {given or stated}{'' if given else ' as its header says'}"


def _refuse_grey_scale(file: Path, scales: Scales) -> None:
    if scales.z_scale is not None:
        raise FileFormatError(
            f"file {file} holds heights, not grey levels: leave out {{z_scale}}.", subject=f"z_scale of file {file}"
        )


def _numbers(file: Path, layout: TextLayout, *, sized: bool) -> _Plain | _Line:
    """What ``file`` holds; a map if it is ``sized``."""
    with file.open("rb") as stream:
        start = stream.read(16)
    with _reported(file):
        if start.startswith(_NPY) or file.suffix.lower() == ".npy":
            found = _Plain(np.load(file, allow_pickle=False))
        elif start.startswith(_PICTURE_MARKS) and not is_text(file):
            found = _grey_levels(file)
        elif is_text(file):
            text = _of_text(file, layout, sized=sized)
            if isinstance(text, _Line):
                return text
            found = text
        else:
            found = _grey_levels(file)
        require.field(found.values, f"content of file {file}")
        return found


def _of_text(file: Path, layout: TextLayout, *, sized: bool) -> _Plain | _Line:
    """Heights of a text: a matrix, with or without coordinates, a list of points, or a line scan
    unless it is ``sized``."""
    text = text_numbers(file, layout)
    if layout.axes != "none" and (scan := line_scan(text, stated=not sized)) is not None:
        if not sized:
            return _Line(scan, text.understood)
        units = (
            f" ({scan.x_unit or 'unknown unit'}, {scan.z_unit or 'unknown unit'})" if scan.x_unit or scan.z_unit else ""
        )
        raise InputError(
            f"it is no map but a line scan: {len(scan.x)} points x z{units} in two columns, x from {scan.x.min():g} to "
            f"{scan.x.max():g}. Leave out {{size}}, or if both columns hold heights, say so ({{axes}}: none)",
            subject=f"line scan in file {file}",
        )
    if text.rows.shape[1] == 1 and text.rows.shape[0] > 1:
        raise InputError(
            f"it is no map but one column of {text.rows.shape[0]} numbers: a line scan without positions",
            subject=f"line scan in file {file}",
        )
    listed = point_columns(text)
    if listed is not None:
        values, spacing = gridded(listed.points)
        words = f"points x y z, {text.understood}"
        return _Plain(
            values,
            spacing=spacing,
            sized=False,
            lateral_unit=listed.lateral_unit,
            height_unit=listed.height_unit,
            words=words,
            stated=text.stated,
        )
    rows, axes = text.rows, (text.x, text.y)
    rows = rows if text.y is not None and text.y[-1] > text.y[0] else np.flipud(rows)  # the top row has the largest y
    rows = np.fliplr(rows) if text.x is not None and text.x[-1] < text.x[0] else rows
    steps = [
        abs(float(axis[-1] - axis[0])) / (axis.size - 1) if axis is not None and axis.size > 1 else 0.0 for axis in axes
    ]
    step = (steps[0] or steps[1], steps[1] or steps[0]) if max(steps) > 0.0 else None
    counted = all(axis is None or is_count(axis) for axis in axes)
    return _Plain(rows.T, spacing=step, counted=counted, words=f"matrix, {text.understood}", stated=text.stated)


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


def _given_size(file: Path, found: _Plain, scales: Scales) -> tuple[tuple[float, float], str]:
    """Lengths (Lx, Ly) in m, and words on their unit for the history."""
    size, lateral_unit, (nx, ny) = scales.size, scales.lateral_unit, found.values.shape
    stated = _stated_size(found)
    if stated is not None:
        return _confirmed_size(file, found, stated, scales)
    if found.spacing is not None and (lateral_unit is not None or size is None or not found.sized):
        if size is not None or lateral_unit is None:
            steps = f"{found.spacing[0]:.6g} x {found.spacing[1]:.6g} in a unit that it does not state"
            what = (
                "a list of points x y z" if not found.sized else "a matrix with coordinates in its first row or column"
            )
            instead = " instead of {size}" if not found.sized else ", or {give_size}"
            raise FileFormatError(
                f"file {file} is {what} on {nx} x {ny} nodes with steps of {steps}: give "
                f"{{give_lateral_unit}}{instead}.",
                subject=f"lateral unit of file {file}",
            )
        metre = unit_factor(lateral_unit, "length", "lateral_unit")
        return (found.spacing[0] * metre * nx, found.spacing[1] * metre * ny), f"points x y in {lateral_unit}, "
    if lateral_unit is not None:
        raise FileFormatError(
            f"file {file} is no list of points x y z, so {{lateral_unit}} must be left out.",
            subject=f"lateral unit of file {file}",
        )
    if size is None:
        scale = "{give_z_scale}" if found.full_scale is not None else "{give_height_unit}"
        raise FileFormatError(
            f"file {file} does not state its size: give {{give_size}} and {scale}.", subject=f"size of file {file}"
        )
    length_x, length_y = checked_size(size, f"file {file}", (nx, ny))
    if found.spacing is not None and not found.counted:
        ratio = length_x / nx / (length_y / ny) * found.spacing[1] / found.spacing[0]
        if abs(ratio - 1.0) > 0.01:
            raise FileFormatError(
                f"file {file} has coordinates with steps of {found.spacing[0]:.6g} x {found.spacing[1]:.6g}, "
                "but the size "
                f"that is given makes pixels of {show(length_x / nx, 'm')} x {show(length_y / ny, 'm')}: give "
                "{give_lateral_unit} instead, or if its first row and column are heights, say so ({axes}: none).",
                subject=f"size of file {file}",
            )
    return (length_x, length_y), ""


def _confirmed_size(
    file: Path, found: _Plain, stated: tuple[float, float], scales: Scales
) -> tuple[tuple[float, float], str]:
    """The size in m that a file states itself, which what is given may only repeat."""
    if scales.lateral_unit is not None:
        given = unit_factor(scales.lateral_unit, "length", "lateral_unit")
        if not found.lateral_unit or given != unit_factor(found.lateral_unit, "length", "lateral_unit"):
            raise FileFormatError(
                f"file {file} states its size itself, so {{lateral_unit}} must be left out.",
                subject=f"lateral unit of file {file}",
            )
    if scales.size is not None and not np.allclose(scales.size, stated, rtol=SQUARE, atol=0.0):
        raise FileFormatError(
            f"file {file} states its own size {stated[0]:g} x {stated[1]:g} m, so {{size}} must be left out.",
            subject=f"size of file {file}",
        )
    return stated, f"points x y in {found.lateral_unit}, " if found.lateral_unit else "size as its header says, "


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
        words = " ".join(str(exc).split())
        reason = (words if isinstance(exc, AsperityError) else words[:200]).rstrip(".")
        subject = exc.subject if isinstance(exc, AsperityError) else ""
        raise FileFormatError(
            f"file {file} cannot be read as a map of heights: {reason}.", subject=subject or f"file {file}"
        ) from exc
