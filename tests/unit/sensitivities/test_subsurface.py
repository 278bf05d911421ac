"""Sensitivities of norms of the stress inside bodies against differences on the frozen set, and
those of loads at yield."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from refusals import refused
from sensitivity_cases import CASES, MPA, NM, frozen_value, problem_of, solved

import asperity as asp
from asperity.contact.boundary import Free, FreeLine, Periodic
from asperity.core.errors import InputError
from asperity.physics.sensitivities.parameters import changed, parameters
from asperity.physics.sensitivities.transfers import Place, PressureTransfers, plain
from asperity.physics.stress.criteria import von_mises
from asperity.physics.stress.kernels.transfer import transfer
from asperity.physics.stress.regions import planes
from asperity.sensitivities import EdgeArea, PressureAt, PressureNorm, StressNorm, sensitivities, yield_load
from asperity.solvers import ActiveSet

NORMS = {
    "layer": StressNorm(0, (0.0, 0.3, 1.0)),
    "tension": StressNorm(0, (0.0, 0.5), m=8.0, measure="tension"),
    "second layer": StressNorm(1, (0.0, 0.5, 1.0)),
    "half-space": StressNorm(2, (0.0, 50 * NM), m=4.0),
    "counter body": StressNorm(0, (100 * NM,), of="counter_body"),
}


def differences(case: str, of: StressNorm, names: tuple[str, ...] = ()) -> float:
    """Largest error of the relative sensitivities over the largest of them."""
    result, step = solved(*CASES[case]), 1e-3
    found = sensitivities(result, of)
    last = "force" if found.held == "load" else "approach"
    given = {each.name: each.value for each in parameters(result.problem)}
    errors = []
    for name in names or (last, *given):

        def at(scale: float, name: str = name) -> float:
            if name == last:
                return frozen_value(result, result.problem, of, found.held, scale)
            return frozen_value(result, changed(result.problem, name, scale * given[name]), of, found.held)

        near, far = (at(1.0 + s) - at(1.0 - s) for s in (step, 2.0 * step))
        errors.append(abs((8.0 * near - far) / (12.0 * step * found.value) - found.relative[name]))
    return max(errors) / max(abs(found.relative[name]) for name in given)


@pytest.mark.parametrize("norm", NORMS)
def test_periodic_norms_are_those_of_differences_on_the_frozen_set(norm: str) -> None:
    assert differences("periodic", NORMS[norm]) <= 1e-8
    assert abs(sensitivities(solved(Periodic()), NORMS[norm]).euler_defect) <= 1e-8


@pytest.mark.parametrize("norm", ["layer", "half-space"])
def test_norms_with_yielded_points_at_a_held_approach(norm: str) -> None:
    assert differences("hardness at an approach", NORMS[norm]) <= 1e-6


@pytest.mark.slow
@pytest.mark.parametrize("norm", NORMS)
def test_free_norms_are_those_of_differences_on_the_frozen_set(norm: str) -> None:
    assert differences("free", NORMS[norm]) <= 1e-5


def test_free_norms_of_one_plane() -> None:
    of = StressNorm(2, (50 * NM,), m=4.0)
    assert differences("free", of, ("force", "body.layers[1].thickness", "body.base.poisson_ratio")) <= 1e-5


@pytest.mark.slow
def test_norms_of_lines_are_those_of_differences_on_the_frozen_set() -> None:
    assert differences("line", NORMS["half-space"], ("force", "body.layers[0].thickness")) <= 1e-5


@pytest.mark.parametrize("boundary", [Periodic(), Free(), FreeLine()], ids=["periodic", "free", "line"])
def test_norms_are_those_of_the_stresses(boundary: object) -> None:
    result = solved(boundary)
    body = result.problem.body
    assert isinstance(body, asp.Layered)
    for layer, shares in enumerate(((0.0, 0.4, 1.0), (0.0, 1.0), (0.0, 80 * NM))):
        of = StressNorm(layer, shares, m=8.0)
        found = sensitivities(result, of, "force")
        fields = asp.stress(result, [plane.depth for plane in of.within(body)])
        values = [
            von_mises(fields.tensor)[number]
            for number, plane in enumerate(fields.planes)
            if plane.region.index == layer
        ]
        assert found.value == pytest.approx(float(np.mean(np.stack(values) ** 8.0)) ** 0.125, rel=1e-6)


def test_heights_change_norms_as_differences_say() -> None:
    result, of, step = solved(Periodic()), NORMS["layer"], 1e-3 * NM
    slope = np.asarray(sensitivities(result, of, "heights")["heights"])
    index = int(np.flatnonzero(result.contact.ravel())[4])
    bump = np.zeros(slope.shape)
    bump.flat[index] = step
    up, down = (
        frozen_value(result, changed(result.problem, "heights", sign * bump), of, "load") for sign in (1.0, -1.0)
    )
    assert slope.ravel()[index] == pytest.approx((up - down) / (2.0 * step), rel=1e-5, abs=1e-7 * np.abs(slope).max())


@pytest.mark.parametrize("interface", [asp.solids.Bonded(), asp.Frictionless()], ids=["bonded", "frictionless"])
def test_amplitudes_are_those_of_the_stresses(interface: asp.solids.Interface) -> None:
    layers = [asp.Layer(asp.Elastic(300e9, 0.2), 60 * NM, interface), asp.Layer(asp.Elastic(40e9, 0.35), 150 * NM)]
    for base in (asp.Elastic(110e9, 0.3), asp.RigidBase()):
        body, alpha = asp.Layered(layers, base).reduced, np.geomspace(1e5, 1e9, 60)
        mine = PressureTransfers(plain(body), alpha, base=isinstance(base, asp.Elastic))
        for plane in planes(body, [0.0, 20 * NM, 60 * NM, 100 * NM, 210 * NM]):
            known = transfer(body, plane, alpha)
            for one, other in zip(mine.to(Place.of(plane)), (known.tau_zz, known.tau_Lz, known.LL_z), strict=True):
                assert np.abs(one - other).max() <= 1e-14


def test_load_at_yield_by_layer() -> None:
    result = solved(Periodic())
    of = StressNorm(0, (0.0, 0.5, 1.0), m=64.0)
    found = yield_load(result, of, ("body.layers", "force"), strength=2e9)
    again = yield_load(result, of, "force", strength=2e9 * 1.02)
    assert found.result.mean_pressure < result.mean_pressure
    # points in contact are few at this load, and one comes to touch now and then
    change = np.log(again.load / found.load) / np.log(1.02)
    assert found.relative["strength"] == pytest.approx(change, rel=0.2)
    assert found.values["strength"] == pytest.approx(found.relative["strength"] * found.load / 2e9, rel=1e-9)
    assert found.relative.keys() == found.norm.values.keys() - {"force"} | {"strength"}
    assert "YieldLoad" in repr(found)


def test_what_a_norm_refuses() -> None:
    result = solved(Periodic())
    with refused(InputError, "layer of a norm of the stress", "7"):
        sensitivities(result, StressNorm(7, (0.0,)))
    with refused(InputError, "plane of a norm of the stress in a layer", "1.5"):
        sensitivities(result, StressNorm(0, (1.5,)))
    with refused(InputError, "plane of a norm of the stress", "-1"):
        StressNorm(0, (-1.0,))
    with refused(InputError, "planes of a norm of the stress"):
        StressNorm(0, ())
    with refused(InputError, "exponent of a norm of the stress", "0.5"):
        StressNorm(0, (0.0,), m=0.5)
    with refused(InputError, "strength of layer 0"):
        yield_load(result, StressNorm(0, (0.5,)))
    with refused(InputError, "place of a pressure (m)"):
        sensitivities(result, PressureAt(1.0, 0.0))
    with refused(InputError, "pressure of an area by its edge (Pa)", "0"):
        EdgeArea(0.0)
    with refused(InputError, "held of sensitivities", "approach"):
        sensitivities(result, "stiffness", held="approach")
    with refused(InputError, "contact"):
        sensitivities(solved(Periodic(), True), "area")


def test_conductance_follows_the_stiffness() -> None:
    conducting = asp.solids.Conduction(electrical_resistivity=2e-8, thermal_conductivity=50.0)
    metal = asp.Elastic(110e9, 0.3, conduction=conducting)
    problem = replace(problem_of(Periodic(), body=metal), counter_body=asp.Elastic(200e9, 0.28, conduction=conducting))
    result = asp.solve(problem, asp.MeanPressure(100 * MPA))
    names = ("force", "body", "counter_body")
    stiffness, current = (sensitivities(result, of, names) for of in ("stiffness", "electrical_conductance"))
    assert current.value == pytest.approx(5e7 / problem.contact_modulus * stiffness.value, rel=1e-12)
    assert abs(current.euler_defect) <= 1e-8
    heat = sensitivities(result, "thermal_conductance", names)
    for name in names[:1]:
        assert current.relative[name] == pytest.approx(stiffness.relative[name], rel=1e-9)
        assert heat.relative[name] == pytest.approx(stiffness.relative[name], rel=1e-9)
    test = stiffness.taylor("force", (0.02, 0.01))
    slope = stiffness.relative["force"] * stiffness.value
    assert test.differences[1] == pytest.approx(0.01 * slope, rel=0.1)
    # equal resistivities of both bodies share the constriction
    both = sensitivities(result, "electrical_conductance", "body")
    assert both.relative["body.electrical_resistivity"] == pytest.approx(-0.5, rel=1e-9)
    of_heat = sensitivities(result, "thermal_conductance", "counter_body.thermal_conductivity")
    assert of_heat.relative["counter_body.thermal_conductivity"] == pytest.approx(0.5, rel=1e-9)
    test = both.taylor("body.electrical_resistivity", (1e-2, 1e-3))
    assert test.orders[0] == pytest.approx(2.0, abs=0.05)
    with refused(InputError, "electrical resistivity of layer 1 of the body"):
        sensitivities(solved(Periodic()), "electrical_conductance", "force")


@pytest.mark.parametrize("grading", [asp.solids.LinearGrading(), asp.solids.PowerGrading(2.0)], ids=lambda g: g.name)
def test_parameters_of_a_graded_coating(grading: asp.solids.Grading) -> None:
    def body(top: float) -> asp.Layered:
        layers = asp.solids.graded(
            asp.Elastic(top, 0.2), asp.Elastic(110e9, 0.3), 150 * NM, grading=grading, sublayers=6
        )
        return asp.Layered(layers, asp.Elastic(110e9, 0.3))

    E = 300e9
    problem = problem_of(Periodic(), body=body(E))
    result = asp.solve(problem, asp.MeanPressure(400 * MPA), solver=ActiveSet(tolerance=1e-10))
    found, step = sensitivities(result, PressureNorm(8.0), "body"), 1e-4
    up, down = (
        frozen_value(result, replace(problem, body=body(E * (1.0 + sign * step))), PressureNorm(8.0), "load")
        for sign in (1.0, -1.0)
    )
    assert found.along(body, E) == pytest.approx((up - down) / (2.0 * step * E), rel=1e-6)
    with refused(InputError, "body that depends on a parameter"):
        found.along(lambda E: asp.Elastic(E, 0.3), E)
