"""The head-disk interface of chapter 4 of Peng (2001) with menisci that do not press the surfaces
together.

His flow chart feeds the meniscus force back into the load, but the sizes that he prints are those
of contacts under the external load alone. Such a contact is some ten pixels: many surfaces are
needed, and as it is solved once, each takes a fiftieth of a second.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from ready_studies import PIXEL

import asperity as asp

if TYPE_CHECKING:
    import xarray

DISK, SLIDER = asp.Elastic(200e9, 0.25), asp.Elastic(450e9, 0.25)
DISK_HARDNESS, SLIDER_HARDNESS, HARDNESS_RATIO = 9e9, 23e9, 0.1
"""Hardness in Pa of the magnetic film and the slider; that of the carbon over its modulus."""

RMS, CORRELATION_LENGTH = 1e-9, 0.5e-6
LOAD = asp.MeanPressure(50e3)
FILM = asp.LiquidFilm(
    surface_tension=25e-3, thickness=2e-9, contact_angles=(math.radians(10.0), math.radians(10.0)), feedback=False
)
KEEP = asp.Keep(stiffness=False)
RATIOS = (0.1, 0.75, 1.75, 10.0)

ROUGH, SOFT, THIN = 10e-9, 0.1, 5e-9
"""σ, E1/E2 and thickness of the one case whose rigid approach is printed."""


def thicknesses(count: int) -> np.ndarray:
    """From none over 1 nm to 100 µm to endless, in m."""
    return np.concatenate([[0.0], np.geomspace(1e-9, 100e-6, count), [np.inf]])


def shapes(seeds: int, points: int, rms: float = RMS) -> list[asp.Surface]:
    """Composite surfaces of slider and disk."""
    grid = asp.Grid((points, points), (PIXEL, PIXEL))
    spectrum = asp.generate.ExponentialAutocorrelation(rms, CORRELATION_LENGTH)
    return [asp.generate.gaussian(grid, spectrum, seed=seed) for seed in range(seeds)]


def body(ratio: float, thickness: float) -> asp.Layered:
    """Carbon of ``ratio`` times the modulus of the disk on it, 0 to infinitely many m thick."""
    carbon = asp.Elastic(ratio * DISK.youngs_modulus, DISK.poisson_ratio)
    if thickness in (0.0, np.inf):
        return asp.Layered([], carbon if thickness else DISK)
    return asp.Layered([asp.Layer(carbon, thickness)], DISK)


def hardness(ratio: float, thickness: float) -> float:
    """Of the softer surface in Pa: the carbon however thin it is, the disk without."""
    surface = HARDNESS_RATIO * ratio * DISK.youngs_modulus if thickness else DISK_HARDNESS
    return min(surface, SLIDER_HARDNESS)


def solved(
    seeds: int,
    points: int,
    count: int,
    ratios: Sequence[float] = RATIOS,
    rms: float = RMS,
    load: asp.MeanPressure = LOAD,
) -> xarray.Dataset:
    """Area, largest displacement and pressure under the load alone, and the force of menisci in
    that gap over the load; the film is 2σ thick."""
    import xarray

    names = ("area_fraction", "max_displacement", "max_pressure", "relative_meniscus_force")
    depths, surfaces = thicknesses(count), shapes(seeds, points, rms)
    film = replace(FILM, thickness=2.0 * rms, meniscus_height=2.0 * rms)
    found = np.array([[contacts(surfaces, ratio, float(h), film, load) for h in depths] for ratio in ratios])
    dims = ("modulus", "thickness", "surface")
    moduli = [ratio * DISK.youngs_modulus for ratio in ratios]
    coordinates = {"modulus": moduli, "thickness": depths, "surface": range(seeds)}
    return xarray.Dataset({name: (dims, found[..., at]) for at, name in enumerate(names)}, coordinates)


def contacts(
    surfaces: Sequence[asp.Surface],
    ratio: float,
    thickness: float,
    film: asp.LiquidFilm = FILM,
    load: asp.MeanPressure = LOAD,
) -> list[tuple[float, ...]]:
    """The four quantities on every one of the ``surfaces``; one operator serves them all."""
    law, solid, operator, rows = asp.Hardness(hardness(ratio, thickness)), body(ratio, thickness), None, []
    for surface in surfaces:
        problem = asp.ContactProblem(surface, solid, counter_body=SLIDER, law=law, film=film)
        operator = operator or asp.solvers.prepare_operator(problem.compliance, problem.grid, problem.boundary)
        found = asp.solve(problem, load, operator=operator, keep=KEEP)
        force = found.require_menisci().relative_meniscus_force
        rows.append((found.area_fraction, float(found.displacement.max()), found.max_pressure, force))
    return rows


def rigid_approaches(seeds: int, points: int) -> np.ndarray:
    """Approach from first touch in m of the rough case with soft thin carbon, by surface."""
    law, found = asp.Hardness(hardness(SOFT, THIN)), []
    for surface in shapes(seeds, points, ROUGH):
        problem = asp.ContactProblem(surface, body(SOFT, THIN), counter_body=SLIDER, law=law)
        found.append(asp.solve(problem, LOAD, keep=KEEP).approach)
    return np.array(found)
