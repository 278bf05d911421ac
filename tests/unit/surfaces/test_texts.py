"""Texts with heights: what is found of their layout is said, and every part of it can be stated."""

from __future__ import annotations

import gzip
from pathlib import Path

import numpy as np
import pytest
from refusals import refused

from asperity.core.errors import FileFormatError, InputError
from asperity.surfaces.read import channels, read
from asperity.surfaces.text_files import TextLayout, text_numbers
from asperity.surfaces.text_points import line_scan

SCALE = {"size": (6e-6, 5e-6), "height_unit": "nm"}
HEIGHTS = np.round(np.random.default_rng(4).normal(size=(5, 6)), 3)  # rows from the top, 6 columns
EXPECTED = HEIGHTS[::-1].T * 1e-9
HOLED = HEIGHTS.copy()
HOLED[1, 2] = np.nan


def rows(mark: str, missing: str = "", values: np.ndarray = HEIGHTS, comma: bool = False) -> str:
    """Text of ``values``, without anything else."""
    text = [[missing if np.isnan(v) else f"{v:.3f}".replace(".", "," if comma else ".") for v in row] for row in values]
    return "".join(mark.join(row) + "\n" for row in text)


def understood(path: Path, **given: object) -> str:
    """What was understood of the text at ``path``."""
    return read(path, **{**SCALE, **given}).origin.history[0]  # type: ignore[arg-type]


WHOLE = {
    "blanks": rows("  "),
    "tabs": rows("\t"),
    "semicolons": rows(";"),
    "decimal commas, tabs": rows("\t", comma=True),
    "decimal commas, blanks": rows(" ", comma=True),
    "decimal commas, semicolons": rows(";", comma=True),
    "comma with blanks": rows(", "),
    "trailing delimiters": rows(",").replace("\n", ",\n"),
    "trailing tabs": rows("\t").replace("\n", "\t\n"),
    "quoted": "".join(",".join(f'"{v}"' for v in row) + "\n" for row in HEIGHTS),
    "quoted decimal commas": "".join(",".join(f'"{v:.3f}"'.replace(".", ",") for v in row) + "\n" for row in HEIGHTS),
    "names of columns": "a,b,c,d,e,f\n" + rows(","),
    "blank lines": "\n" + rows(",").replace("\n", "\n\n"),
    "comments": "% made by hand\n# second\n" + rows(","),
    "windows lines": rows(",").replace("\n", "\r\n"),
    "header of a microscope": '"Model","VK-X200"\n"Lens","50x"\n"Date","2020/01/02"\n"Height"\n' + rows(","),
    "two titles": "Disk A\nside 2\n" + rows(";"),
}


@pytest.mark.parametrize("kind", WHOLE)
def test_a_matrix_is_read_however_it_is_written(tmp_path: Path, kind: str) -> None:
    path = tmp_path / "a.csv"
    path.write_bytes(WHOLE[kind].encode())
    np.testing.assert_allclose(read(path, **SCALE).heights, EXPECTED, rtol=1e-12)
    assert channels(path)[0].shape == (6, 5)


@pytest.mark.parametrize("mark", ["---", "Bad", "N/A", "nan", "NULL", "#N/A", "***"])
@pytest.mark.parametrize("between", [",", "\t", " "])
def test_texts_of_missing_points(tmp_path: Path, mark: str, between: str) -> None:
    (tmp_path / "a.txt").write_text(rows(between, mark, HOLED))
    surface = read(tmp_path / "a.txt", **SCALE)
    assert surface.n_missing == 1
    assert surface.mask[2, 3]
    if mark != "nan":  # which numbers are read with at once
        assert f"1 × '{mark}'" in surface.origin.history[0]


def test_empty_cells_are_missing_points_and_other_words_are_stated(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text(rows(";", "", HOLED))
    assert read(tmp_path / "a.csv", **SCALE).mask[2, 3]
    (tmp_path / "a.csv").write_text(rows(";", "hole", HOLED))
    with refused(FileFormatError, "row 2 (line 2), column 3", "'hole'", "missing="):
        read(tmp_path / "a.csv", **SCALE)
    assert read(tmp_path / "a.csv", missing=["hole"], **SCALE).mask[2, 3]
    (tmp_path / "a.csv").write_text(rows(";", "-9999", HOLED))
    surface = read(tmp_path / "a.csv", missing=[-9999], **SCALE)
    assert surface.mask[2, 3]
    assert "-9999" in surface.origin.history[0]


@pytest.mark.parametrize(
    ("encoding", "said"),
    [("utf-8-sig", "utf-8"), ("utf-16", "utf-16"), ("utf-16-le", "utf-16-le"), ("cp1252", "cp1252")],
)
def test_encodings(tmp_path: Path, encoding: str, said: str) -> None:
    (tmp_path / "a.txt").write_bytes(("Höhe in µm\n" + rows("\t")).encode(encoding))
    np.testing.assert_allclose(read(tmp_path / "a.txt", **SCALE).heights, EXPECTED, rtol=1e-12)
    assert said in understood(tmp_path / "a.txt")
    assert said in understood(tmp_path / "a.txt", encoding=encoding)


def test_a_compressed_text(tmp_path: Path) -> None:
    (tmp_path / "a.csv.gz").write_bytes(gzip.compress(rows(",").encode()))
    surface = read(tmp_path / "a.csv.gz", **SCALE)
    np.testing.assert_allclose(surface.heights, EXPECTED, rtol=1e-12)
    assert surface.origin.source == "a.csv.gz"
    (tmp_path / "cut.gz").write_bytes(gzip.compress(rows(",").encode())[:40])
    with refused(FileFormatError, f"file {tmp_path / 'cut.gz'}"):
        read(tmp_path / "cut.gz", **SCALE)


def test_commas_of_two_meanings_are_refused_and_can_be_stated(tmp_path: Path) -> None:
    text = "".join(",".join(f"{abs(v):.3f}".replace(".", ",") for v in row) + "\n" for row in HEIGHTS)
    (tmp_path / "a.csv").write_text(text)
    with refused(FileFormatError, "commas of the text", "delimiter=", "decimal="):
        read(tmp_path / "a.csv", **SCALE)
    surface = read(tmp_path / "a.csv", size=(12e-6, 5e-6), height_unit="nm", delimiter="comma", decimal="point")
    assert surface.shape == (12, 5)


# Coordinates.

X, Y = 0.5 * np.arange(6), 2.0 - 0.5 * np.arange(5)


def framed(corner: str, mark: str = ",", x: np.ndarray = X, y: np.ndarray = Y) -> str:
    """Text of the heights with a row of ``x`` and a column of ``y``."""
    text = mark.join([corner, *(f"{value:g}" for value in x)]) + "\n"
    for value, row in zip(y, HEIGHTS, strict=True):
        text += mark.join([f"{value:g}", *(f"{v:.3f}" for v in row)]) + "\n"
    return text


@pytest.mark.parametrize("corner", ["0", "", "y\\x", "nan"])
@pytest.mark.parametrize("given", [{"lateral_unit": "um"}, {"size": (3e-6, 2.5e-6)}])
def test_coordinates_in_the_first_row_and_column(tmp_path: Path, corner: str, given: dict[str, object]) -> None:
    (tmp_path / "a.csv").write_text(framed(corner))
    surface = read(tmp_path / "a.csv", height_unit="nm", **given)  # type: ignore[arg-type]
    np.testing.assert_allclose(surface.heights, EXPECTED, rtol=1e-12)
    assert surface.grid.spacing == pytest.approx((0.5e-6, 0.5e-6))
    assert "row 1 and column 1 hold coordinates" in surface.origin.history[0]


def test_coordinates_state_the_order_and_the_ratio_of_the_sides(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text(framed("0", x=X[::-1], y=Y[::-1] * 2.0))
    surface = read(tmp_path / "a.csv", lateral_unit="um", height_unit="nm")
    assert surface.grid.spacing == pytest.approx((0.5e-6, 1e-6))
    np.testing.assert_allclose(surface.heights, HEIGHTS.T[::-1] * 1e-9, rtol=1e-12)
    with refused(FileFormatError, f"size of file {tmp_path / 'a.csv'}", "lateral_unit="):
        read(tmp_path / "a.csv", **SCALE)
    with refused(FileFormatError, f"lateral unit of file {tmp_path / 'a.csv'}", "size=", "lateral_unit="):
        read(tmp_path / "a.csv", height_unit="nm")


def test_an_index_of_rows_is_no_height(tmp_path: Path) -> None:
    """As written by pandas with its default arguments."""
    text = ",".join(["", *map(str, range(6))]) + "\n"
    text += "".join(f"{number}," + line + "\n" for number, line in enumerate(rows(",").splitlines()))
    (tmp_path / "a.csv").write_text(text)
    for size in ((6e-6, 5e-6), (6e-6, 1e-6)):  # numbers of points state no ratio of the sides
        assert read(tmp_path / "a.csv", size=size, height_unit="nm").size == pytest.approx(size)
    named = text.replace(text.splitlines()[0], ",a,b,c,d,e,f")
    (tmp_path / "a.csv").write_text(named)
    surface = read(tmp_path / "a.csv", size=(6e-6, 5e-6), height_unit="nm")
    assert surface.shape == (6, 5)
    assert "column 1 holds coordinates" in surface.origin.history[0]
    assert read(tmp_path / "a.csv", size=(7e-6, 5e-6), height_unit="nm", axes="none").shape == (7, 5)


def test_a_plane_and_a_staircase_have_no_coordinates(tmp_path: Path) -> None:
    plane = np.add.outer(np.arange(5) * 2.0, np.arange(6) * 3.0)
    np.savetxt(tmp_path / "a.txt", plane)
    assert read(tmp_path / "a.txt", **SCALE).shape == (6, 5)
    assert read(tmp_path / "a.txt", size=(15e-6, 8e-6), height_unit="nm", axes="both").shape == (5, 4)
    assert read(tmp_path / "a.txt", size=(6e-6, 4e-6), height_unit="nm", axes="row").shape == (6, 4)


# Line scans and lists of points.


def test_a_line_scan_is_no_map(tmp_path: Path) -> None:
    x = np.arange(50) * 0.5
    np.savetxt(tmp_path / "xz.txt", np.c_[x, np.sin(x)], fmt="%.4f")
    for given, subject in (({}, "units of"), (SCALE, "line scan in")):
        with refused(FileFormatError, f"{subject} file {tmp_path / 'xz.txt'}", "50 points", "0 to 24.5"):
            read(tmp_path / "xz.txt", **given)  # type: ignore[arg-type]
    found = line_scan(text_numbers(tmp_path / "xz.txt", TextLayout()))
    assert found is not None
    np.testing.assert_allclose(found.x, x)
    assert found.x_unit == ""
    (tmp_path / "b.csv").write_text("x (mm);z (µm)\n" + "".join(f"{v};{np.sin(v)}\n" for v in x), encoding="utf-8")
    named = line_scan(text_numbers(tmp_path / "b.csv", TextLayout()))
    assert named is not None
    assert (named.x_unit, named.z_unit) == ("mm", "µm")
    np.savetxt(tmp_path / "z.txt", np.sin(x))
    with refused(FileFormatError, f"line scan in file {tmp_path / 'z.txt'}", "50 numbers"):
        read(tmp_path / "z.txt", **SCALE)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("names", "order"),
    [("x (um),y (um),z (nm)", "xyz"), ("Intensity,Z [nm],Y [um],X [um]", "izyx"), ("y_um,x_um,height_nm,mask", "yxzi")],
)
def test_named_columns_state_their_units(tmp_path: Path, names: str, order: str) -> None:
    text = names + "\n"
    for i in range(4):
        for j in range(3):
            values = {"x": 0.5 * i, "y": 0.25 * j, "z": 10.0 * i + j, "i": 1.0}
            text += ",".join(f"{values[name]}" for name in order) + "\n"
    (tmp_path / "a.csv").write_text(text)
    surface = read(tmp_path / "a.csv")
    assert surface.grid.spacing == pytest.approx((0.5e-6, 0.25e-6))
    np.testing.assert_allclose(surface.heights, 1e-9 * np.add.outer(10.0 * np.arange(4), np.arange(3)), rtol=1e-12)
    assert channels(tmp_path / "a.csv")[0].size == pytest.approx((2e-6, 0.75e-6))
    with refused(FileFormatError, f"height unit of file {tmp_path / 'a.csv'}", "nm", "um"):
        read(tmp_path / "a.csv", height_unit="um")


# Headers.


@pytest.mark.parametrize(
    "head",
    [
        '"XY calibration","500","nm/pixel"\n"Unit","um"\n',
        "X size, 3 um\nY size, 2.5 um\nZ unit, um\n",
        "Pixel size 0.5 µm\nheight units, um\n",
    ],
)
def test_a_header_that_states_size_and_unit(tmp_path: Path, head: str) -> None:
    (tmp_path / "a.csv").write_text('"Model","50x"\n' + head + rows(","), encoding="utf-8")
    surface = read(tmp_path / "a.csv")
    assert surface.size == pytest.approx((3e-6, 2.5e-6))
    np.testing.assert_allclose(surface.heights, 1e3 * EXPECTED, rtol=1e-12)
    assert read(tmp_path / "a.csv", size=(3e-6, 2.5e-6), height_unit="um").size == surface.size
    with refused(FileFormatError, f"size of file {tmp_path / 'a.csv'}", "3e-06 x 2.5e-06"):
        read(tmp_path / "a.csv", size=(1e-6, 1e-6))


def test_lines_of_a_header_can_be_stated(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("DSAA\n5,6\n0,1\n" + rows(","))
    with refused(FileFormatError, f"file {tmp_path / 'a.csv'}", "line 2", "header_lines="):
        read(tmp_path / "a.csv", **SCALE)
    np.testing.assert_allclose(read(tmp_path / "a.csv", header_lines=3, **SCALE).heights, EXPECTED, rtol=1e-12)


def test_rows_and_columns_are_counted_from_one(tmp_path: Path) -> None:
    lines = rows(",").splitlines()
    (tmp_path / "a.csv").write_text("\n".join([*lines[:3], lines[3].rpartition(",")[0], lines[4]]) + "\n")
    with refused(FileFormatError, f"file {tmp_path / 'a.csv'}", "row 4 (line 4) has 5", "row 1 has 6", "delimiter="):
        read(tmp_path / "a.csv", **SCALE)


@pytest.mark.parametrize(
    ("given", "subject"),
    [
        ({"delimiter": "pipe"}, "delimiter of a text"),
        ({"decimal": "dot"}, "decimal of a text"),
        ({"axes": "all"}, "axes of a text"),
        ({"encoding": "klingon"}, "encoding of a text"),
    ],
)
def test_words_for_the_layout(tmp_path: Path, given: dict[str, object], subject: str) -> None:
    (tmp_path / "a.csv").write_text(rows(","))
    with refused(InputError, subject):
        read(tmp_path / "a.csv", **SCALE, **given)  # type: ignore[arg-type]


def test_bytes_of_another_encoding_than_the_one_that_is_stated(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_bytes(("Höhe\n" + rows(",")).encode("cp1252"))
    with refused(FileFormatError, "encoding of the text", "byte 2", "encoding="):
        read(tmp_path / "a.csv", encoding="utf-8", **SCALE)
