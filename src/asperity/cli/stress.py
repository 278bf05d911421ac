"""The command ``stress``: the stresses in a contact that has been solved and saved."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .asked import part_names, part_options, with_parts
from .declared import Given, offers
from .options import OUTPUT, options_of
from .results import Result

if TYPE_CHECKING:
    from ..run.document import ProblemDocument
    from ..run.execute import Outcome
    from ..stress.survey import StressRequest

_option = options_of(OUTPUT)


@dataclass(frozen=True)
class StressOutput:
    """Where the stresses are written."""

    out: Annotated[Path | None, _option("--out", "Folder for report, tables, fields and plots.", "DIR")] = None
    force: Annotated[bool, _option("--force", "Replace files that exist.")] = False
    stress_vtk: Annotated[
        Path | None, _option("--stress-vtk", "Write the stresses in the volume as a VTK file (.vtr).")
    ] = None
    stress_nc: Annotated[
        Path | None, _option("--stress-nc", "Write the stresses in the volume as a NetCDF file (.nc).")
    ] = None

    @property
    def files(self) -> list[Path]:
        """Single files that are asked for."""
        return [path for path in (self.stress_vtk, self.stress_nc) if path is not None]


@offers(lambda: part_options("friction", "stress"))
def stress(
    file: Result,
    given: Given,
    output: StressOutput,
    threads: Annotated[
        int | None, typer.Option("--threads", help="Threads of the transforms; all cores by default.")
    ] = None,
) -> None:
    """Compute the stresses in a saved contact, without solving it again.

    What the result's own problem document asks for is computed, with the options in place of its parts; without either, the
    section y=max. The pressure stays that of the result, whatever the friction.

    Example: asperity stress run/result.nc --friction 0.3 --section y=max --depths 0nm,5nm --out stresses

    Exit code 1 if the saved contact has not converged; the others as for `contact`.
    """
    from ..contact.advice import advise, review
    from ..io.atomic import require_new_files
    from ..io.results import contact_of, document_in, load
    from ..parts.stress import Stress
    from ..run.document import relocated
    from ..run.execute import analysed
    from .failures import NOT_CONVERGED, OK
    from .perform import output_folder, write_volume
    from .progress import stage
    from .show import print_advice, print_files, print_problem, print_words

    require_new_files(output.files, overwrite=output.force)
    result, written = contact_of(load(file)), output.files
    request, document = _asked(document_in(file), given)
    Stress().check(request, result.problem)
    with output_folder(output.out, force=output.force) as folder:
        asks = {"stress": request, "yielding": True}
        outcome = analysed(result, asks, threads=threads, lines=folder is not None, stage=stage)
        if folder is not None and output.out is not None:
            moved = document and relocated(document, file.parent, output.out)
            written = [*(output.out / name for name in _write_folder(outcome, moved, folder)), *written]
    write_volume(outcome, output.stress_nc, output.stress_vtk, force=output.force)
    print_problem(outcome, f"Stresses in {file}")
    print_words(outcome)
    print_advice((*advise(result.problem, result.control), *review(result), *outcome.findings))
    print_files(written)
    raise typer.Exit(OK if result.converged else NOT_CONVERGED)


def _asked(text: str | None, given: Given) -> tuple[StressRequest, ProblemDocument | None]:
    """What is asked for, and the document in the result, whose ``text`` is given, with that in it."""
    from ..parts.stress import stress_request
    from ..run.document import checked_parts, loads

    document = None if text is None else loads(text)
    before: Any = None if document is None or getattr(document, "stress") is None else document  # noqa: B009
    tables = ("friction", "stress")
    start = (
        {}
        if before is None
        else {name: getattr(before, name).model_dump(mode="json", exclude_none=True) for name in tables}
    )
    table = with_parts(start, given, ("stress",))
    checked = checked_parts(table, "command line", part_names(given, everything=True))
    request = stress_request(checked.stress, checked.friction)
    _require_same_coupling(request, None if before is None else stress_request(before.stress, before.friction))
    asked = {name: getattr(checked, name) for name in tables}
    return request, None if document is None else document.model_copy(update=asked)


def _require_same_coupling(request: StressRequest, before: StressRequest | None) -> None:
    """Refuse a coupling that the saved pressure does not have."""
    from ..core.errors import InputError

    had = None if before is None or not before.coupled else (before.friction, before.direction)
    if request.coupled and had != (request.friction, request.direction):
        holds = (
            "without coupling"
            if had is None
            else f"coupled with friction {had[0]:g} along {math.degrees(had[1]):g} deg"
        )
        raise InputError(
            f"--coupled needs the pressure under the friction asked for, but that of the result was solved {holds}. "
            "Solve again: asperity contact --from problem.toml --coupled with that friction."
        )


def _write_folder(outcome: Outcome, document: ProblemDocument | None, folder: Path) -> list[str]:
    """Write everything into ``folder``; return the names."""
    from ..run.document import dumps, save_document
    from .perform import STRESS_NAMES, write_parts

    names = ["report.html", "result.nc", "plots", *STRESS_NAMES]
    if document is not None:
        save_document(document, folder / "problem.toml")
        names.append("problem.toml")
    text, title = (None, "") if document is None else (dumps(document), document.title)
    write_parts(outcome, folder, text, title)
    return names
