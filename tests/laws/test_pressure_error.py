"""The certificate bounds the error of the pressure, also where a stiff plate on something soft
hides it from the energy."""

import numpy as np
import pytest

import asperity as asp
from asperity.contact.operators import prepare_operator
from asperity.contact.solvers.protocol import pressure_error
from asperity.solvers import ActiveSet, ContactQP, FixedMean, run

ALLOWED = 1e-3
"""Error of the pressure over the largest, and in the L2 norm, at the default tolerance."""

CLOSE = ActiveSet(tolerance=1e-12)


def stiff_plate() -> asp.ContactProblem:
    """1 mm of 390 GPa on 70 µm of 1.1 MPa on a rigid base: compliances 6e6 apart on the grid."""
    heights = np.minimum(np.random.default_rng(0).standard_normal((12, 14)), 0.5) * 1e-6
    layers = [asp.Layer(asp.Elastic(3.9e11, 0.45), 1e-3), asp.Layer(asp.Elastic(1.1e6, 0.2), 7e-5)]
    surface = asp.Surface(heights, 8e-6, 2.4e-5, periodic=True)
    return asp.ContactProblem(surface, asp.Layered(layers, asp.RigidBase()))


def layered(seed: int) -> tuple[asp.ContactProblem, asp.MeanPressure]:
    """Moduli over six decades, thickness over four, on soft, stiff and rigid bases; half of them
    stiff plates on something soft."""
    rng = np.random.default_rng([seed, 41])
    shape = int(rng.integers(4, 25)), int(rng.integers(4, 25))
    rough = rng.standard_normal(shape)
    heights = 1e-6 * (rough if rng.random() < 0.5 else np.minimum(rough, rng.uniform(-0.5, 1.0)))
    moduli, thickness = 10.0 ** rng.uniform(6.0, 12.0, 2), 10.0 ** rng.uniform(-7.0, -3.0, 2)
    if rng.random() < 0.5:
        moduli, thickness = np.sort(moduli)[::-1], np.sort(thickness)[::-1]
    layers = [asp.Layer(asp.Elastic(float(E), 0.3), float(t)) for E, t in zip(moduli, thickness, strict=True)]
    base = asp.RigidBase() if rng.random() < 0.4 else asp.Elastic(float(10.0 ** rng.uniform(6.0, 12.0)), 0.3)
    spacing, free = 10.0 ** rng.uniform(-6.5, -4.5), bool(rng.random() < 0.3)
    surface = asp.Surface(heights, spacing, spacing * float(rng.choice([0.5, 1.0, 3.0])), periodic=not free)
    boundary = asp.Free() if free else asp.Periodic()
    return asp.ContactProblem(surface, asp.Layered(layers, base), boundary=boundary), asp.MeanPressure(
        float(10.0 ** rng.uniform(0.0, 8.0))
    )


def errors(problem: asp.ContactProblem, control: asp.MeanPressure) -> tuple[float, float, float]:
    """Of the largest pressure, of all pressures in the L2 norm, and the most that both certificates
    allow of the latter."""
    found = asp.solve(problem, control)
    close = asp.solve(problem, control, solver=CLOSE, on_failure="return")
    p, right = found.pressure, close.pressure
    stated = found.certificate.pressure_error * np.linalg.norm(p) + close.certificate.pressure_error * np.linalg.norm(
        right
    )
    norm = float(np.linalg.norm(right))
    return abs(p.max() - right.max()) / right.max(), float(np.linalg.norm(p - right)) / norm, float(stated) / norm


def test_a_stiff_plate_on_a_soft_layer_has_the_right_pressures() -> None:
    largest, whole, stated = errors(stiff_plate(), asp.MeanPressure(1.0))
    assert max(largest, whole) <= ALLOWED
    assert whole <= stated <= 0.1


def test_a_loose_solution_of_it_states_its_error() -> None:
    """Without asking for more, the energy is right to 5e-7 and the largest pressure wrong by 3 %:
    the bound shows it."""
    problem = stiff_plate()
    operator = prepare_operator(problem.compliance, problem.grid, problem.boundary)
    qp = ContactQP(operator, problem.profile(), np.inf, FixedMean(1.0), float(problem.profile().std()))
    loose, close = (run(ActiveSet(tolerance=tolerance), qp).state for tolerance in (1e-7, 1e-12))
    gap = loose.error * loose.pressure.sum() * qp.height_scale
    error = float(np.linalg.norm(loose.pressure - close.pressure) / np.linalg.norm(loose.pressure))
    assert 0.01 < error <= pressure_error(qp, loose.pressure, gap)


def assert_layered_pressures_are_right(seeds: range) -> None:
    for seed in seeds:
        largest, whole, stated = errors(*layered(seed))
        assert max(largest, whole) <= ALLOWED, seed
        assert whole <= stated + 1e-12, seed


def test_pressures_on_layered_bodies_are_within_what_is_stated() -> None:
    assert_layered_pressures_are_right(range(12))


@pytest.mark.slow
def test_pressures_on_many_layered_bodies_are_within_what_is_stated() -> None:
    assert_layered_pressures_are_right(range(12, 150))


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=lambda b: b.name)
@pytest.mark.parametrize("seed", range(8))
def test_the_least_compliance_is_below_every_eigenvalue(seed: int, boundary: asp.Periodic | asp.Free) -> None:
    problem, _ = layered(seed)
    grid = asp.Grid((7, 9), problem.grid.spacing)
    operator = prepare_operator(problem.compliance, grid, boundary)
    values = np.linalg.eigvalsh(operator.matrix())
    least = values[1] if operator.zero_mean_mode else values[0]
    assert 0.3 * least <= operator.smallest <= least * (1.0 + 1e-6)
