"""Contacts without a wall: Lennard-Jones spheres, an own law with a core, and an independent
minimum of the energy."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference_data import every_row, reference
from refusals import refused

import asperity as asp
from asperity.contact.operators import prepare_operator
from asperity.contact.solvers.protocol import FixedOffset
from asperity.core.errors import InputError, NoSolutionError
from asperity.physics.adhesion.solver.dense import adhesive_gap
from asperity.physics.adhesion.solver.problem import AdhesiveProblem
from asperity.physics.adhesion.solver.soft_core import SoftCoreNewton

SPACING, BODY = 1e-4, asp.Elastic(0.91, 0.3)
"""z0 over the radius of the sphere; E* = 1, R = 1."""

ROWS = [row for row in reference("adhesion/lennard_jones_pulloff") if row["tabor_mu"] <= 2.0]
GRIDS = {0.2: (32, 8.0), 0.3: (32, 8.0), 1.0: (64, 6.0), 2.0: (144, 4.8)}
"""Points along a side, and half of the side over (R z0)^(1/2)."""


def work_of(tabor: float) -> float:
    """w of Tabor's parameter (R w²/E*² z0³)^(1/3)."""
    return math.sqrt(tabor**3 * SPACING**3)


def sphere(attraction: asp.adhesion.Adhesion, points: int, half: float, **more: object) -> asp.ContactProblem:
    size = 2.0 * half * math.sqrt(SPACING)
    x = (np.arange(points) - 0.5 * (points - 1)) * size / points
    surface = asp.Surface(-(x[:, None] ** 2 + x[None, :] ** 2) / 2.0, size / points)
    settings = {"body": BODY, "boundary": asp.Free(), "adhesion": attraction} | more
    return asp.ContactProblem(surface, **settings)  # type: ignore[arg-type]


def beyond(law: asp.adhesion.Adhesion, half: float, approach: float) -> float:
    """Force of the attraction outside the square, where the sphere hardly deforms, over πwR."""
    angle = (np.arange(200) + 0.5) / 200.0 * 0.25 * math.pi
    border = half * math.sqrt(SPACING) / np.cos(angle)
    energy = law.energy(SPACING - approach + 0.5 * border**2)
    return 2.0 * float(energy.mean()) / law.work


@pytest.mark.slow
@every_row(ROWS, label=lambda row: f"tabor {row['tabor_mu']:g}")
def test_pull_off_of_lennard_jones_spheres(row):
    tabor = row["tabor_mu"]
    points, half = GRIDS[tabor]
    law = asp.adhesion.LennardJonesAdhesion(work_of(tabor), SPACING)
    problem = sphere(law, points, half)
    start = {0.2: 0.0, 0.3: 0.0, 1.0: -0.5, 2.0: -0.5}[tabor]
    approaches = SPACING * np.concatenate(
        [[start + 0.5], np.arange(start, start - 1.4 * tabor - 0.3, -max(0.1 * tabor, 0.04))]
    )
    found = asp.solve(problem, asp.History([asp.FixedGrips(float(d)) for d in approaches]))
    assert (
        found.last.adhesion.resolved or tabor < 1.0
    )  # 32 points are fewer than it asks for; the force is compared all the same
    forces = [
        step.external_force / (math.pi * law.work) + beyond(law, half, float(d))
        for d, step in zip(approaches, found.steps, strict=True)
    ]
    assert -min(forces) == pytest.approx(row["minus_P_pulloff_norm"], rel=3e-3)


def test_sphere_jumps_in_and_off_where_the_reference_says():
    row = next(row for row in ROWS if row["tabor_mu"] == 1.0)
    problem = sphere(asp.adhesion.LennardJonesAdhesion(work_of(1.0), SPACING), 96, 5.0)
    for ends, event in (((-1.72, -1.54), "delta_jump_in_over_z0"), ((-1.65, -1.83), "delta_jump_off_over_z0")):
        first = [-2.2] if ends[1] > ends[0] else [-1.0]
        way = np.array([*first, *np.linspace(*ends, 19)])
        found = asp.solve(problem, asp.History([asp.FixedGrips(float(d) * SPACING) for d in way]))
        change = np.abs(np.diff(found.external_force))
        jump = int(np.argmax(change[1:])) + 1
        middle = 0.5 * (way[jump] + way[jump + 1])
        # steps of 0.01, and a box whose far field is missing
        assert middle == pytest.approx(row[event], abs=0.02)


def test_rigid_sphere_pulls_as_bradley():
    law = asp.adhesion.LennardJonesAdhesion(work_of(0.2), SPACING)
    half = 10.0
    found = asp.solve(sphere(law, 96, half, body=asp.Elastic(1e5, 0.3)), asp.FixedGrips(-0.5 * SPACING))
    nearest = 0.25 * (2.0 * half * math.sqrt(SPACING) / 96) ** 2  # the highest points lie that much below the apex
    exact = 2.0 * float(law.energy(np.array(1.5 * SPACING - nearest))) / law.work
    force = found.external_force / (math.pi * law.work) + beyond(law, half, -0.5 * SPACING)
    assert force == pytest.approx(exact, rel=3e-3)


@pytest.mark.parametrize("boundary", [asp.Free(), asp.Periodic()], ids=["free", "periodic"])
def test_dense_quasi_newton_finds_the_same_gap(boundary):
    law = asp.adhesion.LennardJonesAdhesion(work_of(0.8), SPACING)
    n = 12
    x = np.arange(n) / n
    generator = np.random.default_rng(4)
    heights = sum(
        generator.normal() * np.cos(2.0 * np.pi * (i * x[:, None] + j * x[None, :]) + generator.uniform(0.0, 6.3))
        for i, j in ((1, 0), (0, 1), (1, 1), (2, 1))
    )
    body = asp.Layered([asp.Layer(BODY, 0.02)], asp.RigidBase())
    problem = asp.ContactProblem(asp.Surface(SPACING * heights, 0.004), body, boundary=boundary, adhesion=law)
    operator = prepare_operator(problem.compliance, problem.grid, problem.boundary)
    profile = problem.profile()
    posed = AdhesiveProblem(operator, profile, law, FixedOffset(float(profile.max()) - 0.5 * SPACING))
    found = SoftCoreNewton(tolerance=1e-9).solve(posed, np.zeros(profile.shape))
    assert found.status.converged
    assert np.diff(found.energies).max() <= 1e-12 * abs(found.energies[-1])
    # the margin by dense algebra: the core as springs, the softening points against the rest
    slope = law.slope(found.state.gap).ravel()
    springs = np.diag(np.maximum(slope, 0.0))
    matrix = operator.matrix()
    response = matrix @ np.linalg.inv(np.eye(n * n) + springs @ matrix)
    root = np.sqrt(np.maximum(-slope, 0.0))
    largest = float(np.linalg.eigvalsh(root[:, None] * 0.5 * (response + response.T) * root[None, :])[-1])
    assert SoftCoreNewton().margin(posed, found.state) == pytest.approx(1.0 - largest, abs=1e-3)
    gap = adhesive_gap(posed, 1.01 * found.state.gap)
    assert found.state.gap == pytest.approx(gap, abs=3e-5 * law.range)
    assert (gap < law.spacing).any()
    assert (gap > law.peak).any()


def test_two_flats_lose_their_stability_at_the_longest_wave():
    n, pixel = 16, 1e-3
    law = asp.adhesion.LennardJonesAdhesion(work_of(1.0), SPACING)
    problem = asp.ContactProblem(asp.Surface(np.zeros((n, n)), pixel), BODY, adhesion=law)
    for gap in (1.5, 2.0):
        found = asp.solve(problem, asp.FixedGrips((1.0 - gap) * SPACING))
        eigenvalue = -float(law.slope(np.array(gap * SPACING))) * 2.0 / (2.0 * np.pi / (n * pixel))
        assert found.external_force == pytest.approx(
            -float(law.attraction(np.array(gap * SPACING))) * problem.grid.area, rel=1e-5
        )
        assert found.adhesion.margin == pytest.approx(1.0 - eigenvalue, abs=1e-4)


def own(law: asp.adhesion.LennardJonesAdhesion) -> asp.adhesion.CustomAdhesion:
    return asp.adhesion.CustomAdhesion(law.attraction, law.energy, law.slope, far=30.0 * SPACING, equilibrium=SPACING)


def test_own_law_with_a_core_does_the_same():
    law = asp.adhesion.LennardJonesAdhesion(work_of(1.0), SPACING)
    mine = own(law)
    assert mine.peak == pytest.approx(law.peak, rel=1e-9)
    assert mine.strength == pytest.approx(law.strength, rel=1e-12)
    assert mine.work == pytest.approx(law.work, rel=1e-12)
    assert mine.steepest == pytest.approx(law.steepest, rel=1e-5)
    loads = asp.History([asp.Unloaded(), asp.Force(0.5 * math.pi * law.work)])
    forces = [asp.solve(sphere(each, 32, 6.0), loads).last for each in (law, mine)]
    assert forces[0].approach == pytest.approx(forces[1].approach, rel=1e-9)
    with refused(InputError, "attraction of an adhesion law with a core"):
        asp.adhesion.CustomAdhesion(
            law.attraction, law.energy, law.slope, far=30.0 * SPACING, equilibrium=1.1 * SPACING
        )
    with refused(InputError, "energy of an adhesion law"):
        asp.adhesion.CustomAdhesion(
            law.attraction, lambda g: 1.1 * law.energy(g), law.slope, far=30.0 * SPACING, equilibrium=SPACING
        )
    with refused(InputError, "far gap of the adhesion (m)"):
        asp.adhesion.CustomAdhesion(law.attraction, law.energy, law.slope, far=SPACING, equilibrium=SPACING)


def test_load_position_and_machine_meet_on_one_branch():
    law = asp.adhesion.LennardJonesAdhesion(work_of(1.0), SPACING)
    problem, unit = sphere(law, 48, 6.0), math.pi * law.work
    pulled = asp.solve(problem, asp.History([asp.Unloaded(), asp.contact.Pull(1.5 * unit)])).last
    held = asp.solve(problem, asp.FixedGrips(pulled.approach), state=pulled.state)
    assert held.external_force == pytest.approx(-1.5 * unit, rel=1e-4)
    assert pulled.adhesion.margin < held.adhesion.margin
    stiffness = 20.0 * unit / SPACING
    grips = pulled.approach + pulled.external_force / stiffness
    machine = asp.solve(problem, asp.FixedGrips(float(grips), stiffness), state=pulled.state)
    assert machine.external_force == pytest.approx(-1.5 * unit, rel=1e-4)
    gap = asp.solve(problem, asp.MeanGap(held.mean_gap), state=held.state)
    assert gap.external_force == pytest.approx(-1.5 * unit, rel=1e-3)
    with refused(NoSolutionError, "force"):
        asp.solve(problem, asp.contact.Pull(1.75 * unit), state=pulled.state)
    with refused(InputError, "law of a contact with the adhesion Lennard-Jones 3-9"):
        sphere(law, 16, 6.0, law=asp.Hardness(0.1))


def test_deep_contact_and_states_that_go_on(tmp_path):
    """An approach of hundred spacings at once; friction joins; saved and loaded."""
    law = asp.adhesion.LennardJonesAdhesion(work_of(1.0), SPACING)
    problem = sphere(law, 48, 20.0, friction=asp.Coulomb(0.3, coupled=True))
    deep = asp.solve(problem, asp.FixedGrips(100.0 * SPACING))
    hertz = 4.0 / 3.0 * (100.0 * SPACING) ** 1.5
    assert deep.external_force == pytest.approx(hertz, rel=0.05)
    asp.save(deep, tmp_path / "deep.nc")
    loaded = asp.load(tmp_path / "deep.nc")
    assert loaded.adhesion.law == law
    on = asp.solve(problem, asp.FixedGrips(99.0 * SPACING), state=loaded.state)
    assert on.external_force < deep.external_force


@pytest.mark.parametrize("pressure", [1e-6, 1e-3])
def test_rough_surfaces_that_are_pressed_together_have_an_equilibrium(pressure):
    """However light the load: on the way to it the energy may curve down with the distance, which
    is no sign that the surfaces part."""
    missed = []
    for seed in range(12):
        heights = np.random.default_rng(seed).standard_normal((6, 6))
        for pixels in (2.0, 3.0, 6.0):
            law = asp.adhesion.LennardJonesAdhesion(9.0 * math.sqrt(3.0) / 16.0 / pixels, 1.0)
            problem = asp.ContactProblem(
                asp.Surface(heights, 3.0), asp.Elastic(1.0, 0.0), boundary=asp.Free(), adhesion=law
            )
            found = asp.solve(problem, asp.MeanPressure(pressure))
            adhesion = found.require_adhesion()
            traction = found.pressure - adhesion.attraction
            operator = prepare_operator(problem.compliance, problem.grid, problem.boundary)
            gap = operator.apply(traction) + heights.max() - heights - found.approach + law.spacing
            size = np.maximum(law.strength, np.abs(traction))
            missed.append(float((np.abs(traction + law.attraction(gap)) / size).max()))
            assert traction.mean() == pytest.approx(pressure, rel=1e-6, abs=1e-9 * law.strength)
    assert max(missed) < 1e-5
