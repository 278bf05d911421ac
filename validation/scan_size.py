"""How rms height and correlation length grow with the size of the scan: figure 32 of Bhushan (1998)
(Poon & Bhushan 1995).

Disk substrates were scanned by AFM on squares of 0.1 to 64 µm with 256 x 256 points each. Here the
same is done to a random surface of known spectrum: plateau beyond 16 µm, Hurst exponent 0.8 below,
shortest wave 50 nm.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from page import Claim, Page, Table, write_page

import asperity as asp
from asperity import roughness

POINTS = 256
MODEL = roughness.SpectralModel(level=1.0, rolloff_wavelength=16e-6, exponents=(3.6,), shortest_wavelength=50e-9)
ROUGH = roughness.SpectralModel(level=1.0, rolloff_wavelength=16e-6, exponents=(2.2,), shortest_wavelength=50e-9)
"""The same with a Hurst exponent of 0.1: short waves carry much of the height."""

FIXED, STEPS = 16e-6, (1, 4, 16, 32)
"""Size of the scans (m) that are sampled at every so many of 256 points."""

SIDES = (4e-6, 8e-6, 16e-6, 32e-6, 64e-6, 128e-6)
VARIANCE, SLOPE, _ = MODEL.moments()

ABOUT = (
    "Poon & Bhushan (1995), in Bhushan (1998, fig. 32), scanned disk substrates by AFM on squares of "
    "different size with 256 × 256 points each. The rms height grows with the size of the scan and is "
    "constant beyond 16 µm, from which they infer a longest wavelength of 16 µm; the correlation length keeps "
    "growing, which they attribute to the sampling interval that grows with the scan. Here windows of a "
    "random surface of known spectrum are scanned in the same way: roll-off at 16 µm, Hurst exponent 0.8, "
    "shortest wave 50 nm; heights in units of the rms height of the infinite surface. Expected values are "
    "integrals over the spectrum."
)

READING: tuple[str, ...] = (
    "The rms height saturates at one to two roll-off wavelengths: what was interpreted as the longest "
    "wavelength of the surface is its roll-off. Well below the roll-off the correlation length is a fifth of "
    "the scan **for every sampling interval of these scans**: a levelled window of a self-affine surface has "
    "no other length. At 16 µm it is still a fifth to a third below its limit, which needs three roll-off "
    "wavelengths; that is the growth which was observed. The sampling interval is not the cause here: it is "
    "far below the correlation length throughout. Slopes do depend on it: with the number of points kept, "
    "they fall as the scan grows.",
    "**How far this goes.** It holds for the spectrum assumed, whose height is in its long waves. In scans of "
    "one size (second table) the rms height does not depend on the sampling interval for any surface, since "
    "points of a surface have its variance (but for the plane, which takes more from few points). The "
    "correlation length does not, either, for a Hurst exponent of 0.8, up to intervals of a quarter of it. "
    "Where short waves carry much of the height, as with an exponent of 0.1, it is short and grows with the "
    "interval once that is no longer far below it: on such surfaces the sampling interval is a cause, as Poon "
    "and Bhushan say.",
)


@dataclass(frozen=True)
class Sampled:
    """The spectrum on the modes of one grid, shorter waves than it holds folded back, of unit
    variance over all waves."""

    psd: np.ndarray

    def lattice_psd(self, grid: asp.Grid) -> np.ndarray:
        """The table, which belongs to one grid."""
        return self.psd

    def describe(self, grid: asp.Grid) -> str:
        """Words for the history of a surface."""
        return "plateau and power law, sampled at points"


def sampled(grid: asp.Grid, model: roughness.SpectralModel = MODEL) -> Sampled:
    """The spectrum ``model`` as points of ``grid`` see it."""
    qx, qy = grid.wavevector()
    fold = [2.0 * np.pi / d for d in grid.spacing]
    reach = [range(-math.ceil(model.law.high / f), math.ceil(model.law.high / f) + 1) for f in fold]
    psd = sum(model.psd(np.hypot(qx + i * fold[0], qy + j * fold[1])) for i in reach[0] for j in reach[1])
    psd[0, 0] = 0.0
    return Sampled(psd / model.moments()[0])


def scans(side: float, count: int) -> list[dict[str, float]]:
    """Quantities of ``count`` scans of size ``side`` (m) after removal of a plane.

    A periodic map is larger than the scan by two roll-off wavelengths at least; where it is five
    times as large, its four quarters give a scan each.
    """
    pixel = side / POINTS
    nodes = POINTS * math.ceil((side + 2.0 * MODEL.rolloff_wavelength) / side)
    grid = asp.Grid((nodes, nodes), (pixel, pixel))
    spectrum = sampled(grid)
    half = nodes // 2
    corners = [(0, 0), (0, half), (half, 0), (half, half)] if nodes >= 5 * POINTS else [(0, 0)]
    found = []
    for seed in range(math.ceil(count / len(corners))):
        heights = asp.generate.gaussian(grid, spectrum, seed=seed).heights
        for i, j in corners:
            window = asp.Surface(heights[i : i + POINTS, j : j + POINTS], pixel)
            study = roughness.scan_size_study(window, smallest=POINTS)
            found.append({name: float(values[0]) for name, values in study.mean.items()})
    return found


def samplings(model: roughness.SpectralModel, count: int) -> dict[int, list[dict[str, float]]]:
    """Quantities of ``count`` scans of the size ``FIXED`` at every step of ``STEPS``, the same
    surfaces at each."""
    nodes, pixel = 3 * POINTS, FIXED / POINTS
    grid = asp.Grid((nodes, nodes), (pixel, pixel))
    spectrum = sampled(grid, model)
    found: dict[int, list[dict[str, float]]] = {step: [] for step in STEPS}
    for seed in range(count):
        heights = asp.generate.gaussian(grid, spectrum, seed=seed).heights[:POINTS, :POINTS]
        for step in STEPS:
            window = asp.Surface(heights[::step, ::step], step * pixel)
            study = roughness.scan_size_study(window, smallest=POINTS // step)
            found[step].append({name: float(values[0]) for name, values in study.mean.items()})
    return found


def _mean(scans_found: list[dict[str, float]], name: str) -> float:
    return float(np.nanmean([scan[name] for scan in scans_found]))


def _sampling_table(found: dict[str, dict[int, list[dict[str, float]]]], count: int) -> Table:
    rows = []
    for name, steps in found.items():
        for step, ones in steps.items():
            square = math.sqrt(float(np.mean([scan["Sq"] ** 2 for scan in ones])))
            rows.append(
                (name, f"{1e9 * step * FIXED / POINTS:.4g}", f"{square:.3f}", f"{1e6 * _mean(ones, 'beta_e_x'):.2f}")
            )
    about = f"{count} scans of {1e6 * FIXED:g} µm at different sampling intervals, the same surfaces at each:"
    return Table(about, ("Hurst exponent", "interval (nm)", "σ", "β_e (µm)"), tuple(rows))


def expected_rms(side: float) -> float:
    """Rms height of a scan after removal of a plane, of unit variance over all waves."""
    square = roughness.mean_square_after_levelling(MODEL.psd, (side, side), "plane", shortest_wavelength=50e-9)
    return math.sqrt(square / VARIANCE)


def page(count: int = 20, sides: tuple[float, ...] = SIDES) -> Page:
    """The page, from ``count`` scans of each size."""
    results = {side: scans(side, count) for side in sides}
    steps = {"0.8": samplings(MODEL, count), "0.1": samplings(ROUGH, count)}
    rows, claims = [], []
    for side, found in results.items():
        square = np.array([scan["Sq"] ** 2 for scan in found])
        beta = np.array([scan["beta_e_x"] for scan in found])
        slope = np.array([scan["m2_x"] for scan in found]) * VARIANCE / SLOPE
        valley = np.array([scan["Sz"] for scan in found])
        rms = expected_rms(side)
        rows.append(
            (
                f"{1e6 * side:g}",
                f"{1e9 * side / POINTS:.3g}",
                f"{rms:.3f}",
                f"{math.sqrt(square.mean()):.3f}",
                f"{1e6 * np.nanmean(beta):.2f} ± {1e6 * np.nanstd(beta):.2f}",
                f"{np.nanmean(beta) / side:.3f}",
                f"{valley.mean():.2f}",
                f"{math.sqrt(slope.mean()):.2f}",
            )
        )
        error = 5.0 * square.std(ddof=1) / math.sqrt(square.size) + 2e-3 * rms**2
        claims.append(
            Claim(
                f"mean square height of scans of {1e6 * side:g} µm",
                float(square.mean()),
                rms**2 - error,
                rms**2 + error,
            )
        )
    return Page(
        title="Rms height and correlation length against the size of the scan",
        about=ABOUT,
        parts=(
            Table(
                f"{count} scans of each size, plane removed; β_e is the 1/e length along x, mean and deviation "
                "of one scan; slopes over those of the continuous surface:",
                ("scan (µm)", "pixel (nm)", "σ expected", "σ", "β_e (µm)", "β_e / scan", "peak to valley", "rms slope"),
                tuple(rows),
            ),
            _sampling_table(steps, count),
            *READING,
        ),
        claims=(*claims, *_length_claims(results), *_sampling_claims(steps)),
    )


def _sampling_claims(found: dict[str, dict[int, list[dict[str, float]]]]) -> tuple[Claim, ...]:
    first, fourth, last = STEPS[0], STEPS[1], STEPS[-1]

    def change(name: str, step: int, quantity: str) -> float:
        return _mean(found[name][step], quantity) / _mean(found[name][first], quantity)

    return (
        Claim(
            "Hurst exponent 0.8: correlation length at 4 times the sampling interval over that at one",
            change("0.8", fourth, "beta_e_x"),
            0.95,
            1.1,
        ),
        Claim("Hurst exponent 0.1: the same at 32 times", change("0.1", last, "beta_e_x"), low=1.2),
        Claim(
            "Hurst exponent 0.1: rms height at 32 times the sampling interval over that at one",
            change("0.1", last, "Sq"),
            0.9,
            1.1,
        ),
    )


def _length_claims(results: dict[float, list[dict[str, float]]]) -> tuple[Claim, ...]:
    def length(side: float) -> float:
        return float(np.nanmean([scan["beta_e_x"] for scan in results[side]]))

    limit = 3.90e-6  # of the infinite surface, 0.244 roll-off wavelengths
    claims = [
        Claim(
            f"correlation length over the size of scans of {1e6 * side:g} µm, well below the roll-off",
            length(side) / side,
            0.15,
            0.26,
        )
        for side in results
        if side <= 4e-6
    ]
    claims += [
        Claim("correlation length of scans of 16 µm over its limit", length(side) / limit, 0.5, 0.9)
        for side in results
        if side == 16e-6
    ]
    claims += [
        Claim(f"correlation length of scans of {1e6 * side:g} µm over its limit", length(side) / limit, 0.92, 1.06)
        for side in results
        if side >= 64e-6
    ]
    return tuple(claims)


if __name__ == "__main__":
    write_page(page(), __file__)
