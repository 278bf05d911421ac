"""How both bodies move under the contact, and what heat meets between them and in their depth."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Literal, Self

from ...core import require
from ...core.errors import InputError
from ...core.late import Shown

MOVING = ("counter_body", "body", "opposite", "rolling")
"""Which body moves in the frame in which the spots of contact rest."""


@dataclass(frozen=True, repr=False)
class Motion(Shown):
    """Velocities of the materials of both bodies along the surface, in the frame in which the spots
    of contact rest: there the body that carries the roughness, or a pin on a disc, has none.

    InputError if a velocity is no pair of finite numbers.

    Parameters
    ----------
    body, counter_body
        Velocities (vx, vy) in m/s.
    """

    body: tuple[float, float]
    counter_body: tuple[float, float]
    citation_keys: ClassVar[tuple[str, ...]] = ()

    def __post_init__(self) -> None:
        for name in ("body", "counter_body"):
            what = f"velocity of the {name.replace('_', ' ')} (m/s)"
            pair = require.two(getattr(self, name), what)
            object.__setattr__(self, name, (require.finite(pair[0], what), require.finite(pair[1], what)))

    @classmethod
    def of(
        cls,
        speed: float,
        moving: Literal["counter_body", "body", "opposite", "rolling"] = "counter_body",
        *,
        direction: float = 0.0,
        rolling: float = 0.0,
    ) -> Self:
        """That of a sliding ``speed``, with which the counter body slides over the body.

        Parameters
        ----------
        speed
            Sliding speed in m/s, >= 0.
        moving
            Which material moves under the spots: the ``counter_body`` alone, the ``body`` alone,
            both in ``opposite`` directions with half of the speed each, or both in ``rolling`` with
            creep.
        direction
            Angle in rad from +x towards +y in which the counter body slides.
        rolling
            Mean speed in m/s of both materials, of ``rolling`` alone.

        Raises
        ------
        InputError
            If the speed is negative, ``moving`` none of these, or ``rolling`` is given beside
            another one.
        """
        v, u = require.not_negative(speed, "sliding speed (m/s)"), require.finite(rolling, "rolling speed (m/s)")
        require.one_of(moving, MOVING, "moving body")
        if u and moving != "rolling":
            raise InputError(f"rolling speed (m/s) must be left out where nothing rolls, but is {u:g}.")
        share = {"counter_body": 0.0, "body": -1.0, "opposite": -0.5, "rolling": -0.5}[moving]
        along = (round(math.cos(direction), 15), round(math.sin(direction), 15))
        first, second = u + share * v, u + (1.0 + share) * v
        return cls((first * along[0], first * along[1]), (second * along[0], second * along[1]))

    @property
    def slip(self) -> tuple[float, float]:
        """Velocity of the counter body over the body, m/s."""
        return self.counter_body[0] - self.body[0], self.counter_body[1] - self.body[1]

    @property
    def speed(self) -> float:
        """Sliding speed in m/s."""
        return math.hypot(*self.slip)

    @property
    def velocities(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Those of body and counter body."""
        return self.body, self.counter_body


@dataclass(frozen=True, repr=False)
class HeatedInterface(Shown):
    """What heat meets on its way from where it is made: films, bonds of layers, the temperature and
    the depth of the bodies. Of pairs the first value is that of the body, the second that of the
    counter body.

    InputError if a value is outside its range.

    Parameters
    ----------
    resistance
        Specific resistances R1 and R2 in m² K/W, >= 0, between the plane in which heat is made and
        either body.
    bulk
        Temperatures of the bodies in K, > 0: of their mean planes in periodic contact.
    sink
        Depths in m, > 0, in which the bodies are held at those temperatures; infinite by default,
        where the mean of a periodic contact is left out.
    bonds
        Specific resistances in m² K/W, >= 0, under each layer from the surface down; those that are
        not given are zero.
    """

    resistance: tuple[float, float] = (0.0, 0.0)
    bulk: tuple[float, float] = (293.15, 293.15)
    sink: tuple[float, float] = (math.inf, math.inf)
    bonds: tuple[tuple[float, ...], tuple[float, ...]] = ((), ())
    citation_keys: ClassVar[tuple[str, ...]] = ()

    def __post_init__(self) -> None:
        for name in ("resistance", "bulk", "sink", "bonds"):
            require.two(getattr(self, name), f"{name} of a heated interface")
        for value in self.resistance:
            require.not_negative(value, "specific resistance between the heat and a body (m² K/W)")
        for value in self.bulk:
            require.positive(value, "temperature of a body (K)")
        for value in self.sink:
            if value != math.inf:
                require.positive(value, "depth of a heat sink (m)")
        for value in (*self.bonds[0], *self.bonds[1]):
            require.not_negative(value, "specific resistance of a bond (m² K/W)")

    @property
    def difference(self) -> float:
        """Temperature of the counter body less that of the body, K."""
        return self.bulk[1] - self.bulk[0]
