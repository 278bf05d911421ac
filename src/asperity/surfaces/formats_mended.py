"""Files that the reader library takes wrongly or refuses without need, mended here; each with the
version that was found so.

SurfaceTopography 1.27.1: the spacing in ``.nms`` files is in nm and is taken for mm; ``.x3p`` files
are refused for an en dash in the revision, a date that is none, or a folder around their members; a
field of a ``.gwy`` file without units is passed over; classic NetCDF files are refused whose axes
and heights have different units; ``.gsf`` and ``.nhf`` files have no reader.
"""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import FileFormatError, UnitError
from ..core.hdf5_files import SIGNATURE
from ..core.units import unit_factor


@dataclass(frozen=True, eq=False)
class OwnChannel:
    """A channel as those of the library: heights [x, y] of ``values()`` with y downwards, in
    ``unit``, as are the sizes."""

    index: int
    name: str
    nb_grid_pts: tuple[int, int]
    physical_sizes: tuple[float, float] | None
    unit: tuple[str, str]
    values: Callable[[], RealArray]
    data_unit: str = ""
    dim: int = 2
    is_periodic: bool = False
    info: Mapping[str, Any] = field(default_factory=dict)

    def topography(self, **given: Any) -> OwnChannel:
        """The channel itself, which gives its heights."""
        return self

    def heights(self) -> RealArray:
        """Values [x, y] with y downwards."""
        return self.values()


@dataclass(frozen=True, eq=False)
class OwnReader:
    """A reader as those of the library, under the ``name`` of the format; the first channel is the
    default."""

    name: str
    channels: Sequence[OwnChannel]

    @property
    def default_channel(self) -> OwnChannel:
        """The first channel."""
        return self.channels[0]


# A unit that the library takes wrongly.

_LARGEST_NMS = 1e-3  # m: no confocal microscope has larger pixels


def stated_scale(reader: str, channel: Any, size: tuple[float, ...] | None) -> tuple[float, ...] | None:
    """``size`` in m of a ``channel``, mended where the library takes its unit wrongly.

    The spacing of an .nms file is in nm: 312.5 of a 20x objective with a field of 160 µm stands
    there, of which the library makes 160 m. What a later version reads rightly is shorter than any
    of these, and stays.
    """
    if reader != "NMSReader" or size is None or size[0] / channel.nb_grid_pts[0] < _LARGEST_NMS:
        return size
    return tuple(side * 1e-6 for side in size)


# X3P.


@contextmanager
def mended(file: Path) -> Iterator[Path]:
    """``file``, or a copy of an .x3p file as the library expects it."""
    with file.open("rb") as stream:
        zipped = stream.read(4) == b"PK\x03\x04"
    if not zipped:
        yield file
        return
    try:
        with zipfile.ZipFile(file) as archive:
            content = _mended_x3p(archive)
    except Exception:  # many types on damaged bytes; what is wrong is said by the library
        content = None
    if content is None:
        yield file
        return
    with TemporaryDirectory(prefix="asperity-") as folder:
        path = Path(folder) / file.name
        with zipfile.ZipFile(path, "w") as copy:
            for name, data in content.items():
                copy.writestr(name, data)
        yield path


_LARGEST_COPY = 2 << 30  # bytes of the members of a file that is mended


def _mended_x3p(archive: zipfile.ZipFile) -> dict[str, bytes] | None:
    """Members of the .x3p ``archive`` as the library expects them; None if they are so, or it is
    none."""
    members = {info.filename.replace("\\", "/"): info for info in archive.infolist() if not info.is_dir()}
    main = min((name for name in members if re.fullmatch(r"(.*/)?main\.xml", name)), key=len, default=None)
    if main is None or sum(info.file_size for info in members.values()) > _LARGEST_COPY:
        return None
    text = archive.read(members[main]).decode("utf-8-sig")
    changed = re.sub(r"(<Revision>\s*ISO ?5436)\s*[-\u2010-\u2015\u2212]\s*(2000\s*</Revision>)", r"\1 - \2", text)
    changed = re.sub(r"<Revision>\s*ISO ?5436 - 2000\s*</Revision>", "<Revision>ISO5436 - 2000</Revision>", changed)
    for date in re.findall(r"<Date>(.*?)</Date>", changed, re.DOTALL):
        if not re.match(r"\s*\d\d\d\d-\d\d-\d\d", date):
            changed = changed.replace(f"<Date>{date}</Date>", "")
    prefix = main.removesuffix("main.xml")
    if changed == text and not prefix:
        return None
    return {
        name.removeprefix(prefix): changed.encode() if name == main else archive.read(info)
        for name, info in members.items()
        if name.startswith(prefix)
    }


# Readers of our own.


def own_reader(file: Path) -> OwnReader | None:
    """A reader of our own for ``file``, None where the library has one that is right."""
    with file.open("rb") as stream:
        start = stream.read(64)
    if start.startswith(b"Gwyddion Simple Field 1."):
        return _gsf(file)
    if start.startswith(b"CDF"):
        return _netcdf_of_several_units(file)
    if file.suffix.lower() == ".nhf" and start.startswith(SIGNATURE):
        return _nhf(file)
    return None


def completed(reader: Any, file: Path) -> Any:
    """The ``reader`` of the library, or one of our own that gives what it passes over in
    ``file``."""
    return _gwy_without_units(reader, file) or reader


def _gsf(file: Path) -> OwnReader:
    """Gwyddion Simple Field: lines ``key = value`` up to a zero byte, padded to four, then 32-bit
    floats, top row first."""
    content = file.read_bytes()
    end = content.find(b"\0")
    pairs = (line.partition("=") for line in content[: max(end, 0)].decode("utf-8", "replace").splitlines()[1:])
    header = {key.strip().lower(): value.strip() for key, _, value in pairs}
    try:
        nx, ny = int(header["xres"]), int(header["yres"])
        sides = tuple(float(header[key]) for key in ("xreal", "yreal")) if {"xreal", "yreal"} <= header.keys() else None
    except (KeyError, ValueError) as error:
        raise FileFormatError(
            f"file {file} must state its points (XRes, YRes) and sides as numbers, but does not ({error})."
        ) from None
    start = end + 4 - end % 4
    if len(content) - start < 4 * nx * ny or min(nx, ny) < 1:
        raise FileFormatError(
            f"file {file} must hold {nx} x {ny} points, but holds {max(0, len(content) - start) // 4}: it is "
            "cut short.",
            subject=f"points of file {file}",
        )
    values = np.frombuffer(content, "<f4", nx * ny, start).reshape(ny, nx).T
    unit = (header.get("xyunits", ""), header.get("zunits", ""))
    sizes = (sides[0], sides[1]) if sides is not None else None
    channel = OwnChannel(0, header.get("title", "heights"), (nx, ny), sizes, unit, lambda: values, unit[1])
    return OwnReader("GSFReader", (channel,))


def _gwy_without_units(reader: Any, file: Path) -> OwnReader | None:
    """Fields of a .gwy ``file`` of which none states units of length, and which the ``reader`` of
    the library passes over."""
    made: list[OwnChannel] = []
    for key, value in reader._metadata.items():
        place = re.fullmatch(r"/(\d+)/data", key)
        if place is None or "GwyDataField" not in value:
            continue
        data = value["GwyDataField"]
        nx, ny = int(data["xres"]), int(data["yres"])
        units = tuple(
            str(data.get(name, {}).get("GwySIUnit", {}).get("unitstr", "")) for name in ("si_unit_xy", "si_unit_z")
        )
        sides = (abs(float(data["xreal"])), abs(float(data["yreal"]))) if _metres(units[0]) else None
        name = str(reader._metadata.get(f"/{place[1]}/data/title", f"field {place[1]}"))
        values = _stored(file, int(data["data"]["offset"]) + 4, (nx, ny), "<f8")
        mask = reader._masks.get(int(place[1]))
        if mask is not None:
            values = _masked(values, _stored(file, int(mask["offset"]) + 4, (nx, ny), "<f8"))
        made.append(OwnChannel(len(made), name, (nx, ny), sides, (units[0], units[1]), values, units[1]))
    return OwnReader("GWYReader", made) if made else None


def _metres(unit: str) -> float | None:
    """Metres in a ``unit`` of length, None for any other."""
    try:
        return unit_factor(unit, "length", "unit of a file") if unit else None
    except UnitError:
        return None


def _stored(file: Path, place: int, shape: tuple[int, int], kind: str) -> Callable[[], RealArray]:
    """What gives the numbers of ``kind`` at a ``place`` of ``file``, rows from the top, as [x,
    y]."""
    nx, ny = shape

    def values() -> RealArray:
        found: RealArray = np.fromfile(file, kind, nx * ny, offset=place).reshape(ny, nx).T
        return found

    return values


def _masked(values: Callable[[], RealArray], mask: Callable[[], RealArray]) -> Callable[[], RealArray]:
    return lambda: np.where(mask() > 0.5, np.nan, values())


def _netcdf_of_several_units(file: Path) -> OwnReader | None:
    """Classic NetCDF in the layout of SurfaceTopography whose x, y and heights have different
    units; None for any other."""
    from scipy.io import netcdf_file

    def unit_of(variable: Any) -> str:
        text = getattr(variable, "unit", getattr(variable, "units", b""))
        return text.decode("utf-8", "replace") if isinstance(text, bytes) else str(text)

    with netcdf_file(io.BytesIO(file.read_bytes()), "r", mmap=False) as data:
        found = data.variables
        if not {"x", "y", "heights"} <= found.keys() or sorted(found["heights"].dimensions) != ["x", "y"]:
            return None
        units = [unit_of(found[name]) for name in ("x", "y", "heights")]
        factors = [_metres(unit) for unit in units]
        if len(set(units)) == 1 and found["heights"].dimensions == ("x", "y"):
            return None
        if None in factors:
            stated = ", ".join(
                f"{name} in {unit or 'no unit'}" for name, unit in zip(("x", "y", "heights"), units, strict=True)
            )
            raise FileFormatError(
                f"units of file {file} must be lengths, but are {stated}.", subject=f"units of file {file}"
            )
        heights = np.array(found["heights"][:], dtype=float)
        heights = heights if found["heights"].dimensions == ("x", "y") else heights.T
        if "mask" in found:
            mask = np.array(found["mask"][:], dtype=bool)
            heights = np.where(mask if mask.shape == heights.shape else mask.T, np.nan, heights)
        sides = []
        for name, metre in zip("xy", factors, strict=False):
            places = np.array(found[name][:], dtype=float)
            length = getattr(found[name], "length", None)
            step = float(places[1] - places[0]) if places.size > 1 else 1.0
            sides.append(float(metre or 1.0) * (float(length) if length is not None else abs(step) * places.size))
        periodic = bool(getattr(found["x"], "periodic", 0)) and bool(getattr(found["y"], "periodic", 0))
    nx, ny = heights.shape
    words = ("m", units[2])
    channel = OwnChannel(
        0, "heights", (nx, ny), (sides[0], sides[1]), words, lambda: heights, units[2], is_periodic=periodic
    )
    return OwnReader("NCReader", (channel,))


def _nhf(file: Path) -> OwnReader:
    """Nanosurf .nhf: measurements with segments (there and back), of which each dataset is a
    channel of one value a point.

    Layout as the maker's own reader (package ``nanosurf``, MIT licence) has it: numbers of a whole
    type, of which the range stands for ``signal_calibration_min`` to ``_max``; lines from the
    bottom.
    """
    import h5py

    made: list[OwnChannel] = []
    with h5py.File(file, "r") as content:
        for measurement in (item for item in content.values() if isinstance(item, h5py.Group)):
            for segment in (item for item in measurement.values() if isinstance(item, h5py.Group)):
                attributes = {**measurement.attrs, **segment.attrs}
                points = attributes.get("rect_axis_size")
                sides = attributes.get("rect_axis_range")
                if points is None:
                    points = [attributes.get(f"image_{name}") for name in ("points_per_line", "number_of_lines")]
                    sides = [attributes.get(f"image_size_{axis}") for axis in "xy"]
                if sides is None or any(item is None for item in (*points, *sides)):
                    continue
                nx, ny = int(points[0]), int(points[1])
                way = _word(segment.attrs.get("segment_name", segment.attrs.get("name", "")))
                for data in (item for item in segment.values() if isinstance(item, h5py.Dataset)):
                    if data.size != nx * ny or data.dtype.kind not in "iuf":
                        continue
                    of = {
                        key.replace("base_calibration", "signal_calibration"): value
                        for key, value in data.attrs.items()
                    }
                    name = _word(of.get("signal_name", of.get("name", "channel")))
                    hit = re.search(r"\(([^)]+)\)", _word(of.get("signal_calibration_unit", "")))
                    unit = hit[1] if hit else _word(of.get("signal_calibration_unit", ""))
                    limits = [
                        float(of.get(f"signal_calibration_{end}", default)) for end, default in (("min", 0), ("max", 1))
                    ]
                    raw = _scaled(np.array(data), limits).reshape(ny, nx)[::-1].T
                    size = (float(sides[0]), float(sides[1]))
                    title = f"{name} {way}".strip()
                    made.append(
                        OwnChannel(len(made), title, (nx, ny), size, ("m", unit), partial(np.asarray, raw), unit)
                    )
    if not made:
        raise FileFormatError(f"file {file} must hold images, but holds none. It may hold curves of forces only.")
    return OwnReader("NHFReader", made)


def _word(text: Any) -> str:
    return text.decode("utf-8", "replace") if isinstance(text, bytes) else str(text)


def _scaled(raw: Any, limits: Sequence[float]) -> RealArray:
    """Numbers of a whole type between ``limits``; floating-point ones are taken as they are."""
    if raw.dtype.kind == "f":
        return np.asarray(raw, dtype=float)
    ends = np.iinfo(raw.dtype)
    factor = (limits[1] - limits[0]) / (float(ends.max) - ends.min)
    found: RealArray = (raw.astype(float) - ends.min) * factor + limits[0]
    return found
