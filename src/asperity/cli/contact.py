"""The commands that solve a contact: ``contact`` and ``demo``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from .asked import part_names, part_options, with_parts
from .declared import Given, offers
from .options import BodyOptions, OutputOptions, ReadingOptions, SolveOptions, SourceOptions
from .preparing import PreparationOptions


@offers(part_options)
def contact(
    source: SourceOptions,
    reading: ReadingOptions,
    preparation: PreparationOptions,
    bodies: BodyOptions,
    solve: SolveOptions,
    given: Given,
    output: OutputOptions,
) -> None:
    """Press a rough surface against another body: contact area, pressure and gap; menisci and stresses if asked for.

    Examples: asperity contact scan.di --body DLC --periodise --pressure 50kPa --hardness body --out run;
    asperity contact scan.di --body DLC:5nm/steel --periodise --pressure 50MPa --friction 0.3 --section y=max --out run;
    asperity contact scan.di --body DLC --periodise --pressure 1MPa --liquid water --humidity 80% --friction 0.3

    Exit code 0: converged; 1: not converged (results are written and say so); 2: input that cannot be used;
    130: interrupted by Ctrl-C (nothing is left half-written).
    """
    from ..run.document import checked
    from .perform import perform

    if source.from_ is None:
        table, names = _from_options(source.file, reading, preparation, bodies, solve)
        where, base = "command line", Path()
    else:
        require_no_surface(source.file, reading, preparation, bodies)
        table, names = table_of_document(source.from_, bodies, solve), {}
        where, base = f"problem document {source.from_}", source.from_.parent
    asked = (*(output.with_ or ()), *(["plastic_load"] if output.plastic_load else ()))
    table = with_parts(table, given, (*asked, *(["stress"] if output.wants_stress else ())))
    document = checked(table, where, names | part_names(given, everything=source.from_ is None))
    raise typer.Exit(perform(document, base, output))


def demo(
    out: Annotated[
        Path | None, typer.Option("--out", help="Folder for report, result and plots.", metavar="DIR")
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace files that exist.")] = False,
) -> None:
    """Solve a built-in problem: a rough magnetic disk under a flat slider. Nothing to prepare."""
    from importlib import resources

    from ..run.document import loads
    from .perform import perform
    from .show import say

    document = loads(resources.files("asperity").joinpath("data", "demo.toml").read_text(encoding="utf-8"))
    code = perform(document, Path(), OutputOptions(out=out, force=force))
    if out is None:
        say("Add --out DIR for the report, the result file and the plots.", "dim")
    raise typer.Exit(code)


def _from_options(
    file: Path | None,
    reading: ReadingOptions,
    preparation: PreparationOptions,
    bodies: BodyOptions,
    solve: SolveOptions,
) -> tuple[dict[str, Any], dict[str, str]]:
    """Document without its stresses, and what the user calls its keys."""
    from ..core.errors import InputError
    from .compose import NAMES, body_names, composed, overlaid, path_names
    from .preparing import step_names

    if file is None:
        raise InputError("FILE with the rough surface must be given, or a problem document by --from, but neither is.")
    table = overlaid(composed(file, reading, preparation, bodies), bodies, solve)
    return table, {**NAMES, **body_names(table), **path_names(table), **step_names(table["surface"]["prepare"])}


def table_of_document(path: Path, bodies: BodyOptions, solve: SolveOptions) -> dict[str, Any]:
    """The document at ``path`` with what the options replace in it."""
    from dataclasses import replace

    from ..run.document import read_table
    from .compose import overlaid

    table: dict[str, Any] = read_table(path)
    if bodies.materials_file is not None:  # given from where the user stands, not from the document
        bodies = replace(bodies, materials_file=bodies.materials_file.absolute())
    if bodies != BodyOptions() or solve != SolveOptions():
        table = overlaid({"control": {}} | table, bodies, solve)
    return table


def require_no_surface(
    file: Path | None, reading: ReadingOptions, preparation: PreparationOptions, bodies: BodyOptions
) -> None:
    """Refuse a surface given beside that of a document.

    Raises
    ------
    InputError
        If a file, or an option for its reading, preparation or pairing, is given.
    """
    from ..core.errors import InputError

    if (
        file is not None
        or reading != ReadingOptions()
        or preparation != PreparationOptions()
        or (bodies.counter_surface, bodies.mirror, bodies.shift, bodies.rotate) != (None, None, None, None)
        or bodies.common_grid
    ):
        raise InputError(
            "FILE and the options for reading, preparation and counter surface must be left out together with --from, "
            "but are given; edit [surface] in the document instead."
        )
