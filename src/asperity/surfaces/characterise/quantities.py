"""Every number of a characterisation: the path to it, its symbol, unit, definition and source."""

from __future__ import annotations

from ...core.quantity import Quantity

_ISO = "ISO 25178-2"
_SPECTRUM = "Jacobs, Junge & Pastewka (2017); Whittle (1953); Sykulski et al. (2019)"
_SUMMITS = "Nayak (1971); McCool (1987)"
_PEAKS = "Whitehouse & Archard (1970)"
_FRACTAL = "Kent & Wood (1997); Ganti & Bhushan (1995)"


def _number(name: str, symbol: str, label: str, unit: str, description: str, source: str) -> Quantity:
    """A number of a characterisation; ``name`` is the path to it, ``"heights.Sq"``."""
    return Quantity(name, unit, label, symbol=symbol, description=description, source=source)


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
    _number("heights.Sa", "Sa", "mean absolute height", "m", "<|z|> over the valid points, z from their mean", _ISO),
    _number("heights.Sq", "Sq", "rms height", "m", "sqrt(<z²>), normalised by the number of valid points", _ISO),
    _number("heights.Sz", "Sz", "peak to valley", "m", "Sp + Sv", _ISO),
    _number("heights.Sp", "Sp", "highest peak", "m", "max z", _ISO),
    _number("heights.Sv", "Sv", "deepest valley", "m", "-min z", _ISO),
    _number("heights.Ssk", "Ssk", "skewness", "1", "<z³>/Sq³, 0 for Gaussian heights", _ISO),
    _number("heights.Sku", "Sku", "kurtosis", "1", "<z⁴>/Sq⁴, 3 for Gaussian heights", _ISO),
    _number("spatial.Sal", "Sal", "autocorrelation length", "m", "shortest distance at which R/R(0) falls "
            "to 0.2, rays one a degree up to half the "
            "map", _ISO),
    _number("spatial.Str", "Str", "texture aspect ratio", "1", "Sal over the longest such distance; 1 is "
            "isotropic", _ISO),
    _number("spatial.Sal_least", "", "lower bound of Sal", "m", "shortest distance at which a ray drops to 0.2 or "
            "ends", _ISO),
    _number("spatial.Str_most", "", "upper bound of Str", "1", "shortest drop to 0.2 that was found over the longest "
            "drop or ray", _ISO),
    _number("spatial.Std", "Std", "direction of the strongest waves", "rad", "peak of the angular spectrum, from +x "
            "towards +y", _ISO),
    _number("spatial.lay", "", "direction of the lay", "rad", "across the steepest axis of the tensor "
            "of mean products of slopes", "Longuet-Higgins (1957)"),
    _number("spatial.beta_e_x", "β_e,x", "correlation length 1/e along x", "m", "first lag with R/R(0) = 1/e, linear "
            "interpolation", _PEAKS),
    _number("spatial.beta_e_y", "β_e,y", "correlation length 1/e along y", "m", "the same along y", _PEAKS),
    _number("spatial.beta_01_x", "β*_x", "correlation length 0.1 along x", "m", "first lag with R/R(0) = 0.1", "Peng & Bhushan (2001)"),
    _number("spatial.beta_01_y", "β*_y", "correlation length 0.1 along y", "m", "the same along y", "Peng & Bhushan (2001)"),
    _number("hybrid.Sdq", "Sdq", "rms gradient", "1", "sqrt(<h_x²> + <h_y²>), forward differences, all "
            "valid pairs of each direction", _ISO),
    _number("hybrid.Sdr", "Sdr", "developed area ratio", "1", "surface area over projected area less 1, "
            "mean of both triangulations of each cell", _ISO),
    _number("hybrid.Ssc", "Ssc", "arithmetic mean summit curvature", "m**-1", "mean of -(h_xx + h_yy)/2 over the "
            "summits above 8 neighbours", "McCool (1987)"),
    _number("functional.Sk", "Sk", "core height", "m", "height of the equivalent line through the 40 % of "
            "the material ratio curve with the least slope", _ISO),
    _number("functional.Spk", "Spk", "reduced peak height", "m", "height of the triangle of the area above "
            "the core", _ISO),
    _number("functional.Svk", "Svk", "reduced valley depth", "m", "height of the triangle of the area "
            "below the core", _ISO),
    _number("functional.Smr1", "Smr1", "material ratio of the peaks", "1", "ratio at which the curve leaves the "
            "core upwards", _ISO),
    _number("functional.Smr2", "Smr2", "material ratio of the core and peaks", "1", "ratio at which the curve leaves the "
            "core downwards", _ISO),
    _number("functional.Vmp", "Vmp", "peak material volume", "m", "material above the ratio 10 %, per area", _ISO),
    _number("functional.Vmc", "Vmc", "core material volume", "m", "material between the ratios 10 and 80 "
            "%, per area", _ISO),
    _number("functional.Vvc", "Vvc", "core void volume", "m", "voids between the ratios 10 and 80 %, per area", _ISO),
    _number("functional.Vvv", "Vvv", "valley void volume", "m", "voids below the ratio 80 %, per area", _ISO),
    _number("functional.Sxp", "Sxp", "peak extreme height", "m", "Smc(2.5 %) - Smc(50 %)", _ISO),
    _number("functional.Sdc", "Sdc(10, 80)", "height between material ratios", "m", "Smc(10 %) - Smc(80 %)", _ISO),
    _number("moments.difference.m2_x", "m2,x", "mean square slope along x", "1", "mean square of forward differences over "
            "the pixel, all valid pairs", "McCool (1987)"),
    _number("moments.difference.m2_y", "m2,y", "mean square slope along y", "1", "mean square of forward differences over "
            "the pixel, all valid pairs", "McCool (1987)"),
    _number("moments.difference.m4_x", "m4,x", "mean square curvature along x", "m**-2", "mean square of second differences over "
            "the squared pixel, all valid triples", "McCool (1987)"),
    _number("moments.difference.m4_y", "m4,y", "mean square curvature along y", "m**-2", "mean square of second differences over "
            "the squared pixel, all valid triples", "McCool (1987)"),
    _number("moments.difference.alpha_x", "α_x", "Nayak parameter along x", "1", "m0 m4/m2² of the moments by differences", "Nayak (1971)"),
    _number("moments.difference.alpha_y", "α_y", "Nayak parameter along y", "1", "m0 m4/m2² of the moments by differences", "Nayak (1971)"),
    _number("moments.difference.alpha", "α", "Nayak parameter of both directions", "1", "m0 m4/m2² of the means of both "
            "directions", "Nayak (1971)"),
    _number("moments.difference.rms_laplacian", "", "rms Laplacian", "m**-1", "sqrt(<(h_xx + h_yy)²>), twice the rms "
            "mean curvature; second differences", "Jacobs, Junge & Pastewka (2017)"),
    _number("moments.spectral.m0", "m0 (spectral)", "mean square height of the spectrum", "m**2", "(1/A) Σ C over the modes", "Jacobs, Junge & Pastewka (2017)"),
    _number("moments.spectral.m2", "m2 (spectral)", "mean square profile slope of the "
            "spectrum", "1", "(m20 + m02)/2, m_ab = (1/A) Σ q_x^a "
            "q_y^b C", "Nayak (1971)"),
    _number("moments.spectral.m4", "m4 (spectral)", "mean square profile curvature of the "
            "spectrum", "m**-2", "3/8 (m40 + 2 m22 + m04)", "Nayak (1971)"),
    _number("moments.spectral.alpha", "α (spectral)", "Nayak parameter of the spectrum", "1", "m0 m4/m2² of the spectral moments", "Nayak (1971)"),
    _number("summits.eight.count", "", "number of summits", "1", "points above all 8 neighbours, which "
            "are all present and valid", _SUMMITS),
    _number("summits.eight.density", "η", "density of summits", "m**-2", "summits per area of the points that "
            "could be one", _SUMMITS),
    _number("summits.eight.mean_height", "z̄_s", "mean summit height", "m", "above the mean plane", _SUMMITS),
    _number("summits.eight.height_deviation", "σ_s", "standard deviation of summit heights", "m", "normalised by their number", _SUMMITS),
    _number("summits.eight.mean_curvature", "<κ>", "mean summit curvature", "m**-1", "κ = -(h_xx + h_yy)/2 by second "
            "differences", _SUMMITS),
    _number("summits.eight.curvature_deviation", "", "standard deviation of summit curvatures", "m**-1", "of the same κ", _SUMMITS),
    _number("summits.eight.mean_geometric_curvature", "<sqrt(κ1κ2)>", "mean geometric summit curvature", "m**-1", "of the principal curvatures, where both "
            "are positive", _SUMMITS),
    _number("summits.eight.radius", "R", "summit radius", "m", "1/<κ>", _SUMMITS),
    _number("summits.eight.mean_radius", "<1/κ>", "mean of summit radii", "m", "larger than 1/<κ>", _SUMMITS),
    _number("summits.eight.bandwidth", "ηRσ_s", "density x radius x deviation", "1", "about 0.03 to 0.05 for most surfaces", "Greenwood & Williamson (1966)"),
    _number("summits.four.density", "η_4", "density of summits above 4 neighbours", "m**-2", "for comparison with the literature; 30 "
            "% too many on smooth surfaces", _SUMMITS),
    *(
        item
        for axis in "xy"
        for item in (
            _number(f"peaks_{axis}.density", f"N_{axis}", f"peaks per length along {axis}", "m**-1", "points of profiles above both neighbours", _PEAKS),
            _number(f"peaks_{axis}.mean_height", f"z̄_p,{axis}", f"mean peak height along {axis}", "m", "above the mean plane", _PEAKS),
            _number(f"peaks_{axis}.height_deviation", f"σ_p,{axis}", "standard deviation of peak heights "
                    f"along {axis}", "m", "normalised by their number", _PEAKS),
            _number(f"peaks_{axis}.mean_curvature", f"<κ_p,{axis}>", f"mean peak curvature along {axis}", "m**-1", "second difference over the squared pixel", _PEAKS),
            _number(f"peaks_{axis}.zero_crossings", "", "crossings of the mean plane per length "
                    f"along {axis}", "m**-1", "neighbours on opposite sides", _PEAKS),
            _number(f"peaks_{axis}.rho_1", f"ρ1,{axis}", f"correlation of neighbours along {axis}", "1", "pair average over the mean square height", _PEAKS),
            _number(f"peaks_{axis}.rho_2", f"ρ2,{axis}", "correlation of next neighbours along "
                    f"{axis}", "1", "pair average over the mean square height", _PEAKS),
        )
    ),
    *(
        item
        for axis in "xy"
        for item in (
            _number(f"fractal_{axis}.dimension", f"D_{axis}", "fractal dimension of profiles along "
                    f"{axis}", "1", "2 - H of the second differences, V = a τ^(2H) + b, from 2 pixels to a twentieth "
                            "of the map or a tenth of the roll-off", _FRACTAL),
            _number(f"fractal_{axis}.dimension_error", "", f"standard error of D along {axis}", "1", "jackknife over 16 parts of the "
                    "map", _FRACTAL),
            _number(f"fractal_{axis}.amplitude", f"C_{axis}", f"fractal amplitude along {axis}", "m", "S = C η^(2D-3) τ^(4-2D), η = pixel", _FRACTAL),
            _number(f"fractal_{axis}.roughness", f"G_{axis}", f"fractal roughness along {axis}", "m", "of the Weierstrass-Mandelbrot profile "
                    "with γ = 1.5; NaN if not self-affine", "Majumdar & Bhushan (1990)"),
            _number(f"fractal_{axis}.first_lag", "", f"shortest lag of the fit along {axis}", "m", "beginning of the fitted range", _FRACTAL),
            _number(f"fractal_{axis}.last_lag", "", f"longest lag of the fit along {axis}", "m", "end of the fitted range", _FRACTAL),
        )
    ),
    _number("spectrum.hurst", "H", "Hurst exponent", "1", "(a1 - 2)/2 of the fitted spectrum, where "
            "it lies between 0 and 1 to two standard "
            "errors", _SPECTRUM),
    _number("spectrum.hurst_error", "", "standard error of H", "1", "Fisher information of the Whittle "
            "likelihood, and differences between shapes of the roll-off that the data allow", _SPECTRUM),
    _number("spectrum.longest_wave", "", "longest wave of the power law", "m", "beginning of the band of H: the roll-off, "
            "or the longest wave that was fitted", _SPECTRUM),
    _number("spectrum.shortest_wave", "", "shortest wave of the power law", "m", "end of the band of H: the crossover, "
            "or the shortest wave that was fitted", _SPECTRUM),
    _number("spectrum.exponent_1", "a1", "exponent of the spectrum", "1", "C ~ q^-a1 beyond the roll-off", _SPECTRUM),
    _number("spectrum.exponent_1_error", "", "standard error of a1", "1", "twice the standard error of H", _SPECTRUM),
    _number("spectrum.exponent_2", "a2", "second exponent of the spectrum", "1", "C ~ q^-a2 beyond the crossover, if two "
            "power laws are found", _SPECTRUM),
    _number("spectrum.exponent_2_error", "", "standard error of a2", "1", "Fisher information of the Whittle "
            "likelihood", _SPECTRUM),
    _number("spectrum.plateau", "C0", "plateau of the spectrum", "m**4", "<h²> = (1/4π²) ∫ C d²q; if ten modes or "
            "more hold it and λ_r is known to a factor of 1.65", _SPECTRUM),
    _number("spectrum.plateau_error", "", "relative standard error of C0", "1", "Fisher information of the Whittle "
            "likelihood", _SPECTRUM),
    _number("spectrum.rolloff_wavelength", "λ_r", "roll-off wavelength", "m", "longest wave of the first power law, or 2π/q_r of a rounded plateau C0 (1 + q²/q_r²)^(-a1/2)", _SPECTRUM),
    _number("spectrum.rolloff_error", "", "relative standard error of λ_r", "1", "Fisher information of the Whittle "
            "likelihood", _SPECTRUM),
    _number("spectrum.crossover_wavelength", "λ_c", "crossover wavelength", "m", "between two power laws", _SPECTRUM),
    _number("spectrum.crossover_error", "", "relative standard error of λ_c", "1", "Fisher information of the Whittle "
            "likelihood", _SPECTRUM),
    _number("spectrum.floor", "C_n", "floor of white noise", "m**4", "constant part of the spectrum; noise of "
            "rms sqrt(C_n/(dx dy))", _SPECTRUM),
    _number("spectrum.floor_error", "", "relative standard error of C_n", "1", "Fisher information of the Whittle "
            "likelihood", _SPECTRUM),
    _number("spectrum.short_cutoff", "λ_s", "short cut-off wavelength", "m", "where the spectrum ends, if it does", _SPECTRUM),
    _number("sampling.effective_samples", "N_eff", "independent heights", "1", "(Σ C)²/Σ C², for Gaussian heights", "variance of the mean square of a "
            "Gaussian field"),
    _number("sampling.Sq_error", "", "relative scatter of Sq", "1", "1/sqrt(2 N_eff), from map to map of the "
            "same surface", "variance of the mean square of a "
            "Gaussian field"),
    _number("sampling.tip_cutoff", "", "tip cut-off", "m", "stencil length below which the sharpest "
            "peak is sharper than half the curvature "
            "of the tip", "Sanner et al. (2022)"),
)  # fmt: skip
"""All numbers in the order of a report."""
