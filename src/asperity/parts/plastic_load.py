"""The load at which a contact becomes plastic."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..core.quantity import Quantity
from .part import Found, Part, Solved

if TYPE_CHECKING:
    from ..contact.problem import ContactProblem


class PlasticLoad(Part):
    """First load at which more than a share of the real area is at the hardness."""

    name = "plastic_load"
    title = "Plastic load"
    table = "plastic_load"
    quantities = (Quantity("plastic_load_pressure", "Pa", "mean pressure at which the contact becomes plastic"),)

    def check(self, ask: Any, problem: ContactProblem) -> None:
        """Refuse a law without a limit of the pressure."""
        from ..contact.plastic_load import mean_cap

        mean_cap(problem)

    def compute(self, ask: Any, solved: Solved) -> Found:
        """The two loads between which it lies, as detail."""
        from ..contact.plastic_load import plastic_load

        with solved.stage("searching the plastic load") as progress:
            found = plastic_load(solved.problem, fraction=ask.share, solver=solved.solver, progress=progress)
        return Found({"plastic_load_pressure": found.mean_pressure}, found)
