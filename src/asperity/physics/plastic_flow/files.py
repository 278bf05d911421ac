"""What contacts with plastic flow hold in files of format 2."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...contact.couplings.protocol import Memory
from .answer import PlasticBody
from .coupling import found_in

if TYPE_CHECKING:
    from ...io.format2 import Older

_POINTS = ("points", "plastic_strain", "back_stress", "accumulated")
_EACH = ("lift", "first", "work", "step_work", "energy", "iterations")
"""Memory of plastic flow: what is as long as there are points, and what every step has one of."""


def older(at: Older) -> tuple[PlasticBody, Memory | None] | None:
    """The flow of a contact or step and what it remembers; None without plastic flow."""
    if at.problem.plastic_flow is None:
        return None
    memory: Memory | None = None
    if at.values.get("plastic_flow_points_count"):
        found = {name: np.asarray(at.values[f"plastic_flow_{name}"]) for name in _EACH}
        for name in (*_POINTS, "edges"):
            counts = f"plastic_flow_{'edges' if name == 'edges' else 'points'}_count"
            found[name] = at.rows(counts, f"plastic_flow_{name}")
        memory = found
    elif "plastic_flow_points_count" not in at.values:
        memory = at.memory.get("plastic_flow")
    return found_in(at.problem, memory or {}), memory
