"""Documents of prescribed tractions: positions, arrays, what is refused, and that every door gives
the same numbers."""

from __future__ import annotations

import json

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.cli.main import app

PATCH = {"kind": "patch", "x": ["0 um", "3.2 um"], "y": ["0 um", "3.2 um"], "pressure": "1 MPa"}


def document(*loads, body="steel", stress=None, **tractions):
    """Loads on 32 x 32 pixels of 0.1 µm."""
    made = {"size": "3.2 um", "points": [32, 32], "loads": list(loads), **tractions}
    return {"version": 2, "body": body, "tractions": made, "stress": {"depths": ["50 nm"], **(stress or {})}}


def test_a_patch_from_end_to_end_covers_the_periodic_grid():
    """Uniform pressure without lateral strain: σ_xx = -p ν/(1 - ν), so that the von Mises stress is
    p (1 - 2ν)/(1 - ν)."""
    found = asp.run(document(PATCH))
    nu = asp.material("steel").poisson_ratio
    assert found.result.tractions.pressure == pytest.approx(np.full((32, 32), 1e6), rel=1e-12)
    assert found.values["max_von_mises"] == pytest.approx(1e6 * (1.0 - 2.0 * nu) / (1.0 - nu), rel=1e-9)


def test_a_point_load_deep_below_is_that_of_boussinesq():
    point = {"kind": "point", "at": ["1.65 um", "1.65 um"], "normal": "1 uN"}
    made = document(point, boundary="free", body="E=1GPa,nu=0.5", stress={"depths": ["1 um"]})
    found = asp.run(made)
    on_axis = 3e-6 / (2.0 * np.pi * 1e-12)  # incompressible: the only stress below the point is σ_zz
    assert found.values["max_von_mises"] == pytest.approx(on_axis, rel=0.02)  # (pixel / depth)²
    assert found.found["stress"].detail.maxima[0].von_mises.x == pytest.approx(1.6e-6)


def test_arrays_from_files_add_to_the_loads(tmp_path):
    half = {**PATCH, "x": ["0.8 um", "1.6 um"], "shear": ["0.2 MPa", "-0.1 MPa"]}
    covered = np.zeros((32, 32))
    covered[8:16] = 1.0
    np.save(tmp_path / "p.npy", 1e6 * covered)
    np.save(tmp_path / "qx.npy", 2e5 * covered)
    np.savetxt(tmp_path / "qy.txt", -1e5 * covered)
    files = {"pressure_file": "p.npy", "shear_x_file": "qx.npy", "shear_y_file": "qy.txt"}
    made = document(body="DLC:50nm/steel", boundary="free", **files)
    del made["tractions"]["points"]
    expected = asp.run(document(half, body="DLC:50nm/steel", boundary="free")).values
    found = asp.run(made, tmp_path).values
    assert found == pytest.approx(expected, rel=1e-9, nan_ok=True)
    doubled = asp.run(document(half, body="DLC:50nm/steel", boundary="free", **files), tmp_path).values
    assert doubled["max_von_mises"] == pytest.approx(2.0 * found["max_von_mises"], rel=1e-9)
    assert doubled["yield_load_factor"] == pytest.approx(0.5 * found["yield_load_factor"], rel=1e-9)


def test_a_strip_on_one_row_is_in_plane_strain():
    strip = {"kind": "patch", "x": ["28 um", "36 um"], "y": ["0 m", "1 m"], "pressure": "1 MPa"}
    made = document(strip, body="E=1GPa,nu=0.5", stress={"depths": ["4 um"]})
    made["tractions"] |= {"points": [64, 1], "size": "64 um x 1 m", "boundary": "line"}
    largest = (
        2e6 / np.pi * np.sin(np.pi / 2.0) / 2.0
    )  # largest shear stress p sin(α)/π where the strip is seen under α = 90°
    assert asp.run(made).values["max_shear"] == pytest.approx(largest, rel=1e-3)


@pytest.mark.parametrize(
    ("change", "subject"),
    [
        ({"loads": []}, "problem document: tractions"),
        ({"points": None, "loads": [PATCH]}, "problem document: tractions.points"),
        ({"loads": [{**PATCH, "x": ["1 um", "9 um"]}], "boundary": "free"}, "range of a patch along x (m)"),
        ({"loads": [{"kind": "point", "at": ["1 um", "9 um"], "normal": "1 N"}], "boundary": "free"}, "y of a load"),
        ({"loads": [{**PATCH, "kind": "ball"}]}, "problem document: tractions.loads[1].kind"),
        ({"loads": [], "pressure_file": "none.npy"}, "array of tractions.pressure_file"),
        ({"loads": [], "pressure_file": "small.npy"}, "array of tractions.pressure_file"),
        ({"loads": [], "pressure_file": "flat.npy"}, "array of tractions.pressure_file"),
        ({"loads": [], "pressure_file": "text.npy"}, "array of tractions.pressure_file"),
    ],
)
def test_refusals(tmp_path, change, subject):
    np.save(tmp_path / "small.npy", np.ones((4, 4)))
    np.save(tmp_path / "flat.npy", np.ones(32))
    (tmp_path / "text.npy").write_text("no array")
    made = document(PATCH)
    made["tractions"] = {key: value for key, value in {**made["tractions"], **change}.items() if value is not None}
    with refused(asp.errors.AsperityError, subject):
        asp.run(made, tmp_path)


def test_contact_keys_are_refused_beside_tractions():
    with pytest.raises(asp.InputError):
        asp.run({**document(PATCH), "control": {"force": "1 N"}})
    with refused(asp.InputError, "problem document: body"):
        asp.run({**document(PATCH), "body": {"rigid": True}})
    with refused(asp.InputError, "problem document: stress.inside"):
        asp.run(document(PATCH, stress={"inside": "counter_body"}))


def test_the_command_gives_the_same_numbers_and_a_folder_that_runs_again(tmp_path):
    np.save(tmp_path / "p.npy", np.outer(np.hanning(32), np.hanning(32)) * 1e8)
    made = document(body="DLC:50nm/steel", pressure_file="p.npy", stress={"profiles": ["x=max,y=max"], "depths": []})
    (tmp_path / "loads.json").write_text(json.dumps(made))
    out = tmp_path / "out"
    with pytest.raises(SystemExit) as ended:
        app(["stress", str(tmp_path / "loads.json"), "--criterion", "tresca", "--out", str(out)])
    assert ended.value.code == 0
    assert {"report.html", "result.nc", "stress.csv", "problem.toml", "plots"} == {path.name for path in out.iterdir()}
    again, tree = asp.run(out / "problem.toml"), asp.files.open_tree(out / "result.nc")
    assert float(tree["stress/max_von_mises"]) == again.values["max_von_mises"]
    assert float(tree["yielding/yield_load_factor"]) == again.values["yield_load_factor"]
    np.testing.assert_array_equal(tree["tractions/pressure"].values, np.load(tmp_path / "p.npy"))
    page = (out / "report.html").read_text(encoding="utf-8")
    assert page.count("<img") == len(list((out / "plots").iterdir())) > 0
    with refused(asp.errors.FileFormatError, "result file"):
        asp.load(out / "result.nc")


def test_the_command_refuses_what_is_no_document_of_tractions(tmp_path):
    path = tmp_path / "contact.toml"
    path.write_text("version = 2\n")
    for arguments in ([str(path)], [str(path), "--friction", "0.3"]):
        with pytest.raises(SystemExit) as ended:
            app(["stress", *arguments])
        assert ended.value.code == 2
