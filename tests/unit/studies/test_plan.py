"""Axes, their combinations, and the keys of cases."""

from __future__ import annotations

import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from refusals import refused
from study_cases import LOADS, PROBLEM, SEEDS, plan

from asperity.core.arrays import content_digest
from asperity.core.errors import InputError
from asperity.run.document import checked
from asperity.studies.places import content, edited

THICKNESS = {"path": "body.layers.0.thickness", "first": "1 nm", "last": "1 um", "count": 4, "scale": "log"}


def cases(**tables):
    return [case for path in plan(**tables).paths() for case in path]


@pytest.mark.parametrize("name", ["p/E", " p", "p\n"])
def test_names_that_files_cannot_hold_are_refused_before_any_case(name: str) -> None:
    with refused(InputError, "name of the axis control.mean_pressure"):
        plan(axes=[{"path": "control.mean_pressure", "values": ["1 MPa"], "name": name}])


def test_ranges_are_equally_spaced_in_si():
    (log,) = plan(axes=[THICKNESS]).axes
    np.testing.assert_allclose([point.coordinate for point in log.points], [1e-9, 1e-8, 1e-7, 1e-6], rtol=1e-12)
    (linear,) = plan(axes=[{"path": "surface.seed", "first": 2, "last": 10, "count": 5}]).axes
    assert [point.edits[0].value for point in linear.points] == [2, 4, 6, 8, 10]


def test_a_grid_has_all_combinations_and_a_list_goes_through_them_together():
    assert plan(axes=[LOADS, THICKNESS]).shape == (3, 4)
    three = {**THICKNESS, "count": 3}
    listed = plan(axes=[LOADS, three], combine="list")
    assert listed.shape == (3,)
    assert listed.coordinates((1,)) == {
        "case": 1.0,
        "control_mean_pressure": 2e6,
        "thickness": pytest.approx(10**-7.5, rel=1e-12, abs=0.0),
    }


def test_cases_that_differ_in_the_load_are_one_path_of_rising_loads():
    shuffled = {**LOADS, "values": ["5 MPa", "1 MPa", "2 MPa"]}
    for order in ([shuffled, SEEDS], [SEEDS, shuffled]):
        paths = list(plan(axes=order).paths())
        assert len(paths) == 4
        at = order.index(shuffled)
        assert all([case.index[at] for case in path] == [1, 2, 0] for path in paths)
        assert len({case.index for path in paths for case in path}) == 12


def test_a_key_is_that_of_the_whole_changed_problem():
    """Keys are made without checking every case; they must be those of the checked document."""
    made = plan(axes=[LOADS, THICKNESS, {"path": "surface.points", "values": [16, [32, 16]]}])
    for case in (case for path in made.paths() for case in path):
        table = edited(made.table, case.edits)
        assert case.key == content_digest([content(checked(table), Path()), made._made_by])


def test_the_key_of_a_case_does_not_depend_on_the_study_around_it():
    one = {case.key for case in cases(axes=[{**LOADS, "values": ["2 MPa"]}, SEEDS])}
    assert one < {case.key for case in cases(axes=[SEEDS, {**LOADS, "values": ["2000 kPa", "7 MPa"]}])}
    in_list = {"path": "control.mean_pressure", "values": ["2 MPa"] * 4}
    assert one == {case.key for case in cases(axes=[SEEDS, in_list], combine="list")}


def test_costly_quantities_and_the_version_are_part_of_the_key(monkeypatch):
    cheap = {case.key for case in cases(axes=[LOADS], quantities=["area_fraction"])}
    assert cheap == {case.key for case in cases(axes=[LOADS], quantities=["approach"])}
    assert not cheap & {case.key for case in cases(axes=[LOADS], quantities=["normal_stiffness"])}
    monkeypatch.setattr("asperity.studies.plan.software", lambda: {"asperity": "another"})
    assert not cheap & {case.key for case in cases(axes=[LOADS], quantities=["area_fraction"])}


def test_scalars_that_follow_another():
    axis = {
        "path": "body.layers.0.youngs_modulus",
        "values": ["100 GPa", "300 GPa"],
        "also": {"body.layers.0.hardness": 0.05, "surface.seed": [7, 8]},
    }
    first, second = plan(axes=[axis]).axes[0].points
    assert [edit.value for edit in first.edits] == ["100000000000.0 Pa", "5000000000.0 Pa", 7]
    assert [edit.content for edit in second.edits] == [3e11, 1.5e10, 8]


def test_constants_can_replace_a_named_material_together():
    problem = {**PROBLEM, "body": "DLC:5nm/steel"}
    modulus = {"path": "body.base.youngs_modulus", "values": ["100 GPa"]}
    with refused(InputError, "problem with body.base.youngs_modulus = '100000000000.0 Pa': body.base"):
        plan(problem=problem, axes=[modulus])
    named = plan(problem=problem, axes=[{"path": "body.base.material", "values": ["steel", "DLC"]}])
    assert [point.coordinate for point in named.axes[0].points] == ["steel", "DLC"]


def test_the_limits_of_a_layer_are_other_bodies():
    problem = {**PROBLEM, "body": "DLC:5nm/Cr:2nm/steel"}
    for layer, without, endless in (
        ("body.layers.0", ["Cr"], []),
        ("body.layers.1", ["DLC"], ["DLC"]),
    ):
        table = {"layer": layer, "first": "1 nm", "last": "9 nm", "count": 3}
        made = plan(problem=problem, critical_thickness=table)
        points = made.axes[0].points
        assert [point.coordinate for point in (points[0], points[-1])] == [0.0, np.inf]
        bodies = [edited(made.table, points[at].edits)["body"] for at in (0, -1)]
        assert [[part["material"] for part in body.get("layers", [])] for body in bodies] == [without, endless]
    assert bodies[1]["base"]["material"] == "Cr"


def test_other_axes_reach_the_limits_of_a_layer():
    modulus = {"path": "body.layers.0.youngs_modulus", "values": ["10 GPa", "500 GPa"]}
    made = plan(axes=[modulus], critical_thickness={"first": "1 nm", "last": "9 nm", "count": 2})
    ends = {case.index: edited(made.table, case.edits)["body"] for path in made.paths() for case in path}
    assert ends[0, 0] == ends[1, 0] == made.table["body"]["base"]
    assert [ends[number, 3]["youngs_modulus"] for number in (0, 1)] == ["10000000000.0 Pa", "500000000000.0 Pa"]
    assert len({case.key for path in made.paths() for case in path}) == 7, (
        "without the layer its modulus does not matter"
    )


def test_levels_of_a_convergence_study():
    grid = plan(convergence={"of": "grid", "levels": [16, 32, 64]}).axes[0]
    assert [point.edits[0].value for point in grid.points] == [[16, 16], [32, 32], [64, 64]]
    domain = plan(convergence={"of": "domain", "levels": [1, 2, 4]}).axes[0]
    assert [point.edits[0].value for point in domain.points] == [[32, 32], [64, 64], [128, 128]]
    np.testing.assert_allclose([point.edits[1].content[0] for point in domain.points], [1e-5, 2e-5, 4e-5])
    tolerance = plan(convergence={"of": "tolerance", "levels": [1e-3, 1e-6, 1e-9]}).axes[0]
    assert [point.edits[0].value for point in tolerance.points] == [1e-3, 1e-6, 1e-9]


@pytest.mark.parametrize(
    ("tables", "subject", "shown"),
    [
        ({"axes": [{"path": "control.force", "values": [1]}]}, "control.force", "1"),
        ({"axes": [{"path": "control.force", "values": ["1 m"]}]}, "control.force", "'m'"),
        (
            {"axes": [{"path": "control.force", "values": ["-1 N"]}]},
            "problem with control.force = '-1.0 N': control.force",
            "'-1.0 N'",
        ),
        ({"axes": [{**THICKNESS, "values": ["1 nm"]}]}, "study document: axes[1]", "values and first"),
        ({"axes": [{**THICKNESS, "first": "0 nm"}]}, "first of a logarithmic range of body.layers.0.thickness", "0.0"),
        ({"axes": [LOADS, {"path": "control.force", "values": ["1 N"]}]}, "axes", "control.force"),
        ({"axes": [SEEDS, SEEDS]}, "axes", "surface.seed"),
        (
            {"axes": [LOADS, SEEDS], "combine": "list"},
            'axes of a study with combine = "list"',
            "control_mean_pressure has 3, seed has 4",
        ),
        ({"axes": [LOADS], "quantities": ["area"]}, "quantities", "contact_area"),
        ({"axes": [LOADS], "quantities": ["max_von_mises"]}, "quantity max_von_mises", "[stress]"),
        ({"axes": [{**LOADS, "name": "approach"}]}, "name of the axis control.mean_pressure", "'approach'"),
        ({"axes": [{**LOADS, "also": {"surface.seed": [1, 2]}}]}, "also.surface.seed", "2"),
        ({"axes": [{**LOADS, "also": {"surface.seed": 2.0}}]}, "also.surface.seed", "Pa"),
        ({}, "study document: study", "none"),
        ({"axes": [], "sensitivity": {"parameters": []}}, "study document: sensitivity.parameters", "empty"),
        ({"sensitivity": {"parameters": ["solver.tolerance"]}}, "solver.tolerance", "low"),
        ({"critical_thickness": {"values": ["0 nm", "5 nm"]}}, "thicknesses", "0.0 m"),
        (
            {"convergence": {"of": "grid", "levels": [64, 32, 16]}},
            "study document: convergence.levels of grid",
            "[64.0, 32.0, 16.0]",
        ),
        ({"convergence": {"of": "grid", "levels": [16, 32]}}, "study document: convergence.levels", "2"),
        ({"axes": [LOADS], "convergence": {}, "sensitivity": {}}, "study document", "convergence.levels"),
    ],
)
def test_mistakes_are_refused_before_anything_runs(tables, subject, shown):
    with refused(InputError, subject, shown):
        plan(**tables)


def test_a_file_has_no_grid_to_refine(tmp_path):
    surface = {"kind": "file", "path": "a.txt", "size": "1 um", "height_unit": "nm"}
    with refused(InputError, "convergence of the grid"):
        plan(problem={**PROBLEM, "surface": surface}, convergence={"of": "grid", "levels": [8, 16, 32]})


def test_a_problem_document_is_no_study():
    from asperity.studies.documents import study_from_table

    with refused(InputError, "study document"):
        study_from_table(PROBLEM, Path())


def test_cases_are_made_on_the_way():
    """Going through 2700 cases more takes less than 50 bytes for each; a case that is kept takes
    some 500."""
    peaks = []
    for samples in (100, 1000):
        random = [{"path": "surface.seed", "distribution": "seed"}]
        made = plan(axes=[LOADS], monte_carlo={"seed": 1, "samples": samples, "random": random})
        next(made.paths())  # what is prepared once
        tracemalloc.start()
        assert sum(len(path) for path in made.paths()) == 3 * samples
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] - peaks[0] < 50 * 2700


def test_files_are_an_axis_known_by_content(tmp_path):
    for name, text in (("a.txt", "1 2\n3 4\n"), ("b.txt", "1 2\n3 5\n")):
        (tmp_path / name).write_text(text)
    surface = {"kind": "file", "path": "a.txt", "size": "1 um", "height_unit": "nm"}
    axis = {"path": "surface.path", "values": ["a.txt", "b.txt"]}
    made = plan(tmp_path, problem={**PROBLEM, "surface": surface}, axes=[axis])
    assert [point.coordinate for point in made.axes[0].points] == ["a.txt", "b.txt"]
    keys = [case.key for path in made.paths() for case in path]
    (tmp_path / "a.txt").write_text("1 2\n3 5\n")
    again = plan(tmp_path, problem={**PROBLEM, "surface": surface}, axes=[axis])
    assert [case.key for path in again.paths() for case in path] == [keys[1]] * 2
