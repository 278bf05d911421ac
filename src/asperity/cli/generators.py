"""Subcommands of ``generate``: options into a table, checked as in a document, into a surface, into files."""

from __future__ import annotations

import inspect
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from .generator_help import HELP
from .generator_options import KINDS, Key, keys, keyword, parameter, table_of

if TYPE_CHECKING:
    from ..surfaces.surface import Surface

__all__ = ["KINDS", "command"]


def command(kind: str) -> Any:
    """The subcommand of ``kind``."""
    options = keys(KINDS[kind])

    def run(out: Path, force: bool, plot: Path | None, **values: Any) -> None:
        _run(kind, options, values, (out, plot, force))

    streamed = kind in ("digital_filter", "rough")
    parameters = [parameter(key) for key in options]
    if streamed:
        parameters.append(keyword("memory", str | None, typer.Option("--memory", help=HELP["memory"]), None))
    out = typer.Option(
        "--out", help="File to write: .nc (all that is known of it), .txt, .asc or .npy.", metavar="FILE"
    )
    parameters += [
        keyword("out", Path, out, inspect.Parameter.empty),
        keyword("plot", Path | None, typer.Option("--plot", help="Write a picture of the heights, PNG."), None),
        keyword("force", bool, typer.Option("--force", help="Replace files that exist."), False),
    ]
    run.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    run.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
    run.__doc__ = inspect.cleandoc(KINDS[kind].__doc__ or "").replace("``", "")
    group = typer.Typer(add_completion=False)
    group.command(kind)(run)
    group.callback()(lambda: None)
    return typer.main.get_group(group).commands[kind]


def _run(kind: str, options: list[Key], values: dict[str, Any], files: tuple[Path, Path | None, bool]) -> None:
    from ..core.errors import InputError
    from ..io.atomic import require_new_files
    from ..io.surface_files import require_ending, save_surface
    from ..io.surface_tables import checked_surface
    from .show import print_files

    out, plot, force = files
    memory = values.pop("memory", None)
    if plot is not None and plot.suffix.lower() != ".png":
        raise InputError(f"--plot must be the name of a PNG file, such as heights.png, but is {str(plot)!r}.")
    require_ending(out)
    written = [path for path in (out, plot) if path is not None]
    require_new_files(written, overwrite=force)
    names = {".".join(key.path): key.option for key in options}
    table = checked_surface(table_of(kind, options, values), "command line", names)
    if memory is not None:
        _stream(table, out, memory, force)
        written = [out]
    else:
        surface = _generated(table)
        save_surface(surface, out, overwrite=force)
        _picture(surface, plot, force)
        _print(surface)
    print_files(written)


def _generated(table: Any) -> Surface:
    from ..io.build_generated import build_generated
    from ..io.build_surface import build_file_surface
    from .progress import stage

    if table.kind != "rank_ordered":
        return build_generated(table, Path(), build_file_surface)
    with stage("ordering ranks") as progress:
        return build_generated(table, Path(), build_file_surface, progress=progress)


def _stream(table: Any, out: Path, memory: str, force: bool) -> None:
    """Write a surface beyond the memory: an endless one tile by tile, a Gaussian one by transforms on the disk."""
    from ..core.units import parse
    from ..io.build_generated import build_spectrum, table_grid
    from ..io.build_surface import build_file_surface
    from ..io.surface_files import save_endless, save_gaussian
    from ..surfaces.generate import endless
    from .progress import stage
    from .show import say

    _require_streamable(table)
    grid = table_grid(table)
    spectrum = build_spectrum(table.spectrum, Path(), build_file_surface)
    if table.kind == "rough":
        with stage("writing blocks") as progress:
            limit = parse(memory, "memory", "--memory")
            save_gaussian(grid, spectrum, out, seed=table.seed, memory=limit, overwrite=force, progress=progress)
        return
    moments = {"skewness": table.skewness, "kurtosis": table.kurtosis, "system": table.system}
    made = endless(spectrum, grid.spacing, seed=table.seed, **moments)
    bytes_allowed = parse(memory, "memory", "--memory")
    with stage("writing tiles") as progress:
        save_endless(made, grid.shape, out, memory=bytes_allowed, overwrite=force, progress=progress)
    say(f"  {made.origin.history[0]}", "dim")


def _require_streamable(table: Any) -> None:
    from ..core.errors import InputError

    if table.kind == "digital_filter" and table.periodic:
        raise InputError("--memory must be left out with --periodic: this periodic surface is generated as a whole.")
    if table.kind == "rough" and (table.variant != "random" or table.exact_rms or not table.periodic):
        raise InputError(
            "--memory must be left out with --variant, --exact-rms and --no-periodic: beyond the memory Gaussian surfaces are "
            "periodic, with random waves. Use digital_filter for a window without period."
        )


def _picture(surface: Surface, plot: Path | None, force: bool) -> None:
    if plot is not None:
        from ..plots.contact import save_surface_plot

        save_surface_plot(surface, plot, overwrite=force)


def _print(surface: Surface) -> None:
    from ..core.units import show
    from ..io.words import surface_text
    from ..surfaces.characterise.heights import height_parameters
    from ..surfaces.characterise.slopes import rms_slope
    from .show import console, say, table

    found = height_parameters(surface)
    rows = [
        ("surface", f"{surface.origin.source}: {surface_text(surface)}"),
        ("pixel", f"{show(surface.dx, 'm')} × {show(surface.dy, 'm')}"),
        ("boundary", "periodic" if surface.periodic else "not periodic"),
        ("rms height Sq", show(found.Sq, "m")),
        ("rms slope Sdq", show(rms_slope(surface), "1") if min(surface.shape) > 1 else "of a profile: none"),
        ("skewness Ssk, kurtosis Sku", f"{found.Ssk:.4g}, {found.Sku:.4g}"),
        ("peak to valley Sz", show(found.Sz, "m")),
    ]
    console().print(table("Generated", rows))
    for step in surface.origin.history:
        say(f"  {step}", "dim")
