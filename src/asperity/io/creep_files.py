"""What happened in time to viscoelastic contacts in result files: columns of the steps of time, and back to the bit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ..contact.result import ContactResult
from ..core.quantity import Labelled, Quantity
from ..physics.viscoelastic.moments import COLUMNS, Creeping
from .memory_files import memory_in, memory_node
from .tree import Node

CREEP = "creep"
"""Coupling, and group."""

PASTS = "pasts"
"""Group of a history with what is remembered after its steps."""

RETARDED = Quantity("retarded_displacement", "m", "displacement that is not by the pressure then", dims=("x", "y"))

NUMBERS = (
    Quantity("stored_energy", "J", "stored energy"),
    Quantity("dissipated", "J", "heat of the step"),
    Quantity("work", "J", "work of the force in the step"),
    Quantity("tries", "1", "solves, rejected steps of time included"),
    Quantity("tangential_work", "J", "work of the tangential force in the step"),
    Quantity("step_work", "J", "part of it that the length of implicit steps of time takes"),
)

ACCOUNT = (
    Quantity("shear_work", "J", "work of the displacement by shear in the step"),
    Quantity("missed", "J", "works so far less all that is stored or taken"),
    Quantity("explained", "J", "what of that the length of the steps of time explains"),
    Quantity("largest_work", "J", "largest work so far"),
)
"""Numbers that older files do not hold."""

_PREFIX = "creep_"
_MOMENTS = Quantity("creep_moments", "1", "number of moments recorded in the step")


def creep_group(result: ContactResult, lines: tuple[Labelled, ...]) -> dict[str, Node]:
    """Group of what happened during the step that ends with ``result`` on a grid with these ``lines`` of coordinates, if anything did."""
    found = result.creep
    if found is None:
        return {}
    columns = [Labelled(replace(item, dims=("moment",)), found.column(item.name)) for item in COLUMNS]
    numbers = [
        Labelled(replace(item, name=f"step_{item.name}"), getattr(found, item.name)) for item in (*NUMBERS, *ACCOUNT)
    ]
    return {CREEP: Node((*lines, *columns, *numbers, Labelled(RETARDED, found.retarded_displacement)))}


def creep_in(node: Node | None) -> dict[str, Any]:
    """What happened, by the name of the coupling, from its group."""
    if node is None:
        return {}
    records = np.stack([np.asarray(node[item.name]) for item in COLUMNS], axis=1)
    kept = (*NUMBERS, *(item for item in ACCOUNT if f"step_{item.name}" in node))
    numbers = {item.name: np.asarray(node[f"step_{item.name}"]).item() for item in kept}
    return {CREEP: Creeping(records, np.asarray(node[RETARDED.name]), **numbers)}


def creep_columns(steps: Sequence[ContactResult]) -> Iterator[Labelled]:
    """The same of every step of a history; the moments of all steps stand one after the other."""
    found = [step.creep for step in steps if step.creep is not None]
    if not found:
        return
    for item in COLUMNS:
        named = replace(item, name=_PREFIX + item.name, dims=("moment",))
        yield Labelled(named, np.concatenate([each.column(item.name) for each in found]))
    for item in (*NUMBERS, *ACCOUNT):
        named = replace(item, name=f"{_PREFIX}step_{item.name}", dims=("step",))
        yield Labelled(named, np.array([getattr(each, item.name) for each in found]))
    yield Labelled(replace(_MOMENTS, dims=("step",)), np.array([len(each.records) for each in found]))
    fields = np.stack([each.retarded_displacement for each in found])
    yield Labelled(replace(RETARDED, name=_PREFIX + RETARDED.name, dims=("step", "x", "y")), fields)


def creep_pasts(steps: Sequence[ContactResult]) -> dict[str, Node]:
    """Group of what the bodies remember after every step but the last, whose past stands with its contact: a restart may begin at any."""
    found = {f"step_{n}": memory_node(step.memory[CREEP]) for n, step in enumerate(steps[:-1]) if CREEP in step.memory}
    return {PASTS: Node((), {}, found)} if found else {}


def past_from(node: Node, step: int) -> dict[str, Any]:
    """What the bodies remember after one ``step`` of the history in a group, by the name of the coupling; nothing if it is not there."""
    pasts = node.children.get(PASTS, Node()).children
    name = f"step_{step}"
    return {CREEP: memory_in(pasts[name])} if name in pasts else {}


def creep_from(node: Node, at: Mapping[str, Any], step: int) -> dict[str, Any]:
    """What happened during one ``step`` of a history, from its group and what it holds ``at`` that step."""
    if _MOMENTS.name not in at:
        return {}
    ends = np.cumsum(node[_MOMENTS.name])
    rows = slice(int(ends[step] - at[_MOMENTS.name]), int(ends[step]))
    records = np.stack([np.asarray(node[_PREFIX + item.name])[rows] for item in COLUMNS], axis=1)
    kept = (*NUMBERS, *(item for item in ACCOUNT if f"{_PREFIX}step_{item.name}" in at))
    numbers = {item.name: np.asarray(at[f"{_PREFIX}step_{item.name}"]).item() for item in kept}
    return {CREEP: Creeping(records, np.asarray(at[_PREFIX + RETARDED.name]), **numbers)}
