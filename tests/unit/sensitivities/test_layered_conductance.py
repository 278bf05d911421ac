"""Sensitivities of the conductance of layered bodies: rates of the conductors, constants on a given
contact, and contacts whose edge moves, against central differences."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.contact.boundary import Free, Periodic
from asperity.contact.result import ContactResult
from asperity.core.errors import InputError
from asperity.core.grid import Grid
from asperity.physics.conductance.conductance import conductance
from asperity.physics.conductance.operator import ELECTRICAL, THERMAL, Flow, LayeredConductor
from asperity.physics.conductance.rates import ConductorRate, conductor_constants
from asperity.physics.sensitivities.conducting import conductor_parameters, with_conductor
from asperity.sensitivities import sensitivities
from asperity.solids import Conduction
from asperity.solvers import ActiveSet

CONDUCTORS = {
    "half-space": LayeredConductor((0.3, 0.5), (5.0, 0.4, 2.0)),
    "one potential": LayeredConductor((0.3, 0.5), (5.0, 0.4, math.inf)),
}


def moved(conductor: LayeredConductor, rate: ConductorRate, by: float) -> LayeredConductor:
    """``conductor`` with the constant of ``rate`` changed by ``by``."""
    thickness, conductivity = list(conductor.thickness), list(conductor.conductivity)
    (thickness if rate.of_thickness else conductivity)[rate.layer] += by
    return LayeredConductor(tuple(thickness), tuple(conductivity))


@pytest.mark.parametrize("name", CONDUCTORS)
def test_rates_are_those_of_differences(name: str) -> None:
    conductor, q, grid, step = CONDUCTORS[name], np.geomspace(0.01, 100.0, 60), Grid((12, 9), (0.1, 0.13)), 1e-5
    rates = [ConductorRate(conductor, k) for k in range(3) if math.isfinite(conductor.conductivity[k])]
    rates += [ConductorRate(conductor, k, of_thickness=True) for k in range(2)]
    for rate in rates:
        up, down = moved(conductor, rate, step), moved(conductor, rate, -step)
        # differences err by step² and by 1e-16/step of the value
        of_waves = (up.spectral(q) - down.spectral(q)) / (2.0 * step)
        assert rate.spectral(q) == pytest.approx(of_waves, rel=1e-6, abs=1e-9 * float(conductor.spectral(q).max()))
        of_pixels = (up.influence(grid) - down.influence(grid)) / (2.0 * step)
        assert rate.influence(grid) == pytest.approx(of_pixels, rel=1e-5, abs=1e-7)
        assert rate.mean_mode() == pytest.approx((up.mean_mode() - down.mean_mode()) / (2.0 * step), rel=1e-6)


@pytest.mark.parametrize("name", CONDUCTORS)
def test_relations_of_scale(name: str) -> None:
    conductor, q = CONDUCTORS[name], np.geomspace(0.01, 100.0, 60)
    of_conductivity = sum(
        k * ConductorRate(conductor, n).spectral(q) for n, k in enumerate(conductor.conductivity) if math.isfinite(k)
    )
    assert of_conductivity == pytest.approx(-conductor.spectral(q), rel=1e-12)
    of_thickness = sum(
        h * ConductorRate(conductor, n, of_thickness=True).spectral(q) for n, h in enumerate(conductor.thickness)
    )
    step = 1e-5
    by_q = (conductor.spectral(q * (1.0 + step)) - conductor.spectral(q * (1.0 - step))) / (2.0 * step)
    assert of_thickness == pytest.approx(conductor.spectral(q) + by_q, rel=1e-8, abs=1e-8 * conductor.spectral(q).max())


def test_equal_layers_have_no_thickness() -> None:
    same = LayeredConductor((0.3,), (2.0, 2.0))
    q = np.geomspace(0.01, 100.0, 20)
    assert ConductorRate(same, 0, of_thickness=True).spectral(q) == pytest.approx(0.0, abs=1e-14)


def conducting(E: float, nu: float, resistivity: float) -> asp.Elastic:
    """Material whose two flows have different conductivities."""
    known = Conduction(electrical_resistivity=resistivity, thermal_conductivity=3.0 / math.sqrt(resistivity))
    return asp.Elastic(E, nu, conduction=known)


@cache
def sphere(modulus: float = 4.0) -> ContactResult:
    """Sphere of about 15 pixels in the radius of its contact on a coating that conducts badly."""
    a, n = 0.3, 41
    body = asp.Layered([asp.Layer(conducting(modulus, 0.3, 5.0), 0.3)], conducting(1.0, 0.3, 1.0))
    x = (np.arange(n) - 0.5 * (n - 1)) * (2.6 * a / n)
    surface = asp.Surface(-0.5 * np.add.outer(x**2, x**2), x[1] - x[0])
    problem = asp.ContactProblem(surface, body, boundary=Free())
    return asp.solve(problem, asp.Force(4.0 / 3.0 / 0.91 * a**3), solver=ActiveSet(tolerance=1e-8))


def waves(pressure: float = 0.05, counter_body: asp.Elastic | asp.Rigid = asp.Rigid()) -> ContactResult:
    """Crossed waves of 48 points, of which 3/4 touch."""
    x = 2.0 * np.pi * (np.arange(48) + 0.3) / 48
    wave = 0.01 * np.add.outer(np.cos(x), np.cos(x - 0.1))
    body = asp.Layered([asp.Layer(conducting(3.0, 0.2, 4.0), 0.08)], conducting(1.0, 0.3, 1.0))
    problem = asp.ContactProblem(asp.Surface(wave, 1.0 / 48), body, counter_body=counter_body, boundary=Periodic())
    return asp.solve(problem, asp.MeanPressure(pressure), solver=ActiveSet(tolerance=1e-8))


MOVING = (
    "force",
    "body.layers[0].youngs_modulus",
    "body.layers[0].poisson_ratio",
    "body.layers[0].thickness",
    "body.base.youngs_modulus",
    "heights",
)


@pytest.mark.parametrize("flow", ["electrical", "thermal"])
@pytest.mark.parametrize("pressed", [sphere, waves], ids=["sphere", "waves"])
def test_contacts_whose_edge_moves(pressed: object, flow: str) -> None:
    result: ContactResult = pressed()  # type: ignore[operator]
    found = sensitivities(result, f"{flow}_conductance")
    assert abs(found.euler_defect) <= 1e-8
    largest = max(abs(change) for change in found.relative.values())
    step = 0.1 if pressed is sphere else 0.04  # the nearer to full contact, the steeper
    for name in MOVING:
        (up, _), (down, _) = found.again(name, step), found.again(name, -step)
        difference = (up - down) / (2.0 * step * found.value)
        # differences over which the edge moves by about a pixel err by 1 % and more themselves
        assert found.relative[name] == pytest.approx(difference, abs=0.04 * largest), name
    kind = "electrical_resistivity" if flow == "electrical" else "thermal_conductivity"
    whole = sum(value for name, value in found.relative.items() if name.endswith(kind))
    assert whole == pytest.approx(-1.0 if flow == "electrical" else 1.0, rel=1e-6)


@pytest.mark.parametrize("flow", [ELECTRICAL, THERMAL], ids=lambda flow: flow.name)
def test_constants_of_the_conductors_on_a_given_contact(flow: Flow) -> None:
    result = waves(counter_body=conducting(2.0, 0.25, 0.5))
    names = [each.name for each in conductor_parameters(result.problem, flow) if each.of_material]
    found = sensitivities(result, f"{flow.name}_conductance", names)
    assert set(found.values) == set(names)
    # that at this load, beside the mean over loads from which both have errors of a few per mille
    for each in conductor_parameters(result.problem, flow):
        if not each.of_material:
            continue
        ends = []
        for scale in (1.01, 0.99):
            other = with_conductor(result.problem, each, scale * each.value)
            ends.append(conductance(replace(result, problem=other), flow.name).extrapolated)  # type: ignore[arg-type]
        difference = math.log(ends[0] / ends[1]) / math.log(1.01 / 0.99)
        assert found.relative[each.name] == pytest.approx(difference, abs=0.01), each.name


def test_a_coating_of_the_material_of_its_base_conducts_like_the_stiffness() -> None:
    coated = waves()
    metal = conducting(1.0, 0.3, 1.0)
    split = replace(coated.problem, body=asp.Layered([asp.Layer(metal, 0.08)], metal))
    whole = replace(coated.problem, body=metal)
    one, other = (
        sensitivities(
            asp.solve(each, asp.MeanPressure(0.03), solver=ActiveSet(tolerance=1e-8)), "electrical_conductance"
        )
        for each in (split, whole)
    )
    assert one.value == pytest.approx(other.value, rel=0.01)
    assert one.relative["force"] == pytest.approx(other.relative["force"], rel=0.03)
    for kind in ("youngs_modulus", "poisson_ratio", "electrical_resistivity"):
        parts = one.relative[f"body.layers[0].{kind}"] + one.relative[f"body.base.{kind}"]
        assert parts == pytest.approx(other.relative[f"body.{kind}"], rel=0.03), kind
    assert one.relative["body.layers[0].thickness"] == pytest.approx(0.0, abs=1e-6)
    # single heights scatter with the place of the edge, waves of them do not
    x = 2.0 * np.pi * np.arange(48) / 48
    for k, m in ((1, 1), (2, 0), (1, 2), (3, 1)):
        pattern = np.add.outer(np.cos(k * x), np.cos(m * (x - 0.1))) * 0.01
        slopes = [float((np.asarray(each["heights"]) * pattern).sum()) / each.value for each in (one, other)]
        assert slopes[0] == pytest.approx(slopes[1], abs=0.05 * abs(other.relative["heights"])), (k, m)


def test_rigid_bodies_have_no_constants_and_unknown_ones_are_refused() -> None:
    assert conductor_constants(asp.Rigid(), ELECTRICAL, "body") == ()
    result = sphere()
    unknown = replace(result.problem, body=asp.Layered([asp.Layer(asp.Elastic(4.0, 0.3), 0.3)], asp.Elastic(1.0, 0.3)))
    contact = asp.solve(unknown, asp.Force(0.03))
    with refused(InputError, "electrical resistivity of layer 1 of the body"):
        sensitivities(contact, "electrical_conductance", "force")
