"""Masks: their areas against closed forms, what they keep, and what they refuse."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.core.grid import Grid
from asperity.surfaces.prepare.regions import Ellipse, Polygon, Rectangle, masked

GRID = Grid((120, 100), (1e-7, 1.5e-7))
WHOLE = GRID.size[0] * GRID.size[1]


def area(region: Any) -> float:
    """Area in m² of the pixels inside ``region``."""
    return float(np.count_nonzero(region.covers(GRID))) * GRID.spacing[0] * GRID.spacing[1]


def ring(perimeter: float) -> float:
    """Area in m² of the pixels that a line of this length can cross: those whose middle is within
    half a diagonal of it, and of its two ends."""
    diagonal = math.hypot(*GRID.spacing)
    return perimeter * diagonal + 0.25 * math.pi * diagonal**2


@settings(max_examples=30)
@given(
    x=st.tuples(st.floats(0.0, 5.5e-6), st.floats(6e-6, 12e-6)),
    y=st.tuples(st.floats(0.0, 7.0e-6), st.floats(8e-6, 15e-6)),
)
def test_a_rectangle_has_its_area_to_a_ring_of_pixels(x: tuple[float, float], y: tuple[float, float]) -> None:
    x, y = (round(x[0], 12), round(x[1], 12)), (round(y[0], 12), round(y[1], 12))  # lengths below 1e-41 m are refused
    a, b = x[1] - x[0], y[1] - y[0]
    assert abs(area(Rectangle(x=x, y=y)) - a * b) <= ring(2.0 * (a + b))
    corners = Polygon(x=(x[0], x[1], x[1], x[0]), y=(y[0], y[0], y[1], y[1]))
    assert abs(area(corners) - a * b) <= ring(2.0 * (a + b))
    assert area(Rectangle(x=x)) == pytest.approx(area(Rectangle(x=x, y=(0.0, 15e-6))))


@settings(max_examples=30)
@given(a=st.floats(5e-7, 3e-6), b=st.floats(5e-7, 3e-6), angle=st.floats(0.0, 3.2))
def test_an_ellipse_has_its_area_to_a_ring_of_pixels(a: float, b: float, angle: float) -> None:
    region = Ellipse(centre=(5e-6, 7e-6), radii=(a, b), angle=angle)
    perimeter = 2.0 * math.pi * math.hypot(a, b) / math.sqrt(2.0)  # at least that of the ellipse
    assert abs(area(region) - math.pi * a * b) <= ring(perimeter)


@settings(max_examples=30)
@given(radius=st.floats(1e-6, 4e-6), corners=st.integers(3, 40), turn=st.floats(0.0, 6.3))
def test_a_polygon_has_its_area_to_a_ring_of_pixels(radius: float, corners: int, turn: float) -> None:
    place = turn + 2.0 * np.pi * np.arange(corners) / corners
    region = Polygon(x=tuple(6e-6 + radius * np.cos(place)), y=tuple(7e-6 + radius * np.sin(place)))
    exact = 0.5 * corners * radius**2 * math.sin(2.0 * math.pi / corners)
    assert abs(area(region) - exact) <= ring(2.0 * corners * radius * math.sin(math.pi / corners))


def test_a_polygon_that_crosses_itself_is_inside_where_enclosed_an_odd_number_of_times() -> None:
    """A five-pointed star has a hole; a bow tie has two halves."""
    place = 0.5 * np.pi + 4.0 * np.pi * np.arange(5) / 5
    star = Polygon(x=tuple(6e-6 + 5e-6 * np.cos(place)), y=tuple(7e-6 + 5e-6 * np.sin(place)))
    inside = star.covers(GRID)
    assert not inside[60, round(7e-6 / 1.5e-7)]
    assert inside[60, round(11e-6 / 1.5e-7)]
    tie = Polygon(x=(1e-6, 11e-6, 11e-6, 1e-6), y=(1e-6, 11e-6, 1e-6, 11e-6))
    assert abs(area(tie) - 50e-12) <= ring(20e-6 + 2.0 * math.sqrt(2.0) * 10e-6)


def test_every_orientation_and_start_of_a_polygon_is_the_same() -> None:
    x, y = (1e-6, 9e-6, 10e-6, 4e-6), (1e-6, 2e-6, 12e-6, 6e-6)
    found = Polygon(x=x, y=y).covers(GRID)
    np.testing.assert_array_equal(Polygon(x=x[::-1], y=y[::-1]).covers(GRID), found)
    np.testing.assert_array_equal(Polygon(x=(*x[2:], *x[:2]), y=(*y[2:], *y[:2])).covers(GRID), found)


def test_axes_are_not_exchanged() -> None:
    """A region near the end of x and the start of y."""
    for region in (
        Rectangle(x=(10e-6, 12e-6), y=(0.0, 1.5e-6)),
        Ellipse(centre=(11e-6, 1e-6), radii=(1e-6, 0.7e-6)),
        Polygon(x=(10e-6, 12e-6, 12e-6), y=(0.0, 0.0, 1.5e-6)),
    ):
        i, j = np.nonzero(region.covers(GRID))
        assert i.min() >= 99
        assert j.max() <= 11
    slim = Ellipse(centre=(6e-6, 7e-6), radii=(4e-6, 0.5e-6), angle=math.pi / 4)
    i, j = np.nonzero(slim.covers(GRID))
    assert np.corrcoef(i, j)[0, 1] > 0.9  # it rises


SURFACE = asp.Surface(np.random.default_rng(5).standard_normal(GRID.shape) * 1e-9, *GRID.spacing, periodic=True)
HOLE = Rectangle(x=(1e-6, 2e-6), y=(3e-6, 6e-6))


def test_a_mask_takes_points_and_keeps_heights() -> None:
    once = masked(SURFACE, [HOLE, Ellipse(centre=(9e-6, 9e-6), radii=(1e-6, 1e-6))])
    assert once.n_missing == HOLE.covers(GRID).sum() + Ellipse((9e-6, 9e-6), (1e-6, 1e-6)).covers(GRID).sum()
    np.testing.assert_array_equal(once.heights[~once.mask], SURFACE.heights[~once.mask])
    assert once.periodic
    assert once.origin.history[-1] == f"masked: {once.n_missing} of 12000 points inside rectangle, ellipse"
    other = masked(SURFACE, HOLE, invert=True)  # type: ignore[arg-type]
    np.testing.assert_array_equal(other.mask, ~HOLE.covers(GRID))
    twice = masked(once, [HOLE])
    np.testing.assert_array_equal(twice.mask, once.mask)
    full = asp.filled(once)
    assert full.n_missing == 0
    np.testing.assert_array_equal(full.heights[~once.mask], SURFACE.heights[~once.mask])


def test_masks_of_line_scans_are_ranges_along_them() -> None:
    profile = SURFACE.row(3)
    found = masked(profile, [Rectangle(x=(1e-6, 2e-6))])
    assert found.n_missing == 10
    with refused(InputError, "region 1 of a mask", "ellipse"):
        masked(profile, [Ellipse((1e-6, 0.0), (1e-6, 1e-6))])


@pytest.mark.parametrize(
    ("regions", "subject", "shown"),
    [
        ([], "mask", "none"),
        ([Rectangle(x=(0.0, 1.0))], "mask", "12000"),
        ([HOLE, Rectangle(x=(1.0, 2.0))], "region 2 of a mask", "1.2e-05 x 1.5e-05"),
        ([Ellipse((3.01e-6, 3.01e-6), (1e-9, 1e-9))], "region 1 of a mask", "ellipse"),
        (["rectangle"], "region 1 of a mask", "'rectangle'"),
    ],
)
def test_refusals(regions: list[Any], subject: str, shown: str) -> None:
    with refused(InputError, subject, shown):
        masked(SURFACE, regions)


def test_regions_refuse_what_is_none() -> None:
    with refused(InputError, "rectangle of a mask"):
        Rectangle()
    with refused(InputError, "polygon of a mask", "3", "2"):
        Polygon(x=(0.0, 1.0, 2.0), y=(0.0, 1.0))
    with refused(InputError, "radii (m) of Ellipse", "0"):
        Ellipse((0.0, 0.0), (1.0, 0.0))
