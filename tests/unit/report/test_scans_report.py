"""Many scans of one surface on a page: tables, figures, findings, and the waves of a contact."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import asperity as asp
from asperity.core.grid import Grid
from asperity.generate import ExponentialAutocorrelation, gaussian
from asperity.plots.scans import SCALES_PLOTS, SCANS_PLOTS, WAVES_PLOTS
from asperity.report.scans import ScansInWords, scans_summary
from asperity.roughness import deciding_waves_of
from asperity.surfaces import Scan, Scans


@pytest.fixture(scope="module")
def told() -> ScansInWords:
    model = ExponentialAutocorrelation(1e-9, 2e-7)
    maps = [gaussian(Grid((64, 64), (size / 64, size / 64)), model, seed=1) for size in (8e-6, 2e-6)]
    short = Scan(np.zeros(20), 1e-9, name="too short", tip_radius=1e-7)
    scans = Scans([*(Scan.of(one, name=f"scan {i}") for i, one in enumerate(maps)), short])
    spectrum = scans.spectrum()
    return ScansInWords(scans, spectrum, deciding_waves_of(spectrum, 1e11, 1e6, hardness=5e9))


def test_every_scan_and_every_question_has_its_row(told: ScansInWords) -> None:
    tables = dict(told.tables())
    bands = tables["Reliable waves"]
    assert [row[0] for row in bands.cells] == [scan.name for scan in told.scans.scans]
    assert [row[-1] for row in bands.cells] == ["yes", "yes", "no"]
    assert told.waves is not None
    assert len(tables["Scans that suffice"].cells) == len(told.waves.shares)
    assert len(tables["Share of each octave"].cells) == told.waves.longest.size
    for table in tables.values():
        assert {len(row) for row in table.cells} == {len(table.headings)}
    assert "3" in scans_summary(told)


def test_findings_are_those_of_spectrum_and_contact(told: ScansInWords) -> None:
    criteria = [item.criterion for item in told.findings]
    assert "reliable band" in criteria
    assert any(name.startswith("waves of") for name in criteria)
    alone = ScansInWords(told.scans, told.spectrum)
    assert alone.findings == told.spectrum.findings
    assert len(alone.tables()) == 2
    assert len(told.main_rows()) == len(alone.main_rows()) + 1


@pytest.mark.usefixtures("unrendered")
def test_a_page(told: ScansInWords, tmp_path: Path) -> None:
    asp.report.write_scans_report(told.scans, tmp_path / "page.html", spectrum=told.spectrum, waves=told.waves)
    text = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert [scan.name for scan in told.scans.scans if scan.name not in text] == []
    with pytest.raises(asp.errors.OutputError):
        asp.report.write_scans_report(told.scans, tmp_path / "page.html", spectrum=told.spectrum)


def test_every_figure_draws(told: ScansInWords) -> None:
    from matplotlib.figure import Figure

    for plots, thing in ((SCANS_PLOTS, told.spectrum), (SCALES_PLOTS, told.curves), (WAVES_PLOTS, told.waves)):
        for plot in plots:
            ax = Figure().subplots()
            plot.draw(thing, ax)
            assert ax.get_xlabel()
            assert ax.get_ylabel()
    assert len(told.figures()) == 5
