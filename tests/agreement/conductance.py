"""Rows of the agreement matrix: theories of conductance, and the solver beside them."""

from __future__ import annotations

import numpy as np
from agreement.matrix import ROUNDING, Agreement, apart, make

import asperity as asp
from asperity.physics.conductance.conductance import conductance
from asperity.solids import Conduction
from asperity.theories.conductance.spots import sharvin

K = 50.0
"""Harmonic mean of the conductivities."""


def correlated(share: float) -> float:
    """Largest difference of the correlation from 1e-6 to this share of the hardness."""
    joint = make("plastic-joint", K, 1.0, 1.0, 1.0)
    pressures = np.geomspace(1e-6, share, 200)
    return apart(joint.correlation(pressures), joint.at_pressure(pressures).conductance)


def stiff_spot(_: float) -> float:
    """Holm's spot beside Hertz' stiffness, by Barber."""
    hertz = make("hertz", 1e11, 1e-3).at_load(np.array([1e-3, 1.0]))
    return apart(make("holm-spot", K).at_radius(hertz.radius).conductance, K / 1e11 * hertz.stiffness)


def apart_spots(distance: float) -> float:
    """Two spots of 0.1 µm."""
    pair = make("spot-cluster", K, [0.0, distance], [0.0, 0.0], [1e-7, 1e-7])
    return apart(pair.conductance, 2.0 * make("holm-spot", K).at_radius(1e-7).conductance)


def ballistic(path: float) -> float:
    """A spot of 10 nm."""
    return apart(make("holm-spot", K, path).at_radius(1e-8).resistance, sharvin(K, 1e-8, path))


def stiff_gap(_: float) -> float:
    """The stiffness of p ~ exp(-u/u_0) is p/u_0."""
    u, decay = 3e-7, 0.4 * 1e-7
    p = 1e9 * np.exp(-np.array([u, u + 1e-12]) / decay)
    joint = make("mean-gap-joint", K, 1e11, 1e-7, 0.4)
    slope = (p[0] - p[1]) / 1e-12
    return apart(joint.at_pressure(p[0]).conductance, K / 1e11 * slope)


def solved_spot(pixels: float) -> float:
    """Hertz's contact of so many pixels in the radius, of a body of half the conductivity."""
    n, a = int(2.6 * pixels), 5e-5
    dx = a / pixels
    place = (np.arange(n) - 0.5 * (n - 1)) * dx
    heights = -0.5 * (place[:, None] ** 2 + place[None, :] ** 2) / 1e-3
    body = asp.Elastic(0.91e11, 0.3, conduction=Conduction(0.5 * K))
    problem = asp.ContactProblem(asp.Surface(heights, dx), body, boundary=asp.Free())
    found = conductance(asp.solve(problem, asp.Force(4.0 / 3.0 * 1e11 * a**3 / 1e-3)), "thermal")
    return apart(found.total, make("holm-spot", K).at_radius(a).conductance) + found.pixel_error


CONDUCTANCE = (
    Agreement(
        "plastic-joint",
        "1.25 (P/H)^0.95",
        "1e-6 < P/H < 0.03",
        lambda _: correlated(0.03),
        (),
        0.0155,
        "the largest error that is stated of the correlation, 1.5 %",
    ),
    Agreement(
        "holm-spot",
        "hertz",
        "conductance as stiffness",
        stiff_spot,
        (),
        ROUNDING,
        "the incremental contact is the problem of conduction (Barber 2003)",
    ),
    Agreement(
        "spot-cluster",
        "holm-spot",
        "spots far apart",
        apart_spots,
        (1e-5, 1e-3, 0.1),
        1e-6,
        "mutual terms fall as the reciprocal of the distance: 2/π of the radius over it",
    ),
    Agreement(
        "holm-spot",
        "Sharvin's resistance",
        "mean free path to infinity",
        ballistic,
        (1e-7, 1e-6, 1e-5),
        1e-3,
        "Wexler's factor is 0.7 times 3π/8 of the radius over the mean free path",
    ),
    Agreement(
        "mean-gap-joint",
        "exp(-u/u0)",
        "conductance as stiffness",
        stiff_gap,
        (),
        1e-4,
        "a difference of the exponential over 1e-12 m of 4e-8 m",
    ),
    Agreement(
        "holm-spot",
        "solver (free)",
        "pixels to infinity",
        solved_spot,
        (12.0, 24.0, 48.0),
        4e-3,
        "of first order in the pixel: 0.2 of a pixel at the edge, and the rim known to half of that",
    ),
)
