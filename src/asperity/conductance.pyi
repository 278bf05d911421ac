from .physics.conductance.conductance import ContactConductance, SpotFlows, conductance
from .physics.conductance.law import ConductingInterface, radiation, temperature_jump
from .physics.conductance.stiffness import SlopeBounds, conductance_bounds

__all__ = [
    "ConductingInterface",
    "ContactConductance",
    "SlopeBounds",
    "SpotFlows",
    "conductance",
    "conductance_bounds",
    "radiation",
    "temperature_jump",
]
