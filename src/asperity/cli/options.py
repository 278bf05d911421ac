"""The options of the commands, in groups that commands share."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Protocol

from typer import Argument, Option

if TYPE_CHECKING:
    from ..surfaces.surface import Surface


READING, BODIES = "Reading the file", "Bodies and interface"
LOAD, SOLVER, OUTPUT = "Load: one of", "Solver", "Output"


@dataclass(frozen=True)
class SourceOptions:
    """Where the problem comes from: a file with heights and options, or a document."""

    file: Annotated[Path | None, Argument(help="File with the heights of the rough surface.")] = None
    from_: Annotated[
        Path | None,
        Option("--from", help="Problem document (TOML or JSON); options replace parts of it.", metavar="DOCUMENT"),
    ] = None


@dataclass(frozen=True)
class ReadingOptions:
    """What a file with heights does not say itself."""

    channel: Annotated[str | None, option("--channel", "Name or number of the channel.", READING)] = None
    size: Annotated[
        str | None, option("--size", 'Physical size, such as "20 um x 10 um".', READING, "LENGTH [x LENGTH]")
    ] = None
    height_unit: Annotated[str | None, option("--height-unit", "Unit of the heights: nm, um, …", READING, "UNIT")] = (
        None
    )
    z_scale: Annotated[
        str | None, option("--z-scale", "Height of the full grey scale of a picture.", READING, "LENGTH")
    ] = None
    lateral_unit: Annotated[
        str | None, option("--lateral-unit", "Unit of x and y in a list of points x y z.", READING, "UNIT")
    ] = None


@dataclass(frozen=True)
class BodyOptions:
    """Bodies, counter surface, boundary and interface law."""

    body: Annotated[
        str | None,
        option(
            "--body",
            'Material name, "E=140GPa,nu=0.25,H=15GPa", or layers from the surface down on a base: '
            '"DLC:5nm/Cr:2nm/steel"; ~ behind a thickness: slips on what is below.',
            BODIES,
            "BODY",
        ),
    ] = None
    counter: Annotated[
        str | None,
        Option(
            "--counter",
            "--counter-body",
            help="Counter body, in the same way; rigid by default.",
            rich_help_panel=BODIES,
            metavar="BODY",
        ),
    ] = None
    materials_file: Annotated[Path | None, option("--materials-file", "Your own materials, a TOML file.", BODIES)] = (
        None
    )
    counter_surface: Annotated[
        Path | None, option("--counter-surface", "File with the surface of the counter body; flat by default.", BODIES)
    ] = None
    mirror: Annotated[
        str | None,
        option("--mirror", "How the counter surface is turned over: x (default), y or none.", BODIES),
    ] = None
    shift: Annotated[
        str | None,
        option("--shift", "Place of the counter surface's middle from that of the surface.", BODIES, "LENGTH,LENGTH"),
    ] = None
    rotate: Annotated[
        str | None, option("--rotate", "Angle from +x towards +y of the counter surface: 30deg.", BODIES, "ANGLE")
    ] = None
    common_grid: Annotated[
        bool,
        option("--common-grid", "Bring both surfaces on one grid; so do --shift and --rotate.", BODIES),
    ] = False
    hardness: Annotated[
        str | None,
        option(
            "--hardness",
            'Limit of the pressure, "body" for the lower known hardness of the materials at the surfaces, or "effective" for '
            "that of the softer body with its layers, by depth.",
            BODIES,
            "PRESSURE",
        ),
    ] = None
    boundary: Annotated[
        str | None,
        option("--boundary", "periodic (default), free, or line (plane strain; see --line).", BODIES),
    ] = None


@dataclass(frozen=True)
class SolveOptions:
    """What is prescribed, and how the problem is solved."""

    pressure: Annotated[str | None, option("--pressure", "Mean pressure: 50kPa.", LOAD, "PRESSURE")] = None
    load: Annotated[str | None, option("--load", "Normal force: 1mN.", LOAD, "FORCE")] = None
    approach: Annotated[str | None, option("--approach", "Approach from first touch: 3nm.", LOAD, "LENGTH")] = None
    mean_gap: Annotated[str | None, option("--mean-gap", "Mean gap of the deformed surfaces.", LOAD, "LENGTH")] = None
    path: Annotated[
        str | None,
        option(
            "--path", "Load path through turning points: 50MPa,0,80MPa (or forces, or approaches).", LOAD, "VALUE,…"
        ),
    ] = None
    path_steps: Annotated[
        int | None, option("--path-steps", "Steps from one turning point to the next; 10 by default.", LOAD)
    ] = None
    solver: Annotated[
        str | None, option("--solver", "Name of the method; chosen for the problem by default.", SOLVER)
    ] = None
    tolerance: Annotated[float | None, option("--tolerance", "Relative error at which to stop.", SOLVER)] = None
    max_iterations: Annotated[int | None, option("--max-iterations", "Iterations after which to give up.", SOLVER)] = (
        None
    )
    precision: Annotated[
        str | None, option("--precision", "Arithmetic of active_set: mixed (default), double or single.", SOLVER)
    ] = None
    threads: Annotated[int | None, option("--threads", "Threads of the transforms; all cores by default.", SOLVER)] = (
        None
    )


@dataclass(frozen=True)
class OutputOptions:
    """Where the whole run, or a part of it, is written."""

    out: Annotated[
        Path | None, option("--out", "Folder for report, result, scalars, plots and document.", OUTPUT, "DIR")
    ] = None
    force: Annotated[bool, option("--force", "Replace files that exist.", OUTPUT)] = False
    plastic_load: Annotated[
        bool,
        option(
            "--plastic-load",
            "Search the load at which 2 % of the real area is at the hardness (some 15 solves).",
            OUTPUT,
        ),
    ] = False
    with_: Annotated[
        list[str] | None,
        option(
            "--with", "Compute this part with its defaults: stress, plastic_load, … May be repeated.", OUTPUT, "PART"
        ),
    ] = None
    save_document: Annotated[
        Path | None, option("--save-document", "Write the problem as a TOML or JSON document.", OUTPUT)
    ] = None
    csv: Annotated[Path | None, option("--csv", "Write the scalars as a CSV file.", OUTPUT)] = None
    vtk: Annotated[Path | None, option("--vtk", "Write the fields as a VTK image file (.vti).", OUTPUT)] = None
    stress_vtk: Annotated[
        Path | None, option("--stress-vtk", "Write the stresses in the volume as a VTK file (.vtr).", OUTPUT)
    ] = None
    stress_nc: Annotated[
        Path | None, option("--stress-nc", "Write the stresses in the volume as a NetCDF file (.nc).", OUTPUT)
    ] = None

    @property
    def wants_stress(self) -> bool:
        """Whether a file is asked for that holds stresses."""
        return self.stress_vtk is not None or self.stress_nc is not None


class PanelOption(Protocol):
    """Makes the options of one panel."""

    def __call__(self, name: str, text: str, metavar: str | None = None) -> Any:
        """Option ``name`` with the ``text`` of its help."""


def option(name: str, text: str, panel: str, metavar: str | None = None) -> Any:
    """Option ``name`` with the ``text`` of its help, under the heading ``panel``."""
    return Option(name, help=text, rich_help_panel=panel, metavar=metavar)


def options_of(panel: str) -> PanelOption:
    """What makes the options under the heading ``panel``."""

    def panel_option(name: str, text: str, metavar: str | None = None) -> Any:
        return option(name, text, panel, metavar)

    return panel_option


def read_surface(file: Path, reading: ReadingOptions) -> Surface:
    """Surface in ``file``; units are those that the options give."""
    from ..core.units import parse
    from ..core.values import Lengths
    from ..surfaces.read import read

    return read(
        file,
        channel=reading.channel,
        size=None if reading.size is None else Lengths().read(reading.size, "--size"),
        height_unit=reading.height_unit,
        z_scale=None if reading.z_scale is None else parse(reading.z_scale, "length", "--z-scale"),
        lateral_unit=reading.lateral_unit,
    )


def level_of(surface: Surface, level: str) -> str:
    """What ``level`` removes from ``surface``: left to itself, the mean of a periodic one and the plane of any other."""
    return level if level != "auto" else "mean" if surface.periodic else "plane"
