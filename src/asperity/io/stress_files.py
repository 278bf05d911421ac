"""Stress fields as files: NetCDF-4 and VTK plane by plane, the largest stresses as a table."""

from __future__ import annotations

import csv
import json
import math
import shutil
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import ExitStack
from datetime import UTC, datetime
from itertools import chain
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, TypeAlias
from xml.sax.saxutils import quoteattr

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.tensor import AXES, STRESSES
from ..stress.field import Peak, StressField
from ..stress.survey import StressSurvey
from .atomic import atomic_file
from .export import VTK_TYPES
from .provenance import software
from .results import FORMAT_VERSION

if TYPE_CHECKING:
    import h5netcdf


# Stress fields as NetCDF-4 files, written plane by plane.


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


# Largest stresses of a body as a CSV table for other programs.


HEADINGS = ("part", "name", "top", "bottom", "quantity", "value", "unit", "x", "y", "depth", "side")
"""Columns; lengths in m, stresses in Pa, x and y those of nodes."""


def export_stress_csv(survey: StressSurvey, path: str | Path, *, overwrite: bool = False) -> None:
    """Write the maxima, interface tractions and load factors of ``survey`` to ``path``, one row each, SI, exact.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    with atomic_file(path, overwrite=overwrite) as partial, partial.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(HEADINGS)
        writer.writerows(_rows(survey))


def _rows(survey: StressSurvey) -> Iterator[tuple[Any, ...]]:
    for part in survey.maxima:
        region = ("layer", part.region.name, part.region.top, part.region.bottom)
        yield (*region, "max_von_mises", *_at(part.von_mises))
        yield (*region, "max_sqrt_J2", part.von_mises.value / math.sqrt(3.0), *_at(part.von_mises)[1:])
        yield (*region, "max_principal", *_at(part.tension))
        yield (*region, "max_shear", *_at(part.shear))
    for item in survey.interfaces:
        pair = ("interface", f"{item.above}/{item.below}", item.shear.depth, item.shear.depth)
        yield (*pair, "max_shear", *_at(item.shear))
        yield (*pair, "max_peel", *_at(item.peel))
    for state in survey.yielding.regions:
        region = ("layer", state.region.name, state.region.top, state.region.bottom)
        place = _at(state.peak)[2:]
        yield (*region, "yield_stress", state.limit.value, "Pa", "", "", "", "")
        yield (*region, "load_factor_to_yield", state.load_factor, "1", *place)
        yield (*region, "yielded_volume", state.yielded_volume, "m**3", "", "", "", "")


def _at(peak: Peak) -> tuple[Any, ...]:
    return peak.value, "Pa", peak.x, peak.y, peak.depth, peak.side


# Stress fields as VTK rectilinear grids (.vtr), written plane by plane, for pictures in space.


def export_stress_vtk(fields: Fields, path: str | Path, *, overwrite: bool = False) -> None:
    """Write a stress field, or its planes as they come from ``stress_planes``, to ``path`` (.vtr), lengths in m.

    Point data: the components, von Mises stress, and the number of the region; z is the depth, and the two planes of an
    interface share theirs. Only one plane is in memory at a time.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    InputError
        If there are no planes, or the field is a depth profile, which is no grid.
    """
    first, planes = peeked(fields)
    if first.dims == ("plane",):
        raise InputError(
            "stress field for VTK must be a section or whole planes, but is a depth profile; use save_stress."
        )
    with atomic_file(path, overwrite=overwrite) as partial, ExitStack() as stack:
        parts: dict[str, IO[bytes]] = {}
        kinds: dict[str, np.dtype[Any]] = {}
        depths = []
        for field in planes:
            depths.append(field.planes[0].depth)
            for name, values in _point_data(field):
                if name not in parts:
                    parts[name] = stack.enter_context(tempfile.TemporaryFile(dir=partial.parent))
                    kinds[name] = values.dtype
                # x runs fastest in VTK
                parts[name].write(np.ascontiguousarray(values.T).astype(values.dtype.newbyteorder("<")).tobytes())
        with partial.open("wb") as file:
            _write(file, first, depths, parts, kinds)


def _point_data(field: StressField) -> Iterator[tuple[str, np.ndarray[Any, Any]]]:
    yield from components(field).items()
    yield "von_mises", field.von_mises[0]
    shape = field.tensor.xx.shape[1:]
    yield "region", np.full(shape, field.planes[0].region.index, np.uint8)


def _write(
    file: IO[bytes],
    first: StressField,
    depths: list[float],
    parts: dict[str, IO[bytes]],
    kinds: dict[str, np.dtype[Any]],
) -> None:
    """Header with the place of every array, then the arrays themselves, raw, each after its length."""
    lines = {"x": np.atleast_1d(first.x), "y": np.atleast_1d(first.y), "z": np.array(depths)}
    extent = '"' + " ".join(f"0 {line.size - 1}" for line in lines.values()) + '"'
    offset = 0

    def entry(name: str, kind: str, size: int) -> str:
        nonlocal offset
        text = f'<DataArray type="{kind}" Name={quoteattr(name)} format="appended" offset="{offset}"/>\n'
        offset += 8 + size
        return text

    header = '<?xml version="1.0"?>\n'
    header += '<VTKFile type="RectilinearGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n'
    header += f"<RectilinearGrid WholeExtent={extent}>\n<Piece Extent={extent}>\n"
    header += '<PointData Scalars="von_mises">\n'
    header += "".join(entry(name, VTK_TYPES[kinds[name].name], part.tell()) for name, part in parts.items())
    header += "</PointData>\n<Coordinates>\n"
    header += "".join(entry(axis, "Float64", 8 * line.size) for axis, line in lines.items())
    header += '</Coordinates>\n</Piece>\n</RectilinearGrid>\n<AppendedData encoding="raw">\n_'
    file.write(header.encode("ascii"))
    for part in parts.values():
        file.write(np.uint64(part.tell()).astype("<u8").tobytes())
        part.seek(0)
        shutil.copyfileobj(part, file)
    for line in lines.values():
        file.write(np.uint64(8 * line.size).astype("<u8").tobytes() + line.astype("<f8").tobytes())
    file.write(b"\n</AppendedData>\n</VTKFile>\n")
