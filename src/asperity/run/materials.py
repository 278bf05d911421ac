"""Materials of a problem document: from the library, of elastic constants, or viscoelastic."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from ..core.errors import InputError
from ..io.schemas.bodies import MaterialTable
from ..io.schemas.relaxation import (
    ArrheniusTable,
    KelvinVoigtTable,
    MaxwellTable,
    MeasuredTable,
    PowerLawTable,
    PronyTable,
    Relaxing,
    StandardLinearTable,
)
from ..solids.elastic import Elastic, Strength
from ..solids.library import material
from ..solids.moduli_file import read_moduli
from ..solids.viscoelastic import Arrhenius, TemperatureShift, Viscoelastic, WilliamsLandelFerry, fitted_solid


def build_material(table: MaterialTable, library: Path | None, folder: Path) -> Elastic:
    """Material of ``table``; names are looked up in the file ``library`` too, and paths of files start at ``folder``."""
    if table.material is not None:
        return material(table.material, library=library)
    assert table.poisson_ratio is not None
    strength = Strength(_known(table.hardness), _known(table.yield_stress))
    more: dict[str, Any] = {"strength": strength, "name": table.name or "", "sources": ("user",)}
    if table.relaxation is not None:
        return viscoelastic(table.relaxation, float(table.poisson_ratio), folder, **more)
    return Elastic(_known(table.youngs_modulus), table.poisson_ratio, **more)


def viscoelastic(table: Relaxing, nu: float, folder: Path, **more: Any) -> Viscoelastic:
    """Viscoelastic material that relaxes as ``table`` says, of Poisson's ratio ``nu``; ``more`` are fields of it."""
    more |= {"elastic_bulk": table.elastic_bulk, "shift": _shift(table)}
    if isinstance(table, PronyTable):
        terms = tuple((float(e), float(t)) for e, t in zip(table.moduli, table.times, strict=True))
        return Viscoelastic.prony(float(table.relaxed), terms, nu, **more)
    if isinstance(table, StandardLinearTable):
        return Viscoelastic.standard_linear(
            float(table.relaxed), float(table.instantaneous), float(table.time), nu, **more
        )
    if isinstance(table, MaxwellTable):
        return Viscoelastic.maxwell(float(table.modulus), float(table.time), nu, **more)
    if isinstance(table, KelvinVoigtTable):
        ratio = float(table.instantaneous)
        return Viscoelastic.kelvin_voigt(float(table.relaxed), float(table.time), nu, instantaneous=ratio, **more)
    if isinstance(table, PowerLawTable):
        ends = {"shortest": float(table.shortest), "longest": float(table.longest)}
        return Viscoelastic.power_law(float(table.coefficient), float(table.exponent), nu, **ends, **more)
    if not isinstance(table, MeasuredTable):
        raise InputError(f"relaxation must be one of the kinds of documents, but is {table!r}.")
    columns = read_moduli(folder / table.moduli_file)
    more["sources"] = (*more.get("sources", ()), f"relaxation: {table.moduli_file}")
    return fitted_solid(*columns, poisson_ratio=nu, per_decade=table.per_decade, **more).solid


def _shift(table: Relaxing) -> TemperatureShift | None:
    shift = table.shift
    if shift is None:
        return None
    if isinstance(shift, ArrheniusTable):
        return Arrhenius(float(shift.reference), float(shift.activation_energy))
    return WilliamsLandelFerry(float(shift.reference), float(shift.c1), float(shift.c2))


def _known(value: float | str | None) -> float:
    return math.nan if value is None else float(value)
