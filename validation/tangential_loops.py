"""Spheres and cylinders under tangential force, torque and traction: printed formulas of Mindlin,
Deresiewicz, Lubkin and Carter, from other equations."""

from __future__ import annotations

import numpy as np
from page import Claim, Page, Published, Table, write_page

from asperity.core.quadrature import gauss
from asperity.theories import CarterRolling, HertzPoint, MindlinPoint, PartialSlip, tangential_modulus
from asperity.theories.friction.torsion import slip_transform

FRICTION, LOAD, NU = 0.4, 1e-3, 0.3
AMPLITUDES = (0.05, 0.25, 0.5, 0.75, 0.95)
"""Q over μP of the loops."""

BALL = MindlinPoint(E_star=1.0, radius=1.0, G_star=1.0, friction=FRICTION)
ROLLER = CarterRolling(E_star=1.0, radius=1.0, friction=FRICTION)

ABOUT = (
    "A sphere is pressed by P and pulled by Q between ±Q₀ (Mindlin & Deresiewicz 1953), twisted (Lubkin "
    "1951), and a cylinder rolls under a tractive force (Carter 1926). Theirs: the printed formulas. Ours, by "
    "two ways that do not use them: the memory of the contact, `PartialSlip`, which follows any path of "
    "loading and counts the work of friction on the way; and the fields, traction times slip over the annulus "
    "that slips. No parameter is chosen. The loops that Johnson (1955) measured are not compared: the numbers "
    "are in figures."
)

WORDS = """* Work of friction of small cycles goes as the cube of the amplitude: that of Q₀ = 0.05 μP is
  within 5 % of (4/27)(Q₀/μP)³.
* Slip needs the gap of the normal contact under P − Q₀/μ and nothing else; its product with the traction,
  integrated over the annulus, is the loop."""


def page() -> Page:
    """The page."""
    rows, off, numbers = [], [], []
    for s in AMPLITUDES:
        theirs, path, fields = loop(s), _path(s), _fields(s)
        rows.append((f"{s:g}", *(f"{value:.8f}" for value in (theirs, path, fields))))
        off += [abs(path / theirs - 1.0), abs(fields / theirs - 1.0)]
    numbers = [
        Published(
            "Mindlin & Deresiewicz 1953",
            f"loop W/μPδ at Q₀ = {s:g} μP",
            f"{loop(s):.5f}",
            _fields(s),
            1e-6,
            shared=f"loop at {s:g} μP",
        )
        for s in AMPLITUDES[1:4]
    ]
    numbers.append(Published("Mindlin 1949", "tangential over normal stiffness, ν = 0.3", "0.8235", _stiffness(), 1e-6))
    numbers.append(Published("Lubkin 1951", "largest torque over μPa", "0.5890", _torque(), 1e-6))
    creepage, expected = _creepage(0.5), 1.0 - np.sqrt(0.5)
    what, shared = "creepage over μa/R at Q = μP/2", "creepage at 0.5 μP"
    numbers.append(Published("Carter 1926", what, f"{expected:.4f}", creepage, 1e-6, shared=shared))
    small = _path(AMPLITUDES[0]) / (4.0 / 27.0 * AMPLITUDES[0] ** 3)
    return Page(
        "Loops, torsion and rolling by their printed formulas",
        ABOUT,
        (
            Table(
                "Work of friction of a cycle over μPδ, δ the shift at gross sliding:",
                ("Q₀/μP", "printed", "memory", "fields"),
                tuple(rows),
            ),
            WORDS,
        ),
        (
            Claim("largest deviation of a loop", max(off), high=1e-8),
            Claim("loop of the smallest amplitude over its cube", small, 0.95, 1.06),
            Claim("deviation of the creepage, from the work of the fields", abs(creepage / expected - 1.0), high=1e-9),
        ),
        tuple(numbers),
    )


def loop(s: float) -> float:
    """W/μPδ as printed, (24/5) {1 - (1 - s)^(5/3) - (5s/6) [1 + (1 - s)^(2/3)]}."""
    left = 1.0 - s
    return 24.0 / 5.0 * (1.0 - left ** (5.0 / 3.0) - 5.0 * s / 6.0 * (1.0 + left ** (2.0 / 3.0)))


def _scale() -> float:
    return FRICTION * LOAD * FRICTION * float(BALL.normal.at_load(LOAD).approach)


def _path(s: float) -> float:
    contact = PartialSlip(HertzPoint(1.0, 1.0), FRICTION)
    return contact.cycle_dissipation(LOAD, s * FRICTION * LOAD) / _scale()


def _fields(s: float) -> float:
    """Each place slips back and forth by twice what the first loading slips: 4 ∫ μp s dA."""
    Q = s * FRICTION * LOAD
    answer = BALL.at_load(LOAD, Q)
    c, a = float(answer.stick_radius), float(answer.normal.radius)
    t, weight = gauss(np.array([0.0, 1.0]), 60)
    r = c + (a - c) * t**2 * (3.0 - 2.0 * t)  # roots at both ends
    area = 2.0 * np.pi * r * (a - c) * 6.0 * t * (1.0 - t) * weight
    return 4.0 * float(np.sum(area * BALL.traction(r, LOAD, Q) * BALL.slip(r, LOAD, Q))) / _scale()


def _stiffness() -> float:
    """First stiffness of the memory of equal bodies of ν = 0.3 over that of the normal contact."""
    shear = 1.0 - NU  # E* = G/(1 - ν) = 1 of the pair
    ball = HertzPoint(1.0, 1.0)
    contact = PartialSlip(ball, FRICTION, ratio=1.0 / tangential_modulus(shear, NU, shear, NU))
    path = contact.under_forces([LOAD, LOAD], [0.0, 1e-8 * LOAD])
    return float(path.tangential[-1] / path.shift[-1] / ball.at_load(LOAD).stiffness)


def _torque() -> float:
    """8 ∫ x Q dx of the slipping contact, from Hertz's pressure by Abel's transform."""
    x, weight = gauss(np.concatenate([[0.0], 0.3 ** np.arange(8.0, -1.0, -1.0)]), 16)
    slipping = slip_transform(lambda t: 0.5 * (1.0 - t**2), x, 1.0)  # E*(a² - x²)/2R with a = R = E* = 1
    return 8.0 * float(np.sum(weight * x * slipping)) / float(HertzPoint(1.0, 1.0).at_radius(1.0).load)


def _creepage(s: float) -> float:
    """Work of traction and slip over the force, over μa/R."""
    Q = s * FRICTION * LOAD
    answer = ROLLER.at_load(LOAD, Q)
    a, c = float(answer.normal.radius), float(answer.stick_radius)
    t, weight = gauss(np.array([0.0, np.pi]), 60)
    x = -c - (a - c) * np.cos(t)
    work = np.sum(weight * (a - c) * np.sin(t) * ROLLER.traction(x, LOAD, Q) * ROLLER.slip_velocity(x, LOAD, Q))
    return float(work) / Q / (FRICTION * a)


if __name__ == "__main__":
    write_page(page(), __file__)
