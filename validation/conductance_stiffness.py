"""Conductance and stiffness of elastic self-affine contacts: both in proportion to the load, as
Akarapu, Sharp and Robbins found.

Published: h = k_s P/(E* u_0) with u_0 of 0.4 to 0.5 rms heights, whatever the Hurst exponent and
the resolution; and h/k_s is the stiffness over E* (Barber 2003).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from page import Claim, Page, Published, Stated, Table, statements, write_page

import asperity as asp
from asperity.solids import Conduction

SLOPE, K_S = 0.1, 1.0
LOADS = (0.005, 0.01, 0.02, 0.04)
"""Nominal pressure over E* and the rms gradient."""

CASES = ((0.3, 8.0), (0.5, 8.0), (0.8, 8.0), (0.8, 16.0))
"""Hurst exponent, and shortest wavelength in pixels."""

ABOUT = (
    "Akarapu, Sharp and Robbins (2011) pressed self-affine surfaces against each other and found conductance and "
    "stiffness in proportion to the load, k = P/u_0 with u_0 = γ h_rms and γ nearly the same for all surfaces, "
    "0.4 to 0.5, and h/k_s = k/E* between the two, as Barber (2003) proved. Here both are computed apart: the "
    "conductance as current on the solved contact, freed of the pixels, and the stiffness as the difference of two "
    "loads 2 % apart over that of their mean gaps. Nothing was chosen freely."
)

READING = (
    "u_0 over the rms height rises from the smallest loads, where few spots on the highest waves bear the load, to a "
    "level that hardly depends on Hurst exponent and resolution: conductance is governed by the long waves, unlike "
    "the area, which is by the short ones. The smallest loads scatter most from surface to surface, since so few long "
    "waves are on a map."
)


@dataclass(frozen=True)
class Case:
    """Surfaces of one kind: u_0/h_rms, and the conductance over that of the stiffness, (surfaces,
    loads)."""

    hurst: float
    shortest: float
    decay: np.ndarray
    identity: np.ndarray
    exponent: float


def solved(hurst: float, shortest: float, points: int, surfaces: int) -> Case:
    """The case on so many ``surfaces``, with a roll-off at a quarter of their side."""
    body = asp.Elastic(0.91, 0.3, conduction=Conduction(0.5 * K_S))
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(SLOPE),
        hurst=hurst,
        rolloff_wavelength=0.25 * points,
        shortest_wavelength=shortest,
    )
    grid = asp.Grid((points, points), (1.0, 1.0))
    decay, identity, conducts = [], [], []
    for seed in range(1, surfaces + 1):
        surface = asp.generate.gaussian(grid, spectrum, seed=seed)
        problem, rms = asp.ContactProblem(surface, body), float(surface.heights.std())
        row = []
        for load in LOADS:
            pressure = load * problem.contact_modulus * SLOPE
            found = asp.conductance.conductance(asp.solve(problem, asp.MeanPressure(pressure)), "thermal")
            less, more = (asp.solve(problem, asp.MeanPressure(share * pressure)) for share in (0.99, 1.01))
            stiffness = (more.mean_pressure - less.mean_pressure) / (less.mean_gap - more.mean_gap)
            h = found.extrapolated / found.area
            scale = K_S / problem.contact_modulus
            row.append((scale * pressure / (h * rms), found.per_area / (scale * stiffness), h))
        a, b, c = np.array(row).T
        decay.append(a)
        identity.append(b)
        conducts.append(c)
    exponent = float(np.polyfit(np.log(LOADS), np.log(np.mean(conducts, axis=0)), 1)[0])
    return Case(hurst, shortest, np.array(decay), np.array(identity), exponent)


def page(points: int = 512, surfaces: int = 4) -> Page:
    """The page, from so many surfaces of so many points per side."""
    cases = tuple(solved(hurst, shortest, points, surfaces) for hurst, shortest in CASES)
    rows = tuple(
        (
            f"{case.hurst:g}",
            f"{case.shortest:g}",
            *(
                f"{mean:.3f} ± {spread:.3f}"
                for mean, spread in zip(case.decay.mean(0), case.decay.std(0, ddof=1), strict=True)
            ),
            f"{case.exponent:.3f}",
            f"{np.abs(case.identity - 1.0).max():.1e}",
        )
        for case in cases
    )
    means = np.array([case.decay.mean(axis=0) for case in cases])
    exponents = np.array([case.exponent for case in cases])
    apart = float(np.max([np.abs(case.identity - 1.0).max() for case in cases]))
    level = float(means[:, 1:].mean())
    return Page(
        title="Conductance and stiffness of self-affine contacts",
        about=ABOUT,
        parts=(
            Table(
                f"u_0/h_rms at the nominal pressures over E* and rms gradient, mean and deviation of {surfaces} "
                f"surfaces of {points}² points; the exponent of the load; and the largest departure of conductance "
                "from stiffness:",
                ("Hurst exponent", "pixels per wave", *(f"{load:g}" for load in LOADS), "exponent", "identity"),
                rows,
            ),
            statements(
                "Stated in the article:",
                (
                    Stated(
                        "u_0 is 0.4 to 0.5 rms heights", f"{means.min():.2f} to {means.max():.2f}", 0.4 <= level <= 0.5
                    ),
                    Stated(
                        "conductance and stiffness go as the load",
                        f"exponents {exponents.min():.2f} to {exponents.max():.2f}",
                        bool(np.all(np.abs(exponents - 1.0) < 0.1)),
                    ),
                    Stated("h/k_s is the stiffness over E*", f"within {apart:.0e}", apart < 0.01),
                ),
            ),
            READING,
        ),
        claims=(
            Claim("u_0/h_rms, mean of all surfaces from the second load on", level, 0.42, 0.52),
            Claim("least and largest mean of a case: least", float(means.min()), low=0.36),
            Claim("least and largest mean of a case: largest", float(means.max()), high=0.56),
            Claim("least exponent of the load", float(exponents.min()), low=0.9),
            Claim("largest exponent of the load", float(exponents.max()), high=1.1),
            Claim("conductance over stiffness, largest departure from one", apart, high=0.01),
        ),
        published=(
            Published(
                "Akarapu, Sharp & Robbins 2011",
                "power of the load in the conductance, mean of all cases",
                "1",
                float(exponents.mean()),
                within=0.1,
            ),
            Published("Barber 2003", "h/k_s over k/E*, the farthest of all cases and loads", "1", 1.0 + apart),
        ),
    )


if __name__ == "__main__":
    write_page(page(), __file__)
