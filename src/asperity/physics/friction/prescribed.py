"""Prescribed shear traction beside an unknown pressure (type III), and prescribed displacement of
a bonded contact (type II)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...contact.boundary import Boundary, Periodic
from ...contact.operators import prepare_operator
from ...contact.solvers.on_set import inverse_by
from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.errors import ConvergenceError, InputError
from ...core.grid import Grid
from ...core.spectral import thread_count
from ...solids.compliance.halfspace import contact_compliance
from ...solids.compliance.tensor import BodiesSurface
from ...solids.elastic import Rigid
from ...solids.layers import Body
from ...surfaces.surface import Surface
from .operator import CouplingKernel, TangentialOperator


def shear_displacement(
    grid: Grid,
    traction: ArrayLike,
    body: Body,
    *,
    counter_body: Body = Rigid(),
    boundary: Boundary = Periodic(),
) -> RealArray:
    """Normal displacement u_z (nx, ny) in m by a shear traction alone, into the body.

    Of a half-space of shear modulus G in Fourier space, with the wavevector q (Johnson 1985, ch.
    2 and 3),

        u_z = -i (1 - 2ν)/(2G) q·τ/q²,

    so that a push towards +x presses the surface in ahead of it. Incompressible bodies against
    rigid ones and equal bodies have none; a uniform traction of a periodic cell neither.

    Parameters
    ----------
    grid
        Grid of the fields.
    traction
        (2, nx, ny) in Pa, on ``body`` along +x and along +y.
    body, counter_body
        Elastic bodies, the second under the opposite traction and rigid by default.
    boundary
        ``Periodic()``, ``Free()`` or ``FreeLine()``.

    Raises
    ------
    InputError
        If the traction is no such field or not finite, or both bodies are rigid.

    Examples
    --------
    Far ahead of a force Q the displacement is (1 - 2ν) Q/(4π G r):

    >>> import asperity as asp, numpy as np
    >>> body, grid = asp.Elastic(200e9, 0.3), asp.Grid((41, 5), (1e-7, 1e-7))
    >>> traction = np.zeros((2, 41, 5))
    >>> traction[0, 0, 2] = 1e9
    >>> u = asp.friction.shear_displacement(grid, traction, body, boundary=asp.Free())
    >>> expected = 0.4 * 1e9 * 1e-14 / (4 * np.pi * body.shear_modulus * 40e-7)
    >>> f"{u[40, 2] / expected:.4f}"
    '1.0000'
    """
    fields = _vectors(traction, 2, grid, "shear traction (Pa)")
    compliance = BodiesSurface(body, counter_body)
    return CouplingKernel.of(grid, compliance, boundary, thread_count()).lift(fields)


def sheared(
    surface: Surface,
    traction: ArrayLike,
    body: Body,
    *,
    counter_body: Body = Rigid(),
    boundary: Boundary = Periodic(),
) -> Surface:
    """Surface whose normal contact is that of ``surface`` under a prescribed shear traction (mixed
    boundary problem, type III).

    The traction displaces by a known u_z, which opens or closes the gap: the heights less u_z make
    the same problem without shear. Exact where the traction is prescribed on fixed points, with
    adhesion and hardness as well. Take it to ``solve`` or ``stamp_contact``: gaps and pressures
    are those of the sheared contact, the displacement is that by the pressure alone, and the
    approach counts from the highest point of the displaced heights.

    Parameters and errors are those of ``shear_displacement``, with ``surface`` for the grid.

    Examples
    --------
    >>> import asperity as asp, numpy as np
    >>> flat, body = asp.Surface(np.zeros((64, 1)), 1e-6, 1.0), asp.Elastic(200e9, 0.3)
    >>> traction = np.zeros((2, 64, 1))
    >>> traction[0] = 10e6
    >>> turned = asp.friction.sheared(flat, traction, body, boundary=asp.FreeLine())
    >>> press = {"boundary": asp.FreeLine(), "mean_pressure": 50e6}
    >>> p = asp.contact.stamp_contact(turned, body, **press).pressure[:, 0]
    >>> bool(p[0] > p[-1])
    True
    """
    require.instance(surface, Surface, "surface under shear")
    moved = shear_displacement(surface.grid, traction, body, counter_body=counter_body, boundary=boundary)
    return surface.with_heights(np.asarray(surface.heights, dtype=float) - moved, "displaced by a shear traction")


_MISFIT = 1e-9
"""Largest misfit over the largest displacement that is an answer; usual ends are below 1e-11."""

_REDUCTION = 1e-12
_MOST_ROUNDS = 2000
"""Reduction of the residual by conjugate gradients, and products at most."""


@dataclass(frozen=True, eq=False)
class BondedField:
    """Tractions of a bonded contact; components are along x, along y and normal.

    Attributes
    ----------
    grid
        Grid of the fields.
    contact
        (nx, ny), the bonded points.
    traction
        (3, nx, ny) in Pa on the body, the third the pressure, negative where it pulls.
    displacement
        (3, nx, ny) in m of the body relative to the counter body, at all points.
    misfit
        Largest distance in m from the displacement prescribed.
    """

    grid: Grid
    contact: BoolArray
    traction: RealArray
    displacement: RealArray
    misfit: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985", "Kalker1990")

    @property
    def force(self) -> tuple[float, float, float]:
        """On the body along x, along y and into it, in N."""
        x, y, z = (float(total) * self.grid.pixel_area for total in self.traction.sum(axis=(1, 2)))
        return x, y, z

    @property
    def twist(self) -> float:
        """Moment about the normal through the middle of the bonded points, from x towards y, in
        N m."""
        x, y = (np.broadcast_to(axis, self.contact.shape) for axis in self.grid.coordinates())
        arm_x, arm_y = x - x[self.contact].mean(), y - y[self.contact].mean()
        return float((arm_x * self.traction[1] - arm_y * self.traction[0]).sum()) * self.grid.pixel_area


def bonded_contact(
    grid: Grid,
    displacement: ArrayLike,
    body: Body,
    *,
    on: ArrayLike,
    counter_body: Body = Rigid(),
    boundary: Boundary = Periodic(),
) -> BondedField:
    """Tractions that give the points ``on`` a prescribed displacement in all three directions, with
    none elsewhere (mixed boundary problem, type II).

    A linear system with the symmetric, positive tensor of compliances on these points, solved by
    conjugate gradients.

    Parameters
    ----------
    grid
        Grid of the fields.
    displacement
        (3, nx, ny) in m, along x, along y and into the body, of ``body`` relative to
        ``counter_body``; only its values on the bonded points count. From infinity on a free
        boundary, from the mean surface on a periodic half-space.
    body, counter_body
        Elastic bodies; the second is rigid by default.
    on
        (nx, ny), True where the bodies are bonded.
    boundary
        ``Periodic()``, ``Free()`` or ``FreeLine()``.

    Raises
    ------
    InputError
        If a field has another shape or is not finite, no point is bonded, all points of a periodic
        half-space are, or a layer may slip on a free boundary.
    ConvergenceError
        If the displacement is missed by more than 1e-9 of it; its ``result`` is the field so far.

    Examples
    --------
    A square stud is twisted by 0.01:

    >>> import asperity as asp, numpy as np
    >>> grid = asp.Grid((32, 32), (1e-6, 1e-6))
    >>> x, y = grid.centred_coordinates()
    >>> on = (abs(x) < 8e-6) & (abs(y) < 8e-6)
    >>> u = np.stack(np.broadcast_arrays(-0.01 * y, 0.01 * x, 0.0 * x))
    >>> rubber = asp.Elastic(3e6, 0.5)
    >>> stud = asp.friction.bonded_contact(grid, u, rubber, on=on, boundary=asp.Free())
    >>> f"{stud.twist:.2e} N m"
    '3.46e-11 N m'
    """
    wanted = _vectors(displacement, 3, grid, "displacement (m)")
    bonded: BoolArray = require.field(on, "bonded points", grid.shape) != 0.0
    if not bonded.any():
        raise InputError("bonded points must be one or more, but are none.")
    normal = prepare_operator(contact_compliance(body, counter_body), grid, boundary)
    tangential = TangentialOperator(grid, (body, counter_body), boundary)
    if bonded.all() and (normal.zero_mean_mode or (isinstance(boundary, Periodic) and tangential.mean == 0.0)):
        raise InputError(
            "bonded points must leave out some of a periodic half-space, whose uniform tractions displace nothing, "
            f"but are all {bonded.size}."
        )
    product = tangential.coupled_convolution("float64", normal)

    def moved(traction: RealArray) -> RealArray:
        out = np.empty_like(traction)
        product.apply((traction[0], traction[1], traction[2]), (out[0], out[1], out[2]))
        return out

    traction = np.zeros_like(wanted)
    tensor = tangential.compliance.tensor(grid)
    inverses = [inverse_by(waves, normal) for waves in (tensor.xx, tensor.yy, tensor.zz)]  # each for itself
    for _ in range(2):  # the second on the residual computed anew
        residual = np.where(bonded, wanted - moved(traction), 0.0)
        direction, norm, start = np.zeros_like(residual), 0.0, 0.0
        for count in range(_MOST_ROUNDS):
            z = np.where(bonded, [inverse.apply(part) for inverse, part in zip(inverses, residual, strict=True)], 0.0)
            before, norm = norm, float((residual * z).sum())
            start = start or norm
            if not norm > _REDUCTION**2 * start:
                break
            direction = z + (norm / before) * direction if count else z
            response = np.where(bonded, moved(direction), 0.0)
            length = norm / float((direction * response).sum())
            traction = traction + length * direction
            residual = residual - length * response
    found = moved(traction)
    left = float(np.abs(np.where(bonded, found - wanted, 0.0)).max())
    field = BondedField(grid, bonded, traction, found, left)
    size = float(np.abs(np.where(bonded, wanted, 0.0)).max())
    if not left <= _MISFIT * size:
        raise ConvergenceError(f"The bonded points miss their displacement by {left:.1e} m, of {size:.1e} m.", field)
    return field


def _vectors(values: ArrayLike, components: int, grid: Grid, what: str) -> RealArray:
    """``values`` (components, nx, ny) as floating-point numbers, finite."""
    array = np.asarray(values, dtype=np.float64)
    shape = (components, *grid.shape)
    if array.shape != shape:
        raise InputError(f"{what} must be an array of shape {shape}, but is an array of shape {array.shape}.")
    if not np.isfinite(array).all():
        raise InputError(f"{what} must be finite, but is not at {np.count_nonzero(~np.isfinite(array))} places.")
    return array
