"""Named materials. Every value carries its source; a user's own file overrides and extends the built-in list."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from ..core import require, units
from .elastic import INCOMPRESSIBLE, Elastic
from .records import Kind, Sourced, built_in_text, checked, find, overridden, parsed, read_text, sourced
from .strength import Strength

KIND = Kind(
    "material",
    "asperity materials",
    required=("youngs_modulus", "poisson_ratio"),
    values=("youngs_modulus", "poisson_ratio", "hardness", "yield_stress"),
)
"""Keys of a material in a file."""

BUILT_IN = "materials.toml"
"""Name of the built-in material file, as shown in messages."""


@dataclass(frozen=True)
class MaterialRecord:
    """Elastic constants and strength of one named material.

    Parameters
    ----------
    name, aliases
        Names under which it is found, in any case.
    youngs_modulus
        E in Pa, > 0.
    poisson_ratio
        nu, -1 < nu <= 0.5.
    hardness, yield_stress
        Hardness and tensile yield stress in Pa, > 0; None where not known.
    note
        Condition of the material or caveat.
    """

    name: str
    youngs_modulus: Sourced
    poisson_ratio: Sourced
    hardness: Sourced | None = None
    yield_stress: Sourced | None = None
    aliases: tuple[str, ...] = ()
    note: str = ""

    @property
    def values(self) -> dict[str, Sourced]:
        """The known values by key, in the order of the fields."""
        found = {field.name: getattr(self, field.name) for field in fields(self)}
        return {key: value for key, value in found.items() if isinstance(value, Sourced)}

    @property
    def body(self) -> Elastic:
        """Half-space of this material, with name, strength and one source a value."""
        return Elastic(
            self.youngs_modulus.value,
            self.poisson_ratio.value,
            Strength(
                hardness=self.hardness.value if self.hardness else float("nan"),
                yield_stress=self.yield_stress.value if self.yield_stress else float("nan"),
            ),
            name=self.name,
            sources=tuple(f"{key}: {value.source}" for key, value in self.values.items()),
        )


def materials(path: str | Path | None = None) -> tuple[MaterialRecord, ...]:
    """All materials: the built-in ones, and those of the TOML file at ``path`` if given.

    A name or alias in the user's file wins over the same name or alias in the built-in list. Keys of a material are
    ``youngs_modulus`` and ``poisson_ratio`` (required), ``hardness``, ``yield_stress``, ``aliases`` and ``note``; a
    value is text with a unit (``"140 GPa"``) or ``{ value = "140 GPa", source = "..." }``, the source being
    "user" by default.

    Raises
    ------
    InputError
        If the file is missing or not TOML, or a key or value in it cannot be used.
    """
    built_in = parsed(built_in_text(BUILT_IN), BUILT_IN, KIND, _record)
    if path is None:
        return built_in
    return overridden(built_in, parsed(read_text(Path(path), KIND), str(path), KIND, _record))


def material(name: str, *, library: str | Path | None = None) -> Elastic:
    """Half-space of the material ``name`` (or alias, in any case) from the built-in list or the file ``library``.

    Raises
    ------
    InputError
        If no material has that name, with the nearest names, or if the file cannot be used (see ``materials``).
    """
    return find(name, materials(library), KIND).body


def _record(name: str, table: Any, file: str) -> MaterialRecord:
    where, entries, aliases, note = checked(name, table, file, KIND)
    values = {
        key: sourced(entry, f"{key} {where}", _conversion(key, f"{key} {where}")) for key, entry in entries.items()
    }
    return MaterialRecord(name, aliases=aliases, note=note, **values)


def _conversion(key: str, what: str) -> Callable[[Any], float]:
    """How the value of ``key`` is read."""
    if key == "poisson_ratio":
        return lambda value: require.within(value, -1.0, 0.5, what, INCOMPRESSIBLE)
    return lambda value: require.positive(units.parse(value, "pressure", what), f"{what} (Pa)")
