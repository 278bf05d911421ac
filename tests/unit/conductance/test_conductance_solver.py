"""Flux on given contact sets: against closed forms, with bounds, films and conducting gaps."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from reference_data import every_row, reference
from refusals import refused

import asperity as asp
from asperity.contact.operators import prepare_operator
from asperity.core.errors import InputError
from asperity.physics.conductance.operator import (
    ELECTRICAL,
    THERMAL,
    Filmed,
    LayeredConductor,
    conductors,
    harmonic_mean,
    layers_in_series,
)
from asperity.physics.conductance.solver import CLOSE, Flux, flux, flux_with_gap
from asperity.solids import Conduction
from asperity.solids.compliance.halfspace import HalfSpace
from asperity.theories.conductance import spots

BIAS = 0.117
"""By how many pixels a disc of constant flux on pixels conducts like a smaller one."""


CONDUCTORS = (HalfSpace(3.0), LayeredConductor((2.0, 0.5), (10.0, 0.1, 1.0)), Filmed(HalfSpace(1.0), 2.0))


def disc(pixels: float, *, beyond: int = 2, x: float = 0.31, y: float = 0.17) -> np.ndarray:
    """A disc of about so many pixels in the radius, off the middle of the grid."""
    n = int(2 * pixels) + 2 * beyond
    place = np.arange(n) - 0.5 * (n - 1)
    return np.hypot(place[:, None] - x, place[None, :] - y) < pixels


def solved(contact: np.ndarray, compliance, spacing: float, boundary=None) -> tuple[Flux, float]:
    """Flux and conductance."""
    grid = asp.Grid(contact.shape, (spacing, spacing))
    found = flux(prepare_operator(compliance, grid, boundary or asp.Free()), contact)
    return found, found.mean * grid.area


def extrapolated(compliance, sizes=(20.0, 40.0)) -> float:
    """Conductance of a disc of radius one: the error of the pixels is of first order."""
    found = []
    for pixels in sizes:
        contact = disc(pixels)
        found.append(solved(contact, compliance, math.sqrt(math.pi / contact.sum()))[1])
    return 2.0 * found[1] - found[0]


@every_row(reference("transport/coated_spot"), label=lambda row: str(row["case"]))
def test_coated_spots(row: dict[str, float]) -> None:
    """First-order errors are extrapolated; what is left falls from 1.6e-4 to 6e-5 with the next
    halving."""
    compliance = LayeredConductor((row["h_over_a"],), (row["k1_over_k2"], 1.0))
    assert extrapolated(compliance) == pytest.approx(row["G_over_k2_a"], rel=2e-4)


@every_row(reference("transport/spot_clusters"), label=lambda row: str(row["configuration"]))
def test_clusters_of_discs(row: dict[str, float]) -> None:
    """Each radius is taken larger by the bias of the pixels; what is left is the staircase."""
    every = reference("transport/spot_cluster_spots")
    listed = [spot for spot in every if spot["configuration"] == row["configuration"]]
    x, y, a = np.array([[float(spot[key]) for key in ("x", "y", "radius")] for spot in listed]).T
    dx = 1.0 / 16.0
    low, high = (min((place - a).min() for place in (x, y)) - dx, max((place + a).max() for place in (x, y)) + dx)
    place = low + dx * (np.arange(int((high - low) / dx) + 2) + 0.37)
    apart = np.hypot(place[:, None, None] - x, place[None, :, None] - y)
    owner = np.where((apart < a + BIAS * dx).any(axis=2), apart.argmin(axis=2), -1)
    found, total = solved(owner >= 0, HalfSpace(2.0), dx)
    assert total == pytest.approx(row["G_over_k"], rel=5e-3)
    currents = [dx * dx * float(found.density[owner == n].sum()) for n in range(a.size)]
    np.testing.assert_allclose(currents, [spot["current_over_kV"] for spot in listed], rtol=1.5e-2)


@every_row(reference("transport/periodic_strips"), label=lambda row: str(row["case"]))
def test_strips_converge_in_proportion_to_the_pixel(row: dict[str, float]) -> None:
    errors = []
    for n in (100, 200, 400):
        contact = np.zeros((n, 1), dtype=bool)
        contact[: round(row["contact_fraction"] * n)] = True
        grid = asp.Grid(contact.shape, (1.0 / n, 1.0))
        found = flux(prepare_operator(HalfSpace(1.0), grid, asp.Periodic()), contact)
        errors.append(1.0 - found.mean / row["h_lambda_over_ks"])
    if row["contact_fraction"] <= 0.95:  # few pixels apart beyond
        np.testing.assert_allclose(np.divide(errors[:-1], errors[1:]), 2.0, rtol=0.1)
    assert 0.0 < errors[2] < 0.2
    assert abs(2.0 * errors[2] - errors[1]) < 0.15 * errors[2]


def test_squares_converge_to_their_capacity() -> None:
    found = [solved(np.pad(np.ones((n, n), dtype=bool), 1), HalfSpace(1.0), 1.0 / n)[1] for n in (32, 64)]
    assert 2.0 * found[1] - found[0] == pytest.approx(spots.square(1.0, 1.0), rel=5e-4)


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()])
@pytest.mark.parametrize("compliance", CONDUCTORS)
def test_bounds_hold_the_solution_of_a_dense_system(boundary, compliance) -> None:
    contact = np.random.default_rng(3).random((16, 12)) < 0.4
    grid = asp.Grid(contact.shape, (1.0, 0.7))
    operator = prepare_operator(compliance, grid, boundary)
    at = contact.ravel()
    matrix = operator.matrix()[np.ix_(at, at)]
    exact = np.linalg.solve(matrix, np.ones(at.sum()))
    found = flux(operator, contact)
    # an error e has K e = r, so that it is at most the residual over the least eigenvalue
    most = found.residual * math.sqrt(at.sum()) / operator.smallest
    assert np.linalg.norm(found.density[contact] - exact) <= most + 1e-12 * np.linalg.norm(exact)
    np.testing.assert_allclose(found.density[contact], exact, rtol=1e-4)  # the root of CLOSE
    assert found.lower <= exact.sum() / at.size * (1.0 + 1e-12)
    assert found.upper >= exact.sum() / at.size * (1.0 - 1e-12)
    assert found.upper / found.lower - 1.0 <= CLOSE
    assert not found.density[~contact].any()


def test_a_wider_contact_conducts_more() -> None:
    operator = prepare_operator(HalfSpace(1.0), asp.Grid((24, 24), (1.0, 1.0)), asp.Periodic())
    rng, contact, last = np.random.default_rng(5), np.zeros((24, 24), dtype=bool), 0.0
    for _ in range(6):
        contact |= rng.random((24, 24)) < 0.1
        found = flux(operator, contact)
        assert found.lower > last
        last = found.upper


def test_film_alone_conducts_by_area_and_in_series() -> None:
    contact = disc(12.0)
    thick, clean = (solved(contact, Filmed(HalfSpace(1.0), film), 1.0)[1] for film in (1e6, 1e-9))
    assert thick == pytest.approx(contact.sum() / 1e6, rel=1e-4)
    assert clean == pytest.approx(solved(contact, HalfSpace(1.0), 1.0)[1], rel=1e-7)
    both = solved(contact, Filmed(HalfSpace(1.0), 20.0), 1.0)[1]
    in_series = 1.0 / clean + 20.0 / contact.sum()
    assert in_series < 1.0 / both < 1.1 * in_series  # Thomson: each part takes at least its own minimum


def test_layers_have_the_limits_of_the_half_spaces_and_of_a_closed_form() -> None:
    q = np.logspace(-3, 3, 50)
    k1, k2, h = 7.0, 2.0, 0.3
    beta, decay = (k1 - k2) / (k1 + k2), np.exp(-2.0 * q * h)
    expected = (1.0 + beta * decay) / (1.0 - beta * decay) / (k1 * q)
    np.testing.assert_allclose(LayeredConductor((h,), (k1, k2)).spectral(q), expected, rtol=1e-13)
    same = LayeredConductor((0.1, 0.2), (k1, k1, k1))
    np.testing.assert_allclose(same.spectral(q), 1.0 / (k1 * q), rtol=1e-13)
    on_metal = LayeredConductor((h, 2.0 * h), (k1, k2, math.inf))
    assert on_metal.mean_mode() == pytest.approx(h / k1 + 2.0 * h / k2)
    np.testing.assert_allclose(on_metal.spectral(1e-7), on_metal.mean_mode(), rtol=1e-6)
    grid = asp.Grid((20, 15), (0.1, 0.07))
    np.testing.assert_allclose(same.influence(grid), HalfSpace(2.0 * k1).influence(grid), rtol=1e-7)


# A gap that conducts beside the contact.


def dense_with_gap(operator, contact, gap, film) -> np.ndarray:
    matrix = operator.matrix() + np.diag(np.where(contact, 0.0, gap - film).ravel())
    return np.linalg.solve(matrix, np.ones(contact.size)).reshape(contact.shape)


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()])
@pytest.mark.parametrize("film", [0.0, 3.0])
@pytest.mark.parametrize("gas", [1e-3, 1.0, 1e2])
def test_conducting_gap_is_the_dense_solution(boundary, film: float, gas: float) -> None:
    rng = np.random.default_rng(2)
    contact, gap = rng.random((14, 10)) < 0.2, rng.random((14, 10)) + 0.2
    total = Filmed(HalfSpace(1.0), film) if film else HalfSpace(1.0)
    operator = prepare_operator(total, asp.Grid(contact.shape, (1.0, 1.0)), boundary)
    found = flux_with_gap(operator, contact, gap / gas, film)
    dense = dense_with_gap(operator, contact, gap / gas, film)
    off = found.density - dense
    matrix = operator.matrix() + np.diag(np.where(contact, 0.0, gap / gas - film).ravel())
    # bounds closer than CLOSE leave that much of the energy: 1e-4 in its norm
    assert float(off.ravel() @ matrix @ off.ravel()) <= CLOSE * float(dense.sum())
    exact = float(dense.mean())
    assert found.lower <= exact * (1.0 + 1e-12)
    assert found.upper >= exact * (1.0 - 1e-12)


@pytest.mark.parametrize("points", [(2, 2), (8, 6)])
@pytest.mark.parametrize(("first", "second"), [(1.0, 1.0), (0.3, 5.0), (1e-3, 1.0), (1e3, 2e3)])
def test_a_checker_of_films_has_a_closed_form(points: tuple[int, int], first: float, second: float) -> None:
    """One wave alone answers: (d + s e) j = 1 with s = ±1 has the mean 1/(d - e²/(Z + d))."""
    operator = prepare_operator(HalfSpace(1.0), asp.Grid(points, (1.0, 0.7)), asp.Periodic())
    sign = 1.0 - 2.0 * (np.indices(points).sum(axis=0) % 2)
    resistance = np.where(sign > 0.0, first, second)
    wave = float(operator.apply(sign)[0, 0])
    middle, half = 0.5 * (first + second), 0.5 * (first - second)
    exact = 1.0 / (middle - half**2 / (wave + middle))
    found = flux_with_gap(operator, np.zeros(points, dtype=bool), resistance, 0.0)
    assert found.lower <= exact * (1.0 + 1e-12)
    assert found.upper >= exact * (1.0 - 1e-12)
    assert found.upper / found.lower - 1.0 <= CLOSE
    filmed = prepare_operator(Filmed(HalfSpace(1.0), first), asp.Grid(points, (1.0, 0.7)), asp.Periodic())
    beside = flux_with_gap(filmed, sign > 0.0, np.where(sign > 0.0, np.inf, second), first)  # a film in contact
    assert beside.lower <= exact * (1.0 + 1e-12)
    assert beside.upper >= exact * (1.0 - 1e-12)
    spent = beside.drop + np.where(sign > 0.0, 0.0, second) * beside.density  # in bodies and film, and in the gap
    np.testing.assert_allclose(spent, 1.0, atol=1e-4)


def test_a_full_film_conducts_as_one() -> None:
    grid = asp.Grid((12, 9), (1.0, 1.0))
    for film in (1e-3, 1.0, 1e3):
        operator = prepare_operator(Filmed(HalfSpace(1.0), film), grid, asp.Periodic())
        for found in (
            flux(operator, np.ones((12, 9), dtype=bool)),
            flux_with_gap(operator, np.zeros((12, 9), dtype=bool), np.full((12, 9), film), film),
        ):
            assert found.lower <= (1.0 + 1e-12) / film
            assert found.upper >= (1.0 - 1e-12) / film


@given(
    seed=st.integers(0, 2**31),
    periodic=st.booleans(),
    film=st.sampled_from([0.0, 0.1, 10.0]),
    scale=st.floats(-4.0, 4.0),
    spread=st.floats(0.0, 3.0),
    share=st.floats(0.0, 1.0),
    open_share=st.floats(0.0, 0.5),
    layered=st.booleans(),
)
@settings(max_examples=60, deadline=None)
def test_bounds_hold_whatever_the_gap_conducts(
    seed: int,
    periodic: bool,
    film: float,
    scale: float,
    spread: float,
    share: float,
    open_share: float,
    layered: bool,
) -> None:
    """Gaps of any conductance beside any contact: the dense solution lies within the bounds, and
    they within those of uniform flow and of uniform potential."""
    rng = np.random.default_rng(seed)
    shape, boundary = (9, 8), asp.Periodic() if periodic else asp.Free()
    contact = rng.random(shape) < share
    gap = 10.0 ** (scale + spread * (rng.random(shape) - 0.5))
    gap[rng.random(shape) < open_share] = np.inf
    conducts = contact | np.isfinite(gap)
    assume(conducts.any() and not (contact.all() and not film))
    bodies = LayeredConductor((2.0,), (10.0, 1.0)) if layered else HalfSpace(1.0)
    operator = prepare_operator(Filmed(bodies, film) if film else bodies, asp.Grid(shape, (1.0, 0.8)), boundary)
    found = flux_with_gap(operator, contact, np.where(contact, np.inf, gap), film)
    at = conducts.ravel()
    resistance = np.where(contact, film, gap).ravel()[at]
    matrix = operator.matrix()[np.ix_(at, at)] + np.diag(resistance - film)
    exact = float(np.linalg.solve(matrix, np.ones(at.sum())).sum()) / at.size
    assert found.lower <= exact * (1.0 + 1e-9)
    assert found.upper >= exact * (1.0 - 1e-9)
    assert found.upper / found.lower - 1.0 <= 10.0 * CLOSE
    if np.all(resistance > 0.0):
        assert exact <= float((1.0 / resistance).sum()) / at.size * (1.0 + 1e-9)
        if periodic and at.all():
            assert exact >= 1.0 / float(resistance.mean()) * (1.0 - 1e-9)


def test_a_gap_that_does_not_conduct_changes_nothing_and_alone_it_is_a_film() -> None:
    contact = disc(6.0)
    operator = prepare_operator(HalfSpace(1.0), asp.Grid(contact.shape, (1.0, 1.0)), asp.Free())
    closed = flux_with_gap(operator, contact, np.full(contact.shape, np.inf), 0.0)
    assert closed.mean == pytest.approx(flux(operator, contact).mean, rel=1e-9)
    poor = flux_with_gap(operator, np.zeros_like(contact), np.full(contact.shape, 1e7), 0.0)
    assert poor.mean == pytest.approx(1e-7, rel=1e-4)


# Bodies.


def solid(k: float = math.nan, name: str = "") -> asp.Elastic:
    return asp.Elastic(1e11, 0.3, name=name, conduction=Conduction(k))


def test_two_bodies_in_series() -> None:
    body, counter = solid(10.0), solid(30.0)
    k_s = 2.0 * 10.0 * 30.0 / 40.0
    assert conductors(body, counter, THERMAL) == HalfSpace(k_s)
    assert harmonic_mean(body, counter, THERMAL) == pytest.approx(k_s)
    assert conductors(body, asp.Rigid(), THERMAL) == HalfSpace(20.0)
    coated = asp.Layered([asp.Layer(solid(5.0), 1e-6), asp.Layer(solid(8.0), 0.0)], body)
    q = np.array([1e5, 1e6, 1e7])
    expected = LayeredConductor((1e-6,), (5.0, 10.0)).spectral(q) + 1.0 / (30.0 * q)
    np.testing.assert_allclose(conductors(coated, counter, THERMAL).spectral(q), expected, rtol=1e-14)
    np.testing.assert_allclose(conductors(coated, counter, THERMAL, 1e-7).spectral(q), expected + 1e-7, rtol=1e-14)
    assert layers_in_series(coated, coated, THERMAL) == pytest.approx(2.0 * 1e-6 / 5.0)
    assert harmonic_mean(coated, counter, THERMAL) == pytest.approx(2.0 * 5.0 * 30.0 / 35.0)


def test_missing_conductivities_name_the_material() -> None:
    with refused(InputError, "thermal conductivity of mild"):
        conductors(solid(name="mild"), asp.Rigid(), THERMAL)
    coated = asp.Layered([asp.Layer(solid(5.0), 1e-6), asp.Layer(solid(), 1e-6)], solid(3.0))
    with refused(InputError, "thermal conductivity of layer 2 of the counter body"):
        conductors(solid(1.0), coated, THERMAL)
    with refused(InputError, "electrical resistivity of body"):
        conductors(solid(1.0), coated, ELECTRICAL)
    with refused(InputError, "body and counter_body"):
        conductors(asp.Rigid(), asp.Rigid(), THERMAL)
