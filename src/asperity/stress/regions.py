"""Where in a body a plane lies: its homogeneous regions from the surface down, and both sides of their interfaces."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from ..core.errors import InputError
from ..solids.elastic import Elastic, Rigid
from ..solids.layers import Frictionless, Layered

Side: TypeAlias = Literal["surface", "inside", "above", "below"]
"""Position of a plane in its region: on the loaded surface, inside, just above or just below an interface."""

_SAME = 1e-9  # relative difference of depths that are one and the same


@dataclass(frozen=True)
class Region:
    """Homogeneous part of a body: its ``material`` between the depths ``top`` and ``bottom`` (m, infinite for a half-space).

    ``name`` is that of the material if it has one, else "layer 1", … or "substrate".
    """

    index: int
    name: str
    material: Elastic
    top: float
    bottom: float


@dataclass(frozen=True)
class Plane:
    """Plane parallel to the surface at ``depth`` (m) whose points belong to ``region``."""

    depth: float
    region: Region
    side: Side

    @property
    def local_depth(self) -> float:
        """Depth below the top of the region in m."""
        return self.depth - self.region.top


def stack(body: object) -> Layered:
    """``body`` as layers of finite, positive thickness on a base.

    Raises
    ------
    InputError
        If the body is rigid or no body: nothing is known about the stress in it.
    """
    if isinstance(body, Elastic):
        return Layered((), body)
    if isinstance(body, Rigid):
        raise InputError("body in which stresses are asked must deform, but is rigid; ask for the other body.")
    if not isinstance(body, Layered):
        raise InputError(f"body in which stresses are asked must be Elastic or Layered, but is {body!r}.")
    return body.reduced


def regions(body: object) -> tuple[Region, ...]:
    """Regions of ``body`` from the surface down; a rigid base is none.

    Raises
    ------
    InputError
        If the body is rigid or no body.
    """
    layers = stack(body)
    found: list[Region] = []
    top = 0.0
    for number, layer in enumerate(layers.layers):
        name = layer.material.name or f"layer {number + 1}"
        found.append(Region(number, name, layer.material, top, top + layer.thickness))
        top += layer.thickness
    if isinstance(layers.base, Elastic):
        found.append(Region(len(found), layers.base.name or "substrate", layers.base, top, math.inf))
    if not found:
        raise InputError("body in which stresses are asked must deform, but is a bare rigid base.")
    return tuple(found)


def slips(layers: Layered, plane: Plane) -> bool:
    """Whether ``plane`` is a side of an interface of ``layers`` (see ``stack``) that carries no shear traction."""
    upper = {"above": plane.region.index, "below": plane.region.index - 1}.get(plane.side)
    return upper is not None and isinstance(layers.layers[upper].interface, Frictionless)


def planes(body: object, depths: Iterable[float]) -> tuple[Plane, ...]:
    """Planes at ``depths`` (m, >= 0) in increasing order; a depth of an interface gives two, above and below it.

    Raises
    ------
    InputError
        If a depth is negative, no number, or below a rigid base.
    """
    parts = regions(body)
    found: list[Plane] = []
    for value in depths:
        depth = require.finite(value, "depth (m)")
        if depth < 0.0:
            raise InputError(f"depth (m) must be at least zero, but is {depth:g}; depths count from the surface down.")
        found.extend(_planes_at(depth, parts))
    if not found:
        raise InputError("depths must hold at least one depth (m), but are empty.")
    return tuple(sorted(found, key=lambda plane: (plane.depth, plane.region.index)))


def _planes_at(depth: float, parts: tuple[Region, ...]) -> list[Plane]:
    found: list[Plane] = []
    for region in parts:
        if depth == 0.0 and region.top == 0.0:
            found.append(Plane(0.0, region, "surface"))
        elif region.top > 0.0 and math.isclose(depth, region.top, rel_tol=_SAME):
            found.append(Plane(region.top, region, "below"))
        elif math.isclose(depth, region.bottom, rel_tol=_SAME):
            found.append(Plane(region.bottom, region, "above"))
        elif region.top < depth < region.bottom:
            found.append(Plane(depth, region, "inside"))
    if not found:
        raise InputError(
            f"depth (m) must lie in the body, whose rigid base is at {parts[-1].bottom:g}, but is {depth:g}."
        )
    return found


# Depths that show a body: both ends of every layer and points between, denser towards the surface in the substrate.


_GRADING = 1.5  # power of the spacing below the lowest interface, where stresses vary ever more slowly


def depths_through(body: object, deepest: float, *, per_region: int = 12) -> RealArray:
    """Increasing depths in m from the surface of ``body`` to ``deepest`` (m), for ``stress``.

    Every layer has ``per_region`` equal intervals, so that both its faces are among the depths; the substrate has as many
    intervals down to ``deepest``, short ones first. Layers below ``deepest`` are left out.

    Raises
    ------
    InputError
        If the body is rigid, ``deepest`` is not positive or there is less than one interval.
    """
    limit = require.positive(deepest, "deepest depth (m)")
    count = require.integer(per_region, 1, "number of intervals in a region")
    share = np.arange(count + 1) / count
    found = [0.0]
    for region in regions(body):
        bottom = min(region.bottom, limit)
        if bottom > region.top:
            steps = share**_GRADING if math.isinf(region.bottom) else share
            found.extend((region.top + (bottom - region.top) * steps)[1:])
    return np.array(found)
