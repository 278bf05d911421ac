"""Which parts there are."""

from __future__ import annotations

from .contact import Contact
from .menisci import Menisci, WetTheory
from .part import Part
from .plastic_load import PlasticLoad
from .stress import Stress, Yielding

BUILT_IN: tuple[Part, ...] = (Contact(), Menisci(), WetTheory(), Stress(), Yielding(), PlasticLoad())
"""The parts of this package in the order in which they are computed and shown."""


def parts() -> tuple[Part, ...]:
    """All parts."""
    return BUILT_IN
