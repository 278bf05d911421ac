"""Rows of the agreement matrix: theories of gaps and of media of gaps, and the solver beside
them."""

from __future__ import annotations

import math

import numpy as np
from agreement.matrix import ROUNDING, Agreement, apart, make

from asperity.core.arrays import RealArray
from asperity.core.grid import Grid
from asperity.physics.sealing.factors import flow_factors
from asperity.physics.sealing.flow import flow_through
from asperity.physics.sealing.fluids import IdealGas
from asperity.theories.rough.persson import IsotropicSpectrum, PerssonGap
from asperity.theories.sealing.media import bruggeman

SIZES = {"viscosity": 1e-3, "width": 1e-2, "length": 1e-3}
DROPS = np.array([1e3, 1e5])


def from_side_to_side(gap: RealArray, length: float) -> float:
    """12 η Q/ΔP in m³ by the solver of a ``gap`` (n, m) of square cells between two sides."""
    step = length / gap.shape[0]
    return flow_through(gap, Grid(gap.shape, (step, step)), wraps=(False, True)).rate


def equal_ends(_: float) -> float:
    """A taper of two equal gaps."""
    even = make("parallel-gap", 1e-6, **SIZES).at_drop(DROPS).rate
    return apart(make("tapered-gap", 1e-6, 1e-6, **SIZES).at_drop(DROPS).rate, even)


def nearly_equal_radii(difference: float) -> float:
    """A flange of 1 m whose rim has this width."""
    ring = make("annular-gap", 1e-6, 1e-3, 1.0, 1.0 + difference).at_drop(DROPS).rate
    return apart(ring, make("parallel-gap", 1e-6, 1e-3, 2.0 * math.pi, difference).at_drop(DROPS).rate)


def slipping(_: float) -> float:
    """Air in an even gap, by the solver and as a theory."""
    gas, gap = IdealGas(1.8e-5, 6.8e-8), np.full((16, 8), 1e-6)
    flow = flow_through(gap, Grid(gap.shape, (1e-4, 1e-4)), wraps=(False, True))
    theory = make("parallel-gap", 1e-6, 1.8e-5, 8e-4, 1.6e-3, 6.8e-8)
    return apart(gas.leak(flow, 3e5, 1e5).rate, theory.at_inlet(3e5, 1e5).throughput)


def solved_taper(n: float) -> float:
    """A taper from 1 to 3 µm on n cells."""
    gap = np.tile(1e-6 + 2e-6 * (np.arange(int(n))[:, None] + 0.5) / n, (1, 2))
    theory = make("tapered-gap", 1e-6, 3e-6, 1e-3, 2e-3 / n, 1e-3)
    return apart(from_side_to_side(gap, 1e-3), theory.passing)


def solved_throat(n: float) -> float:
    """A throat under a cylinder of 1 mm on n cells, whose ends take 1e-7 of the pressure."""
    x = (np.arange(int(n))[:, None] + 0.5) / n - 0.5
    gap = np.tile(1e-7 + (6e-4 * x) ** 2 / 2e-3, (1, 2))
    return apart(from_side_to_side(gap, 6e-4), make("parabolic-throat", 1e-7, 1e-3, 1e-3, 1.2e-3 / n).passing)


def solved_scratch(n: float) -> float:
    """A scratch with n cells across."""
    y = 2.0 * (np.arange(int(n))[None] + 0.5) / n - 1.0
    gap = np.tile(1e-6 * (1.0 - y**2), (4, 1))
    theory = make("parabolic-channel", 1e-6, 1e-3, 1e-3, 4e-3 / n)
    return apart(from_side_to_side(gap, 4e-3 / n), theory.passing)


def solved_saddle(_: float) -> float:
    """A saddle on 128 x 128 cells against the middle of the bracket, whose half width is 1.4 %."""
    n = 128
    at = (np.arange(n) + 0.5) / n - 0.5
    gap = np.maximum(0.05 + at[:, None] ** 2 / 0.4 - at[None] ** 2 / 0.6, 0.0)
    found = make("saddle-throat", 0.05, 1.0 / 12.0, 0.2, 0.3).at_drop(1.0)
    middle = float(0.5 * (found.lower + found.upper))
    flow = flow_through(gap, Grid(gap.shape, (1.0 / n, 1.0 / n))).rate
    # what is before and behind the saddle resists, too, 1/(g³) over the rest of the axis
    return max(apart(flow, middle) - float((found.upper - found.lower) / (found.upper + found.lower)), 0.0)


def solved_grooves(n: float) -> float:
    """Flow factors of a wave of half the gap on n cells, along and across."""
    wave = 0.5 * np.cos(2.0 * np.pi * (np.arange(int(n)) + 0.5) / n)
    gap = np.tile(1.0 + wave[:, None], (1, 4))
    sigma = 0.5 / math.sqrt(2.0)
    found = flow_factors(gap, Grid(gap.shape, (1.0 / n, 1.0 / n)), sigma, separation=1.0)
    theory = make("grooved-gap", 0.5).at_mean_gap(1.0)
    solved = np.array([found.pressure_x[0], found.pressure_y[0], found.shear_x[0]])
    return apart(solved, np.array([theory.pressure_across[0], theory.pressure_along[0], theory.shear[0]]))


def flat_waves(share: float) -> float:
    """A wave of this share of the gap, which is to the square that of an isotropic surface
    turned."""
    theory = make("grooved-gap", share).at_mean_gap(1.0)
    return abs(float(0.5 * (theory.pressure_along[0] + theory.pressure_across[0])) / (1.0 - 0.75 * share**2) - 1.0)


def cut_off(share: float) -> float:
    """A wave whose crests are cut, the share by which the amplitude is above the gap."""
    first, second = make("grooved-gap", 1.0 + share).at_mean_gap(1.0), make("grooved-gap", 1.0).at_mean_gap(1.0)
    return apart(first.pressure_along, second.pressure_along)


def fitted_factors(ratio: float) -> float:
    """A Gaussian surface at H/σ with a correlation length of 10 pixels, computed and as fitted."""
    n = 256
    q = 2.0 * np.pi * np.hypot(np.fft.fftfreq(n)[:, None], np.fft.rfftfreq(n)[None])
    white = np.fft.rfft2(np.random.default_rng(11).standard_normal((n, n)))
    heights = np.fft.irfft2(white * np.exp(-((5.0 * q) ** 2) / 4.0), s=(n, n))
    heights = (heights - heights.mean()) / heights.std()
    found = flow_factors(np.maximum(ratio + heights, 0.0), Grid((n, n), (1.0, 1.0)), 1.0, separation=ratio)
    fitted = make("patir-cheng", 1.0).at_mean_gap(ratio)
    mean = 0.5 * float(found.pressure_x[0] + found.pressure_y[0])
    shear = 0.5 * float(found.shear_x[0] + found.shear_y[0])
    return max(abs(mean / float(fitted.pressure_along[0]) - 1.0), abs(shear / float(fitted.shear[0]) - 1.0))


def lognormal(deviation: float) -> float:
    """A lognormal gap by 401 gaps."""
    at = np.linspace(-8.0, 8.0, 401)
    return abs(make("effective-medium", np.exp(deviation * at), np.exp(-0.5 * at**2)).transmissivity - 1.0)


def even_medium(deviation: float) -> float:
    """Two gaps this little apart, by Bruggeman and on the mean gap of the cubes: K = <g³> (1 -
    var/2)."""
    medium = make("effective-medium", [1.0 - deviation, 1.0 + deviation])
    return abs(medium.transmissivity / math.sqrt((1.0 - deviation**2) ** 3) - 1.0)


def sparse_spots(covered: float) -> float:
    """Few spots in an even gap."""
    array = make("obstacle-array").at_covered(covered)
    return abs(float(array.closed) / bruggeman(np.array([1.0, 0.0]), np.array([1.0 - covered, covered])) - 1.0)


def solved_array(n: float) -> float:
    """A quarter of the area in one spot on n x n cells that repeat."""
    at = (np.arange(int(n)) + 0.5) / n - 0.5
    covered = at[:, None] ** 2 + at[None] ** 2 < 0.25 / np.pi
    gap = np.where(covered, 0.0, 1.0)
    flow = flow_through(gap, Grid(gap.shape, (1.0 / n, 1.0 / n)), wraps=(True, True), repeats=True)
    return apart(flow.transmissivity, make("obstacle-array").at_covered(float(covered.mean())).closed)


def mean_over_closings(nodes: float) -> float:
    """The mean gap as the mean of the gaps that leave contact while shorter waves are seen."""
    q, psd = np.array([1e4, 1e5, 1e7]), np.array([1e-22, 1e-22, 1e-29])
    spectrum, pressure = IsotropicSpectrum(q, psd), 3e5
    whole = math.erf(math.sqrt(4.0 * math.pi / spectrum.moment(3)) * pressure / 1e9)
    # the gap grows without end where all is in contact: points crowd there
    x, weight = np.polynomial.legendre.leggauss(int(nodes))
    t = 0.5 * (x + 1.0)
    share, step = 1.0 - (1.0 - whole) * t**4, 0.5 * weight * 4.0 * t**3 * (1.0 - whole)
    gaps = [make("critical-junction", 1e9, q, psd, float(f)).at_pressure(pressure).critical_gap[0] for f in share]
    return abs(float(step @ np.array(gaps)) / float(PerssonGap(1e9, spectrum).mean_gap(pressure)) - 1.0)


SEALING = (
    Agreement("tapered-gap", "parallel-gap", "equal ends", equal_ends, (), ROUNDING, "the same gap"),
    Agreement(
        "annular-gap",
        "parallel-gap",
        "radii nearly equal",
        nearly_equal_radii,
        (1e-2, 1e-4, 1e-6),
        1e-6,
        "ln(1 + x) differs from x by half of its square",
    ),
    Agreement(
        "parallel-gap", "solver (sides)", "gas with slip", slipping, (), 1e-9, "rounds of the pressure end at 1e-10"
    ),
    Agreement(
        "tapered-gap",
        "solver (sides)",
        "pixels to infinity",
        solved_taper,
        (10.0, 40.0, 160.0),
        2e-4,
        "exact between the centres of the cells; the half cells at the sides err to the second order",
    ),
    Agreement(
        "parabolic-throat",
        "solver (sides)",
        "pixels to infinity",
        solved_throat,
        (100.0, 200.0, 400.0),
        6e-3,
        "of second order in the pixel, 0.1 of the width √(2 g R) of the throat",
    ),
    Agreement(
        "parabolic-channel",
        "solver (sides)",
        "pixels to infinity",
        solved_scratch,
        (10.0, 40.0, 160.0),
        1e-4,
        "midpoint sums of a cube that is zero at the ends: of second order",
    ),
    Agreement(
        "saddle-throat",
        "solver (sides)",
        "within its bracket",
        solved_saddle,
        (),
        1e-3,
        "the ends of the grid take a tenth of a per cent of the pressure",
    ),
    Agreement(
        "grooved-gap",
        "solver (periodic)",
        "pixels to infinity",
        solved_grooves,
        (8.0, 16.0, 32.0),
        0.01,
        "of second order in the pixel: a quarter for each halving",
    ),
    Agreement(
        "grooved-gap",
        "1 - 3/2 (σ/H)²",
        "small roughness, mean of both directions",
        flat_waves,
        (0.3, 0.1, 0.01),
        1e-7,
        "the next term goes as the fourth power of the amplitude over the gap",
    ),
    Agreement(
        "grooved-gap",
        "crests that are cut (no deformation)",
        "crests just touch",
        cut_off,
        (0.1, 1e-3, 1e-6),
        1e-5,
        "the factor goes on with its slope in the amplitude",
    ),
    Agreement(
        "patir-cheng",
        "solver (periodic)",
        "H/σ of 3, one surface of 256 x 256",
        lambda _: fitted_factors(3.0),
        (),
        0.1,
        "the fit is good to 7 %, and one surface scatters by 1 % in φ and 3 % in φ_s",
    ),
    Agreement(
        "effective-medium",
        "exp <ln g³> (lognormal)",
        "always",
        lambda _: lognormal(0.5),
        (),
        ROUNDING,
        "exact by duality (Keller 1964)",
    ),
    Agreement(
        "effective-medium",
        "√(K1 K2) (chessboard)",
        "two gaps",
        lambda _: even_medium(0.3),
        (),
        ROUNDING,
        "as above, exact",
    ),
    Agreement(
        "obstacle-array",
        "effective-medium",
        "few spots",
        sparse_spots,
        (0.1, 0.01, 0.001),
        3e-6,
        "1 - 2f of both; the next term of the array is 2f²",
    ),
    Agreement(
        "obstacle-array",
        "solver (periodic)",
        "pixels to infinity",
        solved_array,
        (16.0, 48.0, 144.0),
        0.01,
        "of first order in the pixel at the rim",
    ),
    Agreement(
        "critical-junction",
        "persson",
        "mean over contact fractions at which the gap may close",
        mean_over_closings,
        (4.0, 8.0, 16.0),
        1e-3,
        "u_c dA is d(ū A); Gauss points where the gap grows without end at full contact",
    ),
)
