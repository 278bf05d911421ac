"""Shakedown limits of homogeneous rolling and sliding contacts as theories of the catalogue: the
numbers of ``cylinder_shakedown`` and ``sphere_shakedown``."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Annotated, ClassVar, TypeAlias

from ...core.parameters import Help
from ...core.quantity import Quantity
from ...core.values import NonNegative
from ..protocol import PoissonOfSolid, Theory
from .point_shakedown import SphereShakedown, sphere_shakedown
from .shakedown import CylinderShakedown, cylinder_shakedown

Friction: TypeAlias = Annotated[NonNegative, "friction coefficient; 0 for pure rolling"]

PEAKS = (
    Quantity("peak_over_k", "1", "peak pressure that certainly shakes down over the yield stress in shear"),
    Quantity("peak_over_Y", "1", "the same over the tensile yield stress"),
    Quantity("depth", "1", "depth of the limit in contact radii (half-widths); 0 at the surface"),
)


class _Limit:
    """The numbers of both limits, from what was ``found``."""

    found: CylinderShakedown | SphereShakedown

    @property
    def peak_over_k(self) -> float:
        """Peak pressure that certainly shakes down over the yield stress in shear."""
        return self.found.peak_over_k

    @property
    def peak_over_Y(self) -> float:
        """The same over the tensile yield stress."""
        return self.found.peak_over_k / math.sqrt(3.0)

    @property
    def depth(self) -> float:
        """Depth in contact radii (half-widths) where it is reached."""
        return self.found.depth


@dataclass(frozen=True)
class ShakedownLine(_Limit, Theory):
    """Elastic shakedown of a cylinder that rolls and slides: the largest peak pressure under which
    flow ceases after some passes.

        p^s = min_z 1/min_c max_x sqrt(((σ_xx - σ_zz)/2 - c)² + σ_xz²).

    Examples
    --------
    >>> f"{ShakedownLine().peak_over_k:.3f} k"
    '4.000 k'
    """

    friction: Friction = 0.0
    found: CylinderShakedown = field(init=False, repr=False, compare=False)
    name: ClassVar[str] = "shakedown-line"
    title: ClassVar[str] = "Shakedown below a rolling and sliding cylinder"
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1962",)
    numbers: ClassVar[tuple[Quantity, ...]] = (
        *PEAKS,
        Quantity("residual", "1", "residual stress along the pass at that depth over the peak pressure"),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        object.__setattr__(self, "found", cylinder_shakedown(self.friction))

    @property
    def residual(self) -> float:
        """Residual stress over the peak pressure."""
        return self.found.residual


@dataclass(frozen=True)
class ShakedownPoint(_Limit, Theory):
    """Elastic shakedown of a sphere that rolls and slides: peak pressures under which flow
    certainly ceases, and above which it certainly does not.

    J_2(σ + ρ) ≤ k²
    """

    friction: Friction = 0.0
    nu: Annotated[PoissonOfSolid, Help("Poisson's ratio of the body that yields", of="bodies")] = 0.3
    found: SphereShakedown = field(init=False, repr=False, compare=False)
    name: ClassVar[str] = "shakedown"
    title: ClassVar[str] = "Shakedown below a rolling and sliding sphere"
    citation_keys: ClassVar[tuple[str, ...]] = SphereShakedown.citation_keys
    numbers: ClassVar[tuple[Quantity, ...]] = (
        *PEAKS,
        Quantity("bound_over_k", "1", "peak pressure above which flow never ceases over the yield stress in shear"),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        object.__setattr__(self, "found", sphere_shakedown(self.friction, self.nu))

    @property
    def bound_over_k(self) -> float:
        """Peak pressure above which flow never ceases over the yield stress in shear."""
        return self.found.bound_over_k
