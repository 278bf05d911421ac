from . import fem, theories
from .contact import solvers
from .contact.advice import advise, review
from .contact.boundary import Free, FreeLine, Periodic
from .contact.controls import Approach, FixedGrips, Force, MeanGap, MeanPressure, Pull, Step, Unloaded
from .contact.couplings.driver import CouplingCheck, Rounds
from .contact.history import EnergyBalance, History, HistoryResult, ramps, shear_cycles
from .contact.law import Hardness, HardWall
from .contact.operators import prepare_operator
from .contact.problem import ContactProblem, Flat
from .contact.result import ContactResult
from .contact.roughness import roughness_of
from .contact.solve import Keep, solve
from .contact.state import InterfaceState
from .contact.tangential import Shift, TangentialForce
from .contact.time_division import TimeSteps
from .core.citations import cite
from .core.engine import CpuEngine
from .core.engine.array_api import ArrayEngine
from .core.engine.gpu import GpuEngine
from .core.errors import (
    AsperityError,
    ConvergenceError,
    FileFormatError,
    InputError,
    NoSolutionError,
    OutputError,
    UnitError,
)
from .core.grid import Grid
from .core.status import Advice
from .io.export import export_csv, export_vtk
from .io.results import load, open_tree, save
from .io.surface_files import save_endless, save_gaussian, save_surface
from .physics import dynamics
from .physics.adhesion.answer import AdhesiveContact
from .physics.adhesion.bound import EnergyBound, energy_bound
from .physics.adhesion.branch import AdhesiveBranch, adhesive_branch, adhesive_jumps
from .physics.adhesion.jkr import JKRAdhesion
from .physics.adhesion.law import (
    CustomAdhesion,
    DugdaleAdhesion,
    ExponentialAdhesion,
    LennardJonesAdhesion,
    LinearAdhesion,
    VanDerWaalsAdhesion,
)
from .physics.adhesion.loop import AdhesionLoop, adhesion_cycle, adhesion_loop
from .physics.adhesion.surface_energy import work_of_adhesion
from .physics.friction.answer import StickSlip
from .physics.friction.law import Coulomb, FullStick, TrescaFriction
from .physics.friction.linearised import TangentialStiffness, contraction_factor, tangential_stiffness
from .physics.friction.sliding import GrossSliding
from .physics.hardness.layered import LayeredHardness
from .physics.hardness.plastic_load import PlasticLoad, plastic_load
from .physics.menisci.coupling import Menisci
from .physics.menisci.film import LiquidFilm
from .physics.menisci.summits import WetTheory, wet_theory
from .physics.plastic_flow.answer import PlasticBody, PlasticZone
from .physics.plastic_flow.law import PlasticFlow
from .physics.rolling.creep_curve import CreepCurve, creep_curve
from .physics.rolling.rolling import Creepage, RollingContact, roll
from .physics.rolling.rough import RoughRolling, roll_rough
from .physics.stress.compute import stress, stress_planes
from .physics.stress.criteria import MaxPrincipal, Tresca, VonMises
from .physics.stress.field import StressField
from .physics.stress.files import export_stress_vtk, save_stress
from .physics.stress.loads import LineLoad, PatchLoad, PointLoad
from .physics.stress.regions import DepthProfile, Everywhere, Section, depths_through
from .physics.stress.shakedown import ShakedownCurve, ShakedownMap, shakedown, shakedown_map
from .physics.stress.tractions import LoadedBody, ShearTraction, Sliding, Tractions
from .physics.stress.yielding import LoadAtYield, YieldReport, first_yield, fracture_indicators, load_at_yield
from .physics.viscoelastic.harmonic import HarmonicResponse, harmonic
from .physics.viscoelastic.moments import Creeping
from .physics.viscoelastic.steady_sliding import SteadySliding, slide
from .physics.viscoelastic.transient_sliding import TransientSliding, slide_in_time
from .plots.contact import save_path_plots, save_plots, save_surface_plot
from .plots.surface import save_roughness_plots
from .report.animation import save_plastic_animation
from .report.comparison import write_comparison_report
from .report.roughness import write_roughness_report
from .report.write import write_report
from .run.execute import Outcome, run
from .solids.elastic import Elastic, Rigid, Strength
from .solids.layers import (
    Bonded,
    ExponentialGrading,
    Frictionless,
    Layer,
    Layered,
    LinearGrading,
    PowerGrading,
    RigidBase,
    contact_modulus,
    graded,
)
from .solids.library import Liquid, liquid, liquids, material, materials
from .solids.plasticity import J2, LinearHardening, PlasticState, Swift, Voce
from .solids.strength import plastic_parts, plastic_solid
from .solids.viscoelastic import Arrhenius, MasterCurve, Viscoelastic, WilliamsLandelFerry, fitted_solid
from .studies.campaign import Campaign, CampaignState, open_study, run_study
from .studies.compare import compare
from .studies.comparison import Comparison, export_comparison_csv, save_comparison
from .surfaces import generate, roughness
from .surfaces.characterise.heights import mean_absolute_height, peak_to_valley, rms_height
from .surfaces.characterise.slopes import rms_slope
from .surfaces.characterise.summary import Characterisation, characterise
from .surfaces.pair import SurfacePair, composite, on_common_grid, turned_over
from .surfaces.prepare.extent import cropped, periodised, resampled, sliced, tapered
from .surfaces.prepare.filter import filtered, reliability_cutoff, tip_limited
from .surfaces.prepare.level import despiked, filled, levelled, line_corrected
from .surfaces.read import channels, read
from .surfaces.surface import Surface
from .theories.statistics.roughness import Roughness

__version__: str

__all__ = [
    "J2",
    "AdhesionLoop",
    "AdhesiveBranch",
    "AdhesiveContact",
    "Advice",
    "Approach",
    "ArrayEngine",
    "Arrhenius",
    "AsperityError",
    "Bonded",
    "Campaign",
    "CampaignState",
    "Characterisation",
    "Comparison",
    "ContactProblem",
    "ContactResult",
    "ConvergenceError",
    "Coulomb",
    "CouplingCheck",
    "CpuEngine",
    "CreepCurve",
    "Creepage",
    "Creeping",
    "CustomAdhesion",
    "DepthProfile",
    "DugdaleAdhesion",
    "Elastic",
    "EnergyBalance",
    "EnergyBound",
    "Everywhere",
    "ExponentialAdhesion",
    "ExponentialGrading",
    "FileFormatError",
    "FixedGrips",
    "Flat",
    "Force",
    "Free",
    "FreeLine",
    "Frictionless",
    "FullStick",
    "GpuEngine",
    "Grid",
    "GrossSliding",
    "HardWall",
    "Hardness",
    "HarmonicResponse",
    "History",
    "HistoryResult",
    "InputError",
    "InterfaceState",
    "JKRAdhesion",
    "Keep",
    "Layer",
    "Layered",
    "LayeredHardness",
    "LennardJonesAdhesion",
    "LineLoad",
    "LinearAdhesion",
    "LinearGrading",
    "LinearHardening",
    "Liquid",
    "LiquidFilm",
    "LoadAtYield",
    "LoadedBody",
    "MasterCurve",
    "MaxPrincipal",
    "MeanGap",
    "MeanPressure",
    "Menisci",
    "NoSolutionError",
    "Outcome",
    "OutputError",
    "PatchLoad",
    "Periodic",
    "PlasticBody",
    "PlasticFlow",
    "PlasticLoad",
    "PlasticState",
    "PlasticZone",
    "PointLoad",
    "PowerGrading",
    "Pull",
    "Rigid",
    "RigidBase",
    "RollingContact",
    "RoughRolling",
    "Roughness",
    "Rounds",
    "Section",
    "ShakedownCurve",
    "ShakedownMap",
    "ShearTraction",
    "Shift",
    "Sliding",
    "SteadySliding",
    "Step",
    "StickSlip",
    "Strength",
    "StressField",
    "Surface",
    "SurfacePair",
    "Swift",
    "TangentialForce",
    "TangentialStiffness",
    "TimeSteps",
    "Tractions",
    "TransientSliding",
    "Tresca",
    "TrescaFriction",
    "UnitError",
    "Unloaded",
    "VanDerWaalsAdhesion",
    "Viscoelastic",
    "Voce",
    "VonMises",
    "WetTheory",
    "WilliamsLandelFerry",
    "YieldReport",
    "__version__",
    "adhesion_cycle",
    "adhesion_loop",
    "adhesive_branch",
    "adhesive_jumps",
    "advise",
    "channels",
    "characterise",
    "cite",
    "compare",
    "composite",
    "contact_modulus",
    "contraction_factor",
    "creep_curve",
    "cropped",
    "depths_through",
    "despiked",
    "dynamics",
    "energy_bound",
    "export_comparison_csv",
    "export_csv",
    "export_stress_vtk",
    "export_vtk",
    "fem",
    "filled",
    "filtered",
    "first_yield",
    "fitted_solid",
    "fracture_indicators",
    "generate",
    "graded",
    "harmonic",
    "levelled",
    "line_corrected",
    "liquid",
    "liquids",
    "load",
    "load_at_yield",
    "material",
    "materials",
    "mean_absolute_height",
    "on_common_grid",
    "open_study",
    "open_tree",
    "peak_to_valley",
    "periodised",
    "plastic_load",
    "plastic_parts",
    "plastic_solid",
    "prepare_operator",
    "ramps",
    "read",
    "reliability_cutoff",
    "resampled",
    "review",
    "rms_height",
    "rms_slope",
    "roll",
    "roll_rough",
    "roughness",
    "roughness_of",
    "run",
    "run_study",
    "save",
    "save_comparison",
    "save_endless",
    "save_gaussian",
    "save_path_plots",
    "save_plastic_animation",
    "save_plots",
    "save_roughness_plots",
    "save_stress",
    "save_surface",
    "save_surface_plot",
    "shakedown",
    "shakedown_map",
    "shear_cycles",
    "sliced",
    "slide",
    "slide_in_time",
    "solve",
    "solvers",
    "stress",
    "stress_planes",
    "tangential_stiffness",
    "tapered",
    "theories",
    "tip_limited",
    "turned_over",
    "wet_theory",
    "work_of_adhesion",
    "write_comparison_report",
    "write_report",
    "write_roughness_report",
]
