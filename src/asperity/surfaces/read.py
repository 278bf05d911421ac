"""Any file with heights → Surface, or Profile of a line scan. Units and sizes are taken from the
file or asked for, never guessed."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Unpack

from ..core.errors import FileFormatError
from .formats import Asked, ChannelInfo, chosen, instrument_channels, read_instrument
from .formats_archive import Unpacked, scans, unpacked
from .formats_plain import PLAIN_ENDINGS, PLAIN_MARKS, Scales, is_plain, plain_channels, read_plain
from .profile import Profile
from .profile_netcdf import is_own, netcdf_channel, read_netcdf
from .reader_library import SCALE
from .surface import Surface, strip
from .text_files import TextLayout, TextOptions, is_text


def read(
    path: str | os.PathLike[str],
    *,
    channel: str | int | None = None,
    size: tuple[float, float] | None = None,
    height_unit: str | None = None,
    z_scale: float | None = None,
    lateral_unit: str | None = None,
    missing: Sequence[float | str] = (),
    **text: Unpack[TextOptions],
) -> Surface | Profile:
    """Surface from a file; heights in m on axes x (to the right) and y (upwards in the picture).
    Profile of a line scan.

    * Instrument files (some forty formats, read by SurfaceTopography, and .gsf and .nhf) state size
      and units themselves. The picture that the instrument software shows has its top row at the
      largest y. Only channels of heights are read; by default that of a sensor, and the way back,
      where names tell them apart.
    * Surfaces saved by this package (.nc) come back whole, with period and history.
    * Text matrices: one line per row of the picture, top row first, or in the order of a first
      column of coordinates. What stands between columns, before decimals and for missing points,
      header, encoding, coordinates in the first row and column are found; the history says how the
      text was understood. They need ``size`` (or, with coordinates, ``lateral_unit``) and
      ``height_unit`` unless the header states them. A text that was cut exactly between two lines
      is refused where its header counts them or its pixels cease to be square; otherwise nothing
      tells it from a whole one.
    * Lists of points, in text files: three columns x, y, z on more than three lines, or columns of
      these names, in any order, on a regular grid on which points may be missing. They need
      ``lateral_unit`` and ``height_unit`` unless the names of the columns state them, as ``x (um)``
      does.
    * Line scans: texts of two columns x, z on three lines or more, which need ``lateral_unit`` and
      ``height_unit`` unless the names of the columns state them, and stylus formats, which state
      them. With ``size`` two columns are a map two points wide, and refused if the first rises or
      falls throughout, unless ``axes="none"`` says that it holds heights.
    * Arrays (.npy, .npz, .mat, .h5) are taken as [x, y], as everywhere in this package, and need
      ``size`` and ``height_unit``.
    * Pictures (.png, .tif, .jpg, .bmp): grey level zero is height zero, full scale (255 for 8 bit,
      65535 for 16 bit) is ``z_scale``; TIFF files of floating-point heights need ``height_unit``
      instead. All need ``size``.

    What is doubtful, such as a value that looks like a code for missing points, is in
    ``surface.origin.findings``.

    Parameters
    ----------
    path
        File name.
    channel
        Name or index of the data channel (see :func:`channels`); the default height channel if
        omitted.
    size
        (Lx, Ly) in m, only if the file does not state it, or states one that cannot be: number of
        points times pixel size.
    height_unit
        Unit of the heights such as ``"nm"``, only if the file does not state it, or states heights
        that cannot be.
    z_scale
        Height in m of the full grey scale of a picture.
    lateral_unit
        Unit of the coordinates of a list of points x y z, a line scan x z or a matrix with
        coordinates.
    missing
        Numbers as they stand in the file, and in texts words, that stand for missing points.
    text
        How a text is laid out, where that is not found: ``delimiter`` (``"comma"``,
        ``"semicolon"``, ``"tab"``, ``"blank"``), ``decimal`` (``"point"``, ``"comma"``),
        ``header_lines`` to leave out, ``axes``, which of the first row and column hold coordinates
        (``"none"``, ``"row"``, ``"column"``, ``"both"``), and ``encoding``.

    Raises
    ------
    FileFormatError
        If the file is missing, unreadable, empty, damaged, of unknown format, or lacks a
        size or unit that is not given, states one that is given, or one that no instrument of its
        kind has.
    InputError
        If the layout of a text is stated in unknown words.
    UnitError
        If ``height_unit`` is not a unit of length.
    """
    surface = read_doubtful(
        path,
        channel=channel,
        size=size,
        height_unit=height_unit,
        z_scale=z_scale,
        lateral_unit=lateral_unit,
        missing=missing,
        **text,
    )
    for finding in surface.origin.findings:
        if finding.criterion == SCALE:
            fact = finding.fact.removeprefix("The file ")
            raise FileFormatError(
                f"scale of file {path} must be one that an instrument has, but is none: it {fact} {finding.remedy}"
            )
    return surface


class Reading(TextOptions, total=False):
    """What may be stated of a file beside its name: the arguments of :func:`read`."""

    channel: str | int | None
    size: tuple[float, float] | None
    height_unit: str | None
    z_scale: float | None
    lateral_unit: str | None
    missing: Sequence[float | str]


_USUAL = TextLayout()
_OF_TEXT = ("delimiter", "decimal", "header_lines", "axes", "encoding")


def read_map(path: str | os.PathLike[str], *, strip_length: float = 1.0, **given: Unpack[Reading]) -> Surface:
    """Surface from a file, as :func:`read` with what is ``given``; a line scan becomes a strip of
    grooves without end.

    ``strip_length`` in m along y is what its forces and areas belong to; the history says so.
    """
    found = read(path, **given)
    return found if isinstance(found, Surface) else strip(found, strip_length)


def read_doubtful(path: str | os.PathLike[str], **given: Unpack[Reading]) -> Surface | Profile:
    """Surface or line scan as :func:`read` gives it, also where its scale cannot be: that stands
    among the findings of its origin.

    Raises
    ------
    FileFormatError
        As :func:`read` does, but for the scale.
    """
    file = _checked(path)
    if not _packed(file):
        return _read(file, given.get("channel"), given)
    with unpacked(file, given.get("channel")) as found:
        if not found.shown:
            return _read(file, found.channel, given)
        return _read_member(file, found, given)


def _read_member(file: Path, found: Unpacked, given: Mapping[str, Any]) -> Surface | Profile:
    """What is ``found`` packed in ``file``, with what an index states of it."""
    asked, factor = dict(given), 1.0
    if found.scan.size is not None or found.scan.height_unit is not None:
        info = chosen(_channels(found.path, given), found.channel, found.shown)
        line = len(info.shape) == 1 and found.scan.size is None
        if not line and info.size is None and asked.get("size") is None:
            asked["size"] = found.scan.size
        if not info.unit and asked.get("height_unit") is None:
            asked["height_unit"], factor = found.scan.height_unit, found.scan.height_scale
            if line and info.size is None and asked.get("lateral_unit") is None:
                asked["lateral_unit"] = found.scan.height_unit
    held = _read(found.path, found.channel, asked)
    first = held.origin.history[0].replace(found.path.name, found.shown)
    named = replace(held.origin, source=file.name, history=(first, *held.origin.history[1:]))
    if isinstance(held, Profile):
        return Profile(
            held.heights * factor,
            held.spacing,
            periodic=held.periodic,
            instrument=held.instrument,
            lay_angle=held.lay_angle,
            short_cutoff=held.short_cutoff,
            origin=named,
        )
    return Surface(held.heights * factor, held.dx, held.dy, periodic=held.periodic, origin=named)


def _read(file: Path, channel: str | int | None, given: Mapping[str, Any]) -> Surface | Profile:
    """Surface or line scan in a ``file`` that is not packed."""
    size, height_unit, lateral_unit = given.get("size"), given.get("height_unit"), given.get("lateral_unit")
    asked = Asked(channel, size, height_unit, tuple(given.get("missing", ())), lateral_unit)
    scales = Scales(size, height_unit, given.get("z_scale"), lateral_unit)
    layout = _layout(given)
    if file.suffix.lower() == ".nc" and is_own(file):
        chosen((netcdf_channel(file),), asked.channel, file)
        if scales != Scales():
            raise FileFormatError(
                f"file {file} states its size and unit itself: leave out {{size}}, {{height_unit}} and {{z_scale}}.",
                subject=f"size and unit of file {file}",
            )
        found: Surface | Profile = read_netcdf(file)
    elif _is_plain(file, layout):
        found = read_plain(file, channel=asked.channel, scales=scales, layout=layout)
    else:
        if scales.z_scale is not None:
            raise FileFormatError(
                f"file {file} is not a picture, so {{z_scale}} must be left out.",
                subject=f"z_scale of file {file}",
            )
        found = read_instrument(file, asked)
    if isinstance(found, Surface) and min(found.shape) < 2:
        raise FileFormatError(f"file {file} must hold a map of at least 2 x 2 points, but holds {found.shape}.")
    return found


def _packed(file: Path) -> bool:
    """Whether ``file`` is an archive or compressed, by its beginning."""
    with file.open("rb") as stream:
        return stream.read(2) in (b"PK", b"\x1f\x8b")


def _layout(given: Mapping[str, Any]) -> TextLayout:
    """The layout of a text that is stated among what is ``given``."""
    stated = {name: given[name] for name in _OF_TEXT if given.get(name) is not None}
    if not stated and not given.get("missing"):
        return _USUAL
    return TextLayout(**stated, missing=tuple(given.get("missing", ())))


def _is_plain(file: Path, layout: TextLayout) -> bool:
    """Whether ``file`` has no units; a text with a header has none if no reader of instrument files
    finds any in it.

    What begins and ends as no array, picture or text does is left to the readers of instrument
    files, unless these refuse it.
    """
    with file.open("rb") as stream:
        start = stream.read(4096)
    if start.startswith(PLAIN_MARKS) or file.suffix.lower() in PLAIN_ENDINGS or (layout != _USUAL and layout.stated):
        if is_plain(file, layout):
            return True
        if not is_text(file):
            return False
    if b"\0" in start and not start.startswith((b"\xff\xfe", b"\xfe\xff")):
        return False
    try:
        stated = any(info.size or info.unit for info in instrument_channels(file))
    except FileFormatError as error:
        try:
            if is_text(file):
                plain_channels(file, layout)
                return True
        except FileFormatError:
            pass
        raise error from None
    return not stated and is_text(file)


def channels(path: str | os.PathLike[str], **given: Unpack[Reading]) -> tuple[ChannelInfo, ...]:
    """The maps and line scans of a file, in its order; of a text as it is ``given`` to
    :func:`read`.

    Raises FileFormatError if the file is missing, unreadable, empty, damaged or of unknown format.
    """
    file = _checked(path)
    if not _packed(file):
        return _channels(file, given)
    members = scans(file)
    if members is not None and len(members) > 1:
        found = [_channels_in(file, number, given) for number in range(len(members))]
        return tuple(
            replace(
                info,
                index=number,
                name=scan.name,
                size=info.size or scan.size,
                unit=info.unit or scan.height_unit or "",
            )
            for number, (info, scan) in enumerate(zip(found, members, strict=True))
        )
    with unpacked(file, given.get("channel")) as inner:
        return _channels(inner.path, given)


def _channels_in(file: Path, number: int, given: Mapping[str, Any]) -> ChannelInfo:
    """The channel that is read of a scan of an archive if none is named; one of no points where it
    cannot be read."""
    try:
        with unpacked(file, number) as inner:
            return replace(next(info for info in _channels(inner.path, given) if info.default), default=number == 0)
    except FileFormatError as error:
        return ChannelInfo(number, "", (0, 0), None, "", number == 0, f"unreadable: {error}")


def _channels(file: Path, given: Mapping[str, Any]) -> tuple[ChannelInfo, ...]:
    """Channels of a ``file`` that is not packed."""
    if file.suffix.lower() == ".nc" and is_own(file):
        return (netcdf_channel(file),)
    layout = _layout(given)
    return plain_channels(file, layout, given.get("size")) if _is_plain(file, layout) else instrument_channels(file)


def _checked(path: str | os.PathLike[str]) -> Path:
    """``path`` of a file that exists, can be opened and is not empty."""
    file = Path(path)
    try:
        if not file.exists():
            raise FileFormatError(f"file {file} does not exist. Check the name and the folder.", subject=f"file {file}")
        if not file.is_file():
            raise FileFormatError(f"file {file} must be a file with heights, but is a folder or device.")
        with file.open("rb") as stream:
            start = stream.read(4096)
    except OSError as exc:
        raise FileFormatError(
            f"file {file} cannot be opened: {exc.strerror}. Check its permissions.", subject=f"file {file}"
        ) from exc
    if len(start) < 4096 and not start.strip():
        raise FileFormatError(f"file {file} must hold heights, but is empty.")
    return file
