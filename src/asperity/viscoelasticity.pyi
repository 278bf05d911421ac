from .physics.viscoelastic.harmonic import HarmonicResponse, harmonic
from .physics.viscoelastic.moments import Creeping
from .physics.viscoelastic.steady_sliding import SteadySliding, slide
from .physics.viscoelastic.transient_sliding import TransientSliding, slide_in_time
from .solids.moduli_file import TimeCurve, fitted_creep, fitted_relaxation
from .solids.viscoelastic import Arrhenius, MasterCurve, Viscoelastic, WilliamsLandelFerry, fitted_solid

__all__ = [
    "Arrhenius",
    "Creeping",
    "HarmonicResponse",
    "MasterCurve",
    "SteadySliding",
    "TimeCurve",
    "TransientSliding",
    "Viscoelastic",
    "WilliamsLandelFerry",
    "fitted_creep",
    "fitted_relaxation",
    "fitted_solid",
    "harmonic",
    "slide",
    "slide_in_time",
]
