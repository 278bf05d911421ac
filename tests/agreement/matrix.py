"""The agreement matrix: which theories must agree, in which limit, to what tolerance. One row per
agreement.

Each row holds a function from the parameter of the limit to the largest relative difference; it is
evaluated at the values ``towards`` the limit. The difference at the last one must be within the
tolerance, and smaller than at the one before.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ndtri

import asperity as asp
from asperity.contact.solve import steps
from asperity.physics.adhesion.stickiness import stickiness
from asperity.theories import catalogue
from asperity.theories.protocol import ContactAnswer, Prediction
from asperity.theories.rough.persson import IsotropicSpectrum
from asperity.theories.rough.profile_peaks import SampledPeaks, peak_integral
from asperity.theories.single.hertz import ellipse_of_curvatures
from asperity.theories.statistics.heights import ExponentialHeights
from asperity.theories.statistics.nayak import NayakSummits
from asperity.theories.statistics.roughness import Roughness

E, R, SIGMA, ETA, AREA = 1e11, 1e-6, 1e-8, 1e12, 1e-11
"""Contact modulus (Pa), radius (m), height deviation (m), density (1/m²) and area (m²) of the
rows."""

ROUNDING = 1e-10
"""Of two computations of the same number: sums of positive terms and inversions to 1e-12, with a
margin."""


@dataclass(frozen=True)
class Agreement:
    """One row.

    ``theory`` and ``other`` names in the catalogue, or words for what is not a theory of its own;
    ``limit`` in words; ``difference`` and ``towards`` see above, an empty tuple for theories that
    must agree everywhere; ``reason`` where the tolerance comes from.
    """

    theory: str
    other: str
    limit: str
    difference: Callable[[float], float]
    towards: tuple[float, ...]
    tolerance: float
    reason: str


def make(name: str, *args: object, **choices: object):
    """The theory called ``name``."""
    return catalogue.theory(name)(*args, **choices)


def apart(found: ArrayLike, expected: ArrayLike) -> float:
    """Largest relative difference."""
    return float(np.max(np.abs(np.asarray(found) / np.asarray(expected) - 1.0)))


def curves_apart(found: Prediction, expected: Prediction) -> float:
    """Largest relative difference of pressure, area and number of contacts."""
    names = ("pressure", "area_fraction", "contact_density")
    return max(apart(getattr(found, name), getattr(expected, name)) for name in names)


def contacts_apart(found: ContactAnswer, expected: ContactAnswer) -> float:
    """Largest relative difference of the approach and the area of single contacts."""
    return max(apart(found.approach, expected.approach), apart(found.area, expected.area))


SEPARATIONS = np.array([-1.0, 0.0, 1.0, 2.0, 3.0]) * SIGMA
LOADS = np.array([1e-9, 1e-7, 1e-5])
GW = make("greenwood-williamson", E, ETA, R, SIGMA)
HERTZ = make("hertz", E, R)


def like_gw(name: str, *args: object, **choices: object) -> float:
    """Difference of a theory on the same summits from Greenwood and Williamson's."""
    theory = make(name, E, ETA, R, SIGMA, *args, **choices)
    return curves_apart(theory.at_separation(SEPARATIONS), GW.at_separation(SEPARATIONS))


def like_hertz(name: str, *args: object) -> float:
    """Difference of a single contact from Hertz's."""
    return contacts_apart(make(name, E, R, *args).at_load(LOADS), HERTZ.at_load(LOADS))


def adhesive_paraboloid(_: float) -> float:
    """JKR's power law of exponent 2 against JKR's sphere."""
    shape, sphere = make("jkr-power-law", E, 0.5 / R, 2.0, 0.05), make("jkr", E, R, 0.05)
    radii = R * np.array([1e-3, 3e-3, 1e-2])
    found, expected = shape.at_radius(radii), sphere.at_radius(radii)
    return max(
        *(apart(getattr(found, name), getattr(expected, name)) for name in ("load", "approach", "stiffness")),
        apart(shape.pull_off, sphere.pull_off),
    )


def adhesive_cone(work: float) -> float:
    """Adhesive cone against the one without adhesion, at a contact radius of R/10."""
    found, expected = make("jkr-power-law", E, 0.1, 1.0, work), make("power-law-indenter", E, 0.1, 1.0)
    return contacts_apart(found.at_radius([0.1 * R]), expected.at_radius([0.1 * R]))


def adhesive_cylinder(work: float) -> float:
    """Load of an adhesive cylinder against the one without adhesion, at a half-width of R/10."""
    found, expected = make("jkr-cylinder", E, R, work), make("hertz-line", E, R)
    return apart(found.at_half_width([0.1 * R]).load, expected.at_half_width([0.1 * R]).load)


COATED = {"thickness": 1e-5, "radius": 1e-4, "work": 2.0, "coating_nu": 0.25, "base_nu": 0.3}
"""An adhesive sphere on a coating of a tenth of its radius."""


def equal_coating(_: float) -> float:
    """Coating and base of the same solid against JKR's sphere."""
    coated = make("jkr-coated-sphere", 1e6, 1e6, **COATED | {"base_nu": 0.25})
    sphere = make("jkr", 1e6 / (1.0 - 0.25**2), 1e-4, 2.0)
    found, expected = (theory.at_radius(1e-4 * np.array([0.1, 0.3, 0.5])) for theory in (coated, sphere))
    return max(contacts_apart(found, expected), apart(found.load, expected.load), apart(coated.pull_off_ratio, 1.0))


def coated_pull_off(thickness: float) -> float:
    """Pull-off from a coating ten times as stiff as the base against 1.5πwR, that from either
    alone."""
    return apart(make("jkr-coated-sphere", 1e7, 1e6, **COATED | {"thickness": thickness}).pull_off_ratio, 1.0)


def coating_on_a_grid(points: float) -> float:
    """Pull-off from a coating four times softer than the base on a grid, with adhesion without
    range."""
    solids = {"coating_nu": 0.3, "base_nu": 0.3, "thickness": 0.5, "radius": 1.0, "work": 0.02}
    theory = make("jkr-coated-sphere", 0.25, 1.0, **solids)
    pixel = 1.8 / points
    x = (np.arange(int(points)) - 0.5 * (points - 1.0)) * pixel
    body = asp.Layered([asp.Layer(asp.Elastic(0.25, 0.3), 0.5)], asp.Elastic(1.0, 0.3))
    surface = asp.Surface(-0.5 * (x[:, None] ** 2 + x[None, :] ** 2), pixel)
    problem = asp.ContactProblem(surface, body, boundary=asp.Free(), adhesion=asp.adhesion.JKRAdhesion(0.02))
    approach = float(theory.at_radius(theory.pull_off_radius).approach)
    steps = approach + abs(approach) * np.array([1.5, 0.6, 0.3, 0.15, 0.0, -0.1, -0.2, -0.3, -0.4, -0.5])
    found = asp.solve(problem, asp.History([asp.FixedGrips(float(step)) for step in steps]))
    return apart(-found.external_force.min(), theory.pull_off)


def rough_and_attractive(share: float) -> float:
    """Mean pressure over E* at which a twentieth of a rough map touches, of an attraction whose
    number is ``share`` of the limit of stickiness."""
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(0.1), hurst=0.8, rolloff_wavelength=96.0, shortest_wavelength=12.0
    )
    surface, body = asp.generate.gaussian(asp.Grid((192, 192), (1.0, 1.0)), spectrum, seed=2), asp.Elastic(0.91, 0.3)
    unit = asp.ContactProblem(surface, body, adhesion=asp.adhesion.DugdaleAdhesion(1.0, 0.25, 1.0))
    law = asp.adhesion.DugdaleAdhesion(stickiness(unit).share_of_limit / share, 0.25, 1.0)
    deepest = 0.7 * float(surface.heights.max() - surface.heights.mean())
    loads = [asp.FixedGrips(float(approach)) for approach in np.linspace(0.0, deepest, 8)]
    areas, forces = [], []
    for step in steps(asp.ContactProblem(surface, body, adhesion=law), loads):
        areas.append(step.area_fraction)
        forces.append(step.external_force)
        if step.area_fraction > 0.05:
            return float(np.interp(0.05, areas, forces)) / surface.grid.area
    raise AssertionError("the area stays below a twentieth")


def stickiness_of_a_map(_: float) -> float:
    """Share of the limit at which that pressure changes its sign, tensile below and compressive
    above, against 1."""
    shares = np.array([1.0, 2.0, 4.0])
    pressure = np.array([rough_and_attractive(share) for share in shares])
    assert pressure[0] < 0.0 < pressure[-1]
    assert (np.diff(pressure) > 0.0).all()
    return apart(np.exp(np.interp(0.0, pressure, np.log(shares))), 1.0)


def adhesive_wave(work: float) -> float:
    """Adhesive wave against Westergaard's, at contact fractions of 0.2 to 0.8."""
    found, expected = make("jkr-wave", E, 1e-8, 1e-5, work), make("westergaard", E, 1e-8, 1e-5)
    answer, shares = found.at_fraction([0.2, 0.5, 0.8]), [0.2, 0.5, 0.8]
    return apart(expected.area_fraction(answer.mean_pressure), shares)


def full_contact_of_a_wave(_: float) -> float:
    """Work left by full contact of one wave against the work of adhesion less that of pressing the
    wave flat."""
    amplitude, length, work = 1e-8, 1e-5, 0.5
    wave = make("westergaard", E, amplitude, length)
    pressure = wave.full_contact_pressure * np.linspace(0.0, 1.0, 100_001) ** 2
    approach = wave.approach(pressure)
    pressed = float((0.5 * (pressure[1:] + pressure[:-1]) * np.diff(approach)).sum())
    energy = E * 2.0 * np.pi / length * amplitude**2 / 8.0
    return apart(make("persson-tosatti", work, energy).effective_work, work - pressed)


def quantile_summits(count: float) -> float:
    """Summits at the quantiles of a Gaussian against the Gaussian."""
    heights = SIGMA * ndtri((np.arange(int(count)) + 0.5) / int(count))
    discrete = make("discrete-summits", E, heights, np.full(int(count), R), count / ETA)
    h = SEPARATIONS[:4]
    return apart(discrete.at_separation(h).pressure, GW.at_separation(h).pressure)


def crests(stretch: float = 1.0, depth: float = 1e-8, **choices: object):
    """Thirty crests of radius R at random places on the square of AREA, stretched."""
    rng = np.random.default_rng(4)
    x, y = math.sqrt(AREA) * stretch * rng.random((2, 30))
    wavelength = math.pi * math.sqrt(2.0 * R * depth)
    return make(
        "interacting-crests",
        E,
        x,
        y,
        3e-9 * rng.standard_normal(30),
        np.full(30, depth),
        np.full(30, wavelength),
        AREA,
        **choices,
    )


def spheres():
    """The same crests as spheres without interaction."""
    theory = crests()
    return make("discrete-summits", E, theory.height, np.full(30, R), AREA)


def crests_apart(found, expected, depths: ArrayLike = (1e-10, 1e-9, 3e-9)) -> float:
    """Difference of two theories of crests at the same approaches."""
    h = found.highest - np.asarray(depths)
    return curves_apart(found.at_separation(h), expected.at_separation(h))


def gaussian(name: str, alpha: float):
    """A theory of a Gaussian surface with m0 = m2 = 1 and this bandwidth."""
    return make(name, 1.0, 1.0, 1.0, alpha)


def kappa(theory, D: float) -> float:
    """A_r E* h'_rms/p at the separation D of a surface with m0 = m2 = 1."""
    found = theory.at_separation(D)
    return float((found.area_fraction * math.sqrt(2.0) / found.pressure)[0])


RELAXED, STEP, TIME = 2e6, 2e7, 1e-4
"""Relaxed modulus and what relaxes (Pa), and the time (s) of a standard linear solid that
slides."""


def sliding_area(speed: float, modulus: float) -> float:
    """Area of the rubber at ``speed`` (m/s) against that of an elastic half-space of this
    ``modulus``."""
    q, psd = np.array([1e4, 1e5, 1e6]), np.array([1e-18, 1e-20, 1e-24])
    found = make("persson-friction", RELAXED, [STEP], [TIME], q, psd).at_speed([speed], 1e5).area_fraction
    spectrum = IsotropicSpectrum(q, psd)
    gradient = math.sqrt(float(spectrum.partial_moment(3, spectrum.span[-1:])[0]) / (2.0 * math.pi))
    return apart(found, make("persson", modulus, gradient).at_pressure([1e5]).area_fraction)


def area_at_equal_load(name: str, other: str, alpha: float, separations: ArrayLike) -> float:
    """Difference of the areas of two theories of a Gaussian surface at the loads of the second."""
    expected = gaussian(other, alpha).at_separation(separations)
    return apart(gaussian(name, alpha).at_pressure(expected.pressure).area_fraction, expected.area_fraction)


def elliptic_summit(ratio: float) -> float:
    """The elliptical contacts of Bush, Gibson and Thomas against Hertz's ellipse: area and load at
    one approach."""
    shape, mean = ellipse_of_curvatures(ratio), 0.5 * (1.0 + 1.0 / ratio) / R
    found = make("hertz-ellipse", E, R, ratio * R).at_load(1e-6)
    area = math.pi * found.approach / mean * shape.area
    load = 4.0 / 3.0 * E * found.approach**1.5 / math.sqrt(mean) * shape.load
    return max(apart(area, found.area), apart(load, 1e-6))


def exponential_pairs(_: float) -> float:
    """An exponential forgets: misaligned pairs of summits carry like single ones of the relative
    radius."""
    pairs, single = (
        make(name, E, ETA, radius, SIGMA, heights=ExponentialHeights())
        for name, radius in (("greenwood-tripp", R), ("greenwood-williamson", 0.5 * R))
    )
    h = np.array([0.0, 1.0, 3.0]) * SIGMA
    return apart(pairs.at_separation(h).mean_real_pressure, single.at_separation(h).mean_real_pressure)


def independent_peaks(_: float) -> float:
    """All peaks of independent ordinates: their number, mean height and mean curvature."""
    peaks, D = SampledPeaks(0.0, 0.0), -9.0
    height, curvature = D + peak_integral(D, 1.0, 0.0), peak_integral(D, 0.0, -1.0)
    return max(
        apart(height, peaks.mean_height), apart(curvature, peaks.mean_curvature), apart(peak_integral(D, 0.0, 0.0), 1.0)
    )


def all_summits(name: str) -> float:
    """Number of contacts where every summit touches against Nayak's density."""
    found = gaussian(name, 3.0).at_separation(-11.0)
    return apart(found.contact_density, NayakSummits(1.0, 1.0, 3.0).density)


def equal_crests(_: float) -> float:
    """Summits that are all equal."""
    h = np.array([-1e-10, -1e-9])
    discrete = make("discrete-summits", E, np.zeros(10), np.full(10, R), AREA)
    return curves_apart(make("identical-asperities", E, 10 / AREA, R).at_separation(h), discrete.at_separation(h))


def all_plastic(pressure: float) -> float:
    """Fractal spots at light load are all plastic."""
    theory = make("majumdar-bhushan", 1.5, 1e-9, E, 8e9, 1e-8)
    return apart(theory.at_pressure(pressure).area_fraction, pressure / 8e9)


def fits_of_table_1(_: float) -> float:
    """The fitted area between P_a = 1e-6 and 0.1."""
    pressure = GW.pressure_unit * np.geomspace(1e-6, 0.1, 40)
    fitted = make("greenwood-williamson-fits", E, ETA, R, SIGMA)
    return apart(fitted.at_pressure(pressure).area_fraction, GW.at_pressure(pressure).area_fraction)


def shared_roughness(_: float) -> float:
    """Two surfaces that share a roughness against one that has it all, at real areas of 1e-5 to
    1e-2."""
    roughness = Roughness(SIGMA**2, 1e-3, 1e13 * 5.0)
    one, two = (catalogue.theory(name).from_roughness(roughness, E) for name in ("mccool", "greenwood-tripp"))
    pressure = E * math.sqrt(2e-3) * np.geomspace(1e-5, 1e-2, 10)
    return apart(two.at_pressure(pressure).area_fraction, one.at_pressure(pressure).area_fraction)


def persson_and_summits(D: float) -> float:
    """Persson's area over that of all summits at vanishing load: 2/π."""
    summits = gaussian("bush-gibson-thomas", 1.6).at_separation(D)
    area = make("persson", 1.0, math.sqrt(2.0)).at_pressure(summits.pressure).area_fraction
    return apart(area / summits.area_fraction, 2.0 / math.pi)


MATRIX: tuple[Agreement, ...] = (
    Agreement(
        "discrete-summits",
        "greenwood-williamson",
        "summits at the quantiles of a Gaussian, number to infinity",
        quantile_summits,
        (1e2, 1e3, 1e4),
        5e-3,
        "the last cell of the midpoint rule holds 1e-4 of the summits, those with the highest loads, at D = 2",
    ),
    Agreement(
        "discrete-summits",
        "hertz",
        "one summit",
        lambda _: apart(
            make("discrete-summits", E, [0.0], [R], AREA).at_pressure(LOADS / AREA).separation,
            -HERTZ.at_load(LOADS).approach,
        ),
        (),
        ROUNDING,
        "the same contact",
    ),
    Agreement(
        "discrete-summits", "identical-asperities", "equal summits", equal_crests, (), ROUNDING, "the same contacts"
    ),
    Agreement(
        "interacting-crests",
        "discrete-summits",
        "paraboloids, interaction off",
        lambda _: crests_apart(crests(interaction="off", shape="paraboloid"), spheres()),
        (),
        ROUNDING,
        "the same contacts",
    ),
    Agreement(
        "interacting-crests",
        "discrete-summits",
        "paraboloids far apart",
        lambda stretch: crests_apart(crests(stretch, shape="paraboloid"), spheres()),
        (1e2, 1e4, 1e6),
        1e-6,
        "displacements fall as the reciprocal of the distance: 0.1 at distance 1",
    ),
    Agreement(
        "interacting-crests",
        "discrete-summits",
        "deep sines, interaction off",
        lambda depth: crests_apart(crests(1.0, depth, interaction="off"), spheres()),
        (1e-8, 1e-6, 1e-4),
        1e-5,
        "the fourth-order term is a share of 3e-9 m over the depth",
    ),
    Agreement(
        "interacting-crests",
        "its least squares",
        "always",
        lambda _: crests_apart(crests(method="least squares"), crests()),
        (),
        1e-9,
        "the optimiser stops at 1e-13 of the residual",
    ),
    Agreement(
        "sinusoidal-asperity",
        "hertz",
        "deep sines",
        lambda depth: contacts_apart(
            make("sinusoidal-asperity", E, depth, math.pi * math.sqrt(2.0 * R * depth)).at_load(LOADS[:2]),
            HERTZ.at_load(LOADS[:2]),
        ),
        (1e-8, 1e-6, 1e-4),
        1e-6,
        "the fourth-order term is a share of the approach, 1e-9 m, over the depth",
    ),
    Agreement(
        "greenwood-williamson-fits",
        "greenwood-williamson",
        "1e-6 < P_a < 0.1",
        fits_of_table_1,
        (),
        0.0615,
        "the largest error of the fitted area",
    ),
    Agreement(
        "greenwood-tripp",
        "greenwood-williamson",
        "exponential heights: mean real pressure",
        exponential_pairs,
        (),
        ROUNDING,
        "for exponential heights misalignment only rescales the number of contacts",
    ),
    Agreement(
        "greenwood-tripp",
        "mccool",
        "one roughness, shared or not",
        shared_roughness,
        (),
        0.13,
        "misaligned pairs act like a modified distribution of heights",
    ),
    Agreement(
        "kotwal-bhushan",
        "greenwood-williamson",
        "skewness 0, kurtosis 3",
        lambda _: like_gw("kotwal-bhushan", skewness=0.0, kurtosis=3.0),
        (),
        ROUNDING,
        "the normal member of Pearson's system",
    ),
    Agreement(
        "chang-etsion-bogy",
        "greenwood-williamson",
        "hardness above every contact pressure",
        lambda H: like_gw("chang-etsion-bogy", H),
        (5e9, 1e12),
        ROUNDING,
        "elastic below first yield",
    ),
    Agreement(
        "kogut-etsion",
        "greenwood-williamson",
        "hardness above every contact pressure",
        lambda H: like_gw("kogut-etsion", H),
        (5e9, 1e12),
        ROUNDING,
        "elastic below first yield",
    ),
    Agreement(
        "jackson-green",
        "greenwood-williamson",
        "yield stress above every contact pressure",
        lambda Y: like_gw("jackson-green", Y),
        (2e9, 5e11),
        ROUNDING,
        "elastic below first yield",
    ),
    Agreement(
        "fuller-tabor",
        "greenwood-williamson",
        "work of adhesion to zero",
        lambda work: like_gw("fuller-tabor", work),
        (1e-3, 1e-5, 1e-7),
        1e-3,
        "the extension at pull-off over the height deviation goes as the work to the power 2/3",
    ),
    Agreement(
        "mccool",
        "bush-gibson-thomas",
        "alpha = 10, 0 <= h/sqrt(m0) <= 3: area at equal load",
        lambda alpha: area_at_equal_load("mccool", "bush-gibson-thomas", alpha, [0.0, 1.0, 2.0, 3.0]),
        (10.0,),
        0.12,
        "Nayak's highest summits are sharper than his mean",
    ),
    Agreement(
        "mccool",
        "Nayak's summits",
        "all summits touch",
        lambda _: all_summits("mccool"),
        (),
        ROUNDING,
        "the density of summits",
    ),
    Agreement(
        "bush-gibson-thomas",
        "Nayak's summits",
        "all summits touch",
        lambda _: all_summits("bush-gibson-thomas"),
        (),
        ROUNDING,
        "the density of summits",
    ),
    Agreement(
        "bush-gibson-thomas",
        "sqrt(2 pi)",
        "large separation",
        lambda D: apart(kappa(gaussian("bush-gibson-thomas", 1.6), D), math.sqrt(2.0 * math.pi)),
        (8.0, 16.0, 32.0),
        1e-3,
        "corrections go as 1/D²",
    ),
    Agreement(
        "bush-gibson-thomas",
        "hertz-ellipse",
        "one summit",
        lambda ratio: elliptic_summit(ratio),
        (3.0,),
        ROUNDING,
        "the same contact",
    ),
    Agreement(
        "greenwood-elliptic",
        "bush-gibson-thomas",
        "large separation: area at equal load",
        lambda D: area_at_equal_load("greenwood-elliptic", "bush-gibson-thomas", 2.0, D),
        (0.0, 8.0, 24.0),
        1e-3,
        "high summits are round: the difference goes as r², as 1/D²",
    ),
    Agreement(
        "anisotropic-summits",
        "bush-gibson-thomas",
        "isotropic, large separation",
        lambda D: curves_apart(
            make("anisotropic-summits", 1.0, 1.0, 1.0, 1.0).at_separation(D),
            gaussian("bush-gibson-thomas", 1.6).at_separation(D),
        ),
        (8.0, 16.0, 32.0),
        1e-3,
        "corrections go as 1/D²",
    ),
    Agreement(
        "persson-friction",
        "persson",
        "slow sliding: area of the relaxed half-space",
        lambda speed: sliding_area(speed, RELAXED),
        (1e-6, 1e-9),
        1e-6,
        "every wave then passes in more than the relaxation time; the modulus differs from the relaxed one by "
        "the square of its frequency times that",
    ),
    Agreement(
        "persson-friction",
        "persson",
        "fast sliding: area of the half-space of the first instant",
        lambda slowness: sliding_area(1.0 / slowness, RELAXED + STEP),
        (1e-6, 1e-9),
        1e-6,
        "every wave then passes in less than the relaxation time, but for directions across the motion",
    ),
    Agreement(
        "persson",
        "2/pi of all summits",
        "vanishing load",
        persson_and_summits,
        (4.0, 12.0, 32.0),
        1e-3,
        "sqrt(8/pi) over sqrt(2 pi); corrections of the summits go as 1/D²",
    ),
    Agreement(
        "persson",
        "sqrt(8/pi)",
        "vanishing load",
        lambda p: apart(make("persson", 1.0, 1.0).at_pressure(p).area_fraction / p, math.sqrt(8.0 / math.pi)),
        (1e-1, 1e-2, 1e-3),
        1e-6,
        "erf x differs from its slope by x²/3",
    ),
    Agreement(
        "onions-archard",
        "Whitehouse and Archard's peaks",
        "all peaks touch",
        independent_peaks,
        (),
        ROUNDING,
        "the same density of peaks",
    ),
    Agreement(
        "majumdar-bhushan",
        "p/H",
        "light load",
        all_plastic,
        (1e3,),
        ROUNDING,
        "spots below the critical area are plastic",
    ),
    Agreement(
        "hertz-ellipse",
        "hertz",
        "equal radii",
        lambda share: like_hertz("hertz-ellipse", R * (1.0 + share)),
        (1e-2, 1e-5),
        1e-5,
        "first order in the difference of the radii",
    ),
    Agreement(
        "jkr",
        "hertz",
        "work of adhesion to zero",
        lambda work: like_hertz("jkr", work),
        (1e-5, 1e-7, 1e-9),
        5e-3,
        "goes as the square root of wR over the load",
    ),
    Agreement(
        "dmt",
        "hertz",
        "work of adhesion to zero",
        lambda work: like_hertz("dmt", work),
        (1e-5, 1e-7, 1e-9),
        1e-5,
        "the adhesive load 2πwR over the load",
    ),
    Agreement(
        "jkr-power-law",
        "jkr",
        "exponent 2",
        adhesive_paraboloid,
        (),
        ROUNDING,
        "the same profile",
    ),
    Agreement(
        "jkr-power-law",
        "power-law-indenter",
        "work of adhesion to zero",
        adhesive_cone,
        (1e-5, 1e-7, 1e-9),
        5e-3,
        "goes as the square root of the work",
    ),
    Agreement(
        "jkr-cylinder",
        "hertz-line",
        "work of adhesion to zero",
        adhesive_cylinder,
        (1e-5, 1e-7, 1e-9),
        5e-3,
        "goes as the square root of the work",
    ),
    Agreement(
        "jkr-coated-sphere",
        "jkr",
        "coating and base of one solid",
        equal_coating,
        (),
        1e-8,
        "the same half-space; the place of the largest load is known to the root of the rounding",
    ),
    Agreement(
        "jkr-coated-sphere",
        "jkr",
        "thick stiff coating",
        coated_pull_off,
        (1e-4, 1e-3, 1e-2),
        1e-7,
        "pull-off; goes as the cube of the contact radius over the thickness",
    ),
    Agreement(
        "jkr-coated-sphere",
        "jkr",
        "thin stiff coating",
        coated_pull_off,
        (1e-5, 2e-6, 5e-7),
        0.02,
        "pull-off; about as the thickness over the contact radius, 1/78 at the last",
    ),
    Agreement(
        "jkr-coated-sphere",
        "adhesion without range on a grid",
        "soft coating, pixels to zero",
        coating_on_a_grid,
        (24.0, 48.0, 96.0),
        0.06,
        "pull-off; too large by 1.2 to 1.9 pixels over the contact radius, 33 pixels at the last",
    ),
    Agreement(
        "pastewka-robbins",
        "adhesive contact on a grid",
        "rough map: pressure at 5 % of area, tensile or not",
        stickiness_of_a_map,
        (),
        1.5,
        "a criterion of orders: d_att and d_rep are estimates, and κ_rep = 2; the sign changes at 2.0 of its limit",
    ),
    Agreement(
        "jkr-wave",
        "westergaard",
        "work of adhesion to zero",
        adhesive_wave,
        (1e-4, 1e-6, 1e-8),
        5e-3,
        "goes as the square root of the work",
    ),
    Agreement(
        "persson-tosatti",
        "westergaard",
        "one wave: work of pressing it flat",
        full_contact_of_a_wave,
        (),
        1e-9,
        "the elastic energy of full contact; trapezia of 1e5 steps",
    ),
    Agreement(
        "power-law-indenter",
        "hertz",
        "exponent 2",
        lambda _: contacts_apart(make("power-law-indenter", E, 0.5 / R, 2.0).at_load(LOADS), HERTZ.at_load(LOADS)),
        (),
        ROUNDING,
        "the same profile",
    ),
    Agreement(
        "rigid-sphere",
        "hertz",
        "light load",
        lambda load: contacts_apart(make("rigid-sphere", E, R).at_load(load), HERTZ.at_load(load)),
        (1e-5, 1e-8, 1e-11),
        1e-7,
        "the sphere deviates from its parabola by (a/R)²",
    ),
    Agreement(
        "chang-etsion-bogy-sphere",
        "hertz",
        "hardness above the contact pressure",
        lambda H: like_hertz("chang-etsion-bogy-sphere", H),
        (1e12,),
        ROUNDING,
        "elastic below first yield",
    ),
    Agreement(
        "kogut-etsion-sphere",
        "hertz",
        "hardness above the contact pressure",
        lambda H: like_hertz("kogut-etsion-sphere", H),
        (1e12,),
        ROUNDING,
        "elastic below first yield",
    ),
    Agreement(
        "jackson-green-sphere",
        "hertz",
        "yield stress above the contact pressure",
        lambda Y: like_hertz("jackson-green-sphere", Y),
        (5e11,),
        ROUNDING,
        "elastic below first yield",
    ),
)
"""All agreements."""
