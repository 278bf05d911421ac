"""What is prescribed along the surfaces: a shift of the counter body, or a force on it; and
histories of them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, TypeAlias

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.grid import Grid


@dataclass(frozen=True)
class Shift:
    """Rigid displacement of the counter body since the surfaces first touched; it drags the body
    with it.

    Parameters
    ----------
    x, y
        Displacement in m along x and along y, of either sign.
    twist
        Rotation in rad about the normal through the centre of the grid, from x towards y; only
        where the contact does not repeat.

    Raises
    ------
    InputError
        If a number is not finite.
    """

    x: float = 0.0
    y: float = 0.0
    twist: float = 0.0
    name: ClassVar[str] = "shift"

    def __post_init__(self) -> None:
        require.finite(self.x, "shift along x (m)")
        require.finite(self.y, "shift along y (m)")
        require.finite(self.twist, "twist (rad)")


@dataclass(frozen=True)
class TangentialForce:
    """Force on the body along the surface, by the counter body; the counter body is not turned.

    Parameters
    ----------
    x, y
        Force in N along x and along y, of either sign; its magnitude must stay below what friction
        bears.

    Raises
    ------
    InputError
        If a number is not finite.
    """

    x: float = 0.0
    y: float = 0.0
    name: ClassVar[str] = "tangential force"

    def __post_init__(self) -> None:
        require.finite(self.x, "tangential force along x (N)")
        require.finite(self.y, "tangential force along y (N)")

    @property
    def magnitude(self) -> float:
        """Magnitude in N."""
        return math.hypot(self.x, self.y)


Tangential: TypeAlias = Shift | TangentialForce
"""What is prescribed along the surfaces."""


def shift_field(grid: Grid, shift: RealArray) -> RealArray:
    """Displacement in m of the points of a rigid body that has moved by ``shift``: x, y (m) and
    twist (rad).

    Of the shape (2, nx, ny), or (2, 1, 1) without a twist.
    """
    field = np.asarray(shift[:2], dtype=float)[:, None, None]
    if not shift[2]:
        return field
    x, y = about_centre(grid)
    turned = np.empty((2, *grid.shape))
    turned[0], turned[1] = -shift[2] * y, shift[2] * x
    return np.asarray(turned + field)


def resultant(grid: Grid, traction: RealArray) -> tuple[float, float, float]:
    """Force along x and y (N) and torque about the centre (N·m) of a ``traction`` (2, nx, ny) in Pa
    on ``grid``."""
    x, y = about_centre(grid)
    torque = (x * traction[1] - y * traction[0]).sum()
    along, across, turning = (
        float(total) * grid.pixel_area for total in (traction[0].sum(), traction[1].sum(), torque)
    )
    return along, across, turning


def about_centre(grid: Grid) -> tuple[RealArray, RealArray]:
    """Coordinates (nx, 1) and (1, ny) in m from the centre of ``grid``."""
    x, y = ((np.arange(n) - 0.5 * (n - 1)) * spacing for n, spacing in zip(grid.shape, grid.spacing, strict=True))
    return x[:, None], y[None, :]
