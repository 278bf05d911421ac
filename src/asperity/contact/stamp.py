"""Prescribed displacement inverted to pressure: a frictionless stamp of given shape that touches
on given points only and everywhere there, by tension where it takes it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..core import require
from ..core.arrays import BoolArray, RealArray
from ..core.errors import ConvergenceError, InputError
from ..core.grid import Grid
from ..solids.compliance.halfspace import contact_compliance
from ..solids.elastic import Rigid
from ..solids.layers import Body
from ..surfaces.surface import Surface
from .boundary import Boundary, Periodic
from .operators import Operator, prepare_operator
from .solvers.on_set import Until, inverse_of_waves, solved_on

_MISFIT = 1e-9
"""Largest misfit of the shape over the largest displacement or height that is an answer; usual ends
are below 1e-12."""

_REDUCTION = 1e-8
_MOST_ROUNDS = 2000
_PASSES = 3
"""Reduction of the residual by one run of conjugate gradients, products of one at most, and runs,
each on the residual computed anew: rounding hides what one leaves."""


@dataclass(frozen=True, eq=False)
class StampField:
    """Pressure under a stamp.

    Attributes
    ----------
    grid
        Grid of the fields.
    contact
        (nx, ny), the points on which the stamp touches.
    pressure
        (nx, ny) in Pa, zero beside the stamp, negative where it pulls.
    displacement
        (nx, ny) in m, of the surfaces towards each other by the deformation, at all points.
    approach
        Displacement in m under the highest point of the stamp.
    misfit
        Largest distance in m of the surface from the stamp on its points.
    """

    grid: Grid
    contact: BoolArray
    pressure: RealArray
    displacement: RealArray
    approach: float
    misfit: float
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1985",)

    @property
    def mean_pressure(self) -> float:
        """Force over the area of the grid in Pa."""
        return float(self.pressure.mean())

    @property
    def force(self) -> float:
        """In N; on a free line that of its length dy."""
        return float(self.pressure.sum()) * self.grid.pixel_area

    @property
    def moments(self) -> tuple[float, float]:
        """∫p(x - x₀)dA and ∫p(y - y₀)dA in N m about the mean (x₀, y₀) of the points touched, that
        keep the stamp from tilting."""
        x, y = self.grid.coordinates()
        of = [np.broadcast_to(axis, self.pressure.shape) for axis in (x, y)]
        first, second = (float((self.pressure * (axis - axis[self.contact].mean())).sum()) for axis in of)
        return first * self.grid.pixel_area, second * self.grid.pixel_area

    @property
    def tension_share(self) -> float:
        """Share of the points touched that are under tension."""
        return float(np.mean(self.pressure[self.contact] < 0.0))

    @property
    def energy(self) -> float:
        """Elastic energy in J, less that of a uniform pressure on a periodic half-space."""
        return 0.5 * float((self.pressure * self.displacement).sum()) * self.grid.pixel_area


def stamp_contact(
    surface: Surface,
    body: Body,
    mean_pressure: float | None = None,
    *,
    approach: float | None = None,
    on: RealArray | BoolArray | None = None,
    counter_body: Body = Rigid(),
    boundary: Boundary = Periodic(),
) -> StampField:
    """Pressure under a frictionless stamp that touches on all its points, where pulling is allowed.

    On the points of contact the displacement is prescribed, u_z = h - max h + approach, and the
    pressure is zero elsewhere (mixed boundary problem, type II without friction): a linear system
    K p = u_z on these points, solved by conjugate gradients. The force may be prescribed in place
    of the approach, the system then holds but for a constant. The tilt is that of the heights.
    Where the pressure comes out negative the stamp would come off without adhesion; ``solve``
    finds that contact. A shear traction prescribed besides moves the surface up and down: subtract
    what it displaces from the heights.

    Parameters
    ----------
    surface
        Heights of the stamp in m; those where it does not touch are of no account.
    body, counter_body
        Elastic bodies; the second is rigid by default.
    mean_pressure
        Force over the area of the grid in Pa, of either sign or zero.
    approach
        Displacement in m under the highest point touched, of either sign, in place of
        ``mean_pressure``; from infinity on a free boundary, from the mean surface on a periodic
        half-space.
    on
        (nx, ny), True where the stamp touches; all points that are not missing by default.
    boundary
        ``Periodic()``, ``Free()`` or ``FreeLine()``.

    Raises
    ------
    InputError
        If not exactly one of mean pressure and approach is given, or one is not finite, the stamp
        touches nowhere or on a missing point, or on all points of a periodic half-space an
        approach is given, which any force would have.
    ConvergenceError
        If the shape is missed by more than 1e-9 of it; its ``result`` is the field so far.

    Examples
    --------
    A flat square of side 2a on a half-space is stiff by 2.30 E* a, on 32 points across by 1 % less,
    and its corners bear most:

    >>> import asperity as asp, numpy as np
    >>> on = np.zeros((48, 48), dtype=bool)
    >>> on[8:40, 8:40] = True
    >>> flat = asp.Surface(np.zeros((48, 48)), 1e-6, 1e-6)
    >>> body = asp.Elastic(91e9, 0.3)
    >>> found = asp.contact.stamp_contact(flat, body, approach=1e-9, on=on, boundary=asp.Free())
    >>> p, stiffness = found.pressure, found.force / 1e-9
    >>> f"{stiffness / (100e9 * 16e-6):.2f}", bool(p[8, 8] > p[24, 24])
    ('2.28', True)
    """
    require.instance(surface, Surface, "surface of a stamp")
    touched = _touched(surface, on)
    if (mean_pressure is None) == (approach is None):
        raise InputError(
            f"load of a stamp must be either a mean pressure or an approach, but is {mean_pressure!r} and {approach!r}."
        )
    operator = prepare_operator(contact_compliance(body, counter_body), surface.grid, boundary)
    heights = np.where(touched, np.asarray(surface.heights, dtype=float), 0.0)
    heights = np.where(touched, heights - heights[touched].max(), 0.0)
    p = np.zeros(surface.shape)
    if mean_pressure is not None:
        p[touched] = require.finite(mean_pressure, "mean pressure (Pa)") * p.size / np.count_nonzero(touched)
    elif touched.all() and operator.zero_mean_mode:
        raise InputError(
            "approach of a stamp must not be given where it touches all of a periodic half-space, but is "
            f"{approach!r}: any force has the same. Give a mean pressure."
        )
    else:
        heights[touched] += require.finite(approach or 0.0, "approach of a stamp (m)")
    return _solved(operator, heights, touched, p, balanced=mean_pressure is not None)


def _touched(surface: Surface, on: RealArray | BoolArray | None) -> BoolArray:
    """The points of contact, checked."""
    touched: BoolArray = ~surface.mask if on is None else require.field(on, "points touched", surface.shape) != 0.0
    missing = int(np.count_nonzero(touched & surface.mask))
    if missing:
        raise InputError(f"points touched must have heights, but {missing} are missing points of the surface.")
    if not touched.any():
        raise InputError("points touched must be one or more, but are none.")
    return touched


def _solved(operator: Operator, shape: RealArray, touched: BoolArray, p: RealArray, *, balanced: bool) -> StampField:
    """Field that gives the surface the ``shape`` (m), where ``balanced`` but for a constant, from
    the pressure ``p`` on."""
    inverse, until = inverse_of_waves(operator), Until(_REDUCTION, _MOST_ROUNDS)

    def misfit(u: RealArray) -> RealArray:
        gap: RealArray = np.where(touched, u - shape, 0.0)
        return np.where(touched, gap - gap[touched].mean(), 0.0) if balanced else gap

    u = operator.apply(p)
    for _ in range(_PASSES):
        change, _rounds = solved_on(operator, inverse, misfit(u), touched, balanced=balanced, until=until)
        p = p + change
        u = operator.apply(p)
    gap = misfit(u)
    left = float(np.abs(gap).max())
    highest = np.unravel_index(int(np.argmax(np.where(touched, shape, -np.inf))), shape.shape)
    approach = float(u[highest] - gap[highest])
    found = StampField(operator.grid, touched, p, u, approach, left)
    scale = max(float(np.abs(u).max()), float(np.ptp(shape[touched])))
    if not left <= _MISFIT * scale:
        raise ConvergenceError(f"The stamp misses its shape by {left:.1e} m, {left / scale:.1e} of it.", found)
    return found
