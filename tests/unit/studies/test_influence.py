"""Which axis decides a quantity, and where all limits hold."""

from __future__ import annotations

import itertools
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused
from study_cases import LOADS, SEEDS, InProcess, plan, study

from asperity.core.errors import InputError
from asperity.core.quantity import Limit
from asperity.report.study import sentences
from asperity.studies.campaign import prepare_study
from asperity.studies.influence import influence, region
from asperity.studies.run import carry_out


def test_a_power_law_has_the_shares_of_its_exponents() -> None:
    """ln(p^2 t) has the variances 4 var ln p and var ln t, and nothing together."""
    p, t = np.geomspace(1.0, 100.0, 5), np.geomspace(2.0, 4.0, 3)
    found = influence(p[:, None] ** 2 * t[None, :], ["p", "t"])
    parts = 4.0 * np.log(p).var(), np.log(t).var()
    assert found is not None
    assert found.logarithmic
    assert dict(found.shares) == pytest.approx({"p": parts[0] / sum(parts), "t": parts[1] / sum(parts)}, rel=1e-12)
    assert found.together == pytest.approx(0.0, abs=1e-12)
    assert [name for name, _ in found.shares] == ["p", "t"]


def test_a_product_of_signs_is_decided_by_both_together() -> None:
    sign = np.array([-1.0, 1.0])
    found = influence(sign[:, None] * sign[None, :], ["a", "b"])
    assert found is not None
    assert not found.logarithmic
    assert found.together == pytest.approx(1.0)


@pytest.mark.parametrize("values", [np.ones((2, 3)), np.array([[1.0, np.nan], [2.0, 3.0]])])
def test_what_does_not_vary_or_is_missing_has_none(values: np.ndarray) -> None:
    assert influence(values, ["a", "b"]) is None


@given(st.lists(st.booleans(), min_size=12, max_size=12))
def test_the_region_is_the_largest_block_within_the_limits(cells: list[bool]) -> None:
    within = np.array(cells).reshape(3, 4)
    found = region(within)
    assert (found.fitting, found.cases) == (int(within.sum()), 12)
    blocks = [
        (last - first + 1) * (end - begin + 1)
        for first, last in itertools.combinations_with_replacement(range(3), 2)
        for begin, end in itertools.combinations_with_replacement(range(4), 2)
        if within[first : last + 1, begin : end + 1].all()
    ]
    assert math.prod(last - first + 1 for first, last in found.ranges) == max(blocks, default=1)
    if blocks:
        (first, last), (begin, end) = found.ranges
        assert within[first : last + 1, begin : end + 1].all()


def test_large_grids_have_a_block_too() -> None:
    within = np.ones((40, 40, 40), dtype=bool)
    within[20:] = False
    found = region(within)
    (first, last), *others = found.ranges
    assert first == 0
    assert 10 <= last <= 19
    assert others == [(0, 39), (0, 39)]


def test_a_sweep_says_where_limits_hold_and_what_decides(tmp_path: Path) -> None:
    thickness = {"path": "body.layers.0.thickness", "values": ["1 nm", "10 nm", "100 nm"]}
    loads = {**LOADS, "values": ["1 MPa", "2 MPa", "50 MPa"]}
    tables = {"axes": [loads, thickness], "quantities": ["max_pressure", "area_fraction"]}
    campaign = prepare_study(study(**tables, limits=[{"quantity": "area_fraction", "at_most": 0.2}]), tmp_path)
    carry_out(campaign.plan, campaign.records, InProcess())
    data = campaign.dataset()
    within = np.asarray(data["area_fraction"]) <= 0.2
    assert 0 < within.sum() < within.size
    where, *decided = sentences(campaign, data)
    assert where.startswith(f"{within.sum()} of 9 cases")
    assert len(decided) == 2
    assert decided[1].startswith("Mean pressure decides ")  # the area hardly depends on so thin a layer


@pytest.mark.parametrize(
    ("limit", "subject"),
    [
        ({"quantity": "max_presure", "at_most": "1 GPa"}, "quantity of a limit"),
        ({"quantity": "max_pressure", "at_most": 1e9}, "limit of max_pressure"),
        ({"quantity": "max_pressure", "at_most": "1 nm"}, "limit of max_pressure"),
        ({"quantity": "area_fraction", "at_least": "1 nm"}, "limit of area_fraction"),
        ({"quantity": "X", "at_least": 1.0, "at_most": 2.0}, "study document: limits[1]"),
    ],
)
def test_limits_without_sense_are_refused(limit: dict[str, object], subject: str) -> None:
    with refused(InputError, subject):
        plan(axes=[LOADS, SEEDS], limits=[limit])


def test_limits_are_in_si() -> None:
    made = plan(axes=[LOADS], limits=[{"quantity": "max_pressure", "at_most": "3 GPa"}])
    assert made.limits == (("max_pressure", Limit(3e9, least=False)),)


def test_what_all_cases_would_miss_is_refused_before_the_first(tmp_path: Path) -> None:
    bare = {**study()["problem"], "body": "E=100GPa,nu=0.3", "law": {"kind": "hardness", "hardness": "from body"}}
    with refused(InputError, "study"):
        prepare_study(study(problem=bare, axes=[LOADS]), tmp_path / "a")
    assert not (tmp_path / "a").exists()
    # an axis may bring what the problem lacks
    prepare_study(study(problem=bare, axes=[{"path": "law.hardness", "values": ["1 GPa", "2 GPa"]}]), tmp_path / "b")


def test_one_case_in_the_middle_that_can_be_prepared_is_enough() -> None:
    """Neither of the materials at the ends of the axis has a hardness, and the problem has none."""
    soft = {**study()["problem"], "body": {"material": "PDMS"}, "law": {"kind": "hardness", "hardness": "from body"}}
    materials = {"path": "body.material", "values": ["PDMS", "glass", "rubber"]}
    assert plan(problem=soft, axes=[materials, LOADS]).refused() == ""
    assert "hardness" in plan(problem=soft, axes=[{**materials, "values": ["PDMS", "rubber"]}, LOADS]).refused()
