"""Plastic flow in the volume as a physics of the interface: histories, restart, files, what it
works together with and what not."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.contact.solve import Prepared
from asperity.core.errors import InputError
from asperity.core.units import percent
from asperity.solids.plasticity import J2, LinearHardening, Swift

STEEL, FILM = asp.Elastic(200e9, 0.3), asp.Elastic(400e9, 0.25)
SOFT = J2(STEEL, LinearHardening(0.8e9, 4e9))
HARD = J2(FILM, Swift(3e9, 0.01, 0.2), kinematic=5e9)
BODY = asp.Layered([asp.Layer(FILM, 60e-9)], STEEL)
FLOW = asp.PlasticFlow((HARD, SOFT), cells=16)


def rough(shape: tuple[int, int] = (32, 24)) -> asp.Surface:
    """A wavy surface with summits of several heights."""
    n, m = shape
    x, y = 2.0 * np.pi * np.arange(n)[:, None] / n, 2.0 * np.pi * np.arange(m)[None, :] / m
    heights = np.cos(2 * x + 0.3) * np.cos(2 * y) + 0.4 * np.cos(3 * x - 2 * y + 1.0) + 0.2 * np.cos(5 * x + y)
    return asp.Surface(1.2e-9 * heights, 25e-9, 25e-9)


def problem(**changes: Any) -> asp.ContactProblem:
    return replace(asp.ContactProblem(rough(), BODY, plastic_flow=FLOW), **changes)


@cache
def course() -> asp.HistoryResult:
    """Loaded, unloaded and loaded beyond."""
    loads = [0.03e9, 0.12e9, 0.25e9, 0.1e9]
    last = [0.24e9, 0.4e9]
    return asp.solve(
        problem(), asp.History([*map(asp.MeanPressure, loads), asp.Unloaded(), *map(asp.MeanPressure, last)])
    )


def test_history() -> None:
    """Plastic work grows under rising loads alone; unloading leaves the imprint, and a load below
    the largest one moves nothing."""
    flows = [step.plastic_flow for step in course().steps]
    works = np.array([flow.work for flow in flows])
    assert works[1] > 0.0
    assert np.all(np.diff(works[[1, 2, 6]]) > 0.0)
    np.testing.assert_allclose(works[3:6], works[2], rtol=2e-2)
    imprint = flows[4].displacement
    assert imprint.max() > 0.0
    np.testing.assert_allclose(flows[5].displacement, imprint, atol=0.02 * imprint.max())
    assert not course().steps[4].pressure.any()
    assert all(flow.small_strain for flow in flows)
    assert flows[-1].residual_energy > 0.0


def test_layers_are_told_apart() -> None:
    """Volumes, depths and first yield of each part; the soft base yields before the hard film
    does."""
    film, base = course().last.plastic_flow.zones
    assert [film.name, base.name] == ["layer 1", "base"]
    assert base.top == pytest.approx(60e-9)
    assert base.volume > film.volume
    assert base.first_yield <= film.first_yield or np.isnan(film.first_yield)
    assert base.first_yield == pytest.approx(0.12e9)
    assert base.first_place[2] > 60e-9


def test_energies_balance() -> None:
    """Of first order in the steps; what is stored below the surface counts."""
    errors = []
    for count in (4, 8):
        loads = [asp.MeanPressure(0.3e9 * k / count) for k in range(1, count + 1)]
        errors.append(asp.solve(problem(), asp.History(loads)).energies.relative_error)
    assert errors[1] < 0.05
    assert errors[1] < 0.75 * errors[0]


def test_restart_in_the_middle_is_exact(tmp_path: Path) -> None:
    """From a state, and from the state of a saved history, the same bits as without a break."""
    again = asp.solve(problem(), asp.MeanPressure(0.4e9), state=course().steps[5].state)
    asp.save(course(), tmp_path / "history.nc")
    loaded = asp.load(tmp_path / "history.nc")
    stored = asp.solve(problem(), asp.MeanPressure(0.4e9), state=loaded.steps[5].state)
    for one in (again, stored):
        assert np.array_equal(one.pressure, course().last.pressure)
        assert np.array_equal(
            one.plastic_flow.flowed.state.plastic_strain, course().last.plastic_flow.flowed.state.plastic_strain
        )
    for read, step in zip(loaded.steps, course().steps, strict=True):
        assert read.plastic_flow.work == step.plastic_flow.work
        assert read.plastic_flow.residual_energy == step.plastic_flow.residual_energy
        assert np.array_equal(read.plastic_flow.displacement, step.plastic_flow.displacement)
        assert np.array_equal(read.plastic_flow.accumulated, step.plastic_flow.accumulated)
    assert repr(loaded.last.problem.plastic_flow) == repr(FLOW)


def test_a_single_result_is_read_back(tmp_path: Path) -> None:
    result = asp.solve(problem(), asp.MeanPressure(0.2e9))
    asp.save(result, tmp_path / "one.nc")
    read = asp.load(tmp_path / "one.nc")
    assert read.plastic_flow.zones == result.plastic_flow.zones
    assert np.array_equal(read.plastic_flow.stress(), result.plastic_flow.stress())


def test_elastic_where_nothing_yields() -> None:
    """A light load gives the elastic contact, with no depth cells at all; a layer without a law
    stays elastic under any."""
    light, solver = asp.MeanPressure(1e6), asp.solvers.ActiveSet(tolerance=1e-14)
    result = asp.solve(problem(), light, solver=solver)
    assert not result.plastic_flow.depths.size
    elastic = asp.solve(problem(plastic_flow=None), light, solver=solver).pressure
    np.testing.assert_allclose(result.pressure, elastic, rtol=1e-12)  # one round more: rounding
    heavy = asp.solve(problem(plastic_flow=asp.PlasticFlow((None, SOFT), cells=16)), asp.MeanPressure(0.25e9))
    film, base = heavy.plastic_flow.zones
    assert film.volume == 0.0
    assert base.volume > 0.0


def test_position_and_load_agree() -> None:
    """The approach and the mean gap of a load lead back to it."""
    at = course().steps[1]
    for control in (asp.Approach(at.approach), asp.MeanGap(at.mean_gap)):
        result = asp.solve(problem(), control)
        assert result.mean_pressure == pytest.approx(
            at.mean_pressure, rel=0.03
        )  # the one came in two steps, the other in one


def test_which_body_flows_does_not_matter_without_shear() -> None:
    """A rigid rough body on a flat plastic one, and the reverse."""
    turned = asp.ContactProblem(rough(), asp.Rigid(), counter_body=BODY, plastic_flow=FLOW)
    one, two = (asp.solve(each, asp.MeanPressure(0.2e9)) for each in (problem(), turned))
    np.testing.assert_allclose(two.pressure, one.pressure, rtol=1e-9)
    assert two.plastic_flow.work == pytest.approx(one.plastic_flow.work, rel=1e-9)


def test_an_elastic_counter_body_gives_way() -> None:
    """Both compliances act, the imprint is that of the plastic body alone."""
    both = asp.solve(problem(counter_body=STEEL), asp.MeanPressure(0.2e9))
    alone = asp.solve(problem(), asp.MeanPressure(0.2e9))
    assert both.area_fraction > alone.area_fraction
    assert both.plastic_flow.work < alone.plastic_flow.work


def test_sliding_makes_it_flow_earlier() -> None:
    """Shear traction adds to the stress at the surface; the opposite direction on the mirrored
    surface gives the mirror image."""
    still = asp.solve(problem(), asp.MeanPressure(0.15e9))
    friction = asp.Coulomb(0.4)
    result = asp.solve(problem(friction=friction), asp.MeanPressure(0.15e9))
    assert result.plastic_flow.work > 1.1 * still.plastic_flow.work
    assert result.sliding is not None
    heights = rough().heights[::-1]
    mirrored = problem(surface=asp.Surface(heights, 25e-9, 25e-9), friction=asp.Coulomb(0.4, direction=np.pi))
    image = asp.solve(mirrored, asp.MeanPressure(0.15e9))
    np.testing.assert_allclose(image.pressure[::-1], result.pressure, atol=2e-3 * result.max_pressure)


def test_cells_go_deeper_with_the_load() -> None:
    """Cells of a first small load are kept, others are added below; the answer is that of cells
    that were deep from the start."""
    shallow = course().steps[1].plastic_flow.flowed.edges
    deep = course().last.plastic_flow.flowed.edges
    assert deep.size >= shallow.size
    assert np.array_equal(deep[: shallow.size], shallow)
    flow = replace(FLOW, depth=float(deep[-1]), cells=deep.size - 1)
    loads = [step.control for step in course().steps]
    fixed = asp.solve(problem(plastic_flow=flow), asp.History(loads))
    assert fixed.last.plastic_flow.work == pytest.approx(course().last.plastic_flow.work, rel=0.05)
    assert fixed.last.mean_gap == pytest.approx(course().last.mean_gap, rel=0.02)


def test_a_prescribed_depth_that_is_too_small_is_told() -> None:
    shallow = asp.solve(problem(plastic_flow=replace(FLOW, depth=80e-9, cells=8)), asp.MeanPressure(0.25e9))
    assert shallow.plastic_flow.reaches_end
    assert not course().last.plastic_flow.reaches_end


def test_number_of_threads_does_not_matter() -> None:
    one, two = (asp.solve(problem(), asp.MeanPressure(0.2e9), engine=asp.engines.CpuEngine(threads=n)) for n in (1, 2))
    assert np.array_equal(one.pressure, two.pressure)
    assert np.array_equal(one.plastic_flow.displacement, two.plastic_flow.displacement)


@pytest.mark.parametrize(
    ("changes", "subject"),
    [
        ({"law": asp.Hardness(2e9)}, "law of a contact with plastic flow"),
        ({"adhesion": asp.ExponentialAdhesion(0.05, 1e-9)}, "adhesion of a contact with plastic flow"),
        ({"friction": asp.friction.FullStick()}, "friction of a contact with plastic flow"),
        ({"body": STEEL}, "plasticity of a PlasticFlow"),
        ({"plastic_flow": asp.PlasticFlow((SOFT, SOFT))}, "elastic constants of a J2 law"),
    ],
)
def test_refused_problems(changes: dict[str, Any], subject: str) -> None:
    with refused(InputError, subject):
        problem(**changes)


@pytest.mark.parametrize(
    ("plasticity", "subject"),
    [
        ((None, None), "plasticity of a PlasticFlow"),
        ((1.0,), "plasticity of a PlasticFlow"),
        (2e9, "plasticity of a PlasticFlow"),
    ],
)
def test_refused_laws(plasticity: Any, subject: str) -> None:
    with refused(InputError, subject):
        asp.PlasticFlow(plasticity)


def test_stick_and_slip_is_refused() -> None:
    with refused(InputError, "friction of a contact with plastic flow"):
        asp.solve(problem(friction=asp.Coulomb(0.3)), asp.Step(asp.MeanPressure(1e8), asp.Shift(1e-9)))


def test_menisci_are_an_additional_load(tmp_path: Path) -> None:
    """Under load and menisci the body flows as under the sum of both, step by step; the force
    between the solids is that sum.

    The depth of the cells is prescribed, since it would follow from the first load that yields,
    which is another one while menisci grow.
    """
    flow = replace(FLOW, depth=150e-9)
    film = asp.LiquidFilm.of(asp.liquid("water"), 1.5e-9)
    loads = [0.05e9, 0.2e9, 0.1e9]
    wet = asp.solve(problem(plastic_flow=flow, film=film), asp.History(map(asp.MeanPressure, loads)))
    assert wet.converged
    found = wet.last.require_plastic_flow()
    assert found.flowed.points.size
    for step, load in zip(wet, loads, strict=True):
        menisci = step.require_menisci()
        assert menisci.meniscus_force > 1e-2 * step.external_force
        assert step.external_force == pytest.approx(load * step.problem.grid.area, rel=1e-9)
        assert step.force == pytest.approx(step.external_force + menisci.meniscus_force, rel=1e-3)
    dry = asp.solve(problem(plastic_flow=flow), asp.History([asp.Force(step.force) for step in wet])).last
    scale = np.abs(dry.require_plastic_flow().displacement).max()
    # both are settled to the tolerance of the flow in each of two steps that flow
    assert np.abs(found.displacement - dry.require_plastic_flow().displacement).max() <= 4 * flow.tolerance * scale
    asp.save(wet, tmp_path / "wet.nc")
    again = asp.load(tmp_path / "wet.nc").last
    np.testing.assert_array_equal(again.require_plastic_flow().displacement, found.displacement)
    assert again.external_force == wet.last.external_force


def test_laws_follow_from_the_strength_of_the_materials() -> None:
    """What ``plastic_parts`` makes of a body fits it; a part without a known strength stays
    elastic, as does a rigid base."""
    base = asp.Elastic(200e9, 0.3, asp.Strength(yield_stress=0.8e9))
    body = asp.Layered([asp.Layer(FILM, 60e-9)], base)
    flow = asp.PlasticFlow(asp.plasticity.plastic_parts(body, unknown_is_elastic=True))
    film, law = flow.laws(body)
    assert film is None
    assert law is not None
    assert law.hardening.yield_stress(np.zeros(1)) == pytest.approx(0.8e9)
    on_rigid = asp.Layered([asp.Layer(base, 60e-9)], asp.RigidBase())
    assert [part is None for part in asp.PlasticFlow(asp.plasticity.plastic_parts(on_rigid)).laws(on_rigid)] == [
        False,
        True,
    ]


def test_a_result_without_it() -> None:
    result = asp.solve(problem(plastic_flow=None), asp.MeanPressure(1e8))
    assert result.plastic_flow is None
    with refused(InputError, "problem of the result"):
        result.require_plastic_flow()
    assert course().last.require_plastic_flow() is course().last.plastic_flow


def test_one_coupling_is_prepared() -> None:
    assert [coupling.name for coupling in Prepared(problem()).couplings] == ["hardness", "plastic_flow"]


def criteria(result: asp.ContactResult) -> set[str]:
    return {item.criterion for item in asp.contact.review(result)}


def test_findings_of_the_review() -> None:
    """Each on its case with its number, none on a sound one; the hardness of a body whose flow is
    solved is no finding."""
    mine = {"small strain", "depth of the cells", "plastic flow", "hardness"}
    assert not mine & criteria(course().last)
    shallow = asp.solve(problem(plastic_flow=replace(FLOW, depth=80e-9, cells=8)), asp.MeanPressure(0.25e9))
    assert mine & criteria(shallow) == {"depth of the cells"}
    flow = course().last.plastic_flow
    film, base = flow.zones
    large = replace(flow, zones=(film, replace(base, largest_strain=0.123)))
    found = [
        item
        for item in asp.contact.review(replace(course().last, couplings={"plastic_flow": large}))
        if item.criterion in mine
    ]
    assert [item.criterion for item in found] == ["small strain"]
    assert percent(0.123) in found[0].message
    hard = asp.Elastic(200e9, 0.3, asp.Strength(yield_stress=0.8e9, hardness=0.5e9))
    soft = J2(hard, LinearHardening(0.8e9, 4e9))
    for law, told in ((None, True), (asp.PlasticFlow(soft, cells=12), False)):
        result = asp.solve(problem(body=hard, plastic_flow=law), asp.MeanPressure(0.05e9))
        assert ("hardness" in criteria(result)) is told


def test_findings_of_a_rigid_base() -> None:
    """A film that flows down to the rigid base it lies on needs no more cells."""
    body = asp.Layered([asp.Layer(STEEL, 60e-9)], asp.RigidBase())
    result = asp.solve(problem(body=body, plastic_flow=asp.PlasticFlow((SOFT, None), cells=8)), asp.MeanPressure(0.5e9))
    assert result.plastic_flow.reaches_end
    assert "depth of the cells" not in criteria(result)


def test_a_zone_that_reaches_the_edge_of_a_free_grid_is_told() -> None:
    """On a wide grid the zone ends inside; on a narrow one it is cut off, which bears more load at
    the same approach."""
    x = 20e-9 * (np.arange(48) - 24)
    forces = []
    for margin, told in ((0, False), (17, True)):
        kept = slice(margin, 48 - margin)
        heights = -(x[kept, None] ** 2 + x[None, kept] ** 2) / 2e-6
        ball = asp.Surface(heights, 20e-9, 20e-9)
        shape = problem(boundary=asp.Free(), surface=ball)
        result = asp.solve(shape, asp.Approach(8e-9))
        assert result.contact_area < 0.8 * (20e-9 * (48 - 2 * margin)) ** 2
        assert result.plastic_flow.reaches_edge is told
        assert ("edge of the grid" in criteria(result)) is told
        forces.append(result.force)
    assert forces[1] > 1.005 * forces[0]


def test_flow_that_is_not_settled_is_told() -> None:
    """The certificate holds the residual of the coupling, within its tolerance; a run that ended
    beyond it is a finding."""
    (check,) = course().last.certificate.couplings
    assert (check.name, check.tolerance) == ("plastic_flow", 1e-4)
    assert 0.0 <= check.residual <= check.tolerance
    result = course().last
    broken = replace(result.certificate, couplings=(replace(check, residual=3e-3),))
    unsettled = replace(result, certificate=broken)
    found = next(item for item in asp.contact.review(unsettled) if item.criterion == "plastic flow")
    assert "3.0e-03" in found.message


def test_residual_surface_has_the_imprint() -> None:
    """The surface under which the unloaded bodies lie is left; volume and depth are those of what
    lies below the old one."""
    result = course().steps[4]
    imprint = result.plastic_flow.displacement
    left = result.residual_surface().heights
    np.testing.assert_allclose(left, rough().heights - imprint, rtol=0.0, atol=1e-18)
    assert result.max_permanent_indentation == imprint.max() > 0.0
    assert result.plastic_volume == pytest.approx(imprint[imprint > 0.0].sum() * (25e-9) ** 2)
    assert result.indented_area == 0.0  # no point was at a cap
    assert not result.state.permanent_indentation.any()
    again = asp.solve(problem(surface=result.residual_surface(), plastic_flow=None), asp.MeanPressure(0.1e9))
    np.testing.assert_allclose(
        again.pressure, course().steps[3].pressure, atol=0.03 * again.max_pressure
    )  # elastic on the way back


def test_the_body_that_flows_takes_the_imprint() -> None:
    turned = asp.ContactProblem(rough(), asp.Rigid(), counter_body=BODY, plastic_flow=FLOW)
    result = asp.solve(turned, asp.MeanPressure(0.25e9))
    assert result.plastic_flow.of == "counter_body"
    assert np.array_equal(result.residual_surface("body").heights, rough().heights)
    assert np.array_equal(result.residual_surface("counter_body").heights, -result.plastic_flow.displacement)
    assert np.array_equal(result.residual_surface().heights, rough().heights - result.plastic_flow.displacement)


@pytest.mark.parametrize("kind", [asp.MeanPressure, asp.Approach, asp.MeanGap])
def test_position_in_one_step_takes_as_many_iterates_as_the_load(kind: Any) -> None:
    """The contact of each iterate is held at the position itself, so that no search for the load is
    around it."""
    loaded = asp.solve(problem(), asp.MeanPressure(0.6e9))
    value = {asp.MeanPressure: 0.6e9, asp.Approach: loaded.approach, asp.MeanGap: loaded.mean_gap}[kind]
    found = asp.solve(problem(), kind(value))
    assert found.mean_pressure == pytest.approx(0.6e9, rel=1e-3)
    assert found.approach == pytest.approx(loaded.approach, rel=1e-3)
    assert found.plastic_flow.iterations <= 1.5 * loaded.plastic_flow.iterations


def test_position_near_full_contact_of_a_body_without_hardening() -> None:
    """There whole steps of the return mapping swing between a contact and none; shorter ones come
    to rest at the load that has this position."""
    flow = asp.PlasticFlow(J2(STEEL, LinearHardening(0.8e9)), cells=8)
    coarse = asp.Surface(rough((16, 12)).heights, 50e-9, 50e-9)
    soft = problem(surface=coarse, body=STEEL, plastic_flow=flow)
    loaded = asp.solve(soft, asp.MeanPressure(1e9))
    found = asp.solve(soft, asp.Approach(loaded.approach))
    assert loaded.approach > 0.98 * float(soft.profile().max() - soft.profile().mean())
    assert found.mean_pressure == pytest.approx(1e9, rel=0.01)


def test_a_mean_pressure_at_which_the_body_yields_in_itself_ends() -> None:
    """Without lateral strain a half-space yields at every depth beyond Y (1 - ν)/(1 - 2ν): the
    cells end somewhere, and the result says so."""
    flow = asp.PlasticFlow(J2(STEEL, LinearHardening(0.2e9, 50e9)), cells=12)
    yielding = 0.2e9 * 0.7 / 0.4
    found = asp.solve(problem(body=STEEL, plastic_flow=flow), asp.MeanPressure(1.3 * yielding))
    assert found.plastic_flow.reaches_end
    assert found.plastic_flow.depths[-1] < 5.0 * 800e-9
    assert "depth of the cells" in criteria(found)


@pytest.mark.parametrize("control", [asp.MeanPressure(0.5e9), asp.Approach(1.1e-9)])
def test_a_step_that_does_not_settle_is_cut(control: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """Equal parts from the last state that settled, as a history of them would give; the result
    says so and holds the work of all parts."""
    from asperity.physics.plastic_flow import coupling as plastic_flow

    begun = asp.solve(problem(), asp.MeanPressure(0.05e9))
    whole = asp.solve(problem(), control, state=begun.state)
    monkeypatch.setattr(plastic_flow, "_MOST", 7)
    found = asp.solve(problem(), control, state=begun.state, rounds=asp.solvers.Rounds(2))
    assert found.converged
    assert "parts" in found.status.message
    assert "parts" not in whole.status.message
    count = int(found.status.message.split(" equal parts")[0].split()[-1])
    first = begun.mean_pressure if isinstance(control, asp.MeanPressure) else begun.approach
    steps = [type(control)(first + (control.value - first) * k / count) for k in range(1, count + 1)]
    parts = asp.solve(problem(), asp.History(steps), state=begun.state)
    np.testing.assert_allclose(found.pressure, parts.last.pressure, rtol=1e-6, atol=1e-6 * parts.last.max_pressure)
    works = [step.plastic_flow.step_work for step in parts.steps]
    assert found.plastic_flow.step_work == pytest.approx(sum(works), rel=1e-6)
    assert found.force == pytest.approx(whole.force, rel=0.02)
