"""Plastic deformation: what has yielded for good, and the load at which a contact becomes plastic."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Fraction
from ..part import Found, Part, Solved, Words

if TYPE_CHECKING:
    from ...contact.problem import ContactProblem
    from ...plots.picture import Figure


class Plasticity(Part):
    """Permanent indentation, where there is any."""

    name = "plasticity"
    title = "Plastic deformation"

    def compute(self, ask: Any, solved: Solved) -> Found:
        """Nothing beside what the contact holds itself."""
        return Found(detail=solved.result)

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        """Plastic zone and residual surface."""
        from ...plots.contact import PLASTIC_PLOTS, render
        from ...plots.picture import Figure

        plots = PLASTIC_PLOTS if solved.result.indented.any() else ()
        return tuple(Figure(p.name, p.title, p.caption, render(p, solved.result)) for p in plots)

    def words(self, found: Found, solved: Solved) -> Words:
        """Areas, volumes and work."""
        from .words import plastic_rows

        return Words(rows=plastic_rows(solved.result)) if solved.result.indented.any() else Words()


class PlasticLoadSettings(Settings):
    """A search for the load at which the plastic ``share`` of the real area is passed, 0.02 by default (some 15 solves)."""

    share: Fraction = setting(
        0.02, option="--plastic-share", help="Search the load at which this share of the real area is plastic"
    )


class PlasticLoad(Part):
    """First load at which more than a share of the real area is at the hardness."""

    name = "plastic_load"
    title = "Plastic load"
    table = "plastic_load"
    settings = PlasticLoadSettings
    quantities = (Quantity("plastic_load_pressure", "Pa", "mean pressure at which the contact becomes plastic"),)

    def check(self, ask: Any, problem: ContactProblem) -> None:
        """Refuse a law without a limit of the pressure."""
        from ...contact.plastic_load import mean_cap

        mean_cap(problem)

    def compute(self, ask: Any, solved: Solved) -> Found:
        """The two loads between which it lies, as detail."""
        from ...contact.plastic_load import plastic_load

        with solved.stage("searching the plastic load") as progress:
            found = plastic_load(solved.problem, fraction=ask.share, solver=solved.solver, progress=progress)
        return Found({"plastic_load_pressure": found.mean_pressure}, found)

    def words(self, found: Found, solved: Solved) -> Words:
        """The load."""
        from .words import plastic_load_row

        return Words(rows=[plastic_load_row(found.detail)])
