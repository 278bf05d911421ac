"""Statistical meniscus force against film thickness, for summits of several heights, radii and
numbers: fig. 37 of Bhushan (1998)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from bhushan import MODULUS, WATER, WATER_ANGLE
from page import Claim, Page, Table, write_page

from asperity.theories.rough.greenwood_williamson import GreenwoodWilliamson
from asperity.theories.wet.summits import StatisticalMeniscus

LOAD = 100e3
"""Pa; a slider of 1 mm² and 0.1 N."""

MONOLAYER = 0.28e-9
"""Thickness in m of a layer of water, below which there is no meniscus."""

FILMS = (0.2e-9, 0.5e-9, 1e-9, 2e-9, 4e-9, 8e-9, 16e-9, 32e-9)


@dataclass(frozen=True)
class Summits:
    """Standard deviation of heights and radius in m, and summits per area in 1/m²."""

    deviation: float = 4e-9
    radius: float = 10e-6
    density: float = 1e10

    def curve(self, films: Sequence[float] = FILMS) -> np.ndarray:
        """Meniscus force over load at every film thickness in m."""
        contact = GreenwoodWilliamson(MODULUS, self.density, self.radius, self.deviation)
        made = [StatisticalMeniscus(contact, WATER, h, WATER_ANGLE, MONOLAYER) for h in films]
        return np.array([float(one.at_pressure(LOAD).meniscus_pressure[0]) / LOAD for one in made])

    @property
    def largest(self) -> float:
        """Fₘₐₓ/W, every summit in the film (eq. 58)."""
        return 2.0 * math.pi * self.radius * WATER * (1.0 + math.cos(WATER_ANGLE)) * self.density / LOAD


BASE = Summits()
VARIANTS = {
    "σₚ = 2 nm": replace(BASE, deviation=2e-9),
    "σₚ = 4 nm, Rₚ = 10 µm, η = 0.01/µm²": BASE,
    "σₚ = 8 nm": replace(BASE, deviation=8e-9),
    "Rₚ = 5 µm": replace(BASE, radius=5e-6),
    "Rₚ = 20 µm": replace(BASE, radius=20e-6),
    "η = 0.005/µm²": replace(BASE, density=0.5e10),
    "η = 0.02/µm²": replace(BASE, density=2e10),
}

ABOUT = (
    "Bhushan (1998, fig. 37, after Gao, Tian & Bhushan 1995): Gaussian summits of a head-disk interface "
    "against a film of water, eqs 56 to 58. The text gives neither the numbers of the summits nor the load; "
    "ours are of the order of textured disks: E* = 100 GPa, γ = 73 mN/m, θ = 60°, 100 kPa, no meniscus below "
    "a layer of 0.28 nm. Fₘ/W, each row with one parameter changed."
)

WORDS = """* As published, the force grows with the thickness of the film, falls with the standard deviation
  of the summit heights, and grows with their radius and number. For thick films it tends to Fₘₐₓ (eq. 58),
  whatever the distribution of heights.
* The same surfaces that the map model takes are compared with it on the page on [film thickness and
  roughness](bhushan_film.md)."""


def compare() -> Page:
    """The curves of all variants."""
    curves = {name: summits.curve() for name, summits in VARIANTS.items()}
    head = ("film (nm)", *curves)
    rows = [(f"{1e9 * h:g}", *(f"{curve[i]:.3g}" for curve in curves.values())) for i, h in enumerate(FILMS)]
    rows.append(("Fₘₐₓ/W", *(f"{summits.largest:.3g}" for summits in VARIANTS.values())))
    table = Table("", head, tuple(rows))
    return Page("Statistical meniscus force of summits in a film", ABOUT, (table, WORDS), _claims(curves))


def _claims(curves: dict[str, np.ndarray]) -> tuple[Claim, ...]:
    # beyond 8 nm the first curves are at their end
    sharp, base, rough, small, large, few, many = (curve[1:6] for curve in curves.values())
    thickest = [curve[-1] / summits.largest for curve, summits in zip(curves.values(), VARIANTS.values(), strict=True)]
    return (
        Claim("largest force of less than a layer", max(float(curve[0]) for curve in curves.values()), 0.0, 0.0),
        Claim(
            "smallest growth from one film to the next, up to 8 nm",
            min(float(np.diff(curve[1:6]).min()) for curve in curves.values()),
            0.0,
        ),
        Claim(
            "largest force over that of half the deviation, up to 8 nm",
            float(max((base / sharp).max(), (rough / base).max())),
            0.0,
            1.0,
        ),
        Claim(
            "smallest force over that of half the radius", float(min((base / small).min(), (large / base).min())), 1.0
        ),
        Claim("smallest force over that of half the number", float(min((base / few).min(), (many / base).min())), 1.0),
        Claim("force of the thickest film over the largest there can be, smallest", float(min(thickest)), 0.98, 1.0),
    )


if __name__ == "__main__":
    write_page(compare(), __file__)
