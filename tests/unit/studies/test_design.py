"""Designs: the optima of contacts with closed forms, of the published critical thicknesses, and
what is refused before anything is solved."""

from __future__ import annotations

import json
import math
import re
import threading
from contextlib import nullcontext
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reference_data import Row, reference
from refusals import refused
from study_cases import InProcess

import asperity as asp
from asperity.core.errors import ConvergenceError, InputError, UnitError
from asperity.report.design import write_design_files
from asperity.studies.campaign import open_study, run_study
from asperity.studies.cluster import DaskCluster
from asperity.studies.design.evaluation import Evaluation, Here, Scaled
from asperity.studies.design.problem import Site, make_design
from asperity.studies.design.search import Aim, Search
from asperity.studies.design.together import at_once
from asperity.studies.documents import study_from_table
from asperity.studies.store import records

E_STAR, RADIUS = 1e9 / (1.0 - 0.3**2), 1e-3
HALFSPACE = {"youngs_modulus": "1 GPa", "poisson_ratio": 0.3}
ROUGH: dict[str, Any] = {
    "version": 2,
    "surface": {
        "kind": "rough",
        "points": [32, 32],
        "size": "10 um",
        "seed": 1,
        "spectrum": {"kind": "gaussian", "rms_height": "20 nm", "correlation_length": "1 um"},
    },
    "body": "E=150GPa,nu=0.2,H=15GPa:100nm/E=200GPa,nu=0.3,H=9GPa",
    "control": {"mean_pressure": "200 MPa"},
    "solver": {"tolerance": 1e-8},
}
THICKNESS = {"path": "body.layers.0.thickness", "low": "20 nm", "high": "2 um"}
RMS_HEIGHT = {"path": "surface.spectrum.rms_height", "low": "5 nm", "high": "50 nm", "name": "rms"}
MODULUS = {"path": "body.layers.0.youngs_modulus", "low": "50 GPa", "high": "500 GPa"}


def ball(points: int = 32, size: str = "0.3 mm", **tables: Any) -> dict[str, Any]:
    surface = {"kind": "sphere", "points": [points, points], "size": size, "radius": f"{RADIUS} m"}
    given = {"surface": surface, "body": HALFSPACE, "boundary": {"kind": "free"}, "control": {"force": "2 N"}}
    return {"version": 2, **given, "solver": {"tolerance": 1e-9}, **tables}


def study(problem: dict[str, Any], design: dict[str, Any], **tables: Any) -> dict[str, Any]:
    return {"version": 1, "problem": problem, "design": design, **tables}


def converging(values: list[float], exact: float) -> bool:
    """Whether values on grids of half the pixel approach the exact one: the last differs from it by
    less than from the one before."""
    return abs(values[-1] - exact) <= 1.2 * abs(values[-1] - values[-2])


# Optima that are known.


def test_the_load_of_a_given_largest_pressure_is_that_of_hertz():
    """F = π³ R² p₀³/(6 E*²); 1 % more of the limit bears 3 % more."""
    limit = 60e6
    exact = math.pi**3 * RADIUS**2 * limit**3 / (6.0 * E_STAR**2)
    load = {"path": "control.force", "low": "0.05 N", "high": "20 N"}
    table = {"maximise": "force_limit", "variables": [{**load, "name": "force_limit"}], "tolerance": 1e-5}
    table["constraints"] = [{"quantity": "max_pressure", "at_most": "60 MPa"}]
    found = [asp.optimise(study(ball(points, "0.36 mm"), table)) for points in (33, 65)]
    assert converging([design["force_limit"] for design in found], exact)
    (limit_row,) = found[-1].constraints
    assert limit_row.active
    assert limit_row.price == pytest.approx(3.0, rel=0.02)
    assert found[-1].converged


def test_the_load_of_a_wave_is_that_of_westergaard():
    """p₀ = 2 √(p̄ p*) with p* = π E* Δ/λ: the amplitude that is allowed under a mean pressure."""
    wave = {"kind": "sinusoid", "points": [256, 1], "size": "1 um x 1 um", "amplitude": "2 nm", "wavelength": "1 um"}
    problem = {"version": 2, "surface": wave, "body": HALFSPACE, "control": {"mean_pressure": "2 MPa"}}
    table = {"maximise": "amplitude", "variables": [{"path": "surface.amplitude", "low": "1 nm", "high": "50 nm"}]}
    table |= {"constraints": [{"quantity": "max_pressure", "at_most": "12 MPa"}], "tolerance": 1e-5}
    found = asp.optimise(study(problem, table))
    exact = (12e6 / 2.0) ** 2 / 2e6 / (math.pi * E_STAR / 1e-6)
    assert found["amplitude"] == pytest.approx(exact, rel=2e-3)
    (limit,) = found.constraints
    assert limit.price == pytest.approx(2.0, rel=0.02)


def critical(row: Row, points: int) -> asp.studies.Design:
    """The thickness of ``row`` on a grid of 2.7 contact radii, lengths in mm and moduli in GPa."""
    body = {
        "layers": [{"thickness": "0.1 mm", "youngs_modulus": f"{row['E1']} GPa", "poisson_ratio": row["nu1"]}],
        "base": {"youngs_modulus": f"{row['E2']} GPa", "poisson_ratio": row["nu2"]},
    }
    surface = {"kind": "sphere", "points": [points] * 2, "size": f"{2.7 * row['a']} mm", "radius": f"{row['R']} mm"}
    load = {"force": f"{1e3 * row['P']} N"}
    problem = {"version": 2, "surface": surface, "body": body, "boundary": {"kind": "free"}, "control": load}
    limit = f"{row['delta_limit']} mm"
    table = {
        "minimise": "thickness",
        "variables": [{"path": "body.layers.0.thickness", "low": "0.02 mm", "high": "0.6 mm"}],
        "constraints": [{"quantity": "approach", "at_most": limit}],
        "tolerance": 1e-5,
        "starts": 1,
    }
    if row["E1"] < row["E2"]:  # a soft film is the deeper the thicker it is
        table["maximise"] = table.pop("minimise")
    return asp.optimise(study({**problem, "solver": {"tolerance": 1e-9}}, table))


ROWS = reference("coating_critical_thickness")


@pytest.mark.parametrize("row", [ROWS[0], *(pytest.param(row, marks=pytest.mark.slow) for row in ROWS[1:])])
def test_critical_thicknesses_are_found_and_what_they_cost(row: Row):
    """Thickness within the error of the grid, and d ln h/d ln δ of the limit, which on 33² to 97²
    points is 0.5 to 0.2 % off."""
    found = [critical(row, points) for points in (33, 65)]
    assert converging([design["thickness"] * 1e3 for design in found], row["h_critical"])
    (limit,) = found[-1].constraints
    exact = row["dh_ddelta_limit"] * row["delta_limit"] / row["h_critical"]
    assert limit.price == pytest.approx(exact, rel=5e-3)


def test_a_front_that_is_known():
    """Under a force p₀ ∝ E*^(2/3) R^(-2/3), δ ∝ E*^(-2/3) R^(-1/3): the front has the largest
    radius and p₀ δ constant."""
    table = {
        "minimise": "max_pressure",
        "variables": [
            {"path": "surface.radius", "low": "0.5 mm", "high": "2 mm"},
            {"path": "body.youngs_modulus", "low": "1 GPa", "high": "4 GPa"},
        ],
        "pareto": {"minimise": "approach", "points": 5},
        "starts": 1,
    }
    found = asp.optimise(study(ball(48, "0.45 mm"), table))
    assert len(found.front) == 5
    assert [point.values[0] for point in found.front] == pytest.approx([2e-3] * 5)
    products = [point.objective * point.second for point in found.front]
    assert np.ptp(products) < 0.02 * np.mean(products)
    assert all(one.second < two.second and one.objective > two.objective for one, two in pairwise(found.front))
    ends = [point.values[1] for point in found.front]
    assert (ends[0], ends[-1]) == pytest.approx((4e9, 1e9))


# Gradients.


def gradient(table: dict[str, Any], *, known: bool) -> tuple[np.ndarray, np.ndarray]:
    problem = make_design(study_from_table(table, Path()))
    search = Search(problem, Evaluation(problem, Here()))
    site = Site((), tuple(each.start for each in problem.numbers))
    aim = Aim(problem.objective, problem.constraints)
    search.rows(aim, search.met(site))
    assert search.evaluation.seen[site].slopes
    if not known:
        search.evaluation.slope = lambda criterion, found, number: None  # type: ignore[method-assign]
    rows = search.gradient(aim, site)
    assert len(search.evaluation.seen) == (1 if known else 1 + 2 * len(problem.numbers))
    return rows


def test_derivatives_of_the_contact_agree_with_differences():
    """Also of samples with their deviation; central differences with a step of 0.5 % have an error
    of its square and that of points which change their state."""
    load = {"path": "control.mean_pressure", "name": "p", "low": "50 MPa", "high": "400 MPa"}
    limits = [{"quantity": name, "at_least": "1 nm"} for name in ("mean_gap", "approach")]
    limits.append({"quantity": "steepness", "at_least": 1e-3})
    design = {"minimise": "max_pressure", "variables": [THICKNESS, RMS_HEIGHT, MODULUS, load], "constraints": limits}
    derived = {"closed": "log(p / E2) * mean_gap / thickness", "steepness": "closed**2 * sqrt(rms / approach)"}
    samples = {"seed": 1, "samples": 3, "random": [{"path": "surface.seed", "distribution": "seed"}]}
    names = {"letters": {"E2": "body.base.youngs_modulus"}, "derived": derived}
    table = study(ROUGH, {**design, "step": 5e-3, "robust": 1.5}, monte_carlo=samples, **names)
    for one, two in zip(gradient(table, known=True), gradient(table, known=False), strict=True):
        np.testing.assert_allclose(one, two, atol=3e-3 * np.abs(two).max())


def test_linked_scalars_count_in_the_derivative():
    """A base that follows the modulus of its layer makes one solid, whose approach depends on load
    over modulus alone."""
    body = "E=100GPa,nu=0.3:100nm/E=100GPa,nu=0.3"
    modulus = {**MODULUS, "also": {"body.base.youngs_modulus": 1.0}, "start": "100 GPa"}
    load = {"path": "control.mean_pressure", "low": "50 MPa", "high": "400 MPa"}
    design = {"minimise": "approach", "variables": [modulus, load]}
    ((of_modulus, of_load),) = gradient(study({**ROUGH, "body": body}, design), known=True)[0]
    assert of_modulus / math.log(10.0) == pytest.approx(-of_load / math.log(8.0), rel=1e-6)


def test_scaled_numbers_are_smooth_where_logarithms_end():
    scaled = Scaled.of(2.0)
    values = np.array([4.0, 2.0, 1e-6, -1.0])
    step = 1e-7 * np.maximum(np.abs(values), 1e-3)
    found, slope = scaled(values)
    assert found[:2] == pytest.approx([math.log(2.0), 0.0])
    numeric = (scaled(values + step)[0] - scaled(values - step)[0]) / (2.0 * step)
    np.testing.assert_allclose(slope[:3], numeric[:3], rtol=1e-4)


# Derived numbers.


def test_a_derived_number_is_best_where_its_formula_says():
    """With δ = c F^(2/3) of Hertz, δ/R + b E R²/F is least at F^(5/3) = 3 b E R³/(2 c), and F δ
    reaches W at F = (W/c)^(3/5)."""
    c, best, bound = (9.0 / (16.0 * RADIUS * E_STAR**2)) ** (1.0 / 3.0), 2.0, 4e-6
    b = best ** (5.0 / 3.0) * 2.0 * c / (3.0 * 1e9 * RADIUS**3)
    load = {"path": "control.force", "name": "F", "low": "0.2 N", "high": "10 N", "start": "1 N"}
    derived = {"share": "approach / R", "cost": {"expression": f"share + {b} * E * R**2 / F", "label": "all"}}
    names = {"letters": {"R": "surface.radius", "E": "body.youngs_modulus"}, "derived": derived | {"W": "F * approach"}}
    design = {"minimise": "cost", "variables": [load], "tolerance": 1e-6, "starts": 1}
    found = [asp.optimise(study(ball(points), design, **names)) for points in (33, 65)]
    assert converging([one["F"] for one in found], best)
    assert (found[1].objective.label, found[1].objective.unit) == ("all", "1")
    bounded = {"maximise": "F", "variables": [load], "constraints": [{"quantity": "W", "at_most": f"{bound} J"}]}
    found = [asp.optimise(study(ball(points), {**bounded, "tolerance": 1e-5}, **names)) for points in (33, 65)]
    assert converging([one["F"] for one in found], (bound / c) ** 0.6)
    assert found[1].constraints[0].price == pytest.approx(0.6, rel=5e-3)


def test_an_expression_of_an_axis_takes_the_values_of_a_design():
    """A load in proportion to the modulus of a half-space: the same approach whatever the
    modulus."""
    modulus = {"path": "body.youngs_modulus", "name": "E", "low": "1 GPa", "high": "9 GPa"}
    load = {"path": "control.force", "name": "P", "values": [1e-3, 2e-3], "expression": "P * E * R**2"}
    table = study(
        ball(), {"minimise": "approach", "variables": [modulus]}, axes=[load], letters={"R": "surface.radius"}
    )
    problem = make_design(study_from_table(table, Path()))
    one, two = Evaluation(problem, Here())([Site((), (1e9,)), Site((), (4e9,))])
    np.testing.assert_allclose(one.values["approach"], two.values["approach"], rtol=1e-7)
    assert one.values["approach"][0, 1] > 1.5 * one.values["approach"][0, 0]


# Searches.


def test_choices_are_all_tried():
    materials = ["DLC", "TiN", "gold"]
    variable = {"path": "body.layers.0.material", "choices": materials}
    problem = {**ROUGH, "body": "DLC:300nm/steel"}
    found = asp.optimise(study(problem, {"minimise": "max_pressure", "variables": [variable]}))
    sweep = [asp.run({**problem, "body": f"{name}:300nm/steel"}).values["max_pressure"] for name in materials]
    assert found["material"] == materials[int(np.argmin(sweep))]
    assert [trial.objective for trial in found.trials] == pytest.approx(sorted(sweep), rel=1e-6)
    assert {change.value for change in found.changes} == set(materials) - {found["material"]}
    assert found.solves == 3


def test_numbers_are_sought_for_every_choice():
    variable = {"path": "body.layers.0.material", "choices": ["TiN", "gold"]}
    design = {"minimise": "approach", "variables": [THICKNESS, variable], "starts": 2}
    found = asp.optimise(study({**ROUGH, "body": "TiN:300nm/steel"}, design))
    assert found["material"] == "TiN"
    assert len(found.trials) == 4
    assert found.agreeing >= 2


EVOLUTION = {"method": "evolution", "population": 10, "generations": 8}


def test_an_evolution_finds_what_gradients_find_for_every_choice():
    variable = {"path": "body.layers.0.material", "choices": ["gold", "DLC", "TiN"]}
    limits = [{"quantity": "mean_gap", "at_least": "15 nm"}]
    design = {"minimise": "max_pressure", "variables": [RMS_HEIGHT, variable], "constraints": limits, "starts": 2}
    problem = {**ROUGH, "body": "TiN:300nm/steel"}
    every, found = (asp.optimise(study(problem, {**design, **more})) for more in ({}, EVOLUTION))
    assert found.feasible
    assert found["material"] == every["material"]
    assert found.objective.value == pytest.approx(every.objective.value, rel=2e-3)


def test_an_evolution_finds_the_optimum_of_hertz(tmp_path: Path):
    """F = π³ R² p₀³/(6 E*²): the softest body, the largest ball, and the load of both alone."""
    load = {"path": "control.force", "name": "F", "low": "0.05 N", "high": "5 N"}
    radius = {"path": "surface.radius", "low": "0.5 mm", "high": "2 mm"}
    choice = {"path": "body.youngs_modulus", "name": "E", "choices": ["4 GPa", "2 GPa", "1 GPa", "3 GPa"]}
    limits = [{"quantity": "max_pressure", "at_most": "40 MPa"}]
    design = {"maximise": "F", "variables": [radius, load, choice], "constraints": limits, "starts": 2}
    table = study(ball(24), {**design, **EVOLUTION, "tolerance": 1e-4})
    found = asp.optimise(table, tmp_path / "d")
    one = ball(24)
    one["surface"]["radius"] = "2 mm"
    alone = asp.optimise(study(one, {**design, "variables": [load], "tolerance": 1e-4}))
    assert (found["E"], found["radius"]) == (1e9, pytest.approx(2e-3))
    assert found["F"] == pytest.approx(alone["F"], rel=1e-3)
    assert found.converged
    again = asp.optimise(table, tmp_path / "d")
    assert (again.solves, again.history) == (0, found.history)


def test_an_evolution_of_choices_alone_finds_the_best_and_the_front():
    materials = ["gold", "DLC", "TiN"]
    choices = [{"path": f"body.layers.{n}.material", "name": f"m{n}", "choices": materials} for n in (0, 1)]
    problem = {**ROUGH, "body": "DLC:100nm/TiN:100nm/steel"}
    design = {"minimise": "max_pressure", "variables": choices, "pareto": {"minimise": "approach", "points": 3}}
    every, found = (asp.optimise(study(problem, {**design, **more})) for more in ({}, EVOLUTION))
    assert [each.value for each in found.variables] == [each.value for each in every.variables]
    assert found.solves <= every.solves == 9
    assert {point.values for point in found.front} <= {point.values for point in every.front}


def test_many_choices_evolve_unless_something_else_is_asked_for():
    choices = [
        {"path": f"body.layers.{n}.material", "name": f"m{n}", "choices": ["DLC", "TiN", "gold"]} for n in (0, 1)
    ]
    layers = {**ROUGH, "body": "DLC:100nm/TiN:100nm/steel"}
    moduli = {"path": "body.base.youngs_modulus", "choices": [f"{n} GPa" for n in range(100, 200)]}
    base = {**ROUGH, "body": "E=150GPa,nu=0.2:100nm/E=200GPa,nu=0.3"}
    for design, problem, evolves in (
        ({"variables": choices}, layers, False),
        ({"variables": [THICKNESS, *choices]}, layers, False),
        ({"variables": [THICKNESS, *choices], "starts": 7}, layers, True),
        ({"variables": [THICKNESS, *choices], "starts": 7, "method": "slsqp"}, layers, False),
        ({"variables": [THICKNESS], "starts": 100}, ROUGH, False),
        ({"variables": [moduli]}, base, False),
        ({"variables": [THICKNESS, moduli]}, base, True),
    ):
        made = make_design(study_from_table(study(problem, {"minimise": "approach", **design}), Path()))
        assert made.evolves is evolves


def test_all_cases_must_hold_and_the_worst_is_named():
    loads = {"path": "control.mean_pressure", "name": "load", "values": ["100 MPa", "300 MPa"]}
    limits = [{"quantity": "mean_gap", "at_least": "20 nm"}]
    limits.append({"quantity": "mean_gap", "at_least": "25 nm", "at": {"load": "100 MPa"}})
    table = study(ROUGH, {"minimise": "rms", "variables": [RMS_HEIGHT], "constraints": limits}, axes=[loads])
    found = asp.optimise(table)
    assert found.feasible
    assert [limit.case for limit in found.constraints] == ["load 300 MPa", "load 100 MPa"]
    rough = {**ROUGH["surface"], "spectrum": {**ROUGH["surface"]["spectrum"], "rms_height": f"{found['rms']} m"}}
    for load, limit in zip(("300 MPa", "100 MPa"), found.constraints, strict=True):
        alone = asp.run({**ROUGH, "surface": rough, "control": {"mean_pressure": load}})
        assert alone.values["mean_gap"] == pytest.approx(limit.value, rel=1e-5)
    assert min(limit.margin for limit in found.constraints) == pytest.approx(0.0, abs=1e-3)


def test_the_worst_of_several_cases_is_made_small():
    """Two loads: of the larger pressure, with a bound that a search by gradients carries along."""
    loads = {"path": "control.mean_pressure", "name": "load", "values": ["100 MPa", "300 MPa"]}
    limits = [{"quantity": "mean_gap", "at_least": "20 nm"}]
    design = {"minimise": "max_pressure", "variables": [RMS_HEIGHT], "constraints": limits, "starts": 1}
    found = asp.optimise(study(ROUGH, design, axes=[loads]))
    alone = asp.optimise(study({**ROUGH, "control": {"mean_pressure": "300 MPa"}}, design))
    assert found.objective.value == pytest.approx(alone.objective.value, rel=5e-3)


def test_robust_designs_keep_a_distance_of_deviations():
    samples = {"seed": 3, "samples": 5, "random": [{"path": "surface.seed", "distribution": "seed"}]}
    limits = [{"quantity": "mean_gap", "at_least": "20 nm"}]
    design = {"minimise": "rms", "variables": [RMS_HEIGHT], "constraints": limits, "tolerance": 1e-4}
    found = [asp.optimise(study(ROUGH, {**design, "robust": k}, monte_carlo=samples)) for k in (0.0, 2.0)]
    assert found[1]["rms"] > found[0]["rms"]
    rough = {**ROUGH["surface"], "spectrum": {**ROUGH["surface"]["spectrum"], "rms_height": f"{found[1]['rms']} m"}}
    data = study({**ROUGH, "surface": rough}, {}, monte_carlo=samples, quantities=["mean_gap"])
    del data["design"]
    made = make_design(study_from_table(study(ROUGH, {**design, "robust": 2.0}, monte_carlo=samples), Path()))
    evaluation = Evaluation(made, Here())
    (one,) = evaluation([Site((), (found[1]["rms"],))])
    gaps = one.values["mean_gap"][:, 0]
    assert len(set(gaps)) == 5
    assert gaps.mean() - 2.0 * gaps.std(ddof=1) == pytest.approx(20e-9, rel=2e-4)


def test_a_trust_region_finds_the_same():
    limits = [{"quantity": "mean_gap", "at_least": "15 nm"}]
    design = {"minimise": "max_pressure", "variables": [RMS_HEIGHT, MODULUS], "constraints": limits, "starts": 1}
    one, two = (asp.optimise(study(ROUGH, {**design, "method": name})) for name in ("slsqp", "trust-constr"))
    assert two.objective.value == pytest.approx(one.objective.value, rel=0.01)


def test_what_cannot_be_met_is_named_with_the_least_violated_design():
    limits = [{"quantity": "mean_gap", "at_least": "15 nm"}, {"quantity": "max_pressure", "at_most": "100 MPa"}]
    design = {"minimise": "approach", "variables": [RMS_HEIGHT], "constraints": limits, "starts": 1}
    found = asp.optimise(study(ROUGH, design))
    assert not found.feasible
    assert found["rms"] == pytest.approx(5e-9)
    assert not found.constraints[1].met
    assert [text.startswith(each.words) for text, each in zip(found.unmet, found.constraints, strict=True)] == [
        True
    ] * 2
    assert all(text in found.verdict for text in found.unmet)


def test_a_search_without_a_design_says_why():
    """A mean pressure above the hardness: no contact exists."""
    problem = {**ROUGH, "law": {"kind": "hardness", "hardness": "100 MPa"}}
    design = {"minimise": "max_pressure", "variables": [RMS_HEIGHT], "starts": 1}
    with pytest.raises(ConvergenceError):
        asp.optimise(study(problem, design))


# The store.


DESIGN = {
    "minimise": "max_pressure",
    "variables": [THICKNESS, RMS_HEIGHT],
    "constraints": [{"quantity": "mean_gap", "at_least": "15 nm"}],
    "starts": 2,
}


def test_a_search_that_is_run_again_repeats_no_solve(tmp_path: Path):
    whole = asp.optimise(study(ROUGH, DESIGN), tmp_path / "whole")
    seen = []

    def stop(solved: int, reused: int) -> None:
        seen.append(solved)
        if solved > whole.solves // 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        asp.optimise(study(ROUGH, DESIGN), tmp_path / "part", progress=stop)
    rest = asp.optimise(study(ROUGH, DESIGN), tmp_path / "part")
    assert seen[-1] + rest.solves == whole.solves
    assert rest.reused == seen[-1]
    assert [each.value for each in rest.variables] == [each.value for each in whole.variables]
    keys = [record["key"] for record in records(tmp_path / "part" / "records.log")]
    assert len(keys) == len(set(keys)) == whole.solves
    again = asp.optimise(study(ROUGH, DESIGN), tmp_path / "part")
    assert (again.solves, again.reused) == (0, whole.solves)


AT_ONCE = {
    "starts": DESIGN,
    "choices and a front": {
        "minimise": "max_pressure",
        "variables": [RMS_HEIGHT, {"path": "body.layers.0.youngs_modulus", "choices": ["100 GPa", "300 GPa"]}],
        "pareto": {"maximise": "mean_gap", "points": 4},
        "starts": 1,
    },
    "evolution": {**DESIGN, "method": "evolution", "population": 6, "generations": 3},
}


@pytest.mark.parametrize("name", AT_ONCE)
def test_searches_at_once_find_the_same(name: str, monkeypatch: pytest.MonkeyPatch):
    """All numbers of the answer to the last digit, the designs on the way among them."""
    one = asp.optimise(study(ROUGH, AT_ONCE[name]))
    counts = []

    class Counting(InProcess):
        def run(self, function: str, tasks: Any) -> Any:
            given = list(tasks)
            counts.append(len(given))
            return super().run(function, iter(given))

    monkeypatch.setattr(DaskCluster, "kept", lambda cluster: nullcontext(Counting()))
    two = asp.optimise(study(ROUGH, AT_ONCE[name]), dask="tcp://anywhere")
    assert two.record() == one.record()
    assert max(counts) > 1


def test_workers_find_the_same():
    one, two = (asp.optimise(study(ROUGH, DESIGN), workers=count) for count in (1, 2))
    assert two.record() == one.record()


def test_an_error_ends_all_searches(monkeypatch: pytest.MonkeyPatch):
    threads, told = threading.active_count(), []

    def stop(solved: int, reused: int) -> None:
        told.append(solved)
        if len(told) == 3:
            raise KeyboardInterrupt

    monkeypatch.setattr(DaskCluster, "kept", lambda cluster: nullcontext(InProcess()))
    with pytest.raises(KeyboardInterrupt):
        asp.optimise(study(ROUGH, DESIGN), dask="tcp://anywhere", progress=stop)
    assert threading.active_count() == threads
    problem = make_design(study_from_table(study(ROUGH, DESIGN), Path()))
    evaluation, site = Evaluation(problem, InProcess()), problem.place((), np.array([0.5, 0.5]))

    own = ConvergenceError("of this search")

    def fail(given: Evaluation) -> None:
        raise own

    with pytest.raises(ConvergenceError) as caught:
        at_once(evaluation, [lambda given: given([site]), fail])
    assert caught.value is own
    assert threading.active_count() == threads


def test_the_files_of_a_design(tmp_path: Path, rendered: None):
    table = {**DESIGN, "pareto": {"maximise": "mean_gap", "points": 4}, "starts": 1}
    found = asp.optimise(study(ROUGH, table, title="films"), tmp_path / "d")
    written = write_design_files(found, tmp_path / "d")
    assert all(path.exists() for path in written)
    record = json.loads((tmp_path / "d" / "design.json").read_text(encoding="utf-8"))
    assert record["variables"][0]["value"] == found["thickness"]
    assert len(record["front"]) == len(found.front) >= 3
    assert {path.stem for path in (tmp_path / "d" / "plots").iterdir()} == {
        "changes",
        "front",
        "history",
        "margins",
    }
    page = (tmp_path / "d" / "report.html").read_text(encoding="utf-8")
    for text in (found.verdict, *(each.name for each in found.variables), *found.citation_keys, "[design]"):
        assert text in page
    (curves,) = re.findall(r'"texts": ?(\[[^]]*\])', page)
    assert json.loads(curves) == list(found.in_words)
    assert len(found.in_words) == len(found.front)
    text = repr(found)
    assert all(each.name in text for each in found.variables)
    assert found.verdict in text
    with refused(InputError, "study"):
        run_study(tmp_path / "d" / "study.toml", tmp_path / "e")
    with refused(InputError, "study"):
        open_study(tmp_path / "d")


# What is refused.


def told(design: dict[str, Any], problem: dict[str, Any] = ROUGH, **tables: Any) -> None:
    make_design(study_from_table(study(problem, {"minimise": "max_pressure", **design}, **tables), Path()))


LOADS = {"path": "control.mean_pressure", "values": ["100 MPa", "300 MPa"]}
BAD = {
    "path": ({"variables": [{**THICKNESS, "path": "body.layers.3.thickness"}]}, InputError, "path", "layers.3"),
    "unit": ({"variables": [{**THICKNESS, "low": "20 Pa"}]}, UnitError, "body.layers.0.thickness", "Pa"),
    "order": ({"variables": [{**THICKNESS, "low": "3 um"}]}, InputError, "high of body.layers.0.thickness", "3 um"),
    "start": ({"variables": [{**THICKNESS, "start": "3 um"}]}, InputError, "start of body.layers.0.thickness", "3 um"),
    "log": (
        {"variables": [{**THICKNESS, "low": "0 nm", "scale": "log"}]},
        InputError,
        "low of body.layers.0.thickness",
        "0 nm",
    ),
    "seed": (
        {"variables": [{"path": "surface.seed", "low": 1, "high": 9}]},
        InputError,
        "surface.seed",
        "whole",
    ),
    "twice": ({"variables": [THICKNESS, {**THICKNESS, "name": "h"}]}, InputError, "variables and axes", "thickness"),
    "name": (
        {"variables": [{**THICKNESS, "name": "approach"}]},
        InputError,
        "name of the variable body.layers.0.thickness",
        "approach",
    ),
    "quantity": ({"variables": [THICKNESS], "minimise": "max_presure"}, InputError, "quantities", "max_pressure"),
    "table": (
        {"variables": [THICKNESS], "constraints": [{"quantity": "max_tension", "at_most": "1 GPa"}]},
        InputError,
        "quantity max_tension",
        "stress",
    ),
    "limit": (
        {"variables": [THICKNESS], "constraints": [{"quantity": "approach", "at_most": "1 GPa"}]},
        UnitError,
        "limit of approach",
        "GPa",
    ),
    "plain": (
        {"variables": [THICKNESS], "constraints": [{"quantity": "approach", "at_most": 1e-9}]},
        InputError,
        "limit of approach",
        "1e-09",
    ),
    "hardness": (
        {"variables": [THICKNESS], "constraints": [{"quantity": "plastic_area_fraction", "at_most": 0.1}]},
        InputError,
        "quantity plastic_area_fraction of the design",
        "Hardness",
    ),
    "case": (
        {
            "variables": [THICKNESS],
            "constraints": [{"quantity": "approach", "at_most": "1 nm", "at": {"load": "1 MPa"}}],
        },
        InputError,
        "axis of the cases of approach",
        "load",
    ),
    "robust": ({"variables": [THICKNESS], "robust": 2.0}, InputError, "design.robust", "monte_carlo"),
    "bounds": (
        {"variables": [{"path": "body.layers.0.poisson_ratio", "low": 0.1, "high": 0.7}]},
        InputError,
        "problem with body.layers.0.poisson_ratio = 0.7: body.layers[1].poisson_ratio",
        "0.7",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_what_cannot_be_a_design_is_refused_before_it_is_solved(name: str):
    design, kind, subject, shown = BAD[name]
    with refused(kind, subject, shown):
        told(design)


DERIVED = {
    "letter": ({"variables": [{**THICKNESS, "name": "E2"}]}, InputError, "letter E2", "body.layers.0.thickness"),
    "expression": ({"minimise": "cost"}, InputError, "expression of cost", "prise"),
    "unit": ({"constraints": [{"quantity": "work", "at_most": "1 nm"}]}, UnitError, "limit of work", "nm"),
    "axis": ({"variables": [{**THICKNESS, "name": "load"}]}, InputError, "name of a variable", "load"),
}


@pytest.mark.parametrize("name", DERIVED)
def test_what_cannot_be_derived_is_refused_before_it_is_solved(name: str):
    design, kind, subject, shown = DERIVED[name]
    derived = {"work": "approach * E2", "cost": "thickness * prise" if name == "expression" else "thickness"}
    variables = design.get("variables", [THICKNESS])
    derived["cost"] = derived["cost"].replace("thickness", str(variables[0].get("name", "thickness")))
    letters = {"E2": "body.base.youngs_modulus"}
    with refused(kind, subject, shown):
        told({"variables": variables, **design}, derived=derived, letters=letters, axes=[{**LOADS, "name": "load"}])


def test_a_choice_whose_strength_is_not_known_is_refused():
    limits = [{"quantity": "yield_load_factor", "at_least": 1.0}]
    variable = {"path": "body.base.material", "choices": ["Co-Cr", "steel"]}
    with refused(InputError, "quantity yield_load_factor of the design", "steel"):
        told({"variables": [variable], "constraints": limits}, {**ROUGH, "body": "DLC:100nm/Co-Cr", "stress": {}})
