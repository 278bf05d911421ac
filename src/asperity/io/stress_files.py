"""Stress fields as groups of labelled trees, written plane by plane."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from dataclasses import replace
from datetime import UTC, datetime
from itertools import chain
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.quantity import Labelled, Quantity
from ..core.tensor import AXES, STRESSES, Displacement, StressTensor
from ..physics.stress.field import StressField
from ..physics.stress.regions import Plane
from .description import describe, rebuild, software
from .tree import Node, coordinate, write_tree

Fields: TypeAlias = StressField | Iterable[StressField]
"""A stress field, or the planes of one as they come from ``stress_planes``."""


def save_stress(fields: Fields, path: str | Path, *, overwrite: bool = False) -> None:
    """Write a stress field, or its planes as they come from ``stress_planes``, to the NetCDF-4 file ``path``.

    Its group ``field`` has the dimensions plane, x, y (those that the field has); variables xx … yz in Pa and, if there are any,
    displacements in m; depth, side and region of each plane. Only one plane of a stream is in memory at a time. ``load``
    reads the file.

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
    return StressField(
        planes,
        StressTensor(**{name: node[name] for name in STRESSES}),
        moved,
        lines["x"],
        lines["y"],
        axes,
        (dx, dy),
        tuple(str(attributes["citation_keys"]).split()),
        bool(attributes.get("single_row", 0)),
    )


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
    return Node(tuple(values), attributes | {"citation_keys": " ".join(field.citation_keys)})


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
