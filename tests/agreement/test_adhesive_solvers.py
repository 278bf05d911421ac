"""The adhesive solver against a dense bound-constrained method; its energy falls, its states
restart, couplings agree."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from adhesive_cases import APPROACH, BODY, E_STAR, FORCE, LENGTH, RADIUS, WORK, sphere, strength_of
from refusals import refused

import asperity as asp
from asperity.contact.operators import prepare_operator
from asperity.contact.solvers.protocol import FixedOffset
from asperity.core.errors import InputError, NoSolutionError
from asperity.physics.adhesion.law import (
    CustomAdhesion,
    DugdaleAdhesion,
    ExponentialAdhesion,
    LennardJonesAdhesion,
    LinearAdhesion,
    VanDerWaalsAdhesion,
)
from asperity.physics.adhesion.loop import adhesion_cycle, adhesion_loop
from asperity.physics.adhesion.solver.dense import adhesive_gap
from asperity.physics.adhesion.solver.problem import AdhesiveProblem
from asperity.physics.adhesion.solver.solver import MajoriseMinimise

RANGE = WORK / strength_of(1.0)
EXPONENTIAL = ExponentialAdhesion(WORK, RANGE)
OWN = CustomAdhesion(EXPONENTIAL.attraction, EXPONENTIAL.energy, EXPONENTIAL.slope, far=40.0 * RANGE)
LAWS = (EXPONENTIAL, LinearAdhesion(WORK, RANGE), VanDerWaalsAdhesion(WORK, 2.0 * RANGE), OWN)


def rough(points: int, seed: int, boundary: object, layered: bool = False) -> asp.ContactProblem:
    """Random heights on a few waves, so that contact and attraction are spread over the grid."""
    generator = np.random.default_rng(seed)
    x = np.arange(points) / points
    heights = np.zeros((points, points))
    for m, n in ((1, 0), (0, 1), (1, 1), (2, 1), (1, 2)):
        phase = generator.uniform(0.0, 2.0 * np.pi)
        heights += generator.normal() * np.cos(2.0 * np.pi * (m * x[:, None] + n * x[None, :]) + phase) / (m + n)
    surface = asp.Surface(1.5 * APPROACH * heights, 6.0 * LENGTH / points)
    body = asp.Layered([asp.Layer(BODY, 2.0 * LENGTH)], asp.RigidBase()) if layered else BODY
    return asp.ContactProblem(surface, body, boundary=boundary, adhesion=EXPONENTIAL)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
@pytest.mark.parametrize("boundary", [asp.Free(), asp.Periodic()], ids=["free", "periodic"])
def test_dense_quasi_newton_finds_the_same_gap(law, boundary):
    problem = rough(16, 3, boundary, layered=True)
    operator = prepare_operator(problem.compliance, problem.grid, problem.boundary)
    profile = problem.profile()
    posed = AdhesiveProblem(operator, profile, law, FixedOffset(float(profile.max()) - 0.4 * APPROACH))
    found = MajoriseMinimise(tolerance=1e-9).solve(posed, np.zeros(profile.shape))
    assert found.status.converged
    assert found.newton_steps or found.steps < 30
    gap = adhesive_gap(posed, 1.02 * found.state.gap + 0.02 * law.range)
    # the energy is quadratic about its minimum: gradients to 1e-12 are gaps to 1e-6 of the range
    assert found.state.gap == pytest.approx(gap, abs=3e-5 * law.range)
    assert (gap > 0.0).any()
    assert (found.state.gap == 0.0).any()


@pytest.mark.parametrize("law", [*LAWS, DugdaleAdhesion(WORK, RANGE, smoothing=0.0)], ids=lambda law: law.name)
def test_energy_never_rises(law):
    problem = rough(32, 5, asp.Free())
    operator = prepare_operator(problem.compliance, problem.grid, problem.boundary)
    profile = problem.profile()
    for newton in (True, False):
        posed = AdhesiveProblem(operator, profile, law, FixedOffset(float(profile.max()) - 0.2 * APPROACH))
        found = MajoriseMinimise(newton=newton).solve(posed, np.zeros(profile.shape))
        assert found.status.converged
        assert np.diff(found.energies).max() <= 1e-12 * abs(found.energy)


def test_newton_reaches_the_same_state_in_fewer_steps():
    problem = sphere(64, 6.0, ExponentialAdhesion(WORK, WORK / strength_of(1.5)))
    operator = prepare_operator(problem.compliance, problem.grid, problem.boundary)
    profile = problem.profile()
    steps = {}
    states = {}
    for newton in (True, False):
        posed = AdhesiveProblem(operator, profile, problem.adhesion, FixedOffset(float(profile.max()) + 0.3 * APPROACH))
        start = problem.adhesion.attraction(profile.max() - profile)
        found = MajoriseMinimise(tolerance=1e-8, newton=newton).solve(posed, start)
        steps[newton], states[newton] = found.steps, found.state
    assert steps[True] < 0.6 * steps[False]
    assert states[True].gap == pytest.approx(states[False].gap, abs=1e-6 * problem.adhesion.range)


@pytest.mark.parametrize("boundary", [asp.Free(), asp.Periodic()], ids=["free", "periodic"])
def test_history_goes_on_from_its_state(boundary):
    problem = rough(24, 7, boundary)
    controls = adhesion_cycle(-1.5 * APPROACH, 0.5 * APPROACH, steps=4)
    whole = asp.solve(problem, asp.History(controls))
    first = asp.solve(problem, asp.History(controls[:4]))
    rest = asp.solve(problem, asp.History(controls[4:]), state=first.state)
    assert rest.external_force == pytest.approx(whole.external_force[4:], rel=1e-5, abs=1e-6 * FORCE)
    assert rest.last.adhesion.jumps == whole.last.adhesion.jumps


def test_a_smooth_branch_loses_nothing_and_its_work_is_known_whatever_the_step():
    """Stiff bodies approach on one branch: the trapezoidal rule, whose error falls with the square
    of the step, tends to the work found."""
    problem = sphere(32, 8.0, ExponentialAdhesion(WORK, WORK / strength_of(0.3)))
    rules, works, errors = [], [], []
    for steps in (8, 16):
        way = adhesion_cycle(-2.0 * APPROACH, APPROACH, steps=steps)[: steps + 1]
        loop = adhesion_loop(asp.solve(problem, asp.History(way)).steps)
        assert not loop.jumped.any()
        assert loop.hysteresis == pytest.approx(0.0, abs=1e-12 * abs(loop.work).max())
        rules.append(np.trapezoid(loop.force, loop.approach))
        works.append(loop.work[-1])
        errors.append(loop.hysteresis_error)
    assert works[0] == pytest.approx(works[1], rel=1e-6)
    missed = np.abs(np.array(rules) - works[1])
    assert missed[1] < 0.35 * missed[0]
    assert missed[0] > 0.002 * abs(works[1])
    assert missed[1] < 0.002 * abs(works[1])
    assert errors[0] >= missed[0] * (1.0 - 1e-5)


@pytest.mark.slow
def test_compliant_sphere_jumps_and_loses_what_the_cycle_takes():
    problem = sphere(96, 5.0, ExponentialAdhesion(WORK, WORK / strength_of(2.0)))
    solved = asp.solve(problem, asp.History(adhesion_cycle(-1.2 * APPROACH, 0.0, steps=12)))
    loop, balance = adhesion_loop(solved.steps), solved.energies
    assert loop.jumped.sum() == 2
    assert balance.jump_work[-1] == pytest.approx(loop.hysteresis, rel=1e-9)
    assert balance.relative_error < 1e-9
    assert loop.hysteresis > 0.03 * WORK * LENGTH**2
    assert loop.margin.min() > 0.0
    assert abs(np.trapezoid(loop.force, loop.approach) - loop.hysteresis) <= loop.hysteresis_error


COUPLED = {
    "hardness": {"law": asp.Hardness(0.12 * E_STAR)},
    "sliding": {"friction": asp.Coulomb(0.3, coupled=True)},
    "both": {"law": asp.Hardness(0.12 * E_STAR), "friction": asp.Coulomb(0.3, coupled=True)},
}


@pytest.mark.parametrize("more", COUPLED.values(), ids=COUPLED)
def test_other_couplings_join(more):
    problem = sphere(24, 6.0, EXPONENTIAL, **more)
    for control in (asp.Force(FORCE), asp.FixedGrips(0.5 * APPROACH)):
        found = asp.solve(problem, control)
        assert found.converged
        if isinstance(control, asp.Force):
            assert found.external_force == pytest.approx(FORCE, rel=1e-9)
        else:
            assert found.approach == pytest.approx(0.5 * APPROACH, rel=1e-5)
        attraction = EXPONENTIAL.attraction(found.gap)
        assert found.adhesion.attraction == pytest.approx(attraction, abs=2e-5 * EXPONENTIAL.strength)


def test_a_film_of_liquid_joins_at_a_position():
    film = asp.LiquidFilm.of(asp.liquid("water"), 0.6 * APPROACH)
    problem = sphere(48, 6.0, EXPONENTIAL, film=film)
    held = asp.solve(problem, asp.FixedGrips(0.5 * APPROACH))
    assert held.converged
    pulled = held.adhesion.attractive_force + held.menisci.meniscus_force
    assert held.menisci.meniscus_force > 0.0
    assert held.external_force == pytest.approx(held.force - pulled, rel=1e-9)


WET = {
    "pixels of a coarse sphere": (sphere(24, 6.0, EXPONENTIAL), 0.6, 2.0),
    "rounds that end at 11 for 8": (rough(32, 1, asp.Free()), 0.2, 8.0),
    "rounds that end at 1.1 for 0.5": (rough(32, 2, asp.Periodic()), 0.6, 0.5),
    "pulled": (rough(24, 1, asp.Periodic()), 0.6, -3.0),
}


@pytest.mark.parametrize(("dry", "thickness", "load"), WET.values(), ids=WET)
def test_attraction_menisci_and_force_add_up(dry, thickness, load):
    """The force wanted is met, and at the approach found the contact held there bears it but for
    pixels of liquid."""
    film = asp.LiquidFilm(surface_tension=0.0728, thickness=thickness * APPROACH)
    problem = replace(dry, film=film)
    control = asp.Force(load * FORCE) if load > 0.0 else asp.contact.Pull(-load * FORCE)
    loaded = asp.solve(problem, control)
    pulled = loaded.adhesion.attractive_force + loaded.menisci.meniscus_force
    error = 1e-4 * max(abs(load) * FORCE, loaded.menisci.meniscus_force)
    assert loaded.force - pulled == pytest.approx(load * FORCE, abs=error)
    assert loaded.external_force == pytest.approx(load * FORCE, abs=error)
    held = asp.solve(problem, asp.FixedGrips(loaded.approach), state=loaded.state)
    assert held.adhesion.external_force == pytest.approx(loaded.adhesion.external_force, abs=error)
    counted = film.suction * problem.grid.pixel_area * np.count_nonzero(loaded.menisci.wetting.menisci)
    assert held.menisci.meniscus_force == pytest.approx(counted, rel=1e-9)
    # part of the pixels that come or go there: eight by symmetry on the sphere
    assert abs(counted - loaded.menisci.meniscus_force) <= 8.0 * film.suction * problem.grid.pixel_area
    filled = film.suction * problem.grid.pixel_area * float(loaded.menisci.wetting.filled.sum())
    assert loaded.menisci.meniscus_force == pytest.approx(filled, rel=1e-12)
    assert loaded.certificate.load_imbalance <= 1e-4


def test_a_machine_feels_the_menisci():
    film = asp.LiquidFilm(surface_tension=0.02, thickness=0.6 * APPROACH)
    problem = replace(rough(24, 1, asp.Periodic()), film=film)
    stiffness = FORCE / APPROACH
    found = asp.solve(problem, asp.FixedGrips(2.0 * APPROACH, stiffness))
    assert found.menisci.meniscus_force > 0.5 * FORCE
    error = 1e-4 * found.menisci.meniscus_force
    assert found.external_force == pytest.approx(stiffness * (2.0 * APPROACH - found.approach), abs=error)


def test_a_pull_beyond_attraction_and_menisci_is_refused():
    problem = replace(rough(24, 1, asp.Periodic()), film=asp.LiquidFilm(surface_tension=0.02, thickness=APPROACH))
    with refused(NoSolutionError, "force", f"{-30.0 * FORCE:.6g}"):
        asp.solve(problem, asp.contact.Pull(30.0 * FORCE))


def test_stick_and_slip_joins():
    problem = sphere(24, 6.0, EXPONENTIAL, friction=asp.Coulomb(0.3))
    found = asp.solve(problem, asp.Step(asp.Force(FORCE), asp.Shift(1e-8)))
    assert found.converged
    assert found.stick_slip.force_x > 0.0


def test_line_contact_pulls_off():
    """Exponential law and a cylinder: JKR's -3(πE*w²R/16)^(1/3) is met from below, for the zone has
    a width."""
    length = (RADIUS**2 * WORK / E_STAR) ** (1.0 / 3.0)
    n, size = 256, 12.0 * length
    x = (np.arange(n) - 0.5 * (n - 1)) * size / n
    surface = asp.Surface((-(x**2) / (2.0 * RADIUS))[:, None], size / n, 1.0)
    law = ExponentialAdhesion.of_strength(WORK, 3.0 * (E_STAR**2 * WORK / RADIUS) ** (1.0 / 3.0))
    problem = asp.ContactProblem(surface, BODY, boundary=asp.FreeLine(), adhesion=law)
    jkr = 3.0 * (np.pi * E_STAR * WORK**2 * RADIUS / 16.0) ** (1.0 / 3.0)
    history = asp.History([asp.Unloaded(), asp.contact.Pull(0.5 * jkr), asp.contact.Pull(0.9 * jkr)])
    assert asp.solve(problem, history).converged
    with refused(NoSolutionError, "Step 4 of the history: force"):
        asp.solve(problem, asp.History([*history, asp.contact.Pull(1.15 * jkr)]))


def test_what_adhesion_does_not_bear_is_refused():
    problem = sphere(16, 6.0, EXPONENTIAL)
    with refused(NoSolutionError, "force"):
        asp.solve(problem, asp.contact.Pull(3.0 * FORCE))
    dry = sphere(16, 6.0, EXPONENTIAL, adhesion=None)
    for control in (asp.contact.Pull(FORCE), asp.FixedGrips(APPROACH)):
        with refused(InputError, "control of a problem without adhesion"):
            asp.solve(dry, control)
    with refused(InputError, "law of a contact with the adhesion Lennard-Jones 3-9"):
        sphere(16, 6.0, LennardJonesAdhesion(WORK, RANGE), law=asp.Hardness(1e5))
    with refused(InputError, "problem of the result"):
        asp.solve(dry, asp.Force(FORCE)).require_adhesion()
    with refused(NoSolutionError, "approach"):
        asp.solve(rough(16, 3, asp.Periodic()), asp.FixedGrips(1.0))


def test_unresolved_zone_is_said_with_the_pixel_needed():
    found = asp.solve(sphere(16, 6.0, ExponentialAdhesion(WORK, WORK / strength_of(4.0))), asp.Force(FORCE))
    assert not found.adhesion.resolved
    assert repr(found.adhesion).startswith("<AdhesiveContact: exponential, attractive force")
    assert "exponential, 50 mJ/m²" in repr(found)
    assert found.adhesion.needed_pixel == pytest.approx(found.adhesion.cohesive_length / 5.0)


def test_results_and_histories_are_saved_and_go_on(tmp_path):
    problem = rough(16, 7, asp.Free())
    controls = adhesion_cycle(-APPROACH, 0.5 * APPROACH, steps=3)
    whole = asp.solve(problem, asp.History(controls))
    first = asp.solve(problem, asp.History(controls[:4]))
    for number, result in enumerate((first, first.last)):
        path = tmp_path / f"{number}.nc"
        asp.save(result, path)
        loaded = asp.load(path)
        last = loaded.last if number == 0 else loaded
        assert last.adhesion.law == problem.adhesion
        assert last.adhesion.margin == first.last.adhesion.margin
        rest = asp.solve(problem, asp.History(controls[4:]), state=loaded.state)
        assert rest.external_force == pytest.approx(whole.external_force[4:], rel=1e-5, abs=1e-6 * FORCE)


def test_balance_of_a_history_counts_the_interface():
    problem = sphere(32, 8.0, ExponentialAdhesion(WORK, WORK / strength_of(0.3)))
    solved = asp.solve(problem, asp.History(adhesion_cycle(-APPROACH, APPROACH, steps=8)))
    on = asp.solve(problem, asp.History(adhesion_cycle(-APPROACH, APPROACH, steps=8)[1:]), state=solved.steps[0].state)
    loop, balance = adhesion_loop(solved.steps), on.energies
    work = loop.work[-1] - loop.work[1]
    assert balance.external_work[-1] == pytest.approx(work, abs=1e-6 * abs(loop.work).max())
