"""Solve the problem of a document, write what is asked for, print the summary. All contact commands end here."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from .failures import NOT_CONVERGED, OK
from .options import OutputOptions

if TYPE_CHECKING:
    from ..run.document import ProblemDocument
    from ..run.execute import Outcome

NAMES_IN_FOLDER = ("report.html", "result.nc", "scalars.csv", "plots", "problem.toml")
"""What a run leaves in its folder."""

PATH_NAMES = ("path.csv",)
"""What a load path leaves there as well: scalars and energies of its steps."""

STRESS_NAMES = ("stress.csv",)
"""What stresses leave there as well: the table of the largest ones."""


def perform(document: ProblemDocument, base_folder: Path, output: OutputOptions) -> int:
    """Run ``document``, whose relative paths start at ``base_folder``; return the exit code."""
    from ..io.atomic import require_new_files
    from ..run.build import build
    from ..run.document import relocated
    from ..run.execute import execute
    from .progress import stage
    from .show import print_files, print_problem, print_result

    require_new_files(_single_files(output), overwrite=output.force)
    case = build(document, base_folder)
    with output_folder(output.out, force=output.force) as folder:
        outcome = execute(case, lines=folder is not None or bool(case.path), stage=stage)
        if folder is not None and output.out is not None:
            _write_folder(outcome, relocated(document, base_folder, output.out), folder)
    _write_files(outcome, document, base_folder, output)
    write_volume(outcome, output.stress_nc, output.stress_vtk, force=output.force)
    print_problem(outcome, document.title or "Contact")
    print_result(outcome)
    print_files(_written(output, outcome))
    return OK if outcome.converged else NOT_CONVERGED


def _write_folder(outcome: Outcome, document: ProblemDocument, folder: Path) -> None:
    """Write everything into ``folder``, with the ``document`` whose paths start there."""
    from ..io.export import export_csv
    from ..run.document import dumps, save_document

    result, text = outcome.result, dumps(document)
    save_document(document, folder / "problem.toml")
    export_csv(result, folder / "scalars.csv", scalars=outcome.scalars)
    if outcome.path is not None:
        export_csv(outcome.path, folder / PATH_NAMES[0])
    write_parts(outcome, folder, text, document.title)


def write_parts(outcome: Outcome, folder: Path, document: str | None, title: str) -> None:
    """Write result file, report and pictures of the parts of ``outcome`` into ``folder``."""
    from ..io.export import export_csv
    from ..report import write_report
    from ..run.stored import save_outcome

    save_outcome(outcome, folder / "result.nc", document=document, title=title)
    (folder / "plots").mkdir()
    for figure in itertools.chain(outcome.pictures, *outcome.figures.values()):
        (folder / "plots" / f"{figure.name}.png").write_bytes(figure.picture)
    write_report(outcome, folder / "report.html", document=document, title=title)
    if "stress" in outcome.found:
        export_csv(outcome.found["stress"].detail, folder / STRESS_NAMES[0])


def write_volume(outcome: Outcome, nc: Path | None, vtk: Path | None, *, force: bool) -> None:
    """Write all planes of the stresses of ``outcome`` to the files that are asked for."""
    from ..io.export import export_stress_vtk
    from ..io.stress_files import save_stress

    if "stress" in outcome.found:
        survey = outcome.found["stress"].detail
        if nc is not None:
            save_stress(survey.planes(survey.depths), nc, overwrite=force)
        if vtk is not None:
            export_stress_vtk(survey.planes(survey.depths), vtk, overwrite=force)


@contextmanager
def output_folder(out: Path | None, *, force: bool) -> Iterator[Path | None]:
    """Temporary folder that becomes the folder ``out`` when all has gone well; None if none is wanted."""
    from ..io.atomic import atomic_folder

    if out is None:
        yield None
        return
    with atomic_folder(out, overwrite=force) as folder:
        yield folder


def _write_files(outcome: Outcome, document: ProblemDocument, base_folder: Path, output: OutputOptions) -> None:
    from ..io.export import export_csv, export_vtk
    from ..run.document import relocated, save_document

    if output.save_document is not None:
        moved = relocated(document, base_folder, output.save_document.parent)
        save_document(moved, output.save_document, overwrite=output.force)
    if output.csv is not None:
        export_csv(outcome.result, output.csv, scalars=outcome.scalars, overwrite=output.force)
    if output.vtk is not None:
        export_vtk(outcome.result, output.vtk, overwrite=output.force)


def _single_files(output: OutputOptions) -> list[Path]:
    files = (output.save_document, output.csv, output.vtk, output.stress_vtk, output.stress_nc)
    return [path for path in files if path is not None]


def _written(output: OutputOptions, outcome: Outcome) -> list[Path]:
    stressed = STRESS_NAMES if "stress" in outcome.found else ()
    names = [*NAMES_IN_FOLDER, *stressed, *(PATH_NAMES if outcome.path else ())]
    inside = [] if output.out is None else [output.out / name for name in names]
    return [*inside, *_single_files(output)]
