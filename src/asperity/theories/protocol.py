"""What all theories share: parameters, evaluation, results, and limits of validity.

A theory is a frozen value made from its parameters, or from a ``Roughness`` by ``from_roughness``.
Arrays in, arrays out; what a theory does not define is NaN.
"""

from __future__ import annotations

import math
import numbers as kinds
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Annotated, Any, ClassVar, Protocol, Self, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import BoolArray, RealArray
from ..core.errors import InputError
from ..core.late import Tabled
from ..core.parameters import Declared, Help, Parameter, parameters
from ..core.quantity import Quantity
from ..core.values import Choice, Length, Number, Positive, Real, SignedLength
from .statistics.heights import NAMED_HEIGHTS, SummitHeights, WeibullHeights
from .statistics.roughness import Roughness

Modulus: TypeAlias = Annotated[
    float,
    Number("pressure", above=0.0),
    Help("contact modulus E*, 1/E* = (1 - ν1²)/E1 + (1 - ν2²)/E2", of="bodies"),
]
"""The parameter that all elastic theories share."""

Radius: TypeAlias = Annotated[Length, "relative radius of curvature R"]
Work: TypeAlias = Annotated[float, Number("J/m^2", above=0.0), "work of adhesion w"]
MeanSquareHeight: TypeAlias = Annotated[float, Number("area", above=0.0), "mean square height"]
MeanSquareSlope: TypeAlias = Annotated[Positive, "mean square slope of a profile"]
MeanSquareBend: TypeAlias = Annotated[float, Number("1/m^2", above=0.0), "mean square second derivative of a profile"]
SummitDensity: TypeAlias = Annotated[float, Number("density", above=0.0), "summits per area η"]
SummitRadius: TypeAlias = Annotated[Length, "radius R of the summits"]
HeightDeviation: TypeAlias = Annotated[Length, "standard deviation σ_s of the summit heights"]
MeanHeight: TypeAlias = Annotated[SignedLength, "mean z̄_s of the summit heights above the mean plane of the surface"]
SummitSkewness: TypeAlias = Annotated[Real, "skewness of the summit heights"]
SummitKurtosis: TypeAlias = Annotated[Positive, "kurtosis of the summit heights, 3 for Gaussian ones"]


class _NamedHeights(Choice):
    """The words of ``NAMED_HEIGHTS``, and ``weibull:K`` for the shape K of Weibull's
    distribution."""

    @property
    def rule(self) -> str:
        """What a value must be, in words."""
        return f"{super().rule}, or weibull:K with a shape K such as weibull:2"

    def read(self, value: Any, what: str) -> Any:
        """What a word stands for."""
        if isinstance(value, str) and value.strip().lower().startswith("weibull:"):
            try:
                shape = float(value.partition(":")[2])
            except ValueError:
                raise InputError(f"{what} must be {self.rule}, but is {value!r}.") from None
            return WeibullHeights(shape)
        return super().read(value, what)


HeightsLaw: TypeAlias = Annotated[
    SummitHeights,
    _NamedHeights(dict(NAMED_HEIGHTS), others=True),
    "distribution of the standardised summit heights: one of the words, or weibull:K with a shape K",
]
PoissonOfSolid: TypeAlias = Annotated[float, Number(least=0.0, most=0.5)]

QUANTITIES = (
    Quantity("pressure", "Pa", "nominal pressure"),
    Quantity("area_fraction", "1", "real area per nominal area"),
    Quantity("contact_density", "1/m^2", "contacts per nominal area"),
    Quantity("mean_real_pressure", "Pa", "load per real area"),
    Quantity("separation", "m", "plane to mean plane of the undeformed surface"),
    Quantity("mean_gap", "m", "mean distance of the deformed surfaces"),
    Quantity("stiffness", "Pa/m", "pressure per approach"),
)
"""The fields of ``Prediction``."""


@dataclass(frozen=True, eq=False, repr=False)
class Prediction(Tabled):
    """What a theory predicts along a curve: the ``QUANTITIES``, each (n,) in SI, NaN where the
    theory does not define it.

    ``stiffness`` is -dp/d(separation), for theories with a gap only -dp/d(mean gap).
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


def prediction(pressure: RealArray, **known: RealArray) -> Prediction:
    """Prediction with the ``known`` fields, each (n,) or one number; the mean real pressure follows
    from the area."""
    undefined = np.full_like(pressure, np.nan)
    fields = {quantity.name: undefined for quantity in QUANTITIES} | {"pressure": pressure}
    if "area_fraction" in known and "mean_real_pressure" not in known:
        area = np.broadcast_to(known["area_fraction"], pressure.shape)
        known["mean_real_pressure"] = np.divide(pressure, area, out=np.full_like(pressure, np.nan), where=area > 0.0)
    fields |= {name: np.broadcast_to(values, pressure.shape) for name, values in known.items()}
    return Prediction(**fields)


@dataclass(frozen=True, eq=False, repr=False)
class ContactAnswer(Tabled):
    """One contact at given loads: arrays of one shape; NaN where the theory gives no value.

    Parameters
    ----------
    load
        Force in N; in plane strain force per length in N/m.
    approach
        Displacement of distant points toward each other since first touch in m.
    radius
        Contact radius in m; half-width in plane strain, geometric mean of the semi-axes of an
        ellipse.
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


# Limits of validity: declared by a theory as ``Bound``, checked along an answer as ``Limit``.


def _bounds(low: float, high: float, of: tuple[str, ...]) -> str:
    only = f" for {' and '.join(name.replace('_', ' ') for name in of)} only" if of else ""
    if math.isinf(high):
        return f"at least {low:.4g}{only}"
    return f"{f'from {low:.4g} to' if math.isfinite(low) and low != 0.0 else 'at most'} {high:.4g}{only}"


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
    of
        Names of the answered quantities that the condition concerns; all of them if empty.
    """

    criterion: str
    value: RealArray
    low: float
    high: float
    citation: str
    message: str
    of: tuple[str, ...] = ()

    @property
    def holds(self) -> BoolArray:
        """(n,) whether the value lies between the bounds; an undefined value (NaN) does not."""
        return (self.value >= self.low) & (self.value <= self.high)

    @property
    def bounds(self) -> str:
        """Bounds in words, with the quantities if it does not concern all."""
        return _bounds(self.low, self.high, self.of)

    def concerns(self, quantity: str) -> bool:
        """Whether the condition concerns the answered ``quantity``."""
        return not self.of or quantity in self.of


@dataclass(frozen=True)
class Bound:
    """A limit of validity as a class declares it, in ``limits``; fields as of ``Limit``.

    ``value`` gives one number or (n,) values from a theory and its answer, or None where the limit
    does not apply; that of a bound on what was ``measured`` takes the theory and the ``Roughness``
    of the surface.
    """

    criterion: str
    value: Callable[[Any, Any], Any]
    low: float
    high: float
    citation: str
    message: str
    of: tuple[str, ...] = ()
    measured: bool = False

    @property
    def rule(self) -> str:
        """Criterion and bounds in words."""
        measured = " as measured on the surface" if self.measured else ""
        return f"{self.criterion}{measured} {_bounds(self.low, self.high, self.of)}"

    def along(self, theory: Any, answer: Any, roughness: Roughness | None = None) -> tuple[Limit, ...]:
        """The limit checked along the ``answer`` of ``theory``; none where it does not apply, or
        nothing was measured."""
        source = roughness if self.measured else answer
        value = None if source is None else self.value(theory, source)
        if value is None:
            return ()
        points = np.size(getattr(answer, "pressure", getattr(answer, "load", value)))
        values = np.ravel(value) if np.size(value) == points else np.full(points, value)
        return (Limit(self.criterion, values, self.low, self.high, self.citation, self.message, self.of),)


FEW_CONTACTS = Bound(
    "area fraction",
    lambda theory, answer: answer.area_fraction,
    -math.inf,
    0.1,  # a few per cent are safe, narrow spectra bear 0.2
    "Greenwood1966",
    "Contacts deform each other and merge; the theory lets them stand alone.",
)
BLUNT_SUMMITS = Bound(
    "height deviation over radius of summits",
    lambda theory, answer: theory.roughness_ratio,
    0.0,
    0.1,
    "Greenwood1966",
    "Contacts become as large as their radius of curvature; Hertz's parabola no longer describes the summits.",
)
GENTLE_SLOPES = Bound(
    "rms gradient",
    lambda theory, answer: theory.rms_gradient,
    0.0,
    0.3,  # the half-space then errs by about its square, a tenth
    "Johnson1985",
    "The theory of the half-space neglects the square of the slopes.",
)
MEASURED_SLOPES = replace(GENTLE_SLOPES, value=lambda theory, roughness: roughness.rms_gradient, measured=True)
ISOTROPY = Bound(
    "ratio of the principal mean square slopes",
    lambda theory, roughness: roughness.anisotropy,
    1.0,
    2.0,  # mean moments put the area of high summits off by 1.3 % at 2, 6 % at 5, 11 % at 10
    "Bush1979",
    "The surface is anisotropic, and the theory uses the mean over all directions only.",
    measured=True,
)


def small_slope(criterion: str, value: Callable[[Any, Any], Any]) -> Bound:
    """Half-spaces and parabolic profiles are approximations for small slopes in the contact.

    At a slope of 0.3 a sphere needs 3 % more approach than its paraboloid, a third of the square
    (Sneddon 1965).
    """
    message = "The theory of the half-space, and a paraboloid in place of a sphere, neglect the square of the slopes."
    return Bound(criterion, value, 0.0, 0.3, "Sneddon1965", message)


CONTACT_RADIUS = small_slope(
    "contact radius over radius of curvature", lambda theory, answer: answer.radius / theory.radius
)


class _Inputs:
    """Gives a theory, or its class, its declared parameters."""

    def __get__(self, theory: object, kind: type) -> tuple[Parameter, ...]:
        return parameters(kind)


class Theory(Declared):
    """Base of the theories of the catalogue: frozen dataclasses whose parameters are checked when
    they are made.

    ``name`` as on the command line, lower case with hyphens; ``title`` for headings; ``inputs`` are
    its parameters, each with unit, range, default and help; ``numbers`` depend on them alone;
    ``limits`` are the conditions for it to hold. What else it answers, see ``ask.ways_of``.
    """

    inputs = _Inputs()

    name: ClassVar[str]
    title: ClassVar[str]
    citation_keys: ClassVar[tuple[str, ...]]
    numbers: ClassVar[tuple[Quantity, ...]] = ()
    limits: ClassVar[tuple[Bound, ...]] = ()

    def validity(self, answer: Any, roughness: Roughness | None = None) -> tuple[Limit, ...]:
        """The ``limits`` checked along the theory's own ``answer``; with ``roughness`` also those
        on what was measured."""
        return tuple(limit for bound in self.limits for limit in bound.along(self, answer, roughness))


class Described(Protocol):
    """Anything in the catalogue, see ``Theory``."""

    name: ClassVar[str]
    title: ClassVar[str]
    citation_keys: ClassVar[tuple[str, ...]]
    numbers: ClassVar[tuple[Quantity, ...]]
    limits: ClassVar[tuple[Bound, ...]]

    def validity(self, answer: Any, roughness: Roughness | None = None) -> tuple[Limit, ...]:
        """The ``limits`` checked along its own ``answer``."""
        ...


class SurfaceTheory(Protocol):
    """A theory of the contact of a rough surface with a rigid plane, or of what is equivalent to
    it."""

    name: ClassVar[str]
    title: ClassVar[str]
    citation_keys: ClassVar[tuple[str, ...]]

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float, *args: Any, **kwargs: Any) -> Self:
        """Theory for the measured ``roughness`` and the contact modulus ``E_star`` in Pa.

        Further keyword arguments are the parameters that belong to the bodies or are a choice.
        InputError if the roughness does not hold what the theory needs.
        """
        ...

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa; InputError if one is not positive or more
        than the theory can carry."""
        ...

    def validity(self, prediction: Prediction, /) -> tuple[Limit, ...]:
        """Conditions for this theory to hold, checked along its own ``prediction``."""
        ...


class SeparationTheory(Theory):
    """A theory of pressure and contacts at a separation, ``_law`` and ``_contacts``; a pressure it
    seeks within ``_ends``."""

    def at_separation(self, separation: ArrayLike) -> Prediction:
        """Prediction at separations (n,) in m of the plane from the mean plane of the undeformed
        surface."""
        h = curve(separation, "separations (m)")
        (pressure, stiffness), (area, contacts) = self._law(h), self._contacts(h)
        return prediction(pressure, area_fraction=area, contact_density=contacts, separation=h, stiffness=stiffness)

    def at_pressure(self, pressure: ArrayLike) -> Prediction:
        """Prediction at nominal pressures (n,) in Pa; InputError if one is not positive, or beyond
        the range evaluated."""
        return self.at_separation(
            separation_at(curve(pressure, "pressures (Pa)", positive=True), self._law, *self._ends)
        )

    def _law(self, h: RealArray) -> tuple[RealArray, RealArray]:
        """Pressure in Pa and stiffness -dp/dh at the separations ``h`` in m, all (n,)."""
        raise NotImplementedError

    def _contacts(self, h: RealArray) -> tuple[RealArray, RealArray]:
        """Area fraction, and contacts per nominal area in 1/m², at the separations ``h`` in m, all
        (n,)."""
        raise NotImplementedError

    @property
    def _ends(self) -> tuple[float, float, float]:
        """Lowest and highest separation evaluated, and the length on which the pressure changes, in
        m."""
        raise NotImplementedError


# Checks of numbers.


def real_numbers(values: ArrayLike, what: str) -> RealArray:
    """``values`` as an array of floats of any shape; InputError for text, truth values, complex
    numbers and the like."""
    try:
        array = np.asarray(values)
        real = array.dtype.kind in "iuf" or (
            array.dtype.kind == "O"
            and all(isinstance(item, kinds.Real) and not isinstance(item, bool) for item in array.flat)
        )
    except (TypeError, ValueError):  # rows of different lengths
        real = False
    if not real:
        raise InputError(f"{what} must be numbers in SI units, such as 1e6, but are {values!r}.")
    return array.astype(float, copy=False)


def curve(values: ArrayLike, what: str, *, positive: bool = False) -> RealArray:
    """``values`` as a one-dimensional array of finite, if asked for positive, floats; else
    InputError."""
    array = np.atleast_1d(real_numbers(values, what))
    if array.ndim != 1 or array.size == 0:
        raise InputError(f"{what} must be a number or a one-dimensional array, but have shape {array.shape}.")
    if not np.all(np.isfinite(array)):
        raise InputError(f"{what} must be finite, but hold NaN or infinity.")
    if positive and not np.all(array > 0.0):
        raise InputError(f"{what} must be greater than zero, but the smallest is {float(array.min()):g}.")
    return array


def highest_first(theory: object, of: str, positive: Mapping[str, str]) -> None:
    """Put the arrays of a ``theory`` of single summits or crests into the order of falling height:
    ``x``, ``y``, ``height`` and those ``positive``, fields with their words; ``of`` what they are.

    InputError if one is no ``curve``, or their lengths differ.
    """
    columns = {name: curve(getattr(theory, name), f"{name} of {of} (m)") for name in ("x", "y", "height")}
    for name, word in positive.items():
        columns[name] = curve(getattr(theory, name), f"{word} of {of} (m)", positive=True)
    if len({column.size for column in columns.values()}) != 1:
        sizes = ", ".join(f"{name} {column.size}" for name, column in columns.items())
        raise InputError(f"arrays of {of} must have the same length, but have {sizes}.")
    order = np.argsort(-columns["height"], kind="stable")
    for name, column in columns.items():
        object.__setattr__(theory, name, column[order])


def checked(values: ArrayLike, what: str, lowest: float = 0.0, fix: str = "") -> RealArray:
    """``values`` as an array of finite numbers of at least ``lowest``, of any shape; else
    InputError."""
    array = real_numbers(values, what)
    wrong = array[~(np.isfinite(array) & (array >= lowest))]
    if wrong.size:
        raise InputError(
            f"{what} must be finite and at least {lowest:.6g}, but is {wrong.flat[0]:.6g}." + (f" {fix}" if fix else "")
        )
    return array


def poissons_ratio(nu: float) -> float:
    """``nu`` if it is from 0 to 0.5, both included; else InputError."""
    value = require.finite(nu, "Poisson's ratio")
    if not 0.0 <= value <= 0.5:
        raise InputError(f"Poisson's ratio must be from 0 to 0.5, but is {value:g}.")
    return value


# Inversion of elementwise functions.


def bisected(
    function: Callable[[RealArray], RealArray], low: RealArray, high: RealArray, halvings: int = 64
) -> RealArray:
    """Roots of an elementwise rising ``function`` between ``low`` and ``high``, by default to the
    last digits.

    A jump across zero counts as a root.
    """
    low, high = (np.array(end, dtype=float) for end in np.broadcast_arrays(low, high))
    for _ in range(halvings):  # 64 are more than a double has digits
        middle = 0.5 * (low + high)
        above = function(middle) > 0.0
        high, low = np.where(above, middle, high), np.where(above, low, middle)
    return np.asarray(0.5 * (low + high))


_TABLE = 65  # separations at which the pressure is tabulated for a start
_STEPS = 60  # bisections alone would find a double in these
_SQUARED = 1e-8  # a Newton step so small leaves its square, which is rounding
_ROUNDING = 4e-15
_NO_PRESSURE = 1e-12  # Pa, below which messages say that there is none


def separation_at(
    pressure: RealArray, law: Callable[[RealArray], tuple[RealArray, RealArray]], low: float, high: float, unit: float
) -> RealArray:
    """Separations (n,) in m at which a falling ``law``, pressure and -dp/dh, has the ``pressure``
    (n,) in Pa.

    Newton steps on ln p, which is nearly straight or parabolic for most theories, kept within
    brackets from a table. ``low`` and ``high`` are separations in m between which the answer is
    sought, ``unit`` a length in m on which the pressure changes, which sets the accuracy.
    InputError if a pressure lies beyond those at ``low`` and ``high``.
    """
    table = np.linspace(low, high, _TABLE)
    borne = law(table)[0]
    with np.errstate(divide="ignore"):
        logs = np.log(borne)
    wanted = np.log(pressure)
    if wanted.max() > logs[0] or wanted.min() < logs[-1]:
        least = np.exp(logs[-1])
        raise InputError(
            f"pressures must lie between {least if least >= _NO_PRESSURE else 0.0:.4g} Pa and "
            f"{np.exp(logs[0]):.4g} Pa, where this theory is evaluated, but go from {pressure.min():.4g} Pa to "
            f"{pressure.max():.4g} Pa."
        )
    cell = np.clip(np.searchsorted(-logs, -wanted) - 1, 0, _TABLE - 2)
    below, above = table[cell], table[cell + 1]
    with np.errstate(divide="ignore", invalid="ignore"):
        share = (logs[cell] - wanted) / (logs[cell] - logs[cell + 1])
    h = below + np.where(np.isfinite(share), share, 0.5) * (above - below)
    for _ in range(_STEPS):
        p, stiffness = law(h)
        with np.errstate(divide="ignore"):
            excess = np.log(p) - wanted
        below, above = np.where(excess >= 0.0, h, below), np.where(excess <= 0.0, h, above)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = h + excess * p / stiffness
        inside = (step >= below) & (step <= above)
        new = np.where(inside, step, 0.5 * (below + above))
        change, h = np.abs(new - h), new
        if np.all((inside & (change <= _SQUARED * unit)) | (change <= _ROUNDING * (unit + np.abs(h)))):
            break
    return h
