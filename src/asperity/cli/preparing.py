"""Options that prepare a measured surface, and the steps of the document they stand for."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any

from ..core.errors import InputError
from .options import options_of

PREPARATION = "Preparation, in this order"

_option = options_of(PREPARATION)


@dataclass(frozen=True)
class PreparationOptions:
    """Steps between the file and the contact; they apply to the counter surface too."""

    crop: Annotated[str | None, _option("--crop", 'Part to keep: "0um:5um,0um:4um".', "X0:X1,Y0:Y1")] = None
    despike: Annotated[
        float | None, _option("--despike", "Mask spikes beyond so many standard deviations, such as 6.", "NUMBER")
    ] = None
    line_correct: Annotated[
        str | None, _option("--line-correct", "Remove offsets between scan lines along x or y.", "AXIS")
    ] = None
    level: Annotated[
        str, _option("--level", "Remove mean, plane, quadratic or a polynomial of the degree given; or none.")
    ] = "plane"
    robust_level: Annotated[bool, _option("--robust-level", "Level without outliers, such as peaks and pits.")] = False
    fill: Annotated[str, _option("--fill", "Fill missing points: harmonic, nearest or mean; or none.")] = "harmonic"
    tip_radius: Annotated[
        str | None, _option("--tip-radius", "Remove waves that a tip of this radius may have shaped.", "LENGTH")
    ] = None
    short_cutoff: Annotated[str | None, _option("--short-cutoff", "Remove shorter waves: 0.8um.", "LENGTH")] = None
    long_cutoff: Annotated[str | None, _option("--long-cutoff", "Remove longer waves: 80um.", "LENGTH")] = None
    filter: Annotated[
        str, _option("--filter", "Filter for the cut-offs: gaussian, robust, or sharp (after --periodise).")
    ] = "gaussian"
    resample: Annotated[str | None, _option("--resample", "New number of points.", "NX[xNY]")] = None
    taper: Annotated[
        float | None, _option("--taper", "Taper this fraction of the side at each border.", "FRACTION")
    ] = None
    periodise: Annotated[bool, _option("--periodise", "Remove the jumps between opposite borders.")] = False
    line: Annotated[
        str | None,
        _option("--line", "One line of the map, for --boundary line: y=middle; x=3um. Loads per metre.", "AXIS=PLACE"),
    ] = None


_LEVELS = ("mean", "plane", "quadratic", "none")
_NAMES = {
    ("filter", "short"): "--short-cutoff",
    ("filter", "long"): "--long-cutoff",
    ("tip_limit", "radius"): "--tip-radius",
    ("tip_limit", "step"): "--tip-radius",
    ("line_correct", "axis"): "--line-correct",
    ("level", "robust"): "--robust-level",
    **{("slice", key): "--line" for key in ("step", "x", "y", "length")},
}


def steps(preparation: PreparationOptions) -> list[dict[str, Any]]:
    """Preparation steps in the order of the options; a sharp filter needs a periodic surface, so that it comes after that."""
    from ..core import require

    fill = require.one_of(preparation.fill, ("harmonic", "nearest", "mean", "none"), "--fill")
    cutoffs = {"short": preparation.short_cutoff, "long": preparation.long_cutoff}
    given = {key: value for key, value in cutoffs.items() if value is not None}
    kind = require.one_of(preparation.filter, ("gaussian", "robust", "sharp"), "--filter")
    if kind != "gaussian" and not given:
        raise InputError(f"--filter {kind} must be given together with --short-cutoff or --long-cutoff, but is alone.")
    sieve = [{"step": "filter", **given, "kind": kind}] if given else []
    candidates: list[tuple[object, dict[str, Any]]] = [
        (preparation.crop, {"step": "crop", **_crop(preparation.crop)} if preparation.crop is not None else {}),
        (preparation.despike, {"step": "despike", "threshold": preparation.despike}),
        (preparation.line_correct, {"step": "line_correct", "axis": preparation.line_correct}),
        (preparation.level != "none" or None, _level(preparation)),
        (fill != "none" or None, {"step": "fill", "method": fill}),
        (preparation.tip_radius, {"step": "tip_limit", "radius": preparation.tip_radius}),
        *((True, step) for step in sieve if kind != "sharp"),
        (preparation.resample, {"step": "resample", "points": _points(preparation.resample)}),
        (preparation.taper, {"step": "taper", "width": preparation.taper}),
        (preparation.periodise or None, {"step": "periodise"}),
        *((True, step) for step in sieve if kind == "sharp"),
        (preparation.line, {"step": "slice", **_line(preparation.line)}),
    ]
    return [step for wanted, step in candidates if wanted is not None]


def step_names(steps: Sequence[Mapping[str, Any]]) -> dict[str, str]:
    """What the user calls the keys of the preparation ``steps``: the option that made the step."""
    return {
        f"{table}.prepare[{number}].{key}": _name(str(step["step"]), key)
        for table in ("surface", "counter_surface")
        for number, step in enumerate(steps, start=1)
        for key in step
    }


def _name(step: str, key: str) -> str:
    return f"{key} of --crop" if step == "crop" else _NAMES.get((step, key), f"--{step}")


def _level(preparation: PreparationOptions) -> dict[str, Any]:
    from ..core import require

    robust = {"robust": True} if preparation.robust_level else {}
    if preparation.level.isdigit():
        return {"step": "level", "degree": int(preparation.level), **robust}
    return {"step": "level", "form": require.one_of(preparation.level, (*_LEVELS, "a degree"), "--level"), **robust}


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


def _line(text: str | None) -> dict[str, str]:
    """Position of ``"y=middle"``."""
    if text is None:
        return {}
    axis, equals, position = (part.strip() for part in text.partition("="))
    if axis not in ("x", "y") or not equals or not position:
        raise InputError(f'--line must be a position such as "y=middle" or "x=3um", but is {text!r}.')
    return {axis: position}


def _points(text: str | None) -> list[int]:
    return [] if text is None else points(text, "--resample")


def points(text: str, option: str) -> list[int]:
    """Numbers of points [nx, ny] of ``"256"`` or ``"256x128"``; ``option`` names it in the message."""
    match = re.fullmatch(r"\s*(\d+)\s*(?:[x×]\s*(\d+)\s*)?", text)
    if match is None:
        raise InputError(f"{option} must be one or two numbers of points, such as 256x256, but is {text!r}.")
    return [int(match.group(1)), int(match.group(2) or match.group(1))]
