"""States of finite elements in result files, from which histories of indentation and of passes go on, back to the bit."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import fields
from datetime import UTC, datetime
from typing import Any, TypeAlias

import numpy as np

from ..core.quantity import Labelled, Quantity
from ..fem.contact import Equilibrium
from ..fem.history import IndentationState, PlasticZone
from ..fem.passes import PassState
from ..solids.plasticity import PlasticState
from .description import software
from .tree import Node

FemState: TypeAlias = IndentationState | PassState
"""What a history of finite elements goes on from."""

INDENTED, PASSED = "indentation_state", "pass_state"
"""Groups."""

_PLASTIC = (
    Quantity("plastic_strain", "1", "plastic strain at the Gauss points, xx, yy, zz, xy, xz, yz"),
    Quantity("back_stress", "Pa", "back stress at the Gauss points"),
    Quantity("accumulated", "1", "accumulated plastic strain at the Gauss points"),
)

_PASS = (
    Quantity("displacement", "m", "displacements, one for each unknown"),
    Quantity("normal", "", "forces into the body on the points of the surface (N, in plane strain N/m)"),
    Quantity("tangential", "", "forces along x on the points of the surface (N, in plane strain N/m)"),
    Quantity("place", "m", "place of the indenter or load"),
    Quantity("approach", "m", "approach of the indenter"),
    Quantity("work", "", "work of the contact forces (J, in plane strain J/m)"),
    Quantity("dissipated", "", "plastic work (J, in plane strain J/m)"),
)

_EQUILIBRIUM = (
    Quantity("displacement", "m", "displacements, one for each unknown"),
    Quantity("touching", "1", "whether a point of the surface touches"),
    Quantity("slipping", "1", "whether a point of the surface slips"),
    Quantity("approach", "m", "approach of the indenter"),
    Quantity("shift", "m", "displacement of the indenter along the surface"),
    Quantity("normal_force", "N", "forces into the body on the points of the surface"),
    Quantity("tangential_force", "N", "forces along the surface on its points"),
    Quantity("forces", "N", "forces on the elements, one for each unknown"),
    Quantity("stress", "Pa", "stress at the Gauss points, rr, tt, zz, rt, rz, tz"),
    Quantity("residuals", "1", "unbalanced force over the contact force, for each iteration"),
    Quantity("cuts", "1", "how often the step was divided"),
    Quantity("largest", "N", "largest contact force so far"),
)

_INDENTATION = (
    Quantity("work", "J", "work of the indenter"),
    Quantity("plastic_work", "J", "plastic work"),
)

_ZONES = (
    Quantity("region", "1", "number of the region from the surface down"),
    Quantity("volume", "m**3", "volume that has flowed"),
    Quantity("top", "m", "smallest depth that has flowed"),
    Quantity("bottom", "m", "largest depth that has flowed"),
    Quantity("radius", "m", "largest distance from the axis that has flowed"),
    Quantity("largest", "1", "largest accumulated plastic strain"),
    Quantity("place", "m", "r and z of the largest plastic strain"),
    Quantity("first_place", "m", "r and z where flow began"),
    Quantity("first_approach", "m", "approach at which flow began"),
)


def state_tree(state: FemState) -> Node:
    """Tree of a ``state``: what files hold."""
    described = {"created": datetime.now(UTC).isoformat(timespec="seconds"), "software": software()}
    attributes = {"title": "state of finite elements", "provenance": json.dumps(described)}
    if isinstance(state, PassState):
        return Node((), attributes, {PASSED: _node({**_all(state, _PASS), **_all(state.plastic, _PLASTIC)})})
    now, zones = state.equilibrium, state.zones
    columns = {item: np.array([getattr(zone, item.name) for zone in zones]) for item in _ZONES}
    balance = {**_all(now, _EQUILIBRIUM), **_all(now.state, _PLASTIC)}
    children = {"equilibrium": _node(balance), "zones": _node(columns)}
    own = _node(_all(state, _INDENTATION))
    return Node((), attributes, {INDENTED: Node(own.values, own.attributes, children)})


def state_in(groups: Mapping[str, Node]) -> FemState:
    """The state that the ``groups`` of a file hold, equal to the one that was saved.

    Raises
    ------
    ValueError
        If arrays do not fit each other.
    """
    if PASSED in groups:
        found = _read(groups[PASSED], (*_PASS, *_PLASTIC))
        plastic = _plastic(found)
        if found["normal"].shape != found["tangential"].shape or found["displacement"].ndim != 1:
            raise ValueError("forces on the surface do not fit each other")
        return PassState(plastic=plastic, **found)
    node = groups[INDENTED]
    balance = _read(node.children["equilibrium"], (*_EQUILIBRIUM, *_PLASTIC))
    plastic = _plastic(balance)
    if balance["stress"].shape != plastic.plastic_strain.shape or balance["displacement"].ndim != 1:
        raise ValueError("stress and plastic strain do not fit each other")
    if not balance["touching"].shape == balance["slipping"].shape == balance["normal_force"].shape:
        raise ValueError("fields of the surface do not fit each other")
    balance |= {name: balance[name].astype(bool) for name in ("touching", "slipping")}
    balance |= {"residuals": tuple(balance["residuals"].tolist()), "cuts": int(balance["cuts"])}
    return IndentationState(
        Equilibrium(state=plastic, **balance), zones=tuple(_zones(node.children["zones"])), **_read(node, _INDENTATION)
    )


def _all(source: Any, wanted: tuple[Quantity, ...]) -> dict[Quantity, Any]:
    return {item: getattr(source, item.name) for item in wanted}


def _node(values: Mapping[Quantity, Any]) -> Node:
    """Group of ``values``; the axes of arrays have names of their own, and empty arrays stand as their shapes."""
    made, empty = [], {}
    for item, value in values.items():
        array = np.asarray(value)
        if array.size:
            dims = tuple(f"{item.name}_{axis}" for axis in range(array.ndim))
            made.append(Labelled(Quantity(item.name, item.unit, item.label, dims=dims), array))
        else:
            empty[item.name] = array.shape
    return Node(tuple(made), {"empty": json.dumps(empty)})


def _read(node: Node, wanted: tuple[Quantity, ...]) -> dict[str, Any]:
    """Arrays and numbers of a group by name."""
    empty = json.loads(node.attributes["empty"])
    found: dict[str, Any] = {}
    for item in wanted:
        value = np.zeros(empty[item.name]) if item.name in empty else np.asarray(node[item.name])
        if value.dtype.kind not in "fbiu":
            raise ValueError(f"{item.name}: it is no number")
        found[item.name] = value if value.ndim else value.item()
    return found


def _plastic(found: dict[str, Any]) -> PlasticState:
    """The plastic state among the arrays ``found``, which are taken out."""
    strain, back, accumulated = (found.pop(item.name) for item in _PLASTIC)
    if strain.shape != (*accumulated.shape, 6) or back.shape != strain.shape:
        raise ValueError("plastic strain, back stress and accumulated strain do not fit each other")
    return PlasticState(strain, back, accumulated)


def _zones(node: Node) -> Iterator[PlasticZone]:
    columns = _read(node, _ZONES)
    assert [item.name for item in _ZONES] == [item.name for item in fields(PlasticZone)]
    for row in zip(*(np.atleast_1d(column) for column in columns.values()), strict=True):
        numbers: list[Any] = [tuple(map(float, value)) if np.ndim(value) else float(value) for value in row[1:]]
        yield PlasticZone(int(row[0]), *numbers)
