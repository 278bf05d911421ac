"""The certificate of a contact: numbers that bound its error."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ..core.engine import Totals
from ..core.status import peak_memory
from .controls import FixedGrips
from .couplings.driver import CouplingCheck
from .couplings.protocol import Contact
from .solvers.protocol import (
    ROUNDING,
    ContactQP,
    FixedMean,
    Solution,
    best_level,
    heights_near_contact,
    least_length,
    level_of,
    pressure_error,
)

LARGEST_DUALITY_GAP = 1e-3
"""Bound on the relative error of the energy above which a result is doubtful; a converged one has
1e-6."""

LARGEST_IMBALANCE = 1e-3
"""Imbalance of the forces above which a result is doubtful; a converged one has 1e-4 at most."""


@dataclass(frozen=True)
class Certificate:
    """Checks of one solution.

    Attributes
    ----------
    duality_gap
        Rigorous bound on the relative error of the total complementary energy, G / |V|, with V
        measured at the level of the solution (then |V| is the elastic energy for elastic contact).
        At prescribed offset the bound holds for the problem with the load reached.
    field_error
        The customary error of the field, G / (total load x rms height); for bodies flatter than
        they deform, see ``solvers.protocol.least_length``.
    penetration
        Largest overlap of the bodies outside the plastic points, over the rms height.
    load_imbalance
        Force of the contact less the external one prescribed and what menisci and adhesion pull,
        over the sum of these; 0 where the position is prescribed.
    tolerance
        Tolerance the solver was given for its relative error.
    iterations, fft_pairs
        Work of the solver; FFT pairs of the size of the grid.
    wall_time
        Seconds from prepared operator to solution.
    peak_memory
        Largest memory the process has held so far, in bytes; NaN where it is not known.
    solver
        Name of the method.
    couplings
        Residual, rate and tolerance of every coupling with feedback.
    rounds
        Number of normal solves that the couplings took.
    complementarity
        De Saxcé's residual of gap, slip and friction together, see ``StickSlip``; zero without
        stick and slip.
    pressure_error
        Rigorous bound on the relative error of the pressure, |p - p*| / |p| over all points, from
        the duality gap (or its rounding) and the compliance of the wave that gives way least
        (``solvers.protocol.pressure_error``); infinite where it is not known. Usual contacts have
        1e-3, at true errors of 1e-7.
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
    complementarity: float = 0.0
    pressure_error: float = math.inf


def certify(
    qp: ContactQP, solution: Solution, totals: Totals, *, solver: str, tolerance: float, wall_time: float
) -> Certificate:
    """Certificate of ``solution``, whose sums are ``totals`` and which took ``wall_time`` s.

    Of a contact far from the zero of the heights it counts them from near the contact, whose
    deflection they would round away.
    """
    if (near := heights_near_contact(qp)) is not qp.profile:
        qp = replace(qp, profile=near)
        totals = qp.survey(solution.state).totals
    state, at, total, elastic = solution.state, level_of(qp, totals), totals.pressure, 0.5 * totals.deflected
    sharpest = totals.lowest
    if not qp.elastic:
        host = state.pressure, state.deflection, qp.profile
        pressure, deflection, profile = host if isinstance(qp.cap, np.ndarray) else qp.as_computed(state)
        sharpest = best_level(pressure, deflection - profile, qp.cap)
    found = qp.violation(state, sharpest)
    bound = found.above if qp.elastic else found.above + found.below
    deepest = at - sharpest if qp.elastic else qp.violation(state, at).deepest
    length = max(qp.height_scale, least_length(qp, total, elastic))
    energy = max(abs(totals.work - at * total - elastic), total * least_length(qp, total, 0.0))
    rounding = ROUNDING * (abs(totals.work) + abs(sharpest * total))
    target = qp.constraint.mean_pressure * qp.profile.size if isinstance(qp.constraint, FixedMean) else total
    return Certificate(
        duality_gap=bound / energy if energy > 0.0 else 0.0 if bound == 0.0 else np.inf,
        field_error=bound / (total * length) if total > 0.0 else 0.0,
        penetration=max(deepest, 0.0) / length,
        load_imbalance=abs(total - target) / target if target > 0.0 else 0.0,
        tolerance=tolerance,
        iterations=state.iterations,
        fft_pairs=state.applications * qp.operator.pairs_per_application + state.extra_pairs,
        wall_time=wall_time,
        peak_memory=peak_memory(),
        solver=solver,
        pressure_error=pressure_error(qp, state.pressure, max(bound, rounding)),
    )


def imbalance(contact: Contact, pulled: float) -> float:
    """``load_imbalance`` of a ``contact`` whose couplings pull with this force (N), negative where
    they push the bodies apart."""
    posed, control = contact.posed, contact.posed.control
    wanted = posed.external_force
    if isinstance(control, FixedGrips) and math.isfinite(control.stiffness):
        wanted = control.stiffness * (control.value - posed.top - contact.level)
    if wanted is None:
        return 0.0
    whole = abs(wanted) + abs(pulled)
    return abs(contact.force - pulled - wanted) / whole if whole > 0.0 else 0.0
