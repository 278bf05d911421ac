"""The command ``stress``: the same numbers as with the contact, other friction without solving,
refusals."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cli.conftest import Runner
from contact_cases import slid
from refusals import subject_of

import asperity as asp
from asperity.io.results import document_in, load, open_tree, save
from asperity.run.build import build
from asperity.run.document import checked, dumps, load_document

pytestmark = pytest.mark.usefixtures("undrawn")
COATED = "E=300GPa,nu=0.2,H=20GPa,name=film:50nm/E=100GPa,nu=0.1,H=5GPa,name=base"


def saved(folder: Path, **stress: object) -> Path:
    """Result file with its document, as `contact --out` leaves it; ``stress`` is its table
    [stress]."""
    np.savetxt(folder / "rough.txt", np.random.default_rng(1).normal(size=(24, 32)))
    table = {
        "version": 1,
        "surface": {"kind": "file", "path": "rough.txt", "size": "8um x 6um", "height_unit": "nm"},
        "body": COATED,
        "control": {"mean_pressure": "1MPa"},
    }
    document = checked(table | ({"stress": stress} if stress else {}))
    case = build(document, folder)
    if stress.get("coupled"):
        contact = slid(case.problem, case.control, float(str(stress["friction"])))
    else:
        contact = asp.solve(case.problem, case.control)
    save(contact, folder / "result.nc", document=dumps(document))
    return folder / "result.nc"


@pytest.fixture(scope="module")
def plain(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return saved(tmp_path_factory.mktemp("plain"))


WANTED = ("--friction", 0.3, "--section", "y=max", "--profile", "x=max,y=max", "--depths", "0nm,50nm")


def test_stresses_are_those_of_a_run_that_asked_for_them(run: Runner, plain: Path, tmp_path: Path) -> None:
    later = run("stress", plain, *WANTED, "--out", tmp_path / "later")
    assert later.exit_code == 0, later.stderr
    document = tmp_path / "later" / "problem.toml"
    at_once = run("contact", "--from", document, "--out", tmp_path / "once")
    assert at_once.exit_code == 0, at_once.stderr
    names = {path.relative_to(tmp_path / "later") for path in (tmp_path / "later").rglob("*")}
    expected = {path.relative_to(tmp_path / "once") for path in (tmp_path / "once").rglob("*")}
    assert names == expected - {Path("scalars.csv")}
    assert (tmp_path / "later" / "stress.csv").read_text() == (tmp_path / "once" / "stress.csv").read_text()
    fields = [
        open_tree(tmp_path / folder / "result.nc")["stress/section_1"].to_dataset() for folder in ("later", "once")
    ]
    np.testing.assert_array_equal(fields[0]["xz"], fields[1]["xz"])
    assert "film" in later.stdout
    assert "(resolution)" in later.stdout
    assert load_document(document).friction.coefficient == 0.3


def test_the_document_in_the_result_says_what_options_do_not(run: Runner, plain: Path, tmp_path: Path) -> None:
    file, volume = saved(tmp_path, friction=0.3, depths=["10nm"]), tmp_path / "v.nc"
    changed = run("stress", file, "--friction", 0.5, "--stress-nc", volume, "--threads", 1)
    assert changed.exit_code == 0, changed.stderr
    found = open_tree(volume)["field"].to_dataset()
    assert found["depth"].values.tolist() == pytest.approx([10e-9])
    wanted = asp.stress(load(file), [10e-9], friction=0.5)
    np.testing.assert_allclose(found["xz"][0], wanted.shear_xz[0], atol=1e-6 * np.abs(wanted.shear_xz).max())
    assert run("stress", file, "--stress-nc", volume).exit_code == 2
    cited = run("cite", file).stdout
    assert "[Burmister1945]" in cited
    assert "[Eberly2014]" in cited
    assert "[Eberly2014]" not in run("cite", plain).stdout
    (tmp_path / "p.toml").write_text(document_in(file) or "", encoding="utf-8")
    assert run("cite", tmp_path / "p.toml").stdout.count("[Eberly2014]") == 1


def test_a_result_without_document(run: Runner, plain: Path, tmp_path: Path) -> None:
    save(load(plain), tmp_path / "bare.nc")
    result = run("stress", tmp_path / "bare.nc", "--stress-nc", tmp_path / "v.nc")
    assert result.exit_code == 0, result.stderr
    assert set(open_tree(tmp_path / "v.nc")["field"].to_dataset()["region"].values.tolist()) == {0, 1}


def test_a_coupled_pressure_belongs_to_its_friction(run: Runner, tmp_path: Path, plain: Path) -> None:
    file = saved(tmp_path, friction=0.5, coupled=True)
    assert run("stress", file, "--section", "x=max").exit_code == 0
    assert "[Dundurs1969]" in run("cite", file).stdout
    refused = run("stress", file, "--friction", 0.2)
    assert refused.exit_code == 2
    assert "0.5" in refused.stderr
    assert subject_of(run("stress", plain, "--coupled", "--friction", 0.2)) == "--coupled"


@pytest.mark.parametrize(
    ("options", "subject"),
    [
        (("--stress-in", "counter"), "body in which stresses are asked"),
        (("--depths", "1nm,5"), "part 2 of --depths"),
        (("--section", "z=1nm"), "part 1 of --section"),
    ],
)
def test_refusals(run: Runner, plain: Path, options: tuple[str, ...], subject: str) -> None:
    result = run("stress", plain, *options)
    assert subject_of(result) == subject
