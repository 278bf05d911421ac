"""Interface laws: bounds on the pressure, which may change with the permanent indentation."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import ClassVar, Protocol, runtime_checkable

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import InputError


@runtime_checkable
class InterfaceLaw(Protocol):
    """Law of the interface; frictionless and without adhesion it is a bound on the pressure."""

    @property
    def name(self) -> str:
        """Name for reports and documents."""

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers the law rests on."""

    def pressure_cap(self) -> float | RealArray:
        """Largest pressure the interface bears, in Pa: a number, an (nx, ny) array, or infinity."""


@dataclass(frozen=True)
class HardWall:
    """Frictionless, non-adhesive, elastic: the Hertz-Signorini-Moreau conditions (Johnson 1985, sec. 5.6)."""

    name: ClassVar[str] = "hard wall"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985",)

    def pressure_cap(self) -> float:
        """Infinity."""
        return math.inf


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


@runtime_checkable
class LimitByDepth(InterfaceLaw, Protocol):
    """Law with a limit of the pressure that depends on the permanent indentation of each point, on nothing else and everywhere alike.

    Both methods take any selection of points as a two-dimensional array.
    """

    def cap_at(self, indentation: RealArray) -> float | RealArray:
        """Largest pressure in Pa where the surface is indented by ``indentation`` (nx, ny) in m."""

    def work_at(self, indentation: RealArray) -> RealArray:
        """Work (nx, ny) in J/m² to indent the virgin surface by ``indentation`` (nx, ny) in m."""


def work_density(law: InterfaceLaw, before: RealArray, after: RealArray) -> RealArray:
    """Work (nx, ny) in J/m² to indent the surface from ``before`` to ``after`` (nx, ny) in m: the integral of the limit."""
    added = after - before
    if not added.any():
        return np.zeros_like(added)
    if not isinstance(law, LimitByDepth):
        work: RealArray = law.pressure_cap() * added
        return work
    index, density = np.flatnonzero(added), np.zeros_like(added)
    last, first = (law.work_at(depth.reshape(-1)[index][None])[0] for depth in (after, before))
    density.reshape(-1)[index] = last - first
    return density
