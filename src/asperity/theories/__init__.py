"""Closed-form theories: they take and return numbers."""

from .adhesive_sphere import DMT, JKR, tabor_parameter
from .bisinusoid import CrossedWaves
from .catalogue import THEORIES, theory
from .chang_etsion_bogy import ChangEtsionBogy, ChangEtsionBogySphere
from .effective_hardness import EffectiveHardness
from .elastic_plastic_summits import ElasticPlasticSummits
from .fuller_tabor import FullerTabor
from .greenwood_williamson import GreenwoodWilliamson
from .greenwood_williamson_fits import FittedGreenwoodWilliamson
from .hertz import HertzPoint
from .hertz_ellipse import HertzEllipse
from .hertz_ellipse_stress import hertz_ellipse_normal
from .hertz_fields import hertz_normal, hertz_shear
from .hertz_line import HertzLine
from .hertz_line_fields import hertz_line_normal, hertz_line_shear
from .identical_asperities import IdenticalAsperities
from .indenters import FlatPunch, PowerLawIndenter, SphericalIndenter
from .jackson_green import JacksonGreen, JacksonGreenSphere
from .kogut_etsion import KogutEtsion, KogutEtsionSphere
from .kotwal_bhushan import KotwalBhushan
from .line_indenters import LineFlatPunch, LinePowerLawIndenter
from .line_loads import flamant_normal, flamant_tangential, strip_pressure, strip_shear
from .majumdar_bhushan import MajumdarBhushan
from .maugis import MaugisDugdale, maugis_pull_off
from .mindlin import MindlinLine, MindlinPoint, tangential_modulus
from .nayak import NayakSummits
from .oliver_pharr import OliverPharr
from .persson import Persson
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
from .sliding_yield import YieldOnset, cylinder_yield_onset, sphere_yield_onset
from .wavy import Westergaard
from .whitehouse_archard import SampledPeaks

__all__ = [
    "DMT",
    "JKR",
    "THEORIES",
    "ChangEtsionBogy",
    "ChangEtsionBogySphere",
    "ContactAnswer",
    "CrossedWaves",
    "EffectiveHardness",
    "ElasticPlasticSummits",
    "FittedGreenwoodWilliamson",
    "FlatPunch",
    "FullerTabor",
    "GreenwoodWilliamson",
    "HertzEllipse",
    "HertzLine",
    "HertzPoint",
    "IdenticalAsperities",
    "JacksonGreen",
    "JacksonGreenSphere",
    "KogutEtsion",
    "KogutEtsionSphere",
    "KotwalBhushan",
    "Limit",
    "LineFlatPunch",
    "LinePowerLawIndenter",
    "MajumdarBhushan",
    "MaugisDugdale",
    "MindlinLine",
    "MindlinPoint",
    "NayakSummits",
    "OliverPharr",
    "Persson",
    "PowerLawIndenter",
    "Prediction",
    "SampledPeaks",
    "SinusoidalAsperity",
    "SphericalIndenter",
    "Westergaard",
    "YieldOnset",
    "boussinesq",
    "cerruti",
    "critical_interference",
    "cylinder_yield_onset",
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
    "profile_plasticity_index",
    "rebound",
    "sphere_yield_onset",
    "strip_pressure",
    "strip_shear",
    "summit_plasticity_index",
    "tabor_parameter",
    "tangential_modulus",
    "theory",
    "yield_coefficient",
]
