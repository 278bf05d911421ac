"""Islands on patterns one can count by hand, and what they do not depend on."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from asperity.contact.measure import island_sizes, labelled, spans


def pattern(text):
    return np.array([[c == "#" for c in line] for line in text.split()])


CORNERS = pattern("#..# .... .... #..#")


@pytest.mark.parametrize(
    ("wraps", "diagonal", "count"),
    [((False, False), True, 4), ((True, False), False, 2), ((False, True), False, 2), ((True, True), False, 1)],
)
def test_corners_of_a_map_meet_across_its_border(wraps, diagonal, count):
    assert labelled(CORNERS, wraps=wraps, diagonal=diagonal)[1] == count


def test_pixels_that_share_a_corner_across_the_border():
    step = pattern("#... .... .... .#..")
    assert labelled(step, wraps=(True, False))[1] == 2
    assert labelled(step, wraps=(True, False), diagonal=True)[1] == 1
    across = pattern("#... .... .... ...#")
    assert labelled(across, wraps=(True, False), diagonal=True)[1] == 2
    assert labelled(across, wraps=(True, True), diagonal=True)[1] == 1


@given(st.integers(0, 10**6), st.floats(0.1, 0.9), st.integers(0, 11), st.integers(0, 11), st.booleans())
def test_islands_of_a_repeating_map_do_not_care_where_it_starts(seed, share, i, j, diagonal):
    mask = np.random.default_rng(seed).random((9, 12)) < share
    labels, count = labelled(mask, wraps=(True, True), diagonal=diagonal)
    moved, moved_count = labelled(np.roll(mask, (i, j), (0, 1)), wraps=(True, True), diagonal=diagonal)
    assert count == moved_count == labels.max(initial=0)
    assert ((labels > 0) == mask).all()
    # the same pixels belong together: labels correspond one to one
    pairs = {(a, b) for a, b in zip(np.roll(labels, (i, j), (0, 1)).ravel(), moved.ravel(), strict=True)}
    assert len(pairs) == count + (0 if mask.all() else 1)


def test_what_reaches_across():
    labels, _ = labelled(pattern("####. ..... .#..."), wraps=(False, False))
    assert spans(labels, wraps=(False, False)).tolist() == [False, False]
    labels, _ = labelled(pattern("##### ..... .#..."), wraps=(False, False))
    assert spans(labels, wraps=(False, False)).tolist() == [True, False]
    # round the map by way of its border
    labels, _ = labelled(pattern("#.### ..... ###.."), wraps=(False, True))
    assert not spans(labels, wraps=(False, True)).any()


@given(st.integers(0, 10**6), st.floats(0.1, 0.9), st.booleans(), st.booleans())
def test_sizes_are_the_pixels_of_the_labels(seed, share, x, y):
    mask = np.random.default_rng(seed).random((9, 12)) < share
    labels, count = labelled(mask, wraps=(x, y))
    counted = np.bincount(labels.ravel(), minlength=count + 1)[1:]
    np.testing.assert_array_equal(island_sizes(mask, wraps=(x, y)), counted)
