"""Influence coefficients of strips under uniform traction for every field on a plane in a layered body, plane strain.

With the wavevector along x, c = ±1 and s = 0: fields are cosine or sine integrals of the transfer amplitudes. In the
outermost region the homogeneous strip is added in closed form (Johnson 1985, sec. 2.5). Displacements are zero on the surface at the distance ``datum`` from a line load, as in the contact.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ..core.arrays import RealArray
from ..core.grid import Grid
from ..core.tensor import AXES, STRESSES, Displacement, ElasticFields, StressTensor
from ..solids.compliance.line_integral import LineIntegral, line_integral
from ..solids.compliance.point_kernel import wavenumber_grid
from ..solids.layers import Layered, RigidBase
from ..theories.line_loads import (
    flamant_normal,
    flamant_out_of_plane,
    flamant_tangential,
    strip_out_of_plane,
    strip_pressure,
    strip_shear,
)
from .coefficients import PlaneCoefficients
from .patch import Load
from .regions import Plane, planes
from .transfer import Transfer

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
    """Coefficients of all fields on ``plane`` of ``body`` (finite, positive layers only) on ``grid`` (nx, 1)."""

    body: Layered
    plane: Plane
    grid: Grid
    datum: float

    def stress(self, load: Load) -> StressTensor:
        """Stress (Pa/Pa) at offsets (0…nx-1) dx from a strip of width dx under unit traction, arrays (nx, 1)."""
        found = self._fields(load, STRESSES)
        total = StressTensor(*(found[name] for name in STRESSES))
        return total + self._homogeneous(load).stress if self.plane.region.index == 0 else total

    def displacement(self, load: Load) -> Displacement:
        """Displacement (m/Pa), as ``stress``."""
        found = self._fields(load, AXES)
        total = Displacement(*(found[name] for name in AXES))
        if self.plane.region.index == 0:
            total = total + self._homogeneous(load).displacement
        shift = self._at_datum(load) * self.grid.spacing[0]
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

    def _at_datum(self, load: Load) -> float:
        """Surface displacement along the load at the datum from a unit line load; zero on a rigid base, which is one."""
        if isinstance(self.body.base, RigidBase):
            return 0.0
        surface = LineCoefficients(self.body, planes(self.body, [0.0])[0], self.grid, self.datum)
        solid, x = surface.plane.region.material, np.array(self.datum)
        known = LINES[load](x, 0.0, shear=solid.shear_modulus, nu=solid.poisson_ratio).displacement
        rest = surface._integrals(load, (load,))
        return float(getattr(known, load)) + (rest[load].slope(self.datum) if rest else 0.0)
