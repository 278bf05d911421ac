"""What an interface remembers: passed into a solve, returned with its result, never stored on the inputs."""

from __future__ import annotations

from dataclasses import dataclass

from ..core.arrays import RealArray


@dataclass(frozen=True, eq=False)
class InterfaceState:
    """State of the interface after a load.

    Parameters
    ----------
    permanent_indentation
        (nx, ny), m, >= 0: material removed from the composite profile by plastic flow so far.
    pressure
        (nx, ny), Pa: last pressure, where the next solve starts from.
    """

    permanent_indentation: RealArray
    pressure: RealArray
