"""Bad input: exit code 2, one clear sentence on stderr, no traceback."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cli.conftest import BODY, LOAD, SCALE, Runner
from refusals import subject_of

from asperity.core.errors import AsperityError
from asperity.core.units import prefixed


def refused(run: Runner, *arguments: object) -> str:
    result = run(*arguments)
    assert result.exit_code == 2, result.output
    assert result.stderr.startswith("asperity: ")
    assert "Traceback" not in result.output
    return result.stderr


def test_all_problems_at_once(run: Runner, matrix: Path) -> None:
    text = refused(run, "contact", matrix, *SCALE, "--body", "E=-1GPa,nu=0.7", "--pressure", "5", "--boundary", "open")
    found = {AsperityError(line.strip()).subject for line in text.splitlines()[1:]}
    assert found == {"E of --body", "nu of --body", "--pressure", "--boundary"}


def test_document_problems_at_once(run: Runner, tmp_path: Path) -> None:
    path = tmp_path / "p.toml"
    path.write_text(
        'version = 1\n[surface]\nkind = "cube"\n[body]\nmaterial = "DLC"\n[control]\nforce = "1 nm"\n[extra]\n'
    )
    text = refused(run, "contact", "--from", path)
    assert [line.split()[0] for line in text.splitlines()[1:]] == ["surface.kind", "control.force", "extra"]


def test_truncated_instrument_file(run: Runner, shared_data: Path, tmp_path: Path) -> None:
    whole = (shared_data / "afm_grainy_film_1um_256.007").read_bytes()
    (tmp_path / "cut.007").write_bytes(whole[: len(whole) // 3])
    assert "cut.007" in refused(run, "info", tmp_path / "cut.007")


def test_grids_that_do_not_match(run: Runner, matrix: Path, tmp_path: Path) -> None:
    np.savetxt(tmp_path / "other.txt", np.eye(5))
    other = ("--counter-surface", tmp_path / "other.txt")
    assert subject_of(run("contact", matrix, *SCALE, *BODY, *LOAD, *other)) == "the two surfaces of a pair"


def test_neither_file_nor_document(run: Runner) -> None:
    assert subject_of(run("contact", *BODY, *LOAD)) == "FILE with the rough surface"


@pytest.mark.parametrize("arguments", [("--nonsense",), ("nonsense",), ("info",), ("contact", "--nonsense")])
def test_usage_errors_are_exit_2(run: Runner, arguments: tuple[str, ...]) -> None:
    result = run(*arguments)
    assert result.exit_code == 2
    assert "--help" in result.stderr


def test_picture_must_be_a_png(run: Runner, matrix: Path, tmp_path: Path) -> None:
    assert subject_of(run("info", matrix, *SCALE, "--plot", tmp_path / "map.jpg")) == "--plot"
    assert not (tmp_path / "map.jpg").exists()


def test_two_outputs_of_one_name(run: Runner, matrix: Path, tmp_path: Path) -> None:
    both = tmp_path / "both.out"
    assert subject_of(run("contact", matrix, *SCALE, *BODY, *LOAD, "--csv", both, "--vtk", both)) == "output files"
    assert not both.exists()


def test_result_that_is_a_folder(run: Runner, tmp_path: Path) -> None:
    assert str(tmp_path) in refused(run, "cite", tmp_path).replace("\n", "")


def test_messages_name_what_to_do(run: Runner, matrix: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A surface is no result; memory is compared before it is taken; long numbers have prefixes."""
    assert "asperity info" in refused(run, "plot", matrix)
    monkeypatch.setattr("asperity.core.status.free_memory", lambda: 2.0**30)
    text = refused(run, "contact", matrix, *SCALE, *BODY, *LOAD, "--resample", "100000")
    assert [value for value in ("1e+10", "931 GiB", "1 GiB") if value not in text] == []
    text = refused(run, "contact", matrix, *SCALE, *BODY, "--pressure", "15GPa", "--hardness", "body")
    assert [value for value in ("5 GPa", "15 GPa") if value not in text] == []


def test_prefixes_in_messages() -> None:
    assert prefixed("is 1.5e+10 Pa, 8e-06 m, 0 m, 5 m and 20000 N") == "is 15 GPa, 8 µm, 0 m, 5 m and 20 kN"
    kept = "'1e-9 m' or 1e-12 m^4, 3e+4 Pa/m"
    assert prefixed(kept) == kept


def test_an_output_never_replaces_the_input(run: Runner, matrix: Path, tmp_path: Path) -> None:
    done = run("contact", matrix, *SCALE, *BODY, *LOAD, "--out", tmp_path / "run")
    assert done.exit_code == 0, done.stderr
    result = tmp_path / "run" / "result.nc"
    for command, file, option in (
        (("export", result), result, "--csv"),
        (("report", result), result, "--out"),
        (("contact", matrix, *SCALE, *BODY, *LOAD), matrix, "--csv"),
    ):
        before = file.read_bytes()
        assert subject_of(run(*command, option, file, "--force")) == "output file"
        assert file.read_bytes() == before


def test_odd_digits_and_long_names(run: Runner, matrix: Path) -> None:
    for arguments in (
        ("contact", matrix, "--channel", "²"),
        ("contact", matrix, "--channel", "9" * 5000),
        ("contact", matrix, "--level", "²"),
        ("contact", "x" * 300),
        ("contact", matrix, "--csv", "x" * 300),
        ("info", "x" * 300),
        ("status", "x" * 300),
        ("plot", "x" * 300),
    ):
        more = (*SCALE, *BODY, *LOAD) if arguments[0] == "contact" else ()
        assert run(*arguments, *more).exit_code == 2, arguments
