"""Figures of motion on a rough interface: the fitted law, time series, phase portraits, stability,
friction against speed, frames of a run."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ...core.errors import InputError
from ...core.units import show
from ...plots.animation import save_frames
from ...plots.picture import (
    BLACK,
    BLUE,
    GREEN,
    ORANGE,
    VERMILLION,
    Figure,
    Plot,
    figures_by,
    legend_above,
    make_room,
    scale,
    style,
)
from .block_motion import BlockRun
from .sweeps import Branches, StabilityMap

if TYPE_CHECKING:
    from matplotlib.axes import Axes


LAST = 300
"""Samples of the phase portrait of the normal motion: 30 periods at 10 samples each."""


def plot_compliance(values: Mapping[str, Any], ax: Axes) -> Axes:
    """Draw the contact curve and the law that was fitted to it on ``ax``, on logarithmic axes.

    ``values`` are ``curve_approach`` (n,) in m from where the law begins, ``curve_pressure`` (n,)
    in Pa, and ``interface_exponent``.
    """
    depth, pressure, power = values["curve_approach"], values["curve_pressure"], values["interface_exponent"]
    in_m, in_pa = scale(depth, "m"), scale(pressure, "Pa")
    line = np.geomspace(depth[0], depth[-1], 100)
    level = np.exp(np.mean(np.log(pressure) - power * np.log(depth)))
    ax.loglog(in_m(depth), in_pa(pressure), "o", color=BLACK, markersize=4, label="contact")
    ax.loglog(in_m(line), in_pa(level * line**power), color=BLUE, label=f"power {power:.3g}")
    ax.set(xlabel=f"approach from where the law begins ({in_m.symbol})", ylabel=f"mean pressure ({in_pa.symbol})")
    from matplotlib.ticker import FuncFormatter, NullFormatter

    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda value, place: f"{value:g}"))
        low, high = axis.get_view_interval()
        # minor ticks need numbers on less than one power of ten
        axis.set_minor_formatter(FuncFormatter(_few_digits) if high / low < 10.0 else NullFormatter())
    return legend_above(ax)


def _few_digits(value: float, place: int | None) -> str:
    """Number of a minor tick, for 1, 2, 3 and 5 times a power of ten."""
    first = f"{value:.0e}"[0]
    return f"{value:g}" if first in "235" else ""


def plot_forces(values: Mapping[str, Any], ax: Axes) -> Axes:
    """Draw spring and normal force against time on ``ax``, as far as the motion has them."""
    time = values["motion_time"]
    shown = [
        (name, values[f"motion_{name}"]) for name in ("normal_force", "spring_force") if f"motion_{name}" in values
    ]
    in_s, in_n = scale(time, "s"), scale(np.concatenate([item for _, item in shown]), "N")
    for name, force in shown:
        look: dict[str, Any] = (
            {"color": "0.7", "linewidth": 0.5} if name == "normal_force" else {"color": BLUE, "linewidth": 1.2}
        )
        ax.plot(in_s(time), in_n(force), label=name.replace("_", " "), **look)
    ax.set(xlabel=f"time ({in_s.symbol})", ylabel=f"force ({in_n.symbol})", xlim=(0.0, float(in_s(time[-1]))))
    return legend_above(ax)


def plot_penetration(values: Mapping[str, Any], ax: Axes) -> Axes:
    """Draw the penetration against time on ``ax``."""
    time, penetration = values["motion_time"], values["motion_penetration"]
    in_s, in_m = scale(time, "s"), scale(penetration, "m")
    ax.plot(in_s(time), in_m(penetration), color=GREEN, linewidth=0.5)
    ax.axhline(0.0, color=BLACK, linewidth=0.5)
    ax.set(xlabel=f"time ({in_s.symbol})", ylabel=f"penetration ({in_m.symbol})", xlim=(0.0, float(in_s(time[-1]))))
    return ax


def plot_sliding_portrait(values: Mapping[str, Any], ax: Axes) -> Axes:
    """Draw velocity against displacement on ``ax``."""
    x, v = values["motion_displacement"], values["motion_velocity"]
    in_m = scale(x, "m")
    ax.plot(in_m(x), 1e3 * np.asarray(v), color=BLUE, linewidth=0.6)
    ax.axhline(0.0, color=BLACK, linewidth=0.5)
    ax.set(xlabel=f"displacement ({in_m.symbol})", ylabel="velocity (mm/s)")
    return ax


def plot_normal_portrait(values: Mapping[str, Any], ax: Axes) -> Axes:
    """Draw the normal force against the penetration, of the last ``LAST`` samples, on ``ax``."""
    late = slice(-LAST, None)
    depth, force = values["motion_penetration"][late], values["motion_normal_force"][late]
    in_m, in_n = scale(depth, "m"), scale(force, "N")
    ax.plot(in_m(depth), in_n(force), color=VERMILLION, linewidth=0.6)
    ax.set(xlabel=f"penetration ({in_m.symbol})", ylabel=f"normal force ({in_n.symbol})")
    return ax


def plot_friction_curve(values: Mapping[str, Any], ax: Axes) -> Axes:
    """Draw mean and largest friction against the speed of the belt on ``ax``."""
    for name, look in (
        ("largest", {"color": ORANGE, "marker": "s", "ls": "--"}),
        ("mean", {"color": BLUE, "marker": "o"}),
    ):
        friction = values[f"sweep_{name}_friction"]
        ax.semilogx(1e3 * np.asarray(values["sweep_speed"]), friction, markersize=3.5, label=name, **look)
    ax.set(xlabel="speed of the belt (mm/s)", ylabel="spring force / load")
    return legend_above(ax)


def plot_stability_of(values: Mapping[str, Any], ax: Axes) -> Axes:
    """Draw the map of stability over friction and damping on ``ax``."""
    found = StabilityMap(
        ("friction", "damping_ratio"),
        (values["map_friction"], values["map_damping"]),
        values["map_growth_rate"],
        np.full_like(values["map_growth_rate"], np.nan),
    )
    return plot_stability(found, ax, labels=("friction coefficient", "damping ratio"))


PLOTS = (
    (
        "curve_pressure",
        Plot(
            "dynamics_law",
            "Law of the interface",
            "Mean pressure against approach of the solved contact, and the power law of normal compliance "
            "that was fitted to it.",
            plot_compliance,
        ),
    ),
    (
        "motion_time",
        Plot(
            "dynamics_forces",
            "Forces in time",
            "Forces against time. The largest spring force is the apparent static friction, its mean the "
            "apparent kinetic one.",
            plot_forces,
        ),
    ),
    (
        "motion_penetration",
        Plot(
            "dynamics_penetration",
            "Penetration in time",
            "Penetration of the interface; below zero the base is open at its middle.",
            plot_penetration,
        ),
    ),
    (
        "motion_displacement",
        Plot(
            "dynamics_sliding",
            "Phase portrait of sliding",
            "Velocity against displacement. Where the velocity is that of the belt the block sticks to it.",
            plot_sliding_portrait,
        ),
    ),
    (
        "motion_normal_force",
        Plot(
            "dynamics_normal",
            "Phase portrait of the normal motion",
            "Normal force against penetration at the end of the motion: the loop is the work of the damping.",
            plot_normal_portrait,
        ),
    ),
    (
        "map_growth_rate",
        Plot(
            "dynamics_stability",
            "Stability of steady sliding",
            "Largest growth rate of small motion about steady sliding, over friction and damping of the "
            "interface. Beyond the line it grows.",
            plot_stability_of,
        ),
    ),
    (
        "sweep_speed",
        Plot(
            "dynamics_speed",
            "Friction against speed",
            "Mean and largest spring force over the load against the speed of the belt, each from a run that "
            "begins just below sliding.",
            plot_friction_curve,
        ),
    ),
)
"""Figures with the value that each needs, in the order of a report."""


def figures_of(values: Mapping[str, Any]) -> tuple[Figure, ...]:
    """Figures of the ``values`` of the quantities of a motion, as far as they are there."""
    return figures_by([plot for needed, plot in PLOTS if needed in values], values)


def plot_branches(found: Branches, ax: Axes, *, label: str = "") -> Axes:
    """Draw the extremes of the penetration along a parameter that grows and then falls on
    ``ax``."""
    for branch, (colour, name) in enumerate(((VERMILLION, "growing"), (BLUE, "falling"))):
        ax.plot(found.axis_values, found.highest[branch], "o-", color=colour, markersize=3, label=name)
        ax.plot(found.axis_values, found.lowest[branch], "o-", color=colour, markersize=3, fillstyle="none")
    ax.set(xlabel=label or found.axis, ylabel="extremes of the penetration / that at rest")
    return legend_above(ax)


def plot_stability(found: StabilityMap, ax: Axes, *, labels: tuple[str, str] | None = None) -> Axes:
    """Draw the largest growth rate of ``found`` on ``ax``, with the boundary of stability."""
    names = labels or (found.axes[0].replace("_", " "), found.axes[1].replace("_", " "))
    growth = found.growth_rate.T
    largest = float(np.nanmax(np.abs(growth))) if np.isfinite(growth).any() else 1.0
    make_room(ax, right=0.9)
    mesh = ax.pcolormesh(*found.axis_values, growth, cmap="PuOr_r", vmin=-largest, vmax=largest, shading="nearest")
    edge = (
        1e-6 * largest
    )  # without a dashpot the tangential motion neither grows nor decays: zero on all of the stable side
    if np.nanmin(growth) < edge < np.nanmax(growth):
        ax.contour(*found.axis_values, growth, levels=[edge], colors=BLACK, linewidths=1.0)
    bar = ax.inset_axes((1.03, 0.0, 0.04, 1.0))
    figure: Any = ax.figure
    figure.colorbar(mesh, cax=bar, label="growth rate (1/s)")
    ax.set(xlabel=names[0], ylabel=names[1])
    return ax


# Frames of a run.

FRAME_SIZE = (5.6, 2.8)
"""Width and height in inches of a frame."""


def plot_frame(run: BlockRun, place: int, ax: Axes) -> Axes:
    """Draw the block of ``run`` at the sample ``place`` on ``ax``: position, spring, and pressure
    along the base.

    Displacement and penetration are drawn enlarged: the largest displacement of the run as a fifth
    of the length of the block, the penetration at rest as a tenth of its height.
    """
    block, motion = run.block, run.motion
    if not 0 <= place < motion.time.size:
        raise InputError(f"place must be at least zero and below {motion.time.size}, but is {place!r}.")
    b, H = block.length, block.height
    largest = float(np.abs(motion["displacement"]).max())
    sideways, down = 0.2 * b / max(largest, 1e-300), 0.1 * H / block.rest
    x, y, tilt = (float(motion[name][place]) for name in ("displacement", "penetration", "tilt"))
    xi, _ = block.base
    pressure = block.law.pressure(y - xi * tilt, motion["penetration_rate"][place] - xi * motion["tilt_rate"][place])
    left, base = x * sideways, -y * down
    slope = tilt * down
    corners = np.array([[-0.5 * b, 0.0], [0.5 * b, 0.0], [0.5 * b, H], [-0.5 * b, H]])
    drawn = corners + np.column_stack([np.full(4, left), base + corners[:, 0] * slope])
    ax.fill(drawn[:, 0], drawn[:, 1], color="0.88", edgecolor=BLACK, linewidth=0.8)
    ax.axhline(0.0, color=BLACK, linewidth=0.8)
    depth = 0.25 * H * pressure / (block.load / block.area) / 2.0
    ax.fill_between(xi + left, -depth, 0.0, color=VERMILLION, alpha=0.7, linewidth=0.0, step="mid")
    wall, hook, height = -1.15 * b, float(drawn[0, 0]), 0.5 * H + block.spring_height
    coil = np.linspace(wall, hook, 60)
    ax.plot(coil, height + base + 0.05 * H * np.sin(np.linspace(0.0, 20.0 * np.pi, 60)), color=BLUE, linewidth=0.9)
    ax.plot([wall, wall], [0.0, 1.2 * H], color=BLACK, linewidth=1.5)
    ax.annotate("", (0.95 * b, -0.12 * H), (0.7 * b, -0.12 * H), arrowprops={"arrowstyle": "->", "lw": 1.0})
    force = float(motion["spring_force"][place]) / block.load
    ax.set_title(f"t = {show(float(motion.time[place]), 's', 4)}   spring force / load = {force:.3f}", loc="left")
    ax.set(xlim=(-1.2 * b, 1.0 * b), ylim=(-0.45 * H, 1.35 * H), xticks=[], yticks=[])
    ax.set(xlabel="belt moves to the right", ylabel="pressure below")
    ax.set_aspect("equal")
    return ax


def frames(run: BlockRun, places: Sequence[int], *, dpi: int = 100) -> tuple[bytes, ...]:
    """PNG of each of the sampled ``places`` of ``run``; all of one size."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure as Canvas

    made = []
    with style():
        for place in places:
            figure, buffer = Canvas(figsize=FRAME_SIZE, dpi=dpi), io.BytesIO()
            FigureCanvasAgg(figure)
            plot_frame(run, place, figure.add_axes((0.02, 0.02, 0.96, 0.86)))
            figure.savefig(buffer, format="png")
            made.append(buffer.getvalue())
    return tuple(made)


def save_animation(run: BlockRun, path: str | Path, *, count: int = 100, overwrite: bool = False) -> Path:
    """Write ``count`` frames of ``run``, evenly spaced in time, as an animated picture (.gif, .png
    or .webp) of 20 a second.

    Raises
    ------
    InputError
        If the suffix is another, or fewer than two frames are wanted.
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    places = [int(place) for place in np.linspace(0, run.motion.time.size - 1, max(count, 2)).round()]
    return save_frames(path, lambda: frames(run, places), count, pause=50, overwrite=overwrite)
