from .physics.stress.compute import stress, stress_planes
from .physics.stress.criteria import MaxPrincipal, Tresca, VonMises
from .physics.stress.field import StressField
from .physics.stress.influence import influence_coefficients
from .physics.stress.loads import LineLoad, PatchLoad, PointLoad
from .physics.stress.regions import DepthProfile, Everywhere, Section, depths_through
from .physics.stress.shakedown import ShakedownCurve, ShakedownMap, shakedown, shakedown_map
from .physics.stress.tractions import LoadedBody, ShearTraction, Sliding, Tractions
from .physics.stress.yielding import LoadAtYield, YieldReport, first_yield, fracture_indicators, load_at_yield

__all__ = [
    "DepthProfile",
    "Everywhere",
    "LineLoad",
    "LoadAtYield",
    "LoadedBody",
    "MaxPrincipal",
    "PatchLoad",
    "PointLoad",
    "Section",
    "ShakedownCurve",
    "ShakedownMap",
    "ShearTraction",
    "Sliding",
    "StressField",
    "Tractions",
    "Tresca",
    "VonMises",
    "YieldReport",
    "depths_through",
    "first_yield",
    "fracture_indicators",
    "influence_coefficients",
    "load_at_yield",
    "shakedown",
    "shakedown_map",
    "stress",
    "stress_planes",
]
