"""Wear of an axisymmetric contact on rings of even pressure, independent of grids and theories:
backward Euler steps of Archard's law, with break-through of a coating inside the step."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import ellipe, ellipk


@dataclass(frozen=True)
class Rings:
    """Rings between the radii ``edges`` (n + 1,) on a half-space of the modulus E*."""

    edges: np.ndarray
    E_star: float

    @property
    def radii(self) -> np.ndarray:
        """(n,) middles."""
        return 0.5 * (self.edges[1:] + self.edges[:-1])

    @property
    def areas(self) -> np.ndarray:
        """(n,)"""
        return math.pi * np.diff(self.edges**2)

    def compliance(self) -> np.ndarray:
        """(n, n) displacement at the middle of each ring under unit pressure on each: differences
        of discs of even pressure (Johnson 1985, section 3.4)."""
        r, a = self.radii[:, None], self.edges[None, 1:]
        inside = r <= a
        m = np.where(inside, r / a, a / r) ** 2
        disc = np.where(inside, a * ellipe(m), r * (ellipe(m) - (1.0 - m) * ellipk(m)))
        disc *= 4.0 / (math.pi * self.E_star)
        return np.diff(disc, axis=1, prepend=0.0)


@dataclass(frozen=True)
class Coating:
    """Coefficients above and below a worn depth, m²/N and m."""

    first: float
    second: float
    thickness: float = math.inf

    def depth(self, dose: np.ndarray) -> np.ndarray:
        """Worn depth of the ``dose`` ∫ p ds."""
        first = np.minimum(self.first * dose, self.thickness)
        return first + self.second * np.maximum(dose - self.thickness / self.first, 0.0)

    def line(self, coated: np.ndarray, dose: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The straight piece of that law, above break-through or below: depth and slope."""
        if math.isinf(self.thickness):
            return self.first * dose, np.full_like(dose, self.first)
        below = self.thickness + self.second * (dose - self.thickness / self.first)
        return np.where(coated, self.first * dose, below), np.where(coated, self.first, self.second)


@dataclass(frozen=True)
class WornProfile:
    """What rings are worn to: (n,) ``pressure`` and ``depth``; ``radius`` of the contact to a
    ring."""

    rings: Rings
    pressure: np.ndarray
    depth: np.ndarray

    @property
    def radius(self) -> float:
        """Middle of the last ring in contact and of the next."""
        return float(self.rings.edges[1:][self.pressure > 0.0][-1])

    @property
    def volume(self) -> float:
        """Worn volume."""
        return float(self.depth @ self.rings.areas)


def pressed(
    rings: Rings, compliance: np.ndarray, gap: np.ndarray, slope: np.ndarray, load: float, start: np.ndarray
) -> np.ndarray:
    """Pressure >= 0 with (compliance + slope) p + gap even in contact, and not less beside it."""
    n, areas, unit, size = gap.size, rings.areas, rings.E_star / rings.edges[-1], rings.edges[-1]
    active = start.copy()
    for _ in range(200):
        i = np.flatnonzero(active)
        system = np.zeros((i.size + 1, i.size + 1))
        system[:-1, :-1] = unit * (compliance[np.ix_(i, i)] + np.diag(slope[i]))
        system[:-1, -1] = -1.0
        system[-1, :-1] = areas[i] / size**2
        found = np.linalg.solve(system, np.append(-unit * gap[i], load / size**2))
        if (found[:-1] < 0.0).any():
            active[i[found[:-1] < 0.0]] = False
            continue
        pressure = np.zeros(n)
        pressure[i] = found[:-1]
        left = compliance @ pressure + slope * pressure + gap - found[-1] / unit
        inside = ~active & (left < -1e-12 * size)
        if not inside.any():
            return pressure
        active |= inside
    raise RuntimeError("the contact did not settle")


def worn(
    rings: Rings, gap: np.ndarray, load: float, law: Coating, distance: float, ratio: float = 1.05, first: float = 1e-3
) -> WornProfile:
    """The ``gap`` worn over the ``distance``, in steps that start with the share ``first`` of it
    and then grow by ``ratio`` times the distance behind them."""
    compliance, dose = rings.compliance(), np.zeros_like(gap)
    everywhere = np.ones(gap.size, bool)
    pressure = pressed(rings, compliance, gap, np.zeros_like(gap), load, everywhere)
    behind = 0.0
    while behind < distance:
        step = min(max(first * distance, (ratio - 1.0) * behind), distance - behind)
        coated = dose * law.first < law.thickness
        near = np.append(True, pressure[:-1] > 0.0)
        for _ in range(50):
            depth, slope = law.line(coated, dose)
            pressure = pressed(rings, compliance, gap + depth, step * slope, load, near)
            then = (dose + step * pressure) * law.first < law.thickness
            if (then == coated).all():
                break
            coated = then
        dose = dose + step * pressure
        behind += step
    return WornProfile(rings, pressure, law.depth(dose))


def worn_sphere(
    E_star: float, radius: float, load: float, law: Coating, distance: float, outer: float, count: int = 200
) -> WornProfile:
    """A sphere of the ``radius`` on rings up to ``outer``."""
    rings = Rings(np.linspace(0.0, outer, count + 1), E_star)
    steps = 1.0 + 7.5 / count
    return worn(rings, rings.radii**2 / (2.0 * radius), load, law, distance, steps, 0.15 / count)
