"""Stress fields in files hold the numbers of the field, whether written whole or plane by plane."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
from catalogue import oblong
from refusals import refused

import asperity as asp
from asperity.core.tensor import STRESSES

DISK = asp.Layered([asp.Layer(asp.Elastic(280e9, 0.25, name="DLC"), 50e-9)], asp.Elastic(70e9, 0.33, name="Al-Mg"))
DEPTHS = [0.0, 20e-9, 50e-9, 120e-9]
TYPES = {"Float64": "<f8", "Float32": "<f4", "UInt8": "u1"}


@pytest.fixture(scope="module")
def contact() -> asp.ContactResult:
    return asp.solve(asp.ContactProblem(oblong(), DISK), asp.MeanPressure(2e8))


def read_vtr(path: Path) -> tuple[dict[str, np.ndarray], tuple[int, ...]]:
    """Arrays by name from the definition of the format, and the number of points along x, y, z."""
    data = path.read_bytes()
    head, body = data.split(b'<AppendedData encoding="raw">\n_', 1)
    text = head.decode("ascii")
    assert 'byte_order="LittleEndian" header_type="UInt64"' in text
    (extent,) = re.findall(r'WholeExtent="([^"]+)"', text)
    assert f'<Piece Extent="{extent}">' in text
    sizes = tuple(int(last) + 1 for last in extent.split()[1::2])
    arrays = {}
    for kind, name, offset in re.findall(r'type="(\w+)" Name="(\w+)" format="appended" offset="(\d+)"', text):
        at = int(offset)
        length = int.from_bytes(body[at : at + 8], "little")
        arrays[name] = np.frombuffer(body[at + 8 : at + 8 + length], TYPES[kind])
    assert body.endswith(b"\n</AppendedData>\n</VTKFile>\n")
    return arrays, sizes


@pytest.mark.parametrize("streamed", [False, True])
def test_netcdf_holds_the_field(contact, tmp_path, streamed):
    field = asp.stress(contact, DEPTHS, friction=0.3, displacement=True)
    source = asp.stresses.stress_planes(contact, DEPTHS, friction=0.3, displacement=True) if streamed else field
    asp.files.save_stress(source, tmp_path / "s.nc")
    data = asp.files.open_tree(tmp_path / "s.nc")["field"].to_dataset()
    assert data.xx.dims == ("plane", "x", "y")
    for name in STRESSES:
        np.testing.assert_array_equal(data[name], getattr(field.tensor, name))
        assert data[name].attrs["units"] == "Pa"
    np.testing.assert_array_equal(data.displacement_z, field.displacement.z)
    assert data.displacement_z.attrs["units"] == "m"
    np.testing.assert_array_equal(data.depth, field.depth)
    np.testing.assert_array_equal(data.region, field.region)
    assert list(data.side.values) == [plane.side for plane in field.planes]
    np.testing.assert_array_equal(data.x, field.x)
    np.testing.assert_array_equal(data.y, field.y)
    names = [json.loads(text)["name"] for text in data.region_description.values]
    assert names == [plane.region.name for plane in field.planes]
    assert data.attrs["citation_keys"].split() == list(field.citation_keys)
    root = asp.files.open_tree(tmp_path / "s.nc")
    assert json.loads(root.attrs["provenance"])["software"]["asperity"] == asp.__version__
    again = asp.load(tmp_path / "s.nc")
    assert str(again.planes) == str(field.planes)  # nan is not nan
    assert (again.dims, again.spacing, again.citation_keys) == (field.dims, field.spacing, field.citation_keys)
    np.testing.assert_array_equal(again.von_mises, field.von_mises)
    np.testing.assert_array_equal(again.displacement.z, field.displacement.z)


@pytest.mark.parametrize("streamed", [False, True])
def test_the_largest_stresses_at_edges_come_back(contact, tmp_path, streamed):
    """Also those of a region and of a plane; not those of a sum with another field."""
    field = asp.stress(contact, DEPTHS, friction=0.3)
    assert field.surface_maxima is not None
    asp.files.save_stress(
        asp.stresses.stress_planes(contact, DEPTHS, friction=0.3) if streamed else field, tmp_path / "s.nc"
    )
    again = asp.load(tmp_path / "s.nc")
    assert repr(again.surface_maxima) == repr(field.surface_maxima)
    assert repr(again.largest_tension) == repr(field.largest_tension)
    assert repr(again.only(0).largest_tension) == repr(field.only(0).largest_tension)
    assert again.only(1).surface_maxima is None
    assert repr(asp.first_yield(again)) == repr(asp.first_yield(field))
    deeper = asp.stress(contact, DEPTHS[1:], friction=0.3)
    asp.files.save_stress(deeper, tmp_path / "deeper.nc")
    assert asp.load(tmp_path / "deeper.nc").surface_maxima is None


def test_netcdf_of_a_section_and_a_profile(contact, tmp_path):
    section = asp.stress(contact, DEPTHS, on=asp.stresses.Section(y="max"), dtype="float32")
    asp.files.save_stress(section, tmp_path / "section.nc")
    data = asp.files.open_tree(tmp_path / "section.nc")["field"].to_dataset()
    assert data.xz.dims == ("plane", "x")
    assert data.xz.dtype == np.float32
    assert data.attrs["at_y"] == section.y
    np.testing.assert_array_equal(data.xz, section.shear_xz)
    profile = asp.stress(contact, DEPTHS, on=asp.stresses.DepthProfile())
    asp.files.save_stress(profile, tmp_path / "profile.nc")
    data = asp.files.open_tree(tmp_path / "profile.nc")["field"].to_dataset()
    assert data.zz.dims == ("plane",)
    np.testing.assert_array_equal(data.zz, profile.normal_zz)


@pytest.mark.parametrize("streamed", [False, True])
@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_vtk_holds_the_field(contact, tmp_path, streamed, dtype):
    field = asp.stress(contact, DEPTHS, friction=0.3, dtype=dtype)
    source = asp.stresses.stress_planes(contact, DEPTHS, friction=0.3, dtype=dtype) if streamed else field
    asp.files.export_stress_vtk(source, tmp_path / "s.vtr")
    arrays, sizes = read_vtr(tmp_path / "s.vtr")
    assert sizes == (*contact.problem.grid.shape, len(field.planes))
    for axis, line in (("x", field.x), ("y", field.y), ("z", field.depth)):
        np.testing.assert_array_equal(arrays[axis], line)
    for name, values in (*((n, getattr(field.tensor, n)) for n in STRESSES), ("von_mises", field.von_mises)):
        assert arrays[name].dtype == np.dtype(dtype)
        np.testing.assert_array_equal(arrays[name].reshape(sizes[::-1]).transpose(0, 2, 1), values)
    regions = arrays["region"].reshape(sizes[2], -1)
    np.testing.assert_array_equal(regions, np.broadcast_to(field.region[:, None], regions.shape))
    assert [path.name for path in tmp_path.iterdir()] == ["s.vtr"]


def test_vtk_of_a_section(contact, tmp_path):
    field = asp.stress(contact, DEPTHS, on=asp.stresses.Section(x="max"))
    asp.files.export_stress_vtk(field, tmp_path / "s.vtr")
    arrays, sizes = read_vtr(tmp_path / "s.vtr")
    assert sizes == (1, contact.problem.grid.shape[1], len(field.planes))
    np.testing.assert_array_equal(arrays["yz"].reshape(sizes[2], sizes[1]), field.shear_yz)
    assert arrays["x"] == field.x


def test_refusals(contact, tmp_path):
    with refused(asp.InputError, "stress field to write"):
        asp.files.save_stress(iter(()), tmp_path / "s.nc")
    with refused(asp.InputError, "stress field for VTK"):
        asp.files.export_stress_vtk(asp.stress(contact, [0.0], on=asp.stresses.DepthProfile()), tmp_path / "s.vtr")
    field = asp.stress(contact, [0.0])
    asp.files.save_stress(field, tmp_path / "s.nc")
    with refused(asp.errors.OutputError, "output file"):
        asp.files.save_stress(field, tmp_path / "s.nc")
    asp.files.save_stress(field, tmp_path / "s.nc", overwrite=True)


def test_a_failing_stream_leaves_no_file(contact, tmp_path):
    def broken():
        yield asp.stress(contact, [0.0])
        raise RuntimeError("interrupted")

    for write, name in ((asp.files.save_stress, "s.nc"), (asp.files.export_stress_vtk, "s.vtr")):
        with pytest.raises(RuntimeError, match="interrupted"):
            write(broken(), tmp_path / name)
    assert list(tmp_path.iterdir()) == []
