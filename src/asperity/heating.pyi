from .physics.heating.answer import FrictionalHeating
from .physics.heating.heating import flash_temperature
from .physics.heating.law import HeatedInterface, Motion

__all__ = ["FrictionalHeating", "HeatedInterface", "Motion", "flash_temperature"]
