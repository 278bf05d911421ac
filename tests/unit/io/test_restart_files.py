"""States of finite elements and rolling contacts come back from their files as they went in, and
histories go on from them to the bit."""

from __future__ import annotations

import math
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity import fem
from asperity.core.errors import FileFormatError, InputError
from asperity.io.results import contact_of, to_xarray
from asperity.io.tree import Node, read_tree, write_tree
from asperity.solids.plasticity import J2, LinearHardening

SOLID = asp.Elastic(200e9, 0.3)
LAW = J2(SOLID, LinearHardening(400e6, 1e9), kinematic=10e9, recall=50.0)


def same(found: Any, wanted: Any, name: str = "") -> None:
    """All fields are equal to the bit, of the same type."""
    assert type(found) is type(wanted), name
    if is_dataclass(wanted):
        for item in fields(wanted):
            same(getattr(found, item.name), getattr(wanted, item.name), f"{name}.{item.name}")
    elif isinstance(wanted, np.ndarray):
        assert found.dtype == wanted.dtype, name
        assert found.shape == wanted.shape, name
        np.testing.assert_array_equal(found, wanted, name)
    elif isinstance(wanted, tuple):
        assert len(found) == len(wanted), name
        for number, (one, other) in enumerate(zip(found, wanted, strict=True)):
            same(one, other, f"{name}[{number}]")
    else:
        assert found == wanted or (math.isnan(found) and math.isnan(wanted)), name


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_an_indentation_goes_on_from_its_file(friction: float, tmp_path: Path) -> None:
    body = asp.Layered([asp.Layer(asp.Elastic(400e9, 0.25), 1e-6)], base=SOLID)
    steps = [40e-9, 80e-9, fem.Load(0.0), 100e-9]
    coarse = fem.Resolution(across=5, per_layer=3, growth=1.4, distance=10.0)
    ball = fem.Indentation.of(
        body, fem.Paraboloid(10e-6), steps, plasticity=[None, LAW], friction=friction, resolution=coarse
    )
    first = ball.run(steps[:2])
    asp.save(first.state, tmp_path / "state.nc")
    state = asp.load(tmp_path / "state.nc")
    same(state, first.state)
    straight, again = ball.run(steps[2:], start=first.state), ball.run(steps[2:], start=state)
    same(again.state, straight.state)
    same(again.steps, straight.steps)
    with refused(InputError, "result file"):
        contact_of(state)


@pytest.mark.parametrize("sphere", [False, True])
def test_passes_go_on_from_their_file(sphere: bool, tmp_path: Path) -> None:
    make = fem.sphere_track if sphere else fem.cylinder_track
    coarse = fem.Resolution(across=4, growth=1.8, depth=0.8, distance=6.0)
    track = make(SOLID, 1e-3, (-5e-4, 5e-4), plasticity=LAW, resolution=coarse)
    ends, peak = (-5e-4, 5e-4), 1.1e9
    first = fem.hertz_pass(track, track.virgin(), peak, 1e-3, ends, friction=0.1, steps=2, ramp=1)
    assert first.dissipated[-1] > 0.0
    asp.save(first.state, tmp_path / "state.nc")
    state = asp.load(tmp_path / "state.nc")
    same(state, first.state)
    one, other = (
        fem.hertz_pass(track, at, peak, 1e-3, ends, friction=0.1, steps=2, ramp=1) for at in (first.state, state)
    )
    same(other, one)
    assert to_xarray(state)["pass_state"]["displacement"].attrs["units"] == "m"


def test_damaged_states_are_refused(tmp_path: Path) -> None:
    coarse = fem.Resolution(across=4, growth=1.8, distance=6.0)
    track = fem.cylinder_track(SOLID, 1e-3, (0.0, 0.0), plasticity=LAW, resolution=coarse)
    asp.save(track.virgin(), tmp_path / "whole.nc")
    tree = read_tree(tmp_path / "whole.nc")
    group = tree.children["pass_state"]
    attributes = {key: value for key, value in tree.attributes.items() if key != "asperity_format"}
    short = tuple(item for item in group.values if item.quantity.name != "plastic_back_stress")
    write_tree(Node((), attributes, {"pass_state": Node(short, group.attributes)}), tmp_path / "short.nc")
    with refused(FileFormatError, "result file"):
        asp.load(tmp_path / "short.nc")


@pytest.mark.parametrize("law", [asp.Coulomb(0.3), asp.Coulomb(np.full((24, 20), 0.2))], ids=["number", "map"])
def test_a_rolling_contact(law: Any, tmp_path: Path) -> None:
    surface = asp.generate.sphere(asp.Grid((24, 20), (5e-6, 5e-6)), radius=10e-3)
    problem = asp.ContactProblem(surface, SOLID, boundary=asp.Free(), friction=law)
    rolled = asp.roll(problem, asp.Force(2.0), asp.rolling.Creepage(1e-4, 5e-5, 0.2), direction="-x")
    asp.save(rolled, tmp_path / "rolling.nc")
    again = asp.load(tmp_path / "rolling.nc")
    for item in fields(rolled):
        if item.name not in ("normal", "law"):
            same(getattr(again, item.name), getattr(rolled, item.name), item.name)
    np.testing.assert_array_equal(again.law.coefficient, law.coefficient)
    np.testing.assert_array_equal(again.normal.pressure, rolled.normal.pressure)
    assert again.longitudinal_force == rolled.longitudinal_force
    assert again.slip_area_fraction == rolled.slip_area_fraction
    further = asp.roll(problem, asp.Force(2.0), asp.rolling.Creepage(1.2e-4, 5e-5, 0.2), direction="-x", start=again)
    assert further.converged
