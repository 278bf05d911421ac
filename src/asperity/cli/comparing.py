"""Options of ``asperity compare``."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from .panel import option

LOADS, THEORIES, OUTPUT = "Loads", "Theories and solver", "Output"


@dataclass(frozen=True)
class CompareSource:
    """Where the surface and the bodies come from: a file with heights and options, or a document."""

    file: Annotated[Path | None, Argument(help="File with the heights of the rough surface.")] = None
    from_: Annotated[
        Path | None,
        Option("--from", "--document", help="Problem document; its load is left aside.", metavar="DOCUMENT"),
    ] = None


@dataclass(frozen=True)
class CompareOptions:
    """Loads, theories, and where the comparison is written."""

    pressures: Annotated[
        str | None,
        option(
            "--pressures",
            "Nominal pressures: a logarithmic range 1MPa..1GPa, or a list 1MPa,10MPa; from 0.004 to 0.25 E* h' by default.",
            LOADS,
            "PRESSURES",
        ),
    ] = None
    loads: Annotated[int | None, option("--loads", "Number of loads of a range; 12 by default.", LOADS)] = None
    theories: Annotated[
        str | None,
        option("--theories", "Names with commas between; all that the surface allows by default.", THEORIES, "NAME,…"),
    ] = None
    no_numerical: Annotated[bool, option("--no-numerical", "Leave the boundary-element solution out.", THEORIES)] = (
        False
    )
    work: Annotated[
        str | None, option("--work", "Work of adhesion, for fuller-tabor: 50mJ/m^2.", THEORIES, "ENERGY/AREA")
    ] = None
    most_contacts: Annotated[
        int | None,
        option("--most-contacts", "Contacts up to which interacting-crests are solved; 1000 by default.", THEORIES),
    ] = None
    tolerance: Annotated[float | None, option("--tolerance", "Relative error at which to stop.", THEORIES)] = None
    threads: Annotated[int | None, option("--threads", "Threads of the solver; all cores by default.", THEORIES)] = None
    out: Annotated[
        Path | None,
        option("--out", "Folder for report.html, comparison.nc, comparison.csv and plots.", OUTPUT, "DIR"),
    ] = None
    force: Annotated[bool, option("--force", "Replace files that exist.", OUTPUT)] = False
