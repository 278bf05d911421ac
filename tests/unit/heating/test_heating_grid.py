"""Flash temperature on a grid: the reference values, limits, and what must hold by itself."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from heating_cases import COATED, STEEL, ZIRCONIA, flat, given, hertz, rough, solid, waves
from reference_data import Row, every_row, reference
from refusals import refused

import asperity as asp
from asperity.core.errors import InputError
from asperity.heating import HeatedInterface, Motion, flash_temperature
from asperity.physics.heating.answer import FrictionalHeating
from asperity.physics.heating.heating import heating_of

MATERIALS = {"steel": STEEL, "zirconia": ZIRCONIA, "coated": COATED}
PLAIN = HeatedInterface()


def of_row(row: Row) -> FrictionalHeating:
    """The rough example under what a row says."""
    first, second = str(row["pair"]).replace("_interface_one", "").replace("_interface_both", "").split("_on_")
    result = rough(MATERIALS[first], MATERIALS[second], free=row["boundary"] == "free")
    between = HeatedInterface(
        (float(row["R1_m2K_per_W"]), float(row["R2_m2K_per_W"])),
        (300.0, 300.0 + float(row["bulk_2_minus_1_K"])),
    )
    heat = 0.3 * float(row["v_heat_m_per_s"]) * result.pressure
    return heating_of(result, Motion.of(float(row["v_m_per_s"])), heat, between)


@every_row(reference("heating/rough_64"), label=lambda row: str(row["case"]))
def test_rough_contacts(row: Row) -> None:
    """Dense solution of the same discrete problem: the pressures have ten digits, and of the lowest
    flux cancellation leaves six."""
    found = of_row(row)
    on = found.contact
    expected = {
        "fraction_to_1": found.share,
        "T_max_K": found.maximum,
        "T_contact_mean_K": found.mean,
        "T_flux_mean_K": found.flux_mean,
        "surface_1_contact_mean_K": found.surface_1[on].mean(),
        "q1_min_W_per_m2": found.heat_1[on].min(),
        "q1_max_W_per_m2": found.heat_1.max(),
        "T_max_all_to_1_K": found.alone[0],
        "T_max_all_to_2_K": found.alone[1],
    }
    for name, value in expected.items():
        assert value == pytest.approx(row[name], rel=1e-6), name
    assert found.hottest == (row["i_max"], row["j_max"])
    assert found.place == pytest.approx(((row["i_max"] + 0.5) * 1e-6, (row["j_max"] + 0.5) * 1e-6), rel=1e-12)
    assert found.mismatch < 1e-8 * found.maximum
    assert found.power == pytest.approx(0.3 * row["v_heat_m_per_s"] * found.normal_force, rel=1e-12)
    assert found.work > 0.0
    if not (row["R1_m2K_per_W"] or row["R2_m2K_per_W"]):
        assert found.blok == pytest.approx(row["T_max_blok_K"], rel=1e-6)


def test_fields_of_a_rough_contact() -> None:
    found = flash_temperature(rough(), Motion.of(1.0), 0.3)
    rows = reference("heating/rough_fields_64")
    at = np.array([[int(row["i"]), int(row["j"])] for row in rows]).T
    for name, field in (("q", found.heat), ("q1", found.heat_1), ("T", found.temperature)):
        column = "T_K" if name == "T" else f"{name}_W_per_m2"
        known = np.array([row[column] for row in rows])
        np.testing.assert_allclose(field[at[0], at[1]], known, rtol=1e-6, atol=1e-7 * np.abs(known).max())
    assert np.isnan(found.temperature[~found.contact]).all()


@every_row(reference("heating/two_body_sphere"), label=lambda row: str(row["case"]))
def test_a_sphere_converges_with_the_pixels(row: Row) -> None:
    """Squares in a disc err by the mean of the edge: measured 0.7 % of the maximum and 1.4 % of the
    mean at 16 pixels across, 0.04 and 0.2 % at 64; of opposite bodies twice that."""
    motion = Motion((2.0 * float(row["peclet_1"]), 0.0), (2.0 * float(row["peclet_2"]), 0.0))
    k = float(row["k1_over_k2"])
    opposite = 2.0 if float(row["peclet_1"]) < 0.0 else 1.0
    off = []
    for pixels in (16, 64):
        result = hertz(pixels, solid(k, k), solid(1.0, 1.0))
        found = heating_of(result, motion, result.pressure)
        shared = found.share / float(row["fraction_to_1"]) - 1.0
        off.append([shared, found.maximum / float(row["theta_max"]) - 1.0, found.mean / float(row["theta_mean"]) - 1.0])
    share, largest, mean = np.abs(off[1])
    assert share < 2.5e-3
    assert largest < 4e-4 * opposite
    assert mean < 2.2e-3 * opposite
    assert mean < 0.25 * abs(off[0][2])


@every_row(reference("heating/layered_sources")[:20:2], label=lambda row: str(row["case"]))
def test_a_layered_body_in_free_contact(row: Row) -> None:
    """A disc with the share of each pixel that it covers: measured 4e-4 at most at 32 pixels."""
    pixels, a = 32, 1.0
    thickness, ratio = float(row["h_over_a"]), float(row["k1_over_k2"])
    film = solid(ratio, ratio / float(row["kappa1_over_kappa2"]))
    body = asp.Layered([asp.Layer(film, thickness)], solid(1.0, 1.0))
    problem = flat((pixels + 1, pixels + 1), 2.0 * a / pixels, asp.Rigid(), body, asp.Free())
    x = (np.arange(pixels + 1) - pixels / 2) * 2.0 / pixels
    fine = (x[:, None] + ((np.arange(8) + 0.5) / 8 - 0.5) * 2.0 / pixels).ravel()
    covered = (fine[:, None] ** 2 + fine[None, :] ** 2 < 1.0).reshape(pixels + 1, 8, pixels + 1, 8).mean((1, 3))
    flux = covered * math.pi / (covered.sum() * problem.grid.pixel_area)
    result = given(problem, covered > 0.0, flux)
    found = heating_of(result, Motion.of(2.0 * float(row["peclet_substrate"])), flux)
    assert found.surface_2[pixels // 2, pixels // 2] == pytest.approx(row["theta_centre"], rel=5e-4)
    assert np.isnan(found.surface_1).all()


def test_at_rest_every_point_shares_alike() -> None:
    """k1/(k1 + k2), whatever the contact (both homogeneous)."""
    for free in (False, True):
        result = rough(STEEL, ZIRCONIA, free=free)
        found = heating_of(result, Motion.of(0.0), 0.3 * result.pressure)
        on = found.contact
        np.testing.assert_allclose(
            found.heat_1[on], 46.0 / 48.5 * found.heat[on], rtol=1e-7, atol=1e-9 * found.heat.max()
        )


def test_equal_bodies_with_equal_velocity_take_half_each() -> None:
    result = rough()
    found = heating_of(result, Motion((3.0, 1.0), (3.0, 1.0)), 0.3 * result.pressure)
    on = found.contact
    np.testing.assert_allclose(found.heat_1[on], 0.5 * found.heat[on], rtol=1e-7, atol=1e-9 * found.heat.max())


def test_a_large_resistance_sends_all_to_the_other() -> None:
    for resistance, share in (((1e3, 0.0), 0.0), ((0.0, 1e3), 1.0)):
        found = flash_temperature(rough(), Motion.of(1.0), 0.3, HeatedInterface(resistance))
        assert found.share == pytest.approx(share, abs=1e-6)


def test_a_difference_of_the_bulk_temperatures_alone_is_thermal_conductance() -> None:
    """The same discrete equation as that of the conductance, which is solved by another code."""
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(5e-8), hurst=0.8, rolloff_wavelength=3.2e-5, shortest_wavelength=8e-6
    )
    surface = asp.generate.gaussian(asp.Grid((64, 64), (1e-6, 1e-6)), spectrum, seed=3)
    for boundary in (asp.Periodic(), asp.Free()):
        problem = asp.ContactProblem(surface, STEEL, counter_body=ZIRCONIA, boundary=boundary)
        result = asp.solve(problem, asp.MeanPressure(2e8))
        between = HeatedInterface(bulk=(300.0, 310.0))
        found = heating_of(result, Motion.of(0.0), np.zeros((64, 64)), between)
        flow = float(found.heat_1.sum()) * problem.grid.pixel_area
        known = asp.conductance.conductance(result, "thermal")
        assert flow == pytest.approx(10.0 * known.total, rel=1e-5)


def test_a_layer_like_its_base_changes_nothing() -> None:
    same = asp.Layered([asp.Layer(STEEL, 1.5e-6)], STEEL)
    for free in (False, True):
        plain = flash_temperature(rough(STEEL, STEEL, free=free), Motion.of(1.0), 0.3)
        coated = flash_temperature(rough(STEEL, same, free=free), Motion.of(1.0), 0.3)
        np.testing.assert_allclose(coated.surface_2, plain.surface_2, rtol=1e-6, atol=1e-7 * plain.maximum)


@pytest.mark.parametrize("free", [False, True])
def test_the_wake_lies_where_the_material_goes(free: bool) -> None:
    """Turning the motion round on a mirrored contact mirrors everything; the moving body is hotter
    behind its spots."""
    result = rough(free=free)
    ahead = flash_temperature(result, Motion.of(10.0), 0.3)
    back = flash_temperature(result, Motion.of(10.0, direction=math.pi), 0.3)
    assert ahead.wake > 0.0
    assert back.wake > 0.0
    mirrored = given(result.problem, result.contact[::-1], result.pressure[::-1])
    turned = flash_temperature(mirrored, Motion.of(10.0, direction=math.pi), 0.3)
    np.testing.assert_allclose(turned.surface_2[::-1], ahead.surface_2, rtol=1e-7, atol=1e-8 * ahead.maximum)
    flux = ahead.heat - ahead.heat_1
    behind, before = (float((ahead.surface_2 * np.roll(flux, shift, 0)).sum()) for shift in (2, -2))
    assert behind > before


def test_motion_along_y_is_that_along_x_of_the_turned_contact() -> None:
    result = rough(STEEL, COATED)
    turned = given(result.problem, result.contact.T, result.pressure.T)
    along_x = flash_temperature(result, Motion.of(1.0), 0.3)
    along_y = flash_temperature(turned, Motion.of(1.0, direction=math.pi / 2.0), 0.3)
    np.testing.assert_allclose(along_y.surface_1.T, along_x.surface_1, rtol=1e-7, atol=1e-8 * along_x.maximum)
    free = given(rough(STEEL, COATED, free=True).problem, result.contact, result.pressure)
    other = given(free.problem, result.contact.T, result.pressure.T)
    first = flash_temperature(free, Motion.of(1.0), 0.3)
    second = flash_temperature(other, Motion.of(1.0, direction=math.pi / 2.0), 0.3)
    np.testing.assert_allclose(second.surface_2.T, first.surface_2, rtol=1e-7, atol=1e-8 * first.maximum)


def test_oblique_motion_lies_between() -> None:
    found = [flash_temperature(rough(), Motion.of(10.0, direction=a), 0.3).maximum for a in (0.0, 0.4, math.pi / 2.0)]
    assert min(found[0], found[2]) < found[1] * 1.05
    assert found[1] < 1.1 * max(found[0], found[2])


def test_a_free_patch_of_many_is_hotter_than_a_periodic_one_by_the_nominal_rise() -> None:
    periodic = flash_temperature(rough(), Motion.of(1.0), 0.3)
    free = flash_temperature(rough(free=True), Motion.of(1.0), 0.3)
    assert periodic.maximum == pytest.approx(19.55, abs=0.01)
    assert free.maximum == pytest.approx(27.89, abs=0.01)
    assert periodic.share == pytest.approx(0.4956, abs=1e-4)


@pytest.mark.parametrize(
    ("points", "maximum", "flux_mean", "mean"),
    [(64, 19.55, 8.60, 5.94), (128, 19.67, 8.61, 6.12), (256, 19.67, 8.61, 6.20)],
)
def test_refinement_of_the_rough_contact(points: int, maximum: float, flux_mean: float, mean: float) -> None:
    """Solved from its surface: maximum and mean weighted with the heat converge, the plain mean
    follows the contact area. The numbers expected are rounded to the last digit."""
    steel = replace(STEEL, youngs_modulus=2.0 * 115e9 * (1.0 - 0.3**2))
    problem = asp.ContactProblem(waves(points), steel, counter_body=steel)
    found = flash_temperature(asp.solve(problem, asp.MeanPressure(1e8)), Motion.of(1.0), 0.3)
    assert found.maximum == pytest.approx(maximum, abs=0.0051)
    assert found.flux_mean == pytest.approx(flux_mean, abs=0.0051)
    assert found.mean == pytest.approx(mean, abs=0.0051)


def test_the_mean_is_that_of_the_sinks() -> None:
    """Two bodies at rest over equal sinks: half of the mean flux through each."""
    result = rough()
    heat = 0.3 * result.pressure
    deep = heating_of(result, Motion.of(0.0), heat, HeatedInterface(sink=(1e-3, 1e-3)))
    mean = heating_of(result, Motion.of(0.0), heat)
    np.testing.assert_allclose(deep.surface_1 - mean.surface_1, 0.5 * heat.mean() * 1e-3 / 46.0, rtol=1e-6)


def test_temperature_below_the_surface() -> None:
    """At the surface it is that of the surface; it falls with depth; one layer of the same material
    changes nothing, in the layer and below it."""
    depths = (0.0, 1e-6, 2e-6, 5e-6)
    for free in (False, True):
        found = flash_temperature(rough(free=free), Motion.of(1.0), 0.3)
        row = found.hottest[1]
        first, second = found.section(depths)
        np.testing.assert_allclose(first[0], found.surface_1[:, row], rtol=1e-6, atol=1e-7 * found.maximum)
        np.testing.assert_allclose(second[0], found.surface_2[:, row], rtol=1e-6, atol=1e-7 * found.maximum)
        assert np.all(np.diff(second.max(axis=1)) < 0.0)
        same = asp.Layered([asp.Layer(STEEL, 1.5e-6)], STEEL)
        layered = flash_temperature(rough(STEEL, same, free=free), Motion.of(1.0), 0.3)
        np.testing.assert_allclose(layered.section(depths)[1], second, rtol=1e-5, atol=1e-5 * found.maximum)


def test_depth_in_units_of_a_square_source() -> None:
    """Handbook values of a uniform square: T k/(q l) = 0.9400585 at rest, 0.2 l below its
    centre."""
    n = 40
    problem = flat((n, n), 2.0 / n, solid(1.0, 1.0), asp.Rigid(), asp.Free())
    result = given(problem, np.ones((n, n), bool), np.ones((n, n)))
    found = heating_of(result, Motion.of(0.0), result.pressure)
    line = found.section([0.2])[0][0]
    # the centre is a corner of pixels: midway between the points beside it, and the curvature there
    middle = 0.5 * (line[n // 2 - 1] + line[n // 2])
    assert middle == pytest.approx(0.9400585247, rel=2e-3)


def test_joule_heat_adds_its_rise() -> None:
    """Equal bodies: V²/8ρk (Kohlrausch for a small rise)."""
    cold = flash_temperature(rough(), Motion.of(1.0), 0.3)
    found = flash_temperature(rough(), Motion.of(1.0), 0.3, voltage=0.01)
    assert found.joule == pytest.approx(0.01**2 / (8.0 * 1e-7 * 46.0))
    assert found.maximum == pytest.approx(cold.maximum + found.joule)


def test_the_bulge_of_a_body_at_rest_is_local_to_the_heat() -> None:
    """Barber: the curvature of the surface is -α(1 + ν)/k times the flux there."""
    result = rough(STEEL, asp.Rigid())
    found = heating_of(result, Motion.of(0.0), 0.3 * result.pressure)
    u = found.displacement()
    assert abs(u.mean()) < 1e-12 * np.abs(u).max()
    qx, qy = result.problem.grid.wavevector()
    curvature = np.fft.irfft2(-(qx**2 + qy**2) * np.fft.rfft2(u), s=(64, 64))
    expected = -12e-6 * 1.3 / 46.0 * (found.heat - found.heat.mean())
    np.testing.assert_allclose(curvature, expected, atol=1e-9 * np.abs(expected).max())
    with refused(InputError, "contact", "free"):
        heating_of(rough(STEEL, asp.Rigid(), free=True), Motion.of(0.0), result.pressure).displacement()


def test_instability_is_found_beyond_the_critical_wavelength() -> None:
    """4πk/(μ v α (1 + ν) E*): 1.07 mm of steel at 1 m/s, 64 µm from 17 m/s on."""
    found = flash_temperature(rough(), Motion.of(20.0), 0.3)
    assert found.critical_wavelength == pytest.approx(53.5e-6, rel=0.01)
    assert "thermoelastic instability" in {item.criterion for item in found.findings}
    slow = flash_temperature(rough(), Motion.of(1.0), 0.3)
    assert "thermoelastic instability" not in {item.criterion for item in slow.findings}


def test_distribution_and_spots() -> None:
    found = flash_temperature(rough(), Motion.of(1.0), 0.3)
    hot, share = found.distribution()
    assert hot[0] == found.maximum
    assert share[-1] == 1.0
    assert np.all(np.diff(hot) <= 0.0)
    assert found.mean == pytest.approx(hot.mean())
    assert found.pixel_peclet == pytest.approx(1e-6 / (4.0 * 46.0 / 3.8e6))
    assert found.spot_peclet > found.pixel_peclet
    assert 1 <= found.spot_pixels <= found.contact.sum()


def test_friction_of_the_problem_makes_the_heat() -> None:
    """Gross sliding and a coefficient that is given make the same; a stuck contact makes none."""
    x = (np.arange(48) - 23.5) * 1e-6
    ball = asp.Surface(-(x[:, None] ** 2 + x[None, :] ** 2) / 2e-3, 1e-6)
    law = asp.friction.Coulomb(0.3, coupled=False)
    sliding = asp.solve(
        asp.ContactProblem(ball, STEEL, counter_body=STEEL, boundary=asp.Free(), friction=law), asp.Force(0.2)
    )
    by_law = flash_temperature(sliding, Motion.of(1.0))
    assert by_law.heat == pytest.approx(0.3 * sliding.pressure)
    assert by_law.power == pytest.approx(0.3 * 0.2, rel=1e-6)
    problem = asp.ContactProblem(
        ball, STEEL, counter_body=STEEL, boundary=asp.Free(), friction=asp.friction.Coulomb(0.3)
    )
    partly = asp.solve(problem, asp.Step(asp.Force(0.2), asp.friction.TangentialForce(0.03)))
    found = flash_temperature(partly, Motion.of(1.0))
    stuck = ~partly.stick_slip.slipping
    assert np.all(found.heat[stuck] == 0.0)
    assert 0.0 < found.power < 0.3 * 0.2
    assert found.heat.max() <= 0.3 * partly.pressure.max() * 1.0000001
    nothing = asp.solve(asp.ContactProblem(ball, STEEL, boundary=asp.Free()), asp.Force(0.2))
    with refused(InputError, "friction coefficient"):
        flash_temperature(nothing, Motion.of(1.0))


def test_full_contact_needs_sinks() -> None:
    problem = flat((8, 8), 1e-6, STEEL, STEEL, asp.Periodic())
    result = given(problem, np.ones((8, 8), bool), np.full((8, 8), 1e8))
    with refused(InputError, "heat sinks"):
        flash_temperature(result, Motion.of(1.0), 0.3)
    found = flash_temperature(result, Motion.of(1.0), 0.3, HeatedInterface(sink=(1e-3, 3e-3)))
    assert found.share == pytest.approx(0.75)
    assert found.maximum == pytest.approx(0.75 * 3e7 * 1e-3 / 46.0)


REFUSED: dict[str, tuple[Any, str]] = {
    "conductivity": (lambda: flash_temperature(rough(asp.Elastic(1e9, 0.3)), Motion.of(1.0), 0.3), "conductivity"),
    "two rigid": (lambda: flash_temperature(replaced(asp.Rigid(), asp.Rigid()), Motion.of(1.0), 0.3), "body"),
    "speed": (lambda: Motion.of(-1.0), "sliding speed"),
    "moving": (lambda: Motion.of(1.0, "both"), "moving body"),  # type: ignore[arg-type]
    "rolling": (lambda: Motion.of(1.0, rolling=2.0), "rolling speed"),
    "friction": (lambda: flash_temperature(rough(), Motion.of(1.0), -0.3), "friction coefficient"),
    "film": (lambda: HeatedInterface((-1.0, 0.0)), "specific resistance"),
    "sink": (lambda: HeatedInterface(sink=(0.0, 1.0)), "depth of a heat sink"),
    "bulk": (lambda: HeatedInterface(bulk=(0.0, 300.0)), "temperature of a body"),
    "bonds": (
        lambda: flash_temperature(rough(), Motion.of(1.0), 0.3, HeatedInterface(bonds=((1e-7,), ()))),
        "bonds of the body",
    ),
    "sink of a free contact": (
        lambda: flash_temperature(rough(free=True), Motion.of(1.0), 0.3, HeatedInterface(sink=(1e-3, 1e-3))),
        "depth of a heat sink",
    ),
    "oblique and layered": (
        lambda: flash_temperature(rough(COATED, STEEL, free=True), Motion.of(1.0, "body", direction=0.4), 0.3),
        "direction of motion",
    ),
    "rigid base of a free contact": (
        lambda: flash_temperature(
            rough(asp.Layered([asp.Layer(STEEL, 1e-5)], asp.RigidBase()), STEEL, free=True), Motion.of(1.0), 0.3
        ),
        "base of a layered body",
    ),
}


def replaced(body: Any, counter: Any) -> Any:
    """The rough example with bodies that no problem would take."""
    result = rough()
    problem = result.problem
    object.__setattr__(problem, "body", body)
    object.__setattr__(problem, "counter_body", counter)
    return result


@pytest.mark.parametrize("name", REFUSED)
def test_refused(name: str) -> None:
    call, subject = REFUSED[name]
    with pytest.raises(InputError) as error:
        call()
    assert subject in str(error.value)


def test_rolling_with_creep_moves_both() -> None:
    motion = Motion.of(0.2, "rolling", rolling=5.0)
    assert motion.body == pytest.approx((4.9, 0.0))
    assert motion.counter_body == pytest.approx((5.1, 0.0))
    assert motion.speed == pytest.approx(0.2)
    assert Motion.of(2.0, "opposite").velocities == ((-1.0, 0.0), (1.0, 0.0))
    assert Motion.of(2.0, "body").velocities == ((-2.0, 0.0), (0.0, 0.0))
    assert replace(motion, body=(1.0, 2.0)).slip == pytest.approx((4.1, -2.0))


def test_a_rigid_base_keeps_its_temperature() -> None:
    """A plate on it whose depth is that of a sink of its own material."""
    plate = asp.Layered([asp.Layer(STEEL, 2e-5)], asp.RigidBase())
    found = flash_temperature(rough(plate, STEEL), Motion.of(0.0), 0.3)
    assert found.heat.any() == 0
    heat = 0.3 * found.problem.surface.heights + 1.0
    deep = heating_of(rough(plate, asp.Rigid()), Motion.of(0.0), heat)
    assert deep.surface_1 == pytest.approx(2e-5 / 46.0)
