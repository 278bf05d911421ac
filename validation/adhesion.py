"""Adhesive contacts on the grid against independent solutions: Maugis' transition, Johnson's wave,
JKR on coated spheres."""

from __future__ import annotations

import math

import numpy as np
from page import Claim, Page, Table, write_page

import asperity as asp
from asperity.solids.compliance.halfspace import contact_compliance
from asperity.theories.adhesion.short_range import CoatedJKR, WavyJKR
from asperity.theories.adhesion.spheres import maugis_pull_off

TRANSITION = (
    (0.1157, 96, 5.0),
    (0.2, 96, 5.0),
    (0.4, 96, 5.0),
    (0.7, 96, 5.0),
    (1.0, 128, 5.0),
    (1.5, 192, 5.0),
    (2.5, 384, 5.0),
    (3.0, 384, 5.0),
    (3.4713, 400, 4.0),
)
"""Maugis' λ, points along a side, and its least length in units of the contact radius; the last row
takes two minutes on one core. Tabor's parameter of a Lennard-Jones surface of the same largest
stress is λ/1.157."""

WAVES = (0.2, 0.4)
COATED = ((0.25, 0.3, 0.3, 0.5, 2.4), (10.0, 0.25, 0.3, 0.1, 1.2))
"""E1/E2, ν1, ν2, thickness over R, side of the grid over R; w = 0.02 E2 R."""

E_STAR, RADIUS, WORK = 1e6, 1e-4, 0.05

ABOUT = (
    "The reference is an independent solution on every row, by closed forms or one-dimensional equations of "
    "our own. Sphere: Dugdale's law, smoothed over a fifth of its range, on a free grid; pull-off is the most "
    "tensile force of a sphere that is parted step by step, against Maugis' equations. Wave: exponential law "
    "whose cohesive length is six pixels, on a periodic line. Coated sphere: exponential law whose cohesive "
    "length is five pixels of the top layer. The ranges of wave and coated sphere are chosen freely, as small "
    "as the grid resolves; both references have none."
)


def page(
    transition: tuple[tuple[float, int, float], ...] = TRANSITION,
    waves: tuple[float, ...] = WAVES,
    wave_points: int = 1024,
    coated: tuple[tuple[float, ...], ...] = COATED,
    coated_points: int = 256,
) -> Page:
    """The page, for these numbers and grids."""
    spheres = [(lam, n, *sphere(lam, n, least)) for lam, n, least in transition]
    lines = [(alpha, *wave(alpha, wave_points)) for alpha in waves]
    coats = [(row, *coating(row, coated_points)) for row in coated]
    rows = [
        (
            f"{lam:g}",
            f"{lam / 1.157:.2f}",
            f"{n}²",
            f"{pixels:.0f}",
            f"{found:.4f}",
            f"{exact:.4f}",
            f"{100 * (found / exact - 1):+.2f} %",
        )
        for lam, n, found, exact, pixels in spheres
    ]
    wave_rows = [
        (f"{a:g}", f"{found:.5f}", f"{exact:.5f}", f"{100 * (found / exact - 1):+.2f} %") for a, found, exact in lines
    ]
    coat_rows = [
        (f"{row[0]:g}", f"{row[3]:g}", f"{found:.5f}", f"{exact:.5f}", f"{100 * (found / exact - 1):+.2f} %")
        for row, found, exact in coats
    ]
    return Page(
        "Adhesion",
        ABOUT,
        (
            Table(
                "Pull-off over πwR, Maugis' transition.",
                ("λ", "Tabor", "grid", "pixels in ℓ", "grid's", "exact", "deviation"),
                tuple(rows),
            ),
            Table(
                "Pull-off of a wave over p*, adhesion of short range.",
                ("α", "grid's", "exact", "deviation"),
                tuple(wave_rows),
            ),
            Table(
                "Pull-off of a coated sphere over E2R².",
                ("E1/E2", "h/R", "grid's", "exact", "deviation"),
                tuple(coat_rows),
            ),
        ),
        (
            Claim("largest deviation of the transition", max(abs(f / e - 1.0) for _, _, f, e, _ in spheres), high=0.01),
            Claim("largest deviation of the wave", max(abs(f / e - 1.0) for _, f, e in lines), high=0.01),
            Claim("largest deviation of the coated sphere", max(abs(f / e - 1.0) for _, f, e in coats), high=0.04),
        ),
    )


def pulled(problem: asp.ContactProblem, approaches: list[float]) -> tuple[float, asp.adhesion.AdhesiveContact]:
    """Most tensile force (N) of grips at these ``approaches`` (m), one after the other, and the
    adhesion at the end."""
    found = asp.solve(problem, asp.History([asp.FixedGrips(float(value)) for value in approaches]))
    return -float(min(found.external_force)), found.last.adhesion


def sphere(transition: float, points: int, least: float) -> tuple[float, float, float]:
    """Pull-off on the grid and of Maugis' equations over πwR, and pixels in the cohesive length, at
    λ = ``transition``; side ``least`` or more."""
    K = 4.0 / 3.0 * E_STAR
    length = np.cbrt(math.pi * WORK * RADIUS**2 / K)
    unit = length**2 / RADIUS
    strength = 0.5 * transition / np.cbrt(RADIUS / (math.pi * WORK * K**2))
    exact = maugis_pull_off(transition)
    law = asp.adhesion.DugdaleAdhesion(WORK, WORK / strength, smoothing=0.2)
    size = max(least, 2.6 * math.sqrt(2.0 * (law.range / unit + 1.0))) * length
    problem = asp.ContactProblem(paraboloid(points, size, RADIUS), isotropic(E_STAR), boundary=asp.Free(), adhesion=law)
    steps = [0.3 * unit, *((float(exact.approach) + step) * unit for step in (0.1, 0.05, 0.0, -0.05))]
    force, found = pulled(problem, steps)
    return force / (math.pi * WORK * RADIUS), -float(exact.load), found.pixels_per_length


def wave(alpha: float, points: int) -> tuple[float, float]:
    """Pull-off on a line of ``points`` and of Johnson's theory, mean pressures over p*."""
    theory, length, amplitude = WavyJKR(alpha), 1e-4, 1e-6
    full = math.pi * E_STAR * amplitude / length
    work = alpha**2 * length * full**2 / (2.0 * E_STAR)
    pixel = length / points
    x = (np.arange(points) + 0.5) / points
    surface = asp.Surface((amplitude * (np.cos(2.0 * np.pi * (x - 0.5)) - 1.0))[:, None], pixel, 1.0)
    law = asp.ExponentialAdhesion.of_strength(work, math.sqrt(E_STAR * work / (6.0 * pixel)))
    problem = asp.ContactProblem(surface, isotropic(E_STAR), adhesion=law)
    off, _ = theory.stationary
    start = theory.approach(off)
    force, _ = pulled(problem, [(start + step) * amplitude for step in (0.3, 0.15, 0.08, 0.04, 0.02, 0.0, -0.02)])
    return force / length / full, -theory.mean_pressure(off)


def coating(row: tuple[float, ...], points: int) -> tuple[float, float]:
    """Pull-off on the grid and of the theory over E2R²."""
    ratio, nu1, nu2, thickness, side = row
    top, work = asp.Elastic(ratio, nu1), 0.02
    body = asp.Layered([asp.Layer(top, thickness)], asp.Elastic(1.0, nu2))
    modulus, compliance = top.plane_strain_modulus, contact_compliance(body, asp.Rigid())
    theory = CoatedJKR(modulus, lambda q: 0.5 * modulus * q * compliance.spectral(q) - 1.0, thickness, 1.0, work)
    exact = theory.pull_off(0.05, 1.0)
    law = asp.ExponentialAdhesion.of_strength(work, math.sqrt(modulus * work / (5.0 * side / points)))
    problem = asp.ContactProblem(paraboloid(points, side, 1.0), body, boundary=asp.Free(), adhesion=law)
    span = abs(exact.approach)
    steps = [exact.approach + step * span for step in (2.0, 0.8, 0.4, 0.2, 0.0, -0.2, -0.4, -0.6)]
    return pulled(problem, steps)[0], -exact.load


def paraboloid(points: int, size: float, radius: float) -> asp.Surface:
    """Sphere of this ``radius`` on a square of this ``size``, by its parabola."""
    x = (np.arange(points) - 0.5 * (points - 1)) * size / points
    return asp.Surface(-(x[:, None] ** 2 + x[None, :] ** 2) / (2.0 * radius), size / points)


def isotropic(modulus: float) -> asp.Elastic:
    """Solid of this plane-strain ``modulus``."""
    return asp.Elastic(modulus * (1.0 - 0.3**2), 0.3)


if __name__ == "__main__":
    write_page(page(), __file__)
