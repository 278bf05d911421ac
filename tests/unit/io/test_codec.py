"""Every kind of answer comes back from labelled values as it was, and steps from their rows."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from refusals import refused
from stored_cases import CASES, told

import asperity as asp
from asperity.contact.answer import Answer
from asperity.contact.tangential import Shift
from asperity.core.errors import FileFormatError
from asperity.core.quantity import given, measured
from asperity.core.registry import ANSWERS, home
from asperity.io.codec import HERE, Steps, answer_kind, group_of, made_of, steps_group, values_in

PATHS = ("wet", "adhesive", "creeping", "sticking", "flowing")


@pytest.fixture(scope="module")
def paths() -> dict[str, Any]:
    return {name: CASES[name]() for name in PATHS}


@pytest.mark.parametrize("name", PATHS)
def test_answers_of_every_step(name: str, paths: dict[str, Any]) -> None:
    for step in paths[name]:
        assert step.couplings
        for found in step.couplings.values():
            if found is None:
                continue
            node = group_of(found)
            kind = answer_kind(node.attributes["kind"])
            again = made_of(kind, values_in(node), kind.given_by(step.problem))
            assert told(again) == told(found)


@pytest.mark.parametrize("name", PATHS)
def test_steps_of_a_history(name: str, paths: dict[str, Any]) -> None:
    """Also where the first step has nothing, and rows are of another length in each."""
    path = paths[name]
    for key in path.last.couplings:
        found = [step.couplings.get(key) for step in path]
        if found[-1] is None:
            continue
        found[0] = None
        node = steps_group(found, type(found[-1]), [0, 2, 1])
        assert node[HERE].tolist() == [0, 2, 1]
        steps, kind = Steps(node), answer_kind(node.attributes["kind"])
        for number in (1, 2):
            again = made_of(kind, steps.at(number), kind.given_by(path.last.problem))
            assert told(again) == told(found[number])


def test_every_answer_of_the_package_is_listed() -> None:
    """A subclass that no file could name would be lost."""
    listed = {home(place) for place in ANSWERS}
    assert {kind for kind in Answer.__subclasses__() if kind.__module__.startswith("asperity.")} == listed


@dataclass(frozen=True, eq=False)
class Row:
    name: str
    value: float = measured("m", "value")
    pair: tuple[float, float] = measured("m", "two values", "end")


@dataclass(frozen=True, eq=False)
class Odd(Answer):
    """What one could give of one's own."""

    law: str = given()
    flag: bool
    text: str
    rows: tuple[Row, ...]
    numbers: tuple[float, ...]
    counts: tuple[int, ...]
    array: asp.core.arrays.RealArray = measured("Pa", "array of its own length", "place", "part")
    shift: Shift | None = None


@pytest.mark.parametrize("rows", [(), (Row("ü", 1.0, (2.0, np.nan)), Row("", -0.0, (0.0, np.inf)))])
def test_an_answer_of_ones_own(rows: tuple[Row, ...]) -> None:
    shift = Shift(1.0, 2.0) if rows else None
    odd = Odd("given", True, "µ", rows, (0.1, 0.2), (3,), np.ones((2, 3), dtype=np.float32), shift)
    node = group_of(odd)
    assert "law" not in node
    assert {item.quantity.unit for item in node.values if item.quantity.name == "array"} == {"Pa"}
    again = made_of(answer_kind(node.attributes["kind"]), values_in(node), {"law": "given"})
    assert told(again) == told(odd)
    assert type(again.counts[0]) is int
    other = Odd("given", False, "", (), (), (), np.ones((0, 3), dtype=np.float32), None)
    steps = Steps(steps_group([other, odd, other], Odd, [1, 1, 1]))
    assert told(made_of(Odd, steps.at(1), {"law": "given"})) == told(odd)
    assert told(made_of(Odd, steps.at(2), {"law": "given"}))[".array"] == told(other)[".array"]


def test_values_of_a_wrong_type() -> None:
    odd = Odd("given", True, "µ", (), (), (), np.ones((2, 3)), None)
    values = values_in(group_of(odd))
    for bad in ({"text": 1.0}, {"flag": "yes"}):
        with pytest.raises((ValueError, TypeError)):
            made_of(Odd, values | bad, {"law": ""})
    with pytest.raises(KeyError):
        made_of(Odd, {key: value for key, value in values.items() if key != "text"}, {"law": ""})


def test_nothing_is_imported_that_a_file_names() -> None:
    code = (
        "import sys\nfrom asperity.io.codec import answer_kind\nfrom asperity.core.errors import FileFormatError\n"
        "for name in ('turtle:Turtle', 'asperity.web.app:Answer', 'os:system', ''):\n"
        "    try:\n        answer_kind(name)\n        print('found', name)\n"
        "    except FileFormatError:\n        pass\n"
        "print('turtle' in sys.modules)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["False"]
    with refused(FileFormatError, "answer in a result file", "'turtle:Turtle'"):
        answer_kind("turtle:Turtle")
