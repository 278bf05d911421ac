"""Edges, perimeter and spots on patterns one can count by hand."""

import copy
from dataclasses import replace

import numpy as np
import pytest
from contact_cases import elastic, rough
from hypothesis import given, settings
from hypothesis import strategies as st

import asperity as asp
from asperity.contact import measure
from asperity.contact.edge_tables import PATCHES, WAVES
from asperity.contact.edges import Setting, edges_of


def pattern(text):
    return np.array([[c == "#" for c in line] for line in text.split()])


def edges(contact, spacing=(1.0, 1.0), *, periodic=False, gap=1.0):
    """Edges of a contact of pressure one on a pattern, with a gap that is wide against what the
    pressure opens."""
    wraps, table = (periodic, periodic), WAVES if periodic else PATCHES
    grid = asp.Grid(contact.shape, spacing)
    return edges_of(contact * 1.0, ~contact * gap, np.zeros(contact.shape, bool), Setting(grid, wraps, 1.0, table))


def test_pairs_are_neighbours_in_and_out_of_contact():
    found = edges(pattern("..... .##.. ....."), (2.0, 3.0))
    assert sorted(found.inner.tolist()) == [6, 6, 6, 7, 7, 7]
    assert sorted(found.outer.tolist()) == [1, 2, 5, 8, 11, 12]
    assert not found.beyond.any()


def test_border_is_an_edge_only_where_free():
    contact = pattern("## ##")
    free, periodic = edges(contact), edges(contact, periodic=True)
    assert free.beyond.all()
    assert free.perimeter() == 8.0
    assert free.excess.sum() == free.area_error() == 0.0
    assert periodic.inner.size == 0


def test_straight_edges_are_found_where_they_are():
    """Pressures and gaps of the tables, along the grid and between their rows."""
    for table in (PATCHES, WAVES):
        for at in (3, 11.5, 33, 38):
            low, high = int(np.floor(at)), int(np.ceil(at))
            distance, last, second, gap = (0.5 * (column[low] + column[high]) for column in table)
            p, g = np.zeros((9, 7)), np.zeros((9, 7))
            p[:6], p[4], p[5], g[6:] = 3.0, np.sqrt(second), np.sqrt(last), 1.0
            g[6] = 4.0 / 3.0 * gap**1.5
            found = edges_of(
                p, g, np.zeros((9, 7), bool), Setting(asp.Grid((9, 7), (1.0, 2.0)), (False, True), 1.0, table)
            )
            inside = ~found.beyond
            np.testing.assert_allclose(found.distance[inside], distance, atol=2e-3)
            np.testing.assert_allclose(found.spread[inside], 0.0, atol=2e-3)
            np.testing.assert_allclose(found.normal[inside], [[1.0, 0.0]] * 7, atol=1e-12)
            assert found.perimeter() == pytest.approx(7 * 2.0 + 7 * 2.0)


def test_spots_join_across_a_periodic_border():
    contact = pattern("#...# ..... ..#.. ..#.. #....")
    assert measure.contact_spots(contact, wraps=(False, False)).tolist() == [2, 1, 1, 1]
    assert measure.contact_spots(contact, wraps=(True, True)).tolist() == [3, 2]


def test_diagonal_neighbours_are_two_spots():
    assert measure.contact_spots(pattern("#. .#"), wraps=(False, False)).tolist() == [1, 1]


def test_no_contact():
    nothing = np.zeros((4, 4), dtype=bool)
    assert measure.contact_spots(nothing, wraps=(True, True)).size == 0
    assert edges(nothing).inner.size == edges(nothing).perimeter() == 0


@settings(max_examples=50)
@given(st.integers(0, 10**6), st.floats(0.1, 0.9), st.integers(0, 20), st.integers(0, 20), st.booleans())
def test_spots_conserve_pixels_and_do_not_care_where_the_map_starts(seed, share, i, j, periodic):
    contact = np.random.default_rng(seed).random((9, 12)) < share
    spots = measure.contact_spots(contact, wraps=(periodic, periodic))
    assert spots.sum() == np.count_nonzero(contact)
    assert (np.diff(spots) <= 0).all()
    if periodic:
        moved = np.roll(contact, (i, j), (0, 1))
        np.testing.assert_array_equal(measure.contact_spots(moved, wraps=(True, True)), spots)


def test_distribution_integrates_to_one_and_holds_the_mean():
    values = np.random.default_rng(0).random(10000) ** 2
    found = measure.distribution(values, 200)
    width = np.diff(found.edges)
    assert (found.density * width).sum() == pytest.approx(1.0, rel=1e-12)
    middle = 0.5 * (found.edges[1:] + found.edges[:-1])
    assert (middle * found.density * width).sum() == pytest.approx(values.mean(), abs=width[0] / 2)
    for bad in (np.zeros(0), values):
        with pytest.raises(asp.InputError):
            measure.distribution(bad, 0 if bad.size else 5)


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()])
def test_stiffness_is_the_exact_derivative_on_a_fixed_contact(boundary):
    """Against the dense matrix: ones . K_CC^-1 . ones over the number of points."""
    problem = asp.ContactProblem(rough((12, 10), 3), elastic(1.0), boundary=boundary)
    result = asp.solve(problem, asp.MeanPressure(0.05))
    operator = asp.solvers.prepare_operator(problem.compliance, problem.grid, boundary)
    c = result.contact.ravel()
    dense = operator.matrix()[np.ix_(c, c)]
    exact = np.linalg.solve(dense, np.ones(c.sum())).sum() / c.size
    assert result.normal_stiffness == pytest.approx(exact, rel=1e-5)


def test_stiffness_of_nothing_is_zero_and_can_be_left_out():
    problem = asp.ContactProblem(rough((8, 8)), elastic(1.0), law=asp.Hardness(0.1))
    plastic = asp.solve(problem, asp.MeanPressure(0.1))
    assert plastic.normal_stiffness == 0.0
    left_out = asp.solve(problem, asp.MeanPressure(0.05), keep=asp.Keep(stiffness=False))
    assert np.isnan(left_out.normal_stiffness)


@pytest.mark.parametrize("law", [asp.plasticity.HardWall(), asp.Hardness(0.2)], ids=["elastic", "capped"])
def test_stiffness_takes_its_linear_solve_when_it_is_first_read(law, monkeypatch):
    solved: list[int] = []
    solve = measure.conjugate_gradients

    def counting(system, *arguments, **options):
        solved.append(system.free.size)
        return solve(system, *arguments, **options)

    problem = asp.ContactProblem(rough((32, 24), 5), elastic(1.0), law=law)
    monkeypatch.setattr(measure, "conjugate_gradients", counting)
    result = asp.solve(problem, asp.MeanPressure(0.1))
    assert solved == []
    moving = result.contact & ~result.plastic
    operator = asp.solvers.prepare_operator(problem.compliance, problem.grid, problem.boundary)
    wanted = measure.normal_stiffness(operator, moving)
    copied = copy.copy(replace(result, citation_keys=()))
    for _ in range(2):
        assert result.normal_stiffness == copied.normal_stiffness == wanted
    assert solved == 2 * [np.count_nonzero(moving)]  # once here, once by the result, of which the copies take it


@pytest.mark.parametrize("radius", [2.2, 5.3, 11.7])
def test_area_of_a_sphere_lies_within_its_error(radius):
    """Hertz' area is exact; the error, of two standard deviations, is far less than the pixels
    counted too many."""
    pixel, modulus, off = 1e-7, 1e9, np.random.default_rng(7)
    x = pixel * np.arange(32)
    misses = []
    for at in pixel * (15.0 + off.random((4, 2))):
        heights = -((x[:, None] - at[0]) ** 2 + (x[None, :] - at[1]) ** 2) / 2e-4
        problem = asp.ContactProblem(asp.Surface(heights, pixel), asp.Elastic(modulus, 0.0), boundary=asp.Free())
        found = asp.solve(problem, asp.Force(4.0 / 3e-4 * modulus * (radius * pixel) ** 3))
        exact = np.pi * radius**2 / x.size**2
        misses.append((found.area_fraction_corrected - exact) / found.area_fraction_error)
        assert found.area_fraction_error < found.area_fraction
    assert np.sqrt(np.mean(np.square(misses))) < 0.5 * np.sqrt(2.7)  # chi squared of 4, at 3 %


@pytest.mark.slow
@pytest.mark.parametrize(("seed", "shortest"), [(1, 4), (3, 16)])
def test_area_of_a_rough_surface_lies_within_its_error_on_every_grid(seed, shortest):
    """One surface on 128² to 1024² pixels: each area is that of the finest grid within the errors
    of both, which fall with the pixel."""
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(0.1), hurst=0.8, rolloff_wavelength=32.0, shortest_wavelength=float(shortest)
    )
    coarse = asp.generate.gaussian(asp.Grid((128, 128), (1.0, 1.0)), spectrum, seed=seed).heights
    found = []
    for n in (128, 256, 512, 1024):
        padded = np.zeros((n, n), complex)
        begin = (n - 128) // 2
        padded[begin : begin + 128, begin : begin + 128] = np.fft.fftshift(np.fft.fft2(coarse))
        heights = np.fft.ifft2(np.fft.ifftshift(padded)).real * (n / 128) ** 2
        problem = asp.ContactProblem(asp.Surface(heights, 128 / n, periodic=True), asp.Elastic(1e9, 0.0))
        found.append(asp.solve(problem, asp.MeanPressure(2e6)))
    for result in found[:-1]:
        apart = abs(result.area_fraction_corrected - found[-1].area_fraction_corrected)
        assert apart < result.area_fraction_error + found[-1].area_fraction_error
    assert found[0].area_fraction_error > 6.0 * found[-1].area_fraction_error


def test_no_border_no_error():
    assert edges(np.ones((4, 4), dtype=bool), periodic=True).area_error() == 0.0
