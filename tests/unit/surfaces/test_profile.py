"""Line scans: data, reading, preparation, and what needs an area."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.core.errors import FileFormatError, InputError
from asperity.surfaces import (
    Instrument,
    Profile,
    channels,
    cropped,
    despiked,
    filled,
    filtered,
    levelled,
    periodised,
    resampled,
    strip,
    tapered,
    tip_limited,
)

X = 0.5e-6 * np.arange(400)
WAVE = 1e-7 * np.sin(2.0 * np.pi * X / 20e-6)


def scan(**more: object) -> Profile:
    return Profile(WAVE, 0.5e-6, **more)  # type: ignore[arg-type]


def test_a_profile_is_frozen_with_one_dimension() -> None:
    found = Profile([0.0, math.nan, 2e-9], 1e-6, mask=[True, False, False])
    assert found.n_points == 3
    assert found.n_missing == 2
    assert found.length == pytest.approx(3e-6, rel=1e-15)
    assert found.valid.tolist() == [2e-9]
    assert "3, 1 µm apart" in repr(found)
    assert not found.heights.flags.writeable


@pytest.mark.parametrize(
    ("heights", "more", "subject"),
    [
        (np.zeros((3, 2)), {}, "profile heights (m)"),
        ([math.nan, math.nan], {}, "profile heights"),
        ([0.0, math.inf], {}, "profile heights"),
        ([0.0, 1.0], {"mask": [True]}, "profile mask"),
        ([0.0, 1.0], {"lay_angle": 2.0}, "angle of a profile to the lay (rad)"),
        ([0.0, 1.0], {"short_cutoff": -1.0}, "short cut-off of a profile (m)"),
    ],
)
def test_what_is_no_profile_is_refused(heights: object, more: dict[str, object], subject: str) -> None:
    with refused(InputError, subject):
        Profile(heights, 1e-6, **more)  # type: ignore[arg-type]


def test_what_needs_an_area_refuses_with_what_to_do_instead() -> None:
    needing: tuple[Callable[[Profile], object], ...] = (
        asp.characterise,
        asp.roughness.power_spectrum,
        asp.roughness.summits,
        asp.roughness.rms_slope,
        asp.roughness.developed_area_ratio,
        asp.roughness.difference_moments,
        asp.surfaces.line_corrected,
        lambda profile: asp.surfaces.sliced(profile, y=0.0),  # type: ignore[arg-type]
        lambda profile: asp.ContactProblem(profile, asp.Elastic(1e9, 0.3)),  # type: ignore[arg-type]
        lambda profile: profile.grid,
        lambda profile: profile.size,
    )  # type: ignore[assignment]
    for need in needing:
        with refused(InputError, "surface", "asperity.surfaces.strip(profile)"):
            need(scan())


def test_rows_and_columns_of_a_map() -> None:
    heights = np.arange(12.0).reshape(4, 3)
    surface = asp.Surface(heights, 1e-6, 2e-6, periodic=True)
    np.testing.assert_array_equal(surface.row(1).heights, heights[:, 1])
    np.testing.assert_array_equal(surface.column(-1).heights, heights[3])
    assert (surface.row(0).spacing, surface.column(0).spacing) == (1e-6, 2e-6)
    assert surface.row(0).periodic
    with refused(InputError, "number of a row", "2", "3"):
        surface.row(3)
    with refused(InputError, "number of a column", "-5"):
        surface.column(-5)


def test_uneven_points_are_interpolated_to_the_median_spacing() -> None:
    x = np.array([0.0, 1.0, 2.0, 3.0, 7.0, 8.0]) * 1e-6
    found = Profile.from_points(x[::-1], (2.0 * x + 1e-9)[::-1])
    assert found.spacing == pytest.approx(1e-6, rel=1e-12)
    assert found.short_cutoff == pytest.approx(4e-6, rel=1e-12)
    np.testing.assert_allclose(found.heights, 2.0 * found.x + 1e-9, rtol=1e-12)
    even = Profile.from_points(1e-6 * np.arange(9) + 2e-8 * np.array([0, 1, -1, 0, 1, 0, -1, 1, 0]), np.zeros(9))
    assert even.short_cutoff == 0.0


def test_overhangs_and_double_points_are_refused() -> None:
    x = 1e-6 * np.arange(30.0)
    back = x.copy()
    back[10] = 8.5e-6
    with refused(InputError, "coordinates of a profile (m)", "1 of 29"):
        Profile.from_points(back, np.zeros(30))
    twice = x.copy()
    twice[3] = twice[2]
    with refused(InputError, "coordinates of a profile (m)", "2e-06"):
        Profile.from_points(twice, np.zeros(30))
    shuffled = np.random.default_rng(1).permutation(30)
    np.testing.assert_allclose(Profile.from_points(x[shuffled], x[shuffled]).heights, x, atol=1e-20)


def test_a_trace_at_an_angle_to_the_lay_shows_long_waves() -> None:
    found = scan(lay_angle=math.radians(60.0), short_cutoff=1e-6).across_lay()
    assert found.spacing == pytest.approx(0.25e-6, rel=1e-12)
    assert found.short_cutoff == pytest.approx(0.5e-6, rel=1e-12)
    assert found.lay_angle == 0.0
    assert found.across_lay() is found
    with refused(InputError, "profile"):
        scan().across_lay()


# Reading.


@pytest.mark.parametrize("name", ["a.txt", "a.csv", "a.dat"])
def test_two_columns_are_a_line_scan(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    np.savetxt(path, np.c_[X * 1e3, WAVE * 1e9], delimiter="," if name.endswith("csv") else " ")
    found = asp.read(path, lateral_unit="mm", height_unit="nm")
    assert isinstance(found, Profile)
    np.testing.assert_allclose(found.heights, WAVE, rtol=1e-12, atol=1e-22)
    assert found.spacing == pytest.approx(0.5e-6, rel=1e-9)
    assert channels(path)[0].shape == (400,)
    with refused(FileFormatError, f"line scan in file {path}", "400 points"):
        asp.read(path, size=(2e-6, 400e-6), height_unit="nm")
    wide = asp.read(path, size=(2e-6, 400e-6), height_unit="nm", axes="none")  # a map two points wide
    assert isinstance(wide, asp.Surface)
    assert wide.shape == (2, 400)
    with refused(FileFormatError, f"units of file {path}"):
        asp.read(path, height_unit="nm")


def test_a_stylus_file_states_units_and_tip(tmp_path: Path) -> None:
    path = tmp_path / "trace.csv"
    head = "Scan Parameters\nStylus,Radius: 12.5 um\nScan Data\n\nLateral um,Raw nm,\n"
    path.write_text(head + "".join(f"{x * 1e6:.4f},{z * 1e9:.6f},\n" for x, z in zip(X, WAVE, strict=True)))
    found = asp.read(path)
    assert isinstance(found, Profile)
    np.testing.assert_allclose(found.heights, WAVE, atol=1e-15)
    assert found.instrument.kind == "stylus"
    assert found.instrument.tip_radius == pytest.approx(12.5e-6, rel=1e-12)
    assert found.origin.citation_keys == ("Roettger2022",)
    assert [item.shape for item in channels(path)] == [(400,)]
    with refused(FileFormatError, f"units of file {path}", "µm"):
        asp.read(path, height_unit="nm", lateral_unit="um")


# Preparation keeps what is not of heights.


def test_steps_of_preparation_give_profiles() -> None:
    raw = Profile(WAVE + 0.01 * X, 0.5e-6, lay_angle=0.1, instrument=Instrument("stylus", 2e-6), short_cutoff=1e-6)
    steps: tuple[Callable[[Profile], Profile], ...] = (
        levelled,
        despiked,
        filled,
        tapered,
        periodised,
        lambda profile: cropped(profile, x=(10e-6, 60e-6)),
        lambda profile: resampled(profile, (200, 1)),
        lambda profile: filtered(profile, short=4e-6, long=80e-6),
        lambda profile: tip_limited(profile, 1e-6),
    )
    for step in steps:
        found = step(raw)
        assert isinstance(found, Profile)
        assert (found.lay_angle, found.instrument) == (0.1, raw.instrument)
        assert len(found.origin.history) >= len(raw.origin.history)
    assert filtered(raw, short=4e-6).short_cutoff == 4e-6
    assert cropped(raw, x=(10e-6, 60e-6)).n_points == 100
    assert levelled(Profile(0.1 * X, 0.5e-6)).heights == pytest.approx(0.0, abs=1e-17)


def test_missing_points_of_a_profile_are_bridged_by_a_line() -> None:
    heights = np.array([0.0, 1.0, math.nan, math.nan, 4.0, 5.0]) * 1e-9
    np.testing.assert_allclose(filled(Profile(heights, 1e-6)).heights, 1e-9 * np.arange(6.0), rtol=1e-12, atol=1e-24)


def test_an_arc_is_removed_whatever_its_tilt() -> None:
    radius, tilt = 5e-3, 0.2
    angle = np.linspace(-0.1, 0.1, 801)
    x, z = radius * np.sin(angle + tilt), radius * np.cos(angle + tilt)
    even = np.linspace(x[0], x[-1], 801)
    part = np.sqrt(radius**2 - even**2)
    found = levelled(Profile(part, even[1] - even[0]), "arc")
    assert np.abs(found.heights).max() < 1e-9 * np.ptp(z)  # the fit ends at 1e-14 of the residual's scale
    assert "5 mm" in found.origin.history[-1]
    flat = levelled(Profile(1e-3 * even, even[1] - even[0]), "arc")  # a line is an arc of no curvature
    assert np.abs(flat.heights).max() < 1e-9 * np.ptp(1e-3 * even)


def test_a_strip_has_the_length_of_the_grooves() -> None:
    found = strip(scan(periodic=True), 2.0)
    assert found.shape == (400, 1)
    assert found.size == pytest.approx((200e-6, 2.0))
    assert found.periodic
    assert "grooves without end" in found.origin.history[-1]


def test_small_and_flat_profiles_divide_by_nothing() -> None:
    for profile in (Profile(np.zeros(20), 1e-6), Profile([0.0, 1e-9, 0.0], 1e-6), Profile([1e-9], 1e-6)):
        asp.roughness.profile_parameters(profile, sections=1)
        levelled(profile, "mean")
