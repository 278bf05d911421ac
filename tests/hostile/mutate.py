"""Damage of every kind: to bytes, to text, to nested tables, to NetCDF-4 files. The same seed gives
the same damage."""

from __future__ import annotations

import copy
import re
from pathlib import Path
from random import Random
from typing import Any

import h5py
import numpy as np

NUMBERS: tuple[Any, ...] = (
    *(0, -1, 1, 2, 10**9, 10**18, -(10**18), 2**31, 2**63, 10**400, True),
    *(0.0, -0.0, 1e-320, 1e308, -1e308, 1e160, 1e-160, float("nan"), float("inf"), -float("inf"), 0.5, 1e-9),
)
UNITS = (
    "m",
    "nm",
    "Pa",
    "GPa",
    "N",
    "%",
    "K",
    "kPq",
    "m*9**9**9**9",
    "m/s",
    "µm",
    "um",
    "N/m",
    "deg",
    "1/m",
    "m^1e9",
    "",
)
WORDS = (
    *(
        "",
        " ",
        "x",
        "-",
        "--",
        "/",
        "..",
        "../..",
        "/dev/zero",
        "/dev/null",
        "~",
        "none",
        "nan",
        "inf",
        "true",
        "²",
        "٣",
        "½",
    ),
    *("\x00", "\x1b[31mred\x1b[0m", "\r\n", "\t", "‮", "é" * 300, "a" * 300, "a.b" * 3000, "1e400", "9" * 400, "0x10"),
    *(
        "1_000",
        "١٢ nm",
        "${HOME}",
        "%s%n",
        "{0}",
        "<script>",
        "[bold]x[/bold]",
        "DLC:5nm/steel",
        "E=1GPa,nu=0.3",
        "50 MPa",
    ),
    *(
        "5 nm",
        "1e-300 m",
        "1e300 m",
        "-3 nm",
        "0 Pa",
        "1,5 nm",
        "5  nm",
        "5e",
        "e5",
        "- 5 nm",
        "5 nm nm",
        "(5) nm",
        "5 nm;rm",
    ),
)


def quantity(random: Random) -> str:
    """Text with a number and a unit, either of them odd."""
    number = random.choice([*map(str, NUMBERS[1:8]), "1", "5", "1e-9", "1e300", "nan", "1e-300", "-2", "٣", "1_0"])
    return f"{number}{random.choice(['', ' ', '  '])}{random.choice(UNITS)}"


def value(random: Random) -> Any:
    """A value of any type where something else is expected."""
    kind = random.randrange(8)
    if kind < 2:
        return random.choice(NUMBERS)
    if kind < 4:
        return random.choice(WORDS)
    if kind < 6:
        return quantity(random)
    return random.choice(
        [[], [[]], {}, [1, "2"], {"kind": "sphere"}, {"a": {"b": []}}, [None][:0], nested(random), [0] * 5000]
    )


def nested(random: Random) -> Any:
    """Lists in lists, or tables in tables, some hundred deep."""
    inside: Any = 1
    for _ in range(random.choice([3, 90, 400])):
        inside = [inside] if random.random() < 0.5 else {"a": inside}
    return inside


def in_bytes(data: bytes, random: Random) -> bytes:
    """``data`` cut, with bytes turned, numbers replaced, parts repeated, taken out, exchanged or
    filled up."""
    changed = bytearray(data)
    for _ in range(random.choice([1, 1, 2, 4])):
        size = max(len(changed), 1)
        # headers are at the beginning
        at = random.randrange(size) if random.random() < 0.5 else random.randrange(min(size, 2048))
        length = random.choice([1, 2, 4, 8, 64, 512])
        match random.randrange(8):
            case 0:
                del changed[at:]
            case 1:
                changed[at : at + 1] = bytes([random.randrange(256)])
            case 2:
                extreme = random.choice([0, 1, -1, 2**31 - 1, -(2**31), 2**16, 10**6])
                changed[at : at + 4] = extreme.to_bytes(4, random.choice(["little", "big"]), signed=True)
            case 3:
                changed[at:at] = changed[at : at + length]
            case 4:
                del changed[at : at + length]
            case 5:
                changed[at : at + length] = bytes(length)
            case 6:
                changed[at : at + length] = random.randbytes(length)
            case _:
                text = random.choice(WORDS).encode("utf-8", "surrogatepass")
                changed[at : at + len(text)] = text
    return bytes(changed)


def in_text(data: bytes, random: Random) -> bytes:
    """``data``, which is text, with other numbers and words, lines taken out, repeated, exchanged
    or cut; or as bytes."""
    if random.random() < 0.3:
        return in_bytes(data, random)
    text = data.decode("utf-8")
    for _ in range(random.choice([1, 1, 2, 3])):
        lines = text.split("\n")
        line = random.randrange(len(lines))
        match random.randrange(7):
            case 0:
                del lines[line]
            case 1:
                lines.insert(line, lines[random.randrange(len(lines))])
            case 2:
                lines[line] = lines[line][: random.randrange(len(lines[line]) + 1)]
            case 3:
                other = random.randrange(len(lines))
                lines[line], lines[other] = lines[other], lines[line]
            case 4:
                lines[line] = lines[line].replace(
                    random.choice([" ", ".", ",", "=", ":", '"']), random.choice(["", ",", ";", "'"])
                )
            case 5:
                lines.insert(line, random.choice([*WORDS, f"{quantity(random)} = {quantity(random)}"]))
            case _:
                tokens = list(re.finditer(r"[^\s,;=\"\[\]]+", lines[line]))
                if tokens:
                    token = random.choice(tokens)
                    new = random.choice([random.choice(WORDS), quantity(random), str(random.choice(NUMBERS[:9]))])
                    lines[line] = lines[line][: token.start()] + new + lines[line][token.end() :]
        text = "\n".join(lines)
    return text.encode("utf-8", "surrogatepass")


QUANTITY = re.compile(r"[-+]?\d+(\.\d+)?(e[-+]?\d+)?", re.IGNORECASE)


def mild(old: Any, random: Random) -> Any:
    """A number or quantity of another size than ``old``; anything else as it is."""
    if isinstance(old, int) and not isinstance(old, bool):
        return random.choice([old + 1, max(old - 1, 1), 2 * old, 1])
    sizes = [
        1e-300,
        0.0,
        -1.0,
        0.5,
        1.0 + 1e-9,
        2.0,
        *(10.0 ** random.uniform(-most, most) for most in (1, 1, 3, 3, 30)),
    ]
    if isinstance(old, float):
        return old * random.choice(sizes)
    if not isinstance(old, str) or (number := QUANTITY.match(old)) is None:
        return old
    return f"{float(number[0]) * random.choice(sizes):.6g}{old[number.end() :]}"


def in_table(table: dict[str, Any], random: Random) -> dict[str, Any]:
    """``table`` with one or two values of other size in half of the cases, else with anything
    replaced, taken out, renamed."""
    changed = copy.deepcopy(table)
    if random.random() < 0.5:
        numbers = [at for at in _places(changed) if QUANTITY.match(str(at[0][at[1]]))]
        numbers = [
            at
            for at in numbers
            if at[1] != "version" and not (isinstance(at[0], list) and isinstance(at[0][at[1]], int))
        ]
        for parent, key in random.sample(numbers, min(random.choice([1, 1, 2]), len(numbers))):
            parent[key] = mild(parent[key], random)
        return changed
    for _ in range(random.choice([1, 1, 2, 3])):
        places = list(_places(changed))
        parent, key = random.choice(places)
        match random.randrange(6):
            case 0:
                del parent[key]
            case 1 if isinstance(parent, dict):
                parent[random.choice(WORDS)] = parent.pop(key)
            case 2:
                other, elsewhere = random.choice(places)
                parent[key] = copy.deepcopy(other[elsewhere])
            case 3 if isinstance(parent[key], str):
                parent[key] = in_text(parent[key].encode(), random).decode("utf-8", "replace")
            case 4 if isinstance(parent, dict):
                parent[
                    random.choice(["kind", "path", "steps", "x", "values", "count", "a.b", random.choice(WORDS)])
                ] = value(random)
            case _:
                parent[key] = value(random)
        if not changed:
            return {}
    return changed


def _places(inside: Any) -> Any:
    """Every (container, key) in nested tables and lists."""
    items = inside.items() if isinstance(inside, dict) else enumerate(inside) if isinstance(inside, list) else ()
    for key, child in items:
        yield inside, key
        yield from _places(child)


def in_netcdf(file: Path, random: Random) -> None:
    """Change attributes and variables of the NetCDF-4 ``file`` through the HDF5 library."""
    with h5py.File(file, "r+") as tree:
        names: list[str] = [""]
        tree.visit(names.append)
        for _ in range(random.choice([1, 1, 2])):
            name = random.choice(names)
            node: Any = tree[name] if name in tree else tree["/"]
            attributes = list(node.attrs)
            new = random.choice(
                [
                    *NUMBERS[:9],
                    *WORDS,
                    "{}",
                    "[]",
                    '{"type": "Magic"}',
                    "[" * 3000,
                    np.arange(3),
                    np.float32(1),
                    b"\xff",
                ]
            )
            new = float(new) if isinstance(new, int) and abs(new) > 2**62 and abs(new) < 10**300 else new
            try:
                if attributes and random.random() < 0.7:
                    key = random.choice(attributes)
                    old = node.attrs[key]
                    if random.random() < 0.25:
                        del node.attrs[key]
                    elif isinstance(old, str) and random.random() < 0.6:
                        node.attrs[key] = in_text(old.encode(), random).decode("utf-8", "replace")
                    else:
                        node.attrs[key] = new
                elif isinstance(node, h5py.Dataset) and node.dtype.kind == "f" and node.size and random.random() < 0.6:
                    numbers = node[...]
                    np.put(
                        numbers,
                        random.randrange(numbers.size),
                        random.choice([np.nan, np.inf, -1e308, 0.0, 1e-300]),
                    )
                    node[...] = numbers
                elif node.name != "/" and node.name in tree:
                    parent, own, dtype = (
                        node.parent,
                        node.name.rpartition("/")[2],
                        random.choice(["i1", "f8", "S3", "c16"]),
                    )
                    del parent[own]
                    if random.random() < 0.7:
                        parent.create_dataset(own, random.choice([(), (0,), (3,), (2, 2), (1, 2, 3)]), dtype)
            except (
                OSError,
                TypeError,
                ValueError,
                KeyError,
                OverflowError,
                RuntimeError,
            ):  # HDF5 refuses this damage itself
                continue
