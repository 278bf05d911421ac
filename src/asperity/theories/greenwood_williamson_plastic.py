"""Onset of plastic flow in the theory of Greenwood & Williamson (1966): the plastic share of the contact.

With the plasticity index ψ = (E*/H)(σ_s/R)^(1/2), summits pressed deeper than δ_p = R (H/E*)² flow; w = δ_p/σ_s = 1/ψ².
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import NoSolutionError
from .summit_heights import GaussianHeights, SummitHeights

NOTICEABLE = 0.02
"""Plastic share of the area that counts as the onset (Greenwood & Williamson 1966)."""

_LOWEST, _HIGHEST = -35.0, 35.0  # D between which the onset is sought


def plastic_area_share(D: ArrayLike, psi: float, heights: SummitHeights = GaussianHeights()) -> RealArray:
    """Share of the elastic contact area on summits that flow: ∫_(D + w)^∞ (s - D) p ds/F_1(D).

    Parameters
    ----------
    D
        Standardised separations, any shape.
    psi
        Plasticity index ψ > 0.
    heights
        Distribution of the summit heights.
    """
    D, w = np.asarray(D, dtype=float), 1.0 / require.positive(psi, "plasticity index psi") ** 2
    deep = heights.tail_moment(D + w, 1.0) + w * heights.tail_moment(D + w, 0.0)
    share: RealArray = deep / heights.tail_moment(D, 1.0)
    return share


def plastic_area_share_beyond(D: ArrayLike, psi: float, heights: SummitHeights = GaussianHeights()) -> RealArray:
    """F_1(D + w)/F_1(D), the share if only the depth beyond δ_p counts; a definition that is also in use."""
    D, w = np.asarray(D, dtype=float), 1.0 / require.positive(psi, "plasticity index psi") ** 2
    share: RealArray = heights.tail_moment(D + w, 1.0) / heights.tail_moment(D, 1.0)
    return share


def plastic_number_share(D: ArrayLike, psi: float, heights: SummitHeights = GaussianHeights()) -> RealArray:
    """F_0(D + w)/F_0(D), the share of the contacts that flow."""
    D, w = np.asarray(D, dtype=float), 1.0 / require.positive(psi, "plasticity index psi") ** 2
    share: RealArray = heights.tail_moment(D + w, 0.0) / heights.tail_moment(D, 0.0)
    return share


def separation_at_plastic_onset(psi: float, share: float = NOTICEABLE, *, beyond: bool = False) -> float:
    """D below which the plastic share of the area exceeds ``share``, for Gaussian heights.

    Parameters
    ----------
    psi
        Plasticity index.
    share
        Share of the area, between 0 and 1.
    beyond
        Whether the share is that of ``plastic_area_share_beyond``.

    Raises
    ------
    NoSolutionError
        If the share is exceeded, or not reached, at every separation between -35 and 35 standard deviations.
    """
    from scipy.optimize import brentq

    require.between(share, 0.0, 1.0, "plastic share of the area")
    law = plastic_area_share_beyond if beyond else plastic_area_share

    def excess(D: float) -> float:
        found = float(law(D, psi))
        return math.log(found) - math.log(share) if found > 0.0 else -math.inf

    if excess(_LOWEST) < 0.0 or excess(_HIGHEST) > 0.0:
        raise NoSolutionError(
            f"plastic share {share:g} must be crossed between D = {_LOWEST:g} and {_HIGHEST:g}, but psi = {psi:g} has "
            f"{float(law(_LOWEST, psi)):.3g} and {float(law(_HIGHEST, psi)):.3g} there."
        )
    return float(brentq(excess, _LOWEST, _HIGHEST, xtol=1e-14, rtol=1e-14))
