"""Estimates of the flow through a gap beside its solution: bounds and effective medium from the
distribution of the gap, and the critical junction.

All are transmissivities K = 12 η Q L / (W ΔP) in m³, the cube of the even gap that lets as much
through.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...theories.sealing.media import bruggeman, layer_bounds
from .flow import GapFlow
from .network import checked_gap, clusters


@dataclass(frozen=True)
class Estimates:
    """Estimates of K in m³ from the distribution of a gap.

    Attributes
    ----------
    lower, upper
        Layers across and along the flow.
    effective_medium
        Bruggeman's.
    critical_junction
        Cube of the gap of the constriction that decides, which is that of the last path to close.
    """

    lower: float
    upper: float
    effective_medium: float
    critical_junction: float


def estimates_of(flow: GapFlow) -> Estimates:
    """Estimates beside a ``flow``."""
    gap = checked_gap(flow.gap)
    bounds = layer_bounds(gap)
    return Estimates(bounds.lower, bounds.upper, bruggeman(gap), critical_gap(flow) ** 3)


def critical_gap(flow: GapFlow) -> float:
    """Largest gap in m of a body that passes from end to end along the direction of the flow: that
    of the critical constriction; zero where the gap is sealed.

    The rate (u_c³/12 η) (W/L) ΔP with it is that of Persson & Yang (2008) for a square of the size
    of the system, who take u_c from the theory of contact at the magnification where the contact
    closes.
    """
    values = np.unique(flow.gap[flow.net.carrying]) if not flow.sealed else np.zeros(1)
    low, high = 0, values.size  # passes at values[low], not at values[high]
    while high - low > 1:
        middle = (low + high) // 2
        found = clusters(flow.gap >= values[middle], flow.wraps)
        through = found.winds if flow.repeats else found.spans
        low, high = (middle, high) if through[flow.axis].any() else (low, middle)
    return float(values[low])
