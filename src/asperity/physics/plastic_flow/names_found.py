"""Names of plastic flow in results, with their types: for type checkers and editors alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from .answer import PlasticBody


class FlowFound:
    """What the couplings have found."""

    if TYPE_CHECKING:
        plastic_flow: PlasticBody | None
        require_plastic_flow: Callable[[], PlasticBody]
