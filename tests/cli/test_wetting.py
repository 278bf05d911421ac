"""Liquid films on the command line and in documents: what is printed, drawn and written, and what
is refused."""

from __future__ import annotations

import csv
import math
from pathlib import Path

import numpy as np
import pytest
from cli.conftest import Runner
from contact_cases import wetted
from refusals import subject_of

import asperity as asp
from asperity.run.document import load_document

pytestmark = pytest.mark.usefixtures("undrawn")
NM = 1e-9
DLC = ("--body", "DLC", "--pressure", "2MPa")
WATER = ("--liquid", "water", "--humidity", "80%", "--contact-angle", "60deg,60deg")


@pytest.fixture
def scan(tmp_path: Path) -> Path:
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(2.0 * NM), hurst=0.8, rolloff_wavelength=1e-6, shortest_wavelength=100 * NM
    )
    surface = asp.generate.gaussian(asp.Grid((48, 48), (40 * NM, 40 * NM)), spectrum, seed=5)
    asp.files.save_surface(surface, tmp_path / "scan.nc")
    return tmp_path / "scan.nc"


def test_a_run_with_menisci(run: Runner, scan: Path, tmp_path: Path) -> None:
    out = tmp_path / "run"
    result = run("contact", scan, *DLC, *WATER, "--friction", 0.3, "--out", out)
    assert result.exit_code == 0, result.stderr
    for text in ("60°", "2.414 nm", "toe-dipping", "2 MPa"):
        assert text in result.stdout, text
    assert not (out / "stress.csv").exists(), "the friction coefficient is that of the film alone"
    wet = asp.load(out / "result.nc")
    film = asp.LiquidFilm.at_humidity(asp.liquid("water"), 0.8, contact_angles=(np.pi / 3.0, np.pi / 3.0))
    assert wet.problem.film.meniscus_height == pytest.approx(film.meniscus_height, rel=1e-12)
    direct = wetted(asp.ContactProblem(wet.problem.surface, asp.material("DLC")), asp.MeanPressure(2e6), film)
    assert wet.menisci.meniscus_force == pytest.approx(direct.menisci.meniscus_force, rel=1e-12)
    assert wet.control == asp.MeanPressure(2e6)
    assert (out / "plots" / "menisci.png").read_bytes().startswith(b"\x89PNG")
    with (out / "scalars.csv").open(encoding="utf-8") as file:
        rows = {row["name"]: row["value"] for row in csv.DictReader(file)}
    assert float(rows["meniscus_force"]) == wet.menisci.meniscus_force
    assert float(rows["force"]) == pytest.approx(wet.external_force + wet.menisci.meniscus_force, rel=1e-3)
    html = (out / "report.html").read_text(encoding="utf-8")
    for text in ("[TianBhushan1996]", "[Gao1995]"):
        assert text in html, text

    again = run("contact", "--from", out / "problem.toml", "--humidity", "70%", "--csv", tmp_path / "again.csv")
    assert again.exit_code == 0, again.stderr
    with (tmp_path / "again.csv").open(encoding="utf-8") as file:
        drier = {row["name"]: row["value"] for row in csv.DictReader(file)}
    assert float(drier["meniscus_force"]) < wet.menisci.meniscus_force
    assert float(drier["static_friction"]) < wet.menisci.static_friction


def test_without_summits_it_is_said_why_there_is_no_theory(run: Runner, tmp_path: Path) -> None:
    ball = asp.generate.sphere(asp.Grid((32, 32), (6.0 * NM, 6.0 * NM)), radius=1e-6)
    asp.files.save_surface(ball, tmp_path / "ball.nc")
    loaded = ("--body", "E=100GPa,nu=0.3", "--pressure", "25MPa", "--boundary", "free")
    found = run("contact", tmp_path / "ball.nc", *loaded, "--liquid", "PFPE", "--film", "1nm")
    assert found.exit_code == 0, found.stderr
    assert "20" in found.stdout


def test_saved_menisci_are_drawn_and_exported(run: Runner, scan: Path, tmp_path: Path) -> None:
    film = asp.LiquidFilm.of(asp.liquid("PFPE"), 2.0 * NM)
    wet = wetted(asp.ContactProblem(asp.read(scan), asp.material("DLC")), asp.MeanPressure(2e6), film)
    asp.save(wet, tmp_path / "wet.nc")
    drawn = run("plot", tmp_path / "wet.nc", "--kind", "menisci", "--out", tmp_path / "pictures")
    assert drawn.exit_code == 0, drawn.stderr
    assert (tmp_path / "pictures" / "menisci.png").exists()
    assert run("export", tmp_path / "wet.nc", "--csv", tmp_path / "a.csv", "--vtk", tmp_path / "a.vti").exit_code == 0
    assert run("export", tmp_path / "wet.nc", "--surface", tmp_path / "a.nc").exit_code == 0
    np.testing.assert_array_equal(asp.read(tmp_path / "a.nc").heights, wet.problem.surface.heights)
    assert f"meniscus_force,{wet.menisci.meniscus_force!r},N" in (tmp_path / "a.csv").read_text("utf-8")
    assert "TianBhushan1996" in run("cite", tmp_path / "wet.nc").stdout
    dry = asp.solve(asp.ContactProblem(asp.read(scan), asp.material("DLC")), asp.MeanPressure(2e6))
    asp.save(dry, tmp_path / "dry.nc")
    assert subject_of(run("plot", tmp_path / "dry.nc", "--kind", "menisci", "--out", tmp_path)) == "--kind"


def test_a_film_beside_stresses(run: Runner, scan: Path, tmp_path: Path) -> None:
    """Friction counts for both where stresses are asked for; the stresses are those under load and
    menisci."""
    asked = ("--liquid", "PFPE", "--film", "1nm", "--friction", 0.3, "--section", "y=max", "--out", tmp_path / "run")
    found = run("contact", scan, *DLC, *asked)
    assert found.exit_code == 0, found.stderr
    assert (tmp_path / "run" / "stress.csv").exists()
    assert asp.load(tmp_path / "run" / "result.nc").menisci.static_friction > 0.0


def test_every_option_of_the_film_reaches_the_document(run: Runner, scan: Path, tmp_path: Path) -> None:
    own = tmp_path / "own.toml"
    own.write_text('[liquid."ours"]\nsurface_tension = "30 mN/m"\ntemperature = "300 K"\n', "utf-8")
    options = ("--liquid", "ours", "--liquids-file", own, "--surface-tension", "20mN/m", "--film", "1nm")
    more = ("--meniscus-height", "2nm", "--contact-angle", "10deg", "--viscosity", "10mPa*s", "--speed", "1mm/s")
    document = tmp_path / "sub" / "p.toml"
    document.parent.mkdir()
    found = run("contact", scan, *DLC, *options, *more, "--friction", 0.2, "--save-document", document)
    assert found.exit_code == 0, found.stderr
    assert "20 mN/m" in found.stdout
    assert "10 mPa·s" in found.stdout
    film = load_document(document).film
    assert film is not None
    assert Path(film.liquids_file).name == "own.toml"
    assert (film.thickness, film.meniscus_height) == (1e-9, 2e-9)
    assert load_document(document).friction.coefficient == 0.2
    assert film.contact_angle == pytest.approx((math.radians(10.0),))
    assert run("contact", "--from", document).exit_code == 0


@pytest.mark.parametrize(
    ("options", "subject"),
    [
        (("--film", "2nm"), "the film"),
        (("--liquid", "water"), "the film"),
        (("--liquid", "water", "--humidity", "120%"), "--humidity"),
        (("--liquid", "watr", "--film", "1nm"), "liquid"),
        (("--liquid", "water", "--film", "1"), "--film"),
        (("--liquid", "PFPE", "--humidity", "50%"), "molar volume of head-disk lubricant"),
        (("--surface-tension", "30mN/m", "--humidity", "50%"), "the film"),
        (("--liquid", "water", "--humidity", "50%", "--meniscus-height", "1nm"), "the film"),
        (("--liquid", "water", "--film", "1nm", "--contact-angle", "1deg,2deg,3deg"), "--contact-angle"),
        (("--liquid", "water", "--film", "1nm", "--contact-angle", "120deg,80deg"), "contact angles"),
        (("--liquid", "PFPE", "--film", "1nm", "--speed", "1mm/s"), "viscosity of the liquid"),
    ],
)
def test_films_that_cannot_be_used_are_refused(run: Runner, scan: Path, options: tuple[str, ...], subject: str) -> None:
    found = run("contact", scan, *DLC, *options)
    assert subject_of(found) == subject


def test_a_force_that_runs_away_is_told(run: Runner, scan: Path) -> None:
    found = run("contact", scan, "--body", "E=1GPa,nu=0.3", "--pressure", "10kPa", "--liquid", "PFPE", "--film", "2nm")
    assert found.exit_code == 2
    assert "meniscus" in found.stderr


def test_a_force_that_is_not_fed_back(run: Runner, scan: Path, tmp_path: Path) -> None:
    """It is there where feedback runs away, and verdict, document and files say which it is; with
    adhesional friction beside it."""
    soft = ("--body", "E=1GPa,nu=0.3", "--pressure", "10kPa", "--liquid", "PFPE", "--film", "2nm")
    adhesional = ("--friction-law", "tresca", "--friction-strength", "20MPa")
    found = run("contact", scan, *soft, *adhesional, "--no-meniscus-feedback", "--out", tmp_path / "unfed")
    assert found.exit_code == 0, found.stderr
    assert load_document(tmp_path / "unfed" / "problem.toml").film.feedback is False
    wet = asp.load(tmp_path / "unfed" / "result.nc")
    assert wet.force == pytest.approx(10e3 * wet.problem.grid.area, rel=1e-9)
    assert wet.menisci.relative_meniscus_force > 1.0
    assert wet.menisci.friction_force == pytest.approx(
        20e6 * np.count_nonzero(wet.contact) * wet.problem.grid.pixel_area, rel=1e-12
    )
    fed = run("contact", "--from", tmp_path / "unfed" / "problem.toml", "--meniscus-feedback")
    assert fed.exit_code == 2


def test_the_shear_strength_limits_the_viscous_force(run: Runner, scan: Path, tmp_path: Path) -> None:
    moving = (*DLC, *WATER, "--friction", 0.3, "--speed", "1m/s")
    strength, force, area = 3e3, {}, {}
    for name, more in (
        ("free", ()),
        ("limited", ("--shear-strength", "3kPa")),
        ("strong", ("--shear-strength", "1TPa")),
    ):
        out = tmp_path / name
        assert run("contact", scan, *moving, *more, "--out", out).exit_code == 0
        wet = asp.load(out / "result.nc")
        force[name], area[name] = wet.menisci.viscous_force, np.count_nonzero(wet.menisci.wetting.menisci)
    pixel = wet.problem.grid.pixel_area
    assert force["free"] / (area["free"] * pixel) > strength
    assert force["limited"] == pytest.approx(strength * area["limited"] * pixel, rel=1e-12)
    assert force["strong"] == force["free"]
    assert load_document(tmp_path / "limited" / "problem.toml").film.shear_strength == strength
    assert subject_of(run("contact", scan, *moving, "--shear-strength", "3nm")) == "--shear-strength"
