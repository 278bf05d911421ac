"""The load at which a contact with a limited pressure becomes plastic."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.units import percent, show
from ...core.values import Fraction
from ...parts.part import Found, Part, Solved, Words

if TYPE_CHECKING:
    from ...contact.problem import ContactProblem
    from .plastic_load import PlasticLoad as SolvedPlasticLoad


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
        from .plastic_load import mean_cap

        mean_cap(problem)

    def compute(self, ask: Any, solved: Solved) -> Found:
        """The two loads between which it lies, as detail."""
        from .plastic_load import plastic_load

        with solved.stage("searching the plastic load") as progress:
            found = plastic_load(solved.problem, fraction=ask.share, solver=solved.solver, progress=progress)
        return Found({"plastic_load_pressure": found.mean_pressure}, found)

    def words(self, found: Found, solved: Solved) -> Words:
        """The load."""
        return Words(rows=[plastic_load_row(found.detail)])


def plastic_load_row(found: SolvedPlasticLoad) -> tuple[str, str]:
    """Label and text of the load at which a share of the real area is plastic."""
    load, force = show(found.mean_pressure, "Pa"), show(found.force, "N")
    share = percent(found.fraction)
    pixels = int(found.below.contact.sum())
    return (
        f"first load at which {share} of the real area is plastic",
        f"mean pressure {load}, force {force}, at {percent(found.below.area_fraction)} area ({pixels} pixels)",
    )
