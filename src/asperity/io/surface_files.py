"""Surfaces written for other programs and for later."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..core.errors import OutputError
from ..surfaces.formats import write_netcdf
from ..surfaces.surface import Surface
from .atomic import atomic_file

ENDINGS = (".nc", ".npy", ".txt", ".asc")
"""Endings of files a surface can be written to."""


def save_surface(surface: Surface, path: str | Path, *, overwrite: bool = False) -> None:
    """Write ``surface`` to ``path``; the ending chooses the form.

    * ``.nc``: classic NetCDF with units, period, missing points and the whole history. ``read`` returns an equal surface;
      SurfaceTopography and contact.engineering read it too.
    * ``.txt``, ``.asc``: matrix of heights in m with a header that states size and unit, top row (largest y) first, as Gwyddion
      exports and reads it; ``read`` needs no further word. ``nan`` marks a missing point. A text does not tell that a
      surface is periodic.
    * ``.npy``: the bare array [x, y] of heights in m; ``read`` asks for size and unit.

    Raises
    ------
    OutputError
        If the ending is another, the file exists and ``overwrite`` is false, or it cannot be written.
    """
    target = Path(path)
    require_ending(target)
    ending = target.suffix.lower()
    with atomic_file(target, overwrite=overwrite) as partial:
        if ending == ".nc":
            write_netcdf(surface, partial)
        elif ending == ".npy":
            np.save(partial, surface.heights)
        else:
            _write_text(surface, partial)


def require_ending(path: Path, endings: tuple[str, ...] = ENDINGS) -> None:
    """Refuse a ``path`` whose ending is none of ``endings``.

    Raises
    ------
    OutputError
        As said.
    """
    if path.suffix.lower() not in endings:
        raise OutputError(f"file of a surface must end in {', '.join(endings)}, but is {path}.")


def _write_text(surface: Surface, path: Path) -> None:
    length_x, length_y = surface.size
    header = f"Channel: heights\nWidth: {length_x!r} m\nHeight: {length_y!r} m\nValue units: m"
    with path.open("w", encoding="utf-8", newline="\n") as file:
        np.savetxt(file, np.flipud(surface.heights.T), fmt="%.10g", delimiter="\t", header=header)
