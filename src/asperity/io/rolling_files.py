"""Rolling contacts in result files: fields, forces and creepages beside the normal contact, and back to the bit."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import asdict, replace
from typing import Any

import numpy as np

from ..contact.result import ContactResult
from ..core.arrays import RealArray
from ..core.quantity import Labelled, Quantity
from ..core.status import Outcome, Status
from ..physics.rolling.rolling import DIRECTIONS, Creepage, RollingContact
from .description import describe, rebuild
from .tree import Node

ROLLING = "rolling_contact"
"""Group."""

VECTORS = (
    Quantity("traction", "Pa", "shear traction on the body"),
    Quantity("slip", "1", "slip velocity of the counter body over the body / rolling speed"),
)
"""Fields with a component along x and one along y, which files keep apart."""

POWER = Quantity("power_density", "J/m**3", "energy turned into heat per area and distance rolled", dims=("x", "y"))

NUMBERS = (
    Quantity("force_x", "N", "force on the body along x"),
    Quantity("force_y", "N", "force on the body along y"),
    Quantity("torque", "N*m", "torque on the body about the centre"),
    Quantity("friction_limit", "N", "largest tangential force that the contact bears"),
    Quantity("dissipated", "J/m", "heat per distance rolled"),
    Quantity("steadiness", "1", "error of the friction law, or change by the last move"),
    Quantity("steps", "1", "Newton steps or moves"),
)


def rolling_node(found: RollingContact, lines: tuple[Labelled, ...]) -> Node:
    """Group of ``found`` but its normal contact, on a grid with these ``lines`` of coordinates."""
    arrays: dict[str, RealArray] = {}
    attributes = {
        "creepage": json.dumps(asdict(found.creepage)),
        "direction": found.direction,
        "law": json.dumps(describe(found.law, arrays, "law")),
        **{f"status_{name}": str(text) for name, text in asdict(found.status).items()},
    }
    maps = (
        Labelled(Quantity(name, "", "map of the friction", dims=("x", "y")), array) for name, array in arrays.items()
    )
    return Node((*lines, *_variables(found), *maps), attributes)


def _variables(found: RollingContact) -> Iterator[Labelled]:
    for item in VECTORS:
        for axis, values in zip("xy", getattr(found, item.name), strict=True):
            named = replace(item, name=f"{item.name}_{axis}", label=f"{item.label} along {axis}", dims=("x", "y"))
            yield Labelled(named, values)
    yield Labelled(POWER, found.power_density)
    for item in NUMBERS:
        yield Labelled(item, getattr(found, item.name))


def rolling_in(node: Node, normal: ContactResult) -> RollingContact:
    """The rolling contact of a group, and of the ``normal`` contact beside it."""
    attributes = node.attributes
    arrays = {item.quantity.name: np.asarray(item.values) for item in node.values if np.ndim(item.values) == 2}
    shape = normal.problem.grid.shape
    if any(array.shape != shape or array.dtype.kind not in "fiu" for array in arrays.values()):
        raise ValueError("fields of the rolling contact are not those of its grid")
    direction = attributes["direction"]
    if direction not in DIRECTIONS:
        raise ValueError(f"direction: {direction!r}")
    fields: dict[str, Any] = {item.name: np.stack([arrays[f"{item.name}_{axis}"] for axis in "xy"]) for item in VECTORS}
    ended = [str(attributes[f"status_{name}"]) for name in ("outcome", "message", "remedy")]
    return RollingContact(
        normal=normal,
        creepage=Creepage(**json.loads(attributes["creepage"])),
        power_density=arrays[POWER.name],
        status=Status(Outcome(ended[0]), ended[1], ended[2]),
        law=rebuild(json.loads(attributes["law"]), arrays),
        direction=direction,
        **fields,
        **{item.name: np.asarray(node[item.name]).item() for item in NUMBERS},
    )
