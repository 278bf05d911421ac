"""The plain contact: areas, pressures, gaps and energies of every solve."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..core.quantity import Quantity
from .part import Found, Part, Solved

if TYPE_CHECKING:
    from ..contact.problem import ContactProblem

STIFFNESS = "normal_stiffness"
"""The quantity that costs about one more solve."""


class Contact(Part):
    """What is known of every contact."""

    name = "contact"
    title = "Contact"

    @property
    def quantities(self) -> tuple[Quantity, ...]:  # type: ignore[override]
        """Scalars of a result, and three that follow from its fields and problem."""
        from ..contact.result import SCALARS

        return (
            *SCALARS,
            Quantity("max_displacement", "m", "largest displacement"),
            Quantity("rms_height", "m", "rms height of the profile"),
            Quantity("contact_modulus", "Pa", "contact modulus E*"),
        )

    @property
    def fields(self) -> tuple[Quantity, ...]:
        """Fields (nx, ny) of a result."""
        from ..io.words import FIELDS

        return FIELDS

    def compute(self, ask: Any, solved: Solved) -> Found:
        """Scalars of the result."""
        from ..contact.advice import advise, review
        from ..contact.result import SCALARS

        result, problem = solved.result, solved.problem
        values = {
            **{q.name: getattr(result, q.name) for q in SCALARS},
            "max_displacement": float(result.displacement.max()),
            "rms_height": float(problem.profile().std()),
            "contact_modulus": problem.contact_modulus,
        }
        findings = (*advise(problem, solved.control), *review(result))
        return Found(values, result, findings, result.citation_keys)

    def citations(self, ask: Any, problem: ContactProblem) -> tuple[str, ...]:
        """Keys of the problem's papers."""
        return problem.citation_keys
