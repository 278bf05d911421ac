"""From options to the problem document; messages name the option where the user gave one."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ..core import units
from ..core.errors import InputError, UnitError
from ..io.schemas.bodies import SYMBOLS, body_from_text
from ..io.schemas.problem import EFFECTIVE, FROM_BODY, NONE
from .options import BodyOptions, ReadingOptions, SolveOptions
from .preparing import PreparationOptions, steps

CONTROLS = MappingProxyType(
    {"mean_pressure": "pressure", "force": "load", "approach": "approach", "mean_gap": "mean_gap", "path": "path"}
)
"""Option that gives each control of the document."""

NAMES = MappingProxyType(
    {
        **{f"control.{key}": f"--{option.replace('_', '-')}" for key, option in CONTROLS.items()},
        **{
            f"{table}.{key}": f"--{key.replace('_', '-')}"
            for table in ("surface", "counter_surface")
            for key in ("channel", "size", "height_unit", "z_scale", "lateral_unit", "mirror")
        },
        **{f"control.path.{key}": "--path" for key in ("mean_pressure", "force", "approach")},
        "control.path.steps": "--path-steps",
        "counter_surface.place.shift": "--shift",
        "counter_surface.place.angle": "--rotate",
        "boundary.kind": "--boundary",
        "law.hardness": "--hardness",
        "solver.method": "--solver",
        "solver.tolerance": "--tolerance",
        "solver.max_iterations": "--max-iterations",
        "solver.precision": "--precision",
        "solver.threads": "--threads",
    }
)
"""What the user calls a key of the document."""


WORDS = (*SYMBOLS.items(), ("material", "material"), ("thickness", "thickness"))
"""What the user calls a key of a part of a body, and the key."""


WORDS_OF_HARDNESS = MappingProxyType({"body": FROM_BODY, FROM_BODY: FROM_BODY, EFFECTIVE: EFFECTIVE})
"""Words for a hardness on the command line, and in the document."""


def composed(
    file: Path, reading: ReadingOptions, preparation: PreparationOptions, bodies: BodyOptions
) -> dict[str, Any]:
    """Document without load and solver for the surface in ``file``."""
    if bodies.body is None:
        raise InputError("--body must be given, such as --body DLC; the command `asperity materials` lists the names.")
    table: dict[str, Any] = {"version": 2, "surface": _surface(file, reading, preparation)}
    if bodies.counter_surface is not None:
        counter = _surface(bodies.counter_surface, reading, preparation)
        table["counter_surface"] = {**counter, "mirror": bodies.mirror or "x", **_place(bodies)}
    else:
        given = {"--mirror": bodies.mirror, "--shift": bodies.shift, "--rotate": bodies.rotate}
        given["--common-grid"] = "" if bodies.common_grid else None
        for option, value in given.items():
            if value is not None:
                raise InputError(f"{option} must be given together with --counter-surface only, but is given without.")
    return table


def overlaid(table: Mapping[str, Any], bodies: BodyOptions, solve: SolveOptions) -> dict[str, Any]:
    """``table`` with the bodies, boundary, law, load and solver settings that are given as options."""
    result = dict(table)
    if bodies.body is not None:
        result["body"] = body_table(bodies.body, "--body", bodies.materials_file)
    if bodies.counter is not None:
        result["counter_body"] = body_table(bodies.counter, "--counter", bodies.materials_file)
    if bodies.boundary is not None:
        result["boundary"] = {"kind": bodies.boundary}
    if bodies.hardness is not None:
        result["law"] = {"kind": "hardness", "hardness": WORDS_OF_HARDNESS.get(_word(bodies.hardness), bodies.hardness)}
    result["control"] = _control(table, solve)
    settings = {"method": solve.solver, "tolerance": solve.tolerance}
    settings |= {"max_iterations": solve.max_iterations, "precision": solve.precision, "threads": solve.threads}
    stated = {key: value for key, value in settings.items() if value is not None}
    before = table.get("solver", {})
    if stated and isinstance(before, dict):
        result["solver"] = {**before, **stated}
    return result


def _control(table: Mapping[str, Any], solve: SolveOptions) -> Any:
    """The load that options give, or that of ``table``."""
    given = {key: getattr(solve, option) for key, option in CONTROLS.items() if getattr(solve, option) is not None}
    if len(given) > 1 or (not given and "control" not in table):
        options = [NAMES[f"control.{key}"] for key in given]
        choices = ", ".join(NAMES[f"control.{key}"] for key in CONTROLS)
        raise InputError(
            f"load must be given by exactly one of {choices}, but is given by {' and '.join(options) or 'none'}."
        )
    if "path" in given:
        given["path"] = path_table(given["path"])
    control = given or table["control"]
    return control if solve.path_steps is None else with_steps(control, solve.path_steps)


def _word(text: str) -> str:
    return text.strip().casefold()


def path_table(text: str) -> dict[str, Any]:
    """Table of the load path in ``text``: the unit of its first value other than zero says what is prescribed."""
    points = [part.strip() for part in text.split(",")]
    loads = [point for point in points if point != NONE]
    kinds = {"mean_pressure": "pressure", "force": "force", "approach": "length"}
    for key, kind in kinds.items():
        try:
            units.parse(loads[0] if loads else "", kind, "")
        except UnitError:
            continue
        return {key: points}
    raise InputError(
        '--path must be pressures, forces or lengths with units, separated by commas, such as "50MPa,0,80MPa", '
        f"but is {text!r}."
    )


def path_names(table: Mapping[str, Any]) -> dict[str, str]:
    """What the user calls the turning points of the load path in ``table``."""
    path = table["control"].get("path", {})
    return {
        f"control.path.{key}[{number}]": f"turning point {number} of --path"
        for key, points in path.items()
        if isinstance(points, list)
        for number in range(1, len(points) + 1)
    }


def with_steps(control: Any, steps: int) -> dict[str, Any]:
    """Table ``control`` with other steps of its load path."""
    if not isinstance(control, dict) or not isinstance(control.get("path"), dict):
        raise InputError("--path-steps must be given together with a load path (--path) only, but is given without.")
    return {**control, "path": {**control["path"], "steps": steps}}


def body_table(text: str, option: str, materials_file: Path | None) -> dict[str, Any]:
    """Body from its one line of text (see ``io.schemas.bodies``); named materials are looked up in the file."""
    try:
        table = body_from_text(text)
    except InputError as error:
        raise InputError(f"{option}{error}") from None
    named = "layers" in table or "material" in table
    return {**table, "materials_file": str(materials_file)} if named and materials_file is not None else table


def body_names(table: Mapping[str, Any]) -> dict[str, str]:
    """What the user calls the keys of the bodies in ``table``: the symbol, the part and the option."""
    names: dict[str, str] = {}
    for key, option in (("body", "--body"), ("counter_body", "--counter")):
        body = table.get(key)
        layers = body.get("layers", ()) if isinstance(body, dict) else ()
        parts = {key: option, f"{key}.base": f"the base of {option}"}
        parts |= {f"{key}.layers[{n}]": f"layer {n} of {option}" for n in range(1, len(layers) + 1)}
        for part, name in parts.items():
            names[part] = name
            names |= {f"{part}.{k}": f"{symbol} of {name}" for symbol, k in WORDS}
    return names


def _place(bodies: BodyOptions) -> dict[str, Any]:
    """Where the counter surface lies, if anything is said of it."""
    if bodies.shift is None and bodies.rotate is None and not bodies.common_grid:
        return {}
    parts = [] if bodies.shift is None else [part.strip() for part in bodies.shift.split(",")]
    if len(parts) not in (0, 2):
        raise InputError(f'--shift must be two lengths, such as "1um,0um", but is {bodies.shift!r}.')
    shift = {"shift": parts} if parts else {}
    return {"place": {**shift, **({} if bodies.rotate is None else {"angle": bodies.rotate})}}


def _surface(file: Path, reading: ReadingOptions, preparation: PreparationOptions) -> dict[str, Any]:
    keys = {"channel": reading.channel, "size": reading.size}
    keys |= {"height_unit": reading.height_unit, "z_scale": reading.z_scale}
    keys["lateral_unit"] = reading.lateral_unit
    given = {key: value for key, value in keys.items() if value is not None}
    return {"kind": "file", "path": str(file), **given, "prepare": steps(preparation)}
