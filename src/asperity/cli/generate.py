"""The command ``generate``: one subcommand for every kind of surface, whose options follow from
what makes it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import typer

from ..core.errors import InputError
from ..core.parameters import REQUIRED, Parameter, parameters, taken_apart
from ..core.settings import COMMAND_LINE, validated
from ..core.units import parse, show
from ..core.values import Choice, Number
from ..core.words import first_paragraph
from ..io.atomic import require_new_files
from ..io.schemas.surfaces import (
    AMPLITUDES,
    HEIGHTS_TABLES,
    SPECTRUM_TABLES,
    SURFACE_TABLES,
    AnySurface,
    FileSurface,
    LineScanFile,
)
from ..io.surface_files import ENDINGS, require_ending, save_endless, save_gaussian, save_surface
from ..io.words import surface_text
from ..plots.contact import save_surface_plot
from ..run.build import build_generated, build_part, large_grid, stated_points, table_grid
from ..surfaces.characterise.heights import height_parameters
from ..surfaces.characterise.moments import spectral_moments
from ..surfaces.characterise.slopes import rms_slope
from ..surfaces.characterise.spectrum import power_spectrum
from ..surfaces.generate.digital_filter import endless
from ..surfaces.generate.gaussian import Spectrum
from ..surfaces.generate.non_gaussian import Marginal
from ..surfaces.profile import Profile
from ..surfaces.surface import Surface
from .declared import Given, Option, built, options_of
from .main import Listing
from .options import steps
from .show import confirmed, console, interruptible, print_advice, print_files, say, shown, stage, table

STREAMED = ("digital_filter", "rough")
"""Kinds that can be written piece by piece."""


SAME = 5e-3
"""Relative difference of two definitions of the rms slope up to which one number is stated."""


class Kinds(Listing):
    """Subcommands that are made when they are asked for."""

    @staticmethod
    def lines() -> Mapping[str, str]:
        """Names of all kinds and what they are."""
        return {kind: first_paragraph(made).replace("``", "") for kind, made in SURFACE_TABLES.items()}

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """Subcommand of one kind, with dashes or underscores; None if there is none of the name."""
        kind = cmd_name.replace("-", "_")
        return _command(kind) if kind in SURFACE_TABLES else None


app = typer.Typer(name="generate", cls=Kinds, no_args_is_help=True, add_completion=False, rich_markup_mode=None)


@app.callback()
def generate() -> None:
    """Generate a rough surface, a texture or an indenter and write it to a file.

    Example: asperity generate rough --points 512 --size 10um --spectrum self_affine --rms-height
    5nm --hurst 0.8 --rolloff-wavelength 2um --shortest-wavelength 80nm --seed 1 --out rough.nc

    asperity generate KIND --help lists the options of a kind.
    """


def _command(kind: str) -> Any:
    """The subcommand of ``kind``."""

    def run(
        given: Given,
        out: Annotated[
            Path,
            typer.Option("--out", help=f"File to write: {', '.join(ENDINGS)}; .nc keeps all that is known of it."),
        ],
        plot: Annotated[Path | None, typer.Option("--plot", help="Write a picture of the heights, PNG.")] = None,
        force: Annotated[bool, typer.Option("--force", help="Replace files that exist.")] = False,
        yes: Annotated[bool, typer.Option("--yes", help="Do not ask before work that takes much memory.")] = False,
    ) -> None:
        if plot is not None and plot.suffix.lower() != ".png":
            raise InputError(f"--plot must be the name of a PNG file, such as heights.png, but is {str(plot)!r}.")
        require_ending(out)
        written = [path for path in (out, plot) if path is not None]
        require_new_files(written, overwrite=force)
        asked = {"kind": kind} | given.table()
        memory = asked.pop("memory", None)
        for part in asked.values():
            if isinstance(part, dict) and "surface" in part:
                part["surface"] = {"kind": "file", **part["surface"], "prepare": steps(Given({}))}
        asked_for: Any = _checked(kind, asked, given.names)
        if memory is not None:
            _stream(asked_for, out, memory, force)
            print_files([out])
            return
        confirmed(large_grid(stated_points(asked_for)), yes=yes)
        if kind == "rank_ordered":
            with shown("ordering ranks") as bar, interruptible(bar) as progress:
                surface = build_generated(asked_for, Path(), progress=progress)
        else:
            surface = build_generated(asked_for, Path())
        save_surface(surface, out, overwrite=force)
        if plot is not None:
            save_surface_plot(surface, plot, overwrite=force)
        found = height_parameters(surface)
        rows = [
            ("surface", f"{surface.origin.source}: {surface_text(surface)}"),
            ("pixel", f"{show(surface.dx, 'm')} × {show(surface.dy, 'm')}"),
            ("boundary", "periodic" if surface.periodic else "not periodic"),
            ("rms height Sq", show(found.Sq, "m")),
            ("rms slope Sdq", _slope(surface)),
            ("skewness Ssk, kurtosis Sku", f"{found.Ssk:.4g}, {found.Sku:.4g}"),
            ("peak to valley Sz", show(found.Sz, "m")),
        ]
        console().print(table("Generated", rows))
        for step in surface.origin.history:
            say(f"  {step}", "dim")
        print_advice(surface.origin.findings)
        print_files(written)

    run.__doc__ = (SURFACE_TABLES[kind].__doc__ or "").replace("``", "")
    return built(run, kind, options(kind))


def _checked(kind: str, asked: dict[str, Any], names: Mapping[str, str]) -> Any:
    """The table of a surface of ``kind`` as ``asked``; a missing amplitude of a spectrum is named
    with all else that is missing.

    Raises
    ------
    InputError
        If anything is missing or out of range.
    """
    missing = []
    for part, given in asked.items():
        keys = [key for key in AMPLITUDES if f"{part}.{key}" in names]
        of_kind = (
            SPECTRUM_TABLES.get(str(given.get("kind", "")).lower().replace("-", "_"))
            if isinstance(given, dict)
            else None
        )
        if of_kind is not None and keys and {*keys} <= {*of_kind.model_fields} and not {*keys} & {*given}:
            missing.append(
                f"{part} must give exactly one of {', '.join(names[f'{part}.{key}'] for key in keys)}, but gives none."
            )
    try:
        return validated(SURFACE_TABLES[kind], asked, COMMAND_LINE, names)
    except InputError as error:
        lines = [line.strip() for line in str(error).splitlines() if not line.startswith(COMMAND_LINE)]
        found = [line for line in lines if "exactly one" not in line or not missing] + missing
        if not missing:
            raise
        if len(found) == 1:
            raise InputError(found[0]) from None
        listed = "\n".join(f"  {line}" for line in found)
        raise InputError(f"{COMMAND_LINE} has {len(found)} problems:\n{listed}", subject=COMMAND_LINE) from None


def _slope(surface: Surface) -> str:
    """Rms slope between neighbouring points, and of a periodic surface that of the waves
    themselves, where a spectrum prescribes it."""
    if min(surface.shape) < 2:
        return "of a profile: none"
    between = rms_slope(surface)
    waves = math.sqrt(2.0 * spectral_moments(power_spectrum(surface)).m2) if surface.periodic else between
    same = abs(waves - between) <= SAME * waves
    return (
        show(between, "1")
        if same
        else f"{show(between, '1')} between neighbouring points, {show(waves, '1')} of the waves themselves"
    )


def options(kind: str) -> list[Option]:
    """All options of a kind, those of its own first."""
    model = SURFACE_TABLES[kind]
    types = {Spectrum: SPECTRUM_TABLES, Marginal: HEIGHTS_TABLES}
    made = {item.name: (item, types.get(taken_apart(item.annotation)[0])) for item in parameters(model.makes)}
    parts = {name: (item, tables) for name, (item, tables) in made.items() if tables is not None}
    scans = _line_scans(kind)
    found = [option for name in scans for option in _line_scan_options(name)]
    found += options_of(model, leave=("kind", *AnySurface.model_fields, *parts, *scans))
    for item, tables in parts.values():
        found += _part_options(item, tables)
    if kind in STREAMED:
        text = "write piece by piece within this memory (2GB), to an .npy file of any size"
        found.append(Option("--memory", ("memory",), Parameter("memory", str, Number("memory"), None, text)))
    return found


def _line_scans(kind: str) -> list[str]:
    """Names of the arguments of a kind that are line scans."""
    return [item.name for item in parameters(SURFACE_TABLES[kind].makes) if taken_apart(item.annotation)[0] is Profile]


def _line_scan_options(name: str) -> list[Option]:
    """Options for the file of the line scan ``name`` and how it is read."""
    leave = ("kind", "size", "z_scale", *AnySurface.model_fields)
    return [
        replace(option, name="--file", required=True) if option.path[-1] == "path" else option
        for option in options_of(LineScanFile, (name,), leave=leave)
    ]


def _part_options(item: Parameter, tables: Any) -> list[Option]:
    """Options of a table within the table, of whatever kind it may be; its kinds share options of
    the same name."""
    kinds = Choice({kind: kind for kind in tables})
    choice = Parameter("kind", str, kinds, REQUIRED, f"kind of the {item.help}")
    found = {"--" + item.name: Option("--" + item.name, (item.name, "kind"), choice, required=True)}
    for kind in tables.values():
        prefix = "" if item.name in ("spectrum", "heights") else f"{item.name}-"
        offered = [*options_of(kind, (item.name,), leave=("kind", "surface"), prefix=prefix)]
        if "surface" in kind.model_fields:
            file = {"path": "file", **{key: f"file-{key}" for key in ("channel", "size", "height_unit")}}
            for option in options_of(FileSurface, (item.name, "surface")):
                if (key := option.path[-1]) in file:
                    name = f"--{item.name}-{file[key]}".replace("_", "-")
                    offered.append(Option(name, option.path, option.parameter))
        for option in offered:
            others = ("--rms",) if option.name == "--rms-height" else ()
            found.setdefault(option.name, Option(option.name, option.path, option.parameter, others=others))
    return list(found.values())


def _stream(table: Any, out: Path, memory: str, force: bool) -> None:
    """Write a surface beyond the memory: an endless one tile by tile, a Gaussian one by transforms
    on the disk."""
    if table.kind == "digital_filter" and table.periodic:
        raise InputError("--memory must be left out with --periodic: this periodic surface is generated as a whole.")
    if table.kind == "rough" and (table.variant != "random" or table.exact_rms or not table.periodic):
        raise InputError(
            "--memory must be left out with --variant, --exact-rms and --no-periodic: beyond the memory "
            "Gaussian surfaces are periodic, with random waves. Use digital_filter for a window without "
            "period."
        )
    grid = table_grid(table)
    spectrum = build_part(table.spectrum, Path())
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
