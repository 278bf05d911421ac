"""Adhesion in result files: the attraction as a field, everything else as one text; and back to the bit."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, replace
from typing import Any

import numpy as np

from ..core.quantity import Labelled, Quantity
from ..core.status import Outcome, Status
from ..physics.adhesion.answer import AdhesiveContact
from ..physics.adhesion.law import Adhesion
from .description import describe, rebuild

STICK_SLIP, ADHESION = "stick_slip", "adhesion"
"""Couplings; the group of the first, and the name of the text of the second."""

FOLLOWING = (STICK_SLIP, ADHESION)
"""Couplings whose memory follows from what they found."""

ATTRACTION = Quantity("attraction", "Pa", "attraction of the surfaces")

_TEXTS = ("outcome", "message", "remedy")


def adhesion_text(found: AdhesiveContact) -> str:
    """All that files hold of ``found`` but its law and its field, as JSON."""
    apart = ("law", "attraction", "status")
    numbers = {item.name: describe(getattr(found, item.name)) for item in fields(found) if item.name not in apart}
    return json.dumps(numbers | {"status": [str(getattr(found.status, name)) for name in _TEXTS]})


def adhesion_columns(steps: Sequence[AdhesiveContact]) -> Iterator[Labelled]:
    """The same, and the field, of every step of a history."""
    if steps:
        attraction = np.stack([step.attraction for step in steps])
        yield Labelled(replace(ATTRACTION, dims=("step", "x", "y")), attraction)
        text = Quantity(ADHESION, "", "numbers of the adhesion, as JSON", dims=("step",))
        yield Labelled(text, np.asarray([adhesion_text(step) for step in steps]))


def adhesion_from(source: Mapping[str, Any], law: Adhesion, text: str) -> AdhesiveContact:
    """Adhesion of a group or a step, whose variables are ``source``, from its ``text``."""
    numbers = {key: rebuild(value) for key, value in json.loads(text).items()}
    ended = numbers.pop("status")
    status = Status(Outcome(ended[0]), ended[1], ended[2])
    return AdhesiveContact(law=law, attraction=np.asarray(source[ATTRACTION.name]), status=status, **numbers)


def following(couplings: Mapping[str, Any], gap: Any, approach: float) -> dict[str, Any]:
    """Memories that follow from what the couplings found, and from the ``gap`` (nx, ny) and the ``approach`` in m."""
    found = {STICK_SLIP: couplings[STICK_SLIP].memory} if STICK_SLIP in couplings else {}
    return found | ({ADHESION: couplings[ADHESION].memory(gap, approach)} if ADHESION in couplings else {})
