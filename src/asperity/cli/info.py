"""The command ``info``: what is in a file."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .options import ReadingOptions

if TYPE_CHECKING:
    from ..surfaces.channels import ChannelInfo
    from ..surfaces.surface import Surface


def info(
    file: Annotated[Path, typer.Argument(help="File with heights.")],
    reading: ReadingOptions,
    as_json: Annotated[bool, typer.Option("--json", help="Print as JSON, all values in SI.")] = False,
    plot: Annotated[Path | None, typer.Option("--plot", help="Write a picture of the heights, PNG.")] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace the picture if it exists.")] = False,
) -> None:
    """Say what is in a file: channels, size, pixel, units, missing points, roughness.

    Roughness values are those after subtraction of the least-squares plane.
    """
    import json

    from ..core.errors import InputError
    from ..io.atomic import require_new_file
    from ..surfaces.channels import chosen
    from ..surfaces.prepare.level import levelled
    from ..surfaces.read import channels
    from .show import console, print_files, say

    if plot is not None and plot.suffix.lower() != ".png":
        raise InputError(f"--plot must be the name of a PNG file, such as heights.png, but is {str(plot)!r}.")
    if plot is not None:
        require_new_file(plot, overwrite=force)
    surface = _read(file, reading)
    found, flat = channels(file), levelled(surface, "plane")
    if as_json:
        console().out(json.dumps(_record(file, found, surface, flat), indent=2), highlight=False)
    else:
        _print(file, found, chosen(found, reading.channel, file).index, surface, flat)
    if plot is not None:
        from ..plots.figures import save_surface_plot

        save_surface_plot(flat, plot, overwrite=force)
        if not as_json:
            say("The picture shows the heights after plane levelling.", "dim")
            print_files([plot])


def _read(file: Path, reading: ReadingOptions) -> Surface:
    from ..core.units import parse, parse_size
    from ..surfaces.read import read

    return read(
        file,
        channel=reading.channel,
        size=None if reading.size is None else parse_size(reading.size, "--size"),
        height_unit=reading.height_unit,
        z_scale=None if reading.z_scale is None else parse(reading.z_scale, "length", "--z-scale"),
    )


def _roughness(flat: Surface) -> dict[str, tuple[float, str, str]]:
    """Value, unit and label by key of the roughness of a levelled surface."""
    from ..core.errors import InputError
    from ..surfaces.characterise.heights import mean_absolute_height, peak_to_valley, rms_height
    from ..surfaces.characterise.slopes import rms_slope

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


def _record(file: Path, found: tuple[ChannelInfo, ...], surface: Surface, flat: Surface) -> dict[str, Any]:
    from dataclasses import asdict

    roughness = {key: value if value == value else None for key, (value, _, _) in _roughness(flat).items()}
    return {
        "file": str(file),
        "channels": [asdict(channel) for channel in found],
        "channel": surface.origin.channel,
        "shape": surface.shape,
        "size": surface.size,
        "pixel": surface.grid.spacing,
        "missing": surface.n_missing,
        "levelled": "plane",
        **roughness,
        "instrument": dict(surface.origin.instrument),
    }


def _print(file: Path, found: tuple[ChannelInfo, ...], read_index: int, surface: Surface, flat: Surface) -> None:
    from ..core.units import percent, show
    from .show import console, surface_text, table

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
    out = console()
    out.print(table(str(file), rows))
    values = [(label, show(value, unit)) for value, unit, label in _roughness(flat).values()]
    out.print(table("Roughness after plane levelling", values))
