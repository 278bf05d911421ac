"""The page of every kind of study, and the files beside it."""

from __future__ import annotations

import csv
from html.parser import HTMLParser
from pathlib import Path

import pytest
import tomli_w
from study_cases import LOADS, PROBLEM, SEEDS, InProcess, study

from asperity.report.study import write_study_files
from asperity.studies.campaign import Campaign, prepare_study
from asperity.studies.run import carry_out

pytestmark = pytest.mark.usefixtures("unrendered")

SEED = {"path": "surface.seed", "distribution": "seed"}
STUDIES = {
    "sweep": {"axes": [LOADS, {"path": "body.layers.0.thickness", "values": ["1 nm", "10 nm"]}]},
    "list": {"axes": [LOADS, {**SEEDS, "values": [1, 2, 3]}], "combine": "list"},
    "words": {"axes": [{"path": "boundary.kind", "values": ["periodic", "free"]}]},
    "monte_carlo": {"axes": [LOADS], "monte_carlo": {"seed": 1, "samples": 5, "random": [SEED]}},
    "histogram": {"monte_carlo": {"seed": 1, "samples": 5, "random": [SEED]}},
    "convergence": {"axes": [LOADS], "convergence": {"of": "grid", "levels": [16, 32, 64]}},
    "critical_thickness": {"axes": [LOADS], "critical_thickness": {"first": "1 nm", "last": "10 um", "count": 4}},
    "sensitivity": {"sensitivity": {"parameters": ["control.mean_pressure", "body.layers.0.thickness"]}},
}
FINDINGS = {"monte_carlo", "histogram", "convergence", "critical_thickness", "sensitivity"}


class Reader(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.pictures = 0
        self.headings: list[str] = []
        self._inside = False
        self.links: list[str] = []

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        self.pictures += tag == "img" and values["src"].startswith("data:image/png;base64,") and bool(values["alt"])
        self._inside = tag == "h2"
        self.links += [value for key, value in attrs if key in ("href", "src") and not value.startswith(("data:", "#"))]

    def handle_data(self, data):
        if self._inside and data.strip():
            self.headings.append(data.strip())


def made(tmp_path: Path, name: str) -> Campaign:
    (tmp_path / "s.toml").write_text(tomli_w.dumps(study(**STUDIES[name], title=f"A <{name}>")), encoding="utf-8")
    campaign = prepare_study(tmp_path / "s.toml")
    assert repr(campaign).splitlines()[0] == f"Study {campaign.title}"
    assert "0 done, 0 failed" in repr(campaign)
    carry_out(campaign.plan, campaign.records, InProcess())
    return campaign


@pytest.mark.parametrize("name", [name for name in STUDIES if name != "critical_thickness"])
def test_every_kind_of_study_has_its_files(tmp_path, name):
    page_and_files(made(tmp_path, name), name)


def page_and_files(campaign, name):
    """Text of the page, after all files are checked."""
    write_study_files(campaign, campaign.folder)
    page = (campaign.folder / "report.html").read_text(encoding="utf-8")
    reader = Reader()
    reader.feed(page)
    assert f"A &lt;{name}&gt;" in page
    assert "All cases are done." in page
    assert reader.links == [], "the page needs nothing else"
    assert ("Findings" in reader.headings) == (name in FINDINGS)
    pictures = list((campaign.folder / "plots").glob("*.png")) if (campaign.folder / "plots").exists() else []
    assert reader.pictures == len(pictures)
    assert len(pictures) >= (0 if name == "words" else 4), "one for each quantity where there is something to draw"
    assert (campaign.folder / "findings.csv").exists() == (name in FINDINGS)
    with (campaign.folder / "cases.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == campaign.plan.n_cases
    assert all(float(row["max_pressure"]) > 0.0 for row in rows)
    return page


def test_findings_of_critical_thickness_are_in_the_page(tmp_path):
    page = page_and_files(made(tmp_path, "critical_thickness"), "critical_thickness")
    for text in (
        "floor",
        "ceiling",
        "endless layer",
        "mean pressure 1 MPa",
        "Study of critical thickness: 18 cases",
        "6 points, 0 m to endless",
    ):
        assert text in page
    assert "inf m" not in page
    assert "Burmister1945" in page


def test_a_study_under_way_says_what_is_missing(tmp_path):
    (tmp_path / "s.toml").write_text(tomli_w.dumps(study(axes=[SEEDS, LOADS])), encoding="utf-8")
    campaign = prepare_study(tmp_path / "s.toml")
    write_study_files(campaign, campaign.folder)
    page = (campaign.folder / "report.html").read_text(encoding="utf-8")
    assert "12 cases are missing." in page
    assert PROBLEM["surface"]["size"] in page


def test_the_running_mean_of_an_unfinished_study_ends_with_its_samples(tmp_path, monkeypatch):
    """Samples still to be computed are no samples: a flat line would say that the mean does not
    change any more."""
    drawn = []
    monkeypatch.setattr("asperity.report.study.plot_running_mean", lambda y, halves, means, ax: drawn.append(means))
    campaign = made(tmp_path, "histogram")
    lines = campaign.records.read_bytes().splitlines(keepends=True)
    campaign.records.write_bytes(b"".join(lines[:-2]))
    write_study_files(campaign, campaign.folder)
    assert {means.size for means in drawn} == {3}
