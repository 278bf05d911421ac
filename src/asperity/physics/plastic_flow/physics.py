"""Plastic flow in the volume as a physics of a problem: what it refuses, and its coupling."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from ...contact.boundary import FreeLine
from ...contact.controls import Control, Step
from ...contact.law import HardWall
from ...contact.problem import ContactProblem, Physics, Preparing, Solved
from ...core.errors import InputError
from ...solids.eigenstrain.cells import stack_of
from ...solids.layers import materials_of
from ...solids.plasticity import J2
from ...solids.viscoelastic import Viscoelastic
from .law import PlasticFlow, plastic_body

if TYPE_CHECKING:
    from ...contact.couplings.protocol import Coupling
    from ...contact.operators import Operator
    from ...contact.result import ContactResult
    from ...contact.state import InterfaceState


@dataclass(frozen=True)
class Flowing(Physics):
    """Plastic flow of a body by a ``flow`` law of its parts."""

    flow: PlasticFlow
    keyword: ClassVar[str] = "plastic_flow"
    takes: ClassVar[Any] = PlasticFlow
    types: ClassVar[tuple[type, ...]] = (J2, PlasticFlow)
    moving: ClassVar[str] = "what has flowed would have to move with the surface"

    def conserves(self) -> bool:
        """It dissipates."""
        return False

    def check(self, problem: ContactProblem) -> None:
        """Bodies, boundary and the other physics that a flow goes with."""
        friction = next((item.given for item in problem.physics if item.slides is False), None)
        for found, what, remedy in (
            (
                problem.law if not isinstance(problem.law, HardWall) else None,
                "law",
                "A hardness is a model of the same flow.",
            ),
            (friction, "friction", "Use Coulomb(coefficient), under which all points slide."),
            (
                problem.boundary if isinstance(problem.boundary, FreeLine) else None,
                "boundary",
                "Use Periodic() or Free().",
            ),
        ):
            if found is not None:
                raise InputError(
                    f"{what} of a contact with plastic flow must be another or none, but is {found!r}. {remedy}"
                )
        plastic, _ = plastic_body(problem.body, problem.counter_body)
        self.flow.laws(plastic)
        stack_of(plastic)  # refuses a layer that may slip
        for material in (*materials_of(problem.body), *materials_of(problem.counter_body)):
            if isinstance(material, Viscoelastic):
                raise InputError(
                    f"materials of a contact with plastic flow must be elastic, but one is {material!r}. Take "
                    "its relaxed or its instantaneous solid."
                )

    def couplings(self, problem: ContactProblem, operator: Operator, how: Preparing) -> Iterator[Coupling]:
        """The lift by plastic strain."""
        from .coupling import PlasticFlowCoupling

        if how.sticks:
            raise InputError(
                "friction of a contact with plastic flow must slide everywhere, but a step prescribes a shift "
                "or a tangential force. Leave that out: under Coulomb(mu) all points slide."
            )
        yield PlasticFlowCoupling.prepared(problem, how.tolerances.get("plastic_flow"), how.threads)

    def followed(self, problem: ContactProblem, step: Step, solved: Solved) -> Solved:
        """A step in which the flow does not settle is cut into parts."""

        def by_parts(control: Control, state: InterfaceState | None) -> ContactResult:
            from .cut_steps import in_parts

            result = solved(control, state)
            return result if result.converged else in_parts(control, state, result, solved)

        return by_parts
