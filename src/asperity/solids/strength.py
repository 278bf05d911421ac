"""Which parts of a body flow plastically: the J2 solid of each material, from its yield stress and hardening."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias

from ..core.errors import InputError
from .elastic import TABOR, Elastic, Strength
from .layers import Body, Layered, RigidBase, materials_of, surface_material
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


@dataclass(frozen=True)
class YieldPressure:
    """Contact pressure (mean, over the projected area) at which a material yields plastically.

    Attributes
    ----------
    value
        In Pa; None where neither hardness nor yield stress is known.
    symbol
        ``"H"`` where it is the hardness, ``"2.8 Y"`` where it follows from the yield stress (Tabor 1951), empty where it is not known.
    """

    value: float | None
    symbol: str


def yield_pressure(strength: Strength) -> YieldPressure:
    """Pressure at which a material of this ``strength`` yields: its hardness, else 2.8 Y.

    Examples
    --------
    >>> yield_pressure(Strength(yield_stress=200e6))
    YieldPressure(value=560000000.0, symbol='2.8 Y')
    """
    if not math.isnan(strength.hardness):
        return YieldPressure(strength.hardness, "H")
    if not math.isnan(strength.yield_stress):
        return YieldPressure(TABOR * strength.yield_stress, f"{TABOR:g} Y")
    return YieldPressure(None, "")


LEAST_OF_ELASTOMERS = 0.49
"""Poisson's ratio from which on a solid of unknown strength is taken for an elastomer, which tears but does not yield; metals and glassy
polymers have at most 0.46."""


def never_yields(material: Elastic) -> bool:
    """Whether ``material`` is an elastomer without a stated strength."""
    return yield_pressure(material.strength).value is None and material.poisson_ratio >= LEAST_OF_ELASTOMERS


def unknown_strengths(body: Body) -> tuple[str, ...]:
    """What keeps the hardness of the layered ``body`` with its base from being known by depth: names of materials of unknown strength, a rigid base."""
    parts = materials_of(body)
    unknown = [part.name or "a material" for part in parts if yield_pressure(part.strength).value is None]
    rigid = isinstance(body, Layered) and isinstance(body.reduced.base, RigidBase)
    return (*dict.fromkeys(unknown), *(["the rigid base"] if rigid else []))


@dataclass(frozen=True)
class SurfaceStrength:
    """Contact pressure at which a body of a contact yields plastically at its surface.

    Attributes
    ----------
    body
        Which of the two bodies of the problem it is.
    material
        Name of the material at its surface, of a coated body that of its top layer; ``"the body"`` or ``"the counter body"`` without a name.
    pressure
        Hardness, else 2.8 Y (Tabor 1951), in Pa; None where neither hardness nor yield stress is known.
    known_as
        How it is known, such as ``"H of DLC"`` or ``"2.8 Y of stainless steel"``; empty where it is not.
    """

    body: Literal["body", "counter_body"]
    material: str
    pressure: float | None
    known_as: str

    @property
    def by_hardness(self) -> bool:
        """Whether it is a stated hardness."""
        return self.known_as.startswith("H ")


def strength_of(body: Body, counter_body: Body) -> tuple[SurfaceStrength, ...]:
    """Strength of the surfaces of two bodies in contact, those left out that never yield: rigid ones and elastomers without a known strength."""
    found = (_surface("body", body), _surface("counter_body", counter_body))
    return tuple(strength for strength in found if strength is not None)


def _surface(which: Literal["body", "counter_body"], body: Body) -> SurfaceStrength | None:
    solid = surface_material(body)
    if solid is None or never_yields(solid):
        return None
    found, name = yield_pressure(solid.strength), solid.name or body.name or f"the {which.replace('_', ' ')}"
    return SurfaceStrength(which, name, found.value, f"{found.symbol} of {name}" if found.symbol else "")


def plastic_solid(material: Elastic) -> J2:
    """The elastic-plastic solid of ``material``: its hardening, or perfect plasticity at its yield stress, with its back stress.

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
            f"material of a plastic solid must be elastic until it yields, but {material.name or 'it'} is viscoelastic. Give Elastic(E, nu)."
        )
    stress, strength = flow_stress(material.strength), material.strength
    if math.isnan(stress.value):
        raise InputError(
            f"yield stress of {material.name or 'the material'} must be known for plastic flow, but neither it nor a hardness is. "
            "Give it, as {yield_stress}.",
            subject=f"yield stress of {material.name or 'the material'}",
        )
    hardening = strength.hardening or LinearHardening(stress.value)
    plain = Elastic(material.youngs_modulus, material.poisson_ratio)
    return J2(plain, hardening, strength.kinematic, strength.recall)


def plastic_parts(body: Body, *, unknown_is_elastic: bool = False) -> tuple[PlasticPart, ...]:
    """Solid of each layer of ``body`` from the surface down, and of the base last; a rigid base is left out.

    Parameters
    ----------
    body
        Homogeneous or layered.
    unknown_is_elastic
        Whether a material of unknown yield stress and hardness stays elastic at any stress, instead of being refused.

    Raises
    ------
    InputError
        If a yield stress is needed and not known.
    """
    return tuple(
        material if unknown_is_elastic and math.isnan(flow_stress(material.strength).value) else plastic_solid(material)
        for material in materials_of(body)
    )
