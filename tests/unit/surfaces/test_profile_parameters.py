"""Parameters of profiles against independent routes, closed shapes and laws."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from reference_data import FOLDER, Row, every_row, reference

from asperity.surfaces import Profile, filtered, levelled
from asperity.surfaces.profile_parameters import (
    ProfileParameters,
    SectionParameters,
    band_crossings,
    profile_elements,
    profile_parameters,
    section_parameters,
    valley_suppressed,
)
from asperity.surfaces.profile_settings import ProfileComponents, components

INDEX = {str(row["profile"]): row for row in reference("profiles/profile_index")}
NAMES = {"Sm_up": "sm", "Sm_down": "sm_down", "n_elements": "n"}
CORE = {"k", "pk", "vk", "mrk1", "mrk2"}


def trace(name: str) -> Profile:
    with np.load(FOLDER / "profiles" / "profiles.npz") as stored:
        counts = stored[name]
    row = INDEX[name]
    return Profile(counts * float(row["height_unit_m"]), float(row["spacing_m"]))


def separated(name: str) -> ProfileComponents:
    row = INDEX[name]
    short, long = float(row["lambda_s_m"]), float(row["lambda_c_m"])
    return components(trace(name), long=long, short=short, sections=int(row["sections"]))


@cache
def measured(name: str) -> tuple[dict[str, ProfileParameters], SectionParameters]:
    found = separated(name)
    parts = {"R": (found.roughness, found.sections), "P": (found.primary, 1), "W": (found.waviness, 1)}
    by_letter = {letter: profile_parameters(part, letter, sections=n) for letter, (part, n) in parts.items()}
    return by_letter, section_parameters(found.roughness, sections=found.sections)


@every_row(reference("profiles/profile_params"), lambda row: f"{row['profile']} {row['parameter']}")
def test_parameters_of_four_traces(row: Row) -> None:
    by_letter, sections = measured(str(row["profile"]))
    name, expected = str(row["parameter"]), float(row["value"])
    letter, tail = name[0], name[1:]
    found = by_letter[letter]
    if tail.endswith("_4287"):
        value = getattr(sections, name.removesuffix("_4287"))
    elif tail.startswith("mr_"):
        value = 100.0 * found.mr(float(tail[3:-1]) * found.q)
    else:
        value = getattr(found, NAMES.get(tail, tail)) * (100.0 if tail.startswith("mrk") else 1.0)
    printed = 0.5 * 10.0 ** (math.floor(math.log10(abs(expected))) - 7) / abs(expected) if expected else 0.0
    assert value == pytest.approx(expected, rel=1e-4 if tail in CORE else 1e-8 + printed)  # eight digits are printed


def shape(name: str, points: int = 100_000, waves: int = 10) -> Profile:
    """Unit amplitude, wavelength 1, mean removed."""
    phase = (np.arange(points) * waves / points + 0.5 * waves / points) % 1.0
    kinds = {
        "sine": np.sin(2.0 * np.pi * phase),
        "triangle": 1.0 - 4.0 * np.abs(phase - 0.5),
        "sawtooth": 2.0 * phase - 1.0,
        "rectangle duty 0.25": np.where(phase < 0.25, 1.0, -1.0),
        "turned cusps (parabola z=8(x-1/2)^2-1)": 8.0 * (phase - 0.5) ** 2,
    }
    z = kinds[name]
    return Profile(z - z.mean(), waves / points, periodic=True)


@every_row(reference("profiles/analytic_profiles"), lambda row: f"{row['profile']} {row['parameter']}")
def test_closed_shapes(row: Row) -> None:
    found = profile_parameters(shape(str(row["profile"])), "R", sections=10)
    name = str(row["parameter"])
    value = 100.0 * found.mr(0.5 * found.q) if name == "Rmr(0.5Rq)" else getattr(found, name[1:])
    assert value == pytest.approx(
        float(row["value"]), rel=2e-4, abs=2e-4
    )  # 10 000 points a wave; corners are cut by 1e-4


def test_the_core_of_sines_and_triangles_is_not_unique() -> None:
    flags = {name: profile_parameters(shape(name), "R").core_window_not_unique for name in ("sine", "triangle")}
    assert flags == {"sine": True, "triangle": True}
    normal = Profile(np.random.default_rng(1).standard_normal(20_000), 1.0)
    assert not profile_parameters(normal, "R").core_window_not_unique


@pytest.mark.parametrize("name", sorted(INDEX))
def test_reversal_and_sign(name: str) -> None:
    """All but RSm are the same backwards; peaks and valleys change places upside down."""
    rough = separated(name).roughness
    there = profile_parameters(rough, "R")
    back = profile_parameters(rough.with_heights(rough.heights[::-1], "reversed"), "R")
    down = profile_parameters(rough.with_heights(-rough.heights, "turned over"), "R")
    for field in ("a", "q", "sk", "ku", "p", "v", "z", "zx", "t", "dq", "k", "pk", "vk"):
        assert getattr(back, field) == pytest.approx(getattr(there, field), rel=1e-10)
    assert back.sm == pytest.approx(there.sm, rel=0.03)
    for field, other, sign in (("p", "v", 1.0), ("pt", "vt", 1.0), ("sk", "sk", -1.0), ("pk", "vk", 1.0)):
        assert getattr(down, field) == pytest.approx(sign * getattr(there, other), rel=1e-6)


@pytest.mark.parametrize("name", sorted(INDEX))
def test_order_of_the_parameters(name: str) -> None:
    by_letter, sections = measured(name)
    found = by_letter["R"]
    assert found.t >= found.zx >= found.z
    assert sections.Ra == pytest.approx(found.a, rel=1e-12)  # the same number by both standards
    assert sections.Rq <= found.q * (1.0 + 1e-12)


def test_elements_join_what_is_not_significant() -> None:
    z = np.array([1.0, 1.0, -1.0, -1.0, 0.05, -1.0, 1.0, 1.0, -1.0, 1.0])
    found = profile_elements(z, 1.0, least_height=0.1, least_width=0.1)
    np.testing.assert_allclose(found.upward, [5.5, 8.5])
    np.testing.assert_allclose(found.downward, [1.5, 7.5])
    assert found.count == 1
    assert found.mean_width == 3.0
    assert found.heights.tolist() == [2.0]
    none = profile_elements(np.zeros(5), 1.0, least_height=0.1, least_width=0.1)
    assert math.isnan(none.mean_width)


def test_peak_counts_by_a_band() -> None:
    sine = shape("sine", 1000, 10)
    assert band_crossings(sine, 0.5) == 9  # the first rise follows no fall
    assert band_crossings(sine, 2.0) == 0


def test_the_valley_suppressing_filter_lifts_the_mean_line_less() -> None:
    """Deep grooves pull the Gaussian mean line down beneath the plateaus; ISO 13565-1 leaves most
    of that out."""
    found = separated("honed")
    whole = filtered(levelled(trace("honed")), short=found.short)
    stratified = valley_suppressed(whole, found)
    assert stratified.n_points == found.roughness.n_points
    plain, cut = float(np.median(found.roughness.heights)), float(np.median(stratified.heights))
    assert abs(cut) < abs(plain)
    again = section_parameters(found.roughness, stratified=stratified)
    assert again.Rvk > 0.0
    assert 0.0 < again.Mr1 < again.Mr2 < 1.0


def test_sections_without_points_are_left_out() -> None:
    heights = np.random.default_rng(2).standard_normal(1000)
    heights[:200] = np.nan
    found = profile_parameters(Profile(heights, 1.0), "R", sections=5)
    assert found.z == pytest.approx(np.mean([np.ptp(heights[k : k + 200]) for k in (200, 400, 600, 800)]))
