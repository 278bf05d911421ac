"""Plastic flow in result files: the points of every step one after the other, and back to the bit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ..contact.problem import ContactProblem
from ..contact.result import ContactResult
from ..core.quantity import Labelled, Quantity
from ..physics.plastic_flow.coupling import found_in
from ..physics.plastic_flow.law import plastic_body
from .tree import Node

FLOW = "plastic_flow"
"""Coupling."""

_PREFIX = "plastic_flow_"

_LISTS = {
    "points": Quantity("points", "1", "points that have flowed, by number", dims=("flow_point",)),
    "plastic_strain": Quantity(
        "plastic_strain", "1", "plastic strain xx, yy, zz, xy, xz, yz", dims=("flow_point", "flow_component")
    ),
    "back_stress": Quantity("back_stress", "Pa", "back stress", dims=("flow_point", "flow_component")),
    "accumulated": Quantity("accumulated", "1", "accumulated plastic strain", dims=("flow_point",)),
    "edges": Quantity("edges", "m", "depths between the depth cells", dims=("flow_edge",)),
}
"""What is as long as there are points or edges in each step."""

_EACH = {
    "lift": Quantity("lift", "m", "displacement of the surface by the plastic strain", dims=("step", "x", "y")),
    "first": Quantity(
        "first",
        "",
        "mean pressure (Pa), x, y and depth (m) where each layer flowed first",
        dims=("step", "flow_region", "flow_entry"),
    ),
    "work": Quantity("work", "J", "plastic work in the volume", dims=("step",)),
    "step_work": Quantity("step_work", "J", "plastic work of the step", dims=("step",)),
    "energy": Quantity("energy", "J", "elastic energy of the residual stress", dims=("step",)),
    "iterations": Quantity("iterations", "1", "iterates of the plastic strain", dims=("step",)),
}
"""What every step has one of."""


def flow_found(problem: ContactProblem, memory: Mapping[str, Any]) -> dict[str, Any]:
    """What the coupling found, by its name, from its ``memory``; nothing where the ``problem`` has no plastic flow."""
    return {} if problem.plastic_flow is None else {FLOW: found_in(problem, memory)}


def flow_columns(steps: Sequence[ContactResult]) -> Iterator[Labelled]:
    """Memories of the plastic flow of all ``steps``; points and edges of one step stand after those of another."""
    problem = steps[0].problem
    if problem.plastic_flow is None:
        return
    memories = [step.memory.get(FLOW, {}) for step in steps]
    width = {"plastic_strain": (6,), "back_stress": (6,)}
    for name, item in _LISTS.items():
        parts = [np.asarray(memory.get(name, np.zeros((0, *width.get(name, ()))))) for memory in memories]
        yield _named(item, np.concatenate(parts))
        if name in ("points", "edges"):
            count = Quantity(f"{name}_count", "1", f"number of {name} of the step", dims=("step",))
            yield _named(count, np.array([len(part) for part in parts]))
    regions = len(problem.plastic_flow.laws(plastic_body(problem.body, problem.counter_body)[0]))
    none = {"lift": np.zeros(problem.grid.shape), "first": np.full((regions, 4), np.nan)}
    for name, item in _EACH.items():
        yield _named(item, np.stack([np.asarray(memory.get(name, none.get(name, 0.0))) for memory in memories]))


def flow_from(node: Node, at: Mapping[str, Any], step: int) -> dict[str, Any]:
    """Memory, by the name of the coupling, after one ``step`` of a history, from its group and what it holds ``at`` that step."""
    if f"{_PREFIX}points_count" not in at or not at[f"{_PREFIX}points_count"]:
        return {}
    found: dict[str, Any] = {name: np.asarray(at[_PREFIX + name]) for name in _EACH}
    for name in _LISTS:
        counts = np.asarray(node[f"{_PREFIX}{'edges' if name == 'edges' else 'points'}_count"])
        end = int(counts[: step + 1].sum())
        found[name] = np.asarray(node[_PREFIX + name])[end - int(counts[step]) : end]
    return {FLOW: found}


def _named(item: Quantity, values: Any) -> Labelled:
    return Labelled(replace(item, name=_PREFIX + item.name), np.asarray(values))
