"""The protocol of all theories: parameters, evaluation, results and limits of validity.

A theory is a frozen value made from its parameters, or from a ``Roughness`` by ``from_roughness``. Arrays in, arrays out;
what a theory does not define is NaN.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Protocol, Self, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import BoolArray, RealArray
from ..core.errors import InputError
from ..core.parameters import Help
from ..core.values import Choice, Length, Number, SignedLength
from .statistics.heights import NAMED_HEIGHTS, SummitHeights
from .statistics.roughness import Roughness

Modulus: TypeAlias = Annotated[
    float,
    Number("pressure", above=0.0),
    Help("contact modulus E*, 1/E* = (1 - ν1²)/E1 + (1 - ν2²)/E2", of="bodies"),
]
"""The parameter that all elastic theories share."""

SummitDensity: TypeAlias = Annotated[float, Number("density", above=0.0), "summits per area η"]
SummitRadius: TypeAlias = Annotated[Length, "radius R of the summits"]
HeightDeviation: TypeAlias = Annotated[Length, "standard deviation σ_s of the summit heights"]
MeanHeight: TypeAlias = Annotated[SignedLength, "mean z̄_s of the summit heights above the mean plane of the surface"]
HeightsLaw: TypeAlias = Annotated[
    SummitHeights, Choice(dict(NAMED_HEIGHTS), others=True), "distribution of the standardised summit heights"
]
PoissonOfSolid: TypeAlias = Annotated[float, Number(least=0.0, most=0.5)]


@dataclass(frozen=True, eq=False)
class Prediction:
    """What a theory predicts along a curve; every field (n,), NaN where the theory does not define it.

    Parameters
    ----------
    pressure
        Nominal pressure p in Pa: load per nominal area.
    area_fraction
        Real area of contact per nominal area.
    contact_density
        Contacts per nominal area in 1/m².
    mean_real_pressure
        Load per real area in Pa.
    separation
        Distance in m of the rigid plane from the mean plane of the undeformed surface.
    mean_gap
        Mean distance in m of the deformed surfaces over the nominal area.
    stiffness
        -dp/d(separation) in Pa/m, for theories with a gap only -dp/d(mean gap).
    """

    pressure: RealArray
    area_fraction: RealArray
    contact_density: RealArray
    mean_real_pressure: RealArray
    separation: RealArray
    mean_gap: RealArray
    stiffness: RealArray

    def __len__(self) -> int:
        """Number of points of the curve."""
        return int(self.pressure.size)


QUANTITIES: tuple[tuple[str, str, str], ...] = (
    ("pressure", "Pa", "nominal pressure"),
    ("area_fraction", "", "real area per nominal area"),
    ("contact_density", "1/m^2", "contacts per nominal area"),
    ("mean_real_pressure", "Pa", "load per real area"),
    ("separation", "m", "plane to mean plane of the undeformed surface"),
    ("mean_gap", "m", "mean distance of the deformed surfaces"),
    ("stiffness", "Pa/m", "pressure per approach"),
)
"""Name, SI unit and meaning of each field of ``Prediction``."""


@dataclass(frozen=True, eq=False)
class Limit:
    """One condition for the validity of a theory, checked along a curve.

    Parameters
    ----------
    criterion
        What is compared, a few words, for example "area fraction".
    value
        (n,) its values.
    low, high
        Bounds between which the theory is meant to hold, -inf or inf where there is none.
    citation
        Key of the paper that states or supports the bound, see ``core.citations``.
    message
        What happens beyond the bounds, one sentence.
    """

    criterion: str
    value: RealArray
    low: float
    high: float
    citation: str
    message: str

    @property
    def holds(self) -> BoolArray:
        """(n,) whether the value lies between the bounds; an undefined value (NaN) does not."""
        inside: BoolArray = (self.value >= self.low) & (self.value <= self.high)
        return inside


class Described(Protocol):
    """Anything in the catalogue: what it is called, rests on, and is made from.

    ``name`` as on the command line, lower case with hyphens; ``title`` for headings. What it is made from,
    its constructor declares, see ``core.parameters``.
    """

    name: ClassVar[str]
    title: ClassVar[str]
    citation_keys: ClassVar[tuple[str, ...]]


class SurfaceTheory(Described, Protocol):
    """A theory of the contact of a rough surface with a rigid plane, or of what is equivalent to it."""

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float, *args: Any, **kwargs: Any) -> Self:
        """Theory for the measured ``roughness`` and the contact modulus ``E_star`` in Pa.

        Further keyword arguments are the parameters that belong to the bodies or are a choice.

        Raises
        ------
        InputError
            If the roughness does not hold what the theory needs.
        """
        ...

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa, positive.

        Raises
        ------
        InputError
            If a pressure is not positive, or beyond what the theory can carry.
        """
        ...

    def validity(self, prediction: Prediction) -> tuple[Limit, ...]:
        """Conditions for this theory to hold, checked along its own ``prediction``."""
        ...


class SeparationTheory(SurfaceTheory, Protocol):
    """A theory that predicts the load at a given separation."""

    def at_separation(self, separation: ArrayLike) -> Prediction:
        """Prediction at separations (n,) in m of the plane from the mean plane of the undeformed surface."""
        ...


def curve(values: ArrayLike, what: str, *, positive: bool = False) -> RealArray:
    """Return ``values`` as a one-dimensional array of finite, if asked for positive, floats.

    Raises
    ------
    InputError
        If they are not.
    """
    array = np.atleast_1d(_numbers(values, what))
    if array.ndim != 1 or array.size == 0:
        raise InputError(f"{what} must be a number or a one-dimensional array, but have shape {array.shape}.")
    if not np.all(np.isfinite(array)):
        raise InputError(f"{what} must be finite, but hold NaN or infinity.")
    if positive and not np.all(array > 0.0):
        raise InputError(f"{what} must be greater than zero, but the smallest is {float(array.min()):g}.")
    return array


def prediction(pressure: RealArray, **known: RealArray) -> Prediction:
    """Prediction with the ``known`` fields, each (n,) or one number for all; the mean real pressure follows from the
    area.
    """
    undefined = np.full_like(pressure, np.nan)
    fields = {name: undefined for name, _, _ in QUANTITIES} | {"pressure": pressure}
    if "area_fraction" in known and "mean_real_pressure" not in known:
        area = np.broadcast_to(known["area_fraction"], pressure.shape)
        known["mean_real_pressure"] = np.divide(pressure, area, out=np.full_like(pressure, np.nan), where=area > 0.0)
    fields |= {name: np.broadcast_to(values, pressure.shape) for name, values in known.items()}
    return Prediction(**fields)


# Theories of one contact.


@dataclass(frozen=True, eq=False)
class ContactAnswer:
    """One contact at given loads: arrays of one shape; NaN where the theory gives no value.

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
"""Slope in the contact at which a sphere needs 3 % more approach than its paraboloid (Sneddon 1965): a third of its
square.
"""


def small_slope(criterion: str, slope: RealArray) -> Limit:
    """Half-spaces and parabolic profiles are approximations for small slopes in the contact."""
    message = "The theory of the half-space, and a paraboloid in place of a sphere, neglect the square of the slopes."
    return Limit(criterion, np.atleast_1d(slope).ravel(), 0.0, SMALL_SLOPE, "Sneddon1965", message)


def _numbers(values: ArrayLike, what: str) -> RealArray:
    """``values`` as an array of floats of any shape."""
    try:
        array: RealArray = np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise InputError(f"{what} must be numbers in SI units, such as 1e6, but are {values!r}.") from None
    return array


def checked(values: ArrayLike, what: str, lowest: float = 0.0, fix: str = "") -> RealArray:
    """``values`` as an array of finite numbers of at least ``lowest``.

    Raises
    ------
    InputError
        If one is not.
    """
    array = _numbers(values, what)
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
