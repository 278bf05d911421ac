"""Gauss rules on many panels at once."""

from __future__ import annotations

import numpy as np

from .arrays import RealArray


def gauss(breaks: RealArray, nodes: int) -> tuple[RealArray, RealArray]:
    """Gauss-Legendre nodes and weights on the panels between ``breaks``.

    Parameters
    ----------
    breaks
        (…, n + 1) ends of the panels, not falling along the last axis; a panel of no width contributes nothing.
    nodes
        Nodes in each panel.

    Returns
    -------
    (…, n · nodes) nodes and weights.
    """
    x, w = np.polynomial.legendre.leggauss(nodes)
    low, high = breaks[..., :-1, None], breaks[..., 1:, None]
    half = 0.5 * (high - low)
    shape = (*breaks.shape[:-1], -1)
    return (low + half * (x + 1.0)).reshape(shape), (half * w).reshape(shape)
