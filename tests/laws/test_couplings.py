"""Laws of contacts in which several physics act at once: agreement with nesting, order, restart,
prescribed positions, balances."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.contact.couplings.driver import settle
from asperity.contact.couplings.protocol import Coupling, Exchange, Posed, Share
from asperity.contact.solve import Prepared, steps
from asperity.physics.menisci.coupling import TOLERANCE
from asperity.physics.menisci.film import wetting

NM = 1e-9
BODY = asp.Elastic(100e9, 0.15)
FRICTION = asp.Coulomb(0.5, 0.4)
FILM = asp.LiquidFilm(surface_tension=0.025, thickness=NM, contact_angles=(math.radians(10.0), 0.0))
LOAD = asp.MeanPressure(10e6)
TIGHT = asp.solvers.ActiveSet(tolerance=1e-12)


def coated(film: float, base: float) -> asp.Layered:
    """2 nm of one hardness (Pa) on another, of the same elasticity."""
    upper, lower = (asp.Elastic(100e9, 0.15, asp.Strength(hardness=h)) for h in (film, base))
    return asp.Layered([asp.Layer(upper, 2 * NM)], lower)


SOFT, HARD = coated(0.7e9, 2e9), coated(2e9, 1e9)
LAWS = {
    "elastic": (BODY, asp.plasticity.HardWall()),
    "hardness": (BODY, asp.Hardness(1e9)),
    "soft film": (SOFT, asp.plasticity.LayeredHardness(SOFT)),
    "hard film": (HARD, asp.plasticity.LayeredHardness(HARD)),
}


@pytest.fixture(scope="module")
def surface() -> asp.Surface:
    return asp.generate.gaussian(asp.Grid((32, 24), (25 * NM, 25 * NM)), surface_spectrum(), seed=5)


def surface_spectrum() -> asp.generate.SelfAffine:
    return asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(2.0 * NM), hurst=0.8, rolloff_wavelength=1e-6, shortest_wavelength=100 * NM
    )


def problem(surface: asp.Surface, law: str = "elastic", **physics) -> asp.ContactProblem:
    body, normal = LAWS[law]
    return asp.ContactProblem(surface, body, law=normal, **physics)


def nested(posed: asp.ContactProblem, control: asp.MeanPressure) -> tuple[asp.ContactResult, float]:
    """Menisci in an outer loop around dry solves of everything else, and their force (N)."""
    dry, load = replace(posed, film=None), control.value * posed.grid.area
    pull = 0.0
    for _ in range(60):
        found = asp.solve(dry, asp.Force(load + pull), solver=TIGHT)
        latest = meniscus_force(found)
        if latest == pull:
            break
        pull = latest
    return found, latest


def meniscus_force(found: asp.ContactResult) -> float:
    stands = wetting(found.gap, found.contact, FILM, wraps=found.problem.boundary.wraps)
    return FILM.suction * np.count_nonzero(stands.menisci) * found.problem.grid.pixel_area


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("friction", [None, FRICTION], ids=["frictionless", "sliding"])
def test_menisci_with_everything_else_agree_with_nested_loops(surface, law, friction):
    posed = problem(surface, law, film=FILM, friction=friction)
    found = asp.solve(posed, LOAD, solver=TIGHT)
    wanted, pull = nested(posed, LOAD)
    assert found.converged
    slack = 2.0 * TOLERANCE * found.force
    assert found.menisci.meniscus_force == pytest.approx(pull, abs=slack)
    assert found.external_force == pytest.approx(LOAD.value * posed.grid.area, rel=1e-12)
    assert found.force == pytest.approx(wanted.force, abs=slack)
    np.testing.assert_allclose(found.pressure, wanted.pressure, atol=0.05 * wanted.max_pressure)
    assert found.certificate.rounds <= 20


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=lambda b: b.name)
@pytest.mark.parametrize("film", [None, FILM], ids=["dry", "wet"])
@pytest.mark.parametrize("friction", [None, FRICTION], ids=["frictionless", "sliding"])
def test_every_combination_settles_at_every_control(surface, law, boundary, film, friction):
    """Load and position are two ways to the same contact."""
    posed = problem(surface, law, boundary=boundary, film=film, friction=friction)
    loaded = asp.solve(posed, LOAD)
    assert loaded.converged
    for control in (asp.Approach(loaded.approach), asp.MeanGap(loaded.mean_gap), asp.Force(loaded.external_force)):
        found = asp.solve(posed, control)
        assert found.converged
        assert found.control is control
        slack = 2e-3 if film is None else 2e-3 + 6.0 * FILM.suction * posed.grid.pixel_area / loaded.external_force
        assert found.external_force == pytest.approx(loaded.external_force, rel=slack)
    for check in loaded.certificate.couplings:
        assert check.residual <= check.tolerance
        assert check.distance >= check.residual
    names = {"hardness": "film" in law, "menisci": film is not None, "sliding": friction is not None}
    assert {check.name for check in loaded.certificate.couplings} == {name for name, there in names.items() if there}


def test_the_order_of_couplings_does_not_matter(surface):
    posed = problem(surface, "soft film", film=FILM, friction=FRICTION)
    prepared = Prepared(posed)
    found = []
    for order in itertools.permutations(prepared.couplings):
        profile = posed.profile()
        step = Posed(prepared.operator, profile, profile, LOAD, float(profile.std()))
        settled = settle(step, order, {}, prepared.solver)
        assert settled.status.converged
        found.append(settled.contact.pressure)
    for other in found[1:]:
        np.testing.assert_allclose(other, found[0], rtol=0.0, atol=1e-9 * found[0].max())


@pytest.mark.parametrize("law", LAWS)
def test_a_history_goes_on_from_its_state_as_if_there_were_no_break(surface, law):
    """In the middle of a leg too, for which the state keeps both last pressures: the same numbers
    to the bit."""
    posed = problem(surface, law, film=FILM, friction=FRICTION)
    course = asp.contact.ramps(asp.MeanPressure, [20e6, 4e6], steps=3)
    whole = asp.solve(posed, asp.History(course))
    assert whole.converged
    for cut in (1, 2, 4):
        first = asp.solve(posed, asp.History(course[:cut]))
        rest = asp.solve(posed, asp.History(course[cut:]), state=first.state)
        for found, wanted in zip(rest.steps, whole.steps[cut:], strict=True):
            np.testing.assert_array_equal(found.pressure, wanted.pressure)
            assert found.external_force == wanted.external_force
            assert found.total_plastic_work == wanted.total_plastic_work


def test_a_history_with_menisci_and_friction_unloads_and_balances_its_energies(surface):
    """The residual is that of the trapezoidal rule, of second order in the steps."""
    posed, errors = problem(surface, "hardness", film=FILM, friction=FRICTION), []
    for count in (4, 8):
        found = asp.solve(posed, asp.History.ramps(asp.MeanPressure, [40e6, 2e6], steps=count))
        assert found.converged
        energies = found.energies
        assert energies.meniscus_work[count - 1] > 0.0
        assert (np.diff(energies.plastic_work) >= 0.0).all()
        errors.append(energies.relative_error)
    assert errors[1] < 0.5 * errors[0]
    assert errors[1] < 0.02


def test_menisci_are_remembered(surface):
    """On the way back they hold more than on the way up, and what they hold does not depend on the
    number of steps."""
    posed = problem(surface, film=replace(FILM, thickness=2.0 * NM, meniscus_height=2.0 * NM))
    up = asp.solve(posed, asp.MeanPressure(4e6))
    pixels = 4.0 * posed.film.suction * posed.grid.pixel_area + 2e-4 * up.external_force
    found = []
    for count in (1, 4):
        history = asp.History.ramps(asp.MeanPressure, [40e6, 4e6], steps=count)
        found.append(asp.solve(posed, history).last)
    for back in found:
        assert back.menisci.meniscus_force >= up.menisci.meniscus_force - pixels
    assert found[0].menisci.meniscus_force == pytest.approx(found[1].menisci.meniscus_force, abs=2.0 * pixels)
    assert math.isnan(found[0].menisci.feedback)


def test_unloaded_menisci_hold_the_bodies(surface):
    """Without external force what the menisci pull is what the contact bears."""
    wet = problem(surface, film=FILM)
    for state in (None, asp.solve(wet, LOAD).state):
        found = asp.solve(wet, asp.Unloaded(), state=state)
        assert found.converged
        assert found.external_force == 0.0
        assert found.menisci.meniscus_force > 0.0
        assert found.force == pytest.approx(found.menisci.meniscus_force, rel=TOLERANCE)
    thin = problem(surface, film=replace(FILM, thickness=1e-3 * NM, meniscus_height=1e-3 * NM))
    assert asp.solve(thin, asp.Unloaded()).converged


class Repelling:
    """Coupling of one's own: pushes the bodies apart with a constant force (N)."""

    name, feedback, remedy = "repelling", True, "none"

    def __init__(self, force: float) -> None:
        self.force = force

    def begin(self, posed, memory):
        return Exchange(np.zeros(()), np.zeros(()), np.inf, 1e-9)

    def share(self, exchange):
        return Share(load=-self.force)

    def reply(self, exchange, contact):
        return replace(exchange, residual=0.0)

    rescued = Coupling.rescued
    unbearable = Coupling.unbearable
    settled, settled_text = Coupling.settled, Coupling.settled_text
    unsettled, unsettled_text = Coupling.unsettled, Coupling.unsettled_text

    def end(self, exchange, contact):
        return {}, None


@pytest.mark.parametrize("share", [0.5, 1.0, 2.0])
def test_a_total_load_of_nothing_or_less_lets_the_bodies_just_touch(surface, share):
    posed = problem(surface)
    prepared, profile = Prepared(posed), posed.profile()
    step = Posed(prepared.operator, profile, profile, LOAD, float(profile.std()))
    external = LOAD.value * posed.grid.area
    settled = settle(step, (*prepared.couplings, Repelling(share * external)), {}, prepared.solver)
    assert settled.status.converged
    assert settled.contact.force == pytest.approx(max(1.0 - share, 0.0) * external)
    assert settled.contact.gap.min() == pytest.approx(0.0, abs=1e-15)


def test_menisci_that_run_away_with_friction_and_hardness_are_explained(surface):
    soft = asp.Elastic(1e9, 0.15)
    film = replace(FILM, thickness=2 * NM, meniscus_height=2 * NM)
    posed = asp.ContactProblem(surface, soft, film=film, friction=FRICTION)
    with refused(asp.errors.NoSolutionError, "meniscus force", "4.8e-10 N"):
        asp.solve(posed, asp.MeanPressure(1e3))
    weak = asp.ContactProblem(
        surface, BODY, law=asp.Hardness(8e6), film=replace(film, thickness=4 * NM, meniscus_height=4 * NM)
    )
    with refused(asp.errors.NoSolutionError, "mean pressure with the menisci"):
        asp.solve(weak, asp.MeanPressure(7.96e6))
    with refused(asp.errors.NoSolutionError, "Step 2 of the history: mean pressure"):
        asp.solve(replace(weak, film=None), asp.History([asp.MeanPressure(1e4), asp.MeanPressure(9e6)]))


def test_what_does_not_settle_is_said_in_the_words_of_the_worst(surface):
    posed = problem(surface, film=FILM, friction=asp.Coulomb(30.0))
    found = asp.solve(posed, LOAD, on_failure="return")
    assert found.status.outcome == "stagnated"
    assert "by shear" in found.status.message
    assert "friction" in found.status.remedy
    with pytest.raises(asp.ConvergenceError) as caught:
        asp.solve(posed, LOAD)
    assert caught.value.result.status == found.status
    hasty = asp.solve(problem(surface, film=FILM), LOAD, rounds=asp.solvers.Rounds(most=2), on_failure="return")
    assert hasty.status.outcome == "iteration limit"
    assert "meniscus force still changes" in hasty.status.message


def test_an_approach_of_a_millionth_of_the_roughness_is_met(surface):
    posed = problem(surface)
    for share in (1e-7, 1e-5, 1e-3):
        control = asp.Approach(share * float(posed.profile().std()))
        found = asp.solve(posed, control)
        assert found.approach == pytest.approx(control.value, rel=1e-5)


def test_a_position_at_the_hardness_is_answered_or_refused():
    """The load search used to reach a mean pressure equal to the hardness, and to divide by the
    load still to be placed."""
    grid = asp.Grid((24, 20), (1.0, 1.0))
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(1.0), hurst=0.8, rolloff_wavelength=6.0, shortest_wavelength=4.0
    )
    rough = asp.generate.gaussian(grid, spectrum, seed=1)
    posed = asp.ContactProblem(rough, asp.Elastic(0.91, 0.3), law=asp.Hardness(0.6))
    for gap in (0.2, 0.02, 1e-3):
        found = asp.solve(posed, asp.MeanGap(gap), on_failure="return")
        assert found.mean_gap == pytest.approx(gap, rel=1e-4) or "No load reaches" in found.status.message


def test_a_hard_film_near_full_contact_is_brought_to_its_position(surface):
    """Beyond the largest load that the softening surface bears, too: the position is searched for
    at every state of the film."""
    rougher = asp.generate.gaussian(asp.Grid((48, 48), (25 * NM, 25 * NM)), surface_spectrum(), seed=5)
    posed, loads = problem(rougher, "hard film"), []
    for approach in (6.0 * NM, 6.5 * NM, 7.0 * NM):
        found = asp.solve(posed, asp.Approach(approach))
        assert found.approach == pytest.approx(approach, rel=1e-6)
        assert found.certificate.rounds <= 50
        loads.append(found.mean_pressure)
    assert loads[2] < loads[1] > loads[0]
    loaded = asp.solve(posed, asp.MeanPressure(loads[0]))
    assert loaded.approach == pytest.approx(6.0 * NM, rel=1e-3)


def test_uncoupled_friction_and_equal_bodies_cost_nothing(surface):
    plain = asp.solve(problem(surface), LOAD)
    uncoupled = asp.solve(problem(surface, friction=asp.Coulomb(0.5, coupled=False)), LOAD)
    np.testing.assert_array_equal(uncoupled.pressure, plain.pressure)
    assert uncoupled.sliding is None
    equal = asp.ContactProblem(surface, BODY, counter_body=BODY, friction=FRICTION)
    assert asp.solve(equal, LOAD).certificate.rounds == 1


def test_results_of_steps_come_one_by_one(surface):
    posed = problem(surface, film=FILM)
    stream = steps(posed, [asp.MeanPressure(5e6), LOAD])
    first, second = next(stream), next(stream)
    assert first.menisci.meniscus_force <= second.menisci.meniscus_force
    assert second.state.memory["menisci"]["force"] > 0.0
