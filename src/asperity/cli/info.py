"""The command ``info``: what is in files with heights."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from contextlib import nullcontext
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import typer

from ..core.errors import AsperityError, InputError
from ..core.units import percent, show
from ..io.atomic import require_new_file
from ..io.records import roughness_record
from ..io.words import surface_text
from ..parts.part import Table
from ..plots.contact import save_surface_plot
from ..plots.surface import roughness_figures
from ..plots.together import save_pictures
from ..report.roughness import quantity_rows, write_files_report, write_roughness_report
from ..surfaces.characterise.heights import mean_absolute_height, peak_to_valley, rms_height
from ..surfaces.characterise.slopes import rms_slope
from ..surfaces.characterise.summary import Characterisation, characterise
from ..surfaces.formats import ChannelInfo, chosen
from ..surfaces.read import channels
from ..surfaces.surface import Surface
from .declared import FILE, Given, Option, offers
from .main import NOT_CONVERGED, OK
from .one_surface import one_surface, one_surface_options, require_one_surface, tip_radius
from .options import levelled_as, own_option, read_surface, reading_options
from .show import console, print_files, say, short_names, silence, table


def _options() -> list[Option]:
    output = {"report": "write a page on the roughness, HTML", "plot": "write a picture of the heights, PNG"}
    output["plots"] = "write all pictures into this folder"
    tip = own_option("--tip-radius", ("tip_radius",), "radius of the tip: shorter waves are not fitted", None, "LENGTH")
    return [
        tip,
        *one_surface_options(),
        *(own_option(f"--{name}", ("output", name), text, None, FILE) for name, text in output.items()),
        *reading_options(),
    ]


@offers(_options)
def info(
    given: Given,
    files: Annotated[list[Path], typer.Argument(help="File with heights; many give one table.", metavar="FILE")],
    full: Annotated[bool, typer.Option("--full", help="All roughness quantities, not only the first four.")] = False,
    level: Annotated[
        str,
        typer.Option(
            "--level",
            help="Removed before: mean, plane, quadratic or a polynomial of the degree given; by default "
            "the mean of a periodic surface, the plane of any other.",
            metavar="WORD",
        ),
    ] = "auto",
    as_json: Annotated[bool, typer.Option("--json", help="Print as JSON, all values in SI.")] = False,
    force: Annotated[bool, typer.Option("--force", help="Replace files that exist.")] = False,
) -> None:
    """Tell what is in files with heights: channels, size, pixel, units, roughness.

    Examples: asperity info scan.di --full; asperity info scans/*.di --report page.html;
    asperity info optical/*.opd afm/*.di --one-surface --plots pictures

    Roughness values are those after levelling: by the least-squares plane, of a periodic surface by
    its mean, unless another level is chosen.
    """
    paths = {name: Path(path) for name, path in given.under("output").table().items()}
    report, plot, plots = (paths.get(name) for name in ("report", "plot", "plots"))
    for name, path, suffix, example in (
        ("--plot", plot, ".png", "heights.png"),
        ("--report", report, ".html", "roughness.html"),
    ):
        if path is not None and path.suffix.lower() != suffix:
            kind = suffix[1:].upper()
            raise InputError(f"{name} must be the name of a {kind} file, such as {example}, but is {str(path)!r}.")
        if path is not None:
            require_new_file(path, overwrite=force)
    if given.get("one_surface"):
        one_surface(files, given, paths, full=full, as_json=as_json, force=force)
        return
    require_one_surface(given)
    if len(files) > 1:
        if full or plot or plots:
            raise InputError("--full, --plot and --plots must be left out with many files: give one file.")
        raise typer.Exit(_many(files, given, level, report, as_json=as_json, force=force))
    file = files[0]
    surface = read_surface(file, given)
    found, (flat, removed) = channels(file), levelled_as(surface, level)
    whole = characterise(flat, tip_radius=tip_radius(given)) if full or report or plots else None
    shown = whole if full else None
    levelling = f"degree-{removed} levelling" if removed.isdigit() else f"{removed} levelling"
    if as_json:
        record = _record(file, found, surface, flat, shown) | {"levelled": removed}
        console().out(json.dumps(record, indent=2), highlight=False)
    else:
        _print(file, found, chosen(found, given.get("surface", "channel"), file).index, surface)
        _print_roughness(flat, shown, levelling)
    written: list[Path] = []
    figures = () if whole is None else roughness_figures(whole)
    if plot is not None:
        save_surface_plot(flat, plot, overwrite=force)
        written.append(plot)
    if whole is not None and plots is not None:
        written += save_pictures(figures, plots, overwrite=force)
    if whole is not None and report is not None:
        write_roughness_report(whole, report, figures=figures, overwrite=force)
        written.append(report)
    if written and not as_json:
        say(f"Pictures and pages show the heights after {levelling}.", "dim")
        print_files(written)


HEADINGS = ("file", "points", "size", "missing", "Sq", "Sa", "Sz", "Sdq", "levelled")


def _many(files: Sequence[Path], given: Given, level: str, report: Path | None, *, as_json: bool, force: bool) -> int:
    """Print one row for each file, and write them as a page; the exit code shows whether all could
    be read."""
    rows, records, lost = [], [], []
    for file, name in zip(files, short_names(files), strict=True):
        try:
            surface = read_surface(file, given)
            flat, removed = levelled_as(surface, level)
        except AsperityError as error:
            lost.append(f"{file}: {error}")
            rows.append((name, *("–" for _ in HEADINGS[1:])))
            continue
        records.append(_record(file, channels(file), surface, flat, None) | {"levelled": removed})
        size = " × ".join(show(side, "m", 3) for side in surface.size)
        roughness = [show(value, unit, 3) for value, unit, _ in _roughness(flat).values()]
        missing = percent(surface.n_missing / surface.grid.n_points)
        rows.append((name, " × ".join(map(str, surface.shape)), size, missing, *roughness, removed))
    if as_json:
        console().out(json.dumps(records, indent=2), highlight=False)
    else:
        made = table(f"{len(files)} files", rows, HEADINGS)
        made.columns[0].no_wrap = True
        console().print(made)
    with silence() if as_json else nullcontext():  # JSON stays alone on stdout
        for text in lost:
            say(f"warning: {text}", "yellow", warning=True)
    if report is not None:
        write_files_report(
            Table(HEADINGS, tuple(rows)),
            report,
            f"{len(files)} files, {len(lost)} not read.",
            overwrite=force,
        )
        if not as_json:
            print_files([report])
    return NOT_CONVERGED if lost else OK


def _roughness(flat: Surface) -> dict[str, tuple[float, str, str]]:
    """Value, unit and label by key of the roughness of a levelled surface."""
    try:
        slope = rms_slope(flat)
    except InputError:  # no two neighbouring valid points
        slope = math.nan
    return {
        "Sq": (rms_height(flat), "m", "rms height Sq"),
        "Sa": (mean_absolute_height(flat), "m", "mean absolute height Sa"),
        "Sz": (peak_to_valley(flat), "m", "peak to valley Sz"),
        "rms_slope": (slope, "1", "rms slope Sdq"),
    }


def _record(
    file: Path, found: tuple[ChannelInfo, ...], surface: Surface, flat: Surface, whole: Characterisation | None
) -> dict[str, Any]:
    roughness = {key: value if value == value else None for key, (value, _, _) in _roughness(flat).items()}
    return {
        "file": str(file),
        "channels": [asdict(channel) for channel in found],
        "channel": surface.origin.channel,
        "shape": surface.shape,
        "size": surface.size,
        "pixel": surface.grid.spacing,
        "missing": surface.n_missing,
        **roughness,
        "instrument": dict(surface.origin.instrument),
        **({} if whole is None else {"roughness": roughness_record(whole)}),
    }


def _print(file: Path, found: tuple[ChannelInfo, ...], read_index: int, surface: Surface) -> None:
    rows = [
        (
            f"channel {item.index}" + (" (read)" if item.index == read_index else ""),
            f"{item.name}, unit {item.unit or 'unknown'}",
        )
        for item in found
    ]
    share = surface.n_missing / surface.grid.n_points
    rows += [
        ("map", surface_text(surface)),
        ("pixel", f"{show(surface.dx, 'm')} × {show(surface.dy, 'm')}"),
        ("missing points", f"{surface.n_missing} ({percent(share)})"),
    ]
    rows += [(f"instrument: {key}", text) for key, text in surface.origin.instrument.items()]
    console().print(table(str(file), rows))


def _print_roughness(flat: Surface, whole: Characterisation | None, levelling: str) -> None:
    if whole is None:
        values = [(label, show(value, unit)) for value, unit, label in _roughness(flat).values()]
        console().print(table(f"Roughness after {levelling}", values))
        return
    say(f"Roughness after {levelling}", "bold")
    for heading, rows in quantity_rows(whole):
        console().print(table(heading, [(name, text) for name, text, _ in rows]))
    for remark in whole.remarks:
        say(remark, "yellow")
