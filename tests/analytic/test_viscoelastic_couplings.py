"""Adhesion, friction, menisci and hardness beside creep: limits of the speed, energies, restart,
what is refused."""

from __future__ import annotations

import itertools
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from refusals import refused

import asperity as asp

FIRST, RELAXED = 3e6, 1e6
RUBBER = asp.Viscoelastic.standard_linear(RELAXED, FIRST, 1.0, 0.5)
LAW = asp.ExponentialAdhesion(0.05, 0.25e-6)
PLACES = np.array([0.1, 0.0, -0.1, -0.2, -0.3, -0.4, -0.5, -0.6, -0.75]) * 1e-6
DWELL = asp.Step(asp.FixedGrips(float(PLACES[0])), duration=1e3)
COARSE = asp.TimeSteps(tolerance=5e-3)


def sphere(body: asp.Elastic | asp.Layered, boundary: asp.Free | asp.Periodic = asp.Free()) -> asp.ContactProblem:
    x = (np.arange(32) - 15.5) * 7.5e-7
    surface = asp.Surface(-0.5 * (x[:, None] ** 2 + x**2) / 1e-4, 7.5e-7)
    return asp.ContactProblem(surface, body, boundary=boundary, adhesion=LAW)


def retraction(speed: float) -> list[asp.Step]:
    """Steps to the places at a ``speed`` (m/s), at once if that is infinite."""
    return [
        asp.Step(asp.FixedGrips(float(end)), duration=float(abs(end - start) / speed))
        for start, end in itertools.pairwise(PLACES)
    ]


def pulls(found: asp.HistoryResult) -> np.ndarray:
    return np.array([step.adhesion.external_force for step in found.steps if step.adhesion is not None])


def retracted(body: asp.Elastic, speed: float) -> asp.HistoryResult:
    """Touch at the first place, dwell where the body relaxes, and retraction."""
    start = [asp.FixedGrips(float(PLACES[0]))]
    dwell = [DWELL] if isinstance(body, asp.Viscoelastic) else []
    return asp.solve(sphere(body), asp.History([*start, *dwell, *retraction(speed)]), time_steps=COARSE)


@pytest.mark.slow
def test_slow_retraction_is_that_of_the_relaxed_body() -> None:
    slow, relaxed = retracted(RUBBER, 1e-11), retracted(asp.Elastic(RELAXED, 0.5), np.inf)
    np.testing.assert_allclose(pulls(slow)[1:], pulls(relaxed), atol=5e-3 * np.abs(pulls(relaxed)).max())
    assert slow.energies.relative_error < 0.02


@pytest.mark.slow
def test_machine_that_gives_way_while_the_body_relaxes() -> None:
    """At once and after a long hold forces are those of the elastic contacts of the first and the
    relaxed modulus in the same machine, to the error of the steps."""
    grips = asp.FixedGrips(float(PLACES[0]), 20.0)
    found = asp.solve(sphere(RUBBER), asp.History([grips, asp.Step(grips, duration=1e3)]), time_steps=COARSE)
    for step, modulus in zip(found.steps, (FIRST, RELAXED), strict=True):
        elastic = asp.solve(sphere(asp.Elastic(modulus, 0.5)), grips)
        assert step.external_force == pytest.approx(elastic.external_force, abs=5e-3 * elastic.force)
        assert step.approach == pytest.approx(
            grips.value - step.external_force / grips.stiffness, abs=1e-5 * grips.value
        )


@pytest.mark.slow
def test_retraction_at_once_is_elastic_about_what_has_crept() -> None:
    """After the dwell the retarded displacement stays: an elastic contact of the first modulus of
    surfaces lowered by it."""
    found = retracted(RUBBER, np.inf)
    held = found.steps[1]
    assert held.creep is not None
    # between the dwell and the next step of no length all that is retarded stays as it was
    at_end = found.steps[2].creep
    assert at_end is not None
    frozen = at_end.retarded_displacement
    first = sphere(asp.Elastic(FIRST, 0.5))
    lowered = asp.Surface(first.surface.heights - frozen, first.grid.spacing[0])
    elastic = asp.ContactProblem(lowered, first.body, boundary=asp.Free(), adhesion=LAW)
    shift = float(np.max(first.surface.heights) - np.max(lowered.heights))
    course = asp.History([asp.FixedGrips(float(place - shift)) for place in PLACES])
    expected = asp.solve(elastic, course)
    np.testing.assert_allclose(pulls(found)[1:], pulls(expected), atol=2e-3 * np.abs(pulls(expected)).max())


@pytest.mark.slow
def test_virgin_contact_at_once_is_the_first_elastic_one() -> None:
    body = asp.Elastic(FIRST, 0.5)
    course = asp.History([asp.FixedGrips(float(place)) for place in PLACES])
    found, elastic = (asp.solve(sphere(each), course) for each in (RUBBER, body))
    np.testing.assert_allclose(pulls(found), pulls(elastic), rtol=1e-9)
    for ours, theirs in zip(found.steps, elastic.steps, strict=True):
        assert ours.adhesion is not None
        assert theirs.adhesion is not None
        assert ours.adhesion.elastic_energy == pytest.approx(theirs.adhesion.elastic_energy, rel=1e-6)


@pytest.mark.slow
def test_pull_off_grows_with_the_speed_and_work_is_stored_or_heat() -> None:
    found = [retracted(RUBBER, speed) for speed in (1e-8, 1e-7, 1e-6)]
    off = [float(-pulls(each).min()) for each in found]
    assert off[0] < off[1] < off[2]
    for each in found:
        assert each.energies.relative_error < 0.04
        heat = each.energies.viscous_work
        assert (np.diff(heat) >= 0.0).all()
    assert found[1].energies.viscous_work[-1] > 0.05 * found[1].energies.external_work.max()


@pytest.mark.slow
def test_adhesive_history_goes_on_to_the_bit(tmp_path: Path) -> None:
    course = [asp.FixedGrips(float(PLACES[0])), *retraction(1e-6)[:3]]
    whole = asp.solve(sphere(RUBBER), asp.History(course), time_steps=COARSE)
    first = asp.solve(sphere(RUBBER), asp.History(course[:2]), time_steps=COARSE)
    asp.save(first, tmp_path / "half.nc")
    for state in (first.state, asp.load(tmp_path / "half.nc").state):
        rest = asp.solve(sphere(RUBBER), asp.History(course[2:]), state=state, time_steps=COARSE)
        np.testing.assert_array_equal(rest.last.pressure, whole.last.pressure)
        assert pulls(rest)[-1] == pulls(whole)[-1]


@pytest.mark.parametrize("boundary", [asp.Free(), asp.Periodic()])
def test_adhesion_of_a_viscoelastic_coating(boundary: asp.Free | asp.Periodic) -> None:
    """After a long hold it is that of the relaxed coating."""
    coated, relaxed = (
        asp.Layered([asp.Layer(material, 3e-6)], asp.Elastic(1e8, 0.3))
        for material in (asp.Viscoelastic.standard_linear(1e6, 3e6, 1.0, 0.4), asp.Elastic(1e6, 0.4))
    )
    load = asp.Force(1e-5)
    held = asp.solve(
        sphere(coated, boundary), asp.History([load, asp.Step(load, duration=500.0)]), time_steps=COARSE
    ).last
    end = asp.solve(sphere(relaxed, boundary), load)
    assert held.adhesion is not None
    assert end.adhesion is not None
    assert held.adhesion.attractive_force == pytest.approx(end.adhesion.attractive_force, rel=0.01)
    assert held.contact_area == pytest.approx(end.contact_area, rel=0.05)


def test_adhesion_with_a_core_beside_creep() -> None:
    """Lennard-Jones' law, which has no wall: after a long hold attraction and contact are those of
    the relaxed body."""
    load, law = asp.Force(1e-5), asp.adhesion.LennardJonesAdhesion(0.05, 0.25e-6)
    soft, relaxed = (replace(sphere(body), adhesion=law) for body in (RUBBER, asp.Elastic(RELAXED, 0.5)))
    held = asp.solve(soft, asp.History([load, asp.Step(load, duration=500.0)]), time_steps=COARSE).last
    end = asp.solve(relaxed, load)
    assert held.adhesion is not None
    assert end.adhesion is not None
    assert held.adhesion.attractive_force == pytest.approx(end.adhesion.attractive_force, rel=1e-5)
    assert held.contact_area == pytest.approx(end.contact_area, rel=1e-3)


# Friction, menisci, hardness on a rough body.

GROUND = asp.generate.gaussian(
    asp.Grid((32, 32), (4e-7, 4e-7)),
    asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(0.1), hurst=0.8, rolloff_wavelength=1e-5, shortest_wavelength=2e-6
    ),
    seed=2,
)
SOFT = asp.Viscoelastic.prony(2e6, ((5e6, 0.1), (9e6, 0.01)), 0.3)
COATED = asp.Layered([asp.Layer(SOFT, 2e-6)], asp.Elastic(1e8, 0.3))
LOAD = asp.MeanPressure(1e5)
HOLD = asp.History([LOAD, asp.Step(LOAD, duration=0.05), asp.Step(LOAD, duration=50.0)])


@pytest.mark.parametrize("boundary", [asp.Free(), asp.Periodic()])
def test_shear_of_sliding_creeps_with_the_pressure(boundary: asp.Free | asp.Periodic) -> None:
    """Coupled Coulomb friction: at once as the first elastic body, after a long hold as the relaxed
    one."""
    problem, first, relaxed = (
        asp.ContactProblem(GROUND, body, boundary=boundary, friction=asp.Coulomb(0.5))
        for body in (SOFT, asp.Elastic(16e6, 0.3), asp.Elastic(2e6, 0.3))
    )
    found = asp.solve(problem, HOLD)
    for step, body, allowed in ((found.steps[0], first, 1e-6), (found.last, relaxed, 5e-3)):
        elastic = asp.solve(body, LOAD)
        assert np.abs(step.pressure - elastic.pressure).max() < allowed * elastic.max_pressure
        assert step.sliding is not None
        assert elastic.sliding is not None
        largest = float(np.abs(elastic.sliding.shear_displacement).max())
        np.testing.assert_allclose(
            step.sliding.shear_displacement, elastic.sliding.shear_displacement, atol=allowed * largest
        )


@pytest.mark.parametrize("body", [SOFT, COATED])
@pytest.mark.parametrize("boundary", [asp.Free(), asp.Periodic()])
@pytest.mark.parametrize("thickness", [2e-8, 5e-8])
def test_menisci_beside_creep_find_a_balance(
    body: asp.Elastic | asp.Layered, boundary: asp.Free | asp.Periodic, thickness: float
) -> None:
    """The force counts pixels: where an island comes and goes with it, it lies in the jump."""
    film = asp.LiquidFilm(surface_tension=0.02, thickness=thickness, meniscus_height=2.5 * thickness)
    found = asp.solve(asp.ContactProblem(GROUND, body, boundary=boundary, film=film), HOLD)
    forces = [step.menisci.meniscus_force for step in found.steps if step.menisci is not None]
    assert min(forces) > 0.0
    assert found.area_fraction_corrected[2] > found.area_fraction_corrected[0]
    for step, force in zip(found.steps, forces, strict=True):
        assert step.force == pytest.approx(step.external_force + force, rel=0.05)


@pytest.mark.parametrize("body", [SOFT, COATED])
def test_hardness_menisci_and_friction_together_beside_creep(body: asp.Elastic | asp.Layered) -> None:
    film = asp.LiquidFilm(surface_tension=0.02, thickness=2e-8, meniscus_height=5e-8)
    problem = asp.ContactProblem(GROUND, body, film=film, law=asp.Hardness(8e5), friction=asp.Coulomb(0.3))
    found = asp.solve(problem, HOLD)
    assert found.last.max_pressure <= 8e5 * (1.0 + 1e-9)
    assert found.last.total_plastic_work >= found.steps[0].total_plastic_work > 0.0


@pytest.mark.parametrize("boundary", [asp.Free(), asp.Periodic()])
def test_hardness_of_layers_with_menisci_beside_creep(boundary: asp.Free | asp.Periodic) -> None:
    """The limit follows the depth of indentation while the coating creeps."""
    soft = asp.Viscoelastic(16e6, 0.3, strength=asp.Strength(hardness=1.5e6), spectrum=SOFT.spectrum)
    body = asp.Layered([asp.Layer(soft, 2e-6)], asp.Elastic(1e8, 0.3, strength=asp.Strength(hardness=1e7)))
    film = asp.LiquidFilm(surface_tension=0.02, thickness=2e-8, meniscus_height=5e-8)
    problem = asp.ContactProblem(GROUND, body, boundary=boundary, law=asp.plasticity.LayeredHardness(body), film=film)
    found = asp.solve(problem, HOLD)
    assert found.steps[0].total_plastic_work > 0.0
    assert found.last.total_plastic_work >= found.steps[0].total_plastic_work
    assert found.last.max_pressure < 2e6
    assert found.area_fraction_corrected[2] > found.area_fraction_corrected[0]


def test_what_is_not_followed_is_named() -> None:
    endless = asp.ContactProblem(GROUND, SOFT, boundary=asp.Free(), adhesion=asp.adhesion.JKRAdhesion(0.05))
    with refused(asp.InputError, "adhesion of viscoelastic bodies", "JKRAdhesion"):
        asp.solve(endless, LOAD)
