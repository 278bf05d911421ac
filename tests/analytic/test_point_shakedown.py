"""Shakedown of point contacts: published limits, laws of the bounds, and independent optimisers."""

from __future__ import annotations

import math

import numpy as np
import pytest
from refusals import refused
from scipy.optimize import minimize

import asperity as asp
from asperity import theories
from asperity.core.errors import InputError, NoSolutionError
from asperity.core.tensor import StressTensor, second_invariant
from asperity.fem import Resolution, point_load, sphere_track
from asperity.theories.subsurface.hertz import hertz_line_normal, hertz_line_shear, hertz_normal

FRICTION = (0.0, 0.1, 0.2, 0.35, 0.6, 1.0)
SPHERES = {mu: theories.sphere_shakedown(mu) for mu in FRICTION}


def test_pure_rolling_of_a_sphere() -> None:
    """Alternating σ_xz bounds the load: 4.68 k (Hearle, Ponter and Johnson 1985). The residual
    normal stresses reach 1 % below it."""
    x, z = np.linspace(-1.5, 0.0, 601)[:, None], np.linspace(0.2, 0.6, 161)[None, :]
    largest = np.abs(hertz_normal(x, 0.0 * x, z, 1.0, shear=1.0, nu=0.3).stress.xz).max()
    found = SPHERES[0.0]
    assert found.bound_over_k == pytest.approx(
        1.0 / largest, rel=1e-3
    )  # sampled along the pass: second order in 1 to 3 % of the radius
    assert found.bound_over_k == pytest.approx(4.68, abs=0.005)
    assert 0.985 * found.bound_over_k < found.peak_over_k < found.bound_over_k


def test_order_of_the_limits() -> None:
    """First yield, then the limit, then the bound; both fall with friction."""
    for mu, found in SPHERES.items():
        onset = theories.sphere_yield_onset(0.3, mu).peak_over_k
        assert onset * (1.0 - 1e-3) < found.peak_over_k <= found.bound_over_k * (1.0 + 1e-9)
    limits = [found.peak_over_k for found in SPHERES.values()]
    bounds = [found.bound_over_k for found in SPHERES.values()]
    assert np.all(np.diff(limits) < 0.0)
    assert np.all(np.diff(bounds) < 0.0)


@pytest.mark.parametrize("mu", [0.6, 1.0])
def test_the_surface_under_high_friction(mu: float) -> None:
    """k/μ, from above and below: no residual stress changes σ_xz = μp at the surface."""
    found = SPHERES[mu]
    np.testing.assert_allclose([found.peak_over_k, found.bound_over_k], 1.0 / mu, rtol=1e-6)
    assert found.depth == 0.0


@pytest.mark.slow
def test_long_ellipses_are_lines() -> None:
    """Across the pass: 4 k within some (a/b)²; round: the sphere, within the coarser places of the
    ellipse."""
    long = theories.ellipse_shakedown(15.0)
    assert 4.0 < long.peak_over_k < 4.04
    round_ = theories.ellipse_shakedown(1.0)
    found = [round_.peak_over_k, round_.bound_over_k]
    np.testing.assert_allclose(found, [SPHERES[0.0].peak_over_k, SPHERES[0.0].bound_over_k], rtol=5e-3)


def test_plane_strain_of_incompressible_solids() -> None:
    """σ_yy is then the mean of the others all along the pass, and von Mises' criterion that of the
    smallest circles."""
    x, z = np.linspace(-4.0, 4.0, 401)[None, :], np.array([0.1, 0.4, 0.5, 0.8])[:, None]
    normal = hertz_line_normal(x, z, 1.0, shear=1.0, nu=0.5).stress
    stress = normal + hertz_line_shear(x, z, 1.0, shear=1.0, nu=0.5).stress * 0.2
    circles = theories.line_shakedown(stress, 1.0)
    spheres = theories.point_shakedown(stress.map(lambda part: np.asarray(part)[:, :, None]), 1.0)
    np.testing.assert_allclose(spheres.radius, circles.radius, rtol=1e-6)
    np.testing.assert_allclose(spheres.residual_along[:, 0], circles.residual, atol=1e-3)  # ρ_xx is flat there


def loops(seed: int, places: int = 12) -> StressTensor:
    random = np.random.default_rng(seed)
    return StressTensor(*random.standard_normal((6, 2, places, 3)))


def test_the_residual_stresses_give_the_radius() -> None:
    stress = loops(1)
    found = theories.point_shakedown(stress, np.array([1.0, 2.0]))
    k = np.array([1.0, 2.0])[:, None, None]
    along, across = found.residual_along[:, None, :] * k, found.residual_across[:, None, None] * k
    kept = StressTensor(stress.xx + along, stress.yy + across, stress.zz, stress.xy, stress.xz, stress.yz)
    np.testing.assert_allclose(np.sqrt(second_invariant(kept)).max(axis=(1, 2)) / k[:, 0, 0], found.radius, rtol=1e-9)


def test_residual_stresses_that_are_there_already_change_nothing() -> None:
    stress, random = loops(2), np.random.default_rng(5)
    plain = theories.point_shakedown(stress, 1.0)
    own = StressTensor(
        stress.xx + random.standard_normal((2, 1, 3)),
        stress.yy + random.standard_normal((2, 1, 1)),
        stress.zz,
        stress.xy,
        stress.xz,
        stress.yz,
    )
    np.testing.assert_allclose(theories.point_shakedown(own, 1.0).radius, plain.radius, rtol=1e-6)
    any_ = StressTensor(*(part + random.standard_normal((2, 1, 3)) for part in vars(stress).values()))
    np.testing.assert_allclose(theories.point_shakedown(any_, 1.0).least, plain.least, rtol=1e-4)


def test_against_a_general_optimiser() -> None:
    """The least of the largest J2 over the residual stresses, by sequential quadratic
    programming."""
    stress = loops(3)
    found = theories.point_shakedown(stress, 1.0)

    def radius(shift: np.ndarray, plane: int, place: slice) -> float:
        part = {name: value[plane][:, place].copy() for name, value in vars(stress).items()}

        def excess(unknown: np.ndarray) -> np.ndarray:
            moved = dict(part)
            moved["xx"] = part["xx"] + unknown[1 : 1 + shift.shape[0] - 5]
            for name, value in zip(("yy", "xy", "xz", "yz"), unknown[-4:], strict=True):
                moved[name] = part[name] + value
            return np.asarray(unknown[0] - second_invariant(StressTensor(**moved)).ravel())

        fixed = [{"type": "ineq", "fun": excess}]
        if part["xx"].shape[1] > 1:  # shear is not free
            fixed.append({"type": "eq", "fun": lambda unknown: unknown[-3:]})
        start = np.zeros(shift.shape[0])
        start[0] = 50.0
        best = minimize(
            lambda unknown: unknown[0],
            start,
            constraints=fixed,
            method="SLSQP",
            options={"maxiter": 300, "ftol": 1e-9},
        )
        assert best.success
        return math.sqrt(best.fun)

    for plane in range(2):
        assert found.radius[plane] == pytest.approx(radius(np.zeros(8), plane, slice(None)), rel=1e-5)
        alone = max(radius(np.zeros(6), plane, slice(place, place + 1)) for place in range(3))
        assert found.least[plane] == pytest.approx(alone, rel=1e-4)


STEEL = asp.Elastic(2e11, 0.3, asp.Strength(yield_stress=1e9), name="steel")


def solved(body: object) -> asp.ContactResult:
    sphere = asp.generate.sphere(asp.Grid((48, 48), (2.5e-6, 2.5e-6)), radius=1e-2)
    return asp.solve(asp.ContactProblem(sphere, body, boundary=asp.Free()), asp.Approach(1.5e-7))


@pytest.mark.slow
def test_limits_of_a_solved_contact() -> None:
    """The sphere within the error of its pixels, 15 to the radius; a coating of the body's own
    material changes nothing; a weaker one lowers the limit."""
    k, friction, results = 1e9 / math.sqrt(3.0), [0.0, 0.2, 0.6], []
    weak = asp.Elastic(2e11, 0.3, asp.Strength(yield_stress=5e8), name="weak")
    for body in (
        STEEL,
        asp.Layered([asp.Layer(STEEL, 1e-5)], base=STEEL),
        asp.Layered([asp.Layer(weak, 1e-5)], base=STEEL),
    ):
        result = solved(body)
        results.append(asp.stresses.shakedown(result, [0.0, 1e-5, 1.25e-5, 1.4e-5, 1.6e-5], friction))
        np.testing.assert_array_less(results[-1].limit, results[-1].bound * (1.0 + 1e-9))
    peak = result.pressure.max()
    wanted = [theories.sphere_shakedown(mu) for mu in friction]
    np.testing.assert_allclose(results[0].limit * peak / k, [w.peak_over_k for w in wanted], rtol=0.03)
    np.testing.assert_allclose(results[0].bound * peak / k, [w.bound_over_k for w in wanted], rtol=0.03)
    assert results[0].depth[-1] == 0.0
    np.testing.assert_allclose(results[1].limit, results[0].limit, rtol=1e-6)
    assert np.all(results[2].limit <= results[0].limit * (1.0 + 1e-6))
    assert results[2].region[-1] == 0
    assert results[2].limit[-1] == pytest.approx(0.5 * results[0].limit[-1], rel=1e-6)  # at the surface
    found = asp.stresses.shakedown_map([0.0, 1.0, 2.0], results)
    assert found.limit.shape == (3, 3)
    np.testing.assert_array_equal(found.bound[1], results[1].bound)


def test_refusals() -> None:
    with refused(InputError, "stress"):
        theories.point_shakedown(loops(1), 0.0)
    with refused(InputError, "friction coefficient", "-1"):
        theories.sphere_shakedown(-1.0)
    with refused(InputError, "Poisson's ratio", "0.7"):
        theories.sphere_shakedown(0.1, 0.7)
    with refused(InputError, "ratio of the semi-axes", "30"):
        theories.ellipse_shakedown(30.0)
    result = solved(asp.Elastic(2e11, 0.3))
    with refused(NoSolutionError, "strength of substrate"):
        asp.stresses.shakedown(result, [1e-5])
    with refused(InputError, "friction coefficient", "-0.1"):
        asp.stresses.shakedown(result, [1e-5], -0.1)
    with refused(InputError, "curves of a shakedown map"):
        asp.stresses.shakedown_map([1.0], [])


def test_rolling_sphere_by_finite_elements() -> None:
    """Both bounds from the elastic stresses of finite elements below the pressure of Hertz; four
    elements to the radius give stresses within 3 % of the peak."""
    coarse = Resolution(across=4, growth=1.5, depth=1.0, distance=12.0)
    track = sphere_track(asp.Elastic(1.0, 0.3), 1.0, (0.0, 0.0), plasticity=None, resolution=coarse)
    push = point_load(track, 0.0, 1.0, 1.0)
    stress = track.response(track.carry(track.virgin(), push, 0.0 * push)).stress.mean(axis=1)
    x, y, z = (np.unique(track.mesh.points[:, axis]) for axis in range(3))
    planes = np.moveaxis(stress.reshape(len(x) - 1, len(y) - 1, len(z) - 1, 6), 2, 0)
    near = planes[:, np.abs(x[1:] + x[:-1]) < 8.0][:, :, y[1:] + y[:-1] < 4.4]
    found, exact = (
        theories.point_shakedown(StressTensor(*np.moveaxis(near, -1, 0)), 1.0),
        theories.sphere_shakedown(0.0, 0.3),
    )
    assert found.limit == pytest.approx(exact.peak_over_k, rel=0.03)
    assert found.bound == pytest.approx(exact.bound_over_k, rel=0.03)
