"""Names of plastic flow in problems and energies, with their types: for type checkers and
editors alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypedDict

if TYPE_CHECKING:
    from .law import PlasticFlow


class FlowKeyword(TypedDict, total=False):
    """What a problem takes by keyword."""

    plastic_flow: PlasticFlow | None


class FlowGiven:
    """What was given for the keyword."""

    if TYPE_CHECKING:
        plastic_flow: PlasticFlow | None
