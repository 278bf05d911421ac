"""What the application computes of many scans of one surface: the surface generated, their one
spectrum and its report."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("nicegui", reason="the extra web is not installed")

from asperity.core.grid import Grid
from asperity.files import save_surface
from asperity.generate import ExponentialAutocorrelation, gaussian
from asperity.io.schemas.surfaces import SPECTRUM_TABLES
from asperity.web import tasks
from asperity.web.beginning import scanned
from asperity.web.forms import asked_of


def table(folder: Path) -> dict[str, Any]:
    model = ExponentialAutocorrelation(1e-9, 2e-7)
    for seed, size in enumerate((8e-6, 2e-6)):
        save_surface(gaussian(Grid((64, 64), (size / 64, size / 64)), model, seed=seed), folder / f"{seed}.nc")
    return scanned([str(folder / f"{seed}.nc") for seed in range(2)]) | {"points": "64x64", "size": "3 um"}


def test_preview_of_a_surface_like_many_scans(tmp_path: Path) -> None:
    task = {"table": table(tmp_path), "steps": None, "folder": str(tmp_path), "out": str(tmp_path / "a.bin")}
    found = tasks.surface(task)
    assert found["full"] == [64, 64]
    assert "1.nc" in found["history"][0]


def test_roughness_of_many_scans(tmp_path: Path) -> None:
    found = tasks.roughness({"table": table(tmp_path), "folder": str(tmp_path), "out": str(tmp_path / "roughness")})
    assert "error" not in found
    assert [name for name, _ in found["reports"]] == ["one_surface.html", "roughness.html"]
    names = [f"{figure[0]}.png" for figure in found["figures"]] + [name for name, _ in found["reports"]]
    assert len(set(names)) == len(names)
    assert [name for name in names if not (tmp_path / "roughness" / name).exists()] == []


def test_the_form_lists_the_scans() -> None:
    entries = {item.name: item for item in asked_of(SPECTRUM_TABLES["scans"])}
    assert entries["scans"].shape == "list"
    assert entries["scans"].tables is not None
    inner = {item.name: item.shape for item in asked_of(entries["scans"].tables[""])}
    assert inner["path"] == "text"
    assert inner["tip_radius"] == "number"
    assert inner["prepare"] == "list"


def test_no_scan_is_a_sentence(tmp_path: Path) -> None:
    asked = scanned([])
    found = tasks.surface({"table": asked, "steps": None, "folder": str(tmp_path), "out": str(tmp_path / "a.bin")})
    assert found["kind"] == "InputError"
    assert np.array(sorted(found)).tolist() == ["error", "kind"]
