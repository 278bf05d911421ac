"""The parts of a report on plastic deformation and load paths: what they say, and when they are
there."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import asperity as asp
from asperity.core.status import Outcome, Status
from asperity.parts.contact_work import energy_table, path_sentence, plastic_rows, turn_table
from asperity.parts.part import Found
from asperity.physics.hardness.work import plastic_load_row
from asperity.run.execute import analysed

pytestmark = pytest.mark.usefixtures("unrendered")


def posed(law: asp.Hardness | asp.plasticity.HardWall) -> asp.ContactProblem:
    noise = np.random.default_rng(7).standard_normal((24, 16))
    heights = sum(np.roll(noise, (i, j), (0, 1)) for i in range(3) for j in range(3)) * 1e-9
    return asp.ContactProblem(asp.Surface(heights, 2e-8, 1e-8, periodic=True), asp.Elastic(1e11, 0.3), law=law)


@pytest.fixture(scope="module")
def path() -> asp.HistoryResult:
    return asp.solve(posed(asp.Hardness(3e9)), asp.History(asp.contact.ramps(asp.MeanPressure, [4e8, 0.0], steps=4)))


def page(tmp_path: Path, answer: asp.ContactResult | asp.studies.Outcome) -> str:
    asp.write_report(answer, tmp_path / "report.html")
    return (tmp_path / "report.html").read_text(encoding="utf-8")


def test_a_path_is_reported(path: asp.HistoryResult, tmp_path: Path) -> None:
    text = page(tmp_path, analysed(path.steps[-1], {"path": True, "plasticity": True}, path))
    for words in (
        "Plastic deformation",
        "Load path",
        "Where the load turns",
        "400 MPa",
        "Plastic zone",
        "Residual surface",
    ):
        assert words in text
    assert text.count("data:image/png") == 9 + 2 + 3


def test_an_elastic_contact_has_no_such_part(tmp_path: Path) -> None:
    text = page(tmp_path, asp.solve(posed(asp.plasticity.HardWall()), asp.MeanPressure(4e8)))
    assert "Plastic deformation" not in text
    assert "Load path" not in text


def test_tables_hold_the_turns(path: asp.HistoryResult) -> None:
    turns, energies = turn_table(path), energy_table(path)
    assert [cells[0] for cells in turns.cells] == [cells[0] for cells in energies.cells] == ["4", "8"]
    assert turns.cells[0][1] == "400 MPa"
    assert turns.cells[1][3] == "0 %"
    assert all(len(cells) == len(turns.headings) for cells in turns.cells)
    assert all(len(cells) == len(energies.headings) for cells in energies.cells)
    assert energies.cells[1][2] == "0 J"


def test_rows_and_summary(path: asp.HistoryResult) -> None:
    top, last = path.steps[3], path.steps[-1]
    rows = dict(plastic_rows(top))
    assert "plastic: more than 2 %" in rows["plastic area under this load / real area"]
    assert "µm²" in rows["area ever plastic"] or "nm²" in rows["area ever plastic"]
    assert rows["volume of the permanent indentation"].endswith(("µm³", "nm³"))
    assert top.verdict.fails
    assert top.verdict.holds.startswith("Plastic: ")
    assert last.verdict.what.startswith("The bodies do not touch; ")
    assert "stays" in path.verdict.what
    lighter = asp.solve(top.problem, asp.MeanPressure(1e8), state=top.state)
    assert not lighter.verdict.fails
    assert lighter.verdict.holds.startswith("Elastic: ")


def test_steps_that_failed_are_named(path: asp.HistoryResult) -> None:
    failed = replace(path.steps[2], status=Status(Outcome.STAGNATED, "Stuck.", "Try."))
    broken = asp.HistoryResult((*path.steps[:2], failed, *path.steps[3:]))
    assert path_sentence(broken).endswith("Not converged: step 3.")
    assert "Not converged" not in path_sentence(path)


def test_the_plastic_load_is_reported(path: asp.HistoryResult, tmp_path: Path) -> None:
    result = path.steps[0]
    found = asp.plasticity.plastic_load(result.problem)
    label, text = plastic_load_row(found)
    assert label == "first load at which 2 % of the real area is plastic"
    assert "mean pressure" in text
    assert text in page(tmp_path, replace(analysed(result, {}), found={"plastic_load": Found(detail=found)}))
