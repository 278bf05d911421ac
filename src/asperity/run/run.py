"""Running a document from Python: of any kind, from a file or as tables, checked and computed."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, Literal

from ..parts.part import Stage, no_stage
from ..parts.registry import with_own
from .build import build
from .document import TRACTIONS, ProblemDocument, checked, read_table
from .execute import Outcome, execute
from .tractions import checked_tractions, run_tractions


def run(
    document: ProblemDocument | Mapping[str, Any] | str | os.PathLike[str],
    base_folder: str | os.PathLike[str] | None = None,
    *,
    parts: Iterable[object] = (),
    stage: Stage = no_stage,
    on_failure: Literal["raise", "return"] = "raise",
) -> Outcome:
    """Solve the problem of a document and carry out every analysis that it requests.

    Parameters
    ----------
    document
        Path of a TOML or JSON file, the name of one of this package (``document.PRESETS``), its
        content as nested dictionaries, or a document as ``load_document`` gives it. With a table
        ``[tractions]`` it prescribes loads on a body, without any contact, and the ``result`` is a
        ``LoadedBody``.
    base_folder
        Where relative paths in the document start; by default the folder of the file, or the
        working folder.
    parts
        Parts of your own that no installed package adds, each a ``Part``: their tables may stand in
        the document, and their values are in the outcome as those of other parts are.
    stage
        Gives the progress of the stage of that name.
    on_failure
        ``"raise"`` a ConvergenceError if the solve does not converge, or ``"return"`` it with its
        status.

    Raises
    ------
    InputError
        If the document has problems, or requests something that its problem does not have, or a
        part cannot be used.
    NoSolutionError
        If the load has no solution.
    ConvergenceError
        If the solve does not converge and ``on_failure`` is ``"raise"``.
    """
    folder = Path() if base_folder is None else Path(base_folder)
    where = "problem document"
    if isinstance(document, str | os.PathLike):
        folder, where = Path(document).parent if base_folder is None else folder, f"{where} {document}"
        document = read_table(document)
    if isinstance(document, Mapping) and TRACTIONS in document:
        return run_tractions(checked_tractions(document, where), folder, stage=stage)
    known = with_own(parts)
    if not isinstance(document, ProblemDocument):
        document = checked(document, where, known=known)
    return execute(build(document, folder, known), stage=stage, on_failure=on_failure)
