"""Preconditioned conjugate gradients on the free set, and the arrays of a problem that they correct.

The linear system of a step is K d = r on the free set; at prescribed load it holds up to a constant (the multiplier of the
load), with d summing to zero.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any, NamedTuple, Protocol

import numpy as np

from ....core.arrays import RealArray
from ....core.engine import Cells, CoarseCompliance, Convolution, Engine, FreeSet, Hierarchy, Merge, Products, Survey
from ....core.grid import Grid
from ...operators import Operator, prepare_operator
from ..protocol import ContactQP, FixedMean, FixedOffset, heights_near_contact

# Compliance of nested cells: a model of the half-space whose exact inverse on any set of points costs no transform.
#
# The wavelengths of a surface are sorted into octaves: differences between the parts of a cell of side H deflect by the
# compliance at q = pi / H (the mean over the Haar functions of the cell, to one percent, for 1/q), so
#
#     B = sum over levels l of c(pi / H_l) (P_l - P_l+1),     P_l: means over the cells of level l,
#
# which is a sum of constants over nested cells. Two hierarchies, shifted against each other by a third of a cell at every
# level, hide the borders between cells. On a periodic grid the second is rolled round it as a whole, so that its cells reach
# over the borders of the grid: at 512² this takes the reduction of the residual per step from 0.37 to 0.28 (0.44 to 0.29 at
# four times the load).

_SQUARE = 1.5
"""Ratio of sides up to which cells merge along both axes; beyond, only along the shorter side, so that ratios stay below 2.
It does not matter for square pixels."""

PIXEL_SHARE = 0.6
"""Share of c(pi / a) that a pixel of side a is given of its own in the model.

Points on both sides of a border between cells are coupled less in the model than in truth, so that it deflects too much by what differs between them; a
smaller compliance of each point of its own compensates. At 512² the residual falls by 0.20 instead of 0.28 a step, on films of E 10, h 4 and 20 pixels by 0.39
and 0.34 instead of 0.43 and 0.40. Pairs (cases: see ``solver``) for 0.4, 0.5, 0.7, 0.8, 1: elastic 15.1, 14.7, 14.9, 14.7, 16.7; free 44.5, 44.5, 43.8, 46.4,
44.2; cap 17.9, 16.5, 16.1, 15.7, 15.9; tight 25.2, 23.4, 25.2, 24.7, 25.7.
"""

PIXEL_SHARE_COARSE = 0.8
"""The same with the coarse correction, which leaves fewer borders. Pairs on films for 0.6, 0.7, 1: 22.2, 22.5, 23.0."""


_LEAST_MEAN = 0.1
"""Share of the compliance of half the grid that a uniform load is given at least: with none the model has no inverse in full contact."""


class Spectral(Protocol):
    """Compliance, or what is known of it."""

    def spectral(self, wavenumber: RealArray) -> RealArray:
        """Displacement per pressure c(q) in m/Pa at each ``wavenumber`` q > 0 (rad/m)."""


def hierarchies(
    compliance: Spectral, grid: Grid, *, periodic: bool, share: float, mean: float | None = None
) -> tuple[Hierarchy, Hierarchy]:
    """Nested cells on ``grid`` that follow the normal ``compliance``, as square as its pixels allow.

    Single points are given this ``share`` of their compliance. ``mean`` is the displacement in m/Pa by a uniform load, where it is not that of the
    longest wave.
    """
    merges, sides, points = octaves(grid)
    detail = np.asarray(compliance.spectral(np.pi / sides), dtype=float)
    if mean is not None:
        detail[-1] = max(mean, _LEAST_MEAN * detail[-2])
    weights = np.diff(detail) / points[1:] / (share * detail[0])
    if periodic:
        cells = tuple(Merge(x, y, 0, 0, float(weight)) for (x, y), weight in zip(merges, weights, strict=True))
        return Hierarchy(cells), Hierarchy(cells, (_third(grid.shape[0]), _third(grid.shape[1])))
    first, second = (
        tuple(
            Merge(x, y, int(x and (level + start) % 2 == 0), int(y and (level + start) % 2 == 1), float(weight))
            for level, ((x, y), weight) in enumerate(zip(merges, weights, strict=True))
        )
        for start in (0, 1)
    )
    return Hierarchy(first), Hierarchy(second)


def _third(n: int) -> int:
    """Number of the binary digits ...10101 below ``n``: a third of a cell, or two, of any 2^k points."""
    third = 0
    while 4 * third + 1 < n:
        third = 4 * third + 1
    return third


def pixel_compliance(compliance: Spectral, grid: Grid) -> float:
    """Deflection (m/Pa) of a point of ``grid`` under its own pressure, in the model of nested cells."""
    return float(np.asarray(compliance.spectral(np.pi / octaves(grid).sides[:1]))[0])


def merges_of(grid: Grid) -> list[tuple[bool, bool]]:
    """Axes along which the cells of each level merge in pairs, until one cell is left."""
    counts, sides = list(grid.shape), list(grid.spacing)
    merges: list[tuple[bool, bool]] = []
    while max(counts) > 1 or not merges:
        x = counts[0] > 1 and (counts[1] == 1 or sides[0] <= _SQUARE * sides[1])
        y = counts[1] > 1 and (counts[0] == 1 or sides[1] <= _SQUARE * sides[0])
        merges.append((x, y))
        for axis, pairs in enumerate((x, y)):
            if pairs:
                counts[axis], sides[axis] = -(-counts[axis] // 2), 2.0 * sides[axis]
    return merges


class OctavesOfCells(NamedTuple):
    """Of every level of nested cells, from single points up: the axes along which they merge, their ``sides`` (m), and number of ``points``."""

    merges: tuple[tuple[bool, bool], ...]
    sides: RealArray
    points: RealArray


@lru_cache(maxsize=64)
def octaves(grid: Grid) -> OctavesOfCells:
    """Levels of nested cells on ``grid``; the side of a cell is that along the axes in which it merges."""
    merges = merges_of(grid)
    cell, points, sides, numbers = list(grid.spacing), 1.0, [], []
    for x, y in (*merges, merges[-1]):
        merged = [side for side, pairs in zip(cell, (x, y), strict=True) if pairs] or cell
        sides.append(math.prod(merged) ** (1.0 / len(merged)))
        numbers.append(points)
        for axis, pairs in enumerate((x, y)):
            if pairs:
                cell[axis], points = 2.0 * cell[axis], 2.0 * points
    return OctavesOfCells(tuple(merges), np.array(sides), np.array(numbers))


# Coarse correction: the true compliance of the larger cells, where constants over nested cells are too crude.
#
# Where the compliance falls much more steeply than 1/q, as that of a bending film does (up to q^-4), the smooth deflection
# under a smooth load is poorly represented by constants over cells. A convolution on a coarse grid has it cheaply:
#
# B = sum over levels l < n of c(pi / H_l) (P_l - P_l+1) + K_n,
#
# with K_n the compliance itself for pressures constant on the cells of level n, of 8 x 8 points. Reduction of the residual per step at 512², self-affine
# surface, a tenth in contact, without and with: films of E 10, h 4 and 20 pixels 0.39 and 0.36, 0.34 and 0.27; E 2, h 4 pixels 0.25 and 0.27; half-space
# 0.20 and 0.23. Pairs of a whole solve at 1024², a sixth and a tenth in contact: the first film 36 and 33, the second 22 and 18; none are saved where a
# fortieth is. A step costs 6 % more.


_DEPTH = 3
"""Level of the corrected cells, of 8 x 8 points: a product on their grid costs 1/64 of an FFT pair. Pairs on films for 2, 4: 25.6, 22.2 (3: 22.8)."""

_STEEP = 3.0
"""Factor by which the compliance must fall over an octave for the correction to pay (1/q: 2). On a half-space it costs
pairs: with the threshold below 2 the means at 512² are 15.9 for 13.9, free at 256² 49.8 for 43.8."""

_FEWEST = 4
"""Corrected cells along a side at least: smaller grids cost little either way."""

_PRODUCTS = 4
"""Products with the coarse compliance per use: two for each hierarchy."""


class CoarseCorrection(NamedTuple):
    """True compliance of large cells in the ``form`` an engine takes, and the FFT ``pairs`` of the fine grid for one use."""

    form: CoarseCompliance
    pairs: float


def coarse_correction(operator: Operator) -> CoarseCorrection | None:
    """True compliance of ``operator`` on cells of 8 x 8 points.

    None where it does not fall to a third over any octave beyond them, where pixels are too oblong, and where the grid is
    too small, a line, or periodic with sides that are no multiples of such cells.
    """
    grid, periodic, side = operator.grid, all(operator.boundary.wraps), 1 << _DEPTH
    if min(grid.shape) < _FEWEST * side or (periodic and any(n % side for n in grid.shape)):
        return None
    merges, sides, points = octaves(grid)
    detail = operator.octaves.spectral(np.pi / sides)
    if not all(x and y for x, y in merges[:_DEPTH]) or np.max(detail[_DEPTH:] / detail[_DEPTH - 1 : -1]) < _STEEP:
        return None
    # on a free grid the first cell may begin up to side - 1 points outside
    nx, ny = (n // side if periodic else -(-(n + side - 1) // side) for n in grid.shape)
    coarse = Grid((nx, ny), (side * grid.spacing[0], side * grid.spacing[1]))
    of_cells = prepare_operator(operator.compliance, coarse, operator.boundary, engine=operator.engine)
    # over c(pi / a) of a whole pixel; over PIXEL_SHARE_COARSE of it, as the weights are, films take 22.2 pairs for 22.8
    kernel = np.maximum(of_cells.kernel - detail[_DEPTH - 1], 0.0) / (detail[0] * points[_DEPTH])
    pairs = _PRODUCTS * of_cells.pairs_per_application * coarse.n_points / grid.n_points
    return CoarseCorrection(CoarseCompliance(_DEPTH, kernel, coarse.shape, of_cells.padded), pairs)


@dataclass(frozen=True, eq=False)
class ScaledOperator:
    """The compliance over ``scale`` (m/Pa) in the precision ``dtype``, with its preconditioners and two work arrays.

    ``product`` is the product with it, from ``field`` to ``response``. Nothing in the work arrays outlasts a step but zeros
    in ``field``.
    """

    operator: Operator
    dtype: str
    scale: float
    product: Convolution
    field: Any
    response: Any

    @classmethod
    def of(cls, operator: Operator, dtype: str, scale: float) -> ScaledOperator:
        """Scaled ``operator`` with work arrays of its own."""
        engine, shape = operator.engine, operator.grid.shape
        fields = engine.field(shape, dtype), engine.field(shape, dtype)
        return cls(operator, dtype, scale, operator.convolution(dtype, scale), *fields)

    @property
    def engine(self) -> Engine:
        """Machine that computes it."""
        return self.operator.engine

    @cached_property
    def coarse(self) -> CoarseCorrection | None:
        """Coarse correction of the nested cells, where it pays."""
        return coarse_correction(self.operator)

    @property
    def _share(self) -> float:
        return PIXEL_SHARE if self.coarse is None else PIXEL_SHARE_COARSE

    @cached_property
    def cells(self) -> Cells:
        """Nested cells that model it."""
        operator = self.operator
        periodic = all(operator.boundary.wraps)
        nested = hierarchies(operator.octaves, operator.grid, periodic=periodic, share=self._share)
        coarse = None if self.coarse is None else self.coarse.form
        return self.engine.cells(operator.grid.shape, nested, coarse, self.dtype)

    @cached_property
    def pixel_compliance(self) -> float:
        """Deflection of a point under its own load in the model of nested cells, over ``scale``."""
        return self._share * pixel_compliance(self.operator.octaves, self.operator.grid) / self.scale

    @cached_property
    def inverse(self) -> Convolution:
        """Convolution whose ``solve`` divides by it: exact on a periodic grid, nearly so on a free one."""
        return self.operator.preconditioner(self.product, self.dtype, self.scale)


@dataclass(frozen=True, eq=False)
class Workspace:
    """Arrays of one problem and the scaled operator for its corrections.

    ``pressure`` and ``deflection`` (Pa, m; in the precision ``dtype``) are the iterate, changed in place; ``exact`` is
    the convolution that makes the one from the other. A deflection over ``scaled.scale`` is a pressure in units of ``unit``.
    """

    qp: ContactQP
    scaled: ScaledOperator
    dtype: str
    heights: Any
    cap: Any
    exact: Convolution
    pressure: Any
    deflection: Any

    @classmethod
    def of(cls, qp: ContactQP, precision: str, start: RealArray, deflection: RealArray | None = None) -> Workspace:
        """Workspace of ``qp`` with the pressure ``start`` (Pa) and its ``deflection`` (m), if it is known, both of which it may take over.

        ``precision`` is ``"double"``, ``"single"``, or ``"mixed"`` for corrections in single and the rest in double.
        """
        operator, engine, shape = qp.operator, qp.operator.engine, qp.operator.grid.shape
        dtype = "float32" if precision == "single" else "float64"
        pressure, exact = engine.array(start, dtype), operator.convolution(dtype)
        if deflection is None:
            begun = engine.zeros(shape, dtype)
            exact.apply(pressure, begun)
        else:
            begun = engine.array(deflection, dtype)
        scale = float(operator.kernel.max()) or 1.0
        return cls(
            qp=qp,
            scaled=ScaledOperator.of(operator, "float64" if precision == "double" else "float32", scale),
            dtype=dtype,
            heights=engine.array(_heights(qp, centred=precision == "single"), dtype),
            cap=None if qp.elastic else engine.array(np.asarray(qp.cap, dtype=float).reshape(-1), dtype),
            exact=exact,
            pressure=pressure,
            deflection=begun,
        )

    @property
    def unit(self) -> float:
        """Pressure (Pa) of one in a correction."""
        return self.qp.height_scale / self.scaled.scale

    @property
    def engine(self) -> Engine:
        """Machine it is on."""
        return self.scaled.engine

    @property
    def load_prescribed(self) -> bool:
        """Whether corrections must sum to zero."""
        return isinstance(self.qp.constraint, FixedMean)

    def survey(self) -> Survey:
        """Sums over the iterate."""
        return self.engine.survey(self.pressure, self.deflection, self.heights, self.cap)

    def copy(self) -> Workspace:
        """Workspace with arrays of its own for the iterate; the work arrays of corrections are shared."""
        pressure, deflection = self.engine.copy(self.pressure), self.engine.copy(self.deflection)
        return replace(self, pressure=pressure, deflection=deflection)


def _heights(qp: ContactQP, *, centred: bool) -> RealArray:
    """Heights from a level near the contact; ``centred`` in any case if the load is prescribed."""
    if isinstance(qp.constraint, FixedOffset):
        return qp.profile - qp.constraint.offset if qp.constraint.offset else qp.profile
    heights = heights_near_contact(qp)
    return heights - float(heights.mean()) if centred and heights is qp.profile else heights


# Preconditioners: approximate inverses of the compliance on a free set.


_NEARLY_FULL = 0.998
"""Share of the points of a periodic grid from which on the inverse in Fourier space serves. FFT pairs for a reduction of the
residual to 1e-6 on self-affine surfaces: nested cells 10 at any area (film of E 10, h 4 pixels: 20); the restricted inverse
25 (53) at 90 % of the area, 19 (37) at 99 %, 15 (21) at 99.8 %, 11 (17) at 99.95 %. With a free boundary it is nowhere
exact, and takes more than twice those of nested cells."""

_STEP_LENGTH = 0.7
"""Length, times the inverse of the pixel's compliance, of a step along the preconditioned residual where none can be measured. Measured lengths scatter about
it. Mean pairs at 512² for 0.4, 0.55, 0.7, 0.85, 1: 15.2, 14.7, 13.9, 15.6, 16.3; free at 256² 46, 44.5, 43.8, 47.5, 49.8; films 21.4, 22.9, 22.8, 23, 23."""


class Preconditioner(Protocol):
    """Approximate inverse, symmetric and positive definite, on one free set."""

    @property
    def pairs(self) -> float:
        """FFT pairs of the grid that one use costs."""

    @property
    def step_length(self) -> float:
        """Length of a step along inverse times residual that is about right where none can be measured."""

    def solve(self, r: Any, other: Any, out: Any) -> Products:
        """Vector z = inverse times r, its sum, z·r and z·other; in the memory of ``out`` where that can be."""

    def predicted_residual(self, r: Any, loaded: FreeSet, change: Any) -> Any:
        """Vector r less about the deflection by ``change`` on the set ``loaded``; None where that takes transforms."""


class NestedCells:
    """Inverse of the compliance of nested cells, and of the coarse correction of the larger of them (see ``cells``)."""

    def __init__(self, scaled: ScaledOperator, free: FreeSet) -> None:
        self.pairs = 0.0 if scaled.coarse is None else scaled.coarse.pairs
        self.step_length = _STEP_LENGTH / scaled.pixel_compliance
        self._cells = scaled.cells
        self._unit = scaled.pixel_compliance
        self._free = free
        self._factorised = False

    def solve(self, r: Any, other: Any, out: Any) -> Products:
        """Inverse times ``r``."""
        if not self._factorised:
            self._cells.factorise(self._free)
            self._factorised = True
        return self._cells.solve(self._free, r, other, out)

    def predicted_residual(self, r: Any, loaded: FreeSet, change: Any) -> Any:
        """``r`` less the deflection of the cells."""
        self._factorised = False
        return self._cells.predicted_residual(self._free, r, loaded, change, self._unit)


class RestrictedInverse:
    """Inverse of the compliance of the whole grid in Fourier space, restricted to the set: exact in full contact."""

    pairs = 1.0
    step_length = 1.0

    def __init__(self, scaled: ScaledOperator, free: FreeSet) -> None:
        self._scaled = scaled
        self._free = free

    def solve(self, r: Any, other: Any, out: Any) -> Products:
        """Inverse times ``r``."""
        scaled = self._scaled
        self._free.scatter(r, scaled.field)
        scaled.inverse.solve(scaled.field, scaled.response)
        return self._free.gather_products(scaled.response, r, other, out)

    def predicted_residual(self, r: Any, loaded: FreeSet, change: Any) -> Any:
        """None: any deflection takes a transform."""
        return None


def preconditioner(scaled: ScaledOperator, free: FreeSet) -> Preconditioner:
    """The inverse in Fourier space on nearly full periodic contact, else nested cells."""
    return RestrictedInverse(scaled, free) if nearly_full(scaled, free) else NestedCells(scaled, free)


def nearly_full(scaled: ScaledOperator, free: FreeSet) -> bool:
    """Whether ``free`` holds so many points of a periodic grid that its preconditioner takes a product."""
    operator = scaled.operator
    return all(operator.boundary.wraps) and free.size > _NEARLY_FULL * operator.grid.n_points


# Conjugate gradients.


@dataclass(frozen=True, eq=False)
class LinearSystem:
    """Equations K d = r on the set ``free``; if ``zero_sum`` up to a constant, d summing to zero."""

    scaled: ScaledOperator
    free: FreeSet
    zero_sum: bool

    def mean(self, total: float) -> float:
        """Mean of a vector that sums to ``total``, where it is to be taken out."""
        return total / self.free.size if self.zero_sum else 0.0


class Stopping(NamedTuple):
    """When to stop: at this ``reduction`` of the residual, or after ``max_steps``.

    It counts in the norm of the preconditioner, or in the plain one if that is the first to be reduced: it is known before
    the next use of the preconditioner, a quarter of which are not needed then. FFT pairs with and without, cases much as in
    ``solver``: elastic 14.1 both, films 21.6 and 22.8, cap 15.9 and 16.0, free 44.1 and 43.3.

    ``ending``, if given: conjugate gradients stop at this reduction of the largest residual instead, and a last step follows whose length
    is not measured and whose deflection is not computed, but estimated (see ``Correction.open``).
    """

    reduction: float
    max_steps: int
    ending: float | None = None


class PressureChange(NamedTuple):
    """``values`` by which the pressure on the set ``free`` has changed, in the units of a correction."""

    free: FreeSet
    values: Any


class Correction(NamedTuple):
    """Vector ``d``, None where no step was possible; FFT ``pairs`` it took; whether the reduction was ``reached``.

    ``open``: d holds a last step that ``on_step`` was not told of.
    """

    d: Any
    pairs: float
    reached: bool
    open: bool = False


class _Direction(NamedTuple):
    """Search direction ``t``, K t, their product and the sum of K t."""

    t: Any
    kt: Any
    curvature: float
    total: float


def conjugate_gradients(
    system: LinearSystem,
    r: Any,
    stopping: Stopping,
    *,
    pending: PressureChange | None = None,
    on_step: Callable[[float], None] | None = None,
    further: float = 0.0,
) -> Correction:
    """Solve the ``system`` for the residual ``r``, which may be overwritten.

    ``pending`` is a change whose deflection is not in the residual yet: the first product with the compliance includes it.
    ``on_step`` receives the length of every step while its product with the compliance is in ``response``.
    ``further``: length of one more step without a product, over that before; for changes whose deflection is computed anyway. None if zero.
    """
    scaled, free = system.scaled, system.free
    inverse = preconditioner(scaled, free)
    last: _Direction | None = None
    ending = None if stopping.ending is None or inverse.pairs >= 1.0 else stopping.ending * free.largest(r)
    (d, r, first, square, left), pairs, taken = _first_step(system, inverse, r, pending, on_step)
    z, length, reached = free.empty(), inverse.step_length, False
    while taken < stopping.max_steps:
        if taken > 0 and ending is not None and free.largest(r) <= ending:
            return _unmeasured(system, inverse, r, last, length, Correction(d, pairs, True, open=True))
        if reached := taken > 0 and left < stopping.reduction**2 * square:
            break
        preconditioned = inverse.solve(r, r if last is None else last.kt, z)
        z, product = preconditioned.vector, preconditioned.first
        pairs += inverse.pairs
        if reached := product <= 0.0 or (taken > 0 and product < stopping.reduction**2 * first):
            break
        first = first or product
        t, slope = _next_direction(system, r, preconditioned, last)
        scaled.product.apply(scaled.field, scaled.response)
        pairs += scaled.operator.pairs_per_application
        kt, total, curvature, _ = free.gather_products(scaled.response, t, t, free.empty() if last is None else last.kt)
        if curvature <= 0.0:
            break
        last = _Direction(t, kt, curvature, total)
        taken, length = taken + 1, slope / curvature
        if on_step is not None:
            on_step(length)
        d, r, left = free.update_solution(length, t, kt, system.mean(total), d, r)
    found = Correction(d if taken else None, pairs, reached)
    return _unmeasured(system, inverse, r, last, further * length, found) if further and taken else found


def _unmeasured(
    system: LinearSystem, inverse: Preconditioner, r: Any, last: _Direction | None, length: float, found: Correction
) -> Correction:
    """``found`` and one more step of this ``length``, without a product, where the preconditioner takes none either."""
    if inverse.pairs >= 1.0:
        return found
    t, _ = _next_direction(system, r, inverse.solve(r, r if last is None else last.kt, system.free.empty()), last)
    d = system.free.update_solution(length, t, t, 0.0, found.d, r)[0]
    return found._replace(d=d, pairs=found.pairs + inverse.pairs)


def _next_direction(system: LinearSystem, r: Any, z: Products, last: _Direction | None) -> tuple[Any, float]:
    """Search direction, set in the field, and its product with ``r``.

    ``z`` is the preconditioned residual; its second product is that with K ``last``, to which the direction is conjugate.
    """
    mean, ratio = system.mean(z.total), 0.0
    if last is not None:
        ratio = -(z.second - mean * last.total) / last.curvature
    t = system.free.zeros() if last is None else last.t
    return system.free.update_direction(z.vector, mean, ratio, t, r, system.scaled.field)


class _FirstStep(NamedTuple):
    """Vector ``d``, the residual ``r`` after it, of the square ``left``; of the predicted residual the ``product`` with its preconditioned self and the ``square``."""

    d: Any
    r: Any
    product: float
    square: float
    left: float


def _first_step(
    system: LinearSystem,
    inverse: Preconditioner,
    r: Any,
    pending: PressureChange | None,
    on_step: Callable[[float], None] | None,
) -> tuple[_FirstStep, float, int]:
    """Combined step for a pending change, none without; the FFT pairs and the number of products of it."""
    if pending is None:
        square = system.free.square(r)
        return _FirstStep(system.free.zeros(), r, 0.0, square, square), 0.0, 0
    begun = _combined_step(system, inverse, r, pending, on_step)
    return begun, system.scaled.operator.pairs_per_application + (inverse.pairs if begun.product else 0.0), 1


def _combined_step(
    system: LinearSystem,
    inverse: Preconditioner,
    r: Any,
    pending: PressureChange,
    on_step: Callable[[float], None] | None,
) -> _FirstStep:
    """Step of fixed length by one product with the compliance, which gives the deflection by the pending change as well.

    Its direction t is the preconditioned residual that the change will leave, as predicted by the preconditioner; the field
    holds t + change / length. Where no prediction is possible without transforms, t is zero.
    """
    scaled, free = system.scaled, system.free
    length, product, square = inverse.step_length, 0.0, 0.0
    predicted = inverse.predicted_residual(r, pending.free, pending.values)
    if predicted is None:
        t = free.zeros()
    else:
        z = inverse.solve(predicted, predicted, free.empty())
        t, _ = _next_direction(system, r, z, None)
        product, square = z.first, free.square(predicted)
    pending.free.scatter_add(pending.values, 1.0 / length, scaled.field)
    scaled.product.apply(scaled.field, scaled.response)
    scaled.engine.clear_field(pending.free, scaled.field)
    response = free.gather_products(scaled.response, t, t, free.empty())
    if on_step is not None:
        on_step(length)
    d, r, left = free.update_solution(length, t, response.vector, system.mean(response.total), free.zeros(), r)
    return _FirstStep(d, r, product, square, left)
