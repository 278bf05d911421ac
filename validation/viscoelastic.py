"""Viscoelastic contacts against independent solutions: Lee & Radok, Ting, a punch on a coating, a
sliding wave, Persson's rubber friction."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from page import Claim, Page, Table, write_page
from scipy.integrate import quad
from scipy.optimize import brentq

import asperity as asp

SOLIDS = {
    "standard": (1.0, ((9.0, 1.0),)),
    "Prony, three terms": (1.0, ((2.0, 10.0), (5.0, 1.0), (20.0, 0.01))),
    "Maxwell": (0.0, ((1.0, 1.0),)),
}
"""Contact modulus (Pa) and terms (Pa, s); as Young's modulus of a solid whose Poisson's ratio is
zero."""

TIMES = (0.1, 1.0, 10.0)
WAVES = (
    (0.001, 0.3, 0.00295196, 0.36, 0.0047011, 1.09718),
    (0.1, 0.3, 0.0105027, 0.11465, 0.023953, 3.39568),
    (0.3, 0.3, 0.00359368, 0.111404, 0.0081373, 3.45641),
    (1.0, 0.3, 0.00108127, 0.110924, 0.0024842, 3.46342),
)
"""Speed over λ/τ, mean pressure over p*; friction, contact fraction, shift over λ and largest
pressure over p* by a dense active set."""

RUBBER = (
    (0.01, 0.04460254126, 0.3226091927, 1.3e6, 1.3e9, 1e-6),
    (0.01, 0.03553453422, 0.2840821227, 2e6, 2e7, 1e-4),
    (1.0, 0.01382888481, 0.1265386925, 2e6, 2e7, 1e-4),
)
"""Speed (m/s), friction and area by quadrature, relaxed modulus and step (Pa), time (s)."""

ABOUT = (
    "The reference is an independent solution on every row, by closed forms, roots and quadratures of our "
    "own. Held and relaxing sphere: Lee and Radok (1960), a³ = 3/4 RP J(t) and P = 4/3 √R δ^(3/2) E(t). "
    "Triangle: a sphere that approaches and withdraws at one speed, Ting (1966). Punch: a square punch on a "
    "coating of elastic bulk, pressed in at once and held; its load is found from elastic contacts with "
    "moduli at real values of the Laplace variable, inverted by Stehfest's (1970) formula. Sliding wave: "
    "steady sliding of a wave of amplitude 0.01 λ over the standard solid, against a dense active set on 1024 "
    "points. Rubber: Persson's (2001) friction of a self-affine spectrum against quadrature. Grids and steps "
    "of time are chosen freely."
)


def page(points: int = 64, waves: int = 512, tolerance: float = 1e-3) -> Page:
    """The page, for spheres on ``points``² and waves on ``waves`` points, with this ``tolerance``
    of the steps of time."""
    settings = asp.TimeSteps(tolerance)
    held = [(name, t, *row) for name in SOLIDS for t, *row in creeping(name, points, settings)]
    relaxing = [(name, t, *row) for name in SOLIDS for t, *row in relaxed(name, points, settings)]
    triangles = [(name, *triangle(name, points, settings)) for name in SOLIDS]
    punches = [(t, *row) for t, *row in punch(points // 2, settings)]
    sliding = [(row, wave(row, waves)) for row in WAVES]
    rubber = [(row, friction(row)) for row in RUBBER]
    return Page(
        "Viscoelasticity",
        ABOUT,
        (
            Table(
                "Approach of a held sphere over that at once.",
                ("solid", "t", "grid's", "exact", "deviation"),
                tuple(map(_row, held)),
            ),
            Table(
                "Load of a relaxing sphere over that at once.",
                ("solid", "t", "grid's", "exact", "deviation"),
                tuple(map(_row, relaxing)),
            ),
            Table(
                "Triangle of approach: largest error of the load over its peak, and time at which the load is "
                "gone over that of the peak.",
                ("solid", "error of the load", "grid's, between", "exact"),
                tuple(
                    (name, f"{error:.1e}", f"{low:.4f} and {high:.4f}", f"{exact:.4f}")
                    for name, error, low, high, exact in triangles
                ),
            ),
            Table(
                "Load of a punch on a coating over that at once.",
                ("t", "grid's", "exact", "deviation"),
                tuple(_row(("", *row))[1:] for row in punches),
            ),
            Table(
                "Sliding wave.",
                (
                    "v τ/λ",
                    "friction: grid's",
                    "exact",
                    "contact fraction: grid's",
                    "exact",
                    "shift: grid's",
                    "exact",
                    "largest pressure over p*: grid's",
                    "exact",
                ),
                tuple(
                    (f"{row[0]:g}", *(f"{value:.4g}" for pair in zip(found, row[2:], strict=True) for value in pair))
                    for row, found in sliding
                ),
            ),
            Table(
                "Persson's friction.",
                ("v (m/s)", "friction", "exact", "area", "exact"),
                tuple(
                    (f"{row[0]:g}", f"{mu:.6f}", f"{row[1]:.6f}", f"{area:.6f}", f"{row[2]:.6f}")
                    for row, (mu, area) in rubber
                ),
            ),
        ),
        (
            Claim("largest deviation of the held sphere", max(abs(f / e - 1.0) for *_, f, e in held), high=0.005),
            Claim(
                "largest error of the relaxing sphere over its first load",
                max(abs(f - e) for *_, f, e in relaxing),
                high=0.002,
            ),
            Claim("largest error of the triangle over its peak", max(row[1] for row in triangles), high=0.005),
            Claim(
                "separations within their brackets",
                float(all(low <= e <= high for _, _, low, high, e in triangles)),
                1.0,
                1.0,
            ),
            Claim("largest deviation of the punch", max(abs(f / e - 1.0) for _, f, e in punches), high=0.005),
            Claim(
                "largest difference of the friction of the wave",
                max(abs(f[0] - row[2]) for row, f in sliding),
                high=1e-4,
            ),
            Claim(
                "largest difference of its contact fraction",
                max(abs(f[1] - row[3]) for row, f in sliding),
                high=4.0 / waves + 0.0043,
            ),
            Claim(
                "largest difference of its shift",
                max(abs(f[2] - row[4]) for row, f in sliding),
                high=2.0 / waves + 0.0043,
            ),
            Claim(
                "largest deviation of Persson's friction",
                max(abs(mu / row[1] - 1.0) for row, (mu, _) in rubber),
                high=1e-6,
            ),
        ),
    )


def _row(row: tuple[str, float, float, float]) -> tuple[str, ...]:
    name, t, found, exact = row
    return name, f"{t:g}", f"{found:.5f}", f"{exact:.5f}", f"{100 * (found / exact - 1):+.2f} %"


def solid(name: str) -> asp.Viscoelastic:
    """Solid of this name."""
    return asp.Viscoelastic.prony(*SOLIDS[name], 0.0)


def sphere(points: int, reach: float, body: asp.Elastic) -> asp.ContactProblem:
    """Paraboloid of radius 1 m on a square of half side ``reach`` against ``body``."""
    x = (np.arange(points) - points / 2 + 0.5) * 2 * reach / points
    return asp.ContactProblem(
        asp.Surface(-0.5 * (x[:, None] ** 2 + x**2), 2 * reach / points), body, boundary=asp.Free()
    )


def holds(control: asp.Force | asp.Approach) -> asp.History:
    """``control`` at once, held until each of ``TIMES``."""
    return asp.History([control, *(asp.Step(control, duration=float(dt)) for dt in np.diff([0.0, *TIMES]))])


def creeping(name: str, points: int, settings: asp.TimeSteps) -> list[tuple[float, float, float]]:
    """Approach of a held sphere over that at once, on the grid and by J(t)^(2/3)."""
    body = solid(name)
    creep = body.contact_creep
    load = 1e-4
    reach = 1.15 * np.cbrt(0.75 * load * float(creep.at(TIMES[-1])))
    found = asp.solve(sphere(points, reach, body), holds(asp.Force(load)), time_steps=settings)
    exact = [np.cbrt(0.75 * load * float(creep.at(t))) ** 2 for t in TIMES]
    first = np.cbrt(0.75 * load * creep.instantaneous) ** 2
    return [(t, float(d / first), e / first) for t, d, e in zip(TIMES, found.approach[1:], exact, strict=True)]


def relaxed(name: str, points: int, settings: asp.TimeSteps) -> list[tuple[float, float, float]]:
    """Load of a sphere at a fixed approach over that at once, on the grid and by E(t)."""
    body = solid(name)
    found = asp.solve(sphere(points, 0.17, body), holds(asp.Approach(0.02)), time_steps=settings)
    E = body.contact_relaxation
    shares = [float(E.at(t)) / E.instantaneous for t in TIMES]
    return [(t, float(p / found.force[0]), e) for t, p, e in zip(TIMES, found.force[1:], shares, strict=True)]


def triangle(name: str, points: int, settings: asp.TimeSteps) -> tuple[float, float, float, float]:
    """Largest error of the load over its peak; times with and without load, and of separation, over
    that of the peak."""
    speed, peak = 1e-3, 1.0
    body = solid(name)
    end = separation(body, peak)
    times = [0.25, 0.5, 0.75, 1.0, *(1.0 + share * (end - 1.0) for share in (0.25, 0.5, 0.75, 0.97, 1.03))]
    ramp = [
        asp.Step(asp.Approach(speed * min(t, 2.0 - t)), duration=float(dt))
        for t, dt in zip(times, np.diff([0.0, *times]), strict=True)
    ]
    problem = sphere(points, 1.2 * math.sqrt(speed), body)
    found = asp.solve(problem, asp.History(ramp), time_steps=replace(settings, tolerance=0.5 * settings.tolerance))
    exact = np.array([pressed(body, speed, peak, t) for t in times[:-1]])
    error = float(np.abs(found.force[:-1] - exact).max() / exact.max())
    last = times[-2] if found.force[-2] > 0.0 else 0.0
    return error, last, times[-1] if found.force[-1] == 0.0 else math.inf, end


def _until(body: asp.Viscoelastic, x: float) -> float:
    """Integral of the contact modulus from 0 to ``x`` (s)."""
    E = body.contact_relaxation
    return E.relaxed * x + sum(strength * tau * -math.expm1(-x / tau) for strength, tau in E.terms)


def same_radius(body: asp.Viscoelastic, peak: float, t: float) -> float:
    """Earlier time t1 at which the radius was that at ``t``: ∫ E(t - s) dδ from t1 to t is zero."""
    if t <= peak:
        return t

    def balance(t1: float) -> float:
        return _until(body, t - t1) - 2.0 * _until(body, t - peak)

    return float(brentq(balance, 0.0, peak, xtol=1e-14)) if balance(0.0) > 0.0 else 0.0


def separation(body: asp.Viscoelastic, peak: float) -> float:
    """Time at which the contact ends, t1 = 0."""
    return float(brentq(lambda t: _until(body, t) - 2.0 * _until(body, t - peak), peak, 2.0 * peak, xtol=1e-14))


def pressed(body: asp.Viscoelastic, speed: float, peak: float, t: float) -> float:
    """Load of the triangle at ``t``: 4/3 ∫ E(t - s) dδ^(3/2) from 0 to t1."""
    E = body.contact_relaxation
    found, _ = quad(
        lambda s: float(E.at(t - s)) * 1.5 * speed**1.5 * math.sqrt(s),
        0.0,
        same_radius(body, peak, t),
        epsabs=0.0,
        epsrel=1e-9,
    )
    return 4.0 / 3.0 * found


def punch(points: int, settings: asp.TimeSteps) -> list[tuple[float, float, float]]:
    """Load of a held punch on a coating over that at once, in time and by Stehfest's inversion of
    elastic contacts."""
    top = asp.Viscoelastic.standard_linear(1.0, 10.0, 1.0, 0.4, elastic_bulk=True)
    height = np.full((points, points), -1.0)
    quarter = points // 4
    height[quarter:-quarter, quarter:-quarter] = 0.0
    surface, approach = asp.Surface(height, 1.0 / points), asp.Approach(1e-3)

    def coated(material: asp.Elastic) -> asp.ContactProblem:
        body = asp.Layered([asp.Layer(material, 0.2)], asp.Elastic(20.0, 0.3))
        return asp.ContactProblem(surface, body, boundary=asp.Free())

    found = asp.solve(coated(top), holds(approach), time_steps=settings)

    def elastic(s: float) -> float:
        shear, nu = (complex(part).real for part in top.operational(s))
        material = asp.Elastic(2.0 * shear * (1.0 + nu), nu)
        return float(asp.solve(coated(material), approach, solver=asp.solvers.ActiveSet(tolerance=1e-13)).force)

    exact = [stehfest(lambda s: elastic(s) / s, t) for t in TIMES]
    return [
        (t, float(p / found.force[0]), e / found.force[0])
        for t, p, e in zip(TIMES, found.force[1:], exact, strict=True)
    ]


def stehfest(transform: Callable[[float], float], t: float, terms: int = 10) -> float:
    """Value at ``t`` of the function with this Laplace ``transform`` of a real variable (Stehfest
    1970)."""
    half, total = terms // 2, 0.0
    for k in range(1, terms + 1):
        weight = sum(
            j ** (half + 1) * math.comb(half, j) * math.comb(2 * j, j) * math.comb(j, k - j) / math.factorial(half)
            for j in range((k + 1) // 2, min(k, half) + 1)
        )
        total += (-1) ** (k + half) * weight * transform(k * math.log(2.0) / t)
    return total * math.log(2.0) / t


def wave(row: tuple[float, ...], points: int) -> tuple[float, float, float, float]:
    """Friction, contact fraction, shift and largest pressure over p* of the sliding wave."""
    speed, load = row[:2]
    scale = math.pi * 0.01
    heights = 0.01 * np.cos(2.0 * np.pi * np.arange(points) / points)
    surface = asp.Surface(heights[:, None], 1.0 / points, 1.0)
    problem = asp.ContactProblem(surface, asp.Rigid(), counter_body=solid("standard"))
    found = asp.slide(problem, asp.MeanPressure(load * scale), speed)
    touching = found.normal.contact[:, 0]
    x = (np.arange(points) / points + 0.5) % 1.0 - 0.5
    return found.friction, float(touching.mean()), float(x[touching].mean()), found.normal.max_pressure / scale


def friction(row: tuple[float, ...]) -> tuple[float, float]:
    """Persson's friction and area."""
    speed, _, _, relaxed_modulus, step, tau = row
    level = 1e-18 * (2.0 * np.pi) ** 2
    spectrum = asp.theories.IsotropicSpectrum([2e3, 2e6], [level, level * 1e3**-3.6])
    body = asp.Viscoelastic.prony(relaxed_modulus, ((step, tau),), 0.0)
    modulus = body.contact_relaxation.complex_modulus
    found = asp.theories.rubber_friction(spectrum, modulus, speed=speed, pressure=1e5)
    return found.friction, found.area_fraction


if __name__ == "__main__":
    write_page(page(), __file__)
