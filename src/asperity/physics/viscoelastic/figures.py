"""Figures of viscoelastic contacts: area, approach and energies against time, moduli of the solids,
friction and area against speed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ...contact.problem import ContactProblem
from ...core.arrays import RealArray
from ...plots.maps import Field, Look, plot_map
from ...plots.picture import (
    BLACK,
    BLUE,
    GREEN,
    ORANGE,
    PRESSURE_MAP,
    PURPLE,
    VERMILLION,
    Plot,
    legend_above,
    literal,
    scale,
)
from ...solids.layers import materials_of
from ...solids.viscoelastic import Viscoelastic

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_COLOURS = (BLUE, ORANGE, GREEN, PURPLE, VERMILLION)

_POINTS = 200
"""Points of a curve of a solid."""


@dataclass(frozen=True, eq=False)
class TimePicture:
    """What figures against time are drawn from: columns of all moments, and at which moment each
    step of the load ends."""

    moments: Mapping[str, RealArray]
    ends: RealArray
    solids: tuple[Viscoelastic, ...] = ()


@dataclass(frozen=True, eq=False)
class SpeedPicture:
    """What figures of sliding are drawn from: pressure (nx, ny), direction (rad), and columns
    against speed, empty if there are none."""

    problem: ContactProblem
    pressure: RealArray
    direction: float
    curve: Mapping[str, RealArray] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class StartPicture:
    """What figures of the start of sliding are drawn from: pressure (nx, ny) after the distance,
    direction (rad), columns of all steps of time, and friction and area of the steady state, NaN
    where there is none."""

    problem: ContactProblem
    pressure: RealArray
    direction: float
    columns: Mapping[str, RealArray]
    friction: float
    area_fraction: float


def relaxing_solids(problem: ContactProblem) -> tuple[Viscoelastic, ...]:
    """The viscoelastic materials of both bodies that relax, each once."""
    found: dict[str, Viscoelastic] = {}
    for body in (problem.body, problem.counter_body):
        for solid in materials_of(body):
            if isinstance(solid, Viscoelastic) and solid.spectrum:
                found.setdefault(repr((solid.name, solid.youngs_modulus, solid.spectrum)), solid)
    return tuple(found.values())


def _against_time(shown: TimePicture, ax: Axes, curves: Mapping[str, tuple[str, str]], unit: str, label: str) -> Axes:
    """Curves (label and colour by column) against time, with lines where steps of the load end."""
    time = shown.moments["time"]
    in_s = scale(time, "s")
    in_unit = scale(np.concatenate([shown.moments[name] for name in curves]), unit)
    for name, (words, colour) in curves.items():
        ax.plot(in_s(time), in_unit(shown.moments[name]), color=colour, marker=".", markersize=3.0, label=words)
    for end in np.unique(shown.ends)[:-1]:
        ax.axvline(float(in_s(end)), color="0.8", linewidth=0.5, zorder=0)
    symbol = f" ({in_unit.symbol})" if in_unit.symbol else ""
    ax.set(xlabel=f"time ({in_s.symbol})", ylabel=f"{label}{symbol}", xlim=(0.0, float(in_s(time[-1]))))
    return legend_above(ax) if len(curves) > 1 else ax


plot_area_in_time = partial(
    _against_time,
    curves={"area_fraction": ("real contact area", BLUE)},
    unit="1",
    label="real contact area / nominal area",
)
plot_approach_in_time = partial(
    _against_time, curves={"approach": ("approach", BLUE)}, unit="m", label="approach from first touch"
)
plot_load_in_time = partial(
    _against_time, curves={"mean_pressure": ("mean pressure", BLACK)}, unit="Pa", label="mean pressure"
)
plot_energy_in_time = partial(
    _against_time,
    curves={"stored_energy": ("stored in the solids", BLUE), "dissipated": ("heat", VERMILLION)},
    unit="J",
    label="energy",
)


def _name(solid: Viscoelastic, number: int) -> str:
    return literal(solid.name) if solid.name else f"viscoelastic solid {number + 1}"


def _span(shown: TimePicture) -> RealArray:
    """Times (s) over which the solids relax."""
    times = [tau for solid in shown.solids for _, tau in solid.spectrum]
    times += [lam for solid in shown.solids for _, lam in solid.uniaxial_creep.terms]
    return np.geomspace(0.03 * min(times), 30.0 * max(times), _POINTS)


def plot_relaxation(shown: TimePicture, ax: Axes) -> Axes:
    """Draw the relaxation modulus of every viscoelastic solid, and the inverse of its creep
    compliance, against time on ``ax``."""
    t = _span(shown)
    moduli = [solid.relaxation.at(t) for solid in shown.solids]
    in_pa = scale(np.concatenate(moduli), "Pa")
    for number, (solid, modulus) in enumerate(zip(shown.solids, moduli, strict=True)):
        colour = _COLOURS[number % len(_COLOURS)]
        ax.loglog(t, in_pa(modulus), color=colour, label=f"{_name(solid, number)}: E(t)")
        ax.loglog(t, in_pa(1.0 / solid.uniaxial_creep.at(t)), color=colour, linestyle="--", label="1/J(t)")
    ax.set(xlabel="time (s)", ylabel=f"Young's modulus ({in_pa.symbol})")
    return legend_above(ax)


def plot_complex_moduli(shown: TimePicture, ax: Axes) -> Axes:
    """Draw storage and loss modulus of every viscoelastic solid against frequency on ``ax``."""
    f = 1.0 / (2.0 * np.pi * _span(shown)[::-1])
    moduli = [solid.complex_modulus(2.0 * np.pi * f) for solid in shown.solids]
    in_pa = scale(np.abs(np.concatenate(moduli)), "Pa")
    for number, (solid, modulus) in enumerate(zip(shown.solids, moduli, strict=True)):
        colour = _COLOURS[number % len(_COLOURS)]
        ax.loglog(f, in_pa(modulus.real), color=colour, label=f"{_name(solid, number)}: storage")
        ax.loglog(f, in_pa(modulus.imag), color=colour, linestyle="--", label="loss")
    ax.set(xlabel="frequency (Hz)", ylabel=f"Young's modulus ({in_pa.symbol})")
    return legend_above(ax)


def sliding_pressure(shown: SpeedPicture | StartPicture) -> Field:
    """Pressure of the sliding contact; no contact is blank."""
    values = np.where(shown.pressure > 0.0, shown.pressure, np.nan)
    look = Look("Pa", "contact pressure", PRESSURE_MAP, blank="no contact", blank_value=0.0, reduced="max")
    return Field(values, shown.problem.grid, look)


def plot_sliding_pressure(shown: SpeedPicture | StartPicture, ax: Axes) -> Axes:
    """Draw the pressure of the sliding contact on ``ax``, with an arrow along which the rough body
    moves."""
    plot_map(sliding_pressure(shown), ax)
    if min(shown.problem.grid.shape) > 1:
        step = 0.16 * np.array([np.cos(shown.direction), np.sin(shown.direction)])
        start = np.array([0.14, 0.14]) - 0.5 * step
        style: Any = {"arrowstyle": "-|>", "color": VERMILLION, "lw": 1.4}
        ax.annotate("", xy=tuple(start + step), xytext=tuple(start), xycoords="axes fraction", arrowprops=style)
    return ax


def _against_speed(shown: SpeedPicture, ax: Axes, names: tuple[str, str], label: str) -> Axes:
    """The column of the first of ``names`` against speed, that of the second, by Persson's theory,
    beside it."""
    speed = shown.curve["speed"]
    ax.semilogx(speed, shown.curve[names[0]], color=BLUE, marker=".", label="this contact")
    beside = shown.curve.get(names[1], np.array(np.nan))
    if np.isfinite(beside).any():
        ax.semilogx(speed, beside, color=ORANGE, linestyle="--", label="Persson")
    ax.set(xlabel="sliding speed (m/s)", ylabel=label, ylim=(0.0, None))
    return legend_above(ax)


plot_friction_by_speed = partial(
    _against_speed, names=("friction", "persson_friction"), label="coefficient of hysteretic friction"
)
plot_area_by_speed = partial(
    _against_speed, names=("area_fraction", "persson_area_fraction"), label="real contact area / nominal area"
)


def _along_the_way(shown: StartPicture, ax: Axes, name: str, label: str) -> Axes:
    """Column ``name`` against the distance moved, with the value of steady sliding as a line."""
    steady: float = getattr(shown, name)
    in_m = scale(shown.columns["distance"], "m")
    ax.plot(in_m(shown.columns["distance"]), shown.columns[name], color=BLUE, label="start of sliding")
    if np.isfinite(steady):
        ax.axhline(steady, color=ORANGE, linestyle="--", label="steady sliding")
    ax.set(xlabel=f"distance moved ({in_m.symbol})", ylabel=label, xlim=(0.0, None))
    return legend_above(ax)


plot_friction_at_start = partial(_along_the_way, name="friction", label="coefficient of friction")
plot_area_at_start = partial(_along_the_way, name="area_fraction", label="real contact area / nominal area")


def plot_energy_at_start(shown: StartPicture, ax: Axes) -> Axes:
    """Draw stored energy and heat against time on ``ax``."""
    in_s = scale(shown.columns["time"], "s")
    in_j = scale(np.concatenate([shown.columns["stored_energy"], shown.columns["dissipated"]]), "J")
    curves = (("stored_energy", "stored in the solids", BLUE), ("dissipated", "heat", VERMILLION))
    for name, words, colour in curves:
        ax.plot(in_s(shown.columns["time"]), in_j(shown.columns[name]), color=colour, label=words)
    ax.set(xlabel=f"time ({in_s.symbol})", ylabel=f"energy ({in_j.symbol})", xlim=(0.0, None))
    return legend_above(ax)


TIME_PLOTS = (
    Plot(
        "area_in_time",
        "Contact area against time",
        "Real over nominal contact area at every step of time; thin lines: ends of the steps of the load.",
        plot_area_in_time,
    ),
    Plot(
        "approach_in_time",
        "Approach against time",
        "Approach from first touch at every step of time.",
        plot_approach_in_time,
    ),
    Plot("load_in_time", "Load against time", "Mean pressure at every step of time.", plot_load_in_time),
    Plot(
        "energy_in_time",
        "Energies against time",
        "Energy stored in the solids, and heat since the virgin state.",
        plot_energy_in_time,
    ),
)
"""Figures of a contact in time."""

SOLID_PLOTS = (
    Plot(
        "relaxation",
        "Relaxation of the solids",
        "Young's modulus of every viscoelastic solid after a step of strain, and the inverse of its "
        "compliance after a step of stress.",
        plot_relaxation,
    ),
    Plot(
        "complex_moduli",
        "Storage and loss moduli",
        "Storage and loss modulus of every viscoelastic solid against frequency.",
        plot_complex_moduli,
    ),
)
"""Figures of the viscoelastic solids."""

SLIDING_PLOT = Plot(
    "sliding_pressure",
    "Pressure while sliding",
    "Pressure of the steadily sliding contact; the rough body moves along the arrow, and the pressure is "
    "larger in front of its bumps.",
    plot_sliding_pressure,
    "map",
    shows=sliding_pressure,
)
SPEED_PLOTS = (
    Plot(
        "friction_by_speed",
        "Friction against speed",
        "Coefficient of hysteretic friction of steady sliding; Persson's theory beside it where it holds.",
        plot_friction_by_speed,
    ),
    Plot(
        "area_by_speed",
        "Contact area against speed",
        "Real over nominal contact area of steady sliding; Persson's theory beside it where it holds.",
        plot_area_by_speed,
    ),
)
"""Figures against speed."""

START_PLOTS = (
    Plot(
        "friction_at_start",
        "Friction at the start of sliding",
        "Coefficient of friction, by the slope of what moves, against the distance moved since the load "
        "came at once; dashed: steady sliding.",
        plot_friction_at_start,
    ),
    Plot(
        "area_at_start",
        "Contact area at the start of sliding",
        "Real over nominal contact area against the distance moved; dashed: steady sliding.",
        plot_area_at_start,
    ),
    Plot(
        "energy_at_start",
        "Energies at the start of sliding",
        "Energy stored in the solids, and heat since the virgin state, against time.",
        plot_energy_at_start,
    ),
    Plot(
        "pressure_after_start",
        "Pressure after the start of sliding",
        "Pressure after the distance; the rough body moves along the arrow.",
        plot_sliding_pressure,
        "map",
        shows=sliding_pressure,
    ),
)
"""Figures of the start of sliding."""
