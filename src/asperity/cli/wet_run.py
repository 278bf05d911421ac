"""The menisci of a run: solved, drawn, written and printed."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..contact.wet_result import WetContactResult
    from ..contact.wet_theory import WetTheory
    from ..report.wet import WetPart


def write_wet(result: WetContactResult, theory: WetTheory | str, folder: Path, document: str) -> WetPart:
    """Write result file and figures of ``result`` into the ``folder`` of a run; what its report is to show."""
    from ..io.wet_results import save_wet
    from ..plots.contact import wet_figures
    from ..report.wet import WetPart

    save_wet(result, folder / "result.nc", document=document)
    figures = wet_figures(result)
    for figure in figures:
        (folder / "plots" / f"{figure.name}.png").write_bytes(figure.picture)
    return WetPart(result, figures, theory)


def print_wet(result: WetContactResult, theory: WetTheory | str) -> None:
    """Print liquid, menisci, friction, the theory beside them and whether the force is steady."""
    from ..report.wet import film_rows, theory_rows, wet_rows
    from .show import console, say, table

    console().print(table("Liquid film and menisci", [*film_rows(result), *wet_rows(result)]))
    if rows := theory_rows(theory, result):
        console().print(table("Statistical theory beside it", rows))
    say(result.status.message, "green" if result.converged else "bold red")
    if result.status.remedy:
        say(result.status.remedy, "red")
