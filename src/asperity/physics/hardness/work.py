"""Search for the plastic load, and its words."""

from __future__ import annotations

from typing import Any

from ...contact.problem import ContactProblem
from ...core.units import percent, show
from ...parts.part import Found, Solved, Words, Work
from .plastic_load import PlasticLoad, mean_cap, plastic_load


class PlasticLoadWork(Work):
    """First load at which more than a share of the real area is at the hardness: what is done for
    it."""

    def check(self, ask: Any, problem: ContactProblem) -> None:
        """Refuse a law without a limit of the pressure."""
        mean_cap(problem)

    def compute(self, ask: Any, solved: Solved) -> Found:
        """The two loads between which it lies, as detail."""
        with solved.stage("searching the plastic load") as progress:
            found = plastic_load(solved.problem, fraction=ask.share, solver=solved.solver, progress=progress)
        return Found({"plastic_load_pressure": found.mean_pressure}, found)

    def words(self, found: Found, solved: Solved) -> Words:
        """The load."""
        return Words(rows=[plastic_load_row(found.detail)])


def plastic_load_row(found: PlasticLoad) -> tuple[str, str]:
    """Label and text of the load at which a share of the real area is plastic."""
    load, force = show(found.mean_pressure, "Pa"), show(found.force, "N")
    share = percent(found.fraction)
    pixels = int(found.below.contact.sum())
    return (
        f"first load at which {share} of the real area is plastic",
        f"mean pressure {load}, force {force}, at {percent(found.below.area_fraction)} area ({pixels} pixels)",
    )
