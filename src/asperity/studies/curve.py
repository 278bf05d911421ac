"""Measured curves: columns of a CSV file with units in its head."""

from __future__ import annotations

import csv
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..core import units
from ..core.arrays import RealArray
from ..core.errors import FileFormatError, InputError
from ..core.text import read_text
from ..io.schemas.problem import LOADS
from .documents import LoadedStudy
from .places import locate
from .plan import measures

_HEAD = re.compile(r"\s*([\w.]+)\s*(?:\[(.*)\]|\((.*)\))?\s*")


class Curve(NamedTuple):
    """A measured curve, SI: what is prescribed (``path``, ``loads`` (n,) and their texts), the
    ``values`` of each quantity (n,) and their standard ``deviations``."""

    path: str
    loads: RealArray
    texts: tuple[str, ...]
    values: dict[str, RealArray]
    deviations: dict[str, RealArray]


def read_curve(path: Path, study: LoadedStudy, noise: float) -> Curve:
    """The curve in the CSV file at ``path``, such as ``force (mN),approach (nm)``: first what is
    prescribed, then quantities; ``approach_deviation (nm)`` is the standard deviation, else the
    share ``noise`` of each value.

    Raises
    ------
    FileFormatError
        If the file is missing or not a table of numbers.
    InputError
        If a column is unknown or has no unit.
    """
    rows = list(csv.reader(line for line in read_text(path, "curve").splitlines() if line.strip()[:1] not in ("", "#")))
    if len(rows) < 2 or len(rows[0]) < 2:
        raise FileFormatError(f"curve must hold a head and rows of two columns or more, but {path} does not.")
    try:
        numbers = np.array([[float(cell) for cell in row] for row in rows[1:]])
    except ValueError as error:
        raise FileFormatError(f"curve {path} must hold rows of equally many numbers, but does not: {error}.") from None
    named = [_named(cell) for cell in rows[0]]
    first, unit = named[0]
    path_of_load = f"control.{first}" if first in LOADS else first
    place = locate(study.problem, path_of_load)
    loads = numbers[:, 0] * _factor(unit, place.unit, f"column {first} of the curve")
    known, values, deviations = measures(), dict[str, RealArray](), dict[str, RealArray]()
    for (name, unit), column in zip(named[1:], numbers.T[1:], strict=True):
        quantity = name.removesuffix("_deviation")
        if quantity not in known:
            raise InputError(
                f"column {name} of the curve must be a quantity of studies, such as approach, area_fraction_corrected "
                "or force, but is none."
            )
        into = values if quantity == name else deviations
        into[quantity] = column * _factor(unit, known[quantity].unit, f"column {name} of the curve")
    for name, column in values.items():
        deviations.setdefault(name, noise * np.abs(column))
        if not np.all(deviations[name] > 0.0):
            raise InputError(f"deviation of {name} in the curve must be above zero, but is zero for a value of zero.")
    texts = tuple(str(place.written(float(load))) for load in loads)
    return Curve(path_of_load, loads, texts, values, deviations)


def _named(cell: str) -> tuple[str, str]:
    """Name and unit in the head of a column."""
    head = _HEAD.fullmatch(cell)
    return (cell, "") if head is None else (head[1], (head[2] or head[3] or "").strip())


def _factor(unit: str, si: str, what: str) -> float:
    if not unit and si == "1":
        return 1.0
    if not unit:
        raise InputError(f"{what} must have its unit in brackets, such as ({si}), but has none.")
    return units.parse(f"1 {unit}", "number", what) if si == "1" else units.parse_in(f"1 {unit}", si, what)
