"""THE place for new interface physics: what the two surfaces do to each other where they meet."""

from .layered_hardness import LayeredHardness
from .protocol import Coulomb, Hardness, HardWall, InterfaceLaw, LimitByDepth, work_density

__all__ = [
    "Coulomb",
    "HardWall",
    "Hardness",
    "InterfaceLaw",
    "LayeredHardness",
    "LimitByDepth",
    "work_density",
]
