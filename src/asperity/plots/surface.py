"""Figures of a surface: distribution, material ratio, correlation, spectrum, summits, view in
space."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.grid import Grid
from ..core.units import percent, show
from ..surfaces.characterise.correlation import DROP_1E, DROP_TENTH
from ..surfaces.characterise.heights import MaterialRatioCurve, core
from ..surfaces.characterise.summary import Characterisation
from ..surfaces.surface import Surface
from .maps import Look, heights_field, map_of, plot_heights
from .picture import (
    BLACK,
    BLUE,
    GREEN,
    HEIGHT_MAP,
    ORANGE,
    SKY,
    VERMILLION,
    Figure,
    Plot,
    figures_by,
    legend_above,
    scale,
)
from .together import save_pictures
from .view import draw_view, thinned

if TYPE_CHECKING:
    from matplotlib.axes import Axes


# Curves of a surface: how heights are distributed, how much material lies above a height, how
# heights correlate.


_CURVE_POINTS = 800  # of a material ratio curve, whose heights may be millions
_DARKEST, _LEAST = 0.001, 1e-12
"""Of a spectrum the share of its modes that are drawn darkest, and the least value over the
largest: rounding lies below."""


def plot_height_distribution(found: Characterisation, ax: Axes) -> Axes:
    """Draw the probability density of the heights and the normal density of the same deviation on
    ``ax``."""
    distribution = found.curves.distribution
    in_unit = scale(distribution.edges, "m")
    edges = np.asarray(in_unit(distribution.edges))
    ax.set(xlabel=f"height ({in_unit.symbol})", ylabel=f"probability density (1/{in_unit.symbol})")
    ax.stairs(distribution.density * in_unit.factor, edges, fill=True, color=SKY, label="measured")
    if distribution.deviation > 0.0:
        heights = np.linspace(distribution.edges[0], distribution.edges[-1], 400)
        normal = distribution.normal(heights) * in_unit.factor
        ax.plot(in_unit(heights), normal, color=BLACK, label="normal, same Sq")
        ax.set_title(f"Ssk {found.heights.Ssk:z.2f}   Sku {found.heights.Sku:.2f}", loc="right")
    ax.set_xlim(edges[0], edges[-1])
    return legend_above(ax)


def plot_material_ratio(found: Characterisation, ax: Axes) -> Axes:
    """Draw the material ratio (Abbott) curve with the line and the bounds of its core on ``ax``."""
    return draw_material_ratio(found.curves.material_ratio, ax)


def draw_material_ratio(curve: MaterialRatioCurve, ax: Axes, letter: str = "S") -> Axes:
    """Draw a material ratio ``curve`` on ``ax``; ``letter`` begins the names of its parameters."""
    in_unit = scale(curve.heights, "m")
    ratios = np.linspace(0.0, 1.0, _CURVE_POINTS)
    ax.set(xlabel="material ratio (%)", ylabel=f"height ({in_unit.symbol})", xlim=(0.0, 100.0))
    ax.plot(100.0 * ratios, in_unit(curve.height(ratios)), color=BLUE, label="measured")
    try:
        line = core(curve)
    except InputError:  # flat
        return ax
    top, bottom = float(in_unit(line.top)), float(in_unit(line.bottom))
    ax.plot([0.0, 100.0], [top, bottom], color=VERMILLION, linestyle="--", label="core line")
    ax.hlines([top, bottom], 0.0, 100.0, color="0.6", linewidth=0.7)
    for ratio, name in ((line.ratio_1, f"{letter}mr1"), (line.ratio_2, f"{letter}mr2")):
        ax.axvline(100.0 * ratio, color="0.6", linewidth=0.7, linestyle=":", label=f"{name} {percent(ratio)}")
    peak, valley = float(in_unit(line.reduced_peak)), float(in_unit(line.reduced_valley))
    # triangles with the areas of peaks and valleys
    for corners in (
        [(0.0, top), (0.0, top + peak), (100.0 * line.ratio_1, top)],
        [(100.0, bottom), (100.0, bottom - valley), (100.0 - 100.0 * (1.0 - line.ratio_2), bottom)],
    ):
        ax.fill(*zip(*corners, strict=True), color=SKY, alpha=0.5, linewidth=0.0)
    ax.set_title(
        f"{letter}k {top - bottom:.3g}   {letter}pk {peak:.3g}   {letter}vk {valley:.3g} {in_unit.symbol}", loc="right"
    )
    ax.legend(loc="lower left", frameon=True, edgecolor="none", framealpha=0.9)
    return ax


def plot_autocorrelation(found: Characterisation, ax: Axes) -> Axes:
    """Draw R/R(0) along x and y on ``ax`` with the levels 1/e and 0.1 that define correlation
    lengths."""
    covariance = found.curves.autocovariance
    longest = max(covariance.size)
    lengths = np.array([found.spatial.beta_e_x, found.spatial.beta_e_y])
    known = lengths[np.isfinite(lengths) & (lengths > 0.0)]
    reach = 0.5 * max(found.surface.size)  # the longest lag to show: six correlation lengths, half the map at most
    if known.size:
        reach = min(reach, 6.0 * float(known.max()))
    in_unit = scale(reach, "m")
    ax.set(xlabel=f"lag ({in_unit.symbol})", ylabel="R/R(0)", xlim=(0.0, float(in_unit(reach))))
    ax.axhline(0.0, color="0.7", linewidth=0.7)
    for level, name in ((DROP_1E, "1/e"), (DROP_TENTH, "0.1")):
        ax.axhline(level, color="0.5", linewidth=0.7, linestyle=":")
        ax.annotate(
            name,
            (1.0, level),
            xycoords=("axes fraction", "data"),
            xytext=(3, 0),
            textcoords="offset points",
            va="center",
        )
    if covariance.mean_square > 0.0:
        for axis, colour in (("x", BLUE), ("y", ORANGE)):
            lags, values = covariance.along(axis)
            part = lags <= min(reach, longest)
            length = float(in_unit(getattr(found.spatial, f"beta_e_{axis}")))
            label = f"along {axis}" + ("" if math.isnan(length) else f", $\\beta_e$ {length:.3g} {in_unit.symbol}")
            ax.plot(in_unit(lags[part]), values[part] / covariance.mean_square, color=colour, label=label)
        ax.legend(loc="upper right")
    return ax


# A surface seen from the side in space, and its summits seen from above.


def plot_surface_view(surface: Surface, ax: Axes) -> Axes:
    """Draw ``surface`` in space, lit from the upper left, on the three-dimensional axes ``ax``.

    Heights are exaggerated to a fifth of the longer side; large maps are thinned to 180 points
    along it by block averages. Missing points are gaps. A profile has no view.
    """
    heights, grid = _thinned(surface)
    return draw_view(heights, grid, ax, Look("m", "height", HEIGHT_MAP))


def plot_summits(found: Characterisation, ax: Axes) -> Axes:
    """Draw the heights of ``found`` and its summits (above 8 neighbours), larger dots for blunter
    ones, on ``ax``."""
    surface, summits = found.surface, found.curves.summits
    plot_heights(surface, ax)
    if 1 in surface.shape or summits.count == 0:
        return ax
    length = scale(max(surface.size), "m")
    radius = 1.0 / summits.curvature
    # area of a dot as the radius, about the mean; a map of a hundred thousand summits gets small
    # dots
    mean = min(12.0, 4000.0 / summits.count)
    area = np.clip(mean * radius / radius.mean(), 0.15 * mean, 6.0 * mean)
    x, y = (summits.i + 0.5) * surface.dx, (summits.j + 0.5) * surface.dy
    ax.scatter(length(x), length(y), s=area, color=VERMILLION, linewidths=0.0, alpha=0.85)
    ax.set_title(f"{summits.count} summits", loc="left")
    return ax


def _thinned(surface: Surface) -> tuple[RealArray, Grid]:
    """Heights about their mean, averaged over blocks."""
    return thinned(surface.heights - np.nanmean(surface.heights, dtype=np.float64), surface.grid)


# The power spectrum of a surface with its fitted model, and slopes and curvatures against the
# scale.


def plot_spectrum(found: Characterisation, ax: Axes) -> Axes:
    """Draw the radial mean of the power spectrum of ``found`` and the fitted model on ``ax``,
    logarithmically.

    The range that was fitted is shaded; wavelengths stand above. Convention: <h²> = (1/4π²) ∫ C
    d²q.
    """
    surface = found.surface
    unit = scale(math.sqrt(min(surface.grid.spacing) * max(surface.size)), "m")
    ax.set(xlabel=f"wavenumber q (rad/{unit.symbol})", ylabel=f"C ({unit.symbol}$^4$)")
    rings = found.spectra.radial
    if rings is None or not np.any(rings.psd > 0.0):
        ax.text(0.5, 0.5, "no spectrum", transform=ax.transAxes, ha="center", va="center")
        return ax
    ax.set(xscale="log", yscale="log")
    shown = rings.psd > 0.0
    q, psd = rings.q[shown] * unit.factor, rings.psd[shown] / unit.factor**4
    ax.plot(q, psd, color=BLUE, marker=".", markersize=3.5, linewidth=0.8, label="measured")
    fit = found.spectra.fit
    if fit is not None:
        waves = np.geomspace(fit.first, fit.last, 400)
        label = ", ".join(f"$q^{{{-exponent:.2f}}}$" for exponent in fit.model.exponents)
        if 0.0 < fit.model.hurst[0] <= 1.0:
            label += f", H = {fit.model.hurst[0]:.2f} ± {fit.hurst_error:.2f}"
        ax.plot(waves * unit.factor, fit.model.psd(waves) / unit.factor**4, color=VERMILLION, label=label)
        ax.axvspan(fit.first * unit.factor, fit.last * unit.factor, color=SKY, alpha=0.13, linewidth=0.0)
        bends = [(fit.model.rolloff_wavelength, r"$\lambda_r$", BLACK)] if fit.has_rolloff else []
        if len(fit.model.exponents) == 2:
            bends.append((fit.model.crossover_wavelength, r"$\lambda_c$", GREEN))
        for wavelength, name, colour in bends:
            label, place = f"{name} {show(wavelength, 'm', 3)}", 2.0 * math.pi / wavelength * unit.factor
            ax.axvline(place, color=colour, linewidth=0.8, linestyle=":", label=label)

    def turned(values: RealArray) -> RealArray:
        with np.errstate(divide="ignore"):
            wavelengths: RealArray = 2.0 * np.pi / np.asarray(values, dtype=float)
        return wavelengths

    both_ways: Any = (turned, turned)
    above = ax.secondary_xaxis("top", functions=both_ways)
    above.set_xlabel(f"wavelength ({unit.symbol})")
    ax.legend(loc="lower left")
    return ax


def plot_spectrum_map(found: Characterisation, ax: Axes) -> Axes:
    """Draw the two-dimensional power spectrum of ``found`` on ``ax``, logarithmic in colour, over
    all directions; q and -q have the same."""
    from matplotlib.colors import LogNorm

    surface, power = found.surface, found.spectra.power
    unit = scale(math.sqrt(min(surface.grid.spacing) * max(surface.size)), "m")
    ax.set(xlabel=f"wavenumber along x (rad/{unit.symbol})", ylabel=f"wavenumber along y (rad/{unit.symbol})")
    if power is None or min(surface.grid.shape) < 3 or not (power.psd > 0.0).any():
        ax.text(0.5, 0.5, "no spectrum", transform=ax.transAxes, ha="center", va="center")
        return ax
    (nx, ny), (dx, dy) = power.grid.shape, power.grid.spacing
    behind = power.psd[-np.arange(nx) % nx][:, ny - np.arange(ny // 2 + 1, ny)]
    whole = np.roll(np.hstack([power.psd, behind]), (nx // 2, ny // 2), axis=(0, 1)) / unit.factor**4
    largest = float(whole.max())
    least = max(float(np.quantile(whole[whole > 0.0], _DARKEST)), largest * _LEAST)
    (left, right), (low, high) = (
        (-(count // 2 + 0.5) * step, (count - count // 2 - 0.5) * step)
        for count, step in ((n, 2.0 * np.pi * unit.factor / (n * pixel)) for n, pixel in ((nx, dx), (ny, dy)))
    )
    norm = LogNorm(least, largest, clip=True)
    image = ax.imshow(whole.T, origin="lower", extent=(left, right, low, high), norm=norm, cmap="magma")
    ax.figure.colorbar(image, ax=ax, label=f"C ({unit.symbol}$^4$)")
    return ax


def plot_scale_dependence(found: Characterisation, ax: Axes) -> Axes:
    """Draw rms slopes (left) and curvatures (right) of profiles against the length of the stencil
    on ``ax``."""
    lengths = [curve.slope_length for curve in found.curves.scale if curve is not None]
    unit = scale(max((length[-1] for length in lengths), default=1.0), "m")
    ax.set(xlabel=f"length of the stencil ({unit.symbol})", ylabel="rms slope")
    ax.set(xscale="log", yscale="log")
    twin = ax.twinx()
    twin.set(yscale="log", ylabel=f"rms curvature (1/{unit.symbol})")
    for curve, style in zip(found.curves.scale, ("-", "--"), strict=True):
        if curve is not None and curve.slope.max() > 0.0:
            ax.plot(
                unit(curve.slope_length), curve.slope, color=BLUE, linestyle=style, label=f"slope along {curve.axis}"
            )
            curvature = curve.curvature * unit.factor
            twin.plot(unit(curve.curvature_length), curvature, color=ORANGE, linestyle=style)
            ax.plot([], [], color=ORANGE, linestyle=style, label=f"curvature along {curve.axis}")
    cutoff = found.sampling.tip_cutoff
    if math.isfinite(cutoff) and cutoff > 0.0:
        ax.axvline(float(unit(cutoff)), color=VERMILLION, linewidth=0.8, label=f"tip cut-off {show(cutoff, 'm', 3)}")
    if ax.lines:
        ax.legend(loc="lower left")
    return ax


# The standard figures of a surface, as PNG.


SURFACE_PLOTS = (
    map_of(
        "heights",
        "Heights",
        "Heights relative to their mean; missing points are grey.",
        lambda found: heights_field(found.surface),
        by_step=False,
    ),
    Plot(
        "view",
        "View",
        "The surface in space; how much heights are exaggerated stands above.",
        lambda found, ax: plot_surface_view(found.surface, ax),
        "view",
    ),
    Plot(
        "distribution",
        "Distribution of heights",
        "Probability density of the heights, and the normal density of the same deviation.",
        plot_height_distribution,
    ),
    Plot(
        "material_ratio",
        "Material ratio",
        "Material ratio (Abbott) curve with the equivalent line of the core; triangles for peaks and valleys.",
        plot_material_ratio,
    ),
    Plot(
        "spectrum",
        "Power spectrum",
        "Radial mean of the power spectrum and the fitted model; the range of the fit is shaded.",
        plot_spectrum,
    ),
    Plot(
        "spectrum_map",
        "Power spectrum by direction",
        "Two-dimensional power spectrum: round if the surface is the same in all directions.",
        plot_spectrum_map,
        "map",
    ),
    Plot(
        "autocorrelation",
        "Autocorrelation",
        "Autocorrelation along x and y; its falls to 1/e and to 0.1 define correlation lengths.",
        plot_autocorrelation,
    ),
    Plot(
        "scale_dependence",
        "Slope and curvature by scale",
        "Rms slope and curvature of profiles against the length of the stencil.",
        plot_scale_dependence,
    ),
    Plot(
        "summits",
        "Summits",
        "Points above all eight neighbours; the area of a dot grows with the radius of the summit.",
        plot_summits,
        "map",
    ),
)
"""The standard figures of a surface in the order of a report."""


def roughness_figures(found: Characterisation) -> tuple[Figure, ...]:
    """The standard figures of a characterised surface."""
    return figures_by(SURFACE_PLOTS, found)


def save_roughness_plots(found: Characterisation, folder: str | Path, *, overwrite: bool = False) -> tuple[Path, ...]:
    """Write the standard figures of a characterised surface as PNG into ``folder`` (made if
    missing).

    Raises OutputError if a file exists and ``overwrite`` is false, or the folder cannot be made or
    written.
    """
    return save_pictures(roughness_figures(found), folder, overwrite=overwrite)
