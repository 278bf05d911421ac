"""Measured storage and loss moduli in text files: columns with their units in the headings."""

from __future__ import annotations

import math
import re
from pathlib import Path
from types import MappingProxyType

import numpy as np

from ..core import units
from ..core.arrays import RealArray
from ..core.errors import FileFormatError, UnitError
from ..core.text import read_text

COLUMNS = MappingProxyType({"frequency": "Hz", "angular frequency": "rad/s", "storage": "Pa", "loss": "Pa"})
"""First words of the headings, and the SI unit of each column; one of the two frequencies is
needed."""

EXAMPLE = "frequency (Hz), storage modulus (MPa), loss modulus (MPa)"

_HEADING = re.compile(
    r"\s*(frequency|angular frequency|storage|loss)\b[^()\[\]]*[(\[]([^()\[\]]+)[)\]]\s*", re.IGNORECASE
)


def read_moduli(path: str | Path) -> tuple[RealArray, RealArray, RealArray]:
    """Frequency (Hz), storage and loss modulus (Pa), each (n,), of the table in the text file at
    ``path``.

    The first line that is no comment (#) has the headings, such as
    ``frequency (Hz), storage modulus (MPa), loss modulus (MPa)``, in any order; an angular
    frequency (rad/s) may stand instead. Columns are separated by commas, semicolons or tabs; others
    are left out.

    FileFormatError if the file is missing, no text, or not such a table.
    """
    what = "file of storage and loss moduli"
    lines = [line for line in read_text(path, what).splitlines() if line.strip() and not line.lstrip().startswith("#")]
    if not lines:
        raise FileFormatError(f"{what} must hold a table such as {EXAMPLE!r}, but {path} is empty.")
    separator = next((mark for mark in ("\t", ";") if mark in lines[0]), ",")
    places: dict[str, tuple[int, float]] = {}
    for number, heading in enumerate(lines[0].split(separator)):
        match = _HEADING.fullmatch(heading)
        if match is not None:
            name = match[1].lower()
            try:
                places.setdefault(
                    name, (number, units.parse_in(f"1 {match[2].strip()}", COLUMNS[name], f"column {name}"))
                )
            except UnitError as error:
                raise FileFormatError(f"{what} {path}: {error}") from None
    frequencies = [name for name in ("frequency", "angular frequency") if name in places]
    if len(frequencies) != 1 or not {"storage", "loss"} <= places.keys():
        raise FileFormatError(
            f"headings of the {what} must be such as {EXAMPLE!r}, but {path} has {lines[0].strip()!r}."
        )
    taken = [places[name] for name in (*frequencies, "storage", "loss")]
    rows = []
    for number, line in enumerate(lines[1:], start=1):
        cells = line.split(separator)
        try:
            rows.append([float(cells[place]) * factor for place, factor in taken])
        except (ValueError, IndexError):
            raise FileFormatError(
                f"row {number} of the {what} {path} must hold numbers in all columns, but is {cells!r}."
            ) from None
    table = np.array(rows, dtype=float).reshape(-1, 3)
    rate = 1.0 if frequencies == ["frequency"] else 2.0 * math.pi
    return table[:, 0] / rate, table[:, 1], table[:, 2]
