"""The bodies that can take part in a contact, and their contact modulus."""

from __future__ import annotations

from typing import TypeAlias

from ..core.errors import InputError
from .elastic import Elastic, Rigid
from .layers import Layered

Body: TypeAlias = Elastic | Rigid | Layered
"""A body that can take part in a contact."""


def surface_material(body: Body) -> Elastic | None:
    """Material at the surface of ``body``: of its outermost layer where it is layered, None where it is rigid."""
    material = body.surface_material if isinstance(body, Layered) else body
    return material if isinstance(material, Elastic) else None


def materials_of(body: Body) -> tuple[Elastic, ...]:
    """Every elastic material in ``body`` that takes part, from the surface down."""
    if not isinstance(body, Layered):
        return (body,) if isinstance(body, Elastic) else ()
    reduced = body.reduced
    parts = (*(layer.material for layer in reduced.layers), reduced.base)
    return tuple(part for part in parts if isinstance(part, Elastic))


def deformable(body: Body, counter_body: Body) -> tuple[tuple[Elastic | Layered, float], ...]:
    """The bodies that deform, each with the sign of the tractions it carries: 1 for ``body``, -1 for ``counter_body``.

    Raises
    ------
    InputError
        If both are rigid.
    """
    found = tuple(
        (solid, sign)
        for solid, sign in ((body, 1.0), (counter_body, -1.0))
        if not isinstance(solid, Rigid) and materials_of(solid)
    )
    if not found:
        raise InputError("body and counter_body must not both be rigid; make at least one of them Elastic.")
    return found


def contact_modulus(body: Body, counter_body: Body) -> float:
    """Contact modulus E* in Pa, 1/E* = (1 - nu1²)/E1 + (1 - nu2²)/E2 (Johnson 1985, eq. 4.22), of the surface materials.

    For a layered body the material of the outermost layer counts: it governs contacts much smaller than that layer is
    thick. Larger contacts feel the layers below too; what they feel is in the compliance, not in this number.

    Raises
    ------
    InputError
        If both bodies are rigid.
    """
    solids = (surface_material(solid) for solid, _ in deformable(body, counter_body))
    return 1.0 / sum(1.0 / solid.plane_strain_modulus for solid in solids if solid is not None)
