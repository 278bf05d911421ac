from .physics.adhesion.answer import AdhesiveContact
from .physics.adhesion.bound import EnergyBound, energy_bound
from .physics.adhesion.branch import AdhesiveBranch, adhesive_branch, adhesive_jumps
from .physics.adhesion.jkr import JKRAdhesion
from .physics.adhesion.law import (
    Adhesion,
    CustomAdhesion,
    DugdaleAdhesion,
    ExponentialAdhesion,
    LennardJonesAdhesion,
    LinearAdhesion,
    VanDerWaalsAdhesion,
)
from .physics.adhesion.loop import AdhesionLoop, adhesion_cycle, adhesion_loop
from .physics.adhesion.surface_energy import work_of_adhesion

__all__ = [
    "Adhesion",
    "AdhesionLoop",
    "AdhesiveBranch",
    "AdhesiveContact",
    "CustomAdhesion",
    "DugdaleAdhesion",
    "EnergyBound",
    "ExponentialAdhesion",
    "JKRAdhesion",
    "LennardJonesAdhesion",
    "LinearAdhesion",
    "VanDerWaalsAdhesion",
    "adhesion_cycle",
    "adhesion_loop",
    "adhesive_branch",
    "adhesive_jumps",
    "energy_bound",
    "work_of_adhesion",
]
