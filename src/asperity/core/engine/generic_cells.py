"""Nested cells of the array-API engine: whole arrays per level (see ``cell_kernels`` for the algorithm)."""

from __future__ import annotations

from typing import Any

from .generic_face import ArrayFace
from .library import Library
from .protocol import CellWaves, Convolution, Face, Hierarchy, Merge, Products


class ArrayCells:
    """Inverse of nested cells on a working set, exact without ``waves`` (see ``wave_kernels`` for the step with them)."""

    def __init__(
        self,
        library: Library,
        hierarchies: tuple[Hierarchy, Hierarchy],
        waves: CellWaves | None,
        product: Convolution | None,
        dtype: str,
    ) -> None:
        self._library = library
        self._hierarchies = hierarchies
        self._waves = waves
        self._product = product
        self._dtype = dtype
        self._stiff: tuple[tuple[list[Any], list[Any]], ...] = ()

    def restrict(self, face: Face) -> None:
        """Prepare for the points of ``face``."""
        assert isinstance(face, ArrayFace)
        xp = self._library.xp
        unit = xp.astype(face.inside, getattr(xp, self._dtype))
        self._stiff = tuple(
            self._stiffened(hierarchy.merges, xp.roll(unit, hierarchy.roll, axis=(0, 1)))
            for hierarchy in self._hierarchies
        )

    def solve(self, face: Face, r: Any, other: Any, out: Any) -> Products:
        """Inverse times ``r``."""
        assert isinstance(face, ArrayFace)
        z = r - self._library.select(face.inside, self._mean_deflection(self._stiff, r))
        return face.products(z, r, other)

    def relieved(self, face: Face, r: Any, loaded: Face, change: Any, factor: float) -> Any:
        """r - factor times the deflection of nested cells."""
        assert isinstance(face, ArrayFace)
        ones: tuple[tuple[list[Any], list[Any]], ...]
        ones = tuple(([1.0] * len(hierarchy.merges), []) for hierarchy in self._hierarchies)
        return r - float(factor) * self._library.select(face.inside, self._mean_deflection(ones, change))

    def _mean_deflection(self, stiff: tuple[tuple[list[Any], list[Any]], ...], load: Any) -> Any:
        """Mean over the hierarchies of the deflection of the points by the cells they lie in."""
        roll, deflection = self._library.xp.roll, self._library.xp.zeros_like(load)
        for hierarchy, (g, units) in zip(self._hierarchies, stiff, strict=True):
            back = (-hierarchy.roll[0], -hierarchy.roll[1])
            moved = self._deflected(hierarchy.merges, g, units, roll(load, hierarchy.roll, axis=(0, 1)))
            deflection = deflection + roll(moved, back, axis=(0, 1))
        return deflection / float(len(self._hierarchies))

    def _stiffened(self, merges: tuple[Merge, ...], passed: Any) -> tuple[list[Any], list[Any]]:
        """g = 1 / (1 + w T) and T on every level of a hierarchy, from the sums ``passed`` up by single points."""
        levels, units = [], []
        for merge in merges:
            units.append(self._summed(passed, merge))
            levels.append(1.0 / (1.0 + merge.weight * units[-1]))
            passed = levels[-1] * units[-1]
        return levels, units

    def _deflected(self, merges: tuple[Merge, ...], g: list[Any], units: list[Any], passed: Any) -> Any:
        """Deflection of points by the cells they lie in under the loads ``passed`` up by them; without ``units`` no waves."""
        if self._waves is None or not units:
            return self._by_cells(merges, g, passed)
        depth, sums, shapes = self._waves.depth, [], []
        for merge, stiff in zip(merges[:depth], g, strict=False):
            shapes.append(passed.shape)
            sums.append(self._summed(passed, merge))
            passed = stiff * sums[-1]
        deflection = self._by_waves(merges[depth - 1 :], g[depth - 1 :], units[depth - 1], sums[-1])
        for level in range(depth - 1, -1, -1):
            deflection = _spread(self._library.xp, deflection, merges[level], shapes[level])
            if level > 0:
                deflection = g[level - 1] * (deflection + merges[level - 1].weight * sums[level - 1])
        return deflection

    def _by_waves(self, merges: tuple[Merge, ...], g: list[Any], unit: Any, total: Any) -> Any:
        """Deflection of the cells of the level of the waves, the first of those given, under the loads ``total``."""
        xp, sum_of = self._library.xp, self._library.xp.sum
        guess = self._of_level(merges, g, total)
        residual = guess - self._convolved(total - unit * guess)
        step = residual - self._of_level(merges, g, unit * residual)
        t = unit * step
        curvature = sum_of(t * (step + self._convolved(t)), dtype=xp.float64)
        product = sum_of(t * residual, dtype=xp.float64)
        safe = xp.where(curvature > 0.0, curvature, xp.ones_like(curvature))
        return guess - xp.astype(xp.where(curvature > 0.0, product / safe, xp.zeros_like(product)), t.dtype) * step

    def _of_level(self, merges: tuple[Merge, ...], g: list[Any], total: Any) -> Any:
        """Deflection of the cells of the first level given, under the loads ``total``, by nested cells from there on."""
        return g[0] * (self._by_cells(merges[1:], g[1:], g[0] * total) + merges[0].weight * total)

    def _convolved(self, loads: Any) -> Any:
        """True deflection of cells under ``loads``."""
        assert self._waves is not None
        assert self._product is not None
        (nx, ny), out = loads.shape, self._library.zeros(self._waves.cells, self._dtype)
        out[:nx, :ny] = loads
        return self._product.apply(out, out)[:nx, :ny]

    def _by_cells(self, merges: tuple[Merge, ...], g: list[Any], passed: Any) -> Any:
        """Deflection of parts by the cells they lie in under the loads ``passed`` up by them."""
        sums, shapes = [], []
        for merge, stiff in zip(merges, g, strict=True):
            shapes.append(passed.shape)
            sums.append(self._summed(passed, merge))
            passed = stiff * sums[-1]
        deflection = self._library.xp.zeros_like(passed)
        for merge, stiff, total, shape in reversed(list(zip(merges, g, sums, shapes, strict=True))):
            deflection = _spread(self._library.xp, stiff * (deflection + merge.weight * total), merge, shape)
        return deflection

    def _summed(self, values: Any, merge: Merge) -> Any:
        """Sums over the parts of every cell."""
        xp = self._library.xp
        for axis, pairs, offset in ((0, merge.x, merge.offset_x), (1, merge.y, merge.offset_y)):
            if not pairs:
                continue
            n = values.shape[axis]
            before, after = offset, (n + offset) % 2
            values = xp.concat([_rim(xp, values, axis, before), values, _rim(xp, values, axis, after)], axis=axis)
            halves = (n + before + after) // 2
            split = (halves, 2, values.shape[1]) if axis == 0 else (values.shape[0], halves, 2)
            values = xp.sum(xp.reshape(values, split), axis=axis + 1)
        return values


def _rim(xp: Any, values: Any, axis: int, width: int) -> Any:
    shape = (width, values.shape[1]) if axis == 0 else (values.shape[0], width)
    return xp.zeros(shape, dtype=values.dtype, device=values.device)


def _spread(xp: Any, values: Any, merge: Merge, shape: tuple[int, int]) -> Any:
    """Value of every cell on each of its parts, which are of ``shape``."""
    if merge.x:
        values = xp.repeat(values, 2, axis=0)[merge.offset_x : merge.offset_x + shape[0], :]
    if merge.y:
        values = xp.repeat(values, 2, axis=1)[:, merge.offset_y : merge.offset_y + shape[1]]
    return values
