"""What may stand for a parameter: numbers of a quantity between bounds, whole numbers, choices,
several of them.

Each kind of values checks a value, reads one from text such as ``"5 nm"``, and describes itself to
documents, forms and commands.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Annotated, Any, ClassVar, Literal, TypeAlias

from . import units
from .errors import InputError
from .words import alike

LEAST, LARGEST = 1e-41, 1e40
"""Lengths (m), moduli and pressures (Pa) beyond which products of several of them leave the range
of floating-point numbers."""


class Written(float):
    """An SI number that keeps the ``text`` in which it was written, so that a document can be
    written again."""

    text: str

    def __new__(cls, value: float, text: str) -> Written:
        """Number ``value`` written as ``text``."""
        made = super().__new__(cls, value)
        made.text = text
        return made

    def __getnewargs__(self) -> tuple[float, str]:  # type: ignore[override]
        """What a copy or a pickle is made from."""
        return float(self), self.text


class WrittenPair(tuple[float, float]):
    """Two SI numbers that keep the ``text`` in which they were written."""

    text: str

    def __new__(cls, values: tuple[float, float], text: str) -> WrittenPair:
        """Pair of ``values`` written as ``text``."""
        made = super().__new__(cls, values)
        made.text = text
        return made

    def __getnewargs__(self) -> tuple[tuple[float, float], str]:
        """What a copy or a pickle is made from."""
        return (self[0], self[1]), self.text


class Values:
    """What may stand for a parameter. This one: anything."""

    unit = ""
    json_schema: ClassVar[Mapping[str, Any]] = MappingProxyType({})
    """What may stand here in a document, for forms."""

    @property
    def metavar(self) -> str | None:
        """What stands for a value in the help of a command."""
        return None

    def check(self, value: Any, what: str) -> Any:
        """``value`` in its canonical type; ``what`` names it in the message.

        Raises
        ------
        InputError
            If the value is out of range or of a wrong type.
        """
        return value

    def read(self, value: Any, what: str) -> Any:
        """What ``value``, mostly text with a unit as in a document or a command, stands for; errors
        as of ``check``."""
        return value

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> Any:
        """How pydantic reads a value declared with this, and writes it."""
        from pydantic_core import core_schema

        written = core_schema.plain_serializer_function_ser_schema(_text_of, when_used="json")
        return core_schema.no_info_plain_validator_function(lambda value: self.read(value, ""), serialization=written)

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        """What may stand here in a document, for forms."""
        return dict(self.json_schema)


@dataclass(frozen=True)
class Number(Values):
    """Real numbers of a quantity between bounds, or one of a few words.

    Parameters
    ----------
    quantity
        Kind of quantity of ``core.units.DIMENSIONS`` such as ``"length"``, or an SI unit such as
        ``"N/m^2"``; "" for none.
    above, least, below, most
        Bounds: > ``above`` or >= ``least``, < ``below`` or <= ``most``.
    words
        Text that may stand instead of a number, and is left as it is.
    percent
        Whether it is written in percent.
    infinite
        Whether it may be infinity.
    fix
        Usual fix of a value out of range, one sentence.
    """

    quantity: str = ""
    above: float = -math.inf
    least: float = -math.inf
    below: float = math.inf
    most: float = math.inf
    words: tuple[str, ...] = ()
    percent: bool = False
    infinite: bool = False
    fix: str = ""

    @property
    def unit(self) -> str:  # type: ignore[override]
        """SI unit; empty for a number without one."""
        return (
            "" if self.quantity == "number" else units.DIMENSIONS.get(self.quantity, self.quantity).replace("**", "^")
        )

    @property
    def metavar(self) -> str:
        """What stands for a value in the help of a command."""
        named = {"power spectrum": "PSD", "surface tension": "TENSION"}
        return named.get(
            self.quantity, self.quantity.upper() if self.quantity in units.DIMENSIONS else self.unit or "NUMBER"
        )

    @property
    def rule(self) -> str:
        """What a value must be, in words; empty if it may be any number."""

        def shown(bound: float) -> str:
            return f"{100.0 * bound:g} %" if self.percent else "zero" if bound == 0.0 else f"{bound:g}"

        low = f"greater than {shown(self.above)}" if self.above > self.least else f"at least {shown(self.least)}"
        high = f"less than {shown(self.below)}" if self.below < self.most else f"at most {shown(self.most)}"
        bounded = (max(self.above, self.least) > -math.inf, min(self.below, self.most) < math.inf)
        return " and ".join(text for text, there in zip((low, high), bounded, strict=True) if there)

    def check(self, value: Any, what: str) -> float | str:
        """``value`` as a float within the bounds, or one of the words."""
        return self._checked(value, what, repr(getattr(value, "text", value)))

    def read(self, value: Any, what: str) -> float | str:
        """Number for text with a unit, which is kept; numbers may stand as they are where there is
        no unit."""
        if isinstance(value, Written) or (isinstance(value, str) and value in self.words):
            self.check(value, what)
            return value
        if not isinstance(value, str):
            if self.unit and isinstance(value, int | float):
                raise InputError(
                    f"{what} must be text with a number and a unit, such as {self._example!r}, but is the bare "
                    f"number {value!r}."
                )
            return self._checked(value, what, repr(value))
        if self.infinite and value.strip() == "inf":
            return Written(math.inf, value)
        kind, instead = self.quantity if self.quantity in units.DIMENSIONS else self.unit, self._or_words
        number = units.parse(value, kind, what, f",{instead}" if instead else "")
        self._checked(number, what, repr(value))
        return Written(number, value)

    @property
    def _example(self) -> str:
        return units.EXAMPLES.get(self.quantity, f"1 {self.unit}".rstrip())

    @property
    def _or_words(self) -> str:
        """The words that may stand instead, for messages."""
        return f" or {' or '.join(map(repr, self.words))}" if self.words else ""

    def _checked(self, value: Any, what: str, shown: str) -> float | str:
        """``value`` within the bounds; the message shows it as ``shown``."""
        if isinstance(value, str) and value in self.words:
            return value
        if isinstance(value, bool | str):
            unit = f" in {self.unit}" if self.unit else ""
            raise InputError(f"{what} must be a number{unit}{self._or_words}, but is {shown}.")
        try:
            number = float(value)
        except (TypeError, ValueError):
            raise InputError(f"{what} must be a number, but is {shown}.") from None
        except OverflowError:
            raise InputError(f"{what} must be {self.rule}, but is {_digits(value)}.") from None
        if not math.isfinite(number) and not (self.infinite and number > 0.0):
            raise InputError(f"{what} must be a finite number, but is {shown}.")
        if not (
            self.above < number
            and self.least <= number
            and number <= self.most
            and (number < self.below or number == math.inf)
        ):
            fix = self.fix
            if self.percent and 1.0 < number <= 100.0 and "%" not in shown:
                fix = f"Write {number:g}%."
            raise InputError(f"{what} must be {self.rule}, but is {shown}.{f' {fix}' if fix else ''}")
        if self.quantity == "length" and number and math.isfinite(number) and not LEAST < abs(number) <= LARGEST:
            raise InputError(f"{what} must be, in metres, more than {LEAST:g} and at most {LARGEST:g}, but is {shown}.")
        return number

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        """Text with its kind of quantity, or a number with its bounds."""
        if self.unit or self.percent:
            return {"type": "string", "quantity": self.quantity or "number", "examples": [self._example]}
        names = {"above": "exclusiveMinimum", "least": "minimum", "below": "exclusiveMaximum", "most": "maximum"}
        bounds = {name: getattr(self, key) for key, name in names.items() if math.isfinite(getattr(self, key))}
        return {"type": "number", **bounds}


@dataclass(frozen=True)
class Whole(Values):
    """Whole numbers of at least ``least`` and at most ``most``, the ``odd`` ones only if so
    chosen."""

    least: int = 1
    most: int | None = None
    odd: bool = False
    metavar = "NUMBER"

    @property
    def rule(self) -> str:
        """What a value must be, in words."""
        name = "an odd whole number" if self.odd else "a whole number"
        return (
            f"{name} from {self.least} to {self.most}" if self.most is not None else f"{name} of at least {self.least}"
        )

    def check(self, value: Any, what: str) -> int:
        """``value`` as an int within the bounds."""
        number = value if not isinstance(value, bool) and hasattr(value, "__index__") else None
        if isinstance(value, float) and value.is_integer():
            number = int(value)  # a float such as 3.0 stands for a whole number
        if (
            number is None
            or number < self.least
            or number >= 2**63  # no array is longer, and a float may not hold it
            or (self.most is not None and number > self.most)
            or (self.odd and number % 2 == 0)
        ):
            shown = _digits(number) if isinstance(number, int) and abs(number) >= 2**63 else repr(value)
            raise InputError(f"{what} must be {self.rule}, but is {shown}.")
        return int(number)

    def read(self, value: Any, what: str) -> int:
        """Whole number for its digits."""
        digits = isinstance(value, str) and value.strip().isascii() and value.strip().isdigit() and len(value) < 20
        if isinstance(value, float):  # 3.0 in a document for a whole number
            raise InputError(f"{what} must be {self.rule}, but is {value!r}.")
        return self.check(int(value) if digits else value, what)

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        """A whole number with its bounds."""
        return {"type": "integer", "minimum": self.least} | ({} if self.most is None else {"maximum": self.most})


@dataclass(frozen=True, eq=False)
class Choice(Values):
    """One of a few ``words``, each with what it stands for; in Python any others too, if ``others``
    is true."""

    words: Mapping[str, Any]
    others: bool = False
    metavar = "WORD"

    @property
    def rule(self) -> str:
        """What a value must be, in words."""
        return "one of " + ", ".join(self.words)

    def check(self, value: Any, what: str) -> Any:
        """``value``, which a word stands for."""
        if self.others and not isinstance(value, str):
            return value
        if not any(value is known or value == known for known in self.words.values()):
            raise InputError(f"{what} must be {self.rule}, but is {value!r}.")
        return value

    def read(self, value: Any, what: str) -> Any:
        """What a word stands for."""
        if isinstance(value, str):
            if value in self.words:
                return self.words[value]
            same = [word for word in self.words if alike(word) == alike(value)]
            if len(same) == 1:
                return self.words[same[0]]
        return self.check(value, what)

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        """The words."""
        return {"enum": list(dict.fromkeys(self.words.values()))}


@dataclass(frozen=True)
class Several(Values):
    """Values of one ``item``: so many (``count``), or any number of them."""

    item: Values
    count: int | None = None

    @property
    def unit(self) -> str:  # type: ignore[override]
        """Unit of each."""
        return self.item.unit

    @property
    def metavar(self) -> str:
        """What stands for a value in the help of a command."""
        one = self.item.metavar or "TEXT"
        return ",".join([one] * self.count) if self.count else f"{one},…"

    @property
    def rule(self) -> str:
        """What a value must be, in words."""
        return "values with commas between" if self.count is None else f"{self.count} values with commas between"

    def check(self, value: Any, what: str) -> Any:
        """``value`` as a tuple of checked items; an array, once its items are checked, as it is."""
        if hasattr(value, "dtype") and value.size > 1:  # an array is long: its ends stand for all of it
            self.check((value.min(), value.max()) if self.count is None else tuple(value), what)
            return value
        items = list(value) if hasattr(value, "__iter__") and not isinstance(value, str) else [value]
        if self.count not in (None, len(items)):
            raise InputError(f"{what} must be {self.count} values, but is {value!r}.")
        made = tuple(self.item.check(item, what) for item in items)
        return value if hasattr(value, "dtype") else made

    def read(self, value: Any, what: str) -> tuple[Any, ...]:
        """Tuple of items for text with commas between, or for a list."""
        parts = [part.strip() for part in value.split(",")] if isinstance(value, str) else value
        if not isinstance(parts, list | tuple) or self.count not in (None, len(parts)):
            raise InputError(f"{what} must be {self.rule}, but is {value!r}.")
        return tuple(
            self.item.read(part, f"{what}[{number}]" if what else f"[{number}]")
            for number, part in enumerate(parts, start=1)
        )


@dataclass(frozen=True)
class Lengths(Values):
    """Two lengths > 0 in one text: ``"20 um x 10 um"``, or one for both."""

    unit = "m"
    metavar = "LENGTH[xLENGTH]"
    json_schema: ClassVar[Mapping[str, Any]] = MappingProxyType(
        {"type": "string", "quantity": "size", "examples": ["20 um x 20 um"]}
    )

    def check(self, value: Any, what: str) -> tuple[float, float]:
        """``value`` as two lengths."""
        checked: tuple[float, float] = Several(Number("length", above=0.0), 2).check(value, what)
        return checked

    def read(self, value: Any, what: str) -> WrittenPair:
        """Two lengths for their text, which is kept."""
        if isinstance(value, WrittenPair):
            return value
        if not isinstance(value, str):
            raise InputError(f'{what} must be text with one or two lengths, such as "20 um x 10 um", but is {value!r}.')
        found = units.parse_size(value, what)
        for length in found:
            Number("length", above=0.0).check(Written(length, value), what)
        return WrittenPair(found, value)


@dataclass(frozen=True)
class Numbers(Values):
    """Numbers of points along x and y, at least 1 each: ``[256, 128]``, ``"256x128"``, or ``"256"``
    for both."""

    metavar = "NX[xNY]"
    json_schema: ClassVar[Mapping[str, Any]] = MappingProxyType(
        {"type": "array", "items": {"type": "integer", "minimum": 1}, "minItems": 2, "maxItems": 2}
    )

    def check(self, value: Any, what: str) -> tuple[int, int]:
        """``value`` as two whole numbers."""
        checked: tuple[int, int] = Several(Whole(1), 2).check(value, what)
        return checked

    def read(self, value: Any, what: str) -> tuple[int, int]:
        """Two whole numbers for a list, or for text."""
        if isinstance(value, str):
            match = re.fullmatch(r"\s*(\d{1,12})\s*(?:[x×]\s*(\d{1,12})\s*)?", value, re.ASCII)
            if match is None or "0" in (match[1].strip("0") or "0", (match[2] or match[1]).strip("0") or "0"):
                raise InputError(f"{what} must be one or two numbers of points, such as 256x256, but is {value!r}.")
            return int(match[1]), int(match[2] or match[1])
        whole = isinstance(value, list | tuple) and all(
            type(number) is int and 1 <= number < 10**12 for number in value
        )
        if not whole or len(value) != 2:
            shown = list(value) if isinstance(value, tuple) else value
            raise InputError(
                f"{what} must be two whole numbers [nx, ny] of at least 1, such as [256, 256], but is {shown!r}."
            )
        return value[0], value[1]


@dataclass(frozen=True)
class Interval(Values):
    """Two lengths that bound an interval: ``["0 um", "5 um"]`` or ``"0um:5um"``."""

    unit = "m"
    metavar = "LENGTH:LENGTH"
    json_schema: ClassVar[Mapping[str, Any]] = MappingProxyType(
        {
            "type": "array",
            "items": {"type": "string", "quantity": "length", "examples": ["5 um"]},
            "minItems": 2,
            "maxItems": 2,
        }
    )

    def check(self, value: Any, what: str) -> tuple[float, float]:
        """``value`` as two ascending lengths."""
        low, high = Several(Number("length"), 2).check(value, what)
        if high <= low:
            first, last = (_text_of(end) for end in value)
            raise InputError(f"{what} must end after its start, but runs from {first!r} to {last!r}.")
        return low, high

    def read(self, value: Any, what: str) -> tuple[float, float]:
        """Two lengths for a list, or for text with a colon between."""
        ends = [end.strip() for end in value.split(":")] if isinstance(value, str) else value
        if not isinstance(ends, list | tuple) or len(ends) != 2:
            raise InputError(f'{what} must be two lengths, such as ["0 um", "5 um"], but is {value!r}.')
        low, high = (Number("length").read(end, what) for end in ends)
        self.check((low, high), what)
        return low, high  # type: ignore[return-value]


@dataclass(frozen=True)
class Flag(Values):
    """True or false."""

    rule = "true or false"

    def read(self, value: Any, what: str) -> bool:
        """Truth value, also as text."""
        known = {True: True, False: False, "true": True, "false": False}
        if not isinstance(value, bool | str) or value not in known:
            raise InputError(f"{what} must be true or false, but is {value!r}.")
        return known[value]


@dataclass(frozen=True)
class Text(Values):
    """Text that is not empty."""

    rule = "text"

    def read(self, value: Any, what: str) -> str:
        """The text."""
        if not isinstance(value, str) or not value.strip():
            raise InputError(
                f"{what} must be {'text' if not isinstance(value, str) else 'text that is not empty'}, but is "
                f"{value!r}."
            )
        return value


def _digits(number: int) -> str:
    """Words for an integer that is too long to be shown; Python writes none of more than 4300
    digits."""
    return f"an integer of {int(math.log10(abs(number))) + 1} digits"


def _text_of(value: Any) -> Any:
    """What a document holds for a value: its text where it has one."""
    if isinstance(value, tuple) and not isinstance(value, WrittenPair):
        return [_text_of(item) for item in value]
    return getattr(value, "text", value)


Length: TypeAlias = Annotated[float, Number("length", above=0.0)]
NonNegativeLength: TypeAlias = Annotated[float, Number("length", least=0.0)]
SignedLength: TypeAlias = Annotated[float, Number("length")]
Pressure: TypeAlias = Annotated[float, Number("pressure", above=0.0)]
HardnessValue: TypeAlias = Annotated[float, Number("hardness", above=0.0)]
Force: TypeAlias = Annotated[float, Number("force", above=0.0)]
Angle: TypeAlias = Annotated[float, Number("angle")]
Density: TypeAlias = Annotated[float, Number("density", above=0.0)]
Psd: TypeAlias = Annotated[float, Number("power spectrum", above=0.0)]
SurfaceTension: TypeAlias = Annotated[float, Number("surface tension", above=0.0)]
Viscosity: TypeAlias = Annotated[float, Number("viscosity", above=0.0)]
ThermalConductivity: TypeAlias = Annotated[float, Number("thermal conductivity", above=0.0)]
ElectricalResistivity: TypeAlias = Annotated[float, Number("electrical resistivity", above=0.0)]
VolumetricHeatCapacity: TypeAlias = Annotated[float, Number("volumetric heat capacity", above=0.0)]
ThermalExpansion: TypeAlias = Annotated[float, Number("thermal expansion", above=0.0)]
ThermalResistance: TypeAlias = Annotated[float, Number("m^2*K/W", least=0.0)]
WearCoefficient: TypeAlias = Annotated[float, Number("wear coefficient", least=0.0)]
Temperature: TypeAlias = Annotated[float, Number("temperature", above=0.0)]
Voltage: TypeAlias = Annotated[float, Number("V", least=0.0)]
Speed: TypeAlias = Annotated[float, Number("speed", least=0.0)]
Positive: TypeAlias = Annotated[float, Number(above=0.0)]
NonNegative: TypeAlias = Annotated[float, Number(least=0.0)]
Real: TypeAlias = Annotated[float, Number()]
Fraction: TypeAlias = Annotated[float, Number(above=0.0, below=1.0)]
Humidity: TypeAlias = Annotated[float, Number("number", above=0.0, below=1.0, percent=True)]
PoissonRatio: TypeAlias = Annotated[float, Number(above=-1.0, most=0.5)]
Hurst: TypeAlias = Annotated[float, Number(above=0.0, most=1.0)]
Count: TypeAlias = Annotated[int, Whole(1)]
Seed: TypeAlias = Annotated[int, Whole(0)]
StepOfPath: TypeAlias = Annotated[float | str, Number(least=1.0, words=("peak", "last"))]
Axis: TypeAlias = Literal["x", "y"]
NonEmpty: TypeAlias = Annotated[str, Text()]
Size: TypeAlias = Annotated[tuple[float, float], Lengths()]
Points: TypeAlias = Annotated[tuple[int, int], Numbers()]
LengthRange: TypeAlias = Annotated[tuple[float, float], Interval()]
