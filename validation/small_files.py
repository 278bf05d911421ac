"""Small files of public kinds, each with the same map of heights, made here from the descriptions
of their formats.

No bytes of other people's files are in the repository: what a reader must do with a kind of file is
tested on these.
"""

from __future__ import annotations

import io
import struct
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

STEP = 1e-9
"""Metre per step of the heights, which are whole numbers of steps."""

PIXEL = 0.5e-6
"""Distance in m of the points along both axes."""

STEPS = np.random.default_rng(20261129).integers(1, 4000, (12, 8))
"""Steps [x, y], y upwards, without any symmetry; positive, as some formats need them."""

HEIGHTS = STEPS * STEP
"""Heights (12, 8) in m."""

ROWS = np.ascontiguousarray(STEPS[:, ::-1].T)
"""Steps as a picture has them: rows from the top."""

NX, NY = STEPS.shape
SIZE = (NX * PIXEL, NY * PIXEL)


@dataclass(frozen=True)
class Kind:
    """A kind of file: its ``name``, ``ending`` and writer; ``given``: what must be stated to read
    it; ``digits``: rounding of its numbers over the largest height."""

    name: str
    ending: str
    write: Callable[[Path], None]
    given: Mapping[str, Any] = field(default_factory=dict)
    digits: float = 1e-12


# Formats of programs and standards.


def gsf(path: Path) -> None:
    """Gwyddion Simple Field."""
    head = (
        f"Gwyddion Simple Field 1.0\nXRes = {NX}\nYRes = {NY}\nXReal = {SIZE[0]:g}\nYReal = {SIZE[1]:g}\n"
        "XYUnits = m\nZUnits = nm\n"
    ).encode()
    path.write_bytes(head + b"\0" * (4 - len(head) % 4) + ROWS.astype("<f4").tobytes())


def gwy(path: Path) -> None:
    """Gwyddion's native format: nested objects with named parts."""

    def part(name: str, kind: str, content: bytes) -> bytes:
        return name.encode() + b"\0" + kind.encode() + content

    def made(name: str, *parts: bytes) -> bytes:
        return name.encode() + b"\0" + struct.pack("<I", sum(map(len, parts))) + b"".join(parts)

    unit = made("GwySIUnit", part("unitstr", "s", b"m\0"))
    data = made(
        "GwyDataField",
        part("xres", "i", struct.pack("<i", NX)),
        part("yres", "i", struct.pack("<i", NY)),
        part("xreal", "d", struct.pack("<d", SIZE[0])),
        part("yreal", "d", struct.pack("<d", SIZE[1])),
        part("si_unit_xy", "o", unit),
        part("si_unit_z", "o", unit),
        part("data", "D", struct.pack("<I", NX * NY) + (ROWS * STEP).astype("<f8").tobytes()),
    )
    whole = (part("/0/data", "o", data), part("/0/data/title", "s", b"Height\0"))
    path.write_bytes(b"GWYP" + made("GwyContainer", *whole))


def x3p(path: Path) -> None:
    """ISO 25178-72, with the checksum of its index; rows from the top as written by most
    instruments."""
    import hashlib

    axes = "".join(
        f"<C{name}><AxisType>{kind}</AxisType><DataType>D</DataType><Increment>{step!r}</Increment><Offset>0</Offset></C{name}>"
        for name, kind, step in (("X", "I", PIXEL), ("Y", "I", PIXEL), ("Z", "A", 1.0))
    )
    raw = (ROWS * STEP).astype("<f8").tobytes()
    text = (
        '<?xml version="1.0" encoding="UTF-8"?><p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2">'
        f"<Record1><Revision>ISO5436 - 2000</Revision><FeatureType>SUR</FeatureType><Axes>{axes}</Axes></Record1>"
        "<Record2><Date>2020-01-01T00:00:00</Date><Instrument><Manufacturer>m</Manufacturer><Model>x</Model>"
        "<Serial>s</Serial><Version>v</Version></Instrument><CalibrationDate>2020-01-01T00:00:00</CalibrationDate>"
        "<ProbingSystem><Type>NonContacting</Type><Identification>i</Identification></ProbingSystem></Record2>"
        f"<Record3><MatrixDimension><SizeX>{NX}</SizeX><SizeY>{NY}</SizeY><SizeZ>1</SizeZ></MatrixDimension><DataLink>"
        f"<PointDataLink>bindata/data.bin</PointDataLink><MD5ChecksumPointData>{hashlib.md5(raw).hexdigest()}"
        "</MD5ChecksumPointData></DataLink></Record3><Record4><ChecksumFile>md5checksum.hex</ChecksumFile></Record4>"
        "</p:ISO5436_2>"
    )
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("main.xml", text)
        archive.writestr("bindata/data.bin", raw)
        archive.writestr("md5checksum.hex", f"{hashlib.md5(text.encode()).hexdigest()} *main.xml")


def _sdf_fields() -> dict[str, Any]:
    return {
        "ManufacID": "asperity",
        "CreateDate": "010120200000",
        "ModDate": "010120200000",
        "NumPoints": NX,
        "NumProfiles": NY,
        "Xscale": PIXEL,
        "Yscale": PIXEL,
        "Zscale": STEP,
        "Zresolution": -1.0,
        "Compression": 0,
        "DataType": 7,
        "CheckType": 0,
    }


def sdf_text(path: Path) -> None:
    """ISO 25178-71 in text."""
    head = "".join(f"{name} = {value}\n" for name, value in _sdf_fields().items())
    body = "\n".join(" ".join(map(str, row)) for row in ROWS)
    path.write_text(f"aISO-1.0\n{head}*\n{body}\n*\n*\n", encoding="ascii")


def sdf_binary(path: Path) -> None:
    """ISO 25178-71 in binary."""
    values = list(_sdf_fields().values())
    texts = [values[0].ljust(10).encode(), *(item.encode() for item in values[1:3])]
    head = struct.pack("<10s12s12sHHddddBBB", *texts, *values[3:])
    path.write_bytes(b"bISO-1.0" + head + ROWS.astype("<f8").tobytes())


def sur(path: Path) -> None:
    """Digital Surf, 16-bit points."""
    head = struct.pack("<12sHHHH30s30sHHHHHII", b"DIGITAL SURF", 0, 1, 1, 2, b"scan", b"", 0, 0, 0, 0, 1, 0, 0)
    head += struct.pack("<HiiiiI", 16, int(ROWS.min()), int(ROWS.max()), NX, NY, NX * NY)
    head += struct.pack("<fff", PIXEL * 1e6, PIXEL * 1e6, STEP * 1e6)
    head += b"".join(name.ljust(16) for name in (b"X", b"Y", b"Z", *[b"um"] * 6))
    head += struct.pack("<fffHHHIII", 1.0, 1.0, 1.0, 0, 0, 0, 0, 0, 0)
    head += struct.pack("<7HfIIHHH", 0, 0, 0, 1, 1, 2020, 3, 0.0, 0, 0, 0, 0, 0)
    head += b" " * 128 + struct.pack("<fff", 0.0, 0.0, 0.0) + bytes(34)
    path.write_bytes(head + ROWS.astype("<i2").tobytes())


def os3d(path: Path) -> None:
    """OmniSurf3D."""
    head = b"OmniSurf3D" + struct.pack("<ii", 1, 0)
    for text in (b"scan", b"2020-01-01 10:00"):
        head += struct.pack("<i", len(text)) + text
    head += struct.pack("<iidddd", NX, NY, PIXEL * 1e6, PIXEL * 1e6, 0.0, 0.0)
    path.write_bytes(head + (ROWS * STEP * 1e6).astype("<f4").tobytes() + b"\0")


# Optical profilers and microscopes.


def al3d(path: Path) -> None:
    """Alicona focus variation: rows padded to eight bytes."""
    tags = {
        "Version": 1,
        "TagCount": 9,
        "Cols": NX,
        "Rows": NY,
        "DepthImageOffset": 845,
        "TextureImageOffset": 0,
        "IconOffset": 0,
        "NumberOfPlanes": 0,
        "InvalidPixelValue": 3e15,
        "PixelSizeXMeter": PIXEL,
        "PixelSizeYMeter": PIXEL,
    }
    head = b"AliconaImaging\0\r\n"
    head += b"".join(
        struct.pack("<20s30s2s", key.encode(), str(value).encode(), b"\r\n") for key, value in tags.items()
    )
    wide = np.zeros((NY, NX + NX % 2), "<f4")
    wide[:, :NX] = ROWS * STEP
    path.write_bytes(head.ljust(843, b"\0") + b"\r\n" + wide.tobytes())


def plu(path: Path) -> None:
    """Sensofar confocal, one layer."""
    micron = PIXEL * 1e6
    head = b"Wed Jan  1 10:00:00 2020".ljust(128, b"\0") + struct.pack("<I", 0) + bytes(256)
    head += struct.pack("<IIIfffffff", NY, NX, 0, 1.0, micron, micron, 0.0, 0.0, 1.0, 0.0)
    head += struct.pack("<IIIII", 3, 0, 0, 1, 0) + struct.pack("<IIIIIdfII", 0, 0, NX, NY, 0, 0.0, 0.0, 0, 0)
    head += struct.pack("<BBBBB3BI", 0, 1, 0, 0, 0, 0, 0, 0, 0)
    low, high = float(ROWS.min()), float(ROWS.max())
    data = struct.pack("<II", NY, NX) + (ROWS * STEP * 1e6).astype("<f4").tobytes() + struct.pack("<ff", low, high)
    path.write_bytes(head + data)


def plux(path: Path) -> None:
    """Sensofar's archive of layers."""
    micron = PIXEL * 1e6
    index = (
        '<?xml version="1.0"?><xml><GENERAL><DATE>2020-01-01 10:00:00</DATE>'
        f"<IMAGE_SIZE_X>{NX}</IMAGE_SIZE_X><IMAGE_SIZE_Y>{NY}</IMAGE_SIZE_Y><FOV_X>{micron}</FOV_X><FOV_Y>{micron}</FOV_Y>"
        "</GENERAL><INFO><SIZE>1</SIZE><ITEM_0><NAME>Device</NAME><VALUE>S neox</VALUE></ITEM_0></INFO>"
        "<LAYER_0><FILENAME_Z>LAYER_0.raw</FILENAME_Z></LAYER_0></xml>"
    )
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("index.xml", index)
        archive.writestr("LAYER_0.raw", (ROWS * STEP * 1e6).astype("<f4").tobytes())


def opd(path: Path) -> None:
    """Wyko white-light interferometer: columns from the left, each from the bottom, in units of the
    wavelength."""
    mult, wavelength = 1000, 500.0
    steps = np.rint(STEPS * STEP * 1e9 / wavelength * mult * 2.0).astype("<i2")  # half steps of a nm
    blocks = [
        (b"RAW_DATA", 3, struct.pack("<HHH", NX, NY, 2) + steps.tobytes()),
        (b"Wavelength", 7, struct.pack("<f", wavelength)),
        (b"Mult", 6, struct.pack("<h", 2 * mult)),
        (b"Aspect", 7, struct.pack("<f", 1.0)),
        (b"Pixel_size", 7, struct.pack("<f", PIXEL * 1e3)),
    ]
    head = struct.pack("<16shlH", b"Directory", 1, 24 * (len(blocks) + 1), 0xFFFF)
    head += b"".join(struct.pack("<16shlH", name, kind, len(data), 0) for name, kind, data in blocks)
    path.write_bytes(b"\x01\x00" + head + b"".join(data for *_, data in blocks))


def nms(path: Path) -> None:
    """NanoFocus confocal: 16 bit between two heights, spacing in nm."""
    head = bytearray(3468)
    struct.pack_into("<4I", head, 0, 2, 1, 0, 0xFFFF)
    struct.pack_into("<2d", head, 16, 0.0, 65534 * STEP * 1e6)
    head[1076:1092] = b"2020-01-01 10:00"
    struct.pack_into("<2I", head, 1368, NX, NY)
    struct.pack_into("<2d", head, 1376, PIXEL * 1e9, PIXEL * 1e9)
    path.write_bytes(bytes(head) + ROWS.astype("<u2").tobytes() + bytes(NX * NY))


def tmd(path: Path) -> None:
    """TrueMap: all lengths in mm."""
    head = b"Binary TrueMap Data File v2.0\r\n\0" + b"made small".ljust(21) + b"\r\n\0"
    head += struct.pack("<IIffff", NX, NY, SIZE[0] * 1e3, SIZE[1] * 1e3, 0.0, 0.0)
    path.write_bytes(head + (ROWS * STEP * 1e3).astype("<f4").tobytes())


def zmg(path: Path) -> None:
    """Zeta: 16-bit points."""
    head = b"Zeta-Instruments" + bytes(69) + struct.pack("<II4s", NX, NY, b"")
    head += struct.pack("<fff8sI", PIXEL * 1e6, PIXEL * 1e6, STEP * 1e6, b"", 4) + bytes(84)
    path.write_bytes(head + b"note" + ROWS.astype("<u2").tobytes())


# Scanning probe microscopes.


def bcr(path: Path) -> None:
    """BCR-STM: text head of 2048 bytes."""
    head = (
        f"fileformat = bcrstm\nheadersize = 2048\nxpixels = {NX}\nypixels = {NY}\nxlength = {SIZE[0] * 1e9:g}\n"
        f"ylength = {SIZE[1] * 1e9:g}\nxunit = nm\nyunit = nm\nzunit = nm\nbit2nm = {STEP * 1e9:g}\nxoffset = 0\n"
        "yoffset = 0\nintelmode = 1\n"
    )
    path.write_bytes(head.encode().ljust(2048, b" ") + ROWS.astype("<i2").tobytes())


def ibw(path: Path) -> None:
    """Igor binary wave of Asylum's microscopes: a phase first, which the file says is in m, then
    heights."""
    data = np.dstack([45.0 + 0.001 * STEPS, HEIGHTS])
    wave, count = bytearray(320), data.shape[2]
    struct.pack_into("<I", wave, 12, data.size)
    struct.pack_into("<h", wave, 16, 2)
    wave[28:32] = b"topo"
    struct.pack_into("<4i", wave, 68, NX, NY, count, 0)
    struct.pack_into("<4d", wave, 84, PIXEL, PIXEL, 1.0, 1.0)
    wave[148:149] = wave[152:153] = wave[156:157] = b"m"
    labels = b"".join(name.ljust(32, b"\0") for name in (b"", b"PhaseRetrace", b"HeightRetrace"))
    raw = data.astype("<f4").tobytes(order="F")
    head = bytearray(64)
    struct.pack_into("<h", head, 0, 5)
    struct.pack_into("<i", head, 4, 320 + len(raw))
    struct.pack_into("<4i", head, 36, 0, 0, len(labels), 0)
    total = sum(struct.unpack("<192h", bytes(head) + bytes(wave))) & 0xFFFF
    struct.pack_into("<H", head, 2, (-total) & 0xFFFF)
    path.write_bytes(bytes(head) + bytes(wave) + raw + labels)


def mdt_frame(signal: int, steps: np.ndarray, z_step: float, *, xy_unit: int = -2, z_unit: int = -1) -> bytes:
    """Frame of an NT-MDT file: ``steps`` [x, y] of 16 bit, lines from the bottom, in units by their
    codes (-1 nm, -2 µm, -3 mm, 3 V); ``signal`` is the number of the converter (0 height, 1 DFL, 11
    phase)."""
    nx, ny = steps.shape
    scale = PIXEL * {-1: 1e9, -2: 1e6, -3: 1e3}[xy_unit]
    axes = struct.pack("<ffhffhffh", 0.0, scale, xy_unit, 0.0, scale, xy_unit, 0.0, z_step, z_unit)
    body = axes + struct.pack("<BBHH", signal, 0, nx, ny) + struct.pack("<HHHH", 0, nx, ny, 0)
    body += steps.T.astype("<i2").tobytes()
    return struct.pack("<IHBB6HH", 22 + len(body), 0, 0, 1, 2020, 1, 1, 10, 0, 0, 36) + body


def mdt(path: Path, *frames: bytes) -> None:
    """NT-MDT: a deflection before the heights."""
    frames = frames or (mdt_frame(1, STEPS[::-1], 1e-3), mdt_frame(0, STEPS, STEP * 1e9))
    head = struct.pack("<II4sH18sB", 0xFF93B001, sum(map(len, frames)), b"", len(frames) - 1, b"", 0)
    path.write_bytes(head + b"".join(frames))


def mi(path: Path) -> None:
    """Molecular Imaging: two buffers, lines from the bottom, as shares of a range."""
    keys = [
        ("fileType", "Image"),
        ("xPixels", NX),
        ("yPixels", NY),
        ("xLength", SIZE[0]),
        ("yLength", SIZE[1]),
        ("bufferLabel", "Topography"),
        ("bufferUnit", "nm"),
        ("bufferRange", 32768 * STEP * 1e9),
        ("bufferLabel", "Deflection"),
        ("bufferUnit", "V"),
        ("bufferRange", 10.0),
        ("data", "BINARY"),
    ]
    head = "".join(f"{key:14s}{value}\n" for key, value in keys)
    path.write_bytes(head.encode() + STEPS.T.astype("<i2").tobytes() + STEPS.T[::-1].astype("<i2").tobytes())


def wsxm(path: Path) -> None:
    """WSxM: the picture turned by half a turn."""
    body = (ROWS[::-1, ::-1] * STEP * 1e9).astype("<f8").tobytes()
    head = (
        "WSxM file copyright Nanotec Electronica\r\nSxM Image file\r\nImage header size: 400\r\n\r\n[Control]\r\n\r\n"
        f"    X Amplitude: {SIZE[0] * 1e9:g} nm\r\n    Y Amplitude: {SIZE[1] * 1e9:g} nm\r\n\r\n[General Info]\r\n\r\n"
        f"    Image Data Type: double\r\n    Number of columns: {NX}\r\n    Number of rows: {NY}\r\n"
        f"    Z Amplitude: {float(np.ptp(ROWS)) * STEP * 1e9:g} nm\r\n\r\n[Miscellaneous]\r\n\r\n"
        f"    Maximum: {float(ROWS.max())}\r\n    Minimum: {float(ROWS.min())}\r\n\r\n[Header end]\r\n"
    )
    path.write_bytes(head.encode() + body)


def nhf(path: Path) -> None:
    """Nanosurf: HDF5, whole numbers between two heights, lines from the bottom."""
    import h5py

    top, steps = 2**31 - 1, STEPS.astype(np.int32)
    with h5py.File(path, "w") as file:
        segment = file.create_group("group_0000/subgroup_0000")
        segment.parent.attrs["rect_axis_range"] = SIZE
        segment.attrs.update({"segment_name": "Forward", "rect_axis_size": [NX, NY]})
        data = segment.create_dataset("dataset_0000", data=steps.T.ravel())
        limits = {"signal_calibration_min": -(top + 1) * STEP, "signal_calibration_max": top * STEP}
        data.attrs.update({"signal_name": "Topography", "signal_calibration_unit": "Meter (m)", **limits})


# Arrays, pictures and texts.


def nc(path: Path) -> None:
    """NetCDF as SurfaceTopography writes it."""
    from scipy.io import netcdf_file

    with netcdf_file(path, "w", version=2) as file:
        for name, n, side in zip("xy", (NX, NY), SIZE, strict=True):
            file.createDimension(name, n)
            axis = file.createVariable(name, "f8", (name,))
            axis[:] = np.arange(n) * PIXEL
            axis.length, axis.periodic, axis.unit = np.float64(side), np.int32(0), b"m"
        heights = file.createVariable("heights", "f8", ("x", "y"))
        heights[:], heights.unit = HEIGHTS[:, ::-1], b"m"


def npy(path: Path) -> None:
    """NumPy array [x, y]."""
    np.save(path, STEPS.astype(float))


def npz(path: Path) -> None:
    """Archive of one NumPy array [x, y]."""
    np.savez(path, heights=STEPS.astype(float))


def mat(path: Path) -> None:
    """Matlab, version 5."""
    from scipy.io import savemat

    savemat(path, {"heights": STEPS.astype(float)})


def h5(path: Path) -> None:
    """HDF5 with one array."""
    import h5py

    with h5py.File(path, "w") as file:
        file["heights"] = STEPS.astype(float)


def xyz(path: Path) -> None:
    """Points x y z in m, line by line from the top."""
    points = [(i * PIXEL, j * PIXEL, HEIGHTS[i, j]) for j in range(NY - 1, -1, -1) for i in range(NX)]
    path.write_text("".join(f"{x:.9e} {y:.9e} {z:.9e}\n" for x, y, z in points), encoding="ascii")


def text_export(path: Path) -> None:
    """Text export of Gwyddion, which states size and unit."""
    head = f"# Channel: Z\n# Width: {SIZE[0] * 1e6:g} µm\n# Height: {SIZE[1] * 1e6:g} µm\n# Value units: nm\n"
    path.write_text(head + "".join(" ".join(map(str, row)) + "\n" for row in ROWS), encoding="utf-8")


def _table(path: Path, mark: str, comma: str = ".", encoding: str = "utf-8", head: str = "") -> None:
    rows = "".join(mark.join(f"{value:.1f}".replace(".", comma) for value in row) + "\n" for row in ROWS)
    path.write_text(head + rows, encoding=encoding)


def with_coordinates(path: Path) -> None:
    """Matrix whose first row and column hold x and y in µm, y downwards."""
    x, y = np.arange(NX) * PIXEL * 1e6, (NY - 1 - np.arange(NY)) * PIXEL * 1e6
    lines = ["\t".join(["", *(f"{one:g}" for one in x)])]
    lines += ["\t".join([f"{one:g}", *map(str, row)]) for one, row in zip(y, ROWS, strict=True)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def points(path: Path) -> None:
    """Points with columns that state their units, not in order, in a spreadsheet's dialect."""
    order = np.random.default_rng(2).permutation(NX * NY)
    lines = ["Intensity;X [um];Y [um];Height [nm]"]
    for number in order:
        i, j = divmod(int(number), NY)
        values = (1.0, i * PIXEL * 1e6, j * PIXEL * 1e6, float(STEPS[i, j]))
        lines.append(";".join(f"{value:.3f}".replace(".", ",") for value in values))
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def png(path: Path) -> None:
    """Grey levels of 16 bit."""
    from PIL import Image

    Image.fromarray(ROWS.astype(np.uint16)).save(path)


def tif(path: Path) -> None:
    """Heights of 32-bit floating point."""
    from PIL import Image

    Image.fromarray(ROWS.astype(np.float32)).save(path)


def zipped(path: Path) -> None:
    """A simple field in a zip archive, with a note."""
    inner = path.with_suffix(".gsf")
    gsf(inner)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.write(inner, "scan.gsf")
        archive.writestr("README.txt", "one scan")
    inner.unlink()


def gzipped(path: Path) -> None:
    """A text export, compressed."""
    import gzip

    inner = path.with_suffix("")
    text_export(inner)
    stream = io.BytesIO()
    with gzip.GzipFile(fileobj=stream, mode="wb", mtime=0) as packed:
        packed.write(inner.read_bytes())
    path.write_bytes(stream.getvalue())
    inner.unlink()


_SCALE = {"size": SIZE, "height_unit": "nm"}
_METRES = {"lateral_unit": "m", "height_unit": "m"}
_SINGLE = 2e-7  # of numbers of 32 bit, and of scales that are such numbers

KINDS = (
    Kind("Gwyddion", "gwy", gwy),
    Kind("Gwyddion simple field", "gsf", gsf, digits=_SINGLE),
    Kind("ISO 25178-72", "x3p", x3p),
    Kind("ISO 25178-71, text", "sdf", sdf_text),
    Kind("ISO 25178-71, binary", "sdf", sdf_binary),
    Kind("Digital Surf", "sur", sur, digits=_SINGLE),
    Kind("OmniSurf3D", "os3d", os3d, digits=_SINGLE),
    Kind("Alicona", "al3d", al3d, digits=_SINGLE),
    Kind("Sensofar", "plu", plu, digits=_SINGLE),
    Kind("Sensofar, archive", "plux", plux, digits=_SINGLE),
    Kind("Wyko", "opd", opd, digits=_SINGLE),
    Kind("NanoFocus", "nms", nms, digits=_SINGLE),
    Kind("TrueMap", "tmd", tmd, digits=_SINGLE),
    Kind("Zeta", "zmg", zmg, digits=_SINGLE),
    Kind("BCR-STM", "bcr", bcr),
    Kind("Asylum", "ibw", ibw, digits=_SINGLE),
    Kind("NT-MDT", "mdt", mdt, digits=_SINGLE),
    Kind("Molecular Imaging", "mi", mi),
    Kind("WSxM", "stp", wsxm),
    Kind("Nanosurf", "nhf", nhf, digits=1e-6),
    Kind("NetCDF", "nc", nc),
    Kind("NumPy", "npy", npy, _SCALE),
    Kind("NumPy, archive", "npz", npz, _SCALE),
    Kind("Matlab", "mat", mat, _SCALE),
    Kind("HDF5", "h5", h5, _SCALE),
    Kind("points x y z", "xyz", xyz, _METRES, digits=1e-9),
    Kind("points, named columns, decimal commas", "csv", points),
    Kind("text export of Gwyddion", "txt", text_export),
    Kind("matrix, blanks", "txt", lambda path: _table(path, " "), _SCALE),
    Kind("matrix, semicolons and decimal commas", "csv", lambda path: _table(path, ";", ","), _SCALE),
    Kind("matrix, tabs, UTF-16", "txt", lambda path: _table(path, "\t", encoding="utf-16"), _SCALE),
    Kind(
        "matrix under a head of a profiler",
        "csv",
        lambda path: _table(
            path, ",", head=f'"Model","50x"\n"XY calibration","{PIXEL * 1e9:g}","nm/pixel"\n"Unit","nm"\n'
        ),
    ),
    Kind("matrix with coordinates", "tsv", with_coordinates, {"lateral_unit": "um", "height_unit": "nm"}),
    Kind("picture, 16 bit", "png", png, {"size": SIZE, "z_scale": 65535 * STEP}),
    Kind("picture, floating point", "tif", tif, _SCALE, digits=_SINGLE),
    Kind("zip archive of a simple field", "zip", zipped, digits=_SINGLE),
    Kind("text export, compressed", "txt.gz", gzipped),
)
"""Kinds of files, each with the same map."""


def written(folder: Path) -> dict[str, Path]:
    """Every kind written to a ``folder``, by name."""
    found = {}
    for number, kind in enumerate(KINDS):
        found[kind.name] = folder / f"{number:02d}.{kind.ending}"
        kind.write(found[kind.name])
    return found
