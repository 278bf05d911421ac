"""Relaxation, creep and complex modulus against reference rows, closed forms and one another."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from reference_data import Row, every_row, reference
from refusals import refused
from scipy.special import gamma

import asperity as asp
from asperity.io.description import describe, rebuild
from asperity.solids.relaxation import Creep, Relaxation
from asperity.solids.viscoelastic import alike, power_law_error, power_law_series

MATERIALS = {
    "sls": Relaxation(1.0, ((9.0, 1.0),)),
    "sls_mild": Relaxation(1.0, ((1.0, 1.0),)),
    "prony3": Relaxation(1.0, ((2.0, 10.0), (5.0, 1.0), (20.0, 0.01))),
    "prony5": Relaxation(0.5, ((0.2, 100.0), (0.4, 10.0), (1.0, 1.0), (3.0, 0.1), (10.0, 0.01))),
    "maxwell": Relaxation(0.0, ((1.0, 1.0),)),
}


@every_row(reference("viscoelasticity/linear_functions"))
def test_relaxation_creep_and_complex_modulus_of_the_reference(row: Row) -> None:
    solid, t = MATERIALS[str(row["material"])], float(row["t"])
    E = complex(solid.complex_modulus(float(row["omega"])))
    assert solid.at(t) == pytest.approx(row["relaxation"], rel=2e-12)
    assert solid.creep.at(t) == pytest.approx(row["creep"], rel=2e-12)
    assert pytest.approx((row["storage"], row["loss"]), rel=2e-12) == (E.real, E.imag)


@pytest.mark.parametrize("name", MATERIALS)
def test_creep_leads_back_to_the_relaxation(name: str) -> None:
    solid = MATERIALS[name]
    back = solid.creep.relaxation
    np.testing.assert_allclose(back.terms, solid.terms, rtol=1e-12)
    assert back.relaxed == pytest.approx(solid.relaxed, rel=1e-13, abs=1e-300)


@pytest.mark.parametrize("seed", range(8))
def test_complex_compliance_is_the_reciprocal_of_the_modulus(seed: int) -> None:
    """For random spectra, from close neighbours to strengths of 1e-9 of the whole; retardation is
    slower than relaxation."""
    random = np.random.default_rng(seed)
    taus, strengths = 10.0 ** random.uniform(-6, 6, 12), 10.0 ** random.uniform(-9, 0, 12)
    terms = (*zip(strengths, taus, strict=True), (0.3, taus[0] * (1.0 + 1e-6)))
    solid = Relaxation(1.0 if seed % 2 else 0.0, terms)
    omega = np.geomspace(1e-8, 1e8, 200)
    product = solid.complex_modulus(omega) * solid.creep.complex_compliance(omega)
    np.testing.assert_allclose(product, 1.0, rtol=1e-9)
    slower = [lam > tau for (_, lam), (_, tau) in zip(solid.creep.terms, solid.terms, strict=False)]
    assert all(slower)
    assert min(strength for strength, _ in solid.creep.terms) > 0.0


def test_standard_linear_solid_in_closed_form() -> None:
    solid = asp.Viscoelastic.standard_linear(2e6, 20e6, 0.5, 0.5)
    creep = solid.uniaxial_creep
    assert creep.terms[0][1] == pytest.approx(0.5 * 10.0, rel=1e-14)
    assert creep.terms[0][0] == pytest.approx(1.0 / 2e6 - 1.0 / 20e6, rel=1e-14)
    assert solid.contact_creep.instantaneous == pytest.approx(0.75 / 20e6)
    assert solid.relaxed_share == pytest.approx(0.1)


def test_kelvin_voigt_creeps_as_its_spring_and_dashpot() -> None:
    solid = asp.Viscoelastic.kelvin_voigt(1e6, 3.0, 0.3, instantaneous=1e6)
    t = np.array([0.1, 1.0, 10.0])
    np.testing.assert_allclose(solid.uniaxial_creep.at(t), (1.0 - np.exp(-t / 3.0)) / 1e6, rtol=1e-4)


def test_maxwell_flows() -> None:
    creep = asp.Viscoelastic.maxwell(5e6, 2.0, 0.5).uniaxial_creep
    assert (creep.instantaneous, creep.fluidity) == pytest.approx((1.0 / 5e6, 1.0 / (5e6 * 2.0)), rel=1e-14)
    assert creep.terms == Creep(1.0).terms
    assert creep.relaxed == math.inf


@pytest.mark.parametrize("alpha", [0.1, 0.3, 0.5])
def test_power_law_by_a_prony_series(alpha: float) -> None:
    """Relaxation within 1e-5 of itself; creep t^alpha/Gamma(1 - alpha)Gamma(1 + alpha) and complex
    modulus within 2e-3, for what is lost below the shortest term falls off as a power of time."""
    series, t = power_law_series(1e6, alpha, shortest=1e-2, longest=1e3), np.geomspace(1e-2, 1e3, 60)
    assert power_law_error(series, 1e6, alpha, t) < 1e-5
    np.testing.assert_allclose(series.creep.at(t) * 1e6, t**alpha / (gamma(1 - alpha) * gamma(1 + alpha)), rtol=2e-3)
    expected = 1e6 * gamma(1 - alpha) * (1j / t) ** alpha
    np.testing.assert_allclose(series.complex_modulus(1.0 / t), expected, rtol=2e-3)
    solid = asp.Viscoelastic.power_law(1e6, alpha, 0.4, shortest=1e-2, longest=1e3)
    np.testing.assert_allclose(solid.relaxation.at(t), series.at(t), rtol=1e-12)


def test_elastic_bulk_makes_the_ratio_relax() -> None:
    """Contact and Young's modulus agree with the operational ones of shear and bulk modulus; the
    ratio ends where they say."""
    solid = asp.Viscoelastic.standard_linear(1e6, 1e9, 1e-3, 0.3, elastic_bulk=True)
    s = np.array([1e-6, 1j, 100j, 3e3j, 1e9])
    G, nu = solid.operational(s)
    np.testing.assert_allclose(solid.contact_creep.operational(s) * 2.0 * G / (1.0 - nu), 1.0, rtol=1e-12)
    np.testing.assert_allclose(solid.relaxation.operational(s), 2.0 * G * (1.0 + nu), rtol=1e-12)
    K, relaxed = solid.bulk_modulus, 1e-3 * solid.shear_modulus
    assert nu[0].real == pytest.approx((3 * K - 2 * relaxed) / (2 * (3 * K + relaxed)), rel=1e-6)
    assert nu[-1].real == pytest.approx(0.3, rel=1e-6)


def test_measured_moduli_are_fitted_with_their_error() -> None:
    """A broad spectrum is met within 1 %; noise of 5 % gives an error of that size and a smooth
    solid."""
    series, f = power_law_series(1e6, 0.3, shortest=1e-6, longest=1e3), np.geomspace(1e-2, 1e4, 40)
    E = series.complex_modulus(2 * np.pi * f)
    fit = asp.viscoelasticity.fitted_solid(f, E.real, E.imag, poisson_ratio=0.49, per_decade=2)
    assert fit.largest_error < 0.01
    noisy = E * (1.0 + 0.05 * np.random.default_rng(1).standard_normal(f.size))
    rough = asp.viscoelasticity.fitted_solid(f, noisy.real, noisy.imag, poisson_ratio=0.49, per_decade=2)
    assert 0.02 < rough.rms_error < 0.08
    np.testing.assert_allclose(rough.fitted, E, rtol=0.1)
    assert rough.errors.shape == f.shape


def test_terms_halfway_between_others_are_converted() -> None:
    """Zeros at the middle between two poles, where the sign of the modulus is that of rounding."""
    for strength in (1.0, 3.0, 10.0):
        solid = Relaxation(strength, ((strength, 1.0), (strength, 3.0)))
        omega = np.geomspace(1e-3, 1e3, 30)
        product = solid.complex_modulus(omega) * solid.creep.complex_compliance(omega)
        np.testing.assert_allclose(product, 1.0, rtol=1e-12)


def test_temperature_shifts_all_times() -> None:
    wlf = asp.viscoelasticity.WilliamsLandelFerry(300.0, 17.44, 51.6)
    solid = asp.Viscoelastic.standard_linear(1e6, 1e9, 1.0, 0.4, shift=wlf)
    warm = solid.at_temperature(320.0)
    assert warm.spectrum[0][1] == pytest.approx(solid.spectrum[0][1] * 10 ** (-17.44 * 20 / 71.6), rel=1e-12)
    there_and_back = warm.at_temperature(300.0)
    assert there_and_back.spectrum[0][1] == pytest.approx(solid.spectrum[0][1], rel=1e-12)
    two_steps = warm.at_temperature(340.0).spectrum[0][1]
    assert two_steps == pytest.approx(solid.at_temperature(340.0).spectrum[0][1], rel=1e-10)
    hot = asp.Viscoelastic.maxwell(1e6, 1.0, 0.5, shift=asp.viscoelasticity.Arrhenius(300.0, 50e3)).at_temperature(
        330.0
    )
    assert hot.spectrum[0][1] == pytest.approx(math.exp(50e3 / 8.31446261815324 * (1 / 330 - 1 / 300)))
    assert hot.at_temperature(300.0).spectrum[0][1] == pytest.approx(1.0)
    assert {"Williams1955", "Ferry1980"} <= set(solid.citation_keys)


def test_it_is_the_elastic_solid_of_the_first_instant() -> None:
    solid = asp.Viscoelastic.standard_linear(1e6, 1e9, 1.0, 0.4, name="rubber")
    assert solid.instantaneous == asp.Elastic(1e9, 0.4, name="rubber")
    assert asp.solids.contact_modulus(solid) == pytest.approx(1e9 / (1 - 0.16))
    assert "relaxes to 0.1 %" in repr(solid)
    strong = replace(solid, strength=asp.Strength(1e8, 3e7), shift=asp.viscoelasticity.Arrhenius(300.0, 5e4))
    assert rebuild(describe(strong)) == strong
    assert alike((solid, solid.with_times(1.0)))
    assert not alike((solid, solid.with_times(2.0)))
    assert not alike((solid, asp.Elastic(1e9, 0.3)))
    assert alike((asp.Elastic(1e9, 0.3), asp.Elastic(2e9, 0.3)))


@pytest.mark.parametrize(
    ("make", "subject"),
    [
        (lambda: asp.Viscoelastic(1e6, 0.3, spectrum=((0.7, 1.0), (0.4, 2.0))), "shares of a viscoelastic spectrum"),
        (lambda: asp.Viscoelastic.standard_linear(2e6, 1e6, 1.0, 0.3), "instantaneous modulus (Pa)"),
        (lambda: asp.Viscoelastic.standard_linear(1e6, 2e6, 0.0, 0.3), "time of a term of a relaxation (s)"),
        (
            lambda: asp.Viscoelastic.kelvin_voigt(1e6, 1.0, 0.3, instantaneous=0.5),
            "ratio of the instantaneous to the relaxed modulus",
        ),
        (
            lambda: asp.Viscoelastic(1e6, 0.5, spectrum=((0.5, 1.0),), elastic_bulk=True),
            "Poisson's ratio of a solid of elastic bulk",
        ),
        (lambda: asp.Viscoelastic(1e6, 0.5, shift=3), "shift of a viscoelastic solid"),  # type: ignore[arg-type]
        (lambda: asp.Viscoelastic.maxwell(1e6, 1.0, 0.5).at_temperature(300.0), "viscoelastic solid without a name"),
        (lambda: asp.viscoelasticity.WilliamsLandelFerry(300.0, 17.0, 51.6).factor(240.0), "temperature (K)"),
        (lambda: asp.viscoelasticity.Arrhenius(300.0, 1e5).factor(1.0), "temperature of a viscoelastic solid"),
        (lambda: power_law_series(1.0, 1.2, shortest=1.0, longest=2.0), "exponent of a power law"),
        (lambda: power_law_series(1.0, 0.2, shortest=2.0, longest=1.0), "longest time of a power law (s)"),
        (
            lambda: asp.viscoelasticity.fitted_solid([1.0, 2.0], [1.0], [1.0], poisson_ratio=0.3),
            "frequency, storage and loss modulus",
        ),
        (
            lambda: asp.viscoelasticity.fitted_solid([1.0, 1.0], [1.0, 1.0], [1.0, 1.0], poisson_ratio=0.3),
            "frequencies (Hz) of a viscoelastic solid",
        ),
        (
            lambda: asp.viscoelasticity.fitted_solid([1.0, 2.0], [1.0, -1.0], [1.0, 1.0], poisson_ratio=0.3),
            "storage moduli (Pa)",
        ),
        (lambda: Relaxation(0.0), "modulus of a relaxation"),
    ],
)
def test_values_that_are_refused(make: Callable[[], object], subject: str) -> None:
    with refused(asp.InputError, subject):
        make()
