"""Hertz: sphere and ellipsoid on a free half-space (Johnson 1985, sections 4.2 and 4.1)."""

import numpy as np
import pytest
from contact_cases import TIGHT, elastic, square_grid
from reference_data import every_row, reference

import asperity as asp
from asperity import generate
from asperity.solvers import ConjugateGradient
from asperity.theories.single.hertz import HertzEllipse, HertzPoint

RADIUS, CONTACT_RADIUS = 1.0, 1.0  # the parabolic profile has no other length: any a / R is as good
THEORY = HertzPoint(E_star=1.0, radius=RADIUS)
ANSWER = THEORY.at_radius(CONTACT_RADIUS)
FORCE, PEAK, APPROACH = (float(x) for x in (ANSWER.load, ANSWER.max_pressure, ANSWER.approach))


def hertz(n, control=None, **problem):
    surface = generate.sphere(square_grid(n, 2.4 * CONTACT_RADIUS), radius=RADIUS)
    posed = asp.ContactProblem(surface, elastic(1.0), boundary=asp.Free(), **problem)
    return asp.solve(posed, control or asp.Force(FORCE), solver=TIGHT)


def radius(result):
    return np.sqrt(result.contact_area / np.pi)


def pressure_error(result):
    x, y = result.problem.grid.centred_coordinates()
    exact = THEORY.pressure(np.hypot(x, y), FORCE)
    return np.linalg.norm(result.pressure - exact) / np.linalg.norm(exact)


def test_one_percent_at_64_pixels_per_diameter():
    """The bar for a first mesh: radius, peak pressure and approach within 1 % (errors are of order
    3/2 to 2)."""
    result = hertz(77)
    assert radius(result) == pytest.approx(CONTACT_RADIUS, rel=0.01)
    assert result.max_pressure == pytest.approx(PEAK, rel=0.01)
    assert result.approach == pytest.approx(APPROACH, rel=0.01)


def test_order_of_convergence():
    """Constant pressure on pixels: peak and approach converge with order 2 but for the edge (square
    root) at 3/2.

    The field converges with order 1, as does any piecewise constant approximation. Scatter of the
    edge position on the grid moves single errors by some ten per cent, so orders are fitted over
    three refinements and 0.25 is allowed.
    """
    pixels = np.array([24, 48, 96, 192])
    results = [hertz(n) for n in pixels]

    def order(errors):
        return -np.polyfit(np.log(pixels), np.log(np.abs(errors)), 1)[0]

    assert order([r.max_pressure / PEAK - 1.0 for r in results]) > 1.5
    assert order([r.approach / APPROACH - 1.0 for r in results]) > 1.5
    assert order([pressure_error(r) for r in results]) == pytest.approx(1.0, abs=0.25)
    # the corrected radius is a count of pixels along the rim: error of the order of one pixel in
    # the circumference
    for n, result in zip(pixels, results, strict=True):
        assert abs(radius(result) / CONTACT_RADIUS - 1.0) < 2.4 / n / 2.0


def test_stiffness_is_twice_modulus_times_radius():
    """The radius of the pixelated contact is uncertain by half a pixel, 1/80 here."""
    result = hertz(96)
    total = result.normal_stiffness * result.problem.grid.area
    assert total == pytest.approx(float(ANSWER.stiffness), rel=0.5 * 2.4 / 96 / CONTACT_RADIUS)


def test_stiffness_is_the_derivative_of_force_by_approach():
    """Central difference; the contact grows smoothly, so its error is of second order in the step
    plus pixel steps."""
    step = 0.02
    low, high = hertz(96, asp.Approach(APPROACH - step)), hertz(96, asp.Approach(APPROACH + step))
    slope = (high.mean_pressure - low.mean_pressure) / (2.0 * step)
    middle = hertz(96, asp.Approach(APPROACH))
    assert middle.normal_stiffness == pytest.approx(slope, rel=0.01)


@pytest.mark.parametrize("control", [asp.Approach(APPROACH), asp.MeanPressure(FORCE / 2.4**2)])
def test_controls_are_consistent(control):
    by_force = hertz(64)
    control = asp.Approach(by_force.approach) if isinstance(control, asp.Approach) else control
    other = hertz(64, control)
    assert other.force == pytest.approx(by_force.force, rel=1e-6)
    assert other.approach == pytest.approx(by_force.approach, rel=1e-6)


def test_mean_gap_control_finds_the_force():
    by_force = hertz(48)
    by_gap = hertz(48, asp.MeanGap(by_force.mean_gap))
    assert by_gap.mean_gap == pytest.approx(by_force.mean_gap, rel=1e-8)
    assert by_gap.force == pytest.approx(FORCE, rel=1e-6)


def test_elastic_energy_is_the_work_of_the_force():
    """Integral of P d(delta) = 2/5 P delta for P ~ delta^(3/2); error of the field: 1 % at 96
    pixels."""
    result = hertz(96)
    assert result.elastic_energy == pytest.approx(0.4 * FORCE * APPROACH, rel=1e-3)


@every_row(reference("hertz_elliptical")[:12], label=lambda row: f"case{row['case']:g}")
def test_ellipse_on_rectangular_pixels(row):
    """Pixels as elongated as the contact, up to 1:15. Peak and approach as for the sphere (order 2:
    1e-4 at 80 pixels

    per axis); semi-axes from the second moments of the pressure, <x²> = a²/5, likewise of order 2.
    """
    n = 96
    grid = asp.Grid((n, n), (2.4 * row["a"] / n, 2.4 * row["b"] / n))
    surface = generate.elliptic_paraboloid(grid, radius_x=row["R_x"], radius_y=row["R_y"])
    problem = asp.ContactProblem(surface, elastic(row["E_star"]), boundary=asp.Free())
    result = asp.solve(problem, asp.Force(row["P"]), solver=ConjugateGradient(tolerance=1e-9))
    x, y = grid.centred_coordinates()
    total = result.pressure.sum()
    theory = HertzEllipse(row["E_star"], row["R_x"], row["R_y"])
    answer, (a, b) = theory.at_load(row["P"]), theory.semi_axes(row["P"])
    assert result.max_pressure == pytest.approx(float(answer.max_pressure), rel=5e-4)
    assert result.approach == pytest.approx(float(answer.approach), rel=5e-4)
    assert np.sqrt(5.0 * (result.pressure * x**2).sum() / total) == pytest.approx(float(a), rel=5e-4)
    assert np.sqrt(5.0 * (result.pressure * y**2).sum() / total) == pytest.approx(float(b), rel=5e-4)


def test_periodic_agrees_with_free_on_a_large_cell():
    """Images on a square lattice shift the approach by 3.9003 P / (pi E* L) and bend the surface
    little.

    The bending term, 2.258 r²/L² of P/(pi E* L), is 2.258/16² = 0.9 % of P/(pi E* L) at r = a =
    L/16; relative to the approach a²/R = 3P/(4 E* a) that is 2e-4, and the spectral differs from
    the patch discretisation by some pixel²/a².
    """
    n, size = 256, 16.0 * CONTACT_RADIUS
    surface = generate.sphere(square_grid(n, size), radius=RADIUS)
    free, periodic = (
        asp.solve(asp.ContactProblem(surface, elastic(1.0), boundary=b), asp.Force(FORCE), solver=TIGHT)
        for b in (asp.Free(), asp.Periodic())
    )
    shift = 3.9003 * FORCE / (np.pi * size)
    assert free.approach - periodic.approach == pytest.approx(shift, rel=0.01)
    assert periodic.max_pressure == pytest.approx(free.max_pressure, rel=0.01)
    assert periodic.contact_area == pytest.approx(free.contact_area, rel=0.02)
