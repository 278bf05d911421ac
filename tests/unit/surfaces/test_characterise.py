"""Heights and slopes against the reference maps, and their invariances."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reference_data import FOLDER, every_row, reference
from refusals import refused

from asperity.core.errors import InputError
from asperity.surfaces.characterise import heights as hp
from asperity.surfaces.characterise import slopes as sl
from asperity.surfaces.prepare.level import levelled
from asperity.surfaces.surface import Surface

MAPS = dict(np.load(FOLDER / "surfaces_maps.npz"))
ROWS = reference("surfaces_map_heights_slopes")
FORMS = {"mean": "mean", "poly1": "plane", "poly2": "quadratic"}
MEASURES = {
    "Sa": hp.mean_absolute_height,
    "Sq": hp.rms_height,
    "Sp": hp.highest_peak,
    "Sv": hp.deepest_valley,
    "Sz": hp.peak_to_valley,
    "Ssk": hp.skewness,
    "Sku": hp.kurtosis,
    "Sdq_pairs": sl.rms_slope,
    "m2x_fd": lambda surface: sl.rms_profile_slope(surface, axis="x") ** 2,
    "m2y_fd": lambda surface: sl.rms_profile_slope(surface, axis="y") ** 2,
}


def reference_map(name):
    dx, dy = MAPS[f"{name}_spacing"]
    return Surface(MAPS[name], dx, dy, periodic=bool(MAPS[f"{name}_periodic"]))


@every_row(
    [row for row in ROWS if row["quantity"] in MEASURES],
    label=lambda row: f"{row['map']}-{row['prep']}-{row['quantity']}",
)
def test_reference_maps(row):
    surface = levelled(reference_map(row["map"]), FORMS[row["prep"]])
    value, expected = MEASURES[row["quantity"]](surface), row["value"]
    # odd moments may vanish by cancellation, hence a floor at rounding
    assert value == pytest.approx(expected, rel=row["tol_rel"], abs=1e-14)


@settings(max_examples=25, deadline=None)
@given(
    scale=st.floats(-5.0, 5.0).filter(lambda a: abs(a) > 1e-2),
    offset=st.floats(-100.0, 100.0),
    stretch=st.floats(0.1, 10.0),
)
def test_scaling_rules(scale, offset, stretch):
    base = reference_map("N1m")
    other = Surface(scale * base.heights + offset, stretch * base.dx, stretch * base.dy)
    digits = 1e-10  # an offset of 100 costs 4 digits of heights of 0.1
    assert hp.rms_height(other) == pytest.approx(abs(scale) * hp.rms_height(base), rel=digits)
    assert sl.rms_slope(other) == pytest.approx(abs(scale) / stretch * sl.rms_slope(base), rel=1e-8)
    assert hp.skewness(other) == pytest.approx(np.sign(scale) * hp.skewness(base), rel=1e-8)
    assert hp.kurtosis(other) >= 1.0 + hp.skewness(other) ** 2


def test_transposing_exchanges_the_axes():
    base = reference_map("N1m")
    turned = Surface(base.heights.T, base.dy, base.dx)
    assert sl.rms_profile_slope(turned, axis="x") == pytest.approx(sl.rms_profile_slope(base, axis="y"), rel=1e-13)
    assert sl.rms_slope(turned) == pytest.approx(sl.rms_slope(base), rel=1e-13)


def test_slope_of_a_plane_is_exact_and_a_missing_point_does_not_matter():
    x, y = np.arange(8)[:, None] * 0.5, np.arange(6)[None, :] * 2.0
    heights = 0.3 * x - 0.4 * y
    heights[3, 2] = np.nan
    assert sl.rms_slope(Surface(heights, 0.5, 2.0)) == pytest.approx(0.5, rel=1e-14)


def test_periodic_slope_wraps():
    heights = np.zeros((4, 4))
    heights[-1] = 1.0
    assert sl.rms_profile_slope(Surface(heights, 1.0)) == pytest.approx(np.sqrt(1 / 3))
    assert sl.rms_profile_slope(Surface(heights, 1.0, periodic=True)) == pytest.approx(np.sqrt(2 / 4))


def test_refusals():
    flat = Surface(np.zeros((3, 3)), 1.0)
    with refused(InputError, "surface"):
        hp.skewness(flat)
    with refused(InputError, "surface"):
        hp.kurtosis(flat)
    with refused(InputError, "axis of the profiles"):
        sl.rms_profile_slope(flat, axis="z")
    with refused(InputError, "surface"):
        sl.rms_slope(Surface([[1.0, np.nan], [np.nan, 2.0]], 1.0))
