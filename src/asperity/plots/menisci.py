"""Map of the menisci of a wet contact."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ..contact.wet_result import WetContactResult
from .figure import Figure
from .maps import plot_classes
from .picture import map_size, png
from .style import NO_CONTACT, SKY, VERMILLION, YELLOW

if TYPE_CHECKING:
    from matplotlib.axes import Axes

KINDS = (("no liquid", NO_CONTACT), ("within height, dry", YELLOW), ("meniscus", SKY), ("contact", VERMILLION))
"""Name and colour of each kind of point, in the order of their numbers."""


def plot_menisci(result: WetContactResult, ax: Axes) -> Axes:
    """Draw on ``ax`` where the bodies touch, where menisci bridge the gap, and where it is low enough but dry."""
    found = result.wetting
    kinds = np.where(found.cut, 1.0, 0.0)
    kinds[found.menisci] = 2.0
    kinds[result.contact.contact] = 3.0
    return plot_classes(kinds, result.problem.grid, ax, KINDS)


def wet_figures(result: WetContactResult) -> tuple[Figure, ...]:
    """Figures of the menisci of ``result``."""
    caption = (
        "Where the bodies touch, and where menisci bridge the gap. Points within the height of a meniscus that no film "
        "reaches stay dry."
    )
    picture = png(partial(plot_menisci, result), map_size(result.problem.grid))
    return (Figure("menisci", "Menisci", caption, picture),)
