"""The command ``info``: what is in files with heights."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from dataclasses import asdict, dataclass
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
from ..surfaces.characterise.slopes import rms_profile_slope, rms_slope
from ..surfaces.characterise.summary import Characterisation, characterise
from ..surfaces.formats import HEIGHT, ChannelInfo, chosen
from ..surfaces.formats_archive import scans
from ..surfaces.profile import Profile
from ..surfaces.read import channels, read_doubtful
from ..surfaces.surface import Surface, strip
from .declared import FILE, Given, Option, offers
from .info_line import info_line, require_no_cutoffs, tip_radius
from .main import NOT_CONVERGED, OK
from .one_surface import one_surface, one_surface_options, require_one_surface
from .options import levelled_as, own_option, reading_options, reading_table
from .show import console, print_files, say, short_names, silence, table


def _options() -> list[Option]:
    output = {"report": "write a page on the roughness, HTML", "plot": "write a picture of the heights, PNG"}
    output["plots"] = "write all pictures into this folder"
    lengths = {
        "lambda-c": "cut-off λc of a line scan, by default that of its measured Ra",
        "lambda-s": "its cut-off λs",
    }
    tip = own_option("--tip-radius", ("tip_radius",), "radius of the tip: shorter waves are not fitted", None, "LENGTH")
    return [
        tip,
        *(own_option(f"--{key}", (key.replace("-", "_"),), text, None, "LENGTH") for key, text in lengths.items()),
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
    _require_outputs(report, plot, overwrite=force)
    entries = [scan for file in files for scan in _scans(file, given)]
    if given.get("one_surface"):
        one_surface(
            [(str(scan), scan.read(given)[0]) for scan in entries],
            given,
            paths,
            full=full,
            as_json=as_json,
            force=force,
        )
        return
    require_one_surface(given)
    if len(entries) > 1:
        if full or plot or plots:
            raise InputError("--full, --plot and --plots must be left out with many files: give one file.")
        raise typer.Exit(_many(entries, given, level, report, as_json=as_json, force=force))
    file = files[0]
    surface, found = _Scan(file).read(given)
    if isinstance(surface, Profile):
        shown_as = "json" if as_json else "full" if full else "short"
        raise typer.Exit(info_line(file, surface, given, level, shown_as, force=force))
    require_no_cutoffs(file, given)
    radius = tip_radius(given)
    flat, removed = levelled_as(surface, level)
    whole = characterise(flat, tip_radius=radius) if full or report or plots else None
    shown = whole if full else None
    levelling = f"degree-{removed} levelling" if removed.isdigit() else f"{removed} levelling"
    if as_json:
        record = _record(str(file), found, surface, flat, shown) | {"levelled": removed}
        console().out(json.dumps(record, indent=2), highlight=False)
    else:
        _print(file, found, _read_index(found, given.get("surface", "channel"), file), surface)
        _print_roughness(flat, shown, levelling)
        for finding in surface.origin.findings:
            say(f"{finding.level}: {finding.message}", "yellow" if finding.level == "warning" else "dim")
    written = _written(flat, whole, {"plot": plot, "plots": plots, "report": report}, force=force)
    if written and not as_json:
        say(f"Pictures and pages show the heights after {levelling}.", "dim")
        print_files(written)


def _written(
    flat: Surface, whole: Characterisation | None, paths: Mapping[str, Path | None], *, force: bool
) -> list[Path]:
    """Write the picture, the pictures and the page that are asked for; their files."""
    plot, plots, report = (paths[name] for name in ("plot", "plots", "report"))
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
    return written


def _require_outputs(report: Path | None, plot: Path | None, *, overwrite: bool) -> None:
    """Refuse names of other kinds of files, and files that exist unless they are to be replaced."""
    for name, path, suffix, example in (
        ("--plot", plot, ".png", "heights.png"),
        ("--report", report, ".html", "roughness.html"),
    ):
        if path is not None and path.suffix.lower() != suffix:
            kind = suffix[1:].upper()
            raise InputError(f"{name} must be the name of a {kind} file, such as {example}, but is {str(path)!r}.")
        if path is not None:
            require_new_file(path, overwrite=overwrite)


HEADINGS = ("file", "points", "size", "missing", "Sq", "Sa", "Sz", "Sdq", "levelled")


@dataclass(frozen=True)
class _Scan:
    """A file, or a scan in an archive of several: its ``number`` and its ``member``."""

    file: Path
    number: int | None = None
    member: str = ""

    def read(self, given: Given) -> tuple[Surface | Profile, tuple[ChannelInfo, ...]]:
        """Surface or line scan, and channels, as the options that are ``given`` ask."""
        asked = reading_table(self.file, given).reading()
        if self.number is not None:
            asked["channel"] = self.number
        return read_doubtful(self.file, **asked), channels(self.file, **asked)

    def __str__(self) -> str:
        return f"{self.file}/{self.member}" if self.member else str(self.file)


def _scans(file: Path, given: Given) -> list[_Scan]:
    """What there is to read in ``file``: itself, or the scans of an archive of which none is
    chosen."""
    try:
        members = scans(file) if file.is_file() and given.get("surface", "channel") is None else None
    except AsperityError:  # it is said where the file is read
        members = None
    if members is None or len(members) == 1:
        return [_Scan(file)]
    return [_Scan(file, number, scan.name) for number, scan in enumerate(members)]


def _many(files: Sequence[_Scan], given: Given, level: str, report: Path | None, *, as_json: bool, force: bool) -> int:
    """Print one row for each file or scan, and write them as a page; the exit code shows whether
    all could be read."""
    rows, records, lost, doubts = [], [], [], list[str]()
    for file, name in zip(files, short_names([Path(str(file)) for file in files]), strict=True):
        try:
            held, found = file.read(given)
            line = isinstance(held, Profile)  # its strip has any length
            surface = strip(held) if isinstance(held, Profile) else held
            flat, removed = levelled_as(surface, level)
        except AsperityError as error:
            lost.append(f"{file}: {error}")
            rows.append((name, *("–" for _ in HEADINGS[1:])))
            continue
        doubts += [f"{file}: {item.message}" for item in surface.origin.findings if item.level == "warning"]
        records.append(_record(str(file), found, surface, flat, None) | {"levelled": removed})
        size = " × ".join(show(side, "m", 3) for side in surface.size[: 1 if line else 2])
        roughness = [show(value, unit, 3) for value, unit, _ in _roughness(flat).values()]
        missing = percent(surface.n_missing / surface.grid.n_points)
        rows.append((name, " × ".join(map(str, surface.shape[: 1 if line else 2])), size, missing, *roughness, removed))
    if as_json:
        console().out(json.dumps(records, indent=2), highlight=False)
    else:
        headings, shown, left = one_line_each(HEADINGS, rows, console().width)
        made = table(f"{len(files)} files", shown, headings)
        made.columns[0].no_wrap = True
        console().print(made)
        if left:
            say(f"  left out for want of room: {', '.join(left)}; --json has all", "dim")
    with silence() if as_json else nullcontext():  # JSON stays alone on stdout
        for text in (*lost, *doubts):
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


_FIRST_LEFT = ("levelled", "Sa", "Sz", "Sdq", "missing", "size")
"""Columns that are left out where the terminal is narrow, the first ones first."""


def one_line_each(
    headings: Sequence[str], rows: Sequence[tuple[str, ...]], width: int
) -> tuple[tuple[str, ...], list[tuple[str, ...]], tuple[str, ...]]:
    """Headings and rows of a table that has one line for each row in a terminal of ``width``, and
    the headings left out.

    What all rows share needs no column: the table says it once. Columns are left out in turn, then
    names are shortened.
    """
    shared = {number for number in range(len(headings)) if len(rows) > 1 and len({row[number] for row in rows}) == 1}
    wide = [max(len(headings[number]), *(len(row[number]) for row in rows)) for number in range(len(headings))]
    kept = list(range(len(headings)))

    def room() -> int:
        """Characters that are left for the names."""
        others = [number for number in kept[1:] if number not in shared]
        return width - sum(wide[number] + 2 for number in others) - 4

    for name in _FIRST_LEFT:
        if room() >= min(wide[0], _NAME):
            break
        number = headings.index(name)
        if number not in shared:
            kept.remove(number)
    most = max(room(), 8)

    def shortened(name: str) -> str:
        return name if len(name) <= most else f"{name[: (most - 1) // 2]}…{name[len(name) - most // 2 :]}"

    shown = [(shortened(row[0]), *(row[number] for number in kept[1:])) for row in rows]
    left = tuple(heading for number, heading in enumerate(headings) if number not in kept)
    return tuple(headings[number] for number in kept), shown, left


_NAME = 28
"""Characters of a name beside which columns may stand."""


def _roughness(flat: Surface) -> dict[str, tuple[float, str, str]]:
    """Value, unit and label by key of the roughness of a levelled surface."""
    try:
        slope = rms_profile_slope(flat) if flat.shape[1] == 1 else rms_slope(flat)
    except InputError:  # no two neighbouring valid points
        slope = math.nan
    return {
        "Sq": (rms_height(flat), "m", "rms height Sq"),
        "Sa": (mean_absolute_height(flat), "m", "mean absolute height Sa"),
        "Sz": (peak_to_valley(flat), "m", "peak to valley Sz"),
        "rms_slope": (slope, "1", "rms slope Sdq"),
    }


def _record(
    file: str, found: tuple[ChannelInfo, ...], surface: Surface, flat: Surface, whole: Characterisation | None
) -> dict[str, Any]:
    roughness = {key: value if value == value else None for key, (value, _, _) in _roughness(flat).items()}
    return {
        "file": file,
        "channels": [asdict(channel) for channel in found],
        "channel": surface.origin.channel,
        "shape": surface.shape,
        "size": surface.size,
        "pixel": surface.grid.spacing,
        "missing": surface.n_missing,
        "read": surface.origin.history[0] if surface.origin.history else "",
        "findings": [item.message for item in surface.origin.findings],
        **roughness,
        "instrument": dict(surface.origin.instrument),
        **({} if whole is None else {"roughness": roughness_record(whole)}),
    }


def _read_index(found: tuple[ChannelInfo, ...], channel: str | None, file: Path) -> int:
    """Number of the channel that was read; of an archive that of the scan, which stands before the
    name of the channel in it."""
    try:
        return chosen(found, channel, file).index
    except AsperityError:
        return chosen(found, str(channel).partition(":")[0], file).index


def _print(file: Path, found: tuple[ChannelInfo, ...], read_index: int, surface: Surface) -> None:
    rows = [
        (
            f"channel {item.index}" + (" (read)" if item.index == read_index else ""),
            f"{item.name}, unit {item.unit or 'unknown'}"
            if item.kind == HEIGHT
            else f"{item.name}, no heights ({item.kind})",
        )
        for item in found
    ]
    share = surface.n_missing / surface.grid.n_points
    rows += [
        *((("read as", text),) if (text := _understood(surface)) else ()),
        ("map", surface_text(surface)),
        ("pixel", f"{show(surface.dx, 'm')} × {show(surface.dy, 'm')}"),
        ("missing points", f"{surface.n_missing} ({percent(share)})"),
    ]
    rows += [(f"instrument: {key}", text) for key, text in surface.origin.instrument.items()]
    console().print(table(str(file), rows))


def _understood(surface: Surface) -> str:
    """How the file was understood, as its history begins; empty where there was nothing to
    understand."""
    first = surface.origin.history[0] if surface.origin.history else ""
    if not first.startswith("read: ") or surface.origin.source not in first:
        return ""
    return first.partition(surface.origin.source)[2].lstrip(",; ")


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
