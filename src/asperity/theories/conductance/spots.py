"""Conductance of single spots and of clusters, in closed form.

Both bodies together, between points far away: k_s = 2 k1 k2/(k1 + k2) is the harmonic mean of
their conductivities in S/m or W/(m K), and conductances are in S or W/K. The two bodies are
half-spaces, insulated outside the spots, so that the spots have one potential.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.late import Tabled
from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.values import Number, Several
from ..ask import CONTACT_RADIUS, Way
from ..protocol import Bound, Theory, checked

CAPACITY_OF_A_SQUARE = 0.36678741
"""Capacity of a square plate over that of a sphere of its side as radius (Hwang & Mascagni
2004)."""

LORENZ = 2.45e-8
"""Lorenz number of metals in V²/K²."""


def circle(k_s: float, radius: ArrayLike) -> RealArray:
    """G = 2 k_s a of circles of ``radius`` a (m), any shape (Holm 1967).

    Examples
    --------
    >>> circle(50e6, 1e-6).item()  # S
    100.0
    """
    return np.asarray(2.0 * _conductivity(k_s) * _positive(radius, "radius of a spot (m)"))


def ellipse(k_s: float, semi_major: float, semi_minor: float) -> float:
    """G = π k_s a/K(e) of an ellipse of semi-axes a >= b (m), e² = 1 - b²/a² (Holm 1967).

    Raises
    ------
    InputError
        If the minor axis is longer than the major one.
    """
    a = require.positive(semi_major, "semi-major axis of a spot (m)")
    b = require.positive(semi_minor, "semi-minor axis of a spot (m)")
    if b > a:
        raise InputError(f"semi-minor axis of a spot (m) must be at most the semi-major one, {a:g}, but is {b:g}.")
    mean, other = a, b  # arithmetic-geometric mean of the axes: K = π a/2 over it
    while mean - other > 1e-15 * mean:
        mean, other = 0.5 * (mean + other), math.sqrt(mean * other)
    return 2.0 * _conductivity(k_s) * mean


def square(k_s: float, side: float) -> float:
    """G = 1.1523 k_s s of a square of ``side`` s (m), from its capacity."""
    return math.pi * CAPACITY_OF_A_SQUARE * _conductivity(k_s) * require.positive(side, "side of a spot (m)")


def strips(k_s: float, contact_fraction: ArrayLike, period: float) -> RealArray:
    """Conductance per area π k_s/(-2 λ ln sin(π f/2)) of parallel strips that touch on the fraction
    f of each ``period`` λ (m), 0 < f <= 1 (Westergaard's stiffness).

    It is that of the constriction alone, between mean planes far away; infinite at f = 1.
    """
    f = np.asarray(contact_fraction, dtype=float)
    if not np.all((f > 0.0) & (f <= 1.0)):
        raise InputError(f"contact fraction of strips must be greater than zero and at most one, but is {f!r}.")
    with np.errstate(divide="ignore"):
        wide = -2.0 * require.positive(period, "period of strips (m)") * np.log(np.sin(0.5 * math.pi * f))
        return np.asarray(math.pi * _conductivity(k_s) / np.abs(wide))


def cluster(k_s: float, x: ArrayLike, y: ArrayLike, radius: ArrayLike) -> float:
    """Resistance 1/(2 k_s Σa) + Σ_{i≠j} a_i a_j/s_ij/(π k_s (Σa)²) of circles at ``x``, ``y`` of
    ``radius`` a (m, (n,) each), in K/W or Ω (Greenwood 1966).

    Currents are taken in proportion to the radii. It is no bound: -0.7 % for two circles that
    nearly touch, -0.1 % for five radii between centres, +0.3 % for seven in a hexagon at 2.5 radii.

    Raises
    ------
    InputError
        If circles overlap.
    """
    a = np.atleast_1d(_positive(radius, "radius of a spot (m)"))
    place = np.broadcast_to(np.asarray(x, dtype=float) + 1j * np.asarray(y, dtype=float), a.shape)
    apart = np.abs(place[:, None] - place[None, :])
    np.fill_diagonal(apart, np.inf)
    if np.any(apart < (a[:, None] + a[None, :]) * (1.0 - 1e-9)):
        raise InputError("spots of a cluster must not overlap, but two of them do. Join them to one spot.")
    total, k = float(a.sum()), _conductivity(k_s)
    return 1.0 / (2.0 * k * total) + float((a[:, None] * a[None, :] / apart).sum()) / (math.pi * k * total**2)


# A circle at the end of a tube: the share of other spots in the constriction.


def tube_factor(ratio: ArrayLike) -> RealArray:
    """ψ = (1 - ε)^1.5 for the ``ratio`` ε of the radius of a circle to that of its tube, 0 <= ε <=
    1: G = 2 k_s a/ψ (Cooper, Mikic & Yovanovich 1969)."""
    return np.asarray((1.0 - _ratio(ratio)) ** 1.5)


# Spots that are small against the mean free path, and hot ones.


def sharvin(k_s: float, radius: ArrayLike, mean_free_path: float) -> RealArray:
    """Resistance 4 ℓ/(3 π k_s a²) that ballistic carriers of the ``mean_free_path`` ℓ (m) add to a
    circle of ``radius`` a (m), K/W or Ω (Sharvin 1965)."""
    a = _positive(radius, "radius of a spot (m)")
    path = require.not_negative(mean_free_path, "mean free path (m)")
    return np.asarray(4.0 * path / (3.0 * math.pi * _conductivity(k_s) * a**2))


BALLISTIC = 9.0 * math.pi**2 / 128.0
"""Wexler's factor on the resistance of Maxwell far below the mean free path."""

_SLOPE = 0.5 / (1.0 - BALLISTIC)


def wexler(knudsen: ArrayLike) -> RealArray:
    """Γ(K) on the resistance of Holm and Maxwell between its limits 1 at K = ℓ/a = 0 and 9π²/128:
    R = R_S + Γ/(2 k_s a) (Wexler 1966).

    (1 + 0.694 c K)/(1 + c K) with c = 1.634, which has both limits, and the first slope -1/2 of
    the fit of Nikolić & Allen (1999), from which it differs by less than 0.03 below K = 1.
    """
    K = np.asarray(knudsen, dtype=float)
    return np.asarray((1.0 + BALLISTIC * _SLOPE * K) / (1.0 + _SLOPE * K))


def hottest(voltage: float, ambient: float = 293.15, lorenz: float = LORENZ) -> float:
    """Temperature in K of the hottest point of a spot that carries current at the ``voltage`` (V):
    T² = T_0² + V²/4L (Kohlrausch 1900), bodies at the ``ambient`` T_0 (K).

    For metals, whose heat and current take the same way; ``lorenz`` L in V²/K². Metals soften at
    about 0.1 V.

    Examples
    --------
    >>> round(hottest(0.1))
    434
    """
    V, T = require.not_negative(voltage, "voltage (V)"), require.positive(ambient, "temperature (K)")
    return math.sqrt(T**2 + V**2 / (4.0 * require.positive(lorenz, "Lorenz number (V²/K²)")))


def _conductivity(k_s: float) -> float:
    return require.positive(k_s, "harmonic mean of the conductivities")


def _positive(value: ArrayLike, what: str) -> RealArray:
    found = np.asarray(value, dtype=float)
    if not np.all(found > 0.0):
        raise InputError(f"{what} must be greater than zero, but is {found.min():g}.")
    return found


def _ratio(value: ArrayLike) -> RealArray:
    found = np.asarray(value, dtype=float)
    if not np.all((found >= 0.0) & (found <= 1.0)):
        raise InputError(f"ratio of the radii must be from zero to one, but is {found.ravel()[0]:g}.")
    return found


@dataclass(frozen=True, eq=False, repr=False)
class SpotAnswer(Tabled):
    """Spots of some radii, arrays of one shape: ``radius`` in m, ``conductance`` in S,
    ``resistance`` in Ω, of which ``ballistic`` is Sharvin's part."""

    radius: RealArray
    conductance: RealArray
    resistance: RealArray
    ballistic: RealArray


@dataclass(frozen=True)
class HolmSpot(Theory):
    """One circular spot between two bodies, with the mean free path ℓ of electrons:

        R = Γ(ℓ/a)/(2 k_s a) + 4 ℓ/(3 π k_s a²).

    Without one R = (ρ1 + ρ2)/4a. With thermal conductivities in place of electrical ones K/W for Ω.
    """

    conductivity: Annotated[
        float, Number("S/m", above=0.0), Help("k_s = 2/(ρ1 + ρ2) of both bodies, electrical", of="bodies")
    ]
    mean_free_path: Annotated[float, Number("length", least=0.0), "mean free path ℓ of electrons"] = 0.0
    name: ClassVar[str] = "holm-spot"
    title: ClassVar[str] = "Holm, Sharvin & Wexler, circular spot"
    citation_keys: ClassVar[tuple[str, ...]] = ("Holm1967", "Sharvin1965", "Wexler1966", "Nikolic1999")
    limits: ClassVar[tuple[Bound, ...]] = ()
    ways: ClassVar[tuple[Way, ...]] = (
        Way(
            CONTACT_RADIUS,
            "at_radius",
            (
                Quantity("radius", "m", "contact radius"),
                Quantity("conductance", "S", "conductance of the spot"),
                Quantity("resistance", "ohm", "resistance of the spot"),
                Quantity("ballistic", "ohm", "Sharvin's part of the resistance"),
            ),
        ),
    )

    def at_radius(self, contact_radius: ArrayLike) -> SpotAnswer:
        """Spots of the ``contact_radius`` in m, >= 0, of any shape; no conductance at zero."""
        a = checked(contact_radius, "contact radius (m)")
        safe = np.where(a > 0.0, a, 1.0)
        free = np.where(a > 0.0, sharvin(self.conductivity, safe, self.mean_free_path), math.inf)
        spread = wexler(self.mean_free_path / safe) / (2.0 * self.conductivity * safe)
        resistance = np.where(a > 0.0, spread + free, math.inf)
        return SpotAnswer(a, 1.0 / resistance, resistance, free)


@dataclass(frozen=True, eq=False)
class SpotCluster(Theory):
    """Circular spots of one joint side by side, whose currents are in proportion to their radii:

        R = 1/(2 k_s Σ a_i) + Σ_{i≠j} a_i a_j/s_ij/(π k_s (Σ a_i)²).

    InputError if spots overlap, or their places and radii differ in number.
    """

    conductivity: Annotated[
        float, Number("S/m", above=0.0), Help("k_s = 2/(ρ1 + ρ2) of both bodies, electrical", of="bodies")
    ]
    x: Annotated[ArrayLike, Several(Number("length")), "x of the centres"] = field(repr=False)
    y: Annotated[ArrayLike, Several(Number("length")), "y of the centres"] = field(repr=False)
    radius: Annotated[ArrayLike, Several(Number("length", above=0.0)), "radii of the spots"] = field(repr=False)
    name: ClassVar[str] = "spot-cluster"
    title: ClassVar[str] = "Greenwood, cluster of spots"
    citation_keys: ClassVar[tuple[str, ...]] = ("GreenwoodSpots1966", "Holm1967")
    limits: ClassVar[tuple[Bound, ...]] = ()
    ways: ClassVar[tuple[Way, ...]] = ()
    numbers: ClassVar[tuple[Quantity, ...]] = (
        Quantity("resistance", "ohm", "resistance of the cluster"),
        Quantity("conductance", "S", "conductance of the cluster"),
        Quantity("alone", "S", "conductance of the same spots far apart"),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        sizes = {np.size(part) for part in (self.x, self.y, self.radius)}
        if len(sizes) > 1:
            raise InputError(
                f"places and radii of spots must be as many, but are {', '.join(map(str, sorted(sizes)))}."
            )

    @property
    def resistance(self) -> float:
        """R in Ω."""
        return cluster(self.conductivity, self.x, self.y, self.radius)

    @property
    def conductance(self) -> float:
        """1/R in S."""
        return 1.0 / self.resistance

    @property
    def alone(self) -> float:
        """2 k_s Σ a in S."""
        return float(circle(self.conductivity, self.radius).sum())
