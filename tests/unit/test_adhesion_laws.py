"""Adhesion laws: σ, its energy and slope belong together, the integral is the work, and the rows of
the reference hold."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from reference_data import every_row, reference
from refusals import refused
from scipy.integrate import quad

from asperity.core.errors import InputError
from asperity.physics.adhesion.law import (
    CustomAdhesion,
    DugdaleAdhesion,
    ExponentialAdhesion,
    LennardJonesAdhesion,
    LinearAdhesion,
    VanDerWaalsAdhesion,
    cohesive_length,
)

WORK, RANGE = 0.05, 2e-9
CUT_WORK = 0.84375
"""Work of the van der Waals law cut at 4 D0 over that of the uncut one, in whose units the rows
are."""

LAWS = {
    "dugdale": DugdaleAdhesion(WORK, RANGE, smoothing=0.0),
    "linear": LinearAdhesion(WORK, RANGE),
    "exponential": ExponentialAdhesion(WORK, RANGE),
    "van_der_waals_wall": VanDerWaalsAdhesion(WORK, 2.0 * RANGE),
    "van_der_waals_cut_shifted": VanDerWaalsAdhesion(CUT_WORK * WORK, 2.0 * RANGE, 8.0 * RANGE),
    "lennard_jones_39": LennardJonesAdhesion(WORK, 16.0 * RANGE / (9.0 * math.sqrt(3.0))),
}
OWN = CustomAdhesion(
    lambda g: LAWS["exponential"].attraction(g),
    lambda g: LAWS["exponential"].energy(g),
    lambda g: LAWS["exponential"].slope(g),
    far=40.0 * RANGE,
)
ROUNDED = DugdaleAdhesion(WORK, RANGE, smoothing=0.2)
SMOOTH = {name: law for name, law in LAWS.items() if name != "dugdale"} | {"own": OWN, "rounded": ROUNDED}


@every_row(reference("adhesion/cohesive_laws"), label=lambda row: f"case{row['case']:g}")
def test_rows_of_the_reference(row):
    name = row["law"]
    law = LAWS[name]
    # the rows count the gap of van der Waals' law from the atomic planes of the other body
    planes = 2.0 * RANGE if name.startswith("van_der_waals") else 0.0
    gap = np.array(row["gap_norm"] * RANGE - planes)
    assert law.attraction(gap) * RANGE / WORK == pytest.approx(row["attraction_norm"], rel=1e-12, abs=1e-14)
    assert -law.energy(gap) / WORK == pytest.approx(row["energy_norm"], rel=1e-12, abs=1e-14)
    # at the largest attraction of Lennard-Jones' law terms of size 7 cancel
    assert law.slope(gap) * RANGE**2 / WORK == pytest.approx(row["slope_norm"], rel=1e-12, abs=3e-14)


@pytest.mark.parametrize("law", [*LAWS.values(), OWN, ROUNDED], ids=lambda law: law.name)
def test_integral_of_the_attraction_is_the_work(law):
    start = law.spacing
    ends = np.concatenate([[start], start + RANGE * np.array([0.5, 1.0, 2.0, 6.0, 40.0])])
    pieces = [
        quad(lambda g: float(law.attraction(np.array(g))), *pair, epsabs=0.0, epsrel=1e-12)[0]
        for pair in itertools.pairwise(ends)
    ]
    beyond = -float(law.energy(np.array(ends[-1])))
    assert sum(pieces) + beyond == pytest.approx(law.work, rel=1e-9)
    assert -float(law.energy(np.array(law.spacing))) == pytest.approx(law.work, rel=1e-12)


@pytest.mark.parametrize("law", SMOOTH.values(), ids=lambda law: law.name)
def test_energy_and_slope_belong_to_the_attraction(law):
    g = law.spacing + RANGE * np.array([0.05, 0.3, 0.95, 1.7, 3.1, 5.2])
    h = 1e-5 * RANGE  # error of the central difference: (h/ϱ)²/6 of the third derivative, 1e-10, and rounding 1e-11
    assert (law.energy(g + h) - law.energy(g - h)) / (2.0 * h) == pytest.approx(law.attraction(g), rel=1e-7, abs=1.0)
    measured = (law.attraction(g + h) - law.attraction(g - h)) / (2.0 * h)
    assert measured == pytest.approx(law.slope(g), rel=1e-6, abs=1e-8 * law.steepest)


@pytest.mark.parametrize("law", SMOOTH.values(), ids=lambda law: law.name)
def test_strength_and_steepest_are_the_extremes(law):
    g = law.spacing + RANGE * np.linspace(0.0, 6.0, 60001)
    # half a step of 1e-4 ϱ beside the extreme of Lennard-Jones' law costs 3e-8 of it
    assert law.attraction(g).max() == pytest.approx(law.strength, rel=1e-7)
    assert -law.slope(g).min() == pytest.approx(law.steepest, rel=1e-7)


def test_strength_may_be_given_instead_of_the_range():
    law = ExponentialAdhesion.of_strength(WORK, WORK / RANGE)
    assert law.range == pytest.approx(RANGE, rel=1e-15)


def test_hamaker_constant_and_work():
    law = VanDerWaalsAdhesion.of_hamaker(6e-20)
    assert law.hamaker == pytest.approx(6e-20, rel=1e-14)
    assert law.work == pytest.approx(6e-20 / (12.0 * math.pi * 0.165e-9**2), rel=1e-14)


def test_cohesive_length_of_the_exponential_law():
    assert cohesive_length(LAWS["exponential"], 1e9) == pytest.approx(1e9 * RANGE**2 / WORK, rel=1e-14)


def test_own_laws_that_do_not_hold_together_are_refused():
    law = LAWS["exponential"]
    with refused(InputError, "energy of an adhesion law"):
        CustomAdhesion(law.attraction, lambda g: 2.0 * law.energy(g), law.slope, far=20.0 * RANGE)
    with refused(InputError, "slope of an adhesion law"):
        CustomAdhesion(law.attraction, law.energy, lambda g: 0.0 * g, far=20.0 * RANGE)
    with refused(InputError, "attraction of an adhesion law"):
        CustomAdhesion(lambda g: g, law.energy, law.slope, far=20.0 * RANGE)


@pytest.mark.parametrize(
    ("make", "what"),
    [
        (lambda: ExponentialAdhesion(0.0, RANGE), "work of adhesion (J/m^2)"),
        (lambda: ExponentialAdhesion(1e-299, RANGE), "work of adhesion (J/m^2)"),
        (lambda: DugdaleAdhesion(WORK, -1.0), "range of the adhesion (m)"),
        (lambda: DugdaleAdhesion(WORK, 1e160), "range of the adhesion (m)"),
        (lambda: LinearAdhesion.of_strength(WORK, 1e-299), "strength of the adhesion (Pa)"),
        (lambda: LinearAdhesion.of_strength(WORK, 0.0), "strength of the adhesion (Pa)"),
        (lambda: VanDerWaalsAdhesion(WORK, 1e-9, 0.5e-9), "reach of the adhesion (m)"),
        (lambda: LennardJonesAdhesion(WORK, math.nan), "equilibrium gap (m)"),
    ],
)
def test_impossible_laws_are_refused(make, what):
    with refused(InputError, what):
        make()
