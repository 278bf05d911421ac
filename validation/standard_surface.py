"""The computer-generated standard surface of layered-contact studies: σ = 1 nm, β* = 0.5 µm on 20 x
20 µm², 256 x 256 points.

Gaussian heights and the autocorrelation exp(-2.3 r/β*): the surface of Peng (2001) and of Bhushan
(1998), figs. 25 to 31.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from page import Claim, Page, Published, Table, write_page

import asperity as asp
from asperity import roughness
from asperity.theories.rough.profile_peaks import SampledPeaks

SIDE, POINTS, SIGMA, BETA = 20e-6, 256, 1e-9, 0.5e-6
PIXEL = SIDE / POINTS

ABOUT = (
    "Rough surfaces in the studies of Peng (2001) and Bhushan (1998) are generated with an rms height of 1 nm "
    "and a correlation length of 0.5 µm at which the autocorrelation has fallen to 0.1, on 20 µm × 20 µm with "
    "256 × 256 points. The expected roughness parameters of such a surface follow from the autocorrelation at "
    "lags of a few pixels; here surfaces are generated and characterised as measured maps."
)

READING = (
    "β* is the 0.1 length: β_e = β*/ln 10 = 0.217 µm. Bhushan (1998) writes C = exp(−τ/β*) in eq. 22, the 1/e "
    "definition, with the same symbol; taking one for the other doubles the mean square slope. The "
    "exponential autocorrelation has no second derivative at the origin: slopes, curvatures and summits exist "
    "only at the sampling interval, and generating it from its spectrum cut at the Nyquist wavenumber loses "
    "10 % of the variance and 36 % of the mean square slope. Scaled to 2 nm and 1 µm everything follows by "
    "similarity."
)


def correlation(lag: float) -> float:
    """exp(-ln 10 r/β*) at the lag in pixels."""
    return math.exp(-math.log(10.0) * lag * PIXEL / BETA)


def expected() -> dict[str, float]:
    """Closed forms at the sampling interval, in SI; summits from 8·10⁶ sampled neighbourhoods of
    the exact covariance."""
    m2 = 2.0 * SIGMA**2 * (1.0 - correlation(1)) / PIXEL**2
    m4 = 2.0 * SIGMA**2 * (3.0 - 4.0 * correlation(1) + correlation(2)) / PIXEL**4
    peaks = SampledPeaks(correlation(1), correlation(2))
    return {
        "m2": m2,
        "m4": m4,
        "alpha": SIGMA**2 * m4 / m2**2,
        "peaks per length": peaks.fraction / PIXEL,
        "mean peak height": peaks.mean_height * SIGMA,
        "mean peak curvature": peaks.mean_curvature * SIGMA / PIXEL**2,
        "density of summits": 0.0713 / PIXEL**2,
        "mean summit height": 1.077 * SIGMA,
        "deviation of summit heights": 0.843 * SIGMA,
        "summit radius": 3.56e-6,
        "β_e": BETA / math.log(10.0),
        "β*": BETA,
        "highest peak": 4.26 * SIGMA,
        "peak to valley": 8.50 * SIGMA,
        "rms height": SIGMA,
        "kurtosis": 3.0,
    }


MEASURES: dict[str, Callable[[asp.roughness.Characterisation], float]] = {
    "rms height": lambda f: f.heights.Sq,
    "kurtosis": lambda f: f.heights.Sku,
    "β_e": lambda f: f.spatial.beta_e_x,
    "β*": lambda f: f.spatial.beta_01_x,
    "m2": lambda f: f.moments.difference.m2,
    "m4": lambda f: f.moments.difference.m4,
    "alpha": lambda f: f.moments.difference.alpha,
    "peaks per length": lambda f: f.peaks_x.density,
    "mean peak height": lambda f: f.peaks_x.mean_height,
    "mean peak curvature": lambda f: f.peaks_x.mean_curvature,
    "density of summits": lambda f: f.summits.eight.density,
    "mean summit height": lambda f: f.summits.eight.mean_height,
    "deviation of summit heights": lambda f: f.summits.eight.height_deviation,
    "summit radius": lambda f: f.summits.eight.radius,
    "highest peak": lambda f: f.heights.Sp,
    "peak to valley": lambda f: f.heights.Sz,
}
"""How each quantity is read from a characterisation."""

TOLERANCE = {
    "β_e": 0.03,
    "β*": 0.04,
    "density of summits": 0.002,
    "summit radius": 0.002,
    "highest peak": 0.03,
    "peak to valley": 0.02,
}
"""Share by which the expected value itself is uncertain: interpolation between lags, finite
windows, two or three digits."""


def page(realisations: int = 40) -> Page:
    """The page, from so many generated surfaces."""
    spectrum = asp.generate.ExponentialAutocorrelation(SIGMA, BETA)
    grid = asp.Grid((POINTS, POINTS), (PIXEL, PIXEL))
    found = [asp.characterise(asp.generate.gaussian(grid, spectrum, seed=seed)) for seed in range(realisations)]
    values = {name: np.array([measure(f) for f in found]) for name, measure in MEASURES.items()}
    theirs = expected()
    rows = tuple(
        (name, f"{theirs[name]:.4g}", f"{column.mean():.4g}", f"{column.std(ddof=1) / column.mean():.1%}")
        for name, column in values.items()
    )
    return Page(
        title="The standard surface of layered-contact studies",
        about=ABOUT,
        parts=(
            Table(
                f"{realisations} generated surfaces, SI units; m2 and m4 are the mean square slope and "
                "curvature of profiles by differences:",
                ("quantity", "expected", "mean", "scatter of one map"),
                rows,
            ),
            READING,
        ),
        claims=tuple(_claim(name, values[name], theirs[name]) for name in MEASURES),
        published=_published(values["β*"] / values["β_e"]),
    )


def _published(ratio: np.ndarray) -> tuple[Published, ...]:
    """The lag of 0.1 over that of 1/e, by map, and the least Nayak parameter, that of waves of one
    length."""
    return (
        Published(
            "Bhushan 1998, eq. 22",
            "lag at which the autocorrelation is 0.1 over that at which it is 1/e",
            "2.3",
            float(ratio.mean()),
            spread=float(ratio.std(ddof=1)),
        ),
        Published("Bhushan 1998, eq. 25", "least α of an isotropic Gaussian surface", "1.5", least_alpha()),
    )


def least_alpha(points: int = 512, length: float = 8.0) -> float:
    """Nayak's parameter, from the measured spectrum, of a Gaussian surface all of whose waves are
    within 2 % ``length`` pixels long."""
    frequency = np.hypot(np.fft.fftfreq(points)[:, None], np.fft.rfftfreq(points)[None, :])
    ring = np.abs(frequency * length - 1.0) < 0.02
    noise = np.fft.rfft2(np.random.default_rng(1).standard_normal((points, points)))
    surface = asp.Surface(np.fft.irfft2(noise * ring, s=(points, points)), 1.0, 1.0, periodic=True)
    moments = roughness.spectral_moments(roughness.power_spectrum(surface))
    return roughness.nayak_parameter(moments.m0, moments.m2, 0.5 * (moments.m40 + moments.m04))


def _claim(name: str, values: np.ndarray, expected_: float) -> Claim:
    error = 5.0 * values.std(ddof=1) / math.sqrt(values.size) + TOLERANCE.get(name, 0.001) * expected_
    return Claim(f"{name}: mean of the generated surfaces", float(values.mean()), expected_ - error, expected_ + error)


if __name__ == "__main__":
    write_page(page(), __file__)
