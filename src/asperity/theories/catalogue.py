"""All theories by name. A new theory is one more line."""

from __future__ import annotations

from ..core import require
from .greenwood_williamson import GreenwoodWilliamson
from .greenwood_williamson_fits import FittedGreenwoodWilliamson
from .kotwal_bhushan import KotwalBhushan
from .majumdar_bhushan import MajumdarBhushan
from .persson import Persson
from .protocol import Described

_CLASSES: tuple[type[Described], ...] = (
    GreenwoodWilliamson,
    FittedGreenwoodWilliamson,
    KotwalBhushan,
    MajumdarBhushan,
    Persson,
)

THEORIES: dict[str, type[Described]] = {theory.name: theory for theory in _CLASSES}
"""Class of each theory by its name."""


def theory(name: str) -> type[Described]:
    """Class of the theory called ``name``.

    Raises
    ------
    InputError
        If there is no such theory.
    """
    return THEORIES[require.one_of(name, THEORIES, "name of a theory")]
