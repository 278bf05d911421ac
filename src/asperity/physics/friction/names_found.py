"""Names of friction in results, with their types: for type checkers and editors alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from .answer import StickSlip
    from .sliding import GrossSliding


class FrictionFound:
    """What the couplings have found."""

    if TYPE_CHECKING:
        sliding: GrossSliding | None
        stick_slip: StickSlip | None
        require_stick_slip: Callable[[], StickSlip]
