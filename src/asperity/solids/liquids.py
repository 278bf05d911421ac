"""Named liquids between surfaces. Every value carries its source; a user's own file overrides and extends the list."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from ..core import require, units
from ..core.errors import InputError
from .records import Kind, Sourced, built_in_text, checked, find, overridden, parsed, read_text, sourced

KIND = Kind(
    "liquid",
    "asperity liquids",
    required=("surface_tension", "temperature"),
    values=("surface_tension", "temperature", "molar_volume", "viscosity"),
)
"""Keys of a liquid in a file."""

DIMENSIONS = {
    "surface_tension": "surface tension",
    "temperature": "temperature",
    "molar_volume": "molar volume",
    "viscosity": "viscosity",
}
"""Kind of quantity of each value."""

BUILT_IN = "liquids.toml"
"""Name of the built-in liquid file, as shown in messages."""

WATER = "water"
"""The liquid whose adsorbed film follows from the humidity."""


@dataclass(frozen=True)
class Liquid:
    """What a film between surfaces needs of its liquid.

    Parameters
    ----------
    surface_tension
        γ in N/m, > 0.
    temperature
        In K at which the values hold, > 0.
    molar_volume, viscosity
        m³/mol and Pa s; NaN where not known.
    name, sources
        Name of the liquid and where its values come from.

    Raises
    ------
    InputError
        If a value is not positive.
    """

    surface_tension: float
    temperature: float = 293.15
    molar_volume: float = math.nan
    viscosity: float = math.nan
    name: str = ""
    sources: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        require.positive(self.surface_tension, "surface tension (N/m)")
        require.positive(self.temperature, "temperature (K)")
        for value, what in ((self.molar_volume, "molar volume (m^3/mol)"), (self.viscosity, "viscosity (Pa s)")):
            if not math.isnan(value):
                require.positive(value, what)

    def require_molar_volume(self) -> float:
        """Molar volume in m³/mol.

        Raises
        ------
        InputError
            If it is not known.
        """
        if math.isnan(self.molar_volume):
            raise InputError(
                f"molar volume of {self.name or 'the liquid'} must be known for menisci at a humidity, but is not. "
                "Give the film thickness and the meniscus height instead; lubricants have no vapour to speak of."
            )
        return self.molar_volume

    @property
    def adsorbs_as_water(self) -> bool:
        """Whether the empirical film of water on carbon holds for it."""
        return self.name == WATER


@dataclass(frozen=True)
class LiquidRecord:
    """Surface tension (N/m), temperature (K), molar volume (m³/mol) and viscosity (Pa s) of one named liquid.

    ``name`` and ``aliases`` find it, in any case; ``note`` is its condition or a caveat.
    """

    name: str
    surface_tension: Sourced
    temperature: Sourced
    molar_volume: Sourced | None = None
    viscosity: Sourced | None = None
    aliases: tuple[str, ...] = ()
    note: str = ""

    @property
    def values(self) -> dict[str, Sourced]:
        """The known values by key, in the order of the fields."""
        found = {field.name: getattr(self, field.name) for field in fields(self)}
        return {key: value for key, value in found.items() if isinstance(value, Sourced)}

    @property
    def liquid(self) -> Liquid:
        """The liquid, with name and one source a value."""
        numbers = {key: item.value for key, item in self.values.items()}
        sources = tuple(f"{key}: {item.source}" for key, item in self.values.items())
        return Liquid(**numbers, name=self.name, sources=sources)


def liquids(path: str | Path | None = None) -> tuple[LiquidRecord, ...]:
    """All liquids: the built-in ones, and those of the TOML file at ``path`` if given.

    The file has tables ``[liquid."name"]`` with ``surface_tension`` and ``temperature`` (required), ``molar_volume``,
    ``viscosity``, ``aliases`` and ``note``; a value is text with a unit (``"72 mN/m"``) or
    ``{ value = "72 mN/m", source = "..." }``. Its names win over built-in ones.

    Raises
    ------
    InputError
        If the file is missing or not TOML, or a key or value in it cannot be used.
    """
    built_in = parsed(built_in_text(BUILT_IN), BUILT_IN, KIND, _record)
    if path is None:
        return built_in
    return overridden(built_in, parsed(read_text(Path(path), KIND), str(path), KIND, _record))


def liquid(name: str, *, library: str | Path | None = None) -> Liquid:
    """Liquid ``name`` (or alias, in any case) from the built-in list or the file ``library``.

    Raises
    ------
    InputError
        If no liquid has that name, with the nearest names, or if the file cannot be used (see ``liquids``).
    """
    return find(name, liquids(library), KIND).liquid


def _record(name: str, table: Any, file: str) -> LiquidRecord:
    where, entries, aliases, note = checked(name, table, file, KIND)
    values = {
        key: sourced(entry, f"{key} {where}", _conversion(key, f"{key} {where}")) for key, entry in entries.items()
    }
    return LiquidRecord(name, aliases=aliases, note=note, **values)


def _conversion(key: str, what: str) -> Callable[[Any], float]:
    unit = units.DIMENSIONS[DIMENSIONS[key]]
    return lambda value: require.positive(units.parse(value, DIMENSIONS[key], what), f"{what} ({unit})")
