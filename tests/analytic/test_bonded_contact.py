"""Bonded discs against closed forms: pushed, pulled along and twisted."""

from __future__ import annotations

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.core.errors import ConvergenceError, InputError
from asperity.friction import BondedField, bonded_contact


def _disc(points: int) -> tuple[asp.Grid, np.ndarray, dict[str, np.ndarray]]:
    """Disc of radius 1 on a grid of 1/``points``, and unit motions of it."""
    grid = asp.Grid((2 * points + 4,) * 2, (1.0 / points,) * 2)
    x, y = np.broadcast_arrays(*grid.centred_coordinates())
    none, one = np.zeros(grid.shape), np.ones(grid.shape)
    motions = {"push": [none, none, one], "drag": [one, none, none], "twist": [-y, x, none]}
    return grid, x**2 + y**2 < 1.0, {name: np.stack(parts) for name, parts in motions.items()}


def _moved(points: int, motion: str, poisson: float) -> float:
    """Force or moment of a unit motion over that of unit shear modulus and radius."""
    grid, on, motions = _disc(points)
    body = asp.Elastic(2.0 * (1.0 + poisson), poisson)
    field = bonded_contact(grid, motions[motion], body, on=on, boundary=asp.Free())
    assert field.misfit < 1e-9
    assert np.abs(field.traction[:, ~on]).max() == 0.0
    return {"push": field.force[2], "drag": field.force[0], "twist": field.twist}[motion]


def _stiffness(motion: str, poisson: float) -> float:
    """Closed forms: Mossakovskii's of the bonded push, and those of drag and twist."""
    if motion == "push":
        return 8.0 if poisson == 0.5 else 4.0 * np.log(3.0 - 4.0 * poisson) / (1.0 - 2.0 * poisson)
    return 16.0 / 3.0 if motion == "twist" else 8.0 / (2.0 - poisson)


@pytest.mark.parametrize(
    ("motion", "poisson"),
    [("push", 0.0), ("push", 0.3), ("push", 0.5), ("twist", 0.0), ("twist", 0.3), ("twist", 0.5), ("drag", 0.5)],
)
def test_discs(motion: str, poisson: float) -> None:
    """The error falls with the spacing and is below that of a radius shorter by one point."""
    expected = _stiffness(motion, poisson)
    power = 3 if motion == "twist" else 1
    errors = [abs(_moved(points, motion, poisson) / expected - 1.0) for points in (16, 64)]
    assert errors[1] < 0.4 * errors[0]
    assert errors[1] < power / 64


def test_a_bonded_drag_is_stiffer_than_without_coupling() -> None:
    """Points that may not move up or down resist; by 8 G a/(2 - ν) and more, up to a few per
    cent."""
    gain = _moved(64, "drag", 0.0) / _stiffness("drag", 0.0)
    assert 1.03 < gain < 1.1


def test_without_coupling_the_push_is_the_frictionless_stamp() -> None:
    grid, on, motions = _disc(12)
    body = asp.Elastic(1.0, 0.5)
    bonded = bonded_contact(grid, motions["push"], body, on=on, boundary=asp.Free())
    flat = asp.Surface(np.zeros(grid.shape), *grid.spacing)
    stamp = asp.contact.stamp_contact(flat, body, approach=1.0, on=on, boundary=asp.Free())
    assert np.abs(bonded.traction[2] - stamp.pressure).max() < 1e-8 * stamp.pressure.max()
    assert np.abs(bonded.traction[:2]).max() < 1e-8 * stamp.pressure.max()


@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.FreeLine()])
def test_tractions_are_found_again_from_their_displacement(boundary: asp.contact.Boundary) -> None:
    """On a periodic cell and a line: those of one motion from the displacement that they give."""
    shape = (32, 1) if isinstance(boundary, asp.FreeLine) else (24, 20)
    grid = asp.Grid(shape, (1.0, 1.0))
    random = np.random.default_rng(5)
    on = np.zeros(shape, dtype=bool)
    on[4:15] = True
    first = bonded_contact(grid, random.normal(size=(3, *shape)), asp.Elastic(1.0, 0.2), on=on, boundary=boundary)
    wider = np.zeros(shape, dtype=bool)
    wider[2:18] = True
    again = bonded_contact(grid, first.displacement, asp.Elastic(1.0, 0.2), on=wider, boundary=boundary)
    assert np.abs(again.traction - first.traction).max() < 1e-6 * np.abs(first.traction).max()


def test_refused() -> None:
    grid, on, motions = _disc(6)
    body = asp.Elastic(1.0, 0.3)
    with refused(InputError, "bonded points"):
        bonded_contact(grid, motions["push"], body, on=np.zeros_like(on))
    with refused(InputError, "bonded points", str(on.size)):
        bonded_contact(grid, motions["push"], body, on=np.ones_like(on))
    with refused(InputError, "displacement (m)", "(2, 16, 16)"):
        bonded_contact(grid, motions["push"][:2], body, on=on)


def test_a_displacement_that_is_missed_is_no_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("asperity.physics.friction.prescribed._MOST_ROUNDS", 2)
    grid, on, motions = _disc(8)
    with pytest.raises(ConvergenceError) as caught:
        bonded_contact(grid, motions["twist"], asp.Elastic(1.0, 0.3), on=on, boundary=asp.Free())
    assert isinstance(caught.value.result, BondedField)
