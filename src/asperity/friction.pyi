from .contact.history import shear_cycles
from .contact.tangential import Shift, TangentialForce
from .physics.friction.answer import StickSlip
from .physics.friction.law import Coulomb, FullStick, TrescaFriction
from .physics.friction.linearised import TangentialStiffness, contraction_factor, tangential_stiffness
from .physics.friction.sliding import GrossSliding

__all__ = [
    "Coulomb",
    "FullStick",
    "GrossSliding",
    "Shift",
    "StickSlip",
    "TangentialForce",
    "TangentialStiffness",
    "TrescaFriction",
    "contraction_factor",
    "shear_cycles",
    "tangential_stiffness",
]
