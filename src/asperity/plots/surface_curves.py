"""Curves of a surface: how heights are distributed, how much material lies above a height, how heights correlate."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.units import percent
from ..surfaces.characterise.correlation import DROP_1E, DROP_TENTH
from ..surfaces.characterise.material_ratio import core
from ..surfaces.characterise.summary import Characterisation
from .style import BLACK, BLUE, ORANGE, SKY, VERMILLION, Scale, scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_CURVE_POINTS = 800  # of a material ratio curve, whose heights may be millions


def plot_height_distribution(found: Characterisation, ax: Axes) -> Axes:
    """Draw the probability density of the heights and the normal density of the same deviation on ``ax``."""
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
    return _with_legend(ax)


def plot_material_ratio(found: Characterisation, ax: Axes) -> Axes:
    """Draw the material ratio (Abbott) curve with the line and the bounds of its core on ``ax``."""
    curve = found.curves.material_ratio
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
    for ratio, name in ((line.ratio_1, "Smr1"), (line.ratio_2, "Smr2")):
        ax.axvline(100.0 * ratio, color="0.6", linewidth=0.7, linestyle=":", label=f"{name} {percent(ratio)}")
    _fill_reduced(ax, line.ratio_1, (top, float(in_unit(line.reduced_peak))), at_left=True)
    _fill_reduced(ax, 1.0 - line.ratio_2, (bottom, -float(in_unit(line.reduced_valley))), at_left=False)
    ax.set_title(
        f"Sk {top - bottom:.3g}   Spk {float(in_unit(line.reduced_peak)):.3g}   Svk "
        f"{float(in_unit(line.reduced_valley)):.3g} {in_unit.symbol}",
        loc="right",
    )
    ax.legend(loc="lower left", frameon=True, edgecolor="none", framealpha=0.9)
    return ax


def plot_autocorrelation(found: Characterisation, ax: Axes) -> Axes:
    """Draw R/R(0) along x and y on ``ax`` with the levels 1/e and 0.1 that define correlation lengths."""
    covariance = found.curves.autocovariance
    longest = max(covariance.size)
    reach = _reach(found)
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
            label = f"along {axis}{_length_text(found, axis, in_unit)}"
            ax.plot(in_unit(lags[part]), values[part] / covariance.mean_square, color=colour, label=label)
        ax.legend(loc="upper right")
    return ax


def _reach(found: Characterisation) -> float:
    """Longest lag to show: six correlation lengths, half the map at most."""
    half = 0.5 * max(found.surface.size)
    lengths = np.array([found.spatial.beta_e_x, found.spatial.beta_e_y])
    known: RealArray = lengths[np.isfinite(lengths) & (lengths > 0.0)]
    return min(half, 6.0 * float(known.max())) if known.size else half


def _length_text(found: Characterisation, axis: str, in_unit: Scale) -> str:
    length = getattr(found.spatial, f"beta_e_{axis}")
    return f", $\\beta_e$ {float(in_unit(length)):.3g} {in_unit.symbol}" if length == length else ""


def _fill_reduced(ax: Axes, width: float, heights: tuple[float, float], *, at_left: bool) -> None:
    """Triangle of the area of peaks or valleys, from the level ``heights[0]`` by ``heights[1]``."""
    base, rise = heights
    corners = [(0.0, base), (0.0, base + rise), (100.0 * width, base)]
    if not at_left:
        corners = [(100.0 - x, y) for x, y in corners]
    ax.fill(*zip(*corners, strict=True), color=SKY, alpha=0.5, linewidth=0.0)


def _with_legend(ax: Axes) -> Axes:
    ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, borderaxespad=0.3, borderpad=0.2)
    return ax
