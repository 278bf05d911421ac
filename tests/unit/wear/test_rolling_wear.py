"""Wear by creepage: where it slips, as much as the heat says."""

from __future__ import annotations

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.wear import archard, dissipated_energy, rolled


def rolling(direction: str = "x") -> asp.rolling.RollingContact:
    """A ball that rolls with some creepage across and along."""
    n, radius, contact, friction = 32, 1.0, 0.1, 0.3
    spacing = 2.3 * contact / n
    x = (np.arange(n) - 0.5 * (n - 1)) * spacing
    surface = asp.Surface(-(x[:, None] ** 2 + x[None] ** 2) / (2.0 * radius), spacing)
    body = asp.Elastic(1.0, 0.3)
    problem = asp.ContactProblem(
        surface, body, counter_body=body, boundary=asp.Free(), friction=asp.friction.Coulomb(friction)
    )
    load = asp.Force(4.0 / 3.0 * problem.contact_modulus * contact**3 / radius)
    return asp.roll(problem, load, asp.rolling.Creepage(8e-3, 3e-3), direction=direction)


def test_the_volume_is_that_of_the_heat() -> None:
    """mu p s is the heat per area and distance rolled: V = k/mu times it, whatever the
    circumference."""
    found = rolling()
    heat = float(found.power_density.sum()) * found.normal.problem.grid.pixel_area
    for circumference in (2.0, 5.0):
        worn = rolled(found, archard(1e-9), 100.0, circumference)
        assert worn.volume == pytest.approx(1e-9 / 0.3 * heat * 100.0, rel=1e-9)
        assert worn.passages == pytest.approx(100.0 / circumference)
    energy = rolled(found, dissipated_energy(1e-9 / 0.3, 0.3), 100.0, 2.0)
    assert energy.depth == pytest.approx(rolled(found, archard(1e-9), 100.0, 2.0).depth)


def test_what_sticks_does_not_wear_and_the_way_is_that_of_rolling() -> None:
    """Lines along the direction of rolling on which no point slips keep their height; the profile
    is across."""
    along_x = rolled(rolling(), archard(1e-9), 100.0, 2.0)
    along_y = rolled(rolling("y"), archard(1e-9), 100.0, 2.0)
    assert along_x.depth[[0, -1]].tolist() == [0.0, 0.0]
    assert along_x.depth[len(along_x.depth) // 2] > 0.0
    assert along_x.across == pytest.approx(-along_x.across[::-1])
    assert along_y.depth.shape == along_x.depth.shape
    assert along_y.volume != along_x.volume, "the creepage along x is across now"


@pytest.mark.parametrize(
    ("change", "subject"),
    [
        ({"distance": 0.0}, "distance rolled (m)"),
        ({"circumference": -1.0}, "circumference of a rolling body (m)"),
        ({"law": archard(1e-15, threshold_pressure=1.0)}, "law of wear of a rolling body"),
        ({"law": 1e-15}, "law of wear of a rolling body"),
    ],
)
def test_what_does_not_wear_by_rolling_is_refused(change: dict[str, object], subject: str) -> None:
    given = {"contact": rolling(), "law": archard(1e-15), "distance": 1.0, "circumference": 1.0}
    with refused(InputError, subject):
        rolled(**given | change)  # type: ignore[arg-type]
