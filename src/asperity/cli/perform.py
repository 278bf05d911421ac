"""Solve the problem of a document, write what is asked for, print the summary. All contact commands end here."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from .failures import NOT_CONVERGED, OK
from .options import OutputOptions

if TYPE_CHECKING:
    from ..contact.finding import Advice
    from ..contact.result import ContactResult
    from ..io.build import Case
    from ..io.documents import ProblemDocument

NAMES_IN_FOLDER = ("report.html", "result.nc", "scalars.csv", "plots", "problem.toml")
"""What a run leaves in its folder."""


def perform(document: ProblemDocument, base_folder: Path, output: OutputOptions) -> int:
    """Run ``document``, whose relative paths start at ``base_folder``; return the exit code."""
    from ..contact.advice import advise, review
    from ..io.atomic import require_new_files
    from ..io.build import build
    from .show import print_advice, print_files, print_result

    require_new_files(_single_files(output), overwrite=output.force)
    case = build(document, base_folder)
    before = advise(case.problem, case.control)
    with _folder(output) as folder:
        result = _solved(case)
        findings = (*before, *review(result))
        if folder is not None and output.out is not None:
            _write_folder(result, findings, document, base_folder, (folder, output.out))
    _write_files(result, document, base_folder, output)
    print_result(result, document.title)
    print_advice(findings)
    print_files(_written(output))
    return OK if result.converged else NOT_CONVERGED


@contextmanager
def _folder(options: OutputOptions) -> Iterator[Path | None]:
    """Temporary folder that becomes the output folder when all has gone well; None if none is wanted."""
    from ..io.atomic import atomic_folder

    if options.out is None:
        yield None
        return
    with atomic_folder(options.out, overwrite=options.force) as folder:
        yield folder


def _solved(case: Case) -> ContactResult:
    from ..contact.solve import solve
    from ..core.engine import CpuEngine
    from .interrupt import interruptible
    from .progress import shown

    with shown("solving") as bar, interruptible(bar) as progress:
        return solve(
            case.problem,
            case.control,
            solver=case.solver,
            engine=CpuEngine(case.threads),
            progress=progress,
            on_failure="return",
        )


def _write_folder(
    result: ContactResult,
    findings: tuple[Advice, ...],
    document: ProblemDocument,
    base_folder: Path,
    folders: tuple[Path, Path],
) -> None:
    """Write everything into the first of ``folders``, which will be renamed to the second."""
    from ..io.documents import dumps, relocated, save_document
    from ..io.export import export_csv
    from ..io.results import save
    from ..plots.figures import save_plots
    from ..report import write_report

    folder, final = folders
    moved = relocated(document, base_folder, final)
    text = dumps(moved)
    save_document(moved, folder / "problem.toml")
    save(result, folder / "result.nc", document=text)
    export_csv(result, folder / "scalars.csv")
    save_plots(result, folder / "plots")
    write_report(result, folder / "report.html", advice=findings, document=text, title=document.title)


def _write_files(result: ContactResult, document: ProblemDocument, base_folder: Path, output: OutputOptions) -> None:
    from ..io.documents import relocated, save_document
    from ..io.export import export_csv, export_vtk

    if output.save_document is not None:
        moved = relocated(document, base_folder, output.save_document.parent)
        save_document(moved, output.save_document, overwrite=output.force)
    if output.csv is not None:
        export_csv(result, output.csv, overwrite=output.force)
    if output.vtk is not None:
        export_vtk(result, output.vtk, overwrite=output.force)


def _single_files(output: OutputOptions) -> list[Path]:
    return [path for path in (output.save_document, output.csv, output.vtk) if path is not None]


def _written(output: OutputOptions) -> list[Path]:
    inside = [] if output.out is None else [output.out / name for name in NAMES_IN_FOLDER]
    return [*inside, *_single_files(output)]
