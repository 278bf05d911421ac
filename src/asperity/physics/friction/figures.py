"""Figures of stick and slip: where points stick and slip, what slip dissipates, traction along a
line, and loops of force and shift."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...contact.history import HistoryResult
from ...contact.result import ContactResult
from ...core.units import show
from ...plots.maps import Field, Kinds, Look, enlarge_contact, map_of
from ...plots.picture import BLACK, BLUE, NO_CONTACT, PRESSURE_MAP, VERMILLION, Plot, legend_above, scale
from .fretting import kinds, loop_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CLASSES = (("open", NO_CONTACT), ("sticks", BLUE), ("slips", VERMILLION))
"""Name and colour of each kind of point, in the order of their numbers."""


def stick_slip_kinds(result: ContactResult) -> Kinds:
    """Where the surfaces of ``result`` are open, stick, and slip in the last step; InputError if it
    has no stick and slip."""
    return Kinds(np.asarray(kinds(result), dtype=float), result.problem.grid, CLASSES)


def dissipation_field(thing: ContactResult | HistoryResult) -> Field:
    """Energy per area that slip has dissipated in the step of a result, or in all steps of a
    history; blank where nothing slips."""
    steps = thing.steps if isinstance(thing, HistoryResult) else (thing,)
    density = np.sum([step.require_stick_slip().dissipation_density for step in steps], axis=0)
    drawn = np.where(density > 0.0, density, np.nan)
    blank = "no slip"
    look = Look("J/m²", "energy dissipated by slip", PRESSURE_MAP, blank=blank, blank_value=0.0, reduced="max")
    return Field(drawn, steps[-1].problem.grid, look)


def plot_shear_section(result: ContactResult, ax: Axes) -> Axes:
    """Draw the shear traction of ``result`` along x through its largest value on ``ax``, between
    the bounds of the friction.

    The traction is that along the tangential force.
    """
    found, grid = result.require_stick_slip(), result.problem.grid
    row = int(np.unravel_index(np.argmax(found.traction_magnitude), grid.shape)[1])
    force = np.array([found.force_x, found.force_y])
    size = float(np.hypot(*force))
    along = force / size if size > 0.0 else np.array([1.0, 0.0])
    traction = np.tensordot(along, found.traction[:, :, row], axes=1)
    bound = found.law.bound(result.pressure)[:, row]
    bound = np.where(np.isfinite(bound), bound, np.nan)
    length, in_pa = scale(grid.size[0], "m"), scale(np.append(bound, traction), "Pa")
    x = length((np.arange(grid.shape[0]) + 0.5) * grid.spacing[0])
    ax.fill_between(x, -in_pa(bound), in_pa(bound), color="0.88", linewidth=0.0, label="bound of the friction")
    ax.plot(x, in_pa(traction), color=BLUE, label="shear traction")
    ax.axhline(0.0, color=BLACK, linewidth=0.5)
    place = f", at y = {show((row + 0.5) * grid.spacing[1], 'm')}" if grid.shape[1] > 1 else ""
    ax.set(
        xlabel=f"x ({length.symbol}){place}",
        ylabel=f"shear traction ({in_pa.symbol})",
        xlim=(0.0, float(length(grid.size[0]))),
    )
    return legend_above(ax)


def plot_shear_loop(history: HistoryResult, ax: Axes) -> Axes:
    """Draw the tangential force of ``history`` against the shift, both along the largest shift, on
    ``ax``."""
    loop = loop_of(history.steps)
    first = loop.cycles[0][0] if loop.cycles else len(loop.shift) - 1
    zero = [0.0] if history.start is None and loop.shift[0] != 0.0 else []
    in_m, in_n = scale(loop.shift, "m"), scale(loop.force, "N")
    shift, force = in_m(np.append(zero, loop.shift)), in_n(np.append(zero, loop.force))
    ax.axhline(0.0, color="0.8", linewidth=0.5)
    ax.axvline(0.0, color="0.8", linewidth=0.5)
    turn = first + len(zero)
    ax.plot(shift[: turn + 1], force[: turn + 1], color=BLACK, marker=".", linestyle="--", label="first shift")
    if loop.cycles:
        ax.plot(shift[turn:], force[turn:], color=BLUE, marker=".", label="cycles")
    ax.set(xlabel=f"shift ({in_m.symbol})", ylabel=f"tangential force ({in_n.symbol})")
    return legend_above(ax)


SHEAR_PLOTS = (
    map_of(
        "stick_slip",
        "Stick and slip",
        "Where the surfaces are open, stick, and slip in the last step; shares of the nominal area.",
        stick_slip_kinds,
        enlarge_contact,
    ),
    Plot(
        "shear_section",
        "Shear traction",
        "Shear traction along x through its largest value, along the tangential force, between the bounds "
        "that the friction sets. Points on the bound slip.",
        plot_shear_section,
    ),
    map_of(
        "dissipation",
        "Heat",
        "Energy per area that slip dissipates in the last step; grey where nothing slips.",
        dissipation_field,
        enlarge_contact,
        by_step=False,
    ),
)
"""Figures of a result with stick and slip in the order of a report."""

LOOP_PLOTS = (
    Plot(
        "loop",
        "Tangential force against shift",
        "Tangential force against shift, both along the largest shift. The area within a loop is the energy "
        "that a cycle takes.",
        plot_shear_loop,
    ),
    map_of(
        "dissipation",
        "Heat of the history",
        "Energy per area that slip has dissipated in all steps; grey where nothing has slipped.",
        dissipation_field,
        by_step=False,
    ),
)
"""Figures of a history with stick and slip."""
