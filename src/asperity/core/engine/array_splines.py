"""Nested quadratic B-splines of the array-API engine: whole arrays per level; what they compute:
see ``splines``."""

from __future__ import annotations

from typing import Any, NamedTuple

from .array_library import Library
from .protocol import MISSING, Products, SplineModel, cells_of


class _Overlap(NamedTuple):
    """Of the cells of a level: the mean of what the four parts between the middles of each and the
    next ones pass up, and the share that is made up for over its row sum."""

    mean: Any
    per: Any


class ArraySplines:
    """Compliance of nested splines and its inverse on a free set."""

    def __init__(self, library: Library, model: SplineModel, dtype: str) -> None:
        self._library, self._model = library, model
        self._dtype = dtype
        self._factors: list[Any] = []
        self._overlaps: list[_Overlap | None] = []
        self._alone: Any = None
        self._together: Any = None

    def factorise(self, free: Any) -> None:
        """Local stiffness of every point of ``free`` beside its neighbours, and g of all cells."""
        model = self._model
        xp = self._library.xp
        unit = xp.astype(free.inside, getattr(xp, self._dtype))
        self._alone = 1.0 + 0.375 * sum(model.bend) + self._around(unit, tuple(0.25 * fall for fall in model.fall))
        self._together = self._alone + self._beside(unit) if model.corrections else xp.ones_like(unit)
        passed, self._factors, self._overlaps = unit, [], []
        corrections = model.corrections or (0.0,) * len(model.merges)
        for merge, weight, share in zip(model.merges, model.inverse_weights, corrections, strict=True):
            sums, overlap = self._summed(passed, merge), None
            self._factors.append(1.0 / (1.0 + weight * sums))
            if share and all(merge):
                between = passed
                for axis in (0, 1):
                    between = 0.5 * self._pairs_between(between, axis)
                overlap = _Overlap(between, share / (sums + 1e-30))
            self._overlaps.append(overlap)
            passed = self._factors[-1] * sums

    def solve(self, free: Any, r: Any, other: Any, out: Any) -> Products:
        """Inverse times ``r``, see ``protocol.Splines``."""
        model, loads = self._model, [r]
        for merge, g in zip(model.merges, self._factors, strict=True):
            loads.append(g * self._summed(loads[-1], merge))
        deflection = self._library.xp.zeros_like(loads[-1])
        for depth in reversed(range(len(model.merges))):
            overlap = self._overlaps[depth]
            deflection = model.inverse_weights[depth] * loads[depth + 1] + self._factors[depth] * deflection
            if overlap is not None:
                deflection = deflection + overlap.per * self._missing(overlap, deflection)
            deflection = self._spread(deflection, model.merges[depth], loads[depth].shape)
        z = self._alone * r + self._beside(r)
        z = z - self._together * deflection
        found: Products = free.products(self._library.select(free.inside, model.stiffness * z), r, other)
        return found

    def deflection(self, free: Any, t: Any, other: Any, out: Any) -> Products:
        """Deflection by ``t``, see ``protocol.Splines``."""
        found: Products = free.products(self._library.select(free.inside, self._deflected(t)), t, other)
        return found

    def predicted_residual(self, free: Any, r: Any, loaded: Any, change: Any) -> Any:
        """``r`` less the deflection of the points of ``free`` by ``change``."""
        return r - self._library.select(free.inside, self._deflected(change))

    def _deflected(self, load: Any) -> Any:
        """Deflection of all points under the ``load``, their own and that by the cells, averaged
        over neighbouring ones."""
        point, x, y, diagonal = self._model.own
        rows = self._moved(load, 0, 1) + self._moved(load, 0, -1)
        found = point * load + 0.5 * x * rows + 0.5 * y * (self._moved(load, 1, 1) + self._moved(load, 1, -1))
        found = found + 0.25 * diagonal * (self._moved(rows, 1, 1) + self._moved(rows, 1, -1))
        model, loads = self._model, [load]
        for merge in model.merges:
            loads.append(self._summed(loads[-1], merge))
        deflection = self._library.xp.zeros_like(loads[-1])
        for depth in reversed(range(len(model.merges))):
            total = loads[depth + 1]
            for axis in (axis for axis in (0, 1) if model.averages[depth][axis]):
                total = 0.5 * total + 0.25 * (self._moved(total, axis, 1) + self._moved(total, axis, -1))
            deflection = model.weights[depth] * total + deflection
            deflection = self._spread(deflection, model.merges[depth], loads[depth].shape)
        return found + deflection

    def _beside(self, values: Any) -> Any:
        """Local stiffness of all points for the ``values`` at those beside them."""
        fall, bend = self._model.fall, self._model.bend
        nearest = self._around(values, (-0.25 * (fall[0] + bend[0]), -0.25 * (fall[1] + bend[1])))
        return nearest + self._around(values, (0.0625 * bend[0], 0.0625 * bend[1]), distance=2)

    def _around(self, values: Any, factors: tuple[float, ...], distance: int = 1) -> Any:
        """Values at this distance along x and y, times the ``factors``."""
        x, y = (self._moved(values, axis, distance) + self._moved(values, axis, -distance) for axis in (0, 1))
        return factors[0] * x + factors[1] * y

    def _moved(self, values: Any, axis: int, places: int) -> Any:
        """``values`` moved along the axis; zero comes from beyond the rim where it does not
        wrap."""
        xp, n = self._library.xp, values.shape[axis]
        if self._model.wraps[axis]:
            return xp.roll(values, places, axis=axis)
        kept, none = max(n - abs(places), 0), self._zeros(values, axis, min(abs(places), n))
        if places > 0:
            return xp.concat([none, part_of(values, axis, 0, kept)], axis=axis)
        return xp.concat([part_of(values, axis, n - kept, n), none], axis=axis)

    def _pairs_between(self, values: Any, axis: int) -> Any:
        """Sum of the two parts between the middles of every cell and the next along the axis."""
        xp, n = self._library.xp, values.shape[axis]
        first, odd = _halves(xp.concat([values, self._zeros(values, axis, n % 2)], axis=axis), axis)
        if self._model.wraps[axis]:
            return odd + xp.roll(first, -1, axis=axis)
        rim, cells = self._zeros(values, axis, 1), cells_of(n, wraps=False)
        second, last = (xp.concat(part, axis=axis) for part in ([first, rim, rim], [rim, odd, rim]))
        return part_of(second, axis, 0, cells) + part_of(last, axis, 0, cells)

    def _missing(self, overlap: _Overlap, values: Any) -> Any:
        """What the products of B-splines of a level times the ``values`` are less than the row sums
        times them."""

        def beyond(fields: Any, places: int, axes: tuple[int, ...]) -> Any:
            for axis in axes:
                fields = self._moved(fields, axis, places)
            return fields

        middle, side, across = MISSING
        corners: tuple[tuple[int, ...], ...] = ((), (0,), (1,), (0, 1))
        at = [beyond(values, -1, corner) for corner in corners]
        found = self._library.xp.zeros_like(values)
        for k, corner in enumerate(corners):
            share = middle * at[k] - side * (at[k ^ 1] + at[k ^ 2]) - across * at[k ^ 3]
            found = found + beyond(overlap.mean * share, 1, corner)
        return found

    def _summed(self, values: Any, merge: tuple[bool, bool]) -> Any:
        """Sums over the parts of every cell."""
        xp = self._library.xp
        for axis in (axis for axis in (0, 1) if merge[axis]):
            n = values.shape[axis]
            values = xp.concat([values, self._zeros(values, axis, n % 2)], axis=axis)
            even, odd = _halves(values, axis)
            if self._model.wraps[axis]:
                next_, before = xp.roll(even, -1, axis=axis), xp.roll(odd, 1, axis=axis)
            else:  # one more cell at either end, of which an odd number of parts does not reach the last
                rim, cells = self._zeros(values, axis, 1), cells_of(n, wraps=False)
                shifted = ([rim, even, rim], [rim, odd, rim], [even, rim, rim], [rim, rim, odd])
                even, odd, next_, before = (part_of(xp.concat(part, axis=axis), axis, 0, cells) for part in shifted)
            values = 0.75 * (even + odd) + 0.25 * (next_ + before)
        return values

    def _spread(self, values: Any, merge: tuple[bool, bool], shape: tuple[int, int]) -> Any:
        """Values of the cells at their parts, which are of ``shape``."""
        xp = self._library.xp
        for axis in (axis for axis in (0, 1) if merge[axis]):
            n = (shape[axis] + 1) // 2
            if self._model.wraps[axis]:
                own, before, next_ = values, xp.roll(values, 1, axis=axis), xp.roll(values, -1, axis=axis)
            else:
                values = xp.concat([values, self._zeros(values, axis, 1)], axis=axis)
                own, before, next_ = (part_of(values, axis, k, k + n) for k in (1, 0, 2))
            values = spread_over(xp, axis, own, before, next_, shape[axis])
        return values

    def _zeros(self, values: Any, axis: int, width: int) -> Any:
        shape = (width, values.shape[1]) if axis == 0 else (values.shape[0], width)
        return self._library.zeros(shape, self._dtype)


def part_of(values: Any, axis: int, first: int, end: int) -> Any:
    """Part of ``values`` along the axis."""
    return values[first:end, :] if axis == 0 else values[:, first:end]


def spread_over(xp: Any, axis: int, own: Any, before: Any, after: Any, length: int) -> Any:
    """Values at the two parts of every cell along the axis, up to this ``length``: three quarters
    of the cell's and a quarter of those of the nearer neighbour."""
    pairs = xp.stack([0.75 * own + 0.25 * before, 0.75 * own + 0.25 * after], axis=axis + 1)
    wide = [*own.shape]
    wide[axis] *= 2
    return part_of(xp.reshape(pairs, tuple(wide)), axis, 0, length)


def _halves(values: Any, axis: int) -> tuple[Any, Any]:
    """Every other one of ``values`` along the axis, and the others."""
    return (values[::2, :], values[1::2, :]) if axis == 0 else (values[:, ::2], values[:, 1::2])
