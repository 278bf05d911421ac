"""Stick and slip against closed and semi-analytic solutions of single contacts, with the order of
convergence."""

import math

import numpy as np
import pytest
from reference_data import reference

import asperity as asp


def rows(name, **wanted):
    return [row for row in reference(f"friction/{name}") if all(row[key] == value for key, value in wanted.items())]


def axis(n, length):
    """Pixel size and coordinates from the centre of n pixels."""
    return length / n, (np.arange(n) - 0.5 * (n - 1)) * length / n


def sphere(n, radius, reach, body, counter, law):
    """Problem of a paraboloid on n x n pixels that cover ``reach`` to both sides."""
    spacing, x = axis(n, 2.0 * reach)
    surface = asp.Surface(-(x[:, None] ** 2 + x[None, :] ** 2) / (2.0 * radius), spacing, spacing)
    return asp.ContactProblem(surface, body, counter_body=counter, boundary=asp.Free(), friction=law), x


def coated(row):
    top, base = (asp.Elastic(row[f"E{k}"], row[f"nu{k}"]) for k in (1, 2))
    return asp.Layered([asp.Layer(top, row["h"])], base=base)


def pixel_means(values, n):
    """Means over the n x n pixels of a field on a finer grid: what constant tractions on pixels
    stand for."""
    m = len(values) // n
    return values.reshape(n, m, n, m).mean(axis=(1, 3))


def test_cattaneo_mindlin_sphere_converges_with_first_order():
    """Equal bodies of ν = 0, where the theory is exact: tractions in L2, of pixel means, and
    shift."""
    mu, a, R, E = 0.4, 0.1, 1.0, 2.0
    body = asp.Elastic(E, 0.0)
    P = 4.0 / 3.0 * (0.5 * E) * a**3 / R
    c, p0 = a * 0.5 ** (1.0 / 3.0), 1.5 * P / (math.pi * a**2)
    errors, sizes = [], (20, 28, 40, 56, 80, 112)
    for n in sizes:
        problem, _ = sphere(n, R, 1.2 * a, body, body, asp.Coulomb(mu))
        found = asp.solve(problem, asp.Step(asp.Force(P), asp.TangentialForce(0.5 * mu * P))).stick_slip
        fine = axis(16 * n, 2.4 * a)[1]
        r = np.hypot(fine[:, None], fine[None, :])
        full, stick = (np.sqrt(np.maximum(1.0 - (r / radius) ** 2, 0.0)) * radius / a for radius in (a, c))
        expected = pixel_means(mu * p0 * (full - stick), n)
        errors.append(np.linalg.norm(found.traction[0] - expected) / np.linalg.norm(expected))
        assert np.abs(found.traction[1]).max() <= 1e-6 * expected.max()
    order = -np.polyfit(np.log(sizes), np.log(errors), 1)[0]
    assert order >= 0.95  # first order; single grids scatter by how pixels lie to the edges
    assert found.shift_x == pytest.approx(mu * (a**2 - c**2) / R, rel=1e-3)


@pytest.mark.parametrize("row", rows("partial_slip_sinusoid"), ids=lambda row: f"{row['case']:.0f}")
def test_partial_slip_of_a_wave(row):
    """Lines of equal bodies in a periodic cell, in-plane and antiplane: tractions, shift, and the
    work of a whole cycle."""
    body = asp.Elastic(row["E_each"], row["nu_each"])
    along = row["mode"] == "inplane"
    errors = []
    for n in (128, 256):
        spacing, x = axis(n, row["wavelength"])
        heights = row["gap_amplitude"] * (np.cos(2.0 * np.pi * x / row["wavelength"]) - 1.0)
        surface = asp.Surface(heights[:, None], spacing, spacing, periodic=True)
        problem = asp.ContactProblem(surface, body, counter_body=body, friction=asp.Coulomb(row["mu"]))
        force = row["qbar"] * problem.grid.area
        peak = asp.TangentialForce(force, 0.0) if along else asp.TangentialForce(0.0, force)
        cycle = asp.friction.shear_cycles(asp.MeanPressure(row["pbar"]), peak, cycles=1, steps=1)
        # a monotone leg is exact in one step: from one turning point to the next
        turns = asp.History([step for k, step in enumerate(cycle) if k in (0, 2, 4)])
        found = asp.solve(problem, turns)
        first, loop = found.steps[0].stick_slip, found.steps[1:]
        traction = first.traction[0 if along else 1, :, 0]
        at = np.array([0.0, 0.5 * row["c"], 0.5 * (row["a"] + row["c"])])
        expected = np.array([row["q_0"], row["q_c2"], row["q_mid"]])
        errors.append(np.abs(np.interp(at, x, traction) - expected).max() / expected.max())
        shift = first.shift_x if along else first.shift_y
        work = sum(step.stick_slip.dissipated for step in loop) / problem.grid.area
    assert errors[-1] < 0.03
    assert shift == pytest.approx(row["delta_t"], rel=0.02)
    assert work == pytest.approx(row["W_cycle"], rel=0.05)


@pytest.mark.parametrize("row", rows("line_layered_twins"), ids=lambda row: f"{row['case']:.0f}")
def test_coated_cylinders(row):
    """Coated twins in line contact: force at the same stick width, where the reduced theorem is up
    to 60 % off."""
    body, along = coated(row), row["mode"] == "inplane"
    misses = []
    for n in (96, 192):
        spacing, x = axis(n, 2.4 * row["a"])
        surface = asp.Surface(-(x[:, None] ** 2) / (2.0 * row["R"]), spacing, 1.0)
        problem = asp.ContactProblem(
            surface, body, counter_body=body, boundary=asp.FreeLine(), friction=asp.Coulomb(row["mu"])
        )
        force = asp.TangentialForce(row["Q"], 0.0) if along else asp.TangentialForce(0.0, row["Q"])
        result = asp.solve(problem, asp.Step(asp.Force(row["P"]), force))
        stick = np.count_nonzero(result.contact & ~result.stick_slip.slipping) * spacing
        misses.append(abs(0.5 * stick / row["a"] - row["c_over_a"]) * row["a"] / spacing)
        traction = result.stick_slip.traction[0 if along else 1, :, 0]
        at = np.array([0.0, 0.5 * row["c_over_a"], 0.5 * (1.0 + row["c_over_a"])]) * row["a"]
        expected = np.array([row["q_0"], row["q_c2"], row["q_mid"]])
        assert np.abs(np.interp(at, x, traction) - expected).max() < 0.06 * expected.max()
    assert max(misses) <= 1.5  # pixels


@pytest.mark.parametrize("row", rows("torsion_layered_twins"), ids=lambda row: f"{row['case']:.0f}")
def test_twisted_coated_spheres(row):
    """Torque at the same twist, exact for every ν."""
    body = coated(row)
    errors = []
    for n in (32, 64):
        problem, _ = sphere(n, row["R"], 1.2 * row["a"], body, body, asp.Coulomb(row["mu"]))
        found = asp.solve(problem, asp.Step(asp.Force(row["P"]), asp.Shift(twist=row["twist"]))).stick_slip
        errors.append(abs(found.torque / row["M"] - 1.0))
    assert errors[-1] < 0.01


@pytest.mark.parametrize("case", sorted({row["case"] for row in rows("sphere_histories_nu0")}))
def test_paths_of_a_sphere(case):
    """Forces and accumulated work on a path of approach and shift, sampled finely enough for
    implicit steps."""
    path = rows("sphere_histories_nu0", case=case)
    body, reach = asp.Elastic(path[0]["E_each"], 0.0), 1.15 * max(row["a"] for row in path)
    problem, _ = sphere(40, path[0]["R"], reach, body, body, asp.Coulomb(path[0]["mu"]))
    parts, at, steps, ends = 8, (0.0, 0.0), [], []
    for row in path:
        to = (row["approach"], row["shift"])
        for k in range(1, parts + 1):
            approach, shift = (a + (b - a) * k / parts for a, b in zip(at, to, strict=True))
            steps.append(asp.Step(asp.Approach(approach), asp.Shift(shift)))
        ends.append(len(steps) - 1)
        at = to
    found = asp.solve(problem, asp.History(steps))
    largest = max(row["P"] for row in path)
    work = max(row["W_total"] for row in path)
    for row, end in zip(path, ends, strict=True):
        result = found.steps[end]
        assert result.force == pytest.approx(row["P"], abs=0.01 * largest)
        assert result.stick_slip.force_x == pytest.approx(row["Q"], abs=0.03 * path[0]["mu"] * largest)
        assert result.stick_slip.total_dissipated == pytest.approx(row["W_total"], abs=0.15 * work)


@pytest.mark.parametrize(
    "row", rows("finite_friction_indentation", nu_rigid_indenter=0.3), ids=lambda row: f"{row['c_over_a']}"
)
def test_stick_radius_of_a_pressed_sphere(row):
    """Rigid sphere pressed on ν = 0.3 with Coulomb friction: the inner circle of radius c sticks
    (Spence 1975)."""
    a, R = 0.1, 1.0
    body = asp.Elastic(1.0, 0.3)
    P = 4.0 / 3.0 * body.plane_strain_modulus * a**3 / R
    problem, _ = sphere(64, R, 1.1 * a, body, asp.Rigid(), asp.Coulomb(row["mu"]))
    steps = 12
    pressed = [asp.Step(asp.Force(P * (k / steps) ** 3), asp.Shift()) for k in range(1, steps + 1)]
    last = asp.solve(problem, asp.History(pressed)).last
    stick = np.count_nonzero(last.contact & ~last.stick_slip.slipping) / np.count_nonzero(last.contact)
    assert math.sqrt(stick) == pytest.approx(row["c_over_a"], abs=0.06)
