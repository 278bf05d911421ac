"""Adhesion of infinitely short range on a grid: JKR's sphere, Johnson's wave, coated spheres, and
the compliance of a step of the edge."""

from __future__ import annotations

import math

import numpy as np
import pytest
from adhesive_cases import APPROACH, BODY, E_STAR, FORCE, LENGTH, RADIUS, WORK, sphere
from reference_data import reference
from refusals import refused

import asperity as asp
from asperity.contact.operators import prepare_operator
from asperity.core.errors import InputError, NoSolutionError
from asperity.physics.adhesion.solver.front import step_compliance
from asperity.solids.compliance.halfspace import contact_compliance
from asperity.theories.adhesion.short_range import PowerLawJKR, WavyJKR

LAW = asp.adhesion.JKRAdhesion(WORK)
THEORY = PowerLawJKR(E_STAR, 2.0, 0.5 / RADIUS, WORK)
SIZE = 4.2


def parted(problem: asp.ContactProblem, approaches: object) -> asp.HistoryResult:
    """History of rigid grips at these approaches over APPROACH."""
    return asp.solve(problem, asp.History([asp.FixedGrips(float(d) * APPROACH) for d in approaches]))


@pytest.mark.slow
def test_pull_off_of_a_sphere_converges_with_the_first_order():
    """Pixels in the radius times relative error is 1.6 to 1.7 from 7 to 52 pixels on; what the
    order leaves is below 1 %."""
    found = {}
    for points in (48, 96):
        loop = parted(sphere(points, SIZE, LAW), [0.2, *np.linspace(0.0, -0.9, 31)])
        found[points] = -min(loop.external_force) / FORCE
        pixels = (1.5 ** (1.0 / 3.0)) / SIZE * points
        assert 1.0 < (found[points] / 1.5 - 1.0) * pixels < 2.0
    assert 2.0 * found[96] - found[48] == pytest.approx(1.5, rel=0.01)


def test_edge_of_a_growing_contact_is_that_of_jkr():
    loop = parted(sphere(96, 5.0, LAW), np.linspace(-0.1, 1.0, 6))
    last = loop.last
    radius = math.sqrt(last.area_fraction * last.problem.grid.area / math.pi)
    exact = THEORY.at_radius(radius)
    # one pixel in the radius of 34
    assert exact.approach == pytest.approx(APPROACH, abs=2.0 / 34.0 * APPROACH)
    assert last.external_force == pytest.approx(exact.load, abs=0.05 * FORCE)
    assert last.adhesion.resolved
    assert last.adhesion.spot_radius == pytest.approx(radius, rel=1e-12)
    assert 0.0 < last.adhesion.margin < 1.0


def test_contact_that_does_not_close_by_itself_approaches_as_without_adhesion():
    sticky, dry = sphere(48, SIZE, asp.adhesion.JKRAdhesion(WORK, closes=False)), sphere(48, SIZE, LAW, adhesion=None)
    found, plain = (asp.solve(problem, asp.Approach(APPROACH)) for problem in (sticky, dry))
    assert found.external_force == pytest.approx(plain.force, rel=1e-6)
    loop = parted(sticky, [1.2, *np.linspace(0.8, -0.9, 31)])
    closing = parted(sphere(48, SIZE, LAW), [0.2, *np.linspace(0.0, -0.9, 31)])
    assert min(loop.external_force) == pytest.approx(min(closing.external_force), rel=0.05)


def test_edges_lose_energy_and_never_gain_it():
    solved = parted(sphere(48, SIZE, LAW), [-0.1, 0.1, *np.linspace(0.0, -1.1, 23)])
    lost = np.array([step.adhesion.dissipated for step in solved.steps])
    assert lost.min() > -1e-3 * lost.max()
    loop = asp.adhesion.adhesion_loop(solved.steps)
    assert loop.work[-1] == pytest.approx(loop.hysteresis, rel=1e-9)
    assert loop.jumped[1]
    areas = np.array([step.area_fraction for step in solved.steps])
    assert areas[-1] == 0.0
    assert loop.jumped[np.flatnonzero(areas)[-1] + 1]


def wave(alpha: float, points: int) -> tuple[asp.ContactProblem, float]:
    """Periodic line, and p* in Pa."""
    length, amplitude = 1e-4, 1e-6
    full = math.pi * E_STAR * amplitude / length
    x = (np.arange(points) + 0.5) / points - 0.5
    surface = asp.Surface((amplitude * (np.cos(2.0 * np.pi * x) - 1.0))[:, None], length / points, 1.0)
    law = asp.adhesion.JKRAdhesion(alpha**2 * length * full**2 / (2.0 * E_STAR))
    return asp.ContactProblem(surface, BODY, adhesion=law), full


@pytest.mark.parametrize("alpha", [0.2, 0.4])
def test_wave_jumps_into_full_contact_where_johnson_says(alpha):
    problem, full = wave(alpha, 128)
    _, jump = WavyJKR(alpha).stationary
    pressure = WavyJKR(alpha).mean_pressure(jump) * full
    loads = pressure * np.array([0.6, 0.8, 0.95, 0.98, 1.02])
    areas = [step.area_fraction for step in asp.solve(problem, asp.History([asp.MeanPressure(p) for p in loads])).steps]
    assert areas[-1] == 1.0
    # two pixels of 128 is one step of both edges
    assert areas[-2] < jump + 2.0 / 128.0


def test_wave_pulls_off_where_johnson_says():
    theory = WavyJKR(0.2)
    off = theory.stationary[0]
    errors = []
    for points in (64, 128):
        problem, full = wave(0.2, points)
        steps = theory.approach(off) + np.concatenate([[0.3], np.linspace(0.15, -0.05, 21)])
        loop = asp.solve(problem, asp.History([asp.FixedGrips(float(d) * 1e-6) for d in steps]))
        force = -min(loop.external_force) / problem.grid.area / full
        errors.append(force / -theory.mean_pressure(off) - 1.0)
    assert 0.0 < errors[1] < 0.6 * errors[0] < 0.1


def test_flat_wave_closes_by_itself():
    """Without load from α = (27/256)^(1/4) = 0.570 on; a sixteenth more and less."""
    areas = [asp.solve(wave(alpha, 64)[0], asp.Unloaded()).area_fraction for alpha in (0.53, 0.61)]
    assert areas[0] < 0.85
    assert areas[1] == 1.0


def test_pull_off_of_a_coated_sphere():
    row = next(row for row in reference("adhesion/jkr_coated_pulloff") if row["E1_over_E2"] == 10.0 and row["h"] == 0.1)
    points, side = 64, 1.0
    body = asp.Layered([asp.Layer(asp.Elastic(10.0, row["nu1"]), 0.1)], asp.Elastic(1.0, row["nu2"]))
    x = (np.arange(points) - 0.5 * (points - 1)) * side / points
    surface = asp.Surface(-(x[:, None] ** 2 + x[None, :] ** 2) / 2.0, side / points)
    problem = asp.ContactProblem(surface, body, boundary=asp.Free(), adhesion=asp.adhesion.JKRAdhesion(row["w"]))
    at = row["delta_at_pulloff"]
    steps = [0.1 * abs(at), *(at * (1.0 - step) for step in (0.4, *np.linspace(0.2, -0.4, 13)))]
    found = -min(asp.solve(problem, asp.History([asp.FixedGrips(d) for d in steps])).external_force)
    pixels = row["a_pulloff"] / side * points
    assert 0.0 < (found / -row["P_pulloff"] - 1.0) * pixels < 2.5


def test_step_compliance_of_a_half_space():
    """⟨ln q⟩ over a line is ln(π/Δx) - 1, over a square ln(π/Δx) - (3 - ln 2 - π/2)/2."""
    compliance, pixel = contact_compliance(BODY, asp.Rigid()), 1e-7
    line = prepare_operator(compliance, asp.Surface(np.zeros((4096, 1)), pixel, 1.0).grid, asp.Periodic())
    assert step_compliance(line) == pytest.approx(2.0 * math.e / math.pi * pixel / E_STAR, rel=1e-3)
    square = prepare_operator(compliance, asp.Surface(np.zeros((512, 512)), pixel).grid, asp.Periodic())
    exact = 2.0 / math.pi * math.exp(0.5 * (3.0 - math.log(2.0) - 0.5 * math.pi)) * pixel / E_STAR
    assert step_compliance(square) == pytest.approx(exact, rel=1e-4)


@pytest.mark.parametrize("boundary", [asp.Free(), asp.Periodic()], ids=["free", "periodic"])
def test_step_compliance_is_that_of_a_point_at_a_step(boundary):
    """One over the diagonal of the inverse of the compliances of half a grid and a part of its last
    row, by dense algebra."""
    n = 24
    operator = prepare_operator(
        contact_compliance(BODY, asp.Rigid()), asp.Surface(np.zeros((n, n)), 1e-7, 1.4e-7).grid, boundary
    )
    matrix = operator.matrix()
    if operator.zero_mean_mode:
        matrix = matrix + 1e3 * matrix.max()  # a stiff mean: points move against each other
    points = np.arange(n * n).reshape(n, n)
    closed = np.concatenate([points[: n // 2].ravel(), points[n // 2, : n // 2]])
    inverse = np.linalg.inv(matrix[np.ix_(closed, closed)])
    assert step_compliance(operator) == pytest.approx(1.0 / inverse[-1, -1], rel=0.02)


def test_loads_and_what_is_refused():
    problem = sphere(48, SIZE, LAW)
    assert asp.solve(problem, asp.History([asp.Unloaded(), asp.contact.Pull(1.4 * FORCE)])).converged
    with refused(NoSolutionError, "Step 2 of the history: force"):
        asp.solve(problem, asp.History([asp.Unloaded(), asp.contact.Pull(1.9 * FORCE)]))
    with refused(InputError, "work of adhesion (J/m^2)"):
        asp.adhesion.JKRAdhesion(0.0)


def test_other_couplings_join_and_states_go_on(tmp_path):
    problem = sphere(24, SIZE, LAW, law=asp.Hardness(0.3 * E_STAR), friction=asp.Coulomb(0.3, coupled=True))
    controls = [asp.FixedGrips(0.2 * APPROACH), asp.FixedGrips(-0.2 * APPROACH)]
    whole = asp.solve(problem, asp.History(controls))
    assert whole.converged
    asp.save(asp.solve(problem, controls[0]), tmp_path / "first.nc")
    loaded = asp.load(tmp_path / "first.nc")
    assert loaded.adhesion.law == LAW
    assert loaded.adhesion.spot_radius > 0.5 * LENGTH
    rest = asp.solve(problem, controls[1], state=loaded.state)
    assert rest.external_force == pytest.approx(whole.last.external_force, rel=1e-3)
