"""Heat flux on the surface of a moving body to the temperature of its surface, on a grid.

Periodic contacts sample the impedance of the layered body at the wavevectors of the grid. Free ones
have the exact temperature of a pixel on a half-space, with zeros around the grid; layers add what
they change, by quadrature over all waves.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Self, TypeAlias

import numpy as np

from ...contact.problem import ContactProblem
from ...core import require
from ...core.arrays import ComplexArray, RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.quadrature import gauss
from ...core.spectral import PaddedTransform, RealTransform, fast_length
from ...solids.elastic import Elastic, Rigid, known_conduction
from ...solids.layers import Body, Layered
from ...theories.heating.impedance import HeatConductor, HeatLayer, decay
from ...theories.heating.pixel import pixel_kernel

Velocity: TypeAlias = tuple[float, float]
Response: TypeAlias = Callable[[RealArray, RealArray], ComplexArray]
"""Of the surface to waves (qx, qy) in rad/m."""

_LONG = (1e-3, 0.0)
"""Wavevector in rad/m of a wave that is uniform over any contact."""

SHORTEST = 11.5
"""Wavenumber times thickness at which a layer is a half-space to 1e-10: exp(-2 q h)."""

NODES, GRADES = 16, 14
"""Nodes of a panel, and panels, each a quarter of the next, towards a wavenumber of zero."""


def heat_conductor(body: Body, which: str, bonds: tuple[float, ...] = ()) -> HeatConductor | None:
    """Conductor that ``body`` is for heat; None for a rigid one, which takes none.

    Layers that vanish, and what lies under a layer of infinite thickness, do not count; a rigid
    base keeps its temperature. ``which`` body it is, for messages; ``bonds`` are the resistances
    under its layers.

    Raises
    ------
    InputError
        If the conductivity or the heat capacity of a material is not known, or there are more bonds
        than layers.
    """
    if isinstance(body, Rigid):
        return None
    stack = body.reduced if isinstance(body, Layered) else Layered((), body)
    if len(bonds) > len(stack.layers):
        raise InputError(
            f"bonds of the {which} must be at most one for each of its layers, but are {len(bonds)} for "
            f"{len(stack.layers)}."
        )
    under = (*bonds, *(0.0 for _ in range(len(stack.layers) - len(bonds))))
    layers = tuple(
        HeatLayer(*_conducts(layer.material, f"layer {n} of the {which}"), layer.thickness, bond)
        for n, (layer, bond) in enumerate(zip(stack.layers, under, strict=True), 1)
    )
    if isinstance(stack.base, Elastic):
        return HeatConductor(*_conducts(stack.base, which), layers)
    if not layers:
        return None
    *above, last = layers
    if last.resistance:
        raise InputError(f"bond of the {which} to its rigid base must be perfect for heat; leave its resistance out.")
    return HeatConductor(last.conductivity, last.diffusivity, tuple(above), last.thickness)


def _conducts(material: Elastic, which: str) -> tuple[float, float]:
    """k and κ of a material."""
    keys = ("thermal_conductivity", "volumetric_heat_capacity")
    conductivity, capacity = (known_conduction(material, key, which) for key in keys)
    return conductivity, conductivity / capacity


@dataclass(frozen=True, eq=False)
class HeatKernel:
    """One body on the grid: flux (nx, ny) in W/m² to surface temperature (nx, ny) in K.

    Attributes
    ----------
    spectrum
        Transform of the temperature of a point of unit flux, half a plane of the grid or of the
        padded one.
    """

    transform: RealTransform | PaddedTransform
    spectrum: ComplexArray = field(repr=False)

    @classmethod
    def of(
        cls,
        conductor: HeatConductor,
        velocity: Velocity,
        problem: ContactProblem,
        sink: float,
        threads: int,
        depth: float = 0.0,
    ) -> Self:
        """That of the ``conductor`` whose material moves with ``velocity`` (m/s) on the grid of the
        ``problem``, to the temperature at the ``depth`` in m, >= 0; in periodic contact the mean
        flux has a ``sink`` at that depth (m), which may be infinite."""
        z, grid = require.not_negative(depth, "depth (m)"), problem.grid
        if all(problem.boundary.wraps):

            def response(qx: RealArray, qy: RealArray) -> ComplexArray:
                return conductor.below(z, qx, qy, velocity) if z else conductor.impedance(qx, qy, velocity)

            return cls(RealTransform(grid.shape, threads), waves(grid, response, mean(conductor, sink, z)))
        padded = (fast_length(2 * grid.shape[0] - 1), fast_length(2 * grid.shape[1] - 1))
        kernel = free_pixel(conductor, velocity, grid, z)
        return cls(PaddedTransform(grid.shape, padded, threads), _cyclic(kernel, grid, padded))

    def __add__(self, other: HeatKernel) -> HeatKernel:
        """Both bodies in series."""
        return replace(self, spectrum=self.spectrum + other.spectrum)

    def apply(self, flux: RealArray) -> RealArray:
        """Temperature rise (nx, ny) in K of the surface under ``flux`` (nx, ny) in W/m², in its
        precision, which has to be that of the spectrum."""
        made = self.transform.forward(flux, np.empty(self.transform.spectrum_shape, self.spectrum.dtype))
        made *= self.spectrum
        return self.transform.backward(made, np.empty_like(flux))

    @property
    def single(self) -> HeatKernel:
        """The same in single precision."""
        return replace(self, spectrum=self.spectrum.astype(np.complex64))


def mean(conductor: HeatConductor, sink: float, depth: float = 0.0) -> float:
    """Temperature at the ``depth`` (m) over the mean flux: that of layers, bonds and a base that is
    ``sink`` m deep; zero where the mean is left out."""
    whole = conductor if math.isfinite(conductor.sink_depth) else replace(conductor, sink_depth=sink)
    if not math.isfinite(whole.sink_depth):
        return 0.0
    return float(whole.below(depth, *_LONG).real) if depth else whole.mean_mode()


def waves(grid: Grid, response: Response, at_mean: float) -> ComplexArray:
    """``response`` (qx, qy) at the wavevectors of the ``grid`` (nx, ny // 2 + 1), with ``at_mean``
    at zero. Where an axis has an even number of points, its shortest wave stands for both
    directions and has the mean of both, so that fields are real."""
    nx, ny = grid.shape
    qx, qy = grid.wavevector()
    safe = np.broadcast_to(qx, (nx, qy.shape[1])).copy()
    safe[0, 0] = 1.0 / grid.spacing[0]
    found = np.array(response(safe, qy), dtype=np.complex128)
    along, across = nx % 2 == 0 and nx > 1, ny % 2 == 0 and ny > 1
    row, last = slice(nx // 2, nx // 2 + 1), slice(qy.shape[1] - 1, None)
    if along:
        found[row] = 0.5 * (found[row] + response(-safe[row], qy))
    if across:
        found[:, last] = 0.5 * (found[:, last] + response(safe[:, last], -qy[:, last]))
    if along and across:
        corner = safe[row, last]
        found[row, last] = 0.5 * (response(corner, qy[:, last]) + response(corner, -qy[:, last])).real
    found[0, 0] = at_mean
    return found


def free_pixel(conductor: HeatConductor, velocity: Velocity, grid: Grid, depth: float = 0.0) -> RealArray:
    """Temperature (2 nx - 1, 2 ny - 1) in K m²/W at all offsets from a pixel of unit flux, at the
    ``depth`` in m.

    Raises
    ------
    InputError
        If the body lies on a rigid base, which in free contact is not covered.
    """
    if math.isfinite(conductor.sink_depth):
        raise InputError(
            "base of a layered body must be a material for the heat of a free contact, but is rigid. Give it one, or "
            "take {periodic}."
        )
    base = (conductor.conductivity, conductor.diffusivity)
    if not conductor.layers:
        return pixel_kernel(grid.shape, grid.spacing, *base, velocity, depth=depth)
    top = conductor.layers[0]
    near = depth < top.thickness
    own, deep = (top.conductivity, top.diffusivity), 2.0 * top.thickness if near else depth
    found = pixel_kernel(grid.shape, grid.spacing, *base, velocity, depth=deep)
    if near:
        found = found + pixel_kernel(grid.shape, grid.spacing, *own, velocity, depth=depth)
        found = found - pixel_kernel(grid.shape, grid.spacing, *own, velocity, depth=deep)

    def rest(qx: RealArray, qy: RealArray) -> ComplexArray:
        """What is left: bounded for long waves, and gone for those short against the layer."""
        sb = decay(qx, qy, conductor.diffusivity, velocity)
        more = conductor.below(depth, qx, qy, velocity) - np.exp(-sb * deep) / (conductor.conductivity * sb)
        if near:
            s = decay(qx, qy, top.diffusivity, velocity)
            more = more - (np.exp(-s * depth) - np.exp(-s * deep)) / (top.conductivity * s)
        return np.asarray(more)

    return found + _by_waves(rest, velocity, grid, deep - depth if near else depth)


def _by_waves(response: Response, velocity: Velocity, grid: Grid, scale: float) -> RealArray:
    """Temperature at all offsets from a pixel by the ``response`` to waves, which is bounded and
    falls on the length ``scale``.

    Where nothing repeats the wakes are long, and a box of waves would have to be longer. So this is
    a product of quadratures along qx and qy, graded towards zero where the response of a moving
    body is a root, with the phase of the largest offset resolved everywhere.
    """
    if velocity[0] and velocity[1]:
        raise InputError(
            "direction of motion must be along x or y for the layered bodies of a free contact, but is oblique "
            "({heating.direction=0deg})."
        )
    if velocity[1]:

        def turned(qx: RealArray, qy: RealArray) -> ComplexArray:
            return response(qy.T, qx.T).T

        return _by_waves(turned, velocity[::-1], grid.exchanged, scale).T
    rules = [_rule(n, d, scale) for n, d in zip(grid.shape, grid.spacing, strict=True)]
    (qx, wx), (qy, wy) = rules
    waves_x, waves_y = (
        np.arange(n)[:, None] * d * q for n, d, (q, _) in zip(grid.shape, grid.spacing, rules, strict=True)
    )
    even, odd, across = np.cos(waves_x), np.sin(waves_x), np.cos(waves_y)
    quarter, turn = np.zeros(grid.shape), np.zeros(grid.shape)
    wx = wx * np.sinc(qx * grid.spacing[0] / (2.0 * np.pi))
    wy = wy * np.sinc(qy * grid.spacing[1] / (2.0 * np.pi)) * grid.pixel_area / math.pi**2
    for first in range(0, qx.size, _BLOCK):
        part = slice(first, first + _BLOCK)
        found = response(qx[part, None], qy[None, :]) * wx[part, None] * wy
        quarter += (even[:, part] @ found.real) @ across.T
        turn += (odd[:, part] @ found.imag) @ across.T
    half = np.concatenate([(quarter + turn)[:0:-1], quarter - turn])
    return np.concatenate([half[:, :0:-1], half], axis=1)


_BLOCK = 256
"""Waves along x at a time."""


def _rule(n: int, d: float, scale: float) -> tuple[RealArray, RealArray]:
    """Wavenumbers and weights of an integral from 0 to where the response is gone, for offsets up
    to n d."""
    last = min(2.0 * SHORTEST / scale, 4.0 * math.pi / d)
    panel = 4.0 * math.pi / (n * d)
    breaks = np.append(np.arange(panel, last, panel), last)
    breaks = np.concatenate([[0.0], breaks[0] * 4.0 ** np.arange(-GRADES, 0), breaks])
    return gauss(breaks, NODES)


def _cyclic(kernel: RealArray, grid: Grid, padded: tuple[int, int]) -> ComplexArray:
    """Spectrum of a ``kernel`` at all offsets on the padded grid."""
    nx, ny = grid.shape
    whole = np.zeros(padded)
    at_x, at_y = np.arange(1 - nx, nx) % padded[0], np.arange(1 - ny, ny) % padded[1]
    whole[np.ix_(at_x, at_y)] = kernel
    return RealTransform(padded).forward(whole)
