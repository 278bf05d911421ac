"""The stresses of a run: computed, drawn, written and printed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from .options import OutputOptions

if TYPE_CHECKING:
    from ..plots.picture import Figure
    from ..report.stress import StressPart
    from ..stress.field import StressField
    from ..stress.survey import StressSurvey

FOLDER, TABLE = "stress", "stress.csv"
"""Names in the folder of a run: the fields, and the table of the largest stresses."""


def write_stress(survey: StressSurvey, folder: Path) -> StressPart:
    """Write table, fields and figures of ``survey`` into the ``folder`` of a run; what its report is to show."""
    from ..io.stress_files import export_stress_csv, save_stress
    from ..plots.stress import line_figures
    from ..report.stress import StressPart

    export_stress_csv(survey, folder / TABLE)
    fields = folder / FOLDER
    fields.mkdir()
    figures = list(line_figures(survey))
    if survey.request.depths:
        save_stress(_drawn(survey.planes(survey.request.depths), figures), fields / "planes.nc")
    for number, section in enumerate(survey.sections, start=1):
        save_stress(section.field, fields / f"section_{number}.nc")
    for number, field in enumerate(survey.profiles, start=1):
        save_stress(field, fields / f"profile_{number}.nc")
    for figure in figures:
        (folder / "plots" / f"{figure.name}.png").write_bytes(figure.picture)
    return StressPart(survey, tuple(figures))


def write_volume(survey: StressSurvey, output: OutputOptions) -> None:
    """Write all planes of ``survey`` to the files that are asked for."""
    from ..io.stress_files import export_stress_vtk, save_stress

    if output.stress_nc is not None:
        save_stress(survey.planes(survey.depths), output.stress_nc, overwrite=output.force)
    if output.stress_vtk is not None:
        export_stress_vtk(survey.planes(survey.depths), output.stress_vtk, overwrite=output.force)


@contextmanager
def output_folder(options: OutputOptions) -> Iterator[Path | None]:
    """Temporary folder that becomes the output folder when all has gone well; None if none is wanted."""
    from ..io.atomic import atomic_folder

    if options.out is None:
        yield None
        return
    with atomic_folder(options.out, overwrite=options.force) as folder:
        yield folder


def print_stress(survey: StressSurvey) -> None:
    """Print the largest stresses of each layer and interface, and what yields first."""
    from ..report.stress import interface_table, maxima_table, strength_table, yield_sentence, yield_table
    from .show import console, say, table

    out = console()
    titles = ("Largest stresses inside", "Interfaces", "Onset of yield", "Given strengths")
    makers = (maxima_table, interface_table, yield_table, strength_table)
    for title, made in zip(titles, (maker(survey) for maker in makers), strict=True):
        if made.cells:
            out.print(table(title, _once(made.cells), made.headings))
    say(yield_sentence(survey), "yellow" if survey.yielding.yields else "")


def _once(cells: tuple[tuple[str, ...], ...]) -> list[tuple[str, ...]]:
    """The same ``cells``, without the name of a row where the row above has it too."""
    above = ("", *(row[0] for row in cells))
    return [("" if row[0] == name else row[0], *row[1:]) for name, row in zip(above, cells, strict=False)]


def _drawn(planes: Iterator[StressField], figures: list[Figure]) -> Iterator[StressField]:
    """The same ``planes``, each drawn as it passes."""
    from ..plots.stress import map_figure

    for number, plane in enumerate(planes, start=1):
        figures.append(map_figure(plane, number))
        yield plane
