"""What the application computes of a line scan: its channel, its curve, its parameters and
figures."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("nicegui", reason="the extra web is not installed")

from asperity.web import maps, tasks


def table(folder: Path) -> dict[str, Any]:
    x = 0.5 * np.arange(1200)
    np.savetxt(folder / "trace.txt", np.c_[x, 20.0 * np.sin(2.0 * np.pi * x / 20.0)])
    return {"kind": "file", "path": "trace.txt", "lateral_unit": "um", "height_unit": "nm"}


def test_channels_and_preview_of_a_line_scan(tmp_path: Path) -> None:
    asked = table(tmp_path)
    held = tasks.inspect({"path": str(tmp_path / "trace.txt")})
    assert held["channels"][0]["text"] == "heights: 1200 points"
    found = tasks.surface({"table": asked, "steps": None, "folder": str(tmp_path), "out": str(tmp_path / "a.bin")})
    assert found["full"] == [1200, 1]
    values = np.frombuffer((tmp_path / "a.bin").read_bytes(), "<f4").reshape(1, found["shape"][0])
    figure = maps.height_line(values, tuple(found["spacing"]), "scan")
    assert figure["data"][0]["mode"] == "lines"


def test_roughness_of_a_line_scan(tmp_path: Path) -> None:
    found = tasks.roughness({"table": table(tmp_path), "folder": str(tmp_path), "out": str(tmp_path / "roughness")})
    assert "error" not in found
    assert len(found["headline"]) == 8
    assert (tmp_path / "roughness" / "roughness.html").exists()
    assert (tmp_path / "roughness" / "trace.png").exists()
