"""The rough contact of chapter 3 of Peng (2001) that its table, scaling laws and figures share.

A rigid nominally flat rough surface on one layer: exponential autocorrelation exp(-2.3 r/β*), 20 x
20 µm², ν = 0.3, E2 = 100 GPa, hardness 0.05 E1, h = 1 µm unless something else is said.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

import asperity as asp

SIDE = 20e-6
PIXELS = 255
"""Patches along a side. The text says 256; the areas of table 3.1 are whole multiples of 1/255²."""

CORRELATION_LENGTH = 0.5e-6
THICKNESS = 1e-6
BASE = asp.Elastic(100e9, 0.3)
HARDNESS_RATIO = 0.05
"""Hardness over E1."""


@dataclass(frozen=True)
class Case:
    """One contact: ratio E1/E2, nominal pressure over E2, rms height in m."""

    ratio: float
    load: float
    rms: float

    @property
    def x(self) -> float:
        """X = (p_n/E2)(β*/σ), on which alone the contact area depends."""
        return self.load * CORRELATION_LENGTH / self.rms

    @property
    def cap(self) -> float:
        """Hardness over E2."""
        return HARDNESS_RATIO * self.ratio


@dataclass(frozen=True, eq=False)
class Found:
    """Contact pixels and largest pressure over E2 on one surface after the other."""

    pixels: np.ndarray
    peak: np.ndarray


def grid(pixels: int = PIXELS, side: float = SIDE) -> asp.Grid:
    """Square cell of ``side`` metres."""
    return asp.Grid((pixels, pixels), (side / pixels, side / pixels))


def surfaces(count: int, cell: asp.Grid, *, rms: float = 1.0, length: float = CORRELATION_LENGTH) -> list[asp.Surface]:
    """Periodic Gaussian surfaces of the seeds 0, 1, …"""
    spectrum = asp.generate.ExponentialAutocorrelation(rms, length)
    return [asp.generate.gaussian(cell, spectrum, seed=seed) for seed in range(count)]


def coated(ratio: float, thickness: float = THICKNESS, poisson: float = BASE.poisson_ratio) -> asp.Layered:
    """The body: a layer with E1 = ``ratio`` E2 on the base."""
    base = asp.Elastic(BASE.youngs_modulus, poisson)
    return asp.Layered([asp.Layer(asp.Elastic(ratio * BASE.youngs_modulus, poisson), thickness)], base)


def contacts(
    case: Case,
    shapes: Iterable[asp.Surface],
    *,
    body: asp.Layered | None = None,
    boundary: asp.Periodic | asp.Free = asp.Periodic(),
    capped: bool = True,
) -> Iterator[asp.ContactResult]:
    """Contact of ``case`` on every one of ``shapes``, whose heights are in units of σ; one operator
    serves them all."""
    solid = body or coated(case.ratio)
    law = asp.Hardness(case.cap * BASE.youngs_modulus) if capped else asp.plasticity.HardWall()
    operator = None
    for shape in shapes:
        surface = shape.with_heights(case.rms * shape.heights, f"rms height {case.rms:g} m")
        problem = asp.ContactProblem(surface, solid, boundary=boundary, law=law)
        operator = operator or asp.solvers.prepare_operator(problem.compliance, problem.grid, boundary)
        load = asp.MeanPressure(case.load * BASE.youngs_modulus)
        yield asp.solve(problem, load, operator=operator, keep=asp.Keep(stiffness=False))


def ensemble(results: Iterable[asp.ContactResult]) -> Found:
    """Area and largest pressure of every result."""
    pairs = [(result.contact.sum(), result.max_pressure / BASE.youngs_modulus) for result in results]
    pixels, peak = np.array(pairs, dtype=float).T
    return Found(pixels, peak)
