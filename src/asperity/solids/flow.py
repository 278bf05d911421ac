"""Which regions of a layered body flow, and by which law: layers from the surface down, then the
base."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from ..core.errors import InputError
from .elastic import Elastic, Hardening
from .layers import Layered, materials_of
from .plasticity import J2
from .strength import plastic_parts

Flow: TypeAlias = Hardening | J2 | None
"""How one material flows: its hardening, a whole J2 law (for back stress), or None where it stays
elastic."""


class OfStrength:
    """Stands for the laws that follow from the strengths of the materials."""

    def __repr__(self) -> str:
        return "from the strengths of the materials"


Plasticity: TypeAlias = Flow | Sequence[Flow] | OfStrength
"""One law for all regions, one for each layer from the surface down and one for the base, or those
of the strengths."""

OF_STRENGTH = OfStrength()
"""Yield stress and hardening of each material; it stays elastic where its yield stress is not
known."""


def regions_of(body: Elastic | Layered) -> tuple[Elastic, ...]:
    """Materials of the regions of the reduced ``body`` from the surface down; a rigid base is
    none."""
    return materials_of(body)


def flow_of(body: Elastic | Layered, plasticity: Plasticity = OF_STRENGTH) -> tuple[Elastic | J2, ...]:
    """Law of every region of ``body`` from the surface down: a ``J2`` where it may flow, else its
    ``Elastic``.

    Raises
    ------
    InputError
        If the number of laws is not that of the regions, an entry is no law, or a J2 law has other
        elastic constants.
    """
    if isinstance(plasticity, OfStrength):
        return plastic_parts(body, unknown_is_elastic=True)
    materials = regions_of(body)
    given = list(plasticity) if isinstance(plasticity, Sequence) else [plasticity] * len(materials)
    if len(given) != len(materials):
        raise InputError(
            f"plasticity must be one law for each of the {len(materials)} regions of the body, but is "
            f"{len(given)} laws. Give the layers from the surface down, then the base; None stays elastic."
        )
    laws: list[Elastic | J2] = []
    for material, flow in zip(materials, given, strict=True):
        if isinstance(flow, J2):
            same = (flow.elastic.youngs_modulus, flow.elastic.poisson_ratio)
            if same != (material.youngs_modulus, material.poisson_ratio):
                raise InputError(
                    "plasticity must be laws with the elastic constants of their region, but is E = "
                    f"{same[0]:g} Pa, nu = {same[1]:g} in a region with E = {material.youngs_modulus:g} Pa, nu "
                    f"= {material.poisson_ratio:g}. Give the hardening alone, or the same constants."
                )
            laws.append(flow)
        elif flow is None:
            laws.append(material)
        elif isinstance(flow, Hardening):
            laws.append(J2(material, flow))
        else:
            raise InputError(
                f"plasticity must be laws of hardening, J2 laws or None, but is {flow!r}. Write "
                "LinearHardening(Y), Swift(…), Voce(…) or J2(…)."
            )
    return tuple(laws)
