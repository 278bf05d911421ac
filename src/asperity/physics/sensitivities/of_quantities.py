"""Outputs that are quantities of studies, and their derivatives to what a contact has."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from ...contact.result import ContactResult
from ...core.errors import AsperityError
from .answer import Sensitivities
from .outputs import Output, Slopes, State
from .sensitivities import sensitivities


@dataclass(frozen=True)
class LargestPressure:
    """Pressure of the pixel with the largest one, whose derivative is that of the maximum as long
    as it stays there."""

    name: str = "max_pressure"
    unit: str = "Pa"
    degree: float | None = 1.0

    def at(self, state: State) -> Slopes:
        """Value and partial derivatives."""
        slope = np.zeros(state.pressure.shape)
        where = int(np.argmax(state.pressure))
        slope.flat[where] = 1.0
        return Slopes(float(state.pressure.flat[where]), slope)


OUTPUTS: MappingProxyType[str, str | Output] = MappingProxyType(
    {
        "approach": "approach",
        "mean_gap": "mean_gap",
        "elastic_energy": "elastic_energy",
        "force": "force",
        "max_pressure": LargestPressure(),
    }
)
"""Output of the sensitivities for each quantity of studies that has one."""


def derivatives(result: ContactResult, quantity: str, names: Sequence[str]) -> Sensitivities | None:
    """Sensitivities of a ``quantity`` of studies to those of the parameters ``names`` that the
    contact has; None if to none, or the quantity has none."""
    return _derivatives(result, OUTPUTS[quantity], names) if quantity in OUTPUTS else None


def _derivatives(result: ContactResult, of: str | Output, names: Sequence[str]) -> Sensitivities | None:
    """Sensitivities to those of the parameters ``names`` that the contact has; None if to none."""
    try:
        return sensitivities(result, of, names)
    except AsperityError:  # the contact or the number has none, or not to one of the parameters
        pass
    kept = []
    for name in names if len(names) > 1 else ():
        try:
            sensitivities(result, of, name)
        except AsperityError:
            continue
        kept.append(name)
    return sensitivities(result, of, kept) if kept else None
