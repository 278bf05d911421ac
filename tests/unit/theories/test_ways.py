"""How theories are asked: every way of every theory answers, quickly, with its limits."""

from __future__ import annotations

import numpy as np
import pytest
from refusals import refused
from theory_cases import EXAMPLES, GIVEN, RANGES

import asperity as asp
from asperity.core.citations import reference
from asperity.core.parameters import parameters
from asperity.theories import FAMILIES, THEORIES, evaluate, theory
from asperity.theories.ask import ways_of
from asperity.theories.catalogue import nearest

WAYS = [(name, way) for name, kind in THEORIES.items() for way in ways_of(kind)]


def made(name: str):
    return theory(name)(**EXAMPLES[name])


@pytest.mark.parametrize(("name", "way"), WAYS, ids=lambda item: getattr(getattr(item, "axis", None), "name", item))
def test_every_way_of_every_theory_answers(name, way):
    low, high = RANGES[way.axis.name]
    values = np.linspace(low, high, 200)
    given = {item.name: GIVEN[item.name] for item in way.given if item.required}
    model = made(name)
    found = evaluate(model, **{way.axis.name: values}, **given)
    axis, first = found.columns[0]
    assert axis.name == way.axis.name
    assert first == pytest.approx(values)
    assert len(found.columns) > 1
    for column, numbers in found.columns:
        assert numbers.shape == values.shape
        assert column.label
        assert not np.isnan(numbers).all()
    for limit in found.limits:
        assert np.broadcast_to(limit.value, values.shape).shape == values.shape
        assert reference(limit.citation)


@pytest.mark.parametrize("name", THEORIES)
def test_every_theory_can_be_asked_and_cited(name):
    kind = theory(name)
    assert ways_of(kind) or kind.numbers
    names = [item.name for item in parameters(kind)]
    axes = {item.name for way in ways_of(kind) for item in (way.axis, *way.given)}
    assert not axes & set(names), "an option cannot be both"
    model = made(name)
    assert asp.cite(model) == asp.cite(kind)
    assert all(f"[{key}]" in asp.cite(model) for key in kind.citation_keys)
    if kind.numbers:
        found = evaluate(model)
        assert len(found.numbers) == len(kind.numbers)
        assert all(np.isfinite(value) for _, value in found.numbers)
        assert found.columns == ()


def test_the_families_hold_every_theory_once():
    names = [kind.name for family in FAMILIES.values() for kind in family]
    assert sorted(names) == sorted(set(names)) == sorted(THEORIES)
    assert list(EXAMPLES) == list(THEORIES)


NO_NUMBERS = (
    "1MPa",
    "1",
    b"1",
    ["1"],
    None,
    True,
    1j,
    {},
    {1.0},
    object(),
    [[1.0], [1.0, 2.0]],
    np.datetime64("2026-01-01"),
)


def test_no_theory_takes_what_is_not_a_number():
    """Every argument of every way of the catalogue: text, truth values, complex numbers and other
    things are refused."""
    taken = []
    for name, way in WAYS:
        arguments = {item.name: 1.0 if item.required else item.default for item in (way.axis, *way.given)}
        for argument in arguments:
            for wrong in NO_NUMBERS:
                try:
                    getattr(made(name), way.method)(**arguments | {argument: wrong})
                except asp.InputError:
                    continue
                taken.append((name, argument, wrong))
    assert taken == []


def test_an_answer_is_that_of_the_theory():
    model = made("hertz")
    found = {column.name: values for column, values in evaluate(model, load=[1e-6, 1e-5]).columns}
    answer = model.at_load([1e-6, 1e-5])
    assert found["approach"].tolist() == answer.approach.tolist()
    assert found["mean_pressure"].tolist() == answer.mean_pressure.tolist()
    nayak = {column.name: value for column, value in evaluate(made("nayak")).numbers}
    assert nayak["density"] == made("nayak").density


def test_what_a_theory_does_not_define_is_left_out():
    columns = [column.name for column, _ in evaluate(made("hertz-line"), load=1.0).columns]
    assert "approach" not in columns
    assert "max_pressure" in columns


@pytest.mark.parametrize(
    ("name", "arguments", "subject", "shown"),
    [
        ("hertz", {}, "hertz", "nothing"),
        ("hertz", {"pressure": 1e6}, "hertz", "pressure"),
        ("hertz-stress", {"depth": 1e-9}, "hertz-stress", "load"),
        ("sampled-peaks", {"load": 1.0}, "sampled-peaks", "nothing"),
        ("mindlin", {"tangential": 1e-7, "load": [1.0, 2.0]}, "load", "2"),
        ("boussinesq", {"depth": 0.0}, "depth (m)", "0"),
        ("hertz", {"load": -1.0}, "load (N)", "-1"),
    ],
)
def test_what_cannot_be_asked_is_refused(name, arguments, subject, shown):
    with refused(asp.InputError, subject, shown):
        evaluate(made(name), **arguments)


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("gw", "greenwood-williamson"),
        ("BGT", "bush-gibson-thomas"),
        ("herz", "hertz"),
        ("HertzPoint", "hertz"),
        ("greenwood_wiliamson", "greenwood-williamson"),
        ("meniscus", "statistical-meniscus"),
    ],
)
def test_names_that_are_meant_are_found(written, meant):
    assert meant in nearest(written)
    with refused(asp.InputError, "name of a theory", meant):
        theory(written)


def test_a_name_like_no_other_is_answered_with_all():
    with refused(asp.InputError, "name of a theory"):
        theory("xxxxxx")
