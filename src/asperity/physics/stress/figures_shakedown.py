"""Figures of shakedown: the limit against friction, and its map against friction and the thickness
of a coating."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...plots.picture import BLUE, VERMILLION, legend_above
from .shakedown import ShakedownCurve, ShakedownMap

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def plot_shakedown_curve(
    curve: ShakedownCurve, ax: Axes, *, per: float = 1.0, label: str = "factor on the stresses"
) -> Axes:
    """Draw on ``ax`` the limit against friction, the uncertain loads shaded; ``per``: what the
    factor is multiplied by, named by ``label``."""
    ax.plot(curve.friction, per * curve.limit, "o-", color=BLUE, ms=3, label="certainly shakes down below")
    if np.any(curve.bound > curve.limit * (1.0 + 1e-9)):
        ax.plot(curve.friction, per * curve.bound, "s--", color=VERMILLION, ms=3, label="certainly does not above")
        ax.fill_between(curve.friction, per * curve.limit, per * curve.bound, color=BLUE, alpha=0.12, lw=0.0)
    ax.set(xlabel="friction coefficient", ylabel=label, ylim=(0.0, None))
    return legend_above(ax)


def plot_shakedown_map(
    found: ShakedownMap,
    ax: Axes,
    *,
    per: float = 1.0,
    label: str = "factor on the stresses",
    across: str = "coating thickness (m)",
) -> Axes:
    """Draw on ``ax`` the limit as contours, with dots where a layer below the outermost sets it;
    ``per`` and ``label`` as for the curve."""
    factor = per * found.limit
    low, high = float(np.min(factor)), float(np.max(factor))
    levels = np.linspace(low, high, 13) if high > low else np.array([low * 0.99, low * 1.01])
    colours = ax.contourf(found.friction, found.across, factor, levels=levels, cmap="viridis")
    ax.figure.colorbar(colours, ax=ax, label=label)
    friction, values = np.meshgrid(found.friction, found.across)
    deeper = found.region > 0
    if np.any(deeper):
        ax.plot(friction[deeper], values[deeper], "w.", ms=4, label="set by a layer below the outermost")
        legend_above(ax)
    ax.set(xlabel="friction coefficient", ylabel=across)
    return ax
