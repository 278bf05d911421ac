"""What the tip of an instrument may have shaped is removed."""

from __future__ import annotations

import math

from ...core import require
from ...core.errors import InputError
from ...core.units import show
from ..characterise.structure import scale_dependence, tip_cutoff
from ..surface import Surface
from .filter import FINEST, filtered

_KEYS = ("Sanner2022",)


def reliability_cutoff(surface: Surface, tip_radius: float) -> float:
    """Wavelength in m below which a tip of ``tip_radius`` (m) may have shaped the map; 0 if nowhere, infinite if everywhere.

    The longer of the stencil lengths along x and y at which the sharpest peak has the curvature 1/(2 R) (Sanner et al.
    2022, eq. 10). SurfaceTopography applies the same criterion along x alone.

    Raises
    ------
    InputError
        If the radius is not positive or the map too small for a stencil.
    """
    radius = require.positive(tip_radius, "radius of the tip (m)")
    return max(tip_cutoff(scale_dependence(surface, axis=axis), radius) for axis in ("x", "y"))


def tip_limited(surface: Surface, tip_radius: float) -> Surface:
    """Surface without the waves that a tip of ``tip_radius`` (m) may have shaped, by a Gaussian filter.

    Where the tip was sharp enough for every peak at every length, or the cut-off lies below four pixels, which a filter does
    not resolve, the heights stay as they are; the history tells the cut-off in any case.

    Raises
    ------
    InputError
        If the tip is blunter than the surface at every length: no wave of the map is reliable.
    """
    cutoff = reliability_cutoff(surface, tip_radius)
    if math.isinf(cutoff):
        raise InputError(
            f"radius of the tip must be small enough for the longest waves of the map, but with {tip_radius:g} m the "
            "map may be shaped by the tip at every length. Check the radius and the units of the heights."
        )
    tip = f"tip of radius {show(tip_radius, 'm', 3)}"
    if cutoff < FINEST * max(surface.grid.spacing):
        reach = "no wave" if cutoff == 0.0 else f"waves below {show(cutoff, 'm', 3)}, less than four pixels,"
        return _told(surface, f"tip-limited: {reach} shaped by a {tip}, nothing removed")
    return _told(filtered(surface, short=cutoff), f"tip-limited: waves below {show(cutoff, 'm', 3)} shaped by a {tip}")


def _told(surface: Surface, step: str) -> Surface:
    origin = surface.origin.continued(step, _KEYS)
    return Surface(surface.heights, surface.dx, surface.dy, periodic=surface.periodic, origin=origin)
