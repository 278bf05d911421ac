"""What results and histories say of themselves in Python is what reports and the command line
say."""

from __future__ import annotations

from functools import cache

import numpy as np

import asperity as asp
from asperity.parts.advice import advise, review
from asperity.plots.notebook import card


@cache
def problem() -> asp.ContactProblem:
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(2e-9), hurst=0.8, rolloff_wavelength=6e-7, shortest_wavelength=4e-8
    )
    surface = asp.generate.gaussian(asp.Grid((48, 48), (10e-9, 10e-9)), spectrum, seed=3)
    return asp.ContactProblem(surface, asp.material("DLC"))


def test_a_result_knows_that_its_hardness_is_exceeded() -> None:
    """An elastic answer at more than the hardness of DLC was "Contact, converged", and no more."""
    hard = asp.solve(problem(), asp.MeanPressure(9e9))
    assert hard.max_pressure > asp.material("DLC").strength.hardness
    warned = {item.criterion for item in hard.advice if item.level == "warning"}
    assert "hardness" in warned
    for shown in (repr(hard), card(hard)):
        assert "Would yield: " in shown
        assert "Doubtful: " in shown
    assert set(hard.advice) == {*advise(hard.problem, hard.control), *review(hard)}


def test_a_history_that_ends_unloaded_tells_of_its_largest_force() -> None:
    path = asp.solve(problem(), asp.History([asp.MeanPressure(value) for value in (1e9, 9e9, 1e7)]))
    peak, last = review(path[1]), {item.criterion for item in review(path.last)}
    missed = [item for item in peak if item.criterion not in last]
    assert missed, "the case is chosen so that the last step alone would not tell"
    told = {item.criterion: item.message for item in path.advice}
    for item in missed:
        assert told[item.criterion].endswith(item.message)
        assert "(step 2)" in told[item.criterion]


def test_a_quiet_contact_says_nothing() -> None:
    x = np.linspace(0.0, 2.0 * np.pi, 32, endpoint=False)
    wave = asp.Surface(1e-9 * np.cos(x)[:, None] * np.cos(x), 1e-7, periodic=True)
    result = asp.solve(asp.ContactProblem(wave, asp.Elastic(1e11, 0.3)), asp.MeanPressure(2e7))
    assert [item for item in result.advice if item.level == "warning"] == []
    assert "WARNING" not in repr(result)
