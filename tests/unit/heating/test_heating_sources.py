"""Single sources of heat: reference values, limits, routes against one another, and invariants."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reference_data import every_row, reference
from refusals import refused

from asperity.core.errors import InputError
from asperity.core.quadrature import gauss
from asperity.core.scipy_parts import special
from asperity.theories import (
    BandSource,
    EllipticSource,
    HeatConductor,
    HeatLayer,
    MovingSource,
    RectangularSource,
    disc_source,
)
from asperity.theories.heating import band, polar
from asperity.theories.heating.estimates import HERTZIAN_DISC, SQUARE, UNIFORM_DISC

UNIT = HeatConductor(1.0, 1.0)
"""k = κ = 1: with a = 1 temperatures are θ, and the speed is 2 Pe."""

DIGITS = 6e-10
"""Half of the last of ten digits of values below one."""


def close(found: float, row: dict[str, float], name: str, error: float) -> None:
    assert float(found) == pytest.approx(row[name], abs=error + DIGITS), name


@every_row(reference("heating/circular_sources"), label=lambda row: str(row["case"]))
def test_discs(row: dict[str, float]) -> None:
    moving = MovingSource(disc_source(1.0, hertzian=row["source"] == "hertz"), UNIT, 2.0 * row["peclet"])
    hottest = moving.hottest()
    close(hottest.temperature, row, "theta_max", 1e-9)
    close(hottest.x, row, "x_max_over_a", 1e-6)
    close(moving.temperature(0.0), row, "theta_centre", 1e-9)
    close(moving.temperature(-0.5), row, "theta_at_minus_half_a", 1e-9)
    close(moving.temperature(0.5), row, "theta_at_plus_half_a", 1e-9)
    close(moving.mean(), row, "theta_mean", 2e-8)
    close(moving.mean(weighted=True), row, "theta_flux_mean", 2e-8)


@every_row(reference("heating/band_source"), label=lambda row: str(row["case"]))
def test_bands(row: dict[str, float]) -> None:
    moving = MovingSource(BandSource(1.0), UNIT, 2.0 * row["peclet"])
    hottest = moving.hottest()
    close(hottest.temperature, row, "theta_max", 1e-9)
    close(hottest.x, row, "x_max_over_l", 1e-6)
    for name, x in (("centre", 0.0), ("leading_edge", -1.0), ("trailing_edge", 1.0), ("at_3l", 3.0)):
        close(moving.temperature(x), row, f"theta_{name}", 1e-9)
    close(moving.mean(), row, "theta_mean", 1e-9)


@every_row(reference("heating/rectangle_ellipse_sources"), label=lambda row: str(row["case"]))
def test_rectangles_and_ellipses(row: dict[str, float]) -> None:
    """Rectangles at rest, and means of ellipses, are known to fewer digits."""
    if row["shape"] == "rectangle_uniform":
        moving = MovingSource(RectangularSource(1.0, row["b_over_a"]), UNIT, 2.0 * row["peclet"])
        error = mean = 1e-9 if row["peclet"] else 1.15e-7 * max(1.0, row["b_over_a"])  # stated 1.1e-7
    else:
        shape = EllipticSource(1.0, row["b_over_a"], row["shape"] == "ellipse_hertz")
        moving = MovingSource(shape, UNIT, 2.0 * row["peclet"])
        error, mean = 1e-9, 3e-6
    hottest = moving.hottest()
    close(hottest.temperature, row, "theta_max", error)
    close(hottest.x, row, "x_max_over_a", 1e-6)
    close(moving.temperature(0.0), row, "theta_centre", error)
    close(moving.mean(), row, "theta_mean", mean)


@every_row(reference("heating/transient_sources"), label=lambda row: str(row["case"]))
def test_sources_in_time(row: dict[str, float]) -> None:
    shape = RectangularSource(1.0, 1.0) if row["source"] == "square" else disc_source(1.0)
    moving, time = MovingSource(shape, UNIT, 2.0 * row["peclet"]), row["fourier_number"]
    close(moving.temperature(0.0, time=time), row, "theta_centre", 1e-9)
    if not math.isnan(row["theta_x_two"]):
        close(moving.temperature(0.5, time=time), row, "theta_x_half", 1e-9)
        close(moving.temperature(2.0, time=time), row, "theta_x_two", 1e-9)


@every_row(reference("heating/subsurface_square"), label=lambda row: str(row["case"]))
def test_below_a_square(row: dict[str, float]) -> None:
    """The table stops at rest as that of the surface does."""
    moving = MovingSource(RectangularSource(1.0, 1.0), UNIT, 2.0 * row["peclet"])
    found = moving.temperature(row["x_over_l"], depth=row["z_over_l"])
    close(float(found), row, "theta", 1e-10 if row["peclet"] else 1.15e-7)


@pytest.mark.slow
@every_row(reference("heating/layered_sources"), label=lambda row: str(row["case"]))
def test_layered_discs(row: dict[str, float]) -> None:
    """The means of discs on a half-space are known to 2e-8, of those of the layer to that over
    k1."""
    layer = HeatLayer(row["k1_over_k2"], row["kappa1_over_kappa2"], row["h_over_a"])
    moving = MovingSource(disc_source(1.0), HeatConductor(1.0, 1.0, (layer,)), 2.0 * row["peclet_substrate"])
    hottest = moving.hottest()
    close(hottest.temperature, row, "theta_max", 1e-8)
    close(hottest.x, row, "x_max_over_a", 1e-6)
    close(moving.temperature(0.0), row, "theta_centre", 1e-8)
    close(moving.mean(), row, "theta_mean", 2e-8 / row["k1_over_k2"])


# Limits.


@pytest.mark.parametrize(
    ("shape", "limits"),
    [
        (disc_source(1.0), UNIFORM_DISC),
        (disc_source(1.0, hertzian=True), HERTZIAN_DISC),
        (RectangularSource(1.0, 1.0), SQUARE),
    ],
)
def test_limits_at_rest_and_fast(shape, limits) -> None:
    still = MovingSource(shape, UNIT)
    assert still.hottest().temperature == pytest.approx(limits.rest, rel=1e-12)
    assert still.mean() == pytest.approx(limits.rest_mean, rel=1e-12)
    peclet = 1e6
    fast, scale = MovingSource(shape, UNIT, 2.0 * peclet), math.sqrt(math.pi * peclet)
    # the sides cool the mean of a square by about a heated depth over its width, a Pe**-0.5 = 1e-3
    assert fast.hottest().temperature * scale == pytest.approx(limits.fast, rel=1e-5)
    assert fast.mean() * scale == pytest.approx(limits.fast_mean, rel=1e-3 if shape.area == 4.0 else 5e-5)


def test_small_peclet_numbers_cool_in_proportion() -> None:
    """exp(-β r) to its first order: v/κ times the area over 4π, of the mean and of each point."""
    square = RectangularSource(1.0, 1.0)
    still = float(MovingSource(square, UNIT).temperature(0.3))
    for speed in (1e-4, 1e-6, 1e-8, 1e-10, 1e-30):
        slow = MovingSource(square, UNIT, speed)
        assert SQUARE.rest_mean - slow.mean() == pytest.approx(speed / math.pi, rel=1e-3, abs=1e-12)
        drift = speed * 0.3 * 0.8  # downstream of the centre it is less, by x times a slope of order one
        assert still - float(slow.temperature(0.3)) == pytest.approx(speed / math.pi, abs=drift + 1e-12)
    moving = [MovingSource(disc_source(1.0), UNIT, 2.0 * pe).mean() for pe in (1e-5, 2e-5)]
    first, second = (8.0 / (3.0 * math.pi) - mean for mean in moving)
    assert second / first == pytest.approx(2.0, rel=1e-4)
    assert first == pytest.approx(0.5e-5, rel=1e-4)


def test_a_band_is_a_long_rectangle() -> None:
    x = np.array([-1.5, 0.3, 2.0])
    for peclet, depth in ((1.0, 0.0), (3.0, 0.4)):
        flat = MovingSource(BandSource(1.0), UNIT, 2.0 * peclet).temperature(x, depth=depth)
        wide = MovingSource(RectangularSource(1.0, 40.0), UNIT, 2.0 * peclet).temperature(x, depth=depth)
        np.testing.assert_allclose(wide, flat, rtol=1e-10)


def test_the_closed_form_of_a_band_is_its_integral() -> None:
    x = np.array([-3.0, -1.0, -0.2, 0.0, 0.9, 1.0, 4.0])
    for peclet in (2e-3, 0.5, 30.0):
        np.testing.assert_allclose(band.at_surface(x, peclet), band.below(x, peclet, 0.0), atol=1e-12)
    u, weight = gauss(np.linspace(-1.0, 1.0, 400), 8)
    for peclet in (0.1, 10.0):
        assert band.mean(peclet) == pytest.approx(0.5 * weight @ band.at_surface(u, peclet), rel=1e-8)


# Routes against one another.


def test_one_square_by_polar_and_by_separable_integrals() -> None:
    """In polar coordinates about the point (0.3, 0), cut where its corners are seen, and graded
    upstream."""
    for peclet in (0.0, 0.7, 20.0):
        edges = np.arctan2([1.0, -1.0], [1.3, 1.3]), np.arctan2([1.0, -1.0], [-0.7, -0.7])
        corners = np.sort(np.concatenate([*edges, [0.0]]))
        fine = np.concatenate(
            [corners, *(sign * 2.0 ** -np.arange(0.0, 12.0) for sign in (1.0, -1.0)), [-math.pi, math.pi]]
        )
        phi, weight = gauss(np.unique(fine), 16)
        c, s = np.cos(phi), np.sin(phi)
        with np.errstate(divide="ignore"):
            rim = np.minimum(np.where(c > 0.0, 1.3, 0.7) / np.abs(c), 1.0 / np.abs(s))
        beta = 2.0 * peclet * np.sin(0.5 * phi) ** 2
        inner = np.where(beta * rim > 1e-9, -np.expm1(-beta * rim) / np.maximum(beta, 1e-300), rim)
        expected = weight @ inner / (2.0 * math.pi)
        found = MovingSource(RectangularSource(1.0, 1.0), UNIT, 2.0 * peclet).temperature(0.3)
        assert float(found) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("hertzian", [False, True])
@pytest.mark.parametrize(
    ("b", "peclet", "x", "y", "z"),
    [
        (1.0, 3.0, 1.5, 0.3, 0.0),
        (0.3, 10.0, -1.5, 0.3, 0.0),
        (4.0, 1.0, 0.2, 5.0, 0.0),
        (1.0, 1.0, 0.2, 0.3, 0.5),
        (2.0, 5.0, 1.9, 0.3, 0.3),
        (1.0, -2.0, 1.05, 0.0, 0.0),
    ],
)
def test_points_beside_and_below_an_ellipse(hertzian: bool, b: float, peclet: float, x: float, y: float, z: float):
    """Against a sum over the source in polar coordinates about its centre."""
    share, weight = gauss(np.linspace(0.0, 1.0, 9), 16)
    rho, weight = 1.0 - (1.0 - share) ** 2, 2.0 * (1.0 - share) * weight  # a root at the rim
    phi, around = gauss(np.linspace(0.0, 2.0 * math.pi, 41), 16)
    dx, dy = x - rho[:, None] * np.cos(phi), y - b * rho[:, None] * np.sin(phi)
    r = np.sqrt(dx**2 + dy**2 + z**2)
    flux = 1.5 * np.sqrt(1.0 - rho**2) if hertzian else np.ones_like(rho)
    felt = np.exp(-np.abs(peclet) * (r - np.copysign(1.0, peclet) * dx)) / r
    expected = (weight * rho * flux) @ felt @ around * b / (2.0 * math.pi)
    source = polar.ScaledEllipse(b, hertzian, peclet, z)
    assert source.at(x, y) == pytest.approx(expected, rel=1e-11)


def test_the_mean_of_a_disc_by_the_kernel_averaged_over_directions() -> None:
    """∮ 1/s dφ/2π = sqrt(z)/q 2/π K((1 - z)/2) with z = (1 + (v/κ q)²)^-1/2; the transform falls as
    q**-3, cut at 2e3."""
    q, weight = gauss(np.concatenate([[0.0], np.geomspace(1e-6, 1.0, 30), np.arange(2.0, 2001.0)]), 8)
    for peclet in (0.3, 10.0):
        z = 1.0 / np.sqrt(1.0 + (2.0 * peclet / q) ** 2)
        kernel = np.sqrt(z) / q * 2.0 / math.pi * special.ellipk(0.5 * (1.0 - z))
        found = weight @ (0.5 * q * (2.0 * special.j1(q) / q) ** 2 * kernel)
        assert found == pytest.approx(MovingSource(disc_source(1.0), UNIT, 2.0 * peclet).mean(), abs=1e-6)


def test_a_layer_at_rest_by_images() -> None:
    for share, h in ((0.1, 0.3), (8.0, 0.5)):
        r = (share - 1.0) / (share + 1.0)
        n = np.arange(1.0, 2000.0)
        images = 1.0 + 2.0 * np.sum(r**n * (np.sqrt(1.0 + 4.0 * (n * h) ** 2) - 2.0 * n * h))
        body = HeatConductor(1.0, 1.0, (HeatLayer(share, 1.0, h),))
        found = float(MovingSource(disc_source(1.0), body).temperature(0.0))
        assert found == pytest.approx(images / share, abs=1e-10 / share)


def test_a_layer_of_the_base_changes_nothing() -> None:
    body = HeatConductor(46.0, 1.2e-5, (HeatLayer(46.0, 1.2e-5, 3e-5),))
    for shape in (disc_source(1e-4, hertzian=True), RectangularSource(1e-4, 2e-4)):
        layered, bare = (MovingSource(shape, each, 0.7) for each in (body, HeatConductor(46.0, 1.2e-5)))
        x = np.array([-1e-4, 3e-5])
        np.testing.assert_allclose(layered.temperature(x, 2e-5), bare.temperature(x, 2e-5), rtol=1e-12)
        assert layered.mean(weighted=True) == pytest.approx(bare.mean(weighted=True), rel=1e-12)


def test_a_sink_takes_its_depth_of_a_wide_source() -> None:
    """T(0) - a/k + d/k: at a source much wider than the sink is deep the flow is uniform."""
    body = HeatConductor(2.0, 1.0, sink_depth=0.05)
    found = float(MovingSource(disc_source(1.0), body).temperature(0.0))
    assert found == pytest.approx(0.05 / 2.0, rel=1e-9)


# Invariants.

PLACES = st.floats(-2.0, 2.0)
PECLETS = st.floats(0.0, 50.0)


@settings(max_examples=25, deadline=None)
@given(peclet=PECLETS, x=PLACES, y=PLACES, b=st.floats(0.2, 5.0), hertzian=st.booleans())
def test_the_sides_are_alike_and_the_wake_lies_at_positive_x(peclet, x, y, b, hertzian) -> None:
    source = polar.ScaledEllipse(b, hertzian, peclet)
    here = source.at(x, y)
    assert 0.0 <= here <= polar.ScaledEllipse(b, hertzian, 0.0).at(x, y) * (1.0 + 1e-11) + 1e-300
    assert source.at(x, -y) == pytest.approx(here, rel=1e-10, abs=1e-300)
    assert polar.ScaledEllipse(b, hertzian, -peclet).at(-x, y) == pytest.approx(here, rel=1e-12, abs=1e-300)
    assert source.at(abs(x), y) >= source.at(-abs(x), y) * (1.0 - 1e-11)


@settings(max_examples=25, deadline=None)
@given(peclet=st.floats(0.0, 20.0), fourier=st.floats(1e-3, 1e3), x=PLACES, hertzian=st.booleans())
def test_temperatures_rise_in_time_to_the_steady_one(peclet, fourier, x, hertzian) -> None:
    source = disc_source(1.0, hertzian=hertzian)
    moving = MovingSource(source, UNIT, 2.0 * peclet)
    early, late, last = (float(moving.temperature(x, time=time)) for time in (fourier, 2.0 * fourier, math.inf))
    assert early <= late * (1.0 + 1e-10) + 1e-14
    assert late <= last * (1.0 + 1e-10) + 1e-14


@settings(max_examples=20, deadline=None)
@given(scale=st.floats(1e-7, 1e-2), k=st.floats(0.1, 400.0), kappa=st.floats(1e-7, 1e-4), peclet=st.floats(0.01, 50.0))
def test_temperatures_scale_with_size_and_conductivity(scale, k, kappa, peclet) -> None:
    moving = MovingSource(EllipticSource(scale, 2.0 * scale), HeatConductor(k, kappa), 2.0 * peclet * kappa / scale)
    assert moving.peclet == pytest.approx(peclet)
    unit = MovingSource(EllipticSource(1.0, 2.0), UNIT, 2.0 * peclet)
    assert moving.mean() * k / scale == pytest.approx(unit.mean(), rel=1e-10)
    assert float(moving.temperature(0.4 * scale)) * k / scale == pytest.approx(float(unit.temperature(0.4)), rel=1e-10)


@pytest.mark.parametrize(
    ("call", "subject"),
    [
        (lambda: EllipticSource(0.0, 1.0), "half length of a source (m)"),
        (lambda: RectangularSource(1.0, -1.0), "half width of a source (m)"),
        (lambda: MovingSource(BandSource(1.0), UNIT).temperature(0.0), "speed (m/s) of the material under a band"),
        (lambda: MovingSource(disc_source(1.0), UNIT, math.inf), "speed (m/s)"),
        (lambda: MovingSource(disc_source(1.0), UNIT).temperature(0.0, depth=-1.0), "depth (m)"),
        (lambda: MovingSource(disc_source(1.0), UNIT).temperature(0.0, time=0.0), "time since the flux began (s)"),
        (
            lambda: MovingSource(BandSource(1.0), UNIT, 1.0).temperature(0.0, time=1.0),
            "time since the flux began (s) of a band",
        ),
        (
            lambda: MovingSource(disc_source(1.0), HeatConductor(1.0, 1.0, (HeatLayer(1.0, 1.0, 1e-3),))),
            "thickness of the first layer (m)",
        ),
        (
            lambda: MovingSource(disc_source(1.0), HeatConductor(1.0, 1.0, sink_depth=1.0)).temperature(0.0, depth=1.0),
            "depth (m) and time (s)",
        ),
        (lambda: MovingSource(BandSource(1.0), HeatConductor(1.0, 1.0, sink_depth=1.0), 1.0), "body under a band"),
    ],
)
def test_what_cannot_be_is_refused(call, subject: str) -> None:
    with refused(InputError, subject):
        call()
