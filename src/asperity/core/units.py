"""Physical quantities as text with units, for input and output; all computation is with SI
floats."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from functools import cache
from typing import Any

from .errors import UnitError

DIMENSIONS = {
    "length": "m",
    "area": "m**2",
    "density": "1/m**2",
    "power spectrum": "m**4",
    "pressure": "Pa",
    "hardness": "Pa",
    "force": "N",
    "energy": "J",
    "surface tension": "N/m",
    "stiffness": "Pa/m",
    "thermal conductivity": "W/(m*K)",
    "electrical resistivity": "ohm*m",
    "volumetric heat capacity": "J/(m**3*K)",
    "thermal expansion": "1/K",
    "wear coefficient": "m**2/N",
    "molar volume": "m**3/mol",
    "viscosity": "Pa*s",
    "speed": "m/s",
    "angle": "rad",
    "temperature": "K",
    "time": "s",
    "memory": "byte",
    "number": "dimensionless",
}
"""Kinds of quantity, with the SI unit in which they are returned."""

EXAMPLES = {
    "length": "5 nm",
    "pressure": "50 kPa",
    "hardness": "5 GPa",
    "force": "1 mN",
    "area": "1 um**2",
    "angle": "10 deg",
    "density": "1 um**-2",
    "power spectrum": "1e4 nm**4",
    "surface tension": "72 mN/m",
    "molar volume": "18 cm**3/mol",
    "viscosity": "1 mPa*s",
    "thermal conductivity": "50 W/(m*K)",
    "electrical resistivity": "17 nohm*m",
    "volumetric heat capacity": "3.7 MJ/(m**3*K)",
    "thermal expansion": "12e-6/K",
    "wear coefficient": "1e-6 mm^3/Nm",
    "temperature": "293 K",
    "time": "1 s",
    "speed": "1 mm/s",
}
"""Text of a usual value of each kind, for messages and forms."""

_NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*)", re.DOTALL)


_PREFIXES = {
    **{"z": -21, "a": -18, "f": -15, "p": -12, "n": -9, "u": -6, "µ": -6, "m": -3},
    **{"": 0, "k": 3, "M": 6, "G": 9, "T": 12, "P": 15, "E": 18},
}
"""Power of ten of each prefix in use; the later of two symbols is the one that is printed."""

_SYMBOLS = {power: symbol for symbol, power in _PREFIXES.items()}

_PREFIXED = ("m", "Pa", "N", "J", "s", "B", "N/m", "Pa/m")
"""Units that are read and printed with ``_PREFIXES`` here, to the bit as pint does, which takes 0.5
s to import and to set up. Powers of a length are printed here too; all others are left to pint."""

_WRITTEN = {
    "ohm": "Ω",
    "ohm*m": "Ω·m",
    "W/(m*K)": "W/(m·K)",
    "J/(m**3*K)": "J/(m³·K)",
    "1/K": "m/(m·K)",
    "W/m**2": "W/m²",
}
"""Further units that are read and printed with ``_PREFIXES`` here, and how they are printed: pint
writes m·Ω, and with a prefix nm·Ω."""

_CUBIC_MM = 1e-9
"""1 mm³/(N m) in m²/N."""

_DIRECT = {("deg", "rad"): math.pi / 180.0, ("%", "dimensionless"): 0.01}
"""Factors of two more usual units (the contact angle of liquids has a default in degrees)."""

_WEAR = frozenset(
    f"{volume}/{work}"
    for volume in ("mm^3", "mm**3", "mm³", "mm3")
    for work in ("Nm", "(Nm)", "(N m)", "(N*m)", "(N·m)", "N/m")
)
"""Usual ways to write the unit of a wear coefficient, which pint does not read."""


@cache
def _registry() -> Any:
    import pint

    return pint.UnitRegistry()


@dataclass(frozen=True)
class Dimension:
    """Powers of the base quantities in a unit, such as (("length", -1.0), ("mass", 1.0)); those
    that are not there are 0."""

    powers: tuple[tuple[str, float], ...]

    def times(self, other: Dimension) -> Dimension:
        """Dimension of the product of both."""
        found = dict(self.powers)
        for name, power in other.powers:
            found[name] = found.get(name, 0.0) + power
        return Dimension(tuple(sorted((name, power) for name, power in found.items() if abs(power) > _NO_POWER)))

    def power(self, exponent: float) -> Dimension:
        """Dimension of what has this one to the ``exponent``."""
        return Dimension(tuple((name, power * exponent) for name, power in self.powers if exponent))


_NO_POWER = 1e-9
"""Power below which a base quantity is not there, but for rounding."""


@cache
def dimension(unit: str) -> Dimension:
    """Dimension of what is measured in ``unit``, "1" or "" for plain numbers."""
    if unit in ("", "1"):
        return Dimension(())
    found = _registry().get_dimensionality(unit)
    return Dimension(tuple(sorted((name.strip("[]"), float(power)) for name, power in found.items())))


_BASE_UNITS = {
    "length": "m",
    "mass": "kg",
    "time": "s",
    "temperature": "K",
    "current": "A",
    "substance": "mol",
    "luminosity": "cd",
}


def unit_of(wanted: Dimension) -> str:
    """SI unit of a dimension: one of ``DIMENSIONS`` where there is one, "1" for plain numbers."""
    if not wanted.powers:
        return "1"
    usual = (unit for kind, unit in DIMENSIONS.items() if kind not in ("number", "angle", "memory"))
    known = next((unit for unit in usual if dimension(unit) == wanted), None)
    if known is not None:
        return known
    return "*".join(
        _BASE_UNITS[name] if power == 1.0 else f"{_BASE_UNITS[name]}**{power:g}" for name, power in wanted.powers
    )


class _OtherDimensionError(Exception):
    """A unit is of another dimension than the one that is wanted."""


def parse(text: str | float, kind: str, what: str, instead: str = "") -> float:
    """Return the SI value of a quantity such as ``"50 kPa"`` or ``"5nm"``.

    Parameters
    ----------
    text
        Number followed by a unit, or a hardness number. A unit is never guessed. An electrical
        resistivity may be given by the conductivity, in S/m. What has been read already stays as
        it is.
    kind
        One of ``DIMENSIONS``, or an SI unit such as ``"N/m"`` for a quantity that is none of them.
    what
        Name of the input, for the error message.
    instead
        What else it may be, for the message about text that is no number.

    Raises
    ------
    UnitError
        If number or unit is missing, unknown, or of another dimension.
    """
    if isinstance(text, float) and hasattr(text, "text"):
        return float(text)
    if kind not in DIMENSIONS:
        return parse_in(str(text), kind, what, instead)
    if kind == "hardness" and "H" in str(text).upper() and (hardness := hardness_of(str(text), what)) is not None:
        return hardness  # a hardness number; no unit of pressure in use has this letter
    if kind == "electrical resistivity" and _CONDUCTIVITY.fullmatch(str(text)):
        conductivity = parse_in(str(text), "S/m", what)
        return 1.0 / conductivity if conductivity else math.inf
    unit = DIMENSIONS[kind]
    number, name = _split(str(text), EXAMPLES.get(kind, f"1 {unit}"), what, instead, plain=kind == "number")
    return number * unit_factor(name, kind, what)


_CONDUCTIVITY = re.compile(r".*\d\s*[kMGmuµn]?S\s*/\s*[cmuµn]?m\s*")
"""Text of an electrical conductivity, which stands for the resistivity."""


def parse_in(text: str, unit: str, what: str, instead: str = "") -> float:
    """Return the value in ``unit`` of a quantity such as ``"3 um**-2"``, for ``unit`` =
    ``"1/m^2"``; no unit is a plain number.

    Raises
    ------
    UnitError
        If number or unit is missing, unknown, or of another dimension.
    """
    known = {DIMENSIONS[kind]: example for kind, example in EXAMPLES.items() if kind != "hardness"}
    number, name = _split(text, known.get(unit.replace("^", "**"), f"1 {unit}"), what, instead, plain=not unit)
    try:
        return number * _factor(name or "dimensionless", unit or "dimensionless")
    except _OtherDimensionError:
        like = f"in a unit such as {unit}" if unit else "a plain number"
        raise UnitError(f"{what} must be {like}, but its unit is {name!r}.") from None
    except Exception:  # pint raises many types on malformed unit text
        raise UnitError(f"{what} has the unknown unit {name!r}; {_meant(name, unit)}.", subject=what) from None


_COMMA = re.compile(r"\s*[+-]?\d*,\d")
"""Beginning of a number with a comma for the decimals."""


def _split(text: str, example: str, what: str, instead: str, *, plain: bool) -> tuple[float, str]:
    """Number and name of the unit in ``text``; a ``plain`` number needs none."""
    match = _NUMBER.fullmatch(str(text))
    if _COMMA.match(str(text)):
        instead = str(text).strip().replace(",", ".", 1)
        raise UnitError(
            f"{what} must have a point before its decimals, such as {instead!r}, but has a comma: {text!r}.",
            subject=what,
        )
    if match is None:
        wanted = "a number" if plain else f'a number with a unit, such as "{example}"'
        raise UnitError(f"{what} must be {wanted}{instead}, but is {text!r}.")
    number, name = float(match.group(1)), match.group(2).strip()
    name = f"1{name}" if re.match(r"/ ?[A-Za-zµ]", name) else name  # 12e-6/K
    if not name and not plain:
        raise UnitError(f'{what} must have a unit, such as "{example}", but is {text!r} without one.')
    return number, name


def unit_factor(name: str, kind: str, what: str) -> float:
    """SI value of one ``name`` (for example ``"nm"`` → 1e-9 for a length).

    Raises
    ------
    UnitError
        If the unit is unknown or of another dimension than ``kind``.
    """
    unit = DIMENSIONS[kind]
    try:
        return _factor(name or "dimensionless", unit)
    except _OtherDimensionError:
        meant = (
            f"a {kind} (unit such as {unit})"
            if kind != "hardness"
            else "a pressure (unit such as Pa) or a number in HV, HB or HRC"
        )
        raise UnitError(f"{what} must be {meant}, but its unit is {name!r}.") from None
    except Exception:  # pint raises many types on malformed unit text
        raise UnitError(f"{what} has the unknown unit {name!r}; {_meant(name, unit)}.", subject=what) from None


def _meant(name: str, unit: str) -> str:
    """What may be meant by a ``name`` that is no unit: one that differs in the case of letters, or
    ``unit`` itself."""
    known = [
        f"{prefix}{base}"
        for base in ("Pa", "N", "m", "J", "N/m", "rad", "s")
        for prefix in ("M", "G", "k", "m", "u", "n", "p", "")
    ]
    alike = [other for other in known if other.lower() == name.lower()]
    return f"write {' or '.join(alike)}" if alike else f"use for example {unit or 'none'}"


_FACTOR = r"[^\W\d_]{1,20}(?: ?(?:\*\*|\^) ?[+-]?\d(?:\.\d)?)?"
_GRAMMAR = re.compile(rf"(?:1 ?/ ?)?\(?{_FACTOR}\)?(?: ?[*/· ] ?\(?{_FACTOR}\)?){{0,5}}|[%°1]|")
"""What the library of units is given, which computes whatever stands in a text: names with small
powers."""


@cache
def _factor(name: str, unit: str) -> float:
    """One ``name`` in ``unit``."""
    plain = name.replace("^", "**")
    if plain == unit:
        return 1.0
    if (name, unit) in _DIRECT:
        return _DIRECT[name, unit]
    if unit == "m**2/N" and name in _WEAR:
        return _CUBIC_MM
    if (unit in _PREFIXED or unit in _WRITTEN) and plain.endswith(unit) and plain.removesuffix(unit) in _PREFIXES:
        return float(f"1e{_PREFIXES[plain.removesuffix(unit)]}")
    if len(name) > 60 or not _GRAMMAR.fullmatch(name):
        raise ValueError(name)
    import pint

    try:
        return float(_registry().Quantity(1.0, name).to(unit).magnitude)
    except pint.DimensionalityError:
        raise _OtherDimensionError from None


def parse_size(text: str | tuple[float, float], what: str = "size") -> tuple[float, float]:
    """Return (Lx, Ly) in m from text such as ``"20 um x 20 um"``; one length means a square.

    Raises
    ------
    UnitError
        If a length lacks a unit or the text has more than two parts.
    """
    if isinstance(text, tuple):
        return float(text[0]), float(text[1])
    parts = re.split(r"\s*[x×]\s*", text.strip())
    if len(parts) == 1:
        parts *= 2
    if len(parts) != 2:
        raise UnitError(f'{what} must be one or two lengths, such as "20 um x 20 um", but is {text!r}.')
    return parse(parts[0], "length", what), parse(parts[1], "length", what)


_SMALLEST = 1e-19
"""SI value below which prefixes are of no help."""

_LARGEST = 1e21
"""SI value up to which the prefixes of ``_PREFIXES`` serve."""


def show(value: float, unit: str, digits: int = 4) -> str:
    """Text of an SI ``value`` with an SI-prefixed ``unit``, for example ``show(5e-9, "m")`` →
    ``"5 nm"``."""
    if not unit or unit == "1":
        return f"{value:.{digits}g}"
    if value != value or value in (float("inf"), float("-inf")):
        return f"{value:g} {unit}"
    if (unit in _PREFIXED or unit in _WRITTEN) and abs(value) < _LARGEST:
        power = 0 if abs(value) < _SMALLEST else 3 * math.floor(math.log10(abs(value)) / 3)
        return f"{value * _inverse(power):.{digits}g} {_SYMBOLS[power]}{_WRITTEN.get(unit, unit)}"
    if unit == "m**2/N":
        return f"{value / _CUBIC_MM:.{digits}g} mm³/(N·m)"
    if unit in _POWERS:
        power, sign, least = _POWERS[unit]
        inverse = {symbol: _inverse(_PREFIXES[symbol], power) for symbol in ("", "m", "µ", "n")}
        large = (symbol for symbol in inverse if symbol == "n" or value == 0.0 or abs(value * inverse[symbol]) >= least)
        symbol = next(large)
        return f"{value * inverse[symbol]:.{digits}g} {symbol}m{sign}"
    quantity = _registry().Quantity(value, unit)
    compact = quantity if abs(value) < _SMALLEST else quantity.to_compact()
    return f"{compact.magnitude:.{digits}g} {compact.units:~P}"


def _inverse(power: int, times: int = 1) -> float:
    """One over a prefix to the power ``times``, computed as pint does: 1e-9 is rounded, and 1e9
    differs from it in the last bit."""
    return float(math.pow(float(f"1e{power}"), -times))


_DIGITS = r"\d+(?:\.\d+)?(?:e[+-]\d+)?"
_PLAIN = re.compile(rf"""(?<![\w.'"+-])(?:({_DIGITS}) x )?({_DIGITS}) (Pa|N|m|J|N/m)\b(?![/*^²³])""")


def prefixed(text: str) -> str:
    """``text`` with its long SI numbers as ``show`` writes them: "1.5e+10 Pa" is "15 GPa", of two
    sides both; what is quoted stays."""

    def shown(match: re.Match[str]) -> str:
        numbers = [float(number) for number in match.groups()[:2] if number]
        long = any("e" in number or not 1e-2 <= float(number) < 1e4 for number in match.groups()[:2] if number)
        return " x ".join(show(number, match[3], 6) for number in numbers) if long and all(numbers) else match[0]

    return _PLAIN.sub(shown, text)


def times(ratio: float, digits: int = 2) -> str:
    """Text of a ``ratio`` in a sentence, without a power of ten up to a million: ``times(412.3)`` →
    ``"410"``."""
    text = f"{ratio:.{digits}g}"
    return f"{float(text):.0f}" if "e" in text and 1.0 <= ratio < 1e6 else text


def percent(share: float, digits: int = 3) -> str:
    """Text of a ``share`` of one in percent, for example ``percent(0.0123)`` → ``"1.23 %"``."""
    return f"{times(100.0 * share, digits)} %"


_POWERS = {"m**2": (2, "²", 0.01), "m**3": (3, "³", 1e-3), "m**4": (4, "⁴", 0.01)}
"""For powers of a length, whose prefixes are factors of a million and more apart: the largest unit
from m to nm in which a value is at least the number given serves, else the smallest."""


# Hardness numbers of Vickers, Brinell and Rockwell as the pressure that this package calls
# hardness: force over *projected* area.
#
# Vickers and Brinell numbers are forces over the curved or inclined area of the imprint itself, in
# kgf/mm².
#
# HV, HV10        HV 9.80665 MPa / sin 68°: the faces of the pyramid stand at 68° to its axis, so
#                 that HV is 0.927 of the pressure.
# HB, HBW         HB 9.80665 MPa / (1 - t/D): the ball of diameter D leaves a cap of depth t, of
#                 area π D t and projected area π t (D - t); from HB = F/(π D t) is t/D = (F/D²)/(π
#                 HB). A number like HBW10/3000 gives D in mm and F in kgf, else F/D² is 30 kgf/mm²
#                 as for steel and cast iron, below 95.5 HB 10 kgf/mm² as for softer metals. Valid
#                 for imprints of 0.24 D to 0.6 D (ISO 6506-1).
# HRC             by the Vickers numbers of non-austenitic steels in ASTM E140, table 1, from 20 to
#                 68 HRC; other materials differ.

KILOPOND = 9.80665e6
"""1 kgf/mm² in Pa."""

VICKERS_OF_ROCKWELL_C = (
    *(238, 248, 260, 272, 286, 302, 318, 336, 354, 372, 392, 412, 434),
    *(458, 484, 513, 544, 577, 613, 653, 697, 746, 800, 865, 940),
)
"""HV at 20, 22, … 68 HRC (ASTM E140, table 1); what lies between is within 0.3 % of the table."""

_STEEL, _SOFTER = 30.0, 10.0
"""F/D² in kgf/mm² of the usual test of steel, and of that below ``_LEAST_OF_STEEL``."""

_LEAST_OF_STEEL, _HARDEST_BRINELL = 95.5, 650.0
_SHALLOWEST, _DEEPEST = (0.5 * (1.0 - math.sqrt(1.0 - ratio**2)) for ratio in (0.24, 0.6))

_HARDNESS_NUMBER = re.compile(
    r"\s*(?P<number>[+-]?(?:\d+\.?\d*|\.\d+))\s*(?:(?P<vickers>HV)(?:\s?\d+(?:\.\d+)?)?"
    r"|(?P<brinell>HBW?)(?:\s?(?P<ball>\d+(?:\.\d+)?)/(?P<force>\d+(?:\.\d+)?))?|(?P<rockwell>HRC))\s*",
    re.IGNORECASE,
)


def hardness_of(text: str, what: str) -> float | None:
    """Hardness in Pa that a number such as ``"700 HV"``, ``"200 HB"``, ``"187 HBW10/3000"`` or
    ``"60 HRC"`` stands for; None for any other text.

    Raises
    ------
    UnitError
        If the number lies outside the range of its scale; ``what`` names the input.

    Examples
    --------
    >>> [f"{hardness_of(text, '') / 1e9:.2f}" for text in ("700 HV", "200 HB", "60 HRC")]
    ['7.40', '2.06', '7.37']
    """
    match = _HARDNESS_NUMBER.fullmatch(text)
    if match is None:
        return None
    number = float(match["number"])
    if match["vickers"]:
        return _vickers(number, text, what)
    if match["rockwell"]:
        last = 20 + 2 * (len(VICKERS_OF_ROCKWELL_C) - 1)
        if not 20.0 <= number <= last:
            raise UnitError(
                f"{what} must be from 20 to {last} HRC, the range of the table of steels, but is {text!r}. "
                "Give HV, HB or a pressure."
            )
        row = min(int((number - 20.0) / 2.0), len(VICKERS_OF_ROCKWELL_C) - 2)
        low, high = VICKERS_OF_ROCKWELL_C[row : row + 2]
        return _vickers(low + (high - low) * (number - 20.0 - 2 * row) / 2.0, text, what)
    given = match["ball"] is not None
    index = _STEEL if number >= _LEAST_OF_STEEL else _SOFTER
    if given:
        index = float(match["force"]) / float(match["ball"]) ** 2 if float(match["ball"]) else 0.0
    depth = index / (math.pi * number) if number > 0.0 else math.inf  # over the diameter of the ball
    if not 0.99 * _SHALLOWEST <= depth <= 1.01 * _DEEPEST or number > _HARDEST_BRINELL:
        least, most = (index / (math.pi * end) for end in (_DEEPEST, _SHALLOWEST))
        if not given:
            least, most = _SOFTER / (math.pi * _DEEPEST), _HARDEST_BRINELL
        raise UnitError(
            f"{what} must be from {least:.3g} to {min(most, _HARDEST_BRINELL):.3g} HB, for imprints of 0.24 to "
            f"0.6 of the ball, but is {text!r}. Give the ball and the force, such as HBW10/500, HV or a "
            "pressure."
        )
    return number * KILOPOND / (1.0 - depth)


def _vickers(number: float, text: str, what: str) -> float:
    if not number > 0.0:
        raise UnitError(f"{what} must be greater than zero, but is {text!r}.")
    return number * KILOPOND / math.sin(math.radians(68.0))
