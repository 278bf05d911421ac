"""The wet contact that figs 39 to 42 of Bhushan (1998) share, as far as the text states it.

A rigid smooth flat on a rough half-space: exponential autocorrelation that has dropped to 0.1 at
β* = 0.5 µm, E* = 100 GPa, pixels of 20 µm/256. Half the side of the published maps, several of them
instead of one.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

import asperity as asp

PIXEL = 20e-6 / 256
PIXELS = 128
CORRELATION_LENGTH = 0.5e-6
MODULUS = 100e9
BODY = asp.Elastic(MODULUS * (1.0 - 0.3**2), 0.3)
LOAD = 3.28e6
"""Pa: a hundred times the 32.8 kPa of the dry figures; figs 39 to 42 do not state theirs in the
text."""

WATER = 0.073
"""Surface tension in N/m."""

WATER_ANGLE = math.radians(60.0)


@dataclass(frozen=True)
class Found:
    """Meniscus force over load without feedback and when it is steady (infinite where it runs
    away), real area of contact over nominal area under load and menisci, and the force over load of
    the theory of summits."""

    first: float
    steady: float
    area: float
    theory: float


def spectrum(rms: float) -> asp.generate.ExponentialAutocorrelation:
    """Of a surface with the rms height ``rms`` in m."""
    return asp.generate.ExponentialAutocorrelation(rms, CORRELATION_LENGTH)


def grid(pixels: int = PIXELS) -> asp.Grid:
    """Square cell of so many of their pixels."""
    return asp.Grid((pixels, pixels), (PIXEL, PIXEL))


def film(thickness: float, tension: float = WATER, angle: float = WATER_ANGLE) -> asp.LiquidFilm:
    """Film whose menisci are as high as it is thick, in m."""
    return asp.LiquidFilm(surface_tension=tension, thickness=thickness, contact_angles=(angle, 0.0))


class Interface:
    """One surface against a flat; its operator and dry contacts serve every film."""

    def __init__(self, surface: asp.Surface) -> None:
        self.problem = asp.ContactProblem(surface, BODY)
        self._operator = asp.solvers.prepare_operator(self.problem.compliance, self.problem.grid, self.problem.boundary)
        self._dry: dict[float, asp.ContactResult] = {}

    def unfed(self, liquid: asp.LiquidFilm, load: float = LOAD) -> asp.ContactResult:
        """Contact under the ``load`` in Pa alone, with the menisci of ``liquid`` in its gap."""
        alone = replace(self.problem, film=replace(liquid, feedback=False))
        return asp.solve(alone, asp.MeanPressure(load), operator=self._operator, keep=asp.Keep(stiffness=False))

    def menisci(self, liquid: asp.LiquidFilm, load: float = LOAD, *, theory: bool = False) -> Found:
        """Menisci of ``liquid`` under the ``load`` in Pa; the theory of summits only if asked
        for."""
        control = asp.MeanPressure(load)
        if load not in self._dry:
            keep = asp.Keep(stiffness=False)
            self._dry[load] = asp.solve(self.problem, control, operator=self._operator, keep=keep)
        wet = replace(self.problem, film=liquid)
        options = {"state": self._dry[load].state, "operator": self._operator}
        once = self.unfed(liquid, load)
        first = once.menisci.relative_meniscus_force
        beside = asp.menisci.wet_theory(once).meniscus_force / once.external_force if theory else math.nan
        try:
            steady = asp.solve(wet, control, **options)
        except asp.errors.NoSolutionError:
            return Found(first, math.inf, math.nan, beside)
        return Found(first, steady.menisci.relative_meniscus_force, steady.area_fraction, beside)


def column(found: list[Found], name: str) -> np.ndarray:
    """Values of one field of all ``found``."""
    return np.array([getattr(one, name) for one in found])


def shown(values: np.ndarray, form: str = ".3g") -> str:
    """Mean ± standard deviation; how many run away, if any do."""
    away = int(np.isinf(values).sum())
    if away:
        return f"{away} of {values.size} run away"
    return f"{values.mean():{form}} ± {values.std(ddof=1):{form}}"
