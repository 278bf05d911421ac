"""Menisci of Greenwood-Williamson summits in a liquid film (Gao, Tian & Bhushan 1995; Bhushan 1998, eq. 56-58)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import NoSolutionError
from .greenwood_williamson import HIGHEST, LOWEST, GreenwoodWilliamson
from .meniscus import film_force
from .protocol import Prediction, curve

Pull: TypeAlias = Callable[[RealArray], RealArray]
"""Meniscus force per nominal area in Pa at separations in m, (1, m) for all loads or (n, 1), one for each."""

_STEPS = 100  # ten are the rule
_CLOSE = 1e-14  # standard deviations; the error is less than the last step
_STEP = 0.1  # of the search for the first balance, in standard deviations; all curves change over about one
_NEAR = 12.0  # beyond, on the dense side every summit is in the film, and on the other there is hardly one left
_FAR_STEP = 1.0


@dataclass(frozen=True, eq=False)
class WetPrediction:
    """Balance of load, menisci and summits along a curve; arrays (n,).

    ``pressure`` external load per nominal area in Pa, ``meniscus_pressure`` meniscus force per nominal area in Pa,
    ``contact`` what the summits do under the sum of both.
    """

    pressure: RealArray
    meniscus_pressure: RealArray
    contact: Prediction

    def static_friction(self, coefficient: float) -> RealArray:
        """μ_s = μ_r (1 + F_m/W) for the dry ``coefficient`` μ_r, without viscous part (Bhushan 1998, eq. 59)."""
        mu = require.not_negative(coefficient, "friction coefficient")
        return np.asarray(mu * (1.0 + self.meniscus_pressure / self.pressure))


@dataclass(frozen=True)
class StatisticalMeniscus:
    """A smooth surface with a film of liquid against rough summits of ``contact``.

    Every summit that reaches the film, touching the solid or not, is pulled by the full force of a sphere that touches
    it, 2πRγ(1 + cos θ): true for menisci much higher than the film. Below about one molecular layer there is none.

    Parameters
    ----------
    contact
        Summits and contact modulus; any distribution of heights.
    surface_tension
        γ of the liquid in N/m, > 0.
    film_thickness
        h in m, > 0.
    contact_angle
        θ in rad on the summits.
    molecular_layer
        Thickness in m below which a film is no liquid.

    Raises
    ------
    InputError
        If a number is out of its range, or the liquid does not wet.
    """

    contact: GreenwoodWilliamson
    surface_tension: float
    film_thickness: float
    contact_angle: float = 0.0
    molecular_layer: float = 0.0
    citation_keys: ClassVar[tuple[str, ...]] = ("McFarlane1950", "Bhushan1998", "Gao1995", "Greenwood1966")

    def __post_init__(self) -> None:
        require.positive(self.film_thickness, "film thickness (m)")
        require.not_negative(self.molecular_layer, "molecular layer (m)")
        film_force(self.contact.radius, self.surface_tension, self.contact_angle)

    @property
    def largest(self) -> float:
        """Meniscus force per nominal area in Pa when every summit reaches the film; zero for less than a layer."""
        if self.film_thickness < self.molecular_layer:
            return 0.0
        return self.contact.density * film_force(self.contact.radius, self.surface_tension, self.contact_angle)

    def meniscus_pressure(self, separation: ArrayLike) -> RealArray:
        """Meniscus force per nominal area in Pa at separations (n,) in m from the mean plane of the surface."""
        return self._pull(curve(separation, "separations (m)"))

    def _pull(self, separation: RealArray) -> RealArray:
        reached = self.contact.standardised(separation - self.film_thickness)
        return np.asarray(self.largest * self.contact.heights.tail_moment(reached, 0.0))

    def at_pressure(self, pressure: ArrayLike) -> WetPrediction:
        """Balance under external pressures (n,) in Pa, > 0."""
        return balance(self.contact, self._pull, curve(pressure, "pressures (Pa)", positive=True))

    def feedback(self, separation: ArrayLike) -> RealArray:
        """dF_m/dL at separations (n,) in m: the load settles by repeated solution only where this is below one."""
        h = curve(separation, "separations (m)")
        reached = self.contact.standardised(h - self.film_thickness)
        slope = self.largest * self.contact.heights.density(reached) / self.contact.height_deviation
        return np.asarray(slope / self.contact.at_separation(h).stiffness)

    @property
    def pull_off(self) -> float:
        """Largest tension per nominal area in Pa that the menisci hold against the summits, >= 0."""
        h = _separations(self.contact)
        rest = self.contact.borne(h) - self.meniscus_pressure(h)
        lowest = int(np.argmin(rest))
        if lowest in (0, h.size - 1):
            return 0.0
        from scipy.optimize import minimize_scalar

        def net(separation: float) -> float:
            at = np.array([separation])
            return float((self.contact.borne(at) - self.meniscus_pressure(at))[0])

        found = minimize_scalar(net, bounds=(h[lowest - 1], h[lowest + 1]), method="bounded", options={"xatol": 0.0})
        return max(0.0, -float(found.fun))


def balance(contact: GreenwoodWilliamson, pull: Pull, pressure: RealArray) -> WetPrediction:
    """State in which the summits carry ``pressure`` (n,) in Pa and the ``pull`` of the menisci, the densest of several.

    Raises
    ------
    NoSolutionError
        If the summits do not carry load and menisci at any separation.
    """
    h, loads = _separations(contact), pressure[:, None]

    def rest(separation: RealArray) -> RealArray:
        return np.asarray(contact.borne(separation) - pull(separation))

    table = rest(h[None, :])
    short = table < loads
    first = np.argmax(short, axis=1)
    unborne = (first == 0) | ~short.any(axis=1)
    if unborne.any():
        densest = float(np.broadcast_to(table, short.shape)[unborne, 0][0])
        raise NoSolutionError(
            f"load (Pa) with its menisci must be within what the summits carry, at most {densest:.4g} Pa at "
            f"{-LOWEST:g} standard deviations below their mean, but is {pressure[unborne][0]:g}."
        )
    ends = h[first - 1][:, None], h[first][:, None]
    separations = _crossing(lambda separation: rest(separation) - loads, *ends, _CLOSE * contact.height_deviation)
    return WetPrediction(pressure, pull(separations)[:, 0], contact.at_separation(separations[:, 0]))


def _crossing(function: Pull, low: RealArray, high: RealArray, close: float) -> RealArray:
    """Where ``function`` falls through zero between ``low`` and ``high``, to a step of ``close``: false position (Illinois)."""
    at_low, at_high = function(low), function(high)
    for _ in range(_STEPS):
        fall = at_high - at_low
        x = high - np.divide(at_high * (high - low), fall, out=np.zeros_like(high), where=fall != 0.0)
        step, value = np.abs(x - high), function(x)
        passed = value * at_high < 0.0
        low, at_low = np.where(passed, high, low), np.where(passed, at_high, 0.5 * at_low)
        high, at_high = x, value
        if np.all((step <= close) | (value == 0.0)):
            break
    return high


def _separations(contact: GreenwoodWilliamson) -> RealArray:
    """Separations in m from the densest on, between which no balance is overlooked."""
    end = min(HIGHEST, contact.heights.support[1])
    dense = np.arange(LOWEST, -_NEAR, _FAR_STEP)
    near = np.arange(-_NEAR, min(end, _NEAR) + _STEP, _STEP)
    D = np.concatenate([dense, near, np.arange(_NEAR + _FAR_STEP, end + _FAR_STEP, _FAR_STEP)]) - contact.heights.mean
    heights: RealArray = contact.mean_height + contact.height_deviation * D
    return heights
