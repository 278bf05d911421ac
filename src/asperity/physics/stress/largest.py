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


def largest(
    name: str, s: StressTensor, share: float = 0.0, slack: RealArray | None = None
) -> tuple[NDArray[np.intp], RealArray]:
    """Points of ``s`` by number (n,) where the stress ``name`` may be the largest, or with a margin
    may reach it, and its values (n,) there in Pa.

    The margin at a point is ``share`` of the stress and ``slack`` (Pa, an array of as many points).
    Numbers rise.
    """
    flat = s.map(np.ravel)
    bounds = _bounds(name, flat)
    rounding = 16.0 * float(np.finfo(flat.xx.dtype).eps) * float(np.abs(bounds).max())
    reach = bounds if share == 0.0 else bounds + share * np.abs(bounds)
    reach = reach if slack is None else reach + slack

    def at(numbers: NDArray[np.intp]) -> RealArray:
        return np.asarray(EXACT[name](flat.map(lambda component: component[numbers])))

    first = np.argpartition(bounds, -_FIRST)[-_FIRST:] if bounds.size > _FIRST else np.arange(bounds.size)
    numbers = np.flatnonzero(reach >= float(at(first).max()) - rounding)
    return numbers, at(numbers)


def _bounds(name: str, flat: StressTensor) -> RealArray:
    """What the stress ``name`` is at most, (n,)."""
    kernels: Any = import_module(".kernels.extremes", __package__)
    found = np.empty(flat.xx.size)
    kernels.bounds(kernels.QUANTITIES.index(name), tuple(vars(flat).values()), found)
    return found
