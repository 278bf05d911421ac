"""What contacts of viscoelastic bodies hold in files of format 2."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING, Any

import numpy as np

from ...contact.couplings.protocol import Memory
from .moments import COLUMNS, Creeping

if TYPE_CHECKING:
    from ...io.format2 import Older

_LATER = ("shear_work", "missed", "explained", "largest_work")
"""Numbers of steps that older files do not hold."""


def older(at: Older) -> tuple[Creeping, Memory | None] | None:
    """What happened in time in a contact or step, and the past where it is known; None of bodies
    that do not relax."""
    values = at.values
    if "creep_retarded_displacement" not in values:
        return None
    records = np.stack([np.asarray(at.rows("creep_moments", f"creep_{item.name}")) for item in COLUMNS], axis=1)
    names = [item.name for item in fields(Creeping) if item.name not in ("records", "retarded_displacement")]
    there = [name for name in names if name not in _LATER or f"creep_step_{name}" in values]
    numbers: dict[str, Any] = {name: np.asarray(values[f"creep_step_{name}"]).item() for name in there}
    found = Creeping(records, np.asarray(values["creep_retarded_displacement"]), **numbers)
    return found, at.memory.get("creep", at.past)
