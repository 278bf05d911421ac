"""Indentation: one indenter pressed into the body and taken off, by finite elements; hardness,
zones, residual stress, Oliver and Pharr's numbers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Choice, Length, NonNegative, Number, Whole
from ...parts.part import Part
from ..plastic_flow.part_quantities import quantities_of

if TYPE_CHECKING:
    pass

Shape = Annotated[str, Choice({name: name for name in ("sphere", "cone")})]
HalfAngle = Annotated[float, Number("angle", above=0.0, below=0.5 * math.pi)]
Inside = Annotated[str, Choice({name: name for name in ("body", "counter_body")})]


PREFIX = "indentation"


class IndentationSettings(Settings):
    """An indenter that goes into the body by ``depth`` and comes off again, beside the contact of
    the surfaces.

    ``radius`` is that of a sphere, taken as a paraboloid, by default the mean radius of the summits
    of the surface; ``half_angle`` that of a cone, by default the one of Berkovich's area, 70.3
    degrees. It is rigid, or with ``elastic_indenter`` of the material of the other body, which
    stays elastic. Layers and base flow at their yield stress with their hardening. The body is
    axisymmetric, and strains are small.
    """

    depth: Length | None = setting(None, option="--indent", help="Depth of an indentation by finite elements: 100nm")
    indenter: Shape = setting("sphere", option="--indenter", help="Sphere or cone")
    radius: Length | None = setting(
        None, option="--indenter-radius", help="Of a sphere: 10um; by default the mean radius of the summits"
    )
    half_angle: HalfAngle | None = setting(None, option="--indenter-angle", help="Of a cone, from its axis: 70.3deg")
    steps: Annotated[int, Whole(4, 500)] = setting(20, option="--indent-steps", help="Steps of the way in")
    unloading_steps: Annotated[int, Whole(6, 500)] = setting(
        12, option="--indent-unloading-steps", help="Steps of the way out"
    )
    elements: Annotated[int, Whole(4, 100)] = setting(
        20, option="--indent-elements", help="Elements across the largest contact radius"
    )
    friction: NonNegative = setting(0.0, option="--indent-friction", help="Coefficient under the indenter")
    elastic_indenter: bool = setting(
        False, option="--elastic-indenter", help="The indenter is of the material of the other body, and elastic"
    )
    inside: Inside = setting("body", option="--indent-in", help="body or counter_body")
    unknown_is_elastic: bool = setting(
        False,
        option="--unknown-elastic",
        help="Materials of unknown yield stress stay elastic, instead of being refused",
    )

    @model_validator(mode="after")
    def _whole(self) -> IndentationSettings:
        if self.depth is None:
            raise InputError(
                " must give the depth of the indentation, such as {indentation.depth=100 nm}, but does not."
            )
        other = {"sphere": "half_angle", "cone": "radius"}[self.indenter]
        if getattr(self, other) is not None:
            raise InputError(f" must give no {other} for a {self.indenter}, but does.")
        return self


SCALARS = (
    Quantity("indent_force", "N", "largest force of the indentation"),
    Quantity("indent_depth", "m", "largest approach of the indentation"),
    Quantity("indent_radius", "m", "radius of the indenter"),
    Quantity("indent_contact_radius", "m", "contact radius at the largest force"),
    Quantity("indent_hardness", "Pa", "force / true area, indentation"),
    Quantity("indent_hardness_ratio", "1", "that hardness / lowest yield stress of the body"),
    Quantity("indent_oliver_pharr_hardness", "Pa", "hardness by Oliver and Pharr"),
    Quantity("indent_oliver_pharr_modulus", "Pa", "reduced modulus by Oliver and Pharr"),
    Quantity("indent_unloading_stiffness", "N/m", "stiffness at the start of the unloading"),
    Quantity("indent_unloading_exponent", "1", "exponent of the fitted unloading"),
    Quantity("indent_pile_up", "1", "true area / area of Oliver and Pharr"),
    Quantity("indent_residual_depth", "m", "depth at which the unloading ends"),
    Quantity("indent_work", "J", "work of the loading"),
    Quantity("indent_dissipated_work", "J", "work that the indentation keeps"),
    Quantity("indent_plastic_strain", "1", "largest accumulated plastic strain"),
    Quantity("indent_plastic_depth", "m", "depth of the plastic zone"),
    Quantity("indent_surface_tension", "Pa", "largest radial tension at the surface under load"),
    Quantity("indent_layer_tension", "Pa", "largest radial tension at the bottom of a layer under load"),
    Quantity("indent_interface_shear", "Pa", "largest shear of an interface under load"),
    Quantity("indent_interface_peel", "Pa", "largest peel stress of an interface under load"),
    Quantity("indent_residual_surface_tension", "Pa", "largest residual radial tension at the surface"),
    Quantity("indent_residual_layer_tension", "Pa", "largest residual radial tension at the bottom of a layer"),
    Quantity("indent_residual_interface_shear", "Pa", "largest residual shear of an interface"),
    Quantity("indent_residual_interface_peel", "Pa", "largest residual peel stress of an interface"),
)
"""Numbers of an indentation; NaN where there is no layer, or an unloading cannot be fitted."""


class Indentation(Part):
    """An indenter in the body, by finite elements."""

    name = "indentation"
    title = "Indentation"
    purpose = "What force an indenter takes to go into the body, and what it leaves behind."
    table = "indentation"
    settings = IndentationSettings
    work = "physics.indentation.work:IndentationWork"
    quantities = (*SCALARS, *quantities_of(PREFIX))
