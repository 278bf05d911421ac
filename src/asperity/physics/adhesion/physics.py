"""Adhesion as a physics of a problem: what it refuses, its coupling, and its share of the energies
of a history."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ...contact.controls import Control, Step
from ...contact.edges import Kind
from ...contact.law import HardWall
from ...contact.problem import ContactProblem, Physics, Preparing, Solved
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.units import show
from .jkr import JKRAdhesion
from .law import (
    Adhesion,
    DugdaleAdhesion,
    ExponentialAdhesion,
    LennardJonesAdhesion,
    LinearAdhesion,
    VanDerWaalsAdhesion,
    cohesive_length,
)

if TYPE_CHECKING:
    from ...contact.couplings.protocol import Coupling
    from ...contact.operators import Operator
    from ...contact.result import ContactResult
    from ...contact.state import InterfaceState


RESOLVED_ZONE = 3.0
"""Least pixels in the cohesive length from which on the edge under an attraction is an elastic
one."""


@dataclass(frozen=True)
class Adhesive(Physics):
    """Attraction of the surfaces by a ``law``."""

    law: Adhesion
    keyword: ClassVar[str] = "adhesion"
    takes: ClassVar[Any] = Adhesion
    types: ClassVar[tuple[type, ...]] = (
        DugdaleAdhesion,
        ExponentialAdhesion,
        JKRAdhesion,
        LennardJonesAdhesion,
        LinearAdhesion,
        VanDerWaalsAdhesion,
    )
    attracts: ClassVar[bool] = True
    bears_pull: ClassVar[bool] = True
    moving: ClassVar[str] = "edges that open and close would take their own energy"

    def check(self, problem: ContactProblem) -> None:
        """A core has no wall whose pressure a hardness could limit."""
        if self.law.spacing > 0.0 and not isinstance(problem.law, HardWall):
            raise InputError(
                f"law of a contact with the adhesion {self.law.name} must be HardWall(), but is "
                f"{problem.law!r}: its core has no wall whose "
                "pressure a hardness could limit. Use another law ({gentle_law}) of the same work and strength."
            )

    def check_relaxing(self, problem: ContactProblem) -> None:
        """An edge without range would lose energy at all wavelengths."""
        if isinstance(self.law, JKRAdhesion):
            raise InputError(
                "adhesion of viscoelastic bodies must have a range, but is JKRAdhesion (coupling adhesion), "
                "whose edge would lose energy at all wavelengths. Take ExponentialAdhesion(work, range)."
            )

    def couplings(self, problem: ContactProblem, operator: Operator, how: Preparing) -> Iterator[Coupling]:
        """The attraction."""
        from .coupling import TOLERANCE, AdhesionCoupling

        yield AdhesionCoupling.prepared(problem, operator, how.tolerances.get("adhesion", TOLERANCE))

    def followed(self, problem: ContactProblem, step: Step, solved: Solved) -> Solved:
        """Long steps are divided by the range of the attraction."""
        from .steps import divides, in_ranges

        def by_ranges(control: Control, state: InterfaceState | None) -> ContactResult:
            if state is None or step.tangential is not None or not divides(problem, state):
                found: ContactResult = solved(control, state)
                return found
            return in_ranges(problem, control, state, solved)

        return by_ranges

    def edges(self, problem: ContactProblem) -> Kind | None:
        """A core has none; without a range that pixels resolve the edge is that of a crack."""
        if self.law.spacing > 0.0:
            return Kind.smooth
        zone = cohesive_length(self.law, problem.contact_modulus) / max(problem.grid.pixels)
        return None if zone >= RESOLVED_ZONE else Kind.pinned

    def rows(self) -> list[tuple[str, str]]:
        """Law and work of adhesion."""
        return [("adhesion", f"{self.law.name}, {show(self.law.work, 'J/m**2')}")]

    def work(self, steps: Sequence[ContactResult]) -> RealArray:
        """What the solids store and lose, which is exact on a branch."""
        from .loop import adhesion_loop

        return adhesion_loop(steps).work

    def losses(self, steps: Sequence[ContactResult], left: RealArray) -> Mapping[str, RealArray]:
        """Of what nothing else takes, the part of the steps with a jump."""
        jumped = np.array([step.require_adhesion().jumped for step in steps])
        jumped[0] = False  # from which energies are counted
        lost: RealArray = np.cumsum(np.where(jumped, np.diff(left, prepend=0.0), 0.0))
        return {"jump_work": lost}
