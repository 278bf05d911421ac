"""Conductance of plastic joints: rough surfaces that flow at their hardness, on a grid, beside the
theory of Cooper, Mikic and Yovanovich.

Published: h σ/(k_s m) as a function of P/H alone, 1.25 (P/H)^0.95, for Gaussian surfaces of the rms
height σ and the mean absolute slope m of profiles.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np
from page import Claim, Page, Published, Table, write_page

import asperity as asp
from asperity.solids import Conduction
from asperity.theories.conductance.joints import PlasticJoint

E_STAR, K_S = 1.0, 1.0
SHARES = (1e-3, 3e-3, 1e-2, 3e-2, 1e-1)
"""Nominal pressure over hardness."""

CASES = ((0.2, 0.002), (0.2, 0.01), (0.05, 0.002))
"""Rms slope of profiles and hardness over E*: the harder the surface against E* and slope, the more
of it stays elastic."""

ABOUT = (
    "Cooper, Mikic and Yovanovich (1969) let the summits of a Gaussian surface flow: each is a circle at the "
    "end of a tube of its own, and h σ/(k_s m) depends on P/H alone; Yovanovich (1982) writes it as "
    "1.25 (P/H)^0.95. Here Gaussian surfaces of one wavelength band are pressed with the hardness as a limit "
    "of the pressure, and the current problem is solved on their contacts, freed of the size of the pixels. "
    "Nothing was chosen freely. Measured joints are not on the page: no table of them could be read, only "
    "figures that are scaled by a hardness fitted to the joint."
)

READING = (
    "On the grid, too, one curve of P/H holds for every ratio of height to slope and every hardness, and the real "
    "area is P/H. The m of the theory is the mean absolute slope of profiles: with the rms slope, which is √(π/2) as "
    "large on Gaussian surfaces, it would be a quarter too high everywhere. At low pressure theory and grid agree to "
    "some per cent, by two differences that cancel, counted in the last table: a Gaussian surface has more spots, "
    "(2π)^(-3/2) Λ exp(-Λ²/2) times the square of the rms slope over σ at the level Λ, and their areas are "
    "distributed exponentially, so that the mean of √A is 0.886 of the root of the mean, while those of the theory "
    "have one radius. "
    "What is left, and grows with the area, is that spots come in groups and are ragged: they stand in each other's "
    "way more than at the ends of tubes of their own, by 20 % at P/H = 0.1."
)


@dataclass(frozen=True)
class Joint:
    """One case on several surfaces, (surfaces, shares): dimensionless conductances, real area
    fractions, errors by the pixels, and of the spots their number over that of the theory and the
    mean of √A over the root of the mean of A."""

    slope: float
    hardness: float
    scaled: np.ndarray
    area: np.ndarray
    error: np.ndarray
    number: np.ndarray
    unequal: np.ndarray


def surface(points: int, correlation: float, slope: float, seed: int) -> asp.Surface:
    """Gaussian surface with a Gaussian autocorrelation, lengths in pixels."""
    spectrum = asp.generate.GaussianAutocorrelation(
        rms_height=slope * correlation / math.sqrt(2.0), correlation_length=correlation
    )
    return asp.generate.gaussian(asp.Grid((points, points), (1.0, 1.0)), spectrum, seed=seed)


def solved(slope: float, hardness: float, points: int, correlation: float, surfaces: int) -> Joint:
    """The case on so many ``surfaces``."""
    body = asp.Elastic(0.91 * E_STAR, 0.3, conduction=Conduction(0.5 * K_S))
    rows = []
    for seed in range(surfaces):
        made = surface(points, correlation, slope, seed)
        heights = made.heights
        slopes = [np.abs(np.roll(heights, -1, axis) - heights).mean() for axis in (0, 1)]
        unit = K_S * float(np.mean(slopes)) / heights.std()
        problem = asp.ContactProblem(made, body, law=asp.Hardness(hardness))
        row = []
        for share in SHARES:
            result = asp.solve(problem, asp.MeanPressure(share * hardness))
            found = asp.conductance.conductance(result, "thermal")
            areas = found.spots.area
            theirs = math.exp(-(level(share) ** 2)) / (32.0 * share) * (unit / K_S) ** 2 * found.area
            scaled = found.extrapolated / found.area / unit
            sizes = float(np.sqrt(areas).mean() / math.sqrt(areas.mean()))
            row.append((scaled, result.area_fraction, found.extrapolated_error, areas.size / theirs, sizes))
        rows.append(row)
    return Joint(slope, hardness, *np.moveaxis(np.array(rows), -1, 0))


def level(share: float) -> float:
    """Λ: height over σ above which a Gaussian surface has that ``share`` of its area."""
    return -NormalDist().inv_cdf(share)


def theory() -> tuple[np.ndarray, np.ndarray]:
    """h σ/(k_s m) of the theory and of its correlation."""
    joint = PlasticJoint(1.0, 1.0, 1.0, 1.0)
    return joint.at_pressure(np.array(SHARES)).conductance, joint.correlation(SHARES)


def page(points: int = 1024, correlation: float = 12.0, surfaces: int = 4) -> Page:
    """The page, from so many surfaces of so many points per side."""
    joints = tuple(solved(slope, hardness, points, correlation, surfaces) for slope, hardness in CASES)
    exact, fitted = theory()
    every = np.concatenate([joint.scaled for joint in joints])
    mean, spread = every.mean(axis=0), every.std(axis=0, ddof=1)
    rows = tuple(
        (
            f"{share:g}",
            f"{exact[n]:.3e}",
            f"{fitted[n]:.3e}",
            *(f"{joint.scaled[:, n].mean():.3e}" for joint in joints),
            f"{mean[n] / exact[n]:.2f}",
            f"{100.0 * max(joint.error[:, n].mean() for joint in joints):.0f} %",
        )
        for n, share in enumerate(SHARES)
    )
    number, unequal = (
        np.mean([getattr(joint, name) for joint in joints], axis=(0, 1)) for name in ("number", "unequal")
    )
    counted = np.sqrt(number) * unequal
    spots = tuple(
        (f"{share:g}", *(f"{values[n]:.2f}" for values in (number, unequal, counted, mean / exact)))
        for n, share in enumerate(SHARES)
    )
    cases = tuple(f"rms slope {joint.slope:g}, H = {joint.hardness:g} E*" for joint in joints)
    return Page(
        title="Conductance of plastic joints",
        about=ABOUT,
        parts=(
            Table(
                f"h σ/(k_s m), means of {surfaces} surfaces of {points}² points; the last columns are ours over the "
                "theory, and the error by the pixels:",
                ("P/H", "theory", "correlation", *cases, "ratio", "pixels"),
                rows,
            ),
            Table(
                "Spots: their number over that of the theory, the mean of √A over the root of the mean of A, and the "
                "ratio of the conductances that follows from both, for spots that do not see each other:",
                ("P/H", "number", "sizes", "root of number times sizes", "ratio found"),
                spots,
            ),
            READING,
        ),
        claims=_claims(joints, mean, exact, float(counted[0])),
        published=tuple(
            Published(
                "Yovanovich 1982",
                f"h σ/(k_s m) at P/H = {SHARES[n]:g}",
                f"{fitted[n]:.3g}",
                float(mean[n]),
                within=0.1,
                spread=float(spread[n]),
                reason="spots come in groups and are ragged" if n else "",
            )
            for n in (0, 2, 4)
        ),
    )


def _claims(joints: tuple[Joint, ...], mean: np.ndarray, exact: np.ndarray, counted: float) -> tuple[Claim, ...]:
    of_cases = np.array([joint.scaled.mean(axis=0) for joint in joints])
    apart = float((of_cases.max(axis=0) / of_cases.min(axis=0)).max()) - 1.0
    area = np.array([joint.area.mean(axis=0) / SHARES for joint in joints])
    exponent = float(np.polyfit(np.log(SHARES), np.log(mean), 1)[0])
    ratio = mean / exact
    return (
        Claim("real area over P/H, largest departure from one", float(np.abs(area - 1.0).max()), high=0.03),
        Claim("spread of the dimensionless conductance over slope and hardness", apart, high=0.06),
        Claim("exponent of P/H from 0.001 to 0.1", exponent, 0.85, 1.0),
        Claim("ratio by number and sizes of the spots at P/H = 0.001", counted, 0.9, 1.1),
        Claim("ours over the theory at P/H = 0.001", float(ratio[0]), 0.85, 1.1),
        Claim("ours over the theory at P/H = 0.01", float(ratio[2]), 0.8, 0.95),
        Claim("ours over the theory at P/H = 0.1", float(ratio[4]), 0.72, 0.88),
    )


if __name__ == "__main__":
    write_page(page(), __file__)
