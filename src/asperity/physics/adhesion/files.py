"""What adhesive contacts hold in files of format 2."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import numpy as np

from ...contact.couplings.protocol import Memory
from ...core.status import Outcome, Status
from ...io.description import rebuild
from .answer import AdhesiveContact

if TYPE_CHECKING:
    from ...io.format2 import Older


def older(at: Older) -> tuple[AdhesiveContact, Memory] | None:
    """The adhesion of a contact or step and what it remembers; None without adhesion."""
    law, text = at.problem.adhesion, at.values.get("adhesion_found", at.values.get("adhesion"))
    if law is None or text is None:
        return None
    numbers = {key: rebuild(value) for key, value in json.loads(str(text)).items()}
    ended = numbers.pop("status")
    status = Status(Outcome(ended[0]), ended[1], ended[2])
    found = AdhesiveContact(law=law, attraction=np.asarray(at.values["attraction"]), status=status, **numbers)
    return found, found.memory(at.values["gap"], float(at.values["approach"]))
