from . import adhesion as adhesion
from . import contact as contact
from . import dynamics as dynamics
from . import engines as engines
from . import errors as errors
from . import fem as fem
from . import files as files
from . import friction as friction
from . import generate as generate
from . import menisci as menisci
from . import plasticity as plasticity
from . import plots as plots
from . import report as report
from . import rolling as rolling
from . import roughness as roughness
from . import solids as solids
from . import solvers as solvers
from . import stresses as stresses
from . import studies as studies
from . import surfaces as surfaces
from . import theories as theories
from . import viscoelasticity as viscoelasticity
from .contact.advice import advise as advise
from .contact.advice import review as review
from .contact.boundary import Free as Free
from .contact.boundary import FreeLine as FreeLine
from .contact.boundary import Periodic as Periodic
from .contact.controls import Approach as Approach
from .contact.controls import FixedGrips as FixedGrips
from .contact.controls import Force as Force
from .contact.controls import MeanGap as MeanGap
from .contact.controls import MeanPressure as MeanPressure
from .contact.controls import Pull as Pull
from .contact.controls import Step as Step
from .contact.controls import Unloaded as Unloaded
from .contact.couplings.driver import CouplingCheck as CouplingCheck
from .contact.couplings.driver import Rounds as Rounds
from .contact.history import EnergyBalance as EnergyBalance
from .contact.history import History as History
from .contact.history import HistoryResult as HistoryResult
from .contact.history import ramps as ramps
from .contact.history import shear_cycles as shear_cycles
from .contact.law import Hardness as Hardness
from .contact.law import HardWall as HardWall
from .contact.operators import prepare_operator as prepare_operator
from .contact.problem import ContactProblem as ContactProblem
from .contact.problem import Flat as Flat
from .contact.result import ContactResult as ContactResult
from .contact.roughness import roughness_of as roughness_of
from .contact.solve import Keep as Keep
from .contact.solve import solve as solve
from .contact.state import InterfaceState as InterfaceState
from .contact.tangential import Shift as Shift
from .contact.tangential import TangentialForce as TangentialForce
from .contact.time_division import TimeSteps as TimeSteps
from .core.citations import cite as cite
from .core.engine import CpuEngine as CpuEngine
from .core.engine.array_api import ArrayEngine as ArrayEngine
from .core.engine.gpu import GpuEngine as GpuEngine
from .core.errors import AsperityError as AsperityError
from .core.errors import ConvergenceError as ConvergenceError
from .core.errors import FileFormatError as FileFormatError
from .core.errors import InputError as InputError
from .core.errors import NoSolutionError as NoSolutionError
from .core.errors import OutputError as OutputError
from .core.errors import UnitError as UnitError
from .core.grid import Grid as Grid
from .core.status import Advice as Advice
from .io.export import export_csv as export_csv
from .io.export import export_stress_vtk as export_stress_vtk
from .io.export import export_vtk as export_vtk
from .io.results import load as load
from .io.results import open_tree as open_tree
from .io.results import save as save
from .io.stress_files import save_stress as save_stress
from .io.surface_files import save_endless as save_endless
from .io.surface_files import save_gaussian as save_gaussian
from .io.surface_files import save_surface as save_surface
from .physics.adhesion.answer import AdhesiveContact as AdhesiveContact
from .physics.adhesion.bound import EnergyBound as EnergyBound
from .physics.adhesion.bound import energy_bound as energy_bound
from .physics.adhesion.branch import AdhesiveBranch as AdhesiveBranch
from .physics.adhesion.branch import adhesive_branch as adhesive_branch
from .physics.adhesion.branch import adhesive_jumps as adhesive_jumps
from .physics.adhesion.jkr import JKRAdhesion as JKRAdhesion
from .physics.adhesion.law import CustomAdhesion as CustomAdhesion
from .physics.adhesion.law import DugdaleAdhesion as DugdaleAdhesion
from .physics.adhesion.law import ExponentialAdhesion as ExponentialAdhesion
from .physics.adhesion.law import LennardJonesAdhesion as LennardJonesAdhesion
from .physics.adhesion.law import LinearAdhesion as LinearAdhesion
from .physics.adhesion.law import VanDerWaalsAdhesion as VanDerWaalsAdhesion
from .physics.adhesion.loop import AdhesionLoop as AdhesionLoop
from .physics.adhesion.loop import adhesion_cycle as adhesion_cycle
from .physics.adhesion.loop import adhesion_loop as adhesion_loop
from .physics.adhesion.surface_energy import work_of_adhesion as work_of_adhesion
from .physics.friction.answer import StickSlip as StickSlip
from .physics.friction.law import Coulomb as Coulomb
from .physics.friction.law import FullStick as FullStick
from .physics.friction.law import TrescaFriction as TrescaFriction
from .physics.friction.linearised import TangentialStiffness as TangentialStiffness
from .physics.friction.linearised import contraction_factor as contraction_factor
from .physics.friction.linearised import tangential_stiffness as tangential_stiffness
from .physics.friction.sliding import GrossSliding as GrossSliding
from .physics.hardness.layered import LayeredHardness as LayeredHardness
from .physics.hardness.plastic_load import PlasticLoad as PlasticLoad
from .physics.hardness.plastic_load import plastic_load as plastic_load
from .physics.menisci.coupling import Menisci as Menisci
from .physics.menisci.film import LiquidFilm as LiquidFilm
from .physics.menisci.summits import WetTheory as WetTheory
from .physics.menisci.summits import wet_theory as wet_theory
from .physics.plastic_flow.answer import PlasticBody as PlasticBody
from .physics.plastic_flow.answer import PlasticZone as PlasticZone
from .physics.plastic_flow.law import PlasticFlow as PlasticFlow
from .physics.rolling.creep_curve import CreepCurve as CreepCurve
from .physics.rolling.creep_curve import creep_curve as creep_curve
from .physics.rolling.rolling import Creepage as Creepage
from .physics.rolling.rolling import RollingContact as RollingContact
from .physics.rolling.rolling import roll as roll
from .physics.rolling.rough import RoughRolling as RoughRolling
from .physics.rolling.rough import roll_rough as roll_rough
from .physics.stress.compute import stress as stress
from .physics.stress.compute import stress_planes as stress_planes
from .physics.stress.criteria import MaxPrincipal as MaxPrincipal
from .physics.stress.criteria import Tresca as Tresca
from .physics.stress.criteria import VonMises as VonMises
from .physics.stress.field import StressField as StressField
from .physics.stress.loads import LineLoad as LineLoad
from .physics.stress.loads import PatchLoad as PatchLoad
from .physics.stress.loads import PointLoad as PointLoad
from .physics.stress.regions import DepthProfile as DepthProfile
from .physics.stress.regions import Everywhere as Everywhere
from .physics.stress.regions import Section as Section
from .physics.stress.regions import depths_through as depths_through
from .physics.stress.shakedown import ShakedownCurve as ShakedownCurve
from .physics.stress.shakedown import ShakedownMap as ShakedownMap
from .physics.stress.shakedown import shakedown as shakedown
from .physics.stress.shakedown import shakedown_map as shakedown_map
from .physics.stress.tractions import LoadedBody as LoadedBody
from .physics.stress.tractions import ShearTraction as ShearTraction
from .physics.stress.tractions import Sliding as Sliding
from .physics.stress.tractions import Tractions as Tractions
from .physics.stress.yielding import LoadAtYield as LoadAtYield
from .physics.stress.yielding import YieldReport as YieldReport
from .physics.stress.yielding import first_yield as first_yield
from .physics.stress.yielding import fracture_indicators as fracture_indicators
from .physics.stress.yielding import load_at_yield as load_at_yield
from .physics.viscoelastic.harmonic import HarmonicResponse as HarmonicResponse
from .physics.viscoelastic.harmonic import harmonic as harmonic
from .physics.viscoelastic.moments import Creeping as Creeping
from .physics.viscoelastic.steady_sliding import SteadySliding as SteadySliding
from .physics.viscoelastic.steady_sliding import slide as slide
from .physics.viscoelastic.transient_sliding import TransientSliding as TransientSliding
from .physics.viscoelastic.transient_sliding import slide_in_time as slide_in_time
from .plots.contact import save_path_plots as save_path_plots
from .plots.contact import save_plots as save_plots
from .plots.contact import save_surface_plot as save_surface_plot
from .plots.surface import save_roughness_plots as save_roughness_plots
from .report.animation import save_plastic_animation as save_plastic_animation
from .report.comparison import write_comparison_report as write_comparison_report
from .report.roughness import write_roughness_report as write_roughness_report
from .report.write import write_report as write_report
from .run.execute import Outcome as Outcome
from .run.execute import run as run
from .solids.elastic import Elastic as Elastic
from .solids.elastic import Rigid as Rigid
from .solids.elastic import Strength as Strength
from .solids.layers import Bonded as Bonded
from .solids.layers import ExponentialGrading as ExponentialGrading
from .solids.layers import Frictionless as Frictionless
from .solids.layers import Layer as Layer
from .solids.layers import Layered as Layered
from .solids.layers import LinearGrading as LinearGrading
from .solids.layers import PowerGrading as PowerGrading
from .solids.layers import RigidBase as RigidBase
from .solids.layers import contact_modulus as contact_modulus
from .solids.layers import graded as graded
from .solids.library import Liquid as Liquid
from .solids.library import liquid as liquid
from .solids.library import liquids as liquids
from .solids.library import material as material
from .solids.library import materials as materials
from .solids.plasticity import J2 as J2
from .solids.plasticity import LinearHardening as LinearHardening
from .solids.plasticity import PlasticState as PlasticState
from .solids.plasticity import Swift as Swift
from .solids.plasticity import Voce as Voce
from .solids.strength import plastic_parts as plastic_parts
from .solids.strength import plastic_solid as plastic_solid
from .solids.viscoelastic import Arrhenius as Arrhenius
from .solids.viscoelastic import MasterCurve as MasterCurve
from .solids.viscoelastic import Viscoelastic as Viscoelastic
from .solids.viscoelastic import WilliamsLandelFerry as WilliamsLandelFerry
from .solids.viscoelastic import fitted_solid as fitted_solid
from .studies.campaign import Campaign as Campaign
from .studies.campaign import CampaignState as CampaignState
from .studies.campaign import open_study as open_study
from .studies.campaign import run_study as run_study
from .studies.compare import compare as compare
from .studies.comparison import Comparison as Comparison
from .studies.comparison import export_comparison_csv as export_comparison_csv
from .studies.comparison import save_comparison as save_comparison
from .surfaces.characterise.heights import mean_absolute_height as mean_absolute_height
from .surfaces.characterise.heights import peak_to_valley as peak_to_valley
from .surfaces.characterise.heights import rms_height as rms_height
from .surfaces.characterise.slopes import rms_slope as rms_slope
from .surfaces.characterise.summary import Characterisation as Characterisation
from .surfaces.characterise.summary import characterise as characterise
from .surfaces.pair import SurfacePair as SurfacePair
from .surfaces.pair import composite as composite
from .surfaces.pair import on_common_grid as on_common_grid
from .surfaces.pair import turned_over as turned_over
from .surfaces.prepare.extent import cropped as cropped
from .surfaces.prepare.extent import periodised as periodised
from .surfaces.prepare.extent import resampled as resampled
from .surfaces.prepare.extent import sliced as sliced
from .surfaces.prepare.extent import tapered as tapered
from .surfaces.prepare.filter import filtered as filtered
from .surfaces.prepare.filter import reliability_cutoff as reliability_cutoff
from .surfaces.prepare.filter import tip_limited as tip_limited
from .surfaces.prepare.level import despiked as despiked
from .surfaces.prepare.level import filled as filled
from .surfaces.prepare.level import levelled as levelled
from .surfaces.prepare.level import line_corrected as line_corrected
from .surfaces.read import channels as channels
from .surfaces.read import read as read
from .surfaces.surface import Surface as Surface
from .theories.statistics.roughness import Roughness as Roughness

__version__: str

__all__ = [
    "adhesion",
    "contact",
    "dynamics",
    "engines",
    "errors",
    "fem",
    "files",
    "friction",
    "generate",
    "menisci",
    "plasticity",
    "plots",
    "report",
    "rolling",
    "roughness",
    "solids",
    "solvers",
    "stresses",
    "studies",
    "surfaces",
    "theories",
    "viscoelasticity",
]
