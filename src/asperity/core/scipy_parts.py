"""Parts of SciPy that are imported at their first use, a tenth of a second each.

``from ..core.scipy_parts import special`` at the top of a module costs nothing until a function
calls ``special.ndtr(x)``.
"""

from __future__ import annotations

from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any


class LatePart(ModuleType):
    """Stands for the module of its name, and keeps each of its names that was asked for."""

    def __getattr__(self, name: str) -> Any:
        value = vars(self)[name] = getattr(import_module(self.__name__), name)
        return value


if TYPE_CHECKING:
    from scipy import interpolate, io, linalg, ndimage, optimize, sparse, special
    from scipy.sparse import linalg as sparse_linalg
else:
    interpolate = LatePart("scipy.interpolate")
    io = LatePart("scipy.io")
    linalg = LatePart("scipy.linalg")
    ndimage = LatePart("scipy.ndimage")
    optimize = LatePart("scipy.optimize")
    sparse = LatePart("scipy.sparse")
    sparse_linalg = LatePart("scipy.sparse.linalg")
    special = LatePart("scipy.special")

__all__ = ["interpolate", "io", "linalg", "ndimage", "optimize", "sparse", "sparse_linalg", "special"]
