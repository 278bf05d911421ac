"""All theories by name, in families. A new theory is one more line."""

from __future__ import annotations

import difflib
from types import MappingProxyType

from ..core.errors import InputError
from .adhesive_sphere import DMT, JKR
from .anisotropic_summits import AnisotropicSummits
from .bisinusoid import CrossedWaves
from .bush_gibson_thomas import BushGibsonThomas, GreenwoodElliptic
from .chang_etsion_bogy import ChangEtsionBogy, ChangEtsionBogySphere
from .cone import Cone, Wedge
from .design_guidance import LeastArea
from .discrete_summits import DiscreteSummits
from .effective_hardness import EffectiveHardness
from .fuller_tabor import FullerTabor
from .greenwood_tripp import GreenwoodTripp
from .greenwood_williamson import GreenwoodWilliamson
from .greenwood_williamson_fits import FittedGreenwoodWilliamson
from .hertz import HertzPoint
from .hertz_ellipse import HertzEllipse
from .hertz_line import HertzLine
from .hertz_stress import HertzEllipseStress, HertzLineStress, HertzStress
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
from .nayak import NayakSummits
from .oliver_pharr import OliverPharr
from .onions_archard import OnionsArchard
from .persson import Persson
from .plasticity import PlasticityIndex, ProfilePlasticityIndex
from .protocol import Described
from .sinusoidal_asperity import SinusoidalAsperity
from .sliding_yield import CylinderYield, SphereYield
from .surface_forces import Boussinesq, Cerruti, Flamant, Strip
from .wavy import Westergaard
from .wet_summits import GrowingMenisci, WetSummits
from .whitehouse_archard import SampledPeaks

FAMILIES: MappingProxyType[str, tuple[type[Described], ...]] = MappingProxyType(
    {
        "Rough surfaces": (
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
        ),
        "Waves": (Westergaard, CrossedWaves),
        "One contact": (
            HertzPoint,
            HertzLine,
            HertzEllipse,
            PowerLawIndenter,
            Cone,
            FlatPunch,
            SphericalIndenter,
            LinePowerLawIndenter,
            Wedge,
            LineFlatPunch,
            MindlinPoint,
            MindlinLine,
            JKR,
            DMT,
            MaugisDugdale,
            ChangEtsionBogySphere,
            KogutEtsionSphere,
            JacksonGreenSphere,
            SinusoidalAsperity,
        ),
        "Below the surface": (
            HertzStress,
            HertzLineStress,
            HertzEllipseStress,
            SphereYield,
            CylinderYield,
            Boussinesq,
            Cerruti,
            Flamant,
            Strip,
        ),
        "Statistics of surfaces": (NayakSummits, SampledPeaks),
        "Plasticity and hardness": (PlasticityIndex, ProfilePlasticityIndex, LeastArea, EffectiveHardness, OliverPharr),
        "Menisci": (WetSummits, GrowingMenisci),
    }
)
"""Theories by what they are about."""

THEORIES: dict[str, type[Described]] = {theory.name: theory for family in FAMILIES.values() for theory in family}
"""Class of each theory by its name."""


def theory(name: str) -> type[Described]:
    """Class of the theory called ``name``.

    Raises
    ------
    InputError
        If there is no such theory; the message names those most like it.
    """
    if name not in THEORIES:
        near = nearest(name)
        like = f"Did you mean {' or '.join(near)}?" if near else f"They are {', '.join(THEORIES)}."
        raise InputError(f"name of a theory must be one of the catalogue, but is {name!r}. {like}")
    return THEORIES[name]


def nearest(name: str) -> list[str]:
    """Up to three names of theories that ``name`` may mean: misspelt, a part, initials, or the name of the class."""
    word = name.lower().replace("_", "-").replace(" ", "-")
    squeezed = word.replace("-", "")
    found = [
        known
        for known, kind in THEORIES.items()
        if word and (word in known or squeezed in (_initials(known), kind.__name__.lower()))
    ]
    found += difflib.get_close_matches(word, THEORIES, n=3, cutoff=0.6)
    return list(dict.fromkeys(found))[:3]


def _initials(name: str) -> str:
    return "".join(part[0] for part in name.split("-"))
