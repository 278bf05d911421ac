"""Search for the balance of a force that rises and falls in jumps: on forces given as functions,
and on contacts made up."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import asperity as asp
from asperity.physics.menisci.bracket import Bracket, End, astray
from asperity.physics.menisci.coupling import TOLERANCE, MeniscusCoupling
from asperity.physics.menisci.film import between, wetting

FILM = asp.LiquidFilm(surface_tension=0.5, thickness=1.0, meniscus_height=2.0)
"""Pulls with 0.5 Pa."""
EXTERNAL = 1.0


def contact(gap: np.ndarray) -> SimpleNamespace:
    """A contact of this ``gap`` on pixels of 1 m², under ``EXTERNAL``."""
    shape = gap.shape
    grid = SimpleNamespace(area=float(gap.size), pixel_area=1.0, shape=shape)
    posed = SimpleNamespace(operator=SimpleNamespace(grid=grid), external_force=EXTERNAL)
    pressure = np.where(gap <= 0.0, 1.0, 0.0)
    return SimpleNamespace(gap=np.maximum(gap, 0.0), touching=gap <= 0.0, pressure=pressure, posed=posed)


def rounds(gap_at, most: int = 80):
    """The coupling's last reply to contacts of the gap ``gap_at(load)``, and all loads posed."""
    coupling, loads = MeniscusCoupling(FILM, (False, False), asp.Coulomb(0.0)), []
    exchange = coupling.begin(None, {})
    for _ in range(most):
        loads.append(EXTERNAL + float(exchange.x))
        again = coupling.reply(exchange, contact(gap_at(loads[-1])))
        if again.stuck or (again.settled and exchange.exact):
            return coupling, again, loads
        exchange = again if again.settled else replace(again, x=again.target)
    raise AssertionError("no end")


def end(posed: float, force: float) -> End:
    gap = np.ones((1, 1))
    return End(posed, force, wetting(gap, gap < 0.0, FILM, wraps=(False, False)), gap, 0.0 * gap)


@settings(max_examples=200)
@given(st.lists(st.tuples(st.floats(0.0, 100.0), st.floats(-20.0, 20.0)), max_size=12), st.floats(0.0, 50.0))
def test_the_bracket_closes_on_a_balance_or_a_fall(jumps, first):
    """Of any force that jumps: at the end it is pulled what is posed, or more on the one side and
    less on the other."""

    def pulled(x: float) -> float:
        return max(first + sum(step for at, step in jumps if x >= at), 0.0)

    bracket, x = Bracket(), 0.0
    for _ in range(200):
        latest = end(x, pulled(x))
        bracket = bracket.with_end(latest)
        if latest.step == 0.0 or bracket.width <= 1e-9 * (1.0 + x):
            break
        x = bracket.further(latest, EXTERNAL)
    assert latest.step == 0.0 or bracket.width <= 1e-9 * (1.0 + x)
    if latest.step != 0.0:
        assert pulled(bracket.low.posed) >= bracket.low.posed
        assert pulled(bracket.high.posed) < bracket.high.posed


def test_a_bracket_that_has_lost_the_balance_is_searched_ever_wider():
    bracket = Bracket().with_end(end(1.0, 5.0)).with_end(end(1.5, 0.0))
    assert bracket.width == 0.5
    assert bracket.further(bracket.high, EXTERNAL) == 1.25
    moved = bracket.with_end(end(1.5, 9.0))  # what else changes has moved it up
    assert moved.high is None
    assert moved.further(moved.low, EXTERNAL) == 1.5 + 4.0 * 0.5
    back = moved.with_end(end(3.5, 0.0)).with_end(end(3.5, 20.0))
    assert back.further(back.low, EXTERNAL) == 3.5 + 4.0 * 2.0


def test_pixels_that_change_sides_are_filled_in_part():
    gap = np.array([[0.0, 0.5, 0.8, 5.0]])
    closer = np.array([[0.0, 0.0, 0.8, 1.5]])
    here, there = (wetting(g, g <= 0.0, FILM, wraps=(False, False)) for g in (gap, closer))
    part = between(here, there, 0.25)
    np.testing.assert_array_equal(part.filled, [[0.0, 0.75, 1.0, 0.25]])
    np.testing.assert_array_equal(part.partly, [[False, True, False, True]])
    assert part.share("filled") == pytest.approx(0.75 * here.share("filled") + 0.25 * there.share("filled"))
    np.testing.assert_array_equal(part.menisci, here.menisci)
    assert not here.partly.any()
    full = wetting(np.zeros((1, 4)), np.ones((1, 4), bool), FILM, wraps=(False, False))
    assert (full.regime, full.filled_at([2], [0.5]).regime) == ("dry", "flooded")


def test_a_pixel_that_comes_into_contact_holds_liquid_in_part():
    """Two pixels of 0.5 N each until, at 1.6 N, one touches: 0.6 N beside 1 N are pulled by one and
    a fifth of them."""

    def gap(load: float) -> np.ndarray:
        return np.array([[-1.0, 1.6 - load, 0.5, 9.0, 9.0, 9.0]])

    coupling, found, loads = rounds(gap)
    assert found.settled
    assert not found.stuck
    assert found.note.force == pytest.approx(0.6, abs=2.0 * TOLERANCE)
    assert loads[-1] == pytest.approx(1.6, abs=2.0 * TOLERANCE)
    assert found.note.found.filled[0, 1:3] == pytest.approx([0.2, 1.0], abs=1e-3)
    assert "in a jump of 0.5 N, 1 pixel being under liquid in part there," in coupling.settled(found)


def test_an_island_that_dries_at_once_is_no_balance_and_said():
    """Six pixels lose the only one in the film at 2.2 N, far from their own edges: 3 N or none are
    pulled, and 1.2 N wanted."""

    def gap(load: float) -> np.ndarray:
        return np.array([[-1.0, 9.0, 0.9 + 0.1 * (load > 2.2) * 2.0, *[1.5] * 5, 9.0, 9.0, 9.0, 9.0, 9.0]])

    coupling, found, loads = rounds(gap)
    assert found.stuck
    assert not found.settled
    assert loads[-1] == pytest.approx(2.2, rel=1e-6)
    said = coupling.unsettled(found)
    assert "jumps past its balance: by 3 N from the contact force of 2.2 N" in said
    assert "as 6 pixels away" in said


def test_a_force_that_rises_by_islands_is_followed_to_the_first_balance():
    """Jumps up only: what is pulled is posed, and the first load that bears it is the balance,
    though a later one bears more."""

    def gap(load: float) -> np.ndarray:
        thresholds = np.array([1.0, 1.4, 1.9, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0, 9.0])
        return np.concatenate([[-1.0], np.where(load >= thresholds, 0.5, 9.0)])[None, :]

    _, found, loads = rounds(gap)
    assert found.note.force == 1.5
    assert loads[-1] == EXTERNAL + 1.5
    assert max(loads) == loads[-1]


def test_pixels_wet_in_part_where_the_pressure_jumps_must_be_at_the_edge_at_both_ends():
    """Fully yielded points sink at one load; a contact that jumps otherwise is not the one in
    between."""
    apart, shut = contact(np.array([[-1.0, 0.5, 3.0]])), contact(np.array([[-1.0, -0.1, 3.0]]))
    ends = []
    for at in (apart, shut):
        stands = wetting(at.gap, at.touching, FILM, wraps=(False, False))
        ends.append(End(0.0, 0.0, stands, at.gap, at.pressure))
    assert astray(*ends, 2.0) == 1
    sunk = End(0.0, 0.0, ends[1].stands, shut.gap, np.where(shut.touching, [[1.0, 1e-5, 0.0]], 0.0))
    assert astray(ends[0], sunk, 2.0) == 0
