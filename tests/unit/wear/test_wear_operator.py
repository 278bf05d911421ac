"""The compliance of a step of wear: products against its matrix, and solvers on uneven beds."""

from __future__ import annotations

import numpy as np
import pytest

import asperity as asp
from asperity.contact.boundary import Free, Periodic
from asperity.contact.operators import prepare_operator
from asperity.contact.solvers.active_set.solver import ActiveSet
from asperity.contact.solvers.protocol import ContactQP, FixedMean, run
from asperity.core.grid import Grid
from asperity.physics.wear.operator import WearOperator
from asperity.solids.compliance.halfspace import HalfSpace
from asperity.solvers import ConjugateGradient

GRID = Grid((12, 10), (1.0, 1.2))


@pytest.mark.parametrize("boundary", [Periodic(), Free()])
@pytest.mark.parametrize("uneven", [False, True])
@pytest.mark.parametrize("tracked", [False, True])
def test_products_are_those_of_the_matrix(boundary: object, uneven: bool, tracked: bool) -> None:
    generator = np.random.default_rng(1)
    whole = prepare_operator(HalfSpace(1.0), GRID, boundary)  # type: ignore[arg-type]
    bed = 2.0 * generator.random(GRID.shape) if uneven else 0.7
    track = generator.random(GRID.shape[1]) if tracked else None
    operator = WearOperator(whole, bed, track)
    pressure = generator.random(GRID.shape)
    wanted = whole.apply(pressure) + bed * pressure
    if track is not None:
        wanted = wanted + track * pressure.mean(axis=0)
    assert operator.apply(pressure) == pytest.approx(wanted, rel=1e-12)
    matrix = operator.matrix()
    assert matrix == pytest.approx(matrix.T, abs=1e-14)
    assert (matrix @ pressure.ravel()).reshape(GRID.shape) == pytest.approx(wanted, rel=1e-12)
    assert np.linalg.eigvalsh(matrix).min() >= operator.smallest * (1.0 - 1e-9)
    half = operator.coarsened
    assert half.grid.shape == (6, 5)
    assert half.translation_invariant == (not uneven and not tracked)


@pytest.mark.parametrize("cap", [np.inf, 0.5, 0.2])
def test_the_fast_solver_takes_uneven_beds(cap: float) -> None:
    """Beds of 1 : 100 beside and below the compliance of single points, with a limit of the
    pressure that differs from point to point; conjugate gradients find the same."""
    n = 48
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(0.3), hurst=0.8, rolloff_wavelength=n / 4, shortest_wavelength=6.0
    )
    profile = asp.generate.gaussian(asp.Grid((n, n), (1.0, 1.0)), spectrum, seed=2).heights
    whole = prepare_operator(HalfSpace(1.0), asp.Grid((n, n), (1.0, 1.0)), Periodic())
    bed = np.where(profile > np.median(profile), 100.0, 1.0) * whole.smallest
    limit: float | np.ndarray = cap if cap == np.inf else np.where(profile > 0.0, cap, 2.0 * cap)
    qp = ContactQP(WearOperator(whole, bed), np.asarray(profile), limit, FixedMean(0.05), float(profile.std()))
    fast = run(ActiveSet(max_iterations=300), qp)
    slow = run(ConjugateGradient(tolerance=1e-9, max_iterations=20000), qp)
    assert fast.status.converged
    assert slow.status.converged
    largest = float(slow.state.pressure.max())
    # the pressure is to the root of the relative error of the energy, 1e-7
    assert fast.state.pressure == pytest.approx(slow.state.pressure, abs=1e-3 * largest)


def test_what_points_yield_beside_the_bed_spares_products() -> None:
    """Two thirds of the products are enough where beds differ by a factor of ten in patches and
    preconditioned systems know it; the answer is the same."""
    n = 64
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(0.3), hurst=0.8, rolloff_wavelength=n / 4, shortest_wavelength=6.0
    )
    grid = asp.Grid((n, n), (1.0, 1.0))
    profile = np.asarray(asp.generate.gaussian(grid, spectrum, seed=4).heights)
    whole = prepare_operator(HalfSpace(1.0), grid, Periodic())
    x, y = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    bed = np.where((x // 8 + y // 8) % 2 == 0, 30.0, 3.0) * whole.smallest
    products, pressures = [], []
    for told in (False, True):
        operator = WearOperator(whole, bed)
        if not told:
            operator.beside = None
        found = run(ActiveSet(), ContactQP(operator, profile, np.inf, FixedMean(0.05), float(profile.std())))
        assert found.status.converged
        products.append(found.state.applications + found.state.extra_pairs)
        pressures.append(found.state.pressure)
    assert products[1] <= 2.0 / 3.0 * products[0]
    assert pressures[1] == pytest.approx(pressures[0], abs=1e-3 * float(pressures[0].max()))
