"""Names of a fluid that presses on both bodies in results, with their types: for type checkers and
editors alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from .coupling import FluidContact


class FluidFound:
    """What the couplings have found."""

    if TYPE_CHECKING:
        fluid: FluidContact | None
        require_fluid: Callable[[], FluidContact]
