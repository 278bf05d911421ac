"""Pictures after fig. 2.8 of Peng (2001): plastic strain and σ_xx below a sphere that slides over a
layer; ``pictures.py`` writes them.

The numbers and statements are on the page layered_sliding.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING

from layered_sliding_runs import Case, Snapshots, run

from asperity.plots.picture import BLACK

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SHOWN = (-12.0, 24.0, 16.0, 0.0)
"""Limits of x and z in a_y."""


@cache
def sliding() -> Snapshots:
    """One pass of the case of the figure."""
    return run(Case(2.0, 0.1, passes=1))


def plastic_strain(figure: Figure) -> None:
    """Equivalent plastic strain in Y/E beside the plane of symmetry, indented and at the four
    distances."""
    _sections(figure, "strain", "plastic strain / (Y/E)", "viridis", symmetric=False)


def sigma_xx(figure: Figure) -> None:
    """σ_xx in Y beside the plane of symmetry, and after lifting."""
    _sections(figure, "along", "σ_xx / Y", "RdBu_r", symmetric=True)


def _sections(figure: Figure, name: str, label: str, colours: str, *, symmetric: bool) -> None:
    found = sliding()
    values = getattr(found, name)
    top = float(abs(values).max())
    axes = figure.subplots(3, 2, sharex=True, sharey=True).ravel()
    titles = ("indented", "Δx = 2 a_y", "Δx = 4 a_y", "Δx = 8 a_y", "Δx = 12 a_y", "lifted")
    for number, (ax, title) in enumerate(zip(axes, titles, strict=True)):
        mesh = ax.pcolormesh(
            found.x, found.z, values[number].T, cmap=colours, vmin=-top if symmetric else 0.0, vmax=top
        )
        ax.axhline(1.0, color=BLACK, linewidth=0.5)
        ax.plot(found.centre[number], 0.0, "v", color=BLACK, clip_on=False)
        ax.set(title=title, xlim=SHOWN[:2], ylim=SHOWN[2:])
    for ax in axes[::2]:
        ax.set_ylabel("z/a_y")
    for ax in axes[-2:]:
        ax.set_xlabel("x/a_y")
    figure.colorbar(mesh, ax=list(axes), label=label, shrink=0.8)


FIGURES: dict[str, tuple[Callable[[Figure], None], tuple[float, float]]] = {
    "plastic_strain_sliding": (plastic_strain, (9.0, 6.5)),
    "sigma_xx_sliding": (sigma_xx, (9.0, 6.5)),
}
