"""Repeated passes: a cylinder or sphere that rolls or slides over the body, or is pressed in place
again and again, by finite elements; whether flow ceases."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Choice, Force, Length, NonNegative, Number, Pressure, Whole
from ...parts.part import Part
from ..plastic_flow.part_quantities import quantities_of

if TYPE_CHECKING:
    pass

Shape = Annotated[str, Choice({name: name for name in ("cylinder", "sphere")})]
Motion = Annotated[str, Choice({name: name for name in ("one way", "to and fro", "in place")})]
Given = Annotated[str, Choice({name: name for name in ("solved", "hertz")})]
LineLoad = Annotated[float, Number("N/m", above=0.0)]
Inside = Annotated[str, Choice({name: name for name in ("body", "counter_body")})]

PREFIX = "passes"


class PassesSettings(Settings):
    """Passes of a rigid cylinder (in plane strain) or sphere over the body, beside the contact of
    the surfaces.

    The load is one of ``force`` (sphere), ``line_load`` (cylinder) or ``peak_pressure``, that of
    Hertz's elastic contact with the base. With pressure "hertz" this pressure itself moves over the
    body, otherwise the contact is solved with the flow. All that touches slides with the
    ``friction``, by default the coefficient of [friction]. Layers and base flow at their yield
    stress with their hardening, and strains are small.
    """

    count: Annotated[int, Whole(1, 200)] | None = setting(
        None, option="--passes", help="Number of passes of a cylinder or sphere, by finite elements"
    )
    indenter: Shape = setting("cylinder", option="--pass-indenter", help="Cylinder or sphere")
    radius: Length | None = setting(
        None, option="--pass-radius", help="Of cylinder or sphere: 10um; by default the mean radius of the summits"
    )
    force: Force | None = setting(None, option="--pass-force", help="Load of a sphere: 1mN")
    line_load: LineLoad | None = setting(None, option="--pass-line-load", help="Load of a cylinder: 500N/m")
    peak_pressure: Pressure | None = setting(
        None, option="--pass-peak", help="Instead of a load: largest pressure of Hertz's contact with the base, 1GPa"
    )
    pressure: Given = setting(
        "solved", option="--pass-pressure", help="solved: of a rigid indenter; hertz: Hertz's pressure, given"
    )
    friction: NonNegative | None = setting(
        None, option="--pass-friction", help="Coefficient of the passes; by default that of the contact"
    )
    motion: Motion = setting("one way", option="--pass-motion", help="one way, to and fro, or in place")
    track: Length | None = setting(
        None,
        option="--pass-track",
        help="Length of a pass; by default 4 half-widths of a cylinder, 2 radii of a sphere",
    )
    steps: Annotated[int, Whole(4, 400)] = setting(16, option="--pass-steps", help="Steps of a pass along the track")
    elements: Annotated[int, Whole(4, 60)] | None = setting(
        None, option="--pass-elements", help="Elements across the contact radius; by default 8, under a sphere 4"
    )
    inside: Inside = setting("body", option="--pass-in", help="body or counter_body")
    unknown_is_elastic: bool = setting(
        False,
        option="--pass-unknown-elastic",
        help="Materials of unknown yield stress stay elastic, instead of being refused",
    )

    @model_validator(mode="after")
    def _whole(self) -> PassesSettings:
        if self.count is None:
            raise InputError(" must give the number of passes, such as {passes.count=3}, but does not.")
        loads = [name for name in ("force", "line_load", "peak_pressure") if getattr(self, name) is not None]
        own = {"sphere": "force", "cylinder": "line_load"}[self.indenter]
        if len(loads) != 1 or loads[0] not in (own, "peak_pressure"):
            raise InputError(
                f" must give either {own} or peak_pressure for a {self.indenter}, but gives "
                f"{' and '.join(loads) or 'neither'}."
            )
        if self.motion == "in place" and (self.track is not None or self.friction):
            raise InputError(" must give neither track nor friction where motion is in place, but does.")
        if self.indenter == "sphere" and (self.elements or 0) > MOST_UNDER_A_SPHERE:
            raise InputError(
                f".elements must be at most {MOST_UNDER_A_SPHERE} under a sphere, but is {self.elements}: the "
                "number of bricks grows with its cube."
            )
        return self


MOST_UNDER_A_SPHERE = 10

SCALARS = (
    Quantity("pass_line_load", "N/m", "load of the cylinder that passes"),
    Quantity("pass_force", "N", "load of the sphere that passes"),
    Quantity("pass_radius", "m", "radius of the cylinder or sphere that passes"),
    Quantity("pass_friction", "1", "friction coefficient of the passes"),
    Quantity("pass_hertz_pressure", "Pa", "largest pressure of Hertz's contact with the base, passes"),
    Quantity("pass_peak_pressure", "Pa", "largest pressure in the middle of the last pass"),
    Quantity("pass_contact_radius", "m", "half-width or radius of the contact in the last pass"),
    Quantity("pass_shakedown_share", "1", "Hertz's pressure / elastic shakedown limit at first yield"),
    Quantity("pass_line_dissipation", "J/m", "plastic work of the last pass per length of the cylinder"),
    Quantity("pass_dissipation", "J", "plastic work of the last pass of the sphere"),
    Quantity("pass_resistance", "1", "plastic work of the last pass / load and distance"),
    Quantity("pass_plastic_strain", "1", "largest accumulated plastic strain, passes"),
    Quantity("pass_layer_strain", "1", "largest accumulated plastic strain of a layer, passes"),
    Quantity("pass_base_strain", "1", "largest accumulated plastic strain of the base, passes"),
    Quantity("pass_strain_growth", "1", "growth of the accumulated plastic strain in the last pass"),
    Quantity("pass_growth_ratio", "1", "that growth / growth in the first pass"),
    Quantity("pass_onward_share", "1", "change of the plastic strain by the last pass / its growth"),
    Quantity("pass_forward", "m", "motion of the surface along the track in the last pass"),
    Quantity("pass_groove_depth", "m", "depth of the groove after the passes"),
    Quantity("pass_plastic_depth", "m", "depth of the plastic zone of the passes"),
    Quantity("pass_residual_compression", "Pa", "largest residual compression along the track"),
    Quantity("pass_residual_compression_depth", "m", "depth of that compression"),
    Quantity("pass_surface_tension", "Pa", "largest tension along the surface in a pass"),
    Quantity("pass_layer_tension", "Pa", "largest tension at the bottom of a layer in a pass"),
    Quantity("pass_interface_shear", "Pa", "largest shear of an interface in a pass"),
    Quantity("pass_interface_peel", "Pa", "largest peel stress of an interface in a pass"),
    Quantity("pass_residual_surface_tension", "Pa", "largest residual tension along the surface after the passes"),
    Quantity("pass_residual_layer_tension", "Pa", "largest residual tension at the bottom of a layer after the passes"),
    Quantity("pass_residual_interface_shear", "Pa", "largest residual shear of an interface after the passes"),
    Quantity("pass_residual_interface_peel", "Pa", "largest residual peel stress of an interface after the passes"),
)
"""Numbers of repeated passes, in the middle of the track; NaN where there is no such thing."""

EACH = (
    Quantity("passes_growth", "1", "growth of the accumulated plastic strain in each pass"),
    Quantity("passes_onward", "1", "change of the plastic strain by each pass"),
    Quantity("passes_dissipation", "1", "plastic work of each pass / that of the first"),
    Quantity("passes_forward", "m", "motion of the surface along the track in each pass"),
    Quantity("passes_groove", "m", "depth of the groove after each pass"),
)
"""Columns with one number for each pass."""

PROFILE = (
    Quantity("passes_profile_depth", "m", "depths of the residual stresses in the middle of the track"),
    Quantity("passes_residual_along", "Pa", "residual stress along the track against depth"),
    Quantity("passes_residual_across", "Pa", "residual stress across the track against depth"),
)
"""Columns of the residual stress below the middle of the track."""


@dataclass(frozen=True)
class Passing:
    """What is asked of the passes, and the friction coefficient of the contact."""

    settings: PassesSettings
    friction: float

    @property
    def coefficient(self) -> float:
        """That of the passes."""
        table = self.settings
        if table.motion == "in place":
            return 0.0
        return self.friction if table.friction is None else float(table.friction)


class Passes(Part):
    """A cylinder or sphere that passes over the body again and again, by finite elements."""

    name = "passes"
    title = "Repeated passes"
    purpose = "Whether a body that is passed over again and again shakes down or goes on yielding."
    table = "passes"
    settings = PassesSettings
    work = "physics.indentation.work_passes:PassesWork"
    quantities = (
        *SCALARS,
        *quantities_of(PREFIX),
        *(replace(item, dims=("passes_pass",)) for item in EACH),
        *(replace(item, dims=("passes_row",)) for item in PROFILE),
    )

    def asked(self, document: Any, folder: Path) -> Passing:
        """The table [passes] with the friction of the contact."""
        table: PassesSettings = document.passes
        friction = getattr(document, "friction", None)
        slides = friction is not None and friction.law == "coulomb"
        coefficient: Any = getattr(friction, "coefficient", None) if slides else None
        return Passing(table, float(coefficient or 0.0))
