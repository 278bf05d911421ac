"""Sinusoidal crests that press each other down: the equations, as a complementarity problem and as least squares.

With w_i = a_i² of the contact radii and the far-field approach δ_i = δ - (z_M - z_i) of each crest,

    r_i(w) = ω_i(w_i) + Σ_j≠i F_j(w_j)/(π E* r_ij) - δ_i,   w_i >= 0,  r_i >= 0,  w_i r_i = 0:

a crest touches, or the others have pressed it below the plane. Displacements between crests are those of point forces.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..core.arrays import BoolArray, RealArray
from ..core.errors import ConvergenceError, InputError
from .sinusoidal_asperity import TWO_TERMS, two_term_approach, two_term_load

_STEPS = 200
_TOLERANCE = 1e-13  # of the residual over the approach
_LIFTED = 1e-9  # share of the approach above which a residual is not rounding of the optimiser
_SELF_TERM = math.pi  # F_i/(π E* a_i)

_LOAD_STEP, _APPROACH_STEP = 2.0, 1.25  # ratios to the value before from which steps settle where crests crowd
_FIRST_SHARE = 0.03  # of a load or an approach with so few contacts that the steps settle from any start


@dataclass(frozen=True, eq=False)
class CrestSystem:
    """The crests that may touch, the highest first.

    Parameters
    ----------
    A1, A2
        (n,) coefficients of the crests in 1/m and 1/m³.
    largest
        (n,) largest a² in m² for which the two terms hold, infinite for paraboloids (A_2 = 0).
    coupling
        (n, n) displacement at i per F_j/E* at j in 1/m, zero on the diagonal.
    self_term
        Whether F_i/(π E* a_i) is added to ω_i, as in the printed formulation. The approach of a punch already is the
        displacement of its centre against the far field, so that this counts it twice.
    """

    A1: RealArray
    A2: RealArray
    largest: RealArray
    coupling: RealArray
    self_term: bool = False

    def residual(self, w: RealArray, delta: RealArray) -> RealArray:
        """r_i in m."""
        own = two_term_approach(np.sqrt(w), self.A1, self.A2)
        if self.self_term:
            own = own + (8.0 / 3.0 * self.A1 + 64.0 / 15.0 * self.A2 * w) * w / _SELF_TERM
        values: RealArray = own + self.coupling @ self.loads(w) - delta
        return values

    def loads(self, w: RealArray) -> RealArray:
        """F_i/E* in m²."""
        return two_term_load(np.sqrt(w), 1.0, self.A1, self.A2)

    def load_slope(self, w: RealArray) -> RealArray:
        """d(F_i/E*)/dw_i."""
        values: RealArray = (4.0 * self.A1 + 32.0 / 3.0 * self.A2 * w) * np.sqrt(w)
        return values

    def jacobian(self, w: RealArray, among: BoolArray) -> RealArray:
        """dr_i/dw_j of the crests ``among``."""
        own = 2.0 * self.A1 + 16.0 / 3.0 * self.A2 * w
        if self.self_term:
            own = own + (8.0 / 3.0 * self.A1 + 128.0 / 15.0 * self.A2 * w) / _SELF_TERM
        matrix: RealArray = self.coupling[np.ix_(among, among)] * self.load_slope(w)[among]
        matrix[np.diag_indices_from(matrix)] += own[among]
        return matrix

    def isolated(self, delta: RealArray) -> RealArray:
        """w_i of crests that do not feel each other, at most the largest; the self term is left out."""
        omega = np.maximum(delta, 0.0)
        discriminant = self.A1**2 + 8.0 / 3.0 * self.A2 * omega  # negative beyond the largest approach, 9h/8
        alone = omega / (self.A1 + np.sqrt(np.where(discriminant >= 0.0, discriminant, np.nan)))
        return np.where(np.isnan(alone), self.largest, np.minimum(alone, self.largest))

    @property
    def count(self) -> int:
        """Number of crests."""
        return int(self.A1.size)

    def nearness(self, w: RealArray) -> RealArray:
        """1/distance in 1/m of each crest to the next one that touches; 0 without interaction."""
        values: RealArray = math.pi * np.max(self.coupling * (w > 0.0), axis=1, initial=0.0)
        return values

    def leading(self, count: int) -> CrestSystem:
        """The ``count`` highest crests."""
        part = slice(0, count)
        return CrestSystem(self.A1[part], self.A2[part], self.largest[part], self.coupling[part, part], self.self_term)


def solve_complementarity(system: CrestSystem, delta: RealArray, start: RealArray) -> RealArray:
    """w (n,) by Newton steps on the touching crests, which crests leave and enter as the conditions say.

    Raises
    ------
    InputError
        If a crest is pressed beyond the range of its two terms.
    ConvergenceError
        If the steps do not settle.
    """
    w, scale = start.copy(), float(delta.max())
    for _ in range(_STEPS):
        r = system.residual(w, delta)
        touching = (w > 0.0) | (r < 0.0)
        if np.all(np.abs(r[touching]) <= _TOLERANCE * scale):
            return w
        w[touching] -= np.linalg.solve(system.jacobian(w, touching), r[touching])
        np.clip(w, 0.0, 0.999 * system.largest, out=w)
    raise _not_solved(system, w)


def solve_load(
    system: CrestSystem, depth: RealArray, total: float, *, delta: float, start: RealArray
) -> tuple[float, RealArray]:
    """Approach δ in m, and w (n,), at which the loads F_i/E* of the crests sum to ``total`` in m².

    Newton steps in δ and all w at once; crests lie ``depth`` (n,) in m below the highest, and ``delta`` and ``start`` are first
    values of δ and w.

    Raises
    ------
    InputError, ConvergenceError
        As for ``solve_complementarity``.
    """
    w = start.copy()
    for _ in range(_STEPS):
        r = system.residual(w, delta - depth)
        touching = (w > 0.0) | (r < 0.0)
        excess = system.loads(w).sum() - total
        if np.all(np.abs(r[touching]) <= _TOLERANCE * delta) and abs(excess) <= _TOLERANCE * total:
            return delta, w
        sides = np.stack([r[touching], np.ones(int(touching.sum()))], axis=1)
        fall, rise = np.linalg.solve(system.jacobian(w, touching), sides).T
        slope = system.load_slope(w)[touching]
        step = np.clip((slope @ fall - excess) / (slope @ rise), -0.5 * delta, delta)
        w[touching] += step * rise - fall
        delta += float(step)
        np.clip(w, 0.0, 0.999 * system.largest, out=w)
    raise _not_solved(system, w)


def solve_least_squares(system: CrestSystem, delta: RealArray, start: RealArray) -> RealArray:
    """w (n,) by minimising |r|²/2 over the contact radii a >= 0 of the touching crests, with scipy's optimiser.

    A crest that ends with a positive residual is pressed below the plane and leaves; one with a negative residual enters.

    Raises
    ------
    InputError, ConvergenceError
        As for ``solve_complementarity``.
    """
    w, scale = start.copy(), float(delta.max())
    unit = np.sqrt(np.where(np.isinf(system.largest), system.isolated(delta) + scale / system.A1, system.largest))
    touching = w > 0.0
    for _ in range(_STEPS):
        w = _least_squares(system, delta, w, touching, unit=unit)
        r = system.residual(w, delta)
        # a crest that cannot reach the plane holds a positive residual, and the others a negative one
        pressed, missed = touching & (r > _LIFTED * scale), ~touching & (r < 0.0)
        if not pressed.any() and not missed.any():
            return w
        w[pressed] = 0.0
        touching = (touching & ~pressed) | missed
    raise _not_solved(system, w)


def _least_squares(
    system: CrestSystem, delta: RealArray, start: RealArray, among: BoolArray, *, unit: RealArray
) -> RealArray:
    """w of the crests ``among`` with the least sum of squared residuals, the others zero; unknowns are a over ``unit``."""
    from scipy.optimize import least_squares

    def squares(x: RealArray) -> RealArray:
        w = np.zeros_like(delta)
        w[among] = np.square(x * unit[among])
        return w

    def residual(x: RealArray) -> RealArray:
        values: RealArray = system.residual(squares(x), delta)[among] / scale
        return values

    def jacobian(x: RealArray) -> RealArray:
        values: RealArray = system.jacobian(squares(x), among) * (2.0 * x * unit[among] ** 2) / scale
        return values

    scale = float(delta.max())
    found = least_squares(
        residual,
        np.clip(np.sqrt(start[among]) / unit[among], 1e-6, 0.999),
        jacobian,
        bounds=(0.0, 1.0),  # of paraboloids as well: interaction makes contacts smaller
        xtol=_TOLERANCE,
        ftol=_TOLERANCE,
        gtol=_TOLERANCE,
    )
    return squares(found.x)


def _not_solved(system: CrestSystem, w: RealArray) -> InputError | ConvergenceError:
    if np.any(w >= 0.99 * system.largest):
        return InputError(
            f"contact radii must stay below {TWO_TERMS:.3f} wavelengths, where the two terms of the sine end, but a crest "
            "is pressed deeper. Lower the pressure or the approach."
        )
    return ConvergenceError(f"interacting crests did not settle in {_STEPS} steps; the crests may be too close.")


def settled(
    solve: Callable[[CrestSystem, RealArray, RealArray], RealArray],
    system: CrestSystem,
    delta: RealArray,
    start: RealArray,
) -> RealArray:
    """w (n,) by ``solve`` from ``start``, or where its steps swing, from a small approach upwards.

    Raises
    ------
    InputError, ConvergenceError
        As for ``solve_complementarity``.
    """
    try:
        return solve(system, delta, start)
    except ConvergenceError:
        w, top = np.zeros_like(start), float(delta.max())
        for approach in _graded(np.array([_FIRST_SHARE * top, top]), _APPROACH_STEP):
            w = solve(system, approach - (top - delta), w)
        return w


def graded_loads(loads: RealArray) -> RealArray:
    """The ``loads`` (n,) as they rise, with lighter ones to begin with and others between those that are too far apart."""
    return _graded(np.append(loads, _FIRST_SHARE * loads.min()), _LOAD_STEP)


def graded_approaches(approaches: RealArray) -> RealArray:
    """The ``approaches`` (n,) as they rise, with others between those that are too far apart."""
    return _graded(approaches, _APPROACH_STEP)


def _graded(values: RealArray, ratio: float) -> RealArray:
    rising = np.unique(values)
    parts = [rising[:1]]
    for low, high in itertools.pairwise(rising):
        count = math.ceil(math.log(high / low) / math.log(ratio)) if low > 0.0 else 1
        parts.append(np.append(low * (high / low) ** (np.arange(1, count) / count), high))
    return np.concatenate(parts)
