"""Materials of a problem document: from the library, of elastic constants, or viscoelastic."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..core.errors import InputError
from ..io.schemas.bodies import FLOW, AnyHardening, LinearHardeningTable, MaterialTable, SwiftTable
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
from ..solids.elastic import Elastic, Hardening, Strength
from ..solids.library import material
from ..solids.moduli_file import read_moduli
from ..solids.plasticity import LinearHardening, Swift, Voce
from ..solids.strength import flow_stress
from ..solids.viscoelastic import Arrhenius, TemperatureShift, Viscoelastic, WilliamsLandelFerry, fitted_solid


def build_material(table: MaterialTable, library: Path | None, folder: Path) -> Elastic:
    """Material of ``table``; names are looked up in the file ``library`` too, and paths of files start at ``folder``."""
    if table.material is not None:
        found = material(table.material, library=library)
        given = [key for key in FLOW if getattr(table, key) is not None]
        kept = tuple(source for source in found.sources if source.partition(":")[0] not in given)
        sources = (*kept, *(f"{key}: user" for key in given))
        return replace(found, strength=strength_of(table, found), sources=sources) if given else found
    assert table.poisson_ratio is not None
    strength = strength_of(table, None)
    more: dict[str, Any] = {"strength": strength, "name": table.name or "", "sources": ("user",)}
    if table.relaxation is not None:
        return viscoelastic(table.relaxation, float(table.poisson_ratio), folder, **more)
    return Elastic(_known(table.youngs_modulus), table.poisson_ratio, **more)


def strength_of(table: MaterialTable, known: Elastic | None) -> Strength:
    """Strength that ``table`` gives, in place of what is ``known`` of its material; a hardening begins at the yield stress, or at that of the hardness."""
    before = Strength() if known is None else known.strength
    given = table.yield_stress is not None
    strength = Strength(
        before.hardness if table.hardness is None else float(table.hardness),
        _known(table.yield_stress) if given else before.yield_stress,
        None if given or table.hardening is not None else before.hardening,
        before.kinematic if table.kinematic is None else float(table.kinematic),
        before.recall if table.recall is None else float(table.recall),
    )
    if table.hardening is None:
        return strength
    first, modulus = flow_stress(strength).value, known.youngs_modulus if known else _known(table.youngs_modulus)
    if math.isnan(first):
        raise InputError(
            "yield stress must be given together with a hardening, but is not known. Give yield_stress (Y in the text of a body).",
            subject="yield stress",
        )
    return replace(strength, yield_stress=first, hardening=_hardening(table.hardening, first, modulus))


def _hardening(table: AnyHardening, first: float, youngs_modulus: float) -> Hardening:
    if isinstance(table, LinearHardeningTable):
        return LinearHardening(first, float(table.modulus))
    if isinstance(table, SwiftTable):
        strain = first / youngs_modulus if table.reference_strain is None else float(table.reference_strain)
        return Swift(first, strain, float(table.exponent))
    return Voce(first, float(table.gain), float(table.rate))


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
