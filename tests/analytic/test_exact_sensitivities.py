"""Sensitivities of contacts with exact answers: Westergaard's wave and spheres on coatings.

The edge of a contact lies somewhere between pixels, which scatters derivatives by some per mille.
Grids on which it lies elsewhere show by how much: the mean over them must be exact within their
range.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

import numpy as np
import pytest
from reference_data import Row, reference

import asperity as asp
from asperity.contact.result import ContactResult
from asperity.sensitivities import (
    EdgeArea,
    FirstYield,
    PressureAt,
    PressureNorm,
    Sensitivities,
    StressNorm,
    sensitivities,
    uncertainty,
    yield_load,
)
from asperity.solvers import ActiveSet

CLOSE = ActiveSet(tolerance=1e-8)


def number(row: Row, name: str) -> float:
    """The number in a column."""
    return float(row[name])


def assert_exact(found: Iterable[Mapping[str, float]], wanted: Mapping[str, float], most: float) -> None:
    """The mean over grids is ``wanted`` within their range, which relative to it is at most
    ``most``."""
    several = list(found)
    for name, exact in wanted.items():
        values = np.array([one[name] for one in several])
        spread = float(np.ptp(values))
        assert spread <= most * abs(exact), name
        assert abs(values.mean() - exact) <= spread + 1e-6 * abs(exact), name


@pytest.mark.parametrize(
    "row", reference("sensitivities/westergaard_sensitivities"), ids=lambda row: f"{row['case']:g}"
)
def test_waves(row: Row) -> None:
    norm, found = PressureNorm(number(row, "m")), []
    for n in (1000, 1003, 1010, 1017, 1026, 1033):
        wave = np.cos(2.0 * np.pi * np.arange(n) / n)[:, None]
        problem = asp.ContactProblem(asp.Surface(0.01 * wave, 1.0 / n, 1.0), asp.Elastic(1.0, 0.0))
        result = asp.solve(problem, asp.MeanPressure(number(row, "pbar")), solver=CLOSE)
        of_norm = sensitivities(result, norm, ("force", "heights", "body.youngs_modulus"))
        found.append(
            {
                "p_norm": of_norm.value,
                "dnorm_dpbar": of_norm["force"],
                "dnorm_dEstar": of_norm["body.youngs_modulus"],
                "dnorm_dDelta": float((np.asarray(of_norm["heights"]) * wave).sum()),
                "dapproach_dpbar": sensitivities(result, "approach", "force")["force"],
            }
        )
    wanted = {name: number(row, name) for name in found[0]}
    assert_exact(found, wanted, 0.2 if row["pbar_over_pstar"] == 0.05 else 0.03)


@pytest.mark.parametrize(
    "row", reference("sensitivities/coated_sphere_sensitivities"), ids=lambda row: f"{row['case']:g}"
)
def test_coated_spheres(row: Row) -> None:
    E1, nu1, E2, nu2, h, R, P, a = (number(row, name) for name in ("E1", "nu1", "E2", "nu2", "h", "R", "P", "a"))
    body = asp.Layered([asp.Layer(asp.Elastic(E1, nu1), h)], asp.Elastic(E2, nu2))
    names = {
        "force": "P",
        "body.layers[0].thickness": "h",
        "body.layers[0].youngs_modulus": "E1",
        "body.layers[0].poisson_ratio": "nu1",
        "body.base.youngs_modulus": "E2",
        "body.base.poisson_ratio": "nu2",
    }
    found = []
    for reach in (1.20, 1.215, 1.23, 1.245, 1.26, 1.275):
        n = 96
        x = (np.arange(n) - 0.5 * n + 0.5) * (2.0 * reach * a / n)
        sphere = -0.5 * np.add.outer(x**2, x**2) / R
        problem = asp.ContactProblem(asp.Surface(sphere, x[1] - x[0]), body, boundary=asp.Free())
        result = asp.solve(problem, asp.Force(P), solver=CLOSE)
        # the zero of heights is the apex of the sphere, so that its approach is the offset down
        of_offset = sensitivities(result, "offset")
        one = {f"ddelta_d{symbol}": -float(of_offset[name]) for name, symbol in names.items()}
        one["ddelta_dR"] = float((np.asarray(of_offset["heights"]) * sphere).sum()) / R
        found.append(one)
    assert_exact(found, {name: number(row, name) for name in found[0]}, 0.02)


NAMES = {
    "force": "P",
    "body.layers[0].thickness": "h",
    "body.layers[0].youngs_modulus": "E1",
    "body.layers[0].poisson_ratio": "nu1",
    "body.base.youngs_modulus": "E2",
    "body.base.poisson_ratio": "nu2",
}


def pressed(row: Row, n: int, reach: float) -> ContactResult:
    """Sphere of a ``row`` on n² points, n odd, as wide as ``reach`` times the contact."""
    E1, nu1, E2, nu2, h, R, P, a = (number(row, name) for name in ("E1", "nu1", "E2", "nu2", "h", "R", "P", "a"))
    body = asp.Layered([asp.Layer(asp.Elastic(E1, nu1), h)], asp.Elastic(E2, nu2))
    x = (np.arange(n) - 0.5 * (n - 1)) * (2.0 * reach * a / n)
    sphere = -0.5 * np.add.outer(x**2, x**2) / R
    problem = asp.ContactProblem(asp.Surface(sphere, x[1] - x[0]), body, boundary=asp.Free())
    return asp.solve(problem, asp.Force(P), solver=CLOSE)


def worst(row: Row, key: str, found: Sensitivities, factor: float = 1.0) -> float:
    """Largest error of the derivatives θ dJ/dθ of ``key`` over the largest of them."""
    errors, sizes = [], []
    for name, symbol in NAMES.items():
        exact = number(row, f"d{key}_d{symbol}")
        sizes.append(abs(exact * number(row, symbol)))
        errors.append(abs((float(found[name]) * factor - exact) * number(row, symbol)))
    by_radius = -float((np.asarray(found["heights"]) * found.problem.profile()).sum()) * factor
    errors.append(abs(by_radius - number(row, f"d{key}_dR") * number(row, "R")))
    return max(errors) / max(sizes)


SPHERES = reference("sensitivities/coated_sphere_sensitivities")


@pytest.mark.parametrize("row", SPHERES, ids=lambda row: f"{row['case']:g}")
def test_stiffness_area_and_pressure_of_coated_spheres(row: Row) -> None:
    # the loads move the edge over a pixel and more; the mean over them leaves what is given here
    result, a = pressed(row, 41, 1.3), number(row, "a")
    stiffness, area = sensitivities(result, "stiffness"), sensitivities(result, "area")
    middle = 20 * result.problem.grid.spacing[0]
    center = sensitivities(result, PressureAt(middle, middle))
    assert stiffness.value == pytest.approx(number(row, "stiffness"), rel=5e-3)
    assert math.sqrt(area.value / math.pi) == pytest.approx(a, rel=0.01)
    assert center.value == pytest.approx(number(row, "p0"), rel=1e-3)
    assert abs(stiffness.euler_defect) < 1e-8
    assert worst(row, "stiffness", stiffness) < 0.05
    assert worst(row, "a", area, 1.0 / (2.0 * math.pi * a)) < 0.02
    assert abs(area.euler_defect) < 1e-8
    assert worst(row, "p0", center) < 0.04


@pytest.mark.slow
@pytest.mark.parametrize("row", SPHERES[:2], ids=lambda row: f"{row['case']:g}")
def test_stiffness_and_area_converge_in_the_grid(row: Row) -> None:
    factor = 1.0 / (2.0 * math.pi * number(row, "a"))
    errors = []
    for n in (41, 97):
        results = [pressed(row, n, reach) for reach in (1.3, 1.32, 1.34)]
        errors.append(
            [
                max(worst(row, "stiffness", sensitivities(each, "stiffness")) for each in results),
                max(worst(row, "a", sensitivities(each, "area"), factor) for each in results),
            ]
        )
    coarse, fine = errors  # those of the area are the secant's
    assert fine[0] < 0.015
    assert fine[1] < 0.01
    assert fine[0] < coarse[0]


WAVES = {number(row, "pbar_over_pstar"): row for row in reference("sensitivities/westergaard_sensitivities")}


@pytest.mark.parametrize("n", [101, 2001])
@pytest.mark.parametrize("row", WAVES.values(), ids=lambda row: f"{row['pbar_over_pstar']:g}")
def test_area_and_stiffness_of_waves(row: Row, n: int) -> None:
    wave = np.cos(2.0 * np.pi * np.arange(n) / n)[:, None]
    problem = asp.ContactProblem(asp.Surface(0.01 * wave, 1.0 / n, 1.0), asp.Elastic(1.0, 0.0))
    result = asp.solve(problem, asp.MeanPressure(number(row, "pbar")), solver=CLOSE)
    area = sensitivities(result, "area", ("force", "body.youngs_modulus", "heights"))
    # the secant over the loads; of 101 points the edge moves by one or two, or 5 are open
    error = 0.03 if n == 101 else 0.02
    assert area.value == pytest.approx(number(row, "contact_fraction"), rel=0.003)
    assert area["force"] == pytest.approx(number(row, "dfraction_dpbar"), rel=error)
    assert area["body.youngs_modulus"] == pytest.approx(number(row, "dfraction_dEstar"), rel=error)
    assert area.relative["heights"] == pytest.approx(-area.relative["force"], rel=1e-6)
    assert 0.85 < area.certificate.by_edges < 1.5
    stiffness = sensitivities(result, "stiffness", ("force", "body.youngs_modulus"))
    # the secant over loads from 0.85 to 1.15
    assert stiffness.value == pytest.approx(number(row, "stiffness"), rel=0.02)
    assert abs(stiffness.euler_defect) < 1e-8


def crossed(pressure: float, thickness: float = 0.08) -> ContactResult:
    """Crossed waves of 48 points on a stiff coating."""
    x = 2.0 * np.pi * (np.arange(48) + 0.3) / 48
    wave = 0.01 * np.add.outer(np.cos(x), np.cos(x - 0.1))
    body = asp.Layered([asp.Layer(asp.Elastic(3.0, 0.2), thickness)], asp.Elastic(1.0, 0.3))
    problem = asp.ContactProblem(asp.Surface(wave, 1.0 / 48), body)
    return asp.solve(problem, asp.MeanPressure(pressure), solver=CLOSE)


@pytest.mark.parametrize("pressure", [0.01, 0.05, 0.065])
def test_area_of_crossed_waves_up_to_nearly_full_contact(pressure: float) -> None:
    result = crossed(pressure)
    found = sensitivities(result, "area")
    touching = float(result.contact.mean())
    assert (touching > 0.85) == (pressure > 0.06)
    largest = max(abs(change) for change in found.relative.values())
    for name in ("force", "body.layers[0].youngs_modulus", "body.layers[0].thickness", "body.base.youngs_modulus"):
        step = 0.2 * (1.0 - touching)
        (up, _), (down, _) = found.again(name, step), found.again(name, -step)
        difference = (up - down) / (2.0 * step * found.value)
        # central differences by 2 to 20 % beside a mean over 85 to 115 % of the load
        assert found.relative[name] == pytest.approx(difference, abs=0.03 * largest), name


def test_load_at_yield_of_a_sphere() -> None:
    # √(3 J2) is largest on the axis, 0.62 p0 at 0.48 a for ν = 0.3 (Johnson 1985, sec. 4.2), so
    # that the load at yield goes with Y³ R²/E*²
    R, E, nu, Y = 1.0, 1.0, 0.3, 0.01
    p0 = Y / 0.6200
    a = math.pi * p0 * R * (1.0 - nu * nu) / (2.0 * E)
    exact = 2.0 / 3.0 * math.pi * a * a * p0
    x = (np.arange(49) - 24.0) * (2.5 * a / 49.0)
    sphere = -0.5 * np.add.outer(x**2, x**2) / R
    problem = asp.ContactProblem(asp.Surface(sphere, x[1] - x[0]), asp.Elastic(E, nu), boundary=asp.Free())
    result = asp.solve(problem, asp.Force(0.5 * exact), solver=CLOSE)
    found = yield_load(result, StressNorm(0, tuple(np.linspace(0.3, 0.7, 9) * a), m=512.0), strength=Y)
    assert found.load == pytest.approx(exact, rel=0.01)
    assert found.relative["strength"] == pytest.approx(3.0, rel=0.03)
    assert found.relative["body.youngs_modulus"] == pytest.approx(-2.0, rel=0.03)
    assert found.values["strength"] == pytest.approx(found.relative["strength"] * found.load / Y, rel=1e-9)
    R_share = -float((np.asarray(found.values["heights"]) * sphere).sum()) / found.load
    assert R_share == pytest.approx(2.0, rel=0.05)
    # what scales stresses and strength scales the load
    assert found.relative["strength"] + found.relative["body.youngs_modulus"] == pytest.approx(1.0, rel=1e-3)

    # so the load factor is lognormal, of this variance
    scatter = {"strength": 0.1, "body.youngs_modulus": 0.05, "heights": 0.02, "force": 0.03}
    of = FirstYield(StressNorm(0, tuple(np.linspace(0.3, 0.7, 9) * a), m=512.0), Y)
    bar = uncertainty(result, of, scatter, samples=6, seed=2)
    assert bar.value == pytest.approx(2.0, rel=0.01)
    assert bar.relative == pytest.approx(math.hypot(0.3, 0.1, 0.04, 0.03), rel=0.03)
    assert bar.parts == pytest.approx(
        {"strength": 0.3, "body.youngs_modulus": 0.1, "heights": 0.04, "force": 0.03}, rel=0.05
    )
    assert abs(bar.sensitivities.euler_defect) < 1e-3
    assert bar.sampled is not None
    # the heights alone move where the largest stress lies between planes
    assert bar.sampled.values == pytest.approx(bar.sampled.predicted, rel=0.02)
    test = bar.sensitivities.taylor("strength", (0.02, 0.01))
    assert test.differences[1] == pytest.approx(0.01 * 3.0 * bar.value, rel=0.05)


def test_area_by_its_edge_at_one_load() -> None:
    row = SPHERES[0]
    result = pressed(row, 61, 1.3)
    mean = result.force / (math.pi * number(row, "a") ** 2)
    found = sensitivities(result, EdgeArea(0.75 * mean), "force")
    assert math.sqrt(found.value / math.pi) == pytest.approx(number(row, "a"), rel=0.01)
    assert float(found["force"]) / (2.0 * math.pi * number(row, "a")) == pytest.approx(number(row, "da_dP"), rel=0.3)
