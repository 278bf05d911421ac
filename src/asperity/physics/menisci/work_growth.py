"""The growth of menisci asked for by a document: numbers, figure and words."""

from __future__ import annotations

import math
from typing import Any, ClassVar

import numpy as np

from ...contact.problem import ContactProblem
from ...core.status import Advice
from ...core.units import percent, show, times
from ...io.words import value_text
from ...parts.part import Found, Rows, Solved, Table, Words, Work
from ...plots.picture import Figure, figures_by
from .figures import GROWTH_PLOTS, GrowthPicture
from .film import FLOODED
from .growth import COLUMNS, MOMENTS, growing_menisci
from .part_growth import SCALARS, Growing

_ROWS = 9
"""Times in the table of the report."""

_FIRST = 1e-6
"""First time after contact over the last where that is given."""


class GrowthWork(Work):
    """How the menisci of the map grow: what is done for it."""

    citation_keys: ClassVar[tuple[str, ...]] = ("BhushanKotwal1998", "TianBhushan1996")

    def compute(self, ask: Growing, solved: Solved) -> Found:
        """Force, area, volume and height at all times."""
        problem: ContactProblem = solved.problem.with_physics(film=ask.film, friction=None)
        moments = None
        if not math.isnan(ask.until):
            moments = np.concatenate([[0.0], np.geomspace(_FIRST * ask.until, ask.until, MOMENTS - 1)])
        with solved.stage("growth of menisci") as progress:
            found = growing_menisci(problem, solved.control, ask.feed, moments, progress=progress)
        last = float(found.meniscus_force[-1])
        numbers = (
            float(found.meniscus_force[0]),
            last,
            last / found.external_force,
            found.settling,
            found.equilibrium_height,
        )
        values: dict[str, Any] = {item.name: number for item, number in zip(SCALARS, numbers, strict=True)}
        values |= {f"growth_{item.name}": getattr(found, item.name) for item in COLUMNS}
        made = []
        if float(found.held.mean()) >= FLOODED:
            fact = (
                f"The growing menisci have filled {percent(float(found.held.mean()))} of the interface at "
                f"{show(float(found.time[-1]), 's', 3)}: beyond, the force on a map means nothing."
            )
            numbers_of = {"filled": float(found.held.mean()), "flooded": FLOODED}
            made.append(
                Advice("warning", "flooded", fact, "Take a shorter time or a drier feed.", numbers_of, ("grown_",))
            )
        citations = (*found.citation_keys, *getattr(ask.feed, "citation_keys", ()))
        return Found(values, None, tuple(made), tuple(dict.fromkeys(citations)))

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Force and area against time."""
        return figures_by(GROWTH_PLOTS, GrowthPicture(found.columns("growth_")))

    def words(self, found: Found, solved: Solved) -> Words:
        """How the force grows, and when it has settled."""
        values = found.values
        rows: Rows = [(item.label, value_text(item, float(values[item.name]))) for item in SCALARS]
        columns = found.columns("growth_")
        cells = []
        for at in np.unique(np.linspace(0, len(columns["time"]) - 1, _ROWS).round().astype(int)):
            cells.append(tuple(value_text(item, float(columns[item.name][at])) for item in COLUMNS))
        table = Table(tuple(item.title for item in COLUMNS), tuple(cells))
        first, force = (show(float(values[f"grown_{when}_force"]), "N", 3) for when in ("first", "last"))
        share = float(values["grown_relative_force"])
        settled = show(float(values["grown_settling"]), "s", 3)
        sentence = (
            f"The menisci grow: their force goes from {first} at first touch to {force}, {times(share, 3)} times the "
            f"external force, and has settled after {settled}."
        )
        return Words(sentence, [], rows, (("Growth of the menisci", table),), (REMARK,))


REMARK = (
    "Each island of gaps up to the film thickness is a meniscus at first and takes the volume that its feed brings; "
    "islands that meet become one, and the contact is solved again as the force changes. One feed for an island of any "
    "size; the rest of the film stays as it is. Vapour is slower in gaps below its mean free path: those times are "
    "lower bounds."
)
"""What the model assumes."""
