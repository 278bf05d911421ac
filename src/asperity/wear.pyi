from .physics.wear.fretting import fretted
from .physics.wear.history import WearHistory, WearState
from .physics.wear.law import Sides, WearLaw, archard, dissipated_energy, of_layers
from .physics.wear.march import WearSteps, worn
from .physics.wear.rolled import RollingWear, rolled
from .physics.wear.rolling_course import worn_by_rolling
from .physics.wear.stresses import WornStresses
from .physics.wear.third_body import CompressedLayer, Debris, ThirdBody

__all__ = [
    "CompressedLayer",
    "Debris",
    "RollingWear",
    "Sides",
    "ThirdBody",
    "WearHistory",
    "WearLaw",
    "WearState",
    "WearSteps",
    "WornStresses",
    "archard",
    "dissipated_energy",
    "fretted",
    "of_layers",
    "rolled",
    "worn",
    "worn_by_rolling",
]
