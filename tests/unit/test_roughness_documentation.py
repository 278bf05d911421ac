"""The guide to roughness runs, and the reference lists every quantity as the library has it."""

from __future__ import annotations

import inspect
import re
from pathlib import Path

import numpy as np
import pytest

import asperity as asp
from asperity.surfaces.characterise.quantities import GROUPS, QUANTITIES

pytestmark = pytest.mark.usefixtures("unrendered")

ROOT = Path(__file__).parents[2]
REFERENCE = ROOT / "docs" / "reference" / "roughness.md"


def blocks(path: Path, language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", path.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


@pytest.fixture
def scan() -> asp.Surface:
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsHeight(5e-9), hurst=0.8, rolloff_wavelength=4e-7, shortest_wavelength=0.0
    )
    surface = asp.generate.gaussian(asp.Grid((128, 96), (2e-8, 2e-8)), spectrum, seed=1)
    return asp.Surface(surface.heights, 2e-8)


def test_the_guide_runs(scan, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    code = blocks(ROOT / "docs" / "how-to" / "roughness.md", "python")
    assert len(code) >= 5
    assert 'asp.read("scan.di")' in code[0]
    names["scan_of_the_reader"] = scan
    for number, block in enumerate(code):
        text = block.replace('asp.read("scan.di")', "scan_of_the_reader")
        exec(compile(text, f"block {number}", "exec"), names)  # noqa: S102 - running the page is the test
    assert (tmp_path / "roughness.html").exists()
    assert len(list((tmp_path / "pictures").glob("*.png"))) == len(asp.plots.SURFACE_PLOTS)
    assert "heights.Sq" in capsys.readouterr().out
    more = names["more"]
    assert isinstance(more, asp.Surface)
    assert np.isfinite(more.heights).all()


def test_the_options_of_the_guide_exist():
    from asperity.cli.info import info

    (console,) = blocks(ROOT / "docs" / "how-to" / "roughness.md", "console")
    known = {name.replace("_", "-") for name in inspect.signature(info).parameters} | {"json"}
    known |= {option.name[2:] for option in info.offered()}
    assert set(re.findall(r"--([a-z-]+)", console)) <= known


def rows() -> list[list[str]]:
    lines = REFERENCE.read_text(encoding="utf-8").splitlines()
    cells = [re.split(r"(?<!\\)\|", line)[1:-1] for line in lines if line.startswith("| `")]
    return [[cell.strip().replace("\\|", "|") for cell in row] for row in cells]


def test_the_reference_lists_every_quantity():
    listed = rows()
    assert [row[0].strip("`") for row in listed] == [quantity.name for quantity in QUANTITIES]
    for row, quantity in zip(listed, QUANTITIES, strict=True):
        assert row[1:] == [
            quantity.symbol,
            quantity.label,
            quantity.unit,
            quantity.description.strip(),
            quantity.source,
        ]


def test_the_reference_has_every_group():
    text = REFERENCE.read_text(encoding="utf-8")
    for heading in GROUPS.values():
        assert f"## {heading}\n" in text
