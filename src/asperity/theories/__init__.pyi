from .adhesion.fuller_tabor import FullerTabor
from .adhesion.spheres import DMT, JKR, MaugisDugdale, maugis_pull_off, tabor_parameter
from .ask import Evaluation, evaluate
from .catalogue import FAMILIES, THEORIES, theory
from .dynamics.restitution import rebound
from .friction.coated import CoatedLine, CoatedLineSlip, CoatedTwist, CoatedTwistSlip
from .friction.finite_friction import FrictionalIndenter, FrictionalPunch, GoodmanLine, friction_of_stick
from .friction.full_stick import StickingIndenter, StickingIndenterLine, StickingPunch, StickingPunchLine
from .friction.histories import PartialSlip, SlipMemory, SlipPath
from .friction.kalker import kalker_coefficients
from .friction.partial_slip import MindlinLine, MindlinPoint, MindlinWave, tangential_modulus
from .friction.rolling import CarterRolling, CreepForces, Fastsim, KalkerLinear, ShenHedrickElkins
from .friction.sliding import SlidingCylinder, SlidingPunch
from .friction.torsion import LubkinSphere, StickingTwist
from .friction.tresca import TrescaDisc, TrescaLine, TrescaTwist
from .hardness.effective_hardness import EffectiveHardness, OliverPharr, StackHardness
from .hardness.plasticity import (
    LeastArea,
    PlasticityIndex,
    ProfilePlasticityIndex,
    critical_interference,
    hardness_coefficient,
    nominal_interference,
    profile_plasticity_index,
    summit_plasticity_index,
    yield_coefficient,
)
from .protocol import ContactAnswer, Limit, Prediction
from .rough.discrete_summits import DiscreteSummits, IdenticalAsperities
from .rough.elastic_plastic_laws import (
    ChangEtsionBogy,
    ChangEtsionBogySphere,
    ElasticPlasticSummits,
    JacksonGreen,
    JacksonGreenSphere,
    KogutEtsion,
    KogutEtsionSphere,
)
from .rough.elliptic_summits import AnisotropicSummits, BushGibsonThomas, GreenwoodElliptic, McCool
from .rough.greenwood_williamson import (
    FittedGreenwoodWilliamson,
    GreenwoodTripp,
    GreenwoodWilliamson,
    KotwalBhushan,
    plastic_area_share,
    separation_at_plastic_onset,
)
from .rough.interacting_crests import InteractingCrests
from .rough.majumdar_bhushan import MajumdarBhushan
from .rough.persson import Persson
from .rough.profile_peaks import OnionsArchard, SampledPeaks
from .single.conforming import CylinderInHole, PinInHole, SphereInCavity
from .single.hertz import HertzEllipse, HertzLine, HertzPoint
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
from .statistics.heights import (
    AnyHeights,
    ExponentialHeights,
    GaussianHeights,
    HistogramHeights,
    LaplaceHeights,
    PearsonHeights,
    TriangularHeights,
    UniformHeights,
)
from .statistics.nayak import NayakSummits
from .subsurface.hertz import (
    HertzEllipseStress,
    HertzLineStress,
    HertzStress,
    hertz_ellipse_normal,
    hertz_line_normal,
    hertz_line_shear,
    hertz_normal,
    hertz_shear,
)
from .subsurface.loads import (
    Boussinesq,
    Cerruti,
    Flamant,
    Strip,
    boussinesq,
    cerruti,
    flamant_normal,
    flamant_tangential,
    strip_pressure,
    strip_shear,
)
from .subsurface.sliding_yield import CylinderYield, SphereYield, YieldOnset, cylinder_yield_onset, sphere_yield_onset
from .wet.meniscus import MeniscusGrowth
from .wet.single import DropletMeniscus, FilmMeniscus, VapourMeniscus
from .wet.summits import GrowingMenisci, KineticMeniscus, StatisticalMeniscus, WetSummits

__all__ = [
    "DMT",
    "FAMILIES",
    "JKR",
    "THEORIES",
    "AnisotropicSummits",
    "AnyHeights",
    "Boussinesq",
    "BushGibsonThomas",
    "CarterRolling",
    "Cerruti",
    "ChangEtsionBogy",
    "ChangEtsionBogySphere",
    "CoatedLine",
    "CoatedLineSlip",
    "CoatedTwist",
    "CoatedTwistSlip",
    "Cone",
    "ContactAnswer",
    "CreepForces",
    "CrossedWaves",
    "CylinderInHole",
    "CylinderYield",
    "DiscreteSummits",
    "DropletMeniscus",
    "EffectiveHardness",
    "ElasticPlasticSummits",
    "EllipticPunch",
    "Evaluation",
    "ExponentialHeights",
    "Fastsim",
    "FilmMeniscus",
    "FittedGreenwoodWilliamson",
    "Flamant",
    "FlatPunch",
    "FrictionalIndenter",
    "FrictionalPunch",
    "FullerTabor",
    "GaussianHeights",
    "GoodmanLine",
    "GreenwoodElliptic",
    "GreenwoodTripp",
    "GreenwoodWilliamson",
    "GrowingMenisci",
    "HertzEllipse",
    "HertzEllipseStress",
    "HertzLine",
    "HertzLineStress",
    "HertzPoint",
    "HertzStress",
    "HistogramHeights",
    "IdenticalAsperities",
    "InteractingCrests",
    "JacksonGreen",
    "JacksonGreenSphere",
    "KalkerLinear",
    "KineticMeniscus",
    "KogutEtsion",
    "KogutEtsionSphere",
    "KotwalBhushan",
    "LaplaceHeights",
    "LeastArea",
    "Limit",
    "LineFlatPunch",
    "LinePowerLawIndenter",
    "LubkinSphere",
    "MajumdarBhushan",
    "MaugisDugdale",
    "McCool",
    "MeniscusGrowth",
    "MindlinLine",
    "MindlinPoint",
    "MindlinWave",
    "NayakSummits",
    "OliverPharr",
    "OnionsArchard",
    "PartialSlip",
    "PearsonHeights",
    "Persson",
    "PinInHole",
    "PlasticityIndex",
    "PowerLawIndenter",
    "Prediction",
    "ProfilePlasticityIndex",
    "SampledPeaks",
    "ShenHedrickElkins",
    "SinusoidalAsperity",
    "SlidingCylinder",
    "SlidingPunch",
    "SlipMemory",
    "SlipPath",
    "SphereInCavity",
    "SphereYield",
    "SphericalIndenter",
    "StackHardness",
    "StatisticalMeniscus",
    "StickingIndenter",
    "StickingIndenterLine",
    "StickingPunch",
    "StickingPunchLine",
    "StickingTwist",
    "Strip",
    "TrescaDisc",
    "TrescaLine",
    "TrescaTwist",
    "TriangularHeights",
    "UniformHeights",
    "VapourMeniscus",
    "Wedge",
    "Westergaard",
    "WetSummits",
    "YieldOnset",
    "boussinesq",
    "cerruti",
    "critical_interference",
    "cylinder_yield_onset",
    "evaluate",
    "flamant_normal",
    "flamant_tangential",
    "friction_of_stick",
    "hardness_coefficient",
    "hertz_ellipse_normal",
    "hertz_line_normal",
    "hertz_line_shear",
    "hertz_normal",
    "hertz_shear",
    "kalker_coefficients",
    "maugis_pull_off",
    "nominal_interference",
    "plastic_area_share",
    "profile_plasticity_index",
    "rebound",
    "separation_at_plastic_onset",
    "sphere_yield_onset",
    "strip_pressure",
    "strip_shear",
    "summit_plasticity_index",
    "tabor_parameter",
    "tangential_modulus",
    "theory",
    "yield_coefficient",
]
