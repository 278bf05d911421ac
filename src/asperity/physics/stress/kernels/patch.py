"""All fields of a uniform traction on a rectangle of a homogeneous half-space (Love 1929; Johnson
1985, sec. 3.3)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ....core.arrays import RealArray
from ....core.grid import Grid
from ....core.tensor import Displacement, ElasticFields, StressTensor
from ....theories.subsurface.loads import boussinesq, cerruti

# Potentials of a uniformly loaded quarter plane, from which every field of a rectangular patch is a
# corner sum.
#
# Derivatives of Φ (Φ_XY = ln(R + z)) and Ψ (Ψ_Z = Φ), the Boussinesq-Cerruti potentials (Love 1929;
# Johnson 1985, eqs 3.2-3.10); functions of X alone or Y alone cancel in the corner sum and are left
# out. Written without cancellation: logarithms as asinh, pairs of arctangents as one angle.


_TINY = 1e-290


@dataclass(frozen=True, eq=False)
class Corner:
    """Point (X, Y, z) in m relative to a corner; arrays that broadcast against each other, z >=
    0."""

    X: RealArray
    Y: RealArray
    z: RealArray | float

    @cached_property
    def R(self) -> RealArray:
        """Distance from the corner, kept above 1e-145."""
        return np.sqrt(np.maximum(self.X**2 + self.Y**2 + self.z**2, _TINY))

    @cached_property
    def L_X(self) -> RealArray:
        """ln(R + X) up to a function of Y: Φ_YZ."""
        return np.arcsinh(self.X / np.sqrt(self._yz))

    @cached_property
    def L_Y(self) -> RealArray:
        """ln(R + Y) up to a function of X: Φ_XZ."""
        return np.arcsinh(self.Y / np.sqrt(self._xz))

    @cached_property
    def XY(self) -> RealArray:
        """Φ_XY = ln(R + z)."""
        return np.asarray(np.log(self.R + self.z))

    @cached_property
    def ZZ(self) -> RealArray:
        """Φ_ZZ = -arctan(XY / zR)."""
        return -np.arctan2(self.X * self.Y, self.z * self.R)

    @cached_property
    def XX(self) -> RealArray:
        """Φ_XX = arctan(Y/X) - arctan(zY / XR) as one angle."""
        return np.arctan2(self._twist, self.X**2 * self.R + self.Y**2 * self.z)

    @cached_property
    def YY(self) -> RealArray:
        """Φ_YY, as Φ_XX with X and Y exchanged."""
        return np.arctan2(self._twist, self.Y**2 * self.R + self.X**2 * self.z)

    @cached_property
    def X_(self) -> RealArray:
        """Φ_X."""
        return self.Y * self.XY - self.Y + self.X * self.XX + self.z * self.L_Y

    @cached_property
    def Y_(self) -> RealArray:
        """Φ_Y."""
        return self.X * self.XY - self.X + self.Y * self.YY + self.z * self.L_X

    @cached_property
    def Z_(self) -> RealArray:
        """Φ_Z."""
        return self.X * self.L_Y + self.Y * self.L_X + self.z * self.ZZ

    @cached_property
    def XXZ(self) -> RealArray:
        """Φ_XXZ = -XY / R(X² + z²)."""
        return -self.X * self.Y / self.R / self._xz

    @cached_property
    def YYZ(self) -> RealArray:
        """Φ_YYZ = -XY / R(Y² + z²)."""
        return -self.X * self.Y / self.R / self._yz

    @cached_property
    def XZZ(self) -> RealArray:
        """Φ_XZZ = -zY / R(X² + z²)."""
        return -self.z * self.Y / self.R / self._xz

    @cached_property
    def YZZ(self) -> RealArray:
        """Φ_YZZ = -zX / R(Y² + z²)."""
        return -self.z * self.X / self.R / self._yz

    @cached_property
    def XXY(self) -> RealArray:
        """Φ_XXY = X / R(R + z)."""
        return self.X / self.R / (self.R + self.z)

    @cached_property
    def XYY(self) -> RealArray:
        """Φ_XYY = Y / R(R + z)."""
        return self.Y / self.R / (self.R + self.z)

    @cached_property
    def _xz(self) -> RealArray:
        return np.asarray(np.maximum(self.X**2 + self.z**2, _TINY))

    @cached_property
    def _yz(self) -> RealArray:
        return np.asarray(np.maximum(self.Y**2 + self.z**2, _TINY))

    @cached_property
    def _twist(self) -> RealArray:
        return self.X * self.Y * (self.X**2 + self.Y**2) / (self.R + self.z)


def pressure_stress(c: Corner, nu: float) -> StressTensor:
    """Stress of unit pressure: Love's patch (Love 1929)."""
    z, k = c.z, 1.0 - 2.0 * nu
    s = StressTensor(
        xx=2.0 * nu * c.ZZ - k * c.XX - z * c.XXZ,
        yy=2.0 * nu * c.ZZ - k * c.YY - z * c.YYZ,
        zz=c.ZZ + z * (c.XXZ + c.YYZ),
        xy=-k * c.XY - z / c.R,
        xz=-z * c.XZZ,
        yz=-z * c.YZZ,
    )
    return s * (0.5 / np.pi)


def pressure_displacement(c: Corner, shear: float, nu: float) -> Displacement:
    """Displacement (m/Pa) of unit pressure on a body of shear modulus ``shear`` (Pa)."""
    z, k = c.z, 1.0 - 2.0 * nu
    u = Displacement(-k * c.X_ - z * c.L_Y, -k * c.Y_ - z * c.L_X, 2.0 * (1.0 - nu) * c.Z_ - z * c.ZZ)
    return u * (0.25 / (np.pi * shear))


def shear_stress(c: Corner, nu: float) -> StressTensor:
    """Stress of unit shear traction along +x."""
    z, s = c.z, c.R + c.z
    xzz, xyy = c.XZZ, c.XYY
    t = StressTensor(
        xx=2.0 * (1.0 + nu) * c.L_Y + 2.0 * nu * (-c.L_Y + c.Y / s) + z * (xyy + xzz),
        yy=2.0 * nu * c.L_Y - 2.0 * nu * c.Y / s - z * xyy,
        zz=-z * xzz,
        xy=c.L_X - 2.0 * nu * c.X / s - z * c.XXY,
        xz=c.ZZ - z * c.XXZ,
        yz=-z / c.R,
    )
    return t * (0.5 / np.pi)


def shear_displacement(c: Corner, shear: float, nu: float) -> Displacement:
    """Displacement (m/Pa) of unit shear traction along +x on a body of shear modulus ``shear``
    (Pa)."""
    z = c.z
    psi_xx = -c.X * c.L_Y + z * c.XX
    psi_xy = z * c.XY - c.R
    u = Displacement(
        2.0 * c.Z_ + 2.0 * nu * psi_xx - z * c.XX,
        2.0 * nu * psi_xy - z * c.XY,
        (1.0 - 2.0 * nu) * c.X_ - z * c.L_Y,
    )
    return u * (0.25 / (np.pi * shear))


Load: TypeAlias = Literal["x", "y", "z"]
"""Unit traction on the body: shear along +x, shear along +y, pressure (along +z)."""

_FAR = 300.0  # sides; beyond it corner differences lose more digits than four point forces
_GAUSS = 1.0 / np.sqrt(3.0)
_CORNERS_AT_ONCE = 1 << 17  # so that the potentials of a block of rows stay in the cache


@dataclass(frozen=True)
class Patch:
    """Unit traction in the direction ``load`` on a rectangle of full ``sides`` (m) centred at the
    origin."""

    sides: tuple[float, float]
    load: Load


def patch_fields(x: ArrayLike, y: ArrayLike, z: ArrayLike, patch: Patch, *, shear: float, nu: float) -> ElasticFields:
    """Displacement (m/Pa) and stress (Pa/Pa) of a ``patch`` under unit traction.

    ``x``, ``y``, ``z``: field points in m, broadcast against each other, z >= 0; ``patch``:
    rectangle and direction of the traction; ``shear``, ``nu``: shear modulus G in Pa and Poisson's
    ratio, up to 0.5.

    Notes
    -----
    Relative error of order 1e-15 on and near the patch, below 1e-9 of the field everywhere: corner
    differences lose digits with distance; beyond 300 sides four point forces stand for the patch.
    On the surface an edge has half and a corner a quarter of the traction; in-plane stresses that
    are logarithmically infinite there come out large.
    """
    x, y, z = (np.asarray(v, dtype=np.float64) for v in np.broadcast_arrays(x, y, z))
    sides, load = patch.sides, patch.load
    if load == "y":
        return patch_fields(y, x, z, Patch(sides[::-1], "x"), shear=shear, nu=nu).exchanged()
    a, b = 0.5 * sides[0], 0.5 * sides[1]
    corner = Corner(x[..., None, None] + [[-a], [a]], y[..., None, None] + [-b, b], z[..., None, None])
    u = pressure_displacement(corner, shear, nu) if load == "z" else shear_displacement(corner, shear, nu)
    s = pressure_stress(corner, nu) if load == "z" else shear_stress(corner, nu)
    near = ElasticFields(u, s).map(lambda f: _corner_sum(f)[..., 0, 0])
    distant = np.sqrt(x**2 + y**2 + z**2) > _FAR * max(sides)
    if not distant.any():
        return near
    force = boussinesq if load == "z" else cerruti
    away = np.where(distant, x, _FAR * max(sides))  # the formulas of forces are singular at the patch
    spots = [(sx * _GAUSS * a, sy * _GAUSS * b) for sx in (-1.0, 1.0) for sy in (-1.0, 1.0)]
    far = [force(away - sx, y - sy, z, shear=shear, nu=nu) * (a * b) for sx, sy in spots]
    return near.combined(far[0] + far[1] + far[2] + far[3], lambda n, f: np.where(distant, f, n))


def stress_coefficients(grid: Grid, z: float, load: Load, nu: float) -> StressTensor:
    """Stress (Pa/Pa) at depth ``z`` (m) at pixel offsets (0…nx-1, 0…ny-1) from a pixel of ``grid``
    under unit traction.

    Relative error below 1e-12 up to 100 pixels away, 1e-9 up to 1000.
    """
    if load == "y":
        return stress_coefficients(grid.exchanged, z, "x", nu).map(np.transpose).exchanged()
    formula = pressure_stress if load == "z" else shear_stress
    blocks = [formula(corner, nu).map(_corner_sum) for corner in _corners(grid, z)]
    return StressTensor(*(np.concatenate(parts) for parts in zip(*(vars(b).values() for b in blocks), strict=True)))


def displacement_coefficients(grid: Grid, z: float, load: Load, shear: float, nu: float) -> Displacement:
    """Displacement (m/Pa), as ``stress_coefficients``."""
    if load == "y":
        return displacement_coefficients(grid.exchanged, z, "x", shear, nu).map(np.transpose).exchanged()
    formula = pressure_displacement if load == "z" else shear_displacement
    blocks = [formula(corner, shear, nu).map(_corner_sum) for corner in _corners(grid, z)]
    return Displacement(*(np.concatenate(parts) for parts in zip(*(vars(b).values() for b in blocks), strict=True)))


def _corners(grid: Grid, z: float) -> list[Corner]:
    """Corners of all pixels, seen from the loaded one, in blocks of rows."""
    (nx, ny), (dx, dy) = grid.shape, grid.spacing
    X = (np.arange(nx + 1) - 0.5)[:, None] * dx
    Y = (np.arange(ny + 1) - 0.5)[None, :] * dy
    rows = max(1, _CORNERS_AT_ONCE // (ny + 1))
    return [Corner(X[first : first + rows + 1], Y, z) for first in range(0, nx, rows)]


def _corner_sum(potential: RealArray) -> RealArray:
    """F(X₁, Y₁) - F(X₁, Y₂) - F(X₂, Y₁) + F(X₂, Y₂) over the last two axes."""
    return np.diff(np.diff(potential, axis=-2), axis=-1)
