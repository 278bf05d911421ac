"""What is measured on a map with the mouse, against planes, steps and closed forms."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("nicegui", reason="the extra web is not installed")

import asperity as asp
from asperity.core.units import show as shown
from asperity.run.document import checked
from asperity.web import tasks
from asperity.web.measuring import (
    drawn_range,
    drawn_region,
    line_scan,
    outlines,
    place_of_mask,
    reading,
    section,
    simplified,
    with_region,
    without_region,
)

SHAPE, SPACING = (60, 40), (2e-7, 3e-7)
X = ((np.arange(60) + 0.5) * 2e-7)[:, None]
Y = ((np.arange(40) + 0.5) * 3e-7)[None, :]


@pytest.mark.parametrize(
    ("start", "end"),
    [((1e-6, 1e-6), (11e-6, 1e-6)), ((2e-6, 1e-6), (2e-6, 11e-6)), ((11e-6, 10e-6), (1e-6, 2e-6))],
    ids=["row", "column", "oblique, backwards"],
)
def test_height_difference_and_angle_on_an_inclined_plane(start: tuple[float, float], end: tuple[float, float]) -> None:
    """z = a x + b y: along a line from (x0, y0) to (x1, y1) the slope is (a Δx + b Δy) / length."""
    a, b = 0.3, -0.7
    plane = a * X + b * Y
    found = section(plane, SPACING, start, end)
    for given, stood, side in zip((*start, *end), (*found.start, *found.end), 2 * SPACING, strict=True):
        assert abs(given - stood) <= 0.5 * side * (1.0 + 1e-9)
    dx, dy = (found.end[k] - found.start[k] for k in (0, 1))
    assert found.length == pytest.approx(math.hypot(dx, dy), rel=1e-12)
    read = reading(found, 0.2 * found.length, 0.8 * found.length)
    slope = (a * dx + b * dy) / math.hypot(dx, dy)
    rounding = 16 * np.finfo(float).eps * 12e-6  # of four products of heights up to 12 µm
    assert read.dz == pytest.approx(slope * read.dx, abs=rounding)
    assert read.angle == pytest.approx(math.degrees(math.atan(slope)), abs=math.degrees(rounding / read.dx) * 2.0)
    assert read.Pq <= rounding
    assert read.Pt <= 4.0 * rounding
    back = reading(found, 0.8 * found.length, 0.2 * found.length)
    assert (back.dx, back.dz) == (-read.dx, -read.dz)


def test_along_rows_and_columns_the_heights_are_those_of_the_map() -> None:
    heights = np.random.default_rng(0).standard_normal(SHAPE)
    row = section(heights, SPACING, (0.0, 5e-6), (12e-6, 5e-6))
    np.testing.assert_array_equal(row.heights, heights[:, 16])
    np.testing.assert_allclose(row.distance, np.arange(60) * 2e-7, rtol=1e-12)
    column = section(heights, SPACING, (3e-6, 12e-6), (3e-6, 0.0))
    np.testing.assert_array_equal(column.heights, heights[15, ::-1])
    diagonal = section(heights[:40], SPACING, (0.0, 0.0), (8e-6, 12e-6))
    np.testing.assert_array_equal(diagonal.heights, np.diagonal(heights[:40]))


def test_missing_points_are_gaps_and_do_not_spread_along_a_row() -> None:
    heights = np.ones(SHAPE)
    heights[20:25, 16] = np.nan
    row = section(heights, SPACING, (0.0, 5e-6), (12e-6, 5e-6))
    np.testing.assert_array_equal(np.isnan(row.heights), np.isnan(heights[:, 16]))
    beside = section(heights, SPACING, (0.0, 5.3e-6), (12e-6, 5.3e-6))
    assert np.isfinite(beside.heights).all()
    oblique = section(heights, SPACING, (0.0, 4.2e-6), (12e-6, 5.8e-6))
    (gap,) = np.nonzero(np.isnan(oblique.heights))
    assert gap.size > 0
    assert set(gap) <= set(range(19, 26))  # where a missing point is one of the four around
    inside = reading(row, 21 * 2e-7, 23 * 2e-7)
    assert math.isnan(inside.dz)
    assert math.isnan(inside.Pq)
    assert ("Δz", "–") in inside.words()


def test_roughness_between_the_cursors_is_that_of_whole_waves() -> None:
    """A sine of amplitude A over n whole periods: Pq = A/√2, Pa = 2A/π, Pt = 2A, but for its
    straight line of least squares, which reaches 3A/(π n) and takes 6/(π n)² of the variance."""
    amplitude, periods, points = 5e-9, 40, 8000
    wave = amplitude * np.sin(2.0 * np.pi * periods * np.arange(points) / points)
    read = reading(line_scan(wave, 1e-8), 0.0, points * 1e-8)
    line = 3.0 * amplitude / (math.pi * periods)
    assert read.Pq == pytest.approx(amplitude / math.sqrt(2.0), rel=6.0 / (math.pi * periods) ** 2)
    assert read.Pa == pytest.approx(2.0 * amplitude / math.pi, abs=0.5 * line)
    assert read.Pt == pytest.approx(2.0 * amplitude, abs=2.0 * line)
    names = [name for name, _ in read.words()]
    assert names == ["Δx", "Δz", "angle", "height at A", "height at B", "Pa", "Pq", "Pt, peak to valley"]


def test_the_table_of_a_profile() -> None:
    heights = np.random.default_rng(1).standard_normal(SHAPE)
    found = section(heights, SPACING, (0.0, 0.0), (12e-6, 9e-6))
    first, *rest = found.csv().splitlines()
    assert first == "distance (m),x (m),y (m),height (m)"
    read = np.array([[float(value) for value in line.split(",")] for line in rest])
    np.testing.assert_allclose(read[:, 0], found.distance, rtol=1e-11, atol=1e-22)
    np.testing.assert_allclose(read[:, 3], found.heights, rtol=1e-11)
    np.testing.assert_allclose(read[-1, 1:3], found.end, rtol=1e-11)


# Regions.


def area_of(region: Any) -> float:
    flat = asp.Surface(np.zeros((200, 200)), 5e-8)
    table = {"kind": "flat", "points": [200, 200], "size": "10 um x 10 um"}
    masked = table | {"prepare": [{"step": "mask", "regions": [region]}]}
    rest = {"version": 2, "body": {"material": "DLC"}, "control": {"mean_pressure": "1 MPa"}}
    (step,) = checked({"surface": masked, **rest}).surface.prepare
    (made,) = step.regions
    return float(made.makes(**made.given("kind")).covers(flat.grid).sum()) * 5e-8**2


@pytest.mark.parametrize(
    ("kind", "points", "area", "perimeter"),
    [
        ("rectangle", [[7e-6, 8e-6], [2e-6, 1e-6]], 35e-12, 24e-6),
        (
            "ellipse",
            [[1e-6, 2e-6], [9e-6, 6e-6]],
            math.pi * 8e-12,
            2.0 * math.pi * math.hypot(4e-6, 2e-6) / math.sqrt(2.0),
        ),
        ("polygon", [[1e-6, 1e-6], [9e-6, 1e-6], [5e-6, 7e-6]], 24e-12, 8e-6 + 2.0 * math.hypot(4e-6, 6e-6)),
    ],
)
def test_what_is_drawn_is_what_is_masked(kind: str, points: list[list[float]], area: float, perimeter: float) -> None:
    region = drawn_region(kind, points, (10e-6, 10e-6), 5e-8)
    ring = perimeter * math.hypot(5e-8, 5e-8)  # of the pixels that the border can cross
    assert abs(area_of(region) - area) <= ring
    (outline,) = outlines([{"step": "mask", "regions": [region]}], 1, (10e-6, 10e-6))
    x, y = np.array(outline["points"]).T
    enclosed = 0.5 * abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
    in_ellipse = 2.0 * math.pi**2 / (3.0 * 72**2)  # a polygon of 72 corners
    assert enclosed == pytest.approx(area, rel=in_ellipse)


def test_what_has_no_area_is_no_region() -> None:
    assert drawn_region("rectangle", [[1e-6, 1e-6], [1e-6, 5e-6]], (1e-5, 1e-5), 1e-8) is None
    assert drawn_region("polygon", [[1e-6, 1e-6], [2e-6, 2e-6], [3e-6, 3e-6]], (1e-5, 1e-5), 1e-8) is None
    assert drawn_region("ellipse", [[2e-5, 2e-5], [3e-5, 3e-5]], (1e-5, 1e-5), 1e-8) is None
    assert drawn_range(2e-6, 2e-6, 1e-5) is None
    assert drawn_range(2e-5, 2e-6, 1e-5) == {"kind": "rectangle", "x": ["2 um", "10 um"]}


def test_free_hand_lines_keep_their_shape_with_fewer_corners() -> None:
    turn = np.linspace(0.0, 2.0 * np.pi, 2001)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])
    few = simplified(circle, 0.01)
    assert 10 < len(few) < 60
    assert np.hypot(*few.T) == pytest.approx(1.0)
    chords = np.hypot(*np.diff(few, axis=0).T)
    assert (1.0 - np.sqrt(1.0 - 0.25 * chords**2)).max() <= 0.01  # their heights over the chords


def test_a_mask_comes_before_levelling_and_after_the_crop() -> None:
    box = {"kind": "rectangle", "x": ["1 um", "2 um"]}
    steps = [{"step": "level"}, {"step": "fill"}]
    assert [step["step"] for step in with_region(steps, box, 2)] == ["mask", "level", "fill"]
    cropped = [{"step": "crop", "x": ["0 um", "5 um"]}, *steps]
    once = with_region(cropped, box, 3)
    assert [step["step"] for step in once] == ["crop", "mask", "level", "fill"]
    assert place_of_mask(once, 4) == (1, True)
    twice = with_region(once, box, 4)
    assert len(twice[1]["regions"]) == 2
    before = with_region(twice, box, 0)  # on the surface before the crop
    assert [step["step"] for step in before] == ["mask", "crop", "mask", "level", "fill"]
    assert len(outlines(before, 5, (1e-5, 1e-5))) == 2
    assert len(outlines(before, 0, (1e-5, 1e-5))) == 1
    assert without_region(without_region(twice, 1, 0), 1, 0) == cropped
    assert outlines([{"step": "mask", "regions": [{"kind": "ellipse", "centre": "1 um"}, {}, 3]}], 1, (1.0, 1.0)) == []


# A step: before, after, and what it removes.


def preview(folder: Path, **more: Any) -> dict[str, Any]:
    made = {
        "kind": "rough",
        "points": [64, 48],
        "size": "6.4 um x 4.8 um",
        "spectrum": {
            "kind": "self_affine",
            "rms_height": "5 nm",
            "hurst": 0.8,
            "rolloff_wavelength": "3 um",
            "shortest_wavelength": "0.3 um",
        },
        "seed": 1,
        "prepare": more.pop("prepare"),
    }
    return tasks.surface({"table": made, "folder": str(folder), "out": str(folder / "a.bin"), **more})


FILTER = [{"step": "level", "form": "plane"}, {"step": "filter", "short": "0.8 um", "long": "4 um"}]


def test_the_difference_is_before_less_after_exactly(tmp_path: Path) -> None:
    held = {}
    for show in ("before", "after", "removed"):
        found = preview(tmp_path, prepare=FILTER, steps=2, since=1, show=show)
        held[show] = np.load(tmp_path / "a.npy")
        assert found["cutoffs"] == {"short": 0.8e-6, "long": 4e-6}
        assert found["missing"] == 0
    np.testing.assert_array_equal(held["removed"], held["before"] - held["after"])
    deviation = held["removed"] - held["removed"].mean()
    rms = shown(float(np.sqrt(np.mean(deviation**2))), "m", 4)
    assert f"rms {rms}" in found["words"]
    wrong = [FILTER[0], {"step": "filter", "short": "1 nm"}]
    assert "error" in preview(tmp_path, prepare=wrong, steps=2, since=1, show="after")
    assert "error" not in preview(tmp_path, prepare=wrong, steps=2, since=1, show="before")
    np.testing.assert_array_equal(np.load(tmp_path / "a.npy"), held["before"])
    first = preview(tmp_path, prepare=FILTER, steps=1, since=0, show="after")
    assert first["Sq"] > 0.0
    np.testing.assert_array_equal(np.load(tmp_path / "a.npy"), held["before"])
    whole = preview(tmp_path, prepare=FILTER, steps=None)
    np.testing.assert_array_equal(np.load(tmp_path / "a.npy"), held["after"])
    assert "words" not in whole


def test_steps_that_move_or_take_points_say_so(tmp_path: Path) -> None:
    crop = [{"step": "crop", "x": ["1 um", "4 um"]}]
    assert "30 × 48" in preview(tmp_path, prepare=crop, steps=1, since=0, show="removed")["nothing"]
    assert preview(tmp_path, prepare=crop, steps=1, since=0, show="before")["full"] == [64, 48]
    mask = [{"step": "mask", "regions": [{"kind": "rectangle", "x": ["1 um", "2 um"]}]}, {"step": "fill"}]
    found = preview(tmp_path, prepare=mask, steps=1, since=0, show="after")
    assert found["missing"] == 480
    assert "480 points become missing" in found["words"]
    assert "480 missing points are filled" in preview(tmp_path, prepare=mask, steps=2, since=1, show="after")["words"]


def test_a_thinned_map_keeps_all_its_heights(tmp_path: Path) -> None:
    table = {"kind": "sphere", "points": [1200, 600], "size": "12 um x 6 um", "radius": "20 um"}
    found = tasks.surface({"table": table, "folder": str(tmp_path), "out": str(tmp_path / "a.bin")})
    assert (found["shape"], found["step"]) == ([400, 200], 3)
    assert np.load(tmp_path / "a.npy", mmap_mode="r").shape == (1200, 600)
    assert found["pixel"] == pytest.approx([1e-8, 1e-8])
