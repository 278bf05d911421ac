"""What an interface remembers: passed into a solve, returned with its result, never stored on the inputs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError


@dataclass(frozen=True, eq=False)
class InterfaceState:
    """State of the interface after a load.

    Parameters
    ----------
    permanent_indentation
        (nx, ny), m, >= 0: material removed from the composite profile by plastic flow so far.
    pressure
        (nx, ny), Pa, >= 0: last pressure, where the next solve starts from.
    plastic_work
        J, >= 0: energy dissipated by plastic flow so far.

    Raises
    ------
    InputError
        If a value is negative or not finite.
    """

    permanent_indentation: RealArray
    pressure: RealArray
    plastic_work: float = 0.0

    def __post_init__(self) -> None:
        for values, what in (
            (self.permanent_indentation, "permanent indentation (m)"),
            (self.pressure, "pressure (Pa)"),
        ):
            field = require.field(values, f"{what} of an interface state")
            if not np.isfinite(field).all() or field.min() < 0.0:
                raise InputError(
                    f"{what} of an interface state must be finite and not negative, but its smallest value is "
                    f"{field.min():g}. Pass the state of an earlier result."
                )
        require.not_negative(self.plastic_work, "plastic work (J) of an interface state")
