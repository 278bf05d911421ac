"""Map of the menisci of a wet contact, and their growth."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...contact.result import ContactResult
from ...core.arrays import RealArray
from ...plots.maps import Kinds, enlarge_contact, plot_map
from ...plots.picture import BLUE, NO_CONTACT, SKY, VERMILLION, YELLOW, Plot, scale

if TYPE_CHECKING:
    from matplotlib.axes import Axes

KINDS = (("no liquid", NO_CONTACT), ("within height, dry", YELLOW), ("meniscus", SKY), ("contact", VERMILLION))
"""Name and colour of each kind of point, in the order of their numbers."""


def meniscus_kinds(result: ContactResult) -> Kinds:
    """Where the bodies touch, where menisci bridge the gap, and where it is low enough but dry.

    Raises InputError if the contact has no film of liquid.
    """
    stands = result.require_menisci().wetting
    kinds = np.where(stands.cut, 1.0, 0.0)
    kinds[stands.menisci] = 2.0
    kinds[result.contact] = 3.0
    return Kinds(kinds, result.problem.grid, KINDS)


def plot_menisci(result: ContactResult, ax: Axes) -> Axes:
    """Draw on ``ax`` where the bodies touch, where menisci bridge the gap, and where it is low
    enough but dry.

    Raises InputError if the contact has no film of liquid.
    """
    return plot_map(meniscus_kinds(result), ax)


MENISCI = Plot(
    "menisci",
    "Menisci",
    "Where the bodies touch, and where menisci bridge the gap. Points within the height of a meniscus that no film "
    "reaches stay dry.",
    plot_menisci,
    "map",
    enlarge_contact,
    shows=meniscus_kinds,
)
"""The figure of a contact with a film of liquid."""

PLOTS = (MENISCI,)


@dataclass(frozen=True, eq=False)
class GrowthPicture:
    """Columns of growing menisci by name, SI."""

    columns: Mapping[str, RealArray]


def plot_growth(picture: GrowthPicture, ax: Axes) -> Axes:
    """Draw on ``ax`` force and area of growing menisci against time."""
    time, force = (np.asarray(picture.columns[name]) for name in ("time", "meniscus_force"))
    later = time > 0.0
    moments, pull = scale(float(time.max()), "s"), scale(float(force.max()), "N")
    ax.plot(moments(time[later]), pull(force[later]), color=BLUE)
    ax.axhline(float(pull(force[0])), color=BLUE, linestyle=":", linewidth=1.0)
    ax.set(xscale="log", xlabel=f"time after contact ({moments.symbol})", ylabel=f"meniscus force ({pull.symbol})")
    ax.set_ylim(bottom=0.0)
    share = ax.twinx()
    share.plot(moments(time[later]), 100.0 * picture.columns["meniscus_area_fraction"][later], color=VERMILLION)
    share.set_ylabel("area of the menisci (%)", color=VERMILLION)
    share.set_ylim(bottom=0.0)
    return ax


GROWTH_PLOTS = (
    Plot(
        "meniscus_growth",
        "Growth of the menisci",
        "Force (left, blue) and area (right, red) of the menisci against the time after contact; dotted: force at "
        "first touch.",
        plot_growth,
    ),
)
"""The figure of growing menisci."""
