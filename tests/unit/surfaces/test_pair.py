"""Composite of two surfaces: sums, mirrors, masks and refusals."""

import numpy as np
import pytest
from ensemble import average, periodic_statistics, require_accepted, rows
from refusals import refused

from asperity.core.errors import InputError
from asperity.core.grid import Grid
from asperity.generate import PlateauPSD, SelfAffine, gaussian, sinusoid, sphere
from asperity.surfaces.pair import composite
from asperity.surfaces.surface import Origin, Surface


def noise(seed, periodic=False, shape=(6, 5)):
    heights = np.random.default_rng(seed).standard_normal(shape)
    return Surface(heights, 1.0, 2.0, periodic=periodic, origin=Origin(source=f"map {seed}", history=("measured",)))


def test_two_spheres_make_one_of_the_reduced_radius():
    grid = Grid((9, 9), (1e-7, 1e-7))
    pair = composite(sphere(grid, radius=1e-5), sphere(grid, radius=3e-5))
    np.testing.assert_allclose(pair.heights, sphere(grid, radius=0.75e-5).heights, rtol=1e-14)


def test_sum_is_symmetric_and_records_both():
    one, two = noise(1), noise(2)
    pair = composite(one, two)
    np.testing.assert_array_equal(pair.heights, one.heights + two.heights)
    np.testing.assert_array_equal(composite(two, one).heights, pair.heights)
    assert pair.origin.source == "map 1 + map 2"
    assert pair.origin.history == (
        "surface 1: measured",
        "surface 2: measured",
        "composite: sum of surfaces 1 and 2",
    )
    assert (pair.dx, pair.dy) == (1.0, 2.0)


@pytest.mark.parametrize(("mirrored", "axis"), [("x", 0), ("y", 1)])
def test_mirror_of_the_counter_surface(mirrored, axis):
    one, two = noise(1), noise(2)
    pair = composite(one, two, mirrored=mirrored)
    np.testing.assert_array_equal(pair.heights, one.heights + np.flip(two.heights, axis))
    assert f"surface 2: turned over: mirrored along {mirrored}" in pair.origin.history


def test_periodic_mirror_is_about_node_zero():
    one, two = noise(1, periodic=True), noise(2, periodic=True)
    pair = composite(one, two, mirrored="x")
    nodes = -np.arange(6) % 6
    np.testing.assert_array_equal(pair.heights, one.heights + two.heights[nodes])
    wave = sinusoid(Grid((16, 4), (1.0, 1.0)), amplitude=1.0, wavelength=8.0)  # even about node 0
    np.testing.assert_allclose(composite(wave, wave, mirrored="x").heights, 2 * wave.heights, atol=1e-14)


def test_masks_combine():
    one, two = noise(1), noise(2)
    first = Surface(one.heights, 1.0, 2.0, mask=np.eye(6, 5, dtype=bool))
    second = Surface(two.heights, 1.0, 2.0, mask=np.arange(30).reshape(6, 5) == 1)
    mask = np.eye(6, 5, dtype=bool)
    mask[5, 1] = True  # the second mask after its mirror
    np.testing.assert_array_equal(composite(first, second, mirrored="x").mask, mask)


def test_periodic_only_if_both_are():
    assert composite(noise(1, True), noise(2, True)).periodic
    assert not composite(noise(1, True), noise(2)).periodic


def test_refusals():
    with refused(InputError, "the two surfaces of a pair"):
        composite(noise(1), noise(2, shape=(6, 6)))
    other = noise(2)
    with refused(InputError, "the two surfaces of a pair"):
        composite(noise(1), Surface(other.heights, 1.0, 2.001))
    with refused(InputError, "mirror of the counter surface"):
        composite(noise(1), other, mirrored="z")


def test_composite_of_two_random_surfaces_meets_its_acceptance_intervals():
    """Moments and spectra of independent surfaces add."""
    grid = Grid((128, 128), (0.1, 0.1))
    one = SelfAffine(amplitude=PlateauPSD(2e-5), hurst=0.8, rolloff_wavelength=2.9, shortest_wavelength=0.47)
    two = SelfAffine(amplitude=PlateauPSD(1e-5), hurst=0.6, rolloff_wavelength=1.7, shortest_wavelength=0.53)

    def statistics(seed):
        pair = composite(gaussian(grid, one, seed=2 * seed), gaussian(grid, two, seed=2 * seed + 1), mirrored="x")
        found = periodic_statistics(pair.heights, grid.spacing)
        return {name: found[name] for name in ("m0", "m2x_fd", "m4x_fd")}

    require_accepted("G12", average(statistics(seed) for seed in range(int(rows("G12")[0]["n_realisations"]))))
