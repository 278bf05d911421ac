"""The summits and peaks of a surface beside those of a Gaussian surface with the same moments."""

from __future__ import annotations

from ..core.errors import InputError
from ..core.units import show
from ..surfaces.characterise.summary import Characterisation
from ..theories.rough.profile_peaks import SampledPeaks
from ..theories.statistics.nayak import NayakSummits

Row = tuple[str, str, str, str]
"""Quantity, measured, from the moments by differences, from the spectral moments."""


def summit_comparison(found: Characterisation) -> list[Row]:
    """Measured summits against Nayak's isotropic Gaussian surface; empty without summits, dashes where it has no answer."""
    measured = found.summits.eight
    if measured.count == 0:
        return []
    difference, spectral = found.moments.difference, found.moments.spectral
    theories = [_nayak(difference.m0, difference.m2, difference.m4), _nayak(spectral.m0, spectral.m2, spectral.m4)]
    table = (
        ("density of summits", "m**-2", measured.density, "density"),
        ("mean summit height", "m", measured.mean_height, "mean_height"),
        ("standard deviation of summit heights", "m", measured.height_deviation, "height_deviation"),
        ("mean summit curvature", "m**-1", measured.mean_curvature, "mean_curvature"),
        ("summit radius 1/<κ>", "m", measured.radius, "radius"),
    )
    return [
        (label, show(value, unit), _text(theories[0], name, unit), _text(theories[1], name, unit))
        for label, unit, value, name in table
    ]


def peak_comparison(found: Characterisation) -> list[tuple[str, str, str]]:
    """Measured peaks of profiles against those of a Gaussian profile with the same ρ1 and ρ2, along x and y."""
    rows = []
    for axis, peaks, spacing in (("x", found.peaks_x, found.surface.dx), ("y", found.peaks_y, found.surface.dy)):
        try:
            theory = SampledPeaks(peaks.rho_1, peaks.rho_2)
        except InputError:  # no profile, or a smooth one whose correlations are one
            continue
        sigma = found.heights.Sq
        rows += [
            (f"peaks per length along {axis}", show(peaks.density, "m**-1"), show(theory.fraction / spacing, "m**-1")),
            (f"mean peak height along {axis}", show(peaks.mean_height, "m"), show(theory.mean_height * sigma, "m")),
            (
                f"mean peak curvature along {axis}",
                show(peaks.mean_curvature, "m**-1"),
                show(theory.mean_curvature * sigma / spacing**2, "m**-1"),
            ),
        ]
    return rows


def _nayak(m0: float, m2: float, m4: float) -> NayakSummits | None:
    try:
        return NayakSummits(m0, m2, m4)
    except InputError:  # undefined moments, or α < 1.5 by differences on a coarse grid
        return None


def _text(theory: NayakSummits | None, name: str, unit: str) -> str:
    return "–" if theory is None else show(getattr(theory, name), unit)
