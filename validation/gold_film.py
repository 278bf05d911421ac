"""The sputtered gold film: AFM map, fitted spectrum and generated surfaces of the review chapter on
rough contact.

Reported: rms height 2.7 nm, skewness -0.08, kurtosis 2.7, Nayak's parameter about 2.2; spectrum
with the plateau 380 nm⁴ (convention <h²> = ∫ C d²q), roll-off at 90 nm, change of slope at 50 nm,
exponents -6.5 and -4.6; scan of 1.5 µm with 512 x 512 points.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from page import Claim, Page, Published, Table, write_page

import asperity as asp
from asperity import roughness
from asperity.theories.statistics.nayak import NayakSummits

SIDE, POINTS = 1.5e-6, 512
PLATEAU = 380e-36 * 4.0 * math.pi**2
ROLLOFF, CROSSOVER, EXPONENTS = 90e-9, 50e-9, (6.5, 4.6)
RMS, SKEWNESS, KURTOSIS, NAYAK = 2.7e-9, -0.08, 2.7, 2.2

MODEL = roughness.SpectralModel(
    level=PLATEAU, rolloff_wavelength=ROLLOFF, exponents=EXPONENTS, crossover_wavelength=CROSSOVER
)
"""The fitted spectrum as printed."""

ABOUT = (
    "A review chapter on the contact of rough surfaces fits the spectrum of an AFM map of a sputtered gold "
    "film and generates surfaces from it. Reported of the measured film and of the generated surfaces alike: "
    "rms height 2.7 nm and a Nayak parameter of about 2.2; of the film also skewness −0.08 and kurtosis 2.7. "
    "Here the printed spectrum is integrated in closed form, and surfaces are generated from it and "
    "characterised as if they had been measured."
)

READING = (
    "The printed numbers are not all consistent. The plateau of 380 nm⁴ gives 2.92 nm, 8 % more than the "
    "reported rms height; 325 nm⁴ would give 2.7 nm. The Nayak parameter of 2.2 is that of the spectrum **cut "
    "at 50 nm**; with the −4.6 branch, which the generated surfaces contain, it is 17 to 19, or 12 as finite "
    "differences on the 512² points see it, and the radius of the summits is four times smaller. The "
    "exponents mean H = 2.25 and 1.3: below the roll-off the film is smooth, not self-affine. A branch close "
    "to −5 is what a blunt tip produces on any surface. Gaussian surfaces have kurtosis 3, not 2.7; rank "
    "ordering gives both the spectrum and the measured moments."
)


def grid() -> asp.Grid:
    """The points of the scan."""
    return asp.Grid((POINTS, POINTS), (SIDE / POINTS, SIDE / POINTS))


def spectrum(amplitude: object) -> asp.generate.TwoSlopes:
    """The printed shape at any amplitude."""
    return asp.generate.TwoSlopes(
        amplitude=amplitude, exponents=EXPONENTS, rolloff_wavelength=ROLLOFF, crossover_wavelength=CROSSOVER
    )


@dataclass(frozen=True)
class Moments:
    """Profile moments and what follows from them for a Gaussian surface."""

    name: str
    m0: float
    m2: float
    m4: float

    @property
    def alpha(self) -> float:
        """Nayak's parameter."""
        return roughness.nayak_parameter(self.m0, self.m2, self.m4)

    @property
    def row(self) -> tuple[str, ...]:
        """Text of the row of a table."""
        summits = NayakSummits(self.m0, self.m2, self.m4)
        return (
            self.name,
            f"{1e9 * math.sqrt(self.m0):.3f}",
            f"{self.alpha:.2f}",
            f"{math.sqrt(2.0 * self.m2):.3f}",
            f"{1e-12 * summits.density:.0f}",
            f"{1e9 * summits.radius:.1f}",
        )


def printed() -> tuple[Moments, ...]:
    """Moments of the printed spectrum over several ranges."""
    nyquist = 2.0 * SIDE / POINTS
    exact = asp.generate.gaussian(grid(), spectrum(asp.generate.PlateauPSD(PLATEAU)), seed=1, variant="fixed")
    spectral = roughness.spectral_moments(roughness.power_spectrum(exact))
    differences = roughness.difference_moments(exact)
    return (
        Moments("waves of 1.5 µm to 50 nm", *MODEL.moments(CROSSOVER, SIDE)),
        Moments("waves of 1.5 µm to 5.86 nm (two pixels)", *MODEL.moments(nyquist, SIDE)),
        Moments(
            "512² points, sum over modes, mean of x and y",
            spectral.m0,
            spectral.m2,
            0.5 * (spectral.m40 + spectral.m04),
        ),
        Moments("512² points, finite differences", differences.m0, differences.m2, differences.m4),
    )


def generated(realisations: int) -> dict[str, np.ndarray]:
    """Numbers of Gaussian surfaces of the printed shape at the reported rms height."""
    shape = spectrum(asp.generate.RmsHeight(RMS))
    found = [asp.characterise(asp.generate.gaussian(grid(), shape, seed=seed)) for seed in range(realisations)]
    columns = {
        "rms height (nm)": lambda f: 1e9 * f.heights.Sq,
        "skewness": lambda f: f.heights.Ssk,
        "kurtosis": lambda f: f.heights.Sku,
        "roll-off (nm)": lambda f: 1e9 * f.spectrum.rolloff_wavelength,
        "change of slope (nm)": lambda f: 1e9 * f.spectrum.crossover_wavelength,
        "first exponent": lambda f: -f.spectrum.exponent_1,
        "second exponent": lambda f: -f.spectrum.exponent_2,
        "Nayak parameter, differences": lambda f: f.moments.difference.alpha,
        "Nayak parameter, spectral": lambda f: f.moments.spectral.alpha,
        "density of summits (µm⁻²)": lambda f: 1e-12 * f.summits.eight.density,
        "radius of summits (nm)": lambda f: 1e9 * f.summits.eight.radius,
    }
    return {name: np.array([column(f) for f in found]) for name, column in columns.items()}


REPORTED = {
    "rms height (nm)": "2.7",
    "skewness": "−0.08 (film)",
    "kurtosis": "2.7 (film)",
    "roll-off (nm)": "90",
    "change of slope (nm)": "50",
    "first exponent": "−6.5",
    "second exponent": "−4.6",
    "Nayak parameter, differences": "about 2.2",
    "Nayak parameter, spectral": "about 2.2",
}


NAYAK = "Nayak parameter of the film"


def page(realisations: int = 20) -> Page:
    """The page, from so many generated surfaces."""
    moments, found = printed(), generated(realisations)
    marginal = asp.generate.rank_ordered(
        grid(), spectrum(asp.generate.RmsHeight(RMS)), asp.generate.HeightMoments(SKEWNESS, KURTOSIS), seed=1
    )
    heights = roughness.height_parameters(marginal)
    rows = tuple(
        (name, REPORTED.get(name, ""), f"{values.mean():.3g}", f"{values.std(ddof=1):.2g}")
        for name, values in found.items()
    )
    return Page(
        title="The gold film",
        about=ABOUT,
        parts=(
            Table(
                "The printed spectrum, integrated (η and R of Nayak's Gaussian surface):",
                ("range", "σ (nm)", "α", "rms gradient", "η (µm⁻²)", "R (nm)"),
                tuple(item.row for item in moments),
            ),
            Table(
                f"{realisations} generated surfaces of that shape at σ = 2.7 nm, 512² points, characterised as "
                "measured maps:",
                ("quantity", "theirs", "ours", "deviation of one map"),
                rows,
            ),
            f"Rank-ordered with the measured marginal: skewness {heights.Ssk:.3f}, kurtosis {heights.Sku:.3f}, "
            f"rms height {1e9 * heights.Sq:.3f} nm.",
            READING,
        ),
        claims=_claims(moments, found, heights, realisations),
        published=_published(moments, found),
    )


def _published(moments: tuple[Moments, ...], found: dict[str, np.ndarray]) -> tuple[Published, ...]:
    """What is printed of the generated surfaces, and of the film where Gaussian surfaces may be
    expected to share it."""
    source, film = "review chapter, sec. 3", "the film's; Gaussian surfaces have 0 and 3"
    cut, whole = moments[0], moments[2]

    def measured(name: str, theirs: str, reason: str = "", rests_on: str = "put in", shared: str = "") -> Published:
        values = found[name]
        return Published(
            source,
            name,
            theirs,
            float(values.mean()),
            spread=float(values.std(ddof=1)),
            reason=reason,
            rests_on=rests_on,
            shared=shared,
        )

    level = 380.0 * RMS**2 / whole.m0
    return (
        measured("rms height (nm)", "2.7"),
        measured("skewness", "−0.08", film, "Gaussian heights put in"),
        measured("kurtosis", "2.7", film, "Gaussian heights put in"),
        *(measured(name, REPORTED[name]) for name in ("roll-off (nm)", "change of slope (nm)")),
        *(measured(name, REPORTED[name]) for name in ("first exponent", "second exponent")),
        Published(source, "plateau (nm⁴) with which the printed shape has the printed rms height", "380", level),
        Published(
            "review chapter, sec. 4.2",
            "Nayak parameter, waves down to 50 nm",
            "2.2",
            cut.alpha,
            0.05,
            rests_on="spectrum cut at 50 nm",
            shared=NAYAK,
        ),
        measured("Nayak parameter, differences", "2.2", "all waves", "", NAYAK),
        measured("Nayak parameter, spectral", "2.2", "all waves", "", NAYAK),
    )


def _claims(
    moments: tuple[Moments, ...], found: dict[str, np.ndarray], heights: roughness.HeightParameters, realisations: int
) -> tuple[Claim, ...]:
    cut, whole, _, differences = moments

    def mean(name: str, expected: float) -> Claim:
        values = found[name]
        error = 5.0 * values.std(ddof=1) / math.sqrt(realisations)
        return Claim(
            f"{name}: mean of the generated surfaces", float(values.mean()), expected - error, expected + error
        )

    return (
        Claim(
            "rms height (nm) of the printed spectrum over all resolved waves", 1e9 * math.sqrt(whole.m0), 2.915, 2.922
        ),
        Claim("the same to 50 nm only", 1e9 * math.sqrt(cut.m0), 2.86, 2.87),
        Claim("Nayak parameter to 50 nm: the reported 2.2, rounded", cut.alpha, 2.15, 2.35),
        Claim("Nayak parameter with the second branch", whole.alpha, 17.0, 17.2),
        Claim("Nayak parameter by differences on 512² points", differences.alpha, 11.0, 12.0),
        mean("rms height (nm)", 2.7),
        mean("roll-off (nm)", 90.0),
        mean("change of slope (nm)", 50.0),
        mean("first exponent", -6.5),
        mean("second exponent", -4.6),
        mean("kurtosis", 3.0),
        Claim("kurtosis of the rank-ordered surface", heights.Sku, 2.69, 2.71),
        Claim("skewness of the rank-ordered surface", heights.Ssk, -0.085, -0.075),
    )


if __name__ == "__main__":
    write_page(page(), __file__)
