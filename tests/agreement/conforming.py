"""More rows of the agreement matrix: cylinders between flats, conforming contacts, and their
solutions."""

from __future__ import annotations

import numpy as np
from agreement.matrix import ROUNDING, Agreement, apart, make

import asperity as asp

E, R = 1e11, 1e-3
"""Contact modulus (Pa) and radius (m) of the rows."""


def one_of_two_contacts(_: float) -> float:
    """Half-width and peak under 1 kN/m."""
    one, other = (make(name, E, R).at_load(1e3) for name in ("compressed-cylinder", "hertz-line"))
    return max(apart(one.radius, other.radius), apart(one.max_pressure, other.max_pressure))


def loose(name: str, like: str, angle: float) -> float:
    """Peak pressure at the load of Hertz's contact of the half-width ``angle`` R, with a clearance
    of the radius over a million."""
    outer = R * (1.0 + 1e-6)
    hertz = make(like, E, R * outer / (outer - R))
    load = hertz.at_peak(0.5 * E * angle * 1e-6 * (1.0 if like == "hertz-line" else 4.0 / np.pi)).load
    return apart(make(name, E, R, outer).at_load(load).max_pressure, hertz.at_load(load).max_pressure)


def solved_bore(points: float) -> float:
    """Peak pressure at about 60° to each side."""
    twin, clearance = asp.Elastic(2.0 * E * 0.91, 0.3), 1e-6
    pin = make("pin-in-hole", E, R, R + clearance)
    found = asp.contact.cylinder_in_bore(twin, twin, R, clearance, 2.0 * E * clearance, points=int(points))
    return apart(found.max_pressure, pin.at_load(found.load).max_pressure)


def solved_socket(angle: float) -> float:
    """Half-angle at the load of Hertz's contact of the radius ``angle`` R."""
    twin, clearance = asp.Elastic(2.0 * E * 0.91, 0.3), 1e-6
    theory = make("sphere-in-cavity", E, R, R + clearance)
    found = asp.contact.sphere_in_socket(twin, twin, R, clearance, theory.at_radius(angle * R).load, points=1024)
    return apart(found.max_pressure, theory.at_load(found.load).max_pressure)


CONFORMING = (
    Agreement(
        "cylinder-in-hole",
        "hertz-line",
        "width over radius to zero",
        lambda angle: loose("cylinder-in-hole", "hertz-line", angle),
        (1e-1, 1e-2, 1e-3),
        1e-5,
        "the square of the half-width over the radius",
    ),
    Agreement(
        "pin-in-hole",
        "hertz-line",
        "width over radius to zero",
        lambda angle: loose("pin-in-hole", "hertz-line", angle),
        (1e-1, 1e-2, 1e-3),
        1e-5,
        "the square of the half-width over the radius",
    ),
    Agreement(
        "sphere-in-cavity",
        "hertz",
        "contact radius over radius to zero",
        lambda angle: loose("sphere-in-cavity", "hertz", angle),
        (1e-1, 1e-2, 1e-3),
        1e-5,
        "the square of the contact radius over the radius",
    ),
    Agreement(
        "pin-in-hole",
        "the solver (cylinder in bore)",
        "points to infinity",
        solved_bore,
        (128.0, 256.0, 512.0),
        1e-5,
        "the edge falls between two points: power 1.5 to 2 of the spacing over the width",
    ),
    Agreement(
        "sphere-in-cavity",
        "the solver (sphere in socket)",
        "contact radius over radius to zero",
        solved_socket,
        (0.4, 0.2, 0.1),
        0.02,
        "half-spaces lack the stiffness of a sphere and its cavity: the square of the contact radius over the radius",
    ),
    Agreement(
        "compressed-cylinder",
        "hertz-line",
        "each of the two contacts",
        one_of_two_contacts,
        (),
        ROUNDING,
        "half-width and peak are Hertz's",
    ),
)
