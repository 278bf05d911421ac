"""Hardness at the strain rate of a passing asperity."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.values import HardnessValue, Number, Positive
from ..ask import Way, asked
from ..protocol import Bound, Prediction, Theory, checked, curve

RateLaw = Literal["power", "johnson-cook", "cowper-symonds"]

_ROUNDS = 100  # of the fixed point, whose error falls to a half or less in each
_MOST_EXPONENT = 1.0


@dataclass(frozen=True, eq=False, repr=False)
class RateAnswer(Tabled):
    """Hardness at strain rates (n,) in 1/s: ``strain_rate``, ``hardness`` in Pa and its ``ratio``
    to that of slow loads."""

    strain_rate: RealArray
    hardness: RealArray
    ratio: RealArray


@dataclass(frozen=True, eq=False, repr=False)
class SpotRateAnswer(RateAnswer):
    """The same of one fully plastic spot, with its ``contact_radius`` (m)."""

    contact_radius: RealArray


_HARDNESS = (
    Quantity("hardness", "Pa", "hardness at that rate"),
    Quantity("ratio", "1", "hardness over that of slow loads"),
)


@dataclass(frozen=True)
class RateHardness(Theory):
    """Hardness at the strain rate r at which an asperity of contact radius a passes at the speed v.

    Three laws, ``power``, ``johnson-cook`` and ``cowper-symonds``, with the hardness H_0 and the
    reference rate r_0:

        r = v/(2 a),
        H = H_0 (r/r_0)^m,
        H = H_0 [1 + C ln(r/r_0)]  (r > r_0),
        H = H_0 [1 + (r/r_0)^(1/q)].

    ``sensitivity`` is m, C or q. Johnson and Cook's law is H_0 below the reference rate. The spot
    of a load W has a² = W/(π H), so that the hardness follows from itself; for the power law

        H^(1-m/2) = H_0 (v/(2 r_0))^m (π/W)^(m/2).

    The least spots are the hardest. Below the reference rate the power law gives less than H_0, as
    creep does; heating by the plastic work, and moduli that change with the rate, are not in it.
    Rough surfaces: ``at_contacts`` takes the mean spot of a theory, and
    ``asperity.plasticity.solve_at_speed`` every island of a map.

    Examples
    --------
    >>> steel = RateHardness(3e9, "johnson-cook", 0.014, 1.0)
    >>> answer = steel.at_speed([1e-6, 1.0], 10e-3)
    >>> (answer.hardness / 1e9).round(2)
    array([3.  , 3.55])
    """

    hardness: Annotated[HardnessValue, Help("hardness H0 of slow loads", of="bodies")]
    law: Annotated[RateLaw, Help("law of the strain rate", of="choice")]
    sensitivity: Annotated[Positive, Help("exponent m, factor C, or root q of the law", of="bodies")]
    reference_rate: Annotated[float, Number("1/s", above=0.0), Help("reference strain rate", of="bodies")]
    name: ClassVar[str] = "rate-hardness"
    title: ClassVar[str] = "Hardness at the strain rate of an asperity"
    citation_keys: ClassVar[tuple[str, ...]] = ("Bhushan1998", "JohnsonCook1983", "Cowper1957")
    limits: ClassVar[tuple[Bound, ...]] = (
        Bound(
            "strain rate over the reference rate, power law",
            lambda theory, answer: answer.strain_rate / theory.reference_rate if theory.law == "power" else None,
            1.0,
            math.inf,
            "Bhushan1998",
            "The power law gives less than the hardness of slow loads there, as creep does.",
        ),
    )
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            asked("speed", "m/s", "sliding speed"),
            "at_speed",
            (
                Quantity("contact_radius", "m", "radius of the fully plastic spot"),
                Quantity("strain_rate", "1/s", "strain rate v/2a"),
                *_HARDNESS,
            ),
            (asked("load", "N", "load of the spot"),),
        ),
        Way(asked("rate", "1/s", "strain rate"), "at_rate", _HARDNESS),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.law != "johnson-cook" and not self._exponent < _MOST_EXPONENT:
            rule = "less than 1" if self.law == "power" else "greater than 1"
            raise InputError(
                f"sensitivity of the hardness to the rate must be {rule} for the law {self.law}, but is "
                f"{self.sensitivity:g}: it is the {'exponent m' if self.law == 'power' else 'root q'}."
            )

    @property
    def _exponent(self) -> float:
        return self.sensitivity if self.law == "power" else 1.0 / self.sensitivity

    def _ratio(self, rate: RealArray) -> RealArray:
        """H/H_0 at strain rates in 1/s, of any shape."""
        share = rate / self.reference_rate
        if self.law == "power":
            return np.asarray(share**self.sensitivity)
        if self.law == "johnson-cook":
            return np.asarray(1.0 + self.sensitivity * np.log(np.maximum(share, 1.0)))
        return np.asarray(1.0 + share**self._exponent)

    def at_rate(self, rate: ArrayLike) -> RateAnswer:
        """Hardness at strain rates (n,) in 1/s, > 0."""
        rates = curve(rate, "strain rates (1/s)", positive=True)
        ratio = self._ratio(rates)
        return RateAnswer(rates, self.hardness * ratio, ratio)

    def at_diameter(self, speed: float, diameter: ArrayLike) -> RealArray:
        """Hardness in Pa of spots of the ``diameter`` in m, > 0, of any shape, that pass at the
        ``speed`` in m/s, > 0."""
        rate = require.positive(speed, "sliding speed (m/s)") / checked(diameter, "diameter of a spot (m)")
        return np.asarray(self.hardness * self._ratio(rate))

    def at_speed(self, speed: ArrayLike, load: float) -> SpotRateAnswer:
        """One fully plastic spot under the ``load`` in N, > 0, at sliding speeds (n,) in m/s,
        > 0."""
        v, W = curve(speed, "sliding speeds (m/s)", positive=True), require.positive(load, "load of a spot (N)")
        H = np.full_like(v, self.hardness)
        if self.law == "power":
            m = self.sensitivity
            front = self.hardness * (0.5 * v / self.reference_rate) ** m * (math.pi / W) ** (0.5 * m)
            H = front ** (1.0 / (1.0 - 0.5 * m))
        else:
            for _ in range(_ROUNDS):
                H = self.hardness * self._ratio(0.5 * v * np.sqrt(math.pi * H / W))
        a = np.sqrt(W / (math.pi * H))
        return SpotRateAnswer(0.5 * v / a, H, H / self.hardness, a)

    def at_contacts(self, contacts: Prediction, speed: float) -> RateAnswer:
        """Hardness at the mean spot of a theory's ``contacts``, of diameter 2 sqrt(A_r/(π n)), at
        the ``speed`` in m/s, > 0; NaN where the theory counts no contacts.

        Indices of plasticity and limits of the pressure are those of this hardness.
        """
        with np.errstate(invalid="ignore", divide="ignore"):
            diameter = 2.0 * np.sqrt(contacts.area_fraction / (math.pi * contacts.contact_density))
            rate = require.positive(speed, "sliding speed (m/s)") / diameter
        ratio = self._ratio(rate)
        return RateAnswer(rate, self.hardness * ratio, ratio)
