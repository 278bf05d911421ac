"""What a contact solver needs of the machine it runs on: convolutions and fused passes over arrays.

Arrays of an engine are opaque to the solver: NumPy arrays on the CPU, arrays of an array-API
library elsewhere. In all passes p is the pressure (Pa), u the deflection K p (m), h the heights
(m), r = u - h, and a negative p (a tensile point, see the solver) counts as 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol, runtime_checkable

from ..arrays import RealArray

NEAR_CAP = 1.0 - 1e-14
"""Share of its cap from which on a pressure that is rescaled counts as being at the cap: some 50
roundings of float64, fewer than the 1e-14 of the load to which the load is restored."""

SQUARE_SIDE = 16
"""Points along the side of the squares in which a survey sums up residuals; a multiple of 8."""


@dataclass(frozen=True)
class Totals:
    """Sums over one iterate: p; p·u; p·r; p and p·r strictly between the bounds; and bounds of the
    plane level.

    ``lowest`` is min r, ``highest_capped`` max r at the cap (or -inf), ``lowest_open`` min r at
    zero pressure (or inf); without a cap, where it matters only if nothing is loaded, min r.
    """

    pressure: float
    deflected: float
    work: float
    weight: float
    weighted: float
    lowest: float
    highest_capped: float
    lowest_open: float


@dataclass(frozen=True)
class Violation:
    """Sums of (r - level)+ p and (level - r)+ (cap - p), and the largest level - r below the
    cap."""

    above: float
    below: float
    deepest: float


@dataclass(frozen=True)
class Load:
    """Sums over a free set: p; p strictly below the cap; and the number of points below the cap."""

    pressure: float
    movable: float
    below: int


class Clipped(NamedTuple):
    """After a step clipped to the bounds: the ``load`` of the free set, and the ``number`` of
    points clipped."""

    load: Load
    number: int


class Unclipped(NamedTuple):
    """After a step that is not clipped: the number of ``tensile`` points of the free set, the sum
    of their ``tension`` -p, and that of the ``pressure`` of the others."""

    tensile: int
    tension: float
    pressure: float


class Products(NamedTuple):
    """Vector of a free set, its sum, and its products with two others."""

    vector: Any
    total: float
    first: float
    second: float


def cells_of(n: int, wraps: bool) -> int:
    """Number of cells that ``n`` cells in a row form in pairs: with one more at either end, where
    they do not wrap, since B-splines reach beyond the last pairs."""
    return (n + 1) // 2 if wraps else n // 2 + 2


MISSING = 0.609375, 0.234375, 0.140625
"""What the row sums of B-splines exceed their products by between the middles of four neighbouring
cells, per part there: at a cell itself, and less at those beside it and across. Along one axis the
products are 5/8 and 3/8, so that these are 1 - 25/64, 15/64 and 9/64."""


@dataclass(frozen=True)
class SplineModel:
    """A compliance of nested quadratic B-splines on the points of a grid, and coefficients of its
    inverse on a free set.

    The compliance is B = own + sum over levels of w P C P^T, P being the B-splines of the cells of
    a level at the points: a part takes three quarters of the deflection of the cell that it lies in
    and a quarter of that of the nearest other one, along each axis, from level to level. C averages
    the loads of a cell (half of its own) and those beside it (a quarter on either side, none beyond
    a rim). The inverse on a set is approximated, level by level, with diagonal matrices for the
    products of B-splines (see ``splines``) and a local stiffness.

    Parameters
    ----------
    wraps
        Whether the grid is periodic along x and y.
    merges
        Axes along which the cells of each level merge in pairs, until one cell is left.
    averages
        Axes along which C of each level averages.
    weights
        w of each level: deflection by a unit load on a cell and all those beside it.
    own
        Deflection of a point by its own unit load, by two of a half at the nearest points along x,
        two along y, and four of a quarter at the diagonal ones.
    inverse_weights
        w of each level for the inverse, over the deflection of a point under its own load.
    stiffness
        Load for a unit deflection of a single point, without the cells.
    fall, bend
        Share of it for the differences from the neighbours in the set, and for the curvature, along
        x and y.
    corrections
        Shares, level by level, in which the inverse makes up for what row sums of the products of
        B-splines exceed these by: zero up to some level, and where there are any points count by
        the row sums of the local stiffness. None for no level.
    """

    wraps: tuple[bool, bool]
    merges: tuple[tuple[bool, bool], ...]
    averages: tuple[tuple[bool, bool], ...]
    weights: tuple[float, ...]
    own: tuple[float, ...]
    inverse_weights: tuple[float, ...]
    stiffness: float
    fall: tuple[float, float]
    bend: tuple[float, float]
    corrections: tuple[float, ...] = ()


class Convolution(Protocol):
    """Prepared product with a real, even kernel in Fourier space; owns its buffers."""

    def apply(self, field: Any, out: Any) -> Any:
        """Convolve ``field`` into ``out`` and return it."""


class FreeSet(Protocol):
    """The points whose pressure may change in a step. Vectors over a free set are opaque to the
    solver, but they may be added and multiplied by a number.

    A *field* is an array over the whole grid that goes into or comes out of a convolution.
    """

    @property
    def size(self) -> int:
        """Number of points."""

    @property
    def entering(self) -> int:
        """Number of points that enter from a bound."""

    def residual(self, *, centred: bool) -> Any:
        """Vector (level - r) / scale, less its mean if ``centred``."""

    def zeros(self) -> Any:
        """Vector of zeros."""

    def empty(self) -> Any:
        """Vector of any values, to be written over."""

    def copy(self, vector: Any) -> Any:
        """Copy of ``vector`` that may be overwritten."""

    def shifted(self, vector: Any, by: float) -> Any:
        """``vector`` with a number added to each entry, a new one."""

    def square(self, vector: Any) -> float:
        """Sum of the squares of ``vector``; NaN beyond the range of its precision."""

    def largest(self, vector: Any) -> float:
        """Largest of zero and the entries of ``vector``."""

    def gather(self, values: Any) -> tuple[Any, float]:
        """Vector of the array ``values`` (pressure or deflection) in its precision, and its sum."""

    def gather_products(self, field: Any, a: Any, b: Any, out: Any) -> Products:
        """Vector of ``field``, in the memory of the vector ``out`` where that can be, and its
        products with a and b."""

    def products(self, vector: Any, a: Any, b: Any) -> Products:
        """``vector`` with its sum and its products with a and b."""

    def scatter(self, values: Any, field: Any) -> None:
        """Set ``field`` on the set to the vector ``values``."""

    def scatter_add(self, values: Any, factor: float, field: Any) -> None:
        """Add ``factor`` times the vector ``values`` to ``field``."""

    def scatter_change(self, old: Any, values: Any, r: Any, field: Any) -> tuple[Any, float]:
        """Vector ``values`` - ``old``, also set in the field, and its product with r.

        ``old`` is what ``gather`` gave of the array ``values`` before a change.
        """

    def update_direction(self, z: Any, mean: float, ratio: float, t: Any, r: Any, field: Any) -> tuple[Any, float]:
        """Vector (z - mean) + ratio t, also set in the field if there is one, and its product with
        r; ``t`` may be overwritten."""

    def update_solution(self, length: float, t: Any, kt: Any, mean: float, d: Any, r: Any) -> tuple[Any, Any, float]:
        """Vectors d + length t and r - length (kt - mean), and the square of the latter; ``d`` and
        ``r`` may be overwritten."""

    def add_unclipped(self, p: Any, d: Any, scale: float) -> Unclipped:
        """p + scale d on the set, in place."""

    def clear_tension(self, p: Any, factor: float, scale: float) -> Any:
        """Set p on the set to factor times its positive part; the change over ``scale`` as a
        vector.

        The residual vector may be overwritten.
        """

    def loaded(self, values: Any, total: float | None, vector: Any) -> tuple[FreeSet, Any, Any]:
        """The points of the set where ``values`` > 0, with a residual of zero, and on them the
        values, scaled to the sum ``total`` if one is given, and ``vector``."""

    def spread(self, left: FreeSet, values: Any) -> Any:
        """Vector of the set: ``values`` on the points ``left`` of it by ``loaded``, once or several
        times, zero on the others."""

    def change(self, values: Any, before: Any, scale: float) -> Any:
        """Vector (``values`` - ``before``) / scale in the precision of corrections."""

    def put(self, values: Any, p: Any) -> None:
        """Set p on the set to the vector ``values``."""

    def add_clipped(self, p: Any, d: Any, scale: float, cap: Any) -> Clipped:
        """p + scale d on the set, clipped to [0, cap], in place."""

    def rescale(self, p: Any, factor: float, shift: float, cap: Any) -> Load:
        """factor p + shift where p is below the cap, clipped to it, in place; the load
        afterwards."""

    def interpolate(self, old: Any, share: float, values: Any) -> None:
        """Set the array ``values`` on the set to old + share (values - old)."""


class Splines(Protocol):
    """A compliance of nested splines B and its approximate inverse, positive definite and but for
    corrections symmetric, on a free set."""

    def factorise(self, free: FreeSet) -> None:
        """Prepare the inverse for the points of ``free``."""

    def solve(self, free: FreeSet, r: Any, other: Any, out: Any) -> Products:
        """Vector z = inverse times r, z·r and z·other; in the memory of the vector ``out`` where
        that can be."""

    def deflection(self, free: FreeSet, t: Any, other: Any, out: Any) -> Products:
        """Vector B t on the set, and its products with t and ``other``; in ``out`` where that can
        be."""

    def predicted_residual(self, free: FreeSet, r: Any, loaded: FreeSet, change: Any) -> Any:
        """Vector r less the deflection of the points of ``free`` by ``change``, a vector of the set
        ``loaded``."""


@runtime_checkable
class UnevenSplines(Protocol):
    """Such splines whose points may yield unlike to their own load, by factors of ``conductance``
    (n,), positive or negative."""

    def factorise(self, free: FreeSet, conductance: Any | None = None) -> None:
        """Prepare the inverse for the points of ``free``."""

    def solve_with(self, free: FreeSet, r: Any, conductance: Any) -> Any:
        """Inverse times ``r`` after ``factorise`` with the same factors; not quite symmetric."""


class Survey(Protocol):
    """Sums over one iterate, and the free set chosen by them."""

    @property
    def totals(self) -> Totals:
        """Sums over all points."""

    @property
    def squares(self) -> RealArray:
        """(bands, squares, 3): number of points strictly between the bounds, their sum of r and of
        r², in each square.

        Squares have ``SQUARE_SIDE`` points a side, those at the last row and column fewer.
        """

    def free_set(self, levels: RealArray, level: float, scale: float, dtype: str) -> FreeSet:
        """Free set with the residual (level - r) / scale, its vectors of the precision ``dtype``.

        Its points are those strictly between the bounds, points at zero pressure with r below the
        first of the ``levels`` (bands, squares, 2) of their square, and points at the cap with r
        above the second. Tensile points are left out.
        """


class Engine(Protocol):
    """A machine: arrays, convolutions, passes. Results of equal calls do not depend on its number
    of threads."""

    @property
    def name(self) -> str:
        """Name for provenance."""

    def array(self, values: RealArray | float, dtype: str) -> Any:
        """``values`` as an array of this engine of type ``float64`` or ``float32`` (a copy where
        needed)."""

    def numpy(self, values: Any) -> RealArray:
        """``values`` as a NumPy array."""

    def zeros(self, shape: tuple[int, int], dtype: str) -> Any:
        """Array of zeros."""

    @property
    def separate_memory(self) -> bool:
        """Whether ``resident`` arrays lie in another memory than those of NumPy."""

    def resident(self, values: Any) -> Any:
        """``values`` where the engine computes, in double precision, if arrays there take the
        operations of NumPy; else as they are.

        Arrays that cannot be written to may be the same in repeated calls.
        """

    def total(self, values: Any) -> float:
        """Sum of the ``values``, an array of this engine."""

    def copy(self, values: Any) -> Any:
        """New array equal to ``values``."""

    def field(self, shape: tuple[int, int], dtype: str) -> Any:
        """Field of zeros for convolutions and free sets, in whatever memory layout suits the
        transforms."""

    def convolution(
        self, kernel: RealArray, shape: tuple[int, int], dtype: str, padded: tuple[int, int] | None = None
    ) -> Convolution:
        """Periodic convolution of fields of ``shape`` with the half-spectrum ``kernel``, or free:
        zero-padded to ``padded``, the grid of ``kernel``."""

    def splines(self, shape: tuple[int, int], model: SplineModel, dtype: str) -> Splines:
        """Nested splines on points of ``shape``, for vectors of the precision ``dtype``."""

    def prolonged(self, coarse: Any, coarse_heights: Any, heights: Any, stiffness: float) -> Any:
        """Pressure on the points of ``heights`` from the ``coarse`` one, an array of this engine,
        on half as many points per side.

        Heights and what is returned are as ``resident`` leaves them. Where the ``coarse`` pressure
        is not zero, ``stiffness`` times what the coarse heights do not show is added, down to zero.
        """

    def interpolated(self, coarse: Any, shape: tuple[int, int], wraps: tuple[bool, bool]) -> RealArray:
        """Linear interpolation of ``coarse`` values, an array of this engine, at the points of
        ``shape``, two for each along either axis; a NumPy array.

        Beyond the first and last point of an axis that does not wrap they are as there.
        """

    def survey(self, p: Any, u: Any, h: Any, cap: Any) -> Survey:
        """Survey of an iterate; ``cap`` is None for no cap."""

    def violation(self, p: Any, u: Any, h: Any, cap: Any, level: float) -> Violation:
        """How far an iterate is from the contact conditions at ``level``."""

    def add(self, field: Any, factor: float, values: Any) -> None:
        """Add ``factor`` times a field to the array ``values``."""

    def clear_field(self, free: FreeSet, field: Any) -> None:
        """Set ``field`` to zero on ``free`` again."""
