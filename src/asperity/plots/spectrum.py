"""The power spectrum of a surface with its fitted model, and slopes and curvatures against the scale."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.arrays import RealArray
from ..core.units import show
from ..surfaces.characterise.spectral_fit import SpectralFit
from ..surfaces.characterise.summary import Characterisation
from .style import BLACK, BLUE, GREEN, ORANGE, SKY, VERMILLION, Scale, scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def plot_spectrum(found: Characterisation, ax: Axes) -> Axes:
    """Draw the radial mean of the power spectrum of ``found`` and the fitted model on ``ax``, logarithmically.

    The range that was fitted is shaded; wavelengths stand above. Convention: <h²> = (1/4π²) ∫ C d²q.
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
    if found.spectra.fit is not None:
        _draw_fit(found.spectra.fit, unit, ax)
    _wavelengths(unit, ax)
    ax.legend(loc="lower left")
    return ax


def plot_scale_dependence(found: Characterisation, ax: Axes) -> Axes:
    """Draw rms slopes (left) and curvatures (right) of profiles against the length of the stencil on ``ax``."""
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


def _draw_fit(fit: SpectralFit, unit: Scale, ax: Axes) -> None:
    q = np.geomspace(fit.first, fit.last, 400)
    ax.plot(q * unit.factor, fit.model.psd(q) / unit.factor**4, color=VERMILLION, label=_fit_text(fit))
    ax.axvspan(fit.first * unit.factor, fit.last * unit.factor, color=SKY, alpha=0.13, linewidth=0.0)
    bends = [(fit.model.rolloff_wavelength, r"$\lambda_r$", BLACK)] if fit.has_rolloff else []
    if len(fit.model.exponents) == 2:
        bends.append((fit.model.crossover_wavelength, r"$\lambda_c$", GREEN))
    for wavelength, name, colour in bends:
        label = f"{name} {show(wavelength, 'm', 3)}"
        ax.axvline(2.0 * math.pi / wavelength * unit.factor, color=colour, linewidth=0.8, linestyle=":", label=label)


def _fit_text(fit: SpectralFit) -> str:
    laws = ", ".join(f"$q^{{{-exponent:.2f}}}$" for exponent in fit.model.exponents)
    hurst = fit.model.hurst[0]
    return f"{laws}, H = {hurst:.2f} ± {fit.hurst_error:.2f}" if 0.0 < hurst <= 1.0 else laws


def _wavelengths(unit: Scale, ax: Axes) -> None:
    """Axis above the spectrum with wavelengths 2π/q."""

    def turned(values: RealArray) -> RealArray:
        with np.errstate(divide="ignore"):
            turned_: RealArray = 2.0 * np.pi / np.asarray(values, dtype=float)
        return turned_

    both_ways: Any = (turned, turned)
    above = ax.secondary_xaxis("top", functions=both_ways)
    above.set_xlabel(f"wavelength ({unit.symbol})")
