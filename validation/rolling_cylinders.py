"""Rolling cylinders of Carter and twisted spheres of Lubkin by the numerical solution: creepage,
stick zone, torque, with the order of convergence."""

from __future__ import annotations

import numpy as np
from page import Claim, Page, Published, Table, write_page

import asperity as asp
from asperity.theories import LubkinSphere

FRICTION, RADIUS, A = 0.3, 1.0, 0.1
STEEL = asp.Elastic(1.0, 0.3)
UNIT = FRICTION * A / RADIUS
"""Creepage from which on all slips."""

SHARES = (0.2, 0.5, 0.8)
TWISTS = (0.9, 0.7, 0.5)
GRIDS = (32, 128, 512)

ABOUT = (
    "Equal cylinders roll under a tractive force (Carter 1926), and a sphere is twisted under its load "
    "(Lubkin 1951). Theirs: the printed formulas. Ours: `asp.roll` by the direct method on lines, and a twist "
    "by `asp.solve`, on pixels of constant tractions. No parameter is chosen. Layered rollers, for which "
    "there are no published numbers, stand beside."
)

WORDS = """* The stick zone reaches the leading edge, and the creepage at a given force, found between two
  creepages of the grid, is Carter's. The error of the force falls with the first power of the pixel on grids
  whose pixels lie alike at the rims.
* Rollers with a layer half a half-width thick and a third as stiff transmit less at the same creepage, for
  the layer yields to shear; those with a stiffer layer transmit more."""


def page(grids: tuple[int, ...] = GRIDS, points: int = 64) -> Page:
    """The page, with rollers on lines of ``grids`` pixels and the sphere on ``points`` pixels along
    the side."""
    errors = [force_error(n) for n in grids]
    order = -float(np.polyfit(np.log(grids), np.log(errors), 1)[0])
    finest = grids[-1]
    numbers = [
        Published(
            "Carter 1926",
            f"creepage over μa/R at Q = {s:g} μP",
            f"{1.0 - np.sqrt(1.0 - s):.4f}",
            creepage_at(s, finest),
            0.01,
            shared="creepage at 0.5 μP" if s == 0.5 else "",
        )
        for s in SHARES
    ]
    numbers += [
        Published(
            "Carter 1926",
            f"stick zone over the contact at Q = {s:g} μP",
            f"{np.sqrt(1.0 - s):.4f}",
            stick_at(s, finest),
            0.02,
        )
        for s in SHARES
    ]
    numbers += [
        Published(
            "Lubkin 1951", f"torque over the largest at c/a = {c:g}", f"{lubkin(c)[1]:.4f}", torque_at(c, points), 0.02
        )
        for c in TWISTS
    ]
    at = np.array([0.1, 0.2, 0.4, 0.6, 0.8, 1.0])
    columns = [curve(body, at, 128) for body in (STEEL, layered(1.0 / 3.0), layered(3.0))]
    rows = tuple((f"{x:g}", *(f"{column[k]:.3f}" for column in columns)) for k, x in enumerate(at))
    worst = max(abs(number.deviation) for number in numbers)
    return Page(
        "Rolling cylinders and twisted spheres",
        ABOUT,
        (
            Table(
                "Largest error of the force on a creep-force curve over the friction limit:",
                ("pixels over three half-widths", "error"),
                tuple((f"{n}", f"{error:.5f}") for n, error in zip(grids, errors, strict=True)),
            ),
            Table(
                "Force over the friction limit of plain rollers, and of such with a layer of half the Hertz "
                "half-width of the plain ones, under the same load:",
                ("creepage over μa/R", "plain", "layer of a third of E", "layer of three times E"),
                rows,
            ),
            WORDS,
        ),
        (
            Claim("order of convergence of the force", order, 0.8, 1.3),
            Claim("largest deviation of creepage, stick zone or torque", worst, high=0.02),
        ),
        tuple(numbers),
    )


def layered(ratio: float) -> asp.Layered:
    """Steel with a layer of ``ratio`` times its modulus."""
    return asp.Layered([asp.Layer(asp.Elastic(ratio, 0.3), 0.5 * A)], base=STEEL)


def rollers(body: asp.Elastic | asp.Layered, points: int) -> tuple[asp.ContactProblem, asp.Force]:
    """Equal rollers on a line, and the load of plain ones of the half-width ``A``."""
    spacing = 3.0 * A / points
    x = (np.arange(points) - 0.5 * (points - 1)) * spacing
    surface = asp.Surface(-(x[:, None] ** 2) / (2.0 * RADIUS), spacing, 1.0)
    law = asp.Coulomb(FRICTION)
    problem = asp.ContactProblem(surface, body, counter_body=body, boundary=asp.FreeLine(), friction=law)
    return problem, asp.Force(np.pi / 4.0 * asp.solids.contact_modulus(STEEL, STEEL) * A**2 / RADIUS)


def curve(body: asp.Elastic | asp.Layered, at: np.ndarray, points: int) -> np.ndarray:
    """Force over the friction limit at creepages ``at`` over μa/R."""
    problem, load = rollers(body, points)
    found = asp.rolling.creep_curve(problem, load, at * UNIT)
    return np.asarray(found.longitudinal_force / found.friction_limit)


def force_error(points: int) -> float:
    """Largest difference from Carter's force over the friction limit."""
    at = np.linspace(0.1, 1.1, 11)
    return float(np.abs(curve(STEEL, at, points) - (1.0 - (1.0 - np.minimum(at, 1.0)) ** 2)).max())


def creepage_at(s: float, points: int) -> float:
    """Creepage over μa/R at which the force is the share ``s`` of the limit, between two of the
    curve."""
    exact = 1.0 - np.sqrt(1.0 - s)
    at = exact * np.array([0.97, 1.0, 1.03])
    return float(np.interp(s, curve(STEEL, at, points), at))


def stick_at(s: float, points: int) -> float:
    """Share of the contact that sticks at Carter's creepage for ``s``."""
    problem, load = rollers(STEEL, points)
    return 1.0 - asp.roll(problem, load, asp.rolling.Creepage(UNIT * (1.0 - np.sqrt(1.0 - s)))).slip_area_fraction


def lubkin(c: float) -> tuple[float, float]:
    """Twist in rad, and torque over the largest, that leave the share ``c`` of the radius
    sticking."""
    ball = LubkinSphere(asp.solids.contact_modulus(STEEL, STEEL), RADIUS, 0.5 * STEEL.shear_modulus, FRICTION)
    load = float(4.0 / 3.0 * asp.solids.contact_modulus(STEEL, STEEL) * A**3 / RADIUS)
    answer = ball.at_stick_radius(load, c)
    return float(answer.rotation), float(ball.torque(load, c) / ball.largest_torque(load))


def torque_at(c: float, points: int) -> float:
    """Torque over (3π/16) μPa at the twist for ``c``."""
    spacing = 2.4 * A / points
    x = (np.arange(points) - 0.5 * (points - 1)) * spacing
    surface = asp.Surface(-(x[:, None] ** 2 + x[None, :] ** 2) / (2.0 * RADIUS), spacing, spacing)
    problem = asp.ContactProblem(
        surface, STEEL, counter_body=STEEL, boundary=asp.Free(), friction=asp.Coulomb(FRICTION)
    )
    load = 4.0 / 3.0 * problem.contact_modulus * A**3 / RADIUS
    found = asp.solve(problem, asp.Step(asp.Force(load), asp.Shift(twist=lubkin(c)[0]))).require_stick_slip()
    return found.torque / (3.0 * np.pi / 16.0 * FRICTION * load * A)


if __name__ == "__main__":
    write_page(page(), __file__)
