"""Statistics of surfaces that are known in closed form: waves, planes, paraboloids, Gaussian
heights and slopes."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from reference_data import Row, every_row, reference
from summit_maps import MAPS, summit_map

import asperity as asp
from asperity import roughness as r

ROWS = reference("surfaces_analytic")


def surface_of(case: str, given_: dict) -> asp.Surface:
    i, j = np.arange(given_["nx"])[:, None], np.arange(given_.get("ny", 1))[None, :]
    dx = given_["dx"]
    dy = given_.get("dy", dx)
    if case in ("AN1", "AN2"):
        phase = given_["kx"] * i / given_["nx"] + given_["ky"] * j / given_["ny"]
        heights = given_["a"] * np.cos(2.0 * np.pi * phase + given_["phi"])
    elif case == "AN3":
        waves = [2.0 * np.pi * given_[f"k{a}"] * n / given_[f"n{a}"] for a, n in (("x", i), ("y", j))]
        heights = given_["a"] * np.cos(waves[0]) * np.cos(waves[1])
    elif case == "AN4":
        wave = 2.0 * np.pi * i / given_["nx"]
        heights = given_["a1"] * np.cos(given_["k1"] * wave) + given_["a2"] * np.cos(
            given_["k2"] * wave + given_["phi"]
        )
        heights = heights + 0.0 * j
    elif case == "AN5":
        heights = given_["a"] + given_["b"] * i * dx + given_["c"] * j * dy
    else:
        x, y = (i - given_["i0"]) * dx, (j - given_["j0"]) * dy
        heights = -(x**2) / (2.0 * given_["Rx"]) - y**2 / (2.0 * given_["Ry"])
    return asp.Surface(heights, dx, dy, periodic=bool(given_["periodic"]))


def value_of(surface: asp.Surface, quantity: str, given_: dict) -> float:
    heights = {"Sq": "Sq", "Sq after mean": "Sq", "Sa": "Sa", "Sku": "Sku", "Ssk": "Ssk"}
    if quantity in heights:
        return getattr(r.height_parameters(surface), heights[quantity])
    if quantity == "Sq after poly1":
        return asp.roughness.rms_height(asp.levelled(surface, "plane"))
    if quantity.startswith("sum8"):
        mean = r.summit_statistics(r.summits(surface))
        names = {
            "sum8_count": mean.count,
            "sum8_mean_curvature": mean.mean_curvature,
            "sum8_mean_height": mean.mean_height,
            "sum8_radius_of_mean_curv": mean.radius,
        }
        return names[quantity]
    if quantity.startswith("C"):
        if quantity.startswith("C1D"):
            return float(r.profile_spectrum(surface).psd[given_["kx"] - 1])
        kx, ky = (given_["kx"], given_["ky"]) if given_["ky"] >= 0 else (-given_["kx"], -given_["ky"])
        psd = float(r.power_spectrum(surface).psd[kx, ky])
        return psd / (4.0 * math.pi**2) if "persson" in quantity else psd
    if quantity == "acf(2,-3)":
        return r.autocovariance(surface).at((2, -3))
    if quantity == "struct_x(3)":
        return r.mean_square_increment(surface, (3, 0))
    if quantity == "Sdr_iso":
        return r.developed_area_ratio(surface)
    if quantity.endswith("_spec") or quantity.startswith(("m2_max", "m2_min")):
        moments = r.spectral_moments(r.power_spectrum(surface))
        tensor = moments.slope_tensor
        named = {
            "m2_max": tensor.largest,
            "m2_min": tensor.smallest,
            "m2_max_dir_deg": math.degrees(tensor.direction),
        }
        return named[quantity] if quantity in named else getattr(moments, quantity.removesuffix("_spec"))
    return difference_of(surface, quantity)


def difference_of(surface: asp.Surface, quantity: str) -> float:
    m0 = asp.roughness.rms_height(surface) ** 2
    if quantity == "m0":
        return m0
    squares = {
        "m2x_fd": lambda: r.rms_profile_slope(surface, axis="x") ** 2,
        "m2y_fd": lambda: r.rms_profile_slope(surface, axis="y") ** 2,
        "m4x_fd": lambda: r.rms_profile_curvature(surface, axis="x") ** 2,
        "m4y_fd": lambda: r.rms_profile_curvature(surface, axis="y") ** 2,
        "rms_laplacian_fd": lambda: r.rms_laplacian(surface),
    }
    if quantity == "alpha_fd":
        return r.nayak_parameter(m0, squares["m2x_fd"](), squares["m4x_fd"]())
    if quantity == "Sdq_pairs":
        return math.sqrt(squares["m2x_fd"]() + squares["m2y_fd"]())
    return squares[quantity]()


def is_map(row: Row) -> bool:
    # coefficients of polynomials are a matter of levelling
    return row["case"] in ("AN1", "AN2", "AN3", "AN4", "AN5", "AN6") and not row["quantity"].startswith("detrend")


@every_row([row for row in ROWS if is_map(row)], label=lambda row: f"{row['case']}-{row['quantity']}")
def test_sampled_shapes(row):
    given_ = json.loads(row["parameters"])
    value = value_of(surface_of(row["case"], given_), row["quantity"], given_)
    # where the exact value is zero, rounding of the heights (1e-16) counts, over the square of the
    # pixel in curvatures
    floor = 1e-12 if row["sampled_value"] == 0.0 else 0.0
    assert value == pytest.approx(row["sampled_value"], rel=max(row["tol_rel"], 5e-12), abs=floor)


def test_uniform_heights():
    heights = r.height_parameters(asp.Surface(0.02 * np.arange(50.0)[:, None], 1.0))
    expected = {row["quantity"]: row["sampled_value"] for row in ROWS if row["case"] == "AN7"}
    assert heights.Sq == pytest.approx(expected["Sq"], rel=1e-10)
    assert heights.Sku == pytest.approx(expected["Sku"], rel=1e-10)


@pytest.mark.parametrize("line", ["least squares", "secant"])
def test_material_ratio_of_gaussian_heights(line):
    """Quantiles of the normal distribution at (k - 1/2)/N: the discrete curve errs by O(1/N) in the
    middle."""
    from scipy.special import ndtri

    n = 400_000
    curve = r.MaterialRatioCurve(ndtri(1.0 - (np.arange(n) + 0.5) / n))
    found = r.functional_parameters(curve, line)
    short = {"least squares": "lsq", "secant": "secant"}[line]
    for row in ROWS:
        given_ = json.loads(row["parameters"])
        if row["case"] != "AN9" or given_.get("core_line", short) != short or row["quantity"] == "Sa":
            continue
        value = getattr(found, row["quantity"]) * (100.0 if row["unit"] == "%" else 1.0)
        # the tails beyond 1/N hold 1/N of the area at four to five deviations
        assert value == pytest.approx(row["continuum_value"], rel=3e-4 if row["quantity"][0] == "V" else 1e-4)


def test_mean_absolute_height_of_gaussian_heights():
    from scipy.special import ndtri

    surface = asp.Surface(ndtri((np.arange(400_000) + 0.5) / 400_000).reshape(400, 1000), 1.0)
    (expected,) = (row["continuum_value"] for row in ROWS if row["case"] == "AN9" and row["quantity"] == "Sa")
    assert asp.roughness.mean_absolute_height(surface) == pytest.approx(
        expected * asp.roughness.rms_height(surface), rel=1e-5
    )


@every_row([row for row in ROWS if row["case"] == "AN10"], label=lambda row: row["parameters"])
def test_developed_area_of_gaussian_slopes(row):
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(1.0), hurst=0.8, rolloff_wavelength=64.0, shortest_wavelength=16.0
    )
    surface = asp.generate.gaussian(asp.Grid((1024, 1024), (1.0, 1.0)), spectrum, seed=9)
    scale = math.sqrt(json.loads(row["parameters"])["Sdq2"]) / asp.roughness.rms_slope(surface)
    scaled = asp.Surface(scale * surface.heights, 1.0, periodic=True)
    # some 4000 independent slopes leave the fourth moment uncertain by 2 %, which enters Sdr with a
    # quarter of Sdq²
    slope2 = json.loads(row["parameters"])["Sdq2"]
    assert r.developed_area_ratio(scaled) == pytest.approx(row["continuum_value"], rel=2e-3 + 0.02 * slope2)


@pytest.mark.parametrize("number", MAPS)
def test_summits_of_sums_of_waves(number):
    surface = summit_map(number)
    expected = {(int(row["i"]), int(row["j"])): row for row in reference("summit_map_summits") if row["map"] == number}
    four, eight = r.summits(surface, 4), r.summits(surface, 8)
    places = list(zip(four.i.tolist(), four.j.tolist(), strict=True))
    assert set(places) == set(expected)
    strict = {place for place, row in expected.items() if row["is_8_neighbour_summit"] == "True"}
    assert set(zip(eight.i.tolist(), eight.j.tolist(), strict=True)) == strict
    for n, place in enumerate(places):
        row = expected[place]
        assert four.height[n] == pytest.approx(row["z_m"], rel=1e-11)
        assert four.kappa_x[n] == pytest.approx(row["kappa_x_per_m"], rel=1e-11)
        assert four.kappa_y[n] == pytest.approx(row["kappa_y_per_m"], rel=1e-11)
        assert 1.0 / four.curvature[n] == pytest.approx(row["R_mean_m"], rel=1e-11)
        if row["R_geometric_m"] == row["R_geometric_m"]:
            assert 1.0 / four.geometric_curvature[n] == pytest.approx(row["R_geometric_m"], rel=1e-9)
        else:
            assert math.isnan(four.geometric_curvature[n])


def fits_the_grid(row: Row) -> bool:
    """Spectra are tested elsewhere; a decay of a hundred pixels leaves too few independent heights
    on 512² points."""
    return not row["model"].startswith("isotropic plateau") and json.loads(row["parameters"]) != {
        "delta_over_beta_e": 0.01
    }


@every_row(
    [row for row in reference("surfaces_summit_bias") if fits_the_grid(row)],
    label=lambda row: f"{row['model'][:12]}-{row['parameters']}",
)
def test_summits_of_sampled_gaussian_surfaces(row):
    given_ = json.loads(row["parameters"])
    grid, seeds = asp.Grid((512, 512), (1.0, 1.0)), range(3)
    if row["model"] == "white noise":
        surfaces = [
            asp.Surface(np.random.default_rng(s).standard_normal(grid.shape), 1.0, periodic=True) for s in seeds
        ]
    elif "delta_over_beta_e" in given_:
        spectrum = asp.generate.ExponentialAutocorrelation(1.0, 1.0 / given_["delta_over_beta_e"], drop=math.exp(-1.0))
        surfaces = [asp.generate.gaussian(grid, spectrum, seed=s) for s in seeds]
    else:
        spectrum = asp.generate.GaussianAutocorrelation(1.0, given_["b_over_delta"], drop=math.exp(-1.0))
        surfaces = [asp.generate.gaussian(grid, spectrum, seed=s) for s in seeds]
    found = [r.summit_statistics(r.summits(surface)) for surface in surfaces]
    four = [r.summit_statistics(r.summits(surface, 4)) for surface in surfaces]
    summits = sum(mean.count for mean in found)
    # positions repel or attract each other, heights and curvatures are correlated: three times the
    # error of independent summits, at five deviations; heights of long waves scatter more, by the
    # number of such waves
    error = 5.0 * 3.0 / math.sqrt(summits)
    assert np.mean([mean.density for mean in found]) == pytest.approx(row["p8_summits_per_node"], rel=error)
    assert np.mean([mean.density for mean in four]) == pytest.approx(row["p4_summits_per_node"], rel=error)
    assert np.mean([mean.mean_curvature for mean in found]) == pytest.approx(
        row["mean_curvature_x_delta2_over_sigma"], rel=error
    )
    decay = 1.0 / given_.get("delta_over_beta_e", 1.0 / given_.get("b_over_delta", 1.0))
    waves = 3.0 * grid.n_points / max(1.0, 0.5 * math.pi * decay**2)
    assert np.mean([mean.mean_height for mean in found]) == pytest.approx(
        row["mean_height_over_sigma"], rel=error, abs=5.0 / math.sqrt(waves)
    )


@given(
    wave=st.tuples(st.integers(1, 5), st.integers(-4, 4)),
    amplitude=st.floats(1e-9, 1e3),
    dx=st.floats(1e-9, 1e3),
    ratio=st.floats(0.2, 5.0),
)
def test_every_moment_of_a_wave(wave, amplitude, dx, ratio):
    i, j = np.arange(24)[:, None], np.arange(18)[None, :]
    dy = ratio * dx
    surface = asp.Surface(
        amplitude * np.cos(2.0 * np.pi * (wave[0] * i / 24 + wave[1] * j / 18) + 0.3), dx, dy, periodic=True
    )
    qx, qy = 2.0 * np.pi * wave[0] / (24 * dx), 2.0 * np.pi * wave[1] / (18 * dy)
    moments = r.spectral_moments(r.power_spectrum(surface))
    m0 = 0.5 * amplitude**2
    assert moments.m00 == pytest.approx(m0, rel=1e-10)
    assert moments.m20 == pytest.approx(m0 * qx**2, rel=1e-10)
    assert moments.m31 == pytest.approx(m0 * qx**3 * qy, rel=1e-10, abs=1e-12 * m0 * qx**4)
    assert moments.rms_laplacian == pytest.approx(math.sqrt(m0) * (qx**2 + qy**2), rel=1e-10)
    assert moments.slope_tensor.smallest == pytest.approx(0.0, abs=1e-10 * moments.slope_tensor.largest)
    direction = math.atan2(qy, qx)
    assert math.sin(moments.slope_tensor.direction - direction) == pytest.approx(0.0, abs=1e-7)
    slope = r.rms_profile_slope(surface, axis="x") ** 2
    assert slope == pytest.approx(4.0 * m0 * math.sin(0.5 * qx * dx) ** 2 / dx**2, rel=1e-10)
