"""All theories by name. A new theory is one more line."""

from __future__ import annotations

from ..core import require
from .anisotropic_summits import AnisotropicSummits
from .bush_gibson_thomas import BushGibsonThomas, GreenwoodElliptic
from .greenwood_tripp import GreenwoodTripp
from .greenwood_williamson import GreenwoodWilliamson
from .greenwood_williamson_fits import FittedGreenwoodWilliamson
from .kotwal_bhushan import KotwalBhushan
from .majumdar_bhushan import MajumdarBhushan
from .mccool import McCool
from .onions_archard import OnionsArchard
from .persson import Persson
from .protocol import Described

_CLASSES: tuple[type[Described], ...] = (
    GreenwoodWilliamson,
    FittedGreenwoodWilliamson,
    KotwalBhushan,
    GreenwoodTripp,
    McCool,
    OnionsArchard,
    BushGibsonThomas,
    GreenwoodElliptic,
    AnisotropicSummits,
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
