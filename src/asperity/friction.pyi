from .contact.history import shear_cycles
from .contact.tangential import Shift, TangentialForce
from .physics.friction.answer import StickSlip
from .physics.friction.law import Coulomb, FullStick, TrescaFriction
from .physics.friction.linearised import TangentialStiffness, contraction_factor, tangential_stiffness
from .physics.friction.prescribed import BondedField, bonded_contact, shear_displacement, sheared
from .physics.friction.sliding import GrossSliding

__all__ = [
    "BondedField",
    "Coulomb",
    "FullStick",
    "GrossSliding",
    "Shift",
    "StickSlip",
    "TangentialForce",
    "TangentialStiffness",
    "TrescaFriction",
    "bonded_contact",
    "contraction_factor",
    "shear_cycles",
    "shear_displacement",
    "sheared",
    "tangential_stiffness",
]
