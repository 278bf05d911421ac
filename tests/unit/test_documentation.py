"""The examples of README and docs run, on a small generated scan in place of the reader's file."""

from __future__ import annotations

import ast
import builtins
import math
import re
import shlex
import tomllib
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import asperity as asp
from asperity.cli.main import app
from asperity.core.settings import declared
from asperity.physics.menisci.part import Menisci
from asperity.physics.stress.part import Stress
from asperity.physics.wear.part import WearSettings
from asperity.run.document import load_document, loads
from asperity.studies.documents import study_from_table
from asperity.studies.plan import make_plan

pytestmark = pytest.mark.usefixtures("undrawn")

ROOT = Path(__file__).parents[2]
GUIDES = sorted((ROOT / "docs").rglob("*.md"))


READ = 'scan = asp.periodised(asp.levelled(asp.filled(asp.read("scan.di"))))  # the map to press\n'
"""Line of a guide that reads the file of the reader; the tests have a scan in its place."""


def blocks(path: Path, language: str) -> list[str]:
    text = path.read_text(encoding="utf-8").replace(READ, "")
    return re.findall(rf"^[ ]*```{language}\n(.*?)^[ ]*```", text, re.DOTALL | re.MULTILINE)


def test_guides_run_as_pasted():
    """Every name is imported or made on the page itself, before it is used."""
    lost = {}
    for page in [ROOT / "README.md", *GUIDES]:
        made = set(dir(builtins)) | ({"scan"} if READ in page.read_text(encoding="utf-8") else set())
        for code in blocks(page, "python"):
            nodes = list(ast.walk(ast.parse(code)))
            names = [node for node in nodes if isinstance(node, ast.Name)]
            made |= {node.id for node in names if not isinstance(node.ctx, ast.Load)}
            made |= {
                n.asname or n.name
                for node in nodes
                if isinstance(node, ast.Import | ast.ImportFrom)
                for n in node.names
            }
            made |= {
                node.name for node in nodes if isinstance(node, ast.FunctionDef | ast.ClassDef | ast.ExceptHandler)
            }
            made |= {node.arg for node in nodes if isinstance(node, ast.arg)}
            if unknown := {node.id for node in names} - made:
                lost.setdefault(page.name, set()).update(unknown)
    assert lost == {}


@pytest.fixture
def scan() -> asp.Surface:
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(100e-9), hurst=0.8, rolloff_wavelength=3e-6, shortest_wavelength=1e-6
    )
    return asp.generate.gaussian(asp.Grid((48, 48), (0.1e-6, 0.1e-6)), spectrum, seed=1)


def test_the_example_of_the_readme(scan, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (code,) = blocks(ROOT / "README.md", "python")
    assert 'asp.read("scan.di")' in code
    exec(compile(code.replace('asp.read("scan.di")', "scan"), "README.md", "exec"), {"scan": scan})  # noqa: S102 - running the page is the test
    assert asp.load("contact.nc").converged
    assert "Polonsky" in capsys.readouterr().out


def test_the_first_contact(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    names = {}
    for number, code in enumerate(blocks(ROOT / "docs/start/first-contact.md", "python")):
        exec(compile(code, f"block {number}", "exec"), names)  # noqa: S102 - running the page is the test
    printed = capsys.readouterr().out
    assert "100 nm, DLC" in printed
    assert "100 nm, bearing steel" in printed
    assert {"contact.nc", "report.html"} == {path.name for path in tmp_path.iterdir()}
    assert 0.5 < names["model"].at_pressure(100e6).area_fraction[0] / names["result"].area_fraction_corrected < 1.2


def test_the_examples_of_loading_and_unloading(scan, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    first, *rest = blocks(ROOT / "docs/how-to/loading-and-unloading.md", "python")
    names = {"scan": scan}
    exec(compile(first, "first block", "exec"), names)  # noqa: S102 - running the page is the test
    # each of the two solves is uncertain in energy by its field error times load times rms height,
    # some times over
    again, rms = names["again"], scan.heights.std()
    assert again.plastic_work <= 10.0 * again.certificate.tolerance * again.force * rms
    assert names["loaded"].plastic_work > 0.0
    for number, code in enumerate(rest):
        exec(compile(code, f"block {number + 2}", "exec"), names)  # noqa: S102 - running the page is the test
    assert names["result"].mean_pressure == pytest.approx(500e6)
    assert names["balance"].relative_error < 0.05
    assert {"path.nc", "path.csv", "plots"} == {path.name for path in tmp_path.iterdir()}
    assert not names["found"].below.is_plastic
    assert names["worn"].plastic.any()
    np.testing.assert_allclose(
        names["worn"].pressure[names["worn"].plastic], names["limit"][names["worn"].plastic], rtol=2e-5
    )
    (text,) = blocks(ROOT / "docs/how-to/loading-and-unloading.md", "toml")
    head = 'version = 1\nbody = "DLC:20nm/Co-Cr"\nsurface = { kind = "flat", points = [8, 8], size = "1 um" }\n'
    assert loads(head + text).control.path.steps == 8


def test_the_examples_of_layered_bodies(scan, capsys):
    names = {"scan": scan}
    for number, code in enumerate(blocks(ROOT / "docs/how-to/layered-bodies.md", "python")):
        exec(compile(code, f"block {number}", "exec"), names)  # noqa: S102 - running the page is the test
    assert names["result"].area_fraction > names["bare"].area_fraction, "DLC is softer than steel here"
    assert names["line"].converged
    assert 0.0 < names["line"].contact_area < 2e-6
    assert len(capsys.readouterr().out.splitlines()) == 3


def test_the_examples_of_stresses(scan, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    names = {"scan": scan}
    for number, code in enumerate(blocks(ROOT / "docs/how-to/stress.md", "python")):
        exec(compile(code, f"block {number}", "exec"), names)  # noqa: S102 - running the page is the test
    assert sorted(path.name for path in tmp_path.iterdir()) == ["section.nc", "stress.png", "volume.vtr"]
    assert names["report"].first is not None
    assert names["found"].report.load_factor == pytest.approx(1.0, abs=0.02)
    assert "DLC" in capsys.readouterr().out


@pytest.mark.slow
def test_the_examples_of_generation(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    names = {}
    for number, code in enumerate(blocks(ROOT / "docs/how-to/generate.md", "python")):
        exec(compile(code, f"block {number}", "exec"), names)  # noqa: S102 - running the page is the test
    made = [value for value in names.values() if isinstance(value, asp.Surface)]
    assert len(made) > 15
    assert np.load(tmp_path / "big.npy", mmap_mode="r").shape == (2000, 1500)
    np.testing.assert_array_equal(asp.read(tmp_path / "rough.nc").heights, names["rough"].heights)
    printed = capsys.readouterr().out
    assert "must be at least 2.799" in printed
    assert "Jacobs" in printed
    assert asp.roughness.rms_height(names["grooved"]) == pytest.approx(1e-9, rel=0.01)
    (text,) = blocks(ROOT / "docs/how-to/generate.md", "toml")
    rest = '\n[body]\nmaterial = "DLC"\n[control]\nmean_pressure = "1 MPa"\n'
    assert loads("version = 1\n" + text + rest).surface.kind == "rough"


def test_the_examples_of_preparation(scan, capsys):
    first, second, tips = blocks(ROOT / "docs/how-to/prepare.md", "python")
    names = {"scan": asp.Surface(scan.heights, scan.dx)}
    assert 'asp.read("scan.di")' in first
    exec(compile(first.replace('asp.read("scan.di")', "scan"), "first block", "exec"), names)  # noqa: S102 - running the page is the test
    exec(compile(second, "second block", "exec"), names)  # noqa: S102 - running the page is the test
    exec(compile(tips, "block of tips", "exec"), names)  # noqa: S102 - running the page is the test
    assert (names["behind"].heights <= scan.heights).all()
    words = ["despiked", "line-corrected", "masked", "filled", "levelled"]
    words += ["tip-limited", "filtered", "resampled", "periodised"]
    assert [line.split(":")[0] for line in capsys.readouterr().out.splitlines()] == words
    assert names["problem"].surface.dx == pytest.approx(scan.dx)
    (text,) = blocks(ROOT / "docs/how-to/prepare.md", "toml")
    table = 'version = 1\n[surface]\nkind = "file"\npath = "a.di"\n' + text
    rest = '\n[body]\nmaterial = "DLC"\n[control]\nmean_pressure = "1 MPa"\n'
    assert len(loads(table + rest).surface.prepare) == 9


def test_the_example_of_statistical_theories(capsys):
    (code,) = blocks(ROOT / "docs/theory/statistical-contact.md", "python")
    exec(compile(code, "statistical-contact.md", "exec"), {})  # noqa: S102 - running the page is the test
    printed = capsys.readouterr().out
    assert "bush-gibson-thomas 0.0" in printed
    assert "area fraction holds [Carbone2008]" in printed


def test_the_examples_of_scaling_theories(capsys):
    names = {}
    for number, code in enumerate(blocks(ROOT / "docs/theory/scaling-theories.md", "python")):
        exec(compile(code, f"block {number}", "exec"), names)  # noqa: S102 - running the page is the test
    assert 0.0 < names["curve"].area_fraction[0] < names["curve"].area_fraction[1] < 1.0
    assert len(capsys.readouterr().out.splitlines()) == 2


def test_the_examples_of_comparing(scan, tmp_path, monkeypatch, capsys):
    """The commands as printed, but for the loads of the first, whose dozen add nothing."""
    monkeypatch.chdir(tmp_path)
    page, names = ROOT / "docs/how-to/compare.md", {"scan": scan}
    for number, code in enumerate(blocks(page, "python")):
        exec(compile(code, f"block {number}", "exec"), names)  # noqa: S102 - running the page is the test
    printed = capsys.readouterr().out
    assert "fuller-tabor left out: It needs the work of adhesion" in printed
    assert "greenwood-williamson - height deviation" in printed
    assert [curve.name for curve in names["mine"].curves] == ["persson", "bush-gibson-thomas"]
    assert asp.files.open_tree("comparison.nc").to_dataset().sizes["pressure"] == 5
    asp.files.save_surface(scan, "scan.nc")
    (console,) = blocks(page, "console")
    lines = [line.removeprefix("$ ").split("  #")[0] for line in console.splitlines()]
    assert len(lines) == 3
    for line in lines[1:]:
        result = CliRunner().invoke(app, shlex.split(line.replace("scan.di", "scan.nc"))[1:])
        assert result.exit_code == 0, result.output
        assert "Theories and numerical solution" in result.stdout
    assert "--out" in lines[0]


def test_the_examples_of_single_contacts(capsys):
    names = {}
    for number, code in enumerate(blocks(ROOT / "docs/theory/single-contacts.md", "python")):
        exec(compile(code, f"block {number}", "exec"), names)  # noqa: S102 - running the page is the test
    assert "Hertz" in capsys.readouterr().out
    assert names["answer"].max_pressure[0] == pytest.approx(names["answer"].max_pressure[2] / 100 ** (1 / 3))
    assert names["onset"].at_surface
    assert np.all(names["curve"].area_fraction >= names["elastic"].area_fraction)
    assert names["pressure"] < 0.0 < names["sticky"].reach


def test_the_example_of_frictional_heating(capsys):
    (code,) = blocks(ROOT / "docs/theory/heating.md", "python")
    names = {}
    exec(compile(code, "heating.md", "exec"), names)  # noqa: S102 - running the page is the test
    assert len(capsys.readouterr().out.splitlines()) == 3
    bare, coated = (
        names["theories"].MovingSource(names["spot"].source, names[body], 5.0).mean() for body in ("steel", "coated")
    )
    assert bare < coated < bare + 2e-6  # thickness over conductivity of the layer


def test_the_example_of_theories_of_wear(capsys):
    (code,) = blocks(ROOT / "docs/theory/wear.md", "python")
    names = {}
    exec(compile(code, "wear.md", "exec"), names)  # noqa: S102 - running the page is the test
    assert len(capsys.readouterr().out.splitlines()) == 3
    assert names["after"].core[0] == 0.0 < names["ball"].life < 10.0


def test_the_examples_of_wet_contact(tmp_path, monkeypatch, capsys):
    """On a surface as smooth as the films are thin; the table of options and keys has everything
    twice."""
    monkeypatch.chdir(tmp_path)
    waves = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(2e-9), hurst=0.8, rolloff_wavelength=1e-6, shortest_wavelength=0.1e-6
    )
    scan = asp.generate.gaussian(asp.Grid((48, 48), (40e-9, 40e-9)), waves, seed=5)
    asp.files.save_surface(scan, "scan.nc")
    page = ROOT / "docs/how-to/wet-contact.md"
    names = {"scan": scan}
    for number, code in enumerate(blocks(page, "python")):
        exec(compile(code, f"block {number}", "exec"), names)  # noqa: S102 - running the page is the test
    assert asp.load("wet.nc").menisci.meniscus_force == names["wet"].menisci.meniscus_force
    assert names["held"].external_force == pytest.approx(names["wet"].external_force, rel=0.1)
    capsys.readouterr()
    for line in commands(page):
        result = CliRunner().invoke(app, shlex.split(line.replace("scan.di", "scan.nc"))[1:])
        assert result.exit_code == 0, result.output
        assert "Liquid film and menisci" in result.stdout
    film, own = blocks(page, "toml")
    head = (
        'version = 1\nbody = "DLC"\nsurface = { kind = "flat", points = [8, 8], size = "1 um" }\ncontrol '
        '= { force = "1 mN" }\n'
    )
    assert loads(head + film).film.contact_angle == pytest.approx((math.pi / 3, math.pi / 3))
    (tmp_path / "own.toml").write_text(own, encoding="utf-8")
    assert asp.liquid("our lubricant", library=tmp_path / "own.toml").viscosity == 0.08


@pytest.mark.slow
def test_the_examples_of_stick_and_slip(tmp_path, monkeypatch, capsys):
    """On a small smooth scan: Python and the second command give the same heat; the steps of the
    document are solved."""
    monkeypatch.chdir(tmp_path)
    waves = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(2e-9), hurst=0.8, rolloff_wavelength=1e-6, shortest_wavelength=0.2e-6
    )
    scan = asp.generate.gaussian(asp.Grid((24, 24), (40e-9, 40e-9)), waves, seed=5)
    asp.files.save_surface(scan, "scan.nc")
    page, names = ROOT / "docs/how-to/stick-slip.md", {"scan": scan}
    (code,) = blocks(page, "python")
    exec(compile(code, page.name, "exec"), names)  # noqa: S102 - running the page is the test
    assert names["found"].dissipated > 0.0
    capsys.readouterr()
    for line in commands(page):
        result = CliRunner().invoke(app, shlex.split(line.replace("scan.di", "scan.nc"))[1:])
        assert result.exit_code == 0, result.output
    saved = asp.files.open_tree("fretting/result.nc")["stick_slip"]
    heat = names["loop_of"](names["history"].steps).cycle_energies[0]
    assert float(saved["cycle_dissipation"]) == pytest.approx(heat, rel=1e-3)
    (steps,) = blocks(page, "toml")
    head = (
        'version = 2\nbody = "DLC"\nsurface = { kind = "file", path = "scan.nc" }\ncontrol = { '
        'mean_pressure = "50 MPa" }\n'
    )
    outcome = asp.run(tomllib.loads(head + steps))
    assert len(outcome.path.steps) == 4
    assert outcome.values["force_x"] == pytest.approx(0.1e-6, rel=1e-4)
    assert outcome.values["mean_pressure"] == pytest.approx(40e6)


def test_the_examples_of_rolling(tmp_path, monkeypatch, capsys):
    """Python and the commands of the page, on coarser grids."""
    monkeypatch.chdir(tmp_path)
    page, names = ROOT / "docs/how-to/rolling.md", {}
    (code,) = blocks(page, "python")
    exec(compile(code.replace("64)", "24)"), page.name, "exec"), names)  # noqa: S102 - running the page is the test
    assert 0.3 < names["found"].force_x / names["found"].friction_limit < 0.5
    assert names["curve"].theories == ()
    capsys.readouterr()
    (block,) = blocks(page, "console")
    for line in block.splitlines():
        shorter = line.replace("--points 64", "--points 32").replace("--creep-points 8", "--creep-points 2")
        result = CliRunner().invoke(app, shlex.split(shorter.removeprefix("$ "))[1:])
        assert result.exit_code == 0, result.output
    saved = asp.files.open_tree("run/result.nc")["rolling"]
    assert float(saved["fastsim_longitudinal_force"]) == pytest.approx(
        float(saved["rolling_longitudinal_force"]), rel=0.1
    )


def test_the_example_of_conductance(capsys):
    page, names = ROOT / "docs/how-to/conductance.md", {}
    (code,) = blocks(page, "python")
    exec(compile(code.replace("128, 128", "64, 64"), page.name, "exec"), names)  # noqa: S102 - running the page is the test
    loaded, unloaded = (asp.conductance.conductance(names["path"].steps[n]).total for n in (0, 2))
    assert unloaded > loaded
    assert capsys.readouterr().out.count("ohm") == 3


def test_the_example_of_flash_temperatures(capsys):
    page, names = ROOT / "docs/how-to/frictional-heating.md", {}
    (code,) = blocks(page, "python")
    exec(compile(code.replace("128, 128", "64, 64"), page.name, "exec"), names)  # noqa: S102 - running the page is the test
    assert names["hot"].share > 0.5, "the coating of the moving body sends the heat into the other one"
    assert capsys.readouterr().out.count("into the body") == 2


def test_the_example_of_sensitivities(capsys):
    page, names = ROOT / "docs/how-to/sensitivities.md", {}
    code, at_yield = blocks(page, "python")
    exec(compile(code, page.name, "exec"), names)  # noqa: S102 - running the page is the test
    assert abs(names["peak"].euler_defect) < 1e-6
    assert "body.layers[0].thickness" in capsys.readouterr().out
    exec(compile(at_yield, page.name, "exec"), names)  # noqa: S102 - running the page is the test
    assert names["found"].relative["strength"] > 1.0


def test_the_example_of_uncertainty(capsys):
    page, names = ROOT / "docs/how-to/uncertainty.md", {}
    code, of_yield = blocks(page, "python")
    exec(compile(code, page.name, "exec"), names)  # noqa: S102 - running the page is the test
    low, high = names["found"].interval
    assert low < names["found"].value < high
    assert names["found"].sampled.gain > 5.0
    exec(compile(of_yield, page.name, "exec"), names)  # noqa: S102
    low, high = names["factor"].interval
    assert 0.0 < low < names["factor"].value < high


def test_the_examples_of_wear(capsys):
    page, names = ROOT / "docs/how-to/wear.md", {}
    code, of_stresses = blocks(page, "python")
    exec(compile(code, page.name, "exec"), names)  # noqa: S102 - running the page is the test
    first, last = (names["history"].kept[end][1] for end in (0, -1))
    assert last.area_fraction > 2.0 * first.area_fraction
    assert last.max_pressure < 0.5 * first.max_pressure
    assert "bare after" in capsys.readouterr().out
    exec(compile(of_stresses, page.name, "exec"), names)  # noqa: S102
    told = [line for line in capsys.readouterr().out.splitlines() if "yields at" in line]
    factors = [float(line.split()[4]) for line in told]
    assert factors == sorted(factors), "it bears more as it wears"


def test_the_commands_of_wear(tmp_path, monkeypatch):
    """On a small scan; every option of the tables is one of the command, with the key beside it."""
    monkeypatch.chdir(tmp_path)
    page = ROOT / "docs/how-to/wear.md"
    spectrum = asp.generate.GaussianAutocorrelation(1e-7, 1e-6)
    asp.files.save_surface(asp.generate.gaussian(asp.Grid((32, 32), (3e-7, 3e-7)), spectrum, seed=1), "scan.nc")
    line, study = (line for block in blocks(page, "console") for line in block.splitlines())
    result = CliRunner().invoke(app, [*shlex.split(line.removeprefix("$ "))[1:], "--wear-tolerance", "10%"])
    assert result.exit_code == 0, result.output
    assert (tmp_path / "run" / "wear.csv").exists()
    assert float(asp.files.open_tree("run/result.nc")["wear/wear_distance"]) == 1.0
    assert (ROOT / "examples/campaigns" / shlex.split(study)[3]).exists()
    (wheel,) = blocks(page, "toml")
    wears = asp.run(tomllib.loads(wheel.replace("48, 48", "16, 16")))
    assert wears.values["wear_distance"] == 1e5
    assert wears.values["wear_volume"] > 0.0
    shown = set(re.findall(r"(--[a-z-]+)", page.read_text(encoding="utf-8")))
    options = {declared(key, field).option for key, field in WearSettings.model_fields.items()}
    assert options <= shown


def test_the_example_of_sealing(capsys):
    page, names = ROOT / "docs/how-to/sealing.md", {}
    (code,) = blocks(page, "python")
    exec(compile(code.replace("128, 128", "64, 64"), page.name, "exec"), names)  # noqa: S102 - running the page is the test
    assert names["leak"].bracket.lower < names["leak"].rate
    assert "closes at" in capsys.readouterr().out


@pytest.mark.slow
def test_the_commands_of_sealing(tmp_path, monkeypatch):
    """On a small scan; the study of the page varies what a seal has."""
    monkeypatch.chdir(tmp_path)
    page = ROOT / "docs/how-to/sealing.md"
    spectrum = asp.generate.GaussianAutocorrelation(1e-7, 1e-6)
    asp.files.save_surface(asp.generate.gaussian(asp.Grid((32, 32), (3e-7, 3e-7)), spectrum, seed=1), "scan.nc")
    for line in [line for block in blocks(page, "console") for line in block.splitlines()]:
        result = CliRunner().invoke(app, shlex.split(line.removeprefix("$ "))[1:])
        assert result.exit_code == 0, result.output
    assert (tmp_path / "factors" / "flow_factors.csv").exists()
    leaks = asp.files.open_tree("run/result.nc")["sealing"]
    assert leaks["path_leak_rate"].size == 3
    (table,) = blocks(page, "toml")
    assert [axis["path"] for axis in tomllib.loads(table)["axes"]] == [
        "control.mean_pressure",
        "surface.spectrum.rms_height",
    ]


@pytest.mark.slow
def test_the_examples_of_viscoelastic_bodies():
    page, names = ROOT / "docs/how-to/viscoelastic.md", {}
    for code in blocks(page, "python"):
        exec(compile(code, page.name, "exec"), names)  # noqa: S102 - running the page is the test
    assert names["fit"].largest_error < 0.05
    assert names["response"].loss_tangent > 0.0
    assert names["found"].slope_friction == pytest.approx(names["found"].friction, rel=0.1)


@pytest.mark.slow
def test_the_commands_and_documents_of_viscoelastic_bodies(tmp_path, monkeypatch):
    """Commands on coarser grids; each table is read as a part of a document."""
    monkeypatch.chdir(tmp_path)
    page = ROOT / "docs/how-to/viscoelastic.md"
    for line in [line for block in blocks(page, "console") for line in block.splitlines()]:
        shorter = re.sub(r"--points \d+", "--points 16", line).removeprefix("$ ")
        more = ["--speed-points", "2"] if "--slowest" in shorter else []
        result = CliRunner().invoke(app, [*shlex.split(shorter)[1:], *more])
        assert result.exit_code == 0, result.output
    assert float(asp.files.open_tree("run/result.nc")["viscoelastic/viscoelastic_time"]) == pytest.approx(121.0)
    sliding = asp.files.open_tree("sliding/result.nc")["hysteresis"]
    assert float(sliding["hysteresis_friction"]) == pytest.approx(float(sliding["hysteresis_slope_friction"]), rel=0.1)
    head = 'version = 2\nsurface = { kind = "flat", points = [8, 8], size = "1 um" }\n'
    times, body, speeds = blocks(page, "toml")
    load = '\n[control]\nmean_pressure = "1 kPa"\n'
    solid = loads(head + load + body).body.relaxation
    assert [float(time) for time in solid.times] == [0.1, 0.01]
    assert loads(head + 'body = "steel"\n' + times).viscoelastic.temperature == 310.0
    assert loads(head + 'body = "steel"\n' + load + speeds).hysteresis.points == 9


def test_the_options_of_films_and_their_keys_mean_the_same(tmp_path, monkeypatch):
    """Every row of the table in the guide, as option and as key."""
    monkeypatch.chdir(tmp_path)
    page = (ROOT / "docs/how-to/wet-contact.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `(--[a-z-]+) ([^`]+)` \| `([^`]+)` \|", page, re.MULTILINE)
    assert len(rows) == 10
    head = 'version = 2\nbody = "DLC"\ncontrol = { force = "1 mN" }\n'
    head += 'surface = { kind = "flat", points = [8, 8], size = "1 um" }\n'
    base = {"liquid": 'liquid = "PFPE"', "thickness": 'thickness = "1 nm"'}
    for option, value, key in rows:
        more = {**base, "liquid": 'liquid = "water"'} if option == "--humidity" else base
        (tmp_path / "p.toml").write_text(head + "[film]\n" + "\n".join(more.values()), encoding="utf-8")
        words = ["contact", "--from", "p.toml", option, value, "--save-document", "q.toml", "--force"]
        assert CliRunner().invoke(app, words).exit_code == 0, option
        name = key.split(" = ")[0]
        lines = [line for known, line in more.items() if known != name]
        wanted = head + in_table("film", [*lines, key])
        found = load_document(tmp_path / "q.toml")
        assert Menisci().asked(found, tmp_path) == Menisci().asked(loads(wanted), tmp_path), option


def in_table(name: str, keys: list[str]) -> str:
    """Keys of a document, those in full before the table ``name`` with the others."""
    whole = [key for key in keys if key.startswith("friction.")]
    return "\n".join([*whole, f"[{name}]", *(key for key in keys if key not in whole)])


def commands(path: Path) -> list[str]:
    """Commands `asperity contact` on a scan, without their comments."""
    lines = [line.strip() for block in blocks(path, "console") for line in block.splitlines()]
    found = [line.removeprefix("$ ").split("  #")[0] for line in lines if line.startswith("$ asperity contact")]
    return [line for line in found if "scan.di" in line]


@pytest.mark.parametrize(
    "page",
    [
        "README.md",
        "docs/how-to/measured-scan.md",
        "docs/how-to/coated-contact.md",
        "docs/how-to/loading-and-unloading.md",
    ],
)
def test_the_commands_on_a_scan(scan, tmp_path, monkeypatch, page):
    monkeypatch.chdir(tmp_path)
    asp.files.save_surface(scan, "scan.nc")
    found = commands(ROOT / page)
    assert found
    for line in found:
        result = CliRunner().invoke(app, shlex.split(line.replace("scan.di", "scan.nc"))[1:])
        assert result.exit_code == 0, result.output
        assert ("Largest stresses inside" in result.stdout) == ("--friction" in line)


@pytest.mark.slow
def test_the_document_of_the_coated_contact(tmp_path):
    (text,) = blocks(ROOT / "docs/how-to/coated-contact.md", "toml")
    (tmp_path / "p.toml").write_text(text, encoding="utf-8")
    result = CliRunner().invoke(app, ["contact", "--from", str(tmp_path / "p.toml")])
    assert result.exit_code == 0, result.output
    assert "DLC 50 nm / graded titanium nitride - steel 1 µm in 8 layers /" in result.stdout
    assert "graded titanium nitride - steel / steel, 1.05 µm" in result.stdout


def test_the_options_of_stresses_and_their_keys_mean_the_same(scan, tmp_path, monkeypatch):
    """Every row of the table in the guide, as option and as key."""
    monkeypatch.chdir(tmp_path)
    asp.files.save_surface(scan, "scan.nc")
    page = (ROOT / "docs/how-to/coated-contact.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `(--[a-z-]+[^`]*)` \| `([^`]+)` \|", page, re.MULTILINE)
    assert len(rows) > 8
    head = 'version = 2\nbody = "DLC:1um/steel"\ncounter_body = "steel"\n'
    head += 'surface = { kind = "flat", points = [8, 8], size = "1 um" }\ncontrol = { force = "1 mN" }\n'
    for option, key in rows:
        (tmp_path / "p.toml").write_text(head + "[stress]", encoding="utf-8")
        words = ["contact", "--from", "p.toml", *option.split(maxsplit=1), "--save-document", "q.toml", "--force"]
        assert CliRunner().invoke(app, words).exit_code == 0, option
        found, wanted = load_document(tmp_path / "q.toml"), loads(head + in_table("stress", [key]))
        assert Stress().asked(found, tmp_path) == Stress().asked(wanted, tmp_path), option


def test_the_problem_document_of_the_guide_is_valid():
    (text,) = blocks(ROOT / "docs/how-to/problem-document.md", "toml")
    assert loads(text).title == "Two rough bodies"


def test_the_materials_of_the_guide_are_valid(tmp_path):
    (text,) = blocks(ROOT / "docs/how-to/own-materials.md", "toml")
    file = tmp_path / "my.toml"
    file.write_text(text, encoding="utf-8")
    assert asp.material("coating A", library=file).strength.hardness == 21e9
    assert asp.material("seal rubber", library=file).youngs_modulus == 5e6


def test_the_studies_of_the_guide(tmp_path, monkeypatch):
    """The sweep of the page runs; each kind of study is a valid addition to it, and so are
    expressions and limits."""
    monkeypatch.chdir(tmp_path)
    page = ROOT / "docs/how-to/campaigns.md"
    sweep, expressions, axis, *kinds = blocks(page, "toml")
    problem = """
        version = 1
        body = "E=140GPa,nu=0.25:5nm/E=200GPa,nu=0.3"
        control = { mean_pressure = "1 MPa" }
        [surface]
        kind = "rough"
        points = [16, 16]
        size = "5 um"
        seed = 1
        spectrum = { kind = "gaussian", rms_height = "1 nm", correlation_length = "1 um" }
    """
    Path("problem.toml").write_text(problem, encoding="utf-8")
    Path("thickness.toml").write_text(sweep, encoding="utf-8")
    names = {}
    (code,) = blocks(page, "python")
    exec(compile(code, page.name, "exec"), names)  # noqa: S102 - running the page is the test
    assert names["peak"].dims == ("thickness",)
    assert bool((names["peak"] > 0.0).all())
    assert names["campaign"].state().complete
    head = sweep.partition("[[axes]]")[0]
    found = {study_from_table(tomllib.loads(head + kind), Path()).document.kind for kind in kinds}
    assert found == {"monte_carlo", "convergence", "critical_thickness", "sensitivity"}
    assert make_plan(study_from_table(tomllib.loads(head + expressions + axis), Path())).columns[-1] == "Y"
    for kind in kinds:
        make_plan(study_from_table(tomllib.loads(head + kind), Path()))


@pytest.mark.parametrize("page", [ROOT / "README.md", ROOT / "CONTRIBUTING.md"], ids=lambda p: p.name)
def test_links_lead_somewhere(page):
    """Those of all pages of the site: ``tests/unit/test_site.py``."""
    for target in re.findall(r"\]\(([^)#]+)\)", page.read_text(encoding="utf-8")):
        if not target.startswith("http"):
            assert (page.parent / target).exists(), f"{page.name} links to {target}"


@pytest.mark.parametrize("package", ["tamaas", "ContactMechanics"])
def test_the_same_problem_in_other_packages(package, capsys):
    """Where they are installed they give the pressures of asperity, with the numbers that the page
    states."""
    pytest.importorskip(package, reason=f"{package} is not installed, whose pressures would be compared")
    page = ROOT / "docs/reference/other-packages.md"
    problem, ours, *scripts = blocks(page, "python")
    names = {}
    for code in (
        problem,
        ours,
        next(code for code in scripts if f"{package} import" in code or f"import {package}" in code),
    ):
        exec(compile(code, page.name, "exec"), names)  # noqa: S102 - running the page is the test
    theirs = names["of_tamaas" if package == "tamaas" else "of_contact_mechanics"]
    result = names["result"]
    assert np.abs(theirs - result.pressure).max() < 2e-6 * result.max_pressure
    assert np.array_equal(theirs > 0.0, result.contact)


def test_the_same_problem_for_asperity_and_contact(tmp_path, monkeypatch, capsys):
    """Pixels and pressure as stated; the file for CONTACT has a distance for each element, none of
    them negative, x first."""
    monkeypatch.chdir(tmp_path)
    page = ROOT / "docs/reference/other-packages.md"
    problem, ours, *_, written = blocks(page, "python")
    names = {}
    for code in (problem, ours, written):
        exec(compile(code, page.name, "exec"), names)  # noqa: S102 - running the page is the test
    result, text = names["result"], page.read_text(encoding="utf-8")
    assert f"{int(result.contact.sum())} pixels touch" in text
    assert f"{result.max_pressure / 1e9:.3f} GPa" in text
    head, _, rest = (tmp_path / "cap.inp").read_text().partition("IBASE, IPLAN\n")
    distance = np.array(rest.partition(" 0  MODULE")[0].split(), dtype=float)
    assert "26315.789" in head
    np.testing.assert_allclose(
        distance.reshape(64, 64).T,
        1e3 * np.ptp(names["heights"]) - 1e3 * (names["heights"] - names["heights"].min()),
        atol=1e-12,
    )
    assert distance.min() == 0.0
