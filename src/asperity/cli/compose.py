"""From options to the problem document; messages name the option where the user gave one."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ..core import require
from ..core.errors import InputError
from ..io.schemas.body_text import SYMBOLS, body_from_text
from .options import BodyOptions, PreparationOptions, ReadingOptions, SolveOptions

CONTROLS = MappingProxyType(
    {"mean_pressure": "pressure", "force": "load", "approach": "approach", "mean_gap": "mean_gap"}
)
"""Option that gives each control of the document."""

NAMES = MappingProxyType(
    {
        **{f"control.{key}": f"--{option.replace('_', '-')}" for key, option in CONTROLS.items()},
        **{
            f"{table}.{key}": f"--{key.replace('_', '-')}"
            for table in ("surface", "counter_surface")
            for key in ("channel", "size", "height_unit", "z_scale", "mirror")
        },
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


def composed(
    file: Path, reading: ReadingOptions, preparation: PreparationOptions, bodies: BodyOptions
) -> dict[str, Any]:
    """Document without load and solver for the surface in ``file``."""
    if bodies.body is None:
        raise InputError("--body must be given, such as --body DLC; the command `asperity materials` lists the names.")
    table: dict[str, Any] = {"version": 1, "surface": _surface(file, reading, preparation)}
    if bodies.counter_surface is not None:
        counter = _surface(bodies.counter_surface, reading, preparation)
        table["counter_surface"] = {**counter, "mirror": bodies.mirror or "x"}
    elif bodies.mirror is not None:
        raise InputError("--mirror must be given together with --counter-surface only, but is given without.")
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
        from_body = bodies.hardness.strip().casefold() in {"body", "from body"}
        result["law"] = {"kind": "hardness", "hardness": "from body" if from_body else bodies.hardness}
    given = {key: getattr(solve, option) for key, option in CONTROLS.items() if getattr(solve, option) is not None}
    if len(given) > 1 or (not given and "control" not in table):
        options = [NAMES[f"control.{key}"] for key in given]
        choices = ", ".join(NAMES[f"control.{key}"] for key in CONTROLS)
        raise InputError(
            f"load must be given by exactly one of {choices}, but is given by {' and '.join(options) or 'none'}."
        )
    if given:
        result["control"] = given
    settings = {"method": solve.solver, "tolerance": solve.tolerance}
    settings |= {"max_iterations": solve.max_iterations, "precision": solve.precision, "threads": solve.threads}
    stated = {key: value for key, value in settings.items() if value is not None}
    before = table.get("solver", {})
    if stated and isinstance(before, dict):
        result["solver"] = {**before, **stated}
    return result


def body_table(text: str, option: str, materials_file: Path | None) -> dict[str, Any]:
    """Body from its one line of text (see ``io.schemas.body_text``); named materials are looked up in the file."""
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


def _surface(file: Path, reading: ReadingOptions, preparation: PreparationOptions) -> dict[str, Any]:
    keys = {"channel": reading.channel, "size": reading.size}
    keys |= {"height_unit": reading.height_unit, "z_scale": reading.z_scale}
    given = {key: value for key, value in keys.items() if value is not None}
    return {"kind": "file", "path": str(file), **given, "prepare": steps(preparation)}


def steps(preparation: PreparationOptions) -> list[dict[str, Any]]:
    """Preparation steps in the order crop, level, fill, resample, taper, periodise."""
    level = require.one_of(preparation.level, ("mean", "plane", "quadratic", "none"), "--level")
    fill = require.one_of(preparation.fill, ("harmonic", "nearest", "mean", "none"), "--fill")
    result: list[dict[str, Any]] = []
    if preparation.crop is not None:
        result.append({"step": "crop", **_crop(preparation.crop)})
    if level != "none":
        result.append({"step": "level", "form": level})
    if fill != "none":
        result.append({"step": "fill", "method": fill})
    if preparation.resample is not None:
        result.append({"step": "resample", "points": _points(preparation.resample)})
    if preparation.taper is not None:
        result.append({"step": "taper", "width": preparation.taper})
    if preparation.periodise:
        result.append({"step": "periodise"})
    return result


def step_names(steps: Sequence[Mapping[str, Any]]) -> dict[str, str]:
    """What the user calls the keys of the preparation ``steps``: the option that made the step."""
    return {
        f"{table}.prepare[{number}].{key}": f"{key} of --crop" if step["step"] == "crop" else f"--{step['step']}"
        for table in ("surface", "counter_surface")
        for number, step in enumerate(steps, start=1)
        for key in step
    }


def _crop(text: str) -> dict[str, list[str]]:
    """Ranges of ``"X0:X1,Y0:Y1"``; an empty part keeps the full side."""
    parts = [part.strip() for part in text.split(",")]
    ends = [[end.strip() for end in part.split(":")] for part in parts]
    if (
        len(parts) != 2
        or not any(parts)
        or any(part and len(pair) != 2 for part, pair in zip(parts, ends, strict=True))
    ):
        raise InputError(f'--crop must be two ranges of lengths, such as "0um:5um,0um:4um", but is {text!r}.')
    return {axis: pair for axis, part, pair in zip("xy", parts, ends, strict=True) if part}


def _points(text: str) -> list[int]:
    match = re.fullmatch(r"\s*(\d+)\s*(?:[x×]\s*(\d+)\s*)?", text)
    if match is None:
        raise InputError(f"--resample must be one or two numbers of points, such as 256x256, but is {text!r}.")
    return [int(match.group(1)), int(match.group(2) or match.group(1))]
