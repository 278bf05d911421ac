"""What lies under the first layer of a conductor adds to the temperature of a single source.

It is smooth, and falls as exp(-2 q h) with the thickness h of the layer, so it is summed over
waves, and the source on a half-space of the layer taken from elsewhere (``polar``, ``pixel``).
Lengths in half lengths of the source along the motion.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...core.arrays import ComplexArray, RealArray
from ...core.quadrature import gauss
from .impedance import HeatConductor

Transform = Callable[[RealArray, RealArray], RealArray]
"""Of a source at wavevectors (qx, qy), 1 at none."""

_REACH = 13.0
"""q h where exp(-2 q h) is 5e-12."""
_PHASE = 24.0
"""Phase over which as many Gauss points are exact to 1e-12."""
_NODES = 24


@dataclass(frozen=True)
class _Waves:
    """Waves in one quarter of all directions."""

    qx: RealArray
    qy: RealArray
    weight: ComplexArray


class FromBelow:
    """The part from below the first layer of a ``body`` in units of the half length, of a source of
    the ``area`` and ``transform``, within ``reach`` of its centre, per mean flux."""

    def __init__(self, body: HeatConductor, speed: float, area: float, transform: Transform, reach: float) -> None:
        thickness = body.layers[0].thickness if body.layers else body.sink_depth
        last = _REACH / thickness
        octaves = np.append(0.0, last * 2.0 ** np.arange(-max(0.0, math.ceil(math.log2(last))), 1.0))
        self._waves = []
        for low, high in itertools.pairwise(octaves):
            count = math.ceil((high - low) * 2.0 * reach / _PHASE)
            breaks = np.linspace(low, high, count + 1)
            if low == 0.0:  # s is the root of q there
                breaks = np.concatenate([[0.0], breaks[1] * 4.0 ** np.arange(-22.0, 0.0), breaks[1:]])
            q, of_q = gauss(breaks, _NODES)
            parts = 2 + math.ceil(0.5 * math.pi * high * reach / _PHASE)
            even = np.linspace(0.0, 0.5 * math.pi, parts + 1)
            across = even[1] * 4.0 ** -np.arange(1.0, 23.0 if low == 0.0 else 12.0)
            angles = np.concatenate([even[:-1], even[-1] - across, even[-1:]])
            phi, of_phi = gauss(angles, _NODES)
            qx, qy = q[:, None] * np.cos(phi), q[:, None] * np.sin(phi)
            flux = (area / math.pi**2) * (of_q * q)[:, None] * of_phi * transform(qx, qy)
            self._waves.append(_Waves(qx, qy, flux * body.under_surface(qx, qy, speed)))

    def at(self, x: float, y: float) -> float:
        """At one point of the surface."""
        total = 0.0
        for waves in self._waves:
            phase = np.exp(1j * waves.qx * x)
            total += float(np.sum((waves.weight * phase).real * (np.cos(waves.qy * y) if y else 1.0)))
        return total

    def mean(self, transform: Transform) -> float:
        """Mean over the source with the weights that have the ``transform``."""
        return float(sum(np.sum(waves.weight.real * transform(waves.qx, waves.qy)) for waves in self._waves))
