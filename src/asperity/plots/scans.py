"""Figures of many scans of one surface: spectrum, scale-dependent parameters, and the waves that
decide a contact."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ..core.units import show
from ..surfaces.characterise.scans_scales import ScaleCurve
from ..surfaces.characterise.scans_spectrum import ScansSpectrum
from ..theories.rough.deciding_waves import DecidingWaves
from .picture import BLACK, BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILLION, Plot, legend_above, scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def plot_scans_spectrum(found: ScansSpectrum, ax: Axes) -> Axes:
    """Draw the combined C1D of ``found`` with its standard errors and the fitted spectrum on
    ``ax``, logarithmically; bars below are the reliable waves of each scan."""
    curve = found.curve
    unit = scale(float(2.0 * np.pi / np.sqrt(curve.q[0] * curve.q[-1])), "m")
    ax.set(xlabel=f"wavenumber q (rad/{unit.symbol})", ylabel=f"C1D ({unit.symbol}$^3$)", xscale="log", yscale="log")
    shown = curve.profile_psd > 0.0
    q, psd = curve.q[shown] * unit.factor, curve.profile_psd[shown] / unit.factor**3
    error = curve.error[shown]
    bars = psd * np.array([1.0 - 1.0 / (1.0 + error), error])  # equal factors up and down
    ax.errorbar(q, psd, yerr=bars, color=BLUE, fmt=".", markersize=4.0, linewidth=0.8, label="all scans")
    waves = np.geomspace(curve.q[0], curve.q[-1], 300)
    label = f"{found.model.name} roll-off, H = {found.hurst:.3g} ± {found.hurst_error:.2g}"
    ax.plot(waves * unit.factor, found.profile_psd(waves) / unit.factor**3, color=VERMILLION, label=label)
    if found.rolloff_seen:
        place = found.model.corner * unit.factor
        name = f"roll-off {show(found.rolloff_wavelength, 'm', 3)}"
        ax.axvline(place, color=BLACK, linewidth=0.8, linestyle=":", label=name)
    for number, (name, (short, long)) in enumerate(zip(found.scans, found.bands, strict=True)):
        height = float(psd.min()) * 0.4 ** (number + 1)
        band = 2.0 * np.pi / np.array([long, short]) * unit.factor
        ax.plot(band, [height, height], color=SKY, linewidth=3.0)
        ax.annotate(name, (float(band[0]), height), fontsize="small", va="bottom")
    ax.legend(loc="upper right")
    return ax


def plot_scale_curve(curves: Mapping[str, ScaleCurve], ax: Axes, quantity: str = "slope") -> Axes:
    """Draw a rms ``quantity`` of profiles (height, slope or curvature) of the ``curves`` against
    the length it is measured over on ``ax``, logarithmically, with its standard errors, and what
    the fitted spectrum expects."""
    curve = curves[quantity]
    across, up = scale(curve.length, "m"), scale(curve.value, _UNITS[quantity])
    name = f"rms {quantity}" + (f" ({up.symbol})" if up.symbol else "")
    ax.set(xlabel=f"length ({across.symbol})", ylabel=name, xscale="log", yscale="log")
    known = np.where(np.isfinite(curve.error), curve.error, 0.0)
    bars = up(curve.value) * np.array([1.0 - 1.0 / (1.0 + known), known])
    ax.errorbar(
        across(curve.length),
        up(curve.value),
        yerr=bars,
        color=BLUE,
        fmt=".",
        markersize=4.0,
        linewidth=0.8,
        label="all scans",
    )
    ax.plot(across(curve.length), up(curve.expected), color=VERMILLION, label="fitted spectrum")
    ax.legend()
    return ax


_UNITS = {"height": "m", "slope": "1", "curvature": "1/m"}


def plot_shares(waves: DecidingWaves, ax: Axes) -> Axes:
    """Draw the share of every octave of wavelengths in the answers of the contact of ``waves`` on
    ``ax``."""
    edges = np.append(waves.longest, waves.shortest[-1:])
    unit = scale(float(np.sqrt(edges[0] * edges[-1])), "m")
    for (name, shares), (colour, line) in zip(waves.shares.items(), _LINES, strict=False):
        ax.stairs(100.0 * shares[::-1], unit(edges[::-1]), color=colour, linestyle=line, label=name.replace("_", " "))
    ax.set(xlabel=f"wavelength ({unit.symbol})", ylabel="share of an octave (%)", xscale="log")
    return legend_above(ax, columns=4)


_LINES = (
    (BLACK, ":"),
    (SKY, ":"),
    (GREEN, ":"),
    (BLUE, "-"),
    (VERMILLION, "-"),
    (ORANGE, "--"),
    (PURPLE, "--"),
)
"""Colour and line by question: of the surface alone, the areas, the gap and the compliance."""

SCANS_PLOTS = (
    Plot(
        "spectrum",
        "Spectrum of all scans",
        "Combined profile spectrum with standard errors, the fit, and the reliable waves of each scan.",
        plot_scans_spectrum,
    ),
)
"""Figures of the spectrum of many scans."""

SCALES_PLOTS = tuple(
    Plot(
        f"{quantity}_by_length",
        f"Rms {quantity} by length",
        f"Rms {quantity} of profiles {how}, with standard errors of lines and maps, and what the fit expects.",
        partial(plot_scale_curve, quantity=quantity),
    )
    for quantity, how in (
        ("height", "in windows of a length, less their line"),
        ("slope", "between points a length apart"),
        ("curvature", "of three points over a length"),
    )
)
"""Figures of the scale-dependent parameters by quantity."""

WAVES_PLOTS = (
    Plot(
        "deciding_waves",
        "Waves that decide the contact",
        "Share of every octave of wavelengths in the answers of the contact, by Persson's theory.",
        plot_shares,
    ),
)
"""Figures of the waves that decide a contact."""
