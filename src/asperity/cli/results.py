"""The commands on results: ``plot``, ``export`` and ``cite``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

Result = Annotated[Path, typer.Argument(help="Result file of `asperity contact --out`.", metavar="RESULT.nc")]
MENISCI = "menisci"
"""Kind of figure that only wet contacts have."""

Force = Annotated[bool, typer.Option("--force", help="Replace files that exist.")]


def plot(
    file: Result,
    kind: Annotated[
        str,
        typer.Option(
            "--kind",
            help="all, heights, pressure, pressure_log, contact, gap, section, histogram or gap_histogram; of an indented surface "
            "also indentation and residual, of a wet contact menisci.",
        ),
    ] = "all",
    out: Annotated[Path, typer.Option("--out", help="Folder of the pictures, made if missing.")] = Path(),
    force: Force = False,
) -> None:
    """Draw the figures of a result as PNG files."""
    from ..core import require
    from ..plots.contact import PLASTIC_PLOTS, PLOTS
    from .show import print_files

    require.one_of(kind, ("all", *(item.name for item in (*PLOTS, *PLASTIC_PLOTS)), MENISCI), "--kind")
    print_files(_menisci(file, out, force=force) if kind == MENISCI else _figures(file, kind, out, force=force))


def _figures(file: Path, kind: str, out: Path, *, force: bool) -> tuple[Path, ...]:
    """Draw the figure of that ``kind`` of the result in ``file``, or all there are, into the folder ``out``."""
    from ..io.atomic import atomic_file
    from ..io.results import load
    from ..io.wet_results import is_wet
    from ..plots.contact import PLASTIC_PLOTS, PLOTS, render, save_plots

    result = load(file)
    if kind == "all":
        menisci = _menisci(file, out, force=force) if is_wet(file) else ()
        return (*save_plots(result, out, overwrite=force), *menisci)
    _make(out)
    path = out / f"{kind}.png"
    with atomic_file(path, overwrite=force) as partial:
        partial.write_bytes(render(next(item for item in (*PLOTS, *PLASTIC_PLOTS) if item.name == kind), result))
    return (path,)


def _menisci(file: Path, out: Path, *, force: bool) -> tuple[Path, ...]:
    """Draw the menisci of the wet contact in ``file`` into the folder ``out``."""
    from ..io.wet_results import load_wet
    from ..plots.contact import wet_figures
    from ..plots.picture import save_pictures

    pictures = {figure.name: lambda picture=figure.picture: picture for figure in wet_figures(load_wet(file))}
    return save_pictures(pictures, out, overwrite=force)


def export(
    file: Result,
    csv: Annotated[Path | None, typer.Option("--csv", help="Scalars as a CSV file.")] = None,
    vtk: Annotated[Path | None, typer.Option("--vtk", help="Fields as a VTK image file (.vti).")] = None,
    force: Force = False,
) -> None:
    """Write a result for other programs."""
    from ..core.errors import InputError
    from ..io.atomic import require_new_files
    from ..io.export import export_csv, export_vtk
    from ..io.results import load
    from ..io.wet_results import is_wet, load_wet
    from .show import print_files

    wanted = [path for path in (csv, vtk) if path is not None]
    if not wanted:
        raise InputError("export must be told what to write: give --csv FILE or --vtk FILE or both.")
    require_new_files(wanted, overwrite=force)
    result = load(file)
    if csv is not None:
        export_csv(load_wet(file) if is_wet(file) else result, csv, overwrite=force)
    if vtk is not None:
        export_vtk(result, vtk, overwrite=force)
    print_files(wanted)


def cite(
    file: Annotated[Path, typer.Argument(help="Result file (.nc) or problem document (.toml, .json).")],
) -> None:
    """Print the papers behind the numbers of a result or a problem."""
    from ..core.citations import cite as references
    from ..io.build_stress import build_stress
    from ..io.documents import load_document, loads
    from ..io.results import document_in, load
    from ..run.build import build
    from ..stress.survey import Planned
    from .show import say

    if file.suffix.lower() in (".toml", ".json"):
        say(references(build(load_document(file), file.parent)))
        return
    result, text = load(file), document_in(file)
    asked = None if text is None else loads(text).stress
    say(references(result, *(() if asked is None else (Planned(build_stress(asked), result.problem),))))


def _make(folder: Path) -> None:
    from ..core.errors import OutputError

    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"folder {folder} cannot be made: {error.strerror}; choose another.") from error
