"""Surface temperature per flux of one wave on a conductor that moves under it: layered, bonded with
resistances, with a sink at depth; steady, or transformed in time.

Flux q̂ exp(i q·x) on a body whose material moves with v: each homogeneous part has the temperature
exp(±s z) with s² = q² + i v·q/κ + p/κ, and Re s > 0. The sign belongs to exp(+i q·x) and material
that moves to +v: the wake lies there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import ComplexArray, RealArray
from ...core.errors import InputError

Speed = float | tuple[float, float]
"""Of the material in m/s, along x or along x and y."""


@dataclass(frozen=True)
class HeatLayer:
    """A layer of a conductor.

    Parameters
    ----------
    conductivity, diffusivity
        k in W/(m K) and κ in m²/s, > 0.
    thickness
        h in m, > 0.
    resistance
        Of the bond under it, in m² K/W, >= 0.
    """

    conductivity: float
    diffusivity: float
    thickness: float
    resistance: float = 0.0

    def __post_init__(self) -> None:
        """InputError for values that cannot be."""
        require.positive(self.conductivity, "thermal conductivity (W/m/K)")
        require.positive(self.diffusivity, "thermal diffusivity (m²/s)")
        require.positive(self.thickness, "thickness of a layer (m)")
        require.not_negative(self.resistance, "resistance of a bond (m² K/W)")


@dataclass(frozen=True)
class HeatConductor:
    """A half-space with layers, which all move together.

    Parameters
    ----------
    conductivity, diffusivity
        k in W/(m K) and κ in m²/s of the base, > 0.
    layers
        From the surface down.
    sink_depth
        Thickness d in m of the base, on a sink of no temperature rise; infinite for a half-space.
    """

    conductivity: float
    diffusivity: float
    layers: tuple[HeatLayer, ...] = ()
    sink_depth: float = math.inf

    def __post_init__(self) -> None:
        """InputError for values that cannot be."""
        require.positive(self.conductivity, "thermal conductivity (W/m/K)")
        require.positive(self.diffusivity, "thermal diffusivity (m²/s)")
        if not self.sink_depth > 0.0:
            raise InputError(f"depth of the sink (m) must be greater than zero, but is {self.sink_depth!r}.")

    def impedance(self, qx: ArrayLike, qy: ArrayLike, speed: Speed = 0.0, laplace: complex = 0.0) -> ComplexArray:
        """Z = T̂/q̂ in K m²/W at wavevectors (``qx``, ``qy``) in rad/m, broadcast, not both zero but
        for a Laplace variable; ``laplace`` in 1/s.

        From the base up: Z <- Z + R, then Z <- (1 + ρ)/(1 - ρ)/(k s) with ρ = (k s Z - 1)/(k s Z +
        1) exp(-2 s h).
        """
        return self._above(len(self.layers), _decays(self, qx, qy, speed, laplace))

    def _above(self, count: int, decays: list[ComplexArray]) -> ComplexArray:
        """Z at the upper side of what lies under the first layers but ``count`` of the lowest."""
        s = decays[-1]
        z = 1.0 / (self.conductivity * s)
        if math.isfinite(self.sink_depth):
            z = z * np.tanh(s * self.sink_depth)
        for layer, s in list(zip(self.layers, decays, strict=False))[::-1][:count]:
            ks = layer.conductivity * s
            z = z + layer.resistance
            back = (ks * z - 1.0) / (ks * z + 1.0) * np.exp(-2.0 * s * layer.thickness)
            z = (1.0 + back) / (1.0 - back) / ks
        return z


def decay(qx: ArrayLike, qy: ArrayLike, diffusivity: float, speed: Speed = 0.0, laplace: complex = 0.0) -> ComplexArray:
    """s = sqrt(q² + i v·q/κ + p/κ) in 1/m, Re s > 0, at wavevectors (``qx``, ``qy``) in rad/m."""
    qx, qy = np.asarray(qx, dtype=float), np.asarray(qy, dtype=float)
    vx, vy = speed if isinstance(speed, tuple) else (speed, 0.0)
    return np.asarray(np.sqrt(qx**2 + qy**2 + (laplace + 1j * (vx * qx + vy * qy)) / diffusivity))


def _decays(body: HeatConductor, qx: ArrayLike, qy: ArrayLike, speed: Speed, laplace: complex) -> list[ComplexArray]:
    return [decay(qx, qy, part.diffusivity, speed, laplace) for part in (*body.layers, body)]
