"""Stress fields as groups of result files, written plane by plane, and as grids for VTK."""

from __future__ import annotations

import json
import shutil
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import ExitStack
from dataclasses import replace
from datetime import UTC, datetime
from functools import partial as applied
from itertools import chain
from pathlib import Path
from typing import IO, Any, TypeAlias
from xml.sax.saxutils import quoteattr

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.quantity import Labelled, Quantity
from ...core.tensor import AXES, STRESSES, Displacement, StressTensor
from ...io.atomic import atomic_file
from ...io.codec import KIND, made_of, values_in, values_of
from ...io.description import describe, kind_name, rebuild, software
from ...io.export import VTK_TYPES
from ...io.tree import Node, coordinate, write_tree
from .field import OfTensor, StressField
from .peaks import MAXIMA, Peak, SurfaceMaxima
from .regions import Plane

EDGES = "surface_maxima"
"""Group of the largest stresses at the surface with the edges of the contact."""

Fields: TypeAlias = StressField | Iterable[StressField]
"""A stress field, or the planes of one as they come from ``stress_planes``."""


def save_stress(fields: Fields, path: str | Path, *, overwrite: bool = False) -> None:
    """Write a stress field, or its planes as they come from ``stress_planes``, to the NetCDF-4 file
    ``path``.

    Its group ``field`` has the dimensions plane, x, y (those that the field has); variables xx … yz
    in Pa and, if there are any, displacements in m; depth, side and region of each plane. Only one
    plane of a stream is in memory at a time. Where the field holds the surface of a contact, the
    largest stresses on the edges of that stand in a group of their own, for which they are
    computed. ``load`` reads the file.

    Raises
    ------
    OutputError
        If the file does not end in .nc, exists and ``overwrite`` is false, or cannot be written.
    InputError
        If there are no planes.
    """
    described = {"created": datetime.now(UTC).isoformat(timespec="seconds"), "software": software()}
    title = "stress inside a body, tension positive, z into it"
    group = field_node(fields)
    keys = str(group.attributes["citation_keys"])
    attributes = {"title": title, "provenance": json.dumps(described), "citation_keys": keys}
    write_tree(Node((), attributes, {"field": group}), path, overwrite=overwrite)


def field_node(fields: Fields) -> Node:
    """Group of a stress field, or of planes one after the other.

    Raises
    ------
    InputError
        If there are no planes.
    """
    if isinstance(fields, StressField):
        return _node(fields)
    first, planes = peeked(fields)
    next(planes)
    return replace(_node(first), rows=(_node(plane) for plane in planes))


def field_from(node: Node) -> StressField:
    """The stress field of a group, equal to the one it was made of."""
    attributes, dims = node.attributes, node["xx"].shape
    axes = next(item.quantity.dims for item in node.values if item.quantity.name == "xx")
    sides = [str(side) for side in node["side"]]
    regions = {text: rebuild(json.loads(text)) for text in dict.fromkeys(map(str, node["region_description"]))}
    parts = [regions[str(text)] for text in node["region_description"]]
    planes = tuple(
        Plane(float(depth), region, side)  # type: ignore[arg-type]
        for depth, region, side in zip(node["depth"], parts, sides, strict=True)
    )
    lines = {axis: node[axis] if axis in node else np.asarray(float(attributes[f"at_{axis}"])) for axis in "xy"}
    moved = None
    if "displacement_x" in node:
        moved = Displacement(*(node[f"displacement_{axis}"] for axis in AXES))
    assert len(dims) == len(axes)
    dx, dy = (float(step) for step in attributes["spacing"])
    tensor = StressTensor(**{name: node[name] for name in STRESSES})
    at_edges = None
    if EDGES in node.children:
        values, by_number = values_in(node.children[EDGES]), {part.index: part for part in parts}
        kept = {name: {"region": by_number[int(values[f"{name}_region"])]} for name in MAXIMA}
        maxima = SurfaceMaxima(*(made_of(Peak, values, known, f"{name}_") for name, known in kept.items()))
        at_edges = OfTensor(applied(_known, maxima), tensor)
    return StressField(
        planes,
        tensor,
        moved,
        lines["x"],
        lines["y"],
        axes,
        (dx, dy),
        tuple(str(attributes["citation_keys"]).split()),
        bool(attributes.get("single_row", 0)),
        at_edges,
    )


def _known(maxima: SurfaceMaxima) -> SurfaceMaxima:
    return maxima


def _node(field: StressField) -> Node:
    """Group of all planes of ``field`` at once."""
    lines = [coordinate(axis, line) for axis, line in (("x", field.x), ("y", field.y)) if axis in field.dims]
    values = [*lines]
    for name in STRESSES:
        values.append(Labelled(Quantity(name, "Pa", f"stress {name}", dims=field.dims), getattr(field.tensor, name)))
    for axis in AXES if field.displacement is not None else ():
        quantity = Quantity(f"displacement_{axis}", "m", f"displacement {axis}", dims=field.dims)
        values.append(Labelled(quantity, getattr(field.displacement, axis)))

    def column(name: str, unit: str, label: str, found: list[Any]) -> None:
        values.append(Labelled(Quantity(name, unit, label, dims=("plane",)), np.array(found)))

    column("depth", "m", "depth below the surface", [plane.depth for plane in field.planes])
    column("region", "1", "region, 0 the outermost", [plane.region.index for plane in field.planes])
    column("side", "", "position of the plane in its region", [plane.side for plane in field.planes])
    described = [json.dumps(describe(plane.region)) for plane in field.planes]
    column("region_description", "", "name, material and depths of the region, as JSON", described)
    fixed = {axis: float(line) for axis, line in (("x", field.x), ("y", field.y)) if axis not in field.dims}
    attributes: dict[str, Any] = {f"at_{axis}": value for axis, value in fixed.items()}
    attributes |= {"spacing": np.array(field.spacing), "single_row": int(field.single_row)}
    maxima = field.surface_maxima
    children = dict[str, Node]()
    if maxima is not None:
        at_edges = list[Labelled]()
        for name in MAXIMA:
            peak, region = getattr(maxima, name), Quantity(f"{name}_region", "1", "region, 0 the outermost")
            at_edges += [*values_of(peak, f"{name}_"), Labelled(region, peak.region.index)]
        children[EDGES] = Node(tuple(at_edges), {KIND: kind_name(SurfaceMaxima)})
    return Node(tuple(values), attributes | {"citation_keys": " ".join(field.citation_keys)}, children)


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
    """Components of the only plane of ``field`` by name: xx … yz, and displacement_x … where there
    are any."""
    found = {name: getattr(field.tensor, name)[0] for name in STRESSES}
    if field.displacement is not None:
        found |= {f"displacement_{axis}": getattr(field.displacement, axis)[0] for axis in AXES}
    return found


def _single(field: StressField) -> Iterator[StressField]:
    """The planes of ``field`` one by one, without copies."""
    return (field.only(number) for number in range(len(field.planes)))


def export_stress_vtk(fields: Fields, path: str | Path, *, overwrite: bool = False) -> None:
    """Write a stress field, or its planes as they come from ``stress_planes``, to ``path`` (.vtr),
    lengths in m.

    Point data: the components, von Mises stress, and the number of the region; z is the depth, and
    the two planes of an interface share theirs. Only one plane is in memory at a time.

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
            region = np.full(field.tensor.xx.shape[1:], field.planes[0].region.index, np.uint8)
            for name, values in {**components(field), "von_mises": field.von_mises[0], "region": region}.items():
                if name not in parts:
                    parts[name] = stack.enter_context(tempfile.TemporaryFile(dir=partial.parent))
                    kinds[name] = values.dtype
                # x runs fastest in VTK
                parts[name].write(np.ascontiguousarray(values.T).astype(values.dtype.newbyteorder("<")).tobytes())
        with partial.open("wb") as file:
            _write(file, first, depths, parts, kinds)


def _write(
    file: IO[bytes],
    first: StressField,
    depths: list[float],
    parts: dict[str, IO[bytes]],
    kinds: dict[str, np.dtype[Any]],
) -> None:
    """Header with the place of every array, then the arrays themselves, raw, each after its
    length."""
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
