"""Hardness that follows the local indentation of a coated body: limits, agreement of depth and
limit, independence of steps."""

from __future__ import annotations

import math

import numpy as np
import pytest
from contact_cases import rough
from refusals import refused

import asperity as asp
from asperity.contact.law import LimitByDepth
from asperity.solvers import ActiveSet

SOLVER = ActiveSet(tolerance=1e-10)
FILMS = pytest.mark.parametrize(("film", "base"), [(0.3, 0.6), (0.6, 0.3), (0.25, 1.0)])


def coated(film: float, base: float, *thicknesses: float) -> asp.Layered:
    """Unit E* throughout; every layer of the hardness of the film."""
    upper, lower = (asp.Elastic(0.91, 0.3, asp.Strength(hardness=h)) for h in (film, base))
    return asp.Layered([asp.Layer(upper, t) for t in thicknesses], lower)


def solved(body, load=0.2, law=None, **options):
    problem = asp.ContactProblem(rough((24, 20), 3), body, law=law or asp.plasticity.LayeredHardness(body))
    return asp.solve(problem, asp.MeanPressure(load), solver=SOLVER, **options)


@FILMS
@pytest.mark.parametrize("thickness", [0.05, 0.5, 5.0])
def test_limit_and_indentation_agree(film, base, thickness):
    body = coated(film, base, thickness)
    result = solved(body)
    limit = asp.plasticity.LayeredHardness(body).cap_at(result.permanent_indentation)
    assert result.plastic.any()
    np.testing.assert_allclose(result.pressure[result.plastic], limit[result.plastic], rtol=1.01e-5)
    assert (result.pressure <= limit * (1.0 + 1.01e-5)).all()
    np.testing.assert_array_equal(result.indented, result.plastic)


@FILMS
def test_much_thicker_than_the_indentation_is_the_film(film, base):
    plain = solved(coated(film, base, 1.0), law=asp.Hardness(film))
    result = solved(coated(film, base, 1e5 * plain.max_permanent_indentation))
    np.testing.assert_allclose(result.pressure, plain.pressure, rtol=0.0, atol=1e-4 * plain.max_pressure)
    assert result.plastic_work == pytest.approx(plain.plastic_work, rel=1e-4)


def test_much_thinner_than_the_indentation_is_the_base():
    """A soft film bears nothing: what differs goes with its thickness. A hard one must first be
    broken; there the base bears."""
    plain = solved(coated(0.3, 0.6, 1.0), law=asp.Hardness(0.6))
    found = [np.abs(solved(coated(0.3, 0.6, t)).pressure - plain.pressure).max() for t in (0.1, 0.03, 0.01)]
    assert found[1] < 0.6 * found[0]
    assert found[2] < 0.5 * found[1]
    assert found[2] < 0.04 * plain.max_pressure
    hard = solved(coated(0.6, 0.3, 1e-5))
    broken = hard.permanent_indentation > 1e-3
    assert broken.any()
    np.testing.assert_allclose(hard.pressure[broken], 0.3, rtol=1e-5)
    assert hard.pressure[~broken].max() <= 0.6


def test_a_load_above_the_hardness_of_the_film_presses_through_it():
    result = solved(coated(0.1, 1.0, 0.05), 0.2)
    assert result.converged
    assert result.max_pressure > 0.2
    with refused(asp.errors.NoSolutionError, "mean pressure", "0.1"):
        solved(coated(0.1, 0.15, 0.05), 0.2)


def test_soft_films_of_any_thickness_settle():
    """Random films from a ten-thousandth to the rms height; limits alone as unknowns left half of
    them unsettled."""
    solves = 0
    for seed in (0, 1, 6, 8, 12, 15, 16, 19):
        rng = np.random.default_rng(seed)
        film = rng.uniform(0.05, 0.5)
        base, thickness = film * rng.uniform(1.2, 10.0), 10.0 ** rng.uniform(-4.0, 0.5)
        body = coated(film, base, thickness)
        problem = asp.ContactProblem(rough((24, 20), seed), body, law=asp.plasticity.LayeredHardness(body))
        result = asp.solve(problem, asp.MeanPressure(rng.uniform(0.05, 0.8) * min(base, 0.5)))
        limit = problem.law.cap_at(result.permanent_indentation)
        yields = result.indented
        np.testing.assert_allclose(result.pressure[yields], limit[yields], rtol=2e-5)
        assert (result.pressure <= limit * (1.0 + 2e-5)).all()
        np.testing.assert_array_equal(yields, result.plastic)
        solves += result.certificate.rounds
    assert solves <= 80


@pytest.mark.parametrize("thickness", [1e-8, 1e-5])
def test_a_film_far_thinner_than_the_indentation_is_left_out(thickness):
    plain = solved(coated(0.3, 0.6, 1.0), law=asp.Hardness(0.6))
    found = solved(coated(0.3, 0.6, thickness))
    np.testing.assert_allclose(found.pressure, plain.pressure, rtol=0.0, atol=1e-6 + 10.0 * thickness)


def test_a_load_under_which_nearly_every_point_of_a_thick_soft_film_yields():
    result = solved(coated(0.05, 1.0, 1.0))
    assert result.indented.mean() > 0.99
    assert result.converged


@FILMS
def test_equal_layers_are_one(film, base):
    one, two = solved(coated(film, base, 0.5)), solved(coated(film, base, 0.2, 0.3))
    np.testing.assert_allclose(one.pressure, two.pressure, rtol=0.0, atol=1e-9)


def test_a_film_of_the_base_is_no_film():
    body = coated(0.4, 0.4, 0.5)
    np.testing.assert_array_equal(solved(body).pressure, solved(body, law=asp.Hardness(0.4)).pressure)
    assert solved(body).plastic_work == pytest.approx(solved(body, law=asp.Hardness(0.4)).plastic_work, rel=1e-12)


def test_more_film_is_softer_or_harder_as_the_film_is():
    for film, base, sign in ((0.3, 0.6, 1.0), (0.6, 0.3, -1.0)):
        areas = [solved(coated(film, base, t)).area_fraction for t in (0.02, 0.3, 1.0, 3.0, 1e4)]
        assert (np.diff(areas) * sign >= 0.0).all()
        assert areas[0] != areas[-1]


@FILMS
@pytest.mark.parametrize("thickness", [0.2, 2.0])
def test_one_step_ends_where_many_do(film, base, thickness):
    """Limit and depth agree after a step of any size; what little differs are points that yielded
    on the way."""
    body = coated(film, base, thickness)
    problem = asp.ContactProblem(rough((24, 20), 3), body, law=asp.plasticity.LayeredHardness(body))
    many = asp.solve(problem, asp.History(asp.contact.ramps(asp.MeanPressure, [0.2], steps=8)), solver=SOLVER).steps[-1]
    one = solved(body)
    assert one.approach == pytest.approx(many.approach, rel=2e-3)
    assert one.area_fraction == pytest.approx(many.area_fraction, abs=1.1 / 480)
    assert one.total_plastic_work == pytest.approx(many.total_plastic_work, rel=0.01)


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=lambda b: b.name)
@pytest.mark.parametrize("kind", [asp.Approach, asp.MeanGap])
def test_prescribed_positions(boundary, kind):
    body = coated(0.3, 0.6, 0.5)
    problem = asp.ContactProblem(rough((24, 20), 3), body, boundary=boundary, law=asp.plasticity.LayeredHardness(body))
    aim = asp.solve(problem, asp.MeanPressure(0.15), solver=SOLVER)
    found = asp.solve(problem, kind(aim.approach if kind is asp.Approach else aim.mean_gap), solver=SOLVER)
    assert found.mean_pressure == pytest.approx(0.15, rel=1e-3)
    assert found.max_permanent_indentation == pytest.approx(aim.max_permanent_indentation, rel=1e-2)


def test_rounds_that_do_not_agree_are_flagged():
    class Restless:
        """Another one at every other depth."""

        name = "restless"
        citation_keys = ()

        def pressure_cap(self) -> float:
            return 0.4

        def cap_at(self, indentation):
            return np.full(indentation.shape, 0.4 + 0.01 * (0.618 * round(1e4 * float(indentation.sum())) % 1.0))

        def work_at(self, indentation):
            return 0.4 * indentation

    law = Restless()
    assert isinstance(law, LimitByDepth)
    result = solved(coated(0.3, 0.6, 0.5), law=law, on_failure="return")
    assert result.status.outcome == "stagnated"
    assert "hardness still changes by" in result.status.message
    assert result.status.remedy
    with pytest.raises(asp.ConvergenceError) as caught:
        solved(coated(0.3, 0.6, 0.5), law=Restless())
    assert caught.value.result.status == result.status


def test_yield_stresses_enter_where_both_are_known():
    known = asp.Strength(0.6, 0.1), asp.Strength(0.3, 0.12)
    solids = [asp.Elastic(0.91, 0.3, s) for s in known]
    law = asp.plasticity.LayeredHardness(asp.Layered([asp.Layer(solids[0], 1.0)], solids[1]))
    ratio = 0.1 / 0.12
    expected = 0.3 + 0.3 * math.exp(-(0.6 / 0.3) / ratio * 0.5)
    assert float(law.cap_at(np.array([[0.5]]))[0, 0]) == pytest.approx(expected, rel=1e-12)
    assert law.pressure_cap() == 0.6


def test_every_material_needs_a_hardness():
    soft = asp.Elastic(1.0, 0.3, name="soft")
    hard = asp.Elastic(1.0, 0.3, asp.Strength(hardness=1.0))
    with refused(asp.InputError, "hardness of soft in layer 1"):
        asp.plasticity.LayeredHardness(asp.Layered([asp.Layer(soft, 1.0)], hard))
    with refused(asp.InputError, "hardness of soft in the base"):
        asp.plasticity.LayeredHardness(asp.Layered([asp.Layer(hard, 1.0)], soft))
    with refused(asp.InputError, "base of a body with an effective hardness"):
        asp.plasticity.LayeredHardness(asp.Layered([asp.Layer(hard, 1.0)], asp.RigidBase()))
    with refused(asp.InputError, "body of an effective hardness"):
        asp.plasticity.LayeredHardness(hard)  # type: ignore[arg-type]


def test_the_stated_range_holds_the_pressures_found():
    """Gold, softer than nickel and copper: in between the limit is higher than at either end."""
    gold, nickel, copper = (asp.material(name) for name in ("gold", "nickel", "copper"))
    body = asp.Layered([asp.Layer(gold, 50e-9), asp.Layer(nickel, 1e-6)], copper)
    law = asp.plasticity.LayeredHardness(body)
    highest = float(np.max(law.cap_at(np.geomspace(1e-10, 1e-3, 5000)[None])))
    assert highest > 1.5 * law.base_hardness
    assert f"{highest / 1e6:.4g} MPa" in law.limit_text
    hard_on_soft = asp.Layered([asp.Layer(nickel, 1e-6)], copper)
    assert "between" not in asp.plasticity.LayeredHardness(hard_on_soft).limit_text


def test_yield_stresses_serve_where_hardnesses_are_not_known():
    film, base = (asp.Elastic(1.0, 0.3, asp.Strength(yield_stress=y)) for y in (1.0, 3.0))
    like = (asp.Elastic(1.0, 0.3, asp.Strength(hardness=2.8 * y)) for y in (1.0, 3.0))
    laws = [
        asp.plasticity.LayeredHardness(asp.Layered([asp.Layer(one, 1.0)], other)) for one, other in ((film, base), like)
    ]
    depths = np.linspace(0.0, 3.0, 20)[None]
    assert np.allclose(laws[0].cap_at(depths), laws[1].cap_at(depths), rtol=1e-14)
