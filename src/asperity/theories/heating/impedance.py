"""Temperature per flux of one wave of heat on a conductor that moves by under it: layered, bonded
with resistances, with a sink at depth; steady, in time, or transformed in time.

A flux q̂ exp(i q·x) into a body whose material moves with v makes in each homogeneous part
temperatures exp(±s z), s² = q² + i v·q/κ + p/κ, Re s > 0 (Ling 1973). The sign belongs to exp(+i
q·x) and to material that moves to +v, where the wake lies.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import ComplexArray
from ...core.errors import InputError
from ...core.scipy_parts import special

Speed: TypeAlias = float | tuple[float, float]
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
        _conducts(self.conductivity, self.diffusivity)
        require.positive(self.thickness, "thickness of a layer (m)")
        require.not_negative(self.resistance, "resistance of a bond (m² K/W)")


class _Part(NamedTuple):
    """A layer or the base under one flux: k s, s h, and the reflection at its lower side."""

    ks: ComplexArray
    s: ComplexArray
    thickness: float
    reflection: ComplexArray

    def at(self, z: float) -> ComplexArray:
        """Temperature at ``z`` below its upper side per flux into it."""
        if math.isinf(self.thickness):
            return np.asarray(np.exp(-self.s * z) / self.ks)
        back = self.reflection * np.exp(-self.s * (2.0 * self.thickness - z))
        return np.asarray((np.exp(-self.s * z) + back) / (self.ks * (1.0 - self._round())))

    def through(self) -> ComplexArray:
        """Flux at its lower side per flux into it."""
        return np.asarray(np.exp(-self.s * self.thickness) * (1.0 - self.reflection) / (1.0 - self._round()))

    def from_below(self) -> ComplexArray:
        """What its lower side adds to the temperature of its upper one."""
        if math.isinf(self.thickness):
            return np.zeros_like(self.ks)
        e = self._round()
        return np.asarray(2.0 * e / (1.0 - e) / self.ks)

    def _round(self) -> ComplexArray:
        return np.asarray(self.reflection * np.exp(-2.0 * self.s * self.thickness))


@dataclass(frozen=True)
class HeatConductor:
    """A half-space or thick base with layers on it, which all move together.

    Parameters
    ----------
    conductivity, diffusivity
        k in W/(m K) and κ in m²/s of the base, > 0.
    layers
        From the surface down.
    sink_depth
        Thickness d in m of the base, on a sink whose temperature does not rise; infinite for a
        half-space.

    Examples
    --------
    A film three wavelengths thick hides what is under it:

    >>> film = HeatConductor(50.0, 1e-5, (HeatLayer(5.0, 2e-6, 3e-6),))
    >>> round(float(film.impedance(6.283e6, 0.0).real * 5.0 * 6.283e6), 6)
    1.0
    """

    conductivity: float
    diffusivity: float
    layers: tuple[HeatLayer, ...] = ()
    sink_depth: float = math.inf
    citation_keys: ClassVar[tuple[str, ...]] = ("CarslawJaeger1959", "Ling1973")

    def __post_init__(self) -> None:
        """InputError for values that cannot be."""
        _conducts(self.conductivity, self.diffusivity)
        if not self.sink_depth > 0.0:
            raise InputError(f"depth of the sink (m) must be greater than zero, but is {self.sink_depth!r}.")

    def impedance(self, qx: ArrayLike, qy: ArrayLike, speed: Speed = 0.0, laplace: complex = 0.0) -> ComplexArray:
        """Z = T̂/q̂ in K m²/W at wavevectors (``qx``, ``qy``) in rad/m, broadcast against each other.

        ``laplace`` p in 1/s is the Laplace variable of time, 0 for the steady state, where the
        wavevector must not vanish. From the base up over resistances Z <- Z + R, and through layers
        Z <- (1 + r e)/(1 - r e)/(k s), e = exp(-2 s h), r = (k s Z - 1)/(k s Z + 1).
        """
        return self._parts(qx, qy, speed, laplace)[0].at(0.0)

    def below(
        self, depth: float, qx: ArrayLike, qy: ArrayLike, speed: Speed = 0.0, laplace: complex = 0.0
    ) -> ComplexArray:
        """T̂/q̂ at the ``depth`` z in m, >= 0, below the surface; at an interface that of its upper
        side. Arguments else as of ``impedance``.

        InputError at depths beyond the sink.
        """
        z = require.not_negative(depth, "depth (m)")
        parts = self._parts(qx, qy, speed, laplace)
        flux: ComplexArray = np.ones_like(parts[0].s)
        for part in parts[:-1]:
            if z <= part.thickness:
                return flux * part.at(z)
            z -= part.thickness
            flux = flux * part.through()
        if z > self.sink_depth:
            raise InputError(f"depth (m) must be at most that of the sink, but is {depth:g}.")
        return flux * parts[-1].at(z)

    def beyond_base(self, qx: ArrayLike, qy: ArrayLike, speed: Speed = 0.0, laplace: complex = 0.0) -> ComplexArray:
        """Z - 1/(k s): what layers and resistances add to the bare half-space of the base, without
        cancellation of both. Arguments as of ``impedance``.

        Bounded: for qx to zero Σ R + Σ (h/k_j) (1 - b_j²/b²) with effusivities b = k/sqrt(κ), or
        with k for b at rest. At a wavevector of zero it is this limit.
        """
        qx, qy = np.broadcast_arrays(np.asarray(qx, dtype=float), np.asarray(qy, dtype=float))
        still = (qx == 0.0) & (qy == 0.0) & (not laplace)
        qx = np.where(still, 1.0, qx)
        bare = 1.0 / (self.conductivity * decay(qx, qy, self.diffusivity, speed, laplace))
        more: ComplexArray = np.zeros_like(bare)
        for layer in reversed(self.layers):
            more = more + layer.resistance
            s = decay(qx, qy, layer.diffusivity, speed, laplace)
            ks, tanh = layer.conductivity * s, np.tanh(s * layer.thickness)
            more = (more + tanh / ks * (1.0 - (ks * bare) * (ks * (bare + more)))) / (1.0 + ks * (bare + more) * tanh)
        return np.where(still, self._limit(bool(np.any(speed))), more)

    def _limit(self, moving: bool) -> float:
        """``beyond_base`` of waves that are infinitely long, along x."""
        total = 0.0
        for layer in self.layers:
            share = layer.conductivity / self.conductivity
            square = share**2 * (self.diffusivity / layer.diffusivity if moving else 1.0)
            total += layer.resistance + layer.thickness / layer.conductivity * (1.0 - square)
        return total

    def under_surface(self, qx: ArrayLike, qy: ArrayLike, speed: Speed = 0.0) -> ComplexArray:
        """Z - 1/(k s) with the material at the surface: what lies under it adds 2 e/(1 - e)/(k s),
        which falls as exp(-2 q h). Arguments as of ``impedance``."""
        return self._parts(qx, qy, speed, 0.0)[0].from_below()

    def mean_mode(self) -> float:
        """Σ h/k + Σ R + d/k in K m²/W of a uniform steady flux; infinite on a half-space."""
        return self.sink_depth / self.conductivity + sum(
            layer.thickness / layer.conductivity + layer.resistance for layer in self.layers
        )

    def _parts(self, qx: ArrayLike, qy: ArrayLike, speed: Speed, laplace: complex) -> list[_Part]:
        """Layers and base from the top."""
        s = decay(qx, qy, self.diffusivity, speed, laplace)
        found = [_Part(self.conductivity * s, s, self.sink_depth, np.full(s.shape, -1.0 + 0.0j))]
        for layer in reversed(self.layers):
            s = decay(qx, qy, layer.diffusivity, speed, laplace)
            ks = layer.conductivity * s
            under = ks * (found[0].at(0.0) + layer.resistance)
            reflection: ComplexArray = np.divide(under - 1.0, under + 1.0, dtype=complex)
            found.insert(0, _Part(ks, s, layer.thickness, reflection))
        return found


def decay(qx: ArrayLike, qy: ArrayLike, diffusivity: float, speed: Speed = 0.0, laplace: complex = 0.0) -> ComplexArray:
    """s = sqrt(q² + i v·q/κ + p/κ) in 1/m, Re s > 0, at wavevectors (``qx``, ``qy``) in rad/m."""
    qx, qy = np.asarray(qx, dtype=float), np.asarray(qy, dtype=float)
    vx, vy = speed if isinstance(speed, tuple) else (speed, 0.0)
    return np.asarray(np.sqrt(qx**2 + qy**2 + (laplace + 1j * (vx * qx + vy * qy)) / diffusivity))


def after(
    time: float, qx: ArrayLike, qy: ArrayLike, conductivity: float, diffusivity: float, speed: Speed = 0.0
) -> ComplexArray:
    """T̂/q̂ = erf(s sqrt(κ t))/(k s) of a half-space, at the ``time`` t in s, > 0, after a flux
    began; also of a wavevector of zero, 2 sqrt(t/π)/b."""
    t, s = require.positive(time, "time since the flux began (s)"), decay(qx, qy, diffusivity, speed)
    reach = math.sqrt(diffusivity * t)
    safe = np.where(s == 0.0, 1.0, s)
    found = np.where(s == 0.0, 2.0 * reach / math.sqrt(math.pi), special.erf(safe * reach) / safe)
    return np.asarray(found / conductivity)


def buried(
    depth: float, source_depth: float, body: HeatConductor, qx: ArrayLike, qy: ArrayLike, speed: Speed = 0.0
) -> ComplexArray:
    """T̂ at the ``depth`` z of a half-space per heat made at ``source_depth`` z' (m, >= 0 each):
    (exp(-s|z - z'|) + exp(-s (z + z')))/(2 k s).

    InputError for a ``body`` with layers or a sink.
    """
    if body.layers or math.isfinite(body.sink_depth):
        raise InputError("body with heat made at depth must be a half-space without layers or a sink.")
    z, own = require.not_negative(depth, "depth (m)"), require.not_negative(source_depth, "depth of the source (m)")
    s = decay(qx, qy, body.diffusivity, speed)
    return np.asarray((np.exp(-s * abs(z - own)) + np.exp(-s * (z + own))) / (2.0 * body.conductivity * s))


def _conducts(conductivity: float, diffusivity: float) -> None:
    require.positive(conductivity, "thermal conductivity (W/m/K)")
    require.positive(diffusivity, "thermal diffusivity (m²/s)")
