"""Line scans written and read back."""

from __future__ import annotations

import math
import warnings
import zipfile
from pathlib import Path

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.surfaces import Instrument
from asperity.surfaces.surface import Origin


def scan(dtype: type = np.float64, missing: bool = True, periodic: bool = False, **more: float) -> asp.Profile:
    heights = np.random.default_rng(1).standard_normal(40).astype(dtype) * dtype(1e-8)
    if missing:
        heights[7] = np.nan
    return asp.Profile(
        heights,
        0.3e-6,
        periodic=periodic,
        instrument=Instrument("stylus", tip_radius=2e-6, noise=1e-9),
        origin=Origin("a µ b", "height", {"tip": "10 nm"}, ("levelled: line", "filled ∇²h = 0"), ("Jacobs2017",)),
        **more,
    )


def same(after: asp.Profile, before: asp.Profile) -> None:
    np.testing.assert_array_equal(after.heights, before.heights)
    np.testing.assert_array_equal(after.mask, before.mask)
    assert after.heights.dtype == before.heights.dtype
    for name in ("spacing", "periodic", "short_cutoff", "origin"):
        assert getattr(after, name) == getattr(before, name)
    for left, right in ((after, before), (after.instrument, before.instrument)):
        for name in ("lay_angle", "kind", "tip_radius", "resolution", "noise"):
            a, b = getattr(left, name, None), getattr(right, name, None)
            assert a == b or (math.isnan(a) and math.isnan(b))


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("missing", [True, False])
@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("more", [{}, {"lay_angle": 0.2, "short_cutoff": 2.5e-6}])
def test_netcdf_comes_back_equal(
    tmp_path: Path, dtype: type, missing: bool, periodic: bool, more: dict[str, float]
) -> None:
    before = scan(dtype, missing, periodic, **more)
    asp.save(before, tmp_path / "a.nc")
    same(asp.load(tmp_path / "a.nc"), before)
    same(asp.read(tmp_path / "a.nc"), before)
    (channel,) = asp.surfaces.channels(tmp_path / "a.nc")
    assert (channel.shape, channel.size, channel.unit) == ((40,), (before.length,), "m")


def test_an_archive_keeps_what_is_known_of_a_line_scan(tmp_path: Path) -> None:
    before = scan(lay_angle=0.2, short_cutoff=2.5e-6)
    asp.save(before, tmp_path / "a.nc")
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        archive.write(tmp_path / "a.nc", "a.nc")
    after = asp.read(tmp_path / "a.zip")
    np.testing.assert_array_equal(after.heights, before.heights)
    for name in ("spacing", "periodic", "short_cutoff", "lay_angle", "instrument"):
        assert repr(getattr(after, name)) == repr(getattr(before, name))


def test_a_map_is_saved_and_loaded_too(tmp_path: Path) -> None:
    before = asp.Surface(np.random.default_rng(2).standard_normal((5, 4)), 1e-8, 2e-8, periodic=True)
    asp.save(before, tmp_path / "a.nc")
    after = asp.load(tmp_path / "a.nc")
    np.testing.assert_array_equal(after.heights, before.heights)
    assert (after.size, after.periodic) == (before.size, True)


def test_netcdf_is_that_of_the_reader_library(tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the library warns where MPI is missing
        from SurfaceTopography import read_topography

        before = scan(periodic=True)
        asp.save(before, tmp_path / "a.nc")
        theirs = read_topography(str(tmp_path / "a.nc"))
    assert (theirs.dim, theirs.unit, theirs.is_periodic) == (1, "m", True)
    assert theirs.physical_sizes == pytest.approx((before.length,), rel=1e-15)
    np.testing.assert_array_equal(np.ma.filled(theirs.heights(), np.nan), before.heights)


@pytest.mark.parametrize("ending", [".txt", ".asc", ".xyz"])
def test_columns_come_back_without_a_word(tmp_path: Path, ending: str) -> None:
    before = scan()
    asp.files.save_surface(before, tmp_path / f"a{ending}")
    after = asp.read(tmp_path / f"a{ending}")
    assert isinstance(after, asp.Profile)
    np.testing.assert_array_equal(after.mask, before.mask)
    np.testing.assert_allclose(after.heights, before.heights, rtol=1e-9)  # ten digits are written
    assert after.spacing == pytest.approx(before.spacing, rel=1e-9)


def test_the_array_is_bare(tmp_path: Path) -> None:
    before = scan()
    asp.files.save_surface(before, tmp_path / "a.npy")
    np.testing.assert_array_equal(asp.Profile(np.load(tmp_path / "a.npy"), before.spacing).heights, before.heights)


def test_refusals(tmp_path: Path) -> None:
    before = scan()
    for ending in (".gsf", ".x3p"):
        with refused(asp.errors.OutputError, "file of a line scan"):
            asp.files.save_surface(before, tmp_path / f"a{ending}")
    with refused(asp.errors.OutputError, "file of a surface"):
        asp.save(before, tmp_path / "a.txt")
    with refused(asp.InputError, "document and start"):
        asp.save(before, tmp_path / "a.nc", document="")
    assert list(tmp_path.iterdir()) == []
    asp.save(before, tmp_path / "a.nc")
    with refused(asp.errors.OutputError, "output file"):
        asp.save(before, tmp_path / "a.nc")
    asp.save(before, tmp_path / "a.nc", overwrite=True)
    with refused(asp.errors.FileFormatError, f"size and unit of file {tmp_path / 'a.nc'}"):
        asp.read(tmp_path / "a.nc", height_unit="nm", lateral_unit="um")
    whole = (tmp_path / "a.nc").read_bytes()
    for name, content in (
        ("cut.nc", whole[: len(whole) // 2]),
        ("turned.nc", whole.replace(b'"spacing": ', b'"spacing": -')),
        ("lost.nc", whole.replace(b'"lay_angle"', b'"lax_angle"')),
    ):
        (tmp_path / name).write_bytes(content)
        with pytest.raises(asp.errors.FileFormatError):
            asp.read(tmp_path / name)
    with pytest.raises(asp.errors.FileFormatError):
        asp.load(tmp_path / "missing.nc")
