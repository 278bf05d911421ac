"""Every measured topography goes through the program from end to end."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from cli.conftest import Runner

from asperity.io.results import load

FILES = {
    "afm_granular_film_10um_512.di": (14.32e-9, 512 * 512),
    "afm_nodular_film_300nm_512.di": (10.96e-9, 512 * 512),
    "afm_grainy_film_1um_256.007": (2.42e-9, 256 * 256),
    "afm_storage_medium_10um_128.nid": (27.10e-9, 128 * 128),
    "wli_126um_640x480.opd": (6.71e-9, 640 * 480),
    "focusvar_88um_200x296.al3d": (289.8e-9, 200 * 296),
}
"""Rms height after plane levelling (m) and number of points, computed from the files by other
means."""


def test_no_file_is_left_out(shared_data: Path) -> None:
    assert {path.name for path in shared_data.iterdir()} - {"README.md"} == set(FILES)


@pytest.mark.parametrize("name", FILES)
def test_info(run: Runner, shared_data: Path, name: str) -> None:
    result = run("info", shared_data / name, "--json")
    assert result.exit_code == 0, result.stderr
    found, (rms_height, points) = json.loads(result.stdout), FILES[name]
    assert found["Sq"] == pytest.approx(rms_height, rel=2.5e-3)
    assert found["shape"][0] * found["shape"][1] == points


@pytest.mark.parametrize("name", FILES)
def test_contact(run: Runner, shared_data: Path, tmp_path: Path, name: str) -> None:
    out = tmp_path / "run"
    options = ("--body", "DLC", "--hardness", "body", "--pressure", "5MPa", "--periodise", "--resample", "96x80")
    result = run("contact", shared_data / name, *options, "--out", out)
    assert result.exit_code == 0, result.output
    solved = load(out / "result.nc")
    assert solved.problem.surface.shape == (96, 80)
    assert solved.mean_pressure == pytest.approx(5e6, rel=1e-6)
    assert solved.max_pressure <= 15e9
