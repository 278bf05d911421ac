"""Files of many public kinds, re-made small: each gives the same map. Line scans in archives, units
in the names of columns, and NT-MDT."""

from __future__ import annotations

import gzip
import struct
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import small_files
from refusals import refused
from small_files import HEIGHTS, KINDS, PIXEL, STEP, STEPS, Kind, mdt, mdt_frame

from asperity.core.errors import FileFormatError
from asperity.surfaces import Profile, Surface
from asperity.surfaces.read import channels, read


@pytest.mark.parametrize("kind", KINDS, ids=[kind.name for kind in KINDS])
def test_every_kind_of_file_holds_the_same_map(tmp_path: Path, kind: Kind) -> None:
    path = tmp_path / f"a.{kind.ending}"
    kind.write(path)
    surface = read(path, **kind.given)
    assert isinstance(surface, Surface)
    assert surface.grid.spacing == pytest.approx((PIXEL, PIXEL), rel=max(kind.digits, 1e-9))
    np.testing.assert_allclose(surface.heights, HEIGHTS, atol=kind.digits * HEIGHTS.max(), rtol=0.0)
    assert [info.default for info in channels(path)].count(True) == 1


def test_kinds_are_many_and_named_once() -> None:
    assert len({kind.name for kind in KINDS}) == len(KINDS) >= 35
    assert len(np.unique(small_files.STEPS[:, 0])) == small_files.NX  # no row like another, for orientation


# NT-MDT.


def test_nt_mdt_heights_are_those_of_the_height_signal(tmp_path: Path) -> None:
    """Of seven frames whose axes are lengths; a frame in volts is no channel, nor is one of
    spectra."""
    spectrum = struct.pack("<IHBB6HH", 32, 1, 0, 1, 2020, 1, 1, 10, 0, 0, 0) + bytes(10)
    signals = (1, 2, 6, 11, 9, 5)
    frames = [mdt_frame(number, STEPS[::-1], 1e-3) for number in signals]
    volts = mdt_frame(3, STEPS, 1.0, z_unit=3)
    mdt(tmp_path / "a.mdt", *frames[:3], spectrum, volts, mdt_frame(0, STEPS, STEP * 1e9), *frames[3:])
    found = channels(tmp_path / "a.mdt")
    assert [(info.name, info.kind) for info in found] == [
        ("DFL", "deflection"),
        ("Lateral F", "friction"),
        ("MAG", "amplitude"),
        ("Height", "height"),
        ("Phase1", "phase"),
        ("RMS", "other signal"),
        ("FB-Out", "other signal"),
    ]
    surface = read(tmp_path / "a.mdt")
    assert surface.origin.channel == "Height"
    np.testing.assert_allclose(surface.heights, HEIGHTS, atol=1e-15)
    with refused(FileFormatError, f"channel 'DFL' of file {tmp_path / 'a.mdt'}", "deflection", "'Height'"):
        read(tmp_path / "a.mdt", channel="DFL")


def test_nt_mdt_units_of_the_axes(tmp_path: Path) -> None:
    for xy_unit, z_unit, step in ((-1, -1, STEP * 1e9), (-3, -2, STEP * 1e6), (-2, 0, STEP * 1e10)):
        mdt(tmp_path / "a.mdt", mdt_frame(0, STEPS, step, xy_unit=xy_unit, z_unit=z_unit))
        surface = read(tmp_path / "a.mdt")
        assert isinstance(surface, Surface)
        assert surface.dx == pytest.approx(PIXEL, rel=1e-6)
        np.testing.assert_allclose(surface.heights, HEIGHTS, rtol=1e-6)


def test_nt_mdt_without_frames_that_are_known_says_what_to_do(tmp_path: Path) -> None:
    multidimensional = struct.pack("<IHBB6HH", 62, 106, 0, 1, 2020, 1, 1, 10, 0, 0, 0) + bytes(40)
    mdt(tmp_path / "a.mdt", multidimensional)
    mdt(tmp_path / "whole.mdt")
    (tmp_path / "cut.mdt").write_bytes((tmp_path / "whole.mdt").read_bytes()[:200])
    for name in ("a.mdt", "cut.mdt"):
        with refused(FileFormatError, f"file {tmp_path / name}", "NT-MDT", ".gsf"):
            read(tmp_path / name)


# Line scans in archives.


X = PIXEL * np.arange(60)
WAVE = 1e-7 * np.sin(2.0 * np.pi * X / 7e-6)


def trace(names: str = "x (mm);z (nm)") -> bytes:
    return (names + "\n" + "".join(f"{1e3 * x:.7f};{1e9 * z:.6f}\n" for x, z in zip(X, WAVE, strict=True))).encode()


def stylus() -> bytes:
    head = "Scan Parameters\nStylus,Radius: 12.5 um\nScan Data\n\nLateral um,Raw nm,\n"
    return (head + "".join(f"{x * 1e6:.4f},{z * 1e9:.6f},\n" for x, z in zip(X, WAVE, strict=True))).encode()


def archive(path: Path, **members: bytes) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as made:
        for name, content in members.items():
            made.writestr(name.replace("_", "."), content)
    return path


@pytest.mark.parametrize("content", [trace, stylus])
def test_a_line_scan_in_an_archive(tmp_path: Path, content: Callable[[], bytes]) -> None:
    one = archive(tmp_path / "one.zip", trace_csv=content(), README_txt=b"one trace")
    found = read(one)
    assert isinstance(found, Profile)
    assert found.spacing == pytest.approx(PIXEL, rel=1e-9)
    np.testing.assert_allclose(found.heights, WAVE, atol=1e-15)
    assert found.origin.source == "one.zip"
    assert [info.shape for info in channels(one)] == [(60,)]
    (tmp_path / "trace.csv.gz").write_bytes(gzip.compress(content()))
    np.testing.assert_allclose(read(tmp_path / "trace.csv.gz").heights, WAVE, atol=1e-15)


def test_line_scans_and_maps_in_one_archive(tmp_path: Path) -> None:
    small_files.gsf(tmp_path / "map.gsf")
    both = archive(tmp_path / "both.zip", a_csv=trace(), b_csv=stylus(), map_gsf=(tmp_path / "map.gsf").read_bytes())
    assert [(info.name, info.shape) for info in channels(both)] == [
        ("a.csv", (60,)),
        ("b.csv", (60,)),
        ("map.gsf", (12, 8)),
    ]
    with refused(FileFormatError, f"channel of file {both}", "0 = a.csv", "2 = map.gsf"):
        read(both)
    second = read(both, channel="b.csv")
    assert isinstance(second, Profile)
    assert second.instrument.tip_radius == pytest.approx(12.5e-6, rel=1e-12)  # the stylus goes through the archive
    assert isinstance(read(both, channel=2), Surface)
    with refused(FileFormatError, f"line scan in file {both}/a.csv", "60 points"):
        read(both, channel="a.csv", size=(1e-6, 1e-6), height_unit="nm")


def test_an_index_states_the_units_of_a_line_scan(tmp_path: Path) -> None:
    index = """surfaces:
- topographies:
  - {name: a trace, datafile: {original: a.txt}, size: !!python/tuple [30.0], unit: um, height_scale: 0.5}
"""
    text = "".join(f"{1e6 * x:.4f} {1e6 * z:.9f}\n" for x, z in zip(X, WAVE, strict=True)).encode()
    with zipfile.ZipFile(tmp_path / "ce.zip", "w") as made:
        made.writestr("meta.yml", index)
        made.writestr("a.txt", text)
    found = read(tmp_path / "ce.zip")
    assert isinstance(found, Profile)
    assert found.spacing == pytest.approx(PIXEL, rel=1e-9)
    np.testing.assert_allclose(found.heights, 0.5 * WAVE, atol=1e-15)


# Units in the names of columns.


@pytest.mark.parametrize(
    ("names", "x_metre", "z_metre"),
    [
        ("x (um);z (nm)", 1e-6, 1e-9),
        ("Position [mm];Height [µm]", 1e-3, 1e-6),
        ("x_um;height_nm", 1e-6, 1e-9),
        ("X / mm;Z / um", 1e-3, 1e-6),
        ("# x (m);z (pm)", 1.0, 1e-12),
        ("x(um);z(um)", 1e-6, 1e-6),
    ],
)
def test_columns_of_a_line_scan_state_their_units(tmp_path: Path, names: str, x_metre: float, z_metre: float) -> None:
    rows = "".join(f"{x / x_metre:.12g};{z / z_metre:.12g}\n" for x, z in zip(X, WAVE, strict=True))
    (tmp_path / "a.csv").write_text(f"{names}\n{rows}", encoding="utf-8")
    found = read(tmp_path / "a.csv")
    assert isinstance(found, Profile)
    assert found.spacing == pytest.approx(PIXEL, rel=1e-9)
    np.testing.assert_allclose(found.heights, WAVE, atol=1e-18)


@pytest.mark.parametrize(("names", "lacking"), [("x (um);z", "height_unit="), ("x;z [nm]", "lateral_unit=")])
def test_one_unit_in_the_names_asks_for_the_other(tmp_path: Path, names: str, lacking: str) -> None:
    path = tmp_path / "a.csv"
    path.write_text(names + "\n" + "".join(f"{1e6 * x:.3f};{1e9 * z:.6f}\n" for x, z in zip(X, WAVE, strict=True)))
    with refused(FileFormatError, f"units of file {path}", lacking):
        read(path)
    found = read(path, **({"height_unit": "nm"} if lacking.startswith("height") else {"lateral_unit": "um"}))
    np.testing.assert_allclose(found.heights, WAVE, atol=1e-15)
    given = {"height_unit": "um", "lateral_unit": "mm"}
    with refused(FileFormatError, f"units of file {path}", "um" if lacking.startswith("height") else "nm"):
        read(path, **given)  # the one that is stated is not the one that is given


def test_a_name_whose_bracket_is_no_length_states_no_unit(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    rows = "".join(f"{1e6 * x:.3f};{1e9 * z:.6f}\n" for x, z in zip(X, WAVE, strict=True))
    path.write_text("x (s);z (V)\n" + rows)
    with refused(FileFormatError, f"units of file {path}", "lateral_unit=", "height_unit="):
        read(path)
