"""The subcommand of one theory: options from its inputs and ways, numbers out of text, and its answer in a table or a file."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, get_type_hints

import numpy as np
import typer

from ..core import units
from ..core.errors import InputError
from ..theories.ask import Way, evaluate, ways_of
from ..theories.protocol import Described, Input
from .options import BODIES, READING, ReadingOptions
from .theory_surface import BODY_INPUTS, from_surface, of_bodies

if TYPE_CHECKING:
    from ..core.arrays import RealArray

INPUTS, ASKED, ANSWER = "What it is made from", "What it is asked", "Answer"


@dataclass(frozen=True)
class RangeOptions:
    """How ranges are divided, and where the answer goes."""

    points: Annotated[int, typer.Option("--points", help="Points of a range.", rich_help_panel=ASKED)] = 11
    linear: Annotated[
        bool, typer.Option("--linear", help="Even steps instead of even ratios.", rich_help_panel=ASKED)
    ] = False
    as_json: Annotated[
        bool, typer.Option("--json", help="Print as JSON, all values in SI.", rich_help_panel=ANSWER)
    ] = False
    csv: Annotated[
        Path | None, typer.Option("--csv", help="Write the columns as a CSV file, in SI.", rich_help_panel=ANSWER)
    ] = None
    force: Annotated[bool, typer.Option("--force", help="Replace a file that exists.", rich_help_panel=ANSWER)] = False


@dataclass(frozen=True)
class SurfaceOptions:
    """A measured surface in place of numbers."""

    surface: Annotated[
        Path | None, typer.Option("--surface", help="Measure them on this file.", rich_help_panel=READING)
    ] = None
    level: Annotated[
        str,
        typer.Option(
            "--level",
            help="Removed before: mean, plane, quadratic or a degree; the mean of a periodic surface, else the plane.",
            rich_help_panel=READING,
        ),
    ] = "auto"
    bins: Annotated[
        int | None,
        typer.Option(
            "--bins",
            help="Take the histogram of the measured summit heights with so many bins.",
            rich_help_panel=READING,
        ),
    ] = None


@dataclass(frozen=True)
class MaterialOptions:
    """Bodies in place of their modulus and strength."""

    body: Annotated[
        str | None,
        typer.Option("--body", help='Material, or "E=140GPa,nu=0.25,H=15GPa".', rich_help_panel=BODIES, metavar="BODY"),
    ] = None
    counter: Annotated[
        str | None,
        typer.Option(
            "--counter", help="Counter body, in the same way; rigid by default.", rich_help_panel=BODIES, metavar="BODY"
        ),
    ] = None


def command(kind: type[Described]) -> Any:
    """The subcommand of ``kind``."""
    groups: dict[str, Any] = {"answer": RangeOptions}
    if _measured(kind) is not None:
        groups |= {"place": SurfaceOptions, "reading": ReadingOptions}
    if any(item.name in BODY_INPUTS for item in kind.inputs):
        groups |= {"materials": MaterialOptions}
    shown = [_parameter(item.name, _option(item), _metavar(item), _help(item), INPUTS) for item in kind.inputs]
    shown += [
        _parameter(item.name, _option(item), _metavar(item), _help(item), ASKED) for item in _arguments(kind).values()
    ]
    members = {name: list(get_type_hints(group, include_extras=True).items()) for name, group in groups.items()}
    for name, group in groups.items():
        shown += [
            inspect.Parameter(
                key,
                inspect.Parameter.KEYWORD_ONLY,
                default=group.__dataclass_fields__[key].default,
                annotation=hint,
            )
            for key, hint in members[name]
            if key != "bins" or _takes_bins(kind)
        ]

    def run(**values: Any) -> None:
        built = {
            name: group(**{key: values.pop(key) for key, _ in members[name] if key in values})
            for name, group in groups.items()
        }
        _run(kind, {name: text for name, text in values.items() if text is not None}, built)

    run.__signature__ = inspect.Signature(shown)  # type: ignore[attr-defined]
    run.__annotations__ = {parameter.name: parameter.annotation for parameter in shown}
    run.__doc__ = f"{kind.title}. {inspect.cleandoc(kind.__doc__ or '').partition(chr(10))[0]}".replace("``", "")
    made = typer.Typer(add_completion=False)
    made.command(kind.name)(run)
    made.callback()(lambda: None)
    return typer.main.get_group(made).commands[kind.name]


def _run(kind: type[Described], texts: dict[str, str], groups: Mapping[str, Any]) -> None:
    from ..io.atomic import require_new_file
    from ..io.records import save_table
    from .show import print_files
    from .theory_show import print_answer

    answer: RangeOptions = groups["answer"]
    if answer.csv is not None:
        require_new_file(answer.csv, overwrite=answer.force)
    arguments = _arguments(kind)
    inputs = {item.name: item for item in kind.inputs}
    given = {name: read_input(inputs[name], text, texts) for name, text in texts.items() if name in inputs}
    asked = {
        name: read_range(arguments[name], text, points=answer.points, linear=answer.linear)
        for name, text in texts.items()
        if name in arguments
    }
    theory = made(kind, given, groups)
    found = evaluate(theory, **asked)
    if answer.csv is not None:
        save_table(found, answer.csv, overwrite=answer.force)
    print_answer(found, as_json=answer.as_json)
    if answer.csv is not None and not answer.as_json:
        print_files([answer.csv])


def made(kind: type[Described], given: dict[str, Any], groups: Mapping[str, Any]) -> Described:
    """The theory ``kind`` from the numbers ``given``, those of named bodies, and a surface if there is one.

    Raises
    ------
    InputError
        If an input is missing, or given twice.
    """
    materials: MaterialOptions | None = groups.get("materials")
    if materials is not None and materials.body is not None:
        given = of_bodies(kind, given, materials.body, materials.counter)
    elif materials is not None and materials.counter is not None:
        raise InputError("--counter must be given together with --body, but is given alone.")
    place: SurfaceOptions | None = groups.get("place")
    if place is not None and place.surface is not None:
        extra = {} if place.bins is None else {"bins": place.bins}
        return from_surface(kind, given | extra, place.surface, groups["reading"], place.level)
    if place is not None and (groups["reading"] != ReadingOptions() or place.bins is not None):
        raise InputError("options for reading must be given together with --surface, but are given alone.")
    missing = [item for item in kind.inputs if item.required and item.name not in given]
    if missing:
        needed = ", ".join(
            f"{_option(item)} ({item.meaning}{f', in {item.unit}' if item.unit else ''})" for item in missing
        )
        measured = any(item.of == "surface" for item in missing) and _measured(kind) is not None
        also = " Or measure the surface's numbers with --surface FILE." if measured else ""
        raise InputError(f"{kind.name} must be given {needed}, but is not.{also}")
    return kind(**given)


def read_input(item: Input, text: str, texts: Mapping[str, str]) -> Any:
    """Value of an input from its ``text``: a word, a number with its unit, or several with commas between."""
    option = _option(item)
    if item.choices:
        words = dict(item.choices)
        if text not in words:
            raise InputError(f"{option} must be one of {', '.join(words)}, but is {text!r}.")
        return words[text]
    if isinstance(item.default, str):
        return text
    unit = item.unit
    if unit == "m^(1-n)":  # of a profile B r^n
        exponent = 1.0 - units.parse_in(texts["exponent"], "", "--exponent") if "exponent" in texts else 0.0
        unit = f"m^({exponent:g})" if exponent else ""
    if item.many:
        return np.array([units.parse_in(part, unit, option) for part in text.split(",")])
    return units.parse_in(text, unit, option)


def read_range(item: Input, text: str, *, points: int, linear: bool) -> RealArray:
    """Numbers of an argument: one, several with commas between, or ``points`` from one to another with ``..`` between."""
    option = _option(item)
    ends = text.split("..")
    if len(ends) == 1:
        return np.array([units.parse_in(part, item.unit, option) for part in text.split(",")])
    if len(ends) != 2:
        raise InputError(f'{option} must be a value, several with commas, or a range such as "1..10", but is {text!r}.')
    if points < 2:
        raise InputError(f"--points must be at least 2 for a range, but is {points}.")
    first, last = (units.parse_in(end, item.unit, option) for end in ends)
    if linear or not first * last > 0.0:
        return np.linspace(first, last, points)
    return np.asarray(np.sign(first) * np.geomspace(abs(first), abs(last), points))


def _arguments(kind: type[Described]) -> dict[str, Input]:
    """Everything by which ``kind`` can be asked, by name."""
    ways: tuple[Way, ...] = ways_of(kind)
    return {item.name: item for way in ways for item in (way.axis, *way.given)}


def _measured(kind: type[Described]) -> Any:
    """What makes ``kind`` from a roughness, or None."""
    return getattr(kind, "from_roughness", getattr(kind, "of_roughness", None))


def _takes_bins(kind: type[Described]) -> bool:
    return "bins" in inspect.signature(_measured(kind)).parameters


def _option(item: Input) -> str:
    return "--" + item.name.replace("_", "-")


def _metavar(item: Input) -> str:
    if item.choices:
        return "WORD"
    return item.unit or "NUMBER"


def _help(item: Input) -> str:
    text = item.meaning[0].upper() + item.meaning[1:] + (f", in {item.unit}" if item.unit else "")
    words = [word for word, _ in item.choices]
    text += f": {', '.join(words)}" if words else ""
    if item.default is None or item.many:
        return f"{text}."
    shown = next((word for word, value in item.choices if value == item.default), None)
    return f"{text}. Default: {shown or units.show(item.default, item.unit)}."


def _parameter(name: str, option: str, metavar: str, text: str, panel: str) -> inspect.Parameter:
    names = list(dict.fromkeys((option, option.lower())))
    made = typer.Option(*names, help=text, metavar=metavar, rich_help_panel=panel)
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=Annotated[str | None, made])
