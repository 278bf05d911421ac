"""Influence coefficients of pixels under uniform traction for every field on a plane in a layered body, not periodic.

A spectrum f(α) cos(mφ) or f(α) sin(mφ), φ the direction of the wavevector, belongs to a point response of angular order m
(see ``solids.compliance.point_kernel``), and products of c = cos φ and s = sin φ in the turned fields are such functions. In
the outermost region the field of a homogeneous body of its material is subtracted and added in closed form, so that the
rest decays as exp(-α(2h - z)) and nothing is singular at the surface.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import TypeAlias

import numpy as np

from ..core.arrays import RealArray
from ..core.grid import Grid
from ..core.tensor import Displacement, StressTensor
from ..solids.compliance.patch_average import (
    COS_1,
    COS_2,
    ISOTROPIC,
    SIN_1,
    SIN_2,
    Angular,
    patch_coefficients,
)
from ..solids.compliance.point_kernel import Limits, PointKernel, point_kernel, wavenumber_grid
from ..solids.elastic import Elastic
from ..solids.layers import Layered
from .patch import Load, displacement_coefficients, stress_coefficients
from .regions import Plane, Region
from .transfer import Transfer, transfer

COS_3 = Angular(lambda c, s: c * (c * c - 3.0 * s * s), even_x=False, even_y=True)
SIN_3 = Angular(lambda c, s: s * (3.0 * c * c - s * s), even_x=True, even_y=False)

_DECAYED = 45.0  # exponent from which the remainder of the outermost region is rounding only

Term: TypeAlias = tuple[str, Angular, float]
"""Name of a point kernel, its angular factor and sign."""

STRESS_UNDER_PRESSURE: dict[str, tuple[Term, ...]] = {
    "xx": (("mean", ISOTROPIC, 1.0), ("bend", COS_2, -1.0)),
    "yy": (("mean", ISOTROPIC, 1.0), ("bend", COS_2, 1.0)),
    "zz": (("normal", ISOTROPIC, -1.0),),
    "xy": (("bend", SIN_2, -1.0),),
    "xz": (("slide", COS_1, 1.0),),
    "yz": (("slide", SIN_1, 1.0),),
}
STRESS_UNDER_SHEAR: dict[str, tuple[Term, ...]] = {
    "xx": (("along", COS_1, 1.0), ("twist", COS_3, -1.0)),
    "yy": (("across", COS_1, 1.0), ("twist", COS_3, 1.0)),
    "zz": (("lift", COS_1, -1.0),),
    "xy": (("skew", SIN_1, 1.0), ("twist", SIN_3, -1.0)),
    "xz": (("carry", ISOTROPIC, -1.0), ("turn", COS_2, 1.0)),
    "yz": (("turn", SIN_2, 1.0),),
}
DISPLACEMENT_UNDER_PRESSURE: dict[str, tuple[Term, ...]] = {
    "x": (("spread", COS_1, -1.0),),
    "y": (("spread", SIN_1, -1.0),),
    "z": (("sink", ISOTROPIC, 1.0),),
}
DISPLACEMENT_UNDER_SHEAR: dict[str, tuple[Term, ...]] = {
    "x": (("drag", ISOTROPIC, 1.0), ("sway", COS_2, -1.0)),
    "y": (("sway", SIN_2, -1.0),),
    "z": (("tilt", COS_1, 1.0),),
}

SPECTRA: dict[str, tuple[int, Callable[[Transfer, float], RealArray]]] = {
    "normal": (0, lambda t, nu: t.tau_zz),
    "slide": (1, lambda t, nu: t.tau_Lz),
    "mean": (0, lambda t, nu: 0.5 * (t.LL_z + nu * (t.LL_z - t.tau_zz))),
    "bend": (2, lambda t, nu: 0.5 * (t.LL_z - nu * (t.LL_z - t.tau_zz))),
    "lift": (1, lambda t, nu: t.tau_zL),
    "carry": (0, lambda t, nu: 0.5 * (t.tau_LL + t.tau_T)),
    "turn": (2, lambda t, nu: 0.5 * (t.tau_LL - t.tau_T)),
    "along": (1, lambda t, nu: 0.25 * (3.0 * t.LL_L + nu * (t.LL_L - t.tau_zL)) - 0.5 * t.LT),
    "across": (1, lambda t, nu: 0.25 * (t.LL_L + 3.0 * nu * (t.LL_L - t.tau_zL)) + 0.5 * t.LT),
    "skew": (1, lambda t, nu: 0.25 * (t.LL_L - nu * (t.LL_L - t.tau_zL)) - 0.5 * t.LT),
    "twist": (3, lambda t, nu: 0.25 * (t.LL_L - nu * (t.LL_L - t.tau_zL)) + 0.5 * t.LT),
    "sink": (0, lambda t, nu: t.W_z),
    "spread": (1, lambda t, nu: t.U_z),
    "tilt": (1, lambda t, nu: t.W_L),
    "drag": (0, lambda t, nu: 0.5 * (t.U_L + t.u_T)),
    "sway": (2, lambda t, nu: 0.5 * (t.U_L - t.u_T)),
}
"""Angular order and spectrum of every point kernel; σ_TT = ν(σ_LL - τ_z)."""


@dataclass(frozen=True, eq=False)
class PlaneCoefficients:
    """Coefficients of all fields on ``plane`` of ``body`` (finite, positive layers only) on ``grid``."""

    body: Layered
    plane: Plane
    grid: Grid

    def stress(self, load: Load) -> StressTensor:
        """Stress (Pa/Pa) at pixel offsets (0…nx-1, 0…ny-1) from a pixel under unit traction, arrays (nx, ny).

        The error is below 1e-8 of the largest coefficient.
        """
        if load == "y":
            return self._exchanged.stress("x").map(np.transpose).exchanged()
        terms = STRESS_UNDER_PRESSURE if load == "z" else STRESS_UNDER_SHEAR
        nu = self.plane.region.material.poisson_ratio
        known = stress_coefficients(self.grid, self.plane.depth, load, nu) if self._outermost else None
        if known is not None and self._homogeneous:
            return known
        rest = StressTensor(**self._sums(terms))
        return rest if known is None else known + rest

    def displacement(self, load: Load) -> Displacement:
        """Displacement (m/Pa), as ``stress``; zero at infinity."""
        if load == "y":
            return self._exchanged.displacement("x").map(np.transpose).exchanged()
        terms = DISPLACEMENT_UNDER_PRESSURE if load == "z" else DISPLACEMENT_UNDER_SHEAR
        solid = self.plane.region.material
        shear, nu = solid.shear_modulus, solid.poisson_ratio
        known = displacement_coefficients(self.grid, self.plane.depth, load, shear, nu) if self._outermost else None
        if known is not None and self._homogeneous:
            return known
        rest = Displacement(**self._sums(terms))
        return rest if known is None else known + rest

    @property
    def _outermost(self) -> bool:
        return self.plane.region.index == 0

    @property
    def _homogeneous(self) -> bool:
        return not self.body.layers

    @property
    def _exchanged(self) -> PlaneCoefficients:
        return PlaneCoefficients(self.body, self.plane, Grid(self.grid.shape[::-1], self.grid.spacing[::-1]))

    def _sums(self, terms: dict[str, tuple[Term, ...]]) -> dict[str, RealArray]:
        """Pixel averages of the point kernels in ``terms``; each kernel with each angular factor is averaged once."""
        kernels = self.kernels({name for line in terms.values() for name, _, _ in line})
        averages = {
            (name, id(angular)): patch_coefficients(kernels[name], self.grid, angular)
            for line in terms.values()
            for name, angular, _ in line
        }
        return {
            component: sum(
                (sign * averages[name, id(angular)] for name, angular, sign in line), np.zeros(self.grid.shape)
            )
            for component, line in terms.items()
        }

    def kernels(self, names: set[str]) -> dict[str, PointKernel]:
        """Point kernels by name (see ``SPECTRA``), in the outermost region less those of a homogeneous body."""
        length = self.body.thickness
        alpha = wavenumber_grid(length)
        spectra = self.spectra(alpha)
        nu = self.plane.region.material.poisson_ratio
        kernels = {}
        for name in names:
            order, combine = SPECTRA[name]
            values = alpha * combine(spectra, nu)
            kernels[name] = point_kernel(values, Limits(0.0, float(values[0]), length), order)
        return kernels

    def spectra(self, alpha: RealArray) -> Transfer:
        """Transfer to the plane at wavenumbers ``alpha`` (rad/m); in the outermost region less that of a homogeneous body."""
        found = transfer(self.body, self.plane, alpha)
        if not self._outermost:
            return found
        solid: Elastic = self.plane.region.material
        alone = Plane(self.plane.depth, Region(0, "", solid, 0.0, np.inf), "inside")
        same = transfer(Layered((), solid), alone, alpha)
        keep = alpha * (2.0 * self.plane.region.bottom - self.plane.depth) < _DECAYED
        rest = {f.name: np.where(keep, getattr(found, f.name) - getattr(same, f.name), 0.0) for f in fields(Transfer)}
        return Transfer(**rest)
