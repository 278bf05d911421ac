"""What a coupling has found in a contact, and what result, history and files ask of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import fields
from typing import TYPE_CHECKING, Any, ClassVar, Self, cast

from ..core.quantity import GIVEN

if TYPE_CHECKING:
    from ..core.arrays import RealArray
    from ..core.quantity import Labelled, Quantity
    from ..core.status import Advice, Status
    from .certificate import Certificate
    from .couplings.protocol import Memory
    from .problem import ContactProblem


class Answer:
    """What a coupling has found in a contact: base of frozen dataclasses, whose methods say nothing
    where it has no part in what is asked."""

    quantities: ClassVar[tuple[Quantity, ...]] = ()
    """Its numbers in the table of a result, stored fields and others that follow from them."""

    def line(self) -> str:
        """What it is in one line; empty for the name of its type."""
        return ""

    def tabled(self, result: Any) -> Iterator[Labelled]:
        """Numbers of tables that follow from it and the ``result`` that it is of."""
        yield from ()

    def contradicted(self) -> tuple[str, ...]:
        """Names of scalars of the result that are not what a reader would take them for beside
        it."""
        return ()

    def traction_beside(self) -> RealArray | None:
        """Attraction (nx, ny) in Pa beside the pressure."""
        return None

    def lifted(self) -> RealArray | None:
        """Elastic displacement (nx, ny) in m of the surface that is neither by pressure nor by
        attraction."""
        return None

    def imprint(self, part: str = "composite") -> RealArray | None:
        """Displacement (nx, ny) in m, into the body, that stays in this ``part``: "body",
        "counter_body" or the "composite" surface."""
        return None

    def pulls(self) -> float:
        """Force in N with which it holds the surfaces together."""
        return 0.0

    def outside(self, force: float, *, alone: bool) -> float:
        """Force (N) from outside that with what it pulls makes the ``force``; where it pulls
        ``alone`` it may know that to the last digit."""
        return force - self.pulls()

    def held_at(self) -> float | None:
        """Approach (m) of what holds the bodies, where that is not theirs."""
        return None

    def stores(self, *, relaxing: bool) -> float:
        """Energy (J) that it stores, beside the elastic energy of the result, which in ``relaxing``
        bodies is that of all their springs."""
        return 0.0

    def springs(self) -> float | None:
        """Elastic energy (J) of the bodies, where that is not half of pressure times
        displacement."""
        return None

    def retarded(self) -> RealArray | None:
        """Displacement (nx, ny) in m that is by earlier loads."""
        return None

    def worked(self) -> float | None:
        """Work (J) of the force between the solids in this step, where it is known better than by
        the trapezoidal rule."""
        return None

    def heat(self) -> float:
        """Heat (J) of the bodies in this step."""
        return 0.0

    def slipped(self) -> float:
        """Energy (J) that slip takes in this step."""
        return 0.0

    def has_jumped(self) -> bool:
        """Whether the contact jumped in this step, whose loss nothing else tells."""
        return False

    def summed(self, earlier: Sequence[Self]) -> Self:
        """The answer of a whole step, of which this is that of its last part, and ``earlier`` those
        of the parts before."""
        return self

    def friction_under_load(self) -> float | None:
        """Static friction force over external force with what it pulls; None where it knows
        none."""
        return None

    def flows(self) -> float:
        """Plastic work (J) of this step beside that at the surface."""
        return 0.0

    def require_sound(self) -> None:
        """Refuse fields of a file that cannot be, with a ValueError that names the field."""

    def ended(self) -> Status | None:
        """How its own solver ended."""
        return None

    @classmethod
    def given_by(cls, problem: ContactProblem) -> Mapping[str, Any]:
        """Its fields that are ``given`` by the ``problem``, by name; files do not hold them."""
        by = {item.name: item.metadata.get(GIVEN) for item in fields(cast(Any, cls))}
        return {name: getattr(problem, keyword) for name, keyword in by.items() if keyword}

    def remembered(self, approach: float) -> Memory:
        """What of its coupling's memory for the next step follows from it and from the ``approach``
        in m; files do not hold that twice."""
        return {}

    def certified(self, certificate: Certificate) -> Certificate:
        """The ``certificate`` of the contact with what it adds."""
        return certificate

    def findings(self, certificate: Certificate) -> Iterator[Advice]:
        """What should be known before the numbers of a result with this ``certificate`` are
        used."""
        yield from ()


def outside(answers: Iterable[Answer], force: float) -> float:
    """Force (N) from outside that with what the ``answers`` pull makes the ``force`` between the
    solids, attractions first."""
    pulling = sorted((item for item in answers if item.pulls()), key=lambda item: item.traction_beside() is None)
    for answer in pulling:
        force = answer.outside(force, alone=len(pulling) == 1)
    return force
