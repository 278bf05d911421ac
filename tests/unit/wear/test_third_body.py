"""Debris in the gap: a uniform layer is a bed of springs, and what stays does not widen the gap."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.contact.operators import prepare_operator
from asperity.contact.problem import ContactProblem
from asperity.contact.solvers.active_set.solver import ActiveSet
from asperity.contact.solvers.protocol import ContactQP, FixedMean, run
from asperity.core.errors import InputError
from asperity.physics.wear.operator import WearOperator
from asperity.wear import Debris, Sides, ThirdBody, WearSteps, archard, worn

POINTS, SIDE = 48, 4e-6


def rough() -> ContactProblem:
    """A self-affine surface of steel."""
    waves = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(10e-9), hurst=0.8, rolloff_wavelength=1e-6, shortest_wavelength=300e-9
    )
    surface = asp.generate.gaussian(asp.Grid((POINTS, POINTS), (SIDE / POINTS,) * 2), waves, seed=4)
    return ContactProblem(surface, asp.Elastic(210e9, 0.3))


@pytest.mark.parametrize("ratio", [0.3, 3.0, 30.0])
def test_a_layer_is_a_bed_of_springs(ratio: float) -> None:
    """Rounds of compression and contact agree with one contact of the compliance K + t/M, whatever
    the layer's compliance over that of the shortest wave; a map as well."""
    problem, control = rough(), asp.MeanPressure(300e6)
    operator = prepare_operator(problem.compliance, problem.grid, problem.boundary)
    bed = ratio * operator.smallest * np.linspace(0.5, 1.5, POINTS)[:, None] * np.ones((1, POINTS))
    layered = asp.solve(replace(problem, physics=(ThirdBody(1e-7 * bed / bed.mean(), 1e-7 / bed.mean()),)), control)
    height = float(problem.profile().std())
    qp = ContactQP(WearOperator(operator, bed), problem.profile(), np.inf, FixedMean(300e6), height)
    once = run(ActiveSet(), qp)
    # the pressure of both is to the root of the relative error of the energy, 1e-7
    assert layered.pressure == pytest.approx(once.state.pressure, abs=1e-3 * float(once.state.pressure.max()))
    assert layered.third_body is not None
    wanted = bed * layered.pressure
    off = np.linalg.norm(layered.third_body.compression - wanted) / np.linalg.norm(wanted)
    assert off < 1.01e-6, "the tolerance of the rounds"
    area = problem.grid.pixel_area
    assert layered.third_body.energy == pytest.approx(0.5 * area * float((bed * layered.pressure**2).sum()), rel=1e-4)


def test_debris_slows_the_wear_of_the_gap_not_of_the_bodies() -> None:
    """The volume is k P s with and without; the gap widens by what has left, and the layer lies
    where it was worn off."""
    problem, control, distance = rough(), asp.MeanPressure(300e6), 0.02
    steps = WearSteps(number=6)
    without = worn(problem, control, distance, archard(1e-15), steps=steps)
    sides = Sides(body=archard(1e-15), debris=Debris(0.5, 50e9))
    with_debris = worn(problem, control, distance, sides, steps=steps)
    assert with_debris.worn_volume == pytest.approx(without.worn_volume, rel=1e-12)
    last = with_debris.last.problem
    change = problem.profile() - last.profile()
    assert change == pytest.approx(0.5 * with_debris.depth, rel=1e-9, abs=1e-18)
    layer = next(item for item in last.physics if isinstance(item, ThirdBody))
    assert layer.thickness == pytest.approx(0.5 * with_debris.depth)
    again = asp.solve(last, control)
    assert again.pressure == pytest.approx(with_debris.last.pressure, abs=2e-3 * again.max_pressure)


def test_debris_that_is_stiff_and_stays_little_is_none() -> None:
    problem, control = rough(), asp.MeanPressure(300e6)
    steps = WearSteps(number=4)
    sides = Sides(body=archard(1e-15), debris=Debris(1e-6, 1e15))
    little = worn(problem, control, 0.01, sides, steps=steps)
    none = worn(problem, control, 0.01, archard(1e-15), steps=steps)
    assert little.depth == pytest.approx(none.depth, abs=1e-4 * float(none.depth.max()))


@pytest.mark.parametrize(
    ("make", "subject"),
    [
        (lambda: Debris(1.0, 1e9), "share of the debris that stays"),
        (lambda: Debris(0.5, 0.0), "modulus of the debris (Pa)"),
        (lambda: ThirdBody(-np.ones((2, 2)), 1e9), "thickness of a third body (m)"),
        (lambda: ThirdBody(np.ones((2, 2)), -1e9), "modulus of a third body (Pa)"),
        (
            lambda: Sides(archard(1e-15), archard(1e-15), counter_track=1.0, debris=Debris(0.5, 1e9)),
            "debris of a contact that wears",
        ),
        (lambda: replace(rough(), physics=(ThirdBody(np.ones((2, 2)), 1e9),)), "thickness of a third body (m)"),
    ],
)
def test_what_is_no_third_body_is_refused(make: object, subject: str) -> None:
    with refused(InputError, subject):
        make()  # type: ignore[operator]


def test_a_file_holds_the_layer(tmp_path: Path) -> None:
    problem = replace(rough(), physics=(ThirdBody(np.full((POINTS, POINTS), 1e-8), 1e11),))
    result = asp.solve(problem, asp.MeanPressure(100e6))
    asp.save(result, tmp_path / "layer.nc")
    found = asp.load(tmp_path / "layer.nc")
    assert np.array_equal(found.third_body.compression, result.third_body.compression)
    assert np.array_equal(found.problem.physics[0].thickness, problem.physics[0].thickness)
    assert found.to_xarray()["contact"]["ThirdBody_thickness"].attrs["units"] == "m"


def test_the_work_of_a_load_path_is_stored_in_bodies_and_layer() -> None:
    """What the load does over the approach is the elastic energy of both, to the second order of
    the trapezoidal rule."""
    problem = replace(rough(), physics=(ThirdBody(np.full((POINTS, POINTS), 5e-8), 50e9),))
    errors = []
    for steps in (8, 16):
        path = asp.solve(problem, asp.History.ramps(asp.MeanPressure, [300e6], steps=steps))
        errors.append(path.energies.relative_error)
    assert errors[1] < 0.02
    assert errors[1] < 0.4 * errors[0]
