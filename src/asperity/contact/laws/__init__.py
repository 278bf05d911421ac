"""THE place for new interface physics: what the two surfaces do to each other where they meet."""

from .by_depth import LimitByDepth, cap_at, work_density
from .coulomb import Coulomb
from .hard_wall import HardWall
from .hardness import Hardness
from .layered_hardness import LayeredHardness
from .protocol import InterfaceLaw

__all__ = [
    "Coulomb",
    "HardWall",
    "Hardness",
    "InterfaceLaw",
    "LayeredHardness",
    "LimitByDepth",
    "cap_at",
    "work_density",
]
