"""Displacement of a viscoelastic body under a pressure that moves steadily over a free grid.

A load that moves with the speed v along x has stood a distance v s further back a time s ago. With
the creep sum K_k (1 - exp(-t/lambda_k)) on top of K_0 the point at x in the frame of the load
therefore is displaced by

    A(x, y) = K_0(x, y) + sum ∫ K_k(x + s, y) exp(-s/L_k) ds/L_k,    L_k = v lambda_k,

in which the integral obeys L A_k' = A_k - K_k. It is taken from pixel to pixel, against the motion,
with K_k interpolated between them. The loss is -p·A'p = sum p·(K_k - A_k)p/L_k: no derivative of a
displacement is needed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from ...contact.boundary import FreeLine
from ...contact.operators import Operator
from ...contact.operators.creep import MultipleOperator, SummedOperator
from ...contact.problem import ContactProblem
from ...core.arrays import ComplexArray, RealArray
from ...core.engine import CpuEngine
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.quadrature import rule
from ...core.spectral import RealTransform
from ...solids.compliance.creep import AnyCreep, SharedCreep, contact_creep
from ...solids.compliance.halfspace import Compliance

_PARTS = 5
"""Parts of a pixel at which the influence is computed, odd; between them it is a polynomial of this
degree."""

_FARTHER = 2
"""Length upstream up to which the influence is computed, over that of the grid; beyond it falls
like that of a point, or of a line."""

_LOSS = 0.2
"""Share of the magnitude of a complex compliance that its real part counts as at least, in the
symmetric operator."""


@dataclass(frozen=True, eq=False)
class FreeMovingKernel:
    """Convolutions with the influence of pressure that moves over a free grid, on the half spectrum
    of the padded grid.

    Attributes
    ----------
    whole
        From pressure to displacement, m/Pa.
    storage
        Symmetric, positive; of the splitting.
    loss
        From pressure to p·(K - A)p/L, 1/Pa.
    axis, sign
        Axis of the grid along which it moves, and whether towards its end (+1) or its begin (-1).
    """

    whole: ComplexArray
    storage: RealArray
    loss: RealArray
    axis: int
    sign: float
    grid: Grid
    transform: RealTransform = field(repr=False)

    @classmethod
    def of(cls, problem: ContactProblem, operator: Operator, speed: float, direction: float) -> FreeMovingKernel:
        """For the bodies of ``problem``, its ``operator`` at the first instant, a ``speed`` (m/s)
        and a ``direction`` (rad) along an axis.

        InputError for another direction, and for bodies that flow.
        """
        axis, sign = axis_of(direction, problem)
        creep = contact_creep(problem.body, problem.counter_body)
        assert creep is not None
        if not np.isfinite(creep.times).all():
            raise InputError(
                f"bodies in steady sliding on a free grid must be solid, but one flows at {speed:g} m/s: it "
                "would sink without end. Take a spectrum whose shares add up to less than one."
            )
        grid = problem.grid if axis == 0 else problem.grid.exchanged
        moved, loss = _influences(creep, problem, grid, speed)
        if axis == 1:
            moved, loss = moved.T, loss.T
        if sign < 0.0:
            moved, loss = np.flip(moved, axis), np.flip(loss, axis)
        engine = operator.engine
        threads = engine.threads_for(operator.padded) if isinstance(engine, CpuEngine) else 1
        transform = RealTransform(operator.padded, threads)
        whole = _spectrum(transform, moved) + operator.kernel
        size = np.abs(whole)
        storage = size**2 / np.maximum(whole.real, _LOSS * size)
        return cls(whole, storage, _spectrum(transform, loss).real, axis, sign, problem.grid, transform)

    def lag(self, pressure: RealArray) -> RealArray:
        """Displacement (nx, ny) in m by ``pressure`` (Pa) beyond that of the symmetric operator."""
        return self._convolved(self.whole - self.storage, pressure)

    def slope(self, heights: RealArray) -> RealArray:
        """Derivative of ``heights`` (nx, ny) along the direction of motion, by central
        differences."""
        return np.asarray(self.sign * np.gradient(heights, self.grid.spacing[self.axis], axis=self.axis))

    def dissipation(self, pressure: RealArray) -> float:
        """Mean of -p ∂u/∂x along the motion (Pa)."""
        return float((pressure * self._convolved(self.loss, pressure)).mean())

    @property
    def lags(self) -> bool:
        """Whether there is any difference from the symmetric operator."""
        return bool(np.abs(self.whole - self.storage).max() > 1e-14 * self.storage.max())

    def symmetric(self, operator: Operator) -> Operator:
        """Operator of ``storage``; ``operator`` is that at the first instant, whose compliance
        serves for preconditioners."""
        return _StorageOperator(operator, operator.compliance, self.storage)

    def _convolved(self, kernel: RealArray | ComplexArray, pressure: RealArray) -> RealArray:
        (nx, ny), padded = pressure.shape, np.zeros(self.transform.shape)
        padded[:nx, :ny] = pressure
        spectrum = self.transform.forward(padded, np.empty(self.transform.spectrum_shape, np.complex128))
        spectrum *= kernel
        return np.ascontiguousarray(self.transform.backward(spectrum, padded)[:nx, :ny])


class _StorageOperator(SummedOperator):
    """Symmetric part of the operator; on coarser grids, for first guesses, a multiple of that at
    the first instant."""

    @property
    def coarsened(self) -> Operator:
        """A multiple of the operator at the first instant on half as many points per side."""
        return MultipleOperator(self.whole.coarsened, float(self.kernel.max() / self.whole.kernel.max()))


def axis_of(direction: float, problem: ContactProblem) -> tuple[int, float]:
    """Axis and sign of a ``direction`` (rad) on a free grid; InputError if it is along none."""
    quarters = direction / (0.5 * math.pi)
    number = round(quarters)
    line = isinstance(problem.boundary, FreeLine)
    if abs(quarters - number) > 1e-9 or (line and number % 2):
        axes = "0 or pi" if line else "a multiple of pi/2"
        raise InputError(
            f"direction of sliding (rad) must be {axes}, along an axis of the free grid, but is {direction:.6g}. "
            "Turn the surface instead."
        )
    return number % 2, (1.0, 1.0, -1.0, -1.0)[number % 4]


def _influences(creep: AnyCreep, problem: ContactProblem, grid: Grid, speed: float) -> tuple[RealArray, RealArray]:
    """Sums of A_k, and of (K_k - A_k)/L_k, at offsets (-(nx-1) … nx-1, -(ny-1) … ny-1) for a motion
    along the first axis."""
    (nx, ny), dx = grid.shape, grid.spacing[0]
    fine = Grid(((1 + _FARTHER) * _PARTS * nx, ny), (dx / _PARTS, grid.spacing[1]))
    total, loss = np.zeros((2 * nx - 1, ny)), np.zeros((2 * nx - 1, ny))
    shared = _between(_influence(problem, problem.compliance, fine), nx) if isinstance(creep, SharedCreep) else None
    for number, lam in enumerate(creep.times):
        if isinstance(creep, SharedCreep):
            assert shared is not None
            K = creep.shares[number] * shared
        else:
            K = _between(_influence(problem, creep.term(number), fine), nx)
        here = K[::_PARTS][: 2 * nx - 1]
        if speed == 0.0:
            total += here
            continue
        length = speed * lam
        line = isinstance(problem.boundary, FreeLine)
        # A = ∫ K(x + s) exp(-s/L) ds/L at every pixel, from that beyond the last one. Of a pixel by
        # weights of the values at 0, 1/5 … 1 for the integral of their polynomial times r exp(-r t)
        # from 0 to 1, for r pixels over L.
        r = dx / length
        nodes = np.arange(_PARTS + 1) / _PARTS
        moments = np.empty(nodes.size)
        if r < 2.0:
            t, w = rule(24)
            t, w = 0.5 * (t + 1.0), 0.5 * w
            moments[:] = [(w * t**n * r * np.exp(-r * t)).sum() for n in range(nodes.size)]
        else:
            moments[0] = -math.expm1(-r)
            for n in range(1, nodes.size):
                moments[n] = n / r * moments[n - 1] - math.exp(-r)
        weights, decay = np.linalg.solve(np.vander(nodes, increasing=True).T, moments), math.exp(-r)
        pixels = (len(K) - 1) // _PARTS
        A = np.empty((pixels + 1, K.shape[1]))
        A[-1] = _tail(K, dx, nx, grid.spacing[1], length, line=line)
        for pixel in range(pixels - 1, -1, -1):
            A[pixel] = weights @ K[pixel * _PARTS : (pixel + 1) * _PARTS + 1] + decay * A[pixel + 1]
        A = A[: 2 * nx - 1]
        total += A
        loss += (here - A) / length
    both = [np.concatenate([field[:, :0:-1], field], axis=1) for field in (total, loss)]
    return both[0], both[1]


def _influence(problem: ContactProblem, compliance: Compliance, grid: Grid) -> RealArray:
    if isinstance(problem.boundary, FreeLine):
        datum = problem.boundary.datum
        return compliance.line_influence(grid, problem.grid.size[0] if datum is None else datum)
    return compliance.influence(grid)


def _between(fine: RealArray, nx: int) -> RealArray:
    """Influence of a pixel at offsets -(nx-1) dx, … in parts of a pixel, from that of its parts at
    offsets 0, …"""
    start, half = (nx - 1) * _PARTS, _PARTS // 2
    both = np.concatenate([fine[start + half : 0 : -1], fine])
    running = np.concatenate([np.zeros((1, fine.shape[1])), np.cumsum(both, axis=0)])
    return np.asarray(running[_PARTS:] - running[:-_PARTS])


def _tail(K: RealArray, dx: float, nx: int, dy: float, length: float, *, line: bool) -> RealArray:
    """∫ K(X + s) exp(-s/L) ds/L at the last pixel X of ``K``, beyond which it falls like 1/r, or in
    a line like -ln x."""
    pixels = (len(K) - 1) // _PARTS
    X, last = (pixels - nx + 1) * dx, K[pixels * _PARTS]
    z, w = rule(200)
    end = math.log1p(40.0 * length / X)
    z, w = 0.5 * end * (z + 1.0), 0.5 * end * w
    s = X * np.expm1(z)
    w = w * (X + s) * np.exp(-s / length) / length
    if line:
        middle = K[(pixels - (pixels - nx + 1) // 2) * _PARTS]
        near = X - (pixels - nx + 1) // 2 * dx
        return np.asarray(last * w.sum() - (middle - last) / math.log(X / near) * float(w @ z))
    y = np.arange(K.shape[1]) * dy
    return np.asarray(last * np.hypot(X, y) * (w @ (1.0 / np.hypot(X + s[:, None], y))))


def _spectrum(transform: RealTransform, offsets: RealArray) -> ComplexArray:
    """Half spectrum of the cyclic kernel with values at ``offsets`` (-(nx-1) … nx-1, -(ny-1) …
    ny-1)."""
    nx, ny = (offsets.shape[0] + 1) // 2, (offsets.shape[1] + 1) // 2
    kernel = np.zeros(transform.shape)
    i, j = np.arange(1 - nx, nx), np.arange(1 - ny, ny)
    kernel[np.ix_(i % transform.shape[0], j % transform.shape[1])] = offsets
    return transform.forward(kernel, np.empty(transform.spectrum_shape, np.complex128))
