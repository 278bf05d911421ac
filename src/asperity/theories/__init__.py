"""Closed-form theories: they take and return numbers."""

from .adhesive_sphere import DMT, JKR, tabor_parameter
from .bisinusoid import CrossedWaves
from .catalogue import THEORIES, theory
from .effective_hardness import EffectiveHardness
from .greenwood_williamson import GreenwoodWilliamson
from .greenwood_williamson_fits import FittedGreenwoodWilliamson
from .hertz import HertzPoint
from .hertz_ellipse import HertzEllipse
from .hertz_fields import hertz_normal, hertz_shear
from .hertz_line import HertzLine
from .hertz_line_fields import hertz_line_normal, hertz_line_shear
from .indenters import FlatPunch, PowerLawIndenter, SphericalIndenter
from .kotwal_bhushan import KotwalBhushan
from .line_indenters import LineFlatPunch, LinePowerLawIndenter
from .line_loads import flamant_normal, flamant_tangential, strip_pressure, strip_shear
from .majumdar_bhushan import MajumdarBhushan
from .maugis import MaugisDugdale, maugis_pull_off
from .mindlin import MindlinLine, MindlinPoint, tangential_modulus
from .nayak import NayakSummits
from .persson import Persson
from .point_loads import boussinesq, cerruti
from .protocol import Limit, Prediction
from .single_contact import ContactAnswer
from .sliding_yield import YieldOnset, cylinder_yield_onset, sphere_yield_onset
from .wavy import Westergaard
from .whitehouse_archard import SampledPeaks

__all__ = [
    "DMT",
    "JKR",
    "THEORIES",
    "ContactAnswer",
    "CrossedWaves",
    "EffectiveHardness",
    "FittedGreenwoodWilliamson",
    "FlatPunch",
    "GreenwoodWilliamson",
    "HertzEllipse",
    "HertzLine",
    "HertzPoint",
    "KotwalBhushan",
    "Limit",
    "LineFlatPunch",
    "LinePowerLawIndenter",
    "MajumdarBhushan",
    "MaugisDugdale",
    "MindlinLine",
    "MindlinPoint",
    "NayakSummits",
    "Persson",
    "PowerLawIndenter",
    "Prediction",
    "SampledPeaks",
    "SphericalIndenter",
    "Westergaard",
    "YieldOnset",
    "boussinesq",
    "cerruti",
    "cylinder_yield_onset",
    "flamant_normal",
    "flamant_tangential",
    "hertz_line_normal",
    "hertz_line_shear",
    "hertz_normal",
    "hertz_shear",
    "maugis_pull_off",
    "sphere_yield_onset",
    "strip_pressure",
    "strip_shear",
    "tabor_parameter",
    "tangential_modulus",
    "theory",
]
