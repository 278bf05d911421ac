"""Names of menisci in results, with their types: for type checkers and editors alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from .coupling import Menisci


class FilmFound:
    """What the couplings have found."""

    if TYPE_CHECKING:
        menisci: Menisci | None
        require_menisci: Callable[[], Menisci]
