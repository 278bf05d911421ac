"""What the command ``theory`` prints: the catalogue, and the answer of one theory with its limits and sources."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.citations import reference
from ..core.parameters import Parameter, parameters
from ..core.units import show
from ..theories.protocol import Described, Limit
from .show import console, say, table

if TYPE_CHECKING:
    from rich.table import Table

    from ..core.arrays import RealArray
    from ..theories.ask import Evaluation

LEFT = "!"
"""Mark of a row beyond a limit."""


def print_list(*, as_json: bool) -> None:
    """Print all theories with their inputs and sources."""
    from ..io.records import catalogue_record
    from ..theories.catalogue import FAMILIES, THEORIES

    if as_json:
        records = [catalogue_record(kind) for kind in THEORIES.values()]
        console().out(json.dumps(records, indent=2), highlight=False)
        return
    for family, kinds in FAMILIES.items():
        say(family, "bold")
        for kind in kinds:
            _print_kind(kind)
    say("* also from a surface, with --surface FILE. `asperity theory NAME --help` explains the options of one theory.")


def _print_kind(kind: type[Described]) -> None:
    from ..theories.ask import numbers_of, ways_of

    measured = hasattr(kind, "from_roughness") or hasattr(kind, "of_roughness")
    say(f"\n{kind.name}{' *' if measured else ''}", "cyan")
    say(f"  {kind.title}")
    for item in parameters(kind):
        say(f"    {item.name + ('' if item.required else ' (optional)'):32} {item.unit or '-':9} {item.help}")
    for way in ways_of(kind):
        given = [f"{item.name} in {item.unit or 'numbers'}" for item in way.given if item.required]
        with_given = f", with {', '.join(given)}" if given else ""
        say(f"    asked along {way.axis.name} in {way.axis.unit or 'numbers'}{with_given}")
    if numbers_of(kind):
        say(f"    tells {', '.join(column.name.rpartition('.')[2] for column in numbers_of(kind))}")
    for key in kind.citation_keys:
        say(f"    source: {reference(key)}", "dim")


def print_answer(found: Evaluation, *, as_json: bool) -> None:
    """Print the results of a theory, its limits of validity and its sources."""
    if as_json:
        from ..io.records import answer_record

        console().out(json.dumps(answer_record(found), indent=2), highlight=False)
        return
    theory = found.theory
    rows = [(item.help, _input_text(item, getattr(theory, item.name))) for item in parameters(type(theory))]
    _print_table(theory.title, table("", rows))
    if found.numbers:
        numbers = [(column.meaning, show(value, column.unit)) for column, value in found.numbers]
        _print_table("Numbers", table("", numbers))
    if found.columns:
        _print_columns(found)
    for limit in found.limits:
        _print_limit(limit)
    for key in theory.citation_keys:
        say(f"  source: {reference(key)}", "dim")


def _print_columns(found: Evaluation) -> None:
    """The curve; rows beyond a limit are marked and red."""
    size = found.columns[0][1].size
    left = np.zeros(size, dtype=bool)
    for limit in found.limits:
        left |= ~np.broadcast_to(limit.holds, size)
    names = [_heading(column.name) for column, _ in found.columns]
    if size == 1:  # one point is read downwards
        point = [
            (name, show(float(values[0]) + 0.0, column.unit), column.meaning)
            for name, (column, values) in zip(names, found.columns, strict=True)
        ]
        _print_table("Answer", table("", point))
        return
    rows = [
        (LEFT if left[n] else "", *(show(float(values[n]) + 0.0, column.unit) for column, values in found.columns))
        for n in range(size)
    ]
    made = table("", rows, ("", *names))
    for row, beyond in zip(made.rows, left, strict=True):
        row.style = "red" if beyond else None
    _print_table("Answer", made)


def _heading(name: str) -> str:
    """Heading of the column ``name``: stress.xx is σ xx."""
    return name.replace("displacement.", "u ").replace("stress.", "σ ").replace(".", " ").replace("_", " ")


def _print_table(title: str, made: Table) -> None:
    """Print a table below its ``title``, however narrow it is."""
    made.title = None
    say(title, "bold")
    console().print(made)


def _print_limit(limit: Limit) -> None:
    bounds = _bounds(limit.low, limit.high)
    values = _extent(limit.value)
    source = f"[{limit.citation}]"
    if limit.holds.all():
        say(f"valid: {limit.criterion} {values}, must be {bounds} {source}", "green")
        return
    how_often = (
        "everywhere" if not limit.holds.any() else f"at {int((~limit.holds).sum())} of {limit.holds.size} points"
    )
    say(f"{LEFT} left {how_often}: {limit.criterion} {values}, must be {bounds}. {limit.message} {source}", "red")


def _bounds(low: float, high: float) -> str:
    if math.isinf(low):
        return f"at most {high:.4g}"
    return f"at least {low:.4g}" if math.isinf(high) else f"from {low:.4g} to {high:.4g}"


def _extent(values: RealArray) -> str:
    """Smallest to largest of ``values``, or the only one."""
    known = values[~np.isnan(values)]
    if known.size == 0:
        return "is not defined"
    first, last = f"{known.min():.4g}", f"{known.max():.4g}"
    return f"is {first}" if first == last else f"goes from {first} to {last}"


def _input_text(item: Parameter, value: Any) -> str:
    for word, choice in item.words.items():
        if choice == value:
            return word
    if item.many:
        return f"{np.size(value)} values"
    if value is None:
        return "not given"
    if isinstance(value, int | float):
        return show(float(value), item.unit if item.unit != "m^(1-n)" else "")
    return str(getattr(value, "name", value))
