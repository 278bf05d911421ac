"""The command ``predict``: a contact from a table of solved ones."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Annotated, Any

import typer

from ..contact.controls import Force, MeanPressure
from ..core.errors import InputError
from ..core.grid import Grid
from ..core.units import parse, parse_size, show
from ..io.atomic import require_new_file
from ..io.tables import write_table
from ..physics.prediction.predict import predict as predicted
from ..physics.prediction.prediction import MEANING, Prediction
from ..physics.prediction.waves import Rough
from ..run.build import body_of_text
from ..solids.elastic import Rigid
from ..surfaces.generate.autocorrelation import ExponentialAutocorrelation
from ..surfaces.profile import Profile, no_area
from .declared import FILE, Given, Option, offers
from .options import LOAD, OUTPUT, body_options, heights_in, levelled_as, own_option, reading_options
from .show import console, print_advice, print_files, say, table

SURFACE, PULL = "Surface without a file", "Pull"
NUMBERS = {"rms_height": "--rms-height", "correlation_length": "--correlation-length", "pixel": "--pixel"}


def _options() -> list[Option]:
    make = own_option
    return [
        *(option for option in body_options() if option.name in ("--body", "--counter")),
        make("--pressure", ("load", "pressure"), "mean pressure, such as 50MPa", LOAD, "PRESSURE"),
        make("--load", ("load", "force"), "force on the whole surface, such as 10mN", LOAD, "FORCE"),
        make("--rms-height", ("rough", "rms_height"), "rms height", SURFACE, "LENGTH"),
        make(
            "--correlation-length",
            ("rough", "correlation_length"),
            "10 % length of the autocorrelation",
            SURFACE,
            "LENGTH",
        ),
        make("--pixel", ("rough", "pixel"), "size of a pixel; --size is that of the surface", SURFACE, "LENGTH"),
        make("--pull", ("pull", "tension"), "tension where the gap is small; 2γ/h of a liquid film", PULL, "PRESSURE"),
        make("--reach", ("pull", "reach"), "largest gap across which it pulls; h of a film", PULL, "LENGTH"),
        make("--hardness", ("law", "hardness"), "limit of the pressure, such as 6GPa", LOAD, "PRESSURE"),
        make("--csv", ("output", "csv"), "write the numbers as a CSV file, in SI", OUTPUT, FILE),
        *reading_options(),
    ]


@offers(_options)
def predict(
    given: Given,
    file: Annotated[
        Path | None, typer.Argument(help="File with heights; or give --rms-height and so on.", metavar="FILE")
    ] = None,
    level: Annotated[
        str, typer.Option("--level", help="Removed before: mean, plane, quadratic or a degree.", metavar="WORD")
    ] = "auto",
    as_json: Annotated[bool, typer.Option("--json", help="Print as JSON, all values in SI.")] = False,
    force: Annotated[bool, typer.Option("--force", help="Replace files that exist.")] = False,
) -> None:
    """Predict area, largest pressure and gap of a rough contact in milliseconds, without solving.

    Examples: asperity predict scan.di --body steel --pressure 50MPa; asperity predict --rms-height
    1nm --correlation-length 0.5um --pixel 40nm --size 10um --body steel --pressure 50MPa

    The numbers are read from a table of solved contacts. Outside of it the command says what to
    solve instead.
    """
    csv = given.get("output", "csv")
    if csv is not None:
        require_new_file(Path(csv), overwrite=force)
    body = given.get("body")
    if body is None:
        raise InputError("--body must be given, such as --body DLC; the command `asperity materials` lists the names.")
    counter = given.get("counter_body")
    surface, grid, hardness = *_surface(file, given, level), given.get("law", "hardness")
    found = predicted(
        surface,
        body_of_text(body, "--body"),
        _load(given),
        grid=grid,
        counter_body=Rigid() if counter is None else body_of_text(counter, "--counter"),
        pull=_pull(given),
        hardness=None if hardness is None else parse(hardness, "pressure", "--hardness"),
    )
    if csv is not None:
        write_table(_rows(found), Path(csv), overwrite=force)
    if as_json:
        console().out(json.dumps(record(found), indent=2), highlight=False)
        return
    _print(found)
    if csv is not None:
        print_files([Path(csv)])


def _surface(file: Path | None, given: Given, level: str) -> tuple[Rough, Grid | None]:
    """Map in the ``file``, or the spectrum and the grid of the numbers that are given."""
    texts = given.under("rough").table()
    if file is not None:
        if texts:
            options = " and ".join(NUMBERS[key] for key in texts)
            raise InputError(f"{options} must be left out with a file, which is measured, but is given.")
        heights = heights_in(file, given)
        if isinstance(heights, Profile):
            raise no_area()
        return levelled_as(heights, level)[0], None
    texts["size"] = given.get("surface", "size")
    missing = [option for key, option in {**NUMBERS, "size": "--size"}.items() if texts.get(key) is None]
    if missing:
        raise InputError(f"FILE or {', '.join(missing)} must be given, but is not.")
    rms, length, pixel = (parse(texts[key], "length", option) for key, option in NUMBERS.items())
    sides = parse_size(texts["size"], "--size")
    points = [max(1, round(side / pixel)) for side in sides]
    grid = Grid((points[0], points[1]), (sides[0] / points[0], sides[1] / points[1]))
    return ExponentialAutocorrelation(rms, length), grid


def _load(given: Given) -> MeanPressure | Force:
    texts = given.under("load").table()
    if len(texts) != 1:
        raise InputError(
            f"load must be given by --pressure or --load, but is given by {'both' if texts else 'neither'}."
        )
    if "pressure" in texts:
        return MeanPressure(parse(texts["pressure"], "pressure", "--pressure"))
    return Force(parse(texts["force"], "force", "--load"))


def _pull(given: Given) -> tuple[float, float] | None:
    texts = given.under("pull").table()
    if not texts:
        return None
    if len(texts) == 1:
        raise InputError("--pull and --reach must be given together, but one is missing.")
    return parse(texts["tension"], "pressure", "--pull"), parse(texts["reach"], "length", "--reach")


def _rows(found: Prediction) -> list[tuple[Any, ...]]:
    """Heading and rows of a table in SI."""
    rows: list[tuple[Any, ...]] = [("name", "unit", "value", "error", "scatter", "low", "high", "meaning")]
    rows += [
        (quantity.name, quantity.unit, value.value, value.error, value.scatter, *value.band, quantity.label)
        for quantity, value in found.values()
    ]
    return rows


def record(found: Prediction) -> dict[str, Any]:
    """``found`` as plain values in SI; a number that is not known is left out."""
    names, *rows = _rows(found)
    return {
        "values": {row[0]: dict(zip(names[1:], row[1:], strict=True)) for row in rows},
        "pressure": found.pressure,
        "groups": {key: value if math.isfinite(value) else None for key, value in _groups(found).items()},
        "full_contact_pressure": found.waves.full_contact,
        "rms_height": found.waves.rms,
        "correlation_length": found.waves.length,
        "findings": [finding.message for finding in found.findings],
    }


def _groups(found: Prediction) -> dict[str, float]:
    return {key: getattr(found.groups, key) for key in ("y", "X", "nayak", "size", "ratio", "thickness")}


def _print(found: Prediction) -> None:
    """Print the numbers with their bands, the groups and the findings."""
    rows = []
    for quantity, value in found.values():
        low, high = (show(end, quantity.unit, 3) for end in value.band)
        rows.append(
            (
                quantity.label,
                show(value.value, quantity.unit, 3),
                show(value.error, quantity.unit, 2),
                f"{low} … {high}",
            )
        )
    console().print(table("Predicted, not solved", rows, ("", "mean", "error", "19 of 20 surfaces")))
    groups = [(MEANING[key], f"{value:.4g}") for key, value in _groups(found).items() if math.isfinite(value)]
    groups.append(("rms pressure of full contact", show(found.waves.full_contact, "Pa")))
    groups += [("rms height", show(found.waves.rms, "m")), ("10 % length", show(found.waves.length, "m"))]
    console().print(table("Groups", groups))
    print_advice(found.findings)
    say("To solve it: `asperity contact FILE` with the same body and load.", "dim")
