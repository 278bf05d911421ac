"""Where a stress is largest: compiled bounds of it at all points, the stress itself where they
reach the largest one."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...core.arrays import RealArray
from ...core.tensor import StressTensor
from . import criteria as invariants

EXACT: dict[str, Callable[[StressTensor], RealArray]] = {
    "tension": lambda s: np.asarray(invariants.principal_stresses(s)[0]),
    "von_mises": invariants.von_mises,
    "shear": invariants.max_shear,
    "in_plane": invariants.principal_tensile,
}
"""Stresses of which the largest are sought, in the order of ``SurfaceMaxima``."""

_FIRST = 64
"""Points of the highest bounds at which the stress is evaluated first."""

_FEW = 1 << 12
"""Points up to which it is evaluated at all of them: less than the import of compiled bounds."""


def largest(
    name: str, s: StressTensor, share: float = 0.0, slack: RealArray | None = None
) -> tuple[NDArray[np.intp], RealArray]:
    """Points of ``s`` by number (n,) where the stress ``name`` may be the largest, or with a margin
    may reach it, and its values (n,) there in Pa.

    The margin at a point is ``share`` of the stress and ``slack`` (Pa, an array of as many points).
    Numbers rise.
    """
    flat = s.map(np.ravel)
    if flat.xx.size <= _FEW:
        return np.arange(flat.xx.size), np.asarray(EXACT[name](flat))
    kernels: Any = import_module(".kernels.extremes", __package__)
    bounds = np.empty(flat.xx.size)
    kernels.bounds(kernels.QUANTITIES.index(name), tuple(vars(flat).values()), bounds)
    rounding = 16.0 * float(np.finfo(flat.xx.dtype).eps) * float(np.abs(bounds).max())
    reach = bounds if share == 0.0 else bounds + share * np.abs(bounds)
    reach = reach if slack is None else reach + slack

    def at(numbers: NDArray[np.intp]) -> RealArray:
        return np.asarray(EXACT[name](flat.map(lambda component: component[numbers])))

    least = float(at(np.argpartition(bounds, -_FIRST)[-_FIRST:]).max()) - rounding
    numbers = np.flatnonzero(~(reach < least))  # all where one is NaN, so that the largest is
    return numbers, at(numbers)
