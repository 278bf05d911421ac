"""Any file with heights → Surface. Units and sizes are taken from the file or asked for, never
guessed."""

from __future__ import annotations

import os
from pathlib import Path

from ..core.errors import FileFormatError
from .formats import (
    ChannelInfo,
    chosen,
    instrument_channels,
    is_own,
    is_plain,
    netcdf_channel,
    plain_channels,
    read_instrument,
    read_netcdf,
    read_plain,
)
from .surface import Surface


def read(
    path: str | os.PathLike[str],
    *,
    channel: str | int | None = None,
    size: tuple[float, float] | None = None,
    height_unit: str | None = None,
    z_scale: float | None = None,
    lateral_unit: str | None = None,
) -> Surface:
    """Surface from a file; heights in m on axes x (to the right) and y (upwards in the picture).

    * Instrument files (some forty formats, read by SurfaceTopography) state size and units
      themselves. The picture that the instrument software shows has its top row at the largest y.
    * Surfaces saved by this package (.nc) come back whole, with period and history.
    * Text matrices (.txt, .dat, .asc, .csv, .tsv, .xyz): one line per row of the picture, top row
      first, separated by blanks, tabs, commas or semicolons; ``nan`` marks a missing point. They
      need ``size`` and ``height_unit``. One title or a row of column names, and decimal commas
      (with blanks, tabs or semicolons between) are understood. A text that was cut exactly between
      two lines is refused where its header counts them or its pixels cease to be square; otherwise
      nothing tells it from a whole one.
    * Lists of points, in the same text files: three columns x, y, z on more than three lines, in
      any order, on a regular grid on which points may be missing. They need ``lateral_unit`` and
      ``height_unit``.
    * NumPy arrays (.npy) are taken as [x, y], as everywhere in this package, and need ``size`` and
      ``height_unit``.
    * Pictures (.png, .tif, .jpg, .bmp): grey level zero is height zero, full scale (255 for 8 bit,
      65535 for 16 bit) is ``z_scale``; TIFF files of floating-point heights need ``height_unit``
      instead. All need ``size``.

    Parameters
    ----------
    path
        File name.
    channel
        Name or index of the data channel (see :func:`channels`); the default height channel if
        omitted.
    size
        (Lx, Ly) in m, only if the file does not state it: number of points times pixel size.
    height_unit
        Unit of the heights such as ``"nm"``, only if the file does not state it.
    z_scale
        Height in m of the full grey scale of a picture.
    lateral_unit
        Unit of the coordinates of a list of points x y z.

    Raises
    ------
    FileFormatError
        If the file is missing, unreadable, empty, damaged, of unknown format, not a map, or lacks a
        size or unit that is not given, or states one that is given.
    UnitError
        If ``height_unit`` is not a unit of length.
    """
    file = _checked(path)
    if is_own(file):
        chosen((netcdf_channel(file),), channel, file)
        if any(scale is not None for scale in (size, height_unit, z_scale, lateral_unit)):
            raise FileFormatError(
                f"file {file} states its size and unit itself: leave out {{size}}, {{height_unit}} and {{z_scale}}.",
                subject=f"size and unit of file {file}",
            )
        surface = read_netcdf(file)
    elif is_plain(file):
        surface = read_plain(
            file, channel=channel, size=size, height_unit=height_unit, z_scale=z_scale, lateral_unit=lateral_unit
        )
    else:
        if z_scale is not None:
            raise FileFormatError(
                f"file {file} is not a picture, so {{z_scale}} must be left out.",
                subject=f"z_scale of file {file}",
            )
        if lateral_unit is not None:
            raise FileFormatError(
                f"file {file} is no list of points x y z, so {{lateral_unit}} must be left out.",
                subject=f"lateral unit of file {file}",
            )
        surface = read_instrument(file, channel=channel, size=size, height_unit=height_unit)
    if min(surface.shape) < 2:
        raise FileFormatError(f"file {file} must hold a map of at least 2 x 2 points, but holds {surface.shape}.")
    return surface


def channels(path: str | os.PathLike[str]) -> tuple[ChannelInfo, ...]:
    """The two-dimensional data channels of a file, in its order.

    Raises FileFormatError if the file is missing, unreadable, empty, damaged or of unknown format.
    """
    file = _checked(path)
    if is_own(file):
        return (netcdf_channel(file),)
    return plain_channels(file) if is_plain(file) else instrument_channels(file)


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
