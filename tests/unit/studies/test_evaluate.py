"""From cases to records: what a path answers, and that nothing but its content decides about the
answer."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from contact_cases import slid
from refusals import refused
from study_cases import LOADS, PROBLEM, SEEDS, InProcess, plan

import asperity as asp
from asperity.io.schemas.study import StopTable
from asperity.parts.contact import Contact
from asperity.run.build import build
from asperity.run.document import checked
from asperity.studies import collect
from asperity.studies.analysis import analysis
from asperity.studies.collect import Failure, causes, dataset, state, stopped_at
from asperity.studies.convergence import step_sizes
from asperity.studies.places import replaced
from asperity.studies.plan import computed
from asperity.studies.run import carry_out
from asperity.studies.store import records

TOLERANCE = 1e-9
TIGHT = {**PROBLEM, "solver": {"tolerance": TOLERANCE}}
HARD = {**TIGHT, "law": {"kind": "hardness", "hardness": "0.4 GPa"}}


def collected(tmp_path: Path, **tables):
    made = plan(**tables)
    carry_out(made, tmp_path / "r.log", InProcess())
    return dataset(made, tmp_path / "r.log")


@pytest.mark.parametrize("problem", [TIGHT, HARD], ids=["elastic", "plastic"])
def test_a_case_of_a_path_is_that_of_a_contact_on_its_own(tmp_path, problem):
    """Warm starts change nothing beyond the tolerance: relative errors of energies, at most, so
    fields by its root."""
    names = [item.name for item in Contact().quantities]
    data = collected(tmp_path, problem=problem, axes=[SEEDS, LOADS], quantities=names)
    for seed in (1, 4):
        for load in (1e6, 5e6):
            table = replaced(problem, ("surface", "seed"), seed)
            case = build(checked(replaced(table, ("control", "mean_pressure"), f"{load} Pa")))
            alone = asp.solve(case.problem, case.control, solver=case.solver)
            found = data.sel(seed=seed, control_mean_pressure=load)
            for name in ("approach", "mean_gap", "max_pressure", "elastic_energy", "plastic_work", "force"):
                assert float(found[name]) == pytest.approx(getattr(alone, name), rel=3.0 * TOLERANCE**0.5, abs=0.0), (
                    name
                )
            assert float(found["n_spots"]) == alone.n_spots
            assert float(found["area_fraction"]) == pytest.approx(alone.area_fraction, abs=1.0 / 32**2)
            assert float(found["normal_stiffness"]) == pytest.approx(alone.normal_stiffness, rel=1e-3, abs=0.0)
            assert float(found["max_displacement"]) == pytest.approx(
                alone.displacement.max(), rel=3.0 * TOLERANCE**0.5, abs=0.0
            )


def test_results_do_not_depend_on_the_order_of_loads_or_axes(tmp_path):
    backwards = {**LOADS, "values": LOADS["values"][::-1]}
    first = collected(tmp_path, problem=HARD, axes=[SEEDS, LOADS])
    (tmp_path / "again").mkdir()
    second = collected(tmp_path / "again", problem=HARD, axes=[backwards, SEEDS]).transpose("seed", ...)
    for name in ("approach", "max_pressure", "mean_gap"):
        np.testing.assert_array_equal(first[name], second[name][:, ::-1])


def test_adding_a_load_computes_only_that_load_and_agrees(tmp_path):
    whole = collected(tmp_path, problem=TIGHT, axes=[LOADS])
    (tmp_path / "parts").mkdir()
    log = tmp_path / "parts" / "r.log"
    carry_out(plan(problem=TIGHT, axes=[{**LOADS, "values": ["1 MPa", "5 MPa"]}]), log, InProcess())
    made = plan(problem=TIGHT, axes=[LOADS])
    summary = carry_out(made, log, InProcess())
    assert (summary.done, summary.found) == (1, 2)
    np.testing.assert_allclose(dataset(made, log)["approach"], whole["approach"], rtol=3.0 * TOLERANCE**0.5)


def test_stresses_are_collected_where_the_problem_asks_for_them(tmp_path):
    problem = {**PROBLEM, "stress": {"friction": 0.4, "depths": ["0 nm", "50 nm", "100 nm", "300 nm"]}}
    names = [
        "max_von_mises",
        "max_tension",
        "max_shear",
        "max_interface_shear",
        "max_interface_peel",
        "yield_load_factor",
    ]
    data = collected(tmp_path, problem=problem, axes=[LOADS], quantities=names)
    case = build(checked(problem))
    result = asp.solve(case.problem, asp.MeanPressure(5e6), solver=case.solver)
    field = asp.stress(result, [0.0, 50e-9, 100e-9, 300e-9], friction=0.4)
    # the pressures agree to the root of the default tolerance, and so do the stresses, which are
    # linear in them
    assert float(data["max_von_mises"][2]) == pytest.approx(field.von_mises.max(), rel=1e-3, abs=0.0)
    assert float(data["max_tension"][2]) == pytest.approx(field.max_principal.max(), rel=1e-3, abs=0.0)
    assert np.isfinite(data["max_interface_shear"]).all()
    assert np.all(np.diff(data["max_von_mises"]) > 0.0)


def test_coupled_sliding_is_solved_as_on_its_own(tmp_path):
    stress = {"friction": 0.5, "coupled": True, "depths": ["0 nm"]}
    problem = {**PROBLEM, "stress": stress, "body": "E=100GPa,nu=0.2"}
    data = collected(tmp_path, problem=problem, axes=[{**LOADS, "values": ["2 MPa"]}], quantities=["approach"])
    case = build(checked(problem))
    alone = slid(case.problem, case.control, 0.5)
    assert float(data["approach"][0]) == pytest.approx(alone.approach, rel=1e-9, abs=0.0)
    assert float(data["approach"][0]) != pytest.approx(
        asp.solve(replace(case.problem, friction=None), case.control).approach, rel=1e-4, abs=0.0
    )


def test_failed_cases_are_records_and_the_others_go_on(tmp_path):
    """A load above the hardness has no solution; an exponent of the material does not exist."""
    loads = {**LOADS, "values": ["1 MPa", "2 MPa", "500 MPa", "600 MPa"]}
    made = plan(problem=HARD, axes=[SEEDS, loads])
    log = tmp_path / "r.log"
    summary = carry_out(made, log, InProcess())
    assert (summary.done, summary.failed) == (16, 8)
    (cause,) = state(made, log).causes
    assert (cause.kind, cause.count) == ("NoSolutionError", 8)
    assert cause.first.at == {"seed": 1.0, "control_mean_pressure": 5e8}
    assert "mean pressure" in cause.first.message
    data = dataset(made, log)
    assert data["outcome"].attrs["flag_meanings"] == "done failed missing"
    np.testing.assert_array_equal(data["outcome"], [[0, 0, 1, 1]] * 4)
    assert np.isnan(data["approach"][:, 2:]).all()
    assert str(data["error"][0, 2].item()).startswith("NoSolutionError: ")
    assert data["error"][0, 0].item() == ""
    assert carry_out(made, log, InProcess()).done == 0, "a failed case is finished"
    assert carry_out(made, log, InProcess(), retry=True).done == 8


def test_a_problem_that_cannot_be_built_fails_as_a_whole(tmp_path):
    surface = {"kind": "file", "path": "none.txt", "size": "1 um", "height_unit": "nm"}
    made = plan(problem={**PROBLEM, "surface": surface}, axes=[LOADS])
    assert carry_out(made, tmp_path / "r.log", InProcess()).failed == 3
    assert {cause.kind for cause in state(made, tmp_path / "r.log").causes} == {"FileFormatError"}


def test_causes_that_differ_in_numbers_are_one():
    said = [Failure({"a": 1.0}, "E", f"must be below 5e9 Pa, but is {n}.") for n in (7, 8.5, 1e10)]
    found = causes([Failure({}, "E", "another"), *said])
    assert [(cause.count, cause.first.message) for cause in found] == [(3, said[0].message), (1, "another")]


def test_findings_of_the_cases_are_counted(tmp_path, monkeypatch):
    """A layer thinner than a pixel is a warning in every case, which counts once however often it
    says so."""
    body = {"layers": [{"material": "DLC", "thickness": "1 nm"}], "base": "steel"}
    made = plan(problem={**PROBLEM, "body": body}, axes=[SEEDS, LOADS])
    carry_out(made, tmp_path / "r.log", InProcess())
    counted = {cause.kind: cause.count for cause in state(made, tmp_path / "r.log").findings}
    assert counted["note (layer against pixel)"] == 12
    placed = collect.placed_records

    def twice(*args):
        return [(place, {**record, "findings": 2 * record["findings"]}) for place, record in placed(*args)]

    monkeypatch.setattr(collect, "placed_records", twice)
    assert {cause.kind: cause.count for cause in state(made, tmp_path / "r.log").findings} == counted


def test_records_are_plain_json(tmp_path):
    carry_out(plan(axes=[LOADS]), tmp_path / "r.log", InProcess())
    for record in records(tmp_path / "r.log"):
        assert json.loads(json.dumps(record)) == record
        assert record["work"]["duality_gap"] < 1e-4
        assert "Polonsky" in " ".join(record["citations"]) or record["citations"]


def test_samples_end_when_the_mean_is_known_and_again_at_the_same_number(tmp_path):
    random = [{"path": "surface.seed", "distribution": "seed"}]
    rule = {"quantity": "mean_gap", "relative_width": 0.05, "at_least": 4}
    table = {"seed": 3, "samples": 200, "random": random, "stop": rule}
    made = plan(axes=[LOADS], monte_carlo=table)
    carry_out(made, tmp_path / "r.log", InProcess())
    end = stopped_at(made, tmp_path / "r.log")
    data = dataset(made, tmp_path / "r.log")
    assert data.sizes["sample"] == end < 200
    found = analysis(data, made.document)
    ratio = np.asarray(found["mean_gap_half_width"] / found["mean_gap_mean"])
    assert ratio.max() <= 0.05
    earlier = analysis(data.isel(sample=slice(end - 1)), made.document)
    assert end == 4 or float((earlier["mean_gap_half_width"] / earlier["mean_gap_mean"]).max()) > 0.05
    assert carry_out(made, tmp_path / "r.log", InProcess()).done == 0
    tighter = {**table, "stop": {**rule, "relative_width": 0.03}}
    more = plan(axes=[LOADS], monte_carlo=tighter)
    assert carry_out(more, tmp_path / "r.log", InProcess()).done > 0
    np.testing.assert_array_equal(dataset(more, tmp_path / "r.log")["seed"][:end], data["seed"])
    assert StopTable(**rule).confidence == 0.95


def test_the_limits_of_the_critical_thickness_are_the_homogeneous_solids(tmp_path):
    table = {"first": "0.1 nm", "last": "1 mm", "count": 8}
    data = collected(tmp_path, problem=TIGHT, critical_thickness=table, quantities=["max_pressure", "mean_gap"])
    for at, body in ((0, "E=200GPa,nu=0.3"), (-1, "E=100GPa,nu=0.3")):
        case = build(checked({**TIGHT, "body": body}))
        alone = asp.solve(case.problem, case.control, solver=case.solver)
        assert float(data["max_pressure"][at]) == pytest.approx(alone.max_pressure, rel=3.0 * TOLERANCE**0.5, abs=0.0)
        assert float(data["mean_gap"][at]) == pytest.approx(alone.mean_gap, rel=3.0 * TOLERANCE**0.5, abs=0.0)
    # 0.1 nm and 1 mm against waves of 1 µm: a layer changes the compliance at wavenumber q by some
    # q h, the substrate below by some exp(-2 q h)
    np.testing.assert_allclose(data["mean_gap"][[1, -2]], data["mean_gap"][[0, -1]], rtol=2e-3)
    found = analysis(data, plan(critical_thickness=table, quantities=["max_pressure", "mean_gap"]).document)
    for name in ("max_pressure", "mean_gap"):
        assert 1e-10 < float(found[f"{name}_floor"]) < float(found[f"{name}_ceiling"]) < 1e-3


def test_sensitivities_of_an_elastic_contact_obey_its_scaling(tmp_path):
    """Elastic area depends on p / (E σ) alone: elasticities to pressure, modulus and height are n,
    -n, -n."""
    problem = {**TIGHT, "body": {"youngs_modulus": "100 GPa", "poisson_ratio": 0.3}}
    parameters = ["control.mean_pressure", "body.youngs_modulus", "surface.spectrum.rms_height"]
    table = {"parameters": parameters, "change": 0.05}
    data = collected(tmp_path, problem=problem, sensitivity=table, quantities=["max_pressure", "mean_gap"])
    found = analysis(data, plan(problem=problem, sensitivity=table, quantities=["max_pressure", "mean_gap"]).document)
    load, modulus, height = (float(value) for value in found["max_pressure_elasticity"])
    # max pressure = E σ f(p / (E σ)): elasticities n, 1 - n, 1 - n, the same numbers but for the
    # width of the step
    assert load + modulus == pytest.approx(1.0, abs=0.02)
    assert height == pytest.approx(modulus, rel=1e-6, abs=0.0)
    gap = [float(value) for value in found["mean_gap_elasticity"]]
    assert gap[0] + gap[1] == pytest.approx(0.0, abs=0.002)
    assert gap[2] == pytest.approx(1.0 + gap[1], rel=1e-4, abs=0.0)


def test_a_smooth_contact_converges_with_the_grid(tmp_path):
    """Hertz on ever finer grids: the extrapolated approach is nearer to the closed form than the
    finest value."""
    problem = {
        "version": 1,
        "surface": {"kind": "sphere", "points": [16, 16], "size": "10 um", "radius": "100 um"},
        "body": "E=100GPa,nu=0.3",
        "boundary": {"kind": "free"},
        "control": {"force": "10 mN"},
        "solver": {"tolerance": 1e-10},
    }
    table = {"of": "grid", "levels": [16, 32, 64, 128]}
    data = collected(tmp_path, problem=problem, convergence=table, quantities=["mean_real_pressure", "approach"])
    assert data["level"].values.tolist() == [16.0, 32.0, 64.0, 128.0]
    assert np.isfinite(data["approach"]).all()
    modulus = 100e9 / (1.0 - 0.3**2)
    hertz = (9.0 * 0.01**2 / (16.0 * 100e-6 * modulus**2)) ** (1.0 / 3.0)
    errors = np.abs(np.asarray(data["approach"]) / hertz - 1.0)
    assert errors[-1] < 0.3 * errors[0]
    assert step_sizes("grid", [16.0, 32.0]) == (1 / 16, 1 / 32)


def test_computed_quantities_are_those_that_are_there():
    document = checked(PROBLEM)
    assert "max_von_mises" not in computed(document, ["approach"])
    assert "normal_stiffness" in computed(document, ["normal_stiffness"])
    stressed = document.model_copy(update={"stress": checked({**PROBLEM, "stress": {}}).stress})
    assert "max_von_mises" in computed(stressed, [])


def test_a_case_with_a_load_path_is_the_last_step_of_it(tmp_path):
    """Loaded beyond the hardness and unloaded: the peak is an axis, and the residual indentation
    depends on it."""
    control = {"path": {"mean_pressure": ["20 MPa", "1 MPa"], "steps": 3}}
    problem = {**HARD, "control": control}
    peaks = {"path": "control.path.mean_pressure.0", "values": ["5 MPa", "20 MPa"], "name": "peak"}
    data = collected(tmp_path, problem=problem, axes=[peaks], quantities=["max_permanent_indentation", "mean_pressure"])
    case = build(checked(problem))
    path = asp.solve(case.problem, asp.History(case.path), solver=case.solver)
    assert float(data["max_permanent_indentation"][1]) == pytest.approx(
        path.steps[-1].max_permanent_indentation, rel=3.0 * TOLERANCE**0.5, abs=0.0
    )
    np.testing.assert_allclose(data["mean_pressure"], 1e6, rtol=1e-6)
    assert 0.0 < float(data["max_permanent_indentation"][0]) < float(data["max_permanent_indentation"][1])


def test_a_worker_of_another_version_is_refused(tmp_path, monkeypatch):
    """Its numbers would be stored under the digest of this version."""
    monkeypatch.setattr("asperity.studies.evaluate.software", lambda: {"asperity": "0.0.9"})
    with refused(asp.InputError, "workers of a study", "0.0", "9"):
        carry_out(plan(axes=[LOADS]), tmp_path / "r.log", InProcess())
    assert list(records(tmp_path / "r.log")) == []
