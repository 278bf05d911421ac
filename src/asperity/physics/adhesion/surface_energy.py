"""Work of adhesion of a pair of solids from the energies of their surfaces, with sources."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, ClassVar

from ...core.errors import InputError
from ...solids.library import Record, Sourced

CUT_OFF = 0.165e-9
"""D0 in m, distance of the atomic planes in contact at which van der Waals' energy is the work of
adhesion (Israelachvili 2011, ch. 13)."""


@dataclass(frozen=True, kw_only=True)
class SolidSurface(Record):
    """Surface of a solid in air: its energy γ in J/m², or its Hamaker constant A in J, from which
    γ = A/(24π D0²)."""

    surface_energy: Annotated[Sourced | None, "surface tension"] = None
    hamaker_constant: Annotated[Sourced | None, "energy"] = None
    noun: ClassVar[str] = "solid_surface"

    @property
    def energy(self) -> float:
        """γ in J/m²; InputError if the record holds neither value."""
        if self.surface_energy is not None:
            return self.surface_energy.value
        if self.hamaker_constant is not None:
            return self.hamaker_constant.value / (24.0 * math.pi * CUT_OFF**2)
        raise InputError(
            f"solid surface {self.name!r} must have a surface_energy or a hamaker_constant, but has neither.",
            subject="solid surface",
        )


@dataclass(frozen=True, kw_only=True)
class SolidPair(Record):
    """Two solids in air whose work of adhesion w in J/m² was measured; the name is that of both
    with a stroke between."""

    work_of_adhesion: Annotated[Sourced, "surface tension"]
    noun: ClassVar[str] = "solid_pair"


@dataclass(frozen=True)
class PairAdhesion:
    """Work of adhesion of two solids, ``work`` in J/m², and the ``sources`` of what it was made
    of."""

    work: float
    sources: tuple[str, ...]


def solid_surfaces(path: str | Path | None = None) -> tuple[SolidSurface, ...]:
    """All surfaces: the built-in ones, and those of the TOML file at ``path`` if given, whose names
    and aliases win.

    The file has tables ``[solid_surface."name"]`` with ``surface_energy`` (``"22 mJ/m**2"``) or
    ``hamaker_constant`` (``"6.5e-20 J"``), ``aliases`` and ``note``; a value may be a table of
    ``value`` and ``source``. InputError if something in it cannot be used.
    """
    return SolidSurface.all(path)


def solid_pairs() -> tuple[SolidPair, ...]:
    """All pairs whose work of adhesion was measured."""
    return SolidPair.all()


def work_of_adhesion(first: str, second: str, *, library: str | Path | None = None) -> PairAdhesion:
    """Measured w of two solids, or else 2 (γ1 γ2)^½ of their surfaces (Girifalco & Good 1957),
    which is exact for two equal ones and dispersive forces alone.

    Names are those of ``solid_pairs`` and ``solid_surfaces``, in any case and either order. Where
    the file ``library`` holds one of the two the rule is taken, with its value.

    Raises
    ------
    InputError
        If the pair was not measured and a surface is not known; measure its work of adhesion then,
        and give that.
    """
    built_in = {key: record for record in solid_surfaces() for key in record.keys}
    known = built_in if library is None else {key: each for each in solid_surfaces(library) for key in each.keys}
    keys = [" ".join(str(name).casefold().split()) for name in (first, second)]
    names = [built_in[key].keys[0] if key in built_in else key for key in keys]
    if all(known.get(key) == built_in.get(key) for key in keys):
        for pair in solid_pairs():
            both = (
                [built_in[name].keys[0] if name in built_in else name for name in key.split("/")] for key in pair.keys
            )
            if any(sorted(each) == sorted(names) for each in both):
                return PairAdhesion(pair.work_of_adhesion.value, tuple(f"{pair.name}, {text}" for text in pair.sources))
    for key, name in zip(keys, (first, second), strict=True):
        if key not in known:
            raise InputError(
                f"solid surface must be one whose energy is known, {_listed(known.values())}, or of a pair "
                f"that was measured, {_listed(solid_pairs())}, but is {name!r}. Give the work of adhesion "
                "itself, such as 50 mJ/m**2.",
                subject="solid surface",
            )
    one, other = (known[key] for key in keys)
    sources = tuple(dict.fromkeys(f"{record.name}, {source}" for record in (one, other) for source in record.sources))
    return PairAdhesion(2.0 * math.sqrt(one.energy * other.energy), sources)


def _listed(records: Iterable[Record]) -> str:
    return ", ".join(sorted({record.name for record in records}, key=str.lower))
