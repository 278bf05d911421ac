from .physics.viscoelastic.harmonic import HarmonicResponse, harmonic
from .physics.viscoelastic.moments import Creeping
from .physics.viscoelastic.steady_sliding import SteadySliding, slide
from .physics.viscoelastic.transient_sliding import TransientSliding, slide_in_time
from .solids.viscoelastic import Arrhenius, MasterCurve, Viscoelastic, WilliamsLandelFerry, fitted_solid

__all__ = [
    "Arrhenius",
    "Creeping",
    "HarmonicResponse",
    "MasterCurve",
    "SteadySliding",
    "TransientSliding",
    "Viscoelastic",
    "WilliamsLandelFerry",
    "fitted_solid",
    "harmonic",
    "slide",
    "slide_in_time",
]
