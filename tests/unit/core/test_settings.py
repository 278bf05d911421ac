"""Tables of documents whose values are declared: reading, writing, and messages."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import pytest

from asperity import InputError
from asperity.core.parameters import checked
from asperity.core.settings import Settings, declared, setting, table_of, validated
from asperity.core.values import Count, Length, NonNegative, Points, Size, Written


class Film(Settings):
    """A film."""

    thickness: Length | None = setting(None, option="--film", help="Thickness of the film")
    friction: NonNegative = setting(0.0, help="Dry coefficient")
    depths: tuple[Length, ...] = ()
    steps: Count = 10
    kind: Literal["a", "b"] = "a"
    order: Literal[0, 1] = 0
    on: bool = False
    reach: Length = setting("1 m", help="Reach")


class Grid(Settings):
    """What all surfaces have."""

    points: Points
    size: Size


@checked
def sphere(
    grid: object, *, radius: Annotated[Length, "Radius."], exact: Annotated[bool, "No parabola."] = False
) -> float:
    """Sphere, by default its paraboloid.

    More.
    """
    return radius


def message(table: dict[str, Any], names: dict[str, str] | None = None) -> str:
    with pytest.raises(InputError) as caught:
        validated(Film, table, "here", names)
    return str(caught.value)


def test_values_are_numbers_that_keep_their_text() -> None:
    film = validated(Film, {"thickness": "2 nm", "depths": ["1 nm", "5nm"]}, "here")
    assert (film.thickness, film.depths, film.reach) == (2e-9, (1e-9, 5e-9), 1.0)
    assert isinstance(film.reach, Written)  # defaults are read too
    dumped = film.model_dump(mode="json", exclude_unset=True)
    assert dumped == {"thickness": "2 nm", "depths": ["1 nm", "5nm"]}
    assert validated(Film, dumped, "here") == film
    assert film.given("kind", "steps", "on")["thickness"] == 2e-9


def test_every_value_takes_the_text_of_the_command_line() -> None:
    texts = {"friction": "30%", "depths": "1nm, 2nm", "steps": "3", "kind": "b", "order": "1", "on": "true"}
    film = validated(Film, texts, "here")
    assert (film.friction, film.depths, film.steps) == (0.3, (1e-9, 2e-9), 3)
    assert (film.kind, film.order, film.on) == ("b", 1, True)


def test_messages_name_the_key_or_the_option() -> None:
    assert message({"thickness": "-2 nm"}) == "here: thickness must be greater than zero, but is '-2 nm'."
    named = message({"thickness": "2", "depths": ["1 nm", "x"]}, {"thickness": "--film", "depths": "--depths"})
    assert named.splitlines()[0] == "here has 2 problems:"
    assert "--film must have a unit" in named
    assert "part 2 of --depths must be" in named
    assert message({"thicknes": "2 nm"}) == "here: thicknes is not a known key; did you mean thickness?"
    assert "steps must be a whole number of at least 1" in message({"steps": 0})
    assert "kind must be 'a' or 'b'" in message({"kind": "c"})


def test_a_table_follows_from_a_function() -> None:
    model = table_of(sphere, Grid, "kind=sphere")
    table: Any = validated(model, {"kind": "sphere", "points": "8x4", "size": "2 um x 1 um", "radius": "8 um"}, "here")
    assert table.given("kind") == {"points": (8, 4), "size": (2e-6, 1e-6), "radius": 8e-6, "exact": False}
    assert model.__doc__ == "Sphere, by default its paraboloid."
    assert table.model_dump(mode="json")["size"] == "2 um x 1 um"
    schema = model.model_json_schema()
    assert schema["properties"]["radius"]["quantity"] == "length"
    assert schema["required"] == ["points", "size", "kind", "radius"]


def test_declarations_of_a_table() -> None:
    thickness = declared("thickness", Film.model_fields["thickness"])
    assert (thickness.option, thickness.help, thickness.unit) == ("--film", "Thickness of the film", "m")
    assert declared("steps", Film.model_fields["steps"]).default == 10
