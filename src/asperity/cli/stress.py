"""The command ``stress``: the stresses in a contact that has been solved and saved."""

from __future__ import annotations

import math
from typing import Any

import typer

from ..contact.advice import advise, review
from ..core.errors import InputError
from ..core.settings import COMMAND_LINE, validated
from ..io.results import contact_of, document_in, load
from ..io.schemas.problem import SolverTable
from ..parts.stress import Stress, stress_request
from ..run.document import ProblemDocument, checked_parts, loads, relocated
from ..run.execute import analysed
from ..stress.survey import StressRequest
from .contact import STRESS_NAMES, Force, Out, file_options, files_in, output_folder, write_parts, write_volume
from .declared import Given, Option, offers, part_names, part_options, with_parts
from .main import NOT_CONVERGED, OK
from .options import solver_options
from .results import Result
from .show import print_advice, print_doubts, print_files, print_problem, print_words, stage


def _options() -> list[Option]:
    threads = [option for option in solver_options() if option.name == "--threads"]
    return [*part_options("friction", "stress"), *threads, *file_options("stress_vtk", "stress_nc")]


@offers(_options)
def stress(file: Result, given: Given, out: Out = None, force: Force = False) -> None:
    """Compute the stresses in a saved contact, without solving it again.

    What the result's own problem document requests is computed, with the options in place of its parts; without either, the
    section y=max. The pressure stays that of the result, whatever the friction.

    Example: asperity stress run/result.nc --friction 0.3 --section y=max --depths 0nm,5nm --out stresses

    Exit code 1 if the saved contact has not converged; the others as for `contact`.
    """
    files = files_in(given, force=force)
    written = [*files.values()]
    result = contact_of(load(file))
    request, document, threads = _asked(document_in(file), given)
    Stress().check(request, result.problem)
    with output_folder(out, force=force) as folder:
        asks = {"stress": request, "yielding": True}
        outcome = analysed(result, asks, threads=threads, lines=folder is not None, stage=stage)
        if folder is not None and out is not None:
            write_parts(outcome, folder, document and relocated(document, file.parent, out))
            names = ["report.html", "result.nc", "plots", *STRESS_NAMES, *(["problem.toml"] if document else [])]
            written = [*(out / name for name in names), *written]
    write_volume(outcome, files, force=force)
    print_problem(outcome, f"Stresses in {file}")
    first = print_doubts(outcome)
    print_words(outcome)
    findings = (*advise(result.problem, result.control), *review(result), *outcome.findings)
    print_advice(finding for finding in findings if finding not in first)
    print_files(written)
    raise typer.Exit(OK if result.converged else NOT_CONVERGED)


def _asked(text: str | None, given: Given) -> tuple[StressRequest, ProblemDocument | None, int | None]:
    """What is asked for, the document in the result, whose ``text`` is given, with that in it, and the threads."""
    document = None if text is None else loads(text)
    before: Any = None if document is None or getattr(document, "stress") is None else document  # noqa: B009
    tables = ("friction", "stress")
    start = (
        {}
        if before is None
        else {name: getattr(before, name).model_dump(mode="json", exclude_none=True) for name in tables}
    )
    table = with_parts(start, given, ("stress",))
    checked = checked_parts(table, COMMAND_LINE, part_names(given, everything=True))
    request = stress_request(checked.stress, checked.friction)
    _require_same_coupling(request, None if before is None else stress_request(before.stress, before.friction))
    asked = {name: getattr(checked, name) for name in tables}
    threads = validated(SolverTable, given.under("solver").table(), COMMAND_LINE, {"threads": "--threads"}).threads
    return request, None if document is None else document.model_copy(update=asked), threads


def _require_same_coupling(request: StressRequest, before: StressRequest | None) -> None:
    """Refuse a coupling that the saved pressure does not have."""
    had = None if before is None or not before.coupled else (before.friction, before.direction)
    if request.coupled and had != (request.friction, request.direction):
        holds = (
            "without coupling"
            if had is None
            else f"coupled with friction {had[0]:g} along {math.degrees(had[1]):g} deg"
        )
        raise InputError(
            f"--coupled needs the pressure under the friction asked for, but that of the result was solved {holds}. "
            "Solve again: asperity contact --from problem.toml --coupled with that friction.",
            subject="--coupled",
        )
