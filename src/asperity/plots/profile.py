"""Figures of a line scan: trace and waviness, roughness, distribution, material ratio, spectra,
correlation, scales."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..core.units import show
from ..surfaces.characterise.correlation import DROP_1E, DROP_ISO
from ..surfaces.characterise.heights import height_distribution
from ..surfaces.profile import Profile
from ..surfaces.profile_summary import ProfileCharacterisation
from .picture import BLACK, BLUE, ORANGE, SKY, VERMILLION, Figure, Plot, figures_by, legend_above, scale
from .surface import draw_material_ratio

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def plot_profile(profile: Profile, ax: Axes, *, start: float = 0.0, label: str = "heights", color: str = BLUE) -> Axes:
    """Draw the heights of ``profile`` against the place, from ``start`` in m, on ``ax``; missing
    points are gaps."""
    length, height = scale(profile.length, "m"), scale(profile.heights, "m")
    ax.set(xlabel=f"x ({length.symbol})", ylabel=f"height ({height.symbol})")
    ax.plot(length(profile.x + start), height(profile.heights), color=color, linewidth=0.8, label=label)
    ax.set_xlim(0.0, float(length(start + profile.length)))
    return ax


def plot_trace(found: ProfileCharacterisation, ax: Axes) -> Axes:
    """Draw the levelled trace, its waviness and the evaluation length on ``ax``."""
    plot_profile(found.profile, ax, label="trace, levelled", color=SKY)
    if found.parts is not None:
        length, height = scale(found.profile.length, "m"), scale(found.profile.heights, "m")
        waves = found.parts.waviness
        start = 0.5 * (found.profile.length - waves.length)
        offset = float(np.nanmean(found.profile.heights))
        ax.plot(
            length(waves.x + start), height(waves.heights + offset), color=VERMILLION, linewidth=1.0, label="waviness"
        )
        for number in range(found.parts.sections + 1):
            ax.axvline(float(length(start + number * found.parts.long)), color="0.6", linewidth=0.6, linestyle=":")
    return legend_above(ax)


def plot_roughness_profile(found: ProfileCharacterisation, ax: Axes) -> Axes:
    """Draw the roughness profile about its mean line on ``ax``, the primary profile where there is
    none."""
    profile = found.profile if found.parts is None else found.parts.roughness
    plot_profile(profile, ax)
    ax.axhline(0.0, color=BLACK, linewidth=0.6)
    main = found.main
    ax.set_title(f"{main.letter}a {show(main.a, 'm', 3)}   {main.letter}z {show(main.z, 'm', 3)}", loc="right")
    return ax


def plot_profile_distribution(found: ProfileCharacterisation, ax: Axes) -> Axes:
    """Draw the probability density of the heights and the normal density of the same deviation on
    ``ax``."""
    profile = found.profile if found.parts is None else found.parts.roughness
    density = height_distribution(profile)
    in_unit = scale(density.edges, "m")
    edges = np.asarray(in_unit(density.edges))
    ax.set(xlabel=f"height ({in_unit.symbol})", ylabel=f"probability density (1/{in_unit.symbol})")
    ax.stairs(density.density * in_unit.factor, edges, fill=True, color=SKY, label="measured")
    if density.deviation > 0.0:
        heights = np.linspace(density.edges[0], density.edges[-1], 400)
        ax.plot(
            in_unit(heights),
            density.normal(heights) * in_unit.factor,
            color=BLACK,
            label=f"normal, same {found.letter}q",
        )
    main = found.main
    ax.set_title(f"{main.letter}sk {main.sk:z.2f}   {main.letter}ku {main.ku:.2f}", loc="right")
    return legend_above(ax)


def plot_profile_ratio(found: ProfileCharacterisation, ax: Axes) -> Axes:
    """Draw the material ratio curve of the profile with its core on ``ax``."""
    return draw_material_ratio(found.main.curve, ax, found.letter)


def plot_profile_spectrum(found: ProfileCharacterisation, ax: Axes) -> Axes:
    """Draw the two-sided spectrum C1D of the trace and its model on ``ax``, logarithmically; the
    fitted band is shaded."""
    unit = scale(math.sqrt(found.profile.spacing * found.profile.length), "m")
    ax.set(xlabel=f"wavenumber q (rad/{unit.symbol})", ylabel=f"C1D ({unit.symbol}$^3$)")
    if found.spectrum is None or not (found.spectrum.psd > 0.0).any():
        ax.text(0.5, 0.5, "no spectrum", transform=ax.transAxes, ha="center", va="center")
        return ax
    ax.set(xscale="log", yscale="log")
    q, psd = found.spectrum.q, found.spectrum.psd
    shown = psd > 0.0
    ax.plot(q[shown] * unit.factor, psd[shown] / unit.factor**3, color=SKY, linewidth=0.6, label="measured")
    if found.converted is not None:
        waves = np.geomspace(found.converted.first, found.converted.last, 300)
        label = f"fit, H = {found.converted.hurst:.2f}"
        error = found.converted.errors.get("hurst", math.nan)
        label += f" ± {error:.2f}" if math.isfinite(error) else ""
        model = found.converted.profile_psd(waves) / unit.factor**3
        ax.plot(waves * unit.factor, model, color=VERMILLION, label=label)
        ax.axvspan(waves[0] * unit.factor, waves[-1] * unit.factor, color=SKY, alpha=0.13, linewidth=0.0)
    return legend_above(ax)


def plot_isotropic_spectrum(found: ProfileCharacterisation, ax: Axes) -> Axes:
    """Draw the spectrum C of the isotropic surface of the scan on ``ax``, logarithmically."""
    unit = scale(math.sqrt(found.profile.spacing * found.profile.length), "m")
    ax.set(xlabel=f"wavenumber q (rad/{unit.symbol})", ylabel=f"C ({unit.symbol}$^4$)")
    if found.converted is None:
        ax.text(0.5, 0.5, "no spectrum", transform=ax.transAxes, ha="center", va="center")
        return ax
    ax.set(xscale="log", yscale="log")
    waves = np.geomspace(found.converted.first, found.converted.last, 300)
    psd = found.converted.psd(waves) / unit.factor**4
    ax.plot(waves * unit.factor, psd, color=BLUE, label="isotropic surface of this scan")
    return legend_above(ax)


def plot_profile_correlation(found: ProfileCharacterisation, ax: Axes) -> Axes:
    """Draw R/R(0) of the trace on ``ax`` with the levels 1/e and 0.2."""
    lags, values = found.covariance.along("x")
    length = found.correlation_length
    reach = 0.5 * found.profile.length
    reach = min(reach, 6.0 * length) if math.isfinite(length) and length > 0.0 else reach
    in_unit = scale(reach, "m")
    ax.set(xlabel=f"lag ({in_unit.symbol})", ylabel="R/R(0)", xlim=(0.0, float(in_unit(reach))))
    ax.axhline(0.0, color="0.7", linewidth=0.7)
    for level in (DROP_1E, DROP_ISO):
        ax.axhline(level, color="0.5", linewidth=0.7, linestyle=":")
    if found.covariance.mean_square > 0.0:
        part = lags <= reach
        label = "measured" if math.isnan(length) else f"$\\beta_e$ {show(length, 'm', 3)}"
        ax.plot(in_unit(lags[part]), values[part] / found.covariance.mean_square, color=BLUE, label=label)
        ax.legend(loc="upper right")
    return ax


def plot_profile_scales(found: ProfileCharacterisation, ax: Axes) -> Axes:
    """Draw the rms slope (left) and curvature (right) against the length of the stencil on ``ax``,
    logarithmically."""
    curve = found.scale
    unit = scale(found.profile.length, "m")
    ax.set(xlabel=f"length of the stencil ({unit.symbol})", ylabel="rms slope")
    if curve is None or not curve.slope.max() > 0.0:
        return ax
    ax.set(xscale="log", yscale="log")
    twin = ax.twinx()
    twin.set(yscale="log", ylabel=f"rms curvature (1/{unit.symbol})")
    ax.plot(unit(curve.slope_length), curve.slope, color=BLUE, label="slope")
    twin.plot(unit(curve.curvature_length), curve.curvature * unit.factor, color=ORANGE)
    ax.plot([], [], color=ORANGE, label="curvature")
    ax.legend(loc="lower left")
    return ax


PROFILE_PLOTS = (
    Plot("trace", "Trace", "Levelled trace with its waviness; dotted lines bound the sections.", plot_trace),
    Plot("roughness_profile", "Roughness profile", "Roughness profile about its mean line.", plot_roughness_profile),
    Plot(
        "distribution",
        "Distribution of heights",
        "Probability density of the heights, and the normal density of the same deviation.",
        plot_profile_distribution,
    ),
    Plot(
        "material_ratio",
        "Material ratio",
        "Material ratio (Abbott) curve with the equivalent line of the core; triangles for peaks and valleys.",
        plot_profile_ratio,
    ),
    Plot(
        "spectrum",
        "Spectrum of the profile",
        "Two-sided power spectrum of the trace and the fitted model; the range of the fit is shaded.",
        plot_profile_spectrum,
    ),
    Plot(
        "isotropic_spectrum",
        "Spectrum of the isotropic surface",
        "Spectrum of the isotropic surface that the scan may belong to, by the exact relation.",
        plot_isotropic_spectrum,
    ),
    Plot(
        "autocorrelation",
        "Autocorrelation",
        "Autocorrelation of the trace; its falls to 1/e and to 0.2 define correlation lengths.",
        plot_profile_correlation,
    ),
    Plot(
        "scale_dependence",
        "Slope and curvature by scale",
        "Rms slope and curvature against the length of the stencil.",
        plot_profile_scales,
    ),
)
"""The standard figures of a line scan in the order of a report."""


def profile_figures(found: ProfileCharacterisation) -> tuple[Figure, ...]:
    """The standard figures of a characterised line scan."""
    return figures_by(PROFILE_PLOTS, found)
