"""THE place for new interface physics: what the two surfaces do to each other where they meet."""

from .hard_wall import HardWall
from .hardness import Hardness
from .protocol import InterfaceLaw

__all__ = ["HardWall", "Hardness", "InterfaceLaw"]
