"""Pressure limited by the indentation hardness: elastic-perfectly plastic contact."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import InputError


@dataclass(frozen=True, eq=False)
class Hardness:
    """0 <= p <= H; where p = H the surface is permanently indented (Tian & Bhushan 1996; Almqvist et al. 2007).

    Parameters
    ----------
    value
        Hardness H of the softer solid in Pa: a positive number, or an (nx, ny) array of positive numbers.

    Raises
    ------
    InputError
        If any hardness is not positive and finite.
    """

    value: float | RealArray
    _cap: float | RealArray = field(init=False, repr=False)
    name: ClassVar[str] = "hardness"
    citation_keys: ClassVar[tuple[str, ...]] = ("Almqvist2007", "Greenwood1966", "Tian1996")

    def __post_init__(self) -> None:
        if isinstance(self.value, str | bool):
            raise InputError(f"hardness (Pa) must be a number or an array of numbers, but is {self.value!r}.")
        cap = np.array(self.value, dtype=float)
        if not np.isfinite(cap).all() or cap.min() <= 0.0:
            worst = cap.min() if cap.ndim else float(cap)
            raise InputError(
                f"hardness (Pa) must be positive and finite, but is {worst:g}. Use HardWall() for no limit."
            )
        if cap.ndim not in (0, 2):
            raise InputError(f"hardness must be one number or an (nx, ny) array, but has {cap.ndim} dimension(s).")
        cap.flags.writeable = False
        object.__setattr__(self, "_cap", float(cap) if cap.ndim == 0 else cap)

    def pressure_cap(self) -> float | RealArray:
        """The hardness in Pa."""
        return self._cap
