"""Single bodies that slide or roll steadily over a viscoelastic half-space, on free grids: Hunter's
cylinder, limits of the speed, symmetries."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from refusals import refused
from scipy.special import i0e, i1e, k0e, k1e

import asperity as asp

RELAXED, STEP, TIME = 1.0, 9.0, 1.0
RUBBER = asp.Viscoelastic.prony(RELAXED, ((STEP, TIME),), 0.0)


@dataclass(frozen=True)
class Hunter:
    """Cylinder (R = 1 m) that rolls or slides over a standard linear solid with half-width ``a``
    (Hunter 1961), per length.

    With the retardation time lambda, L = v lambda and 1 + s = E_0/E_inf the field q = (1 + s) p - L
    p' is that of an elastic contact with a linear slope, q = (A + B x + C x²)/sqrt(a² - x²). A and
    the place e of the axis follow from p(-a) = 0 and from the slope at the front.
    """

    a: float
    speed: float

    def solved(self) -> tuple[float, float, float]:
        """Load (N/m), friction coefficient, and the centre of the contact ahead of the axis (m)."""
        a, E, ratio = self.a, RELAXED + STEP, (RELAXED + STEP) / RELAXED
        L = self.speed * TIME * ratio
        K, k = ratio * a / L, a / L
        C = -0.5 * E
        # B = E/2 (e + L)
        ends = [i0e(K), -0.5 * E * a * i1e(K)], C * a**2 * (i0e(K) - i1e(K) / K) - 0.5 * E * L * a * i1e(K)
        front = a * k1e(k) - L
        known = C * (a**2 * (k0e(k) + k1e(k) / k) - L * (a + L)) + 0.5 * E * L * front
        slope = [k0e(k), 0.5 * E * front + 0.5 * E * L], known - 0.5 * E * L * a
        A, e = np.linalg.solve(np.array([ends[0], slope[0]]), -np.array([ends[1], slope[1]]))
        B = 0.5 * E * (e + L)
        load = np.pi * (A + 0.5 * C * a**2) / ratio
        moment = (0.5 * np.pi * B * a**2 - L * load) / ratio
        return float(load), float(moment / load - e), float(-e)


def line(points: int, reach: float) -> asp.Surface:
    x = (np.arange(points) - points / 2 + 0.5) * 2 * reach / points
    return asp.Surface(-0.5 * x[:, None] ** 2, 2 * reach / points, 1.0)


def cylinder(points: int = 512, reach: float = 0.4) -> asp.ContactProblem:
    return asp.ContactProblem(line(points, reach), asp.Rigid(), counter_body=RUBBER, boundary=asp.FreeLine())


@pytest.mark.parametrize("speed", [0.003, 0.02, 0.1, 0.5, 3.0])
def test_cylinder_of_hunter(speed: float) -> None:
    """Friction to 1e-3 and the edges of the contact to a pixel, from slow to fast."""
    load, friction, ahead = Hunter(0.2, speed).solved()
    assert friction > 0.0
    found = asp.slide(cylinder(), asp.Force(load), speed)
    assert found.friction == pytest.approx(friction, rel=2e-3)
    assert found.slope_friction == pytest.approx(friction, rel=2e-3)
    touching = np.flatnonzero(found.normal.contact[:, 0])
    x = (touching[[0, -1]] - 255.5) * found.normal.problem.grid.spacing[0]
    np.testing.assert_allclose(x, [ahead - 0.2, ahead + 0.2], atol=1.1 * found.normal.problem.grid.spacing[0])


def test_limits_of_hunter() -> None:
    """Its load is Hertz's of the relaxed modulus when it is slow, of the instantaneous one when it
    is fast."""
    for speed, modulus in ((1e-4, RELAXED), (1e5, RELAXED + STEP)):
        load, friction, ahead = Hunter(0.2, speed).solved()
        assert load == pytest.approx(0.25 * np.pi * modulus * 0.2**2, rel=1e-2)
        assert abs(friction) + abs(ahead) < 1e-2


def sphere(reach: float, points: int) -> asp.Surface:
    x = (np.arange(points) - points / 2 + 0.5) * 2 * reach / points
    return asp.Surface(-0.5 * (x[:, None] ** 2 + x**2), 2 * reach / points)


def ball(points: int = 48, body: asp.Elastic | asp.Layered = RUBBER) -> asp.ContactProblem:
    return asp.ContactProblem(sphere(0.25, points), asp.Rigid(), counter_body=body, boundary=asp.Free())


LOAD = asp.Force(0.004)


@pytest.mark.slow
def test_sphere_between_rest_and_high_speed() -> None:
    """Pressure and approach are those of the relaxed and the instantaneous elastic body at the
    ends; friction has one maximum between."""
    speeds = np.array([0.0, 1e-4, 1e-3, 0.01, 0.02, 0.05, 0.2, 1.0, 1e3])
    found = [asp.slide(ball(), LOAD, float(v)) for v in speeds]
    for each, modulus in ((found[0], RELAXED), (found[-1], RELAXED + STEP)):
        elastic = asp.solve(ball(body=asp.Elastic(modulus, 0.0)), LOAD)
        assert each.normal.max_pressure == pytest.approx(elastic.max_pressure, rel=1e-3)
        assert each.normal.approach == pytest.approx(elastic.approach, rel=1e-3)
    assert found[0].friction == 0.0
    friction = np.array([each.friction for each in found])
    turns = np.diff(np.sign(np.diff(friction)))
    assert np.count_nonzero(turns) == 1
    assert friction.argmax() in (3, 4, 5)
    area = np.array([each.normal.contact_area for each in found])
    assert (np.diff(area) <= 0.0).all()
    for each in found[2:-1]:
        assert each.slope_friction == pytest.approx(each.friction, rel=2e-2)
    assert found[-1].friction * 1e3 == pytest.approx(found[-2].friction, rel=0.05)


def test_every_axis_is_the_same() -> None:
    """Friction along +x, -x, +y and -y; the pressure is that of +x, turned."""
    base = asp.slide(ball(), LOAD, 0.05)
    p = np.asarray(base.normal.pressure)
    turned = {np.pi: p[::-1], 0.5 * np.pi: p.T, -0.5 * np.pi: p.T[:, ::-1]}
    x = np.arange(48) - 23.5
    assert float((p * x[:, None]).sum()) > 0.0  # pressure is larger in front
    for direction, pressure in turned.items():
        found = asp.slide(ball(), LOAD, 0.05, direction=direction)
        assert found.friction == pytest.approx(base.friction, rel=1e-6)
        np.testing.assert_allclose(found.normal.pressure, pressure, atol=1e-4 * base.normal.max_pressure)


def test_coating_on_a_free_grid() -> None:
    """A stack of one material, fitted as layers, is that material; a thin coating on a stiff base
    dissipates less."""
    almost = asp.Layered([asp.Layer(RUBBER.with_times(1.0 + 1e-6), 0.1)], RUBBER)
    thin = asp.Layered([asp.Layer(RUBBER, 0.02)], asp.Elastic(100.0, 0.3))
    whole, layered, coated = (asp.slide(ball(32, body), LOAD, 0.02) for body in (RUBBER, almost, thin))
    assert layered.friction == pytest.approx(whole.friction, rel=1e-3)
    assert coated.friction < 0.5 * whole.friction


def test_finer_grids_agree() -> None:
    coarse, fine = (asp.slide(ball(points), LOAD, 0.03) for points in (32, 64))
    assert coarse.friction == pytest.approx(fine.friction, rel=5e-3)


def test_periodic_box_grows_into_the_free_one() -> None:
    """A sphere in a periodic box eight contacts wide, whose memory is shorter than the box."""
    wide = sphere(1.0, 128)
    kept = np.maximum(wide.heights, -0.5 * 0.6**2)
    box = asp.ContactProblem(asp.Surface(kept, wide.grid.spacing[0]), asp.Rigid(), counter_body=RUBBER)
    free = asp.slide(ball(32), LOAD, 0.01)
    assert asp.slide(box, LOAD, 0.01).friction == pytest.approx(free.friction, rel=0.05)


def test_what_is_refused() -> None:
    with refused(asp.InputError, "direction of sliding (rad)"):
        asp.slide(ball(), LOAD, 0.1, direction=0.3)
    with refused(asp.InputError, "direction of sliding (rad)"):
        asp.slide(cylinder(64), LOAD, 0.1, direction=0.5 * np.pi)
    with refused(asp.InputError, "bodies in steady sliding on a free grid"):
        asp.slide(ball(body=asp.Viscoelastic.maxwell(1.0, 1.0, 0.0)), LOAD, 0.1)
