"""Runs of the sphere that slides over a layered half-space at 100 times the load of first yield,
for the page ``layered_sliding`` and its pictures.

Lengths are in a_y, loads in P_y, stresses and strains in Y and Y/E: contact radius, load and yield
of the homogeneous base.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from itertools import pairwise
from pathlib import Path

import numpy as np

import asperity as asp
from asperity import fem

E, NU, R = 200e9, 0.3, 1e-3
Y = 1e-3 * E
HARDENING = 2e-3
"""Slope over E of each material: perfect plasticity but for what keeps steps long."""

PRESSURE, MODULUS = 1.6128 * Y, E / (1.0 - NU**2)
RADIUS = math.pi * PRESSURE * R / (2.0 * MODULUS)
LOAD = math.pi**3 * R**2 * PRESSURE**3 / (6.0 * MODULUS**2)
"""Contact radius a_y in m and load P_y in N at first yield of the base material."""

DISTANCES = (0.0, 2.0, 4.0, 8.0, 12.0, 16.0, 20.0, 24.0)
"""At which results are kept, in a_y; the first five are those of the pictures."""

PUSHED = (0.05, 0.2, 0.45, 0.7, 1.0)
LIFTED = (0.7, 0.4, 0.15, 0.03)
"""Parts of the load while the sphere is pressed and lifted."""


@dataclass(frozen=True)
class Case:
    """One history: ratio E1/E2 = Y1/Y2, friction, load in P_y; contact radius in a_y that the mesh
    expects, its elements across it, passes, how far and in which steps the sphere slides, in
    a_y."""

    ratio: float
    friction: float
    load: float = 100.0
    radius: float = 6.7
    across: int = 6
    passes: int = 2
    far: float = 12.0
    step: float = 0.6

    @property
    def distances(self) -> tuple[float, ...]:
        """Sliding distances in a_y at which results are kept."""
        return tuple(one for one in DISTANCES if one <= self.far)

    @property
    def name(self) -> str:
        """Of the file with its results."""
        return "_".join(f"{getattr(self, one.name):g}" for one in fields(self))


@dataclass(frozen=True, eq=False)
class Snapshots:
    """What is kept of one case. Columns are the layer and the base; times are the sliding distances
    of the case and lifted, of each pass.

    Attributes
    ----------
    centre
        (times,) of the sphere in a_y.
    flow, flow_place, zone, depth
        (times, 2) largest equivalent plastic strain in Y/E, its place (…, 3) in a_y, volume in a_y³
        and lower end in a_y of what has flowed.
    tension, tension_place
        (times, 2) largest principal stress in Y, and its place (…, 3).
    surface
        (times, 2) largest σ_xx in Y of the upper Gauss points of the layer behind and before the
        centre of the sphere.
    shear, peel
        (times,) largest shear and normal tension in Y on the interface.
    radius, approach, work, lost
        (times,) contact radius in a_y from the area, approach in δ_y, work and plastic work in P_y
        δ_y.
    strain, along
        (times, n_x, n_z) means over the elements beside the plane of symmetry of the equivalent
        plastic strain in Y/E and of σ_xx in Y.
    x, z
        Lines of the mesh in a_y.
    """

    centre: np.ndarray
    flow: np.ndarray
    flow_place: np.ndarray
    zone: np.ndarray
    depth: np.ndarray
    tension: np.ndarray
    tension_place: np.ndarray
    surface: np.ndarray
    shear: np.ndarray
    peel: np.ndarray
    radius: np.ndarray
    approach: np.ndarray
    work: np.ndarray
    lost: np.ndarray
    strain: np.ndarray
    along: np.ndarray
    x: np.ndarray
    z: np.ndarray


def ball(places: np.ndarray) -> np.ndarray:
    """Height in m of the sphere, a paraboloid, at ``places`` (points, 2) in m."""
    height: np.ndarray = (places**2).sum(axis=1) / (2.0 * R)
    return height


def track_of(case: Case) -> fem.Track:
    """The meshed half of the layered body."""
    solids = [asp.Elastic(scale * E, NU) for scale in (case.ratio, 1.0)]
    laws = [
        asp.plasticity.J2(solid, asp.plasticity.LinearHardening(scale * Y, HARDENING * scale * E))
        for solid, scale in zip(solids, (case.ratio, 1.0), strict=True)
    ]
    body = asp.Layered([asp.Layer(solids[0], RADIUS)], solids[1])
    fine = fem.Resolution(across=case.across, per_layer=2, growth=1.7, depth=0.7, distance=8.0)
    return fem.sphere_track(body, case.radius * RADIUS, (0.0, case.far * RADIUS), plasticity=laws, resolution=fine)


def run(case: Case) -> Snapshots:
    """Press, slide, lift, and again from the start."""
    track = track_of(case)
    kept = [_snapshot(track, now) for now in states(case, track)]
    columns = {name: np.array([one[name] for one in kept]) for name in kept[0]}
    x, _, z = (np.unique(track.mesh.points[:, axis]) / RADIUS for axis in range(3))
    return Snapshots(**columns, x=x, z=z)


def states(case: Case, track: fem.Track) -> Iterator[fem.PassState]:
    """States of each pass at the distances of the case and after lifting."""
    force = 0.5 * case.load * LOAD
    now, nothing = track.virgin(), np.zeros(len(track.surface))
    for _ in range(case.passes):
        now = replace(now, place=0.0, approach=math.nan)
        for share in PUSHED:
            now = track.press(now, ball, place=0.0, force=share * force)
        yield now
        for near, far in pairwise(case.distances):
            for stop in np.linspace(near, far, math.ceil((far - near) / case.step) + 1)[1:]:
                now = track.press(now, ball, place=stop * RADIUS, force=force, friction=case.friction)
            yield now
        for share in LIFTED:
            now = track.press(now, ball, place=case.far * RADIUS, force=share * force)
        now = track.carry(now, nothing, nothing, case.far * RADIUS)
        yield now


def stored(case: Case, folder: Path | None) -> Snapshots:
    """Results of the ``case``, from its file in the ``folder`` if it is there."""
    path = None if folder is None else folder / f"{case.name}.npz"
    if path is not None and path.exists():
        with np.load(path) as file:
            return Snapshots(**{one.name: file[one.name] for one in fields(Snapshots)})
    found = run(case)
    if path is not None:
        path.parent.mkdir(parents=True, exist_ok=True)
        np.savez_compressed(path, **{one.name: getattr(found, one.name) for one in fields(found)})
    return found


def _snapshot(track: fem.Track, now: fem.PassState) -> dict[str, object]:
    findings = fem.region_findings(track, now)
    stress, place = track.response(now).stress / Y, track.solid.elements.places
    top = track.mesh.region == 0
    upper = place[..., 2] == place[top][..., 2].min()
    behind = upper & (place[..., 0] < now.place)
    contact = fem.interface_tractions(track, now)
    shear, peel = np.linalg.norm(contact.shear, axis=1), contact.peel
    beside = track.mesh.points[track.mesh.cells][..., 1].min(axis=1) == 0.0
    shape = [len(np.unique(track.mesh.points[:, axis])) - 1 for axis in (0, 2)]
    half = float(track.areas[now.normal > 0.0].sum())
    unit = LOAD * RADIUS**2 / R
    return {
        "centre": now.place / RADIUS,
        "flow": [one.flow * E / Y for one in findings],
        "flow_place": [one.flow_place / RADIUS for one in findings],
        "zone": [2.0 * one.zone / RADIUS**3 for one in findings],
        "depth": [one.zone_depth[1] / RADIUS for one in findings],
        "tension": [one.tension / Y for one in findings],
        "tension_place": [one.tension_place / RADIUS for one in findings],
        "surface": [stress[behind][:, 0].max(), stress[upper & ~behind][:, 0].max()],
        "shear": shear.max() / Y,
        "peel": peel.max() / Y,
        "radius": math.sqrt(2.0 * half / math.pi) / RADIUS,
        "approach": now.approach * R / RADIUS**2,
        "work": 2.0 * now.work / unit,
        "lost": 2.0 * now.dissipated / unit,
        "strain": now.plastic.accumulated[beside].mean(axis=1).reshape(shape) * E / Y,
        "along": stress[beside][..., 0].mean(axis=1).reshape(shape),
    }
