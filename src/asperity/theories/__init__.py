"""Closed-form theories: they take and return numbers. A module is imported when one of its names is asked for.

The stub beside this file says the same to type checkers.
"""

from __future__ import annotations

from types import MappingProxyType
from typing import Any

from ..core.late import LateNames

_NAMES = MappingProxyType(
    {
        "adhesive_sphere": ("DMT", "JKR", "tabor_parameter"),
        "anisotropic_summits": ("AnisotropicSummits",),
        "bisinusoid": ("CrossedWaves",),
        "bush_gibson_thomas": ("BushGibsonThomas", "GreenwoodElliptic"),
        "catalogue": ("FAMILIES", "THEORIES", "theory"),
        "chang_etsion_bogy": ("ChangEtsionBogy", "ChangEtsionBogySphere"),
        "cone": ("Cone", "Wedge"),
        "design_guidance": ("LeastArea",),
        "discrete_summits": ("DiscreteSummits",),
        "effective_hardness": ("EffectiveHardness",),
        "elastic_plastic_summits": ("ElasticPlasticSummits",),
        "fuller_tabor": ("FullerTabor",),
        "greenwood_tripp": ("GreenwoodTripp",),
        "greenwood_williamson": ("GreenwoodWilliamson",),
        "greenwood_williamson_fits": ("FittedGreenwoodWilliamson",),
        "greenwood_williamson_plastic": ("plastic_area_share", "separation_at_plastic_onset"),
        "hertz": ("HertzPoint",),
        "hertz_ellipse": ("HertzEllipse",),
        "hertz_ellipse_stress": ("hertz_ellipse_normal",),
        "hertz_fields": ("hertz_normal", "hertz_shear"),
        "hertz_line": ("HertzLine",),
        "hertz_line_fields": ("hertz_line_normal", "hertz_line_shear"),
        "hertz_stress": ("HertzEllipseStress", "HertzLineStress", "HertzStress"),
        "identical_asperities": ("IdenticalAsperities",),
        "indenters": ("FlatPunch", "PowerLawIndenter", "SphericalIndenter"),
        "interacting_crests": ("InteractingCrests",),
        "jackson_green": ("JacksonGreen", "JacksonGreenSphere"),
        "kinetic_meniscus": ("KineticMeniscus",),
        "kogut_etsion": ("KogutEtsion", "KogutEtsionSphere"),
        "kotwal_bhushan": ("KotwalBhushan", "PearsonHeights"),
        "line_indenters": ("LineFlatPunch", "LinePowerLawIndenter"),
        "line_loads": ("flamant_normal", "flamant_tangential", "strip_pressure", "strip_shear"),
        "majumdar_bhushan": ("MajumdarBhushan",),
        "maugis": ("MaugisDugdale", "maugis_pull_off"),
        "mccool": ("McCool",),
        "measured_heights": ("AnyHeights", "HistogramHeights"),
        "meniscus_growth": ("MeniscusGrowth",),
        "mindlin": ("MindlinLine", "MindlinPoint", "tangential_modulus"),
        "nayak": ("NayakSummits",),
        "oliver_pharr": ("OliverPharr",),
        "onions_archard": ("OnionsArchard",),
        "persson": ("Persson",),
        "plasticity": ("PlasticityIndex", "ProfilePlasticityIndex"),
        "plasticity_index": (
            "critical_interference",
            "hardness_coefficient",
            "nominal_interference",
            "profile_plasticity_index",
            "summit_plasticity_index",
            "yield_coefficient",
        ),
        "point_loads": ("boussinesq", "cerruti"),
        "protocol": ("Limit", "Prediction"),
        "restitution": ("rebound",),
        "single_contact": ("ContactAnswer",),
        "sinusoidal_asperity": ("SinusoidalAsperity",),
        "sliding_yield": ("CylinderYield", "SphereYield", "YieldOnset", "cylinder_yield_onset", "sphere_yield_onset"),
        "stack_hardness": ("StackHardness",),
        "statistical_meniscus": ("StatisticalMeniscus",),
        "summit_heights": (
            "ExponentialHeights",
            "GaussianHeights",
            "LaplaceHeights",
            "TriangularHeights",
            "UniformHeights",
        ),
        "surface_forces": ("Boussinesq", "Cerruti", "Flamant", "Strip"),
        "wavy": ("Westergaard",),
        "ways": ("Evaluation", "evaluate"),
        "wet_summits": ("GrowingMenisci", "WetSummits"),
        "whitehouse_archard": ("SampledPeaks",),
    }
)
"""Public names by module."""

_find = LateNames(__name__, _NAMES)
_HOME = _find.home

__all__ = sorted(_HOME)


def __getattr__(name: str) -> Any:
    value = globals()[name] = _find(name)
    return value


def __dir__() -> list[str]:
    return [*globals(), *__all__]
