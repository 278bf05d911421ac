"""What every theory says of itself and answers: one shared protocol, one shared result.

A theory is a frozen value made from its parameters, or from a ``Roughness`` by ``from_roughness``. Arrays in, arrays out;
what a theory does not define is NaN.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, Literal, Protocol, Self

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import BoolArray, RealArray
from ..core.errors import InputError
from .roughness import Roughness


@dataclass(frozen=True)
class Input:
    """One parameter of a theory, for people and for the command line.

    Parameters
    ----------
    name
        Name of the parameter of the constructor.
    unit
        SI unit as text, "" for numbers without unit.
    meaning
        What it is, a few words.
    of
        What it belongs to: ``"surface"`` (``from_roughness`` finds it), ``"bodies"`` (``from_roughness`` takes it as a
        keyword), or ``"choice"`` (a keyword of either way, with a default).
    default
        Its default, None where it must be given.
    choices
        Words that name the allowed values, each with its value; empty for numbers.
    many
        Whether it is an array of numbers.
    optional
        Whether it may be left out although its default is None.
    """

    name: str
    unit: str
    meaning: str
    of: Literal["surface", "bodies", "choice"] = "surface"
    default: Any = None
    choices: tuple[tuple[str, Any], ...] = ()
    many: bool = False
    optional: bool = False

    @property
    def required(self) -> bool:
        """Whether it must be given."""
        return self.default is None and not self.optional


E_STAR = Input("E_star", "Pa", "contact modulus E*, 1/E* = (1 - nu1²)/E1 + (1 - nu2²)/E2", of="bodies")
"""The parameter that all elastic theories share."""


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

    ``name`` as on the command line, lower case with hyphens; ``title`` for headings; ``inputs`` the parameters of the
    constructor in their order.
    """

    name: ClassVar[str]
    title: ClassVar[str]
    citation_keys: ClassVar[tuple[str, ...]]
    inputs: ClassVar[tuple[Input, ...]]


class SurfaceTheory(Described, Protocol):
    """A theory of the contact of a rough surface with a rigid plane, or of what is equivalent to it."""

    @classmethod
    def from_roughness(cls, roughness: Roughness, E_star: float, *args: Any, **kwargs: Any) -> Self:
        """Theory for the measured ``roughness`` and the contact modulus ``E_star`` in Pa.

        Further keyword arguments are the ``inputs`` that belong to the bodies or are a choice.

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
    array = np.atleast_1d(np.asarray(values, dtype=float))
    if array.ndim != 1 or array.size == 0:
        raise InputError(f"{what} must be a number or a one-dimensional array, but have shape {array.shape}.")
    if not np.all(np.isfinite(array)):
        raise InputError(f"{what} must be finite, but hold NaN or infinity.")
    if positive and not np.all(array > 0.0):
        raise InputError(f"{what} must be greater than zero, but the smallest is {float(array.min()):g}.")
    return array


def prediction(pressure: RealArray, **known: RealArray) -> Prediction:
    """Prediction with the ``known`` fields, each (n,) or one number for all; the mean real pressure follows from the area."""
    undefined = np.full_like(pressure, np.nan)
    fields = {name: undefined for name, _, _ in QUANTITIES} | {"pressure": pressure}
    if "area_fraction" in known and "mean_real_pressure" not in known:
        area = np.broadcast_to(known["area_fraction"], pressure.shape)
        known["mean_real_pressure"] = np.divide(pressure, area, out=np.full_like(pressure, np.nan), where=area > 0.0)
    fields |= {name: np.broadcast_to(values, pressure.shape) for name, values in known.items()}
    return Prediction(**fields)
