from . import adhesion as adhesion
from . import conductance as conductance
from . import contact as contact
from . import dynamics as dynamics
from . import engines as engines
from . import errors as errors
from . import fem as fem
from . import files as files
from . import friction as friction
from . import generate as generate
from . import heating as heating
from . import menisci as menisci
from . import plasticity as plasticity
from . import plots as plots
from . import report as report
from . import rolling as rolling
from . import roughness as roughness
from . import sealing as sealing
from . import sensitivities as sensitivities
from . import solids as solids
from . import solvers as solvers
from . import stresses as stresses
from . import studies as studies
from . import surfaces as surfaces
from . import theories as theories
from . import viscoelasticity as viscoelasticity
from . import wear as wear
from .cli.press import press as press
from .contact.boundary import Free as Free
from .contact.boundary import FreeLine as FreeLine
from .contact.boundary import Periodic as Periodic
from .contact.controls import Approach as Approach
from .contact.controls import FixedGrips as FixedGrips
from .contact.controls import Force as Force
from .contact.controls import MeanGap as MeanGap
from .contact.controls import MeanPressure as MeanPressure
from .contact.controls import Step as Step
from .contact.controls import Unloaded as Unloaded
from .contact.history import History as History
from .contact.history import HistoryResult as HistoryResult
from .contact.law import Hardness as Hardness
from .contact.problem import ContactProblem as ContactProblem
from .contact.result import ContactResult as ContactResult
from .contact.roughness import roughness_of as roughness_of
from .contact.solve import Keep as Keep
from .contact.solve import solve as solve
from .contact.tangential import Shift as Shift
from .contact.tangential import TangentialForce as TangentialForce
from .contact.time_division import TimeSteps as TimeSteps
from .core.citations import cite as cite
from .core.errors import ConvergenceError as ConvergenceError
from .core.errors import InputError as InputError
from .core.grid import Grid as Grid
from .io.results import load as load
from .io.results import save as save
from .physics.adhesion.law import ExponentialAdhesion as ExponentialAdhesion
from .physics.friction.law import Coulomb as Coulomb
from .physics.menisci.film import LiquidFilm as LiquidFilm
from .physics.plastic_flow.law import PlasticFlow as PlasticFlow
from .physics.prediction.predict import predict as predict
from .physics.rolling.rolling import roll as roll
from .physics.stress.compute import stress as stress
from .physics.stress.yielding import first_yield as first_yield
from .physics.viscoelastic.steady_sliding import slide as slide
from .report.write import write_report as write_report
from .run.run import run as run
from .solids.elastic import Elastic as Elastic
from .solids.elastic import Rigid as Rigid
from .solids.elastic import Strength as Strength
from .solids.layers import Frictionless as Frictionless
from .solids.layers import Layer as Layer
from .solids.layers import Layered as Layered
from .solids.layers import RigidBase as RigidBase
from .solids.library import liquid as liquid
from .solids.library import material as material
from .solids.viscoelastic import Viscoelastic as Viscoelastic
from .studies.calibrate import calibrate as calibrate
from .studies.compare import compare as compare
from .studies.design.optimise import optimise as optimise
from .surfaces.characterise.summary import characterise as characterise
from .surfaces.prepare.extent import periodised as periodised
from .surfaces.prepare.level import filled as filled
from .surfaces.prepare.level import levelled as levelled
from .surfaces.profile import Profile as Profile
from .surfaces.read import read as read
from .surfaces.scans import Scans as Scans
from .surfaces.surface import Surface as Surface

__version__: str

__all__ = [
    "adhesion",
    "conductance",
    "contact",
    "dynamics",
    "engines",
    "errors",
    "fem",
    "files",
    "friction",
    "generate",
    "heating",
    "menisci",
    "plasticity",
    "plots",
    "report",
    "rolling",
    "roughness",
    "sealing",
    "sensitivities",
    "solids",
    "solvers",
    "stresses",
    "studies",
    "surfaces",
    "theories",
    "viscoelasticity",
    "wear",
]
