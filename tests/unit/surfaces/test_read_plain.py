"""Plain files: orientation, scales, and one sentence for every failure."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from refusals import refused

import asperity as asp
from asperity.core.errors import FileFormatError, UnitError
from asperity.core.values import Lengths
from asperity.surfaces.read import channels, read

SIZE = (4e-6, 3e-6)
PICTURE = np.array([[1, 2, 3, 4], [5, 6, 7, 8], [9, 10, 11, 12]], dtype=np.uint8)  # rows from top to bottom
EXPECTED = PICTURE[::-1].T.astype(float)  # [x, y] with y upwards


@pytest.mark.parametrize(
    ("name", "delimiter"), [("a.txt", " "), ("a.dat", "\t"), ("a.asc", "  "), ("a.csv", ","), ("b.csv", ";")]
)
def test_text_matrix(tmp_path, name, delimiter):
    path = tmp_path / name
    path.write_text("\n".join(delimiter.join(str(v) for v in row) for row in PICTURE))
    surface = read(path, size=SIZE, height_unit="nm")
    np.testing.assert_allclose(surface.heights, EXPECTED * 1e-9, rtol=1e-15)
    assert surface.size == pytest.approx(SIZE)
    assert surface.dx == pytest.approx(1e-6)
    assert not surface.periodic
    assert "nm" in surface.origin.history[0]


def test_text_with_missing_points(tmp_path):
    path = tmp_path / "a.txt"
    path.write_text("1 2 nan\n4 5 6\n")
    surface = read(path, size=(3e-6, 2e-6), height_unit="um")
    assert surface.n_missing == 1
    assert surface.mask[2, 1]
    assert surface.heights[2, 0] == pytest.approx(6e-6)


def test_text_export_with_header_states_its_size(tmp_path):
    path = tmp_path / "export.txt"
    header = "# Channel: Z\n# Width: 4 µm\n# Height: 3 µm\n# Value units: m\n"
    whole = header + "".join(" ".join(f"{v}e-9" for v in row) + "\n" for row in PICTURE)
    path.write_text(whole, encoding="utf-8")
    surface = read(path)
    np.testing.assert_allclose(surface.heights, EXPECTED * 1e-9, rtol=1e-12)
    assert surface.size == pytest.approx(SIZE)
    lines = whole.splitlines(keepends=True)
    for cut in (whole[:-4], whole[:-5], "".join(lines[:-1])):  # no last line break, a broken number, a line less
        path.write_text(cut, encoding="utf-8")
        with pytest.raises(FileFormatError):  # in the words of the reader library or ours
            read(path)
    tall = header.replace("3 µm", "6 µm") + "".join([*lines[4:], *lines[4:-1]])
    path.write_text(tall, encoding="utf-8")  # pixels of 1 x 1.2 µm may be right: the size confirms them
    assert read(path, size=(4e-6, 6e-6)).shape == (4, 5)


LIST = [(x, y, 10.0 * x + y) for x in (0.5, 0.75, 1.0) for y in (2.0, 2.5, 3.0, 3.5)]


@pytest.mark.parametrize(
    ("name", "header", "mark", "comma"),
    [
        ("a.xyz", "", " ", "."),
        ("a.csv", "x,y,z\n", ",", "."),
        ("b.csv", "X;Y;Z\n", ";", ","),
        ("a.txt", "# a scan\n", "\t", ","),
    ],
)
def test_list_of_points(tmp_path, name, header, mark, comma):
    points = [LIST[i] for i in np.random.default_rng(1).permutation(12) if i != 5]  # any order, one missing
    text = header + "\n".join(mark.join(f"{v:.4f}" for v in point).replace(".", comma) for point in points)
    (tmp_path / name).write_text(text, encoding="utf-8")
    surface = read(tmp_path / name, lateral_unit="um", height_unit="nm")
    assert (surface.dx, surface.dy) == pytest.approx((0.25e-6, 0.5e-6))
    expected = np.array([z for *_, z in LIST]).reshape(3, 4) * 1e-9
    expected[1, 1] = np.nan
    np.testing.assert_allclose(surface.heights, expected)
    for given in ({}, {"size": SIZE}, {"size": SIZE, "height_unit": "nm"}):
        with refused(FileFormatError, f"lateral unit of file {tmp_path / name}", "3 x 4", "lateral_unit="):
            read(tmp_path / name, **given)


@pytest.mark.parametrize(
    "points", [[(0, 0, 1), (1, 0.1, 1), (2.7, 0.4, 1), (3, 1.3, 2)], [*LIST, LIST[0]], [(0, i, 1) for i in range(5)]]
)
def test_three_columns_that_are_no_grid_are_refused(tmp_path, points):
    (tmp_path / "a.txt").write_text("\n".join(" ".join(map(str, point)) for point in points))
    with refused(FileFormatError, "points x y z in three columns"):
        read(tmp_path / "a.txt", size=SIZE, height_unit="nm")


@pytest.mark.parametrize(("header", "mark"), [("", " "), ("a\tb\tc\td\n", "\t"), ("a;b;c;d\n", ";")])
def test_matrix_with_decimal_commas_and_column_names(tmp_path, header, mark):
    rows = "\n".join(mark.join(f"{v / 2:.1f}".replace(".", ",") for v in row) for row in PICTURE)
    (tmp_path / "a.csv").write_text(header + rows)
    np.testing.assert_allclose(read(tmp_path / "a.csv", size=SIZE, height_unit="nm").heights, EXPECTED * 0.5e-9)


def test_one_length_is_no_size_of_a_map_with_unequal_sides(tmp_path):
    np.save(tmp_path / "a.npy", EXPECTED)
    with refused(FileFormatError, f"size of file {tmp_path / 'a.npy'}", "250 nm x 333.3 nm", "1um x 750 nm"):
        read(tmp_path / "a.npy", size=Lengths().read("1um", "--size"), height_unit="nm")
    surface = read(tmp_path / "a.npy", size=Lengths().read("1um x 1um", "--size"), height_unit="nm")
    assert "pixels of 250 nm x 333.3 nm" in surface.origin.history[0]


def test_picture_of_huge_size_is_refused_before_it_is_unpacked(tmp_path):
    Image.new("L", (13_000, 13_000)).save(tmp_path / "a.png")
    with refused(FileFormatError, "pixels of the picture", "13000 x 13000"):
        read(tmp_path / "a.png", size=SIZE, z_scale=1e-7)


def test_numpy_array_is_taken_as_x_y(tmp_path):
    path = tmp_path / "a.npy"
    np.save(path, EXPECTED)
    surface = read(path, size=SIZE, height_unit="nm")
    np.testing.assert_allclose(surface.heights, EXPECTED * 1e-9, rtol=1e-15)


@pytest.mark.parametrize("name", ["a.png", "a.tif", "a.bmp"])
def test_eight_bit_picture(tmp_path, name):
    path = tmp_path / name
    Image.fromarray(PICTURE).save(path)
    surface = read(path, size=SIZE, z_scale=255e-9)
    np.testing.assert_allclose(surface.heights, EXPECTED * 1e-9, rtol=1e-14)


def test_other_pictures(tmp_path):
    sixteen, floating, rgb = tmp_path / "a.png", tmp_path / "f.tif", tmp_path / "g.png"
    Image.fromarray(PICTURE.astype(np.uint16) * 257).save(sixteen)
    Image.fromarray(PICTURE.astype(np.float32)).save(floating)
    Image.fromarray(np.repeat(PICTURE[:, :, None], 3, axis=2)).save(rgb)
    for surface in (
        read(sixteen, size=SIZE, z_scale=255e-9),
        read(floating, size=SIZE, height_unit="nm"),
        read(rgb, size=SIZE, z_scale=255e-9),
    ):
        np.testing.assert_allclose(surface.heights, EXPECTED * 1e-9, rtol=1e-12)


def test_channels_of_a_plain_file(tmp_path):
    path = tmp_path / "a.npy"
    np.save(path, EXPECTED)
    (info,) = channels(path)
    assert info.shape == (4, 3)
    assert info.size is None
    assert info.default
    with refused(FileFormatError, f"channel of file {path}", "'Phase'"):
        read(path, channel="Phase", size=SIZE, height_unit="nm")


@pytest.mark.parametrize(
    ("name", "options", "subject", "shown"),
    [
        ("a.txt", {}, "size of file {}", "size="),
        ("a.txt", {"size": SIZE}, "height unit of file {}", "height_unit="),
        ("a.txt", {"size": (1e-6, 0.0), "height_unit": "nm"}, "size of file {}", "(1e-06, 0.0)"),
        ("a.txt", {"size": 1e-6, "height_unit": "nm"}, "size of file {}", "but is 1e-06"),
        ("a.txt", {"size": SIZE, "height_unit": "nm", "z_scale": 1.0}, "z_scale of file {}", "z_scale"),
        ("a.png", {"size": SIZE}, "z_scale of file {}", "z_scale="),
        ("a.png", {"z_scale": 1e-9}, "size of file {}", "size="),
        ("a.png", {"size": SIZE, "height_unit": "nm"}, "z_scale of file {}", "z_scale="),
        ("colour.png", {"size": SIZE, "z_scale": 1e-9}, "colours of the picture", "grey"),
        ("empty.txt", {}, "file {}", "empty"),
        ("blank.txt", {}, "file {}", "empty"),
        ("ragged.txt", {"size": SIZE, "height_unit": "nm"}, "file {}", "row 2"),
        ("words.txt", {"size": SIZE, "height_unit": "nm"}, "file {}", "text matrix"),
        ("line.txt", {"size": SIZE, "height_unit": "nm"}, "file {}", "2 x 2"),
        ("gone.txt", {}, "file {}", "exist"),
        ("folder", {}, "file {}", "folder or device"),
        ("broken.png", {"size": SIZE, "z_scale": 1e-9}, "file {}", "map of heights"),
        ("broken.npy", {"size": SIZE, "height_unit": "nm"}, "file {}", "map of heights"),
        ("cube.npy", {"size": SIZE, "height_unit": "nm"}, "content of file {}", "two-dimensional"),
        ("object.npy", {"size": SIZE, "height_unit": "nm"}, "file {}", "allow_pickle"),
        ("nothing.txt", {"size": SIZE, "height_unit": "nm"}, "surface heights", "every p"),
        ("noise.xyz1", {}, "file {}", "unknown format"),
    ],
)
def test_refusals_are_one_sentence_with_the_remedy(tmp_path, name, options, subject, shown):
    _write_bad_files(tmp_path)
    with refused(FileFormatError, subject.format(tmp_path / name), shown) as caught:
        read(tmp_path / name, **options)
    assert name in str(caught.value)
    assert "\n" not in str(caught.value)


def test_wrong_unit(tmp_path):
    _write_bad_files(tmp_path)
    with refused(UnitError, "height_unit"):
        read(tmp_path / "a.txt", size=SIZE, height_unit="kg")


def test_unreadable_file(tmp_path, monkeypatch):
    path = tmp_path / "locked.txt"
    path.write_text("1 2\n3 4\n")

    def refuse(self, *args, **options):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "open", refuse)  # file modes do not bind a privileged user
    with refused(FileFormatError, f"file {path}", "Permission denied"):
        read(path)


def _write_bad_files(folder):
    texts = {
        "a.txt": "1 2\n3 4\n",
        "empty.txt": "",
        "blank.txt": " \n",
        "ragged.txt": "1 2 3\n4 5\n",
        "words.txt": "hello world\n",
        "line.txt": "1 2 3\n",
        "nothing.txt": "nan nan\nnan nan\n",
    }
    for name, text in texts.items():
        (folder / name).write_text(text)
    (folder / "folder").mkdir()
    Image.fromarray(PICTURE).save(folder / "a.png")
    colours = np.zeros((3, 4, 3), dtype=np.uint8)
    colours[..., 0] = PICTURE
    Image.fromarray(colours).save(folder / "colour.png")
    (folder / "broken.png").write_bytes((folder / "a.png").read_bytes()[:40])
    np.save(folder / "cube.npy", np.zeros((2, 2, 2)))
    np.save(folder / "object.npy", np.array([[{}, {}]]), allow_pickle=True)
    (folder / "broken.npy").write_bytes((folder / "cube.npy").read_bytes()[:-8])
    (folder / "noise.xyz1").write_bytes(bytes(np.random.default_rng(1).integers(0, 256, 4000, dtype=np.uint8)))


def test_a_name_that_is_too_long_and_a_damaged_record_are_refused(tmp_path):
    with pytest.raises(FileFormatError):
        read("a" * 300)
    asp.files.save_surface(asp.Surface(np.ones((4, 3)), 1e-6), tmp_path / "a.nc")
    whole = (tmp_path / "a.nc").read_bytes()
    for wrong in (whole.replace(b'"dx":', b'"dx" '), whole.replace(b"heights\0", b"\xff\xff\xff\xff\xff\xff\xff\xff")):
        assert wrong != whole
        (tmp_path / "a.nc").write_bytes(wrong)
        with pytest.raises(FileFormatError):
            read(tmp_path / "a.nc", size=SIZE, height_unit="nm")


TITLES = [("Disk A, side 2\n", ";"), ("A disk\n", ","), ("# scan 3\nSurface\n", " "), ("A disk\n\n", "\t")]


@pytest.mark.parametrize(("title", "mark"), TITLES)
def test_one_title_before_the_numbers_is_left_out(tmp_path, title, mark):
    rows = "\n".join(mark.join(str(v) for v in row) for row in PICTURE)
    (tmp_path / "a.csv").write_text(title + rows, encoding="utf-8")
    np.testing.assert_allclose(read(tmp_path / "a.csv", size=SIZE, height_unit="nm").heights, EXPECTED * 1e-9)


@pytest.mark.parametrize(
    "head",
    [
        "DSAA\n4,3\n0,4\n0,3\n1,12\n",  # head of another format, in which rows are shorter
        "size: 4 um\n",  # what states something that would be lost
        "one,two,three,four,five\n",  # more names than columns
        "1.5,nm\n",
        "Title\n1,2,3\n",  # a row that is cut short
    ],
)
def test_what_may_be_the_head_of_a_format_is_no_title(tmp_path, head):
    (tmp_path / "a.csv").write_text(head + "\n".join(",".join(map(str, row)) for row in PICTURE), encoding="utf-8")
    with pytest.raises(FileFormatError):
        read(tmp_path / "a.csv", size=SIZE, height_unit="nm")


def test_a_title_stands_before_rows_longer_than_what_is_looked_at(tmp_path):
    heights = np.random.default_rng(1).standard_normal((3, 9000))
    np.savetxt(tmp_path / "a.csv", heights, delimiter=",", header="A disk", comments="")
    assert read(tmp_path / "a.csv", size=SIZE, height_unit="nm").shape == (9000, 3)


def test_a_text_is_read_once_more_at_the_most_to_see_whether_it_is_whole(tmp_path, monkeypatch):
    path = tmp_path / "export.txt"
    header = "# Channel: Z\n# Width: 4 µm\n# Height: 3 µm\n# Value units: m\n"
    path.write_text(header + "".join(" ".join(f"{v}e-9" for v in row) + "\n" for row in PICTURE), encoding="utf-8")
    reads = []
    whole = Path.read_text
    monkeypatch.setattr(Path, "read_text", lambda self, **options: reads.append(self) or whole(self, **options))
    read(path)
    assert reads == [path]
