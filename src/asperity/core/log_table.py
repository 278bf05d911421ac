"""Functions of a positive number, tabulated on a logarithmic grid and interpolated nearly to rounding."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial.polynomial import polyfromroots

from .arrays import RealArray

STEP = 1.0 / 96.0
"""Spacing of the nodes in ln x. The error of the ten-point polynomial is 870 (STEP/w)^10 relative for a function of ln x
without singularities nearer to the real axis than w: 1e-14 at w = 0.5, about the least of responses of layered bodies."""

_BEFORE, _AFTER = 4, 5  # nodes below and above the node that starts a cell
_CHUNK = 16384  # points whose temporaries stay in the second-level cache


def _lagrange() -> RealArray:
    """Coefficients (power, node) of the polynomials that are one at one node and zero at the others."""
    nodes = np.arange(-_BEFORE, _AFTER + 1) - 0.5
    others = [np.delete(nodes, k) for k in range(nodes.size)]
    return np.transpose([polyfromroots(o) / np.prod(node - o) for node, o in zip(nodes, others, strict=True)])


_LAGRANGE = _lagrange()


@dataclass(frozen=True, eq=False)
class LogTable:
    """Piecewise polynomial in ln x; ``coefficients[k, i]`` belongs to s^k in cell i, s = (ln x - ln start)/STEP - i - 1/2.

    Beyond its ends the table extrapolates with the outermost polynomials.
    """

    start: float
    coefficients: RealArray

    @property
    def end(self) -> float:
        """Largest x of the table."""
        return float(self.start * np.exp(self.coefficients.shape[1] * STEP))

    def __call__(self, x: RealArray) -> RealArray:
        """Values at ``x`` > 0, an array of any shape."""
        x = np.asarray(x, dtype=float)
        flat, out = x.ravel(), np.empty(x.size)
        for begin in range(0, x.size, _CHUNK):
            part = slice(begin, begin + _CHUNK)
            self._evaluate(flat[part], out[part])
        return out.reshape(x.shape)

    def _evaluate(self, x: RealArray, out: RealArray) -> None:
        s = np.log(x)
        s -= np.log(self.start)
        s /= STEP
        cell = s.astype(np.intp)
        np.clip(cell, 0, self.coefficients.shape[1] - 1, out=cell)
        s -= cell
        s -= 0.5
        self.coefficients[-1].take(cell, out=out, mode="clip")
        gathered = np.empty_like(out)
        for coefficient in self.coefficients[-2::-1]:
            out *= s
            out += coefficient.take(cell, out=gathered, mode="clip")

    def integral(self) -> LogTable:
        """Table of the integral over ln x from its start."""
        orders = np.arange(1, self.coefficients.shape[0] + 1)
        rises = self.coefficients / orders[:, None] * STEP
        before, after = np.vander([-0.5, 0.5], orders.size + 1, increasing=True)[:, 1:] @ rises
        begin = np.concatenate([[0.0], np.cumsum(after - before)[:-1]]) - before
        return LogTable(self.start, np.vstack([begin, rises]))


def log_grid(start: float, count: int) -> RealArray:
    """Nodes start·exp(i·STEP), i = 0…count-1."""
    grid: RealArray = start * np.exp(STEP * np.arange(count))
    return grid


def covering_grid(low: float, high: float) -> RealArray:
    """Nodes of a table that reaches from ``low`` to ``high``, both > 0."""
    cells = int(np.ceil(np.log(high / low) / STEP)) + 1
    return log_grid(low * np.exp(-STEP * (_BEFORE + 0.5)), cells + _BEFORE + _AFTER)


def log_table(start: float, values: RealArray) -> LogTable:
    """Table through ``values`` at the nodes ``log_grid(start, len(values))``, at least ten."""
    values = np.asarray(values, dtype=float)
    cells = values.size - _LAGRANGE.shape[1] + 1
    coefficients = np.zeros((_LAGRANGE.shape[0], cells))
    for k, weights in enumerate(_LAGRANGE.T):
        coefficients += weights[:, None] * values[k : k + cells]
    return LogTable(float(start * np.exp(STEP * _BEFORE)), coefficients)
