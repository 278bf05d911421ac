"""Work of adhesion of a pair of solids from the energies of their surfaces, with sources."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, ClassVar

from ..core.errors import InputError
from .library import Record, Sourced

CUT_OFF = 0.165e-9
"""D0 in m, distance of the atomic planes in contact at which van der Waals' energy is the work of adhesion (Israelachvili 2011, ch. 13)."""


@dataclass(frozen=True, kw_only=True)
class SolidSurface(Record):
    """Surface of a solid in air: its energy γ in J/m², or its Hamaker constant A in J, from which γ = A/(24π D0²)."""

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


@dataclass(frozen=True)
class PairAdhesion:
    """Work of adhesion of two solids, ``work`` in J/m², and the ``sources`` of what it was made of."""

    work: float
    sources: tuple[str, ...]


def solid_surfaces(path: str | Path | None = None) -> tuple[SolidSurface, ...]:
    """All surfaces: the built-in ones, and those of the TOML file at ``path`` if given, whose names and aliases win.

    The file has tables ``[solid_surface."name"]`` with ``surface_energy`` (``"22 mJ/m**2"``) or ``hamaker_constant`` (``"6.5e-20 J"``),
    ``aliases`` and ``note``; a value may be a table of ``value`` and ``source``. InputError if something in it cannot be used.
    """
    return SolidSurface.all(path)


def work_of_adhesion(first: str, second: str, *, library: str | Path | None = None) -> PairAdhesion:
    """w = 2 (γ1 γ2)^½ of the surfaces of these names (Girifalco & Good 1957): exact for two equal ones, else for dispersive forces alone.

    Names are those of ``solid_surfaces``, in any case, or of the file ``library``.

    Raises
    ------
    InputError
        If a surface is not known; measure its work of adhesion then, and give that.
    """
    known = {key: record for record in solid_surfaces(library) for key in record.keys}
    pair = []
    for name in (first, second):
        key = " ".join(str(name).casefold().split())
        if key not in known:
            names = ", ".join(sorted({record.name for record in known.values()}, key=str.lower))
            raise InputError(
                f"solid surface must be one whose energy is known, {names}, but is {name!r}. Give the work of adhesion itself, such as "
                "50 mJ/m**2.",
                subject="solid surface",
            )
        pair.append(known[key])
    work = 2.0 * math.sqrt(pair[0].energy * pair[1].energy)
    sources = tuple(dict.fromkeys(f"{record.name}, {source}" for record in pair for source in record.sources))
    return PairAdhesion(work, sources)
