"""More rows of the agreement matrix: theories of one contact in each other's limits, and the solver
beside them."""

from __future__ import annotations

import numpy as np
from agreement.matrix import ROUNDING, Agreement, apart, make
from contact_cases import TIGHT, elastic, square_grid

import asperity as asp
from asperity import theories as th
from asperity.theories.adhesion.spheres import load_ratio

E, R, W = 1e9, 1e-6, 0.05
"""Contact modulus (Pa), radius (m) and work of adhesion (J/m²) of the rows."""

LOADS = np.array([0.0, 1e-7, 1e-6])


def like_a_line(ratio: float) -> float:
    """Half-width and peak of an ellipse of radii R and R times ``ratio``; its middle carries (3/4)
    P/a per length."""
    ellipse = make("hertz-ellipse", E, ratio * R, R)
    a, b = ellipse.semi_axes(1e-6)
    line = make("hertz-line", E, R).at_load(0.75e-6 / float(a))
    return max(apart(b, line.radius), apart(ellipse.at_load(1e-6).max_pressure, line.max_pressure))


def like_a_punch(exponent: float) -> float:
    """A profile that is flat up to r = 1 m and then rises steeply."""
    steep = make("power-law-indenter", E, 1.0, exponent).at_radius(1.0)
    return apart(make("flat-punch", E, 1.0).at_approach(steep.approach).load, steep.load)


def like_a_cylinder(_: float) -> float:
    """Half-width and peak pressure in plane strain."""
    one, other = make("line-power-law-indenter", E, 0.5 / R, 2.0).at_load(1.0), make("hertz-line", E, R).at_load(1.0)
    return max(apart(one.radius, other.radius), apart(one.max_pressure, other.max_pressure))


def wave_like_lines(share: float) -> float:
    """A wave of 1 nm and 1 µm at ``share`` of the pressure of full contact, its crests cylinders of
    λ²/4π²Δ."""
    wave = make("westergaard", E, 1e-9, 1e-6)
    p = share * wave.full_contact_pressure
    line = make("hertz-line", E, 1e-12 / (4.0 * np.pi**2 * 1e-9)).at_load(p * 1e-6)
    return max(apart(wave.area_fraction(p), line.area / 1e-6), apart(wave.max_pressure(p), line.max_pressure))


def like_coulomb(_: float) -> float:
    """Traction at Q = μP against μ times the pressure."""
    theory = make("mindlin", E, R, 1.2 * E, 0.3)
    r = np.linspace(0.0, 0.99, 20) * float(theory.normal.at_load(1e-6).radius)
    return apart(theory.traction(r, 1e-6, 0.3e-6), 0.3 * theory.normal.pressure(r, 1e-6))


def slipping_wave_like_lines(share: float) -> float:
    """Stick width and loop of a wave at ``share`` of the pressure of full contact, sheared by half
    the limit of friction."""
    wave = make("mindlin-wave", E, 1e-9, 1e-6, 0.3)
    p = share * wave.normal.full_contact_pressure
    line, Q = make("mindlin-line", E, 1e-12 / (4.0 * np.pi**2 * 1e-9), 0.3), 0.15 * p
    answer = wave.at_pressure(p, Q)
    sticking = line.at_load(p * 1e-6, Q * 1e-6).stick_radius
    loop = line.cycle_dissipation(p * 1e-6, Q * 1e-6)
    return max(apart(answer.stick_half_width, sticking), apart(1e-6 * answer.dissipation, loop))


def much_friction(friction: float) -> float:
    """Load of a sphere with ``friction`` beside that without slip."""
    ball = make("frictional-indenter", E, 0.5 / R, 2.0, 0.25, friction)
    return apart(ball.load_gain, make("sticking-indenter", E, 0.5 / R, 2.0, 0.25).load_gain)


def stuck_without_coupling(_: float) -> float:
    """Pressure under a cylinder that sticks on bodies without coupling."""
    one, other = make("sticking-indenter-line", E, 0.5 / R, 2.0, 0.0), make("hertz-line", E, R)
    x = np.linspace(0.0, 0.99, 7) * float(other.at_load(1.0).radius)
    return apart(one.pressure(x, 1.0), other.pressure(x, 1.0))


def first_twist(share: float) -> float:
    """Stiffness of a twisted sphere at a ``share`` of the largest torque beside that of a disc
    without slip."""
    ball = make("lubkin", E, R, 0.4 * E, 0.3)
    answer = ball.at_load(1e-6, share * ball.largest_torque(1e-6))
    return apart(answer.stiffness, make("sticking-twist", 0.4 * E, float(answer.normal.radius)).stiffness)


def small_creepage(creepage: float) -> float:
    """Longitudinal force of a wheel at ``creepage`` beside that of the linear theory."""
    wheel = (6e-3, 6e-3, 80e9, 0.25)
    linear = make("kalker-linear", *wheel).at_creepage(creepage)
    return apart(make("shen-hedrick-elkins", *wheel, 1e5, 0.3).at_creepage(creepage).force_x, linear.force_x)


def fine_strips(cells: float) -> float:
    """Lateral force of small spin from ``cells`` strips beside that of the linear theory."""
    wheel = (6e-3, 4e-3, 80e9, 0.25)
    linear = make("kalker-linear", *wheel).at_creepage(0.0, 0.0, 1e-7)
    found = make("fastsim", *wheel, 1e5, 0.3).at_creepage(0.0, 0.0, 1e-7, cells=int(cells))
    return apart(found.force_y, linear.force_y)


def first_creepage(share: float) -> float:
    """Creepage of rolling cylinders per ``share`` Q/μP of traction beside μa/2R."""
    roller = make("carter", E, R, 0.3)
    answer = roller.at_load(1.0, share * 0.3)
    return apart(answer.creepage, 0.15 * share * answer.normal.radius / R)


def first_stiffness(_: float) -> float:
    """Tangential over normal stiffness before any slip: 2(1 - ν)/(2 - ν) for equal bodies of ν =
    0.3."""
    shear = E * (1.0 - 0.3)
    theory = make("mindlin", E, R, th.tangential_modulus(shear, 0.3, shear, 0.3), 0.3)
    ratio = theory.at_load(1e-6, 0.0).stiffness / theory.normal.at_load(1e-6).stiffness
    # E* = G/(1 - ν) for a pair of equal bodies
    return apart(ratio, 2.0 * 0.7 / 1.7 * shear / (E * 0.7))


def maugis_like(name: str, attraction: float) -> float:
    """Contact radius and approach at three loads."""
    near, limit = make("maugis-dugdale", E, R, W, attraction).at_load(LOADS), make(name, E, R, W).at_load(LOADS)
    return max(apart(near.radius, limit.radius), apart(near.approach, limit.approach))


def pull_off_like_jkr(deviation: float) -> float:
    """Pull-off of summits of nearly equal heights, at a/a_c = 9^(1/3) of each."""
    theory = make("fuller-tabor", E, 1e12, R, deviation, W)
    return apart(-theory.pull_off()[1], -1e12 * theory.sphere.pull_off * load_ratio(np.array(9.0 ** (1.0 / 3.0))))


def gw_like_identical(deviation: float) -> float:
    """Pressure and area of summits whose heights vary by ``deviation`` around 1 µm, pressed by 38
    pm."""
    h = np.array([1e-6 - 38e-12])
    nearly = make("greenwood-williamson", E, 1e12, R, deviation, 1e-6).at_separation(h)
    equal = make("identical-asperities", E, 1e12, R, 1e-6).at_separation(h)
    return max(apart(nearly.pressure, equal.pressure), apart(nearly.area_fraction, equal.area_fraction))


def solved_sphere(pixels: float) -> float:
    """Peak pressure and approach of a paraboloid on a grid of 2.4 contact radii."""
    answer = make("hertz", 1.0, 1.0).at_radius(1.0)
    surface = asp.generate.sphere(square_grid(int(pixels), 2.4), radius=1.0)
    problem = asp.ContactProblem(surface, elastic(1.0), boundary=asp.Free())
    result = asp.solve(problem, asp.Force(float(answer.load)), solver=TIGHT)
    return max(apart(result.max_pressure, answer.max_pressure), apart(result.approach, answer.approach))


def solved_wave(points: float) -> float:
    """Peak pressure and approach at 0.4 of the pressure of full contact."""
    wave = make("westergaard", 1.0, 0.01, 1.0)
    grid = asp.Grid((int(points), 1), (1.0 / points, 1.0 / points))
    surface = asp.generate.sinusoid(grid, amplitude=0.01, wavelength=1.0)
    p = 0.4 * wave.full_contact_pressure
    result = asp.solve(asp.ContactProblem(surface, elastic(1.0)), asp.MeanPressure(p), solver=TIGHT)
    return max(apart(result.max_pressure, wave.max_pressure(p)), apart(result.approach, wave.approach(p)))


def solved_punch(pixels: float) -> float:
    """Force at an approach of a tenth of the radius, on a grid of 2.4 radii."""
    surface = asp.generate.flat_punch(square_grid(int(pixels), 2.4), radius=1.0, depth=10.0)
    problem = asp.ContactProblem(surface, elastic(1.0), boundary=asp.Free())
    result = asp.solve(problem, asp.Approach(0.1), solver=TIGHT)
    return apart(result.force, make("flat-punch", 1.0, 1.0).at_approach(0.1).load)


SINGLE_CONTACTS = (
    Agreement(
        "hertz-ellipse",
        "hertz-line",
        "ratio of the radii to infinity",
        like_a_line,
        (1e2, 1e4, 1e8),
        1e-6,
        "(b/a)², about the inverse of the ratio, times a logarithm",
    ),
    Agreement(
        "power-law-indenter",
        "flat-punch",
        "exponent to infinity",
        like_a_punch,
        (10.0, 1e3, 1e5),
        1.1e-5,
        "P = 2n/(n + 1) E*aδ",
    ),
    Agreement("line-power-law-indenter", "hertz-line", "exponent 2", like_a_cylinder, (), ROUNDING, "the same profile"),
    Agreement(
        "westergaard",
        "hertz-line",
        "light load",
        wave_like_lines,
        (1e-2, 1e-4, 1e-6),
        1e-6,
        "arcsin departs from its argument by its square over 6, the load over that of full contact over 6",
    ),
    Agreement("mindlin", "Coulomb's law", "force at the limit", like_coulomb, (), ROUNDING, "no stick zone is left"),
    Agreement(
        "mindlin",
        "2 (1 - nu)/(2 - nu)",
        "initial tangential over normal stiffness, equal bodies",
        first_stiffness,
        (),
        ROUNDING,
        "no slip yet",
    ),
    Agreement(
        "mindlin-wave",
        "mindlin-line",
        "light load: stick zone and loop at half the limit of friction",
        slipping_wave_like_lines,
        (1e-2, 1e-4, 1e-6),
        1e-6,
        "arcsin departs from its argument by its square over 6, the load over that of full contact over 6",
    ),
    Agreement(
        "frictional-indenter",
        "sticking-indenter",
        "friction to infinity",
        much_friction,
        (0.3, 1.0),
        1e-4,
        "the slipping annulus takes 4e-5 of the load at μ = 1, β = 0.25",
    ),
    Agreement(
        "sticking-indenter-line",
        "hertz-line",
        "exponent 2, no coupling",
        stuck_without_coupling,
        (),
        ROUNDING,
        "the same contact",
    ),
    Agreement(
        "lubkin",
        "sticking-twist",
        "vanishing torque: stiffness",
        first_twist,
        (1e-2, 1e-4, 1e-6),
        2e-3,
        "the slipping rim goes as the root of the torque",
    ),
    Agreement(
        "carter",
        "mu a Q/(2 mu P R)",
        "vanishing traction",
        first_creepage,
        (1e-2, 1e-4, 1e-6),
        1e-6,
        "1 - sqrt(1 - s) is s/2 but for s/4 of it",
    ),
    Agreement(
        "shen-hedrick-elkins",
        "kalker-linear",
        "vanishing creepage",
        small_creepage,
        (1e-5, 1e-7, 1e-9),
        1e-6,
        "a third of the linear force over the limit of friction",
    ),
    Agreement(
        "fastsim",
        "kalker-linear",
        "vanishing spin, number of strips to infinity",
        fine_strips,
        (15.0, 60.0, 240.0),
        1e-4,
        "midpoint rules: 1/cells² with a factor of about one",
    ),
    Agreement(
        "maugis-dugdale",
        "jkr",
        "attraction to infinity",
        lambda attraction: maugis_like("jkr", attraction),
        (1e9, 1e10, 1e11),
        1e-5,
        "the width of the adhesive ring goes as 1/λ², 1e-7 at the last",
    ),
    Agreement(
        "maugis-dugdale",
        "dmt",
        "attraction to zero",
        lambda attraction: maugis_like("dmt", attraction),
        (1e4, 1e2, 1.0),
        1e-3,
        "the approach is off by 1.5 sqrt(λ), λ = 3e-8 at the last",
    ),
    Agreement(
        "fuller-tabor",
        "jkr",
        "deviation of heights to zero",
        pull_off_like_jkr,
        (1e-10, 1e-11, 1e-12),
        1e-5,
        "the load has a minimum there: second order in the deviation over the range of adhesion, 5e-4 at the last",
    ),
    Agreement(
        "greenwood-williamson",
        "identical-asperities",
        "deviation of heights to zero",
        gw_like_identical,
        (1e-11, 4e-12, 1e-12),
        3e-4,
        "(3/8)(deviation over approach)² of the load",
    ),
    Agreement(
        "hertz",
        "solver (free)",
        "pixels to infinity",
        solved_sphere,
        (24.0, 48.0, 96.0),
        5e-4,
        "of order 3/2 to 2 in the pixel, 0.025 of the radius at the last",
    ),
    Agreement(
        "westergaard",
        "solver (periodic)",
        "points to infinity",
        solved_wave,
        (32.0, 128.0, 512.0),
        2.4e-4,
        "of order 3/2 in the pixel, (2/512)^1.5 at the last",
    ),
    Agreement(
        "flat-punch",
        "solver (free)",
        "pixels to infinity",
        solved_punch,
        (48.0, 192.0),
        6.3e-3,
        "the rim is known to half a pixel",
    ),
)
