"""What is computed, shown and said of every contact, of load paths and of what yields on the
way."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..contact.history import HistoryResult
from ..contact.problem import ContactProblem
from ..contact.result import PLASTIC_FRACTION, SCALARS, ContactResult, complementary_energy, interference
from ..core.units import percent, show
from ..plots.contact import PATH_PLOTS, PLASTIC_PLOTS
from ..plots.picture import Figure, figures_by
from .advice import findings
from .contact import LoadPath
from .part import Found, Rows, Solved, Table, Words, Work

YIELDING = (
    "plastic_work",
    "total_plastic_work",
    "plastic_area_fraction",
    "indented_area",
    "plastic_volume",
    "max_permanent_indentation",
)
"""Quantities of a contact that yields, zero where nothing limits the pressure."""


class ContactWork(Work):
    """What is known of every contact: what is done for it."""

    def unknown(self, ask: Any, problem: ContactProblem) -> Mapping[str, str]:
        """What yields where the pressure has no limit."""
        if np.all(np.isfinite(problem.law.pressure_cap())):
            return {}
        return dict.fromkeys(YIELDING, "the pressure has no limit. Give one, as {hardness}")

    def compute(self, ask: Any, solved: Solved) -> Found:
        """Scalars of the result."""
        result, problem = solved.result, solved.problem
        overlap = interference(result)
        peak, (dx, dy) = result.peak_pressure, problem.grid.spacing
        values = {
            **{q.name: getattr(result, q.name) for q in SCALARS},
            "peak_pressure": peak.value,
            "peak_pressure_error": peak.error,
            "peak_pressure_x": peak.x + 0.5 * dx,  # in the middle of a pixel, as in figures
            "peak_pressure_y": peak.y + 0.5 * dy,
            "max_displacement": float(result.displacement.max()),
            "interference_area": overlap.area,
            "interference_volume": overlap.volume,
            "complementary_energy": complementary_energy(result),
            "rms_height": float(problem.profile().std()),
            "contact_modulus": problem.contact_modulus,
        }
        made = findings(result if solved.path is None else solved.path)
        return Found(values, result, made)

    def citations(self, ask: Any, problem: ContactProblem) -> tuple[str, ...]:
        """Keys of the problem's papers."""
        return problem.citation_keys


class LoadPathWork(Work):
    """Steps of a load path and their energies: what is done for it."""

    def compute(self, ask: Any, solved: Solved) -> Found:
        """Scalars and energies of the steps, if these were kept."""
        if solved.path is None:
            return Found()
        balance, values = solved.path.energies, {}
        for item in LoadPath().quantities:
            if item.name.startswith("path_"):
                values[item.name] = getattr(balance, item.name.removeprefix("path_"))
            else:
                values[item.name] = np.array([getattr(step, item.name) for step in solved.path.steps])
        return Found(values, solved.path)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Loops of load and area, and the energies."""
        return () if found.detail is None else figures_by(PATH_PLOTS, found.detail)

    def words(self, found: Found, solved: Solved) -> Words:
        """Where the load turns, and where its work goes."""
        return Words() if found.detail is None else path_words(found.detail)


def path_words(path: HistoryResult) -> Words:
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
    lost = {"Heat of viscoelastic solids": balance.viscous_work, "Lost in jumps": balance.jump_work}
    lost = {heading: energy for heading, energy in lost.items() if energy.any()}
    cells = []
    for step in path.turns:
        energies = (
            balance.external_work,
            balance.elastic_energy,
            balance.plastic_work,
            *lost.values(),
            balance.residual,
        )
        values = [float(energy[step]) for energy in energies]
        cells.append((f"{step + 1}", *(show(value if abs(value) > rounding else 0.0, "J") for value in values)))
    headings = ("Step", "External work", "Elastic energy", "Plastic work", *lost, "Error of the steps")
    return Table(headings, tuple(cells))


def path_sentence(path: HistoryResult) -> str:
    """One sentence on the ``path``: its steps, and how well the energies add up."""
    failed = [number for number, result in enumerate(path.steps, start=1) if not result.converged]
    balance = path.energies
    more = {"heat": balance.viscous_work, "what is lost in jumps": balance.jump_work}
    *most, end = ("elastic energy", "plastic work", *(name for name, energy in more.items() if energy.any()))
    parts = f"{', '.join(most)} and {end}"
    in_time = any(result.creep is not None for result in path.steps)
    rule = "the steps of time; smaller ones reduce it" if in_time else "the trapezoidal rule; more steps reduce it"
    text = (
        f"The load ran through {len(path.steps)} steps, each from the interface the last one left. External "
        f"work and the sum of {parts} differ by at most {percent(balance.relative_error, 2)} of the largest "
        f"work, by the error of {rule}."
    )
    if failed:
        text += f" Not converged: step{'s' if len(failed) > 1 else ''} {', '.join(map(str, failed))}."
    return text


class PlasticityWork(Work):
    """Permanent indentation, where there is any: what is done for it."""

    def compute(self, ask: Any, solved: Solved) -> Found:
        """Nothing beside what the contact holds itself."""
        return Found(detail=solved.result)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Plastic zone and residual surface."""
        return figures_by(PLASTIC_PLOTS, solved.result) if solved.result.indented.any() else ()

    def words(self, found: Found, solved: Solved) -> Words:
        """Areas, volumes and work."""
        return Words(rows=plastic_rows(solved.result)) if solved.result.indented.any() else Words()

    def step(self, found: Found, solved: Solved) -> int | None:
        """The end of the load path."""
        return solved.step_of(solved.result)


def plastic_rows(result: ContactResult) -> Rows:
    """What has yielded in ``result``, and the energies."""
    share = result.indented_area / result.problem.grid.area
    limit = percent(PLASTIC_FRACTION)
    verdict = f"plastic: more than {limit}" if result.is_plastic else f"elastic: at most {limit}"
    return [
        ("plastic area under this load / real area", f"{percent(result.plastic_area_fraction)} ({verdict})"),
        ("area ever plastic", f"{show(result.indented_area, 'm**2')} ({percent(share)} of the nominal area)"),
        ("volume of the permanent indentation", show(result.plastic_volume, "m**3")),
        ("deepest permanent indentation", show(result.max_permanent_indentation, "m")),
        ("plastic work since the virgin surface", show(result.total_plastic_work, "J")),
        ("elastic energy under this load", show(result.elastic_energy, "J")),
    ]
