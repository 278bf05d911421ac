"""Influence coefficients of pixels under uniform traction for every field on a plane in a layered
body, not periodic.

A spectrum f(α) cos(mφ) or f(α) sin(mφ), φ the direction of the wavevector, belongs to a point
response of angular order m (see ``solids.compliance.point_kernel``), and products of c = cos φ and
s = sin φ in the turned fields are such functions. In the outermost region the field of a
homogeneous body of its material is subtracted and added in closed form, so that the rest decays as
exp(-α(2h - z)) and nothing is singular at the surface.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import TypeAlias

import numpy as np

from ....core.arrays import RealArray
from ....core.grid import Grid
from ....core.tensor import AXES, STRESSES, Displacement, ElasticFields, StressTensor
from ....solids.compliance.influence import (
    COS_1,
    COS_2,
    ISOTROPIC,
    SIN_1,
    SIN_2,
    Angular,
    Limits,
    LineIntegral,
    PointKernel,
    line_integral,
    patch_coefficients,
    point_kernel,
    wavenumber_grid,
)
from ....solids.elastic import Elastic
from ....solids.layers import Layered, RigidBase
from ....theories.subsurface.loads import (
    flamant_normal,
    flamant_out_of_plane,
    flamant_tangential,
    strip_out_of_plane,
    strip_pressure,
    strip_shear,
)
from ..regions import Plane, Region, planes
from .patch import Load, displacement_coefficients, stress_coefficients
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
    """Coefficients of all fields on ``plane`` of ``body`` (finite, positive layers only) on
    ``grid``."""

    body: Layered
    plane: Plane
    grid: Grid

    def stress(self, load: Load) -> StressTensor:
        """Stress (Pa/Pa) at pixel offsets (0…nx-1, 0…ny-1) from a pixel under unit traction, arrays
        (nx, ny).

        The error is below 1e-8 of the largest coefficient.
        """
        if load == "y":
            return replace(self, grid=self.grid.exchanged).stress("x").map(np.transpose).exchanged()
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
            return replace(self, grid=self.grid.exchanged).displacement("x").map(np.transpose).exchanged()
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

    def _sums(self, terms: dict[str, tuple[Term, ...]]) -> dict[str, RealArray]:
        """Pixel averages of the point kernels in ``terms``; each kernel with each angular factor is
        averaged once."""
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
        """Point kernels by name (see ``SPECTRA``), in the outermost region less those of a
        homogeneous body."""
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
        """Transfer to the plane at wavenumbers ``alpha`` (rad/m); in the outermost region less that
        of a homogeneous body."""
        found = transfer(self.body, self.plane, alpha)
        if not self._outermost:
            return found
        solid: Elastic = self.plane.region.material
        alone = Plane(self.plane.depth, Region(0, "", solid, 0.0, np.inf), "inside")
        same = transfer(Layered((), solid), alone, alpha)
        keep = alpha * (2.0 * self.plane.region.bottom - self.plane.depth) < _DECAYED
        rest = {f.name: np.where(keep, getattr(found, f.name) - getattr(same, f.name), 0.0) for f in fields(Transfer)}
        return Transfer(**rest)


# Influence coefficients of strips under uniform traction for every field on a plane in a layered
# body, plane strain.
#
# With the wavevector along x, c = ±1 and s = 0: fields are cosine or sine integrals of the transfer
# amplitudes. In the outermost region the homogeneous strip is added in closed form (Johnson 1985,
# sec. 2.5). Displacements are zero on the surface at the distance ``datum`` from a line load, as in
# the contact.


Wave: TypeAlias = tuple[Callable[[Transfer, float], RealArray], bool, float]
"""Amplitude, whether it goes with the cosine, and the sign."""

FIELDS: dict[Load, dict[str, Wave]] = {
    "z": {
        "x": (lambda t, nu: t.U_z, False, -1.0),
        "z": (lambda t, nu: t.W_z, True, 1.0),
        "xx": (lambda t, nu: t.LL_z, True, 1.0),
        "yy": (lambda t, nu: nu * (t.LL_z - t.tau_zz), True, 1.0),
        "zz": (lambda t, nu: t.tau_zz, True, -1.0),
        "xz": (lambda t, nu: t.tau_Lz, False, 1.0),
    },
    "x": {
        "x": (lambda t, nu: t.U_L, True, 1.0),
        "z": (lambda t, nu: t.W_L, False, 1.0),
        "xx": (lambda t, nu: t.LL_L, False, 1.0),
        "yy": (lambda t, nu: nu * (t.LL_L - t.tau_zL), False, 1.0),
        "zz": (lambda t, nu: t.tau_zL, False, -1.0),
        "xz": (lambda t, nu: t.tau_LL, True, -1.0),
    },
    "y": {
        "y": (lambda t, nu: t.u_T, True, 1.0),
        "xy": (lambda t, nu: t.LT, False, -1.0),
        "yz": (lambda t, nu: t.tau_T, True, -1.0),
    },
}
"""Fields that a load causes at all, those of displacement by their axis."""

STRIPS = {"z": strip_pressure, "x": strip_shear, "y": strip_out_of_plane}
"""Homogeneous strips by the direction of their traction."""

LINES = {"z": flamant_normal, "x": flamant_tangential, "y": flamant_out_of_plane}
"""Homogeneous line loads by their direction."""


@dataclass(frozen=True, eq=False)
class LineCoefficients:
    """Coefficients of all fields on ``plane`` of ``body`` (finite, positive layers only) on
    ``grid`` (nx, 1)."""

    body: Layered
    plane: Plane
    grid: Grid
    datum: float

    def stress(self, load: Load) -> StressTensor:
        """Stress (Pa/Pa) at offsets (0…nx-1) dx from a strip of width dx under unit traction,
        arrays (nx, 1)."""
        found = self._fields(load, STRESSES)
        total = StressTensor(*(found[name] for name in STRESSES))
        return total + self._homogeneous(load).stress if self.plane.region.index == 0 else total

    def displacement(self, load: Load) -> Displacement:
        """Displacement (m/Pa), as ``stress``."""
        found = self._fields(load, AXES)
        total = Displacement(*(found[name] for name in AXES))
        if self.plane.region.index == 0:
            total = total + self._homogeneous(load).displacement
        shift = 0.0  # zero on a rigid base, which is a datum itself
        if not isinstance(self.body.base, RigidBase):  # displacement of the surface at the datum from a unit line load
            surface = LineCoefficients(self.body, planes(self.body, [0.0])[0], self.grid, self.datum)
            solid, x = surface.plane.region.material, np.array(self.datum)
            known = LINES[load](x, 0.0, shear=solid.shear_modulus, nu=solid.poisson_ratio).displacement
            rest = surface._integrals(load, (load,))
            at_datum = float(getattr(known, load)) + (rest[load].slope(self.datum) if rest else 0.0)
            shift = at_datum * self.grid.spacing[0]
        return Displacement(*(getattr(total, axis) - (shift if axis == load else 0.0) for axis in AXES))

    def _fields(self, load: Load, names: tuple[str, ...]) -> dict[str, RealArray]:
        """The rest of each field beside the homogeneous part, zero where the load causes none."""
        (nx, _), (dx, _) = self.grid.shape, self.grid.spacing
        edges = (np.arange(nx) + 0.5) * dx
        found: dict[str, RealArray] = {name: np.zeros((nx, 1)) for name in names}
        for name, integral in self._integrals(load, names).items():
            at_edges = integral(edges)
            first = -at_edges[0] if FIELDS[load][name][1] else at_edges[0]  # odd about zero for the cosine, even else
            found[name] = np.diff(at_edges, prepend=first)[:, None]
        return found

    def _integrals(self, load: Load, names: tuple[str, ...]) -> dict[str, LineIntegral]:
        if not self.body.layers:
            return {}
        length = self.body.thickness
        alpha = wavenumber_grid(length)
        ready = PlaneCoefficients(self.body, self.plane, self.grid)
        spectra, nu = ready.spectra(alpha), self.plane.region.material.poisson_ratio
        waves = {name: wave for name, wave in FIELDS[load].items() if name in names}
        return {
            name: line_integral(alpha, sign * amplitude(spectra, nu), length, cosine=cosine)
            for name, (amplitude, cosine, sign) in waves.items()
        }

    def _homogeneous(self, load: Load) -> ElasticFields:
        """Strip on a half-space of the material of the outermost region."""
        solid = self.plane.region.material
        x, half = self.grid.coordinates()[0], 0.5 * self.grid.spacing[0]
        return STRIPS[load](x, self.plane.depth, half, shear=solid.shear_modulus, nu=solid.poisson_ratio)
