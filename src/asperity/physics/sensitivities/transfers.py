"""Stress at depth under pressure on the surface, wavenumber by wavenumber, and its derivatives with
respect to moduli, Poisson's ratios and thicknesses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ...core.arrays import RealArray
from ...solids.compliance.layered import (
    LayerMatrices,
    Modulus,
    PlaneCompliance,
    PlaneVector,
    half_space,
    layer_matrices,
    lower_face,
    lowered,
    raised,
    rigid,
)
from ...solids.compliance.rates import constants
from ...solids.elastic import Elastic
from ...solids.layers import Bonded, Interface, Layered
from ..stress.regions import Plane

_STEP = 1e-30
"""Imaginary step, relative to a modulus or a thickness: its square is lost in rounding."""


class Slab(NamedTuple):
    """Shear modulus, Poisson's ratio and thickness of a layer or half-space, numbers or arrays
    (constants, 1), and the interface below it."""

    G: Modulus
    nu: Modulus
    thickness: Modulus
    interface: Interface

    def matrices(self, alpha: RealArray, share: float = 1.0) -> LayerMatrices:
        """Of a ``share`` of its thickness."""
        return layer_matrices(alpha, share * self.thickness, shear_modulus=self.G, nu=self.nu)


class Amplitudes(NamedTuple):
    """Amplitudes on a plane per unit pressure: the tractions ``z`` and ``L`` and the stress ``LL``
    along the wavevector, as of ``Transfer`` of the stresses."""

    z: Any
    L: Any
    LL: Any


def plain(stack: Layered) -> tuple[Slab, ...]:
    """Slabs of a reduced ``stack``; a rigid base is none."""
    found = [
        Slab(layer.material.shear_modulus, layer.material.poisson_ratio, layer.thickness, layer.interface)
        for layer in stack.layers
    ]
    if isinstance(stack.base, Elastic):
        found.append(Slab(stack.base.shear_modulus, stack.base.poisson_ratio, np.inf, Bonded()))
    return tuple(found)


def stepped(stack: Layered) -> tuple[Slab, ...]:
    """Slabs of a reduced ``stack`` with an imaginary step in one of its ``constants`` after the
    other, along the first axis (Squire & Trapp 1998)."""
    known = constants(stack)
    steps = np.array([_STEP * (1.0 if each.kind == "poisson_ratio" else each.value) for each in known])
    found = []
    for number, slab in enumerate(plain(stack)):
        of = {
            kind: 1j * np.where([each.layer == number and each.kind == kind for each in known], steps, 0.0)[:, None]
            for kind in ("youngs_modulus", "poisson_ratio", "thickness")
        }
        E, nu = 2.0 * slab.G * (1.0 + slab.nu), slab.nu + of["poisson_ratio"]
        thickness = slab.thickness if np.isinf(slab.thickness) else slab.thickness + of["thickness"]
        found.append(Slab(0.5 * (E + of["youngs_modulus"]) / (1.0 + nu), nu, thickness, slab.interface))
    return tuple(found)


@dataclass(frozen=True, eq=False)
class Place:
    """Where a plane stays as thicknesses change: in a layer at the same ``share`` of its thickness,
    in the half-space at the same ``depth`` (m) below its top."""

    region: int
    share: float
    depth: float

    @classmethod
    def of(cls, plane: Plane) -> Place:
        """Of a ``plane``."""
        region = plane.region
        if np.isinf(region.bottom):
            return cls(region.index, 0.0, plane.local_depth)
        share = {"surface": 0.0, "below": 0.0, "above": 1.0}.get(plane.side)
        whole = region.bottom - region.top
        return cls(region.index, plane.local_depth / whole if share is None else share, 0.0)


class PressureTransfers:
    """Amplitudes of the stress on planes in ``slabs`` (on a rigid base without ``base``) at the
    wavenumbers ``alpha`` (n,) > 0; what planes have in common is computed once.

    The recursions are those of the stresses (``stress.kernels.transfer``), which hold for complex
    constants.
    """

    def __init__(self, slabs: Sequence[Slab], alpha: RealArray, *, base: bool) -> None:
        self._alpha, self._layers = alpha, slabs[:-1] if base else slabs
        self._base = slabs[-1] if base else None
        below = rigid(alpha) if self._base is None else half_space(alpha, shear_modulus=self._base.G, nu=self._base.nu)
        found: list[PlaneCompliance] = [below]
        matrices = [slab.matrices(alpha) for slab in self._layers]
        for slab, whole in zip(reversed(self._layers), reversed(matrices), strict=True):
            found.append(raised(found[-1], whole, slab.interface))
        self._below, zero, one = found[::-1], np.zeros_like(alpha), np.ones_like(alpha)
        self._tops = [PlaneVector(L=zero, z=one, T=zero)]
        for slab, whole, under in zip(self._layers, matrices, self._below[1:], strict=True):
            self._tops.append(lowered(self._tops[-1], under, whole, slab.interface))
        self._whole = matrices

    def to(self, place: Place) -> Amplitudes:
        """Amplitudes at a ``place``."""
        number, alpha = place.region, self._alpha
        traction = self._tops[number]
        if number == len(self._layers):
            assert self._base is not None
            slab, x = self._base, alpha * place.depth
            e = np.exp(-x)
            traction = PlaneVector(
                L=e * ((1.0 - x) * traction.L - x * traction.z),
                z=e * (x * traction.L + (1.0 + x) * traction.z),
                T=traction.T,
            )
            displacement = half_space(alpha, shear_modulus=slab.G, nu=slab.nu).displacement(traction)
        elif place.share == 0.0:
            slab, displacement = self._layers[number], self._below[number].displacement(traction)
        else:
            slab, below = self._layers[number], self._below[number + 1]
            if place.share == 1.0:  # at the lower face the interface decides
                displacement = lower_face(traction, below, self._whole[number], slab.interface)
                traction = lowered(traction, below, self._whole[number], slab.interface)
            else:
                under = raised(below, slab.matrices(alpha, 1.0 - place.share), slab.interface)
                traction = lowered(traction, under, slab.matrices(alpha, place.share))
                displacement = under.displacement(traction)
        LL = -(2.0 * slab.G * alpha * displacement.L + slab.nu * traction.z) / (1.0 - slab.nu)
        return Amplitudes(traction.z, traction.L, LL)


def rates_of(found: Amplitudes, stack: Layered, alpha: RealArray) -> RealArray:
    """Derivatives (constants, 3, n) of ``found`` with ``stepped`` slabs, per unit of each
    constant."""
    known = constants(stack)
    steps = np.array([_STEP * (1.0 if each.kind == "poisson_ratio" else each.value) for each in known])
    shape = (len(known), alpha.size)
    parts = [np.broadcast_to(np.imag(part), shape) for part in found]
    return np.asarray(np.stack(parts, axis=1) / steps[:, None, None])
