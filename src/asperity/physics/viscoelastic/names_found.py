"""Names of viscoelasticity in results, with their types: for type checkers and editors alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .moments import Creeping


class CreepFound:
    """What the couplings have found."""

    if TYPE_CHECKING:
        creep: Creeping | None
