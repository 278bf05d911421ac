"""Laws of friction: the largest shear traction that a point of the contact bears before it
slips."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from typing import ClassVar, Protocol, runtime_checkable

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError


@runtime_checkable
class FrictionLaw(Protocol):
    """Law of friction: a bound on the shear traction, which may follow the pressure."""

    @property
    def name(self) -> str:
        """Name for reports and documents."""

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers the law rests on."""

    def bound(self, pressure: RealArray) -> RealArray:
        """Largest shear traction (nx, ny) in Pa under ``pressure`` (nx, ny) in Pa; zero where that
        is zero, infinite where nothing slips."""


@dataclass(frozen=True, eq=False)
class Coulomb:
    """Shear traction at most μ p, or at most the smaller of μ p and a limit.

    In a step without a tangential control all points slide: the shear traction is μ p in one
    direction. With one (``Shift``, ``TangentialForce``) the surfaces stick where the traction is
    smaller.

    Parameters
    ----------
    coefficient
        μ >= 0, shear traction over pressure of the solid contact: a number, or an (nx, ny) array.
    direction
        Angle in rad of the shear traction on ``body`` of the problem where all points slide, from
        +x towards +y.
    speed
        Sliding speed in m/s, >= 0, for the viscous force of a film of liquid.
    coupled
        Whether the shear of gross sliding changes the pressure, as it does between unlike bodies
        (Dundurs 1969); if not, it only adds forces.
    limit
        Largest shear traction in Pa whatever the pressure, > 0, for steps with a tangential
        control: shear strength of the interface.

    Raises
    ------
    InputError
        If coefficient or speed are negative, the limit is not positive, or a number is not finite.
    """

    coefficient: float | RealArray
    direction: float = 0.0
    speed: float = 0.0
    coupled: bool = True
    limit: float = math.inf
    name: ClassVar[str] = "Coulomb friction"

    def __post_init__(self) -> None:
        values = _number_or_map(self.coefficient, "friction coefficient")
        object.__setattr__(self, "coefficient", values)
        require.finite(self.direction, "direction of friction (rad)")
        require.not_negative(self.speed, "sliding speed (m/s)")
        if self.limit != math.inf:
            require.positive(self.limit, "limit of the shear traction (Pa)")

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Coulomb) and all(
            np.array_equal(getattr(self, name), getattr(other, name)) for name in self.__dataclass_fields__
        )

    def __hash__(self) -> int:
        return hash((self.direction, self.speed, self.coupled, self.limit))

    @property
    def couples(self) -> bool:
        """Whether there is shear that is to change the pressure."""
        return self.coupled and bool(np.any(self.coefficient))

    @property
    def largest(self) -> float:
        """Largest coefficient."""
        return float(np.max(self.coefficient))

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers of the displacement by shear, where there is any."""
        return ("Dundurs1969", "Johnson1985") if self.couples else ()

    def bound(self, pressure: RealArray) -> RealArray:
        """The smaller of μ p and the limit, in Pa."""
        return np.minimum(self.coefficient * pressure, self.limit)


@dataclass(frozen=True, eq=False)
class TrescaFriction:
    """Shear traction at most τ wherever the surfaces touch, whatever the pressure: soft films,
    adhesive friction.

    Parameters
    ----------
    strength
        τ in Pa, >= 0: a number, or an (nx, ny) array.
    speed
        Sliding speed in m/s, >= 0, for the viscous force of a film of liquid.

    Raises
    ------
    InputError
        If a strength or the speed is negative or not finite.
    """

    strength: float | RealArray
    speed: float = 0.0
    name: ClassVar[str] = "Tresca friction"
    citation_keys: ClassVar[tuple[str, ...]] = ("Dundurs1969", "Johnson1985")

    def __post_init__(self) -> None:
        object.__setattr__(self, "strength", _number_or_map(self.strength, "shear strength of the interface (Pa)"))
        require.not_negative(self.speed, "sliding speed (m/s)")

    def bound(self, pressure: RealArray) -> RealArray:
        """The strength in Pa where there is pressure."""
        return np.where(pressure > 0.0, self.strength, 0.0)


@dataclass(frozen=True)
class FullStick:
    """Nothing slips where the surfaces touch: the limit of a large friction coefficient."""

    name: ClassVar[str] = "full stick"
    citation_keys: ClassVar[tuple[str, ...]] = ("Dundurs1969", "Johnson1985")

    def bound(self, pressure: RealArray) -> RealArray:
        """Infinity where there is pressure."""
        return np.where(pressure > 0.0, math.inf, 0.0)


def at_points(law: FrictionLaw, index: np.ndarray[tuple[int], np.dtype[np.int64]]) -> FrictionLaw:
    """``law``, a dataclass, for the points at the flat ``index`` (n,) alone: its maps become arrays
    (1, n)."""
    values = {item.name: getattr(law, item.name) for item in fields(law)}  # type: ignore[arg-type]
    maps = {name: value.reshape(-1)[index][None] for name, value in values.items() if isinstance(value, np.ndarray)}
    return replace(law, **maps) if maps else law  # type: ignore[type-var]


def _number_or_map(value: float | RealArray, what: str) -> float | RealArray:
    """``value``, a number or an (nx, ny) array of numbers >= 0, as float or as an array that cannot
    be written to."""
    if not isinstance(value, np.ndarray) or value.ndim == 0:
        return require.not_negative(value, what)  # type: ignore[arg-type]
    found = np.array(value, dtype=float)
    if found.ndim != 2:
        raise InputError(f"{what} must be one number or an (nx, ny) array, but has {found.ndim} dimension(s).")
    if not np.isfinite(found).all() or found.min() < 0.0:
        raise InputError(f"{what} must be finite and not negative, but its smallest value is {found.min():g}.")
    found.flags.writeable = False
    return found
