"""The commands that solve a contact, ``contact`` and ``demo``, and what is written of one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from types import MappingProxyType
from typing import Annotated, Any

import typer

from ..core.errors import InputError
from ..core.settings import COMMAND_LINE
from ..core.values import Flag
from ..io.atomic import atomic_folder, require_new_files
from ..run.archive import carried, unpack
from ..run.build import build, large_grid, stated_points
from ..run.document import (
    DEMO,
    EXAMPLES,
    PRESETS,
    ProblemDocument,
    built_in,
    checked,
    files_of,
    is_archive,
    loads,
    read_table,
    relocated,
    save_document,
)
from ..run.execute import Outcome, execute
from .declared import ADVANCED, FILE, Given, Option, offers, part_names, part_options, sorted_out, with_parts
from .main import NOT_CONVERGED, OK
from .options import BASIC, CORE, OUTPUT, composed, document_options, names_in, overlaid, own_option
from .show import confirmed, print_files, print_problem, print_result, say, stage

Out = Annotated[
    Path | None,
    typer.Option(
        "--out", help="Folder for report, result, scalars, plots and document.", rich_help_panel=OUTPUT, metavar="DIR"
    ),
]
Force = Annotated[bool, typer.Option("--force", help="Replace files that exist.", rich_help_panel=OUTPUT)]
Document = Annotated[
    Path | None,
    typer.Option(
        "--from",
        help="Problem document (TOML or JSON); options replace parts of it. Of the literature: "
        f"{', '.join(PRESETS)}; examples: {', '.join(EXAMPLES)}.",
        metavar="DOCUMENT",
    ),
]


PLASTIC_LOAD = own_option(
    "--plastic-load",
    ("asked", "plastic_load"),
    "search the load at which 2 % of the real area is at the hardness (some 15 solves)",
    OUTPUT,
    values=Flag(),
)


YES = own_option("--yes", ("yes",), "do not ask before work that takes much memory or time", OUTPUT, values=Flag())


def contact_options() -> list[Option]:
    """Options of the command ``contact``."""
    own = (PLASTIC_LOAD, YES, *file_options(*FILES))
    return [*sorted_out(document_options(), BASIC), *part_options(basic=BASIC), *own]


FILES = MappingProxyType(
    {
        "save_document": "the problem as a TOML or JSON document",
        "csv": "the scalars as a CSV file",
        "vtk": "the fields as a VTK image file (.vti)",
        "stress_vtk": "the stresses in the volume as a VTK file (.vtr)",
        "stress_nc": "the stresses in the volume as a NetCDF file (.nc)",
        "animation": "plastic zones of the steps, or the section that wears, as a moving picture (.gif, .png, .webp)",
    }
)
"""Single files that can be written."""


def file_options(*names: str) -> list[Option]:
    """Options for single files."""
    return [
        own_option(f"--{name.replace('_', '-')}", ("output", name), f"write {FILES[name]}", f"{ADVANCED}{OUTPUT}", FILE)
        for name in names
    ]


def files_in(given: Given, *, force: bool) -> dict[str, Path]:
    """The single files that are asked for; none of them exists, unless they are replaced by
    ``force``."""
    files = {name: Path(path) for name, path in given.under("output").table().items()}
    if files:
        require_new_files([*files.values()], overwrite=force)
    return files


@offers(contact_options)
def contact(
    given: Given,
    file: Annotated[
        list[Path] | None,
        typer.Argument(
            help="File with the heights of the rough surface, or archive of a problem; of many, one table and report "
            "with a row for each.",
            metavar="FILE",
        ),
    ] = None,
    from_: Document = None,
    out: Out = None,
    force: Force = False,
    with_: Annotated[
        list[str] | None,
        typer.Option(
            "--with",
            help="Compute this part with its defaults: stress, plastic_load, … May be repeated.",
            metavar="PART",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
) -> None:
    """Press rough surfaces against a body: contact area, pressure, gap; menisci and stresses.

    Examples: asperity contact scan.di --body DLC --periodise --pressure 50kPa --hardness body --out
    run; asperity contact scan.di --body DLC:5nm/steel --periodise --pressure 50MPa --friction 0.3
    --section y=max --out run; asperity contact scan.di --body DLC --periodise --pressure 1MPa
    --liquid water --humidity 80% --friction 0.3; asperity contact scans/*.di --body DLC --periodise
    --pressure 50MPa --out all

    Exit code 0: converged; 1: not converged (results are written and say so); 2: input that cannot
    be used; 130: interrupted by Ctrl-C (nothing is left half-written).
    """
    archive = from_ if from_ is not None or not file or len(file) > 1 else file[0]
    if archive is None or not is_archive(archive):
        raise typer.Exit(_solved(Asked(tuple(file or ()), from_), given, out, with_ or [], force=force))
    with TemporaryDirectory(prefix="asperity-") as place:
        asked = Asked((), unpack(archive, Path(place)), unpacked=True)
        raise typer.Exit(_solved(asked, given, out, with_ or [], force=force))


@dataclass(frozen=True)
class Asked:
    """What is solved: ``files`` with heights, or a ``document``, which with those that it names may
    be ``unpacked`` from an archive into a folder that will be gone."""

    files: tuple[Path, ...] = ()
    document: Path | None = None
    unpacked: bool = False


def _solved(asked: Asked, given: Given, out: Path | None, parts_asked: list[str], *, force: bool) -> int:
    """Solve what is asked for; the exit code."""
    file, from_ = asked.files, asked.document
    table, names, base = asked_table(file[0] if file else None, from_, given)
    files = files_in(given, force=force)
    if asked.unpacked and "save_document" in files:
        raise InputError(
            "--save-document must be left out with an archive, but is given: --out DIR holds the document and its "
            "files."
        )
    volume = ["stress"] if {"stress_vtk", "stress_nc"} & files.keys() else []
    table = with_parts(table, given, (*parts_asked, *given.under("asked").table(), *volume))
    where = f"problem document {from_}" if from_ else COMMAND_LINE
    document = checked(table, where, names | part_names(given, everything=from_ is None))
    if files:
        inputs = [*files_of(document, base), *([from_] if from_ else [])]
        require_new_files([*files.values()], overwrite=force, inputs=inputs)
    if len(file) > 1:
        if files:
            raise InputError(
                f"{' and '.join(f'--{name.replace(chr(95), chr(45))}' for name in files)} must be left out "
                "with many files: --out DIR holds the table of all."
            )
        from .campaigns import solve_files

        return solve_files(document, file, out, yes=bool(given.get("yes")))
    confirmed(large_grid(stated_points(document.surface)), yes=bool(given.get("yes")))
    return _perform(document, base, out, files, force=force, unpacked=asked.unpacked)


def _dynamics_options() -> list[Option]:
    first = {option.name for option in part_options("dynamics")} | {"--speed"}
    basic = (*BASIC, *first)
    own = (YES, *file_options("save_document", "csv"))
    return [*sorted_out(document_options(), basic), *part_options(basic=basic), *own]


@offers(_dynamics_options)
def dynamics(
    given: Given,
    file: Annotated[
        Path | None, typer.Argument(help="File with the heights of the rough surface.", metavar="FILE")
    ] = None,
    from_: Document = None,
    out: Out = None,
    force: Force = False,
) -> None:
    """Motion on the interface that a contact gives: vibration, stick-slip, apparent friction of a
    sliding block.

    Examples: asperity dynamics scan.di --body steel --pressure 50kPa --mass 1kg --base 10cmx2cm
    --block-height 5cm --spring 200N/mm --speed 1mm/s --friction 0.3 --out run

    The contact is solved as by `asperity contact`, its pressure against approach gives the law of
    the interface. Exit code 0: converged; 1: not converged; 2: input that cannot be used; 130:
    interrupted by Ctrl-C.
    """
    contact(given, None if file is None else [file], from_, out, force, ["dynamics"])


def demo(out: Out = None, force: Force = False) -> None:
    """Solve a built-in problem: a rough magnetic disk under a flat slider. Nothing to prepare."""
    document = loads(built_in(DEMO))
    code = _perform(document, Path(), out, {}, force=force)
    if out is None:
        say("Add --out DIR for the report, the result file and the plots.", "dim")
    raise typer.Exit(code)


OVER = frozenset({"control", "path", "body", "counter_body", "bodies", "law", "boundary", "solver"})
"""Tables of a document that is given which options may replace."""


def asked_table(file: Path | None, document: Path | None, given: Given) -> tuple[dict[str, Any], dict[str, str], Path]:
    """Document without its parts, what the user calls its keys, and the folder at which its paths
    start.

    Raises
    ------
    InputError
        If neither a ``file`` nor a ``document`` is named, or a surface is given beside that of the
        document.
    """
    if document is None:
        if file is None:
            raise InputError(
                "FILE with the rough surface must be given, or a problem document by --from, but neither is."
            )
        table = overlaid(composed(file, given), given)
        return table, names_in(table, given), Path()
    if file is not None or any(path[0] in CORE for path in given.values):
        raise InputError(
            "FILE and the options for reading, preparation and counter surface must be left out together with --from, "
            "but are given; edit [surface] in the document instead."
        )
    table = read_table(document)
    if OVER & {path[0] for path in given.values}:
        table = overlaid({"control": {}} | table, given, Path().absolute())
    return table, {}, document.parent


def _perform(
    document: ProblemDocument,
    base: Path,
    out: Path | None,
    files: dict[str, Path],
    *,
    force: bool,
    unpacked: bool = False,
) -> int:
    """Run ``document``, whose relative paths start at ``base``; write what is asked for, print; the
    exit code. Files that were ``unpacked`` from an archive are put into the folder ``out``."""
    case, in_folder = build(document, base), []
    with output_folder(out, force=force) as folder:
        outcome = execute(case, lines=folder is not None or bool(case.path), stage=stage)
        if folder is not None and out is not None:
            from ..report.folder import ALL_NAMES, names_in_folder, write_run

            there = carried(document, base, folder, ALL_NAMES) if unpacked else relocated(document, base, out)
            write_run(outcome, folder, there)
            in_folder = [out / name for name in names_in_folder(outcome)]
    if "save_document" in files:
        save_document(relocated(document, base, files["save_document"].parent), files["save_document"], overwrite=force)
    if files.keys() - {"save_document"}:
        from ..io.export import export_csv, export_vtk
        from ..report.animation import save_animation

        if "csv" in files:
            export_csv(outcome.result, files["csv"], scalars=outcome.scalars, overwrite=force)
        if "vtk" in files:
            export_vtk(outcome.result, files["vtk"], overwrite=force)
        write_volume(outcome, files, force=force)
        if "animation" in files:
            save_animation(outcome, files["animation"], overwrite=force)
    print_problem(outcome, document.title or "Contact")
    print_result(outcome)
    print_files([*in_folder, *files.values()])
    return OK if outcome.converged else NOT_CONVERGED


def write_volume(outcome: Outcome, files: Mapping[str, Path], *, force: bool) -> None:
    """Write all planes of the stresses of ``outcome`` to the ``files`` that are asked for."""
    if "stress" in outcome.found:
        from ..physics.stress.files import export_stress_vtk, save_stress

        survey = outcome.found["stress"].detail
        for name, write in (("stress_nc", save_stress), ("stress_vtk", export_stress_vtk)):
            if name in files:
                write(survey.planes(survey.depths), files[name], overwrite=force)


@contextmanager
def output_folder(out: Path | None, *, force: bool) -> Iterator[Path | None]:
    """Temporary folder that becomes the folder ``out`` when all has gone well; None if none is
    wanted."""
    if out is None:
        yield None
        return
    with atomic_folder(out, overwrite=force) as folder:
        yield folder
