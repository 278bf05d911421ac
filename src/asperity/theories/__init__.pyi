from .adhesion.fuller_tabor import FullerTabor
from .adhesion.spheres import DMT, JKR, MaugisDugdale, maugis_pull_off, tabor_parameter
from .ask import Evaluation, evaluate
from .catalogue import FAMILIES, THEORIES, theory
from .dynamics.restitution import rebound
from .hardness.effective_hardness import EffectiveHardness, StackHardness
from .hardness.plasticity import (
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
from .rough.design_guidance import LeastArea
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
from .single.hertz import HertzEllipse, HertzLine, HertzPoint
from .single.indenters import (
    Cone,
    FlatPunch,
    LineFlatPunch,
    LinePowerLawIndenter,
    PowerLawIndenter,
    SphericalIndenter,
    Wedge,
)
from .single.mindlin import MindlinLine, MindlinPoint, tangential_modulus
from .single.oliver_pharr import OliverPharr
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
    "Cerruti",
    "ChangEtsionBogy",
    "ChangEtsionBogySphere",
    "Cone",
    "ContactAnswer",
    "CrossedWaves",
    "CylinderYield",
    "DiscreteSummits",
    "EffectiveHardness",
    "ElasticPlasticSummits",
    "Evaluation",
    "ExponentialHeights",
    "FittedGreenwoodWilliamson",
    "Flamant",
    "FlatPunch",
    "FullerTabor",
    "GaussianHeights",
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
    "KineticMeniscus",
    "KogutEtsion",
    "KogutEtsionSphere",
    "KotwalBhushan",
    "LaplaceHeights",
    "LeastArea",
    "Limit",
    "LineFlatPunch",
    "LinePowerLawIndenter",
    "MajumdarBhushan",
    "MaugisDugdale",
    "McCool",
    "MeniscusGrowth",
    "MindlinLine",
    "MindlinPoint",
    "NayakSummits",
    "OliverPharr",
    "OnionsArchard",
    "PearsonHeights",
    "Persson",
    "PlasticityIndex",
    "PowerLawIndenter",
    "Prediction",
    "ProfilePlasticityIndex",
    "SampledPeaks",
    "SinusoidalAsperity",
    "SphereYield",
    "SphericalIndenter",
    "StackHardness",
    "StatisticalMeniscus",
    "Strip",
    "TriangularHeights",
    "UniformHeights",
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
    "hardness_coefficient",
    "hertz_ellipse_normal",
    "hertz_line_normal",
    "hertz_line_shear",
    "hertz_normal",
    "hertz_shear",
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
