"""Steps with stick and slip come back from their file as they went in, and histories go on from
them."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest
from contact_cases import rough

import asperity as asp
from asperity.core.quantity import stored_quantities
from asperity.physics.friction.answer import StickSlip
from asperity.run.stored import load_outcome

COATED = asp.Layered([asp.Layer(asp.Elastic(2.0, 0.3), 2.0)], asp.Elastic(0.5, 0.2))
PRESSED = asp.MeanPressure(0.01)
STEPS = (
    asp.Step(PRESSED, asp.Shift()),
    asp.Step(PRESSED, asp.Shift(3e-3, 1e-3)),
    asp.Step(asp.MeanPressure(0.012), asp.TangentialForce(-0.2)),
    asp.Step(PRESSED),
)
LAWS = {
    "coulomb": asp.Coulomb(0.3, limit=0.1),
    "map": asp.Coulomb(np.linspace(0.1, 0.5, 256).reshape(16, 16)),
    "full stick": asp.friction.FullStick(),
    "tresca": asp.friction.TrescaFriction(np.full((16, 16), 0.02)),
}


def problem(law: object) -> asp.ContactProblem:
    return asp.ContactProblem(rough((16, 16), 4), COATED, friction=law)  # type: ignore[arg-type]


def same(found: asp.ContactResult, result: asp.ContactResult) -> None:
    again, shear = found.stick_slip, result.stick_slip
    assert again is not None
    assert shear is not None
    for item in fields(shear):
        first, second = getattr(again, item.name), getattr(shear, item.name)
        if isinstance(second, np.ndarray):
            assert first.dtype == second.dtype
            np.testing.assert_array_equal(first, second, item.name)
        elif item.name != "law":
            assert type(first) is type(second)
            assert first == second, item.name
    np.testing.assert_array_equal(found.pressure, result.pressure)
    assert found.memory.keys() == result.memory.keys()
    for key, values in result.memory["stick_slip"].items():
        np.testing.assert_array_equal(found.memory["stick_slip"][key], values, key)


@pytest.mark.parametrize("name", LAWS)
def test_a_step(name: str, tmp_path: Path) -> None:
    result = asp.solve(problem(LAWS[name]), STEPS[1])
    asp.save(result, tmp_path / "r.nc")
    again = asp.load(tmp_path / "r.nc")
    same(again, result)
    law = again.problem.friction
    np.testing.assert_array_equal(law.bound(result.pressure), LAWS[name].bound(result.pressure))  # type: ignore[attr-defined]
    group = asp.files.open_tree(tmp_path / "r.nc")["contact/couplings/stick_slip"]
    measured = [item for item in stored_quantities(StickSlip) if item.unit]
    assert {"traction", "shift_x", "dissipation_density"} <= {item.name for item in measured}
    for item in measured:
        assert group[item.name].attrs == item.attributes
        assert group[item.name].dims == item.dims


@pytest.mark.slow
def test_a_history_and_the_same_bits_after_a_break(tmp_path: Path) -> None:
    """Two steps, saved and loaded, and the other two from there, against all four in one go."""
    case = problem(asp.Coulomb(0.3))
    whole = asp.solve(case, asp.History(STEPS))
    asp.save(whole, tmp_path / "whole.nc")
    loaded = asp.load(tmp_path / "whole.nc")
    for found, result in zip(loaded.steps, whole.steps, strict=True):
        same(found, result)
    outcome = load_outcome(tmp_path / "whole.nc")
    assert outcome.values["total_dissipated"] == whole.last.stick_slip.total_dissipated
    assert "stick_slip" in {part.name for part, _ in outcome.sections}
    column = asp.files.open_tree(tmp_path / "whole.nc")["path/couplings/stick_slip/traction"]
    assert column.dims == ("step", "component", "x", "y")
    assert column.attrs["units"] == "Pa"
    asp.save(asp.solve(case, asp.History(STEPS[:2])), tmp_path / "half.nc")
    half = asp.load(tmp_path / "half.nc")
    rest = asp.solve(case, asp.History(STEPS[2:]), state=half.state)
    for found, result in zip(rest.steps, whole.steps[2:], strict=True):
        same(found, result)
    asp.save(rest, tmp_path / "rest.nc")
    again = asp.load(tmp_path / "rest.nc")
    for key, values in half.state.memory["stick_slip"].items():
        np.testing.assert_array_equal(again.start.memory["stick_slip"][key], values)
