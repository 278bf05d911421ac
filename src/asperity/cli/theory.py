"""The command ``theory``: one subcommand for every theory of the catalogue, whose options follow from its declarations."""

from __future__ import annotations

import inspect
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer.core import TyperGroup

from ..core.errors import InputError
from ..core.parameters import REQUIRED, Parameter, parameters
from ..core.values import Number, Text, Whole
from .declared import Given, Option, built, options_of
from .options import BODIES, READING, ReadingOptions

if TYPE_CHECKING:
    from ..core.arrays import RealArray
    from ..theories.protocol import Described

INPUTS, ASKED, ANSWER = "What it is made from", "What it is asked", "Answer"

OF_BODIES = ("E_star", "hardness", "yield_stress", "nu")
"""Parameters that follow from named bodies."""

BODY_OPTIONS = (
    Option(
        "--body",
        ("body",),
        Parameter("body", str, Text(), None, 'material, or "E=140GPa,nu=0.25,H=15GPa"'),
        BODIES,
    ),
    Option(
        "--counter",
        ("counter",),
        Parameter("counter", str, Text(), None, "counter body, in the same way; rigid by default"),
        BODIES,
    ),
)

_LEVELS = "removed before: mean, plane, quadratic or a degree; the mean of a periodic surface, else the plane"
SURFACE_OPTIONS = (
    Option("--surface", ("surface",), Parameter("surface", str, Text(), None, "measure them on this file"), READING),
    Option("--level", ("level",), Parameter("level", str, Text(), None, _LEVELS), READING),
    Option(
        "--bins",
        ("bins",),
        Parameter("bins", int, Whole(1), None, "take the histogram of the measured summit heights with so many bins"),
        READING,
    ),
)


class Theories(TyperGroup):
    """Subcommands that are built when they are asked for."""

    def list_commands(self, ctx: Any) -> list[str]:
        """Names of all theories."""
        from ..theories.catalogue import THEORIES

        return list(THEORIES)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """Subcommand of one theory, with dashes or underscores.

        Raises
        ------
        InputError
            If there is no such theory.
        """
        from ..theories.catalogue import theory

        return _command(theory(cmd_name.replace("_", "-")))


app = typer.Typer(name="theory", cls=Theories, invoke_without_command=True, add_completion=False)


@app.callback()
def theory(
    context: typer.Context,
    listed: Annotated[bool, typer.Option("--list", help="Show all theories with their inputs and sources.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="The list as JSON.")] = False,
) -> None:
    """Evaluate a theory, from numbers or for a measured surface.

    Examples: asperity theory --list; asperity theory hertz --E-star 115GPa --radius 5mm --load 1N..100N;
    asperity theory bush-gibson-thomas --surface scan.di --body DLC --pressure 1MPa..100MPa

    asperity theory NAME --help lists the options of a theory.
    """
    if context.invoked_subcommand is None:
        if not listed:
            raise InputError("NAME of a theory or --list must be given, but neither is.")
        from .theory_show import print_list

        print_list(as_json=as_json)


def _command(kind: type[Described]) -> Any:
    """The subcommand of ``kind``."""

    def run(
        given: Given,
        points: Annotated[int, typer.Option("--points", help="Points of a range.", rich_help_panel=ASKED)] = 11,
        linear: Annotated[
            bool, typer.Option("--linear", help="Even steps instead of even ratios.", rich_help_panel=ASKED)
        ] = False,
        as_json: Annotated[
            bool, typer.Option("--json", help="Print as JSON, all values in SI.", rich_help_panel=ANSWER)
        ] = False,
        csv: Annotated[
            Path | None, typer.Option("--csv", help="Write the columns as a CSV file, in SI.", rich_help_panel=ANSWER)
        ] = None,
        force: Annotated[
            bool, typer.Option("--force", help="Replace a file that exists.", rich_help_panel=ANSWER)
        ] = False,
    ) -> None:
        from ..io.atomic import require_new_file
        from ..io.records import save_table
        from ..theories.ask import evaluate
        from .show import print_files
        from .theory_show import print_answer

        if csv is not None:
            require_new_file(csv, overwrite=force)
        arguments = _arguments(kind)
        asked = {
            name: read_range(arguments[name], text, points=points, linear=linear)
            for name, text in given.under("asked").table().items()
        }
        found = evaluate(_made(kind, given), **asked)
        if csv is not None:
            save_table(found, csv, overwrite=force)
        print_answer(found, as_json=as_json)
        if csv is not None and not as_json:
            print_files([csv])

    first = inspect.cleandoc(kind.__doc__ or "").partition("\n")[0]
    run.__doc__ = f"{kind.title}. {first}".replace("``", "")
    return built(run, _options(kind), kind.name)


def _options(kind: type[Described]) -> list[Option]:
    """Options of a theory: what it is made from, what it is asked, and where its parameters may come from instead."""
    from ..io.schemas.surfaces import AnySurface, FileSurface

    made = [replace(option, required=False) for option in options_of(kind, ("made",), INPUTS)]
    asked = [
        Option(_option(item), ("asked", name), replace(item, default=None) if item.required else item, ASKED)
        for name, item in _arguments(kind).items()
    ]
    measured = _measured(kind)
    if measured is not None:
        leave = ("kind", "path", *AnySurface.model_fields)
        asked += [o for o in SURFACE_OPTIONS if o.name != "--bins" or "bins" in inspect.signature(measured).parameters]
        asked += options_of(FileSurface, ("reading",), READING, leave=leave)
    if any(item.name in OF_BODIES for item in parameters(kind)):
        asked += BODY_OPTIONS
    return made + asked


def _made(kind: type[Described], given: Given) -> Described:
    """The theory ``kind`` from the numbers given, those of named bodies, and a surface if there is one.

    Raises
    ------
    InputError
        If a parameter is missing, or given twice.
    """
    texts = given.under("made").table()
    values = {item.name: _read(item, texts) for item in parameters(kind) if item.name in texts}
    told = given.table()
    if "body" in told:
        values = _of_bodies(kind, values, told["body"], told.get("counter"))
    elif "counter" in told:
        raise InputError("--counter must be given together with --body, but is given alone.")
    if "surface" in told:
        if "bins" in told:
            values["bins"] = Whole(1).read(told["bins"], "--bins")
        reading = ReadingOptions(**told.get("reading", {}))
        return _of_surface(kind, values, Path(told["surface"]), reading, told.get("level", "auto"))
    if "reading" in told or "bins" in told:
        raise InputError("options for reading must be given together with --surface, but are given alone.")
    missing = [item for item in parameters(kind) if item.required and item.name not in values]
    if missing:
        needed = ", ".join(
            f"{_option(item)} ({item.help}{f', in {item.unit}' if item.unit else ''})" for item in missing
        )
        measured = any(not item.of for item in missing) and _measured(kind) is not None
        also = " Or measure the surface's numbers with --surface FILE." if measured else ""
        raise InputError(f"{kind.name} must be given {needed}, but is not.{also}")
    return kind(**values)


def _of_bodies(kind: type[Described], values: dict[str, Any], body: str, counter: str | None) -> dict[str, Any]:
    """``values`` with what the bodies say of the parameters of ``kind`` that are not given; the weaker body yields.

    Raises
    ------
    InputError
        If a body is not understood, or its strength is needed and not known.
    """
    from ..run.build import body_of_text
    from ..solids.elastic import Rigid
    from ..solids.layers import contact_modulus, weaker_strength

    first = body_of_text(body, "--body")
    second = Rigid() if counter is None else body_of_text(counter, "--counter")
    known = {"E_star": contact_modulus(first, second)} | weaker_strength(first, second)
    for item in parameters(kind):
        if item.name in ("hardness", "yield_stress") and item.required and item.name not in (values | known):
            raise InputError(f"{_option(item)} must be given: no body states its {item.name.replace('_', ' ')}.")
    names = {item.name for item in parameters(kind)}
    return {name: value for name, value in known.items() if name in names} | values


def _of_surface(
    kind: type[Described], values: dict[str, Any], file: Path, reading: ReadingOptions, level: str
) -> Described:
    """The theory ``kind`` of the surface in ``file``, filled and levelled.

    Raises
    ------
    InputError
        If a number that is measured is also given, or another is missing.
    """
    from ..contact.roughness import roughness_of
    from ..surfaces.prepare.fill import filled
    from ..surfaces.prepare.level import levelled
    from .options import level_of, read_surface

    method: Any = _measured(kind)
    taken = {item.name: item for item in list(inspect.signature(method).parameters.values())[1:]}
    surplus = sorted(set(values) - set(taken))
    if surplus:
        options = ", ".join("--" + name.replace("_", "-") for name in surplus)
        raise InputError(f"{options} must be left out with --surface, which measures what {kind.name} needs.")
    needed = [name for name, item in taken.items() if item.default is REQUIRED and name not in values]
    if needed:
        options = ", ".join("--" + name.replace("_", "-") for name in needed)
        raise InputError(f"{kind.name} of a surface must also be given {options}, but is not; --body names a material.")
    surface = read_surface(file, reading)
    found = level_of(surface, level)
    whole = filled(surface) if surface.n_missing else surface
    flat = levelled(whole, int(found) if found.isdigit() else found)
    theory: Described = method(roughness_of(flat), **values)
    return theory


def _read(item: Parameter, texts: dict[str, Any]) -> Any:
    """Value of a parameter from its text; numbers as floats, several as an array."""
    import numpy as np

    values, option = item.values, _option(item)
    if item.unit == "m^(1-n)":  # of a profile B r^n
        exponent = 1.0 - float(Number().read(texts["exponent"], "--exponent")) if "exponent" in texts else 0.0
        values = Number(f"m^({exponent:g})" if exponent else "", above=0.0)
    found = values.read(texts[item.name], option)
    return np.array(found, dtype=float) if item.many else float(found) if isinstance(found, float) else found


def read_range(item: Parameter, text: str, *, points: int, linear: bool) -> RealArray:
    """Numbers of an argument: one, several with commas between, or ``points`` from one to another with ``..`` between."""
    import numpy as np

    option = _option(item)
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


def _arguments(kind: type[Described]) -> dict[str, Parameter]:
    """Everything by which ``kind`` can be asked, by name."""
    from ..theories.ask import ways_of

    return {item.name: item for way in ways_of(kind) for item in (way.axis, *way.given)}


def _measured(kind: type[Described]) -> Any:
    """What makes ``kind`` from a roughness, or None."""
    return getattr(kind, "from_roughness", getattr(kind, "of_roughness", None))


def _option(item: Parameter) -> str:
    return "--" + item.name.replace("_", "-")
