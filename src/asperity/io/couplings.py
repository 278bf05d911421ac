"""What couplings found and remember in result files: a group for each by its name, and back to the
bit."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, Protocol

import numpy as np

from ..contact.answer import Answer
from ..contact.couplings.protocol import Memory
from ..contact.problem import ContactProblem
from ..core.quantity import Labelled, Quantity
from .codec import HERE, KIND, Steps, answer_kind, group_of, made_of, stacked, steps_group, values_in
from .tree import Node

NAMES, STORED = "memory_names", "memory_stored"
"""Variables of the group of a memory: names of all its arrays, and of those that do not follow from
what the coupling found."""

ORDER = "order"
"""Attribute of the group of all couplings: their names in order."""


class Remembering(Protocol):
    """A result or a state."""

    memory: Mapping[str, Memory]


def answers_group(steps: Sequence[Any]) -> Node:
    """Group of what the couplings found in every one of the ``steps``, with a group for each by its
    name."""
    kinds = {name: type(found) for step in steps for name, found in step.couplings.items() if isinstance(found, Answer)}
    groups = {}
    for name, kind in kinds.items():
        found = [step.couplings.get(name) for step in steps]
        places = [list(step.couplings).index(name) + 1 if name in step.couplings else 0 for step in steps]
        node = steps_group(
            found, kind, [place if each is not None else 0 for place, each in zip(places, found, strict=True)]
        )
        following = [item for item in kind.quantities if item.name not in node]
        rows = [
            None if each is None else {item.name: Labelled(item, getattr(each, item.name)) for item in following}
            for each in found
        ]
        groups[name] = replace(node, values=(*node.values, *stacked(rows)), packs=True)
    return Node((), {}, groups)


def answer_groups(result: Any) -> Node:
    """The same of one result, without steps."""
    groups = {}
    for name, found in result.couplings.items():
        if isinstance(found, Answer):
            node = group_of(found)
            more = (Labelled(item, getattr(found, item.name)) for item in found.quantities if item.name not in node)
            groups[name] = replace(node, values=(*node.values, *more))
    return Node((), {ORDER: " ".join(groups)}, groups)


def answers_of(node: Node, problem: ContactProblem) -> dict[str, Any]:
    """What the couplings found in one contact, from such a group."""
    found = {}
    for name in str(node.attributes.get(ORDER, "")).split():
        child = node.children[name]
        kind = answer_kind(str(child.attributes[KIND]))
        found[name] = made_of(kind, values_in(child), kind.given_by(problem))
    return found


def answers_in(node: Node, problem: ContactProblem) -> Callable[[int], dict[str, Any]]:
    """What the couplings found in each step by its number, from such a group."""
    made = {name: (Steps(child), answer_kind(str(child.attributes[KIND]))) for name, child in node.children.items()}

    def at(step: int) -> dict[str, Any]:
        found = {}
        for name, (rows, kind) in made.items():
            values = rows.at(step)
            if values.get(HERE):
                found[name] = int(values[HERE]), made_of(kind, values, kind.given_by(problem))
        return {name: answer for name, (_, answer) in sorted(found.items(), key=lambda item: item[1][0])}

    return at


def memories_group(steps: Sequence[Any]) -> Node:
    """Group of what the couplings remember after every one of the ``steps`` (results or states),
    with a group for each by its name."""
    groups = {}
    for name in dict.fromkeys(name for step in steps for name in step.memory):
        rows: list[dict[str, Labelled] | None] = []
        for step in steps:
            memory, answer = step.memory.get(name), getattr(step, "couplings", {}).get(name)
            following = answer.remembered(step.approach) if isinstance(answer, Answer) else {}
            rows.append(None if memory is None else _remembered(memory, following))
        here = np.array([int(row is not None) for row in rows])
        values = Labelled(Quantity(HERE, "1", "1 where the step has this", ("step",)), here)
        groups[name] = Node((values, *stacked(rows)), packs=True)
    return Node((), {}, groups)


def memories_in(node: Node) -> Callable[[int, Mapping[str, Any], float], dict[str, Memory]]:
    """What the couplings remember after each step by its number, with what they found in it and its
    approach in m, from such a group."""
    rows = {name: Steps(child) for name, child in node.children.items()}

    def at(step: int, couplings: Mapping[str, Any], approach: float) -> dict[str, Memory]:
        found = dict[str, Memory]()
        for name, steps in rows.items():
            values = steps.at(step)
            if values.get(HERE):
                answer, stored = couplings.get(name), str(values[STORED]).split()
                known = answer.remembered(approach) if isinstance(answer, Answer) else {}
                names = str(values[NAMES]).split()
                found[name] = {key: np.asarray(values[key]) if key in stored else known[key] for key in names}
        return found

    return at


def _remembered(memory: Memory, known: Memory) -> dict[str, Labelled]:
    """Arrays of a ``memory`` that are not ``known``, and the names of all."""
    arrays = {key: np.asarray(value) for key, value in memory.items()}
    stored = {
        key: array for key, array in arrays.items() if key not in known or not _same(array, np.asarray(known[key]))
    }
    texts = {
        NAMES: Labelled(Quantity(NAMES, "", "names of all that is remembered"), " ".join(arrays)),
        STORED: Labelled(Quantity(STORED, "", "names of what is stored here"), " ".join(stored)),
    }
    values = {}
    for key, array in stored.items():
        dims = tuple(f"{key}_{axis}" for axis in range(array.ndim))
        values[key] = Labelled(Quantity(key, "", f"{key} that is remembered", dims), array)
    return texts | values


def _same(one: Any, other: Any) -> bool:
    """Whether two arrays are equal to the bit."""
    if one is other:
        return True
    return bool(one.shape == other.shape and one.dtype == other.dtype and one.tobytes() == other.tobytes())
