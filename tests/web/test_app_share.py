"""What is taken away from the application is solved again elsewhere, under the names of the user's
own files."""

from __future__ import annotations

import csv
import json
import tomllib
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from typer.testing import CliRunner

pytest.importorskip("nicegui", reason="the extra web is not installed")

import asperity as asp
from asperity.cli.main import app as program
from asperity.core.grid import Grid
from asperity.files import save_surface
from asperity.generate import ExponentialAutocorrelation, gaussian
from asperity.web.beginning import open_document
from asperity.web.session import Place
from asperity.web.workers import Limits

from .app_server import AppServer
from .expecting import expect
from .test_app import base_of, document, finished, go, put

SCAN = "scan 7 of disk (left).nc"


@pytest.fixture
def scan(tmp_path: Path) -> Path:
    """A map with its scale."""
    (tmp_path / "mine").mkdir()
    surface = gaussian(Grid((32, 32), (1e-8, 1e-8)), ExponentialAutocorrelation(1e-9, 5e-8), seed=3)
    save_surface(surface, tmp_path / "mine" / SCAN)
    return tmp_path / "mine" / SCAN


def values(file: Path) -> list[list[str]]:
    """Rows of a table of scalars, without what depends on the clock."""
    with file.open(encoding="utf-8", newline="") as source:
        return [row for row in csv.reader(source) if "time" not in row[0] and "memory" not in row[0]]


def downloaded(page: Any, text: str, folder: Path) -> Path:
    """What a link gives, under the name that is proposed for it."""
    folder.mkdir(exist_ok=True)
    with page.expect_download() as found:
        page.click(f"[data-state=done] .downloads >> text={text}")
    file = folder / str(found.value.suggested_filename)
    found.value.save_as(file)
    return file


@pytest.mark.slow
def test_downloads_and_the_archive_are_solved_again(scan: Path, open_page: Callable[..., Any], tmp_path: Path) -> None:
    away = tmp_path / "away"
    with AppServer(("--demo", "--threads", "1")) as app:
        page = open_page(app.address, viewport={"width": 1400, "height": 900}, accept_downloads=True).page
        base_of(page)
        page.wait_for_selector(".drop")
        with page.expect_navigation():
            put(page, scan)
        page.wait_for_selector("h1")
        go(page, "run")
        page.click("[data-run]")
        finished(page)
        problem = downloaded(page, "document", away)
        archive = downloaded(page, "Share", away)
        result = downloaded(page, "result (NetCDF)", away)
        scalars = downloaded(page, "scalars (CSV)", away)
        with page.context.expect_page() as opened:
            page.click("text=report >> visible=true")
        opened.value.wait_for_load_state("load")
        report = opened.value.content()
        private = page.evaluate("document.documentElement.outerHTML")
        opened.value.close()
        page.close()
    assert "asperity-app-" not in private + report + problem.read_text(encoding="utf-8")
    assert SCAN in report
    assert tomllib.loads(problem.read_text(encoding="utf-8"))["surface"]["path"] == SCAN
    with h5py.File(result) as content:
        text = json.dumps([str(value) for value in content.attrs.values()])
        named: list[str] = []
        content.visititems(lambda name, item: named.extend(str(value) for value in item.attrs.values()))
    assert "asperity-app-" not in text + " ".join(named)
    assert SCAN in text + " ".join(named)

    # the document beside the scan, and the archive alone
    (away / SCAN).write_bytes(scan.read_bytes())
    for given, out in ((["--from", problem], "again"), ([archive], "unpacked")):
        ran = CliRunner().invoke(program, ["contact", *map(str, given), "--out", str(tmp_path / out)])
        assert ran.exit_code == 0, ran.output
        assert values(tmp_path / out / "scalars.csv") == values(scalars)
    with zipfile.ZipFile(archive) as content:
        assert {"problem.toml", SCAN, "report.html"} == set(content.namelist())
    assert tomllib.loads((tmp_path / "unpacked" / "problem.toml").read_text())["surface"]["path"] == SCAN
    (tmp_path / "unpacked").rename(tmp_path / "moved")
    ran = CliRunner().invoke(program, ["contact", "--from", str(tmp_path / "moved" / "problem.toml")])
    assert ran.exit_code == 0, ran.output
    one, two = asp.load(tmp_path / "moved" / "result.nc"), asp.load(result)
    assert isinstance(one, asp.ContactResult)
    assert isinstance(two, asp.ContactResult)
    np.testing.assert_array_equal(one.pressure, two.pressure)


def archive_of(scan: Path, folder: Path) -> Path:
    """An archive as somebody else shares it."""
    text = f"""
version = 2
title = "Shared"
body = "DLC"
[surface]
kind = "file"
path = "{scan.name}"
[control]
mean_pressure = "20 MPa"
"""
    with zipfile.ZipFile(folder / "shared.zip", "w") as archive:
        archive.writestr("problem.toml", text)
        archive.write(scan, scan.name)
    return folder / "shared.zip"


@pytest.mark.slow
def test_an_archive_is_dropped_and_opened(scan: Path, open_page: Callable[..., Any], tmp_path: Path) -> None:
    archive = archive_of(scan, tmp_path)
    with AppServer(("--demo", "--threads", "1")) as app:
        page = open_page(app.address, viewport={"width": 1400, "height": 900}).page
        base_of(page)
        page.wait_for_selector(".drop")
        with page.expect_navigation():
            put(page, archive)
        page.wait_for_selector(".of:has-text('Shared')")
        page.wait_for_selector("text=32 × 32 points", timeout=60_000)
        asked = document(page)
        assert asked["surface"]["path"] == SCAN
        assert asked["control"] == {"mean_pressure": "20 MPa"}
        bad = tmp_path / "bad.zip"
        with zipfile.ZipFile(bad, "w") as content:
            content.writestr("problem.toml", 'version = 2\n[surface]\nkind = "file"\npath = "../../etc/passwd"\n')
        put(page, bad)
        page.wait_for_selector(".q-notification:has-text('../../etc/passwd')")
        assert document(page) == asked
        expect(page.locator("text=bad.zip is here")).to_have_count(1)


@pytest.mark.slow
@pytest.mark.parametrize("kept", [False, True])
def test_the_application_is_started_with_an_archive(
    kept: bool, scan: Path, open_page: Callable[..., Any], tmp_path: Path
) -> None:
    folder = ("--folder", str(tmp_path / "kept")) if kept else ()
    with AppServer((str(archive_of(scan, tmp_path)), "--threads", "1", *folder)) as app:
        page = open_page(app.address, viewport={"width": 1400, "height": 900}).page
        page.wait_for_selector("text=32 × 32 points", timeout=60_000)
    if kept:
        assert (tmp_path / "kept" / "files" / SCAN).read_bytes() == scan.read_bytes()


def test_a_document_finds_its_files_from_its_own_folder(scan: Path, tmp_path: Path) -> None:
    problem = scan.parent / "problem.toml"
    problem.write_text(f'version = 2\n[surface]\nkind = "file"\npath = "{SCAN}"\n', encoding="utf-8")
    (tmp_path / "own").mkdir()
    place = Place(tmp_path / "own", Limits.usual(), 1, 1)
    _, session = place.new()
    open_document(session, problem)
    assert session.draft.get("surface", "path") == str(scan)
    assert session.labels == {str(scan): SCAN}
    place.close()
    assert scan.exists()


def test_nothing_of_others_gets_into_an_archive(scan: Path, tmp_path: Path) -> None:
    """A folder of somebody else may hold a run whose document names a file of the user."""
    (tmp_path / "own").mkdir()
    place = Place(tmp_path / "own", Limits.usual(), 1, 1)
    _, session = place.new(tmp_path / "kept")
    run = session.new_run("run", "theirs", {})
    run.state = "done"
    session.folder_of(run).mkdir(parents=True)
    text = f'version = 2\nbody = "DLC"\n[surface]\nkind = "file"\npath = "{scan}"\n[control]\nmean_pressure = "1 MPa"\n'
    (session.folder_of(run) / "problem.toml").write_text(text, encoding="utf-8")
    with pytest.raises(asp.InputError) as caught:
        session.shared(run)
    assert caught.value.subject == "files of a run"
    place.close()
