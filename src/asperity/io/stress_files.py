"""Stress fields as NetCDF-4 files, written plane by plane."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from datetime import UTC, datetime
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.tensor import AXES, STRESSES
from ..stress.field import StressField
from .atomic import atomic_file
from .provenance import software
from .results import FORMAT_VERSION

if TYPE_CHECKING:
    import h5netcdf

SIDES = ("surface", "inside", "above", "below")
"""Sides of a plane, by the number that files hold for them."""

Fields: TypeAlias = StressField | Iterable[StressField]
"""A stress field, or the planes of one as they come from ``stress_planes``."""


def save_stress(fields: Fields, path: str | Path, *, overwrite: bool = False) -> None:
    """Write a stress field, or its planes as they come from ``stress_planes``, to the NetCDF-4 file ``path``.

    Dimensions plane, x, y (those that the field has); variables xx … yz in Pa and, if there are any, displacements in m;
    depth, region and side of each plane. Names of the regions, citation keys and provenance are attributes. Only one
    plane of a stream is in memory at a time. ``open_dataset`` reads the file.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    InputError
        If there are no planes.
    """
    import h5netcdf

    first, planes = peeked(fields)
    with atomic_file(path, overwrite=overwrite) as partial, h5netcdf.File(partial, "w") as file:
        _declare(file, first)
        regions: dict[int, str] = {}
        for number, field in enumerate(planes):
            file.resize_dimension("plane", number + 1)
            plane = field.planes[0]
            labels = {"depth": plane.depth, "region": plane.region.index, "side": SIDES.index(plane.side)}
            for name, values in (components(field) | labels).items():
                file.variables[name][number] = values
            regions[plane.region.index] = plane.region.name
        file.attrs["regions"] = json.dumps(regions)


def peeked(fields: Fields) -> tuple[StressField, Iterator[StressField]]:
    """First plane, and all planes one by one, the first included.

    Raises
    ------
    InputError
        If there are no planes.
    """
    planes = _single(fields) if isinstance(fields, StressField) else chain.from_iterable(map(_single, fields))
    first = next(planes, None)
    if first is None:
        raise InputError("stress field to write must hold at least one plane, but is empty.")
    return first, chain([first], planes)


def components(field: StressField) -> dict[str, RealArray]:
    """Components of the only plane of ``field`` by name: xx … yz, and displacement_x … where there are any."""
    found = {name: getattr(field.tensor, name)[0] for name in STRESSES}
    if field.displacement is not None:
        found |= {f"displacement_{axis}": getattr(field.displacement, axis)[0] for axis in AXES}
    return found


def _single(field: StressField) -> Iterator[StressField]:
    """The planes of ``field`` one by one, without copies."""
    return (field.only(number) for number in range(len(field.planes)))


def _declare(file: h5netcdf.File, first: StressField) -> None:
    """Dimensions, empty variables with units and labels, and attributes."""
    lines = {axis: line for axis, line in (("x", first.x), ("y", first.y)) if axis in first.dims}
    file.dimensions = {"plane": None} | {axis: line.size for axis, line in lines.items()}
    for name, values in components(first).items():
        kind, unit = ("displacement", "m") if name.startswith("displacement") else ("stress", "Pa")
        chunks = (1, *values.shape)  # a plane at a time, as it is written
        variable = file.create_variable(name, first.dims, dtype=values.dtype, chunks=chunks)
        variable.attrs.update({"units": unit, "long_name": f"{kind} {name.removeprefix('displacement_')}"})
    _label(file.create_variable("depth", ("plane",), dtype="f8", chunks=(256,)), "m", "depth below the surface")
    _label(file.create_variable("region", ("plane",), dtype="i4", chunks=(256,)), "1", "region, 0 the outermost")
    side = file.create_variable("side", ("plane",), dtype="i1", chunks=(256,))
    _label(side, "1", "position of the plane in its region")
    side.attrs.update({"flag_values": np.arange(len(SIDES), dtype="i1"), "flag_meanings": " ".join(SIDES)})
    for axis, line in lines.items():
        _label(file.create_variable(axis, (axis,), data=line), "m", f"position along {axis}")
    fixed = {axis: float(line) for axis, line in (("x", first.x), ("y", first.y)) if axis not in first.dims}
    file.attrs.update({f"at_{axis}": value for axis, value in fixed.items()})
    file.attrs["title"] = "stress inside a body, tension positive, z into it"
    file.attrs["asperity_format"] = FORMAT_VERSION
    file.attrs["spacing"] = np.array(first.spacing)
    file.attrs["citation_keys"] = " ".join(first.citation_keys)
    created = datetime.now(UTC).isoformat(timespec="seconds")
    file.attrs["provenance"] = json.dumps({"created": created, "software": software()})


def _label(variable: Any, unit: str, label: str) -> None:
    variable.attrs.update({"units": unit, "long_name": label})
