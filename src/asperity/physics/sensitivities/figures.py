"""Figures of sensitivities: bars of the parameters that decide, and the map of the asperities that
matter."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ...contact.problem import ContactProblem
from ...core.arrays import RealArray
from ...plots.maps import Field, Look, map_of
from ...plots.picture import BLACK, BLUE, SKY, VERMILLION, Plot, literal

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SIGNED_MAP = "RdBu_r"

MOST = 12
"""Parameters in bars at most, those of the largest sensitivity."""

LEAST = 0.005
"""Share of the largest below which a parameter has no bar."""


@dataclass(frozen=True, eq=False)
class Decisive:
    """What figures are drawn from: ``names`` of the parameters in words, relative sensitivities of
    each number by its label, and of the first one to each height (nx, ny) in 1/m, empty without."""

    problem: ContactProblem
    names: tuple[str, ...]
    relative: dict[str, RealArray]
    heights: RealArray


def plot_bars(shown: Decisive, ax: Axes, label: str) -> Axes:
    """Draw on ``ax`` bars of the relative sensitivities of the number of that ``label``, the
    largest on top."""
    values = shown.relative[label]
    size = np.abs(values)
    order = [k for k in np.argsort(-size) if size[k] >= LEAST * size.max()][:MOST][::-1]
    rows = np.arange(len(order))
    colours = [BLUE if values[k] > 0.0 else VERMILLION for k in order]
    ax.barh(rows, values[order], height=0.6, color=colours)
    ax.axvline(0.0, color=BLACK, linewidth=0.8)
    ax.set_yticks(rows, [literal(shown.names[k]) for k in order])
    ax.set_xlabel(f"change of the {label} in % by 1 %")
    return ax


def height_field(shown: Decisive, label: str) -> Field:
    """Relative change of the number by the height of each point, about zero, in % per nm."""
    look = Look("%/nm", f"change of the {label} by height", SIGNED_MAP, from_zero=False, about_zero=True)
    return Field(1e-7 * shown.heights, shown.problem.grid, look)


def plots(shown: Decisive) -> tuple[Plot, ...]:
    """Bars of each number, and the map of the first."""
    made = [
        Plot(
            f"sensitivities_{label.replace(' ', '_')}",
            f"What decides the {label}",
            f"Change of the {label} in percent by one percent of each parameter, the others held. Poisson's ratios "
            "change by one percent of themselves, heights all together.",
            partial(plot_bars, label=label),
        )
        for label in shown.relative
    ]
    if shown.heights.size:
        label = next(iter(shown.relative))
        made.append(
            map_of(
                "sensitivity_map",
                f"Asperities that decide the {label}",
                f"Relative change of the {label} by the height of each point: where it is zero, heights do not matter. "
                "An approach counts from a fixed height here, not from the highest point.",
                partial(height_field, label=label),
                by_step=False,
            )
        )
    return tuple(made)


@dataclass(frozen=True, eq=False)
class Contributing:
    """What figures of error bars are drawn from: ``names`` of the sources in words, and the
    deviation in % by each of them alone, of each number by its label."""

    names: tuple[str, ...]
    parts: dict[str, RealArray]


def plot_parts(shown: Contributing, ax: Axes, label: str) -> Axes:
    """Draw on ``ax`` bars of the contributions to the error bar of the number of that ``label``,
    the largest on top, and all together."""
    values = shown.parts[label]
    order = np.argsort(-values, kind="stable")[:MOST][::-1]
    rows = np.arange(order.size + 1)
    whole = float(np.sqrt((values**2).sum()))
    ax.barh(rows, [*values[order], whole], height=0.6, color=[*([SKY] * order.size), BLUE])
    ax.set_yticks(rows, [*(literal(shown.names[k]) for k in order), "all together"])
    ax.set_xlabel(f"standard deviation of the {label} (%)")
    return ax


def share_plots(shown: Contributing) -> tuple[Plot, ...]:
    """Bars of each number."""
    return tuple(
        Plot(
            f"uncertainty_{label.replace(' ', '_')}",
            f"What makes the {label} unsure",
            f"Relative standard deviation of the {label} by each source alone, and by all of them: squares add up.",
            partial(plot_parts, label=label),
        )
        for label in shown.parts
    )
