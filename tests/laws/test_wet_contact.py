"""Laws of contacts with menisci: limits, monotony, balance."""

from __future__ import annotations

import math

import numpy as np
import pytest
from contact_cases import elastic, wetted
from refusals import refused

import asperity as asp

NM = 1e-9
ANGLES = (math.radians(10.0), 0.0)


@pytest.fixture(scope="module")
def problem() -> asp.ContactProblem:
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(2.0 * NM), hurst=0.8, rolloff_wavelength=1e-6, shortest_wavelength=100 * NM
    )
    surface = asp.generate.gaussian(asp.Grid((96, 96), (25 * NM, 25 * NM)), spectrum, seed=5)
    return asp.ContactProblem(surface, elastic(100e9))


def lubricant(thickness: float, **options) -> asp.LiquidFilm:
    return asp.LiquidFilm(surface_tension=0.025, thickness=thickness, contact_angles=ANGLES, **options)


LOAD = asp.MeanPressure(2e6)


def test_the_thinner_the_film_the_drier_the_contact(problem):
    """A film thinner than every gap of the dry contact leaves it as it is."""
    dry = asp.solve(problem, LOAD)
    thinnest = dry.gap[~dry.contact].min()
    wet = wetted(problem, LOAD, lubricant(0.5 * thinnest))
    assert wet.menisci.meniscus_force == 0.0
    assert wet.menisci.wetting.regime == "dry"
    np.testing.assert_array_equal(wet.contact, dry.contact)
    forces = [wetted(problem, LOAD, lubricant(h * NM)).menisci.meniscus_force for h in (0.5, 1.0, 2.0, 3.0)]
    assert 0.0 < forces[0] < forces[1] < forces[2] < forces[3]


def test_the_force_grows_with_the_humidity(problem):
    """Up to flooding: then the area is full and the suction falls."""
    water = asp.liquid("water")
    angle = math.radians(60.0)
    found = [
        wetted(problem, LOAD, asp.LiquidFilm.at_humidity(water, humidity, contact_angles=(angle, angle)))
        for humidity in (0.4, 0.6, 0.7, 0.8, 0.85)
    ]
    assert all(wet.menisci.wetting.regime != "flooded" for wet in found)
    assert (np.diff([wet.menisci.meniscus_force for wet in found]) > 0.0).all()


def test_the_steady_force_is_the_balance(problem):
    """Found by repeated solution; the same contact, posed by its position, needs the same external
    force."""
    film = lubricant(2.0 * NM)
    wet = wetted(problem, LOAD, film, friction=asp.Coulomb(0.3, coupled=False))
    slack = 1e-4 * wet.force
    assert wet.external_force == pytest.approx(2e6 * problem.grid.area, rel=1e-12)
    assert wet.force == pytest.approx(wet.external_force + wet.menisci.meniscus_force, abs=slack)
    assert wet.menisci.meniscus_force == pytest.approx(
        film.suction * wet.menisci.meniscus_area_fraction * problem.grid.area
    )
    assert 0.0 < wet.menisci.feedback < 1.0
    posed = wetted(problem, asp.MeanGap(wet.mean_gap), film)
    assert posed.external_force == pytest.approx(wet.external_force, abs=2.0 * slack)
    # by bisection on the load: F(L) + W - L changes sign there
    for load, sign in ((0.99 * wet.force, 1.0), (1.01 * wet.force, -1.0)):
        dry = wetted(problem, asp.MeanGap(asp.solve(problem, asp.Force(load)).mean_gap), film)
        assert sign * (dry.menisci.meniscus_force + wet.external_force - load) > 0.0
    assert wet.menisci.friction_force == pytest.approx(
        0.3 * (wet.external_force + wet.menisci.meniscus_force), rel=1e-12
    )
    assert wet.menisci.static_friction == pytest.approx(0.3 * (1.0 + wet.menisci.relative_meniscus_force), rel=1e-12)


def test_stiffness_is_that_of_the_last_contact(problem):
    """Rounds leave it out; that of the contact at its end is the one of the same dry contact under
    load and menisci."""
    wet = wetted(problem, LOAD, lubricant(1.0 * NM))
    direct = asp.solve(problem, asp.Force(wet.force), state=asp.solvers.InterfaceState(wet.pressure))
    assert wet.normal_stiffness == pytest.approx(direct.normal_stiffness, rel=1e-4)


def test_menisci_move_with_the_surface(problem):
    surface = problem.surface
    moved = asp.Surface(np.roll(surface.heights, (17, 40), (0, 1)), surface.dx, surface.dy, periodic=True)
    film = lubricant(1.5 * NM)
    here = wetted(problem, LOAD, film)
    there = wetted(asp.ContactProblem(moved, problem.body), LOAD, film)
    assert there.menisci.n_menisci == here.menisci.n_menisci
    # a gap within the solver's error of a threshold may change sides
    differ = np.roll(here.menisci.wetting.menisci, (17, 40), (0, 1)) != there.menisci.wetting.menisci
    assert np.count_nonzero(differ) <= 2


def test_stiffer_bodies_and_rougher_surfaces_stick_less(problem):
    film = lubricant(2.0 * NM)
    usual = wetted(problem, LOAD, film).menisci.meniscus_force
    stiffer = asp.ContactProblem(problem.surface, elastic(300e9))
    assert wetted(stiffer, LOAD, film).menisci.meniscus_force < usual
    heights = problem.surface.heights
    rougher = asp.Surface(1.5 * heights, problem.surface.dx, problem.surface.dy, periodic=True)
    assert wetted(asp.ContactProblem(rougher, problem.body), LOAD, film).menisci.meniscus_force < usual


def test_a_force_that_runs_away_is_an_error_with_its_numbers(problem):
    soft = asp.ContactProblem(problem.surface, elastic(1e9))
    with refused(asp.errors.NoSolutionError, "meniscus force", "5.76e-09 N"):
        wetted(soft, asp.MeanPressure(1e3), lubricant(2.0 * NM, meniscus_height=2.0 * NM))


def test_menisci_that_exceed_the_hardness_are_an_error(problem):
    weak = asp.ContactProblem(problem.surface, elastic(100e9), law=asp.Hardness(8e6))
    with refused(asp.errors.NoSolutionError, "mean pressure with the menisci"):
        wetted(weak, asp.MeanPressure(7.96e6), lubricant(4.0 * NM))


def test_too_few_rounds_are_told(problem):
    wet = wetted(problem, LOAD, lubricant(2.0 * NM), rounds=asp.solvers.Rounds(most=2), on_failure="return")
    assert not wet.converged
    assert "still changes by" in wet.status.message
    assert wet.status.remedy
    with pytest.raises(asp.ConvergenceError) as caught:
        wetted(problem, LOAD, lubricant(2.0 * NM), rounds=asp.solvers.Rounds(most=2))
    assert caught.value.result.status == wet.status


def test_plastic_contacts_keep_what_earlier_loads_indented(problem):
    """The state that goes in is the virgin one of every round: nothing is indented twice."""
    plastic = asp.ContactProblem(problem.surface, elastic(100e9), law=asp.Hardness(1e9))
    film = lubricant(2.0 * NM)
    wet = wetted(plastic, LOAD, film)
    direct = asp.solve(plastic, asp.Force(wet.force))
    np.testing.assert_allclose(
        wet.permanent_indentation, direct.permanent_indentation, atol=1e-3 * direct.max_permanent_indentation
    )
    on = wetted(plastic, asp.MeanPressure(2.0 * LOAD.value), film, state=wet.state)
    assert on.total_plastic_work == pytest.approx(wet.plastic_work + on.plastic_work, rel=1e-12)
