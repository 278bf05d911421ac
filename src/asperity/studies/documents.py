"""Study documents: read, checked, completed by the problem they start from, and written beside
their results."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..core.errors import InputError
from ..io.schemas.study import StudyDocument
from ..run.document import ProblemDocument, checked, load_document, read_table, relocated, tidy, validated

__all__ = ["LoadedStudy", "StudyDocument", "load_study", "study_from_table", "study_text"]


@dataclass(frozen=True)
class LoadedStudy:
    """A study ``document``, its base ``problem``, and the ``folder`` at which relative paths of the
    problem start."""

    document: StudyDocument
    problem: ProblemDocument
    folder: Path


def load_study(path: str | os.PathLike[str]) -> LoadedStudy:
    """Study in the TOML or JSON file at ``path``.

    Raises
    ------
    FileFormatError
        If the file, or that of its problem, is missing, unreadable, or neither TOML nor JSON.
    InputError
        If one of them has problems; the message has one line for each.
    """
    return study_from_table(read_table(path, "study document"), Path(path).parent, f"study document {path}")


def study_from_table(table: Mapping[str, Any], folder: Path, where: str = "study document") -> LoadedStudy:
    """Study of the nested ``table``, whose relative paths start at ``folder``; errors as of
    ``load_study``."""
    if "problem" not in table and "surface" in table:
        raise InputError(
            f"{where} must be a study, but is a problem document. Run it by itself ({{run}}) or give its path "
            "as problem in a study."
        )
    document = validated(StudyDocument, table, where)
    if isinstance(document.problem, str):
        path = folder / document.problem
        problem = relocated(load_document(path), path.parent, folder)
    else:
        problem = checked(document.problem, f"{where}, [problem]")
    return LoadedStudy(document, problem, folder)


def study_text(study: LoadedStudy, folder: Path) -> str:
    """``study`` as TOML with its problem inside, for use in ``folder``: relative paths lead to the
    same files."""
    import tomli_w

    moved = relocated(study.problem, study.folder, folder)
    table = study.document.model_dump(mode="json", exclude_none=True)
    table["problem"] = tidy(moved.model_dump(mode="json", exclude_none=True))
    return tomli_w.dumps(tidy(table))
