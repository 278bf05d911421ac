"""Fields in a half-space as answers of theories: displacement and stress at points, and the stress of von Mises."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.arrays import RealArray
from ..core.deviator import second_invariant
from ..core.tensor import Displacement, StressTensor
from .ways import Column, asked

STRESS = (
    *(
        Column(f"stress.{name}", "Pa", f"stress σ{name}, tension positive")
        for name in ("xx", "yy", "zz", "xy", "xz", "yz")
    ),
    Column("von_mises", "Pa", "stress of von Mises"),
)
"""Stresses at a point."""

FIELDS = (*(Column(f"displacement.{name}", "m", f"displacement along {name}") for name in "xyz"), *STRESS)
"""Displacements and stresses at a point."""

DEPTH = asked("depth", "m", "depth below the surface")
ALONG_X = asked("x", "m", "place along x", 0.0)
ALONG_Y = asked("y", "m", "place along y", 0.0)


@dataclass(frozen=True, eq=False)
class StressAnswer:
    """``stress`` at points."""

    stress: StressTensor

    @property
    def von_mises(self) -> RealArray:
        """Stress of von Mises sqrt(3 J2) in Pa."""
        return np.asarray(np.sqrt(3.0 * second_invariant(self.stress)))


@dataclass(frozen=True, eq=False)
class FieldAnswer(StressAnswer):
    """``stress`` and ``displacement`` at points."""

    displacement: Displacement
