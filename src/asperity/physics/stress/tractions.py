"""What loads a body: pressure and shear traction on its surface, and what lies outside the grid."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, NamedTuple, Self, TypeAlias

import numpy as np

from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...solids.elastic import Rigid
from .loads import PrescribedLoad


@dataclass(frozen=True)
class Sliding:
    """Shear traction of a sliding contact: friction ``coefficient`` times pressure, along
    ``direction``.

    InputError if the coefficient is negative or a value is not finite.

    Parameters
    ----------
    coefficient
        μ >= 0.
    direction
        Angle in rad from +x towards +y of the traction on the body, which is that in which the
        other body moves.
    """

    coefficient: float
    direction: float = 0.0

    def __post_init__(self) -> None:
        require.not_negative(self.coefficient, "friction coefficient", "Turn the direction by pi instead.")
        require.finite(self.direction, "direction of sliding (rad)")

    @property
    def ratios(self) -> tuple[float, float]:
        """Shear traction along x and along y over the pressure; exact for multiples of a right
        angle."""
        c, s = math.cos(self.direction), math.sin(self.direction)
        c, s = (0.0 if abs(v) < 1e-15 else v for v in (c, s))
        return self.coefficient * c, self.coefficient * s


@dataclass(frozen=True, eq=False)
class ShearTraction:
    """Shear traction on the body given as fields (nx, ny) in Pa along +x and along +y.

    InputError if a field is no two-dimensional array of numbers, or the two differ in shape.
    """

    x: RealArray
    y: RealArray

    def __post_init__(self) -> None:
        x = require.field(self.x, "shear traction along x (Pa)")
        object.__setattr__(self, "x", x)
        object.__setattr__(self, "y", require.field(self.y, "shear traction along y (Pa)", x.shape))


Shear: TypeAlias = Sliding | ShearTraction
"""Shear traction on the body."""


Boundary: TypeAlias = Literal["periodic", "free", "free line"]
"""What lies outside the grid."""

BOUNDARIES = ("periodic", "free", "free line")
"""Names of the boundaries."""


@dataclass(frozen=True, eq=False)
class Tractions:
    """Tractions on the surface of one body.

    InputError if a field has another shape than the grid or the boundary another name.

    Parameters
    ----------
    grid
        Grid of the tractions.
    pressure
        (nx, ny) in Pa, positive in compression; of either sign.
    shear
        ``Sliding(...)`` or ``ShearTraction(...)``; none by default.
    boundary
        ``"periodic"``: the load repeats, and is the trigonometric interpolation of its values.
        ``"free"``: nothing loads the surface outside the grid, and each pixel carries a constant
        traction. ``"free line"``: the same along x, and along y, where the grid has one point,
        everything goes on unchanged (plane strain).
    datum
        Only for a free line: distance in m from a line load at which the displacement of the
        surface is called zero; None takes the length of the grid.
    """

    grid: Grid
    pressure: RealArray
    shear: Shear = Sliding(0.0)
    boundary: Boundary = "periodic"
    datum: float | None = None

    def __post_init__(self) -> None:
        require.one_of(self.boundary, BOUNDARIES, "boundary of tractions")
        if self.boundary == "free line" and self.grid.shape[1] != 1:
            raise InputError(f"grid of a free line must have one point along y, but has {self.grid.shape[1]}.")
        pressure = require.field(self.pressure, "pressure of tractions (Pa)", self.grid.shape)
        object.__setattr__(self, "pressure", pressure)
        if not isinstance(self.shear, Sliding | ShearTraction):
            raise InputError(f"shear traction must be Sliding(...) or ShearTraction(qx, qy), but is {self.shear!r}.")
        if isinstance(self.shear, ShearTraction):
            require.field(self.shear.x, "shear traction along x (Pa)", self.grid.shape)

    @classmethod
    def of(
        cls, grid: Grid, *loads: PrescribedLoad, boundary: Boundary = "periodic", datum: float | None = None
    ) -> Self:
        """Sum of ``loads``, each a ``PointLoad``, ``LineLoad`` or ``PatchLoad``, on the pixels of
        ``grid``.

        InputError if a load is of another type, or reaches beyond the grid of a boundary that does
        not repeat.
        """
        total = np.zeros((3, *grid.shape))
        for load in loads:
            if not hasattr(load, "on"):
                raise InputError(f"load on a grid must be PointLoad, LineLoad or PatchLoad, but is {load!r}.")
            total += load.on(grid, wraps=boundary == "periodic")
        return cls(grid, total[2], ShearTraction(total[0], total[1]), boundary, datum)

    @property
    def sheared(self) -> bool:
        """Whether there is any shear traction."""
        if isinstance(self.shear, Sliding):
            return self.shear.coefficient != 0.0
        return bool(np.any(self.shear.x) or np.any(self.shear.y))

    @property
    def shear_x(self) -> RealArray:
        """Shear traction along x in Pa, (nx, ny)."""
        return self.shear.x if isinstance(self.shear, ShearTraction) else self.shear.ratios[0] * self.pressure

    @property
    def shear_y(self) -> RealArray:
        """Shear traction along y in Pa, (nx, ny)."""
        return self.shear.y if isinstance(self.shear, ShearTraction) else self.shear.ratios[1] * self.pressure

    @property
    def means(self) -> tuple[float, float, float]:
        """Means of the shear along x, along y and of the pressure, in Pa."""
        pressure = float(self.pressure.mean(dtype=np.float64))
        if isinstance(self.shear, Sliding):
            x, y = self.shear.ratios
            return x * pressure, y * pressure, pressure
        return float(self.shear.x.mean(dtype=np.float64)), float(self.shear.y.mean(dtype=np.float64)), pressure


class Edges(NamedTuple):
    """What lies outside the grid of a loaded body: its name, and along which axes (x, y) the load
    repeats."""

    name: Boundary
    wraps: tuple[bool, bool]


class Loading(NamedTuple):
    """What stresses need to know of a loaded body beside its pressure: the same as of a contact
    problem."""

    grid: Grid
    body: object
    counter_body: object
    boundary: Edges


@dataclass(frozen=True, eq=False)
class LoadedBody:
    """A body whose surface carries prescribed tractions, without any contact: what ``stress`` takes
    in place of a result.

    Parameters
    ----------
    body
        ``Elastic`` or ``Layered``.
    tractions
        ``Tractions(grid, pressure, shear, boundary)`` of arrays, or
        ``Tractions.of(grid, PointLoad(...), ...)``.

    Examples
    --------
    The largest von Mises stress below a square under 1 MPa:

    >>> import asperity as asp
    >>> grid = asp.Grid((32, 32), (1e-6, 1e-6))
    >>> patch = asp.stresses.PatchLoad(x=(11.5e-6, 19.5e-6), y=(11.5e-6, 19.5e-6), pressure=1e6)
    >>> tractions = asp.stresses.Tractions.of(grid, patch, boundary="free")
    >>> loaded = asp.stresses.LoadedBody(asp.Elastic(200e9, 0.3), tractions)
    >>> field = asp.stress(loaded, depths=[1e-6, 2e-6, 4e-6])
    >>> print(f"{field.von_mises.max():.3g}")
    6.45e+05
    """

    body: object
    tractions: Tractions

    def __post_init__(self) -> None:
        require.instance(self.tractions, Tractions, "tractions of a loaded body", "Write Tractions(...).")

    @property
    def pressure(self) -> RealArray:
        """(nx, ny) in Pa."""
        return self.tractions.pressure

    @property
    def problem(self) -> Loading:
        """Grid, body and boundary, with a rigid body that carries the opposite tractions."""
        own = self.tractions
        wraps = {"periodic": (True, True), "free": (False, False), "free line": (False, True)}[own.boundary]
        return Loading(own.grid, self.body, Rigid(), Edges(own.boundary, wraps))

    @property
    def spot_areas(self) -> RealArray:
        """Areas in m² of the connected loaded pixels, those with a thousandth of the largest
        traction or more."""
        from scipy.ndimage import label

        size = np.sqrt(self.pressure**2 + self.tractions.shear_x**2 + self.tractions.shear_y**2)
        labels, count = label(size > 1e-3 * size.max())
        areas: RealArray = np.bincount(labels.ravel(), minlength=count + 1)[1:] * self.tractions.grid.pixel_area
        return areas

    @property
    def plastic(self) -> BoolArray:
        """(nx, ny), False: no hardness limits what is prescribed."""
        return np.zeros(self.tractions.grid.shape, dtype=bool)
