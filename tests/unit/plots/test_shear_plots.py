"""Figures of stick and slip show the numbers they claim to show."""

from __future__ import annotations

import numpy as np
import pytest
from contact_cases import rough
from matplotlib.figure import Figure

import asperity as asp
from asperity.core.errors import InputError
from asperity.physics.friction.fretting import OPEN, SLIPS, STICKS, kinds, loop_of


@pytest.fixture(scope="module")
def history() -> asp.HistoryResult:
    body = asp.Elastic(2.0, 0.3)
    problem = asp.ContactProblem(rough((24, 20), 3), body, counter_body=body, friction=asp.Coulomb(0.3))
    load = asp.MeanPressure(0.05)
    steps = asp.friction.shear_cycles(load, asp.Shift(0.06, 0.08), cycles=2, steps=3)
    return asp.solve(problem, asp.History([asp.Step(load, asp.Shift()), *steps]))


def test_the_loop(history: asp.HistoryResult) -> None:
    """Shift and force along (0.6, 0.8); both cycles, whose heat is that of their steps and the
    same."""
    loop = loop_of(history.steps)
    assert loop.direction == pytest.approx((0.6, 0.8))
    assert loop.cycles == ((3, 15), (15, 27))
    assert loop.cycle_energies[0] == pytest.approx(loop.cycle_energies[1], rel=1e-4)
    assert loop.cycle_energies.sum() == pytest.approx(sum(s.stick_slip.dissipated for s in history.steps[4:]))
    ax = history.plot("loop", Figure().add_subplot())
    drawn = {line.get_label(): np.asarray(line.get_data()) for line in ax.lines}
    assert drawn["cycles"].shape == (2, 25)
    for row, wanted in zip(drawn["cycles"], (loop.shift, loop.force), strict=True):
        assert row / row[0] == pytest.approx(wanted[3:] / wanted[3], abs=1e-9)


def test_kinds_of_points(history: asp.HistoryResult) -> None:
    """Open where nothing touches; slipping points are those on the bound, to the tolerance."""
    result = history.steps[2]
    found, shear = kinds(result), result.stick_slip
    np.testing.assert_array_equal(found == OPEN, ~result.contact)
    assert 0 < np.count_nonzero(found == SLIPS) < np.count_nonzero(result.contact)
    share = shear.traction_magnitude[result.contact] / shear.law.bound(result.pressure)[result.contact]
    slips = found[result.contact] == SLIPS
    assert share[slips] == pytest.approx(1.0, abs=1e-9)
    assert share[~slips].max() <= 1.0 + 1e-9
    assert STICKS in found


def test_sections_and_heat(history: asp.HistoryResult) -> None:
    """The line lies within the bounds; the map of a history is the sum of those of its steps."""
    result = history.steps[2]
    ax = result.plot("shear_section", Figure().add_subplot())
    line = next(np.asarray(line.get_ydata()) for line in ax.lines if line.get_label() == "shear traction")
    assert line.max() > 0.0
    assert np.all(np.abs(line) <= ax.dataLim.y1 * (1.0 + 1e-9))
    image = history.plot("dissipation", Figure().add_subplot()).images[0].get_array()
    total = sum(step.stick_slip.dissipated for step in history.steps) / history.last.problem.grid.pixel_area
    assert float(image.sum()) == pytest.approx(total)


def test_a_contact_without_has_no_such_figure() -> None:
    problem = asp.ContactProblem(rough((8, 8), 1), asp.Elastic(1.0, 0.3))
    with pytest.raises(InputError) as refused:
        asp.solve(problem, asp.MeanPressure(0.01)).plot("stick_slip", Figure().add_subplot())
    assert refused.value.subject == "result"
