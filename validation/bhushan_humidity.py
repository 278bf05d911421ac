"""Meniscus force against the humidity of the air: fig. 40a of Bhushan (1998)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from bhushan import LOAD, WATER_ANGLE, Interface, column, grid, shown, spectrum
from page import Claim, Page, Published, Table, write_page

import asperity as asp
from asperity.theories.wet.meniscus import kelvin_radius

RMS = 2e-9
FLOODS = 0.9
"""Humidity up to which the force rises; beyond it liquid fills the area."""

HUMIDITIES = (0.1, 0.3, 0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.95)

ABOUT = (
    "Bhushan (1998, fig. 40a, after Tian & Bhushan 1996): a glass-ceramic disk against a smooth surface. The "
    "text gives the model – Kelvin radius (eq. 66), film adsorbed on carbon (eq. 67) – and the trend, but no "
    "roughness, load or contact angle. Ours in character: σ = {rms:g} nm, β* = 0.5 µm, E* = 100 GPa, {load:g} "
    "MPa, θ = 60° on both surfaces, {count} surfaces, mean ± standard deviation of Fₘ/W."
)

WORDS = """* The force rises with the humidity, slowly at first and steeply above 70 %, as published, where
  the film grows from 0.03 to 0.34 nm and the menisci from 0.2 to 5 nm.
* At 95 % the menisci, 10 nm high, fill the whole area between such smooth surfaces, and the force falls with
  the suction. A rougher or wavy disk is flooded at a higher humidity; the text does not mention such a
  decrease.
* The rise is caused by the height of the menisci: the suction falls as its inverse, but the area within that
  height grows faster.
* Below 50 % the radius of the menisci is a few molecular diameters, and the film is thinner than a monolayer:
  numbers there are formal."""


def compare(count: int = 8, humidities: Sequence[float] = HUMIDITIES) -> Page:
    """Ours on ``count`` surfaces for rising relative ``humidities``."""
    water, angles = asp.liquid("water"), (WATER_ANGLE, WATER_ANGLE)
    faces = [Interface(asp.generate.gaussian(grid(), spectrum(RMS), seed=seed)) for seed in range(count)]
    rows, first, steady = [], [], []
    for humidity in humidities:
        film = asp.LiquidFilm.at_humidity(water, humidity, contact_angles=angles)
        found = [face.menisci(film) for face in faces]
        first.append(column(found, "first"))
        steady.append(column(found, "steady"))
        sizes = [f"{1e9 * size:.3g}" for size in (film.thickness, film.meniscus_height)]
        rows.append(
            (f"{100 * humidity:g} %", *sizes, f"{1e-6 * film.suction:.3g}", shown(first[-1]), shown(steady[-1]))
        )
    head = ("humidity", "film (nm)", "menisci (nm)", "suction (MPa)", "first pass", "steady")
    table = Table("", head, tuple(rows))
    about = ABOUT.format(rms=1e9 * RMS, load=1e-6 * LOAD, count=count)
    unit = kelvin_radius(math.exp(-1.0), water.surface_tension, water.molar_volume, water.temperature)
    printed = Published("Bhushan 1998, eq. 66", "γV/RT of water at 20 °C (nm)", "0.54", 1e9 * unit)
    claims = _claims(humidities, np.array(first), np.array(steady))
    return Page("Meniscus force against humidity", about, (table, WORDS), claims, (printed,))


def _claims(humidities: Sequence[float], first: np.ndarray, steady: np.ndarray) -> tuple[Claim, ...]:
    share, once, settled = np.array(humidities), first.mean(axis=1), steady.mean(axis=1)
    rising = (share >= 0.5) & (share <= FLOODS)
    growth = np.diff(np.log(settled[rising])) / np.diff(share[rising])
    flooded = float(settled[share > FLOODS][0] / settled[share == FLOODS][0])
    return (
        Claim(
            "smallest growth of the first pass from one humidity to the next, up to 90 %",
            float(np.diff(np.log(once[share <= FLOODS])).min()),
            0.0,
        ),
        Claim("smallest growth of the steady force per humidity, from 50 to 90 %", float(growth.min()), 0.0),
        Claim(
            "steepness of the last step up to 90 % over that of the first from 50 %", float(growth[-1] / growth[0]), 2.0
        ),
        Claim(
            "steady force at 90 % over that at 50 %", float(settled[share == FLOODS][0] / settled[share == 0.5][0]), 8.0
        ),
        Claim("steady force at 95 %, flooded, over that at 90 %", flooded, 0.5, 1.0),
    )


if __name__ == "__main__":
    write_page(compare(), __file__)
