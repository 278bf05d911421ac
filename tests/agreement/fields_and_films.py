"""Rows of the agreement matrix on stresses below the surface, on menisci, and on the design for the
least area."""

from __future__ import annotations

import numpy as np
from agreement.matrix import ETA, GW, ROUNDING, SIGMA, Agreement, E, R, apart, make

from asperity.core.tensor import StressTensor
from asperity.fem import Resolution, cylinder_track, line_load
from asperity.solids.elastic import Elastic
from asperity.theories.subsurface.hertz import hertz_normal
from asperity.theories.subsurface.shakedown import line_shakedown

LOAD, NU = 1e-6, 0.3
PRESSURES = np.geomspace(1e5, 1e7, 5)


def stresses_apart(found, expected) -> float:
    """Largest difference of the stresses below the axis over the largest of them."""
    parts = [(getattr(found.stress, name), getattr(expected.stress, name)) for name in ("xx", "yy", "zz", "xz")]
    scale = np.max(np.abs([expected for _, expected in parts]), axis=0)
    return float(np.max(np.abs([one - other for one, other in parts]) / scale))


def far_below(name: str, far: float) -> float:
    """Stresses ``far`` contact radii below a Hertz contact against those of its force at a point or
    on a line."""
    if name == "hertz-stress":
        depth = far * float(make("hertz", E, R).at_load(LOAD).radius)
        force = make("boussinesq", LOAD, E)
    else:
        depth = far * float(make("hertz-line", E, R).at_load(LOAD).radius)
        force = make("flamant", LOAD, E)
    return stresses_apart(make(name, E, R).at_depth([depth], LOAD, 0.3 * depth), force.at_depth([depth], 0.3 * depth))


def strip_far_below(far: float) -> float:
    """A strip against the forces on its middle line."""
    strip, line = make("strip", R, 1e6, E, NU, 5e5), make("flamant", 2.0 * R * 1e6, E, NU, 2.0 * R * 5e5)
    depth = far * R
    return stresses_apart(strip.at_depth([depth], 0.3 * depth), line.at_depth([depth], 0.3 * depth))


def dragged_far_below(far: float) -> float:
    """A sliding Hertz contact less its pressure against Cerruti's force."""
    depth = far * float(make("hertz", E, R).at_load(LOAD).radius)
    place = ([depth], LOAD, 0.3 * depth)
    both, pressed = make("hertz-stress", E, R, NU, 1.0).at_depth(*place), make("hertz-stress", E, R).at_depth(*place)
    force = make("cerruti", LOAD, E).at_depth([depth], 0.3 * depth)
    dragged = type(force)(both.stress + pressed.stress * -1.0, force.displacement)
    return stresses_apart(dragged, force)


def round_ellipse(off: float) -> float:
    """Stresses below an ellipse that is nearly a circle."""
    depths = float(make("hertz", E, R).at_load(LOAD).radius) * np.array([0.1, 0.5, 2.0])
    found = make("hertz-ellipse-stress", E, R, R * (1.0 + off)).at_depth(depths, LOAD)
    return stresses_apart(found, make("hertz-stress", E, R).at_depth(depths, LOAD))


def rolled_elements(across: float) -> float:
    """Shakedown limit from the elastic stresses of finite elements below the pressure of Hertz,
    which pass by along x, against the closed fields."""
    fine = Resolution(across=int(across), growth=1.3, depth=1.5, distance=200.0)
    track = cylinder_track(Elastic(1.0, NU), 1.0, (0.0, 0.0), plasticity=None, resolution=fine)
    push = line_load(track, 0.0, 1.0, 1.0)
    stress = track.response(track.carry(track.virgin(), push, 0.0 * push)).stress.mean(axis=1)
    x, z = (np.unique(track.mesh.points[:, axis]) for axis in (0, 1))
    rows = stress.reshape(len(x) - 1, len(z) - 1, 6).swapaxes(0, 1)[:, np.abs(x[1:] + x[:-1]) < 8.0]
    found = line_shakedown(StressTensor(*np.moveaxis(rows, -1, 0)), 1.0)
    return apart(found.limit, make("shakedown-line").peak_over_k)


def rolling_shear(_: float) -> float:
    """Bound of a rolling sphere against one over the largest shear stress σ_xz below the plane of
    symmetry."""
    x, z = np.linspace(0.5, 1.2, 701)[:, None], np.linspace(0.2, 0.6, 401)[None]
    stress = hertz_normal(x, np.zeros_like(x), z, 1.0, shear=1.0, nu=NU).stress
    return apart(make("shakedown").bound_over_k, 1.0 / np.abs(stress.xz).max())


def onset_of_yield(_: float) -> float:
    """Largest stress of von Mises on the axis at the load of first yield against the yield
    stress."""
    contact = make("hertz", E, R).at_load(LOAD)
    onset = make("first-yield", NU).at_friction([0.0])
    depth = float(onset.z[0]) * float(contact.radius)
    highest = make("hertz-stress", E, R, NU).at_depth([depth], LOAD).von_mises
    return apart(highest * onset.peak_over_Y, contact.max_pressure)


def dry_summits(tension: float) -> float:
    """Separation and area of summits in a film that hardly pulls."""
    found = make("statistical-meniscus", E, ETA, R, SIGMA, tension, 1e-9).at_pressure(PRESSURES).contact
    dry = GW.at_pressure(PRESSURES)
    return apart(found.area_fraction, dry.area_fraction)


def window_of_share(_: float) -> float:
    """Meniscus force of summits of the smallest roughness, over the share of the load that it may
    be."""
    worst = 0.0
    for share in (0.1, 0.3, 1.0):
        window = make("roughness-window", E, 1e10, 0.025, 1e-9, 0.1, 1e-6, share)
        smallest = float(window.at_radius([R]).smallest[0])
        summits = make("statistical-meniscus", E, 0.05 / (R * smallest), R, smallest, 0.025, 1e-9)
        worst = max(worst, apart(summits.at_pressure(0.1 / 1e-6).meniscus_pressure / 1e5, share))
    return worst


def caps_at_yield(_: float) -> float:
    """Mean pressure of Hertz under a cap over that of first yield, for caps at the least number."""
    caps = make("designed-caps", E, 1e10, 0.05, 0.025, 2e-9, 1.0)
    least = caps.at_radius([R]).least
    each = float(0.05 / least[0] + caps.of_count([R], [1.0]).meniscus_force[0])
    return apart(make("hertz", E, R).at_load(each).mean_pressure, 0.382 * 1e10)


def grown_menisci(hamaker: float) -> float:
    """Meniscus force long after contact, for films that are held ever more weakly."""
    numbers = (E, ETA, R, SIGMA, 0.025, 1e-9)
    grown = make("kinetic-meniscus", *numbers, 0.1, hamaker)
    late = 50.0 * grown.theory.growth.time_scale
    rest = make("statistical-meniscus", *numbers).at_pressure(1e6).meniscus_pressure
    return apart(grown.at_time([late], 1e6).meniscus_pressure, rest)


def low_meniscus(angle: float) -> float:
    """Force of ever lower exact menisci over that of a sphere that touches the film."""
    exact = make("exact-meniscus", R, 0.025, 0.3).at_filling_angle([angle]).force
    return apart(exact, make("film-meniscus", R, 0.025, 0.3, 1.0).at_gap([0.0]).force)


def condensed(_: float) -> float:
    """Height long after contact, times the curvature that is in equilibrium with the vapour."""
    grown = make("vapour-growth", R, 0.072, 1.8e-5, 0.9, 1e-9)
    kelvin = make("vapour-meniscus", 0.072, 1.8e-5).at_humidity([0.9]).kelvin_radius
    return apart(grown.at_time([1e4 * grown.settling]).height, 2.0 * kelvin)


def designed_area(_: float) -> float:
    """Area of the designed surface against Greenwood and Williamson's on that surface, for 1e-4 <=
    P_a <= 1e-2."""
    design = make("least-area", 8e9)
    ratio = float(design.at_modulus([E]).summit_ratio[0])
    surface = make("greenwood-williamson", E, ETA, SIGMA / ratio, SIGMA)
    pressures = surface.pressure_unit * np.geomspace(1e-4, 1e-2, 9)
    return apart(design.at_pressure(pressures).elastic, surface.at_pressure(pressures).area_fraction)


FIELDS_AND_FILMS: tuple[Agreement, ...] = (
    Agreement(
        "hertz-stress",
        "boussinesq",
        "far below",
        lambda far: far_below("hertz-stress", far),
        (10.0, 100.0, 1000.0),
        1e-5,
        "moments of the pressure count as the square of radius over depth, 1e-6 at the last",
    ),
    Agreement(
        "hertz-line-stress",
        "flamant",
        "far below",
        lambda far: far_below("hertz-line-stress", far),
        (10.0, 100.0, 1000.0),
        1e-5,
        "moments of the pressure count as the square of half-width over depth, 1e-6 at the last",
    ),
    Agreement(
        "hertz-stress",
        "cerruti",
        "far below, the part of friction",
        dragged_far_below,
        (10.0, 100.0, 1000.0),
        1e-5,
        "moments of the traction count as the square of radius over depth, 1e-6 at the last",
    ),
    Agreement(
        "strip",
        "flamant",
        "far below",
        strip_far_below,
        (10.0, 100.0, 1000.0),
        1e-5,
        "moments of the traction count as the square of half-width over depth, 1e-6 at the last",
    ),
    Agreement(
        "hertz-ellipse-stress",
        "hertz-stress",
        "equal radii",
        round_ellipse,
        (1e-2, 1e-4, 1e-6),
        1e-5,
        "first order in the difference of the radii",
    ),
    Agreement(
        "first-yield",
        "hertz-stress",
        "without friction, at the place of first yield",
        onset_of_yield,
        (),
        ROUNDING,
        "the same stresses; at a maximum an error of the position is of second order",
    ),
    Agreement(
        "shakedown-line",
        "4 k of Johnson (1962)",
        "pure rolling",
        lambda _: apart(make("shakedown-line").peak_over_k, 4.0),
        (),
        1e-7,
        "the place along the pass is known to 1/500 of the half-width, and the stress at a maximum to its square",
    ),
    Agreement(
        "shakedown-line",
        "k / friction at the surface",
        "friction above 0.367",
        lambda _: apart(make("shakedown-line", 0.5).peak_over_k, 2.0),
        (),
        1e-7,
        "the traction at the middle of the contact alternates with nothing; the golden section ends at 4e-9",
    ),
    Agreement(
        "shakedown-line",
        "elastic finite elements under a rolling load",
        "elements over the half-width to infinity",
        rolled_elements,
        (4.0, 8.0, 16.0),
        0.004,
        "second order in the element, 1/16² = 0.004 of the half-width squared at the last",
    ),
    Agreement(
        "shakedown",
        "4.68 k of Hearle, Ponter and Johnson (1985)",
        "pure rolling, from above",
        lambda _: apart(make("shakedown").bound_over_k, 4.68),
        (),
        0.0011,
        "their number has three digits",
    ),
    Agreement(
        "shakedown",
        "1/(largest shear stress along the pass)",
        "pure rolling, from above",
        rolling_shear,
        (),
        1e-3,
        "the shear alternates, so that no residual stress lowers it; places along the pass are 0.04 of the "
        "radius apart, the error is of second order",
    ),
    Agreement(
        "shakedown",
        "k / friction at the surface",
        "friction 1",
        lambda _: apart(make("shakedown", 1.0).peak_over_k, 1.0),
        (),
        1e-3,
        "the middle of the contact is a place of the search",
    ),
    Agreement(
        "statistical-meniscus",
        "greenwood-williamson",
        "surface tension to zero",
        dry_summits,
        (1e-2, 1e-4, 1e-6),
        1e-6,
        "the meniscus force of the summits in the film, at most 2πRγ(1 + cos θ)η = 13 Pa of which 2 % reach "
        "it, over 1e5 Pa",
    ),
    Agreement(
        "roughness-window",
        "statistical-meniscus",
        "at the smallest roughness",
        window_of_share,
        (),
        1e-9,
        "a root of the same balance, to 1e-14 of the logarithm of the roughness",
    ),
    Agreement(
        "designed-caps",
        "hertz",
        "least number of caps",
        caps_at_yield,
        (),
        ROUNDING,
        "caps are Hertz contacts at first yield",
    ),
    Agreement(
        "kinetic-meniscus",
        "statistical-meniscus",
        "long after contact, Hamaker constant to zero",
        grown_menisci,
        (1e-20, 1e-22, 1e-24),
        1e-6,
        "film thickness over meniscus height, which goes as the reciprocal of the Hamaker constant",
    ),
    Agreement(
        "exact-meniscus",
        "film-meniscus",
        "filling angle to zero",
        low_meniscus,
        (1e-2, 1e-3, 1e-4),
        1e-4,
        "the error of circular arcs goes as the root of height over radius, 0.3 to 0.4 times it: half of the filling "
        "angle",
    ),
    Agreement(
        "vapour-growth",
        "vapour-meniscus",
        "long after contact",
        condensed,
        (),
        ROUNDING,
        "the height in equilibrium is two Kelvin radii where both surfaces are wetted",
    ),
    Agreement(
        "least-area",
        "greenwood-williamson",
        "1e-4 < P_a < 1e-2",
        designed_area,
        (),
        0.1,
        "the factor 3.2 holds in the middle of this range of loads",
    ),
    Agreement(
        "cone",
        "power-law-indenter",
        "exponent 1",
        lambda _: apart(
            make("cone", E, 0.1).at_load(LOAD).approach, make("power-law-indenter", E, 0.1, 1.0).at_load(LOAD).approach
        ),
        (),
        ROUNDING,
        "the same profile",
    ),
)
"""More rows."""
