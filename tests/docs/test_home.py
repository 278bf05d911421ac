"""The first page: an example of three lines, a report to explore, the map of theories, and the way
for each role."""

from __future__ import annotations

import re
import shlex
from html import unescape

import assemble
import live_report
import map_of_theories
import pytest
from doc_pages import DOCS, blocks, linked
from typer.testing import CliRunner

import asperity as asp
from asperity.cli.main import app
from asperity.run.document import load_document
from asperity.theories.catalogue import THEORIES

HOME = DOCS / "index.md"


@pytest.fixture
def scan(tmp_path, monkeypatch) -> str:
    """File of a small generated scan, in place of the reader's; in the working folder."""
    monkeypatch.chdir(tmp_path)
    waves = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(100e-9), hurst=0.8, rolloff_wavelength=3e-6, shortest_wavelength=1e-6
    )
    surface = asp.generate.gaussian(asp.Grid((48, 48), (0.1e-6, 0.1e-6)), waves, seed=1)
    asp.files.save_surface(surface, "scan.nc")
    return "scan.nc"


def test_the_example_has_three_lines_and_runs(scan, capsys):
    (code,) = blocks(HOME, "python")
    assert len([line for line in code.splitlines() if line.strip()]) == 3
    names = {}
    exec(compile(code.replace("scan.di", scan), HOME.name, "exec"), names)  # noqa: S102 - running the page is the test
    printed = " ".join(capsys.readouterr().out.split())
    for sentence in (names["answer"].verdict.what, names["answer"].verdict.holds):
        assert " ".join(sentence.split()) in printed


def test_the_command_is_the_same_problem(scan):
    (code,) = blocks(HOME, "python")
    answer = eval(re.search(r"asp\.press\(.*\)", code)[0].replace("scan.di", scan), {"asp": asp})
    (command,) = re.findall(r"`(asperity contact [^`]*)`", HOME.read_text(encoding="utf-8"))
    words = shlex.split(command.replace("scan.di", scan))[1:]
    result = CliRunner().invoke(app, [*words, "--save-document", "problem.toml"])
    assert result.exit_code == 0, result.output
    assert load_document("problem.toml") == answer.case.document


def test_the_site_shows_the_report_in_a_frame_and_a_checkout_does_not():
    assert HOME.read_text(encoding="utf-8").count(live_report.MARK) == 1
    shown = assemble.pages()["index.md"]
    assert live_report.MARK not in shown
    assert re.findall(r'<iframe [^>]*src="([^"]+)"', shown) == [live_report.NAME]


@pytest.mark.slow
def test_the_report_can_be_explored_and_needs_nothing_else(tmp_path):
    page = live_report.write(tmp_path).read_text(encoding="utf-8")
    assert [path.name for path in tmp_path.iterdir()] == [live_report.NAME]
    assert re.search(r"<canvas|data-scene|<script>", page)
    assert re.findall(r'(?:src|href)="(?!data:|#)([^"]+)"', page) == []


def test_the_map_is_drawn_from_the_catalogue_and_the_limits():
    drawn = map_of_theories.PAGE.read_text(encoding="utf-8")
    assert drawn == map_of_theories.picture(), "python docs/site/map_of_theories.py draws it anew"
    texts = unescape(" ".join(re.findall(r"<text x=[^>]*>([^<]*)</text>", drawn)))
    assert [kind.title for kind in THEORIES.values() if kind.title not in texts] == []
    boxes, _, _ = map_of_theories.places()
    assert boxes.keys() == THEORIES.keys()
    assert drawn.count('<path class="l"') == len(map_of_theories.limits()) > 0


def test_no_two_boxes_of_the_map_overlap():
    boxes, _, height = map_of_theories.places()
    for name, (column, y) in boxes.items():
        tall = map_of_theories.ROW * len(map_of_theories.lines(name)) + 4
        assert 0.0 < y - 0.5 * tall < y + 0.5 * tall < height
        for other, (beside, z) in boxes.items():
            if other != name and beside == column:
                assert abs(y - z) >= 0.5 * tall + 0.5 * map_of_theories.ROW


def test_the_first_page_shows_the_map_and_leads_to_the_roles():
    aims = linked(HOME)
    assert map_of_theories.PAGE in aims
    assert {DOCS / "roles" / f"{role}.md" for role in ("lab", "design-engineer", "researcher", "developer")} <= aims
