"""Adhesion: the law of the attraction, approach and parting, pull-off and hysteresis, and criteria
of stickiness beside them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import model_validator

from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.settings import Settings, setting
from ...core.values import Choice, Count, Length, Number, Pressure, SurfaceTension
from ...parts.part import Part

if TYPE_CHECKING:
    from .branch import Jump
    from .law import Adhesion as AdhesionLaw
    from .loop import AdhesionLoop
    from .surface_energy import PairAdhesion

LAWS = ("exponential", "dugdale", "linear", "van der waals", "lennard-jones", "jkr")
"""Laws of adhesion in documents."""


WITHOUT_RANGE, OWN_RANGE = "jkr", "van der waals"
"""The law that has no range, and the one that knows its own."""

Law = Annotated[str, Choice({name: name for name in LAWS})]

MachineStiffness = Annotated[float, Number("surface tension", above=0.0)]

USUAL_STEPS = 20
"""Steps of each way of approach and parting, if not said otherwise."""


class AdhesionSettings(Settings):
    """Attraction of the surfaces, by its work of adhesion and either its range or its strength, the
    largest stress: range = work/strength.

    The law "van der waals" needs neither; ``range`` is then half the distance of the atomic planes
    in contact, by default 0.165 nm. The law "jkr" has none: its range is infinitely short. With
    ``retract`` the bodies approach from that distance to the approach of the table [control] and
    part again.
    """

    work: SurfaceTension | None = setting(None, option="--adhesion", help="Work of adhesion: 50mJ/m**2")
    pair: str | None = setting(
        None,
        option="--adhesion-pair",
        help="Two solids whose work of adhesion it is, instead of its value: polystyrene/paraffin wax",
    )
    law: Law = setting("exponential", option="--adhesion-law", help="Attraction as a function of the gap")
    range: Length | None = setting(None, option="--adhesion-range", help="Work over strength: 1nm")
    strength: Pressure | None = setting(None, option="--adhesion-strength", help="Largest attraction: 50MPa")
    retract: Length | None = setting(
        None, option="--retract", help="Approach from this distance apart, and part to it again, of an approach: 20nm"
    )
    steps: Count = setting(USUAL_STEPS, option="--retract-steps", help="Steps of each way")
    cycles: Count = setting(1, option="--retract-cycles", help="Number of approaches")
    stiffness: MachineStiffness | None = setting(
        None, option="--machine-stiffness", help="Of the machine that holds the bodies: 10N/m; rigid by default"
    )

    branch: bool = setting(
        False,
        option="--adhesion-branch",
        help="Follow the branch that jumps leave through its folds, of bodies that part",
    )
    jump_tolerance: Length | None = setting(
        None, option="--jump-tolerance", help="Close in on every jump to this approach, of bodies that part: 0.01nm"
    )

    @model_validator(mode="after")
    def _whole(self) -> AdhesionSettings:
        if (self.work is None) == (self.pair is None):
            gives = "neither" if self.work is None else "both"
            raise InputError(
                " must give either the work of adhesion, such as {adhesion.work=50 mJ/m**2}, or a pair of "
                "solids, such as "
                f"{{adhesion.pair=polystyrene/paraffin wax}}, but gives {gives}."
            )
        if self.pair is not None and self.pair.count("/") != 1:
            raise InputError(f'.pair must be two solids, such as "polystyrene/paraffin wax", but is {self.pair!r}.')
        if self.pair is not None:
            try:
                self.of_pair()
            except InputError as error:
                raise InputError(
                    ".pair must be two solids that were measured together or whose energies are known, but is "
                    f"{self.pair!r}: {error}"
                ) from None
        given = (self.range is not None) + (self.strength is not None)
        if given and self.law == WITHOUT_RANGE:
            raise InputError(
                f" must give neither a range ({{adhesion.range}}) nor a strength ({{adhesion.strength}}) for "
                f"the law {WITHOUT_RANGE}, "
                "whose range is infinitely short, but does. Leave it out, or choose {adhesion.law=exponential}."
            )
        if given > 1 or (given == 0 and self.law not in (WITHOUT_RANGE, OWN_RANGE)):
            raise InputError(
                f" must give either a range ({{adhesion.range}}) or a strength ({{adhesion.strength}}) for the "
                f"law {self.law}, but gives {'both' if given else 'neither'}. Give for example "
                f"{{adhesion.range=1 nm}}."
            )
        further = self.stiffness is not None or self.branch or self.jump_tolerance is not None
        if self.retract is None and (further or self.cycles != 1 or self.steps != USUAL_STEPS):
            raise InputError(
                " must give the distance to which the bodies part, {adhesion.retract}, with its steps, "
                "cycles, branch, jumps and the stiffness of the machine, but does not."
            )
        if self.retract is not None and self.steps < 2:
            raise InputError(f".steps must be at least 2, but is {self.steps}.")
        return self

    def of_pair(self) -> PairAdhesion:
        """Work of adhesion of the pair, with sources."""
        from .surface_energy import work_of_adhesion

        first, second = str(self.pair).split("/")
        return work_of_adhesion(first, second)

    def adhesion(self) -> AdhesionLaw:
        """The law."""
        from .jkr import JKRAdhesion
        from .law import DugdaleAdhesion, ExponentialAdhesion, LennardJonesAdhesion, LinearAdhesion, VanDerWaalsAdhesion

        work = float(self.work) if self.work is not None else self.of_pair().work
        if self.law == WITHOUT_RANGE:
            return JKRAdhesion(work)
        if self.law == OWN_RANGE and self.range is None and self.strength is None:
            return VanDerWaalsAdhesion(work)
        reach = float(self.range) if self.range is not None else work / float(self.strength or math.nan)
        if self.law == OWN_RANGE:
            return VanDerWaalsAdhesion(work, 2.0 * reach)
        if self.law == "lennard-jones":
            return LennardJonesAdhesion(work, 16.0 * reach / (9.0 * math.sqrt(3.0)))
        if self.law == "dugdale":
            return DugdaleAdhesion(work, reach)
        return LinearAdhesion(work, reach) if self.law == "linear" else ExponentialAdhesion(work, reach)


@dataclass(frozen=True)
class Asked:
    """The table and the law."""

    settings: AdhesionSettings
    law: AdhesionLaw


SOURCES = Quantity("work_of_adhesion_sources", "", "sources of the work of adhesion of the pair", dims=("source",))
"""What the work of adhesion of two named solids rests on."""


@dataclass(frozen=True, eq=False)
class Looped:
    """The loop of a path, and its jumps where they were closed in on."""

    loop: AdhesionLoop
    jumps: tuple[Jump, ...] = ()


STICKINESS = (
    Quantity("pastewka_robbins", "1", "Pastewka and Robbins' number / its limit, sticky below 1"),
    Quantity("persson_tosatti_work", "J/m**2", "work of adhesion less the energy of full contact (Persson, Tosatti)"),
    Quantity("fuller_tabor", "1", "Fuller and Tabor's adhesion parameter, roughness wins above about 10"),
)
"""Criteria beside the contact."""


_POINT = ("branch_point",)

ENERGY = (
    Quantity("adhesive_energy", "J", "energy of the contact, elastic and of the interface"),
    Quantity("adhesive_energy_bound", "J", "energy that no contact at this approach is below"),
)
"""Energy and its bound, NaN where that does not hold."""

BRANCH = (
    Quantity("folds", "1", "folds of the branch on the way of parting"),
    Quantity("fold_approach", "m", "approach at the first fold, where rigid grips jump"),
    Quantity("fold_force", "N", "external force there"),
    Quantity("branch_approach", "m", "approach along the branch", dims=_POINT),
    Quantity("branch_force", "N", "external force along the branch", dims=_POINT),
    Quantity(
        "branch_margin", "1", "margin of stability along the branch, negative where grips cannot hold", dims=_POINT
    ),
)
"""The branch that is left by jumps, where it is asked for."""


class Adhesion(Part):
    """Attraction of the surfaces."""

    name = "adhesion"
    title = "Adhesion"
    purpose = "How strongly the surfaces attract each other, and what force parts them again."
    table = "adhesion"
    settings = AdhesionSettings
    basic = ("work", "range", "retract")
    whole_path = True
    of_result = "adhesion"
    work = "physics.adhesion.work:AdhesionWork"

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Scalars of the contact, of approach and parting, and criteria."""
        from .loop import ADHESION_SCALARS, LOOP_SCALARS

        return (*ADHESION_SCALARS, *LOOP_SCALARS, *STICKINESS, *ENERGY, *BRANCH, SOURCES)

    def asked(self, document: Any, folder: Path) -> Asked:
        """The table [adhesion] with its law."""
        table: AdhesionSettings = document.adhesion
        if table.retract is not None and document.control.approach is None:
            raise InputError(
                "approach must be given as the deepest position of approach and parting ({adhesion.retract}), "
                "but is not. Give for example {control.approach=5 nm}.",
                subject="approach",
            )
        return Asked(table, table.adhesion())

    def coupling(self, ask: Asked) -> Mapping[str, Any]:
        """The attraction joins the solve."""
        return {"adhesion": ask.law}
