"""Expressions of studies: values, units, letters, axes that they set, derived numbers."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused
from study_cases import LOADS, SEEDS, InProcess, plan, study

from asperity.core.errors import InputError
from asperity.core.units import DIMENSIONS, dimension, unit_of
from asperity.studies.campaign import Campaign, prepare_study
from asperity.studies.expressions import Expression
from asperity.studies.places import edited
from asperity.studies.run import carry_out

UNITS = {"p": "Pa", "beta": "m", "E2": "Pa", "sigma": "m", "k": "m**2/N", "g": "N/m", "x": "1", "T": "K"}
LETTERS = {
    "p": "control.mean_pressure",
    "beta": "surface.spectrum.correlation_length",
    "sigma": "surface.spectrum.rms_height",
    "E2": "body.base.youngs_modulus",
}
HEIGHTS = {"path": "surface.spectrum.rms_height", "values": ["1 nm", "2 nm"]}
TEXT = "p * beta / (E2 * sigma)"


@pytest.mark.parametrize(
    ("text", "unit"),
    [
        (TEXT, "1"),
        ("p * beta", "N/m"),
        ("sqrt(E2 * p)", "Pa"),
        ("k * p", "1"),
        ("beta + 2*sigma", "m"),
        ("g / (p * beta)", "1"),
        ("pi * beta**2 / 4", "m**2"),
        ("log(p/E2) - exp(x) * log10(x)", "1"),
        ("2**(p/E2)", "1"),
        ("-abs(beta)**1.5", "m**1.5"),
        ("p * T", "mass*temperature"),
        ("1 / beta**2", "1/m**2"),
    ],
)
def test_units_follow_from_those_of_the_names(text: str, unit: str) -> None:
    found = Expression(text, "expression of X").unit(UNITS)
    if unit == "mass*temperature":
        assert dimension(found).powers == (("length", -1.0), ("mass", 1.0), ("temperature", 1.0), ("time", -2.0))
    else:
        assert found == unit


@pytest.mark.parametrize("unit", [unit for kind, unit in DIMENSIONS.items() if kind not in ("memory", "number")])
def test_every_unit_of_the_package_has_a_dimension_that_leads_back(unit: str) -> None:
    assert dimension(unit_of(dimension(unit))) == dimension(unit)


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("p + beta", ("'p' in Pa", "'beta' in m")),
        ("log(p)", ("Pa",)),
        ("p**sigma", ("sigma", "m")),
        ("beta**(p/E2)", ("beta ** (p / E2)",)),
    ],
)
def test_unlike_units_are_refused(text: str, shown: tuple[str, ...]) -> None:
    with refused(InputError, "expression of X", *shown):
        Expression(text, "expression of X").unit(UNITS)


@pytest.mark.parametrize(
    "text",
    [
        *("", "a b", "p[0]", "p.x", "lambda: 1", "'x'", "sqrt(1, 2)", "1j", "True", "__import__('os')"),
        *("(" * 300 + "p" + ")" * 300, "1 < 2", "[p]", "max(p, E2)", "p;E2", "x := 1", "p if x else p"),
    ],
)
def test_what_is_no_formula_is_refused(text: str) -> None:
    with refused(InputError, "expression of X"):
        Expression(text, "expression of X")


@given(st.floats(0.1, 10.0), st.floats(0.1, 10.0), st.floats(0.1, 10.0))
def test_values_are_those_of_python(a: float, b: float, c: float) -> None:
    made = Expression("a**2 / (b - -c) + sqrt(a*b) * log(c) - pi", "x").value({"a": a, "b": b, "c": c})
    assert float(made) == pytest.approx(a**2 / (b + c) + np.sqrt(a * b) * np.log(c) - np.pi, rel=1e-14, abs=1e-14)


@given(st.floats(0.1, 10.0), st.floats(0.1, 10.0), st.floats(0.1, 10.0))
def test_slopes_are_those_of_differences(a: float, b: float, c: float) -> None:
    """Central differences with a step h have an error of h² and of the digits over h."""
    made = Expression("a**2 / (b + c) - sqrt(a*b) * log10(c) + abs(-c)**b * exp(-b) - 3**2 + log(a)", "x")
    at, along = {"a": a, "b": b, "c": c}, {"a": 1.0, "b": -0.5, "c": 0.3}
    h = 1e-5 * min(at.values())
    ends = [made.value({name: at[name] + sign * h * along[name] for name in at}) for sign in (1.0, -1.0)]
    room = 1e-9 * max(map(abs, ends)) / h * 1e-5
    assert float(made.slope(at, along)) == pytest.approx((ends[0] - ends[1]) / (2.0 * h), rel=1e-6, abs=room)


def test_slopes_of_what_does_not_change_are_zero() -> None:
    made = Expression("(a - 1)**0.5 + x**2 + 2**x", "x")
    assert float(made.slope({"a": 1.0, "x": 0.0}, {"a": 0.0, "x": 1.0})) == pytest.approx(np.log(2.0))


def test_derived_numbers_lie_on_the_axes(tmp_path: Path) -> None:
    derived = {
        "X": TEXT,
        "Y": {"expression": "max_pressure * beta / (E2 * sigma)", "label": "normalised largest pressure"},
        "twice": "2 * Y",
    }
    axes = [LOADS, HEIGHTS, SEEDS]
    campaign = prepare_study(study(axes=axes, letters=LETTERS, derived=derived, quantities=["approach"]), tmp_path)
    assert campaign.plan.columns == ("approach", "Y", "twice")
    carry_out(campaign.plan, campaign.records, InProcess())
    data = campaign.dataset()
    assert data["X"].dims == ("control_mean_pressure", "spectrum_rms_height", "seed")
    p, sigma = (
        np.asarray(data["control_mean_pressure"])[:, None, None],
        np.asarray(data["spectrum_rms_height"])[None, :, None],
    )
    assert np.asarray(data["X"]) == pytest.approx(np.broadcast_to(p * 1e-6 / (200e9 * sigma), (3, 2, 4)), rel=1e-12)
    assert np.asarray(data["Y"]) == pytest.approx(np.asarray(data["max_pressure"]) * 1e-6 / (200e9 * sigma), rel=1e-12)
    assert np.asarray(data["twice"]) == pytest.approx(2.0 * np.asarray(data["Y"]), rel=1e-15)
    assert (data["X"].attrs["units"], data["Y"].attrs["long_name"]) == ("1", "normalised largest pressure")
    again = Campaign(tmp_path, campaign.study)
    assert json.dumps(data["Y"].values.tolist()) == json.dumps(again.dataset()["Y"].values.tolist())


def test_an_axis_sets_a_scalar_by_the_others() -> None:
    """Equal X of two rms heights are loads in their ratio; loads rise along a path."""
    axis = {"path": "control.mean_pressure", "name": "X", "values": [2e-3, 1e-3], "expression": "X * E2 * sigma / beta"}
    letters = {key: path for key, path in LETTERS.items() if key != "p"}
    made = plan(axes=[HEIGHTS, axis], letters=letters, derived={"again": "X"})
    found = {}
    for path in made.paths():
        loads = []
        for case in path:
            loads.append(edited(made.table, case.edits)["control"]["mean_pressure"])
            found[case.index] = float(loads[-1].split()[0])
        assert [float(load.split()[0]) for load in loads] == sorted(float(load.split()[0]) for load in loads)
    wanted = {(i, j): x * 200e9 * h / 1e-6 for i, h in enumerate((1e-9, 2e-9)) for j, x in enumerate((2e-3, 1e-3))}
    assert found == pytest.approx(wanted, rel=1e-12)
    keys = {case.key for path in made.paths() for case in path}
    plainly = plan(axes=[{"path": "control.mean_pressure", "values": [f"{v!r} Pa" for v in (400.0, 200.0)]}])
    assert len(keys) == 4
    assert plainly.shape == (2,)


@pytest.mark.parametrize(
    ("changes", "subject"),
    [
        ({"letters": {"p": "control.pressure"}}, "path"),
        ({"letters": {"2p": "control.mean_pressure"}}, "letter of a study"),
        ({"derived": {"X": "p * unknown"}}, "expression of X"),
        ({"derived": {"X": "p + sigma"}}, "expression of X"),
        ({"derived": {"seed": "2 * p"}}, "name of a derived number"),
        ({"derived": {"approach": "2 * p"}}, "name of a derived number"),
        (
            {"axes": [SEEDS, {**LOADS, "values": [1, 2], "name": "q", "expression": "q * sigma"}]},
            "expression of the axis q",
        ),
        ({"axes": [SEEDS, {**LOADS, "values": [1], "name": "q", "expression": "p"}]}, "expression of the axis q"),
        (
            {"axes": [SEEDS, {**LOADS, "values": [0.0], "name": "q", "expression": "E2 / q"}]},
            "expression of the axis q",
        ),
        (
            {"axes": [SEEDS, {**LOADS, "name": "q", "expression": "q * E2"}]},
            "value of the axis q, which an expression takes,",
        ),
    ],
)
def test_mistakes_are_found_before_any_case(changes: dict[str, object], subject: str) -> None:
    with refused(InputError, subject):
        plan(**{"axes": [LOADS, SEEDS], "letters": LETTERS, **changes})


def test_a_letter_without_a_number_in_the_problem_is_refused() -> None:
    with refused(InputError, "solver.threads"):
        plan(axes=[LOADS], letters={"n": "solver.threads"}, derived={"Z": "n * approach"})
