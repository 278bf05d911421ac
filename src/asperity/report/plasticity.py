"""Plastic deformation and load paths in words and tables."""

from __future__ import annotations

from ..contact.energy import energy_balance
from ..contact.path import LoadPath
from ..contact.plastic_load import PlasticLoad
from ..contact.result import PLASTIC_FRACTION, ContactResult
from ..core.units import percent, show
from ..io.words import Rows
from .page import Table


def plastic_rows(result: ContactResult, found: PlasticLoad | None) -> Rows:
    """What has yielded in ``result``, the energies, and the plastic load if it was searched for."""
    share = result.indented_area / result.problem.grid.area
    limit = percent(PLASTIC_FRACTION)
    verdict = f"plastic: more than {limit}" if result.is_plastic else f"elastic: at most {limit}"
    rows = [] if found is None else [plastic_load_row(found)]
    return [
        *rows,
        ("plastic area under this load / real area", f"{percent(result.plastic_area_fraction)} ({verdict})"),
        ("area ever plastic", f"{show(result.indented_area, 'm**2')} ({percent(share)} of the nominal area)"),
        ("volume of the permanent indentation", show(result.plastic_volume, "m**3")),
        ("deepest permanent indentation", show(result.max_permanent_indentation, "m")),
        ("plastic work since the virgin surface", show(result.total_plastic_work, "J")),
        ("elastic energy under this load", show(result.elastic_energy, "J")),
    ]


def plastic_load_row(found: PlasticLoad) -> tuple[str, str]:
    """Label and text of the load at which a share of the real area is plastic."""
    load, force = show(found.mean_pressure, "Pa"), show(found.force, "N")
    share = percent(found.fraction)
    pixels = int(found.below.contact.sum())
    return (
        f"first load at which {share} of the real area is plastic",
        f"mean pressure {load}, force {force}, at {percent(found.below.area_fraction)} area ({pixels} pixels)",
    )


def turn_table(path: LoadPath) -> Table:
    """State of the contact wherever the load of ``path`` turns, and at its end."""
    cells = []
    for step in path.turns:
        result = path.results[step]
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


def energy_table(path: LoadPath) -> Table:
    """Energies along ``path`` wherever its load turns, and at its end."""
    balance = energy_balance(path)
    rounding = 1e-12 * float(abs(balance.external_work).max())
    cells = []
    for step in path.turns:
        energies = (balance.external_work, balance.elastic_energy, balance.plastic_work, balance.residual)
        values = [float(energy[step]) for energy in energies]
        cells.append((f"{step + 1}", *(show(value if abs(value) > rounding else 0.0, "J") for value in values)))
    headings = ("Step", "External work", "Elastic energy", "Plastic work", "Error of the steps")
    return Table(headings, tuple(cells))


def path_sentence(path: LoadPath) -> str:
    """One sentence on the ``path``: its steps, and how well the energies add up."""
    failed = [number for number, result in enumerate(path.results, start=1) if not result.converged]
    text = (
        f"The load ran through {len(path.results)} steps, each from the interface the last one left. External work and the sum "
        f"of elastic energy and plastic work differ by at most {percent(energy_balance(path).relative_error, 2)} of the largest "
        "work, by the error of the trapezoidal rule; more steps reduce it."
    )
    if failed:
        text += f" Not converged: step{'s' if len(failed) > 1 else ''} {', '.join(map(str, failed))}."
    return text
