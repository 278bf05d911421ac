"""Surfaces that asperity made itself are taken as they are: no plane is removed from a periodic
one."""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
from cli.conftest import Runner

import asperity as asp


def made(folder: Path) -> asp.Surface:
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(1e-9), hurst=0.8, rolloff_wavelength=6e-7, shortest_wavelength=8e-8
    )
    surface = asp.generate.gaussian(asp.Grid((32, 32), (20e-9, 20e-9)), spectrum, seed=1)
    asp.files.save_surface(surface, folder / "own.nc")
    return surface


def test_a_periodic_surface_keeps_its_plane_at_every_door(tmp_path: Path, run: Runner) -> None:
    surface = made(tmp_path)
    arguments = [
        "contact",
        str(tmp_path / "own.nc"),
        "--body",
        "DLC",
        "--pressure",
        "50MPa",
        "--out",
        str(tmp_path / "run"),
    ]
    printed = run(*arguments)
    assert printed.exit_code == 0, printed.output
    pressed = asp.load(tmp_path / "run" / "result.nc").problem.surface
    mean_removed = surface.heights - surface.heights.mean()
    np.testing.assert_allclose(pressed.heights, mean_removed, atol=1e-9 * np.abs(mean_removed).max())
    assert pressed.periodic
    document = tomllib.loads((tmp_path / "run" / "problem.toml").read_text(encoding="utf-8"))
    again = asp.run(document | {"surface": {**document["surface"], "path": str(tmp_path / "own.nc")}})
    assert again.result.area_fraction == asp.load(tmp_path / "run" / "result.nc").area_fraction
    np.testing.assert_array_equal(asp.levelled(surface).heights, pressed.heights)


def test_an_open_surface_loses_its_plane(tmp_path: Path) -> None:
    x = np.linspace(0.0, 1e-6, 16)[:, None] * np.ones(16)
    tilted = asp.Surface(0.1 * x + 1e-9 * np.sin(8e6 * x), 1e-6 / 15)
    assert np.ptp(asp.levelled(tilted).heights) < 0.1 * np.ptp(tilted.heights)
    assert np.ptp(asp.levelled(tilted, "mean").heights) > 0.9 * np.ptp(tilted.heights)
