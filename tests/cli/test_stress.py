"""Stresses inside the body from the command ``contact``: what is printed, drawn and written, and
what is refused."""

from __future__ import annotations

import csv
import math
from pathlib import Path

import numpy as np
import pytest
from cli.conftest import LOAD, SCALE, Runner
from contact_cases import slid
from refusals import subject_of

import asperity as asp
from asperity.core.units import show
from asperity.io.results import load, open_tree
from asperity.run.document import load_document

pytestmark = pytest.mark.usefixtures("undrawn")
COATED = ("--body", "E=200GPa,nu=0.25,H=20GPa,name=film:100nm/E=100GPa,nu=0.3,Y=1GPa,name=base")


@pytest.mark.slow
def test_a_run_with_stresses(run: Runner, matrix: Path, tmp_path: Path) -> None:
    out = tmp_path / "run"
    wanted = ("--friction", 0.3, "--direction", "90deg", "--depths", "0nm, 100nm", "--section", "y=max")
    more = ("--section", "x=2um", "--profile", "x=max", "--tensile-strength", "1GPa")
    result = run("contact", matrix, *SCALE, *COATED, *LOAD, *wanted, *more, "--out", out)
    assert result.exit_code == 0, result.stderr
    for text in ("film", "base", "100 nm", "(σ1 − σ3)/2", "7.143 GPa", "H/2.8", str(out / "stress.csv")):
        assert text in result.stdout, text
    names = {path.name for path in out.iterdir()}
    assert names == {"report.html", "result.nc", "scalars.csv", "plots", "problem.toml", "stress.csv"}
    fields = sorted(open_tree(out / "result.nc")["stress"].children)
    assert fields[:2] == ["planes", "profile_1"]
    assert all(name.startswith("section_") for name in fields[2:])
    pictures = {path.stem for path in (out / "plots").iterdir()}
    assert {"stress_plane_1", "stress_plane_2", "stress_plane_3", "stress_profile_1"} <= pictures
    assert {"stress_section_1_von_mises"} <= pictures
    assert any(name.endswith("shear_yz") for name in pictures)

    solved = load(out / "result.nc")
    field = asp.stress(solved, [0.0, 100e-9], friction=0.3, direction=np.pi / 2.0)
    planes = open_tree(out / "result.nc")["stress/planes"].to_dataset()
    np.testing.assert_allclose(planes["xx"], field.normal_xx, rtol=1e-12)
    with (out / "stress.csv").open(encoding="utf-8") as file:
        rows = {(row["name"], row["quantity"]): float(row["value"]) for row in csv.DictReader(file)}
    assert rows["film", "max_von_mises"] >= field.within("film").von_mises.max() * (1.0 - 1e-12)
    html = (out / "report.html").read_text(encoding="utf-8")
    assert "90°" in html
    assert "[Burmister1945]" in html

    again = run("contact", "--from", out / "problem.toml", "--out", tmp_path / "again")
    assert again.exit_code == 0, again.stderr
    with (tmp_path / "again" / "stress.csv").open(encoding="utf-8") as file:
        assert file.read() == (out / "stress.csv").read_text(encoding="utf-8")


def test_stresses_are_computed_only_where_asked_for(
    run: Runner, matrix: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    computed: list[int] = []
    from asperity.physics.stress import compute

    whole = compute.StressPlanes.read

    def counted(self, *arguments):  # type: ignore[no-untyped-def]
        computed.append(1)
        whole(self, *arguments)

    monkeypatch.setattr(compute.StressPlanes, "read", counted)
    out = tmp_path / "run"
    result = run("contact", matrix, *SCALE, *COATED, *LOAD, "--out", out)
    assert result.exit_code == 0
    assert computed == []
    assert not (out / "stress.csv").exists()
    assert load_document(out / "problem.toml").stress is None
    assert "stress" not in open_tree(out / "result.nc").children
    run("contact", matrix, *SCALE, *COATED, *LOAD, "--depths", "10nm,20nm")
    assert len(computed) == 2


def test_friction_alone_shows_the_section_through_the_maximum(run: Runner, matrix: Path, tmp_path: Path) -> None:
    result = run("contact", matrix, *SCALE, *COATED, *LOAD, "--friction", 0.3, "--out", tmp_path / "run")
    assert result.exit_code == 0, result.stderr
    pictures = {path.stem for path in (tmp_path / "run" / "plots").glob("stress*")}
    shown = {name.split("_", 3)[3].removesuffix("_near") for name in pictures}
    assert shown == {"von_mises", "principal_tensile", "shear_xz"}


def test_volume_files(run: Runner, matrix: Path, tmp_path: Path) -> None:
    files = ("--stress-vtk", tmp_path / "v.vtr", "--stress-nc", tmp_path / "v.nc")
    command = ("contact", matrix, *SCALE, *COATED, *LOAD, *files, "--stress-precision", "single", "--deepest", "300nm")
    result = run(*command)
    assert result.exit_code == 0, result.stderr
    assert str(tmp_path / "v.vtr") in result.stdout
    volume = open_tree(tmp_path / "v.nc")["field"].to_dataset()
    assert volume["zz"].dims == ("plane", "x", "y")
    assert volume["zz"].dtype == np.float32
    assert float(volume["depth"].max()) == pytest.approx(300e-9)
    header = (tmp_path / "v.vtr").read_bytes()[:3000].decode("ascii", errors="replace")
    assert 'type="RectilinearGrid"' in header
    assert f'WholeExtent="0 31 0 23 0 {volume.sizes["plane"] - 1}"' in header
    assert subject_of(run(*command)) == "output file"


def test_coupling_changes_the_pressure(run: Runner, matrix: Path, tmp_path: Path) -> None:
    soft = ("--body", "E=100GPa,nu=0.1", "--friction", 0.8)
    for name, extra in (("plain", ()), ("coupled", ("--coupled",))):
        result = run("contact", matrix, *SCALE, *soft, *LOAD, *extra, "--out", tmp_path / name)
        assert result.exit_code == 0, result.stderr
    plain, coupled = (load(tmp_path / name / "result.nc") for name in ("plain", "coupled"))
    assert coupled.mean_pressure == pytest.approx(plain.mean_pressure)
    assert not np.allclose(coupled.pressure, plain.pressure, rtol=1e-3, atol=1e-3 * plain.max_pressure)
    direct = slid(plain.problem, plain.control, 0.8)
    np.testing.assert_allclose(coupled.pressure, direct.pressure, rtol=1e-9, atol=1e-9 * plain.max_pressure)
    html = (tmp_path / "coupled" / "report.html").read_text(encoding="utf-8")
    assert "[Dundurs1969]" in html


def test_options_over_a_document(run: Runner, matrix: Path, tmp_path: Path) -> None:
    document, changed = tmp_path / "p.toml", tmp_path / "q.toml"
    first = run(
        "contact", matrix, *SCALE, *COATED, *LOAD, "--friction", 0.3, "--depths", "5nm", "--save-document", document
    )
    assert first.exit_code == 0, first.stderr
    second = run("contact", "--from", document, "--friction", 0.1, "--stress-in", "body", "--save-document", changed)
    assert second.exit_code == 0, second.stderr
    asked = load_document(changed)
    assert (asked.friction.coefficient, asked.stress.depths) == (0.1, (5e-9,))


def test_stresses_in_the_counter_body(run: Runner, matrix: Path) -> None:
    bodies = ("--body", "rigid", "--counter", "E=1GPa,nu=0.3,name=seal")
    result = run("contact", matrix, *SCALE, *bodies, *LOAD, "--stress-in", "counter")
    assert result.exit_code == 0, result.stderr
    assert "seal" in result.stdout


@pytest.mark.parametrize(
    ("options", "subject"),
    [
        (("--depths", "1nm,5"), "part 2 of --depths"),
        (("--section", "y=5"), "y of part 1 of --section"),
        (("--section", "y=99um"), "y of a stress section"),
        (("--stress-in", "counter"), "body in which stresses are asked"),
        (("--friction", "0.1", "--body", "DLC:5nm~/steel"), "mean shear traction"),
        (("--depths", "1um", "--body", "DLC:5nm/rigid"), "depth (m)"),
    ],
)
def test_refusals(run: Runner, matrix: Path, tmp_path: Path, options: tuple[str, ...], subject: str) -> None:
    body = () if "--body" in options else COATED
    result = run("contact", matrix, *SCALE, *body, *LOAD, *options, "--out", tmp_path / "run")
    assert subject_of(result) == subject
    assert not (tmp_path / "run").exists()


def test_measured_surface(run: Runner, shared_data: Path, tmp_path: Path) -> None:
    """An AFM map of a granular film, coated, sliding: stresses at the surface follow the
    tractions."""
    source = shared_data / "afm_granular_film_10um_512.di"
    wanted = ("--friction", 0.3, "--depths", "0nm,100nm,20nm", "--section", "y=max")
    body = ("--body", "DLC:100nm/Cr:20nm/steel", "--hardness", "body", "--pressure", "50MPa")
    result = run("contact", source, *body, "--resample", 128, "--periodise", *wanted, "--out", tmp_path / "run")
    assert result.exit_code == 0, result.output
    solved = load(tmp_path / "run" / "result.nc")
    planes = open_tree(tmp_path / "run" / "result.nc")["stress/planes"].to_dataset()
    scale = solved.max_pressure
    np.testing.assert_allclose(planes["zz"][0], -solved.pressure, atol=1e-9 * scale)
    np.testing.assert_allclose(planes["xz"][0], -0.3 * solved.pressure, atol=1e-9 * scale)


def test_places_in_the_table_are_those_of_the_screen(run: Runner, matrix: Path, tmp_path: Path) -> None:
    """The middles of the pixels, as in figures, or an edge between two of them; the library counts
    from their corners."""
    out = tmp_path / "run"
    result = run("contact", matrix, *SCALE, *COATED, *LOAD, "--friction", 0.3, "--depths", "0nm", "--out", out)
    assert result.exit_code == 0, result.stderr
    solved = load(out / "result.nc")
    dx, dy = solved.problem.grid.spacing
    with (out / "stress.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    names = {"max_von_mises": "von Mises", "max_principal": "tension σ1", "max_shear": "shear (σ1 − σ3)/2"}
    placed = [row for row in rows if row["part"] == "layer" and row["name"] == "film" and row["quantity"] in names]
    assert len(placed) == 3
    printed = " ".join(result.stdout.split("Largest stresses inside each layer")[1].split("base, below")[0].split())
    for row in placed:
        x, y = float(row["x"]), float(row["y"])
        assert 0.5 in (pytest.approx(x / dx % 1.0), pytest.approx(y / dy % 1.0))
        value, error = show(float(row["value"]), "Pa"), float(row["error"])
        value = f"> {value}" if row["doubt"] else value if math.isnan(error) else f"{value} ± {show(error, 'Pa', 2)}"
        text = f"{names[row['quantity']]} {value} {show(x, 'm')} {show(y, 'm')}"
        assert text in printed
    surface = asp.stress(solved, [0.0], friction=0.3)
    peak = surface.largest_von_mises
    (von_mises,) = [row for row in placed if row["quantity"] == "max_von_mises" and row["side"] == "surface"]
    assert (float(von_mises["x"]), float(von_mises["y"])) == pytest.approx((peak.x + 0.5 * dx, peak.y + 0.5 * dy))
