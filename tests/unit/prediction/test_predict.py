"""Predicted contacts beside solved ones, and what is refused."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from reference_data import Row, every_row, reference
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.generate import ExponentialAutocorrelation, GaussianAutocorrelation, RmsHeight, SelfAffine, gaussian
from asperity.studies import Prediction
from asperity.theories.rough.predictor import HEIGHTS, PERIMETER, Expected, predictor, table

E, NU, RMS, BETA = 100e9, 0.3, 1e-9, 0.5e-6
ROUGH = ExponentialAutocorrelation(RMS, BETA)
HALF_SPACE = asp.Elastic(E, NU)
HARD = asp.plasticity.HardWall()
REACH = 3.0
"""Standard errors within which a mean of a few surfaces must be predicted."""


def grid_of(points: float, size: float) -> asp.Grid:
    return asp.Grid((int(points),) * 2, (size * BETA / points,) * 2)


def layered(ratio: float, thickness: float, nu: tuple[float, float] = (NU, NU)) -> asp.Layered:
    return asp.Layered(
        [asp.Layer(asp.Elastic(ratio * E, nu[0]), thickness=thickness * BETA)], base=asp.Elastic(E, nu[1])
    )


def load(X: float) -> asp.MeanPressure:
    return asp.MeanPressure(X * E * RMS / BETA)


def off(found: Expected, mean: float, samples: float) -> float:
    """Deviation from the ``mean`` of some surfaces over its standard error."""
    return (found.value - mean) / math.hypot(found.error, found.scatter / math.sqrt(samples))


TOUCHING = [row for row in reference("missing/predictor_master") if row["area_raw"] * row["n"] ** 2 >= 24.0]


@every_row(TOUCHING)
def test_means_on_a_half_space_lie_within_the_stated_errors(row: Row) -> None:
    found = asp.predict(ROUGH, HALF_SPACE, load(row["X"]), grid=grid_of(row["n"], row["L_over_beta"]))
    n = row["samples"]
    s = found.waves.full_contact
    assert s * BETA / (E * RMS) == pytest.approx(row["s_beta_over_E2_sigma"], rel=0.015)  # of four maps
    assert abs(off(found.area_fraction, row["area_corrected"], n)) < REACH
    assert abs(off(found.area_fraction_pixels, row["area_raw"], n)) < REACH
    assert abs(off(found.peak_pressure, row["pmax_over_s"] * s, n)) < REACH
    assert abs(off(found.mean_gap, row["gap_over_sigma"] * RMS, n)) < REACH


def test_means_on_a_half_space_are_as_near_as_promised() -> None:
    area, peak, gap = [], [], []
    for row in TOUCHING:
        if row["X"] < 0.003:
            continue
        found = asp.predict(ROUGH, HALF_SPACE, load(row["X"]), grid=grid_of(row["n"], row["L_over_beta"]))
        area.append(found.area_fraction.value / row["area_corrected"] - 1.0)
        peak.append(found.peak_pressure.value / found.waves.full_contact / row["pmax_over_s"] - 1.0)
        gap.append(found.mean_gap.value / RMS - row["gap_over_sigma"])
    rms = [float(np.sqrt(np.mean(np.square(one)))) for one in (area, peak, gap)]
    assert rms[0] < 0.03
    assert rms[1] < 0.10
    assert rms[2] < 0.06


@every_row(reference("missing/predictor_test"))
def test_layers_and_grids_that_were_not_tabulated(row: Row) -> None:
    solid = layered(row["E1_over_E2"], row["h_over_beta"])
    found = asp.predict(ROUGH, solid, load(row["X"]), grid=grid_of(row["points"], row["L_over_beta"]))
    assert abs(off(found.area_fraction, row["area_corrected_mean"], 4)) < REACH
    assert abs(off(found.peak_pressure, row["pmax_mean_Pa"], 4)) < REACH


@every_row(reference("missing/predictor_layer"))
def test_pressure_of_full_contact_and_factors_of_a_layer(row: Row) -> None:
    grid, solid = grid_of(128, 20.0), layered(row["E1_over_E2"], row["h_over_beta"])
    bare = asp.predict(ROUGH, HALF_SPACE, load(0.1), grid=grid)
    found = asp.predict(ROUGH, solid, load(0.1), grid=grid)
    assert found.waves.full_contact / bare.waves.full_contact == pytest.approx(
        row["s_over_s_substrate"], rel=5e-3
    )  # of four maps
    factor, error = predictor().factors.at(found.groups, "peak")
    # loads of the reference are fixed in X, those of the table in y
    assert factor == pytest.approx(row["pmax_factor"], abs=REACH * math.hypot(factor * error, row["pmax_factor_sd"]))
    factor, error = predictor().factors.at(found.groups, "area")
    sd = math.hypot(factor * error, row["area_corrected_factor_sd"])
    assert factor == pytest.approx(row["area_corrected_factor"], abs=REACH * sd)


def solved(
    surface: asp.Surface, solid: object, pressure: float, law: object = HARD
) -> tuple[float, float, float, float]:
    """Area freed of the pixels by its perimeter, counted area, peak (Pa) and gap (m)."""
    problem = asp.ContactProblem(surface, solid, law=law)
    result = asp.solve(problem, asp.MeanPressure(pressure), keep=asp.Keep(stiffness=False))
    contact = result.contact
    edges = sum(float((contact != np.roll(contact, 1, axis)).mean()) for axis in (0, 1))
    area = result.area_fraction - PERIMETER * edges
    return area, result.area_fraction, float(result.pressure.max()), float(result.gap.mean())


@pytest.mark.slow
@pytest.mark.parametrize(
    ("points", "size", "solid"),
    [
        (150, 24.0, HALF_SPACE),
        (128, 12.0, asp.Elastic(70e9, 0.45)),
        (128, 16.0, layered(3.3, 0.12)),
        (128, 16.0, layered(0.6, 0.3)),
        (128, 16.0, layered(2.5, 0.25, (0.22, 0.38))),
    ],
)
@pytest.mark.parametrize("y", [0.004, 0.1])
def test_withheld_surfaces(points: int, size: float, solid: object, y: float) -> None:
    grid = grid_of(points, size)
    p = y * asp.predict(ROUGH, solid, asp.MeanPressure(1e8), grid=grid).waves.full_contact
    found = asp.predict(ROUGH, solid, asp.MeanPressure(p), grid=grid)
    rows = np.array([solved(gaussian(grid, ROUGH, seed=seed), solid, p) for seed in range(9001, 9009)])
    expected = (found.area_fraction, found.area_fraction_pixels, found.peak_pressure, found.mean_gap)
    assert [
        round(off(one, mean, 8), 2)
        for one, mean in zip(expected, rows.mean(axis=0), strict=True)
        if abs(off(one, mean, 8)) > REACH
    ] == []
    within = [(one.band[0] <= values) & (values <= one.band[1]) for one, values in zip(expected, rows.T, strict=True)]
    assert np.mean(within) > 0.85  # 19 of 20, of four correlated numbers of eight surfaces


def several(*layers: tuple[float, float]) -> asp.Layered:
    return asp.Layered(
        [asp.Layer(asp.Elastic(ratio * E, NU), thickness=thickness * BETA) for ratio, thickness in layers], HALF_SPACE
    )


GRADED = asp.Layered(asp.solids.graded(asp.Elastic(3.0 * E, NU), HALF_SPACE, 0.4 * BETA, sublayers=8), HALF_SPACE)


@pytest.mark.slow
@pytest.mark.parametrize(
    "solid",
    [
        several((2.5, 0.08), (1.6, 0.25)),
        several((0.5, 0.1), (0.8, 0.5)),
        several((1.4, 0.1), (2.2, 0.1), (1.6, 0.3)),
        GRADED,
    ],
    ids=["stiff", "soft", "three", "graded"],
)
@pytest.mark.parametrize("y", [0.006, 0.1])
def test_several_layers_like_the_one_that_is_as_compliant(solid: asp.Layered, y: float) -> None:
    grid = grid_of(144, 18.0)
    p = y * asp.predict(ROUGH, solid, asp.MeanPressure(1e8), grid=grid).waves.full_contact
    found = asp.predict(ROUGH, solid, asp.MeanPressure(p), grid=grid)
    rows = np.array([solved(gaussian(grid, ROUGH, seed=seed), solid, p) for seed in range(9401, 9405)])
    expected = (found.area_fraction, found.area_fraction_pixels, found.peak_pressure, found.mean_gap)
    for one, mean in zip(expected, rows.mean(axis=0), strict=True):
        assert abs(off(one, mean, 4)) < REACH
    assert found.area_fraction.error < 0.08 * found.area_fraction.value


def test_layers_alike_are_one_layer() -> None:
    """Split, a layer is read as before, with the error of several."""
    grid = grid_of(128, 20.0)
    whole = asp.predict(ROUGH, layered(2.0, 0.3), load(0.1), grid=grid)
    split = asp.predict(ROUGH, several((2.0, 0.1), (2.0, 0.2)), load(0.1), grid=grid)
    assert split.waves.full_contact == pytest.approx(whole.waves.full_contact, rel=1e-9)
    assert (split.groups.ratio, split.groups.thickness) == pytest.approx((2.0, 0.3), rel=1e-3)
    assert split.area_fraction.value == pytest.approx(whole.area_fraction.value, rel=1e-3)
    with refused(InputError, "layers of a prediction"):
        asp.predict(ROUGH, several((3.0, 0.1), (0.5, 0.2)), load(0.1), grid=grid)


def self_affine(hurst: float = 0.8) -> SelfAffine:
    return SelfAffine(
        amplitude=RmsHeight(RMS), hurst=hurst, shortest_wavelength=0.3 * BETA, rolloff_wavelength=4.0 * BETA
    )


def test_a_map_is_predicted_like_its_spectrum() -> None:
    grid = grid_of(256, 25.0)
    surface = gaussian(grid, ROUGH, seed=5, variant="fixed")
    p = asp.MeanPressure(20e6)
    by_map = asp.predict(surface, HALF_SPACE, p)
    by_spectrum = asp.predict(ROUGH, HALF_SPACE, p, grid=grid)
    assert by_map.waves.full_contact == pytest.approx(by_spectrum.waves.full_contact, rel=1e-9)
    assert by_map.area_fraction.value == pytest.approx(by_spectrum.area_fraction.value, rel=1e-9)
    assert by_map.mean_gap.value == pytest.approx(by_spectrum.mean_gap.value, rel=0.02)  # by the measured 10 % length


def test_load_and_mean_pressure_are_the_same() -> None:
    grid = grid_of(128, 20.0)
    one = asp.predict(ROUGH, HALF_SPACE, asp.MeanPressure(2e7), grid=grid)
    other = asp.predict(ROUGH, HALF_SPACE, asp.Force(2e7 * grid.area), grid=grid)
    assert one.area_fraction.value == pytest.approx(other.area_fraction.value, rel=1e-12)


def test_limits_of_the_layer() -> None:
    grid = grid_of(128, 20.0)
    alone = asp.predict(ROUGH, asp.Elastic(2.0 * E, NU), load(0.1), grid=grid)
    thick = asp.predict(ROUGH, layered(2.0, 200.0), load(0.1), grid=grid)
    assert thick.area_fraction.value == pytest.approx(alone.area_fraction.value, rel=5e-3)
    assert thick.peak_pressure.value == pytest.approx(alone.peak_pressure.value, rel=5e-3)
    same = asp.predict(ROUGH, layered(1.0, 0.3), load(0.1), grid=grid)
    bare = asp.predict(ROUGH, HALF_SPACE, load(0.1), grid=grid)
    assert same.area_fraction.value == pytest.approx(bare.area_fraction.value, rel=1e-9)


def test_two_half_spaces_count_as_one_of_their_contact_modulus() -> None:
    grid = grid_of(128, 20.0)
    both = asp.predict(ROUGH, HALF_SPACE, load(0.1), grid=grid, counter_body=HALF_SPACE)
    soft = asp.predict(ROUGH, asp.Elastic(0.5 * E, NU), load(0.1), grid=grid)
    assert both.peak_pressure.value == pytest.approx(soft.peak_pressure.value, rel=1e-12)


def test_area_grows_and_gap_falls_with_the_load() -> None:
    grid = grid_of(256, 20.0)
    found = [asp.predict(ROUGH, HALF_SPACE, load(X), grid=grid) for X in np.geomspace(0.002, 10.0, 25)]
    assert np.all(np.diff([one.area_fraction.value for one in found]) > 0.0)
    assert np.all(np.diff([one.area_fraction_pixels.value for one in found]) > 0.0)
    assert np.all(np.diff([one.mean_gap.value for one in found]) <= 0.0)
    assert np.all(np.diff([one.peak_pressure.value for one in found]) > 0.0)


@pytest.mark.parametrize("key", ["0.5", "1", "2"])
def test_menisci_beside_the_reference(key: str) -> None:
    left = []
    for row in TOUCHING:
        if row["gap_over_sigma"] < 0.35 or row["X"] < 0.01:
            continue
        found = asp.predict(ROUGH, HALF_SPACE, load(row["X"]), grid=grid_of(row["n"], row["L_over_beta"]))
        left.append(predictor().share_below(found.groups, float(key)).value / row[f"meniscus_area_h_{key}sigma"] - 1.0)
    assert float(np.sqrt(np.mean(np.square(left)))) < 0.06


def test_menisci_pull_and_their_pull_is_in_the_load() -> None:
    grid, film = grid_of(256, 20.0), asp.LiquidFilm(surface_tension=72e-3, thickness=RMS)
    dry = asp.predict(ROUGH, HALF_SPACE, asp.MeanPressure(20e6), grid=grid)
    wet = asp.predict(ROUGH, HALF_SPACE, asp.MeanPressure(20e6), grid=grid, pull=(film.suction, film.thickness))
    pull = wet.pull_pressure.value
    assert pull > 0.0
    assert math.isnan(dry.pull_pressure.value)
    again = asp.predict(ROUGH, HALF_SPACE, asp.MeanPressure(20e6 + pull), grid=grid)
    assert wet.area_fraction.value == pytest.approx(again.area_fraction.value, rel=1e-5)
    assert pull == pytest.approx(
        predictor().share_below(again.groups, RMS / again.waves.rms).value * film.suction, rel=1e-4
    )


def test_yield() -> None:
    solid = asp.Elastic(E, NU, asp.Strength(yield_stress=1e9, hardness=3e9))
    found = asp.predict(ROUGH, solid, asp.MeanPressure(20e6), grid=grid_of(256, 20.0))
    factor = 1e9 / math.sqrt(3.0) / found.max_sqrtJ2.value
    assert found.yield_factor.value == pytest.approx(factor)
    assert 0.3 < found.max_sqrtJ2.value / found.peak_pressure.value < 0.36
    assert [one.criterion for one in found.findings] == ["prediction elastic"]


def test_what_lies_outside_is_refused() -> None:
    grid, p = grid_of(128, 20.0), load(0.1)
    with refused(InputError, "mean pressure / rms pressure of full contact"):
        asp.predict(ROUGH, HALF_SPACE, load(100.0), grid=grid)
    with refused(InputError, "bandwidth α"):
        asp.predict(GaussianAutocorrelation(RMS, BETA), HALF_SPACE, p, grid=grid)
    with refused(InputError, "side / 10 % length"):
        asp.predict(ROUGH, HALF_SPACE, p, grid=grid_of(64, 6.0))
    with refused(InputError, "modulus of the layer / that of its base"):
        asp.predict(ROUGH, layered(12.0, 0.3), p, grid=grid)
    with refused(InputError, "thickness of the layer / 10 % length"):
        asp.predict(ROUGH, layered(2.0, 0.005), p, grid=grid)
    with refused(InputError, "pixels in contact"):
        asp.predict(ROUGH, HALF_SPACE, load(0.001), grid=grid_of(64, 20.0))
    with refused(InputError, "Poisson's ratios of a layer and its base"):
        asp.predict(ROUGH, layered(2.0, 0.3, (0.1, 0.3)), p, grid=grid)
    with refused(InputError, "bodies of a prediction"):
        asp.predict(ROUGH, layered(2.0, 0.3), p, grid=grid, counter_body=HALF_SPACE)
    with refused(InputError, "grid"):
        asp.predict(ROUGH, HALF_SPACE, p)
    with refused(InputError, "grid"):
        asp.predict(gaussian(grid, ROUGH, seed=1), HALF_SPACE, p, grid=grid)
    with refused(InputError, "surface of a prediction"):
        asp.predict(ExponentialAutocorrelation(RMS, BETA, correlation_length_y=4.0 * BETA), HALF_SPACE, p, grid=grid)
    with refused(InputError, "reach of a pull"):
        asp.predict(ROUGH, HALF_SPACE, p, grid=grid, pull=(1e8, 10.0 * RMS))


def test_the_tables_say_where_they_come_from() -> None:
    folder = Path(asp.__file__).parent / "data" / "predictor"
    for name in ("master", "layer"):
        first = (folder / f"{name}.csv").read_text(encoding="utf-8").splitlines()[:2]
        assert "validation/predictor_table.py at commit" in first[1]
        assert "seeds from" in first[1]
        assert len(table(name)) > 100
    assert {f"below_{height:g}" for height in HEIGHTS} <= {*table("master")[0]}


def test_surfaces_of_another_kind_are_predicted_with_wider_bands() -> None:
    found = asp.predict(self_affine(), HALF_SPACE, asp.MeanPressure(20e6), grid=grid_of(256, 30.0))
    assert found.area_fraction.error > 0.1 * found.area_fraction.value
    assert math.isnan(found.mean_gap.value)
    assert math.isnan(found.area_fraction_pixels.value)
    assert [one.criterion for one in found.findings] == ["prediction exponential"]
    with refused(InputError, "surface"):
        asp.predict(self_affine(), HALF_SPACE, asp.MeanPressure(20e6), grid=grid_of(256, 30.0), pull=(1e8, RMS))


@pytest.mark.slow
@pytest.mark.parametrize("hurst", [0.4, 0.7])
@pytest.mark.parametrize("y", [0.01, 0.1])
def test_self_affine_surfaces(hurst: float, y: float) -> None:
    grid, spectrum = grid_of(256, 30.0), self_affine(hurst)
    p = y * asp.predict(spectrum, HALF_SPACE, asp.MeanPressure(2e7), grid=grid).waves.full_contact
    found = asp.predict(spectrum, HALF_SPACE, asp.MeanPressure(p), grid=grid)
    rows = np.array([solved(gaussian(grid, spectrum, seed=seed), HALF_SPACE, p) for seed in range(9101, 9105)])
    assert abs(off(found.area_fraction, rows[:, 0].mean(), 4)) < 2.0
    assert abs(off(found.peak_pressure, rows[:, 2].mean(), 4)) < 2.0


@pytest.mark.slow
@pytest.mark.parametrize(("points", "size", "solid"), [(112, 18.0, HALF_SPACE), (96, 12.0, layered(2.0, 0.2))])
@pytest.mark.parametrize("y", [0.02, 0.2])
@pytest.mark.parametrize("hardness", [0.35, 0.7, 1.5, 3.0])
def test_contacts_under_a_hardness(points: int, size: float, solid: object, y: float, hardness: float) -> None:
    """Means of solved contacts that no fit has seen, within the stated errors."""
    grid = grid_of(points, size)
    s = asp.predict(ROUGH, solid, asp.MeanPressure(1e8), grid=grid).waves.full_contact
    p, H = y * s, hardness * s
    found = asp.predict(ROUGH, solid, asp.MeanPressure(p), grid=grid, hardness=H)
    surfaces = [gaussian(grid, ROUGH, seed=seed) for seed in range(9201, 9205)]
    rows = np.array([solved(one, solid, p, asp.Hardness(H)) for one in surfaces])
    assert abs(off(found.area_fraction, rows[:, 0].mean(), 4)) < REACH
    assert abs(off(found.area_fraction_pixels, rows[:, 1].mean(), 4)) < REACH
    assert np.all(rows[:, 2] <= found.peak_pressure.band[1] * (1.0 + 1e-9))
    if math.isfinite(found.mean_gap.value):
        assert found.mean_gap.value == pytest.approx(rows[:, 3].mean(), abs=0.1 * RMS)


def test_limits_of_a_hardness() -> None:
    """A high one changes nothing; under a low one the area is the load over the hardness."""
    grid, p = grid_of(256, 20.0), 20e6
    elastic = asp.predict(ROUGH, HALF_SPACE, asp.MeanPressure(p), grid=grid)
    high = asp.predict(ROUGH, HALF_SPACE, asp.MeanPressure(p), grid=grid, hardness=1e12)
    assert high.area_fraction_pixels.value == pytest.approx(elastic.area_fraction_pixels.value, rel=1e-3)
    assert high.peak_pressure == elastic.peak_pressure
    assert high.yield_factor == elastic.yield_factor or math.isnan(high.yield_factor.value)
    H = p / elastic.area_fraction_pixels.value / 2.4
    low = asp.predict(ROUGH, HALF_SPACE, asp.MeanPressure(p), grid=grid, hardness=H)
    assert 1.0 < low.area_fraction_pixels.value / (p / H) < 1.1
    assert (low.peak_pressure.value, low.peak_pressure.band) == (H, (H, H))
    assert math.isnan(low.mean_gap.value)
    assert math.isnan(low.max_sqrtJ2.value)
    with refused(InputError, "mean real pressure of the elastic contact / hardness"):
        asp.predict(ROUGH, HALF_SPACE, asp.MeanPressure(p), grid=grid, hardness=0.9 * H)
    with refused(InputError, "hardness of a prediction"):
        asp.predict(ROUGH, HALF_SPACE, asp.MeanPressure(p), grid=grid, hardness=1.1 * p)
    with refused(InputError, "pull of a prediction"):
        asp.predict(ROUGH, HALF_SPACE, asp.MeanPressure(p), grid=grid, hardness=H, pull=(1e7, RMS))


@pytest.mark.slow
@pytest.mark.parametrize(("skewness", "kurtosis"), [(0.4, 3.3), (-0.4, 3.3), (0.0, 3.6), (0.2, 3.1), (-0.5, 3.4)])
@pytest.mark.parametrize("y", [0.008, 0.1])
def test_surfaces_that_are_not_gaussian_lie_within_the_wider_bands(skewness: float, kurtosis: float, y: float) -> None:
    grid = grid_of(160, 16.0)
    for seed in (9301, 9302):
        made = asp.generate.translated(grid, ROUGH, seed=seed, skewness=skewness, kurtosis=kurtosis)
        surface = asp.Surface(made.heights - made.heights.mean(), *grid.spacing, periodic=True)
        p = y * asp.predict(ROUGH, HALF_SPACE, asp.MeanPressure(1e8), grid=grid).waves.full_contact
        found = asp.predict(surface, HALF_SPACE, asp.MeanPressure(p))
        area, pixels, peak, gap = solved(surface, HALF_SPACE, p)
        for one, value in (
            (found.area_fraction, area),
            (found.area_fraction_pixels, pixels),
            (found.peak_pressure, peak),
            (found.mean_gap, gap),
        ):
            assert math.isnan(one.value) or one.band[0] <= value <= one.band[1]


def test_heights_far_from_gaussian_are_refused() -> None:
    grid = grid_of(256, 20.0)
    heights = gaussian(grid, ROUGH, seed=1).heights
    surface = asp.Surface(np.exp(heights / RMS) * RMS, *grid.spacing, periodic=True)
    with refused(InputError, "heights of a prediction"):
        asp.predict(surface, HALF_SPACE, asp.MeanPressure(20e6))


@pytest.mark.slow
def test_a_measured_map_beside_its_solve(shared_data: Path) -> None:
    surface = asp.periodised(asp.levelled(asp.read(shared_data / "afm_granular_film_10um_512.di"), "plane"))
    found: Prediction = asp.predict(surface, HALF_SPACE, asp.MeanPressure(500e6))
    area, _, peak, _ = solved(surface, HALF_SPACE, 500e6)
    assert found.area_fraction.band[0] <= area <= found.area_fraction.band[1]
    assert found.peak_pressure.band[0] <= peak <= found.peak_pressure.band[1]
