"""A contact as a group of result files, and back to the bit: fields, numbers, problem, and what
couplings found and remember."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, replace
from typing import Any

import numpy as np

from ..contact.problem import ContactProblem, Physics
from ..contact.result import ContactResult
from ..core.arrays import RealArray, array_digest
from ..core.quantity import Labelled, Quantity
from ..core.registry import PHYSICS
from ..core.status import Status
from ..surfaces.surface import Origin, Surface
from .codec import values_of
from .couplings import answer_groups, answers_of, memories_group, memories_in
from .description import describe, rebuild, surface_provenance
from .paths import certificate_in, scalars_in, status_in
from .soundness import sound
from .tree import Node, coordinate
from .words import ALL_SCALARS, FIELDS

PARTS = ("body", "counter_body", "boundary", "law", "control")
"""Attributes that describe problem and control, each a JSON text."""

OWN = "physics"
"""Attribute that describes physics of one's own, as a JSON text."""

EARLIER = Quantity("earlier_pressure", "Pa", "pressure of the load before")
"""Field from which the pressure of the next load is extrapolated."""

MARKS = (
    Quantity("contact", "1", "whether the bodies touch"),
    Quantity("plastic", "1", "whether the pressure is at its limit"),
)
"""Fields of true and false."""

SPOTS = Quantity("spot_areas", "m**2", "areas of the contact spots", dims=("spot",))
"""Areas of contact spots, largest first."""

MAPS = {
    item.name: item
    for item in (
        Quantity("Coulomb_coefficient", "1", "friction coefficient"),
        Quantity("TrescaFriction_strength", "Pa", "shear strength of the interface"),
        Quantity("ThirdBody_thickness", "m", "thickness of the third body"),
    )
}
"""Maps of the physics of the interface; any other map of a law is one of the hardness."""


def contact_node(result: ContactResult) -> Node:
    """Group of a contact: heights, fields and scalars; problem, control, certificate and status as
    attributes; what couplings found and remember as groups."""
    problem, arrays = result.problem, dict[str, RealArray]()
    owners: dict[str, Any] = {"control": result} | dict.fromkeys(PARTS[:4], problem)
    attributes = {part: json.dumps(describe(getattr(owners[part], part), arrays, part)) for part in PARTS}
    values = [*grid_lines(result), _field(Quantity("heights", "m", "heights of the surface"), problem.surface.heights)]
    known = [item for item in problem.physics if item.keyword in PHYSICS]
    own: list[Physics] = [item for item in problem.physics if item.keyword not in PHYSICS]
    attributes |= {item.keyword: json.dumps(describe(item.given, arrays, item.keyword)) for item in known}
    attributes |= {OWN: json.dumps([describe(item, arrays, OWN) for item in own])} if own else {}
    attributes["surface"] = _surface_text(problem.surface)
    if isinstance(problem.counter_surface, Surface):
        quantity = Quantity("counter_heights", "m", "heights of the counter surface")
        values.append(_field(quantity, problem.counter_surface.heights))
        attributes["counter_surface"] = _surface_text(problem.counter_surface)
    values += [_field(item, getattr(result, item.name)) for item in (*FIELDS, *MARKS)]
    values += [] if result.earlier is None else [_field(EARLIER, result.earlier)]
    values += [_field(MAPS.get(name, Quantity(name, "Pa", "hardness")), array) for name, array in arrays.items()]
    values += [Labelled(SPOTS, result.spot_areas)]
    values += [Labelled(item, getattr(result, item.name)) for item in ALL_SCALARS]
    checks = list(values_of(result.certificate, "certificate_"))
    attributes |= {item.quantity.name: item.values for item in checks if not item.quantity.dims}
    values += [item for item in checks if item.quantity.dims]
    attributes["citation_keys"] = " ".join(result.citation_keys)
    children = {"couplings": answer_groups(result), "memory": memories_group([result])}
    children = {name: node for name, node in children.items() if node.children}
    return Node(tuple(values), attributes | status_attributes(result.status), children)


def contact_from(node: Node) -> ContactResult:
    """The contact of a group, equal to the one it was made of."""
    attributes = node.attributes
    arrays = fields_in(node)
    problem, control = problem_in(node, arrays)
    couplings = answers_of(node.children.get("couplings", Node()), problem)
    memory = memories_in(node.children.get("memory", Node()))(0, couplings, float(node["approach"]))
    stated = {item.quantity.name: item.values for item in node.values}
    found = ContactResult(
        problem=problem,
        control=control,
        plastic=arrays["plastic"].astype(bool),
        certificate=certificate_in({**attributes, **stated}),
        status=status_in(attributes),
        citation_keys=tuple(attributes["citation_keys"].split()),
        couplings=couplings,
        memory=memory,
        earlier=arrays.get(EARLIER.name),
        **dict[str, Any]((item.name, arrays[item.name]) for item in FIELDS),
        **scalars_in(stated),
    )
    return sound(found)


def fields_in(node: Node) -> dict[str, RealArray]:
    """Arrays (nx, ny) of the group of a contact by name.

    Raises
    ------
    ValueError
        If a field of a contact is not like the heights.
    """
    arrays = {item.quantity.name: np.asarray(item.values) for item in node.values if np.ndim(item.values) == 2}
    for item in (*FIELDS, *MARKS):
        if arrays[item.name].shape != arrays["heights"].shape or arrays[item.name].dtype.kind not in "fbiu":
            raise ValueError(f"{item.name}: it is no field like the heights")
    return arrays


def problem_in(node: Node, arrays: Mapping[str, RealArray]) -> tuple[ContactProblem, Any]:
    """Problem and control of the group of a contact with these ``arrays``."""
    attributes = node.attributes
    parts: dict[str, Any] = {part: rebuild(json.loads(attributes[part]), arrays) for part in PARTS}
    control = parts.pop("control")
    surface = _surface(arrays["heights"], attributes["surface"])
    if "counter_heights" in arrays:
        parts["counter_surface"] = _surface(arrays["counter_heights"], attributes["counter_surface"])
    parts |= {part: rebuild(json.loads(attributes[part]), arrays) for part in PHYSICS if part in attributes}
    own = rebuild(json.loads(attributes.get(OWN, "[]")), arrays)
    return ContactProblem(surface=surface, physics=own, **parts), control


def grid_lines(result: ContactResult) -> tuple[Labelled, Labelled]:
    """Coordinates x and y of the grid of ``result``."""
    x, y = result.problem.grid.coordinates()
    return coordinate("x", x[:, 0]), coordinate("y", y[0])


def status_attributes(status: Status) -> dict[str, str]:
    """``status`` as attributes of a group."""
    return {f"status_{name}": str(text) for name, text in asdict(status).items()}


def _surface_text(surface: Surface) -> str:
    grid = {"dx": surface.dx, "dy": surface.dy, "periodic": surface.periodic}
    return json.dumps(grid | surface_provenance(surface))


def _surface(heights: np.ndarray[Any, Any], text: str) -> Surface:
    described = json.loads(text)
    if array_digest(heights) != described["digest"]:
        raise ValueError("heights: they do not match their digest")
    history, keys = tuple(described["history"]), tuple(described["citation_keys"])
    origin = Origin(described["source"], described["channel"], described["instrument"], history, keys)
    return Surface(heights, described["dx"], described["dy"], periodic=described["periodic"], origin=origin)


def _field(quantity: Quantity, values: np.ndarray[Any, Any]) -> Labelled:
    return Labelled(replace(quantity, dims=("x", "y")), values)
