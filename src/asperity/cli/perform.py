"""Solve the problem of a document, write what is asked for, print the summary. All contact commands end here."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from .failures import NOT_CONVERGED, OK
from .options import OutputOptions

if TYPE_CHECKING:
    from ..contact.path import LoadPath
    from ..io.documents import ProblemDocument
    from ..run.execute import Outcome

NAMES_IN_FOLDER = ("report.html", "result.nc", "scalars.csv", "plots", "problem.toml")
"""What a run leaves in its folder."""

PATH_NAMES = ("path.nc", "path.csv")
"""What a load path leaves there as well: its steps, and their scalars and energies."""


def perform(document: ProblemDocument, base_folder: Path, output: OutputOptions) -> int:
    """Run ``document``, whose relative paths start at ``base_folder``; return the exit code."""
    from ..io.atomic import require_new_files
    from ..io.documents import relocated
    from ..run.build import build
    from ..run.execute import execute
    from .progress import stage
    from .stress_run import output_folder, write_volume

    require_new_files(_single_files(output), overwrite=output.force)
    case = build(document, base_folder)
    with output_folder(output) as folder:
        outcome = execute(case, lines=folder is not None or bool(case.path), stage=stage)
        if folder is not None and output.out is not None:
            _write_folder(outcome, relocated(document, base_folder, output.out), folder)
    _write_files(outcome, document, base_folder, output)
    if "stress" in outcome.found:
        write_volume(outcome.found["stress"].detail, output)
    _print(outcome, _written(output, outcome))
    return OK if outcome.converged else NOT_CONVERGED


def _print(outcome: Outcome, written: Iterable[Path]) -> None:
    """Print what ``outcome`` says and which files were ``written``."""
    from .show import print_advice, print_files, print_path, print_plastic_load, print_result
    from .stress_run import print_stress
    from .wet_run import print_wet

    found = {name: item.detail for name, item in outcome.found.items()}
    print_result(outcome.result, outcome.case.document.title)
    if outcome.path is not None:
        print_path(outcome.path)
    if "film" in found:
        print_wet(found["film"], found.get("wet_theory", ""))
    if "plastic_load" in found:
        print_plastic_load(found["plastic_load"])
    if "stress" in found:
        print_stress(found["stress"])
    print_advice(outcome.findings)
    print_files(written)


def _write_folder(outcome: Outcome, document: ProblemDocument, folder: Path) -> None:
    """Write everything into ``folder``, with the ``document`` whose paths start there."""
    from ..io.documents import dumps, save_document
    from ..io.export import export_csv
    from ..io.results import save
    from ..plots.contact import save_plots
    from ..report import write_report
    from .stress_run import write_stress
    from .wet_run import write_wet

    result, text = outcome.result, dumps(document)
    found = {name: item.detail for name, item in outcome.found.items()}
    wet, stress = found.get("film"), found.get("stress")
    save_document(document, folder / "problem.toml")
    save_plots(result, folder / "plots")
    if wet is None:
        save(result, folder / "result.nc", document=text)
    export_csv(wet or result, folder / "scalars.csv")
    menisci = None if wet is None else write_wet(wet, found.get("wet_theory", ""), folder, text)
    part = None if stress is None else write_stress(stress, folder)
    if outcome.path is not None:
        _write_path(outcome.path, folder, text)
    write_report(
        result,
        folder / "report.html",
        advice=outcome.findings,
        document=text,
        title=document.title,
        stress=part,
        load_path=outcome.path,
        plastic_load=found.get("plastic_load"),
        wet=menisci,
    )


def _write_path(path: LoadPath, folder: Path, document: str) -> None:
    """Write steps, table and figures of ``path`` into ``folder``."""
    from ..io.path_files import export_path_csv, save_path
    from ..plots.contact import save_path_plots

    save_path(path, folder / PATH_NAMES[0], document=document)
    export_path_csv(path, folder / PATH_NAMES[1])
    save_path_plots(path, folder / "plots")


def _write_files(outcome: Outcome, document: ProblemDocument, base_folder: Path, output: OutputOptions) -> None:
    from ..io.documents import relocated, save_document
    from ..io.export import export_csv, export_vtk

    if output.save_document is not None:
        moved = relocated(document, base_folder, output.save_document.parent)
        save_document(moved, output.save_document, overwrite=output.force)
    if output.csv is not None:
        wet = outcome.found["film"].detail if "film" in outcome.found else None
        export_csv(wet or outcome.result, output.csv, overwrite=output.force)
    if output.vtk is not None:
        export_vtk(outcome.result, output.vtk, overwrite=output.force)


def _single_files(output: OutputOptions) -> list[Path]:
    files = (output.save_document, output.csv, output.vtk, output.stress_vtk, output.stress_nc)
    return [path for path in files if path is not None]


def _written(output: OutputOptions, outcome: Outcome) -> list[Path]:
    from .stress_run import FOLDER, TABLE

    stressed = "stress" in outcome.found
    names = [*NAMES_IN_FOLDER, *((FOLDER, TABLE) if stressed else ()), *(PATH_NAMES if outcome.path else ())]
    inside = [] if output.out is None else [output.out / name for name in names]
    return [*inside, *_single_files(output)]
