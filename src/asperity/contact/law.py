"""Interface laws: bounds on the pressure, which may change with the permanent indentation."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import ClassVar, Protocol, runtime_checkable

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import InputError
from .couplings.protocol import Contact, Coupling, Exchange, Memory, Posed, Share


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
    """Frictionless, non-adhesive, elastic: the Hertz-Signorini-Moreau conditions (Johnson 1985,
    sec. 5.6)."""

    name: ClassVar[str] = "hard wall"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985",)

    def pressure_cap(self) -> float:
        """Infinity."""
        return math.inf


@dataclass(frozen=True, eq=False)
class Hardness:
    """0 <= p <= H; where p = H the surface is permanently indented (Tian & Bhushan 1996; Almqvist
    et al. 2007).

    Parameters
    ----------
    value
        Hardness H of the softer solid in Pa: a positive number, or an (nx, ny) array of positive
        numbers.

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
    """Law with a limit of the pressure that depends on the permanent indentation of each point, on
    nothing else and everywhere alike.

    Both methods take any selection of points as a two-dimensional array.
    """

    def cap_at(self, indentation: RealArray) -> float | RealArray:
        """Largest pressure in Pa where the surface is indented by ``indentation`` (nx, ny) in m."""

    def work_at(self, indentation: RealArray) -> RealArray:
        """Work (nx, ny) in J/m² to indent the virgin surface by ``indentation`` (nx, ny) in m."""


# A limit of the pressure as a coupling.


def added_indentation(contact: Contact) -> RealArray:
    """Permanent indentation (nx, ny) in m that ``contact`` adds: the overlap of the bodies where
    the pressure is at its limit."""
    if contact.qp.elastic:
        return np.zeros_like(contact.qp.profile)
    p = contact.pressure
    return np.where((p > 0.0) & (p >= contact.cap), np.maximum(contact.overlap, 0.0), 0.0)


def indentation_before(posed: Posed, memory: Memory) -> RealArray:
    """Permanent indentation (nx, ny) in m in the ``memory`` of the interface."""
    return memory["indentation"] if "indentation" in memory else np.zeros_like(posed.profile)


def indented(law: InterfaceLaw, memory: Memory, contact: Contact) -> Memory:
    """Indentation (m), left out where there is none, and plastic work (J) since the virgin surface,
    after ``contact``; ``memory`` is what they were before."""
    if contact.qp.elastic:
        return {"work": np.zeros(()), **memory}
    first = indentation_before(contact.posed, memory)
    last = first + added_indentation(contact)
    deeper, density = last - first, np.zeros_like(last)  # in J/m²: the integral of the limit
    index = np.flatnonzero(deeper)
    if isinstance(law, LimitByDepth) and index.size:
        after, before = (law.work_at(depth.reshape(-1)[index][None])[0] for depth in (last, first))
        density.reshape(-1)[index] = after - before
    elif index.size:
        density = law.pressure_cap() * deeper
    work = float(density.sum()) * contact.posed.operator.grid.pixel_area
    return {"indentation": last, "work": np.asarray(float(memory.get("work", 0.0)) + work)}


@dataclass(frozen=True)
class ConstantHardness(Coupling):
    """Limit of the pressure that does not change with depth, or none at all: passive."""

    law: InterfaceLaw
    name: ClassVar[str] = "hardness"
    feedback: ClassVar[bool] = False
    remedy: ClassVar[str] = ""

    @property
    def bounds(self) -> bool:
        """Whether it limits the pressure everywhere."""
        return bool(np.all(np.isfinite(self.law.pressure_cap())))

    @property
    def cap(self) -> RealArray | float:
        """The limit."""
        return self.law.pressure_cap()

    def begin(self, posed: Posed, memory: Memory) -> Exchange:
        """The indentation so far, (nx, ny) in m; of no points where there is none."""
        before = memory.get("indentation", np.zeros(0))
        return Exchange(before, before, note=memory)

    def share(self, exchange: Exchange) -> Share:
        """The limit, and the indentation before the step, if there is one, as a lift."""
        return Share(lift=exchange.x if exchange.x.any() else 0.0, cap=self.law.pressure_cap())

    def end(self, exchange: Exchange, contact: Contact) -> tuple[Memory, None]:
        """Indentation and work."""
        return indented(self.law, exchange.note, contact), None
