"""Memory of an interface: passed into a solve, returned with its result, never stored on the
inputs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Self

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from .couplings.protocol import Deflections, Memory


@dataclass(frozen=True, eq=False)
class InterfaceState:
    """State of the interface after a load; a value that a later solve can start from, with the same
    answer as without a break.

    Parameters
    ----------
    pressure
        (nx, ny), Pa, >= 0: last pressure, where the next solve starts from.
    memory
        Named arrays of every coupling by its name: of ``hardness`` the permanent ``indentation``
        (nx, ny) in m, >= 0, and the plastic ``work`` in J, >= 0; of ``menisci`` their ``force`` in
        N. Couplings that a problem does not have are left out of its solve and forgotten.
    earlier
        (nx, ny), Pa: pressure of the load before the last, from which the next guess is
        extrapolated; None if there is none.
    deflections
        Displacements by ``pressure`` and by ``earlier``, which spare the next solve their products;
        not saved, and the answer is the same without.

    Raises
    ------
    InputError
        If a value is negative or not finite.
    """

    pressure: RealArray
    memory: Mapping[str, Memory] = field(default_factory=dict)
    earlier: RealArray | None = None
    deflections: Deflections | None = field(default=None, repr=False)

    def __post_init__(self) -> None:
        fields = [(self.pressure, "pressure (Pa)")]
        if self.is_dented:
            fields.append((self.permanent_indentation, "permanent indentation (m)"))
        if self.earlier is not None:
            fields.append((self.earlier, "earlier pressure (Pa)"))
        for values, what in fields:
            found = require.field(values, f"{what} of an interface state")
            if not (found.min() >= 0.0 and found.max() < np.inf):  # false for NaN as well
                raise InputError(
                    f"{what} of an interface state must be finite and not negative, but its smallest value is "
                    f"{found.min():g}. Pass the state of an earlier result."
                )
        require.not_negative(self.plastic_work, "plastic work (J) of an interface state")

    @classmethod
    def solved(
        cls,
        pressure: RealArray,
        memory: Mapping[str, Memory],
        earlier: RealArray | None = None,
        deflections: Deflections | None = None,
    ) -> Self:
        """State of arrays that a solver has left: without the checks, which go over all of them."""
        made = object.__new__(cls)
        for item, value in zip(fields(cls), (pressure, memory, earlier, deflections), strict=True):
            object.__setattr__(made, item.name, value)
        return made

    @classmethod
    def dented(cls, permanent_indentation: RealArray, pressure: RealArray, plastic_work: float = 0.0) -> Self:
        """State of a dry interface with this indentation (nx, ny) in m, last pressure (nx, ny) in
        Pa and plastic work in J."""
        memory = {"indentation": permanent_indentation, "work": np.asarray(plastic_work)}
        return cls(pressure, {"hardness": memory})

    @property
    def is_dented(self) -> bool:
        """Whether plastic flow has removed anything so far."""
        found = self.memory.get("hardness", {}).get("indentation")
        return found is not None and bool(np.any(found))

    @property
    def permanent_indentation(self) -> RealArray:
        """(nx, ny), m, >= 0: material removed from the composite profile by plastic flow so far."""
        found = self.memory.get("hardness", {}).get("indentation")
        return np.zeros(np.shape(self.pressure)) if found is None else found

    @property
    def imprint(self) -> RealArray:
        """(nx, ny), m: displacement of the surface, into the body, by plastic strain in the
        volume."""
        found = self.memory.get("plastic_flow", {}).get("lift")
        return np.zeros(np.shape(self.pressure)) if found is None else found

    @property
    def plastic_work(self) -> float:
        """J, >= 0: energy dissipated by plastic flow so far."""
        return float(self.memory.get("hardness", {}).get("work", 0.0))

    def require_shape(self, shape: tuple[int, int]) -> None:
        """Refuse a state of another grid than one of this ``shape`` with an InputError."""
        for values, what in ((self.permanent_indentation, "permanent indentation"), (self.pressure, "pressure")):
            if values.shape != shape:
                raise InputError(
                    f"{what} of the state must have the shape {shape} of the grid, but has {values.shape}."
                )
