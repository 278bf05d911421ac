"""Parameters that are declared once, in a signature: what follows from a declaration."""

from __future__ import annotations

import copy
import math
import pickle
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
import pytest
from refusals import refused

from asperity import InputError
from asperity.core import units
from asperity.core.parameters import REQUIRED, Declared, Help, checked, parameters
from asperity.core.values import (
    Choice,
    Count,
    Density,
    Humidity,
    Interval,
    Length,
    Lengths,
    Number,
    Numbers,
    PoissonRatio,
    Pressure,
    Several,
    Values,
    Whole,
    Written,
    WrittenPair,
)


@checked
def punch(
    grid: object,
    *,
    radius: Annotated[Length, "Radius"],
    edge: Annotated[float | None, Number("length", least=0.0), "Radius of the edge"] = None,
    axis: Annotated[Literal["x", "y"], "Axis"] = "y",
    pitch: Annotated[tuple[Length, Length], "Distances"] = (1.0, 2.0),
    waves: Annotated[Count, Help("Waves", option="--n")] = 3,
    longest: Annotated[float, Number("length", above=0.0, infinite=True)] = math.inf,
    plain: object = None,
) -> tuple[Any, ...]:
    """Flat punch."""
    return radius, edge, axis, pitch, waves, longest


@dataclass(frozen=True)
class Ball(Declared):
    """Ball on a flat."""

    modulus: Annotated[Pressure, Help("contact modulus", of="bodies")]
    nu: Annotated[PoissonRatio, "Poisson's ratio"] = 0.3
    name: ClassVar[str] = "ball"


def test_declarations_are_read_from_signatures() -> None:
    found = {item.name: item for item in parameters(punch)}
    assert list(found) == ["radius", "edge", "axis", "pitch", "waves", "longest"]  # grid and plain declare nothing
    assert (found["radius"].unit, found["radius"].required, found["radius"].help) == ("m", True, "Radius")
    assert (found["edge"].default, found["edge"].unit) == (None, "m")
    assert list(found["axis"].values.words) == ["x", "y"]
    assert found["pitch"].values == Several(Number("length", above=0.0), 2)
    assert (found["waves"].option, found["waves"].default) == ("--n", 3)
    modulus, nu = parameters(Ball)
    assert (modulus.of, modulus.default, nu.default) == ("bodies", REQUIRED, 0.3)


def test_arguments_reach_the_function_in_their_canonical_type() -> None:
    assert punch(None, radius=2, waves=4.0)[0] == 2.0  # type: ignore[arg-type]
    radius, *_, waves, longest = punch(None, radius=np.float32(0.5), waves=np.int64(4))  # type: ignore[arg-type]
    assert (type(radius), type(waves), longest) == (float, int, math.inf)


@pytest.mark.parametrize(
    ("arguments", "name", "received"),
    [
        ({"radius": 0.0}, "radius (m) of punch()", "0.0"),
        ({"radius": math.nan}, "radius (m) of punch()", "nan"),
        ({"radius": math.inf}, "radius (m) of punch()", "inf"),
        ({"radius": None}, "radius (m) of punch()", "None"),
        ({"radius": "5 nm"}, "radius (m) of punch()", "'5 nm'"),
        ({"radius": True}, "radius (m) of punch()", "True"),
        ({"radius": 1.0, "edge": -1.0}, "edge (m) of punch()", "-1.0"),
        ({"radius": 1.0, "axis": "z"}, "axis of punch()", "'z'"),
        ({"radius": 1.0, "pitch": (1.0,)}, "pitch (m) of punch()", "(1.0,)"),
        ({"radius": 1.0, "pitch": (1.0, -1.0)}, "pitch (m) of punch()", "-1.0"),
        ({"radius": 1.0, "waves": 0}, "waves of punch()", "0"),
        ({"radius": 1.0, "waves": 1.5}, "waves of punch()", "1.5"),
    ],
)
def test_bad_arguments_are_named_and_shown(arguments: dict[str, Any], name: str, received: str) -> None:
    with pytest.raises(InputError) as caught:
        punch(None, **arguments)
    assert str(caught.value).startswith(name + " must be ")
    assert received in str(caught.value)


def test_a_declared_dataclass_checks_itself() -> None:
    assert Ball(1, 0.5).modulus == 1
    for arguments, subject in (
        ((-1.0,), "modulus (Pa) of ball"),
        ((1.0, 0.51), "nu of ball"),
        ((1.0, -1.0), "nu of ball"),
        (("1 MPa",), "modulus (Pa) of ball"),
    ):
        with refused(InputError, subject, str(arguments[-1])):
            Ball(*arguments)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("values", "text", "value"),
    [
        (Number("length", above=0.0), "5 nm", 5e-9),
        (Number("N/m^2"), "-1 kPa", -1e3),
        (Number(), "0.3", 0.3),
        (Number(), "30%", 0.3),
        (Number("number", percent=True, below=1.0), "80 %", 0.8),
        (Number("pressure", words=("from body",)), "from body", "from body"),
        (Whole(0), " 12 ", 12),
        (Choice({"wide": 1.5, "narrow": 0.5}), "wide", 1.5),
        (Several(Number("length")), "1nm, 2 nm", (1e-9, 2e-9)),
        (Several(Number("length"), 2), ["1nm", "2nm"], (1e-9, 2e-9)),
        (Lengths(), "2 um x 1 um", (2e-6, 1e-6)),
        (Numbers(), "256x128", (256, 128)),
        (Numbers(), "256", (256, 256)),
        (Numbers(), [3, 4], (3, 4)),
        (Interval(), "0um:5um", (0.0, 5e-6)),
    ],
)
def test_text_is_read(values: Values, text: Any, value: Any) -> None:
    assert values.read(text, "x") == pytest.approx(value, rel=1e-14) if not isinstance(value, str) else value


@pytest.mark.parametrize(
    ("values", "text", "shown"),
    [
        (Number("length", above=0.0), "0 nm", "'0 nm'"),
        (Number("length"), "5", "'5' without"),
        (Number("length"), 5.0, "5.0"),
        (Number("length"), "5 kPa", "'kPa'"),
        (Number("length", words=("max",)), "most", "'most'"),
        (Number(least=0.0, most=1.0), 2, "2"),
        (Number("number", above=0.0, below=1.0, percent=True), "60", "60%"),
        (Whole(3, odd=True), 4, "odd"),
        (Whole(0, 20), "21", "0 to 20"),
        (Whole(1), "²", "'²'"),
        (Whole(1), 3.0, "3.0"),
        (Choice({"a": 1}), "b", "b"),
        (Several(Number(), 2), "1", "2"),
        (Lengths(), "20 um x 0 um", "'20 um x 0 um'"),
        (Numbers(), "0x3", "'0x3'"),
        (Numbers(), [3, 0], "[3, 0]"),
        (Interval(), "5um:1um", "from '5um' to '1um'"),
    ],
)  # fmt: skip
def test_text_that_cannot_be_used_is_refused(values: Values, text: Any, shown: str) -> None:
    with refused(InputError, "--option", shown):
        values.read(text, "--option")


def test_a_number_that_was_written_keeps_its_text() -> None:
    made = Number("length").read("5 nm", "x")
    assert isinstance(made, Written)
    for same in (made, copy.deepcopy(made), pickle.loads(pickle.dumps(made))):
        assert (same, same.text) == (5e-9, "5 nm")  # type: ignore[union-attr]
    assert type(units.parse(made, "length", "x")) is float
    pair = pickle.loads(pickle.dumps(Lengths().read("2 um x 1 um", "x")))
    assert isinstance(pair, WrittenPair)
    assert (pair.text, units.parse_size(pair)) == ("2 um x 1 um", pair)


def test_units_of_declarations() -> None:
    units_of = [parameter.unit for parameter in parameters(_several)]
    assert units_of == ["1/m^2", "N/m", ""]


def _several(density: Density, line_load: Annotated[float, Number("N/m")], humidity: Humidity) -> None:
    """Numbers with units of all kinds."""
