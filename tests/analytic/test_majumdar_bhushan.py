"""The fractal contact of Majumdar & Bhushan against its reference rows, quadrature and limits."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference_data import every_row, reference
from refusals import refused
from scipy.integrate import quad

import asperity as asp
from asperity.core.errors import InputError, NoSolutionError
from asperity.theories.catalogue import theory as theory_by_name
from asperity.theories.rough.majumdar_bhushan import MajumdarBhushan
from asperity.theories.statistics.roughness import Fractal, Roughness

AREA = 1e-8
DIMENSIONS = st.floats(1.1, 1.9)


@every_row(reference("mb_load_area"))
def test_load_and_area(row):
    theory = MajumdarBhushan(row["D"], row["G_m"], row["Estar_Pa"], row["H_Pa"], 1.0)
    largest = row["a_l_m2"]
    # the critical area is a power of up to 2/(D - 1) = 10 of ratios that carry rounding
    assert theory.critical_area == pytest.approx(row["a_c_m2"], rel=1e-12)
    assert float(theory.sizes.area(largest)) == pytest.approx(row["Ar_m2"], rel=1e-13)
    assert float(theory.elastic_area(largest)) == pytest.approx(row["Ar_elastic_m2"], rel=1e-11)
    assert float(theory.elastic_load(largest)) == pytest.approx(row["P_elastic_N"], rel=1e-11)
    # what the hardness carries is a difference of areas: as accurate as the whole
    assert float(theory.plastic_load(largest)) == pytest.approx(
        row["P_plastic_N"], rel=1e-11, abs=1e-14 * theory.hardness * row["Ar_m2"]
    )
    assert float(theory.load(largest)) == pytest.approx(row["P_total_N"], rel=1e-11)


@every_row(reference("mb_dimensionless"))
def test_dimensionless_load_and_area(row):
    theory = MajumdarBhushan(row["D"], row["Gstar"], 1.0, row["K_phi"], 1.0)  # E* = 1 and a nominal area of one
    largest = theory.sizes.largest(row["Ar_star"])
    assert theory.critical_area == pytest.approx(row["ac_star"], rel=1e-11)
    assert float(theory.elastic_load(largest)) == pytest.approx(row["Pe_star"], rel=1e-11)
    assert float(theory.load(largest)) == pytest.approx(row["P_star"], rel=1e-11)


@every_row(reference("mb_size_distribution"))
def test_sizes_of_spots(row):
    theory = MajumdarBhushan(row["D"], 1e-12, 1e11, 1e9, 1e-8)
    largest = 3e-12
    spot = row["a_over_al"] * largest
    assert float(theory.sizes.larger_than(spot, largest)) == pytest.approx(row["N_larger"], rel=1e-12)
    assert float(theory.sizes.density(spot, largest)) * largest == pytest.approx(row["n_times_al"], rel=1e-12)
    assert float(theory.sizes.share_below(spot, largest)) == pytest.approx(
        row["area_fraction_in_smaller_spots"], rel=1e-12
    )


@given(dimension=st.one_of(DIMENSIONS, st.floats(1.499, 1.501), st.just(1.5)), ratio=st.floats(1.5, 1e5))
def test_the_load_is_that_of_the_spots(dimension, ratio):
    """∫ P(a) n(a) da with the elastic load of a spot; also next to D = 3/2, where the closed form
    changes."""
    theory = MajumdarBhushan(dimension, 1e-11, 1e11, 2e10, AREA)
    critical = theory.critical_area
    largest = ratio * critical

    def spot_load(log_area):
        a = math.exp(log_area)
        load = 4.0 / 3.0 * theory.E_star * (a / math.pi) ** 1.5 / float(theory.radius(a))
        return load * float(theory.sizes.density(a, largest)) * a

    whole = quad(spot_load, math.log(critical), math.log(largest), epsrel=1e-11)[0]
    assert float(theory.elastic_load(largest)) == pytest.approx(whole, rel=1e-9)


@given(dimension=DIMENSIONS)
def test_spots_yield_below_the_critical_area(dimension):
    theory = MajumdarBhushan(dimension, 1e-11, 1e11, 2e10, AREA)
    a = theory.critical_area
    yielding = (math.pi * theory.hardness / (2.0 * theory.E_star)) ** 2 * float(theory.radius(a))
    assert float(theory.interference(a)) == pytest.approx(yielding, rel=1e-9)
    smaller, larger = 0.5 * a, 2.0 * a
    assert float(theory.load(smaller)) == pytest.approx(theory.hardness * float(theory.sizes.area(smaller)), rel=1e-12)
    assert float(theory.elastic_area(smaller)) == 0.0
    assert 0.0 < float(theory.elastic_area(larger)) < float(theory.sizes.area(larger))


@given(dimension=DIMENSIONS, log_load=st.floats(-9.0, -1.0))
def test_the_largest_spot_under_a_load(dimension, log_load):
    theory = MajumdarBhushan(dimension, 1e-11, 1e11, 2e10, AREA)
    load = 10.0**log_load * float(theory.load(theory.sizes.largest(AREA)))
    assert float(theory.load(theory.largest_spot_under(load))) == pytest.approx(load, rel=1e-9)


@pytest.mark.parametrize(("dimension", "exponent"), [(1.2, 0.9), (1.4, 0.8), (1.6, 0.8), (1.8, 0.9)])
def test_the_load_of_elastic_spots_is_a_power_of_the_area(dimension, exponent):
    theory = MajumdarBhushan(dimension, 1e-13, 1e11, 2e11, AREA)  # so hard that a_c is nothing beside a_l
    ratio = float(theory.load(1e-3) / theory.load(1e-4))
    # the terms left out are (a_c/a_l)^|3/2 - D| of those kept
    left_out = (theory.critical_area / 1e-4) ** abs(1.5 - dimension)
    assert left_out < 0.1
    assert math.log10(ratio) == pytest.approx(exponent, abs=left_out)


def test_what_cannot_be_is_refused():
    with refused(InputError, "dimension of majumdar-bhushan"):
        MajumdarBhushan(2.0, 1e-12, 1e11, 1e9, 1e-8)
    theory = MajumdarBhushan(1.3, 1e-12, 1e11, 1e9, 1e-8)
    with refused(NoSolutionError, "load (N)"):
        theory.largest_spot_under(1e9)
    with refused(InputError, "area of a contact spot (m^2)"):
        theory.sizes.area(-1.0)
    assert MajumdarBhushan(1.01, 1.0, 1e11, 1e9, 1e-8).critical_area == math.inf


def test_the_theory_of_a_surface():
    """A map made of a self-affine spectrum: dimension from its second differences, prediction =
    that of the parameters."""
    waves = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(5e-9), hurst=0.6, rolloff_wavelength=2e-6, shortest_wavelength=2e-8
    )
    surface = asp.generate.gaussian(asp.Grid((192, 192), (10e-9, 10e-9)), waves, seed=2)
    measured = asp.roughness_of(surface)
    theory = theory_by_name("majumdar-bhushan").from_roughness(measured, 1e11, hardness=5e9)
    fit = asp.roughness.fit_spectrum(asp.roughness.power_spectrum(surface))
    along_x, along_y = (asp.roughness.fractal_parameters(surface, axis=axis, lag_range=fit.lag_range) for axis in "xy")
    assert theory.dimension == pytest.approx(0.5 * (along_x.dimension + along_y.dimension), rel=1e-14)
    assert theory.roughness**2 == pytest.approx(along_x.roughness * along_y.roughness, rel=1e-12)
    error = 0.5 * (along_x.dimension_error + along_y.dimension_error)  # of the mean at most
    assert abs(theory.dimension - (2.0 - 0.6)) < 4.0 * error
    curve = theory.at_pressure([1e6, 1e7])
    for pressure, area in zip(curve.pressure, curve.area_fraction, strict=True):
        spot = theory.sizes.largest(area * theory.nominal_area)
        assert float(theory.load(spot)) == pytest.approx(pressure * theory.nominal_area, rel=1e-9)
    atoms, whole = theory.validity(curve)
    assert atoms.holds.tolist() == [theory.critical_area >= 1e-19] * 2
    assert whole.holds.all()
    with refused(InputError, "roughness for the theory majumdar-bhushan"):
        MajumdarBhushan.from_roughness(Roughness(1e-18, 1e-2, 1e14, area=1e-8), 1e11, hardness=1e9)


def test_it_is_for_few_contacts_of_surfaces_that_are_self_affine_over_a_decade():
    def broken(longest):
        measured = Roughness(1e-18, 1e-2, 1e14, area=AREA, fractal=Fractal(1.4, 1e-12, 4e-9, longest))
        theory = MajumdarBhushan.from_roughness(measured, 1e11, hardness=5e9)
        return [limit.criterion for limit in theory.validity(curve, measured) if not limit.holds.all()]

    curve = MajumdarBhushan(1.4, 1e-12, 1e11, 5e9, AREA).at_pressure([1e6, 1e7])
    assert broken(5e-8) == broken(math.nan) == []
    assert broken(3e-8) == ["longest over shortest length of self-affine profiles"]
    theory = MajumdarBhushan(1.4, 1e-12, 1e11, 5e9, AREA)
    crowded = theory.at_pressure([1e6, 1e8])
    assert crowded.area_fraction[1] > 0.02
    assert theory.validity(crowded)[0].holds.tolist() == [True, False]
