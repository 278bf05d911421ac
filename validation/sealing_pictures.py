"""Pictures of the sealing of contacts: the gap just before and after it closes, and the leak rate
against load with its estimates.

The numbers are on the pages percolation and leakage; ``pictures.py`` writes the pictures.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import leakage
import numpy as np
import percolation

import asperity as asp
from asperity import sealing
from asperity.plots.picture import BLACK, BLUE, GREEN, VERMILLION

if TYPE_CHECKING:
    from matplotlib.figure import Figure

POINTS, LOADS = 256, 9


def closing(figure: Figure) -> None:
    """Contact and the fluid's way through the gap, just before and just after it closes."""
    surface = percolation.rough(0.8, 1, POINTS)
    problem = asp.ContactProblem(surface, asp.Elastic(percolation.E_STAR, 0.0))
    unit = percolation.E_STAR * percolation.rms_gradient(surface)
    found = sealing.closing_load(problem, (0.1 * unit, 0.6 * unit), rounds=percolation.ROUNDS)
    for ax, load, title in zip(figure.subplots(1, 2), (found.lower, found.upper), ("open", "closed"), strict=True):
        result = asp.solve(problem, asp.MeanPressure(load))
        leak = sealing.leakage(result, leakage.WATER, 1.0)
        shown = np.where(result.contact, 0.0, np.where(leak.flow.net.carrying, 2.0, 1.0))
        ax.imshow(shown.T, origin="lower", cmap="Blues", vmin=-0.6, vmax=2.4, interpolation="nearest")
        ax.set(
            title=f"{title}: {100.0 * result.area_fraction:.1f} % contact",
            xlabel="pixels along the flow",
            ylabel="pixels across",
        )


def against_load(figure: Figure) -> None:
    """K of one surface against the load up to closing: solved, Bruggeman, critical junctions."""
    surface = leakage.rough(leakage.HURST, 0, POINTS)
    problem = asp.ContactProblem(surface, asp.Elastic(leakage.E_STAR, 0.0))
    unit = leakage.E_STAR * leakage.rms_gradient(surface)
    loads = np.linspace(0.01, 0.17, LOADS)
    found = [leakage.leak_of(problem, float(load) * unit) for load in loads]
    ax = figure.subplots()
    ax.semilogy(loads, [one.flow for one in found], "o-", color=BLACK, label="solved")
    ax.semilogy(loads, [one.medium for one in found], color=BLUE, label="Bruggeman")
    ax.semilogy(loads, [one.throat_gap for one in found], color=GREEN, label="constriction of the contact")
    theory = [leakage.junction(float(load)) for load in loads]
    ax.semilogy(loads, theory, "--", color=VERMILLION, label="critical junction by theory")
    ax.set(xlabel="mean pressure / (E* h')", ylabel="K / rms height³")
    ax.legend()


FIGURES: dict[str, tuple[Callable[[Figure], None], tuple[float, float]]] = {
    "closing": (closing, (9.0, 4.5)),
    "leak_against_load": (against_load, (6.0, 4.5)),
}
"""Name of the file -> how to draw it, width and height in inches."""
