"""Elastic shakedown of contacts that pass again and again: the load up to which plastic flow
ceases, against friction and coating."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError, NoSolutionError
from ...theories.subsurface.point_shakedown import point_shakedown
from ...theories.subsurface.shakedown import line_shakedown
from .compute import Loaded, stress
from .criteria import VonMises


@dataclass(frozen=True, eq=False)
class ShakedownCurve:
    """Elastic shakedown of one contact that passes along x, for friction coefficients (m,).

    Attributes
    ----------
    friction
        Friction coefficients, the traction μp along x everywhere.
    limit
        Factor on all stresses up to which the body certainly shakes down to elastic response.
    bound
        Factor from which on it certainly does not; equal to the limit in plane strain, where the
        limit is exact.
    depth
        Depth in m of the plane that sets the limit.
    region
        Number of the layer that sets it, 0 the outermost.
    """

    friction: RealArray
    limit: RealArray
    bound: RealArray
    depth: RealArray
    region: RealArray
    citation_keys: ClassVar[tuple[str, ...]] = ("Johnson1962", "Hearle1985")


def shakedown(result: Loaded, depths: Iterable[float], friction: ArrayLike = 0.0) -> ShakedownCurve:
    """Elastic shakedown of the body of a contact under repeated passes along x, layer by layer, by
    von Mises' criterion.

    ``result``: of ``solve``, in plane strain (one row) or with a whole point contact; ``depths``:
    of the planes in m, >= 0; ``friction``: coefficients (m,), >= 0. The shear strength k of each
    layer is that of its material over √3. The pressure is taken to be that of the elastic contact;
    the factor is one on stresses, not on loads, which change the contact area.

    Raises
    ------
    InputError
        If a friction coefficient is negative; as of ``stress``.
    NoSolutionError
        If the strength of a layer is unknown.
    """
    coefficients = np.atleast_1d(np.asarray(friction, dtype=float))
    for value in coefficients:
        require.not_negative(float(value), "friction coefficient")
    planes = list(depths)
    still, sliding = stress(result, planes, friction=0.0), stress(result, planes, friction=1.0)
    strengths = [VonMises().limit(plane.region.material).value for plane in still.planes]
    for layer, known in zip((plane.region for plane in still.planes), strengths, strict=True):
        if math.isnan(known):
            raise NoSolutionError(
                f"strength of {layer.name} must be known for a shakedown limit; give yield_stress or hardness.",
                subject=f"strength of {layer.name}",
            )
    k = np.array(strengths) / math.sqrt(3.0)
    rows = []
    for value in coefficients:
        tensor = still.tensor * (1.0 - value) + sliding.tensor * value
        if still.single_row:
            circles = line_shakedown(tensor.map(lambda part: part.reshape(len(still.planes), -1)), k)
            rows.append((circles.limit, circles.limit, int(np.argmax(circles.radius))))
        else:
            spheres = point_shakedown(tensor, k, surface=still.depth == 0.0)
            rows.append((spheres.limit, spheres.bound, int(np.argmax(spheres.radius))))
    limit, bound, plane = (np.array(column) for column in zip(*rows, strict=True))
    return ShakedownCurve(coefficients, limit, bound, still.depth[plane], still.region[plane])


@dataclass(frozen=True, eq=False)
class ShakedownMap:
    """Shakedown against friction (m,) and a second quantity (n,), the thickness of a coating for
    example.

    ``limit``, ``bound``, ``depth`` and ``region`` are (n, m), as in ``ShakedownCurve``.
    """

    across: RealArray
    friction: RealArray
    limit: RealArray
    bound: RealArray
    depth: RealArray
    region: RealArray
    citation_keys: ClassVar[tuple[str, ...]] = ShakedownCurve.citation_keys


def shakedown_map(across: ArrayLike, curves: Iterable[ShakedownCurve]) -> ShakedownMap:
    """The map of ``curves`` for the same friction coefficients, one for each of the values
    ``across`` (n,).

    Raises
    ------
    InputError
        If the numbers of values and curves, or the friction coefficients of the curves, differ.
    """
    values, rows = np.atleast_1d(np.asarray(across, dtype=float)), list(curves)
    alike = rows and all(np.array_equal(row.friction, rows[0].friction) for row in rows)
    if values.shape != (len(rows),) or not alike:
        raise InputError(
            f"curves of a shakedown map must be one for each of the {values.size} values across, for the same "
            f"friction coefficients, but are {len(rows)}."
        )
    names = ("limit", "bound", "depth", "region")
    return ShakedownMap(values, rows[0].friction, *(np.array([getattr(row, name) for row in rows]) for name in names))
