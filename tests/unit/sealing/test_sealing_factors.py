"""Flow factors, estimates and throats against closed forms and published numbers."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from reference_data import Row, every_row, reference
from refusals import refused
from scipy import ndimage

import asperity as asp
from asperity.core.errors import InputError, NoSolutionError
from asperity.core.grid import Grid
from asperity.physics.sealing.estimates import critical_gap, estimates_of
from asperity.physics.sealing.factors import flow_factors, tabulated_flow_factors
from asperity.physics.sealing.flow import flow_through
from asperity.physics.sealing.threshold import closing_load
from asperity.physics.sealing.throats import closed_path, throats, through_corners, through_noise
from asperity.theories.sealing.gaps import (
    annular_gap,
    parabolic_channel,
    parabolic_throat,
    saddle_throat,
    sinusoidal_gap,
    tapered_gap,
)
from asperity.theories.sealing.media import bruggeman, layer_bounds, obstacle_array
from asperity.theories.sealing.roughness import patir_cheng

Field = NDArray[np.float64]
FACTORS = reference("lubrication/flow_factors")
RANDOM = reference("lubrication/flow_factors_random")


def surface(name: str, n: int) -> Field:
    """Heights of the reference with an rms of one on 2π x 2π."""
    at = 2.0 * np.pi * (np.arange(n) + 0.5) / n
    x, y = np.meshgrid(at, at, indexing="ij")
    made = {
        "eggbox": np.cos(x) + np.cos(y),
        "wave_across": np.sqrt(2.0) * np.cos(x),
        "wave_along": np.sqrt(2.0) * np.cos(y),
        "oblique45": np.sqrt(2.0) * np.cos(x + y),
        "three_waves": 0.8 * np.cos(x) + 0.9 * np.cos(2.0 * y + 1.0) + np.sqrt(0.55) * np.cos(x - 2.0 * y + 0.5),
    }
    return np.asarray(made[name])


def factors(row: Row, n: int) -> Field:
    """Pressure factors along x and y, shear factor along x, and mean gap of a ``row``."""
    height = float(row["H"])
    gap = np.maximum(height + surface(str(row["surface"]), n), 0.0)
    found = flow_factors(gap, Grid((n, n), (2.0 * np.pi / n,) * 2), 1.0, separation=height)
    names = ("pressure_x", "pressure_y", "shear_x", "mean_gap_over_roughness")
    return np.array([getattr(found, name)[0] for name in names])


@every_row(FACTORS, lambda row: f"{row['surface']} {row['H']}")
def test_flow_factors_of_waves(row: Row) -> None:
    exact = np.array([row[name] for name in ("phi_x", "phi_y", "phi_s", "mean_gap")], float)
    coarse, fine = factors(row, 48), factors(row, 96)
    # of second order where nothing touches, else of first order at the edges
    change = np.abs(fine - coarse)
    assert (np.abs(fine - exact) <= 1.2 * change + float(row["abs_error"]) + 1e-9).all()
    assert (change < 0.01).all()


OWN = 5
"""Surfaces of each kind."""

LENGTHS = {"iso": (10, 10), "iso_half": (20, 20), "gamma3": (21, 7), "gamma1_3": (7, 21)}


@pytest.mark.slow
@pytest.mark.parametrize("kind", LENGTHS)
def test_flow_factors_of_random_surfaces(kind: str) -> None:
    """Means over surfaces of our own within three standard errors of the difference, by our own
    spread: that of three surfaces of the reference is known to half of it only."""
    rng, rows, surfaces = np.random.default_rng(5), [row for row in RANDOM if row["kind"] == kind], []
    for _ in range(OWN):
        # the autocorrelation exp(-(x/l)²) is that of white noise under a Gaussian of l/2
        noise = rng.standard_normal((256, 256))
        heights = ndimage.gaussian_filter(noise, np.array(LENGTHS[kind]) / 2.0, mode="wrap", truncate=5.0)
        surfaces.append((heights - heights.mean()) / heights.std())
    for row in rows:
        height, found = float(row["H"]), []
        for heights in surfaces:
            gap = np.maximum(height + heights, 0.0)
            one = flow_factors(gap, Grid((256, 256), (1.0, 1.0)), 1.0, separation=height)
            found.append([one.pressure_x[0], one.pressure_y[0], one.shear_x[0]])
        mean, spread = np.mean(found, axis=0), np.std(found, axis=0, ddof=1)
        for number, name in enumerate(("phi_x", "phi_y", "phi_s")):
            error = spread[number] * np.sqrt(1.0 / OWN + 1.0 / float(row["n_surfaces"]))
            assert abs(mean[number] - float(row[name])) < 3.0 * error + 2e-3, (row["H"], name, mean, error)


def test_small_roughness() -> None:
    """φ = 1 - 3/2 (σ/H)² and φ_s = 3/2 σ/H of an isotropic surface, to the next order of σ/H."""
    heights = surface("eggbox", 64)
    for ratio in (20.0, 40.0):
        found = flow_factors(ratio + heights, Grid((64, 64), (1.0, 1.0)), 1.0)
        # the grid errs by (2π/64)²/12 of the deviation
        assert found.pressure_x[0] == pytest.approx(1.0 - 1.5 / ratio**2, abs=10.0 / ratio**3)
        assert found.shear_x[0] == pytest.approx(1.5 / ratio, rel=10.0 / ratio**2 + 2e-3)
        assert abs(found.pressure_xy[0]) < 1e-12


def test_flow_factors_of_deformed_surfaces() -> None:
    heights = ndimage.gaussian_filter(np.random.default_rng(4).standard_normal((64, 64)), 3.0, mode="wrap")
    surface_ = asp.Surface(1e-7 * heights / heights.std(), 0.3e-6, periodic=True)
    problem = asp.ContactProblem(surface_, asp.Elastic(100e9, 0.3))
    table = tabulated_flow_factors(problem, (1.5, 3.0, 6.0))
    assert len(table) == 3
    assert table.contact_fraction[0] > 0.0
    assert table.contact_fraction[-1] == 0.0
    assert table.mean_pressure[0] > 0.0
    # deformed surfaces keep their mean plane, while what is cut widens the gap
    np.testing.assert_allclose(table.mean_gap_over_roughness, (1.5, 3.0, 6.0), rtol=1e-4)
    assert (np.diff(table.pressure_x) > 0.0).all()
    assert table.pressure_x[-1] == pytest.approx(patir_cheng(np.array(6.0))[0], abs=0.02)
    with refused(InputError, "boundary of flow factors", "free"):
        tabulated_flow_factors(asp.ContactProblem(surface_, asp.Elastic(100e9, 0.3), boundary=asp.Free()), (3.0,))


# Estimates.


@every_row(reference("transport/gap_flow"), lambda row: f"{row['geometry']} {row['parameter']}")
def test_closed_forms(row: Row) -> None:
    kind, q = str(row["geometry"]), float(row["parameter"])
    made: dict[str, Callable[[], float]] = {
        "sinusoid_across_grooves": lambda: sinusoidal_gap(q, along=False),
        "sinusoid_along_grooves": lambda: sinusoidal_gap(q, along=True),
        "taper_along_flow": lambda: tapered_gap(1.0, q),
        "step_half_width": lambda: layer_bounds(np.array([1.0, q])).upper,
        "step_half_length": lambda: layer_bounds(np.array([1.0, q])).lower,
        "parabolic_channel_closed_at_sides": lambda: parabolic_channel(1.0),
        "parabolic_throat_R1_h0": lambda: parabolic_throat(q, 1.0),
        "annulus_full_circle_ro_over_ri": lambda: annular_gap(1.0, q),
    }
    assert made[kind]() == pytest.approx(float(row["transmissivity"]), rel=1e-12)


@every_row(reference("transport/obstacle_array"), lambda row: str(row["area_fraction"]))
def test_obstacles_by_multipoles(row: Row) -> None:
    found = obstacle_array(float(row["area_fraction"]), 40)
    assert found == pytest.approx(float(row["K_eff_impermeable"]), abs=1e-11)
    assert 1.0 / found == pytest.approx(float(row["K_eff_perfect"]), rel=1e-10)


@every_row(reference("transport/effective_medium"), lambda row: f"{row['distribution']} {row['parameter']}")
def test_effective_medium(row: Row) -> None:
    q, blocked = float(row["parameter"]), float(row["blocked_fraction"])
    if row["distribution"] == "lognormal_h":
        # the trapezoidal rule on a Gaussian converges faster than any power
        at = np.linspace(-10.0, 10.0, 801)
        gap, share = np.exp(q * at), np.exp(-0.5 * at**2)
    elif row["distribution"] == "uniform_gap_halfwidth":
        at, share = np.polynomial.legendre.leggauss(200)
        gap = 1.0 + q * at
    else:
        gap, share = np.ones(1), np.ones(1)
    share = np.append(share / share.sum() * (1.0 - blocked), blocked)
    gap = np.append(gap, 0.0 if blocked else 1.0)
    assert bruggeman(gap, share) == pytest.approx(float(row["K_bruggeman"]), rel=1e-8, abs=1e-12)
    arithmetic = float((share * gap**3).sum())
    assert arithmetic == pytest.approx(float(row["K_arithmetic"]), rel=1e-8)
    if not blocked:
        assert 1.0 / float((share[:-1] / gap[:-1] ** 3).sum()) == pytest.approx(float(row["K_harmonic"]), rel=1e-8)


def test_effective_medium_of_two_gaps_and_layers() -> None:
    assert bruggeman(np.array([1.0, 2.0])) == pytest.approx(np.sqrt(8.0), rel=1e-12)
    bounds = layer_bounds(np.array([1.0, 2.0]))
    assert bounds.lower < bruggeman(np.array([1.0, 2.0])) < bounds.upper


def test_estimates_bracket_the_flow_of_a_random_gap() -> None:
    heights = ndimage.gaussian_filter(np.random.default_rng(2).standard_normal((96, 96)), 3.0, mode="wrap")
    gap = np.maximum(heights / heights.std() + 1.5, 0.0) + 0.05
    flow = flow_through(gap, Grid(gap.shape, (1.0, 1.0)), wraps=(True, True), repeats=True)
    found = estimates_of(flow)
    assert found.lower < flow.transmissivity < found.upper
    assert found.lower < found.effective_medium < found.upper
    assert 0.0 < found.critical_junction < gap.max() ** 3


def test_critical_gap_is_that_of_the_last_path() -> None:
    gap = np.ones((8, 8))
    gap[3] = np.linspace(0.1, 0.4, 8)
    gap[5] = np.linspace(0.3, 0.2, 8)
    flow = flow_through(gap, Grid((8, 8), (1.0, 1.0)))
    assert critical_gap(flow) == pytest.approx(0.3)


# Throats and what closes the gap.


def saddle(n: int, shift: float = 0.0) -> Field:
    at = (np.arange(n) + 0.5) / n - 0.5
    return np.asarray(np.maximum(0.05 + at[:, None] ** 2 / 0.4 - (at[None] - shift) ** 2 / 0.6, 0.0))


@pytest.mark.parametrize("n", [16, 32, 64])
@pytest.mark.parametrize("shift", [0.0, 0.3])
def test_bracket_of_a_saddle_holds_its_conductance(n: int, shift: float) -> None:
    coarse, fine = (flow_through(saddle(m), Grid((m, m), (1.0 / m, 1.0 / m))).rate for m in (64, 128))
    flow = flow_through(saddle(n, shift / n), Grid((n, n), (1.0 / n, 1.0 / n)))
    found = throats(flow)
    assert found.bracket.lower < (4.0 * fine - coarse) / 3.0 < found.bracket.upper
    assert found.count == 1
    assert found.places[0].x == pytest.approx(0.5, abs=1.0 / n)
    assert found.places[0].gap == pytest.approx(0.05, rel=0.1)


def test_saddle_converges_between_its_brackets() -> None:
    exact = saddle_throat(0.05, 0.2, 0.3)
    flow = flow_through(saddle(128), Grid((128, 128), (1 / 128, 1 / 128)))
    # the ends of the grid, a tenth of a per cent of the resistance, and the pixels
    assert exact.lower < flow.rate < exact.upper * 1.003


def test_throat_of_one_pixel_is_not_resolved() -> None:
    gap = np.zeros((24, 24))
    gap[:9], gap[15:] = 1.0, 1.0
    gap[9:15, 11] = (0.4, 0.3, 0.2, 0.2, 0.3, 0.4)
    found = throats(flow_through(gap, Grid((24, 24), (1e-6, 1e-6))))
    assert found.pixels == 1.0
    assert not found.resolved
    assert found.refinement == 8
    assert found.places[0].carried == pytest.approx(1.0)
    assert found.bracket.lower < found.flow.rate < found.bracket.upper
    wide = throats(flow_through(np.ones((24, 24)), Grid((24, 24), (1e-6, 1e-6))))
    assert wide.resolved
    assert wide.refinement == 1


@pytest.mark.parametrize("way", ["x", "y"])
@pytest.mark.parametrize("wraps", [(False, False), (True, True)])
def test_closed_path_is_closed(way: str, wraps: tuple[bool, bool]) -> None:
    heights = ndimage.gaussian_filter(np.random.default_rng(3).standard_normal((48, 48)), 2.0, mode="wrap")
    gap = np.maximum(heights / heights.std() - 0.7, 0.0)
    flow = flow_through(gap, Grid(gap.shape, (1.0, 1.0)), way, wraps=wraps, repeats=wraps[0])  # type: ignore[arg-type]
    assert flow.sealed
    path = closed_path(flow)
    assert (gap[path[:, 0], path[:, 1]] == 0.0).all()
    across = path[:, 1 - flow.axis]
    assert set(across) == set(range(48))
    steps = np.diff(np.concatenate([path, path[:1]]) if wraps[0] else path, axis=0)
    assert (np.abs((steps + 24) % 48 - 24) <= 1).all()
    # a wall of these cells alone seals, too
    wall = np.ones_like(gap)
    wall[path[:, 0], path[:, 1]] = 0.0
    assert flow_through(wall, flow.grid, way, wraps=wraps, repeats=wraps[0]).sealed  # type: ignore[arg-type]


def test_corner_and_noise() -> None:
    gap = np.ones((12, 12))
    gap[6] = 0.0
    assert not through_corners(flow_through(gap, Grid((12, 12), (1.0, 1.0))))
    gap[6, 4], gap[5, 4], gap[5, 3] = 1.0, 0.0, 1.0
    corner = flow_through(gap, Grid((12, 12), (1.0, 1.0)))
    assert corner.sealed
    assert through_corners(corner)
    gap = np.ones((12, 12))
    gap[6] = 1e-4
    assert through_noise(flow_through(gap, Grid((12, 12), (1.0, 1.0))))
    gap[6, 2] = 0.5
    assert not through_noise(flow_through(gap, Grid((12, 12), (1.0, 1.0))))


# The load at which the gap closes.


def test_gap_of_crossed_waves_closes_between_two_loads() -> None:
    """Contacts close at 0.42 to 0.5 of the area, crossed waves at 0.44 (Dapp 2012)."""
    at = 2.0 * np.pi * (np.arange(32) + 0.5) / 32
    surface_ = asp.Surface(1e-8 * (np.cos(at)[:, None] + np.cos(at)[None]), 1e-7, periodic=True)
    problem = asp.ContactProblem(surface_, asp.Elastic(100e9, 0.3))
    full = 2.0 * np.pi * 1e-8 * 100e9 / (1.0 - 0.3**2) / 3.2e-6
    found = closing_load(problem, (0.05 * full, full), rounds=5)
    assert found.lower < found.upper < 1.1 * found.lower
    # pixels at the rim of a spot change the fraction by some per cent
    assert found.open_fraction <= found.closed_fraction
    assert 0.36 < found.open_fraction < 0.52
    assert closing_load(problem, (0.05 * full, full), way="y", rounds=5).lower == pytest.approx(found.lower)
    with refused(NoSolutionError, "mean pressures of a gap that closes", "open"):
        closing_load(problem, (0.05 * full, 0.06 * full))
    with refused(NoSolutionError, "mean pressures of a gap that closes", "closed"):
        closing_load(problem, (full, 2.0 * full))
    with refused(InputError, "mean pressures of a gap that closes", "2"):
        closing_load(problem, (2.0, 1.0))
