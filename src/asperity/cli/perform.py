"""Solve the problem of a document, write what is asked for, print the summary. All contact commands end here."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ..core.errors import InputError, OutputError
from .failures import NOT_CONVERGED, OK
from .options import FileOptions, FolderOptions

if TYPE_CHECKING:
    from ..contact.advice import Advice
    from ..contact.result import ContactResult
    from ..io.documents import ProblemDocument

NAMES_IN_FOLDER = ("report.html", "result.nc", "scalars.csv", "plots", "problem.toml")
"""What a run leaves in its folder."""


@dataclass(frozen=True)
class Output:
    """What to write."""

    folder: FolderOptions = FolderOptions()
    files: FileOptions = FileOptions()

    def require_possible(self) -> None:
        """Refuse files that exist or cannot be written before any work is done."""
        for path in (self.files.save_document, self.files.csv, self.files.vtk):
            if path is not None:
                require_new(path, force=self.folder.force)


def perform(document: ProblemDocument, base_folder: Path, output: Output) -> int:
    """Run ``document``, whose relative paths start at ``base_folder``; return the exit code."""
    from ..contact.advice import advise, review
    from ..io.build import build
    from .show import print_advice, print_files, print_result

    output.require_possible()
    case = build(document, base_folder)
    before = advise(case.problem, case.control)
    with _folder(output.folder) as folder:
        result = _solved(case)
        findings = (*before, *review(result))
        if folder is not None and output.folder.out is not None:
            _write_folder(result, findings, document, base_folder, (folder, output.folder.out))
    _write_files(result, document, base_folder, output)
    print_result(result, document.title)
    print_advice(findings)
    print_files(_written(output))
    return OK if result.converged else NOT_CONVERGED


def require_new(path: Path, *, force: bool) -> None:
    """Refuse to write ``path`` if it exists and ``force`` is not given, or if its folder does not exist."""
    if path.exists() and not path.is_dir() and not force:
        raise OutputError(f"output file must not exist yet, but {path} does; add --force to replace it.")
    if not path.parent.is_dir() or path.is_dir():
        raise OutputError(f"output must be a file name in an existing folder, but is {path}.")


@contextmanager
def _folder(options: FolderOptions) -> Iterator[Path | None]:
    """Temporary folder that becomes the output folder when all has gone well; None if none is wanted."""
    from ..io.atomic import atomic_folder

    if options.out is None:
        yield None
        return
    with atomic_folder(options.out, overwrite=options.force) as folder:
        yield folder


def _solved(case: object) -> ContactResult:
    from ..contact.solve import solve
    from ..io.build import Case
    from .progress import shown

    if not isinstance(case, Case):
        raise InputError(f"case to solve must be a Case, but is {type(case).__name__}.")
    with shown("solving") as progress:
        return solve(
            case.problem,
            case.control,
            solver=case.solver,
            threads=case.threads,
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
    write_report(result, folder / "report.html", advice=findings, document=text)


def _write_files(result: ContactResult, document: ProblemDocument, base_folder: Path, output: Output) -> None:
    from ..io.documents import relocated, save_document
    from ..io.export import export_csv, export_vtk

    files, force = output.files, output.folder.force
    if files.save_document is not None:
        moved = relocated(document, base_folder, files.save_document.parent)
        save_document(moved, files.save_document, overwrite=force)
    if files.csv is not None:
        export_csv(result, files.csv, overwrite=force)
    if files.vtk is not None:
        export_vtk(result, files.vtk, overwrite=force)


def _written(output: Output) -> list[Path]:
    folder, files = output.folder.out, output.files
    inside = [] if folder is None else [folder / name for name in NAMES_IN_FOLDER]
    return [*inside, *(path for path in (files.save_document, files.csv, files.vtk) if path is not None)]
