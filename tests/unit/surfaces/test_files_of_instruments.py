"""Files of instruments that were read wrongly or refused: units, channels, orientation, damaged
heads, archives."""

from __future__ import annotations

import gzip
import warnings
import zipfile
from pathlib import Path

import h5py
import numpy as np
import pytest
import xarray
from instrument_file import gwy, ibw, nms, x3p
from refusals import refused
from scipy.io import savemat

from asperity.core.errors import FileFormatError
from asperity.surfaces.formats import kind_of, preferred
from asperity.surfaces.read import channels, read

HEIGHTS = np.random.default_rng(3).normal(size=(8, 6))
"""[x, y], y upwards."""


def test_the_spacing_of_nanofocus_files_is_in_nm(tmp_path: Path) -> None:
    nms(tmp_path / "a.nms")
    surface = read(tmp_path / "a.nms")
    assert surface.grid.spacing == pytest.approx((312.5e-9, 312.5e-9))
    assert np.ptp(surface.heights) == pytest.approx(1.959e-6, rel=0.01)


# Channels.


@pytest.fixture
def asylum(tmp_path: Path) -> Path:
    """A file with a phase first, and heights of the voltage and of the sensor, there and back."""
    names = ["PhaseRetrace", "HeightTrace", "HeightRetrace", "ZSensorTrace", "ZSensorRetrace", "AmplitudeRetrace"]
    data = np.stack([HEIGHTS * scale for scale in (45.0, 1e-9, 2e-9, 3e-9, 4e-9, 5e-9)], axis=-1)
    ibw(tmp_path / "a.ibw", data[:6], names)
    return tmp_path / "a.ibw"


def test_heights_are_chosen_by_name_and_never_another_signal(asylum: Path) -> None:
    found = channels(asylum)
    assert [info.kind for info in found] == ["phase", *["height"] * 4, "amplitude"]
    assert [info.unit for info in found] == ["", "m", "m", "m", "m", ""]
    assert [info.name for info in found if info.default] == ["ZSensorRetrace"]
    surface = read(asylum)
    np.testing.assert_allclose(surface.heights, 4e-9 * HEIGHTS[:6], rtol=1e-6)
    assert "4 of 6 channels hold heights" in surface.origin.history[0]
    for name, kind in (("PhaseRetrace", "phase"), ("AmplitudeRetrace", "amplitude")):
        for given in ({}, {"height_unit": "nm"}):
            with refused(FileFormatError, f"channel {name!r} of file {asylum}", kind, "2 = 'HeightRetrace'"):
                read(asylum, channel=name, **given)
    np.testing.assert_allclose(read(asylum, channel=1).heights, 1e-9 * HEIGHTS[:6], rtol=1e-6)


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("Height", "height"),
        ("Z Height Sensor", "height"),
        ("Topography", "height"),
        ("Default", "height"),
        ("Raw", "height"),
        ("Z", "height"),
        ("Scan forward (Z-Axis)", "height"),
        ("Height Error", "error signal"),
        ("Phase", "phase"),
        ("AmplitudeError", "amplitude"),
        ("Deflection", "deflection"),
        ("Lateral Force", "friction"),
        ("Friction", "friction"),
        ("Surface Potential", "potential"),
        ("LFM", "friction"),
        ("Adhesion", "property of the material"),
        ("Laser intensity", "intensity"),
    ],
)
def test_what_a_channel_holds_by_its_name(name: str, kind: str) -> None:
    assert kind_of(name) == kind


def test_heights_of_the_sensor_and_of_the_way_back_come_first() -> None:
    assert preferred(["Height", "Height Sensor"], 0) == 1
    assert preferred(["HeightTrace", "HeightRetrace"], 0) == 1
    assert preferred(["Height", "Height"], 1) == 1
    assert preferred(["Scan forward", "Scan backward"], 0) == 0


def test_two_channels_of_one_name_are_chosen_by_number(tmp_path: Path) -> None:
    gwy(tmp_path / "a.gwy", [("Height", HEIGHTS * 1e-9), ("Height", HEIGHTS * 3e-9)], "m")
    given = {"size": (8e-6, 6e-6)}  # pixels of a metre are refused
    first, second, named = (read(tmp_path / "a.gwy", channel=which, **given) for which in (0, "1", "Height"))
    np.testing.assert_allclose(second.heights, 3.0 * first.heights)
    np.testing.assert_allclose(named.heights, first.heights)
    assert "number 1" in second.origin.history[0]


# Units and orientation.


def test_gwyddion_fields_without_units_ask_for_them(tmp_path: Path) -> None:
    path = tmp_path / "u.gwy"
    gwy(path, [("scan", HEIGHTS)])
    assert (channels(path)[0].size, channels(path)[0].unit) == (None, "")
    subject = f"size and unit of channel 'scan' of file {path}"
    with refused(FileFormatError, subject, "size=", "height_unit="):
        read(path)
    with refused(FileFormatError, subject, "height_unit="):
        read(path, size=(8e-6, 6e-6))
    surface = read(path, size=(8e-6, 6e-6), height_unit="nm")
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-9)


def test_one_array_is_one_surface_in_every_file_of_arrays(tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", HEIGHTS)
    np.savez(tmp_path / "a.npz", A=HEIGHTS)
    savemat(tmp_path / "a.mat", {"A": HEIGHTS})
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["A"] = HEIGHTS
    for name in ("a.npy", "a.npz", "a.mat", "a.h5"):
        surface = read(tmp_path / name, size=(8e-6, 6e-6), height_unit="nm")
        np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-9, rtol=1e-15)
        if name != "a.npy":
            assert "first index of the array is x" in surface.origin.history[0]


@pytest.mark.parametrize("order", [("x", "y"), ("y", "x")])
def test_netcdf_of_several_units(tmp_path: Path, order: tuple[str, str]) -> None:
    axes = {
        name: (name, np.arange(float(n)), {"length": float(n), "unit": unit, "periodic": 0})
        for name, n, unit in (("x", 8, "um"), ("y", 6, "mm"))
    }
    rows = HEIGHTS[:, ::-1] if order == ("x", "y") else HEIGHTS[:, ::-1].T
    made = xarray.Dataset({"heights": (order, rows, {"unit": "nm"})}, coords=axes)
    made.to_netcdf(tmp_path / "m.nc", engine="scipy", format="NETCDF3_64BIT")
    surface = read(tmp_path / "m.nc")
    assert surface.grid.spacing == pytest.approx((1e-6, 1e-3))
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-9)
    made.heights.attrs["unit"] = "V"
    made.to_netcdf(tmp_path / "v.nc", engine="scipy", format="NETCDF3_64BIT")
    with refused(FileFormatError, f"units of file {tmp_path / 'v.nc'}", "x in um", "heights in V"):
        read(tmp_path / "v.nc")


# Heads that are not as they should be.


@pytest.mark.parametrize(
    "given",
    [
        {},
        {"revision": "ISO5436 \N{EN DASH} 2000"},
        {"revision": "ISO5436-2000"},
        {"date": "N/A"},
        {"date": ""},
        {"folder": "scan 1/"},
        {"folder": "a/b/", "date": "unknown", "revision": "ISO 5436 - 2000"},
    ],
)
def test_x3p(tmp_path: Path, given: dict[str, str]) -> None:
    heights = x3p(tmp_path / "a.x3p", **given)
    surface = read(tmp_path / "a.x3p")
    np.testing.assert_allclose(surface.heights, heights, rtol=1e-12)
    assert surface.grid.spacing == pytest.approx((1e-6, 1e-6))


def test_x3p_of_another_standard_is_refused(tmp_path: Path) -> None:
    x3p(tmp_path / "a.x3p", revision="ISO5436 - 1999")
    with refused(FileFormatError, f"file {tmp_path / 'a.x3p'}"):
        read(tmp_path / "a.x3p")


# Formats of our own readers.


def gsf(path: Path, *lines: str) -> None:
    """Write a Gwyddion simple field with these further lines."""
    text = "\n".join(["Gwyddion Simple Field 1.0", "XRes = 8", "YRes = 6", *lines, ""]).encode()
    path.write_bytes(text + b"\0" * (4 - len(text) % 4) + HEIGHTS[:, ::-1].T.astype("<f4").tobytes())


@pytest.mark.parametrize("padding", ["", "x", "xx", "xxx"])
def test_gwyddion_simple_fields(tmp_path: Path, padding: str) -> None:
    path = tmp_path / "a.gsf"
    gsf(path, "XReal = 8e-6", "YReal = 6e-6", "XYUnits = m", "ZUnits = nm", f"Title = Z{padding}")
    surface = read(path)
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-9, rtol=1e-6)
    assert (surface.size, channels(path)[0].name) == ((8e-6, 6e-6), f"Z{padding}")
    path.write_bytes(path.read_bytes()[:-4])
    with refused(FileFormatError, f"points of file {path}", "8 x 6", "47"):
        read(path)


def test_a_simple_field_without_units_asks_for_them(tmp_path: Path) -> None:
    gsf(tmp_path / "a.gsf")
    with refused(FileFormatError, f"size and unit of channel 'heights' of file {tmp_path / 'a.gsf'}", "size="):
        read(tmp_path / "a.gsf")
    surface = read(tmp_path / "a.gsf", size=(8e-6, 6e-6), height_unit="um")
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-6, rtol=1e-6)


@pytest.mark.parametrize("version", [1, 2])
def test_nanosurf_files(tmp_path: Path, version: int) -> None:
    path, top = tmp_path / "a.nhf", 2**31 - 1
    steps = np.round(HEIGHTS / 8.0 * top).astype(np.int32)
    with h5py.File(path, "w") as file:
        measurement = file.create_group("group_0000")
        sides = {"image_size_x": 8e-6, "image_size_y": 6e-6, "image_points_per_line": 8, "image_number_of_lines": 6}
        measurement.attrs.update(sides if version == 1 else {"rect_axis_range": [8e-6, 6e-6]})
        for number, way in enumerate(("Forward", "Backward")):
            segment = measurement.create_group(f"subgroup_{number:04d}")
            segment.attrs.update({"name": way} if version == 1 else {"segment_name": way, "rect_axis_size": [8, 6]})
            word, key = ("name", "base") if version == 1 else ("signal_name", "signal")
            for place, (name, unit) in enumerate((("Phase", "Degree (°)"), ("Topography", "Meter (m)"))):
                data = segment.create_dataset(f"dataset_{place:04d}", data=steps.T.ravel())
                limits = {f"{key}_calibration_min": -8e-9, f"{key}_calibration_max": 8e-9}
                data.attrs.update({word: name, f"{key}_calibration_unit": unit, **limits})
    assert [info.kind for info in channels(path)] == ["phase", "height"] * 2
    surface = read(path)
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-9, atol=1e-17)
    assert (surface.size, surface.origin.channel) == ((8e-6, 6e-6), "Topography Forward")


# The content decides, not the ending.


def test_a_mark_at_the_beginning_wins_over_the_ending(tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", HEIGHTS)
    content = (tmp_path / "a.npy").read_bytes()
    given = {"size": (8e-6, 6e-6), "height_unit": "nm"}
    for name in ("a.txt", "a.png", "a.dat", "a"):
        (tmp_path / name).write_bytes(content)
        np.testing.assert_allclose(read(tmp_path / name, **given).heights, HEIGHTS * 1e-9)  # type: ignore[arg-type]
    heights = x3p(tmp_path / "b.txt")
    np.testing.assert_allclose(read(tmp_path / "b.txt").heights, heights)
    (tmp_path / "c.npy").write_text("1 2\n3 4\n5 7\n")
    with refused(FileFormatError, f"file {tmp_path / 'c.npy'}"):
        read(tmp_path / "c.npy")


def test_a_text_export_of_pixels_that_are_no_squares(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    header = "# Channel: Z\n# Width: 8 µm\n# Height: 12 µm\n# Value units: nm\n"
    path.write_text(header + "".join(" ".join(map(str, row)) + "\n" for row in HEIGHTS[:, ::-1].T), encoding="utf-8")
    surface = read(path)
    assert surface.grid.spacing == pytest.approx((1e-6, 2e-6))
    np.testing.assert_allclose(surface.heights, HEIGHTS * 1e-9)


# Archives.


@pytest.fixture
def archive(tmp_path: Path, asylum: Path) -> Path:
    """A zip archive of two scans, a text and what is no scan."""
    x3p(tmp_path / "b.x3p")
    with zipfile.ZipFile(tmp_path / "scans.zip", "w") as made:
        made.write(asylum, "day 1/a.ibw")
        made.write(tmp_path / "b.x3p", "day 2/b.x3p")
        made.writestr("README.txt", "two scans")
    return tmp_path / "scans.zip"


def test_the_scans_of_an_archive_are_its_channels(archive: Path) -> None:
    assert [(info.index, info.name, info.shape) for info in channels(archive)] == [
        (0, "day 1/a.ibw", (6, 6)),
        (1, "day 2/b.x3p", (5, 4)),
    ]
    with refused(FileFormatError, f"channel of file {archive}", "0 = day 1/a.ibw", "1 = day 2/b.x3p"):
        read(archive)
    for which in (1, "1", "day 2/b.x3p", "b.x3p"):
        assert read(archive, channel=which).shape == (5, 4)
    surface = read(archive, channel="0:HeightTrace")
    np.testing.assert_allclose(surface.heights, 1e-9 * HEIGHTS[:6], rtol=1e-6)
    assert surface.origin.source == "scans.zip"
    with refused(FileFormatError, f"channel 'PhaseRetrace' of file {archive}/day 1/a.ibw", "HeightRetrace"):
        read(archive, channel="a.ibw:PhaseRetrace")


def test_archives_of_one_scan_of_none_and_of_a_problem(tmp_path: Path) -> None:
    heights = x3p(tmp_path / "b.x3p")
    for name, members in {
        "one.zip": {"b.x3p": (tmp_path / "b.x3p").read_bytes()},
        "problem.zip": {"problem.toml": b"version = 2", "b.x3p": b""},
        "none.zip": {"README.md": b"nothing"},
    }.items():
        with zipfile.ZipFile(tmp_path / name, "w", zipfile.ZIP_DEFLATED) as made:
            for member, content in members.items():
                made.writestr(member, content)
    np.testing.assert_allclose(read(tmp_path / "one.zip").heights, heights)
    with refused(FileFormatError, f"file {tmp_path / 'problem.zip'}", "problem.toml", "run(document)"):
        read(tmp_path / "problem.zip")
    with refused(FileFormatError, f"file {tmp_path / 'none.zip'}"):
        read(tmp_path / "none.zip")
    (tmp_path / "cut.zip").write_bytes((tmp_path / "one.zip").read_bytes()[:-30])
    with refused(FileFormatError, f"file {tmp_path / 'cut.zip'}"):
        read(tmp_path / "cut.zip")


def test_a_compressed_file_of_an_instrument(tmp_path: Path) -> None:
    gsf(tmp_path / "a.gsf", "XReal = 8e-6", "YReal = 6e-6", "XYUnits = m", "ZUnits = nm")
    (tmp_path / "a.gsf.gz").write_bytes(gzip.compress((tmp_path / "a.gsf").read_bytes()))
    np.testing.assert_allclose(read(tmp_path / "a.gsf.gz").heights, HEIGHTS * 1e-9, rtol=1e-6)


def test_a_container_of_contact_engineering(tmp_path: Path) -> None:
    """As the library writes it, and as the site does, with the original file and an index that
    states what that lacks."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # on a parallel library that is not there
        from SurfaceTopography import Topography
        from SurfaceTopography.Container.IO.CE import write_containers
        from SurfaceTopography.Container.SurfaceContainer import InMemorySurfaceContainer
    scans = [
        Topography(HEIGHTS[:, ::-1] * scale, (8.0, 6.0), unit="µm", info={"name": name})
        for name, scale in (("first", 1e-3), ("second", 2e-3))
    ]
    write_containers([InMemorySurfaceContainer(scans)], str(tmp_path / "ce.zip"))
    assert [(info.name, info.size) for info in channels(tmp_path / "ce.zip")] == [
        ("first", pytest.approx((8e-6, 6e-6))),
        ("second", pytest.approx((8e-6, 6e-6))),
    ]
    np.testing.assert_allclose(read(tmp_path / "ce.zip", channel="second").heights, HEIGHTS * 2e-9, rtol=1e-12)
    index = """surfaces:
- name: disk
  topographies:
  - {name: a scan, datafile: {original: a.txt}, size: !!python/tuple [8.0, 6.0], unit: um, height_scale: 0.5}
"""
    with zipfile.ZipFile(tmp_path / "yaml.zip", "w") as made:
        made.writestr("meta.yml", index)
        made.writestr("a.txt", "".join(" ".join(map(str, row)) + "\n" for row in HEIGHTS[:, ::-1].T))
    surface = read(tmp_path / "yaml.zip")
    np.testing.assert_allclose(surface.heights, HEIGHTS * 0.5e-6, rtol=1e-12)
    assert surface.size == pytest.approx((8e-6, 6e-6))
    for bad in ("surfaces: 1", "surfaces: !!python/name:os.system", "surfaces: !!python/module:os"):
        with zipfile.ZipFile(tmp_path / "bad.zip", "w") as made:
            made.writestr("meta.yml", bad)
        with refused(FileFormatError, f"file {tmp_path / 'bad.zip'}", "meta.yml"):
            read(tmp_path / "bad.zip")
