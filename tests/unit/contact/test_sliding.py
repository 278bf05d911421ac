"""Coupling of friction and pressure: when there is none, closed form, consistency with the fields,
refusals."""

import numpy as np
import pytest
from catalogue import rough
from contact_cases import slid as solve_sliding
from refusals import refused

import asperity as asp

STEEL, COMPRESSIBLE = asp.Elastic(200e9, 0.3), asp.Elastic(70e9, 0.1)
COATED = asp.Layered([asp.Layer(asp.Elastic(300e9, 0.2), 40e-9)], COMPRESSIBLE)
SLIPPING = asp.Layered([asp.Layer(asp.Elastic(300e9, 0.2), 40e-9, asp.Frictionless())], COMPRESSIBLE)


@pytest.mark.parametrize(
    ("body", "counter_body"),
    [(STEEL, STEEL), (asp.Elastic(1e9, 0.5), asp.Rigid()), (COATED, COATED)],
    ids=["equal bodies", "incompressible on rigid", "equal coated bodies"],
)
@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=lambda b: b.name)
def test_without_coupling_friction_changes_nothing(body, counter_body, boundary):
    problem = asp.ContactProblem(rough(), body, counter_body=counter_body, boundary=boundary)
    slid, still = solve_sliding(problem, asp.MeanPressure(1e8), 0.5), asp.solve(problem, asp.MeanPressure(1e8))
    assert slid.converged
    assert slid.certificate.rounds == 1
    np.testing.assert_allclose(slid.pressure, still.pressure, atol=1e-4 * still.max_pressure)
    np.testing.assert_allclose(slid.sliding.shear_displacement, 0.0, atol=1e-13 * np.abs(still.displacement).max())


@pytest.mark.parametrize("body", [COMPRESSIBLE, COATED], ids=["homogeneous", "coated"])
@pytest.mark.parametrize("boundary", [asp.Periodic(), asp.Free()], ids=lambda b: b.name)
def test_displacement_is_that_of_pressure_and_shear_together(body, boundary):
    """The surface displacement of the stress module under p and μp is another route to the same
    number; 1e-6 of the shear displacement is the change of the pressure that the iteration leaves,
    1e-8 the accuracy of coefficients."""
    problem = asp.ContactProblem(rough((12, 10)), body, boundary=boundary)
    slid = solve_sliding(problem, asp.MeanPressure(1e8), 0.4, direction=0.6)
    surface = asp.stress(slid, [0.0], displacement=True).displacement.z[0]
    np.testing.assert_allclose(slid.displacement, surface, atol=2e-6 * np.abs(surface).max())
    gap = slid.offset + surface - problem.profile()
    assert gap.min() > -2e-6 * np.abs(surface).max()
    np.testing.assert_allclose(gap[slid.pressure > 0.0], 0.0, atol=2e-6 * np.abs(surface).max())


def test_turning_the_direction_round_mirrors_the_pressure():
    grid = asp.Grid((25, 25), (1e-7, 1e-7))
    x, y = grid.centred_coordinates()
    sphere = asp.Surface(-(x**2 + y**2) / (2 * 50e-6), 1e-7, 1e-7)
    problem = asp.ContactProblem(sphere, COMPRESSIBLE, boundary=asp.Free())
    right, left, up = (
        solve_sliding(problem, asp.Force(5e-4), 0.5, direction=angle) for angle in (0.0, np.pi, np.pi / 2)
    )
    largest = right.max_pressure
    np.testing.assert_allclose(left.pressure, right.pressure[::-1], atol=1e-5 * largest)
    np.testing.assert_allclose(up.pressure, right.pressure.T, atol=1e-5 * largest)
    # the body is dragged towards +x and bulges at the trailing side
    assert (right.pressure * x).sum() < -0.05 * (right.pressure * 1e-7).sum()


def test_sliding_cylinder():
    """Rigid cylinder, plane strain: with tan πε = μ(1-2ν)/2(1-ν) the pressure is E' cos πε/2R
    (a-t)^(1/2+ε) (a+t)^(1/2-ε) about a middle at x = -2εa, the load E' π a² (1-4ε²)/4R: the
    singular integral equation of Johnson (1985, sec. 2.8) with bounded ends. A periodic surface has
    no mean slope, so the shear tilts it back by 2κ/E' times the mean pressure, κ = tan πε, which
    moves the contact by R times as much. Images in the period of 24 a curve the surface by about
    (a/period)² = 0.2 %, pixels smooth the ends of the square root.
    """
    n, friction, nu, a, R = 2048, 0.6, 0.1, 85e-7, 1e-2
    x = (np.arange(n) - n // 2) * 1e-7
    problem = asp.ContactProblem(asp.Surface(-(x[:, None] ** 2) / (2 * R), 1e-7, 1e-7), asp.Elastic(1e9, nu))
    modulus = problem.contact_modulus
    kappa = friction * (1 - 2 * nu) / (2 * (1 - nu))
    epsilon = np.arctan(kappa) / np.pi
    load = modulus * np.pi * a**2 * (1 - 4 * epsilon**2) / (4 * R)
    slid = solve_sliding(problem, asp.MeanPressure(load / (n * 1e-7)), friction)
    t = x + 2 * epsilon * a - R * 2 * kappa / modulus * load / (n * 1e-7)
    inside = np.abs(t) < a
    wanted = np.zeros(n)
    wanted[inside] = (
        modulus
        * np.cos(np.pi * epsilon)
        / (2 * R)
        * (a - t[inside]) ** (0.5 + epsilon)
        * (a + t[inside]) ** (0.5 - epsilon)
    )
    core = np.abs(t) < 0.95 * a
    np.testing.assert_allclose(slid.pressure[core, 0], wanted[core], atol=0.01 * wanted.max())
    assert slid.pressure[np.abs(t) > a + 1e-7, 0].max() == 0.0
    assert 2 * epsilon * a > 5e-7  # the shift is more than the pixels could hide


@pytest.mark.parametrize("body", [COMPRESSIBLE, COATED], ids=["homogeneous", "coated"])
def test_displacement_of_a_free_line_is_that_of_pressure_and_shear_together(body):
    """As above; shear along y moves nothing up or down, so that only its part along x counts."""
    profile = asp.Surface(rough((40, 1)).heights, 1e-7, 1.0)
    problem = asp.ContactProblem(profile, body, boundary=asp.FreeLine())
    slid = solve_sliding(problem, asp.MeanPressure(1e8), 0.4, direction=0.6)
    surface = asp.stress(slid, [0.0], displacement=True).displacement.z[0]
    np.testing.assert_allclose(slid.displacement, surface, atol=2e-6 * np.abs(surface).max())
    along = solve_sliding(problem, asp.MeanPressure(1e8), 0.4 * np.cos(0.6))
    np.testing.assert_allclose(along.pressure, slid.pressure, atol=1e-5 * slid.max_pressure)
    assert np.abs(slid.sliding.shear_displacement).max() > 0.01 * np.abs(surface).max()


def test_sliding_cylinder_on_a_free_line():
    """The closed form of the test before, without images and without tilt; pixels of a/85 smooth
    the ends of the root."""
    n, friction, nu, a, R = 201, 0.6, 0.1, 85e-7, 1e-2
    x = (np.arange(n) - n // 2) * 1e-7
    profile = asp.Surface(-(x[:, None] ** 2) / (2 * R), 1e-7, 1.0)
    problem = asp.ContactProblem(profile, asp.Elastic(1e9, nu), boundary=asp.FreeLine())
    modulus = problem.contact_modulus
    epsilon = np.arctan(friction * (1 - 2 * nu) / (2 * (1 - nu))) / np.pi
    slid = solve_sliding(problem, asp.Force(modulus * np.pi * a**2 * (1 - 4 * epsilon**2) / (4 * R)), friction)
    t = x + 2 * epsilon * a
    core, height = np.abs(t) < 0.95 * a, modulus * np.cos(np.pi * epsilon) / (2 * R)
    wanted = height * (a - t[core]) ** (0.5 + epsilon) * (a + t[core]) ** (0.5 - epsilon)
    np.testing.assert_allclose(slid.pressure[core, 0], wanted, atol=3e-3 * wanted.max())
    assert slid.pressure[np.abs(t) > a + 1e-7, 0].max() == 0.0


@pytest.mark.parametrize("boundary", [asp.Free(), asp.FreeLine()], ids=lambda b: b.name)
def test_layers_that_slip_couple_too(boundary):
    """Their coupling ends, far away, in the Poisson contraction of the sheet instead of the step of
    the base."""
    profile = asp.Surface(rough((12, 10) if boundary.name == "free" else (40, 1)).heights, 1e-7, 1e-7)
    slid = solve_sliding(asp.ContactProblem(profile, SLIPPING, boundary=boundary), asp.MeanPressure(1e8), 0.4)
    assert slid.converged
    assert np.abs(slid.sliding.shear_displacement).max() > 0.0
    asp.stress(slid, [20e-9])


def test_prescribed_approach_counts_from_the_true_surfaces():
    problem = asp.ContactProblem(rough(), COMPRESSIBLE, boundary=asp.Free())
    loaded = solve_sliding(problem, asp.MeanPressure(1e8), 0.5)
    again = solve_sliding(problem, asp.Approach(loaded.approach), 0.5)
    assert again.mean_pressure == pytest.approx(1e8, rel=1e-5)
    assert again.approach == pytest.approx(loaded.approach, rel=1e-6)
    assert again.control == asp.Approach(loaded.approach)
    assert again.problem.surface is problem.surface


def test_a_pressure_that_does_not_settle_is_said_so():
    """Friction times β = (1-2ν)/2(1-ν) = 4/9 beyond one: every plain round makes the change larger;
    extrapolation reaches a little further."""
    problem = asp.ContactProblem(rough((12, 10)), COMPRESSIBLE)
    assert solve_sliding(problem, asp.MeanPressure(1e8), 3.0).converged
    result = solve_sliding(problem, asp.MeanPressure(1e8), 20.0, on_failure="return")
    assert result.status.outcome == "stagnated"
    assert "displacement by shear of the sliding contact still changes by" in result.status.message
    assert result.status.remedy
    with pytest.raises(asp.ConvergenceError) as caught:
        solve_sliding(problem, asp.MeanPressure(1e8), 20.0)
    assert caught.value.result.status == result.status


def test_progress_counts_the_iterations_of_all_rounds():
    heard = []

    class Heard:
        def update(self, iteration, error, tolerance):
            heard.append((iteration, error, tolerance))

    problem = asp.ContactProblem(rough(), COMPRESSIBLE)
    engine = asp.engines.CpuEngine(threads=1)
    slid = solve_sliding(problem, asp.MeanPressure(1e8), 0.5, progress=Heard(), engine=engine)
    iterations, errors, tolerances = map(np.array, zip(*heard, strict=True))
    assert np.all(np.diff(iterations) >= 0)
    assert iterations[-1] >= slid.certificate.rounds
    assert errors[-1] <= tolerances[-1] == 1e-12
    np.testing.assert_allclose(slid.pressure, solve_sliding(problem, asp.MeanPressure(1e8), 0.5).pressure, rtol=1e-12)


def test_permanent_indentation_is_kept_once_not_once_per_round():
    problem = asp.ContactProblem(rough(), COMPRESSIBLE, law=asp.Hardness(0.6e9))
    slid = solve_sliding(problem, asp.MeanPressure(1.5e8), 0.4)
    assert slid.plastic_area_fraction > 0.01
    surface = slid.offset + slid.displacement - problem.profile() + slid.permanent_indentation
    np.testing.assert_allclose(np.maximum(surface, 0.0), slid.gap, atol=1e-6 * np.ptp(problem.profile()))
    on = solve_sliding(problem, asp.MeanPressure(2e8), 0.4, state=slid.state)
    assert on.total_plastic_work == pytest.approx(slid.plastic_work + on.plastic_work, rel=1e-12)
    assert on.total_plastic_work == pytest.approx(0.6e9 * on.plastic_volume, rel=1e-9)


def test_refusals():
    problem = asp.ContactProblem(rough(), STEEL)
    with refused(asp.InputError, "friction coefficient"):
        solve_sliding(problem, asp.MeanPressure(1e8), -0.1)
