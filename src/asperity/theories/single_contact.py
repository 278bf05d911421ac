"""What theories of one contact have in common: answers at a load, and conditions under which they hold."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from .protocol import Described, Limit


@dataclass(frozen=True, eq=False)
class ContactAnswer:
    """One contact at given loads: arrays of one shape; NaN where the theory says nothing.

    Parameters
    ----------
    load
        Force in N; in plane strain force per length in N/m.
    approach
        Displacement of distant points toward each other since first touch in m.
    radius
        Contact radius in m; half-width in plane strain, geometric mean of the semi-axes of an ellipse.
    area
        Contact area in m²; width of the contact in m in plane strain.
    max_pressure
        Largest pressure in Pa, infinite at the edge of a punch and the apex of a cone.
    stiffness
        Derivative of the load by the approach in N/m (N/m² in plane strain).
    """

    load: RealArray
    approach: RealArray
    radius: RealArray
    area: RealArray
    max_pressure: RealArray
    stiffness: RealArray

    @property
    def mean_pressure(self) -> RealArray:
        """Load over area in Pa; NaN without contact."""
        return np.divide(self.load, self.area, out=np.full_like(self.load, np.nan), where=self.area > 0.0)


class SingleContact(Described, Protocol):
    """A theory of one contact. Concrete theories are frozen; loads are arrays of any shape."""

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N (N/m in plane strain)."""
        ...

    def validity(self, answer: ContactAnswer) -> tuple[Limit, ...]:
        """Conditions for this theory to hold, checked along its own ``answer``."""
        ...


SMALL_SLOPE = 0.3
"""Slope in the contact at which a sphere needs 3 % more approach than its paraboloid (Sneddon 1965): a third of its square."""


def small_slope(criterion: str, slope: RealArray) -> Limit:
    """Half-spaces and parabolic profiles are approximations for small slopes in the contact."""
    message = "The theory of the half-space, and a paraboloid in place of a sphere, neglect the square of the slopes."
    return Limit(criterion, np.atleast_1d(slope).ravel(), 0.0, SMALL_SLOPE, "Sneddon1965", message)


def checked(values: ArrayLike, what: str, lowest: float = 0.0, fix: str = "") -> RealArray:
    """``values`` as an array of finite numbers of at least ``lowest``.

    Raises
    ------
    InputError
        If one is not.
    """
    array: RealArray = np.asarray(values, dtype=float)
    if not np.all(np.isfinite(array) & (array >= lowest)):
        wrong = float(array[~(np.isfinite(array) & (array >= lowest))].flat[0])
        raise InputError(
            f"{what} must be finite and at least {lowest:.6g}, but is {wrong:.6g}." + (f" {fix}" if fix else "")
        )
    return array


def poissons_ratio(nu: float) -> float:
    """``nu`` if it is from 0 to 0.5, both included.

    Raises
    ------
    InputError
        If it is not.
    """
    value = require.finite(nu, "Poisson's ratio")
    if not 0.0 <= value <= 0.5:
        raise InputError(f"Poisson's ratio must be from 0 to 0.5, but is {value:g}.")
    return value


def bisected(
    function: Callable[[RealArray], RealArray], low: RealArray, high: RealArray, halvings: int = 64
) -> RealArray:
    """Roots of an elementwise rising ``function`` between ``low`` and ``high``, by default to the last digits.

    A jump across zero counts as a root.
    """
    low, high = (np.array(end, dtype=float) for end in np.broadcast_arrays(low, high))
    for _ in range(halvings):  # 64 are more than a double has digits
        middle = 0.5 * (low + high)
        above = function(middle) > 0.0
        high, low = np.where(above, middle, high), np.where(above, low, middle)
    return np.asarray(0.5 * (low + high))
