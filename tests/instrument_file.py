"""Small files in formats of instruments."""

from __future__ import annotations

import struct
import zipfile
from pathlib import Path

import numpy as np

from asperity.core.arrays import RealArray


def bcr(path: Path) -> RealArray:
    """Write a small map in a format of instruments (BCR-STM), the 26th that the library tries; its
    heights [x, y], y upwards."""
    steps = np.random.default_rng(3).integers(-500, 500, (6, 9)).astype("<i2")  # top row first
    header = (
        "fileformat = bcrstm\nheadersize = 2048\nxpixels = 9\nypixels = 6\nxlength = 90\nylength = 60\nxunit = nm\n"
    )
    header += "yunit = nm\nzunit = nm\nbit2nm = 0.5\nxoffset = 0\nyoffset = 0\nintelmode = 1\n"
    path.write_bytes(header.encode().ljust(2048, b" ") + steps.tobytes())
    return 0.5e-9 * steps[::-1].T


def ibw(path: Path, data: RealArray, names: list[str], pixel: float = 1e-8) -> None:
    """Write channels (nx, ny, number) as an Igor binary wave as Asylum's microscopes do, every one
    "in m"."""
    nx, ny, count = data.shape
    wave = bytearray(320)
    struct.pack_into("<I", wave, 12, nx * ny * count)
    struct.pack_into("<h", wave, 16, 2)
    wave[28:32] = b"topo"
    struct.pack_into("<4i", wave, 68, nx, ny, count, 0)
    struct.pack_into("<4d", wave, 84, pixel, pixel, 1.0, 1.0)
    wave[148:149] = wave[152:153] = wave[156:157] = b"m"
    labels = b"".join(name.encode().ljust(32, b"\0") for name in ["", *names])
    raw = data.astype("<f4").tobytes(order="F")
    head = bytearray(64)
    struct.pack_into("<h", head, 0, 5)
    struct.pack_into("<i", head, 4, 320 + len(raw))
    struct.pack_into("<4i", head, 36, 0, 0, len(labels), 0)
    total = sum(struct.unpack("<192h", bytes(head) + bytes(wave))) & 0xFFFF
    struct.pack_into("<H", head, 2, (-total) & 0xFFFF)
    path.write_bytes(bytes(head) + bytes(wave) + raw + labels)


def nms(path: Path, shape: tuple[int, int] = (64, 48), spacing: float = 312.5) -> None:
    """Write a NanoFocus confocal scan whose ``spacing`` is in nm."""
    nx, ny = shape
    head = bytearray(3468)
    struct.pack_into("<4I", head, 0, 2, 1, 0, 0xFFFF)
    struct.pack_into("<2d", head, 16, 6.32123, 8.28037)
    struct.pack_into("<2I", head, 1368, nx, ny)
    struct.pack_into("<2d", head, 1376, spacing, spacing)
    steps = np.random.default_rng(0).integers(1, 65535, nx * ny).astype("<u2")
    path.write_bytes(bytes(head) + steps.tobytes() + bytes(nx * ny))


def x3p(path: Path, revision: str = "ISO5436 - 2000", date: str = "2020-01-01T00:00:00", folder: str = "") -> RealArray:
    """Write a map of 5 x 4 points in the format of ISO 25178-72; its heights [x, y], y upwards."""
    rows = np.arange(20).reshape(4, 5) * 1e-8  # top row first
    axes = "".join(
        f"<C{name}><AxisType>{kind}</AxisType><DataType>D</DataType><Increment>{step}</Increment><Offset>0</Offset></C{name}>"
        for name, kind, step in (("X", "I", 1e-6), ("Y", "I", 1e-6), ("Z", "A", 1))
    )
    instrument = (
        "<Instrument><Manufacturer>m</Manufacturer><Model>x</Model><Serial>s</Serial><Version>v</Version></Instrument>"
    )
    text = (
        '<?xml version="1.0" encoding="UTF-8"?><p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2">'
        f"<Record1><Revision>{revision}</Revision><FeatureType>SUR</FeatureType><Axes>{axes}</Axes></Record1>"
        f"<Record2><Date>{date}</Date>{instrument}</Record2>"
        "<Record3><MatrixDimension><SizeX>5</SizeX><SizeY>4</SizeY><SizeZ>1</SizeZ></MatrixDimension><DataLink>"
        "<PointDataLink>bindata/data.bin</PointDataLink></DataLink></Record3></p:ISO5436_2>"
    )
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr(f"{folder}main.xml", text)
        archive.writestr(f"{folder}bindata/data.bin", rows.astype("<f8").tobytes())
    return rows[::-1].T


def gwy(path: Path, fields: list[tuple[str, RealArray]], unit: str = "") -> None:
    """Write fields (title, heights [x, y]) as a Gwyddion file of 1 x 1 of its ``unit`` a pixel; no
    unit if that is empty."""

    def part(name: str, kind: str, content: bytes) -> bytes:
        return name.encode() + b"\0" + kind.encode() + content

    def made(name: str, *parts: bytes) -> bytes:
        return name.encode() + b"\0" + struct.pack("<I", sum(map(len, parts))) + b"".join(parts)

    units = made("GwySIUnit", part("unitstr", "s", unit.encode() + b"\0"))
    parts = []
    for number, (title, heights) in enumerate(fields):
        nx, ny = heights.shape
        numbers = heights[:, ::-1].T.astype("<f8").tobytes()
        field = made(
            "GwyDataField",
            part("xres", "i", struct.pack("<i", nx)),
            part("yres", "i", struct.pack("<i", ny)),
            part("xreal", "d", struct.pack("<d", float(nx))),
            part("yreal", "d", struct.pack("<d", float(ny))),
            part("data", "D", struct.pack("<I", nx * ny) + numbers),
            *((part("si_unit_xy", "o", units), part("si_unit_z", "o", units)) if unit else ()),
        )
        parts += [part(f"/{number}/data", "o", field), part(f"/{number}/data/title", "s", title.encode() + b"\0")]
    path.write_bytes(b"GWYP" + made("GwyContainer", *parts))
