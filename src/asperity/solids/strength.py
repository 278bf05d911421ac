"""Limits of a material beyond which it is no longer elastic."""

from __future__ import annotations

from dataclasses import dataclass

from ..core import require


@dataclass(frozen=True)
class Strength:
    """Hardness and tensile yield stress in Pa; ``nan`` where not known.

    Raises
    ------
    InputError
        If a given value is not positive.
    """

    hardness: float = float("nan")
    yield_stress: float = float("nan")

    def __post_init__(self) -> None:
        for value, what in ((self.hardness, "hardness (Pa)"), (self.yield_stress, "yield stress (Pa)")):
            if value == value:
                require.positive(value, what)
