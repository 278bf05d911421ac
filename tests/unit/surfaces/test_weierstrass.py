"""Weierstrass-Mandelbrot functions: reference profiles, acceptance intervals, expectations in
closed form."""

import numpy as np
import pytest
from ensemble import average, require_accepted, rows
from reference_data import every_row, reference
from refusals import refused

from asperity.core.errors import InputError
from asperity.core.grid import Grid
from asperity.generate import weierstrass_mandelbrot, weierstrass_mandelbrot_profile
from asperity.surfaces.characterise.correlation import mean_square_increment
from asperity.surfaces.surface import Surface

PROFILES = reference("fractal_wm_profile_structure")
ESTIMATES = reference("fractal_wm_profile_estimates")
STRUCTURE = reference("fractal_wm_structure")


def profile(row):
    grid = Grid((int(row["N"]), 1), (row["dx_m"], 1e-6))
    gamma = row["gamma"]
    return weierstrass_mandelbrot_profile(
        grid,
        dimension=row["D"],
        roughness=row["G_m"],
        gamma=gamma,
        length=gamma ** -(row["n_first"] + 0.5),  # in the middle between two powers, so that rounding cannot choose
        shortest_wavelength=gamma ** -(row["n_last"] - 0.5),
    )


@every_row(PROFILES, label=lambda r: f"{r['set']:g}-{r['lag']:g}")
def test_structure_function_of_the_sampled_profile(row):
    """All phases zero: the profile itself is that of the reference, so are its sample structure
    function."""
    found = mean_square_increment(profile(row), (int(row["lag"]), 0))
    assert found == pytest.approx(row["S_sample_m2"], rel=1e-9)


@every_row(ESTIMATES, label=lambda r: f"{r['set']:g}")
def test_powers_of_the_reference_are_the_usual_ones(row):
    """n1 = floor(ln(1/L)/ln γ) for L = N dx and n2 = ceil(ln(1/2dx)/ln γ), by default."""
    grid = Grid((int(row["N"]), 1), (row["dx_m"], 1e-6))
    made = weierstrass_mandelbrot_profile(grid, dimension=row["D"], roughness=row["G_m"], gamma=row["gamma"])
    assert f"powers {int(row['n_first'])} to {int(row['n_last'])}" in made.origin.history[0]
    assert made.heights.std() == pytest.approx(row["std_m"], rel=1e-9)


@every_row(STRUCTURE[::3], label=lambda r: f"{r['D']:g}-{r['tau_m']:g}")
def test_expected_structure_function_over_random_phases(row):
    """Mean over 40 profiles of many waves, sampled at lag τ over a window, against the exact
    expectation."""
    tau, gamma, first, count = row["tau_m"], row["gamma"], int(row["n_first"]), int(row["n_terms"])
    grid = Grid((400, 1), (tau, 1e-6))
    kept = min(count, 40)  # shorter waves than these add less than 1e-3
    found = []
    for seed in range(40):
        made = weierstrass_mandelbrot_profile(
            grid,
            dimension=row["D"],
            roughness=row["G_m"],
            gamma=gamma,
            length=gamma ** -(first + 0.5),
            shortest_wavelength=gamma ** -(first + kept - 1 - 0.5),
            seed=seed,
        )
        found.append(mean_square_increment(made, (1, 0)))
    powers = np.arange(first, first + kept)
    squares = row["G_m"] ** (2 * (row["D"] - 1)) * gamma ** (-2 * (2 - row["D"]) * powers)
    exact = np.sum(squares * (1 - np.cos(2 * np.pi * gamma**powers * tau)))
    assert exact == pytest.approx(row["S_exact_m2"], rel=2e-3)
    assert np.mean(found) == pytest.approx(exact, abs=5.0 * np.std(found, ddof=1) / np.sqrt(40))


def test_surface_ensemble_meets_its_acceptance_intervals():
    grid = Grid((96, 96), (1.0 / 96.0, 1.0 / 96.0))

    def statistics(seed):
        made = weierstrass_mandelbrot(
            grid, dimension=2.4, roughness=0.001, seed=seed, ridges=10, shortest_wavelength=1.0 / 96.0
        )
        assert "12 waves each" in made.origin.history[0]
        h = made.heights
        return {"raw2": np.mean(h**2), "m2x_fd_nonper": np.mean(np.diff(h, axis=0) ** 2) * 96.0**2}

    require_accepted("G11", average(statistics(seed) for seed in range(int(rows("G11")[0]["n_realisations"]))))


def test_surface_equals_the_direct_sum():
    grid, d, g, gamma, ridges = Grid((7, 5), (0.3, 0.2)), 2.3, 0.01, 1.7, 3
    made = weierstrass_mandelbrot(
        grid, dimension=d, roughness=g, seed=4, gamma=gamma, ridges=ridges, length=2.0, shortest_wavelength=0.4
    )
    count = int(np.floor(np.log(5.0) / np.log(gamma))) + 1
    phases = np.random.Generator(np.random.PCG64(4)).uniform(0.0, 2.0 * np.pi, (ridges, count))
    x, y = grid.coordinates()
    expected = np.zeros(grid.shape)
    for m in range(1, ridges + 1):
        for n in range(count):
            along = x * np.cos(np.pi * m / ridges) + y * np.sin(np.pi * m / ridges)
            amplitude = 2.0 * (g / 2.0) ** (d - 2.0) * np.sqrt(np.log(gamma) / ridges) * gamma ** ((d - 3.0) * n)
            expected -= amplitude * np.cos(2.0 * np.pi * gamma**n / 2.0 * along + phases[m - 1, n])
    np.testing.assert_allclose(made.heights, expected, rtol=0.0, atol=1e-13)


def test_profile_is_the_same_for_all_y_and_reproducible():
    grid = Grid((64, 8), (1e-7, 2e-7))
    made = weierstrass_mandelbrot_profile(grid, dimension=1.5, roughness=1e-10, seed=2)
    assert isinstance(made, Surface)
    assert np.ptp(made.heights, axis=1).max() == 0.0
    again = weierstrass_mandelbrot_profile(grid, dimension=1.5, roughness=1e-10, seed=2)
    np.testing.assert_array_equal(made.heights, again.heights)
    assert not made.periodic
    assert made.citation_keys == ("Majumdar1990",)


@pytest.mark.parametrize(
    ("change", "subject", "shown"),
    [
        ({"dimension": 2.0}, "dimension of weierstrass_mandelbrot()", "2.0"),
        ({"dimension": 3.0}, "dimension of weierstrass_mandelbrot()", "3.0"),
        ({"roughness": 0.0}, "roughness (m) of weierstrass_mandelbrot()", "0.0"),
        ({"gamma": 1.0}, "gamma of weierstrass_mandelbrot()", "1.0"),
        ({"gamma": 1.000001}, "waves of a Weierstrass-Mandelbrot function", "13862960"),
        ({"ridges": 0}, "ridges of weierstrass_mandelbrot()", "0"),
        ({"shortest_wavelength": 20.0}, "shortest wave", "20 m"),
        ({"length": -1.0}, "length (m) of weierstrass_mandelbrot()", "-1.0"),
        ({"seed": -1}, "seed of weierstrass_mandelbrot()", "-1"),
    ],
)
def test_refusals(change, subject, shown):
    with refused(InputError, subject, shown):
        weierstrass_mandelbrot(Grid((8, 8), (1.0, 1.0)), **{"dimension": 2.5, "roughness": 1.0, "seed": 1, **change})


@pytest.mark.parametrize(
    ("change", "subject"),
    [
        ({"dimension": 2.0}, "dimension of weierstrass_mandelbrot_profile()"),
        ({"shortest_wavelength": 1e3}, "waves of a Weierstrass-Mandelbrot function"),
    ],
)
def test_profile_refusals(change, subject):
    with refused(InputError, subject):
        weierstrass_mandelbrot_profile(Grid((8, 1), (1.0, 1.0)), **{"dimension": 1.5, "roughness": 1.0, **change})
