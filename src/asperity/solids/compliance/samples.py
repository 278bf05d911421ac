"""Compliance of a body on a logarithmic grid of wavenumbers, with its limits: all that responses in real space need."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...core.arrays import RealArray
from ..elastic import Elastic
from ..layers import Layered
from .hybrid import PlaneCompliance, half_space, interface_compliances, rigid
from .point_kernel import Limits, PointKernel, point_kernel, wavenumber_grid

Component = Callable[[PlaneCompliance], RealArray]
"""Picks or combines components of a compliance."""


@dataclass(frozen=True, eq=False)
class Samples:
    """``values`` of alpha C (1/Pa) on ``wavenumber_grid(depth)`` and its limits at short (``high``) and long wavelengths."""

    depth: float
    values: PlaneCompliance
    high: PlaneCompliance
    low: PlaneCompliance

    def limits(self, component: Component) -> Limits:
        """Limits of one ``component``."""
        return Limits(float(component(self.high)), float(component(self.low)), self.depth)

    def kernel(self, component: Component, order: int = 0) -> PointKernel:
        """Response to a point force of one ``component`` with the angular ``order``."""
        return point_kernel(component(self.values), self.limits(component), order)


def samples(body: Elastic | Layered, depth: float) -> Samples:
    """Samples of ``body`` around the wavenumber 1/``depth`` (m), which for layers should be about their thickness."""
    stack = body.reduced if isinstance(body, Layered) else Layered((), body)
    alpha = wavenumber_grid(depth)
    values = interface_compliances(stack, alpha)[0].scaled(alpha)
    base = low = _strength(stack.base) if isinstance(stack.base, Elastic) else rigid(np.ones(()))
    if stack.slips:
        # the layers above carry a shear traction as a sheet does, and their Poisson contraction moves the surface: for
        # one layer C_Lz alpha tends to -nu/2G; displacements along the surface grow without limit
        low = PlaneCompliance(np.array(np.inf), base.zz, values.Lz[0], np.array(np.inf))
    return Samples(depth, values, _strength(stack.layers[0].material) if stack.layers else base, low)


def _strength(material: Elastic) -> PlaneCompliance:
    """alpha C of a half-space, which is the same at every wavenumber."""
    return half_space(np.ones(()), shear_modulus=material.shear_modulus, nu=material.poisson_ratio)
