"""Balance of forces in wet contacts: what the bodies press with is the load and what the menisci
pull, whatever the contact."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from contact_cases import elastic, rough, wetted
from refusals import refused

import asperity as asp
from asperity.physics.menisci.coupling import TOLERANCE
from asperity.physics.menisci.film import wetting

BALANCED = 1e-3
"""Imbalance over the sum of the forces up to which a contact may be called converged."""


def pulls(result: asp.ContactResult) -> float:
    """Force (N) of the liquid on the areas of the result."""
    menisci = result.menisci
    return menisci.suction * float(menisci.wetting.filled.sum()) * result.problem.grid.pixel_area


def imbalance(result: asp.ContactResult) -> float:
    """How far load and menisci miss the force of the contact, over their sum."""
    wanted = result.control.value * (result.problem.grid.area if isinstance(result.control, asp.MeanPressure) else 1.0)
    whole = wanted + pulls(result)
    return abs(float(result.pressure.sum()) * result.problem.grid.pixel_area - whole) / whole


def random_case(number: int, *, fine: bool = False) -> tuple[asp.ContactProblem, asp.MeanPressure]:
    """Rough or stepped surface, soft to stiff body, film of 0.2 to 3 rms heights, 1 kPa to 1 MPa;
    free or with a hardness as well.

    ``fine``: 128² points of a rough surface under water.
    """
    rng = np.random.default_rng([number, fine])
    points = 128 if fine else int(rng.integers(8, 40))
    pixel = 10.0 ** rng.uniform(-8.0, -5.5)
    rms = pixel * 10.0 ** rng.uniform(-2.0, 0.0)
    modulus = 10.0 ** rng.uniform(4.0, 11.0)
    unit = rough((points, points), number, power=1.8).heights
    heights = np.round(2.0 * unit) / 2.0 if not fine and number % 4 == 0 else unit
    film = asp.LiquidFilm(
        surface_tension=0.0727,
        thickness=(thickness := rms * 0.2 * 15.0 ** rng.uniform()),
        meniscus_height=thickness * (1.0 if number % 2 else rng.uniform(1.0, 2.0)),
        contact_angles=(rng.uniform(0.0, 1.4), 0.0),
    )
    problem = asp.ContactProblem(
        asp.Surface(rms * heights, pixel, periodic=True),
        elastic(modulus),
        boundary=asp.Free() if not fine and number % 3 == 0 else asp.Periodic(),
        law=asp.Hardness(0.1 * modulus) if number % 5 == 0 else asp.plasticity.HardWall(),
        film=film,
    )
    return problem, asp.MeanPressure(10.0 ** rng.uniform(3.0, 6.0))


def test_a_plateau_whose_last_pixels_are_in_contact_and_liquid_in_part():
    """One pixel of liquid pulls 240 times the load: its share in the corners that touch last is
    what balances the forces."""
    heights = np.zeros((8, 8))
    heights[:5, :5] = 1e-7
    film = asp.LiquidFilm(surface_tension=0.07, thickness=0.9e-7)
    problem = asp.ContactProblem(asp.Surface(heights, 1e-6, periodic=True), asp.Elastic(1e4, 0.3), film=film)
    found = asp.solve(problem, asp.MeanPressure(100.0))
    assert found.external_force == pytest.approx(6.4e-9, rel=1e-12)
    assert imbalance(found) <= TOLERANCE
    assert found.certificate.load_imbalance <= TOLERANCE
    assert found.menisci.meniscus_force == pytest.approx(pulls(found), rel=1e-12)
    partly = found.menisci.wetting.partly
    assert np.count_nonzero(partly) == 4, "the plateau is symmetric"
    assert (found.gap[partly] <= 1e-4 * film.thickness).all()
    # below that force they are open and under liquid, above it they touch
    dry = replace(problem, film=None)
    less, more = (asp.solve(dry, asp.Force(factor * found.force)) for factor in (0.999, 1.001))
    assert not less.contact[partly].any()
    assert more.contact[partly].all()
    (said,) = (item for item in asp.contact.review(found) if item.criterion == "jump of the meniscus force")
    assert said.message.startswith("The forces balance where the meniscus force jumps: 4 pixels")


@pytest.mark.parametrize(("fine", "count"), [(False, 150), (True, 24)], ids=["small", "rough 128²"])
def test_random_wet_contacts_are_in_balance_or_say_what_jumps(fine, count):
    """What is called converged is in balance, and at least 95 % of the contacts that are not closed
    by their liquid are."""
    borne, jumping = 0, 0
    for number in range(count):
        problem, load = random_case(number, fine=fine)
        try:
            found = asp.solve(problem, load, on_failure="return")
        except asp.errors.NoSolutionError:
            continue  # the load alone, or the liquid, closes the surfaces
        borne += 1
        assert found.certificate.load_imbalance == pytest.approx(imbalance(found), abs=1e-9), number
        if found.converged:
            assert imbalance(found) <= BALANCED, number
            assert found.menisci.meniscus_force == pytest.approx(pulls(found), rel=1e-9), number
        else:
            jumping += 1
            assert re.search(r"jumps past its balance: by \S+ N .* as \d+ pixels?", found.status.message), number
    assert borne >= 0.6 * count
    assert jumping <= 0.05 * borne


def test_the_balance_is_the_first_that_a_growing_load_meets():
    """Beside a scan of dry contacts: below the force found the liquid always pulls more than is
    left to it."""
    surface = rough((32, 32), 3, spacing=(1e-7, 1e-7))
    problem = asp.ContactProblem(
        asp.Surface(5e-9 * surface.heights, 1e-7, periodic=True),
        elastic(10e9),
        film=asp.LiquidFilm(surface_tension=0.07, thickness=4e-9),
    )
    found, dry = asp.solve(problem, asp.MeanPressure(1e5)), replace(problem, film=None)
    assert found.menisci.relative_meniscus_force > 0.3
    assert imbalance(found) <= TOLERANCE
    for force in np.linspace(found.external_force, 0.999 * found.force, 40):
        at = asp.solve(dry, asp.Force(force))
        stands = wetting(at.gap, at.contact, problem.film, wraps=(True, True))
        left = force - found.external_force
        assert problem.film.suction * np.count_nonzero(stands.menisci) * problem.grid.pixel_area > left


BODIES = {
    "elastic": elastic(1e9),
    "layered": asp.Layered([asp.Layer(asp.Elastic(5e9, 0.3), 2e-7)], elastic(1e9)),
}
FIXED = asp.generate.gaussian(
    asp.Grid((40, 40), (1e-7, 1e-7)),
    asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(1e-8), hurst=0.8, rolloff_wavelength=2e-6, shortest_wavelength=5e-7
    ),
    seed=2,
)


@pytest.mark.parametrize("body", BODIES)
@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=lambda boundary: boundary.name)
@pytest.mark.parametrize("hardness", [np.inf, 2e8], ids=["elastic", "hardness"])
def test_every_control_is_in_balance(body, boundary, hardness):
    """Load and mean pressure are the same; at the position they come to the same external force is
    found, but for pixels in part under liquid."""
    film = asp.LiquidFilm(surface_tension=0.07, thickness=1e-8, meniscus_height=1.4e-8, contact_angles=(0.4, 0.0))
    law = asp.plasticity.HardWall() if np.isinf(hardness) else asp.Hardness(hardness)
    problem = asp.ContactProblem(FIXED, BODIES[body], boundary=boundary, law=law, film=film)
    loaded = asp.solve(problem, asp.MeanPressure(3e5))
    assert loaded.menisci.meniscus_force > 0.1 * loaded.external_force
    assert imbalance(loaded) <= TOLERANCE
    pushed = asp.solve(problem, asp.Force(loaded.external_force))
    np.testing.assert_allclose(pushed.pressure, loaded.pressure, atol=1e-9 * loaded.max_pressure)
    part = film.suction * problem.grid.pixel_area * np.count_nonzero(loaded.menisci.wetting.partly)
    pixel = film.suction * problem.grid.pixel_area
    for control in (asp.Approach(loaded.approach), asp.MeanGap(loaded.mean_gap)):
        held = asp.solve(problem, control)
        assert held.certificate.load_imbalance == 0.0
        assert held.external_force == pytest.approx(held.force - pulls(held), rel=1e-9)
        # a position is met to 1e-9 of itself, where a pixel may change sides
        assert held.external_force == pytest.approx(loaded.external_force, abs=part + 2.0 * pixel + 1e-4 * loaded.force)


def test_the_imbalance_is_that_of_the_whole_interface():
    """Given up on the way, the contact bears load and liquid of the round before; the certificate
    says by how much they miss."""
    film = asp.LiquidFilm(surface_tension=0.07, thickness=1e-8)
    early = wetted(
        asp.ContactProblem(FIXED, BODIES["elastic"]),
        asp.MeanPressure(3e5),
        film,
        rounds=asp.solvers.Rounds(most=2),
        on_failure="return",
    )
    assert not early.converged
    assert imbalance(early) > 0.01
    assert early.certificate.load_imbalance == pytest.approx(imbalance(early), rel=1e-9)


def test_no_tolerance_makes_an_imbalance_converged():
    """Rounds with a loose tolerance of the menisci end out of balance, and are not called
    converged."""
    film = asp.LiquidFilm(surface_tension=0.07, thickness=1e-8)
    options = {"rounds": asp.solvers.Rounds(tolerances={"menisci": 0.5}), "on_failure": "return"}
    loose = wetted(asp.ContactProblem(FIXED, BODIES["elastic"]), asp.MeanPressure(3e5), film, **options)
    assert loose.certificate.load_imbalance > BALANCED
    assert not loose.converged
    assert "the forces miss their balance" in loose.status.message


def test_menisci_near_the_hardness_are_in_balance_up_to_it():
    """Points that yield touch instead of the liquid: a load below the hardness finds its balance,
    one that the liquid lifts above it does not."""
    problem = asp.ContactProblem(FIXED, elastic(100e9), law=asp.Hardness(8e6))
    film = asp.LiquidFilm(surface_tension=0.025, thickness=4e-9)
    found = wetted(problem, asp.MeanPressure(7e6), film)
    assert imbalance(found) <= TOLERANCE
    assert found.menisci.wetting.regime == "flooded"
    with refused(asp.errors.NoSolutionError, "mean pressure with the menisci"):
        wetted(problem, asp.MeanPressure(7.99e6), film)


def test_on_the_way_back_forces_balance_too():
    """Menisci remembered from a larger load hold more, in balance at every step."""
    problem = asp.ContactProblem(FIXED, elastic(1e10), film=asp.LiquidFilm(surface_tension=0.07, thickness=1.2e-8))
    history = asp.solve(problem, asp.History.ramps(asp.MeanPressure, [2e6, 2e5], steps=4))
    for step in history.steps:
        assert imbalance(step) <= TOLERANCE
        assert step.menisci.meniscus_force == pytest.approx(pulls(step), rel=1e-9)
    again = asp.solve(problem, asp.MeanPressure(2e5))
    assert history.last.menisci.meniscus_force >= again.menisci.meniscus_force * (1.0 - 1e-4)
