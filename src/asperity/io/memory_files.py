"""Memories of couplings in result files: named arrays of a group, or numbers as JSON."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from ..core.quantity import Labelled, Quantity
from .tree import Node


def memory_node(memory: Mapping[str, Any]) -> Node:
    """Group of the named arrays in the memory of a coupling; their axes have names of their own."""
    values = []
    for name, array in memory.items():
        found = np.asarray(array)
        dims = tuple(f"{name}_{axis}" for axis in range(found.ndim))
        values.append(Labelled(Quantity(name, "", f"{name} that is remembered", dims=dims), found))
    return Node(tuple(values))


def memory_in(node: Node) -> dict[str, Any]:
    """The arrays of such a group by name."""
    return {item.quantity.name: np.asarray(item.values) for item in node.values}


def memories_of(text: str) -> dict[str, Any]:
    """Memories of the couplings, but for what fields are kept of, from JSON."""
    return {key: {name: np.asarray(value) for name, value in item.items()} for key, item in json.loads(text).items()}
