"""Every applicable row of the reference statistics and series of the six maps, computed by direct
sums over nodes."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from reference_data import FOLDER, Row, every_row, reference

from asperity.surfaces.characterise import correlation as autocorrelation
from asperity.surfaces.characterise import correlation as structure
from asperity.surfaces.characterise import heights, moments, slopes, spectrum
from asperity.surfaces.characterise.heights import mean_height, rms_height
from asperity.surfaces.characterise.summits import summit_statistics, summits
from asperity.surfaces.characterise.texture import texture_lengths
from asperity.surfaces.prepare.level import levelled
from asperity.surfaces.surface import Surface

MAPS = dict(np.load(FOLDER / "surfaces_maps.npz"))
FORMS = {"mean": "mean", "poly1": "plane", "poly2": "quadratic"}
PRINTED = 5e-12  # the references are printed with twelve digits
STATISTICS = reference("surfaces_map_statistics")
NOT_OURS = ("m4x_fd_cell", "m4y_fd_cell", "rms_gradient_central", "Sdr_diag1", "Sdr_diag2")
"""Variants by other difference schemes, which this package does not offer."""


@cache
def prepared(name: str, prep: str) -> Surface:
    dx, dy = MAPS[f"{name}_spacing"]
    surface = Surface(MAPS[name], dx, dy, periodic=bool(MAPS[f"{name}_periodic"]))
    return levelled(surface, FORMS[prep])


@cache
def covariance(name: str, prep: str) -> autocorrelation.Autocovariance:
    return autocorrelation.autocovariance(prepared(name, prep))


def height(surface: Surface, quantity: str, row: Row) -> float:
    n = surface.grid.n_points - surface.n_missing
    raw = Surface(MAPS[row["map"]], 1.0)
    return {"mean": mean_height(raw), "m0_nm1": rms_height(surface) ** 2 * n / (n - 1)}[quantity]


def differences(surface: Surface, quantity: str, row: Row) -> float:
    found = moments.difference_moments(surface)
    return {
        "m2x_fd": found.m2_x,
        "m2y_fd": found.m2_y,
        "m4x_fd": found.m4_x,
        "m4y_fd": found.m4_y,
        "Sdq_pairs": slopes.rms_slope(surface),
        "rms_gradient_fwd_cell": math.sqrt(found.slope_tensor.xx + found.slope_tensor.yy),
        "m2x_fd_cell": found.slope_tensor.xx,
        "m2y_fd_cell": found.slope_tensor.yy,
        "m11_fd_cell": found.slope_tensor.xy,
        "rms_laplacian_fd": found.rms_laplacian,
        "rms_mean_curvature_fd": 0.5 * found.rms_laplacian,
        "alpha_x_fd": found.alpha_x,
        "alpha_y_fd": found.alpha_y,
    }[quantity]


def hybrid(surface: Surface, quantity: str, row: Row) -> float:
    return {"Sdr_iso": slopes.developed_area_ratio(surface)}[quantity]


def summit(surface: Surface, quantity: str, row: Row) -> float:
    found = summits(surface, int(quantity[3]))
    mean = summit_statistics(found)
    return {
        "count": mean.count,
        "candidates": found.candidates,
        "density": mean.density,
        "mean_height": mean.mean_height,
        "std_height": mean.height_deviation,
        "mean_curvature": mean.mean_curvature,
        "radius_of_mean_curv": mean.radius,
        "mean_radius": mean.mean_radius,
        "n_k2_nonpositive": mean.saddles,
        "mean_gauss_curvature_sqrt": mean.mean_geometric_curvature,
    }[quantity[5:]]


def abbott(surface: Surface, quantity: str, row: Row) -> float:
    curve = heights.material_ratio_curve(surface)
    if quantity.startswith("Smc_"):
        return float(curve.height(float(quantity[4:]) / 100.0))
    if quantity.startswith("Smr_at_c="):
        return float(curve.ratio(float(quantity[9:])))
    if quantity == "secant_start_pct":
        return 100.0 * heights.core(curve).start
    name, _, line = quantity.partition("_secant") if quantity.endswith("_secant") else (quantity, "", None)
    if name == "Sdc_10_80" or row["map"] == "T1":  # too few points for a core
        return {
            "Sdc_10_80": lambda: curve.height_difference(0.1, 0.8),
            "Sxp": lambda: curve.height_difference(0.025, 0.5),
            "Vmp": lambda: curve.material_volume(0.1),
            "Vmc": lambda: curve.material_volume(0.8) - curve.material_volume(0.1),
            "Vvc": lambda: curve.void_volume(0.1) - curve.void_volume(0.8),
            "Vvv": lambda: curve.void_volume(0.8),
        }[name]()
    found = heights.functional_parameters(curve, "least squares" if line is None else "secant")
    return getattr(found, name) * (100.0 if row["unit"] == "%" else 1.0)


def acf(surface: Surface, quantity: str, row: Row) -> float:
    found = covariance(row["map"], row["prep"])
    if quantity.startswith("beta"):
        _, axis, drop = quantity.split("_")
        drops = {"1e": autocorrelation.DROP_1E, "01": autocorrelation.DROP_TENTH, "02": autocorrelation.DROP_ISO}
        return found.correlation_length(drops[drop], axis=axis)
    return getattr(texture_lengths(found), quantity)


def spectral(surface: Surface, quantity: str, row: Row) -> float:
    found = moments.spectral_moments(spectrum.power_spectrum(surface))
    tensor = found.slope_tensor
    named = {
        "rms_gradient_spec": found.rms_gradient,
        "rms_laplacian_spec": found.rms_laplacian,
        "m2_max": tensor.largest,
        "m2_min": tensor.smallest,
        "m2_max_dir_deg": math.degrees(tensor.direction),
    }
    return named[quantity] if quantity in named else getattr(found, quantity.removesuffix("_spec"))


GROUPS = {
    "height": height,
    "fd": differences,
    "hybrid": hybrid,
    "summits": summit,
    "abbott": abbott,
    "acf": acf,
    "spectral": spectral,
}


@every_row(
    [row for row in STATISTICS if row["quantity"] not in NOT_OURS],
    label=lambda row: f"{row['map']}-{row['prep']}-{row['quantity']}",
)
def test_statistics(row):
    value = GROUPS[row["group"]](prepared(row["map"], row["prep"]), row["quantity"], row)
    # the mean of a levelled map and odd moments may vanish by cancellation, hence a floor at
    # rounding
    assert value == pytest.approx(row["value"], rel=max(row["tol_rel"], PRINTED), abs=1e-13)


def test_texture_that_does_not_decay_has_no_aspect_ratio():
    maps = {(row["map"], row["prep"]) for row in STATISTICS if row["quantity"] == "Sal"}
    with_ratio = {(row["map"], row["prep"]) for row in STATISTICS if row["quantity"] == "Str"}
    assert maps - with_ratio
    for name, prep in maps - with_ratio:
        assert math.isnan(texture_lengths(covariance(name, prep)).Str)


def series_value(row: Row) -> tuple[float, float]:
    """Value, and the size that its rounding error is measured against."""
    surface, kind = prepared(row["map"], row["prep"]), row["kind"]
    lag = {"x": (int(row["a"]), 0), "y": (0, int(row["a"])), "xy": (int(row["a"]), int(row["b"]))}
    if kind.startswith("acf"):
        found = covariance(row["map"], row["prep"])
        return found.at(lag[kind[4:]]), found.mean_square
    if kind.startswith("struct"):
        return structure.mean_square_increment(surface, lag[kind[7:]]), 0.0
    if kind.startswith("sdrp2"):
        found = structure.scale_dependence(surface, axis=kind[-1], steps=[int(row["a"])])
        assert found.curvature_length[0] == pytest.approx(row["b"])
        return float(found.curvature[0]), 0.0
    if kind.startswith("C1D"):
        window = {"rect": "none", "hann": "hann"}.get(kind[6:], "auto")
        found = spectrum.profile_spectrum(surface, axis=kind[4], window=window)
        assert found.q[int(row["a"]) - 1] == pytest.approx(row["b"])
        return float(found.psd[int(row["a"]) - 1]), float(found.psd.max())
    found = spectrum.power_spectrum(surface)
    if kind == "C2D_sum_over_area":
        return found.mean_square, 0.0
    if kind == "C2D":
        k, moved = (int(row["a"]), int(row["b"])) if row["b"] >= 0 else (-int(row["a"]), -int(row["b"]))
        return float(found.psd[k, moved]), float(found.psd.max())
    rings = spectrum.radial_spectrum(found, np.array([row["a"], row["b"]]))
    assert rings.modes.tolist() == [row["n"]]
    return float(rings.psd[0]), float(found.psd.max())


@every_row(
    [row for row in reference("surfaces_map_series") if not (row["kind"].startswith("C1D") and row["a"] == 0)],
    label=lambda row: f"{row['map']}-{row['prep']}-{row['kind']}-{row['a']}-{row['b']}",
)
def test_series(row):
    value, size = series_value(row)
    assert value == pytest.approx(row["value"], rel=PRINTED, abs=PRINTED * size)
