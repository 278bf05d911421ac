"""A cylinder in a bore and a sphere in a socket against reference values, Persson's closed form,
Hertz and finite elements."""

from __future__ import annotations

import numpy as np
import pytest
from reference_data import Row, every_row, reference
from refusals import refused

import asperity as asp
from asperity import theories
from asperity.contact import conforming, cylinder_in_bore, sphere_in_socket
from asperity.fem.elements import axisymmetric
from asperity.fem.linear import factorised, without
from asperity.fem.mesh import Mesh, tensor_mesh
from asperity.fem.solid import Solid

TWIN = asp.Elastic(1.0, 0.3)
E_STAR = 0.5 / 0.91
CLEARANCE = 1e-3


@every_row(reference("missing/conforming_bore"))
def test_bores_of_reference(row: Row) -> None:
    """Of the same 1024 modes: digits of the table; its angles are good to 0.1°."""
    pin = asp.Rigid() if row["pair"] == "rigid_pin" else TWIN
    plate = asp.Rigid() if row["pair"] == "rigid_plate" else TWIN
    modulus = E_STAR if row["pair"] == "equal" else 2.0 * E_STAR
    load = row["Q_over_Estar_clearance"] * modulus * CLEARANCE
    found = cylinder_in_bore(pin, plate, 1.0, CLEARANCE, load)
    assert found.shift / CLEARANCE == pytest.approx(row["shift_over_clearance"], rel=5e-7)
    assert np.degrees(found.half_angle) == pytest.approx(row["half_angle_deg"], abs=0.1)
    assert found.max_pressure / load == pytest.approx(row["p_max_R_over_Q"], rel=5e-7)
    assert 2.0 * np.pi / 1024 * (found.pressure * np.cos(found.angle)).sum() == pytest.approx(load, rel=1e-12)


def test_twins_in_a_bore_have_perssons_pressure() -> None:
    """Everywhere, but for the points beside the edge, with an error that falls with the spacing."""
    pin = theories.PinInHole(E_STAR, 1.0, 1.0 + CLEARANCE)
    load = 2.0 * E_STAR * CLEARANCE
    errors = []
    for points in (256, 1024):
        found = cylinder_in_bore(TWIN, TWIN, 1.0, CLEARANCE, load, points=points)
        inner = np.abs(found.angle) < 0.9 * pin.angle(load)
        wrong = found.pressure - pin.pressure(found.angle, load)
        errors.append(np.abs(wrong[inner]).max() / found.max_pressure)
    assert errors[1] < 0.25 * errors[0]
    assert errors[1] < 1e-4


def test_without_clearance_the_angle_does_not_depend_on_the_load() -> None:
    """It is the largest of Persson's; with an interference all touches until the load opens it."""
    largest = theories.PinInHole(E_STAR, 1.0, 1.1).largest_angle
    found = [cylinder_in_bore(TWIN, TWIN, 1.0, 0.0, load) for load in (1e-7, 1e-4)]
    assert found[0].half_angle == pytest.approx(found[1].half_angle, rel=1e-9)
    assert found[0].half_angle == pytest.approx(largest, abs=np.radians(0.1))
    fitted = cylinder_in_bore(TWIN, TWIN, 1.0, -CLEARANCE, 1e-6)
    uniform = CLEARANCE / float(
        (conforming.bore_compliance(np.zeros(1), TWIN) + conforming.cylinder_compliance(np.zeros(1), TWIN))[0]
    )
    assert fitted.half_angle == np.pi
    expected = uniform + 1e-6 / np.pi * np.cos(fitted.angle)
    np.testing.assert_allclose(fitted.pressure, expected, rtol=1e-9)
    assert cylinder_in_bore(TWIN, TWIN, 1.0, -CLEARANCE, 1.1 * np.pi * uniform).half_angle < np.pi


def test_rough_bores_balance_the_load_sideways_too() -> None:
    rough = 2e-5 * np.random.default_rng(5).standard_normal(512)
    found = cylinder_in_bore(TWIN, TWIN, 1.0, CLEARANCE, 1e-3, points=512, heights=rough)
    arc = 2.0 * np.pi / 512
    assert arc * (found.pressure * np.cos(found.angle)).sum() == pytest.approx(1e-3, rel=1e-10)
    assert abs(arc * (found.pressure * np.sin(found.angle)).sum()) < 1e-13
    assert np.all((found.pressure == 0.0) | (found.gap == 0.0))
    smooth = cylinder_in_bore(TWIN, TWIN, 1.0, CLEARANCE, 1e-3, points=512)
    assert found.max_pressure > 1.5 * smooth.max_pressure


def test_small_contacts_in_a_socket_are_hertzs() -> None:
    """Peak pressures differ by the square of contact radius over radius."""
    left = []
    for angle in (0.4, 0.2):
        hertz = theories.HertzPoint(E_STAR, (1.0 + CLEARANCE) / CLEARANCE).at_radius(angle)
        found = sphere_in_socket(TWIN, TWIN, 1.0, CLEARANCE, float(hertz.load))
        left.append(found.max_pressure / hertz.max_pressure - 1.0)
        assert found.half_angle == pytest.approx(angle, rel=0.3 * angle**2 + 0.003)
    assert left[0] / left[1] == pytest.approx(4.0, rel=0.1)


def test_sockets_balance_the_load_and_settle_with_the_points() -> None:
    found = [sphere_in_socket(TWIN, TWIN, 1.0, CLEARANCE, 5e-3, points=points) for points in (128, 256, 512)]
    cosine = np.cos(found[-1].angle)
    step = np.polynomial.legendre.leggauss(512)[1]
    assert 2.0 * np.pi * (step * cosine * found[-1].pressure).sum() == pytest.approx(5e-3, rel=1e-12)
    assert np.all((found[-1].pressure == 0.0) | (found[-1].gap == 0.0))
    peaks = [one.max_pressure for one in found]
    assert abs(peaks[2] - peaks[1]) < 0.5 * abs(peaks[1] - peaks[0])
    assert abs(peaks[2] / peaks[1] - 1.0) < 3e-4
    rigid = sphere_in_socket(asp.Rigid(), TWIN, 1.0, -CLEARANCE, 1e-7)
    assert rigid.half_angle == np.pi
    uniform = CLEARANCE / float(conforming.socket_compliance(np.zeros(1), TWIN)[0])
    expected = uniform + 3e-7 / (4.0 * np.pi) * np.cos(rigid.angle)
    np.testing.assert_allclose(rigid.pressure, expected, rtol=1e-8)


def ball_of_elements(inner: float, outer: float, parts: int) -> tuple[Mesh, np.ndarray]:
    """Rings between two spheres, of the upper half, with the angle of each point."""
    radii = np.geomspace(inner, outer, parts + 1)
    regular = tensor_mesh(np.linspace(0.0, 0.5 * np.pi, parts + 1), radii, np.zeros(parts, dtype=np.intp))
    angle, r = regular.points.T
    return Mesh(np.stack([r * np.sin(angle), r * np.cos(angle)], axis=1), regular.cells, regular.region), angle


def meshed(kind: str, degree: int, parts: int) -> float:
    """Amplitude of the displacement outwards of r = 1 under the pressure P_n(cos θ), by rings."""
    mesh, angle = ball_of_elements(*((0.02, 1.0) if kind == "sphere" else (1.0, 40.0)), parts)
    body = Solid(axisymmetric(mesh), (TWIN,))
    stiffness = body.elements.pattern.matrix(body.entries)
    loaded = np.flatnonzero(np.abs(np.hypot(*mesh.points.T) - 1.0) < 1e-9)
    at = angle[loaded]
    legendre = np.polynomial.legendre.Legendre.basis(degree)(np.cos(at))
    weight = 2.0 * np.pi * np.sin(at) * (0.5 * np.pi / parts)  # trapezoidal rule: the axis bears nothing
    weight[at > 1.57] *= 0.5
    push = (-1.0 if kind == "sphere" else 1.0) * weight * legendre
    forces, held = np.zeros(body.elements.size), np.zeros(body.elements.size, dtype=bool)
    forces[2 * loaded], forces[2 * loaded + 1] = push * np.sin(at), push * np.cos(at)
    held[2 * np.flatnonzero(angle == 0.0)] = True
    held[2 * np.flatnonzero(angle > 1.57) + 1] = True
    forces[held] = 0.0
    u = factorised(without(stiffness, held))(forces)
    outwards = u[2 * loaded] * np.sin(at) + u[2 * loaded + 1] * np.cos(at)
    return (2 * degree + 1) * float((weight * outwards * legendre).sum()) / (2.0 * np.pi)


@pytest.mark.parametrize("degree", [0, 2, 4])
@pytest.mark.parametrize("kind", ["sphere", "socket"])
def test_modes_of_spheres_and_cavities_are_those_of_finite_elements(kind: str, degree: int) -> None:
    """Extrapolated from 32 and 64 rings; a hole of 2 % in the sphere and a free boundary at 40
    radii move less than 1e-4."""
    coarse, fine = (abs(meshed(kind, degree, parts)) for parts in (32, 64))
    name = {"sphere": conforming.sphere_compliance, "socket": conforming.socket_compliance}[kind]
    expected = float(name(np.array([float(degree)]), TWIN)[0])
    assert (4.0 * fine - coarse) / 3.0 == pytest.approx(expected, rel=5e-4)


@pytest.mark.parametrize("kind", ["cylinder", "bore", "sphere", "socket"])
def test_short_waves_find_the_half_space(kind: str) -> None:
    """2/(E' q), with q = n/R on circles and (n + 1/2)/R on spheres."""
    n = np.array([1e3, 1e4])
    q = n + (0.5 if kind in ("sphere", "socket") else 0.0)
    found = getattr(conforming, f"{kind}_compliance")(n, TWIN)
    errors = np.abs(found * q * 0.5 / 0.91 - 1.0)
    assert errors[1] == pytest.approx(0.1 * errors[0], rel=0.05)
    assert errors[1] < 1e-4


def test_conforming_contacts_that_cannot_be() -> None:
    with refused(asp.InputError, "body in the hole"):
        cylinder_in_bore(asp.Rigid(), asp.Rigid(), 1.0, CLEARANCE, 1.0)
    with refused(asp.InputError, "clearance (m)"):
        sphere_in_socket(TWIN, TWIN, 1.0, 0.2, 1.0)
    with refused(asp.InputError, "points around the bore"):
        cylinder_in_bore(TWIN, TWIN, 1.0, CLEARANCE, 1.0, points=8192)
    with refused(asp.InputError, "heights of the bore"):
        cylinder_in_bore(TWIN, TWIN, 1.0, CLEARANCE, 1.0, points=64, heights=np.zeros(63))
