"""All theories by name. A new theory is one more line."""

from __future__ import annotations

from ..core import require
from .adhesive_sphere import DMT, JKR
from .anisotropic_summits import AnisotropicSummits
from .bisinusoid import CrossedWaves
from .bush_gibson_thomas import BushGibsonThomas, GreenwoodElliptic
from .chang_etsion_bogy import ChangEtsionBogy, ChangEtsionBogySphere
from .discrete_summits import DiscreteSummits
from .fuller_tabor import FullerTabor
from .greenwood_tripp import GreenwoodTripp
from .greenwood_williamson import GreenwoodWilliamson
from .greenwood_williamson_fits import FittedGreenwoodWilliamson
from .hertz import HertzPoint
from .hertz_ellipse import HertzEllipse
from .hertz_line import HertzLine
from .identical_asperities import IdenticalAsperities
from .indenters import FlatPunch, PowerLawIndenter, SphericalIndenter
from .interacting_crests import InteractingCrests
from .jackson_green import JacksonGreen, JacksonGreenSphere
from .kogut_etsion import KogutEtsion, KogutEtsionSphere
from .kotwal_bhushan import KotwalBhushan
from .line_indenters import LineFlatPunch, LinePowerLawIndenter
from .majumdar_bhushan import MajumdarBhushan
from .maugis import MaugisDugdale
from .mccool import McCool
from .mindlin import MindlinLine, MindlinPoint
from .onions_archard import OnionsArchard
from .persson import Persson
from .protocol import Described
from .sinusoidal_asperity import SinusoidalAsperity
from .wavy import Westergaard

_CLASSES: tuple[type[Described], ...] = (
    GreenwoodWilliamson,
    FittedGreenwoodWilliamson,
    KotwalBhushan,
    ChangEtsionBogy,
    KogutEtsion,
    JacksonGreen,
    FullerTabor,
    IdenticalAsperities,
    DiscreteSummits,
    InteractingCrests,
    GreenwoodTripp,
    McCool,
    OnionsArchard,
    BushGibsonThomas,
    GreenwoodElliptic,
    AnisotropicSummits,
    MajumdarBhushan,
    Persson,
    HertzPoint,
    HertzLine,
    HertzEllipse,
    PowerLawIndenter,
    FlatPunch,
    SphericalIndenter,
    LinePowerLawIndenter,
    LineFlatPunch,
    Westergaard,
    CrossedWaves,
    MindlinPoint,
    MindlinLine,
    JKR,
    DMT,
    MaugisDugdale,
    ChangEtsionBogySphere,
    KogutEtsionSphere,
    JacksonGreenSphere,
    SinusoidalAsperity,
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
