from .physics.rolling.creep_curve import CreepCurve, creep_curve
from .physics.rolling.rolling import Creepage, RollingContact, roll
from .physics.rolling.rough import RoughRolling, roll_rough

__all__ = ["CreepCurve", "Creepage", "RollingContact", "RoughRolling", "creep_curve", "roll", "roll_rough"]
