"""The command ``theory``: one subcommand for every theory of the catalogue, whose options follow
from its declarations."""

from __future__ import annotations

import inspect
import json
import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from rich.table import Table

from ..contact.roughness import roughness_of
from ..core.arrays import RealArray
from ..core.citations import reference
from ..core.errors import InputError
from ..core.parameters import REQUIRED, Parameter, parameters
from ..core.units import show
from ..core.values import Flag, Number, Text, Values, Whole
from ..io.atomic import require_new_files
from ..io.records import answer_record, catalogue_record, named, save_table
from ..plots.comparison import save_answer_plot
from ..run.build import body_of_text
from ..solids.elastic import Rigid
from ..solids.layers import contact_modulus, weaker_strength
from ..surfaces.prepare.level import filled
from ..theories.ask import Evaluation, evaluate, ways_of
from ..theories.catalogue import FAMILIES, THEORIES
from ..theories.catalogue import theory as theory_of
from ..theories.protocol import Described
from .declared import FILE, Given, Option, built, options_of
from .main import Listing
from .options import READING, body_options, heights_in, levelled_as, reading_options
from .show import console, error_console, print_files, say, table

INPUTS, ASKED, ANSWER = "What it is made from", "What it is asked", "Answer"

OF_BODIES = ("E_star", "hardness", "yield_stress", "nu")
"""Parameters that follow from named bodies."""

POINTS = 11
"""Points of a range."""


def _own(name: str, values: Values, default: Any, text: str, panel: str, metavar: str | None = None) -> Option:
    return Option(f"--{name}", ("answer", name), Parameter(name, str, values, default, text), panel, metavar=metavar)


ANSWERS = (
    _own("points", Whole(1), POINTS, "points of a range", ASKED),
    _own("linear", Flag(), False, "even steps instead of even ratios", ASKED),
    _own("json", Flag(), False, "print as JSON, all values in SI", ANSWER),
    _own("csv", Text(), None, "write the columns as a CSV file, in SI", ANSWER, FILE),
    _own("plot", Text(), None, "draw the columns over the range, PNG", ANSWER, FILE),
    _own("force", Flag(), False, "replace files that exist", ANSWER),
)
"""Options of every theory."""

_LEVELS = "removed before: mean, plane, quadratic or a degree; the mean of a periodic surface, else the plane"
SURFACE_OPTIONS = (
    Option(
        "--surface",
        ("file",),
        Parameter("surface", str, Text(), None, "measure them on this file"),
        READING,
        metavar=FILE,
    ),
    Option("--level", ("level",), Parameter("level", str, Text(), None, _LEVELS), READING),
    Option(
        "--bins",
        ("bins",),
        Parameter("bins", int, Whole(1), None, "take the histogram of the measured summit heights with so many bins"),
        READING,
    ),
)


class Theories(Listing):
    """Subcommands that are built when they are asked for."""

    @staticmethod
    def lines() -> Mapping[str, str]:
        """Names and titles of all theories."""
        return {name: kind.title for name, kind in THEORIES.items()}

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """Subcommand of one theory, with dashes or underscores.

        Raises
        ------
        InputError
            If there is no such theory.
        """
        return _command(theory_of(cmd_name.replace("_", "-")))


app = typer.Typer(name="theory", cls=Theories, invoke_without_command=True, add_completion=False, rich_markup_mode=None)


@app.callback()
def theory(
    context: typer.Context,
    listed: Annotated[bool, typer.Option("--list", help="Show all theories in one table.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="The list as JSON, with all parameters and sources.")] = False,
) -> None:
    """Evaluate a theory, from numbers or for a measured surface.

    Examples: asperity theory --list; asperity theory hertz --E-star 115GPa --radius 5mm --load
    1N..100N; asperity theory bush-gibson-thomas --surface scan.di --body DLC --pressure
    1MPa..100MPa --plot curve.png

    asperity theory NAME --help lists the options, results and sources of a theory.
    """
    if context.invoked_subcommand is not None:
        return
    if not listed:
        raise InputError("NAME of a theory or --list must be given, but neither is.")
    if as_json:
        records = [catalogue_record(kind) for kind in THEORIES.values()]
        console().out(json.dumps(records, indent=2), highlight=False)
        return
    rows: list[tuple[str, ...]] = []
    for family, kinds in FAMILIES.items():
        for number, kind in enumerate(kinds):
            measured = " *" if _measured(kind) is not None else ""
            rows.append((family if number == 0 else "", f"{kind.name}{measured}", kind.title))
    console().print(table("Theories", rows, ("family", "name", "theory")))
    say(
        "* also from a surface, with --surface FILE. `asperity theory NAME --help` lists inputs, results, "
        "limits and sources of one."
    )


def _command(kind: type[Described]) -> Any:
    """The subcommand of ``kind``."""
    # everything by which it can be asked, by name
    arguments = {item.name: item for way in ways_of(kind) for item in (way.axis, *way.given)}

    def run(given: Given) -> None:
        chosen = given.under("answer").table()
        csv, plot = (Path(chosen[key]) if key in chosen else None for key in ("csv", "plot"))
        force, points = bool(chosen.get("force")), Whole(1).read(chosen.get("points", POINTS), "--points")
        if plot is not None and plot.suffix.lower() != ".png":
            raise InputError(f"--plot must be the name of a PNG file, such as curve.png, but is {str(plot)!r}.")
        written = [path for path in (csv, plot) if path is not None]
        require_new_files(written, overwrite=force)
        asked = {
            name: read_range(arguments[name], text, points=points, linear=bool(chosen.get("linear")))
            for name, text in given.under("asked").table().items()
        }
        found = evaluate(_made(kind, given), **asked)
        if csv is not None:
            save_table(found, csv, overwrite=force)
        if plot is not None:
            save_answer_plot(found, plot, overwrite=force)
        print_answer(found, as_json=bool(chosen.get("json")))
        if not chosen.get("json"):
            print_files(written)

    # the docstring up to its sections; formulas, which are indented, keep their lines
    text = re.split(r"\n\n[A-Z]\w+\n---", inspect.cleandoc(kind.__doc__ or ""))[0]
    blocks = [re.sub(r"\n(?!    )", " ", block) for block in f"{kind.title}. {text}".replace("``", "").split("\n\n")]
    ways = [f"{way.axis.name}{f' in {way.axis.unit}' if way.axis.unit else ''}" for way in ways_of(kind)]
    numbers = [column.name.rpartition(".")[2] for column in kind.numbers]
    blocks += [f"Asked along {' or '.join(ways)}."] if ways else []
    blocks += [f"From the inputs alone: {', '.join(numbers)}."] if numbers else []
    blocks += [f"Holds for {bound.rule}. [{bound.citation}]" for bound in kind.limits]
    run.__doc__ = "\n\n".join([*blocks, *(f"Source: {reference(key)}" for key in kind.citation_keys)])
    # what it is made from, what it is asked, and where its parameters may come from instead
    made = [replace(option, required=False) for option in options_of(kind, ("made",), INPUTS)]
    asked = [
        Option(option_of(item), ("asked", name), replace(item, default=None) if item.required else item, ASKED)
        for name, item in arguments.items()
    ]
    measured = _measured(kind)
    if measured is not None:
        asked += [o for o in SURFACE_OPTIONS if o.name != "--bins" or "bins" in inspect.signature(measured).parameters]
        asked += reading_options()
    if any(item.name in OF_BODIES for item in parameters(kind)):
        asked += [option for option in body_options() if option.name in ("--body", "--counter")]
    return built(run, kind.name, [*made, *asked, *ANSWERS])


def _made(kind: type[Described], given: Given) -> Described:
    """The theory ``kind`` from the numbers given, those of named bodies, and a surface if there is
    one, filled and levelled.

    Raises
    ------
    InputError
        If a parameter is missing, or given twice, a number that is measured is also given, a body
        is not understood, or its strength is needed and not known.
    """
    texts = given.under("made").table()
    values = {item.name: _read(item, texts) for item in parameters(kind) if item.name in texts}
    chosen = given.table()
    if "body" in chosen:
        # what follows from the bodies and is not given; the weaker body yields
        first, other = body_of_text(chosen["body"], "--body"), chosen.get("counter_body")
        second = Rigid() if other is None else body_of_text(other, "--counter")
        known = {"E_star": contact_modulus(first, second)} | weaker_strength(first, second)
        for item in parameters(kind):
            if item.name in ("hardness", "yield_stress") and item.required and item.name not in (values | known):
                raise InputError(f"{option_of(item)} must be given: no body states its {item.name.replace('_', ' ')}.")
        names = {item.name for item in parameters(kind)}
        values = {name: value for name, value in known.items() if name in names} | values
    elif "counter_body" in chosen:
        raise InputError("--counter must be given together with --body, but is given alone.")
    if "file" in chosen:
        if "bins" in chosen:
            values["bins"] = Whole(1).read(chosen["bins"], "--bins")
        method: Any = _measured(kind)
        taken = {item.name: item for item in list(inspect.signature(method).parameters.values())[1:]}
        surplus = sorted(set(values) - set(taken))
        if surplus:
            options = ", ".join("--" + name.replace("_", "-") for name in surplus)
            raise InputError(f"{options} must be left out with --surface, which measures what {kind.name} needs.")
        lacking = [name for name, item in taken.items() if item.default is REQUIRED and name not in values]
        if lacking:
            options = ", ".join("--" + name.replace("_", "-") for name in lacking)
            raise InputError(
                f"{kind.name} of a surface must also be given {options}, but is not; --body names a material."
            )
        surface = heights_in(Path(chosen["file"]), given)
        flat, _ = levelled_as(filled(surface) if surface.n_missing else surface, chosen.get("level") or "auto")
        rough = roughness_of(flat)
        if rough.assumption:
            error_console().print(f"Assumption: {rough.assumption}.", style="yellow", markup=False, soft_wrap=True)
        theory: Described = method(rough, **values)
        return theory
    if "surface" in chosen or "bins" in chosen:
        raise InputError("options for reading must be given together with --surface, but are given alone.")
    missing = [item for item in parameters(kind) if item.required and item.name not in values]
    if missing:
        needed = ", ".join(
            f"{option_of(item)} ({item.help}{f', in {item.unit}' if item.unit else ''})" for item in missing
        )
        measured = any(not item.of for item in missing) and _measured(kind) is not None
        also = " Or measure the surface's numbers with --surface FILE." if measured else ""
        raise InputError(f"{kind.name} must be given {needed}, but is not.{also}")
    return kind(**values)


def _read(item: Parameter, texts: dict[str, Any]) -> Any:
    """Value of a parameter from its text; numbers as floats, several as an array."""
    values, option = item.values, option_of(item)
    if item.unit == "m^(1-n)":  # of a profile B r^n
        exponent = 1.0 - float(Number().read(texts["exponent"], "--exponent")) if "exponent" in texts else 0.0
        values = Number(f"m^({exponent:g})" if exponent else "", above=0.0)
    found = values.read(texts[item.name], option)
    return np.array(found, dtype=float) if item.many else float(found) if isinstance(found, float) else found


def read_range(item: Parameter, text: str, *, points: int, linear: bool) -> RealArray:
    """Numbers of an argument: one, several with commas between, or ``points`` from one to another
    with ``..`` between."""
    option = option_of(item)
    ends = text.split("..")
    if len(ends) == 1:
        return np.array([item.values.read(part, option) for part in text.split(",")], dtype=float)
    if len(ends) != 2:
        raise InputError(f'{option} must be a value, several with commas, or a range such as "1..10", but is {text!r}.')
    if points < 2:
        raise InputError(f"--points must be at least 2 for a range, but is {points}.")
    first, last = (float(item.values.read(end, option)) for end in ends)
    if linear or not first * last > 0.0:
        return np.linspace(first, last, points)
    return np.asarray(np.sign(first) * np.geomspace(abs(first), abs(last), points))


def _measured(kind: type[Described]) -> Any:
    """What makes ``kind`` from a roughness, or None."""
    return getattr(kind, "from_roughness", getattr(kind, "of_roughness", None))


def option_of(item: Parameter) -> str:
    """What the command line calls the parameter ``item``."""
    return "--" + item.name.replace("_", "-")


LEFT = "!"
"""Mark of a row beyond a limit."""


def print_answer(found: Evaluation, *, as_json: bool) -> None:
    """Print the results of a theory, its limits of validity and its sources.

    Rows beyond a limit that concerns all columns are marked and red. The heading of stress.xx is σ
    xx.
    """
    if as_json:
        console().out(json.dumps(answer_record(found), indent=2), highlight=False)
        return
    theory = found.theory
    rows = []
    for item in parameters(type(theory)):
        value: Any = getattr(theory, item.name)
        text = next((word for word, choice in item.words.items() if choice == value), None)
        if text is None and item.many:
            text = f"{np.size(value)} values"
        elif text is None and value is None:
            text = "not given"
        elif text is None and isinstance(value, int | float):
            text = show(float(value), item.unit if item.unit != "m^(1-n)" else "")
        rows.append((item.help, named(value) if text is None else text))
    _print_table(theory.title, table("", rows))
    if found.numbers:
        numbers = [(column.label, show(value, column.unit)) for column, value in found.numbers]
        _print_table("Numbers", table("", numbers))
    names = [
        column.name.replace("displacement.", "u ").replace("stress.", "σ ").replace(".", " ").replace("_", " ")
        for column, _ in found.columns
    ]
    if found.columns and found.columns[0][1].size == 1:  # one point is read downwards
        point = [
            (name, show(float(values[0]) + 0.0, column.unit), column.label)
            for name, (column, values) in zip(names, found.columns, strict=True)
        ]
        _print_table("Answer", table("", point))
    elif found.columns:
        left = ~found.holds()
        curve = [
            (LEFT if beyond else "", *(show(float(values[n]) + 0.0, column.unit) for column, values in found.columns))
            for n, beyond in enumerate(left)
        ]
        made = table("", curve, ("", *names))
        for row, beyond in zip(made.rows, left, strict=True):
            row.style = "red" if beyond else None
        _print_table("Answer", made)
    for limit in found.limits:
        known, holds = limit.value[~np.isnan(limit.value)], limit.holds
        extent = "is not defined"
        if known.size:
            first, last = f"{known.min():.4g}", f"{known.max():.4g}"
            extent = f"is {first}" if first == last else f"goes from {first} to {last}"
        rule = f"{limit.criterion} {extent}, must be {limit.bounds}"
        if holds.all():
            say(f"valid: {rule} [{limit.citation}]", "green")
        else:
            where = f"at {int((~holds).sum())} of {holds.size} points" if holds.any() else "everywhere"
            say(f"{LEFT} left {where}: {rule}. {limit.message} [{limit.citation}]", "red")
    for key in theory.citation_keys:
        say(f"  source: {reference(key)}", "dim")


def _print_table(title: str, made: Table) -> None:
    """Print a table below its ``title``, however narrow it is."""
    made.title = None
    say(title, "bold")
    console().print(made)
