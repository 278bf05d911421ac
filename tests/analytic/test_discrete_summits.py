"""Theories of the very summits of a map, alone and pressing each other down, against reference
solutions and limits."""

from __future__ import annotations

import math
from typing import get_args

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference_data import every_row, reference
from refusals import refused
from summit_maps import summit_map

import asperity as asp
from asperity.core.errors import InputError
from asperity.theories.rough.discrete_summits import DiscreteSummits
from asperity.theories.rough.greenwood_williamson import GreenwoodWilliamson
from asperity.theories.rough.interacting_crests import InteractingCrests, Interaction, Method
from asperity.theories.single.waves import two_term_approach, two_term_load, two_terms
from asperity.theories.statistics.roughness import Roughness

AREA = 4e-12
CRESTS = {number: [] for number in sorted({row["set"] for row in reference("gw_interaction_asperities")})}
for _row in reference("gw_interaction_asperities"):
    CRESTS[_row["set"]].append(_row)


def crests(number: float, **choices) -> InteractingCrests:
    """The crests of one set of the reference."""
    columns = (np.array([row[name] for row in CRESTS[number]]) for name in ("x_m", "y_m", "z_m", "h_m", "lambda_m"))
    return InteractingCrests(1e11, *columns, AREA, **choices)


def radii(number: float) -> np.ndarray:
    return np.array([row["R_m"] for row in CRESTS[number]])


@every_row(reference("summit_map_discrete_gw"), label=lambda row: f"{row['map']:g}-{row['delta_m']:g}")
def test_summits_of_a_map(row):
    roughness = asp.roughness_of(summit_map(row["map"]))
    theory = DiscreteSummits.from_roughness(roughness, 91.2e9)
    assert roughness.summits.count == row["n_summits_8"]
    found = theory.at_separation(theory.highest - row["delta_m"])
    # second differences lose six digits of the heights, sums of cosines with phases of six digits
    # agree exactly
    assert found.area_fraction * roughness.area == pytest.approx(row["area_m2"], rel=1e-10)
    assert found.pressure * roughness.area == pytest.approx(row["load_N_Estar_91.2GPa"], rel=1e-10)
    assert found.contact_density * roughness.area == pytest.approx(row["n_contacts"])


def test_many_summits_of_a_distribution_are_its_integral():
    number, theory = 200_000, GreenwoodWilliamson(1e11, 1e12, 1e-6, 1e-8, mean_height=5e-9)
    heights = 5e-9 + 1e-8 * np.random.default_rng(8).standard_normal(number)
    discrete = DiscreteSummits(1e11, heights, np.full(number, 1e-6), number / 1e12)
    h = np.array([-1e-8, 5e-9, 2e-8, 3e-8])
    found, expected = discrete.at_separation(h), theory.at_separation(h)
    D = theory.standardised(h)
    for name, m in (("contact_density", 0.0), ("area_fraction", 1.0), ("pressure", 1.5)):
        first, second = (theory.heights.tail_moment(D, k * m) for k in (1, 2))
        error = np.sqrt((second - first**2) / number) / first  # of a mean of (s - D)^m
        assert np.all(np.abs(getattr(found, name) / getattr(expected, name) - 1.0) < 4.0 * error), name


def test_quantiles_converge_to_the_distribution():
    theory = GreenwoodWilliamson(1.0, 1.0, 1.0, 1.0)
    from scipy.special import ndtri

    errors = []
    for number in (100, 1000, 10_000):
        heights = ndtri((np.arange(number) + 0.5) / number)
        discrete = DiscreteSummits(1.0, heights, np.ones(number), float(number))
        errors.append(abs(float((discrete.at_separation(1.0).pressure / theory.at_separation(1.0).pressure)[0]) - 1.0))
    # the midpoint rule over the share of summits, whose last cell holds the tail: about first order
    assert errors[1] < 0.3 * errors[0]
    assert errors[2] < 0.3 * errors[1] < 0.01


@given(pressure=st.floats(1e2, 1e8), seed=st.integers(0, 5))
def test_pressures_on_summits_are_found_again(pressure, seed):
    rng = np.random.default_rng(seed)
    theory = DiscreteSummits(1e11, 1e-8 * rng.standard_normal(30), 1e-6 * (0.2 + rng.random(30)), 3e-11)
    found = theory.at_pressure(pressure)
    assert found.pressure == pytest.approx(pressure, rel=1e-9)
    assert found.separation < theory.highest


def test_a_single_summit_is_a_sphere():
    theory = DiscreteSummits(1e11, [0.0], [1e-6], 1e-12)
    found = theory.at_pressure(1e6)
    delta = (1e6 * 1e-12 * 3.0 / (4.0 * 1e11 * math.sqrt(1e-6))) ** (2.0 / 3.0)  # Hertz
    assert found.separation == pytest.approx(-delta, rel=1e-10)
    assert found.area_fraction == pytest.approx(math.pi * 1e-6 * delta / 1e-12, rel=1e-10)
    assert found.stiffness == pytest.approx(2.0 * 1e11 * math.sqrt(1e-6 * delta) / 1e-12, rel=1e-10)  # 2 E* a


@pytest.mark.parametrize(
    "row", reference("gw_interaction_results"), ids=lambda row: f"{row['set']:g}-{row['delta_m']:g}"
)
@pytest.mark.parametrize("method", get_args(Method))
@pytest.mark.parametrize(("interaction", "suffix"), [("far field", "int"), ("off", "sin")], ids=get_args(Interaction))
def test_interacting_crests(row, interaction, suffix, method):
    theory = crests(row["set"], interaction=interaction, method=method)
    found = theory.at_separation(theory.highest - row["delta_m"])
    assert found.contact_density * AREA == pytest.approx(row[f"n_{suffix}"])
    # residuals of 1e-13 of the approach; the reference has fifteen digits
    assert found.area_fraction * AREA == pytest.approx(row[f"area_{suffix}_m2"], rel=1e-12)
    assert found.pressure * AREA == pytest.approx(row[f"load_{suffix}_N"], rel=1e-12)


@pytest.mark.parametrize("number", CRESTS)
def test_without_interaction_paraboloids_are_greenwood_and_williamsons_summits(number):
    theory = crests(number, interaction="off", shape="paraboloid")
    spheres = DiscreteSummits(
        1e11, theory.height, np.asarray(theory.wavelength) ** 2 / (2.0 * np.pi**2 * theory.depth), AREA
    )
    h = theory.highest - np.array([5e-10, 2e-9, 8e-9, 4e-8])
    for name in ("pressure", "area_fraction", "contact_density", "stiffness"):
        found, expected = (getattr(item.at_separation(h), name) for item in (theory, spheres))
        assert found == pytest.approx(expected, rel=1e-11), name
    for row in (row for row in reference("gw_interaction_results") if row["set"] == number):
        assert theory.at_separation(theory.highest - row["delta_m"]).pressure * AREA == pytest.approx(
            row["load_gw_N"], rel=1e-11
        )


def test_interaction_fades_with_the_distance():
    near = crests(7)
    h = near.highest - 4e-9
    alone = crests(7, interaction="off").at_separation(h).pressure
    losses = []
    for stretch in (1.0, 10.0, 100.0):
        spread = InteractingCrests(
            1e11,
            stretch * np.asarray(near.x),
            stretch * np.asarray(near.y),
            near.height,
            near.depth,
            near.wavelength,
            AREA,
        )
        losses.append(1.0 - float((spread.at_separation(h).pressure / alone)[0]))
    assert losses[0] > 0.05
    # displacements go as the reciprocal of the distance, once they are small
    assert losses[2] == pytest.approx(0.1 * losses[1], rel=0.1)


@pytest.mark.parametrize("shape", ["sine", "paraboloid"])
def test_two_crests_at_one_height_share_the_load(shape):
    pair = InteractingCrests(1e11, [0.0, 4e-7], [0.0, 0.0], [0.0, 0.0], [1e-8, 1e-8], [2e-7, 2e-7], 1e-12, shape=shape)
    w = pair.squared_radii(2e-9)
    assert w[0] == pytest.approx(w[1], rel=1e-12)
    A1, A2 = two_terms(1e-8, 2e-7)
    A2 = A2 if shape == "sine" else 0.0 * A2
    # each is pressed down by the load of the other over π E* r
    rest = two_term_approach(w[0] ** 0.5, A1, A2) + two_term_load(w[0] ** 0.5, 1.0, A1, A2) / (math.pi * 4e-7)
    assert float(rest) == pytest.approx(2e-9, rel=1e-11)


@pytest.mark.parametrize("method", get_args(Method))
@pytest.mark.parametrize(("lower", "touches"), [(1.2e-10, True), (1.8e-10, False)])
def test_a_high_crest_lifts_its_neighbour_off_the_plane(lower, touches, method):
    delta, distance, depth = 2e-10, 1.5e-7, np.array([1e-8, 1e-8])
    wavelength = np.array([1.2e-6, 2e-7])
    theory = InteractingCrests(
        1e11, [0.0, distance], [0.0, 0.0], [0.0, -lower], depth, wavelength, 1e-12, method=method
    )
    w, (A1, A2) = theory.squared_radii(delta), two_terms(1e-8, 1.2e-6)
    # the neighbour, which would be pressed by this much, sinks under the load of the high crest
    sink = float(two_term_load(w[0] ** 0.5, 1.0, A1, A2)) / (math.pi * distance)
    assert 2e-11 < sink < 8e-11
    assert (w[1] > 0.0) == touches == (delta - lower > sink)


@pytest.mark.parametrize("interaction", get_args(Interaction))
@pytest.mark.parametrize("method", get_args(Method))
def test_pressures_on_interacting_crests_are_found_again(interaction, method):
    theory = crests(5, interaction=interaction, method=method)
    h = theory.highest - np.array([4e-9, 1e-10, 2e-9])
    expected = theory.at_separation(h)
    found = theory.at_pressure(expected.pressure)
    assert found.separation == pytest.approx(h, abs=1e-9 * 4e-9)
    assert found.area_fraction == pytest.approx(expected.area_fraction, rel=1e-8)
    higher, lower = (theory.at_separation(h + sign * 1e-14).pressure for sign in (1.0, -1.0))
    # central differences of a step of 1e-14 m, rounding 1e-13 of the pressure
    assert expected.stiffness == pytest.approx((lower - higher) / 2e-14, rel=1e-6)


def test_validity_of_interacting_crests():
    theory = crests(7)
    found = theory.at_separation(theory.highest - np.array([1e-10, 8e-9]))
    area, slender, near = theory.validity(found)
    assert area.holds.all()
    assert slender.holds.tolist() == [True, False]
    assert np.all(near.value < 1.0)


def test_crests_of_a_map_have_its_radii():
    roughness = asp.roughness_of(summit_map(4))
    theory = InteractingCrests.from_roughness(roughness, 1e11)
    radius = np.asarray(theory.wavelength) ** 2 / (2.0 * np.pi**2 * np.asarray(theory.depth))
    assert np.sort(radius) == pytest.approx(np.sort(roughness.summits.radius), rel=1e-12)


def test_what_crests_cannot_do_is_refused():
    theory = crests(1)
    with refused(InputError, "contact radii"):
        theory.at_separation(theory.highest - 2e-8)
    with refused(InputError, "arrays of crests"):
        InteractingCrests(1e11, [0.0], [0.0], [0.0], [1e-8], [1e-7, 1e-7], 1e-12)
    with refused(InputError, "crests"):
        InteractingCrests(1e11, [0.0, 0.0], [0.0, 0.0], [0.0, 0.0], [1e-8] * 2, [1e-7] * 2, 1e-12).squared_radii(1e-9)
    with refused(InputError, "heights and radii of summits"):
        DiscreteSummits(1e11, [0.0], [1e-6, 1e-6], 1e-12)
    with refused(InputError, "roughness for the theory discrete-summits"):
        DiscreteSummits.from_roughness(Roughness(1e-18, 1e-3, 1e13), 1e11)


def test_crowded_crests_settle_at_loads_far_apart():
    """Contact radii up to the distances, as on a map that is rough down to its pixels: at once,
    from single crests, nothing settles."""
    rng = np.random.default_rng(3)
    side, count, radius = 1e-6, 400, 8e-8
    places = side / 20 * (np.divmod(np.arange(count), 20) + 0.8 * rng.random((2, count)))
    depth = np.full(count, 2e-9)
    wavelength = math.pi * np.sqrt(2.0 * radius * depth)
    heights = 2e-9 * rng.standard_normal(count)
    theory = InteractingCrests(1e11, *places, heights, depth, wavelength, side**2, shape="paraboloid")
    loads = np.array([1e7, 8e9])
    coarse, fine = theory.at_pressure(loads), theory.at_pressure(np.geomspace(*loads, 40))
    np.testing.assert_allclose(coarse.area_fraction, fine.area_fraction[[0, -1]], rtol=1e-9)
    np.testing.assert_allclose(theory.at_pressure(8e9).area_fraction, coarse.area_fraction[1:], rtol=1e-9)
    for separation, load in zip(coarse.separation, loads, strict=True):
        assert theory.at_separation(separation).pressure == pytest.approx(load, rel=1e-9)
