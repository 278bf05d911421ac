"""Theories of wear: every reference row, independent integrations, limits, what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference_data import Row, every_row, reference
from refusals import refused
from worn_rings import Coating, Rings, WornProfile, worn, worn_sphere

import asperity as asp
from asperity.core.errors import InputError
from asperity.physics.wear.law import archard
from asperity.physics.wear.march import WearSteps
from asperity.physics.wear.march import worn as worn_by_solver
from asperity.theories import (
    ArchardWear,
    DissipatedEnergyWear,
    PinOnDisk,
    WearingCoatedSphere,
    WearingCoatedWave,
    WearingCylinder,
    WearingPunch,
    WearingSphere,
    WearingWave,
    WornCap,
    WornComposite,
    punch_rates,
    track_section,
    wear_coefficient,
)

SPHERES = reference("transport/wear_sphere")
STEPS = WearSteps(tolerance=0.02, order=2)
"""Of solutions on the grid: errors below 1 %."""

WORN = [row for row in SPHERES if float(row["sliding_distance_m"]) > 0.0]


@every_row(reference("transport/wear_wave_decay"), lambda row: f"row {row['case']}")
def test_decay_of_waves(row: Row) -> None:
    coating, base, thickness, q = (float(row[name]) for name in ("E1", "E2", "h", "q"))
    wave = WearingCoatedWave(
        coating, base, thickness, 2.0 * math.pi / q, 0.1, coating_nu=float(row["nu1"]), base_nu=float(row["nu2"])
    )
    assert wave.compliance == pytest.approx(float(row["c"]), rel=1e-12)
    assert 0.1 / wave.compliance == pytest.approx(0.1 * float(row["decay_rate_over_kv"]), rel=1e-12)
    assert 0.1 * wave.explicit_limit == pytest.approx(float(row["explicit_step_limit_times_kv"]), rel=1e-12)
    assert wave.at_distance(wave.decay_distance).remaining == pytest.approx(math.exp(-1.0))
    if coating == base and row["nu1"] == row["nu2"]:
        same = WearingWave(coating / (1.0 - float(row["nu1"]) ** 2), 2.0 * math.pi / q, 0.1)
        assert same.compliance == pytest.approx(wave.compliance, rel=1e-13)


@every_row(reference("transport/wear_punch_modes"), lambda row: f"mode {row['mode']}")
def test_modes_of_a_punch(row: Row) -> None:
    found = punch_rates(int(float(row["mode"])))[-1]
    assert found == pytest.approx(float(row["decay_rate_a_over_kvEstar"]), abs=float(row["abs_error"]))


def test_slowest_modes_of_a_punch_by_rings() -> None:
    """The two that the reference leaves out: collocation on rings, whose error falls with the
    square of their width (2e-4 and 3e-4 of the two rates at 200 rings)."""

    def rates(count: int) -> np.ndarray:
        rings = Rings(np.sin(np.linspace(0.0, 0.5 * math.pi, count + 1)), 1.0)
        matrix, shares = rings.compliance(), rings.areas / math.pi
        matrix = matrix - (shares @ matrix)[None, :]  # up to a constant
        free = np.eye(count) - np.outer(np.ones(count), shares)  # without load
        return np.sort(1.0 / np.sort(np.linalg.eigvals(matrix @ free).real)[::-1][:2])

    coarse, fine = rates(100), rates(200)
    exact = punch_rates(2)
    error = np.abs(fine - exact)
    assert (error < 3e-4 * exact).all()
    assert (error < 0.4 * np.abs(coarse - exact)).all()
    # the spacing is π/2 + 0.155/n²
    assert np.diff(punch_rates(100))[-1] == pytest.approx(0.5 * math.pi, abs=0.16 / 99.0**2)


def test_pressure_at_the_centre_of_a_punch() -> None:
    """From a rigid flat punch to even pressure; backward Euler steps err by their size."""
    punch = WearingPunch(1.0, 1.0, 1.0)
    rings = Rings(1.0 - (1.0 - np.linspace(0.0, 1.0, 161)) ** 1.5, 1.0)
    for distance in (0.2, 1.0):
        found = [worn(rings, np.zeros(160), math.pi, Coating(1.0, 1.0), distance, 1.0, 1.0 / n) for n in (40, 80)]
        coarse, fine = (one.pressure[0] for one in found)
        assert punch.at_distance(distance).centre == pytest.approx(2.0 * fine - coarse, abs=2e-3)
    start = punch.at_distance([0.0, 0.05])
    assert start.centre[0] == 0.5
    assert np.isnan(start.centre[1])
    assert punch.at_distance(50.0).centre == pytest.approx(1.0, abs=1e-15)


def rings_of(row: Row) -> tuple[WearingCoatedSphere, float, WornProfile]:
    """Theory, distance and rings of a row."""
    names = ("E_star_Pa", "R_m", "P_N", "k_coating_m2_per_N", "k_substrate_m2_per_N", "coating_thickness_m")
    E, R, P, k1, k2, t = (float(row[name]) for name in names)
    theory, s = WearingCoatedSphere(E, R, P, k1, k2, t), float(row["sliding_distance_m"])
    outer = 1.1 * float(theory.at_distance(s).radius)
    return theory, s, worn_sphere(E, R, P, Coating(k1, k2, t), s, outer, 150)


RING = 0.5 * 1.1 / 150.0
"""The edge of the contact lies within half a ring, over the radius."""


def handbook(row: Row) -> tuple[float, float, float, float]:
    """Hertz's radius, break-through, radius and depth of a row by the formulas that it was made
    with: the contact is that of Hertz plus the worn cap, and the ring is all of the contact at
    break-through."""
    names = ("E_star_Pa", "R_m", "P_N", "k_coating_m2_per_N", "k_substrate_m2_per_N", "coating_thickness_m")
    E, R, P, k1, k2, t = (float(row[name]) for name in names)
    s, hertz = float(row["sliding_distance_m"]), math.cbrt(0.75 * P * R / E)
    ring = hertz**2 + 2.0 * R * t
    life = math.pi * (ring**2 - hertz**4) / (4.0 * R * k1 * P)
    square = math.sqrt(hertz**4 + 4.0 * R * k1 * P * min(s, life) / math.pi)
    linear, quadratic, work = math.pi * ring / k1, math.pi * R / k2, P * max(s - life, 0.0)
    core = 2.0 * work / (linear + math.sqrt(linear**2 + 4.0 * quadratic * work))
    return hertz, life, math.sqrt(square + 2.0 * R * core), (square - hertz**2) / (2.0 * R) + core


@every_row(SPHERES, lambda row: f"row {row['case']}")
def test_rows_of_spheres_follow_their_formulas(row: Row) -> None:
    columns = ("a_hertz_m", "s_breakthrough_m", "a_m", "wear_depth_m")
    assert handbook(row) == pytest.approx([float(row[name]) for name in columns], rel=1e-11)
    assert WearingCoatedSphere(
        float(row["E_star_Pa"]), float(row["R_m"]), float(row["P_N"]), 1e-15, 1e-15, 1e-6
    ).hertz_radius == pytest.approx(float(row["a_hertz_m"]), rel=1e-11)


@pytest.mark.slow
@every_row(WORN, lambda row: f"row {row['case']}")
def test_rows_of_spheres_are_too_small(row: Row) -> None:
    """By solutions on rings: the depth of the rows is too small by 1 to 35 %, since Hertz's radius
    is counted in the ring of coating, and its pressure at the centre is not 1.5 times the mean
    one; the theory meets the rings."""
    theory, s, rings = rings_of(row)
    found = theory.at_distance(s)
    ratio = float(found.hertz_ratio)
    assert 0.6 < float(row["wear_depth_m"]) / rings.depth[0] < 0.99
    assert 0.85 < float(row["a_m"]) / rings.radius < 1.0 + RING
    assert found.radius == pytest.approx(rings.radius, rel=RING + (0.021 if s < theory.life else 1e-3))
    if s < theory.life:
        assert found.depth == pytest.approx(rings.depth[0], rel=0.03)
        return
    # the larger the contact, the less the start counts
    assert found.depth == pytest.approx(rings.depth[0], rel=0.3 / ratio**2)
    core = np.interp(-theory.thickness, -rings.depth, rings.rings.radii)
    assert found.core == pytest.approx(core, rel=0.2 / ratio**2 + 5e-4)


@pytest.mark.slow
def test_sphere_without_a_coating_beside_rings() -> None:
    """What its docstring states of radius and depth at all distances."""
    ball = WearingSphere(1.0, 1.0, 4e-6 / 3.0, 1.0)
    unit = 0.25 * math.pi * ball.hertz_radius**4 / ball.load
    for share in (0.02, 0.3, 1.0, 3.0, 5.0, 11.0, 15.0, 30.0, 1000.0):
        found = ball.at_distance(share * unit)
        rings = worn_sphere(1.0, 1.0, ball.load, Coating(1.0, 1.0), share * unit, 1.1 * float(found.radius), 150)
        late = found.radius > 2.0 * ball.hertz_radius
        assert found.radius == pytest.approx(rings.radius, rel=RING + (0.01 if late else 0.025))
        assert found.depth == pytest.approx(rings.depth[0], rel=0.01 if late else 0.035)
        assert found.volume == pytest.approx(rings.volume, rel=1e-12)


def test_cylinder_beside_the_solver() -> None:
    """What its docstring states of half-width and depth; worn section by Archard."""
    theory = WearingCylinder(1e11, 5e-3, 2e4, 1e-14)
    hertz = theory.hertz_half_width
    for share in (0.02, 0.3, 1.0, 3.0, 30.0):
        s = share * hertz**3 / (1.5 * theory.radius * theory.coefficient * theory.load)
        found = theory.at_distance(s)
        points, late = 300, float(found.half_width) > 3.0 * hertz
        dx = 2.4 * float(found.half_width) / points
        x = (np.arange(points) - 0.5 * (points - 1)) * dx
        surface = asp.Surface((-(x**2) / (2.0 * theory.radius))[:, None], dx, 1.0)
        problem = asp.ContactProblem(surface, asp.Elastic(0.91e11, 0.3), boundary=asp.FreeLine())
        history = worn_by_solver(problem, asp.Force(theory.load), s, archard(theory.coefficient), steps=STEPS)
        width = 0.5 * dx * np.count_nonzero(history.last.pressure)
        pixel = dx / float(found.half_width)
        assert found.half_width == pytest.approx(width, rel=pixel + (0.005 if late else 0.04))
        assert found.depth == pytest.approx(history.body_depth.max(), rel=0.005 if late else 0.04)
        assert found.section == pytest.approx(history.worn_volume, rel=1e-9)


def test_break_through_of_a_sphere() -> None:
    """Depth, radius and pressure at the distance of break-through, early and late; all load is
    borne."""
    for thickness in (1e-8, 1e-6, 1e-4):
        ball = WearingCoatedSphere(1e11, 3e-3, 10.0, 1e-15, 1e-14, thickness)
        around = ball.at_distance(ball.life * np.array([1.0 - 1e-9, 1.0, 1.0 + 1e-9]))
        assert around.depth == pytest.approx(thickness, rel=1e-7)
        assert around.radius == pytest.approx(around.radius[0], rel=2e-2)
        assert around.core[:2].tolist() == [0.0, 0.0]
        later = ball.at_distance(ball.life * np.array([2.0, 10.0, 1e3]))
        assert (np.diff(later.core) > 0.0).all()
        ring = 2.0 * math.pi * ball.radius * thickness
        borne = later.coating_pressure * ring + later.substrate_pressure * math.pi * later.core**2
        assert borne == pytest.approx(10.0, rel=1e-12)
        assert later.coating_pressure == pytest.approx(10.0 * later.substrate_pressure, rel=1e-12)


def test_volumes_of_a_worn_coated_sphere() -> None:
    """Far from the start: V1/k1 + V2/k2 = P s, with the cap of the depth and that of the core."""
    ball = WearingCoatedSphere(1e11, 3e-3, 1e-3, 1e-15, 1e-14, 1e-6)
    s = 1e6
    found = ball.at_distance(s)
    worn_depth, gone = float(found.depth), float(found.depth) - ball.thickness
    core = math.pi * ball.radius * gone**2
    coating = math.pi * ball.radius * worn_depth**2 - core
    assert coating / 1e-15 + core / 1e-14 == pytest.approx(ball.load * s, rel=1e-3)


def test_caps_and_tracks() -> None:
    """Exact volumes by integration, the approximations of standards, and both inverses."""
    ball = WornCap(3e-3)
    scar = 3e-3 * np.array([1e-6, 1e-3, 0.15, 0.35, 1.0])
    found = ball.at_scar(scar)
    z = np.polynomial.legendre.leggauss(20)
    for a, volume in zip(scar[2:], found.volume[2:], strict=True):
        h = 3e-3 - math.sqrt(3e-3**2 - a**2)
        depth = 0.5 * h * (z[0] + 1.0)
        assert volume == pytest.approx(0.5 * h * (z[1] @ (math.pi * depth * (6e-3 - depth))), rel=1e-12)
    short = 1.0 - found.approximate / found.volume
    # as stated for diameters of 0.3 and 0.7 of the radius of the ball
    assert 0.005 < short[2] < 0.01
    assert 0.03 < short[3] < 0.05
    assert found.volume[:2] == pytest.approx(found.approximate[:2], rel=1e-6)
    test = ball.of_test(3e-4, load=10.0, distance=1000.0)
    pin = PinOnDisk(3e-3, 10.0, 1e-2, float(test.coefficient), 0.0).at_distance(1000.0)
    assert pin.scar_radius == pytest.approx(3e-4, rel=1e-12)
    assert pin.track_depth == 0.0
    width = 3e-3 * np.array([1e-5, 0.3, 0.8, 2.0])
    section = track_section(width, 3e-3)
    for w, area in zip(width[1:], section[1:], strict=True):
        x = 0.5 * w * np.sin(0.5 * math.pi * z[0])
        weight = 0.25 * math.pi * w * np.cos(0.5 * math.pi * z[0]) * z[1]
        height = np.sqrt(3e-3**2 - x**2) - math.sqrt(max(3e-3**2 - 0.25 * w**2, 0.0))
        assert area == pytest.approx(weight @ height, rel=1e-9)
    short = 1.0 - width**3 / (12.0 * 3e-3) / section
    assert abs(short[0]) < 1e-9
    assert 0.005 < short[1] < 0.01
    assert 0.03 < short[2] < 0.05
    disk = PinOnDisk(3e-3, 10.0, 1e-2, 0.0, 1e-15)
    for w, area in zip(width[:3], section[:3], strict=True):
        distance = 2.0 * math.pi * 1e-2 * area / (1e-15 * 10.0)
        answer = disk.at_distance(distance)
        assert answer.track_width == pytest.approx(w, rel=1e-9)
        assert answer.track_depth == pytest.approx(3e-3 - math.sqrt(3e-3**2 - 0.25 * w**2), rel=1e-4)


def test_shapes_hold_beside_a_body_that_wears_little() -> None:
    """The one of the two that wears more has the shape that it has alone; volumes always hold."""
    for k, scar, track in ((0.0, True, True), (1e-21, False, True), (1e-17, False, False), (1e-14, True, False)):
        test = PinOnDisk(3e-3, 10.0, 1e-2, k, 1e-15)
        limits = test.validity(test.at_distance([0.0, 1000.0]))
        assert [limit.holds.tolist() for limit in limits] == [[True, scar], [True, track]]
        assert not any(limit.concerns("pin_volume") for limit in limits)


def test_laws() -> None:
    pad = ArchardWear(wear_coefficient(1e-5, 1e9), 10.0, 1e-6, 2e-6, 1e-16)
    s = np.array([0.5, 1.0, 1.5]) * pad.life
    assert pad.at_distance(s).depth == pytest.approx([1e-6, 2e-6, 2e-6 + 0.5e-14 * 1e7 * pad.life], rel=1e-12)
    assert ArchardWear(1e-14, 10.0, 1e-6).life == 0.0
    assert ArchardWear(1e-14, 10.0, 1e-6, 1e-6).life == math.inf
    assert ArchardWear(1e-14, 10.0, 1e-6, 1e-6).at_distance(1e9).depth == 0.0
    energy = DissipatedEnergyWear(4e-14, 0.5, threshold=10.0)
    assert energy.at_energy([5.0, 10.0, 12.0]).volume == pytest.approx([0.0, 0.0, 8e-14])
    cycles = energy.at_cycles(1000.0, load=100.0, amplitude=50e-6)
    assert cycles.energy == pytest.approx(0.5 * 100.0 * 1000.0 * 4.0 * 50e-6)
    surface = WornComposite(1e-13, 1e-15, 0.2)
    found = surface.at_pressure(1e6)
    assert 0.8 * found.pressure_1 + 0.2 * found.pressure_2 == pytest.approx(1e6)
    assert 1e-13 * found.pressure_1 == pytest.approx(1e-15 * found.pressure_2)
    assert found.share_2 == pytest.approx(0.2 * found.pressure_2 / 1e6)


def test_what_is_refused() -> None:
    with refused(InputError, "radius of the scar (m)", "0.003", "0.004"):
        WornCap(3e-3).at_scar(4e-3)
    with refused(InputError, "worn volume of the pin (m³)"):
        PinOnDisk(1e-3, 10.0, 1e-2, 1e-9, 0.0).at_distance(1.0)
    with refused(InputError, "cross-section of the track (m²)"):
        PinOnDisk(1e-3, 10.0, 1e-2, 0.0, 1e-7).at_distance(1.0)
    with refused(InputError, "width of the track (m)", "0.002", "0.003"):
        track_section(3e-3, 1e-3)
    with refused(InputError, "number of modes", "100", "101"):
        punch_rates(101)
    with refused(InputError, "amplitude of the slip (m)", "0"):
        DissipatedEnergyWear(4e-14, 0.5).at_cycles(1.0, 1.0, 0.0)
