"""A mass on a rough interface: normal vibration, free or forced, with loss of contact, and
impact."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.parameters import Declared
from ...core.values import Number, Positive
from .interface import NormalCompliance
from .motion import Guard, Motion, Phase, integrated, sample_times

Mass = Annotated[float, Number("kg", above=0.0)]
ContactArea = Annotated[float, Number("area", above=0.0)]
SignedForce = Annotated[float, Number("force", least=0.0)]

TOLERANCE = 1e-9
"""Local error of the integration unless said otherwise, relative to the amplitudes at rest."""


@dataclass(frozen=True)
class NormalOscillator(Declared):
    """Mass that its load W + F cos(Ωt) presses on a rough interface: M d²y/dt² = W + F cos(Ωt) - A
    p(y, dy/dt).

    Parameters
    ----------
    law
        Of the interface.
    mass
        M in kg, > 0.
    area
        Nominal area A in m², > 0.
    load
        W in N, > 0.
    forcing
        Amplitude F in N, >= 0.
    forcing_rate
        Angular frequency Ω in rad/s, > 0.

    Raises
    ------
    InputError
        If a parameter is out of its range.

    Examples
    --------
    >>> law = NormalCompliance.amontons(2.8e18, 2.0)
    >>> joint = NormalOscillator(law, mass=1.0, area=2e-3, load=100.0)
    >>> f"{joint.natural_frequency:.0f} rad/s"
    '38686 rad/s'
    """

    law: NormalCompliance
    mass: Annotated[Mass, "Mass."]
    area: Annotated[ContactArea, "Nominal contact area."]
    load: Annotated[float, Number("force", above=0.0), "Load, weight included."]
    forcing: Annotated[SignedForce, "Amplitude of a harmonic force."] = 0.0
    forcing_rate: Annotated[Positive, "Angular frequency of the harmonic force, in rad/s."] = 1.0
    name: ClassVar[str] = "mass on a rough interface"
    citation_keys: ClassVar[tuple[str, ...]] = ("Oden1985", "Martins1990")

    def __post_init__(self) -> None:
        super().__post_init__()
        require.instance(self.law, NormalCompliance, "law", "Give an NormalCompliance.")

    @property
    def rest(self) -> float:
        """Penetration y_0 = (W/(c_n A))^{1/m} at rest, in m."""
        return float(self.law.approach(self.load / self.area))

    @property
    def natural_frequency(self) -> float:
        """ω_0 = sqrt(m W/(M y_0)) of small undamped vibrations about rest, in rad/s."""
        return math.sqrt(self.law.normal_exponent * self.load / (self.mass * self.rest))

    @property
    def damping_ratio(self) -> float:
        """A b_n y_0^{l} / (2 M ω_0) of small vibrations about rest."""
        _, power, _ = self.law.exponents
        return float(
            self.area * self.law.damping_coefficient * self.rest**power / (2.0 * self.mass * self.natural_frequency)
        )

    def move(
        self,
        duration: float,
        *,
        start: Sequence[float] | None = None,
        samples: int = 2000,
        tolerance: float = TOLERANCE,
    ) -> Motion:
        """Motion over ``duration`` (s) with loss of contact and contact as events.

        Parameters
        ----------
        duration
            In s, > 0.
        start
            Penetration in m and its rate in m/s at the start, a negative penetration above the
            surface; at rest if not given. The ``end`` of another motion goes on from there.
        samples
            Number of intervals in which the motion is given.
        tolerance
            Local error of the integration.

        Returns
        -------
        Motion

        Raises
        ------
        InputError
            If a value is out of range.
        ConvergenceError
            If the integration fails.

        Notes
        -----
        Dormand and Prince's method of order 8 (the motion is not stiff), restarted where contact is
        lost or made, where the higher derivatives jump. The work of the forcing and the heat of the
        damping are integrated beside the motion.
        """
        times = sample_times(duration, samples)
        require.between(tolerance, 0.0, 1e-2, "tolerance")
        y0, rate0 = started((self.rest, 0.0) if start is None else start)
        unit, time_unit = self.rest, 1.0 / self.natural_frequency
        touching = y0 > 0.0 or (y0 == 0.0 and rate0 > 0.0)
        scales = np.array([unit, unit / time_unit, self.load * unit, self.load * unit])
        c, m, A, M = self.law.normal_coefficient, self.law.normal_exponent, self.area, self.mass
        b, power = self.law.damping_coefficient, self.law.exponents[1]

        def pushed(time: float) -> float:
            return self.forcing * math.cos(self.forcing_rate * time)

        def in_contact(time: float, s: RealArray) -> RealArray:
            y, rate = max(float(s[0]), 0.0), float(s[1])
            elastic, damping = A * c * y**m, A * b * y**power * rate
            damping = max(damping, -elastic)  # no tension
            force = pushed(time)
            return np.array([rate, (self.load + force - elastic - damping) / M, force * rate, damping * rate])

        def in_flight(time: float, s: RealArray) -> RealArray:
            force = pushed(time)
            return np.array([s[1], (self.load + force) / M, force * s[1], 0.0])

        def depth(time: float, s: RealArray) -> float:
            return float(s[0])

        leaves = Guard(depth, -1.0, "loss of contact", lambda time, s: "flight")
        lands = Guard(depth, 1.0, "contact", lambda time, s: "contact")
        course = integrated(
            {"contact": Phase(in_contact, (leaves,)), "flight": Phase(in_flight, (lands,))},
            "contact" if touching else "flight",
            [y0, rate0, 0.0, 0.0],
            times,
            method="DOP853",
            tolerance=tolerance,
            scales=scales,
        )
        y, rate, supplied, dissipated = course.states.T
        values = {
            "penetration": y,
            "penetration_rate": rate,
            "normal_force": self.area * self.law.pressure(y, rate),
            "kinetic_energy": 0.5 * self.mass * rate**2,
            "elastic_energy": self.area * self.law.energy(y) - self.load * y,
            "supplied": supplied,
            "dissipated": dissipated,
        }
        return Motion(times, values, course.events, tuple(course.states[-1, :2]), course.evaluations)


def started(start: Sequence[float]) -> tuple[float, float]:
    """Position in m and velocity in m/s of ``start``.

    Raises
    ------
    InputError
        If it does not hold two finite numbers.
    """
    if len(start) != 2:
        raise InputError(f"start must hold a position (m) and a velocity (m/s), but is {tuple(start)!r}.")
    position, velocity = start
    return require.finite(position, "position at the start (m)"), require.finite(
        velocity, "velocity at the start (m/s)"
    )
