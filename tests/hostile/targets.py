"""What is attacked: every format and document that the package reads, each with sound examples and
the commands that read it."""

from __future__ import annotations

import copy
import gzip
import io
import json
import struct
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import tomli_w
from cli.conftest import BODY, LOAD
from cli.test_same_numbers import DOCUMENTS
from hostile import mutate
from messages.bad_input import CONTACT
from PIL import Image
from study_cases import LOADS, SEEDS, InProcess, study

import asperity as asp

Damage = Callable[[bytes, Random], bytes]
Arguments = tuple[str, ...]
SCALE = ("--size", "8um x 6um", "--height-unit", "nm")
DAMAGED = "damaged"
"""Stem of the damaged file, and in commands the place of its name."""


@dataclass(frozen=True)
class Target:
    """Sound ``examples`` of a kind of file by their names, how they are damaged, and the
    ``commands`` that read them."""

    examples: Mapping[str, bytes]
    damage: Damage
    commands: tuple[Arguments, ...]

    def mutant(self, folder: Path, random: Random) -> Arguments:
        """Write a damaged example into ``folder``; the command that reads it."""
        name = random.choice(sorted(self.examples))
        path = folder / f"{DAMAGED}{Path(name).suffix}"
        path.write_bytes(self.damage(self.examples[name], random))
        return tuple(path.name if word == DAMAGED else word for word in random.choice(self.commands))


class Moduli(Target):
    """Files of moduli, read by a document beside them."""

    def mutant(self, folder: Path, random: Random) -> Arguments:
        """Write a damaged file and the document that names it into ``folder``; the command that
        reads it."""
        super().mutant(folder, random)
        body = {"relaxation": {"kind": "measured", "moduli_file": f"{DAMAGED}.csv"}, "poisson_ratio": 0.4}
        surface = {"kind": "sphere", "points": [8, 8], "size": "8 um", "radius": "20 um"}
        table = {"version": 2, "surface": surface, "body": body, "control": {"mean_pressure": "1 kPa"}}
        (folder / "moduli.toml").write_text(tomli_w.dumps(table), encoding="utf-8")
        return ("contact", "--from", "moduli.toml")


class Options(Target):
    """Command lines with words replaced, taken out, repeated or exchanged."""

    def mutant(self, folder: Path, random: Random) -> Arguments:
        """A command line; ``folder`` holds the examples, undamaged."""
        for name, content in self.examples.items():
            (folder / name).write_bytes(content)
        words = list(random.choice(self.commands))
        for _ in range(random.choice([1, 1, 2])):
            at = random.randrange(1, len(words))
            match random.randrange(6):
                case 0:
                    del words[at]
                case 1:
                    words.insert(at, words[random.randrange(1, len(words))])
                case 2:
                    words[at] = mutate.in_text(words[at].encode(), random).decode("utf-8", "replace")
                case 3:
                    words[at] = str(random.choice(mutate.NUMBERS[:9]))
                case 4:
                    words[at] = mutate.quantity(random)
                case _:
                    words[at] = random.choice(mutate.WORDS)
            if len(words) < 2:
                break
        return tuple(
            word for word in words if not word.startswith(("--out", "--dask", "--debug")) and "/" not in word[:3]
        )


class Campaigns(Target):
    """A finished study of which one file is damaged."""

    def mutant(self, folder: Path, random: Random) -> Arguments:
        """Write the whole campaign, with one file damaged."""
        (folder / "study").mkdir(exist_ok=True)
        hurt = random.choice(sorted(self.examples))
        for name, content in self.examples.items():
            (folder / "study" / name).write_bytes(self.damage(content, random) if name == hurt else content)
        return random.choice(self.commands)


def as_toml(data: bytes, random: Random) -> bytes:
    """The table in the JSON text ``data``, damaged, as TOML."""
    if random.random() < 0.3:
        return mutate.in_text(tomli_w.dumps(json.loads(data)).encode(), random)
    try:
        return tomli_w.dumps(mutate.in_table(json.loads(data), random)).encode("utf-8", "surrogatepass")
    except RecursionError:
        return tomli_w.dumps(json.loads(data)).encode()[: random.randrange(2000)]


def as_json(data: bytes, random: Random) -> bytes:
    """The table in the JSON text ``data``, damaged."""
    if random.random() < 0.3:
        return mutate.in_text(data, random)
    try:
        return json.dumps(mutate.in_table(json.loads(data), random)).encode()
    except (RecursionError, ValueError):  # too deep, or a number of too many digits
        return b"[" * random.choice([500, 100_000])


class Netcdf:
    """Damage through the HDF5 library, in the folder ``place``, or to the bytes."""

    def __init__(self, place: Path) -> None:
        self.place = place

    def __call__(self, data: bytes, random: Random) -> bytes:
        if random.random() < 0.2:
            return mutate.in_bytes(data, random)
        file = self.place / "under_the_knife.nc"
        file.write_bytes(data)
        mutate.in_netcdf(file, random)
        return file.read_bytes()


def heights() -> Any:
    return np.random.default_rng(1).normal(size=(12, 16))


def texts() -> dict[str, bytes]:
    """Heights as text in every form that is read."""
    rows = heights()
    matrix = "\n".join(" ".join(f"{z:.4g}" for z in row) for row in rows)
    points = [(x, y, rows[y, x]) for x in range(16) for y in range(12)]
    return {
        "matrix.txt": matrix.encode(),
        "matrix.csv": matrix.replace(" ", ",").encode(),
        "export.txt": f"# Channel: Z\n# Width: 4 µm\n# Height: 3 µm\n# Value units: nm\n{matrix}\n".encode(),
        "list.xyz": "\n".join(f"{0.5 * x} {0.5 * y} {z:.4g}" for x, y, z in points).encode(),
        "list.csv": ("x (µm);y (µm);z (nm)\n" + "\n".join(f"{0.5 * x};{0.5 * y};{z:.4g}" for x, y, z in points))
        .replace(".", ",")
        .encode(),
        "head.csv": (
            '"Model","50x"\n"XY calibration","500","nm/pixel"\n"Unit","nm"\n' + matrix.replace(" ", ",")
        ).encode(),
        "quoted.csv": "\n".join(",".join(f'"{v}"' for v in row.split()) for row in matrix.splitlines()).encode(),
    }


def arrays(folder: Path) -> dict[str, bytes]:
    """Heights as array and picture."""
    np.save(folder / "a.npy", heights())
    for ending in ("png", "tiff"):
        Image.fromarray((40 * heights() + 128).astype(np.uint8)).save(folder / f"a.{ending}")
    return {f"a.{ending}": (folder / f"a.{ending}").read_bytes() for ending in ("npy", "png", "tiff")}


def instruments() -> dict[str, bytes]:
    """Small files in the formats of instruments."""
    rows = heights()
    tags = {"Version": "1", "TagCount": "5", "Cols": "16", "Rows": "12", "DepthImageOffset": "700"}
    tags |= {"PixelSizeXMeter": "5e-7", "PixelSizeYMeter": "5e-7"}
    al3d = b"AliconaImaging\0\r\n" + b"".join(
        key.encode().ljust(20, b"\0") + text.encode().ljust(30, b"\0") + b"\r\n" for key, text in tags.items()
    )
    al3d = al3d.ljust(700, b"\0") + (1e-9 * rows).astype("<f4").tobytes()
    sdf = b"bISO-1.0" + struct.pack(
        "<10s12s12sHHddddBBB", b"none", b"010120261200", b"010120261200", 16, 12, 5e-7, 5e-7, 1e-9, -1.0, 0, 7, 0
    )
    nanoscope = (
        "\\*File list\r\n\\Version: 0x05310001\r\n\\*Ciao scan list\r\n\\Scan size: 1000 nm\r\n\\*Scanner list\r\n"
        "\\@Sens. Zscan: V 8.66 nm/V\r\n\\*Ciao image list\r\n\\Data offset: 1024\r\n\\Data length: 384\r\n"
        "\\Bytes/pixel: 2\r\n\\Samps/line: 16\r\n\\Number of lines: 12\r\n"
        "\\Aspect ratio: 1:1\r\n\\Scan size: 1 1 ~m\r\n"
        '\\@2:Image Data: S [Height] "Height"\r\n\\@2:Z scale: V [Sens. Zscan] (0.006713867 V/LSB) 440.0 V\r\n'
        "\\*File list end\r\n\x1a"
    ).encode("latin-1")
    field = b"Gwyddion Simple Field 1.0\nXRes=16\nYRes=12\nXReal=8e-6\nYReal=6e-6\nXYUnits=m\nZUnits=nm\n"
    field = field + b"\0" * (4 - len(field) % 4) + rows.astype("<f4").tobytes()
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr("a.gsf", field)
    return {
        "a.al3d": al3d,
        "a.sdf": sdf + rows.astype("<f8").tobytes(),
        "a.di": nanoscope.ljust(1024, b"\0") + (100 * rows).astype("<i2").tobytes(),
        "a.gsf": field,
        "a.gsf.gz": gzip.compress(field),
        "a.zip": packed.getvalue(),
    }


def solved(folder: Path) -> dict[str, bytes]:
    """Results of documents of every kind."""
    from asperity.run.stored import save_outcome

    for name in ("layered hardness", "path", "film", "stress"):
        save_outcome(asp.run(small(DOCUMENTS[name])), folder / f"{name}.nc")
    return {path.name: path.read_bytes() for path in folder.glob("*.nc")}


def small(table: dict[str, Any]) -> dict[str, Any]:
    """``table`` on a coarse grid."""
    made = copy.deepcopy(table)
    for name in ("surface", "counter_surface"):
        if name in made:
            made[name]["points"] = [16, 16 if made[name]["points"][1] > 1 else 1]
    return made


def campaign(folder: Path) -> dict[str, bytes]:
    """Files of a finished study."""
    from asperity.studies.campaign import prepare_study
    from asperity.studies.run import carry_out

    made = prepare_study(STUDIES["grid"], folder / "study")
    carry_out(made.plan, folder / "study" / "records.log", InProcess())
    return {path.name: path.read_bytes() for path in (folder / "study").iterdir() if path.is_file()}


PROBLEM = small({**study()["problem"], "solver": {"threads": 1}})
STUDIES: dict[str, dict[str, Any]] = {
    "grid": {**study(), "problem": PROBLEM, "axes": [LOADS, {**SEEDS, "values": [1, 2]}]},
    "samples": {
        **study(),
        "problem": PROBLEM,
        "monte_carlo": {
            "samples": 4,
            "seed": 1,
            "random": [
                {"path": "surface.seed", "distribution": "seed"},
                {"path": "control.mean_pressure", "distribution": "uniform", "low": "1 MPa", "high": "9 MPa"},
            ],
        },
    },
}
MATERIALS = {
    "material": {
        "glass": {"youngs_modulus": {"value": "70 GPa", "source": "own"}, "poisson_ratio": 0.2, "aliases": ["g"]},
        "film": {"youngs_modulus": "140 GPa", "poisson_ratio": 0.3, "hardness": "9 GPa", "note": "thin"},
        "rubber": {
            "youngs_modulus": {"value": "3 MPa + 10 MPa @ 10 ms + 3 MPa @ 0.1 s", "source": "own"},
            "poisson_ratio": 0.45,
            "elastic_bulk": True,
            "shift": "WLF 298 K; 8.86; 101.6 K",
        },
    }
}
MODULI = "# own\nfrequency (Hz), storage modulus (MPa), loss modulus (MPa)\n" + "".join(
    f"{10.0**k:g}, {3.0 + k}, {0.3 * k + 0.1:.3g}\n" for k in range(6)
)
SOUND = (
    (
        "contact",
        "matrix.txt",
        *SCALE,
        *BODY,
        *LOAD,
        "--hardness",
        "body",
        "--crop",
        "0um:4um,1um:6um",
        "--resample",
        "8x6",
    ),
    (
        "contact",
        "matrix.txt",
        *SCALE,
        "--body",
        "DLC:5nm~/Cr:2nm/steel",
        "--counter-body",
        "E=1GPa,nu=0.4:1um/rigid",
        *LOAD,
    ),
    ("info", "list.csv", "--lateral-unit", "um", "--height-unit", "nm"),
    ("info", "matrix.txt", *SCALE, "--channel", "0"),
    ("theory", "hertz", "--radius", "1mm", "--force", "1N", *BODY),
    (
        "theory",
        "greenwood-williamson",
        "--pressure",
        "1MPa",
        "--radius",
        "1um",
        "--sigma",
        "1nm",
        "--density",
        "1/um^2",
    ),
    ("materials", "steel", "--json"),
    ("generate", "rough", "--points", "16x12", "--size", "8um", "--seed", "1", "--rms-height", "1nm", "--hurst", "0.8"),
)
LINES = (*SOUND * 20, *(("contact", "matrix.txt", *SCALE, *options) for options in CONTACT))


BALL = {
    "version": 2,
    "surface": {"kind": "sphere", "points": [16, 16], "size": "60 um", "radius": "100 um"},
    "body": "E=0.91MPa,nu=0.3",
    "boundary": {"kind": "free"},
    "control": {"approach": "0.3 um"},
    "solver": {"threads": 1},
}
RUBBER = small(DOCUMENTS["sliding over rubber"])
LOOP = {"work": "50 mJ/m**2", "strength": "60 kPa", "retract": "0.6 um", "steps": 3}
ADHESIVE: dict[str, dict[str, Any]] = {
    "loop": {**BALL, "adhesion": {**LOOP, "law": "dugdale", "cycles": 2, "stiffness": "10 N/m"}},
    "branch": {**BALL, "adhesion": {**LOOP, "branch": True, "jump_tolerance": "0.1 um"}},
    "pair": {**BALL, "adhesion": {"pair": "polystyrene/paraffin wax", "range": "0.5 um", "law": "linear"}},
    "core": {**BALL, "adhesion": {"work": "50 mJ/m**2", "range": "0.8 um", "law": "lennard-jones"}},
    "spacing": {
        **BALL,
        "adhesion": {"work": "50 mJ/m**2", "law": "van der waals", "range": "0.5 um"},
        "control": {"force": "10 uN"},
    },
    "no range": {**BALL, "adhesion": {"work": "50 mJ/m**2", "law": "jkr"}, "control": {"force": "10 uN"}},
    "rough": {**small(DOCUMENTS["plain"]), "adhesion": {"work": "10 mJ/m**2", "range": "5 nm"}},
}
SLIDING: dict[str, dict[str, Any]] = {
    "distance": {**RUBBER, "hysteresis": {**RUBBER["hysteresis"], "distance": "4 um"}},
    "curve": {
        **RUBBER,
        "hysteresis": {"speed": "1 mm/s", "slowest": "0.1 mm/s", "fastest": "10 mm/s", "points": 2, "reduction": 0.7},
    },
    "sticky": {
        **RUBBER,
        "adhesion": {"work": "10 mJ/m**2", "range": "5 nm"},
        "hysteresis": {"speed": "1 mm/s", "distance": "4 um", "steps_per_pixel": 1},
    },
    "roller": {
        **BALL,
        "body": "rigid",
        "counter_body": "E=3MPa+3MPa@0.1s,nu=0.5",
        "control": {"force": "1 uN"},
        "hysteresis": {"speed": "20 um/s"},
    },
}
"""Documents with the tables [adhesion] and [hysteresis], in which every key of theirs is found."""


READ: tuple[Arguments, ...] = (("info", DAMAGED, *SCALE), ("info", DAMAGED))
SOLVE: tuple[Arguments, ...] = (("contact", "--from", DAMAGED),)
REPORT: tuple[Arguments, ...] = (("export", DAMAGED, "--csv", "x.csv", "--force"), ("cite", DAMAGED), ("info", DAMAGED))
MATERIAL: tuple[Arguments, ...] = (
    ("materials", "--file", DAMAGED),
    ("materials", "glass", "--file", DAMAGED, "--json"),
)


def in_json(tables: Mapping[str, Any], ending: str) -> dict[str, bytes]:
    return {f"{name}.{ending}": json.dumps(table).encode() for name, table in tables.items()}


def documents() -> dict[str, Any]:
    return {name: small(table) for name, table in DOCUMENTS.items()}


def surface(folder: Path) -> dict[str, bytes]:
    """A surface as this package writes it."""
    asp.files.save_surface(asp.Surface(1e-9 * heights().T, 5e-7), folder / "map.nc")
    return {"map.nc": (folder / "map.nc").read_bytes()}


TARGETS: Mapping[str, Callable[[Path], Target]] = {
    "problem documents (TOML)": lambda _: Target(in_json(documents(), "toml"), as_toml, SOLVE),
    "problem documents (JSON)": lambda _: Target(in_json(documents(), "json"), as_json, SOLVE),
    "documents of adhesion": lambda _: Target(in_json(ADHESIVE, "toml"), as_toml, SOLVE),
    "documents of sliding": lambda _: Target(in_json(SLIDING, "toml"), as_toml, SOLVE),
    "study documents": lambda _: Target(in_json(STUDIES, "toml"), as_toml, (("run", DAMAGED),)),
    "finished studies": lambda folder: Campaigns(
        campaign(folder), mutate.in_text, (*[("status", "study")] * 9, ("collect", "study"))
    ),
    "material files": lambda _: Target(in_json({"own": MATERIALS}, "toml"), as_toml, MATERIAL),
    "files of moduli": lambda _: Moduli({"moduli.csv": MODULI.encode()}, mutate.in_text, (("contact", DAMAGED),)),
    "text matrices and lists": lambda _: Target(
        texts(), mutate.in_text, (*READ, ("info", DAMAGED, "--lateral-unit", "um"))
    ),
    "arrays and pictures": lambda folder: Target(arrays(folder), mutate.in_bytes, READ),
    "instrument files": lambda _: Target(instruments(), mutate.in_bytes, READ),
    "surfaces (NetCDF)": lambda folder: Target(surface(folder), mutate.in_bytes, READ),
    "results (NetCDF-4)": lambda folder: Target(solved(folder), Netcdf(folder), REPORT),
    "command lines": lambda _: Options(
        {name: text for name, text in texts().items() if name in ("matrix.txt", "list.csv")}, mutate.in_text, LINES
    ),
}
"""Every target by name, made in an empty folder."""
