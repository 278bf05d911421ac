"""Rows of the agreement matrix on summits that interact, anisotropic summits, two fractal
dimensions, full contact, and hardness at a rate."""

from __future__ import annotations

import numpy as np
from agreement.matrix import ETA, ROUNDING, SIGMA, Agreement, E, R, apart, curves_apart, make

import asperity as asp

PRESSURES = np.geomspace(1e5, 1e7, 5)
PLACES = np.random.default_rng(4).random((2, 12))
HEIGHTS = SIGMA * np.random.default_rng(5).standard_normal(12)


def summits_apart(distance: float) -> float:
    """Summits in squares of this side against the same that stand alone."""
    placed = make("interacting-summits", E, *(distance * PLACES), HEIGHTS, np.full(12, R), 1e-10)
    alone = make("discrete-summits", E, HEIGHTS, np.full(12, R), 1e-10)
    h = np.array([1.0, 0.0, -1.0]) * SIGMA
    return curves_apart(placed.at_separation(h), alone.at_separation(h))


def like_crests(radius: float) -> float:
    """Summits with displacements of point forces against paraboloidal crests."""
    depth = np.full(12, 1e-7)
    waves = np.pi * np.sqrt(2.0 * radius * depth)
    place = (*(3e-6 * PLACES), HEIGHTS)
    crests = make("interacting-crests", E, *place, depth, waves, 1e-10, shape="paraboloid")
    summits = make("interacting-summits", E, *place, np.full(12, radius), 1e-10, displacement="point")
    h = np.array([1.0, 0.0, -1.0]) * SIGMA
    return curves_apart(summits.at_separation(h), crests.at_separation(h))


def merged(distance: float) -> float:
    """Contacts that merge against those that do not, while none touch."""
    place = (*(distance * PLACES), HEIGHTS, np.full(12, R), 1e-10)
    h = np.array([1.0, 0.0, -1.0]) * SIGMA
    return curves_apart(
        make("merging-summits", E, *place).at_separation(h), make("interacting-summits", E, *place).at_separation(h)
    )


def small_patch(side: float) -> float:
    """Separation of a patch that sinks, in standard deviations from that of one that does not."""
    found = make("mean-field-summits", E, ETA, R, SIGMA, side).at_pressure(PRESSURES).separation
    alone = make("greenwood-williamson", E, ETA, R, SIGMA).at_pressure(PRESSURES).separation
    return float(np.abs(found - alone).max()) / SIGMA


def anisotropic(moments: tuple[float, ...], D: np.ndarray, other: object) -> float:
    """Differences of all summits of these moments from another theory at the separations ``D``."""
    return curves_apart(make("bush-gibson-keogh", 1.0, 1.0, *moments).at_separation(D), other.at_separation(D))


def isotropic_summits(alpha: float) -> float:
    """Against all summits of isotropic surfaces."""
    D = np.array([-1.0, 0.0, 1.0, 2.0, 4.0])
    return anisotropic((1.0, 1.0, alpha, alpha), D, make("bush-gibson-thomas", 1.0, 1.0, 1.0, alpha))


def high_anisotropic_summits(D: float) -> float:
    """Against the limit of high summits."""
    limit = make("anisotropic-summits", 1.0, 1.0, 1.0, 0.25)
    return anisotropic((1.0, 0.25, 2.0, 0.125), np.array([D]), limit)


def one_dimension(_: float) -> float:
    """Two equal fractal dimensions against one."""
    numbers = (1.4, 1e-12, E, 8e9, 1e-8)
    found, one = make("bifractal", *numbers, 1.4, 1e-6), make("majumdar-bhushan", *numbers)
    parts = ("pressure", "area_fraction", "elastic_area_share", "elastic_load_share")
    return max(apart(getattr(found.at_pressure(PRESSURES), p), getattr(one.at_pressure(PRESSURES), p)) for p in parts)


def below_the_crossover(crossover: float) -> float:
    """Areas of spots that are all smaller than the crossover against the theory of their
    dimension."""
    found = make("bifractal", 1.3, 1e-10, E, 8e9, 1e-8, 1.6, crossover)
    one = make("majumdar-bhushan", 1.6, found.fine_roughness, E, 8e9, 1e-8)
    return apart(found.at_pressure(1e6).area_fraction, one.at_pressure(1e6).area_fraction)


SPECTRUM = {"q": [1e6, 1e7, 1e8], "psd": [1e-30, 1e-33, 1e-36]}


def absorbed(_: float) -> float:
    """Area of full contact less what is under tension, twice, against Persson's."""
    full = make("full-contact", E, **SPECTRUM)
    p = full.spread * np.array([0.1, 0.5, 2.0])
    persson = make("persson", E, full.rms_gradient).at_pressure(p)
    return apart(1.0 - 2.0 * full.at_pressure(p).tension_share, persson.area_fraction)


def full_wave(_: float) -> float:
    """Field of full contact of a wave on a grid against its closed form."""
    wave = make("westergaard", 1e11, 1e-9, 1e-6)
    grid = asp.Grid((64, 4), (1e-6 / 64, 1e-6 / 64))
    surface = asp.generate.sinusoid(grid, amplitude=1e-9, wavelength=1e-6)
    found = asp.contact.full_contact(surface, asp.Elastic(1e11 * (1.0 - 0.3**2), 0.3), wave.full_contact_pressure)
    return apart(found.pressure.max(), 2.0 * wave.full_contact_pressure)


def slow_spots(sensitivity: float) -> float:
    """Hardness of a passing spot against that of slow loads, as the law becomes flat."""
    hard = make("rate-hardness", 8e9, "johnson-cook", sensitivity, 1.0)
    return apart(hard.at_speed([1.0], 1e-3).hardness, 8e9)


SUMMITS: tuple[Agreement, ...] = (
    Agreement(
        "interacting-summits",
        "discrete-summits",
        "distance to infinity",
        summits_apart,
        (1e-3, 1e-1, 10.0),
        1e-6,
        "displacements fall as the reciprocal of the distance",
    ),
    Agreement(
        "interacting-summits",
        "interacting-crests",
        "displacements of point forces",
        like_crests,
        (R,),
        ROUNDING,
        "the same equations",
    ),
    Agreement(
        "merging-summits",
        "interacting-summits",
        "contacts apart",
        merged,
        (1e-3,),
        ROUNDING,
        "nothing touches, so nothing merges",
    ),
    Agreement(
        "mean-field-summits",
        "greenwood-williamson",
        "side of the patch to zero",
        small_patch,
        (1e-5, 1e-8, 1e-11),
        1e-6,
        "0.95 of pressure times side over the modulus, 1e-15 m at the last",
    ),
    Agreement(
        "bush-gibson-keogh",
        "bush-gibson-thomas",
        "isotropic moments",
        isotropic_summits,
        (2.0,),
        1e-9,
        "quadratures and tables to 1e-11 of each other",
    ),
    Agreement(
        "bush-gibson-keogh",
        "anisotropic-summits",
        "large separation",
        high_anisotropic_summits,
        (8.0, 16.0, 32.0),
        5e-3,
        "corrections go as 1/D²",
    ),
    Agreement(
        "bifractal",
        "majumdar-bhushan",
        "equal dimensions",
        one_dimension,
        (),
        ROUNDING,
        "the same spots on both sides of the crossover",
    ),
    Agreement(
        "bifractal",
        "majumdar-bhushan",
        "all spots below the crossover: finer dimension",
        below_the_crossover,
        (1e-3,),
        ROUNDING,
        "the coarse branch is empty",
    ),
    Agreement(
        "full-contact",
        "persson",
        "area that an absorbing boundary leaves",
        absorbed,
        (),
        ROUNDING,
        "the image of the Gaussian takes as much as is under tension",
    ),
    Agreement(
        "full-contact",
        "westergaard",
        "field of one wave: largest pressure",
        full_wave,
        (),
        ROUNDING,
        "the pressure of a wave is a wave",
    ),
    Agreement(
        "rate-hardness",
        "H of slow loads",
        "sensitivity to zero",
        slow_spots,
        (1e-3, 1e-6, 1e-9),
        1e-7,
        "a logarithm of 1e8 of the rates times the sensitivity",
    ),
)
"""Agreements."""
