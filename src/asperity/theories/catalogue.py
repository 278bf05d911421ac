"""All theories by name, in families; one line per theory."""

from __future__ import annotations

import difflib
from types import MappingProxyType

from ..core.errors import InputError
from .adhesion.adhesive_shapes import AdhesiveCylinder, AdhesivePowerLaw, AdhesiveWave
from .adhesion.coated_sphere import AdhesiveCoatedSphere
from .adhesion.fuller_tabor import FullerTabor
from .adhesion.spheres import DMT, JKR, MaugisDugdale
from .adhesion.stickiness import PastewkaRobbins, PerssonTosatti
from .conductance.joints import ElasticJoint, MeanGapJoint, PlasticJoint
from .conductance.spots import HolmSpot, SpotCluster
from .friction.finite_friction import FrictionalIndenter, FrictionalPunch, GoodmanLine
from .friction.full_stick import StickingIndenter, StickingIndenterLine, StickingPunch, StickingPunchLine
from .friction.partial_slip import MindlinLine, MindlinPoint, MindlinWave
from .friction.rolling import CarterRolling, Fastsim, KalkerLinear, ShenHedrickElkins
from .friction.sliding import SlidingCylinder, SlidingPunch
from .friction.torsion import LubkinSphere, StickingTwist
from .friction.tresca import TrescaDisc, TrescaLine, TrescaTwist
from .hardness.effective_hardness import EffectiveHardness, OliverPharr
from .hardness.plasticity import LeastArea, PlasticityIndex, ProfilePlasticityIndex
from .hardness.rate_hardness import RateHardness
from .heating.estimates import BlokFlash, JaegerBand, MovingHeatSource, TianKennedy
from .protocol import Described
from .rough.bush_gibson_keogh import BushGibsonKeogh
from .rough.discrete_summits import DiscreteSummits, IdenticalAsperities
from .rough.elastic_plastic_laws import (
    ChangEtsionBogy,
    ChangEtsionBogySphere,
    JacksonGreen,
    JacksonGreenSphere,
    KogutEtsion,
    KogutEtsionSphere,
)
from .rough.elliptic_summits import AnisotropicSummits, BushGibsonThomas, GreenwoodElliptic, McCool
from .rough.full_contact import FullContact
from .rough.greenwood_williamson import (
    FittedGreenwoodWilliamson,
    GreenwoodTripp,
    GreenwoodWilliamson,
    KotwalBhushan,
)
from .rough.interacting_crests import InteractingCrests
from .rough.interacting_summits import InteractingSummits, MergingSummits
from .rough.majumdar_bhushan import BifractalMajumdarBhushan, MajumdarBhushan
from .rough.mean_field_summits import MeanFieldSummits
from .rough.persson import Persson
from .rough.profile_peaks import OnionsArchard, SampledPeaks
from .rough.rubber_friction import PerssonFriction
from .sealing.gaps import AnnularGap, ParabolicChannel, ParabolicThroat, ParallelGap, SaddleThroat, TaperedGap
from .sealing.media import CriticalJunction, EffectiveMedium, ObstacleArray
from .sealing.roughness import GroovedGap, PatirCheng
from .single.compression import CompressedCylinder
from .single.conforming import CylinderInHole, PinInHole, SphereInCavity
from .single.hertz import HertzBodies, HertzEllipse, HertzLine, HertzPoint
from .single.indenters import (
    Cone,
    EllipticPunch,
    FlatPunch,
    LineFlatPunch,
    LinePowerLawIndenter,
    PowerLawIndenter,
    SphericalIndenter,
    Wedge,
)
from .single.waves import CrossedWaves, SinusoidalAsperity, Westergaard
from .statistics.nayak import NayakSummits
from .subsurface.hertz import HertzEllipseStress, HertzLineStress, HertzStress
from .subsurface.loads import Boussinesq, Cerruti, Flamant, Strip
from .subsurface.shakedown_limits import ShakedownLine, ShakedownPoint
from .subsurface.sliding_yield import CylinderYield, SphereYield
from .wear.laws import ArchardWear, DissipatedEnergyWear, WornComposite
from .wear.pins import PinOnDisk, WornCap
from .wear.running_in import WearingCoatedWave, WearingPunch, WearingWave
from .wear.spheres import WearingCoatedSphere, WearingCylinder, WearingSphere
from .wet.design import DesignedCaps, RoughnessWindow
from .wet.exact import ExactMeniscus
from .wet.single import DropletMeniscus, FilmMeniscus, VapourGrowth, VapourMeniscus
from .wet.summits import GrowingMenisci, WetSummits

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
            InteractingSummits,
            MergingSummits,
            MeanFieldSummits,
            GreenwoodTripp,
            McCool,
            OnionsArchard,
            BushGibsonThomas,
            GreenwoodElliptic,
            BushGibsonKeogh,
            AnisotropicSummits,
            MajumdarBhushan,
            BifractalMajumdarBhushan,
            Persson,
            FullContact,
        ),
        "Rubber friction": (PerssonFriction,),
        "Waves": (Westergaard, CrossedWaves, AdhesiveWave),
        "One contact": (
            HertzPoint,
            HertzLine,
            HertzEllipse,
            HertzBodies,
            CompressedCylinder,
            PowerLawIndenter,
            Cone,
            FlatPunch,
            EllipticPunch,
            SphericalIndenter,
            LinePowerLawIndenter,
            Wedge,
            LineFlatPunch,
            CylinderInHole,
            PinInHole,
            SphereInCavity,
            MindlinPoint,
            MindlinLine,
            MindlinWave,
            TrescaDisc,
            TrescaTwist,
            TrescaLine,
            StickingTwist,
            LubkinSphere,
            CarterRolling,
            KalkerLinear,
            ShenHedrickElkins,
            Fastsim,
            SlidingCylinder,
            SlidingPunch,
            StickingIndenter,
            StickingPunch,
            StickingPunchLine,
            StickingIndenterLine,
            FrictionalPunch,
            FrictionalIndenter,
            GoodmanLine,
            JKR,
            DMT,
            MaugisDugdale,
            AdhesivePowerLaw,
            AdhesiveCylinder,
            AdhesiveCoatedSphere,
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
            ShakedownPoint,
            ShakedownLine,
            Boussinesq,
            Cerruti,
            Flamant,
            Strip,
        ),
        "Statistics of surfaces": (NayakSummits, SampledPeaks),
        "Stickiness": (PastewkaRobbins, PerssonTosatti),
        "Plasticity and hardness": (
            PlasticityIndex,
            ProfilePlasticityIndex,
            LeastArea,
            EffectiveHardness,
            OliverPharr,
            RateHardness,
        ),
        "Menisci": (
            WetSummits,
            GrowingMenisci,
            DropletMeniscus,
            FilmMeniscus,
            VapourMeniscus,
            ExactMeniscus,
            VapourGrowth,
            RoughnessWindow,
            DesignedCaps,
        ),
        "Conductance": (PlasticJoint, ElasticJoint, MeanGapJoint, HolmSpot, SpotCluster),
        "Frictional heating": (MovingHeatSource, JaegerBand, TianKennedy, BlokFlash),
        "Sealing": (
            ParallelGap,
            TaperedGap,
            AnnularGap,
            ParabolicThroat,
            ParabolicChannel,
            SaddleThroat,
            GroovedGap,
            PatirCheng,
            EffectiveMedium,
            ObstacleArray,
            CriticalJunction,
        ),
        "Wear": (
            ArchardWear,
            DissipatedEnergyWear,
            WornComposite,
            WornCap,
            PinOnDisk,
            WearingSphere,
            WearingCoatedSphere,
            WearingCylinder,
            WearingPunch,
            WearingWave,
            WearingCoatedWave,
        ),
    }
)
"""Theories by what they are about."""

THEORIES: dict[str, type[Described]] = {theory.name: theory for family in FAMILIES.values() for theory in family}
"""Class of each theory by its name."""


ALIASES: MappingProxyType[str, str] = MappingProxyType(
    {
        "ocallaghan-cameron": "greenwood-tripp",
        "francis": "bush-gibson-thomas",
        "mccool-elliptic": "bush-gibson-keogh",
        "gw-i": "mean-field-summits",
    }
)
"""Further names, with the theory that each amounts to: O'Callaghan & Cameron's (1976) statement on
two rough surfaces, the elastic part of Francis's (1977) theory on summed moments, the statistics
that McCool (1986) simulates, and the first order of interaction by the mean plane."""


RECOGNISED: MappingProxyType[str, tuple[str, ...]] = MappingProxyType(
    {"elastic-plastic": ("hardness", "yield_stress"), "adhesive": ("work",)}
)
"""What the solids of a theory of rough contact do beside being elastic, and the parameters by which
that is recognised."""

NOT_SOLVED: MappingProxyType[str, str] = MappingProxyType(
    {"adhesive": "The numerical solution has no adhesion; in {} it adds to the area."}
)
"""What is said of theories of a kind of ``RECOGNISED``, by their names, beside a numerical solution
that leaves it out."""


def theory(name: str) -> type[Described]:
    """Class of the theory called ``name``, which may be one of the ``ALIASES``.

    InputError if there is no such theory; the message names those most like it.
    """
    name = ALIASES.get(name, name)
    if name not in THEORIES:
        near = nearest(name)
        like = f"Did you mean {' or '.join(near)}?" if near else f"They are {', '.join(THEORIES)}."
        raise InputError(f"name of a theory must be one of the catalogue, but is {name!r}. {like}")
    return THEORIES[name]


def nearest(name: str) -> list[str]:
    """Up to three names of theories that ``name`` may mean: misspelt, a part, initials, or the name
    of the class."""
    word = name.lower().replace("_", "-").replace(" ", "-")
    squeezed = word.replace("-", "")
    found = [
        known
        for known, kind in THEORIES.items()
        if word
        and (word in known or squeezed in ("".join(part[0] for part in known.split("-")), kind.__name__.lower()))
    ]
    found += [known for other, known in ALIASES.items() if len(word) > 3 and word in other]
    close = difflib.get_close_matches(word, [*THEORIES, *ALIASES], n=3, cutoff=0.6)
    found += [ALIASES.get(known, known) for known in close]
    return list(dict.fromkeys(found))[:3]
