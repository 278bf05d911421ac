"""Load paths in words and tables."""

from __future__ import annotations

from ...contact.history import HistoryResult
from ...core.units import percent, show
from ..part import Table, Words


def words(path: HistoryResult) -> Words:
    """Where the load turns, and where its work goes."""
    tables = (("Where the load turns", turn_table(path)), ("Energies from the start of the path", energy_table(path)))
    return Words(path_sentence(path), tables=tables, alarming=not path.converged)


def turn_table(path: HistoryResult) -> Table:
    """State of the contact wherever the load of ``path`` turns, and at its end."""
    cells = []
    for step in path.turns:
        result = path.steps[step]
        cells.append(
            (
                f"{step + 1}",
                show(result.mean_pressure, "Pa"),
                show(result.approach, "m"),
                percent(result.area_fraction_corrected),
                percent(result.plastic_area_fraction),
                show(result.max_permanent_indentation, "m"),
                "converged" if result.converged else "NOT CONVERGED",
            )
        )
    headings = (
        "Step",
        "Mean pressure",
        "Approach",
        "Real area",
        "Plastic / real area",
        "Deepest indentation",
        "Status",
    )
    return Table(headings, tuple(cells))


def energy_table(path: HistoryResult) -> Table:
    """Energies along ``path`` wherever its load turns, and at its end."""
    balance = path.energies
    rounding = 1e-12 * float(abs(balance.external_work).max())
    cells = []
    for step in path.turns:
        energies = (balance.external_work, balance.elastic_energy, balance.plastic_work, balance.residual)
        values = [float(energy[step]) for energy in energies]
        cells.append((f"{step + 1}", *(show(value if abs(value) > rounding else 0.0, "J") for value in values)))
    headings = ("Step", "External work", "Elastic energy", "Plastic work", "Error of the steps")
    return Table(headings, tuple(cells))


def path_sentence(path: HistoryResult) -> str:
    """One sentence on the ``path``: its steps, and how well the energies add up."""
    failed = [number for number, result in enumerate(path.steps, start=1) if not result.converged]
    text = (
        f"The load ran through {len(path.steps)} steps, each from the interface the last one left. External work and the sum "
        f"of elastic energy and plastic work differ by at most {percent(path.energies.relative_error, 2)} of the largest "
        "work, by the error of the trapezoidal rule; more steps reduce it."
    )
    if failed:
        text += f" Not converged: step{'s' if len(failed) > 1 else ''} {', '.join(map(str, failed))}."
    return text
