"""Full contact with tension: reference rows, the field of maps, layers."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference_data import every_row, reference
from refusals import refused
from scipy.special import erf

import asperity as asp
from asperity.theories import FullContact, IsotropicSpectrum, PerssonTosatti
from asperity.theories.rough.full_contact import mean_tension, tension_share

PRINTED = 1e-9
"""Of rows with ten digits."""

TAIL = 3e-9
"""Of what lies beyond a printed pressure of two deviations: φ(2) 2/Q(2) = 4.7 times its rounding of
5e-10."""


@every_row(reference("missing/full_contact"), label=lambda row: f"{row['case']:g}")
def test_pressure_of_full_contact(row):
    q = np.array([row["qL"], row["q0"], row["q1"]])
    level = np.array([1.0, 1.0, (row["q1"] / row["q0"]) ** (-2.0 - 2.0 * row["H"])])
    level /= IsotropicSpectrum(q, level).rms_height ** 2
    theory, p = FullContact(1.0, q, level), row["p_over_Estar"]
    waves = theory.at_wavenumber(row["q_magnification"] * row["q0"], p)
    assert waves.rms_gradient == pytest.approx(row["rms_gradient"], rel=PRINTED)
    assert waves.spread == pytest.approx(row["s_over_Estar"], rel=PRINTED)
    assert waves.tension_share == pytest.approx(row["tension_area_fraction"], rel=TAIL)
    assert mean_tension(p, waves.spread) == pytest.approx(row["mean_tension_over_Estar"], rel=TAIL)
    assert waves.area_fraction == pytest.approx(row["partial_contact_area_persson"], rel=PRINTED, abs=1e-15)
    assert theory.energy_per_area == pytest.approx(row["energy_per_area_over_Estar"], rel=PRINTED)
    if row["q_magnification"] * row["q0"] == row["q1"]:
        whole = theory.at_pressure(p)
        assert whole.tension_share == pytest.approx(row["tension_area_fraction"], rel=TAIL)
        assert whole.mean_tension == pytest.approx(row["mean_tension_over_Estar"], rel=TAIL)
        assert theory.spread == pytest.approx(row["s_over_Estar"], rel=PRINTED)


def test_densities_hold_all_pressures():
    theory = FullContact(1e11, [1e6, 1e7, 1e8], [1e-30, 1e-33, 1e-36])
    s, p = theory.spread, 0.7 * theory.spread
    local = np.linspace(p - 12.0 * s, p + 12.0 * s, 20001)
    found = theory.at_local(local, p)
    step = local[1] - local[0]
    assert found.density.sum() * step == pytest.approx(1.0, rel=1e-10)
    assert (found.density * local).sum() * step == pytest.approx(p, rel=1e-10)
    # without tension the area of Persson carries the same load; the image starts at a corner
    assert found.absorbed.sum() * step == pytest.approx(erf(p / (math.sqrt(2.0) * s)), rel=1e-5)
    assert (found.absorbed * local).sum() * step == pytest.approx(p, rel=1e-6)


@pytest.fixture(scope="module")
def surface() -> asp.Surface:
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(0.05), hurst=0.8, rolloff_wavelength=6e-7, shortest_wavelength=2e-7
    )
    return asp.generate.gaussian(asp.Grid((96, 64), (2e-8, 2e-8)), spectrum, seed=7)


STEEL = asp.Elastic(210e9, 0.3)
BODIES = {"half-space": STEEL, "layered": asp.Layered([asp.Layer(asp.Elastic(840e9, 0.25), 1e-7)], STEEL)}


@pytest.mark.parametrize("kind", BODIES)
def test_the_field_is_that_of_a_solved_contact_without_gaps(surface, kind):
    body = BODIES[kind]
    least = asp.contact.full_contact(surface, body, 0.0)
    load = 1.2 * float(-least.pressure.min())
    found = asp.contact.full_contact(surface, body, load)
    assert found.holds()
    result = asp.solve(asp.ContactProblem(surface, body), asp.MeanPressure(load))
    assert result.area_fraction == 1.0
    error = np.abs(result.pressure - found.pressure).max() / found.spread
    assert error < 1e-6  # the gap that a solve leaves
    assert found.spread == pytest.approx(least.spread)


def test_a_half_space_has_the_spread_of_its_slopes(surface):
    found = asp.contact.full_contact(surface, STEEL, 1e9)
    E_star = 210e9 / (1.0 - 0.3**2)
    roughness = asp.roughness_of(surface)
    assert found.spread == pytest.approx(0.5 * E_star * roughness.rms_gradient, rel=1e-10)
    # some 60 patches of a correlation length square: 1/sqrt(60) of a share of 0.43
    assert found.tension_share == pytest.approx(float(tension_share(1e9, found.spread)), abs=0.06)
    # the bands of a radial spectrum hold 0.56 to 1.04 times the gradient (see ``persson.APART``)
    assert 0.56 < FullContact.of_roughness(roughness, E_star).spread / found.spread < 1.04
    assert found.area_fraction_persson == pytest.approx(erf(1e9 / (math.sqrt(2.0) * found.spread)))
    work = found.energy_per_area
    assert not found.holds()
    assert not found.holds(0.99 * work)
    assert found.holds(1.01 * work)
    assert PerssonTosatti(1.01 * work, work).effective_work == pytest.approx(0.01 * work)


def test_what_cannot_be_pressed_flat_is_refused(surface):
    with refused(asp.InputError, "surface of a full contact"):
        asp.contact.full_contact(asp.Surface(surface.heights, 2e-8), STEEL, 1e9)
    with refused(asp.InputError, "wavenumbers (rad/m)", "1e+06"):
        FullContact(1e11, [1e6, 1e7], [1e-30, 1e-33]).at_wavenumber(1e6, 1e9)
