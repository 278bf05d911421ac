"""Largest stresses and what follows from them in words: with their errors, or as bounds where they are not to be trusted."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ...core.units import show

if TYPE_CHECKING:
    from .field import Peak
    from .yielding import RegionYield


def peak_text(peak: Peak, factor: float = 1.0) -> str:
    """Value of a ``peak`` times ``factor`` with its error where that is known; as a lower bound where it is not to be trusted."""
    value = show(factor * peak.value, "Pa")
    if peak.doubt:
        return f"> {value}"
    return value if math.isnan(peak.error) else f"{value} ± {show(factor * peak.error, 'Pa', 2)}"


def factor_text(part: RegionYield) -> str:
    """Load factor of a region, with its error or as an upper bound."""
    text = f"{part.load_factor:.3g}"
    if part.peak.doubt:
        return f"< {text}"
    return text if math.isnan(part.load_factor_error) else f"{text} ± {part.load_factor_error:.2g}"


def verdict(peak: Peak, strength: float) -> str:
    """Whether a ``strength`` holds, with the error of the largest stress."""
    error = 0.0 if math.isnan(peak.error) else peak.error
    if peak.value - error >= strength or (peak.doubt and peak.value >= strength):
        return "fails"
    return "not certain" if peak.doubt or peak.value + error >= strength else "holds"
