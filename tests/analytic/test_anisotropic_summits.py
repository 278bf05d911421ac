"""All summits of anisotropic Gaussian surfaces against their reference rows, limits and draws of
curvatures."""

from __future__ import annotations

import functools
import math

import numpy as np
import pytest
from reference_data import every_row, reference
from refusals import refused

import asperity as asp
from asperity.theories import AnisotropicSummits, BushGibsonKeogh, BushGibsonThomas, NayakSummits
from asperity.theories.rough.bush_gibson_keogh import in_principal_axes
from asperity.theories.statistics.roughness import MomentTensor

ROWS = {row["case"]: row for row in reference("missing/anisotropic_summits")}


@functools.cache
def theory_of(case: float) -> BushGibsonKeogh:
    row = ROWS[case]
    return BushGibsonKeogh(1.0, 1.0, **{name: row[name] for name in ("m20", "m02", "m40", "m04", "m22")})


@every_row(ROWS.values(), label=lambda row: f"{row['case']:g}")
def test_statistics_of_the_summits(row):
    theory = theory_of(row["case"])
    for name, column in (
        ("density", "summit_density"),
        ("mean_height", "mean_height"),
        ("height_deviation", "sd_height"),
        ("mean_curvature", "mean_curvature"),
        ("mean_geometric_curvature", "mean_geometric_curvature"),
        ("curvature_x", "mean_curvature_x"),
        ("curvature_y", "mean_curvature_y"),
    ):
        assert getattr(theory, name) == pytest.approx(row[column], rel=1e-9), name
    # the rows integrate |κ1 - κ2|, which has a tip, by a smooth rule: they move by 1e-6 as it is
    # refined, the theory by 1e-14
    assert theory.mean_difference == pytest.approx(row["mean_r"], rel=2e-6)


@every_row(reference("missing/anisotropic_contact"), label=lambda row: f"{row['case']:g} at {row['D']:g}")
def test_contact_of_the_summits(row):
    # the rows are good to 3e-10, the theory to 1e-11
    theory = theory_of(row["case"])
    found = theory.at_separation(row["D"])
    assert found.area_fraction == pytest.approx(row["area_fraction"], rel=1e-9)
    assert found.pressure == pytest.approx(row["p_over_Estar"], rel=1e-9)
    assert found.contact_density == pytest.approx(row["n_per_area"], rel=1e-9)
    kappa = found.area_fraction * theory.rms_gradient / found.pressure
    assert kappa == pytest.approx(row["kappa_hrms"], rel=1e-9)


def test_closures_are_those_of_the_families():
    for row in ROWS.values():
        moments = {name: row[name] for name in ("m20", "m02", "m40", "m04")}
        closed = {"stretched": "stretched", "separable": "separable", "five_parameter": "stretched"}[row["family"]]
        assert BushGibsonKeogh(1.0, 1.0, **moments, closure=closed)._m22 == pytest.approx(row["m22"], rel=1e-12)


@pytest.mark.parametrize("alpha", [1.55, 2.0, 10.0, 100.0])
def test_isotropic_surfaces_are_those_of_bush_gibson_and_thomas(alpha):
    D = np.linspace(-3.0, 6.0, 10)
    found = BushGibsonKeogh(1.0, 1.0, 1.0, 1.0, alpha, alpha)
    even, summits = BushGibsonThomas(1.0, 1.0, 1.0, alpha), NayakSummits(1.0, 1.0, alpha)
    for name in ("pressure", "area_fraction", "contact_density", "stiffness"):
        expected = getattr(even.at_separation(D), name)
        assert getattr(found.at_separation(D), name) == pytest.approx(expected, rel=1e-9), name
    for name in ("density", "mean_height", "height_deviation", "mean_curvature", "mean_geometric_curvature"):
        assert getattr(found, name) == pytest.approx(getattr(summits, name), rel=1e-10), name


def test_quadratures_are_fine_enough(monkeypatch):
    """Half as many nodes again change nothing."""
    from asperity.theories.rough import bush_gibson_keogh as module

    moments = {"m20": 1.0, "m02": 0.04, "m40": 5.0, "m04": 0.008}
    rough = BushGibsonKeogh(1.0, 1.0, **moments).at_separation([-1.0, 1.0, 4.0])
    for name, factor in (("_SHAPES", 1.5), ("_TURNS", 2), ("_FEW", 1.5), ("_NODES", 1.5)):
        monkeypatch.setattr(module, name, int(factor * getattr(module, name)))
    fine = BushGibsonKeogh(1.0, 1.0, **moments).at_separation([-1.0, 1.0, 4.0])
    assert fine.pressure == pytest.approx(rough.pressure, rel=3e-11)
    assert fine.area_fraction == pytest.approx(rough.area_fraction, rel=3e-11)


def test_high_summits_tend_to_their_limit():
    found = BushGibsonKeogh(1.0, 1.0, 1.0, 0.25, 2.0, 0.125)
    limit = AnisotropicSummits(1.0, 1.0, 1.0, 0.25)
    apart = [
        abs(float((found.at_separation(D).area_fraction / limit.at_separation(D).area_fraction)[0]) - 1.0)
        for D in (4.0, 8.0, 16.0)
    ]
    assert apart[1] < 0.3 * apart[0]
    assert apart[2] < 0.3 * apart[1] < 0.01


def test_summits_by_draws_of_their_curvatures():
    """Skewed lay, all covariances: summits of a million draws of (z, H) within four standard
    errors."""
    theory = BushGibsonKeogh(1.0, 1.0, 1.0, 0.3, 4.0, 1.2, m22=0.5, m31=0.4, m13=-0.2)
    C = np.array([[1.0, -1.0, -0.3, 0.0], [-1.0, 4.0, 0.5, 0.4], [-0.3, 0.5, 1.2, -0.2], [0.0, 0.4, -0.2, 0.5]])
    z, xx, yy, xy = np.linalg.cholesky(C) @ np.random.default_rng(3).standard_normal((4, 1_000_000))
    det = xx * yy - xy**2
    summit = (det > 0.0) & (xx + yy < 0.0)
    front = np.where(summit, det, 0.0) / (2.0 * math.pi * math.sqrt(0.3))
    for values, expected in (
        (front, theory.density),
        (front * z, theory.density * theory.mean_height),
        (front * (z > 1.0), float(theory.at_separation(1.0).contact_density[0])),
    ):
        assert values.mean() == pytest.approx(expected, abs=4.0 * values.std() / 1000.0)


def test_moments_are_turned_to_the_axes_of_the_slopes():
    """The axes are those in which a stretched surface was made, at any angle."""
    spread = np.array([3.0, 1.0])
    for angle in (0.0, 0.4, 1.3, -0.9):
        c, s = math.cos(angle), math.sin(angle)
        q = np.random.default_rng(5).standard_normal((2, 200_000)) * spread[:, None]
        qx, qy = c * q[0] - s * q[1], s * q[0] + c * q[1]
        powers = ((2, 0), (1, 1), (0, 2), (4, 0), (3, 1), (2, 2), (1, 3), (0, 4))
        found = in_principal_axes(MomentTensor(*(float(np.mean(qx**i * qy**j)) for i, j in powers)))
        straight = in_principal_axes(MomentTensor(*(float(np.mean(q[0] ** i * q[1] ** j)) for i, j in powers)))
        for name in ("m20", "m02", "m40", "m31", "m22", "m13", "m04"):
            scale = straight.m40**0.5 * straight.m04**0.5 if name in ("m31", "m13") else getattr(straight, name)
            assert abs(abs(getattr(found, name)) - abs(getattr(straight, name))) < 1e-9 * scale, name
        assert found.m11 == 0.0


def test_a_measured_map_has_its_mixed_moments():
    """By finite differences near those by the spectrum; the lay lies at an angle."""
    n, pixel = 128, 2e-8
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(0.1), hurst=0.8, rolloff_wavelength=6e-7, shortest_wavelength=4e-7
    )
    surface = asp.generate.gaussian(asp.Grid((n, n), (pixel, 2.0 * pixel)), spectrum, seed=2)
    exact = asp.roughness_of(surface).moments
    near = asp.roughness_of(surface, moments="differences").moments
    for name in ("m40", "m22", "m04"):
        # the shortest wave has ten pixels along y: (π/10)²/3 in each of two differences, twice
        assert getattr(near, name) == pytest.approx(getattr(exact, name), rel=0.15), name
    for name in ("m31", "m13"):
        assert abs(getattr(near, name) - getattr(exact, name)) < 0.05 * math.sqrt(exact.m40 * exact.m04), name
    made = [
        BushGibsonKeogh.from_roughness(asp.roughness_of(surface, moments=way), 1e11).at_pressure(1e8).area_fraction
        for way in ("spectrum", "differences")
    ]
    assert made[1] == pytest.approx(made[0], rel=0.1)


def test_what_no_surface_has_is_refused():
    with refused(asp.InputError, "moments of an anisotropic surface", "1", "4"):
        BushGibsonKeogh(1.0, 1.0, 1.0, 1.0, 1.0, 1.0, m22=2.0)
    with refused(asp.InputError, "mean square height m0 (m^2)", "1"):
        BushGibsonKeogh(1.0, 1.0, 1.0, 1.0, 1.2, 1.2)
    with refused(asp.InputError, "closure of bush-gibson-keogh", "'even'"):
        BushGibsonKeogh(1.0, 1.0, 1.0, 1.0, 4.0, 4.0, closure="even")  # type: ignore[arg-type]
    bare = asp.roughness.Roughness(1.0, 1.0, 4.0, moments=MomentTensor(1.0, 0.0, 0.5))
    with refused(asp.InputError, "roughness for the theory bush-gibson-keogh", "fourth moments"):
        BushGibsonKeogh.from_roughness(bare, 1.0)
