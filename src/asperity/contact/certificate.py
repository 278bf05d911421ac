"""How good is this answer? Numbers that bound the error of a solution, not only the solver's own opinion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.arrays import RealArray
from ..core.system import peak_memory
from .couplings.driver import CouplingCheck
from .solvers.protocol import ContactQP, FixedMean, Solution, best_level, duality_gap, least_length, level


@dataclass(frozen=True)
class Certificate:
    """Checks of one solution.

    Attributes
    ----------
    duality_gap
        Rigorous bound on the relative error of the total complementary energy, G / |V|, with V measured at the
        level of the solution (then |V| is the elastic energy for elastic contact). At prescribed offset the bound
        holds for the problem with the load reached.
    field_error
        The customary error of the field, G / (total load x rms height); for bodies flatter than they deform, see
        ``solvers.protocol.least_length``.
    penetration
        Largest overlap of the bodies outside the plastic points, over the rms height.
    load_imbalance
        Relative difference of the load reached and the load prescribed; 0 where the position is prescribed.
    tolerance
        Tolerance the solver was given for its relative error.
    iterations, fft_pairs
        Work of the solver; FFT pairs of the size of the grid.
    wall_time
        Seconds from prepared operator to solution.
    peak_memory
        Largest memory the process has held so far, in bytes; NaN where the system does not tell.
    solver
        Name of the method.
    couplings
        Residual, rate and tolerance of every coupling with feedback.
    rounds
        Number of normal solves that the couplings took.
    """

    duality_gap: float
    field_error: float
    penetration: float
    load_imbalance: float
    tolerance: float
    iterations: int
    fft_pairs: float
    wall_time: float
    peak_memory: float
    solver: str
    couplings: tuple[CouplingCheck, ...] = ()
    rounds: int = 1


def certify(qp: ContactQP, solution: Solution, *, solver: str, tolerance: float, wall_time: float) -> Certificate:
    """Certificate of ``solution``, which took ``wall_time`` s."""
    p, deflection = solution.state.pressure, solution.state.deflection
    r = deflection - qp.profile
    at = level(qp, p, r)
    sharpest = best_level(p, r, qp.cap)
    total = float(p.sum(dtype=np.float64))
    bound = duality_gap(p, r, qp.cap, sharpest)
    elastic = 0.5 * _product(p, deflection)
    length = max(qp.height_scale, least_length(qp, total, elastic))
    energy = max(abs(elastic - _product(p, qp.profile + at)), total * least_length(qp, total, 0.0))
    lowest = (
        sharpest if qp.elastic else float(r.min(where=p < qp.cap, initial=np.inf))
    )  # of the points that may not overlap
    target = qp.constraint.mean_pressure * p.size if isinstance(qp.constraint, FixedMean) else total
    return Certificate(
        duality_gap=bound / energy if energy > 0.0 else 0.0 if bound == 0.0 else np.inf,
        field_error=bound / (total * length) if total > 0.0 else 0.0,
        penetration=max(at - lowest, 0.0) / length,
        load_imbalance=abs(total - target) / target if target > 0.0 else 0.0,
        tolerance=tolerance,
        iterations=solution.state.iterations,
        fft_pairs=solution.state.applications * qp.operator.pairs_per_application + solution.state.extra_pairs,
        wall_time=wall_time,
        peak_memory=peak_memory(),
        solver=solver,
    )


def _product(first: RealArray, second: RealArray) -> float:
    """Sum of the products of two fields in double precision."""
    return float(np.einsum("ij,ij->", first, second, dtype=np.float64))
