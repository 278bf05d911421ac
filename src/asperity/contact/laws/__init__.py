"""THE place for new interface physics: what the two surfaces do to each other where they meet."""

from .friction import Coulomb, FrictionLaw, FullStick, TrescaFriction
from .layered_hardness import LayeredHardness
from .protocol import Hardness, HardWall, InterfaceLaw, LimitByDepth, work_density

__all__ = [
    "Coulomb",
    "FrictionLaw",
    "FullStick",
    "HardWall",
    "Hardness",
    "InterfaceLaw",
    "LayeredHardness",
    "LimitByDepth",
    "TrescaFriction",
    "work_density",
]
