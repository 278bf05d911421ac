"""A duality gap above 1e-3 stands above everything that is said of a contact: on pages, on screens,
in studies, in notebooks."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from study_cases import LOADS, InProcess, study

import asperity as asp
from asperity.cli.campaigns import _print_causes
from asperity.cli.show import print_result
from asperity.contact.history import HistoryResult
from asperity.report.study import cause_table, warning_texts, write_study_report
from asperity.run.execute import analysed
from asperity.studies.campaign import Campaign, prepare_study
from asperity.studies.run import carry_out

pytestmark = pytest.mark.usefixtures("unrendered")

SAID = "The elastic energy is known to 3.2e-02 of itself only"


@pytest.fixture(scope="module")
def doubtful() -> asp.ContactResult:
    """A contact whose duality gap is 3.2e-2."""
    heights = np.random.default_rng(1).standard_normal((16, 16))
    surface = asp.Surface(heights * 1e-9, 1e-7, periodic=True)
    found = asp.solve(asp.ContactProblem(surface, asp.Elastic(1e9, 0.3)), asp.MeanPressure(1e6))
    assert found.verdict.grade != "not"
    return replace(found, certificate=replace(found.certificate, duality_gap=0.032))


def first_warning(text: str) -> int:
    assert text.count(SAID) == 1, text
    return text.index(SAID)


def test_on_a_page(doubtful: asp.ContactResult, tmp_path: Path) -> None:
    asp.write_report(doubtful, tmp_path / "r.html", advice=(asp.contact.review(doubtful)[0],))
    page = re.sub(r"</?span[^>]*>", "", (tmp_path / "r.html").read_text(encoding="utf-8"))
    assert first_warning(page) < page.index('<dl class="cards">')
    assert page.index("Not to be trusted: ") < first_warning(page)


@pytest.mark.parametrize("asks", [{"contact": True}, {}])
def test_on_a_screen(doubtful: asp.ContactResult, asks: dict[str, bool], capsys: pytest.CaptureFixture[str]) -> None:
    print_result(analysed(doubtful, asks))
    said = capsys.readouterr().out
    assert said[: first_warning(said)].endswith("Not to be trusted: ")


def test_of_a_step_of_a_load_path(doubtful: asp.ContactResult, capsys: pytest.CaptureFixture[str]) -> None:
    sound = replace(doubtful, certificate=replace(doubtful.certificate, duality_gap=1e-8))
    path = HistoryResult((doubtful, sound))
    assert SAID in path.verdict.trust
    assert SAID not in HistoryResult((sound, sound)).verdict.trust
    print_result(analysed(sound, {"contact": True}, path))
    first_warning(capsys.readouterr().out)


def test_in_python_and_on_a_card(doubtful: asp.ContactResult) -> None:
    assert doubtful.verdict.grade == "not"
    assert SAID in doubtful.verdict.trust
    assert SAID in " ".join(repr(doubtful).split())
    first_warning(doubtful._repr_html_())


def test_in_a_study(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr("asperity.parts.advice.LARGEST_DUALITY_GAP", -1.0)
    campaign: Campaign = prepare_study(study(axes=[LOADS]), tmp_path / "study")
    carry_out(campaign.plan, campaign.records, InProcess())
    state = campaign.state()
    first, *_ = warning_texts(state)
    assert "known to" in first
    write_study_report(campaign, tmp_path / "s.html")
    page = (tmp_path / "s.html").read_text(encoding="utf-8")
    assert page.index("duality gap") < page.index("All cases are done")
    _print_causes(campaign, state)
    said = capsys.readouterr().out
    assert said.index("known to") < said.index("Warnings and notes of the cases")
    at = cause_table(campaign, state.findings, "Warning or note").cells[0][2]
    assert at.endswith((" Pa", "kPa", "MPa", "GPa")), f"a place without its unit: {at}"
