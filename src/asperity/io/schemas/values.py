"""The kinds of value a document may hold. Each check raises an ``InputError`` that lacks only the name of the key."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field

from ...contact.solvers.by_name import SOLVERS
from ...core import require, units
from ...core.errors import InputError
from ...solids.elastic import INCOMPRESSIBLE

FROM_BODY = "from body"
"""Hardness that stands for the lowest known hardness of the two bodies."""

EFFECTIVE = "effective"
"""Hardness that stands for that of the softer body with all its layers, by the depth of the indentation."""

NONE = "0"
"""Turning point of a load path without load."""


class Table(BaseModel):
    """Base of all models: unknown keys are errors, nothing is converted silently, nothing changes after loading."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)


def _quantity(
    kind: str, *words: str, check: Callable[[float], float] = lambda value: require.positive(value, "")
) -> Any:
    """Validator of text with a number that passes ``check`` and a unit of the dimension ``kind``, or of one of the ``words``.

    The text itself is kept.
    """

    def checked(value: object) -> object:
        if isinstance(value, int | float):
            raise InputError(f" must be text with a number and a unit, but is the bare number {value!r}.")
        if isinstance(value, str) and value not in words:
            number = units.parse(value, kind, "")
            _shown_as(value, lambda: check(number))
        return value

    return BeforeValidator(checked)


def _shown_as(text: str, check: Callable[[], float]) -> None:
    """Run ``check``; its error shows the ``text`` that the user wrote instead of the SI number."""
    try:
        check()
    except InputError as error:
        rule = str(error).split(", but is ")[0]
        raise InputError(f"{rule}, but is {text!r}.") from None


def _size(text: str) -> str:
    for length in units.parse_size(text, ""):
        _shown_as(text, lambda length=length: require.positive(length, ""))  # type: ignore[misc]
    return text


def _height_unit(name: str) -> str:
    units.unit_factor(name, "length", "")
    return name


def _points(value: object) -> object:
    """Two whole numbers as a tuple."""
    words = "two whole numbers [nx, ny] of at least 1, such as [256, 256]"
    if not isinstance(value, list | tuple) or len(value) != 2:
        raise InputError(f" must be {words}, but is {value!r}.")
    if not all(isinstance(number, int) and not isinstance(number, bool) and number >= 1 for number in value):
        raise InputError(f" must be {words}, but is {list(value)!r}.")
    return tuple(value)


def _range(value: object) -> object:
    """Two lengths as a tuple of texts."""
    if not isinstance(value, list | tuple) or len(value) != 2 or not all(isinstance(end, str) for end in value):
        raise InputError(f' must be two lengths, such as ["0 um", "5 um"], but is {value!r}.')
    low, high = (units.parse(end, "length", "") for end in value)
    if high <= low:
        raise InputError(f" must end after its start, but runs from {value[0]!r} to {value[1]!r}.")
    return tuple(value)


def _ordered(value: object) -> object:
    """A list as a tuple, so that it cannot change."""
    return tuple(value) if isinstance(value, list) else value


def _poisson_ratio(value: float) -> float:
    return require.within(value, -1.0, 0.5, "", INCOMPRESSIBLE)


def _channel(value: object) -> object:
    if (isinstance(value, str) and value.strip()) or (type(value) is int and value >= 0):
        return value
    raise InputError(f" must be the name of a channel or its number, 0 or more, but is {value!r}.")


def _fraction(value: float) -> float:
    return require.between(value, 0.0, 1.0, "")


def _not_negative(value: float) -> float:
    if not require.finite(value, "") >= 0.0:
        raise InputError(f" must be zero or greater, but is {value!r}.")
    return value


def _hurst(value: float) -> float:
    return require.at_most(value, 1.0, "")


def _method(name: str) -> str:
    return require.one_of(name, SOLVERS, "")


def _text(value: str) -> str:
    if not value.strip():
        raise InputError(" must not be empty.")
    return value


def _as_quantity(kind: str, example: str) -> Any:
    return Field(json_schema_extra={"quantity": kind}, examples=[example])


Length: TypeAlias = Annotated[str, _quantity("length"), _as_quantity("length", "5 nm")]
"""Text of a length > 0."""

NonNegativeLength: TypeAlias = Annotated[
    str, _quantity("length", check=lambda value: _not_negative(value)), _as_quantity("length", "5 nm")
]
"""Text of a length >= 0."""

SignedLength: TypeAlias = Annotated[
    str, _quantity("length", check=lambda value: require.finite(value, "")), _as_quantity("length", "-5 nm")
]
"""Text of a length of either sign."""

PLACES = ("max", "pressure")
"""Words for positions: of the largest stress, and of the highest pressure."""

PlaceOfMaximum: TypeAlias = Annotated[
    str, _quantity("length", *PLACES, check=lambda value: _not_negative(value)), _as_quantity("length", "30 nm")
]
"""Text of a position >= 0, or one of the ``PLACES``."""

MIDDLE = "middle"
"""Word for a position: of the line in the middle of a map."""

PlaceOnMap: TypeAlias = Annotated[
    str, _quantity("length", MIDDLE, check=lambda value: _not_negative(value)), _as_quantity("length", "3 um")
]
"""Text of a position >= 0, or ``MIDDLE``."""

Lengths: TypeAlias = Annotated[tuple[Length, Length], BeforeValidator(_ordered)]
"""Texts of two lengths > 0, along x and y."""

SignedLengths: TypeAlias = Annotated[tuple[SignedLength, SignedLength], BeforeValidator(_ordered)]
"""Texts of two lengths of either sign, along x and y."""

Angle: TypeAlias = Annotated[
    str, _quantity("angle", check=lambda value: require.finite(value, "")), _as_quantity("angle", "30 deg")
]
"""Text of an angle of either sign."""

Density: TypeAlias = Annotated[str, _quantity("density"), _as_quantity("density", "1 um**-2")]
"""Text of a number per area > 0."""

Psd: TypeAlias = Annotated[str, _quantity("power spectrum"), _as_quantity("power spectrum", "1e4 nm**4")]
"""Text of a value > 0 of a two-dimensional power spectrum, C with m0 = (1/4π²) ∫ C d²q."""

Pressure: TypeAlias = Annotated[str, _quantity("pressure"), _as_quantity("pressure", "50 kPa")]
"""Text of a pressure > 0."""

PressureOrBody: TypeAlias = Annotated[
    str, _quantity("pressure", FROM_BODY, EFFECTIVE), _as_quantity("pressure", "5 GPa")
]
"""Text of a pressure > 0, or the words that stand for the hardness of the softer body, at its surface or by depth."""

Force: TypeAlias = Annotated[str, _quantity("force"), _as_quantity("force", "1 mN")]
"""Text of a force > 0."""


def _points_of_path(value: object) -> object:
    """A list of at least one as a tuple."""
    if value in ([], ()):
        raise InputError(' must hold at least one turning point, such as ["50 MPa", "0", "80 MPa"], but is empty.')
    return _ordered(value)


def _turning_points(kind: str, example: str) -> Any:
    """List of at least one text of a quantity >= 0; zero may stand without a unit."""
    one = Annotated[str, _quantity(kind, NONE, check=lambda value: _not_negative(value)), _as_quantity(kind, example)]
    return Annotated[tuple[one, ...], BeforeValidator(_points_of_path)]


if TYPE_CHECKING:
    PathPressures: TypeAlias = tuple[str, ...]
    PathForces: TypeAlias = tuple[str, ...]
    PathLengths: TypeAlias = tuple[str, ...]
else:
    PathPressures = _turning_points("pressure", "50 MPa")
    PathForces = _turning_points("force", "1 mN")
    PathLengths = _turning_points("length", "5 nm")

SurfaceTension: TypeAlias = Annotated[str, _quantity("surface tension"), _as_quantity("surface tension", "72 mN/m")]
"""Text of a surface tension > 0."""

Viscosity: TypeAlias = Annotated[str, _quantity("viscosity"), _as_quantity("viscosity", "1 mPa*s")]
"""Text of a viscosity > 0."""

Size: TypeAlias = Annotated[str, AfterValidator(_size), _as_quantity("size", "20 um x 20 um")]
"""Text of one or two lengths."""

HeightUnit: TypeAlias = Annotated[str, AfterValidator(_height_unit), Field(examples=["nm"])]
"""Name of a unit of length."""

Channel: TypeAlias = Annotated[str | int, BeforeValidator(_channel)]
"""Name or number of a data channel."""

Points: TypeAlias = Annotated[tuple[int, int], BeforeValidator(_points)]
"""Numbers of grid points (nx, ny)."""

LengthRange: TypeAlias = Annotated[tuple[str, str], BeforeValidator(_range)]
"""Texts of the two ends of an interval."""

ORDERED = BeforeValidator(_ordered)
"""Marks a tuple that is a list in the file."""

Number: TypeAlias = Annotated[float, AfterValidator(lambda value: require.positive(value, ""))]
"""A dimensionless number > 0."""

AnyNumber: TypeAlias = Annotated[float, AfterValidator(lambda value: require.finite(value, ""))]
"""A number of either sign."""

Numbers: TypeAlias = Annotated[tuple[Number, Number], BeforeValidator(_ordered)]
"""Two numbers > 0."""

PoissonRatio: TypeAlias = Annotated[float, AfterValidator(_poisson_ratio)]
"""Poisson's ratio."""

Fraction: TypeAlias = Annotated[float, AfterValidator(_fraction)]
"""A number between 0 and 1, both excluded."""

Hurst: TypeAlias = Annotated[float, AfterValidator(_hurst)]
"""Hurst exponent."""

Method: TypeAlias = Annotated[str, AfterValidator(_method)]
"""Name of a solver."""

Count: TypeAlias = Annotated[int, AfterValidator(lambda value: require.integer(value, 1, ""))]
"""A whole number >= 1."""

Seed: TypeAlias = Annotated[int, AfterValidator(lambda value: require.integer(value, 0, ""))]
"""A whole number >= 0."""

Text: TypeAlias = Annotated[str, AfterValidator(_text)]
"""Text that is not empty."""
