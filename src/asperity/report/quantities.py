"""The numbers of a characterisation in words for a table."""

from __future__ import annotations

import math

from ..core.quantity import Quantity
from ..core.units import percent, show
from ..surfaces.characterise.quantities import GROUPS, QUANTITIES
from ..surfaces.characterise.summary import Characterisation

ABSOLUTE_ERRORS = {
    "spectrum.hurst": "spectrum.hurst_error",
    "spectrum.exponent_1": "spectrum.exponent_1_error",
    "spectrum.exponent_2": "spectrum.exponent_2_error",
    "fractal_x.dimension": "fractal_x.dimension_error",
    "fractal_y.dimension": "fractal_y.dimension_error",
}
"""Standard error, in the unit of the number, by path of the number."""

RELATIVE_ERRORS = {
    "spectrum.plateau": "spectrum.plateau_error",
    "spectrum.rolloff_wavelength": "spectrum.rolloff_error",
    "spectrum.crossover_wavelength": "spectrum.crossover_error",
    "spectrum.floor": "spectrum.floor_error",
    "heights.Sq": "sampling.Sq_error",
}
"""Standard error relative to the number, by path of the number; that of Sq is its scatter from map to map."""

SHARES = ("functional.Smr1", "functional.Smr2", "hybrid.Sdr", "sampling.Sq_error")
"""Numbers that are told in per cent."""

HEADLINE = (
    "heights.Sq",
    "heights.Sa",
    "heights.Sz",
    "heights.Ssk",
    "heights.Sku",
    "hybrid.Sdq",
    "spatial.Sal",
    "spatial.Str",
)
"""Numbers that people look for first."""


NOT_DEFINED = "–"
"""Text of a number that the surface does not have."""


def quantity_text(quantity: Quantity, value: float, digits: int = 4) -> str:
    """Text of ``value`` with its unit; angles in degrees, shares in per cent, what is not defined as a dash."""
    if math.isnan(value):
        return NOT_DEFINED
    if quantity.unit == "rad":
        return f"{math.degrees(value):.{digits}g}°"
    if quantity.name in SHARES:
        return percent(value, digits)
    if quantity.unit == "1" and quantity.name.endswith((".count", ".saddles")):
        return f"{value:.0f}"
    return show(value, quantity.unit, digits)


def quantity_name(quantity: Quantity) -> str:
    """Label of ``quantity`` with its symbol."""
    return f"{quantity.label} {quantity.symbol}".rstrip()


def quantity_rows(found: Characterisation) -> list[tuple[str, list[tuple[str, str, str]]]]:
    """Heading of each group with the name, the text and the definition of its numbers, those along x and y in one row.

    What is not defined for the surface is left out.
    """
    values = {quantity.name: value for quantity, value in found.values()}
    errors = {*ABSOLUTE_ERRORS.values(), *RELATIVE_ERRORS.values()}
    along_y = {_other(quantity.name): quantity for quantity in QUANTITIES if _other(quantity.name) != quantity.name}
    groups: dict[str, list[tuple[str, str, str]]] = {}
    for quantity in QUANTITIES:
        if quantity.name in errors or quantity in along_y.values():
            continue
        text = _with_error(quantity, values)
        name = quantity_name(quantity)
        if quantity.name in along_y:
            text = _both(text, _with_error(along_y[quantity.name], values))
            name = name.replace(" along x", "").replace(",x", "").replace("_x", "")
        if text != NOT_DEFINED:
            heading = GROUPS[quantity.name.split(".")[0]].replace(" along x", "")
            groups.setdefault(heading, []).append((name, text, quantity.description))
    return list(groups.items())


def headline_values(found: Characterisation) -> list[tuple[str, str]]:
    """Name and text of the numbers that people look for first."""
    chosen = {quantity.name: (quantity, value) for quantity, value in found.values() if quantity.name in HEADLINE}
    return [(quantity_name(chosen[path][0]), quantity_text(*chosen[path], digits=3)) for path in HEADLINE]


def _other(path: str) -> str:
    """Path along x of a number along y; any other path as it is."""
    parts = [part[:-2] + "_x" if part.endswith("_y") else part for part in path.split(".")]
    return ".".join(parts)


def _both(along_x: str, along_y: str) -> str:
    if along_x == along_y == NOT_DEFINED:
        return NOT_DEFINED
    return f"{along_x} (x), {along_y} (y)"


def _with_error(quantity: Quantity, values: dict[str, float]) -> str:
    value, path = values[quantity.name], quantity.name
    text = quantity_text(quantity, value)
    if text == NOT_DEFINED:
        return text
    if path in ABSOLUTE_ERRORS and math.isfinite(error := values[ABSOLUTE_ERRORS[path]]):
        return f"{text} ± {error:.2g}"
    if path in RELATIVE_ERRORS and math.isfinite(error := values[RELATIVE_ERRORS[path]]):
        return f"{text} ± {percent(error, 2)}"
    return text
