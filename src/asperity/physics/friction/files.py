"""What contacts with friction hold in files of format 2."""

from __future__ import annotations

import json
from dataclasses import fields
from typing import TYPE_CHECKING, Any

import numpy as np

from ...contact.couplings.protocol import Memory
from ...core.status import Outcome, Status
from ...io.description import rebuild
from .answer import StickSlip
from .law import Coulomb
from .sliding import GrossSliding

if TYPE_CHECKING:
    from ...io.format2 import Older

_VECTORS = ("traction", "slip_increment", "slip", "tangential_displacement")
"""Fields of stick and slip whose components along x and y stood apart."""

_PREFIX = "stick_slip_"


def older_sliding(at: Older) -> tuple[GrossSliding, None] | None:
    """The gross sliding of a contact or step; None without a displacement by shear."""
    law = at.problem.friction
    if not isinstance(law, Coulomb) or "shear_displacement" not in at.values:
        return None
    return GrossSliding(law.coefficient, law.direction, at.values["shear_displacement"]), None


def older_stick_slip(at: Older) -> tuple[StickSlip, Memory] | None:
    """Stick and slip of a contact or step and what they remember; None without them."""
    law, source = at.problem.friction, at.values
    if law is None or f"{_PREFIX}tangential" not in source:
        return None
    found: dict[str, Any] = {name: np.stack([source[f"{_PREFIX}{name}_{axis}"] for axis in "xy"]) for name in _VECTORS}
    for item in fields(StickSlip):
        if item.name not in ("tangential", "status", "law", *_VECTORS):
            value = np.asarray(source[f"{_PREFIX}{item.name}"])
            found[item.name] = value if value.ndim else value.item()
    ended = [str(source[f"{_PREFIX}status_{name}"]) for name in ("outcome", "message", "remedy")]
    tangential = rebuild(json.loads(str(source[f"{_PREFIX}tangential"])))
    status = Status(Outcome(ended[0]), ended[1], ended[2])
    answer = StickSlip(law=law, tangential=tangential, status=status, **found)
    return answer, answer.memory
