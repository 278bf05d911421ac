"""Figure of a prediction: solved numbers in their bands."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ...plots.picture import BLUE, VERMILLION, Plot, legend_above

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class Beside:
    """Label, unit, predicted mean, ends of its band and solved number of each quantity."""

    rows: tuple[tuple[str, str, float, float, float, float], ...]


def plot_beside(shown: Beside, axes: Axes) -> Axes:
    """Band of 19 of 20 surfaces and the solved number, over the predicted mean."""
    labels = [row[0] for row in shown.rows]
    for place, (_, _, mean, low, high, value) in enumerate(shown.rows):
        ends = [low / mean, high / mean]
        axes.plot(ends, [place, place], color=BLUE, linewidth=6.0, alpha=0.35, label="19 of 20" if not place else None)
        axes.plot([1.0], [place], "|", color=BLUE, markersize=12.0, label="predicted" if not place else None)
        axes.plot([value / mean], [place], "o", color=VERMILLION, label="solved" if not place else None)
    axes.set_yticks(range(len(labels)), labels)
    axes.set_ylim(len(labels) - 0.5, -0.5)
    axes.set_xlabel("over the predicted mean")
    return legend_above(axes, columns=3)


PLOTS = (
    Plot(
        "prediction",
        "Solved beside predicted",
        "Solved numbers over what the table of solved contacts expects, with its bands.",
        plot_beside,
    ),
)
"""Figures of a prediction."""
