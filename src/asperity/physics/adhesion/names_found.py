"""Names of adhesion in results, with their types: for type checkers and editors alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from .answer import AdhesiveContact


class AttractionFound:
    """What the couplings have found."""

    if TYPE_CHECKING:
        adhesion: AdhesiveContact | None
        require_adhesion: Callable[[], AdhesiveContact]
