"""A film of liquid as a physics of a problem: what it refuses, and its coupling."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ...contact.problem import ContactProblem, Physics, Preparing
from ...core.errors import InputError
from ..friction.law import Coulomb, TrescaFriction
from .film import LiquidFilm

if TYPE_CHECKING:
    from ...contact.couplings.protocol import Coupling
    from ...contact.operators import Operator


@dataclass(frozen=True)
class Wet(Physics):
    """A film of liquid whose menisci pull the surfaces together."""

    film: LiquidFilm
    keyword: ClassVar[str] = "film"
    takes: ClassVar[Any] = LiquidFilm
    types: ClassVar[tuple[type, ...]] = (LiquidFilm,)
    attracts: ClassVar[bool] = True
    moving: ClassVar[str] = "menisci of moving surfaces are not steady"
    pull_term: ClassVar[str] = "meniscus_work"

    def check(self, problem: ContactProblem) -> None:
        """The force of the menisci is shared by all points, so that friction is one number."""
        friction = problem.friction
        for name, what in {
            "coefficient": "friction coefficient",
            "strength": "shear strength of the interface",
        }.items():
            if isinstance(getattr(friction, name, 0.0), np.ndarray):
                raise InputError(f"{what} beside a film of liquid must be one number, but is an array.")
        if not isinstance(friction, Coulomb | TrescaFriction | None):
            raise InputError(
                "friction beside a film of liquid must be Coulomb(coefficient), TrescaFriction(strength) or None, but "
                f"is {friction!r}."
            )

    def couplings(self, problem: ContactProblem, operator: Operator, how: Preparing) -> Iterator[Coupling]:
        """The force of the menisci."""
        from .coupling import TOLERANCE, MeniscusCoupling

        friction = problem.friction
        dry = friction if isinstance(friction, Coulomb | TrescaFriction) else Coulomb(0.0)
        yield MeniscusCoupling(self.film, problem.boundary.wraps, dry, how.tolerances.get("menisci", TOLERANCE))
