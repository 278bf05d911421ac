"""Result files of format 1, which had all variables in one group."""

from __future__ import annotations

from ..physics.menisci.quantities import WET_FIELDS, WET_SCALARS
from .tree import Node


def grouped(old: Node) -> Node:
    """Tree of a file of format 1, which had all variables in one group."""
    attributes = dict(old.attributes)
    if "plane" in old.dims():
        return Node((), attributes, {"field": old})
    wet = {name: value for name, value in attributes.items() if name.startswith("wet_")}
    shared = {name: value for name, value in attributes.items() if name not in wet}
    if "step" in old.dims():
        fixed = [item for item in old.values if "step" not in item.quantity.dims and item.quantity.name not in "xy"]
        lines = [item for item in old.values if item.quantity.name in ("x", "y")]
        along = [item for item in old.values if "step" in item.quantity.dims]
        surfaces = Node((*lines, *fixed), attributes)
        return Node(
            (), shared, {"contact": surfaces, "path": Node((*lines, *along), {"controls": attributes["controls"]})}
        )
    if not wet:
        return Node((), shared, {"contact": Node(old.values, shared)})
    names = {item.name for item in (*WET_FIELDS, *WET_SCALARS)}
    lines = [item for item in old.values if item.quantity.name in ("x", "y")]
    film = [item for item in old.values if item.quantity.name in names]
    dry = tuple(item for item in old.values if item.quantity.name not in names)
    renamed = {"wet_outcome": "status_outcome", "wet_message": "status_message", "wet_remedy": "status_remedy"}
    renamed |= {"wet_film": "film", "wet_control": "control", "wet_regime": "regime"}
    described = {renamed.get(name, name.replace("wet_", "stored_")): value for name, value in wet.items()}
    return Node((), shared, {"contact": Node(dry, shared), "film": Node((*lines, *film), described)})
