"""Conductance of joints of nominally flat rough surfaces, without a map of them.

Written for heat, k_s = 2 k1 k2/(k1 + k2) in W/(m K) and h in W/(m² K); with conductivities in S/m
the same formulas give S/m².
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import NormalDist
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.values import HardnessValue, Length, Number, Positive
from ..ask import PRESSURE, Way
from ..protocol import Bound, Modulus, Theory, curve

MeanConductivity = Annotated[
    float, Number("thermal conductivity", above=0.0), Help("k_s = 2 k1 k2/(k1 + k2) of both bodies", of="bodies")
]
RmsHeight = Annotated[Length, "rms height σ of the composite profile"]
ProfileSlope = Annotated[
    Positive, "mean absolute slope m of profiles of the composite surface, √(2/π) of its rms slope if Gaussian"
]


@dataclass(frozen=True, eq=False, repr=False)
class JointAnswer(Tabled):
    """A joint along a curve of pressures; (n,) each, NaN where a theory does not give it.

    Parameters
    ----------
    pressure
        Nominal pressure in Pa.
    conductance
        Conductance of the contact per nominal area in W/(m² K).
    area_fraction
        Real over nominal area.
    separation
        Distance of the mean planes in m.
    """

    pressure: RealArray
    conductance: RealArray
    area_fraction: RealArray
    separation: RealArray


JOINT = (
    Quantity("pressure", "Pa", "nominal pressure"),
    Quantity("conductance", "W/(m**2*K)", "conductance of the contact per nominal area"),
    Quantity("area_fraction", "1", "real area per nominal area"),
    Quantity("separation", "m", "distance of the mean planes"),
)
"""What joints answer."""

WAYS = (Way(PRESSURE, "at_pressure", JOINT),)


_normal_quantile = np.vectorize(NormalDist().inv_cdf, otypes=[float])


class _Joint(Theory):
    ways: ClassVar[tuple[Way, ...]] = WAYS


@dataclass(frozen=True)
class PlasticJoint(_Joint):
    """Summits of a Gaussian surface that flow, each a circle at the end of a tube:

        P/H = erfc(Λ/√2)/2,  h σ/(k_s m) = exp(-Λ²/2)/(2 √(2π) (1 - √(P/H))^(3/2)).

    Its usual correlation is ``correlation``. Joints that are solved on a grid lie 5 % below at
    P/H = 0.001 and 20 % at 0.1.
    """

    conductivity: MeanConductivity
    rms_height: RmsHeight
    slope: ProfileSlope
    hardness: Annotated[HardnessValue, Help("hardness H of the softer body", of="bodies")]
    name: ClassVar[str] = "plastic-joint"
    title: ClassVar[str] = "Cooper, Mikic & Yovanovich, plastic joint"
    citation_keys: ClassVar[tuple[str, ...]] = ("Cooper1969", "Yovanovich1982")
    limits: ClassVar[tuple[Bound, ...]] = (
        Bound(
            "area fraction",
            lambda theory, answer: answer.area_fraction,
            0.0,
            0.1,
            "Cooper1969",
            "Spots merge; the tubes around them no longer stand for their neighbours.",
        ),
    )

    def at_pressure(self, pressure: ArrayLike) -> JointAnswer:
        """The joint at nominal pressures (n,) in Pa, > 0; InputError from half of the hardness
        on."""
        p = curve(pressure, "pressures (Pa)", positive=True)
        share = p / self.hardness
        if np.any(share >= 0.5):
            raise InputError(
                f"pressures of a plastic joint must be below half of the hardness, {0.5 * self.hardness:.4g} Pa, but "
                f"reach {p.max():.4g} Pa."
            )
        separation = -_normal_quantile(share)
        scaled = np.exp(-0.5 * separation**2) / (2.0 * math.sqrt(2.0 * math.pi) * (1.0 - np.sqrt(share)) ** 1.5)
        return JointAnswer(p, self._unit * scaled, share, self.rms_height * separation)

    def correlation(self, pressure: ArrayLike) -> RealArray:
        """h = 1.25 (k_s m/σ)(P/H)^0.95 in W/(m² K) at nominal ``pressure`` (Pa, any shape): within
        1.5 % for 1e-6 <= P/H <= 0.03 (Yovanovich 1982)."""
        return np.asarray(1.25 * self._unit * (np.asarray(pressure, dtype=float) / self.hardness) ** 0.95)

    @property
    def _unit(self) -> float:
        return self.conductivity * self.slope / self.rms_height


@dataclass(frozen=True)
class ElasticJoint(_Joint):
    """Summits of a Gaussian surface that stay elastic:

        h σ/(k_s m) = 1.55 (√2 P/(E* m))^(0.94).

    The real area is P √2/(E* m), half of that of plastic summits of this hardness, and with the
    mean absolute slope m that of Bush, Gibson and Thomas at light load, √(2π) P/(E* h'), h' the rms
    gradient.
    """

    conductivity: MeanConductivity
    E_star: Modulus
    rms_height: RmsHeight
    slope: ProfileSlope
    name: ClassVar[str] = "elastic-joint"
    title: ClassVar[str] = "Mikic, elastic joint"
    citation_keys: ClassVar[tuple[str, ...]] = ("Mikic1974",)
    limits: ClassVar[tuple[Bound, ...]] = (
        Bound(
            "pressure over E* and slope",
            lambda theory, answer: math.sqrt(2.0) * answer.pressure / (theory.E_star * theory.slope),
            1e-6,
            0.1,
            "Mikic1974",
            "The power law was fitted between these bounds.",
        ),
    )

    def at_pressure(self, pressure: ArrayLike) -> JointAnswer:
        """The joint at nominal pressures (n,) in Pa, > 0."""
        p = curve(pressure, "pressures (Pa)", positive=True)
        share = math.sqrt(2.0) * p / (self.E_star * self.slope)
        found = 1.55 * self.conductivity * self.slope / self.rms_height * share**0.94
        return JointAnswer(p, found, share, np.full_like(p, np.nan))


@dataclass(frozen=True)
class MeanGapJoint(_Joint):
    """Elastic surfaces whose mean gap falls as the logarithm of the load, P ~ exp(-u/u_0), so that
    their stiffness is P/u_0.

        h = (k_s/E*) P/u_0,  u_0 = γ h_rms.

    Conductance goes as the load (Akarapu, Sharp & Robbins 2011; Barber 2003).
    """

    conductivity: MeanConductivity
    E_star: Modulus
    rms_height: RmsHeight
    decay: Annotated[Positive, "γ = u_0/h_rms, 0.4 to 0.5 of self-affine surfaces"] = 0.45
    name: ClassVar[str] = "mean-gap-joint"
    title: ClassVar[str] = "Persson and Barber, conductance from the mean gap"
    citation_keys: ClassVar[tuple[str, ...]] = ("Akarapu2011", "Barber2003")
    limits: ClassVar[tuple[Bound, ...]] = (
        Bound(
            "conductance over that of a gap of the rms height",
            lambda theory, answer: answer.conductance * theory.rms_height / theory.conductivity,
            0.0,
            0.1,
            "Akarapu2011",
            "Near full contact the stiffness grows faster than the load.",
        ),
    )

    def at_pressure(self, pressure: ArrayLike) -> JointAnswer:
        """The joint at nominal pressures (n,) in Pa, > 0."""
        p = curve(pressure, "pressures (Pa)", positive=True)
        unknown = np.full_like(p, np.nan)
        return JointAnswer(p, self.conductivity / self.E_star * p / (self.decay * self.rms_height), unknown, unknown)
