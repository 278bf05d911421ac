"""Depths that show a body: both ends of every layer and points between, denser towards the surface in the substrate."""

from __future__ import annotations

import math

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from .regions import regions

_GRADING = 1.5  # power of the spacing below the lowest interface, where stresses vary ever more slowly


def depths_through(body: object, deepest: float, *, per_region: int = 12) -> RealArray:
    """Increasing depths in m from the surface of ``body`` to ``deepest`` (m), for ``stress``.

    Every layer has ``per_region`` equal intervals, so that both its faces are among the depths; the substrate has as many
    intervals down to ``deepest``, short ones first. Layers below ``deepest`` are left out.

    Raises
    ------
    InputError
        If the body is rigid, ``deepest`` is not positive or there is less than one interval.
    """
    limit = require.positive(deepest, "deepest depth (m)")
    count = require.integer(per_region, 1, "number of intervals in a region")
    share = np.arange(count + 1) / count
    found = [0.0]
    for region in regions(body):
        bottom = min(region.bottom, limit)
        if bottom > region.top:
            steps = share**_GRADING if math.isinf(region.bottom) else share
            found.extend((region.top + (bottom - region.top) * steps)[1:])
    return np.array(found)
