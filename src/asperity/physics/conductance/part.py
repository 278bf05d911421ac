"""Conductance: current and heat through the contact."""

from __future__ import annotations

from typing import Annotated

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Choice, Length, Number, Temperature, ThermalConductivity, ThermalResistance, Voltage
from ...parts.part import Part

WORDS = ("known", "electrical", "thermal", "both")
"""What may be asked for."""

FLOWS = ("electrical", "thermal")

Which = Annotated[str, Choice({name: name for name in WORDS})]
ElectricalFilm = Annotated[float, Number("ohm*m^2", least=0.0)]
Emissivity = Annotated[float, Number(above=0.0, most=1.0)]


class ConductanceSettings(Settings):
    """Electrical and thermal conductance of the contact, by the conductivities of the materials;
    rigid bodies and rigid bases have one potential.

    In contact a thin film may have a ``film_resistance`` and a ``thermal_film_resistance``. Heat
    also crosses a gap that is filled (``gap_conductivity``, with the ``jump`` of a gas) or between
    walls of an ``emissivity``. Spots that are small against the ``mean_free_path`` of electrons
    resist more, and at a ``voltage`` between the bodies the hottest spot is hotter than they.
    """

    flow: Which = setting(
        "known",
        option="--conductance",
        help="electrical, thermal, both, or known: what the conductivities of all materials are known for",
    )
    film_resistance: ElectricalFilm = setting(
        "0 ohm*m^2",
        option="--film-resistance",
        help="Specific electrical resistance of a film in contact: 1e-12ohm*m^2",
    )
    thermal_film_resistance: ThermalResistance = setting(
        "0 m^2*K/W", option="--thermal-film", help="Specific thermal resistance of a film in contact: 1e-6m^2*K/W"
    )
    gap_conductivity: ThermalConductivity | None = setting(
        None, option="--gap-conductivity", help="Of heat, of what fills the gap: 0.026W/m/K for air"
    )
    jump: Length | None = setting(
        None, option="--temperature-jump", help="Length by which the walls of a gas widen the gap: 300nm for air"
    )
    emissivity: Emissivity | None = setting(
        None, option="--emissivity", help="Of both walls, for heat by radiation: 0.1"
    )
    temperature: Temperature = setting(
        "293.15 K", option="--ambient-temperature", help="Of the bodies, for radiation and the hottest spot: 300K"
    )
    mean_free_path: Length | None = setting(
        None, option="--mean-free-path", help="Of electrons, for spots that are not large against it: 40nm"
    )
    voltage: Voltage | None = setting(None, option="--voltage", help="Between the bodies, for the hottest spot: 20mV")

    @model_validator(mode="after")
    def _whole(self) -> ConductanceSettings:
        if self.jump is not None and self.gap_conductivity is None:
            raise InputError(
                ".jump must be given together with the {conductance.gap_conductivity} of the gas, but is given alone."
            )
        electrical = {
            "film_resistance": bool(self.film_resistance),
            "mean_free_path": self.mean_free_path,
            "voltage": self.voltage,
        }
        thermal = {
            "thermal_film_resistance": bool(self.thermal_film_resistance),
            "gap_conductivity": self.gap_conductivity,
            "emissivity": self.emissivity,
        }
        for flow, keys in (("thermal", electrical), ("electrical", thermal)):
            given = [key for key, value in keys.items() if value]
            if self.flow == flow and given:
                raise InputError(
                    f".{given[0]} must be left out for the flow {flow}, which it does not change, but is given. "
                    "Ask for {conductance.flow=both} too."
                )
        return self


_GRID = ("x", "y")
UNITS = {
    "electrical": ("ohm", "S", "S/m**2", "ohm*m**2"),
    "thermal": ("K/W", "W/K", "W/(m**2*K)", "m**2*K/W"),
}
"""Units of resistance, conductance, conductance per area and specific resistance."""


def _of(flow: str) -> tuple[Quantity, ...]:
    """Quantities of one ``flow``."""
    resistance, total, per_area, specific = UNITS[flow]
    return (
        Quantity(f"{flow}_resistance", resistance, f"{flow} contact resistance"),
        Quantity(f"{flow}_conductance", total, f"{flow} contact conductance"),
        Quantity(f"{flow}_conductance_per_area", per_area, f"{flow} contact conductance per nominal area"),
        Quantity(f"{flow}_lower_bound", per_area, f"lower bound of the {flow} conductance per area on this grid"),
        Quantity(f"{flow}_upper_bound", per_area, f"upper bound of the {flow} conductance per area on this grid"),
        Quantity(f"{flow}_pixel_error", "1", f"error of the {flow} conductance by the size of the pixels"),
        Quantity(
            f"{flow}_extrapolated_conductance", total, f"{flow} contact conductance freed of the size of the pixels"
        ),
        Quantity(f"{flow}_extrapolated_error", "1", f"error of the {flow} conductance freed of the size of the pixels"),
        Quantity(f"{flow}_layer_resistance", specific, f"specific {flow} resistance of all layers in uniform flow"),
        Quantity(f"{flow}_stiffness_conductance", total, f"{flow} conductance from the normal stiffness (Barber)"),
        Quantity(f"{flow}_half_spots", "1", f"number of spots that carry half of the {flow} flow"),
        Quantity(f"{flow}_density", per_area, f"{flow} flux density per unit drop", _GRID),
        Quantity(f"{flow}_drop", "1", f"share of the {flow} drop spent in bodies and film", _GRID),
        Quantity(f"path_{flow}_conductance_per_area", per_area, f"{flow} conductance per area at each step", ("step",)),
    )


QUANTITIES = (
    *(item for flow in FLOWS for item in _of(flow)),
    Quantity("ballistic_resistance", "ohm", "electrical resistance with ballistic small spots"),
    Quantity("hottest_spot", "K", "temperature of the hottest spot"),
    Quantity("thermal_gap_share", "1", "share of the heat that crosses the gap"),
)


class Conductance(Part):
    """Current and heat through the contact, with their bounds."""

    name = "conductance"
    title = "Conductance"
    purpose = "How much current and heat cross the contact, and what resistance they meet."
    table = "conductance"
    settings = ConductanceSettings
    quantities = QUANTITIES
    work = "physics.conductance.work:ConductanceWork"
    whole_path = True
    basic = ("flow",)
