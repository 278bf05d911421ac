"""Menisci that are not fed back, and adhesional friction beside a film of liquid."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from contact_cases import elastic, wetted
from reference_data import reference
from refusals import refused

import asperity as asp

NM = 1e-9
ANGLES = (math.radians(10.0), math.radians(10.0))


def smooth_disk() -> asp.ContactProblem:
    """Composite roughness of 0.1 nm under 50 kPa, as in figure 4.3 (a) of Peng (2001)."""
    spectrum = asp.generate.ExponentialAutocorrelation(0.1 * NM, 0.5e-6)
    surface = asp.generate.gaussian(asp.Grid((64, 64), (50 * NM, 50 * NM)), spectrum, seed=1)
    return asp.ContactProblem(surface, elastic(200e9))


def film(**options) -> asp.LiquidFilm:
    return asp.LiquidFilm(surface_tension=0.025, thickness=0.2 * NM, contact_angles=ANGLES, **options)


LOAD = asp.MeanPressure(50e3)


def test_the_unfed_force_is_there_where_feedback_runs_away():
    problem = smooth_disk()
    with refused(asp.errors.NoSolutionError, "meniscus force"):
        wetted(problem, LOAD, film())
    unfed, dry = wetted(problem, LOAD, film(feedback=False)), asp.solve(problem, LOAD)
    np.testing.assert_allclose(unfed.pressure, dry.pressure, atol=1e-5 * dry.max_pressure)
    assert unfed.force == pytest.approx(LOAD.value * problem.grid.area, rel=1e-9)
    assert unfed.external_force == pytest.approx(unfed.force, rel=1e-12)
    within = (unfed.gap <= 0.2 * NM) & ~unfed.contact
    found = unfed.menisci
    assert found.meniscus_force == pytest.approx(found.suction * within.mean() * problem.grid.area, rel=1e-12)
    assert found.feedback == 0.0
    assert found.unfed_meniscus_force == found.meniscus_force > 100.0 * unfed.external_force
    said = {item.criterion: item for item in asp.contact.review(unfed)}
    assert said["menisci without feedback"].level == "warning"


def test_the_unfed_force_is_that_of_the_first_round_of_the_fed_one():
    """Given beside every force that is fed back."""
    problem = smooth_disk()
    rough = replace(problem, surface=replace(problem.surface, heights=20.0 * problem.surface.heights))
    load, liquid = asp.MeanPressure(5e6), film(meniscus_height=1.0 * NM)
    fed = wetted(rough, load, liquid)
    unfed = wetted(rough, load, replace(liquid, feedback=False))
    assert 0.0 < fed.menisci.feedback < 1.0
    pixel = unfed.menisci.suction * problem.grid.pixel_area
    assert fed.menisci.unfed_meniscus_force == pytest.approx(unfed.menisci.meniscus_force, abs=2.0 * pixel)
    assert fed.menisci.meniscus_force > unfed.menisci.meniscus_force


def test_a_path_of_unfed_menisci_is_that_of_the_dry_contact():
    """Their force does no work on the bodies, and does not hold them."""
    problem = smooth_disk()
    path = asp.History([LOAD, asp.MeanPressure(2.0 * LOAD.value), asp.Unloaded()])
    wet = asp.solve(replace(problem, film=film(feedback=False)), path)
    assert not wet.energies.meniscus_work.any()
    assert wet.steps[-1].force == 0.0
    held = wetted(problem, asp.MeanGap(wet.steps[0].mean_gap), film(feedback=False))
    assert held.external_force == pytest.approx(held.force, rel=1e-12)
    assert held.menisci.meniscus_force == pytest.approx(wet.steps[0].menisci.meniscus_force, rel=1e-2)


def test_adhesion_beside_unfed_menisci_is_that_without():
    problem = replace(smooth_disk(), adhesion=asp.ExponentialAdhesion(1e-3, 1.0 * NM))
    beside, alone = wetted(problem, LOAD, film(feedback=False)), asp.solve(problem, LOAD)
    np.testing.assert_allclose(beside.gap, alone.gap, atol=1e-5 * NM)
    assert beside.menisci.meniscus_force > 0.0


def test_a_file_keeps_whether_menisci_feed_back(tmp_path: Path):
    unfed = wetted(smooth_disk(), LOAD, film(feedback=False))
    asp.save(unfed, tmp_path / "unfed.nc")
    found = asp.load(tmp_path / "unfed.nc")
    assert found.problem.film.feedback is False
    assert found.external_force == unfed.external_force


# Adhesional friction: τ on the real area, which load and menisci make together.


@pytest.mark.parametrize("row", reference("missing/adhesional_friction_sphere"), ids=lambda row: str(row["case"]))
def test_a_sphere_with_a_ring_of_liquid(row):
    """Hertz under load and the pull of a ring on both surfaces: μ = τ A_r(W + F_m)/W."""
    gamma, angle = row["gamma_N_per_m"], row["theta_rad"]
    ring = asp.theories.DropletMeniscus(row["R_m"], gamma, angle, immersion=1e-9, other_angle=angle)
    pull = float(ring.at_gap(0.0).force)
    assert pull == pytest.approx(row["Fm_N"], rel=1e-10)
    sphere, load = asp.theories.HertzPoint(row["Estar_Pa"], row["R_m"]), row["W_N"]
    dry, wet = (math.pi * float(sphere.at_load(each).radius) ** 2 for each in (load, load + pull))
    assert (dry, wet) == pytest.approx((row["area_dry_m2"], row["area_wet_m2"]), rel=1e-9)
    for area, name in ((dry, "mu_dry"), (wet, "mu_wet")):
        assert row["tau_Pa"] * area / load == pytest.approx(row[name], rel=1e-9)


def test_adhesional_friction_on_a_map():
    """τ on the points in contact, which is what a contact that sticks and slips bears, and the
    liquid beside it; on Hertz's area under load and menisci within its pixels."""
    ball = asp.generate.sphere(asp.Grid((96, 96), (4.0 * NM, 4.0 * NM)), radius=1e-6)
    problem = asp.ContactProblem(ball, asp.Rigid(), counter_body=asp.Elastic(0.91e11, 0.3), boundary=asp.Free())
    liquid = asp.LiquidFilm(surface_tension=0.0728, thickness=2.0 * NM, viscosity=1e-3)
    friction = asp.friction.TrescaFriction(300e6, speed=1e-3)
    wet = wetted(problem, asp.Force(1e-5), liquid, friction)
    found, grid = wet.menisci, problem.grid
    pixels = float(wet.contact.sum()) * grid.pixel_area
    assert found.viscous_force > 0.0
    assert found.friction_force - found.viscous_force == pytest.approx(300e6 * pixels, rel=1e-12)
    assert found.static_friction == pytest.approx(found.friction_force / 1e-5, rel=1e-9)
    hertz = asp.theories.HertzPoint(1e11, 1e-6).at_load(1e-5 + found.meniscus_force)
    assert pixels == pytest.approx(math.pi * float(hertz.radius) ** 2, rel=0.03)
    # the same strength under the load alone
    unfed = wetted(problem, asp.Force(1e-5), replace(liquid, feedback=False), friction)
    alone = math.pi * float(asp.theories.HertzPoint(1e11, 1e-6).at_load(1e-5).radius) ** 2
    dragged = unfed.menisci.friction_force - unfed.menisci.viscous_force
    assert dragged == pytest.approx(300e6 * alone, rel=0.03)
    assert dragged == pytest.approx(300e6 * float(unfed.contact.sum()) * grid.pixel_area, rel=1e-12)
    with refused(asp.errors.InputError, "friction beside a film of liquid"):
        wetted(problem, asp.Force(1e-5), liquid, asp.friction.FullStick())
