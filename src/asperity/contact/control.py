"""What is prescribed: mean pressure, force, approach, mean gap, or no load at all."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, TypeAlias

from ..core import require
from ..core.grid import Grid


@dataclass(frozen=True)
class MeanPressure:
    """Nominal pressure, force over nominal area of the grid, in Pa, > 0."""

    value: float
    name: ClassVar[str] = "mean pressure"
    unit: ClassVar[str] = "Pa"

    def __post_init__(self) -> None:
        require.positive(self.value, "mean pressure (Pa)", "Use Approach(...) to prescribe the position instead.")


@dataclass(frozen=True)
class Force:
    """Normal force on the grid in N, > 0."""

    value: float
    name: ClassVar[str] = "force"
    unit: ClassVar[str] = "N"

    def __post_init__(self) -> None:
        require.positive(self.value, "force (N)", "Use Approach(...) to prescribe the position instead.")


@dataclass(frozen=True)
class Approach:
    """Approach in m, > 0, measured from first touch of the undeformed surfaces.

    Free boundary: displacement of the bodies' distant parts towards each other. Periodic boundary: there that
    displacement is unbounded, so approach is the decrease of the mean gap from its value at first touch.
    """

    value: float
    name: ClassVar[str] = "approach"
    unit: ClassVar[str] = "m"

    def __post_init__(self) -> None:
        require.positive(self.value, "approach (m)", "At zero approach the surfaces only touch.")


@dataclass(frozen=True)
class MeanGap:
    """Mean gap between the deformed surfaces in m, > 0."""

    value: float
    name: ClassVar[str] = "mean gap"
    unit: ClassVar[str] = "m"

    def __post_init__(self) -> None:
        require.positive(self.value, "mean gap (m)", "A gap of zero is full contact; use MeanPressure(...) there.")


@dataclass(frozen=True)
class Unloaded:
    """No load: the bodies, dented as they are, just touch with their highest point. Ends the unloading of a load path."""

    value: ClassVar[float] = 0.0
    name: ClassVar[str] = "mean pressure"
    unit: ClassVar[str] = "Pa"


def mean_pressure(control: MeanPressure | Force, grid: Grid) -> float:
    """Nominal pressure in Pa that ``control`` prescribes on ``grid``."""
    return control.value if isinstance(control, MeanPressure) else control.value / grid.area


Control: TypeAlias = MeanPressure | Force | Approach | MeanGap | Unloaded
"""A prescribed quantity."""
