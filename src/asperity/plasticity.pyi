from .contact.law import Hardness, HardWall
from .physics.hardness.at_speed import ContactAtSpeed, solve_at_speed
from .physics.hardness.layered import LayeredHardness
from .physics.hardness.plastic_load import PlasticLoad, plastic_load
from .physics.plastic_flow.answer import PlasticBody, PlasticZone
from .physics.plastic_flow.law import PlasticFlow
from .solids.plasticity import J2, LinearHardening, PlasticState, Swift, Voce
from .solids.strength import plastic_parts, plastic_solid

__all__ = [
    "J2",
    "ContactAtSpeed",
    "HardWall",
    "Hardness",
    "LayeredHardness",
    "LinearHardening",
    "PlasticBody",
    "PlasticFlow",
    "PlasticLoad",
    "PlasticState",
    "PlasticZone",
    "Swift",
    "Voce",
    "plastic_load",
    "plastic_parts",
    "plastic_solid",
    "solve_at_speed",
]
