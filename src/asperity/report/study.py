"""A self-contained HTML page on a study."""

from __future__ import annotations

import base64
import json
from collections.abc import Sequence
from pathlib import Path

from ..core.citations import REFERENCES
from ..io.atomic import atomic_file
from ..studies.campaign import Campaign
from .page import rendered
from .study_figures import StudyFigure, study_figures
from .study_tables import axis_rows, case_table, derived_table, failure_table, summary

TEMPLATE = "study.html"
"""Template in the folder ``templates``."""


def write_study_report(
    campaign: Campaign, path: str | Path, *, figures: Sequence[StudyFigure] | None = None, overwrite: bool = False
) -> None:
    """Write a page on ``campaign``, as far as it is, to the HTML file ``path``; it needs no network and no other file.

    Parameters
    ----------
    campaign
        A study, as of ``open_study``.
    path
        HTML file to write.
    figures
        Its figures where they have been drawn already.
    overwrite
        Whether an existing file is replaced.

    Raises
    ------
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    with atomic_file(path, overwrite=overwrite) as file:
        file.write_text(_html(campaign, figures), encoding="utf-8")


def _html(campaign: Campaign, figures: Sequence[StudyFigure] | None) -> str:
    data, derived, state = campaign.dataset(), campaign.analysis(), campaign.state()
    drawn = study_figures(campaign, data, derived) if figures is None else figures
    software = json.loads(data.attrs["software"])
    return rendered(
        TEMPLATE,
        title=campaign.title,
        state=state,
        summary=summary(campaign, state),
        axes=axis_rows(campaign),
        derived=None if derived is None else derived_table(campaign, data, derived),
        cases=case_table(campaign, data),
        n_cases=int(data["outcome"].size),
        failures=failure_table(campaign),
        figures=[
            {"title": f.title, "caption": f.caption, "picture": base64.b64encode(f.picture).decode("ascii")}
            for f in drawn
        ],
        provenance=[
            ("collected (UTC)", data.attrs["created"]),
            *((name.replace("_", " "), text) for name, text in software.items()),
        ],
        references=[(key, REFERENCES.get(key, "unknown reference")) for key in data.attrs["citation_keys"].split()],
        document=data.attrs["study"],
    )
