"""Local regression with a Gaussian window: the smoothing behind the areal filters of ISO 16610-61 and -71.

At every node a polynomial of order 0, 1 or 2 in x and y is fitted to its surroundings with the weights
s(x, y) = exp[-π (x/(γ λx))² - π (y/(γ λy))²], and its value there is the smooth surface. γ is such that a wave of the length
λ passes by one half: sqrt(ln 2/π) for order 0 and 1, 0.7309 for order 2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...core.arrays import ComplexArray, RealArray
from ...core.grid import Grid
from ...core.spectral import RealTransform, fast_length, thread_count

_FIRST = math.log(2.0)  # transmission e^-t with t = π γ² at the cut-off
_SECOND = 1.6783469900166605  # (1 + t) e^-t = 1/2, the transmission of order 2 in any number of dimensions
_RIDGE = 1e-10  # of the trace, where the weights leave a coefficient undetermined
_ROWS = 1 << 15  # nodes whose equations are solved together, to bound the memory


def gamma(order: int) -> float:
    """Width γ of the window in units of the cut-off."""
    return math.sqrt((_SECOND if order == 2 else _FIRST) / math.pi)


def transmission(ratio: RealArray | float, order: int = 0) -> RealArray:
    """Amplitude transmission of a wave of the length λ on an endless surface; ``ratio`` λc/λ, both dimensionless."""
    t = (_SECOND if order == 2 else _FIRST) * np.square(np.asarray(ratio, dtype=float))
    values: RealArray = (1.0 + t) * np.exp(-t) if order == 2 else np.exp(-t)
    return values


@dataclass(frozen=True, eq=False)
class LocalRegression:
    """The fit prepared for one grid: transfer functions of the moments of the window along x and y.

    ``along_x[a]`` (px, 1) and ``along_y[b]`` (1, py // 2 + 1) of s(u) (u/λ)^a; ``padded`` is the grid itself if it is periodic.
    """

    shape: tuple[int, int]
    padded: tuple[int, int]
    order: int
    along_x: tuple[ComplexArray, ...]
    along_y: tuple[ComplexArray, ...]

    def smooth(self, heights: RealArray, weights: RealArray) -> RealArray:
        """Fitted values (nx, ny) in m; ``weights`` (nx, ny) >= 0 of the nodes, 0 where ``heights`` (m) are to be left out."""
        transform = RealTransform(self.padded, thread_count())
        of_weights = self._transformed(transform, weights)
        of_heights = self._transformed(transform, weights * heights)
        powers = [(a, b) for a in range(self.order + 1) for b in range(self.order + 1 - a)]
        right = [self._moment(transform, of_heights, *power) for power in powers]
        if len(powers) == 1:
            total = self._moment(transform, of_weights, 0, 0)
            return _ratio(right[0], total)
        sums = {
            (a, b): self._moment(transform, of_weights, a, b)
            for a in range(2 * self.order + 1)
            for b in range(2 * self.order + 1 - a)
        }
        return _solved(powers, sums, right)

    def _transformed(self, transform: RealTransform, field: RealArray) -> ComplexArray:
        if self.padded == self.shape:
            return transform.forward(np.ascontiguousarray(field))
        work = np.zeros(self.padded)
        work[: self.shape[0], : self.shape[1]] = field
        return transform.forward(work)

    def _moment(self, transform: RealTransform, spectrum: ComplexArray, a: int, b: int) -> RealArray:
        """Σ s(x' - x) (x' - x)^a (y' - y)^b f(x') over all nodes x', for every node x."""
        field = transform.backward(spectrum * self.along_x[a] * self.along_y[b])
        return field[: self.shape[0], : self.shape[1]]


def local_regression(
    grid: Grid, cutoff: tuple[float, float], *, order: int, periodic: bool, reach: float
) -> LocalRegression:
    """Prepare the fit of ``order`` 0, 1 or 2 for the ``cutoff`` (λx, λy) in m.

    The window ends at |x| = ``reach`` λx for order 0, at the same share of its height for order 2.
    """
    width = gamma(order)
    counts = [math.floor(reach * width / gamma(0) * c / d + 1e-9) for c, d in zip(cutoff, grid.spacing, strict=True)]
    beyond = (0, 0) if periodic else (counts[0], counts[1])  # zeros after the last node keep the borders apart
    nx, ny = (n if periodic else fast_length(n + k) for n, k in zip(grid.shape, beyond, strict=True))
    padded = (nx, ny)
    windows = [
        _windows(n, count, d / c, width, 2 * order)
        for n, count, d, c in zip(padded, counts, grid.spacing, cutoff, strict=True)
    ]
    # correlation, not convolution: the conjugate of the transform
    along_x = tuple(RealTransform((padded[0], 1)).forward(w[:, None]).conj() for w in windows[0])
    along_y = tuple(RealTransform((1, padded[1])).forward(w[None, :]).conj() for w in windows[1])
    return LocalRegression(grid.shape, padded, order, along_x, along_y)


def _windows(n: int, count: int, step: float, width: float, highest: int) -> list[RealArray]:
    """exp(-π (u/γ)²) u^a, a = 0 … ``highest``, at u = k ``step``, |k| <= ``count``, wrapped on ``n`` nodes from node 0 on."""
    offsets = np.arange(-count, count + 1)
    u = offsets * step
    window = np.exp(-np.pi * (u / width) ** 2)
    window /= window.sum()
    return [np.bincount(offsets % n, window * u**a, n).astype(np.float64) for a in range(highest + 1)]


def _ratio(right: RealArray, total: RealArray) -> RealArray:
    """right/total, NaN where no node with a weight is near (total is no more than rounding)."""
    enough = total > 1e-13
    values: RealArray = np.divide(right, total, out=np.full(right.shape, np.nan), where=enough)
    return values


def _solved(powers: list[tuple[int, int]], sums: dict[tuple[int, int], RealArray], right: list[RealArray]) -> RealArray:
    """Constant term of the fit at every node, from its normal equations."""
    shape, count = right[0].shape, len(powers)
    values = np.full(right[0].size, np.nan)
    flat = {power: field.ravel() for power, field in sums.items()}
    total = flat[0, 0]
    for start in range(0, values.size, _ROWS):
        part = slice(start, start + _ROWS)
        near = total[part] > 1e-13
        matrix = np.empty((int(near.sum()), count, count))
        vector = np.empty((matrix.shape[0], count, 1))
        for i, (a, b) in enumerate(powers):
            vector[:, i, 0] = right[i].ravel()[part][near]
            for j, (c, d) in enumerate(powers):
                matrix[:, i, j] = flat[a + c, b + d][part][near]
        ridge = _RIDGE * np.trace(matrix, axis1=1, axis2=2)
        matrix[:, range(1, count), range(1, count)] += ridge[:, None]  # the constant itself is never shrunk
        found = np.full(near.size, np.nan)
        found[near] = np.linalg.solve(matrix, vector)[:, 0, 0]
        values[part] = found
    return values.reshape(shape)
