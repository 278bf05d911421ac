"""Derivatives of the conductors' compliance, flux density to potential, with respect to
resistivities or conductivities and thicknesses."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import RealArray
from ...core.grid import Grid
from ...solids.compliance.halfspace import Compliance, HalfSpace
from ...solids.compliance.influence import (
    Limits,
    line_kernel,
    patch_coefficients,
    point_kernel,
    strip_coefficients,
    wavenumber_grid,
    wavenumbers,
)
from ...solids.elastic import Elastic, Rigid
from ...solids.layers import Body, Layered
from .operator import Flow, LayeredConductor, conductor_of, transfer

_STEP = 1e-30
"""Imaginary step, relative to a conductivity or thickness (Squire & Trapp 1998)."""

UNITS = {"electrical_resistivity": "ohm*m", "thermal_conductivity": "W/(m*K)", "thickness": "m"}
"""SI units of the constants of a conductor."""


class ConductorConstant(NamedTuple):
    """A constant of a conductor: its ``kind`` (see ``UNITS``), the number of its ``layer`` in the
    reduced body from the surface down, that of the layers for the base, its ``value`` (SI), and
    the derivative of the compliance to it, ``factor`` times ``rate``."""

    kind: str
    layer: int
    value: float
    rate: Compliance
    factor: float


def conductor_constants(body: Body, flow: Flow, which: str) -> tuple[ConductorConstant, ...]:
    """Constants of ``body`` on which its compliance as a conductor depends, none of a rigid one;
    ``which`` body it is, for messages.

    Raises
    ------
    InputError
        If the conductivity of a material is not known.
    """
    conductor = conductor_of(body, flow, which)
    if conductor is None or isinstance(body, Rigid):
        return ()
    if not isinstance(conductor, LayeredConductor):
        material = body.reduced.base if isinstance(body, Layered) else body
        assert isinstance(material, Elastic)
        conductivity = flow.conductivity(material, which)
        # Z = 1/(k q), half of the unit half-space's 2/q
        return (_of_material(flow, 0, conductivity, HalfSpace(1.0), -0.5 / conductivity**2),)
    found = list[ConductorConstant]()
    for k, conductivity in enumerate(conductor.conductivity):
        if math.isfinite(conductivity):
            found.append(_of_material(flow, k, conductivity, ConductorRate(conductor, k), 1.0))
        if k < len(conductor.thickness):
            rate = ConductorRate(conductor, k, of_thickness=True)
            found.append(ConductorConstant("thickness", k, conductor.thickness[k], rate, 1.0))
    return tuple(found)


def _of_material(flow: Flow, layer: int, conductivity: float, rate: Compliance, factor: float) -> ConductorConstant:
    """The constant behind a ``conductivity`` k, from the derivative to k; dk/dρ = -k²."""
    if flow.resistivity:
        return ConductorConstant(flow.key, layer, 1.0 / conductivity, rate, -(conductivity**2) * factor)
    return ConductorConstant(flow.key, layer, conductivity, rate, factor)


@dataclass(frozen=True, eq=False)
class ConductorRate:
    """Derivative of the compliance Z(q) of a layered ``conductor`` with respect to the conductivity
    of the ``layer`` of this number, or its thickness, per unit of it."""

    conductor: LayeredConductor
    layer: int
    of_thickness: bool = False
    citation_keys: ClassVar[tuple[str, ...]] = ()

    def spectral(self, wavenumber: ArrayLike) -> RealArray:
        """dZ(q) at ``wavenumber`` q > 0 (rad/m)."""
        q = wavenumbers(wavenumber)
        return self._times_wavenumber(q) / q

    def mean_mode(self) -> float:
        """dZ(0) on a base of one potential, of the sum of h/k; 0 on a half-space."""
        if math.isfinite(self.conductor.conductivity[-1]):
            return 0.0
        k, h = self.conductor.conductivity[self.layer], self.conductor.thickness[self.layer]
        return 1.0 / k if self.of_thickness else -h / k**2

    def influence(self, grid: Grid) -> RealArray:
        """Derivative of the potential at pixel offsets (nx, ny) from a pixel of unit flux
        density."""
        return patch_coefficients(point_kernel(*self._sampled), grid)

    def line_influence(self, grid: Grid, datum: float) -> RealArray:
        """The same at offsets (nx, 1) from a strip of unit flux density."""
        return strip_coefficients(line_kernel(*self._sampled), grid, datum)

    def _times_wavenumber(self, q: RealArray) -> RealArray:
        """q dZ by a complex step: Z is analytic in thicknesses and conductivities."""
        thickness, conductivity = list[complex](self.conductor.thickness), list[complex](self.conductor.conductivity)
        moved = thickness if self.of_thickness else conductivity
        step = _STEP * moved[self.layer].real
        moved[self.layer] += 1j * step
        return np.asarray(transfer(q, thickness, conductivity).imag / step)

    @cached_property
    def _sampled(self) -> tuple[RealArray, Limits]:
        conductivity, depth = self.conductor.conductivity, sum(self.conductor.thickness)
        slope = 0.0 if self.of_thickness else -1.0 / conductivity[self.layer] ** 2
        base = self.layer == len(conductivity) - 1
        limits = Limits(slope if self.layer == 0 else 0.0, slope if base else 0.0, depth)
        return self._times_wavenumber(wavenumber_grid(depth)), limits
