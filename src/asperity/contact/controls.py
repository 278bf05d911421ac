"""What may be prescribed to a contact: a load, a position or no load; with what moves along the
surface, a step of a history."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, TypeAlias

from ..core import require
from ..core.errors import InputError
from ..core.grid import Grid
from .tangential import Tangential


@dataclass(frozen=True)
class MeanPressure:
    """Nominal pressure, force over nominal area of the grid, in Pa, > 0."""

    value: float
    name: ClassVar[str] = "mean pressure"
    unit: ClassVar[str] = "Pa"

    def __post_init__(self) -> None:
        require.positive(self.value, "mean pressure (Pa)", "Use {approach} to prescribe the position instead.")


@dataclass(frozen=True)
class Force:
    """Normal force on the grid in N, > 0."""

    value: float
    name: ClassVar[str] = "force"
    unit: ClassVar[str] = "N"

    def __post_init__(self) -> None:
        require.positive(self.value, "force (N)", "Use {approach} to prescribe the position instead.")


@dataclass(frozen=True)
class Approach:
    """Approach in m, > 0, measured from first touch of the undeformed surfaces.

    Free boundary: displacement of the bodies' distant parts towards each other. Periodic boundary:
    there that displacement is unbounded, so approach is the decrease of the mean gap from its value
    at first touch.
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
        require.positive(self.value, "mean gap (m)", "A gap of zero is full contact; use {mean_pressure} there.")


@dataclass(frozen=True)
class Pull:
    """Tensile normal force on the grid in N, > 0, that adhesion bears; only for a problem with
    ``adhesion``."""

    value: float
    name: ClassVar[str] = "pull"
    unit: ClassVar[str] = "N"

    def __post_init__(self) -> None:
        require.positive(self.value, "pull (N)", "Use {force} to press the bodies together.")


@dataclass(frozen=True)
class FixedGrips:
    """Approach of a testing machine that holds the bodies by a spring, of either sign; only for a
    problem with ``adhesion``.

    The bodies are at the approach δ = value - F/stiffness under the force F > 0 that presses them
    together.

    Parameters
    ----------
    value
        Approach in m from first touch of the undeformed surfaces (``Approach``); negative where
        they were apart.
    stiffness
        Stiffness of the machine in N/m, > 0; infinite by default.

    Raises
    ------
    InputError
        If the approach is not finite or the stiffness not positive.
    """

    value: float
    stiffness: float = math.inf
    name: ClassVar[str] = "approach of the grips"
    unit: ClassVar[str] = "m"

    def __post_init__(self) -> None:
        require.finite(self.value, "approach of the grips (m)")
        if not self.stiffness > 0.0:
            raise InputError(f"stiffness of the machine (N/m) must be positive, but is {self.stiffness:g}.")


@dataclass(frozen=True)
class Unloaded:
    """No load: the bodies, dented as they are, just touch with their highest point. Ends the
    unloading of a load path."""

    value: ClassVar[float] = 0.0
    name: ClassVar[str] = "mean pressure"
    unit: ClassVar[str] = "Pa"


def mean_pressure(control: MeanPressure | Force, grid: Grid) -> float:
    """Nominal pressure in Pa that ``control`` prescribes on ``grid``."""
    return control.value if isinstance(control, MeanPressure) else control.value / grid.area


Control: TypeAlias = MeanPressure | Force | Approach | MeanGap | Unloaded | Pull | FixedGrips
"""A prescribed quantity."""


@dataclass(frozen=True)
class Step:
    """One step of a history.

    Parameters
    ----------
    normal
        ``MeanPressure``, ``Force``, ``Approach``, ``MeanGap`` or ``Unloaded``.
    tangential
        ``Shift`` or ``TangentialForce``: surfaces stick and slip by the friction of the problem.
        None leaves what the step before prescribed, at first no shift; in a history without any,
        all points slide where the problem has ``Coulomb`` friction.
    duration
        Time in s, >= 0, in which the load or position goes in a straight line to ``normal`` from
        where the step before left it; zero for at once. A hold is a step to the load that is there
        already. It matters to ``Viscoelastic`` bodies alone.

    Raises
    ------
    InputError
        If one of them is something else, or the duration negative or infinite.
    """

    normal: Control
    tangential: Tangential | None = None
    duration: float = 0.0

    def __post_init__(self) -> None:
        if not isinstance(self.normal, Control):
            raise InputError(
                "normal control of a step must be a MeanPressure, Force, Approach, MeanGap or Unloaded, but "
                f"is {self.normal!r}. Write for example MeanPressure(50e3)."
            )
        if not isinstance(self.tangential, Tangential | None):
            raise InputError(
                f"tangential control of a step must be a Shift, a TangentialForce or None, but is {self.tangential!r}. "
                "Write for example Shift(5e-9)."
            )
        object.__setattr__(self, "duration", require.not_negative(self.duration, "duration of a step (s)"))


def as_step(step: Step | Control) -> Step:
    """``step``, or that of a control along the normal alone."""
    return step if isinstance(step, Step) else Step(step)
