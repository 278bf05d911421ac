"""Adhesion on the command line and in documents: the loop and its files, findings, criteria, and
what is refused."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cli.conftest import Runner
from refusals import refused, subject_of

import asperity as asp
from asperity.core.errors import ConvergenceError, InputError
from asperity.physics.adhesion.stickiness import stickiness
from asperity.run.build import build
from asperity.run.document import checked, dumps
from asperity.run.stored import load_outcome

PROBLEM: dict[str, Any] = {
    "version": 2,
    "surface": {"kind": "sphere", "points": [24, 24], "size": "60 um", "radius": "100 um"},
    "body": "E=0.91MPa,nu=0.3",
    "boundary": {"kind": "free"},
    "control": {"approach": "0.3 um"},
    "adhesion": {"work": "50 mJ/m**2", "strength": "60 kPa", "retract": "0.6 um", "steps": 3},
}
ROUGH = {
    "kind": "rough",
    "points": [32, 32],
    "size": "10 um",
    "seed": 1,
    "spectrum": {"kind": "gaussian", "rms_height": "20 nm", "correlation_length": "2 um"},
}


@pytest.mark.slow
def test_the_loop_of_a_command_is_that_of_python(run: Runner, tmp_path: Path) -> None:
    document, out = tmp_path / "case.toml", tmp_path / "out"
    document.write_text(dumps(checked(PROBLEM)), encoding="utf-8")
    done = run("contact", "--from", document, "--out", out)
    assert done.exit_code == 0, done.output
    outcome = load_outcome(out / "result.nc")
    law = asp.ExponentialAdhesion.of_strength(0.05, 60e3)
    assert outcome.result.adhesion.law == law
    controls = asp.adhesion.adhesion_cycle(-0.6e-6, 0.3e-6, steps=3)
    again = asp.solve(outcome.result.problem, asp.History(controls))
    loop = asp.adhesion.adhesion_loop(again.steps)
    assert outcome.values["pull_off_force"] == loop.pull_off_force
    assert outcome.values["hysteresis"] == loop.hysteresis
    assert outcome.values["hysteresis_error"] == loop.hysteresis_error
    np.testing.assert_array_equal(outcome.path.external_force, again.external_force)
    assert {"adhesion_loop", "adhesive_zone", "traction_section"} <= {path.stem for path in (out / "plots").iterdir()}
    assert {"adhesion_loop", "adhesive_zone"} <= {figure.name for figure in outcome.figures["adhesion"]}
    (words,) = (words for part, words in outcome.sections if part.name == "adhesion")
    assert words.sentence in done.output.replace("\n", " ")


def test_options_make_the_same_document(run: Runner, tmp_path: Path) -> None:
    document, out = tmp_path / "case.toml", tmp_path / "out"
    document.write_text(dumps(checked(PROBLEM | {"adhesion": None})), encoding="utf-8")
    options = ("--adhesion", "50mJ/m**2", "--adhesion-strength", "60kPa", "--adhesion-law", "linear")
    done = run("contact", "--from", document, *options, "--out", out)
    assert done.exit_code == 0, done.output
    outcome = load_outcome(out / "result.nc")
    assert outcome.result.adhesion.law == asp.adhesion.LinearAdhesion.of_strength(0.05, 60e3)
    assert outcome.result.approach == pytest.approx(0.3e-6)
    assert math.isnan(outcome.values["pull_off_force"])


@pytest.mark.slow
def test_branch_and_jumps_on_request(run: Runner, tmp_path: Path) -> None:
    document, out = tmp_path / "case.toml", tmp_path / "out"
    table = {"work": "50 mJ/m**2", "strength": "130 kPa", "retract": "1.4 um", "steps": 16}
    surface = PROBLEM["surface"] | {"points": [40, 40], "size": "42 um"}
    case = PROBLEM | {"surface": surface, "adhesion": table, "control": {"approach": "0.1 um"}}
    document.write_text(dumps(checked(case)), encoding="utf-8")
    done = run("contact", "--from", document, "--adhesion-branch", "--jump-tolerance", "20nm", "--out", out)
    assert done.exit_code == 0, done.output
    outcome = load_outcome(out / "result.nc")
    assert outcome.values["folds"] == 2.0
    values = outcome.found["adhesion"].values
    margin, force = values["branch_margin"], values["branch_force"]
    assert margin.shape == force.shape == values["branch_approach"].shape
    assert margin.min() < 0.0 < margin.max()
    (words,) = (words for part, words in outcome.sections if part.name == "adhesion")
    rows = dict(words.rows)
    assert rows["folds of the branch"] == "2"
    heading, cells = words.tables[-1]
    assert heading == "Where jumps begin"
    assert len(cells.cells) == 2
    assert "adhesive_branch" in {path.stem for path in (out / "plots").iterdir()}
    assert outcome.values["adhesive_energy_bound"] <= outcome.values["adhesive_energy"]


def test_a_branch_of_single_points_names_the_pixel_it_needs() -> None:
    table = {
        "work": "50 mJ/m**2",
        "strength": "130 kPa",
        "law": "dugdale",
        "retract": "1.4 um",
        "steps": 4,
        "branch": True,
    }
    outcome = asp.run(PROBLEM | {"adhesion": table, "control": {"approach": "0.1 um"}})
    (finding,) = (item for item in outcome.findings if item.criterion == "branch")
    assert "Take one of at most " in finding.message
    assert "exponential" in finding.message.lower()


@pytest.mark.parametrize("law", ["dugdale", "exponential", "linear", "van der waals"])
@pytest.mark.parametrize("reach", ["0.1 nm", "1 nm"])
def test_attraction_far_stronger_than_the_solid_converges_on_coarse_pixels(law: str, reach: str) -> None:
    """A cohesive length of 1e-6 pixels and less: the attraction is 500 times the modulus, and
    rounding keeps the normal solve from 1e-13."""
    ball = PROBLEM | {"surface": PROBLEM["surface"] | {"points": [16, 16]}}
    table = {"work": "50 mJ/m**2", "range": reach, "law": law}
    for case in (
        ball | {"adhesion": table, "control": {"force": "10 uN"}},
        ball | {"adhesion": table | {"retract": "0.6 um", "steps": 4}},
        ball
        | {
            "surface": ROUGH,
            "boundary": {"kind": "periodic"},
            "control": {"mean_pressure": "20 kPa"},
            "adhesion": table,
        },
    ):
        outcome = asp.run(case)
        steps = [outcome.result] if outcome.path is None else outcome.path.steps
        assert all(step.status.converged for step in steps)
        assert max(step.adhesion.residual for step in steps) <= 1e-5
        assert max(step.certificate.duality_gap for step in steps) < 1e-9
        assert [item.criterion for item in outcome.findings if item.level == "warning"].count("adhesive zone") == 1


def test_a_core_that_no_pixel_resolves_names_the_pixel_it_needs() -> None:
    """A Lennard-Jones sphere whose points snap one by one comes to no rest, soon and with the pixel
    it needs."""
    ball = PROBLEM | {"surface": PROBLEM["surface"] | {"points": [16, 16]}}
    table = {"work": "50 mJ/m**2", "range": "1 nm", "law": "lennard-jones", "retract": "0.6 um", "steps": 4}
    with pytest.raises(ConvergenceError) as stopped:
        asp.run(ball | {"adhesion": table})
    assert "4e-12 m" in str(stopped.value)
    assert "3.75e-06 m" in str(stopped.value)


def test_an_unresolved_zone_is_a_finding() -> None:
    coarse = PROBLEM | {"adhesion": {"work": "50 mJ/m**2", "strength": "300 kPa"}}
    outcome = asp.run(coarse)
    assert [item.criterion for item in outcome.findings if item.level == "warning"].count("adhesive zone") == 1
    assert outcome.values["needed_pixel"] == pytest.approx(0.2 * outcome.values["cohesive_length"])
    assert not outcome.result.adhesion.resolved


def test_short_range_needs_the_work_alone(run: Runner, tmp_path: Path) -> None:
    document, out = tmp_path / "case.toml", tmp_path / "out"
    document.write_text(dumps(checked(PROBLEM | {"adhesion": None, "control": {"force": "10 uN"}})), encoding="utf-8")
    done = run("contact", "--from", document, "--adhesion", "50mJ/m**2", "--adhesion-law", "jkr", "--out", out)
    assert done.exit_code == 0, done.output
    outcome = load_outcome(out / "result.nc")
    assert outcome.result.adhesion.law == asp.adhesion.JKRAdhesion(0.05)
    assert outcome.result.external_force == pytest.approx(10e-6, rel=1e-9)
    assert outcome.values["cohesive_length"] == 0.0
    assert outcome.values["pixels_per_cohesive_length"] == outcome.result.adhesion.pixels_per_length < 20.0
    assert [item.criterion for item in outcome.findings if item.level == "warning"].count("adhesive zone") == 1


def test_lennard_jones_in_documents() -> None:
    table = {"work": "50 mJ/m**2", "strength": "60 kPa", "law": "lennard-jones"}
    outcome = asp.run(PROBLEM | {"adhesion": table, "control": {"force": "10 uN"}})
    law = outcome.result.adhesion.law
    assert isinstance(law, asp.adhesion.LennardJonesAdhesion)
    assert law.strength == pytest.approx(60e3, rel=1e-12)
    assert outcome.result.external_force == pytest.approx(10e-6, rel=1e-6)
    assert outcome.values["stability_margin"] > 0.0


def test_work_of_adhesion_of_a_pair(run: Runner, tmp_path: Path) -> None:
    document, out = tmp_path / "case.toml", tmp_path / "out"
    document.write_text(dumps(checked(PROBLEM | {"adhesion": None})), encoding="utf-8")
    done = run(
        "contact",
        "--from",
        document,
        "--adhesion-pair",
        "polystyrene / paraffin",
        "--adhesion-strength",
        "60kPa",
        "--out",
        out,
    )
    assert done.exit_code == 0, done.output
    outcome, pair = load_outcome(out / "result.nc"), asp.adhesion.work_of_adhesion("polystyrene", "paraffin wax")
    assert outcome.result.adhesion.law == asp.ExponentialAdhesion.of_strength(pair.work, 60e3)
    (words,) = (words for part, words in outcome.sections if part.name == "adhesion")
    assert dict(words.rows)["work of adhesion from"] == "; ".join(pair.sources)
    assert len(pair.sources) == 2


def test_criteria_stand_beside_a_rough_contact() -> None:
    document = PROBLEM | {
        "surface": ROUGH,
        "boundary": {"kind": "periodic"},
        "control": {"mean_pressure": "20 kPa"},
        "adhesion": {"work": "10 mJ/m**2", "range": "100 nm"},
    }
    outcome = asp.run(document)
    found = stickiness(outcome.result.problem)
    assert outcome.values["pastewka_robbins"] == found.share_of_limit
    assert outcome.values["persson_tosatti_work"] == found.effective_work
    assert outcome.values["fuller_tabor"] > 0.0


@pytest.mark.parametrize(
    "table",
    [
        {"strength": "60 kPa"},
        {"work": "50 mJ/m**2"},
        {"work": "50 mJ/m**2", "range": "1 nm", "strength": "60 kPa"},
        {"work": "50 mJ/m**2", "range": "1 nm", "steps": 5},
        {"work": "50 nm", "range": "1 nm"},
        {"work": "50 mJ/m**2", "law": "jkr", "range": "1 nm"},
        {"work": "50 mJ/m**2", "range": "1 nm", "branch": True},
        {"work": "50 mJ/m**2", "pair": "polystyrene/wax", "range": "1 nm"},
        {"pair": "polystyrene", "range": "1 nm"},
        {"pair": "polystyrene/unobtainium", "range": "1 nm"},
        {"work": "50 mJ/m**2", "range": "1 nm", "jump_tolerance": "0.1 nm"},
        {"work": "50 mJ/m**2", "range": "1 nm", "retract": "1 um", "steps": 1},
    ],
)
def test_tables_that_make_no_sense_are_refused(table: dict[str, Any]) -> None:
    with pytest.raises(InputError):
        checked(PROBLEM | {"adhesion": table})


def test_an_unknown_solid_is_refused_where_the_document_is_read(run: Runner, tmp_path: Path) -> None:
    table = {"pair": "unobtainium/polystyrene", "range": "1 nm"}
    with refused(InputError, "problem document: adhesion.pair", "'unobtainium'", "paraffin wax", "polystyrene"):
        checked(PROBLEM | {"adhesion": table})
    document = tmp_path / "case.toml"
    document.write_text(dumps(checked(PROBLEM | {"adhesion": None})), encoding="utf-8")
    options = ("--adhesion-pair", "unobtainium/polystyrene", "--adhesion-range", "1nm")
    done = run("contact", "--from", document, *options, "--out", tmp_path / "out")
    assert "--adhesion-pair" in subject_of(done)
    assert not (tmp_path / "out").exists()


def test_parting_needs_an_approach() -> None:
    with refused(InputError, "approach"):
        build(checked(PROBLEM | {"control": {"mean_pressure": "1 kPa"}}))
