"""Contacts that are given instead of solved, and the rough example of the reference values."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
from reference_data import reference

import asperity as asp
from asperity.core.arrays import BoolArray, RealArray
from asperity.solids.elastic import Conduction


def solid(conductivity: float, capacity: float, expansion: float = float("nan")) -> asp.Elastic:
    """Steel that conducts like this."""
    known = Conduction(conductivity, 1e-7, capacity, expansion)
    return asp.Elastic(210e9, 0.3, conduction=known)


STEEL, ZIRCONIA = solid(46.0, 3.8e6, 12e-6), solid(2.5, 2.8e6, 10e-6)
COATED = asp.Layered([asp.Layer(solid(2.0, 3e6), 2e-6)], STEEL)


def given(problem: asp.ContactProblem, contact: BoolArray, pressure: RealArray) -> Any:
    """What the heat of a result needs."""
    force = float(pressure.sum()) * problem.grid.pixel_area
    return SimpleNamespace(problem=problem, contact=contact, pressure=pressure, force=force, stick_slip=None)


def flat(shape: tuple[int, int], spacing: float, body: Any, counter: Any, boundary: Any) -> asp.ContactProblem:
    """Problem of two bodies on that grid."""
    surface = asp.Surface(np.zeros(shape), spacing)
    return asp.ContactProblem(surface, body, counter_body=counter, boundary=boundary)


def rough(body: Any = STEEL, counter: Any = STEEL, *, free: bool = False) -> Any:
    """Contact of the rough example."""
    pressure = np.zeros((64, 64))
    for row in reference("heating/rough_pressure_64"):
        pressure[int(row["i"]), int(row["j"])] = row["pressure_Pa"]
    problem = flat((64, 64), 1e-6, body, counter, asp.Free() if free else asp.Periodic())
    return given(problem, pressure > 0.0, pressure)


def hertz(pixels: int, body: Any, counter: Any) -> Any:
    """Free contact on the unit disc, in m, with Hertzian pressure of mean one."""
    problem = flat((pixels + 2, pixels + 2), 2.0 / pixels, body, counter, asp.Free())
    x = (np.arange(pixels + 2) - 0.5 * (pixels + 1)) * 2.0 / pixels
    square = x[:, None] ** 2 + x[None, :] ** 2
    return given(problem, square < 1.0, 1.5 * np.sqrt(np.maximum(1.0 - square, 0.0)))


def waves(points: int) -> asp.Surface:
    """Surface of the rough example on a grid of ``points`` a side: 94 waves of the golden ratio."""
    length = 64e-6
    x = 2.0 * np.pi * np.arange(points) / points
    heights, n = np.zeros((points, points)), 0
    golden = (np.sqrt(5.0) - 1.0) / 2.0
    for kx in range(-8, 9):
        for ky in range(9):
            if (ky or kx > 0) and 4 <= kx * kx + ky * ky <= 64:
                n += 1
                phase = 2.0 * np.pi * ((n * n * golden) % 1.0)
                heights += np.hypot(kx, ky) ** -1.8 * np.cos(kx * x[:, None] + ky * x[None, :] + phase)
    return asp.Surface(heights * (50e-9 / heights.std()), length / points, periodic=True)
