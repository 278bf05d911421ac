"""THE place for new interface physics: what the two surfaces do to each other where they meet."""

from .adhesion import (
    Adhesion,
    CustomAdhesion,
    DugdaleAdhesion,
    ExponentialAdhesion,
    LennardJonesAdhesion,
    LinearAdhesion,
    SoftAdhesion,
    VanDerWaalsAdhesion,
    cohesive_length,
)
from .friction import Coulomb, FrictionLaw, FullStick, TrescaFriction
from .layered_hardness import LayeredHardness
from .plastic_flow import PlasticFlow
from .protocol import Hardness, HardWall, InterfaceLaw, LimitByDepth, work_density
from .short_range import JKRAdhesion

__all__ = [
    "Adhesion",
    "Coulomb",
    "CustomAdhesion",
    "DugdaleAdhesion",
    "ExponentialAdhesion",
    "FrictionLaw",
    "FullStick",
    "HardWall",
    "Hardness",
    "InterfaceLaw",
    "JKRAdhesion",
    "LayeredHardness",
    "LennardJonesAdhesion",
    "LimitByDepth",
    "LinearAdhesion",
    "PlasticFlow",
    "SoftAdhesion",
    "TrescaFriction",
    "VanDerWaalsAdhesion",
    "cohesive_length",
    "work_density",
]
