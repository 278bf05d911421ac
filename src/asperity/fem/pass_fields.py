"""What a pass leaves or carries: tension of each layer, tractions on its interfaces, plastic
zones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core import require
from ..core.arrays import RealArray
from .passes import PassState, Track


@dataclass(frozen=True, eq=False)
class RegionFindings:
    """One layer, or the base, in a state of a track.

    Attributes
    ----------
    tension
        Largest principal stress in Pa, an indicator of cracks.
    tension_place
        Where, (2 or 3,) in m.
    flow
        Largest accumulated plastic strain.
    flow_place
        Where, (2 or 3,) in m; NaN if the region has not flowed.
    zone
        Volume in m³ (of half the body; area in m² in plane strain) that has flowed.
    zone_depth
        Depths in m between which it lies; NaN if there is none.
    """

    tension: float
    tension_place: RealArray
    flow: float
    flow_place: RealArray
    zone: float
    zone_depth: tuple[float, float]


def region_findings(track: Track, state: PassState) -> tuple[RegionFindings, ...]:
    """Findings of every region from the surface down, at the Gauss points."""
    stress, elements = track.response(state).stress, track.solid.elements
    found = []
    for number in range(int(track.mesh.region.max()) + 1):
        inside = track.mesh.region == number
        xx, yy, zz, xy, xz, yz = np.moveaxis(stress[inside], -1, 0)
        matrix = np.stack([np.stack(row, axis=-1) for row in ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))], axis=-2)
        tension, flow = np.linalg.eigvalsh(matrix)[..., -1], state.plastic.accumulated[inside]
        places, flowed = elements.places[inside], flow > 0.0
        depths = places[flowed][:, -1]
        weakest, deepest = (np.unravel_index(int(np.argmax(values)), values.shape) for values in (tension, flow))
        found.append(
            RegionFindings(
                float(tension[weakest]),
                places[weakest],
                float(flow[deepest]),
                places[deepest] if depths.size else np.full(places.shape[-1], np.nan),
                float(elements.weights[inside][flowed].sum()),
                (float(depths.min()), float(depths.max())) if depths.size else (np.nan, np.nan),
            )
        )
    return tuple(found)


@dataclass(frozen=True, eq=False)
class PassInterface:
    """Tractions on an interface at the elements (n,) along it.

    ``places`` (n, 1 or 2) in m; ``peel`` the normal one in Pa, positive in tension; ``shear``
    (n, 2) along x and y in Pa.
    """

    places: RealArray
    peel: RealArray
    shear: RealArray


def interface_tractions(track: Track, state: PassState, number: int = 0, *, below: bool = False) -> PassInterface:
    """Tractions on the interface under layer ``number``, extrapolated from the means of the two
    rows of elements above it, or ``below`` it.

    Raises
    ------
    InputError
        If there is no such interface.
    """
    last = int(track.mesh.region.max())
    require.between(number, -1, last, "number of a layer with an interface")
    stress = track.response(state).stress.mean(axis=1)
    corners = track.mesh.points[track.mesh.cells]
    low, high = corners[..., -1].min(axis=1), corners[..., -1].max(axis=1)
    depth = high[track.mesh.region == number].max()
    first = np.flatnonzero(low == depth if below else high == depth)
    edge = (high if below else low)[first[0]]
    second = np.flatnonzero(low == edge if below else high == edge)
    # means of elements belong to their centres
    near, far = 0.5 * (low + high)[first[0]], 0.5 * (low + high)[second[0]]
    share = (depth - near) / (near - far)
    found = (1.0 + share) * stress[first] - share * stress[second]
    centre: RealArray = 0.5 * (corners[first].min(axis=1) + corners[first].max(axis=1))[:, :-1]
    return PassInterface(centre, found[:, 2], found[:, 4:6])
