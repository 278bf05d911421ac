"""Pictures of the pages joint_conductance and conductance_stiffness.

``pictures.py`` writes them.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import conductance_stiffness
import joint_conductance
import numpy as np

from asperity.plots.picture import BLACK, BLUE, GREEN, ORANGE, VERMILLION

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLOURS = (BLUE, VERMILLION, GREEN, ORANGE)


def joints(figure: Figure) -> None:
    """Dimensionless conductance over P/H: theory, correlation and solved joints, and both over the
    theory."""
    ax, beside = figure.subplots(1, 2)
    exact, fitted = joint_conductance.theory()
    shares = np.array(joint_conductance.SHARES)
    ax.loglog(shares, exact, color=BLACK, label="Cooper, Mikic & Yovanovich")
    ax.loglog(shares, fitted, "--", color=BLACK, label="1.25 (P/H)^0.95")
    for (slope, hardness), colour in zip(joint_conductance.CASES, COLOURS, strict=False):
        found = joint_conductance.solved(slope, hardness, 512, 12.0, 2)
        label = f"rms slope {slope:g}, H = {hardness:g} E*"
        ax.loglog(shares, found.scaled.mean(axis=0), "o", color=colour, label=label, fillstyle="none")
        beside.semilogx(shares, found.scaled.mean(axis=0) / exact, "o-", color=colour, fillstyle="none")
    beside.semilogx(shares, fitted / exact, "--", color=BLACK)
    beside.axhline(1.0, color=BLACK)
    beside.set(xlabel="P/H", ylabel="conductance / Cooper, Mikic & Yovanovich", ylim=(0.0, 1.2))
    ax.set(xlabel="P/H", ylabel="h σ/(k_s m)")
    ax.legend()


def stiffness(figure: Figure) -> None:
    """u_0 over the rms height along the load, of several Hurst exponents and resolutions."""
    ax = figure.subplots()
    loads = np.array(conductance_stiffness.LOADS)
    ax.axhspan(0.4, 0.5, color="0.9", label="0.4 to 0.5, published")
    for (hurst, shortest), colour in zip(conductance_stiffness.CASES, COLOURS, strict=True):
        found = conductance_stiffness.solved(hurst, shortest, 256, 3)
        mean, spread = found.decay.mean(axis=0), found.decay.std(axis=0, ddof=1)
        label = f"H = {hurst:g}, {shortest:g} pixels per wave"
        ax.errorbar(loads, mean, spread, fmt="o-", color=colour, label=label, capsize=2)
    ax.set(xlabel="pressure / (E* rms gradient)", ylabel="u_0 / rms height", xscale="log", ylim=(0.0, 0.7))
    ax.set_xticks(loads, [f"{load:g}" for load in loads])
    ax.minorticks_off()
    ax.legend()


FIGURES: dict[str, tuple[Callable[[Figure], None], tuple[float, float]]] = {
    "joint_conductance": (joints, (9.0, 4.0)),
    "conductance_stiffness": (stiffness, (5.0, 4.0)),
}
"""Name of the file -> how to draw it, width and height in inches."""
