"""Solve the problem of a document, write what is asked for, print the summary. All contact commands end here."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from .failures import NOT_CONVERGED, OK
from .options import OutputOptions

if TYPE_CHECKING:
    from ..contact.path import LoadPath
    from ..contact.plastic_load import PlasticLoad
    from ..contact.result import ContactResult
    from ..contact.solvers.protocol import Solver
    from ..contact.wet_result import WetContactResult
    from ..contact.wet_theory import WetTheory
    from ..core.status import Advice
    from ..io.build import Case
    from ..io.documents import ProblemDocument
    from ..stress.request import StressRequest
    from ..stress.survey import StressSurvey

NAMES_IN_FOLDER = ("report.html", "result.nc", "scalars.csv", "plots", "problem.toml")
"""What a run leaves in its folder."""

PATH_NAMES = ("path.nc", "path.csv")
"""What a load path leaves there as well: its steps, and their scalars and energies."""


def perform(document: ProblemDocument, base_folder: Path, output: OutputOptions) -> int:
    """Run ``document``, whose relative paths start at ``base_folder``; return the exit code."""
    from ..contact.advice import advise, review
    from ..contact.wet_advice import review_wet
    from ..io.atomic import require_new_files
    from ..io.build import build
    from ..io.documents import relocated
    from .stress_run import output_folder, surveyed, write_volume
    from .wet_run import theory_of, wet_contact

    require_new_files(_single_files(output), overwrite=output.force)
    case = build(document, base_folder)
    before = advise(case.problem, case.control)
    with output_folder(output) as folder:
        path, wet = (_ran(case) if case.path else None), wet_contact(case)
        result = _result(case, path, wet, chosen=_chooses_solver(document))
        asked, lines = case.stress, folder is not None
        stress = None if asked is None else surveyed(asked, result, lines=lines, threads=case.threads)
        found = _plastic_load(case) if output.plastic_load else None
        moved = document if output.out is None else relocated(document, base_folder, output.out)
        findings = (*before, *review(result), *(() if wet is None else review_wet(wet)))
        run = Run(result, findings, moved, stress, path, wet, found, theory_of(wet))
        if folder is not None:
            _write_folder(run, folder)
    _write_files(wet or result, document, base_folder, output)
    if stress is not None:
        write_volume(stress, output)
    _print(run, _written(output, stressed=stress is not None, along_path=path is not None))
    return OK if (path or wet or result).converged else NOT_CONVERGED


def _print(run: Run, written: Iterable[Path]) -> None:
    """Print what ``run`` has found and which files were ``written``."""
    from .show import print_advice, print_files, print_path, print_plastic_load, print_result
    from .stress_run import print_stress
    from .wet_run import print_wet

    print_result(run.result, run.document.title)
    if run.path is not None:
        print_path(run.path)
    if run.wet is not None:
        print_wet(run.wet, run.wet_theory)
    if run.plastic_load is not None:
        print_plastic_load(run.plastic_load)
    if run.stress is not None:
        print_stress(run.stress)
    print_advice(run.findings)
    print_files(written)


def _result(case: Case, path: LoadPath | None, wet: WetContactResult | None, *, chosen: bool) -> ContactResult:
    """Contact at the end of ``path``, of the ``wet`` contact, or solved now."""
    if path is not None:
        return path.results[-1]
    return _solved(case, chosen=chosen) if wet is None else wet.contact


def _chooses_solver(document: ProblemDocument) -> bool:
    """Whether the user has said anything of the method."""
    return any(value is not None for key, value in document.solver if key != "threads")


def _ran(case: Case) -> LoadPath:
    """The load path of ``case``; steps that do not converge are among its results.

    Raises
    ------
    InputError
        If shear traction is to change the pressure, too.
    """
    from ..contact.path import solve_path
    from ..core.engine import CpuEngine
    from ..core.errors import InputError
    from .interrupt import interruptible
    from .progress import shown

    if case.stress is not None and case.stress.coupled:
        raise InputError(
            "stress.coupled (--coupled) must be left out with a load path: a coupled, sliding contact is solved for one load."
        )
    with shown(f"solving {len(case.path)} steps") as bar, interruptible(bar) as progress:
        return solve_path(
            case.problem,
            case.path,
            solver=case.solver,
            engine=CpuEngine(case.threads),
            progress=progress,
            on_failure="return",
        )


def _plastic_load(case: Case) -> PlasticLoad:
    from ..contact.plastic_load import plastic_load
    from .interrupt import interruptible
    from .progress import shown

    with shown("searching the plastic load") as bar, interruptible(bar) as progress:
        return plastic_load(case.problem, solver=case.solver, progress=progress)


def _solved(case: Case, *, chosen: bool) -> ContactResult:
    """Contact of ``case``; one that slides is solved as ``solve_sliding`` likes best unless the solver was ``chosen``."""
    if case.stress is not None and case.stress.coupled and case.stress.friction:
        return _slid(case, case.stress, case.solver if chosen else None)
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


def _slid(case: Case, stress: StressRequest, solver: Solver | None) -> ContactResult:
    """Contact whose pressure the shear traction has changed; not converged if that did not settle."""
    from ..contact.sliding import solve_sliding
    from ..core.engine import CpuEngine
    from .interrupt import interruptible
    from .progress import shown

    with shown("solving") as bar, interruptible(bar) as progress:
        slid = solve_sliding(
            case.problem,
            case.control,
            stress.friction,
            direction=stress.direction,
            solver=solver,
            progress=progress,
            engine=CpuEngine(case.threads),
            on_failure="return",
        )
    contact = replace(slid.contact, citation_keys=slid.citation_keys)
    return contact if slid.converged else replace(contact, status=slid.status)


@dataclass(frozen=True, eq=False)
class Run:
    """What a run has found: result, findings, the document with paths from its folder; stresses, load path, menisci if any."""

    result: ContactResult
    findings: tuple[Advice, ...]
    document: ProblemDocument
    stress: StressSurvey | None
    path: LoadPath | None
    wet: WetContactResult | None
    plastic_load: PlasticLoad | None
    wet_theory: WetTheory | str


def _write_folder(run: Run, folder: Path) -> None:
    """Write everything into ``folder``."""
    from ..io.documents import dumps, save_document
    from ..io.export import export_csv
    from ..io.results import save
    from ..plots.figures import save_plots
    from ..report import write_report
    from .stress_run import write_stress
    from .wet_run import write_wet

    result, text = run.result, dumps(run.document)
    save_document(run.document, folder / "problem.toml")
    save_plots(result, folder / "plots")
    if run.wet is None:
        save(result, folder / "result.nc", document=text)
    export_csv(run.wet or result, folder / "scalars.csv")
    menisci = None if run.wet is None else write_wet(run.wet, run.wet_theory, folder, text)
    part = None if run.stress is None else write_stress(run.stress, folder)
    if run.path is not None:
        _write_path(run.path, folder, text)
    page, title = folder / "report.html", run.document.title
    write_report(
        result,
        page,
        advice=run.findings,
        document=text,
        title=title,
        stress=part,
        load_path=run.path,
        plastic_load=run.plastic_load,
        wet=menisci,
    )


def _write_path(path: LoadPath, folder: Path, document: str) -> None:
    """Write steps, table and figures of ``path`` into ``folder``."""
    from ..io.path_files import export_path_csv, save_path
    from ..plots.path_figures import save_path_plots

    save_path(path, folder / PATH_NAMES[0], document=document)
    export_path_csv(path, folder / PATH_NAMES[1])
    save_path_plots(path, folder / "plots")


def _write_files(
    result: ContactResult | WetContactResult, document: ProblemDocument, base_folder: Path, output: OutputOptions
) -> None:
    from ..contact.wet_result import WetContactResult
    from ..io.documents import relocated, save_document
    from ..io.export import export_csv, export_vtk

    if output.save_document is not None:
        moved = relocated(document, base_folder, output.save_document.parent)
        save_document(moved, output.save_document, overwrite=output.force)
    if output.csv is not None:
        export_csv(result, output.csv, overwrite=output.force)
    if output.vtk is not None:
        contact = result.contact if isinstance(result, WetContactResult) else result
        export_vtk(contact, output.vtk, overwrite=output.force)


def _single_files(output: OutputOptions) -> list[Path]:
    files = (output.save_document, output.csv, output.vtk, output.stress_vtk, output.stress_nc)
    return [path for path in files if path is not None]


def _written(output: OutputOptions, *, stressed: bool, along_path: bool) -> list[Path]:
    from .stress_run import FOLDER, TABLE

    names = [*NAMES_IN_FOLDER, *((FOLDER, TABLE) if stressed else ()), *(PATH_NAMES if along_path else ())]
    inside = [] if output.out is None else [output.out / name for name in names]
    return [*inside, *_single_files(output)]
