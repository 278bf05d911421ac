"""Area of a bi-sinusoidal wave between its limits of light load and full contact, as in the
lectures of Yastrebov (2016)."""

from __future__ import annotations

import numpy as np
from page import Claim, Page, Published, Table, write_page

import asperity as asp
from asperity.theories import CrossedWaves
from asperity.theories.single.waves import AREA_ERROR

LIGHT, FULL = (0.001, 0.002), (0.97, 0.98, 0.99)
LOADS = (0.01, 0.05, 0.2, 0.4, 0.6, 0.8, 0.95)
"""p̄/p* of the limits and between them."""

WAVES = CrossedWaves(E_star=1.0, amplitude=1e-3, wavelength=1.0)
BODY = asp.Elastic(1.0 - 0.3**2, 0.3)
OFFSET = (0.37, 0.11)
"""Where the crest lies between the pixels, in pixels: off every symmetry of the grid."""

ABOUT = (
    "Yastrebov (2016, after Johnson, Greenwood & Higginson 1985): the wave Δ(2 − cos 2πx/λ − cos 2πy/λ) on a "
    "flat. The lectures print the areas of light load, π (3p̄/8πp*)^⅔, and of nearly full contact, 1 − "
    "(3/2π)(1 − p̄/p*), and show numerical results between them as points of a figure. Theirs: the two "
    "printed formulas where they hold. Ours: `asperity.solve` on one period, areas by the place of the edges "
    "between pixels, and the curve of the catalogue (`CrossedWaves.area_fraction`), which was tabulated from "
    "seven grids of 160² to 256² points with a stated error of {error:g}. No parameter is chosen."
)

WORDS = """* Both limits are those of the solver. The first loses 3 % at p̄/p* = 0.01 and a quarter at 0.2,
  where the separate contacts are about to join; the second holds within 1 % from 0.8 on.
* The contacts of neighbouring crests join at p̄/p* between 0.22 and 0.24, at an area of 0.4; the curve is
  steepest there."""


def page(points: int = 200) -> Page:
    """The page, from grids of ``points`` x ``points``."""
    full = WAVES.full_contact_pressure
    found = dict(zip((*LIGHT, *LOADS, *FULL), _areas(points, (*LIGHT, *LOADS, *FULL)), strict=True))
    rows, off = [], []
    for share, area in found.items():
        curve = float(WAVES.area_fraction(share * full))
        off.append(abs(curve - area))
        limits = (WAVES.area_fraction_at_low_load(share * full), WAVES.area_fraction_at_high_load(share * full))
        rows.append((f"{share:g}", *(f"{float(value):.4f}" for value in (limits[0], limits[1], curve, area))))
    head = ("p̄/p*", "light load", "full contact", "curve of the catalogue", "solver")
    source = "Yastrebov 2016, Westergaard's problem in 3-D"
    numbers = [
        Published(source, f"area of light load at p̄/p* = {share:g}", f"{_light(share):.5f}", found[share], 0.02)
        for share in LIGHT
    ]
    numbers += [
        Published(
            source, f"area of nearly full contact at p̄/p* = {share:g}", f"{_full(share):.4f}", found[share], 0.002
        )
        for share in FULL
    ]
    return Page(
        "A bi-sinusoidal wave from light load to full contact",
        ABOUT.format(error=AREA_ERROR),
        (Table(f"Area fraction, {points} × {points} points:", head, tuple(rows)), WORDS),
        (
            Claim("largest difference of curve and solver", max(off), high=2.0 * AREA_ERROR),
            Claim("numbers of the printed limits that agree", sum(one.kept for one in numbers), 5, 5),
        ),
        tuple(numbers),
    )


def _light(share: float) -> float:
    return float(WAVES.area_fraction_at_low_load(share * WAVES.full_contact_pressure))


def _full(share: float) -> float:
    return float(WAVES.area_fraction_at_high_load(share * WAVES.full_contact_pressure))


def _areas(points: int, shares: tuple[float, ...]) -> list[float]:
    """Area fractions under shares of the pressure of full contact."""
    x, y = (2.0 * np.pi * (np.arange(points) + offset) / points for offset in OFFSET)
    heights = WAVES.amplitude * (np.cos(x)[:, None] + np.cos(y)[None, :] - 2.0)
    problem = asp.ContactProblem(asp.Surface(heights, 1.0 / points, 1.0 / points), BODY)
    operator = asp.solvers.prepare_operator(problem.compliance, problem.grid, problem.boundary)
    loads = [asp.MeanPressure(share * WAVES.full_contact_pressure) for share in shares]
    keep = asp.Keep(stiffness=False)
    return [asp.solve(problem, load, operator=operator, keep=keep).area_fraction_corrected for load in loads]


if __name__ == "__main__":
    write_page(page(), __file__)
