"""Bad input: exit code 2, one clear sentence on stderr, no traceback."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cli.conftest import BODY, LOAD, SCALE, Runner


def refused(run: Runner, *arguments: object) -> str:
    result = run(*arguments)
    assert result.exit_code == 2, result.output
    assert result.stderr.startswith("asperity: ")
    assert "Traceback" not in result.output
    return result.stderr


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ((*BODY, "--pressure", "50"), "--pressure must have a unit, such as \"50 kPa\", but is '50' without one."),
        ((*BODY, "--pressure", "50 nm"), "--pressure must be a pressure (unit such as Pa), but its unit is 'nm'."),
        ((*BODY, "--pressure", "50 kPq"), "--pressure has the unknown unit 'kPq'"),
        ((*BODY, "--pressure", "0 kPa"), "--pressure must be greater than zero, but is '0 kPa'."),
        (
            (
                *BODY,
                "--load=-1mN",
            ),
            "--load must be greater than zero, but is '-1mN'.",
        ),
        ((*BODY, "--approach", "-3nm"), "--approach must be greater than zero"),
        ((*BODY, "--mean-gap", "1 Pa"), "--mean-gap must be a length"),
        (
            BODY,
            "load must be given by exactly one of --pressure, --load, --approach, --mean-gap, --path, but is given by none.",
        ),
        ((*BODY, *LOAD, "--load", "1mN"), "but is given by --pressure and --load."),
        ((*BODY, "--path", "0,0"), "--path must be pressures, forces or lengths with units, separated by commas"),
        ((*BODY, "--path", "1MPa,2"), "turning point 2 of --path must have a unit"),
        ((*BODY, "--path", "1MPa,2nm"), "turning point 2 of --path must be a pressure"),
        ((*BODY, "--path", "1MPa,1MPa"), "neighbouring turning points of a load path must differ"),
        ((*BODY, "--path", "1MPa", "--path-steps", "0"), "--path-steps must be a whole number of at least 1"),
        ((*BODY, *LOAD, "--path-steps", "3"), "--path-steps must be given together with a load path"),
        ((*BODY, "--path", "1MPa", "--friction", "0.1", "--coupled"), "--coupled) must be left out with a load path"),
        (("--body", "E=1GPa,nu=0.3", *LOAD, "--hardness", "effective"), "hardness must be known for at least one body"),
        ((*BODY, *LOAD, "--plastic-load"), "must limit the pressure, but is hard wall. Use Hardness(H) (--hardness)."),
        ((*BODY, *LOAD, "--tolerance", "2"), "--tolerance must be greater than zero and less than 1, but is 2.0."),
        ((*BODY, *LOAD, "--load", "1mN"), "exactly one of"),
        ((*BODY, "--pressure", "6GPa", "--hardness", "body"), "at most the mean hardness 5e+09 Pa"),
        ((*BODY, "--load", "1N", "--hardness", "5GPa"), "hardness times nominal area"),
        (LOAD, "--body must be given"),
        (("--body", "E=-1GPa,nu=0.3", *LOAD), "E of --body must be greater than zero, but is '-1GPa'."),
        (("--body", "E=1GPa,nu=0.6", *LOAD), "nu of --body must be greater than -1 and at most 0.5, but is 0.6."),
        (("--body", "E=1GPa,nu=-1", *LOAD), "nu of --body must be greater than -1 and at most 0.5"),
        (("--body", "E=1GPa,nu=soft", *LOAD), "nu of --body must be a number"),
        (("--body", "E=1GPa", *LOAD), "--body must give youngs_modulus and poisson_ratio together"),
        (("--body", "E=1GPa,nu=0.3,Q=2", *LOAD), "but holds 'Q=2'"),
        (("--body", "unobtainium", *LOAD), "material must be a name in the material library, but is 'unobtainium'"),
        (("--body", "rigid", *LOAD), "must not both be rigid"),
        ((*BODY, *LOAD, "--hardness", "5"), "--hardness must have a unit"),
        (("--body", "E=1GPa,nu=0.3", *LOAD, "--hardness", "body"), "hardness must be known for at least one body"),
        ((*BODY, *LOAD, "--boundary", "open"), "--boundary must be 'periodic', 'free' or 'line', but is 'open'."),
        ((*BODY, *LOAD, "--boundary", "line"), "grid of a line contact must have one point along y"),
        (("--body", "DLC:5/steel", *LOAD), 'thickness of layer 1 of --body must have a unit, such as "5 nm"'),
        (("--body", "DLC:5nm/CrX/steel", *LOAD), "--body must give the thickness of every layer, such as CrX:5nm"),
        (("--body", "DLC:5nm/steel/Cr:2nm", *LOAD), "--body must have the base as its last part, but 'steel'"),
        (("--body", "DLC:5nm", *LOAD), "--body must end in the base, without thickness"),
        (("--body", "DLC:5kg/steel", *LOAD), "thickness of layer 1 of --body must be a length"),
        (("--body", "DLC:5nm/stel", *LOAD), "but is 'stel'; did you mean steel"),
        ((*BODY, "--counter", "DLC:-5nm/steel", *LOAD), "thickness of layer 1 of --counter must be at least zero"),
        ((*BODY, "--counter-body", "DLC/steel", *LOAD), "--counter must give the thickness of every layer"),
        (("--body", "E=1GPa,nu=0.7:1nm/rigid", *LOAD), "nu of layer 1 of --body must be greater than -1"),
        (("--body", "DLC:5nm/E=1GPa", *LOAD), "the base of --body must give youngs_modulus and poisson_ratio together"),
        (("--body", "PDMS:1um/steel", *LOAD, "--hardness", "body"), "of a coated body the top layer counts"),
        ((*BODY, *LOAD, "--precision", "half"), "--precision must be 'mixed', 'double' or 'single', but is 'half'"),
        ((*BODY, *LOAD, "--solver", "magic"), "--solver must be one of active_set, conjugate_gradient"),
        ((*BODY, *LOAD, "--tolerance", "0"), "--tolerance must be greater than zero"),
        ((*BODY, *LOAD, "--threads", "0"), "--threads must be a whole number of at least 1"),
        ((*BODY, *LOAD, "--level", "cubic"), "--level must be one of mean, plane, quadratic, none"),
        ((*BODY, *LOAD, "--fill", "magic"), "--fill must be one of harmonic, nearest, mean, none"),
        ((*BODY, *LOAD, "--crop", "1um"), "--crop must be two ranges of lengths"),
        ((*BODY, *LOAD, "--crop", "2um:1um,"), "x of --crop must end after its start"),
        ((*BODY, *LOAD, "--crop", "0:1,"), "x of --crop must have a unit"),
        ((*BODY, *LOAD, "--crop", "0um:99um,"), "crop along x must lie within"),
        ((*BODY, *LOAD, "--resample", "many"), "--resample must be one or two numbers of points"),
        ((*BODY, *LOAD, "--taper", "0.9"), "--taper must be greater than zero and at most 0.5, but is 0.9."),
        ((*BODY, *LOAD, "--mirror", "x"), "--mirror must be given together with --counter-surface"),
        ((*BODY, *LOAD, "--materials-file", "none.toml", "--body", "DLC"), "material file must exist"),
    ],
)
def test_options(run: Runner, matrix: Path, options: tuple[str, ...], expected: str) -> None:
    text = refused(run, "contact", matrix, *SCALE, *options)
    assert expected in text
    assert len(text.splitlines()) == 1


def test_all_problems_at_once(run: Runner, matrix: Path) -> None:
    text = refused(run, "contact", matrix, *SCALE, "--body", "E=-1GPa,nu=0.7", "--pressure", "5", "--boundary", "open")
    assert text.splitlines()[0] == "asperity: command line has 4 problems:"
    for name in ("E of --body", "nu of --body", "--pressure", "--boundary"):
        assert f"\n  {name} must" in text


def test_document_problems_at_once(run: Runner, tmp_path: Path) -> None:
    path = tmp_path / "p.toml"
    path.write_text(
        'version = 1\n[surface]\nkind = "cube"\n[body]\nmaterial = "DLC"\n[control]\nforce = "1 nm"\n[extra]\n'
    )
    text = refused(run, "contact", "--from", path)
    assert "has 3 problems:" in text
    assert [line.split()[0] for line in text.splitlines()[1:]] == ["surface.kind", "control.force", "extra"]


@pytest.mark.parametrize("command", ["info", "contact"])
@pytest.mark.parametrize(
    ("name", "content", "expected"),
    [
        ("none.txt", None, "does not exist"),
        ("empty.txt", b"", "is empty"),
        ("noise.di", b"\x00\x01\x02 not a topography \xff" * 40, "cannot be read"),
        ("noise.xyzzy", b"certainly not a topography" * 8, "cannot be read"),
        ("ragged.txt", b"1 2 3\n4 5\n", "cannot be read"),
        ("infinite.txt", b"1 2 3\n4 inf 6\n7 8 9\n", "infinities"),
        ("all_nan.txt", b"nan nan\nnan nan\n", "every point is missing"),
        ("one.txt", b"5\n", "at least 2 x 2 points"),
        ("noise_twice_a_square.di", bytes(range(256)) * 8, "no reader recognises its content"),
        ("one.npy", b"\x93NUMPY\x01\x00 truncated", "cannot be read"),
    ],
)
def test_files(run: Runner, tmp_path: Path, command: str, name: str, content: bytes | None, expected: str) -> None:
    path = tmp_path / name
    if content is not None:
        path.write_bytes(content)
    scale = () if name.startswith("noise") else SCALE
    rest = (*BODY, *LOAD) if command == "contact" else ()
    text = refused(run, command, path, *scale, *rest)
    assert expected in text
    assert len(text.splitlines()) == 1


def test_truncated_instrument_file(run: Runner, shared_data: Path, tmp_path: Path) -> None:
    whole = (shared_data / "afm_grainy_film_1um_256.007").read_bytes()
    (tmp_path / "cut.007").write_bytes(whole[: len(whole) // 3])
    assert "cut.007" in refused(run, "info", tmp_path / "cut.007")


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ((), "does not state its size"),
        (("--size", "8um"), "does not state the unit of its heights"),
        (("--size", "8"), "--size must have a unit"),
        (("--size", "8um", "--height-unit", "kg"), "height_unit must be a length"),
        (("--size", "8um", "--height-unit", "nm", "--channel", "Phase"), "channel of file"),
        (("--size", "8um", "--height-unit", "nm", "--z-scale", "5nm"), "leave out z_scale"),
    ],
)
def test_units_and_sizes_are_asked_for(run: Runner, matrix: Path, options: tuple[str, ...], expected: str) -> None:
    assert expected in refused(run, "info", matrix, *options)


def test_grids_that_do_not_match(run: Runner, matrix: Path, tmp_path: Path) -> None:
    np.savetxt(tmp_path / "other.txt", np.eye(5))
    text = refused(run, "contact", matrix, *SCALE, *BODY, *LOAD, "--counter-surface", tmp_path / "other.txt")
    assert "equal numbers of points" in text


def test_neither_file_nor_document(run: Runner) -> None:
    assert "FILE with the rough surface must be given" in refused(run, "contact", *BODY, *LOAD)


@pytest.mark.parametrize("arguments", [("--nonsense",), ("nonsense",), ("info",), ("contact", "--threads", "two")])
def test_usage_errors_are_exit_2(run: Runner, arguments: tuple[str, ...]) -> None:
    result = run(*arguments)
    assert result.exit_code == 2
    assert "--help" in result.stderr


def test_picture_must_be_a_png(run: Runner, matrix: Path, tmp_path: Path) -> None:
    text = refused(run, "info", matrix, *SCALE, "--plot", tmp_path / "map.jpg")
    assert "--plot must be the name of a PNG file" in text
    assert not (tmp_path / "map.jpg").exists()


def test_two_outputs_of_one_name(run: Runner, matrix: Path, tmp_path: Path) -> None:
    both = tmp_path / "both.out"
    text = refused(run, "contact", matrix, *SCALE, *BODY, *LOAD, "--csv", both, "--vtk", both)
    assert "output files must differ" in text
    assert not both.exists()


def test_result_that_is_a_folder(run: Runner, tmp_path: Path) -> None:
    assert "is a folder or device; give the .nc file in it" in refused(run, "cite", tmp_path)
