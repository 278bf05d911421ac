"""Estimates of two bodies and interpolations: reference values, and the errors that are stated."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference_data import every_row, reference
from refusals import refused

from asperity.core.errors import InputError
from asperity.theories import (
    BlokFlash,
    HeatConductor,
    JaegerBand,
    MovingHeatSource,
    MovingSource,
    TianKennedy,
    disc_source,
    evaluate,
)
from asperity.theories.heating.estimates import (
    HERTZIAN,
    HERTZIAN_DISC,
    UNIFORM,
    UNIFORM_DISC,
    fast_share,
    interpolated,
    share,
    together,
)

STEEL = (46.0, 1.2e-5)


def alone(k: float, peclet: float) -> MovingSource:
    """A Hertzian disc of radius 1 with all heat."""
    return MovingSource(disc_source(1.0, hertzian=True), HeatConductor(k, 1.0), 2.0 * peclet)


@every_row(reference("heating/two_body_sphere"), label=lambda row: str(row["case"]))
def test_two_bodies_from_each_alone(row: dict[str, float]) -> None:
    """The columns of the estimates; and how far they are from equal temperatures everywhere, as
    stated."""
    first, second = alone(row["k1_over_k2"], row["peclet_1"]), alone(1.0, row["peclet_2"])
    largest = first.hottest().temperature, second.hottest().temperature
    mean = first.mean(), second.mean()
    assert float(share(*largest)) == pytest.approx(row["fraction_blok"], abs=1e-9)
    assert float(together(*largest)) == pytest.approx(row["theta_max_blok"], abs=1e-9)
    assert float(share(*mean)) == pytest.approx(row["fraction_equal_means"], abs=1e-9)
    assert float(together(*mean)) == pytest.approx(row["theta_mean_equal_means"], abs=1e-9)
    if row["peclet_1"] == 0.0:
        assert float(together(*largest)) / row["theta_max"] == pytest.approx(1.0, abs=5e-3)
        assert -0.07 < float(together(*mean)) / row["theta_mean"] - 1.0 < 1e-3
        assert -0.045 < float(share(*mean)) / row["fraction_to_1"] - 1.0 < 0.075
        assert -1e-3 < float(share(*largest)) / row["fraction_to_1"] - 1.0 < 0.47


@pytest.mark.parametrize(
    ("hertzian", "of", "limits", "largest", "mean"),
    [
        (False, UNIFORM, UNIFORM_DISC, (-0.007, 0.0235), -0.0375),
        (True, HERTZIAN, HERTZIAN_DISC, (-0.0114, 0.0025), -0.0462),
    ],
)
def test_interpolations_err_as_stated(hertzian, of, limits, largest, mean) -> None:
    peclets = np.array([0.0, 0.1, 0.3, 0.5, 1.0, 2.0, 5.0, 10.0, 100.0])
    exact = [MovingSource(disc_source(1.0, hertzian=hertzian), HeatConductor(1.0, 1.0), 2.0 * pe) for pe in peclets]
    errors = interpolated(peclets, hertzian=hertzian) / [each.hottest().temperature for each in exact] - 1.0
    assert largest[0] <= errors.min() < 0.0 < errors.max() <= largest[1]
    means = of.c_mean / np.sqrt(math.pi * (of.d_mean + peclets)) / [each.mean() for each in exact] - 1.0
    assert mean <= means.min() < 0.0
    assert of.c == pytest.approx(limits.fast, rel=1e-3)
    assert of.c / math.sqrt(math.pi * of.d) == pytest.approx(limits.rest, rel=3e-3)


def test_fast_bodies_share_by_effusivity() -> None:
    """Two fast bodies that move the same way have temperatures alike in shape."""
    fast = [alone(k, pe).mean() for k, pe in ((1.0, 3e4), (2.5, 8e5))]
    assert float(share(*fast)) == pytest.approx(fast_share((1.0, 2.5), (1.0, 1.0), (6e4, 1.6e6)), rel=1e-3)
    assert fast_share((1.0, 1.0), (2.0, 2.0), (3.0, 3.0)) == 0.5


def test_theories_of_the_catalogue_are_in_si() -> None:
    a, v = 2e-5, 3.0
    found = MovingHeatSource(1e9, a, a, *STEEL).at_speed(v)
    exact = MovingSource(disc_source(a), HeatConductor(*STEEL), v)
    assert found.peclet[0] == pytest.approx(0.5 * v * a / STEEL[1])
    assert found.max_temperature[0] == pytest.approx(1e9 * exact.hottest().temperature)
    assert found.hottest[0] == pytest.approx(exact.hottest().x)
    assert found.mean_temperature == pytest.approx(found.flux_mean_temperature)
    quick = TianKennedy(1e9, a, *STEEL).at_speed([-v, v])
    assert quick.max_temperature[0] == quick.max_temperature[1]
    assert quick.max_temperature[0] == pytest.approx(found.max_temperature[0], rel=0.024)
    assert np.isnan(quick.hottest).all()
    band = JaegerBand(1e9, a, *STEEL).at_speed([v, 10.0 * v])
    assert band.max_temperature[0] > found.max_temperature[0]
    assert band.hottest[1] > band.hottest[0]


def test_a_flash_grows_with_speed_and_goes_to_the_body_that_moves() -> None:
    contact = BlokFlash(0.3, 10.0, 1e-4, 46.0, *STEEL)
    found = evaluate(contact, speed=np.array([1e-3, 0.1, 10.0]))
    values = {column.name: numbers for column, numbers in found.columns}
    assert values["heat"] == pytest.approx([3e-3, 0.3, 30.0])
    assert values["share"][0] == pytest.approx(0.5, abs=2e-3)
    assert np.all(np.diff(values["share"]) < 0.0)
    assert np.all(np.diff(values["max_temperature"]) > 0.0)
    # the reference's case of equal conductivities at Pe = 3
    at_three = contact.at_speed(2.0 * 3.0 * STEEL[1] / 1e-4)
    unit = at_three.heat[0] / (math.pi * 1e-4 * STEEL[0])
    assert at_three.max_temperature[0] / unit == pytest.approx(0.4157499106, abs=1e-9)
    assert contact.at_speed(0.0).max_temperature[0] == 0.0


@pytest.mark.parametrize(
    ("call", "subject"),
    [
        (lambda: BlokFlash(0.3, 10.0, 1e-4, 46.0, *STEEL).at_speed(-1.0), "sliding speeds (m/s)"),
        (lambda: JaegerBand(1e9, 1e-5, *STEEL).at_speed(0.0), "speed (m/s) of the material under a band"),
        (lambda: MovingHeatSource(1e9, 1e-5, 1e-5, *STEEL, "round"), "shape of moving-source"),
        (lambda: TianKennedy(1e9, 0.0, *STEEL), "radius (m) of tian-kennedy"),
        (lambda: fast_share((1.0, 1.0), (1.0, 1.0), (0.0, 1.0)), "speed (m/s)"),
    ],
)
def test_what_cannot_be_is_refused(call, subject: str) -> None:
    with refused(InputError, subject):
        call()
