"""Relaxing moduli and shifts with temperature as text: ``"3 MPa + 10 MPa @ 10 ms"``,
``"WLF 298 K; 8.86; 101.6 K"``."""

from __future__ import annotations

import re
from types import MappingProxyType

from ..core import units
from ..core.errors import InputError
from .relaxation import Relaxation
from .viscoelastic import Arrhenius, TemperatureShift, WilliamsLandelFerry

AT = "@"
"""Stands between a part of a modulus that relaxes and its time."""

SHIFT_KEYS = MappingProxyType({"WLF": ("reference", "c1", "c2"), "Arrhenius": ("reference", "activation_energy")})
"""What the text of each shift gives, in this order with semicolons between."""

_PLUS = re.compile(r"(?<!\d[eE])\+")


def series_parts(text: str) -> tuple[str, list[tuple[str, str]]]:
    """Text of the relaxed modulus, empty for none, and of each modulus that relaxes with its time.

    InputError if it is no such sum; the message lacks the name of what the text stands for at its
    beginning.
    """
    parts = [part.strip() for part in _PLUS.split(text)]
    terms = [tuple(piece.strip() for piece in part.split(AT)) for part in parts if AT in part]
    rest = [part for part in parts if AT not in part]
    if len(rest) > 1 or any(len(term) != 2 for term in terms):
        raise InputError(
            f" must be one modulus and terms with their times, such as 3MPa+10MPa{AT}10ms, but is {text!r}."
        )
    return (rest or [""])[0], [(term[0], term[1]) for term in terms]


def series_of(text: str, what: str) -> Relaxation:
    """Modulus in ``text``; ``what`` names it in messages. InputError if it cannot be read."""
    try:
        rest, terms = series_parts(text)
    except InputError as error:
        raise InputError(f"{what}{error}") from None
    relaxed = units.parse(rest, "pressure", what) if rest else 0.0
    pairs = ((units.parse(e, "pressure", what), units.parse(t, "time", f"time of {what}")) for e, t in terms)
    return Relaxation(relaxed, tuple(pairs))


def shift_of(text: str, what: str) -> TemperatureShift:
    """Shift with temperature in ``text``; ``what`` names it in messages. InputError if it cannot be
    read."""
    kind, _, rest = text.strip().partition(" ")
    pieces = [piece.strip() for piece in rest.split(";")]
    if kind not in SHIFT_KEYS or len(pieces) != len(SHIFT_KEYS[kind]):
        raise InputError(
            f'{what} must be such as "WLF 298 K; 8.86; 101.6 K" or "Arrhenius 298 K; 80 kJ/mol", but is {text!r}.'
        )
    reference = units.parse(pieces[0], "temperature", f"reference of {what}")
    if kind == "Arrhenius":
        return Arrhenius(reference, units.parse_in(pieces[1], "J/mol", f"activation energy of {what}"))
    c1, c2 = units.parse(pieces[1], "number", f"c1 of {what}"), units.parse(pieces[2], "temperature", f"c2 of {what}")
    return WilliamsLandelFerry(reference, c1, c2)
