"""Closed-form theories: they take and return numbers. A module is imported on first use of one of its names.

The stub beside this file lists the same names for type checkers.
"""

from __future__ import annotations

from types import MappingProxyType
from typing import Any

from ..core.late import LateNames

_NAMES = MappingProxyType(
    {
        "adhesion.fuller_tabor": ("FullerTabor",),
        "adhesion.spheres": ("DMT", "JKR", "maugis_pull_off", "MaugisDugdale", "tabor_parameter"),
        "ask": ("evaluate", "Evaluation"),
        "catalogue": ("FAMILIES", "THEORIES", "theory"),
        "dynamics.restitution": ("rebound",),
        "hardness.effective_hardness": ("EffectiveHardness", "StackHardness"),
        "hardness.plasticity": (
            "critical_interference",
            "hardness_coefficient",
            "nominal_interference",
            "PlasticityIndex",
            "profile_plasticity_index",
            "ProfilePlasticityIndex",
            "summit_plasticity_index",
            "yield_coefficient",
        ),
        "protocol": ("ContactAnswer", "Limit", "Prediction"),
        "rough.design_guidance": ("LeastArea",),
        "rough.discrete_summits": ("DiscreteSummits", "IdenticalAsperities"),
        "rough.elastic_plastic_laws": (
            "ChangEtsionBogy",
            "ChangEtsionBogySphere",
            "JacksonGreen",
            "JacksonGreenSphere",
            "KogutEtsion",
            "KogutEtsionSphere",
        ),
        "rough.elastic_plastic_summits": ("ElasticPlasticSummits",),
        "rough.elliptic_summits": ("AnisotropicSummits", "BushGibsonThomas", "GreenwoodElliptic", "McCool"),
        "rough.greenwood_williamson": (
            "FittedGreenwoodWilliamson",
            "GreenwoodTripp",
            "GreenwoodWilliamson",
            "plastic_area_share",
            "separation_at_plastic_onset",
        ),
        "rough.interacting_crests": ("InteractingCrests",),
        "rough.kotwal_bhushan": ("KotwalBhushan", "PearsonHeights"),
        "rough.majumdar_bhushan": ("MajumdarBhushan",),
        "rough.persson": ("Persson",),
        "rough.profile_peaks": ("OnionsArchard", "SampledPeaks"),
        "single.hertz": ("HertzEllipse", "HertzLine", "HertzPoint"),
        "single.indenters": (
            "Cone",
            "FlatPunch",
            "LineFlatPunch",
            "LinePowerLawIndenter",
            "PowerLawIndenter",
            "SphericalIndenter",
            "Wedge",
        ),
        "single.mindlin": ("MindlinLine", "MindlinPoint", "tangential_modulus"),
        "single.oliver_pharr": ("OliverPharr",),
        "single.waves": ("CrossedWaves", "SinusoidalAsperity", "Westergaard"),
        "statistics.heights": (
            "AnyHeights",
            "ExponentialHeights",
            "GaussianHeights",
            "HistogramHeights",
            "LaplaceHeights",
            "TriangularHeights",
            "UniformHeights",
        ),
        "statistics.nayak": ("NayakSummits",),
        "subsurface.hertz": (
            "hertz_ellipse_normal",
            "hertz_line_normal",
            "hertz_line_shear",
            "hertz_normal",
            "hertz_shear",
            "HertzEllipseStress",
            "HertzLineStress",
            "HertzStress",
        ),
        "subsurface.loads": (
            "boussinesq",
            "Boussinesq",
            "cerruti",
            "Cerruti",
            "Flamant",
            "flamant_normal",
            "flamant_tangential",
            "Strip",
            "strip_pressure",
            "strip_shear",
        ),
        "subsurface.sliding_yield": (
            "cylinder_yield_onset",
            "CylinderYield",
            "sphere_yield_onset",
            "SphereYield",
            "YieldOnset",
        ),
        "wet.meniscus": ("MeniscusGrowth",),
        "wet.summits": ("GrowingMenisci", "KineticMeniscus", "StatisticalMeniscus", "WetSummits"),
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
