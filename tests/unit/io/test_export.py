"""Exports are read back with plain parsers and hold the numbers of the result."""

from __future__ import annotations

import base64
import csv
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import asperity as asp
from asperity.contact.result import SCALARS
from asperity.core.errors import OutputError
from asperity.io.export import export_csv, export_vtk
from asperity.io.words import CERTIFICATE

TYPES = {"Float64": "<f8", "Float32": "<f4", "UInt8": "u1"}


def read_vti(path: Path) -> tuple[ElementTree.Element, dict[str, np.ndarray]]:
    """Image element and its point arrays, [x, y], from the VTK file format's definition."""
    root = ElementTree.parse(path).getroot()
    assert root.attrib["byte_order"] == "LittleEndian"
    assert root.attrib["header_type"] == "UInt64"
    image = root[0]
    extent = [int(word) for word in image.attrib["WholeExtent"].split()]
    nx, ny = extent[1] + 1, extent[3] + 1
    arrays = {}
    for item in image.iter("DataArray"):
        raw = base64.b64decode((item.text or "").strip(), validate=True)
        assert int.from_bytes(raw[:8], "little") == len(raw) - 8
        flat = np.frombuffer(raw[8:], TYPES[item.attrib["type"]])
        arrays[item.attrib["Name"]] = flat.reshape(ny, nx).T  # x runs fastest
    return image, arrays


def test_vtk_holds_the_fields(result: asp.ContactResult, tmp_path: Path) -> None:
    export_vtk(result, tmp_path / "r.vti")
    image, arrays = read_vti(tmp_path / "r.vti")
    spacing = [float(word) for word in image.attrib["Spacing"].split()]
    assert tuple(spacing[:2]) == result.problem.grid.spacing
    assert spacing[2] > 0.0
    assert image[0].attrib["Extent"] == image.attrib["WholeExtent"]
    np.testing.assert_array_equal(arrays["heights"], result.problem.surface.heights)
    assert arrays["heights"].dtype == result.problem.surface.heights.dtype
    for name in ("pressure", "gap", "displacement", "permanent_indentation"):
        np.testing.assert_array_equal(arrays[name], getattr(result, name))
    np.testing.assert_array_equal(arrays["contact"] > 0, result.contact)
    np.testing.assert_array_equal(arrays["contact"] == 2, result.plastic)


def test_plastic_points_are_marked(plastic: asp.ContactResult, tmp_path: Path) -> None:
    export_vtk(plastic, tmp_path / "r.vti")
    assert set(np.unique(read_vti(tmp_path / "r.vti")[1]["contact"])) == {0, 1, 2}


def test_csv_holds_every_scalar_exactly(result: asp.ContactResult, tmp_path: Path) -> None:
    export_csv(result, tmp_path / "r.csv")
    with (tmp_path / "r.csv").open(newline="", encoding="utf-8") as file:
        rows = {row["name"]: row for row in csv.DictReader(file)}
    for quantity in SCALARS:
        row = rows[quantity.name]
        np.testing.assert_equal(float(row["value"]), float(getattr(result, quantity.name)))
        assert (row["unit"], row["label"]) == (quantity.unit, quantity.label)
    assert float(rows["certificate.duality_gap"]["value"]) == result.certificate.duality_gap
    assert rows["certificate.wall_time"]["unit"] == "s"
    assert rows["certificate.solver"]["value"] == result.certificate.solver
    assert rows["status.outcome"]["value"] == str(result.status.outcome)
    assert len(rows) == len(SCALARS) + len(CERTIFICATE) + 1


@pytest.mark.parametrize("export", [export_csv, export_vtk])
def test_existing_file_is_kept_unless_overwritten(elastic: asp.ContactResult, tmp_path: Path, export) -> None:  # type: ignore[no-untyped-def]
    path = tmp_path / "r"
    path.write_text("mine")
    with pytest.raises(OutputError):
        export(elastic, path)
    assert path.read_text() == "mine"
    export(elastic, path, overwrite=True)
    assert path.stat().st_size > 500
    assert [entry.name for entry in tmp_path.iterdir()] == ["r"]
