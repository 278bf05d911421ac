from .adhesion.adhesive_shapes import AdhesiveCylinder, AdhesivePowerLaw, AdhesiveWave
from .adhesion.coated_sphere import AdhesiveCoatedSphere
from .adhesion.fuller_tabor import FullerTabor
from .adhesion.spheres import DMT, JKR, MaugisDugdale, maugis_pull_off, tabor_parameter
from .adhesion.stickiness import PastewkaRobbins, PerssonTosatti
from .ask import Evaluation, evaluate
from .catalogue import FAMILIES, THEORIES, theory
from .conductance.joints import ElasticJoint, JointAnswer, MeanGapJoint, PlasticJoint
from .conductance.spots import HolmSpot, SpotAnswer, SpotCluster
from .dynamics.oscillation import (
    BeltStickSlip,
    FreeVibration,
    belt_stick_slip,
    critical_stiffness,
    flutter_friction,
    free_vibration,
)
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
from .hardness.cavities import ExpandingCavity, cavity_model, expanding_cavity
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
from .hardness.rate_hardness import RateHardness
from .hardness.unloading import (
    IndentationAnalysis,
    UnloadingFit,
    analyse_indentation,
    berkovich_area,
    cone_area,
    fit_unloading,
    paraboloid_area,
    residual_depth,
    sphere_area,
)
from .heating.estimates import BlokFlash, FlashAnswer, HeatAnswer, JaegerBand, MovingHeatSource, TianKennedy
from .heating.impedance import HeatConductor, HeatLayer
from .heating.sources import BandSource, EllipticSource, MovingSource, RectangularSource, disc_source
from .heating.thermoelastic import critical_wavelength
from .protocol import ContactAnswer, Limit, Prediction
from .rough.bush_gibson_keogh import BushGibsonKeogh
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
from .rough.full_contact import FullContact
from .rough.greenwood_williamson import (
    FittedGreenwoodWilliamson,
    GreenwoodTripp,
    GreenwoodWilliamson,
    KotwalBhushan,
    plastic_area_share,
    separation_at_plastic_onset,
)
from .rough.interacting_crests import InteractingCrests
from .rough.interacting_summits import InteractingSummits, MergingSummits
from .rough.line_contact import full_contact_pressure, persson_line_area, wave_line_area
from .rough.majumdar_bhushan import BifractalMajumdarBhushan, MajumdarBhushan
from .rough.mean_field_summits import MeanFieldSummits, sunk
from .rough.persson import IsotropicSpectrum, Persson
from .rough.profile_peaks import OnionsArchard, SampledPeaks
from .rough.rubber_friction import PerssonFriction, RubberFriction, rubber_friction
from .sealing.gaps import (
    AnnularGap,
    BracketedFlow,
    FilmFlow,
    GasFlow,
    ParabolicChannel,
    ParabolicThroat,
    ParallelGap,
    SaddleThroat,
    TaperedGap,
)
from .sealing.media import ArrayAnswer, CriticalJunction, EffectiveMedium, JunctionAnswer, ObstacleArray
from .sealing.roughness import FittedFactors, GroovedGap, PatirCheng, WaveFactors
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
from .statistics.heights import (
    AnyHeights,
    ExponentialHeights,
    GaussianHeights,
    HistogramHeights,
    LaplaceHeights,
    PearsonHeights,
    TriangularHeights,
    UniformHeights,
    WeibullHeights,
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
from .subsurface.point_shakedown import (
    PointShakedown,
    SphereShakedown,
    ellipse_shakedown,
    point_shakedown,
    sphere_shakedown,
)
from .subsurface.shakedown import CylinderShakedown, LineShakedown, cylinder_shakedown, line_shakedown
from .subsurface.shakedown_limits import ShakedownLine, ShakedownPoint
from .subsurface.sliding_yield import CylinderYield, SphereYield, YieldOnset, cylinder_yield_onset, sphere_yield_onset
from .wear.laws import ArchardWear, DissipatedEnergyWear, WornComposite, wear_coefficient
from .wear.pins import PinOnDisk, WornCap, track_section
from .wear.running_in import WearingCoatedWave, WearingPunch, WearingWave, punch_rates
from .wear.spheres import WearingCoatedSphere, WearingCylinder, WearingSphere
from .wet.design import DesignedCaps, RoughnessWindow
from .wet.exact import ExactMeniscus
from .wet.meniscus import MeniscusGrowth
from .wet.single import DropletMeniscus, FilmMeniscus, VapourGrowth, VapourMeniscus
from .wet.summits import GrowingMenisci, KineticMeniscus, StatisticalMeniscus, WetSummits

__all__ = [
    "DMT",
    "FAMILIES",
    "JKR",
    "THEORIES",
    "AdhesiveCoatedSphere",
    "AdhesiveCylinder",
    "AdhesivePowerLaw",
    "AdhesiveWave",
    "AnisotropicSummits",
    "AnnularGap",
    "AnyHeights",
    "ArchardWear",
    "ArrayAnswer",
    "BandSource",
    "BeltStickSlip",
    "BifractalMajumdarBhushan",
    "BlokFlash",
    "Boussinesq",
    "BracketedFlow",
    "BushGibsonKeogh",
    "BushGibsonThomas",
    "CarterRolling",
    "Cerruti",
    "ChangEtsionBogy",
    "ChangEtsionBogySphere",
    "CoatedLine",
    "CoatedLineSlip",
    "CoatedTwist",
    "CoatedTwistSlip",
    "CompressedCylinder",
    "Cone",
    "ContactAnswer",
    "CreepForces",
    "CriticalJunction",
    "CrossedWaves",
    "CylinderInHole",
    "CylinderShakedown",
    "CylinderYield",
    "DesignedCaps",
    "DiscreteSummits",
    "DissipatedEnergyWear",
    "DropletMeniscus",
    "EffectiveHardness",
    "EffectiveMedium",
    "ElasticJoint",
    "ElasticPlasticSummits",
    "EllipticPunch",
    "EllipticSource",
    "Evaluation",
    "ExactMeniscus",
    "ExpandingCavity",
    "ExponentialHeights",
    "Fastsim",
    "FilmFlow",
    "FilmMeniscus",
    "FittedFactors",
    "FittedGreenwoodWilliamson",
    "Flamant",
    "FlashAnswer",
    "FlatPunch",
    "FreeVibration",
    "FrictionalIndenter",
    "FrictionalPunch",
    "FullContact",
    "FullerTabor",
    "GasFlow",
    "GaussianHeights",
    "GoodmanLine",
    "GreenwoodElliptic",
    "GreenwoodTripp",
    "GreenwoodWilliamson",
    "GroovedGap",
    "GrowingMenisci",
    "HeatAnswer",
    "HeatConductor",
    "HeatLayer",
    "HertzBodies",
    "HertzEllipse",
    "HertzEllipseStress",
    "HertzLine",
    "HertzLineStress",
    "HertzPoint",
    "HertzStress",
    "HistogramHeights",
    "HolmSpot",
    "IdenticalAsperities",
    "IndentationAnalysis",
    "InteractingCrests",
    "InteractingSummits",
    "IsotropicSpectrum",
    "JacksonGreen",
    "JacksonGreenSphere",
    "JaegerBand",
    "JointAnswer",
    "JunctionAnswer",
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
    "LineShakedown",
    "LubkinSphere",
    "MajumdarBhushan",
    "MaugisDugdale",
    "McCool",
    "MeanFieldSummits",
    "MeanGapJoint",
    "MeniscusGrowth",
    "MergingSummits",
    "MindlinLine",
    "MindlinPoint",
    "MindlinWave",
    "MovingHeatSource",
    "MovingSource",
    "NayakSummits",
    "ObstacleArray",
    "OliverPharr",
    "OnionsArchard",
    "ParabolicChannel",
    "ParabolicThroat",
    "ParallelGap",
    "PartialSlip",
    "PastewkaRobbins",
    "PatirCheng",
    "PearsonHeights",
    "Persson",
    "PerssonFriction",
    "PerssonTosatti",
    "PinInHole",
    "PinOnDisk",
    "PlasticJoint",
    "PlasticityIndex",
    "PointShakedown",
    "PowerLawIndenter",
    "Prediction",
    "ProfilePlasticityIndex",
    "RateHardness",
    "RectangularSource",
    "RoughnessWindow",
    "RubberFriction",
    "SaddleThroat",
    "SampledPeaks",
    "ShakedownLine",
    "ShakedownPoint",
    "ShenHedrickElkins",
    "SinusoidalAsperity",
    "SlidingCylinder",
    "SlidingPunch",
    "SlipMemory",
    "SlipPath",
    "SphereInCavity",
    "SphereShakedown",
    "SphereYield",
    "SphericalIndenter",
    "SpotAnswer",
    "SpotCluster",
    "StackHardness",
    "StatisticalMeniscus",
    "StickingIndenter",
    "StickingIndenterLine",
    "StickingPunch",
    "StickingPunchLine",
    "StickingTwist",
    "Strip",
    "TaperedGap",
    "TianKennedy",
    "TrescaDisc",
    "TrescaLine",
    "TrescaTwist",
    "TriangularHeights",
    "UniformHeights",
    "UnloadingFit",
    "VapourGrowth",
    "VapourMeniscus",
    "WaveFactors",
    "WearingCoatedSphere",
    "WearingCoatedWave",
    "WearingCylinder",
    "WearingPunch",
    "WearingSphere",
    "WearingWave",
    "Wedge",
    "WeibullHeights",
    "Westergaard",
    "WetSummits",
    "WornCap",
    "WornComposite",
    "YieldOnset",
    "analyse_indentation",
    "belt_stick_slip",
    "berkovich_area",
    "boussinesq",
    "cavity_model",
    "cerruti",
    "cone_area",
    "critical_interference",
    "critical_stiffness",
    "critical_wavelength",
    "cylinder_shakedown",
    "cylinder_yield_onset",
    "disc_source",
    "ellipse_shakedown",
    "evaluate",
    "expanding_cavity",
    "fit_unloading",
    "flamant_normal",
    "flamant_tangential",
    "flutter_friction",
    "free_vibration",
    "friction_of_stick",
    "full_contact_pressure",
    "hardness_coefficient",
    "hertz_ellipse_normal",
    "hertz_line_normal",
    "hertz_line_shear",
    "hertz_normal",
    "hertz_shear",
    "kalker_coefficients",
    "line_shakedown",
    "maugis_pull_off",
    "nominal_interference",
    "paraboloid_area",
    "persson_line_area",
    "plastic_area_share",
    "point_shakedown",
    "profile_plasticity_index",
    "punch_rates",
    "rebound",
    "residual_depth",
    "rubber_friction",
    "separation_at_plastic_onset",
    "sphere_area",
    "sphere_shakedown",
    "sphere_yield_onset",
    "strip_pressure",
    "strip_shear",
    "summit_plasticity_index",
    "sunk",
    "tabor_parameter",
    "tangential_modulus",
    "theory",
    "track_section",
    "wave_line_area",
    "wear_coefficient",
    "yield_coefficient",
]
