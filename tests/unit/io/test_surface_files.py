"""Surfaces written and read back, and surfaces written tile by tile."""

from __future__ import annotations

import tracemalloc
import warnings
from pathlib import Path

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.io.surface_files import BYTES_PER_NODE, save_endless
from asperity.surfaces.surface import Origin

g = asp.generate


def surface(dtype: type = np.float64, missing: bool = True, periodic: bool = True) -> asp.Surface:
    heights = np.random.default_rng(1).standard_normal((12, 9)).astype(dtype) * dtype(1e-8)
    if missing:
        heights[3, 4] = np.nan
    origin = Origin("a µ b", "height", {"tip": "10 nm"}, ("levelled: plane", "filled ∇²h = 0"), ("Jacobs2017",))
    return asp.Surface(heights, 1.1e-8, 0.7e-8, periodic=periodic, origin=origin)


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("missing", [True, False])
@pytest.mark.parametrize("periodic", [True, False])
def test_netcdf_comes_back_equal(tmp_path: Path, dtype: type, missing: bool, periodic: bool) -> None:
    before = surface(dtype, missing, periodic)
    asp.files.save_surface(before, tmp_path / "a.nc")
    after = asp.read(tmp_path / "a.nc")
    np.testing.assert_array_equal(after.heights, before.heights)
    assert after.heights.dtype == before.heights.dtype
    assert (after.dx, after.dy, after.periodic, after.origin) == (before.dx, before.dy, periodic, before.origin)
    (channel,) = asp.surfaces.channels(tmp_path / "a.nc")
    assert (channel.shape, channel.unit) == ((12, 9), "m")


def test_netcdf_is_that_of_the_reader_library(tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the library warns where MPI is missing
        from SurfaceTopography import read_topography
    before = surface()
    asp.files.save_surface(before, tmp_path / "a.nc")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        theirs = read_topography(str(tmp_path / "a.nc"))
    assert theirs.unit == "m"
    assert theirs.physical_sizes == pytest.approx(before.size, rel=1e-15)
    assert theirs.is_periodic
    np.testing.assert_array_equal(np.ma.getmaskarray(theirs.heights()), before.mask)
    np.testing.assert_array_equal(np.ma.filled(theirs.heights(), np.nan), before.heights)


def test_netcdf_opens_in_xarray(tmp_path: Path) -> None:
    import xarray

    before = surface(missing=False)
    asp.files.save_surface(before, tmp_path / "a.nc")
    data = xarray.load_dataset(tmp_path / "a.nc", engine="scipy")
    np.testing.assert_array_equal(data["heights"].values, before.heights)
    assert data["heights"].attrs["units"] == "m"
    np.testing.assert_allclose(data["y"].values, np.arange(9) * 0.7e-8, rtol=1e-15)
    assert data.attrs["history"].splitlines() == list(before.origin.history)


@pytest.mark.parametrize("ending", ["txt", "asc"])
def test_text_comes_back_with_size_and_unit(tmp_path: Path, ending: str) -> None:
    before = surface()
    asp.files.save_surface(before, tmp_path / f"a.{ending}")
    after = asp.read(tmp_path / f"a.{ending}")
    np.testing.assert_array_equal(after.mask, before.mask)
    np.testing.assert_allclose(after.heights, before.heights, rtol=1e-9)  # ten digits are written
    assert after.size == pytest.approx(before.size, rel=1e-9)


def test_array_is_bare(tmp_path: Path) -> None:
    before = surface()
    asp.files.save_surface(before, tmp_path / "a.npy")
    np.testing.assert_array_equal(np.load(tmp_path / "a.npy"), before.heights)
    after = asp.read(tmp_path / "a.npy", size=before.size, height_unit="m")
    np.testing.assert_array_equal(after.heights, before.heights)


def gsf(path: Path) -> tuple[np.ndarray, tuple[float, float]]:
    """Heights [x, y] and size of a Gwyddion Simple Field, by its specification."""
    content = path.read_bytes()
    magic, *lines = content[: content.index(b"\0")].decode("utf-8").splitlines()
    assert magic == "Gwyddion Simple Field 1.0"
    fields = {key.strip(): text.strip() for key, _, text in (line.partition("=") for line in lines)}
    assert (fields["XYUnits"], fields["ZUnits"]) == ("m", "m")
    nx, ny = int(fields["XRes"]), int(fields["YRes"])
    values = np.frombuffer(content[-4 * nx * ny :], "<f4").reshape(ny, nx)
    padding = content[content.index(b"\0") : -4 * nx * ny]
    assert padding in (b"\0", b"\0\0", b"\0\0\0", b"\0\0\0\0")
    assert (len(content) - 4 * nx * ny) % 4 == 0
    return values[::-1].T, (float(fields["XReal"]), float(fields["YReal"]))


@pytest.mark.parametrize("shape", [(12, 9), (7, 30), (101, 3)])
def test_gsf_has_heights_size_and_unit(tmp_path: Path, shape: tuple[int, int]) -> None:
    heights = np.random.default_rng(2).standard_normal(shape) * 1e-8
    heights[1, 2] = np.nan
    before = asp.Surface(heights, 1.1e-8, 0.7e-8)
    asp.files.save_surface(before, tmp_path / "a.gsf")
    found, size = gsf(tmp_path / "a.gsf")
    assert size == before.size
    np.testing.assert_allclose(found, heights, rtol=float(np.finfo(np.float32).eps))


@pytest.mark.parametrize(
    ("ending", "accuracy"), [(".gsf", float(np.finfo(np.float32).eps)), (".x3p", 1e-14), (".xyz", 1e-9)]
)
@pytest.mark.parametrize("missing", [True, False])
def test_other_programs_files_come_back(tmp_path: Path, ending: str, accuracy: float, missing: bool) -> None:
    before, path = surface(missing=missing, periodic=False), tmp_path / f"a{ending}"
    asp.files.save_surface(before, path)
    after = asp.read(path)
    np.testing.assert_array_equal(after.mask, before.mask)
    np.testing.assert_allclose(after.heights, before.heights, rtol=accuracy)
    assert after.size == pytest.approx(before.size, rel=max(accuracy, 1e-13))


@pytest.mark.parametrize(("ending", "accuracy"), [(".x3p", 1e-14), (".xyz", 1e-9)])
def test_the_reader_library_agrees(tmp_path: Path, ending: str, accuracy: float) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the library warns where MPI is missing
        from SurfaceTopography import read_topography

        before, path = surface(), tmp_path / f"a{ending}"
        asp.files.save_surface(before, path)
        theirs = read_topography(str(path))
    heights = np.ma.filled(theirs.heights(), np.nan)
    # y counts downwards from the top row in its maps, upwards in its lists of points
    np.testing.assert_allclose(heights if ending == ".xyz" else heights[:, ::-1], before.heights, rtol=accuracy)
    assert theirs.physical_sizes == pytest.approx(before.size, rel=max(accuracy, 1e-13))
    assert theirs.unit == ("m" if ending == ".x3p" else None)


def test_refusals(tmp_path: Path) -> None:
    before = surface()
    with refused(asp.errors.OutputError, "file of a surface"):
        asp.files.save_surface(before, tmp_path / "a.csv")
    asp.files.save_surface(before, tmp_path / "a.nc")
    with refused(asp.errors.OutputError, "output file"):
        asp.files.save_surface(before, tmp_path / "a.nc")
    asp.files.save_surface(before, tmp_path / "a.nc", overwrite=True)
    with refused(asp.errors.FileFormatError, f"size and unit of file {tmp_path / 'a.nc'}"):
        asp.read(tmp_path / "a.nc", size=(1.0, 1.0))
    with refused(asp.errors.FileFormatError, f"channel of file {tmp_path / 'a.nc'}", "'phase'"):
        asp.read(tmp_path / "a.nc", channel="phase")
    whole = (tmp_path / "a.nc").read_bytes()
    (tmp_path / "cut.nc").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(asp.errors.FileFormatError):
        asp.read(tmp_path / "cut.nc")


ENDLESS = g.endless(g.ExponentialAutocorrelation(1e-9, 4e-8), (1e-8, 1.5e-8), seed=3, skewness=0.4, kurtosis=4.0)


class Watch:
    def __init__(self) -> None:
        self.left: list[float] = []

    def update(self, iteration: int, error: float, tolerance: float) -> None:
        self.left.append(error)


@pytest.mark.parametrize(("precision", "tolerance"), [("double", 1e-13), ("single", 1e-6)])
def test_tiles_make_the_whole_within_the_memory(tmp_path: Path, precision: str, tolerance: float) -> None:
    shape, watch, memory = (700, 530), Watch(), 2.5e6
    tracemalloc.start()
    save_endless(ENDLESS, shape, tmp_path / "a.npy", memory=memory, precision=precision, progress=watch)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert len(watch.left) > 4
    assert watch.left[-1] == pytest.approx(0.0, abs=1e-12)
    assert peak < memory  # of the arrays; BYTES_PER_NODE leaves room for the transform
    whole = ENDLESS.window(shape).heights
    found = np.load(tmp_path / "a.npy", mmap_mode="r")
    assert found.dtype == {"double": np.float64, "single": np.float32}[precision]
    np.testing.assert_allclose(found, whole, rtol=0.0, atol=tolerance * whole.std() * 10)


def test_one_tile_is_enough_for_a_small_surface(tmp_path: Path) -> None:
    watch = Watch()
    save_endless(ENDLESS, (40, 30), tmp_path / "a.npy", progress=watch)
    assert len(watch.left) == 1
    np.testing.assert_allclose(np.load(tmp_path / "a.npy"), ENDLESS.window((40, 30)).heights, atol=1e-22)


def test_tile_refusals(tmp_path: Path) -> None:
    with refused(asp.InputError, "memory of the tiles"):
        save_endless(ENDLESS, (4000, 4000), tmp_path / "a.npy", memory=BYTES_PER_NODE * 1000.0)
    with refused(asp.InputError, "precision of the heights"):
        save_endless(ENDLESS, (40, 40), tmp_path / "a.npy", precision="half")
    with refused(asp.errors.OutputError, "file of a surface"):
        save_endless(ENDLESS, (40, 40), tmp_path / "a.nc")
    with refused(asp.InputError, "number of points along x"):
        save_endless(ENDLESS, (0, 40), tmp_path / "a.npy")
    assert list(tmp_path.iterdir()) == []
