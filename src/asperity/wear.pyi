from .physics.wear.fretting import fretted
from .physics.wear.history import WearHistory, WearState
from .physics.wear.law import Sides, WearLaw, archard, dissipated_energy, of_layers
from .physics.wear.march import WearSteps, worn
from .physics.wear.rolled import RollingWear, rolled

__all__ = [
    "RollingWear",
    "Sides",
    "WearHistory",
    "WearLaw",
    "WearState",
    "WearSteps",
    "archard",
    "dissipated_energy",
    "fretted",
    "of_layers",
    "rolled",
    "worn",
]
