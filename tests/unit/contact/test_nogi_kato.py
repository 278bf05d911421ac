"""Conjugate gradients at a prescribed approach: the recurrence of the source, points that come
back, the load, and agreement on grids that no dense method takes."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from catalogue import CASES, EXACT, solved
from contact_cases import elastic, rough
from scipy.sparse.linalg import cg

import asperity as asp
from asperity.contact.operators import prepare_operator
from asperity.contact.solvers.protocol import ContactQP, FixedOffset, energy
from asperity.core.grid import Grid
from asperity.solids.compliance.halfspace import HalfSpace
from asperity.solvers import NogiKato

TOLERANCE = 1e-10


def pressed_in() -> ContactQP:
    """A free square so far in that every point is in contact and no pressure is ever negative."""
    grid = Grid((7, 6), (1.0, 1.0))
    operator = prepare_operator(HalfSpace(1.0), grid, asp.Free())
    heights = 1e-3 * np.random.default_rng(2).standard_normal(grid.shape)
    return ContactQP(operator, heights, np.inf, FixedOffset(-1.0), float(heights.std()))


def test_follows_the_recurrence_of_the_source_while_no_pressure_is_negative() -> None:
    """Peng's eq. 3.2 is the method of Hestenes and Stiefel: another code of it gives the same
    pressures."""
    qp = pressed_in()
    method = NogiKato()
    state = method.init(qp, None)
    others: list[np.ndarray] = []
    begin, rigid = state.pressure.ravel().copy(), qp.profile.ravel() + 1.0
    cg(qp.operator.matrix(), rigid, x0=begin, rtol=0.0, maxiter=6, callback=lambda p: others.append(p.copy()))
    for other in others:
        state = method.step(qp, state)
        np.testing.assert_allclose(state.pressure.ravel(), other, rtol=1e-11)
    assert len(others) == 6


def test_points_cut_off_come_back_at_one_approach() -> None:
    """Contact from all that overlaps undeformed loses points that belong to it; without joining,
    bodies would penetrate there at the end of the source's method."""
    reference = solved(next(case for case in CASES if case.name == "rough periodic load"), EXACT)[0]
    qp = replace(reference, constraint=FixedOffset(0.0))
    method = NogiKato(tolerance=TOLERANCE)
    state, sets, energies = method.init(qp, None), [], []
    while state.error > method.tolerance and state.iterations < 2000:
        sets.append(state.pressure > 0.0)
        energies.append(energy(qp, state.pressure, state.deflection))
        state = method.step(qp, state)
    assert state.error <= method.tolerance
    touching = state.pressure > 0.0
    assert any((before & ~after & touching).any() for before, after in pairwise(sets))
    assert (np.diff(energies) <= 1e-12 * np.abs(energies).max()).all()


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=["periodic", "free"])
@pytest.mark.parametrize("law", [asp.plasticity.HardWall(), asp.Hardness(0.4)], ids=["elastic", "capped"])
def test_agrees_beyond_the_dense_limit(boundary, law) -> None:
    """The duality gap bounds the energy of the difference, so that pressures differ by about the
    square root of the error."""
    problem = asp.ContactProblem(rough((96, 80), 1, power=1.8), elastic(1.0), boundary=boundary, law=law)
    methods = NogiKato(tolerance=TOLERANCE), asp.solvers.ActiveSet(tolerance=TOLERANCE)
    found, default = (asp.solve(problem, asp.MeanPressure(0.01), solver=method) for method in methods)
    assert found.converged
    assert found.mean_pressure == pytest.approx(0.01, rel=1e-12)
    bound = np.sqrt(TOLERANCE) * default.max_pressure
    np.testing.assert_allclose(found.pressure, default.pressure, rtol=0.0, atol=bound)
    assert asp.cite(problem, found).count("[Nogi1997]") == 1
