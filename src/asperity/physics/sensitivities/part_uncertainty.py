"""Uncertainty: error bars of numbers of the contact, and what they come from."""

from __future__ import annotations

from typing import Annotated

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Choice, NonNegativeLength, Number, Several, StepOfPath, Whole
from ...parts.part import Part
from .part import OUTPUTS

ASKED = OUTPUTS | {"yield": ("1", "load factor of first yield")}
"""Numbers that have error bars, with unit and words."""

SCATTERS = ("moduli", "poisson_ratios", "thicknesses", "hardness", "load", "height_scale")
"""Keys of relative scatters that all numbers have."""

Outputs = Annotated[tuple[str, ...], Several(Choice({name: name for name in ASKED}))]
Share = Annotated[float, Number(least=0.0, most=1.0)]
Samples = Annotated[int, Whole(0, 100_000)]
Seed = Annotated[int, Whole(0)]


class UncertaintySettings(Settings):
    """Error bars of numbers of the contact from relative standard deviations: of each Young's
    modulus (``moduli``), Poisson's ratio, thickness, of hardness, load and the scale of heights,
    all independent; and from ``noise`` of the heights, white or correlated over ``noise_length``.
    The load at first yield over the load (``yield``) has also the scatter of the ``strengths``.

    By the sensitivities; with ``samples`` also by solves with drawn parameters, which show what is
    not linear.
    """

    of: Outputs = setting(("approach",), option="--uncertainty-of", help="Numbers with error bars: approach,area")
    moduli: Share = setting(0.0, option="--scatter-moduli", help="Relative deviation of each Young's modulus: 0.05")
    poisson_ratios: Share = setting(0.0, option="--scatter-poisson", help="Of each Poisson's ratio: 0.05")
    thicknesses: Share = setting(0.0, option="--scatter-thickness", help="Of each thickness: 0.1")
    hardness: Share = setting(0.0, option="--scatter-hardness", help="Of the hardness: 0.1")
    strengths: Share = setting(0.0, option="--scatter-strength", help="Of the strength of the layer that yields: 0.1")
    load: Share = setting(0.0, option="--scatter-load", help="Of the load: 0.02")
    height_scale: Share = setting(0.0, option="--scatter-heights", help="Of the calibration of heights: 0.01")
    noise: NonNegativeLength = setting("0 nm", option="--height-noise", help="Rms of the noise of heights: 0.3nm")
    noise_length: NonNegativeLength = setting(
        "0 nm", option="--height-noise-length", help="Correlation length of the noise; 0 for white noise"
    )
    samples: Samples = setting(0, option="--uncertainty-samples", help="Contacts solved with drawn parameters: 50")
    seed: Seed = setting(0, option="--uncertainty-seed", help="Of the samples")
    step: StepOfPath = setting(
        "peak", option="--uncertainty-step", help="Of a load path: peak for the largest load, last, or its number"
    )

    @model_validator(mode="after")
    def _some(self) -> UncertaintySettings:
        if self.strengths and "yield" not in self.of:
            raise InputError(".strengths must be left out unless {uncertainty.of=yield}, but is given.")
        given = self.noise or any(getattr(self, key) for key in SCATTERS)
        if not (given or (self.strengths and set(self.of) == {"yield"})):
            raise InputError(
                " must give a scatter or a noise, but gives none. Give the scatter of the moduli "
                "({uncertainty.moduli=0.05}) or the noise of the heights ({uncertainty.noise})."
            )
        return self


QUANTITIES = (
    Quantity("uncertainty_source", "", "source of the uncertainty", ("source",)),
    Quantity("uncertainty_yield_layer", "", "layer that may yield first", ("yielding_layer",)),
    Quantity("uncertainty_yield_factor", "1", "load factor at which the layer yields", ("yielding_layer",)),
    Quantity("uncertainty_yield_deviation", "1", "relative standard deviation of that factor", ("yielding_layer",)),
    *(
        item
        for name, (unit, label) in ASKED.items()
        for item in (
            Quantity(f"uncertainty_median_{name}", unit, f"{label} whose error bar is found"),
            Quantity(f"uncertainty_{name}", "1", f"relative standard deviation of the {label}"),
            Quantity(f"uncertainty_low_{name}", unit, f"lower end of 95 % of the {label}"),
            Quantity(f"uncertainty_high_{name}", unit, f"upper end of 95 % of the {label}"),
            Quantity(f"uncertainty_share_{name}", "1", f"share of the variance of the {label}", ("source",)),
            Quantity(f"uncertainty_bias_{name}", "1", f"relative change of the mean of the {label} in samples"),
            Quantity(f"uncertainty_bias_error_{name}", "1", f"standard error of the bias of the {label}"),
            Quantity(f"uncertainty_sampled_{name}", "1", f"relative standard deviation of the {label} in samples"),
        )
    ),
)


class Uncertainty(Part):
    """Error bars of numbers of the contact."""

    name = "uncertainty"
    title = "Uncertainty"
    purpose = "How sure a number of the contact is, and which input makes it unsure."
    table = "uncertainty"
    settings = UncertaintySettings
    quantities = QUANTITIES
    work = "physics.sensitivities.work_uncertainty:UncertaintyWork"
    whole_path = True
    basic = ("of", "moduli", "noise")
