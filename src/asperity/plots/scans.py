"""Figure of the spectrum of many scans."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..core.units import show
from ..surfaces.characterise.scans_spectrum import ScansSpectrum
from .picture import BLACK, BLUE, SKY, VERMILLION, Plot, scale

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


SCANS_PLOTS = (
    Plot(
        "spectrum",
        "Spectrum of all scans",
        "Combined profile spectrum with standard errors, the fit, and the reliable waves of each scan.",
        plot_scans_spectrum,
    ),
)
"""Figures of the spectrum of many scans."""
