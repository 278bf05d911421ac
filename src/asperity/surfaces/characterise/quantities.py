"""Every number of a characterisation: where it stands, its symbol, unit, definition and source."""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from typing import Any

_ISO = "ISO 25178-2"
_SPECTRUM = "Jacobs, Junge & Pastewka (2017); Whittle (1953)"
_SUMMITS = "Nayak (1971); McCool (1987)"
_PEAKS = "Whitehouse & Archard (1970)"
_FRACTAL = "Ganti & Bhushan (1995)"


@dataclass(frozen=True)
class Quantity:
    """A number of a characterisation.

    ``path`` from the characterisation to the number (``"heights.Sq"``), ``symbol`` (may be empty), ``label`` in words,
    SI ``unit`` ("1" for plain numbers), ``definition`` and ``source`` (author and year, or standard).
    """

    path: str
    symbol: str
    label: str
    unit: str
    definition: str
    source: str

    @property
    def group(self) -> str:
        """First part of the path."""
        return self.path.split(".")[0]

    def of(self, characterisation: Any) -> float:
        """The number, of a ``Characterisation``."""
        return float(reduce(getattr, self.path.split("."), characterisation))


GROUPS = {
    "heights": "Heights",
    "spatial": "Correlation and texture",
    "hybrid": "Slopes, area and curvature",
    "functional": "Material ratio",
    "moments": "Moments",
    "summits": "Summits",
    "peaks_x": "Peaks of profiles along x",
    "peaks_y": "Peaks of profiles along y",
    "fractal_x": "Fractal parameters along x",
    "fractal_y": "Fractal parameters along y",
    "spectrum": "Spectrum",
    "sampling": "Sampling",
}
"""Heading of each group."""

QUANTITIES = (
    Quantity("heights.Sa", "Sa", "mean absolute height", "m", "<|z|> over the valid points, z from their mean", _ISO),
    Quantity("heights.Sq", "Sq", "rms height", "m", "sqrt(<z²>), normalised by the number of valid points", _ISO),
    Quantity("heights.Sz", "Sz", "peak to valley", "m", "Sp + Sv", _ISO),
    Quantity("heights.Sp", "Sp", "highest peak", "m", "max z", _ISO),
    Quantity("heights.Sv", "Sv", "deepest valley", "m", "-min z", _ISO),
    Quantity("heights.Ssk", "Ssk", "skewness", "1", "<z³>/Sq³, 0 for Gaussian heights", _ISO),
    Quantity("heights.Sku", "Sku", "kurtosis", "1", "<z⁴>/Sq⁴, 3 for Gaussian heights", _ISO),
    Quantity("spatial.Sal", "Sal", "autocorrelation length", "m", "shortest distance at which R/R(0) falls to 0.2, rays one a degree up to half the map", _ISO),
    Quantity("spatial.Str", "Str", "texture aspect ratio", "1", "Sal over the longest such distance; 1 is isotropic", _ISO),
    Quantity("spatial.Std", "Std", "direction of the strongest waves", "rad", "peak of the angular spectrum, from +x towards +y", _ISO),
    Quantity("spatial.lay", "", "direction of the lay", "rad", "across the steepest axis of the tensor of mean products of slopes", "Longuet-Higgins (1957)"),
    Quantity("spatial.beta_e_x", "β_e,x", "correlation length 1/e along x", "m", "first lag with R/R(0) = 1/e, linear interpolation", _PEAKS),
    Quantity("spatial.beta_e_y", "β_e,y", "correlation length 1/e along y", "m", "the same along y", _PEAKS),
    Quantity("spatial.beta_01_x", "β*_x", "correlation length 0.1 along x", "m", "first lag with R/R(0) = 0.1", "Peng & Bhushan (2001)"),
    Quantity("spatial.beta_01_y", "β*_y", "correlation length 0.1 along y", "m", "the same along y", "Peng & Bhushan (2001)"),
    Quantity("hybrid.Sdq", "Sdq", "rms gradient", "1", "sqrt(<h_x²> + <h_y²>), forward differences, all valid pairs of each direction", _ISO),
    Quantity("hybrid.Sdr", "Sdr", "developed area ratio", "1", "surface area over projected area less 1, mean of both triangulations of each cell", _ISO),
    Quantity("hybrid.Ssc", "Ssc", "arithmetic mean summit curvature", "m**-1", "mean of -(h_xx + h_yy)/2 over the summits above 8 neighbours", "McCool (1987)"),
    Quantity("functional.Sk", "Sk", "core height", "m", "height of the equivalent line through the 40 % of the material ratio curve with the least slope", _ISO),
    Quantity("functional.Spk", "Spk", "reduced peak height", "m", "height of the triangle of the area above the core", _ISO),
    Quantity("functional.Svk", "Svk", "reduced valley depth", "m", "height of the triangle of the area below the core", _ISO),
    Quantity("functional.Smr1", "Smr1", "material ratio of the peaks", "1", "ratio at which the curve leaves the core upwards", _ISO),
    Quantity("functional.Smr2", "Smr2", "material ratio of the core and peaks", "1", "ratio at which the curve leaves the core downwards", _ISO),
    Quantity("functional.Vmp", "Vmp", "peak material volume", "m", "material above the ratio 10 %, per area", _ISO),
    Quantity("functional.Vmc", "Vmc", "core material volume", "m", "material between the ratios 10 and 80 %, per area", _ISO),
    Quantity("functional.Vvc", "Vvc", "core void volume", "m", "voids between the ratios 10 and 80 %, per area", _ISO),
    Quantity("functional.Vvv", "Vvv", "valley void volume", "m", "voids below the ratio 80 %, per area", _ISO),
    Quantity("functional.Sxp", "Sxp", "peak extreme height", "m", "Smc(2.5 %) - Smc(50 %)", _ISO),
    Quantity("functional.Sdc", "Sdc(10, 80)", "height between material ratios", "m", "Smc(10 %) - Smc(80 %)", _ISO),
    Quantity("moments.difference.m2_x", "m2,x", "mean square slope along x", "1", "mean square of forward differences over the pixel, all valid pairs", "McCool (1987)"),
    Quantity("moments.difference.m2_y", "m2,y", "mean square slope along y", "1", "mean square of forward differences over the pixel, all valid pairs", "McCool (1987)"),
    Quantity("moments.difference.m4_x", "m4,x", "mean square curvature along x", "m**-2", "mean square of second differences over the squared pixel, all valid triples", "McCool (1987)"),
    Quantity("moments.difference.m4_y", "m4,y", "mean square curvature along y", "m**-2", "mean square of second differences over the squared pixel, all valid triples", "McCool (1987)"),
    Quantity("moments.difference.alpha_x", "α_x", "Nayak parameter along x", "1", "m0 m4/m2² of the moments by differences", "Nayak (1971)"),
    Quantity("moments.difference.alpha_y", "α_y", "Nayak parameter along y", "1", "m0 m4/m2² of the moments by differences", "Nayak (1971)"),
    Quantity("moments.difference.alpha", "α", "Nayak parameter of both directions", "1", "m0 m4/m2² of the means of both directions", "Nayak (1971)"),
    Quantity("moments.difference.rms_laplacian", "", "rms Laplacian", "m**-1", "sqrt(<(h_xx + h_yy)²>), twice the rms mean curvature; second differences", "Jacobs, Junge & Pastewka (2017)"),
    Quantity("moments.spectral.m0", "m0 (spectral)", "mean square height of the spectrum", "m**2", "(1/A) Σ C over the modes", "Jacobs, Junge & Pastewka (2017)"),
    Quantity("moments.spectral.m2", "m2 (spectral)", "mean square profile slope of the spectrum", "1", "(m20 + m02)/2, m_ab = (1/A) Σ q_x^a q_y^b C", "Nayak (1971)"),
    Quantity("moments.spectral.m4", "m4 (spectral)", "mean square profile curvature of the spectrum", "m**-2", "3/8 (m40 + 2 m22 + m04)", "Nayak (1971)"),
    Quantity("moments.spectral.alpha", "α (spectral)", "Nayak parameter of the spectrum", "1", "m0 m4/m2² of the spectral moments", "Nayak (1971)"),
    Quantity("summits.eight.count", "", "number of summits", "1", "points above all 8 neighbours, which are all present and valid", _SUMMITS),
    Quantity("summits.eight.density", "η", "density of summits", "m**-2", "summits per area of the points that could be one", _SUMMITS),
    Quantity("summits.eight.mean_height", "z̄_s", "mean summit height", "m", "above the mean plane", _SUMMITS),
    Quantity("summits.eight.height_deviation", "σ_s", "standard deviation of summit heights", "m", "normalised by their number", _SUMMITS),
    Quantity("summits.eight.mean_curvature", "<κ>", "mean summit curvature", "m**-1", "κ = -(h_xx + h_yy)/2 by second differences", _SUMMITS),
    Quantity("summits.eight.curvature_deviation", "", "standard deviation of summit curvatures", "m**-1", "of the same κ", _SUMMITS),
    Quantity("summits.eight.mean_geometric_curvature", "<sqrt(κ1κ2)>", "mean geometric summit curvature", "m**-1", "of the principal curvatures, where both are positive", _SUMMITS),
    Quantity("summits.eight.radius", "R", "summit radius", "m", "1/<κ>", _SUMMITS),
    Quantity("summits.eight.mean_radius", "<1/κ>", "mean of summit radii", "m", "larger than 1/<κ>", _SUMMITS),
    Quantity("summits.eight.bandwidth", "ηRσ_s", "density x radius x deviation", "1", "about 0.03 to 0.05 for most surfaces", "Greenwood & Williamson (1966)"),
    Quantity("summits.four.density", "η_4", "density of summits above 4 neighbours", "m**-2", "for comparison with the literature; 30 % too many on smooth surfaces", _SUMMITS),
    Quantity("peaks_x.density", "N_x", "peaks per length along x", "m**-1", "points of profiles above both neighbours", _PEAKS),
    Quantity("peaks_x.mean_height", "z̄_p,x", "mean peak height along x", "m", "above the mean plane", _PEAKS),
    Quantity("peaks_x.height_deviation", "σ_p,x", "standard deviation of peak heights along x", "m", "normalised by their number", _PEAKS),
    Quantity("peaks_x.mean_curvature", "<κ_p,x>", "mean peak curvature along x", "m**-1", "second difference over the squared pixel", _PEAKS),
    Quantity("peaks_x.zero_crossings", "", "crossings of the mean plane per length along x", "m**-1", "neighbours on opposite sides", _PEAKS),
    Quantity("peaks_x.rho_1", "ρ1,x", "correlation of neighbours along x", "1", "pair average over the mean square height", _PEAKS),
    Quantity("peaks_x.rho_2", "ρ2,x", "correlation of next neighbours along x", "1", "pair average over the mean square height", _PEAKS),
    Quantity("peaks_y.density", "N_y", "peaks per length along y", "m**-1", "points of profiles above both neighbours", _PEAKS),
    Quantity("peaks_y.mean_height", "z̄_p,y", "mean peak height along y", "m", "above the mean plane", _PEAKS),
    Quantity("peaks_y.height_deviation", "σ_p,y", "standard deviation of peak heights along y", "m", "normalised by their number", _PEAKS),
    Quantity("peaks_y.mean_curvature", "<κ_p,y>", "mean peak curvature along y", "m**-1", "second difference over the squared pixel", _PEAKS),
    Quantity("peaks_y.zero_crossings", "", "crossings of the mean plane per length along y", "m**-1", "neighbours on opposite sides", _PEAKS),
    Quantity("peaks_y.rho_1", "ρ1,y", "correlation of neighbours along y", "1", "pair average over the mean square height", _PEAKS),
    Quantity("peaks_y.rho_2", "ρ2,y", "correlation of next neighbours along y", "1", "pair average over the mean square height", _PEAKS),
    Quantity("fractal_x.dimension", "D_x", "fractal dimension of profiles along x", "1", "2 - (slope of ln S over ln τ)/2 from 4 pixels (2 if need be) to a tenth of the map or S = Sq²", _FRACTAL),
    Quantity("fractal_x.dimension_error", "", "standard error of D along x", "1", "of the straight line, not of the sampling", _FRACTAL),
    Quantity("fractal_x.amplitude", "C_x", "fractal amplitude along x", "m", "S = C η^(2D-3) τ^(4-2D), η = pixel", _FRACTAL),
    Quantity("fractal_x.roughness", "G_x", "fractal roughness along x", "m", "of the Weierstrass-Mandelbrot profile with γ = 1.5; NaN if not self-affine", "Majumdar & Bhushan (1990)"),
    Quantity("fractal_x.first_lag", "", "shortest lag of the fit along x", "m", "beginning of the fitted range", _FRACTAL),
    Quantity("fractal_x.last_lag", "", "longest lag of the fit along x", "m", "end of the fitted range", _FRACTAL),
    Quantity("fractal_y.dimension", "D_y", "fractal dimension of profiles along y", "1", "2 - (slope of ln S over ln τ)/2 from 4 pixels (2 if need be) to a tenth of the map or S = Sq²", _FRACTAL),
    Quantity("fractal_y.dimension_error", "", "standard error of D along y", "1", "of the straight line, not of the sampling", _FRACTAL),
    Quantity("fractal_y.amplitude", "C_y", "fractal amplitude along y", "m", "S = C η^(2D-3) τ^(4-2D), η = pixel", _FRACTAL),
    Quantity("fractal_y.roughness", "G_y", "fractal roughness along y", "m", "of the Weierstrass-Mandelbrot profile with γ = 1.5; NaN if not self-affine", "Majumdar & Bhushan (1990)"),
    Quantity("fractal_y.first_lag", "", "shortest lag of the fit along y", "m", "beginning of the fitted range", _FRACTAL),
    Quantity("fractal_y.last_lag", "", "longest lag of the fit along y", "m", "end of the fitted range", _FRACTAL),
    Quantity("spectrum.hurst", "H", "Hurst exponent", "1", "(a1 - 2)/2 of the fitted spectrum, where it lies between 0 and 1 to two standard errors", _SPECTRUM),
    Quantity("spectrum.hurst_error", "", "standard error of H", "1", "Fisher information of the Whittle likelihood", _SPECTRUM),
    Quantity("spectrum.exponent_1", "a1", "exponent of the spectrum", "1", "C ~ q^-a1 beyond the roll-off", _SPECTRUM),
    Quantity("spectrum.exponent_1_error", "", "standard error of a1", "1", "Fisher information of the Whittle likelihood", _SPECTRUM),
    Quantity("spectrum.exponent_2", "a2", "second exponent of the spectrum", "1", "C ~ q^-a2 beyond the crossover, if two power laws are found", _SPECTRUM),
    Quantity("spectrum.exponent_2_error", "", "standard error of a2", "1", "Fisher information of the Whittle likelihood", _SPECTRUM),
    Quantity("spectrum.plateau", "C0", "plateau of the spectrum", "m**4", "<h²> = (1/4π²) ∫ C d²q; if ten modes or more hold it", _SPECTRUM),
    Quantity("spectrum.plateau_error", "", "relative standard error of C0", "1", "Fisher information of the Whittle likelihood", _SPECTRUM),
    Quantity("spectrum.rolloff_wavelength", "λ_r", "roll-off wavelength", "m", "longest wave of the first power law", _SPECTRUM),
    Quantity("spectrum.rolloff_error", "", "relative standard error of λ_r", "1", "Fisher information of the Whittle likelihood", _SPECTRUM),
    Quantity("spectrum.crossover_wavelength", "λ_c", "crossover wavelength", "m", "between two power laws", _SPECTRUM),
    Quantity("spectrum.crossover_error", "", "relative standard error of λ_c", "1", "Fisher information of the Whittle likelihood", _SPECTRUM),
    Quantity("spectrum.floor", "C_n", "floor of white noise", "m**4", "constant part of the spectrum; noise of rms sqrt(C_n/(dx dy))", _SPECTRUM),
    Quantity("spectrum.floor_error", "", "relative standard error of C_n", "1", "Fisher information of the Whittle likelihood", _SPECTRUM),
    Quantity("spectrum.short_cutoff", "λ_s", "short cut-off wavelength", "m", "where the spectrum ends, if it does", _SPECTRUM),
    Quantity("sampling.effective_samples", "N_eff", "independent heights", "1", "(Σ C)²/Σ C², for Gaussian heights", "variance of the mean square of a Gaussian field"),
    Quantity("sampling.Sq_error", "", "relative scatter of Sq", "1", "1/sqrt(2 N_eff), from map to map of the same surface", "variance of the mean square of a Gaussian field"),
    Quantity("sampling.tip_cutoff", "", "tip cut-off", "m", "stencil length below which the sharpest peak is sharper than half the curvature of the tip", "Sanner et al. (2022)"),
)  # fmt: skip
"""All numbers in the order of a report."""
