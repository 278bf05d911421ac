"""Laws whose pressure limit changes with the permanent indentation, and what all laws say of limit and work."""

from __future__ import annotations

from typing import Protocol, runtime_checkable

import numpy as np

from ...core.arrays import RealArray
from .protocol import InterfaceLaw


@runtime_checkable
class LimitByDepth(InterfaceLaw, Protocol):
    """Law with a limit of the pressure that depends on the permanent indentation of each point."""

    def cap_at(self, indentation: RealArray) -> float | RealArray:
        """Largest pressure in Pa where the surface is indented by ``indentation`` (nx, ny) in m."""

    def work_at(self, indentation: RealArray) -> RealArray:
        """Work (nx, ny) in J/m² to indent the virgin surface by ``indentation`` (nx, ny) in m."""


def cap_at(law: InterfaceLaw, indentation: RealArray) -> float | RealArray:
    """Largest pressure in Pa that ``law`` allows where the surface is indented by ``indentation`` (nx, ny) in m."""
    return law.cap_at(indentation) if isinstance(law, LimitByDepth) else law.pressure_cap()


def work_density(law: InterfaceLaw, before: RealArray, after: RealArray) -> RealArray:
    """Work (nx, ny) in J/m² to indent the surface from ``before`` to ``after`` (nx, ny) in m: the integral of the limit."""
    added = after - before
    if not added.any():
        return np.zeros_like(added)
    if isinstance(law, LimitByDepth):
        return law.work_at(after) - law.work_at(before)
    work: RealArray = law.pressure_cap() * added
    return work
