"""Stress fields as VTK rectilinear grids (.vtr), written plane by plane, for pictures in space."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import IO, Any
from xml.sax.saxutils import quoteattr

import numpy as np

from ..core.errors import InputError
from ..stress.field import StressField
from .atomic import atomic_file
from .export import VTK_TYPES
from .stress_files import Fields, components, peeked


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
