"""Pictures after the figures of Martins, Oden and Simoes (1990): steady sliding, flutter,
stick-slip and apparent friction of a sliding block.

The numbers and statements are on the page sliding_block; ``pictures.py`` writes the pictures.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import sliding_block

from asperity import dynamics as dyn
from asperity.physics.dynamics.figures import plot_branches
from asperity.plots.picture import BLACK, BLUE, GREEN, VERMILLION

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SPEEDS = np.geomspace(3e-4, 3e-2, 9)
"""Of the belt in m/s."""

FRICTIONS = np.linspace(0.24, 0.5, 14)
"""Along which steady sliding loses its stability."""

SLIDES, WINDOW, GROWS = 0.25, 0.1, 0.15
"""Seconds that the block slides, the last of them that are averaged, and those in which a vibration
grows."""


def traces(figure: Figure) -> None:
    """Spring force in time from rest: steady sliding, flutter on the plateau, stick-slip at low
    speed; below normal force and penetration of the flutter."""
    axes = figure.subplots(2, 3)
    steady, flutter = (
        dyn.move_block(replace(sliding_block.BLOCK, law=sliding_block.law(friction, 4e19)), 0.25)
        for friction in (0.2, 0.35)
    )
    stick_slip = sliding_block.slow(0.5, 3e19, 4e-4)
    for ax, run, title in zip(
        axes[0],
        (steady, flutter, stick_slip),
        ("μ = 0.2: steady sliding", "μ = 0.35: flutter", "0.4 mm/s, stiffer spring: stick-slip"),
        strict=True,
    ):
        limit = run.block.friction
        ax.plot(1e3 * run.motion.time, run.motion["spring_force"] / run.block.load, color=BLUE, linewidth=0.5)
        ax.axhline(limit, color=BLACK, linestyle="--", linewidth=0.8)
        ax.set(title=title, xlabel="time (ms)", ylabel="spring force / W", ylim=(0.0, 1.15 * limit))
    late = flutter.motion.after(0.22)
    shown = slice(0, 400)
    axes[1, 0].plot(1e3 * late.time[shown], late["normal_force"][shown] / flutter.block.load, color=VERMILLION)
    axes[1, 0].set(xlabel="time (ms)", ylabel="normal force / W", title="flutter: normal force")
    base = late["velocity"] + 0.5 * flutter.block.height * late["tilt_rate"]
    axes[1, 1].plot(1e9 * late["penetration"][shown], 1e3 * base[shown], color=GREEN, linewidth=0.6)
    axes[1, 1].axhline(1e3 * flutter.block.speed, color=BLACK, linestyle="--", linewidth=0.8)
    axes[1, 1].set(
        xlabel="penetration (nm)",
        ylabel="velocity of the base (mm/s)",
        title="flutter: the base catches up with the belt",
    )
    x = stick_slip.motion["displacement"]
    axes[1, 2].plot(1e6 * x, 1e3 * stick_slip.motion["velocity"], color=BLUE, linewidth=0.6)
    axes[1, 2].set(xlabel="displacement (µm)", ylabel="velocity (mm/s)", title="stick-slip: phase portrait")
    figure.subplots_adjust(wspace=0.35, hspace=0.45)


def friction(figure: Figure) -> None:
    """Mean spring force over μW against the speed of the belt, and extremes of the penetration
    along the coefficient of friction."""
    left, right = figure.subplots(1, 2)
    for damping, colour in ((4e19, BLUE), (8e19, VERMILLION)):
        block = replace(sliding_block.BLOCK, law=sliding_block.law(0.5, damping))
        found = dyn.sweep_block(block, "speed", list(SPEEDS), duration=SLIDES, window=WINDOW)
        label = f"$b_n$ = {damping / 1e19:g}e19 Pa s/m³"
        left.semilogx(1e3 * SPEEDS, found.numbers["friction_reduction"], "o-", color=colour, markersize=4, label=label)
    left.axhline(1.0, color=BLACK, linestyle="--", linewidth=0.8)
    left.set(xlabel="speed of the belt (mm/s)", ylabel="mean spring force / μW", title="apparent friction, μ = 0.5")
    left.legend(frameon=False)
    block = replace(sliding_block.BLOCK, law=sliding_block.law(0.4, 4e19))
    plot_branches(
        dyn.bifurcation(block, "friction", list(FRICTIONS), duration=GROWS), right, label="friction coefficient"
    )
    right.axvline(block.critical_friction(), color=BLACK, linestyle="--", linewidth=0.8)
    right.annotate("boundary by eigenvalues", (block.critical_friction(), 0.1), (6, 0), textcoords="offset points")
    figure.subplots_adjust(wspace=0.3)


FIGURES: dict[str, tuple[Callable[[Figure], None], tuple[float, float]]] = {
    "block_traces": (traces, (12.0, 6.5)),
    "block_friction": (friction, (10.0, 4.0)),
}
"""Name of the file -> how to draw it, width and height in inches."""
