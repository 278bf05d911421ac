"""Indentation with friction: the stick radius of a rigid sphere against the coefficient of friction
(Spence 1975) by the numerical solution."""

from __future__ import annotations

import math

import numpy as np
from page import Claim, Page, Table, write_page

import asperity as asp
from asperity.theories import FrictionalPunch

A, RADIUS = 0.1, 1.0
CASES = ((0.0, 0.2), (0.0, 0.35), (0.0, 0.5), (0.3, 0.1), (0.3, 0.15), (0.3, 0.25))
"""Poisson's ratio of the body and coefficient of friction."""

GRIDS = (24, 48, 96)

ABOUT = (
    "A rigid sphere is pressed on a half-space with Coulomb's friction: an inner circle sticks, an annulus "
    "slips inwards, and their ratio depends on friction and Poisson's ratio alone (Spence 1975). Reference: "
    "an independent solution of our own, collocation of two coupled equations (`FrictionalPunch`; the same "
    "for all profiles), for numbers of Spence were not at hand. Ours: a history of loads that grow with the "
    "cube of their number, half as many as pixels along the side, so that the contact grows evenly, pressure "
    "and shear balanced at each. No parameter is chosen."
)

WORDS = """* The stick radius is that of a circle of the area that sticks. Pixels and steps of the history
  both limit it, and it comes nearer as both are refined together.
* Pressure and shear change each other here. The plane formula of Goodman (1962) leaves that out and, taken
  for spheres, asks for up to a half more friction."""


def page(grids: tuple[int, ...] = GRIDS) -> Page:
    """The page, on ``grids`` of pixels along the side, with half as many steps of the load."""
    rows, off = [], []
    for nu, friction in CASES:
        theirs = reference(nu, friction)
        ours = [stick_share(nu, friction, n, n // 2) for n in grids]
        rows.append((f"{nu:g}", f"{friction:g}", f"{theirs:.3f}", *(f"{value:.3f}" for value in ours)))
        off.append([abs(value - theirs) for value in ours])
    worst = np.max(off, axis=0)
    return Page(
        "Sphere pressed with friction",
        ABOUT,
        (
            Table(
                "Stick radius over contact radius:",
                ("ν", "μ", "collocation", *(f"{n} pixels" for n in grids)),
                tuple(rows),
            ),
            WORDS,
        ),
        (
            Claim("largest difference on the finest grid", float(worst[-1]), high=0.02),
            Claim(
                "largest difference on the finest grid over that on the coarsest", float(worst[-1] / worst[0]), high=0.8
            ),
        ),
    )


def reference(nu: float, friction: float) -> float:
    """Stick radius over contact radius by collocation."""
    body = asp.Elastic(1.0, nu)
    beta = (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu))
    return FrictionalPunch(body.plane_strain_modulus, A, beta, friction).stick_share


def stick_share(nu: float, friction: float, points: int, steps: int) -> float:
    """The same by the numerical solution."""
    body = asp.Elastic(1.0, nu)
    spacing = 2.2 * A / points
    x = (np.arange(points) - 0.5 * (points - 1)) * spacing
    surface = asp.Surface(-(x[:, None] ** 2 + x[None, :] ** 2) / (2.0 * RADIUS), spacing, spacing)
    problem = asp.ContactProblem(surface, body, boundary=asp.Free(), friction=asp.Coulomb(friction))
    load = 4.0 / 3.0 * body.plane_strain_modulus * A**3 / RADIUS
    pressed = [asp.Step(asp.Force(load * (k / steps) ** 3), asp.Shift()) for k in range(1, steps + 1)]
    last = asp.solve(problem, asp.History(pressed)).last
    sticks = last.contact & ~last.require_stick_slip().slipping
    return math.sqrt(np.count_nonzero(sticks) / np.count_nonzero(last.contact))


if __name__ == "__main__":
    write_page(page(), __file__)
