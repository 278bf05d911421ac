"""A rigid paraboloid on one bonded layer, by a Fredholm equation in plain NumPy.

With the Hankel transform of the pressure P(q) = (E1*/2) ∫ φ(t) cos(qt) dt, t from 0 to the contact
radius a, and the compliance (2/(E1* q)) (1 + m(q)), the displacement δ - r²/2R in the contact gives

    φ(t) + (2/π) ∫ φ(s) ∫ m(q) cos(qt) cos(qs) dq ds = (2/π) (δ - t²/R),  φ(a) = 0,

and the load π E1* ∫ φ dt. Nothing of the package is used.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

NODES = np.polynomial.legendre.leggauss(48)
"""Gauss nodes and weights along t: ten digits of the approach."""

WAVES = np.polynomial.legendre.leggauss(200)
"""Those along the square root of q."""


class Film(NamedTuple):
    """Moduli and Poisson's ratios of layer and base, in units of the base, and the radius."""

    nu1: float
    E2: float
    nu2: float
    R: float


def compliance_deviation(q: np.ndarray, E1: float, h: float, film: Film) -> np.ndarray:
    """m(q) of one layer (Burmister; Johnson 1985, Gladwell 1980)."""
    ratio = E1 / (1.0 + film.nu1) * (1.0 + film.nu2) / film.E2
    lam = 1.0 - 4.0 * (1.0 - film.nu1) / (1.0 + ratio * (3.0 - 4.0 * film.nu2))
    kappa = (ratio - 1.0) / (ratio + 3.0 - 4.0 * film.nu1)
    x = q * h
    e2, e4 = np.exp(-2.0 * x), np.exp(-4.0 * x)
    above = 1.0 + 4.0 * x * kappa * e2 - lam * kappa * e4
    return above / (1.0 - (lam + kappa + 4.0 * kappa * x * x) * e2 + lam * kappa * e4) - 1.0


def approach(load: float, E1: float, h: float, film: Film) -> float:
    """Approach under ``load`` on a layer of modulus ``E1`` and thickness ``h``."""
    plane_strain = E1 / (1.0 - film.nu1**2)
    t, weights = 0.5 * (NODES[0] + 1.0), 0.5 * NODES[1]
    top, root = 22.0 / h, 0.5 * (WAVES[0] + 1.0)  # m falls as exp(-2 q h)
    q = top * root**2
    shares = compliance_deviation(q, E1, h, film) * WAVES[1] * root * top

    def at(a: float) -> tuple[float, float]:
        """Approach and load of the contact radius ``a``."""
        places = np.append(a * t, a)
        waves = np.cos(np.outer(places, q))
        kernel = 2.0 / np.pi * (waves * shares) @ waves[:-1].T * (a * weights)
        right = 2.0 / np.pi * np.stack([np.ones(t.size + 1), places**2 / film.R], axis=-1)
        phi = np.linalg.solve(np.eye(t.size) + kernel[:-1], right[:-1])
        flat, curved = right[-1] - kernel[-1] @ phi  # values at the edge
        delta = float(curved / flat)
        return delta, float(np.pi * plane_strain * (a * weights) @ (phi @ np.array([delta, -1.0])))

    before = math.log((0.75 * load * film.R / plane_strain) ** (1.0 / 3.0))
    miss = math.log(at(math.exp(before))[1] / load)
    now = before - miss / 3.0
    for _ in range(50):
        delta, found = at(math.exp(now))
        wrong = math.log(found / load)
        if abs(wrong) < 1e-13 or wrong == miss:
            break
        before, miss, now = now, wrong, now - wrong * (now - before) / (wrong - miss)
    return delta
