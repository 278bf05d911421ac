"""Full surface compliance, tractions (q_x, q_y, p) to displacements (u_x, u_y, u_z), of a periodic
cell."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ..elastic import Elastic, Rigid
from ..layers import Body, Layered, deformable
from .influence import (
    COS_1,
    COS_2,
    ISOTROPIC,
    SIN_1,
    SIN_2,
    line_integral,
    line_kernel,
    patch_coefficients,
    strip_coefficients,
    wavenumber_grid,
    wavenumbers,
)
from .layered import LayerStack, PlaneCompliance, Samples, half_space, samples


@dataclass(frozen=True, eq=False)
class SurfaceTensor:
    """Hermitian tensor on the half spectrum (nx, ny // 2 + 1) of a grid, in m/Pa.

    ``xx``, ``yy``, ``zz`` and ``xy`` are real; ``xz`` and ``yz`` are the imaginary parts: C_xz = i
    xz, C_zx = -i xz.
    """

    xx: RealArray
    yy: RealArray
    zz: RealArray
    xy: RealArray
    xz: RealArray
    yz: RealArray


def plane_compliance(body: Elastic | Layered, wavenumber: RealArray) -> PlaneCompliance:
    """Compliances along, across and normal to the wavevector at each ``wavenumber`` > 0 (rad/m)."""
    if isinstance(body, Elastic):
        return half_space(wavenumbers(wavenumber), shear_modulus=body.shear_modulus, nu=body.poisson_ratio)
    reduced = body.reduced
    if not reduced.layers and isinstance(reduced.base, Elastic):
        return plane_compliance(reduced.base, wavenumber)
    return LayerStack(body).plane(wavenumber)


def surface_tensor(grid: Grid, body: Body, counter_body: Body = Rigid()) -> SurfaceTensor:
    """Displacement of ``body`` relative to ``counter_body`` per traction on ``body``, in Fourier
    space.

    Compliances of both bodies add up, but their coupling between normal and tangential directions
    subtracts, for the two carry opposite tractions in a common frame. Odd entries are zero on the
    Nyquist lines, where their sign is undefined, so that real tractions give real displacements.
    The mean mode is zero, its displacement being the datum, but for the compression and shear of
    layers on a rigid base.

    ``grid``: periodic cell; ``body``, ``counter_body``: bodies below and above; one of them may be
    rigid.

    InputError if both bodies are rigid.
    """
    q = grid.wavenumber()
    q[0, 0] = 1.0  # any value: the mean mode is replaced
    plane = summed_planes([(plane_compliance(solid, q), sign) for solid, sign in deformable(body, counter_body)])
    stacks = [solid.reduced if isinstance(solid, Layered) else None for solid, _ in deformable(body, counter_body)]
    shear = normal = 0.0
    on_rigid_bases = [stack for stack in stacks if stack is not None and not isinstance(stack.base, Elastic)]
    if len(on_rigid_bases) == len(stacks):
        normal = sum(LayerStack(stack).mean_mode() for stack in on_rigid_bases)
        if not any(
            stack.slips for stack in on_rigid_bases
        ):  # else the mean displacement along the surface is the datum
            shear = sum(
                sum(layer.thickness / layer.material.shear_modulus for layer in stack.layers)
                for stack in on_rigid_bases
            )
    return tensor_of(grid, plane, shear, normal)


def tensor_of(grid: Grid, plane: PlaneCompliance, shear: float, normal: float) -> SurfaceTensor:
    """Tensor of the components ``plane`` at the wavenumbers of ``grid``, and of the mean modes for
    ``shear`` and ``normal`` traction (m/Pa)."""
    qx, qy = grid.wavevector()
    q = grid.wavenumber()
    q[0, 0] = 1.0
    c, s = qx / q, qy / q
    odd_x, odd_y = (component / q for component in grid.wavevector(odd=True))
    difference = plane.LL - plane.T
    tensor = SurfaceTensor(
        xx=c * c * difference + plane.T,
        yy=s * s * difference + plane.T,
        zz=plane.zz,
        xy=odd_x * odd_y * difference,
        xz=odd_x * plane.Lz,
        yz=odd_y * plane.Lz,
    )
    for entry, value in ((tensor.xx, shear), (tensor.yy, shear), (tensor.zz, normal)):
        entry[0, 0] = value
    for entry in (tensor.xy, tensor.xz, tensor.yz):
        entry[0, 0] = 0.0
    return tensor


def summed_planes(parts: Sequence[tuple[PlaneCompliance, float]]) -> PlaneCompliance:
    """Sum of the compliances of bodies with the signs of the tractions that they carry: their
    couplings subtract."""
    return PlaneCompliance(
        LL=np.add.reduce([part.LL for part, _ in parts]),
        zz=np.add.reduce([part.zz for part, _ in parts]),
        Lz=np.add.reduce([sign * part.Lz for part, sign in parts]),
        T=np.add.reduce([part.T for part, _ in parts]),
    )


# Full surface compliance of pixels under uniform traction, without periodicity.


@dataclass(frozen=True, eq=False)
class InfluenceTensor:
    """Displacement (m/Pa) at pixel offsets (0…nx-1, 0…ny-1) from a pixel under unit traction,
    arrays (nx, ny).

    ``xx``, ``yy`` and ``zz`` are even in both offsets, ``xy`` is odd in both; ``xz``, u_x under
    unit pressure, is odd in x and even in y, ``yz`` even in x and odd in y. Reciprocity gives the
    rest: yx = xy, zx = -xz, zy = -yz.
    """

    xx: RealArray
    yy: RealArray
    zz: RealArray
    xy: RealArray
    xz: RealArray
    yz: RealArray


def influence_tensor(grid: Grid, body: Body, counter_body: Body = Rigid()) -> InfluenceTensor:
    """Displacement of ``body`` relative to ``counter_body`` at every offset on ``grid`` from a
    loaded pixel.

    Tractions act on ``body``. Compliances of the two add up; their coupling between normal and
    tangential directions subtracts. The relative error is below 1e-8, as for
    ``patch_coefficients``.

    InputError if both bodies are rigid, or a layer may slip: its displacement under a tangential
    force has no limit.
    """
    surface = BodiesSurface(body, counter_body)
    xx, yy, xy = surface.shear_pixels(grid)
    zz = np.zeros(grid.shape)
    for solid, _ in deformable(body, counter_body):
        zz += patch_coefficients(_samples(grid, solid).kernel(lambda c: c.zz), grid, ISOTROPIC)
    xz, yz = surface.coupling_pixels(grid)
    return InfluenceTensor(xx=xx, yy=yy, zz=zz, xy=xy, xz=xz, yz=yz)


def _samples(grid: Grid, body: Elastic | Layered) -> Samples:
    depth = body.reduced.thickness if isinstance(body, Layered) else 0.0
    return samples(body, depth or max(grid.spacing))


def _require_bonded(body: Elastic | Layered) -> None:
    if isinstance(body, Layered) and body.reduced.slips:
        raise InputError(
            "layers under a tangential traction must be bonded on the free boundary, but one is Frictionless(): "
            "it would slip without end. Use Bonded() or the periodic boundary."
        )


def shear_pixels_of(grid: Grid, known: Samples) -> tuple[RealArray, RealArray, RealArray]:
    """``xx``, ``yy`` and ``xy`` of pixels from the samples ``known``.

    From the spectrum: C_xx = (LL + T)/2 + cos 2phi (LL - T)/2, C_xy = sin 2phi (LL - T)/2; C_xz = i
    cos phi Lz elsewhere. A factor cos(m phi) or sin(m phi) becomes i^m cos(m theta) or i^m sin(m
    theta) and J_m.
    """
    mean = patch_coefficients(known.kernel(lambda c: 0.5 * (c.LL + c.T)), grid)
    bending = known.kernel(lambda c: 0.5 * (c.LL - c.T), order=2)
    along_x = patch_coefficients(bending, grid, COS_2)
    return mean - along_x, mean + along_x, -patch_coefficients(bending, grid, SIN_2)


def coupling_pixels_of(grid: Grid, known: Samples) -> tuple[RealArray, RealArray]:
    """``xz`` and ``yz`` of pixels from the samples ``known``."""
    kernel = known.kernel(lambda c: c.Lz, order=1)
    return -patch_coefficients(kernel, grid, COS_1), -patch_coefficients(kernel, grid, SIN_1)


# Plane strain: strips under shear along x and along y, and the normal displacement by the former,
# which couples friction to pressure.


def shear_strips_of(grid: Grid, known: Samples, datum: float) -> tuple[RealArray, RealArray]:
    """Displacement (m/Pa) along x under unit shear along x, and along y under shear along y, arrays
    (nx, 1), from the samples ``known``.

    At offsets (0…nx-1) dx from a strip of width dx. A half-space gives them relative to the
    distance ``datum`` (m) from a line load, as ``line_influence`` of the normal compliance, and the
    first is then the same as the normal displacement (Johnson 1985, eq. 2.24).
    """
    along = strip_coefficients(line_kernel(known.values.LL, known.limits(lambda c: c.LL)), grid, datum)
    return along, strip_coefficients(line_kernel(known.values.T, known.limits(lambda c: c.T)), grid, datum)


def coupling_strips_of(grid: Grid, known: Samples) -> RealArray:
    """Normal displacement (m/Pa), shape (nx, 1), at offsets (0…nx-1) dx from a strip of width dx
    under unit shear along +x.

    It is odd in the offset. A line force Q lifts a half-space behind it and lowers it ahead by the
    same amount at every distance, (1-2ν)/4G times Q (Johnson 1985, eq. 2.24); with layers the step
    changes from that of the top layer to that of the base. No datum is needed.
    """
    edges, alpha = (np.arange(grid.shape[0]) + 0.5) * grid.spacing[0], wavenumber_grid(known.depth)
    near = float(known.high.Lz)
    rest = line_integral(alpha, (known.values.Lz - near) / alpha, known.depth, cosine=False)
    integral = 0.5 * near * edges + rest(edges)  # of the response from zero, even: the first strip cancels
    return np.diff(integral, prepend=integral[0])[:, None]


# The same of whatever has a compliance: of bodies, and of what is retarded in them.


class SurfaceCompliance(Protocol):
    """Response of a surface to tractions of all three directions."""

    def spectral(self, wavenumber: RealArray) -> RealArray:
        """(C_LL + C_T)/2 in m/Pa at each ``wavenumber`` > 0 (rad/m), the mean over both directions
        along the surface."""

    def tensor(self, grid: Grid) -> SurfaceTensor:
        """That of a periodic cell."""

    def shear_pixels(self, grid: Grid) -> tuple[RealArray, RealArray, RealArray]:
        """``xx``, ``yy`` and ``xy`` of an ``InfluenceTensor``."""

    def coupling_pixels(self, grid: Grid) -> tuple[RealArray, RealArray]:
        """``xz`` and ``yz`` of an ``InfluenceTensor``."""

    def shear_strips(self, grid: Grid, datum: float) -> tuple[RealArray, RealArray]:
        """Along x under shear along x and along y under shear along y, (nx, 1), see
        ``shear_strips_of``."""

    def coupling_strips(self, grid: Grid) -> RealArray:
        """Normal displacement by shear along x, (nx, 1), see ``coupling_strips_of``."""


@dataclass(frozen=True)
class BodiesSurface:
    """Compliance of ``body``, which carries the traction, relative to ``counter_body``."""

    body: Body
    counter_body: Body

    def spectral(self, wavenumber: RealArray) -> RealArray:
        """(C_LL + C_T)/2 in m/Pa at each ``wavenumber`` > 0 (rad/m)."""
        q = np.asarray(wavenumber, dtype=float)
        total = np.zeros(q.shape)
        for solid, _ in deformable(self.body, self.counter_body):
            found = plane_compliance(solid, q)
            total += 0.5 * (found.LL + found.T)
        return total

    def tensor(self, grid: Grid) -> SurfaceTensor:
        """That of a periodic cell."""
        return surface_tensor(grid, self.body, self.counter_body)

    def shear_pixels(self, grid: Grid) -> tuple[RealArray, RealArray, RealArray]:
        """``xx``, ``yy`` and ``xy`` of pixels. InputError if a layer may slip."""
        total = np.zeros((3, *grid.shape))
        for solid, _ in deformable(self.body, self.counter_body):
            _require_bonded(solid)
            total += shear_pixels_of(grid, _samples(grid, solid))
        return total[0], total[1], total[2]

    def coupling_pixels(self, grid: Grid) -> tuple[RealArray, RealArray]:
        """``xz`` and ``yz`` of ``influence_tensor`` alone, which layers that may slip have, too."""
        xz, yz = np.zeros(grid.shape), np.zeros(grid.shape)
        for solid, sign in deformable(self.body, self.counter_body):
            along_x, along_y = coupling_pixels_of(grid, _samples(grid, solid))
            xz += sign * along_x
            yz += sign * along_y
        return xz, yz

    def shear_strips(self, grid: Grid, datum: float) -> tuple[RealArray, RealArray]:
        """Along and across, (nx, 1). InputError if a layer may slip."""
        along, across = np.zeros((grid.shape[0], 1)), np.zeros((grid.shape[0], 1))
        for solid, _ in deformable(self.body, self.counter_body):
            _require_bonded(solid)
            of_solid = shear_strips_of(grid, _samples(grid, solid), datum)
            along += of_solid[0]
            across += of_solid[1]
        return along, across

    def coupling_strips(self, grid: Grid) -> RealArray:
        """Normal displacement by shear along x, (nx, 1), of ``body`` relative to
        ``counter_body``."""
        total = np.zeros((grid.shape[0], 1))
        for solid, sign in deformable(self.body, self.counter_body):
            depth = (solid.reduced.thickness if isinstance(solid, Layered) else 0.0) or grid.spacing[0]
            total += sign * coupling_strips_of(grid, samples(solid, depth))
        return total
