"""Predicted stresses and first yield of layer and base, beside those of solved contacts."""

from __future__ import annotations

import math

import numpy as np
import pytest

import asperity as asp
from asperity.generate import ExponentialAutocorrelation, gaussian
from asperity.theories.rough.predictor import Expected, Groups
from asperity.theories.rough.predictor_stress import THINNEST, in_half_space, stresses

E, NU, RMS, BETA = 100e9, 0.3, 1e-9, 0.5e-6
ROUGH = ExponentialAutocorrelation(RMS, BETA)
ONE = Expected(1.0, 0.0, 0.0)
REACH = 3.0


def grid_of(points: int, size: float) -> asp.Grid:
    return asp.Grid((points, points), (size * BETA / points,) * 2)


def elastic(modulus: float, nu: float = NU, strength: float = math.nan) -> asp.Elastic:
    return asp.Elastic(modulus, nu, asp.Strength(yield_stress=strength))


def coated(ratio: float, thickness: float, nu: tuple[float, float] = (NU, NU), **strengths: float) -> asp.Layered:
    """A layer of this thickness in m."""
    layer = elastic(ratio * E, nu[0], strengths.get("layer", math.nan))
    return asp.Layered([asp.Layer(layer, thickness)], base=elastic(E, nu[1], strengths.get("base", math.nan)))


def loaded(y: float, body: object, grid: asp.Grid) -> asp.MeanPressure:
    """The load of y times the rms pressure of full contact."""
    return asp.MeanPressure(y * asp.predict(ROUGH, body, asp.MeanPressure(1e8), grid=grid).waves.full_contact)


def largest(surface: asp.Surface, body: asp.Layered, control: asp.MeanPressure) -> tuple[float, float]:
    """Largest √J₂ in the layer and in the base of a solved contact, on planes no fit has had."""
    result = asp.solve(asp.ContactProblem(surface, body), control, keep=asp.Keep(stiffness=False))
    pixel, h = surface.grid.spacing[0], body.layers[0].thickness
    layer = [part * pixel for part in (0.0, 0.15, 0.25, 0.35, 0.45, 0.55, 0.7, 1.0, 1.5, 2.5) if part * pixel < h]
    layer += [part * h for part in (0.2, 0.4, 0.6, 0.8, 1.0)]
    base = [h + part * pixel for part in (0.1, 0.25, 0.4, 0.7, 1.0, 2.0)] + [1.2 * h, 1.5 * h, 2.0 * h]
    found = [0.0, 0.0]
    for field in asp.stresses.stress_planes(result, [*layer, *base]):
        part = field.planes[0].region.index
        found[part] = max(found[part], float(field.sqrt_J2.max()))
    return found[0], found[1]


def off(found: Expected, mean: float, samples: int) -> float:
    """Deviation from the mean of some surfaces over its standard error."""
    return (found.value - mean) / math.hypot(found.error, found.scatter / math.sqrt(samples))


WITHHELD = [
    (112, 18.0, 1.0, 0.9, (NU, NU)),
    (112, 18.0, 2.3, 0.55, (NU, NU)),
    (144, 12.0, 4.6, 1.2, (0.24, 0.33)),
    (144, 12.0, 0.35, 2.6, (0.36, 0.3)),
    (176, 22.0, 1.6, 4.0, (NU, 0.22)),
    (176, 22.0, 3.0, 9.0, (NU, NU)),
    (112, 18.0, 0.6, 25.0, (NU, NU)),
]
"""Points, side over β, E1/E2, thickness over λ, Poisson's ratios of layer and base."""


@pytest.mark.slow
@pytest.mark.parametrize(("points", "size", "ratio", "thickness", "nu"), WITHHELD)
@pytest.mark.parametrize("y", [0.008, 0.09])
def test_withheld_stresses(
    points: int, size: float, ratio: float, thickness: float, nu: tuple[float, float], y: float
) -> None:
    """Means within the stated errors, and nearly all single surfaces in the bands."""
    grid = grid_of(points, size)
    width = asp.predict(ROUGH, elastic(E), asp.MeanPressure(1e8), grid=grid).waves.summit_length
    body = coated(ratio, thickness * width, nu)
    control = loaded(y, body, grid)
    found = asp.predict(ROUGH, body, control, grid=grid)
    seeds = range(9501, 9509)
    rows = np.array([largest(gaussian(grid, ROUGH, seed=seed), body, control) for seed in seeds])
    expected = found.max_sqrtJ2_layer, found.max_sqrtJ2_base
    for one, values in zip(expected, rows.T, strict=True):
        assert abs(off(one, values.mean(), len(seeds))) < REACH
        assert np.mean((one.band[0] <= values) & (values <= one.band[1])) >= 0.75
    assert found.max_sqrtJ2.value == max(one.value for one in expected)


@pytest.mark.parametrize("nu", [0.0, 0.15, 0.3, 0.45])
def test_below_a_half_space_it_is_a_little_less_than_below_hertz(nu: float) -> None:
    """Spots of a few pixels spread the pressure: 0.92 to 0.97 of that under Hertz's pressure on the
    axis (Johnson 1985, eqs 3.45)."""
    z = np.linspace(0.01, 2.0, 2000)
    radial = -(1.0 + nu) * (1.0 - z * np.arctan(1.0 / z)) + 0.5 / (1.0 + z**2)
    hertz = float(np.abs(radial + 1.0 / (1.0 + z**2)).max()) / math.sqrt(3.0)
    assert 0.91 < in_half_space(nu, ONE).value / hertz < 0.98


@pytest.mark.parametrize("nu", [0.2, 0.3, 0.4])
def test_a_thick_layer_and_the_base_of_a_thin_one_are_half_spaces(nu: float) -> None:
    read = stresses()
    for ratio in (0.3, 1.0, 2.5, 5.0):
        thick = Groups(0.02, 0.1, 6.0, 20.0, 10**4, ratio, 30.0, 90.0)
        thin = Groups(0.02, 0.1, 6.0, 20.0, 10**4, ratio, 0.05, 0.15)
        assert read.in_layer(thick, (nu, 0.3), ONE).value == pytest.approx(in_half_space(nu, ONE).value, rel=0.03)
        assert read.in_base(thin, (0.3, nu), ONE).value == pytest.approx(in_half_space(nu, ONE).value, rel=0.12)
        assert read.in_base(thick, (nu, 0.3), ONE).value < 0.05


def test_stress_in_the_base_falls_with_the_thickness() -> None:
    read = stresses()
    for ratio in (0.3, 1.0, 2.0, 5.0):
        for y in (0.005, 0.05, 0.5):
            deep = np.geomspace(1.2, 12.0, 20)
            groups = [Groups(y, 0.1, 8.0, 20.0, 10**4, ratio, 0.1, h) for h in deep]
            assert np.all(np.diff([read.in_base(one, (NU, NU), ONE).value for one in groups]) < 0.0)


def test_the_load_of_first_yield_is_where_the_stress_is_the_yield_stress() -> None:
    grid, thickness = grid_of(192, 20.0), 0.08e-6
    trial = asp.predict(ROUGH, coated(2.0, thickness), asp.MeanPressure(20e6), grid=grid)
    strengths = {
        "layer": 1.1 * math.sqrt(3.0) * trial.max_sqrtJ2_layer.value,
        "base": 1.05 * math.sqrt(3.0) * trial.max_sqrtJ2_base.value,
    }
    body = coated(2.0, thickness, **strengths)
    found = asp.predict(ROUGH, body, asp.MeanPressure(20e6), grid=grid)
    assert found.yield_factor.value == pytest.approx(1.05)
    assert found.yield_load.value == min(found.yield_load_layer.value, found.yield_load_base.value)
    for name in ("layer", "base"):
        onset, limit = getattr(found, f"yield_load_{name}"), strengths[name] / math.sqrt(3.0)
        low, high = onset.band
        assert 0.0 <= low < 1.0 < onset.value < high
        then = getattr(asp.predict(ROUGH, body, asp.MeanPressure(20e6 * onset.value), grid=grid), f"max_sqrtJ2_{name}")
        assert then.value == pytest.approx(limit, rel=1e-4)
        for end, side in ((low, 1), (high, 0)):
            if 0.0 < end < math.inf:
                there = asp.predict(ROUGH, body, asp.MeanPressure(20e6 * end), grid=grid)
                assert getattr(there, f"max_sqrtJ2_{name}").band[side] == pytest.approx(limit, rel=1e-3)


def test_parts_that_never_or_always_yield_are_said() -> None:
    grid = grid_of(192, 20.0)
    body = coated(2.0, 0.08e-6, layer=1e12, base=1e6)
    found = asp.predict(ROUGH, body, asp.MeanPressure(20e6), grid=grid)
    assert math.isnan(found.yield_load_layer.value)
    assert math.isnan(found.yield_load_base.value)
    assert math.isnan(found.yield_load.value)
    said = [finding for finding in found.findings if finding.criterion == "prediction yield"]
    assert [finding.numbers["factor"] > 1.0 for finding in said] == [True, False]
    strong = asp.predict(ROUGH, coated(2.0, 0.08e-6, layer=1e12, base=4e8), asp.MeanPressure(20e6), grid=grid)
    assert strong.yield_load == strong.yield_load_base or math.isnan(strong.yield_load_base.value)


def test_what_is_not_known_of_coated_bodies() -> None:
    grid = grid_of(96, 30.0)
    width = asp.predict(ROUGH, elastic(E), asp.MeanPressure(2e7), grid=grid).waves.summit_length

    def predicted(body: asp.Layered) -> tuple[bool, bool, bool, list[str]]:
        found = asp.predict(ROUGH, body, asp.MeanPressure(20e6), grid=grid)
        known = (math.isfinite(one.value) for one in (found.max_sqrtJ2, found.max_sqrtJ2_layer, found.max_sqrtJ2_base))
        return *known, [one.criterion for one in found.findings if one.criterion == "prediction stress"]  # type: ignore[return-value]

    assert predicted(coated(2.0, 5.0 * width)) == (True, True, True, [])
    assert predicted(coated(2.0, 0.9 * THINNEST * width)) == (False, False, True, ["prediction stress"])
    assert predicted(coated(2.0, 150.0 * width)) == (True, True, False, ["prediction stress"])
    two = [asp.Layer(elastic(2.0 * E), 3.0 * width), asp.Layer(elastic(1.5 * E), 3.0 * width)]
    assert predicted(asp.Layered(two, base=elastic(E))) == (False, False, False, ["prediction stress"])
