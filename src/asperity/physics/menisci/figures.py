"""Map of the menisci of a wet contact."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...contact.result import ContactResult
from ...plots.maps import Kinds, enlarge_contact, plot_map
from ...plots.picture import NO_CONTACT, SKY, VERMILLION, YELLOW, Plot

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
