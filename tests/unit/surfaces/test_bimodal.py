"""Two textures, two processes, particles: moments in closed form, places, borders and refusals."""

import numpy as np
import pytest
from ensemble import average, require_accepted, rows
from refusals import refused
from scipy.special import ndtr
from scipy.stats import norm

from asperity.core.errors import InputError
from asperity.core.grid import Grid
from asperity.generate import (
    ExponentialAutocorrelation,
    GaussianAutocorrelation,
    RmsHeight,
    SelfAffine,
    bimodal,
    particles,
    two_process,
)

GRID = Grid((128, 128), (1.0, 1.0))
FINE, COARSE = ExponentialAutocorrelation(0.3, 4.0), ExponentialAutocorrelation(1.5, 20.0)
NEARLY_FLAT = SelfAffine(amplitude=RmsHeight(1e-12), hurst=0.5, rolloff_wavelength=20.0, shortest_wavelength=5.0)


def raw(heights):
    return {f"raw{power}": np.mean(heights**power) for power in (1, 2, 3, 4)}


def test_two_process_ensemble_meets_its_acceptance_intervals():
    made = (two_process(GRID, FINE, COARSE, offset=1.0, seed=s) for s in range(int(rows("G8")[0]["n_realisations"])))
    require_accepted("G8", average(raw(surface.heights) for surface in made))


def test_upper_of_two_processes_mirrors_the_lower():
    """max(X, Y) = -min(-X, -Y): the mean over realisations by the closed form."""
    found = np.array(
        [two_process(GRID, FINE, COARSE, offset=1.0, seed=s, keep="upper").heights.mean() for s in range(80)]
    )
    theta = np.hypot(0.3, 1.5)
    a = 1.0 / theta
    expected = 1.0 * ndtr(a) + theta * norm.pdf(a)
    assert found.mean() == pytest.approx(expected, abs=4.5 * found.std(ddof=1) / np.sqrt(80))


def test_two_textures_have_the_moments_of_their_mixture():
    p, separation, s1, s2 = 0.3, 2.0, 0.4, 1.0
    first, second = ExponentialAutocorrelation(s1, 6.0), ExponentialAutocorrelation(s2, 3.0)
    patches = ExponentialAutocorrelation(1.0, 6.0)
    found = np.array(
        [
            [np.mean(h**k) for k in (1, 2, 3, 4)]
            for h in (
                bimodal(GRID, first, second, share=p, separation=separation, patches=patches, seed=s).heights
                for s in range(60)
            )
        ]
    )
    mean = p * separation
    parts = ((p, separation - mean, s1), (1 - p, -mean, s2))
    central = [
        sum(w * (d**2 + s**2) for w, d, s in parts),
        sum(w * (d**3 + 3 * d * s**2) for w, d, s in parts),
        sum(w * (d**4 + 6 * d**2 * s**2 + 3 * s**4) for w, d, s in parts),
    ]
    expected = [
        mean,
        central[0] + mean**2,
        central[1] + 3 * mean * central[0] + mean**3,
        central[2] + 4 * mean * central[1] + 6 * mean**2 * central[0] + mean**4,
    ]
    error = found.std(axis=0, ddof=1) / np.sqrt(len(found))
    assert np.all(np.abs(found.mean(axis=0) - expected) < 4.5 * error)


def test_patches_are_as_large_as_their_field():
    made = bimodal(GRID, FINE, FINE, share=0.5, separation=100.0, patches=GaussianAutocorrelation(1.0, 30.0), seed=1)
    upper = made.heights > 50.0
    assert 0.2 < upper.mean() < 0.8
    assert np.mean(upper != np.roll(upper, 1, axis=0)) < 0.05
    assert made.periodic


def test_particles_are_spheres_of_the_asked_size_and_number():
    grid = Grid((400, 300), (1.0, 1.2))
    made = particles(grid, NEARLY_FLAT, density=2e-4, radius=8.0, exposure=1.0, seed=3)
    count = int(made.origin.history[0].split()[1])
    mean = 2e-4 * grid.area
    assert abs(count - mean) < 5.0 * np.sqrt(mean)
    # half sunk spheres: covered area by overlapping discs at random, 1 - exp(-n π R²)
    covered = np.mean(made.heights > 1e-9)
    scatter = np.sqrt(np.pi * 64.0 / grid.area)
    assert covered == pytest.approx(1.0 - np.exp(-count / grid.area * np.pi * 64.0), abs=5.0 * scatter)
    # the highest node lies within half a diagonal of a pixel of a centre
    assert 8.0 - (0.5**2 + 0.6**2) / 8.0 <= made.heights.max() <= 8.0 + 1e-9


def test_one_particle_lies_on_the_matrix_and_across_the_border():
    grid = Grid((64, 64), (1.0, 1.0))
    for seed in range(200):
        made = particles(grid, NEARLY_FLAT, density=1.0 / grid.area, radius=10.0, seed=seed)
        if made.origin.history[0].startswith("generated: 1 particles"):
            i, j = np.unravel_index(made.heights.argmax(), grid.shape)
            if min(i, j) < 5:
                break
    assert made.heights.max() == pytest.approx(20.0, abs=0.05)
    rolled = np.roll(made.heights, (32 - i, 32 - j), axis=(0, 1))
    assert rolled[32, 32 - 9] > 5.0
    assert rolled[32, 32 + 9] > 5.0
    assert rolled[32, 32 + 12] < 1e-6


def test_radii_scatter_and_stay_positive():
    grid = Grid((600, 600), (1.0, 1.0))
    made = particles(grid, NEARLY_FLAT, density=5e-5, radius=4.0, radius_deviation=3.0, exposure=2.0, seed=1)
    assert made.heights.max() > 2.0 * 6.0
    assert made.heights.min() > -1e-9


@pytest.mark.parametrize("keep", ["lower", "upper"])
def test_seeds_reproduce_and_streams_are_independent(keep):
    one = two_process(GRID, FINE, FINE, offset=0.0, seed=5, keep=keep)
    np.testing.assert_array_equal(one.heights, two_process(GRID, FINE, FINE, offset=0.0, seed=5, keep=keep).heights)
    # equal fields would give min(X, X) of zero mean; independent ones have the mean -+ σ/sqrt(π)
    sign = -1.0 if keep == "lower" else 1.0
    assert one.heights.mean() == pytest.approx(sign * 0.3 / np.sqrt(np.pi), abs=0.03)
    assert "seed 5" in one.origin.history[0]
    assert "PengBhushan2000" in one.citation_keys


@pytest.mark.parametrize(
    ("make", "subject", "shown"),
    [
        (lambda: two_process(GRID, FINE, COARSE, offset=np.nan, seed=1), "offset (m) of two_process()", "nan"),
        (lambda: two_process(GRID, FINE, COARSE, offset=0.0, seed=1, keep="both"), "keep of two_process()", "'both'"),
        (
            lambda: bimodal(GRID, FINE, COARSE, share=1.0, separation=1.0, patches=FINE, seed=1),
            "share of bimodal()",
            "1.0",
        ),
        (lambda: particles(GRID, FINE, density=1e5, radius=1.0, seed=1), "particles", "1.64e+09"),
        (
            lambda: particles(GRID, FINE, density=1e-3, radius=1.0, radius_deviation=-1.0, seed=1),
            "radius_deviation (m) of particles()",
            "-1.0",
        ),
        (lambda: particles(GRID, FINE, density=1e-2, radius=70.0, seed=1), "particles", "70 m"),
        (
            lambda: particles(GRID, FINE, density=1e-3, radius=7.0, exposure=2.5, seed=1),
            "exposure of particles()",
            "2.5",
        ),
    ],
)
def test_refusals(make, subject, shown):
    with refused(InputError, subject, shown):
        make()
