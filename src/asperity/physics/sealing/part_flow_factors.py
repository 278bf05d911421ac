"""Flow factors: what the roughness of the surface adds to or takes from the flow in a film, as a
table for codes of mixed lubrication."""

from __future__ import annotations

from typing import Annotated

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Choice, Number, Whole
from ...parts.part import Part
from .part import Way

Ratio = Annotated[float, Number(above=0.0, most=100.0)]
Overlapping = Annotated[str, Choice({name: name for name in ("deformed", "cut")})]


class FlowFactorsSettings(Settings):
    """Flow factors φ and φ_s of Patir and Cheng for the surface of the document against the
    separation H of the mean planes over its rms height σ.

    Where summits touch, they are ``deformed`` by the contact, or ``cut`` off. With several
    ``realisations`` the table holds means over the surface and others that have its power spectrum
    and random phases.
    """

    least: Ratio = setting(1.0, option="--least-separation", help="Smallest H/σ of the table")
    largest: Ratio = setting(6.0, option="--largest-separation", help="Largest H/σ of the table")
    points: Annotated[int, Whole(1, 200)] = setting(11, option="--separations", help="Number of H/σ in the table")
    realisations: Annotated[int, Whole(1, 100)] = setting(
        1, option="--flow-realisations", help="Surfaces that are averaged, the others with its spectrum"
    )
    direction: Way = setting("x", option="--flow-direction", help="Of sliding, and of the flow along it: x or y")
    overlap: Overlapping = setting(
        "deformed", option="--flow-overlap", help="Of summits that touch: deformed by the contact, or cut off"
    )

    @model_validator(mode="after")
    def _whole(self) -> FlowFactorsSettings:
        if self.points > 1 and self.largest <= self.least:
            raise InputError(
                f".largest must be above the smallest separation, {self.least:g}, but is {self.largest:g}; or ask for "
                "one ({flow_factors.points=1})."
            )
        return self


AXIS = "separation"
SCALARS = (
    Quantity("flow_separation_ratio", "1", "mean gap of the contact / rms height σ"),
    Quantity("pressure_factor_along", "1", "pressure flow factor of the contact along the direction"),
    Quantity("pressure_factor_across", "1", "pressure flow factor of the contact across it"),
    Quantity("shear_factor", "1", "shear flow factor of the contact"),
    Quantity("flow_roughness", "m", "rms height σ of the composite surface"),
)
"""Numbers of the contact that the document asks for."""

TABLE = (
    Quantity("factors_separation_ratio", "1", "separation of the mean planes / rms height, H/σ", (AXIS,)),
    Quantity("factors_pressure_along", "1", "pressure flow factor along the direction, φ_x", (AXIS,)),
    Quantity("factors_pressure_across", "1", "pressure flow factor across it, φ_y", (AXIS,)),
    Quantity("factors_pressure_oblique", "1", "off-diagonal pressure flow factor, φ_xy", (AXIS,)),
    Quantity("factors_shear", "1", "shear flow factor of the rough body along the direction, φ_s", (AXIS,)),
    Quantity("factors_contact_fraction", "1", "real contact area / nominal area (pixels)", (AXIS,)),
    Quantity("factors_mean_gap_ratio", "1", "mean gap / rms height, h_T/σ", (AXIS,)),
    Quantity("factors_mean_pressure", "Pa", "mean contact pressure; NaN where summits are cut off", (AXIS,)),
    Quantity("factors_pressure_along_error", "1", "standard error of φ_x over the realisations", (AXIS,)),
    Quantity("factors_pressure_across_error", "1", "standard error of φ_y over the realisations", (AXIS,)),
    Quantity("factors_shear_error", "1", "standard error of φ_s over the realisations", (AXIS,)),
    Quantity("factors_fitted_pressure", "1", "φ by the isotropic fit of Patir and Cheng; NaN below H/σ = 0.5", (AXIS,)),
    Quantity("factors_fitted_shear", "1", "φ_s by their isotropic fit; NaN below H/σ = 0.5", (AXIS,)),
)
"""Columns of the table."""


class FlowFactors(Part):
    """What roughness does to the flow in a film, against the separation."""

    name = "flow_factors"
    title = "Flow factors"
    purpose = "How the roughness helps or hinders a lubricant that flows between the surfaces."
    table = "flow_factors"
    settings = FlowFactorsSettings
    basic = ("least", "largest")
    quantities = (*SCALARS, *TABLE)
    work = "physics.sealing.work_flow_factors:FlowFactorsWork"
    headline = "pressure_factor_along"
    sheet = ("flow_factors.csv", AXIS)
