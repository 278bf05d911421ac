"""The commands on campaigns: ``run``, ``status`` and ``collect``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from .failures import INTERRUPTED, NOT_CONVERGED, OK

if TYPE_CHECKING:
    from ..studies.campaign import Campaign

Folder = Annotated[
    Path, typer.Argument(help="Folder of the results, or the study document they lie beside.", metavar="FOLDER")
]


def run(
    study: Annotated[Path, typer.Argument(help="Study document (TOML or JSON).", metavar="STUDY")],
    out: Annotated[
        Path | None, typer.Option("--out", help="Folder of the results; STUDY-results by default.", metavar="DIR")
    ] = None,
    workers: Annotated[
        int | None, typer.Option("--workers", help="Worker processes; as many as cores by default.", metavar="N")
    ] = None,
    dask: Annotated[
        str | None,
        typer.Option("--dask", help='Scheduler of a Dask cluster instead, "tcp://host:8786".', metavar="ADDRESS"),
    ] = None,
    retry: Annotated[bool, typer.Option("--retry", help="Try again what has failed.")] = False,
) -> None:
    """Run or resume a campaign over many contacts: only missing cases are computed.

    Example: asperity run study.toml

    Exit code 0: all cases done; 1: some failed (the others are there, and the causes are listed); 2: bad input;
    130: interrupted by Ctrl-C (all finished cases are kept: run it again to resume).
    """
    from ..studies.campaign import prepare_study
    from .campaign_progress import watched
    from .show import say

    campaign = prepare_study(study, out)
    monte_carlo = campaign.study.document.monte_carlo
    most = "at most " if monte_carlo is not None and monte_carlo.stop is not None else ""
    say(f"{campaign.title}: {most}{campaign.plan.n_cases} cases, results in {campaign.folder}")
    try:
        with watched(campaign.title) as watch:
            done = campaign.run(workers=workers, dask=dask, retry=retry, watch=watch)
    except KeyboardInterrupt:
        say(f"Interrupted. Finished cases are kept; resume with: asperity run {study}", "yellow")
        raise typer.Exit(INTERRUPTED) from None
    say(f"computed {done.done} cases, {done.failed} of them failed; {done.found} were there already")
    raise typer.Exit(_report(campaign))


def status(folder: Folder) -> None:
    """Say how far a campaign is, also while it runs."""
    from ..report.study import axis_rows, summary
    from ..studies.campaign import open_study
    from .show import console, say, table

    campaign = open_study(folder)
    state = campaign.state()
    console().print(table(campaign.title, axis_rows(campaign)))
    say(summary(campaign, state), "green" if state.complete and not state.failed else "")
    _print_causes(campaign)


def collect(folder: Folder) -> None:
    """Write what a campaign has found so far: NetCDF, CSV, pictures and a report, into its folder."""
    from ..studies.campaign import open_study

    raise typer.Exit(_report(open_study(folder)))


def _report(campaign: Campaign) -> int:
    """Write and print results; the exit code."""
    from ..report.study import derived_table, summary, write_study_files
    from .show import console, print_files, say, table

    written = write_study_files(campaign, campaign.folder)
    state, derived = campaign.state(), campaign.analysis()
    if derived is not None:
        found = derived_table(campaign, campaign.dataset(), derived)
        console().print(table("Findings", found.cells, found.headings))
    say(summary(campaign, state), "green" if state.complete and not state.failed else "yellow")
    _print_causes(campaign)
    print_files(written)
    return NOT_CONVERGED if state.failed else OK


def _print_causes(campaign: Campaign) -> None:
    from ..report.study import failure_table, finding_table
    from .show import console, table

    shown = (
        ("Failures by cause", failure_table(campaign)),
        ("Warnings and notes of the cases", finding_table(campaign)),
    )
    for heading, found in shown:
        if found.cells:
            console().print(table(heading, found.cells, found.headings))
