"""Which parts of a body flow plastically: the J2 solid of each material, from its yield stress and
hardening."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeAlias

from ..core.errors import InputError
from .elastic import TABOR, Elastic, Strength
from .layers import Body, materials_of
from .plasticity import J2, LinearHardening
from .viscoelastic import Viscoelastic

PlasticPart: TypeAlias = J2 | Elastic
"""A layer or base: one that may flow, or one that is elastic at any stress."""


@dataclass(frozen=True)
class FlowStress:
    """Initial yield stress in tension of a material.

    Attributes
    ----------
    value
        Y in Pa; NaN where neither yield stress nor hardness is known.
    inferred
        Whether it is the hardness over 2.8 (Tabor 1951).
    """

    value: float
    inferred: bool = False


def flow_stress(strength: Strength) -> FlowStress:
    """Initial yield stress: the known one, or hardness/2.8 where only that is known."""
    if not math.isnan(strength.yield_stress):
        return FlowStress(strength.yield_stress)
    return FlowStress(strength.hardness / TABOR, inferred=not math.isnan(strength.hardness))


def plastic_solid(material: Elastic) -> J2:
    """The elastic-plastic solid of ``material``: its hardening, or perfect plasticity at its yield
    stress, with its back stress.

    Raises
    ------
    InputError
        If neither yield stress nor hardness is known, or the material is viscoelastic.

    Examples
    --------
    >>> plastic_solid(Elastic(200e9, 0.3, Strength(yield_stress=400e6))).hardening
    LinearHardening(initial=400000000.0, modulus=0.0)
    """
    if isinstance(material, Viscoelastic):
        raise InputError(
            f"material of a plastic solid must be elastic until it yields, but {material.name or 'it'} is "
            "viscoelastic. Give Elastic(E, nu)."
        )
    stress, strength = flow_stress(material.strength), material.strength
    if math.isnan(stress.value):
        raise InputError(
            f"yield stress of {material.name or 'the material'} must be known for plastic flow, but neither it "
            "nor a hardness is. "
            "Give it, as {yield_stress}.",
            subject=f"yield stress of {material.name or 'the material'}",
        )
    hardening = strength.hardening or LinearHardening(stress.value)
    plain = Elastic(material.youngs_modulus, material.poisson_ratio)
    return J2(plain, hardening, strength.kinematic, strength.recall)


def plastic_parts(body: Body, *, unknown_is_elastic: bool = False) -> tuple[PlasticPart, ...]:
    """Solid of each layer of ``body`` from the surface down, and of the base last; a rigid base is
    left out.

    Parameters
    ----------
    body
        Homogeneous or layered.
    unknown_is_elastic
        Whether a material of unknown yield stress and hardness stays elastic at any stress, instead
        of being refused.

    Raises
    ------
    InputError
        If a yield stress is needed and not known.
    """
    return tuple(
        material if unknown_is_elastic and math.isnan(flow_stress(material.strength).value) else plastic_solid(material)
        for material in materials_of(body)
    )
