from .adhesive_sphere import DMT, JKR, tabor_parameter
from .anisotropic_summits import AnisotropicSummits
from .bisinusoid import CrossedWaves
from .bush_gibson_thomas import BushGibsonThomas, GreenwoodElliptic
from .catalogue import FAMILIES, THEORIES, theory
from .chang_etsion_bogy import ChangEtsionBogy, ChangEtsionBogySphere
from .cone import Cone, Wedge
from .design_guidance import LeastArea
from .discrete_summits import DiscreteSummits
from .effective_hardness import EffectiveHardness
from .elastic_plastic_summits import ElasticPlasticSummits
from .fuller_tabor import FullerTabor
from .greenwood_tripp import GreenwoodTripp
from .greenwood_williamson import GreenwoodWilliamson
from .greenwood_williamson_fits import FittedGreenwoodWilliamson
from .greenwood_williamson_plastic import plastic_area_share, separation_at_plastic_onset
from .hertz import HertzPoint
from .hertz_ellipse import HertzEllipse
from .hertz_ellipse_stress import hertz_ellipse_normal
from .hertz_fields import hertz_normal, hertz_shear
from .hertz_line import HertzLine
from .hertz_line_fields import hertz_line_normal, hertz_line_shear
from .hertz_stress import HertzEllipseStress, HertzLineStress, HertzStress
from .identical_asperities import IdenticalAsperities
from .indenters import FlatPunch, PowerLawIndenter, SphericalIndenter
from .interacting_crests import InteractingCrests
from .jackson_green import JacksonGreen, JacksonGreenSphere
from .kinetic_meniscus import KineticMeniscus
from .kogut_etsion import KogutEtsion, KogutEtsionSphere
from .kotwal_bhushan import KotwalBhushan, PearsonHeights
from .line_indenters import LineFlatPunch, LinePowerLawIndenter
from .line_loads import flamant_normal, flamant_tangential, strip_pressure, strip_shear
from .majumdar_bhushan import MajumdarBhushan
from .maugis import MaugisDugdale, maugis_pull_off
from .mccool import McCool
from .measured_heights import AnyHeights, HistogramHeights
from .meniscus_growth import MeniscusGrowth
from .mindlin import MindlinLine, MindlinPoint, tangential_modulus
from .nayak import NayakSummits
from .oliver_pharr import OliverPharr
from .onions_archard import OnionsArchard
from .persson import Persson
from .plasticity import PlasticityIndex, ProfilePlasticityIndex
from .plasticity_index import (
    critical_interference,
    hardness_coefficient,
    nominal_interference,
    profile_plasticity_index,
    summit_plasticity_index,
    yield_coefficient,
)
from .point_loads import boussinesq, cerruti
from .protocol import Limit, Prediction
from .restitution import rebound
from .single_contact import ContactAnswer
from .sinusoidal_asperity import SinusoidalAsperity
from .sliding_yield import CylinderYield, SphereYield, YieldOnset, cylinder_yield_onset, sphere_yield_onset
from .stack_hardness import StackHardness
from .statistical_meniscus import StatisticalMeniscus
from .summit_heights import ExponentialHeights, GaussianHeights, LaplaceHeights, TriangularHeights, UniformHeights
from .surface_forces import Boussinesq, Cerruti, Flamant, Strip
from .wavy import Westergaard
from .ways import Evaluation, evaluate
from .wet_summits import GrowingMenisci, WetSummits
from .whitehouse_archard import SampledPeaks

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
