"""Curves of a load path: load against approach, area against load, and where the work goes."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np

from ..contact.energy import energy_balance
from ..contact.path import LoadPath
from ..core.arrays import RealArray
from .style import BLACK, BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILLION, scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LOADING = (BLUE, SKY, GREEN)
"""Colours of the first, the second and every further loading."""

UNLOADING = (VERMILLION, ORANGE, PURPLE)
"""Colours of the first, the second and every further unloading."""


def plot_load_loop(path: LoadPath, ax: Axes) -> Axes:
    """Draw the mean pressure of every step of ``path`` against its approach on ``ax``, each direction in its colour."""
    load, approach = (_from_touch(path, values) for values in (path.mean_pressure, path.approach))
    in_m, in_pa = scale(approach, "m"), scale(load, "Pa")
    _draw_legs(in_m(approach), in_pa(load), path, ax)
    ax.set(xlabel=f"approach from first touch ({in_m.symbol})", ylabel=f"mean pressure ({in_pa.symbol})")
    return ax


def plot_area_loop(path: LoadPath, ax: Axes) -> Axes:
    """Draw the real area of every step of ``path``, in percent of the nominal area, against the mean pressure on ``ax``."""
    load, area = (_from_touch(path, values) for values in (path.mean_pressure, path.area_fraction_corrected))
    in_pa = scale(load, "Pa")
    _draw_legs(in_pa(load), 100.0 * area, path, ax)
    ax.set(xlabel=f"mean pressure ({in_pa.symbol})", ylabel="real contact area (% of nominal)")
    return ax


def plot_energies(path: LoadPath, ax: Axes) -> Axes:
    """Draw external work, elastic energy and plastic work after every step of ``path`` on ``ax``."""
    balance = energy_balance(path)
    in_j = scale(np.concatenate([balance.external_work, balance.elastic_energy, balance.plastic_work]), "J")
    step = np.arange(1, len(path.results) + 1)
    kinds = {
        "external work ∫F dδ": (balance.external_work, BLACK, "-"),
        "elastic energy": (balance.elastic_energy, BLUE, "-"),
        "plastic work": (balance.plastic_work, VERMILLION, "-"),
        "elastic + plastic": (balance.elastic_energy + balance.plastic_work, ORANGE, ":"),
    }
    for label, (energy, colour, line) in kinds.items():
        ax.plot(step, in_j(energy), color=colour, linestyle=line, marker=".", markersize=3.0, label=label)
    ax.set(xlabel="step", ylabel=f"energy ({in_j.symbol})", xlim=(0.5, step[-1] + 0.5))
    ax.locator_params(axis="x", integer=True)
    ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, borderaxespad=0.3, borderpad=0.2)
    return ax


def _from_touch(path: LoadPath, values: RealArray) -> RealArray:
    """``values`` of every step; a path of virgin surfaces begins at first touch, where all of them are zero."""
    return np.concatenate([[0.0], values]) if path.start is None else values


def _draw_legs(x: RealArray, y: RealArray, path: LoadPath, ax: Axes) -> None:
    """Curve of the points ``x``, ``y``, each direction of the load in its colour; a part starts where the last one ended."""
    before = len(x) - len(path.results)
    load = _from_touch(path, path.mean_pressure)
    counts = {True: 0, False: 0}
    for first, last in itertools.pairwise((0, *(turn + before for turn in path.turns))):
        rising = bool(load[last] > load[first])
        number = counts[rising]
        counts[rising] += 1
        colour = (LOADING if rising else UNLOADING)[min(number, len(LOADING) - 1)]
        name = ("loading" if rising else "unloading") + (f" {number + 1}" if number else "")
        part, line = slice(first, last + 1), "-" if rising else "--"
        ax.plot(x[part], y[part], color=colour, marker=".", markersize=3.5, label=name, linestyle=line)
    ax.set_xlim(left=min(0.0, float(np.min(x))))
    ax.set_ylim(bottom=0.0)
    ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=4, borderaxespad=0.3, borderpad=0.2)
