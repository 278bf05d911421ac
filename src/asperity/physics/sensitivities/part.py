"""Sensitivities: which parameter decides a number of the contact, and which asperities."""

from __future__ import annotations

from typing import Annotated

from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Choice, Number, Several, StepOfPath, Text
from ...parts.part import Part

OUTPUTS = {
    "approach": ("m", "approach"),
    "mean_gap": ("m", "mean gap"),
    "elastic_energy": ("J", "elastic energy"),
    "peak_pressure": ("Pa", "peak pressure"),
    "area": ("m**2", "real contact area"),
    "stiffness": ("N/m", "normal stiffness"),
    "electrical_conductance": ("S", "electrical conductance"),
    "thermal_conductance": ("W/K", "thermal conductance"),
    "yield": ("N", "load at first yield"),
}
"""Numbers whose sensitivities a document asks for, with unit and words."""

SHARES = {
    "load": "load",
    "heights": "rms height",
    "thickness": "thickness of the first layer",
    "modulus": "Young's modulus of the first layer",
    "base_modulus": "Young's modulus of the base",
    "counter_modulus": "Young's modulus of the counter body",
}
"""Parameters that every body has by these names, for studies."""

Outputs = Annotated[tuple[str, ...], Several(Choice({name: name for name in OUTPUTS}))]
Names = Annotated[tuple[str, ...], Several(Text())]
Exponent = Annotated[float, Number(least=1.0)]


class SensitivitySettings(Settings):
    """How much numbers of the contact change with each modulus, Poisson's ratio, thickness, with
    load, hardness and heights, in percent per percent.

    ``of`` are the numbers: approach, mean_gap, elastic_energy, peak_pressure, area, stiffness,
    electrical_conductance, thermal_conductance, and yield for the load at which the first layer of
    known strength yields. ``to`` are the parameters: all, or names such as
    body.layers[0].thickness. The peak pressure is a norm with the ``exponent``.
    """

    of: Outputs = setting(
        ("approach", "peak_pressure"),
        option="--sensitivities-of",
        help="Numbers whose sensitivities are computed: approach,area,stiffness,yield",
    )
    to: Names = setting(
        ("all",), option="--sensitivities-to", help="Parameters: all; body.layers[0].thickness,force,heights"
    )
    exponent: Exponent = setting(16.0, option="--peak-exponent", help="Of the norm for a peak pressure: 8 to 32")
    step: StepOfPath = setting(
        "peak", option="--sensitivities-step", help="Of a load path: peak for the largest load, last, or its number"
    )


QUANTITIES = (
    Quantity("sensitivity_parameter", "", "parameter of the sensitivities", ("parameter",)),
    Quantity("sensitivity_value", "1", "value of the parameter in SI units", ("parameter",)),
    *(
        item
        for name, (unit, label) in OUTPUTS.items()
        for item in (
            Quantity(f"sensitive_{name}", unit, f"{label} whose sensitivities are found"),
            Quantity(f"sensitivity_{name}", "1", f"relative sensitivity of the {label}", ("parameter",)),
            *(
                Quantity(f"sensitivity_{name}_{key}", "1", f"relative sensitivity of the {label} to the {text}")
                for key, text in SHARES.items()
            ),
        )
    ),
    Quantity("sensitivity_map", "1/m", "relative sensitivity of the first number to each height", ("x", "y")),
)


class Sensitivities(Part):
    """Sensitivities of numbers of the contact to all parameters."""

    name = "sensitivities"
    title = "Sensitivities"
    purpose = "Which modulus, thickness, load or asperity decides a number of the contact."
    table = "sensitivities"
    settings = SensitivitySettings
    quantities = QUANTITIES
    work = "physics.sensitivities.work:SensitivitiesWork"
    whole_path = True
    basic = ("of",)
