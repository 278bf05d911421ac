"""Tables of numbers in text: matrices of heights and lists of points, with column names and decimal
commas."""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import InputError

_START = 1 << 16  # bytes in which a table must begin
_DECIMAL_COMMA = re.compile(r"[-+]?\d*,\d+([eE][-+]?\d+)?")
_STATED_LINES = re.compile(r"^#\s*y-pixels: (\d+)\s*$", re.MULTILINE)  # in the files that asperity writes
_OFF_GRID = 0.1  # of a step: coordinates are written with few digits
_SPARSE = 4  # nodes of the grid for every point of a list, at most


def is_table(file: Path) -> bool:
    """Whether a text begins with a row of numbers, after comments (#) and one title or row of
    column names at most."""
    with file.open("rb") as stream:
        start = stream.read(_START)
    lines = start.decode("utf-8-sig", "replace").splitlines()
    lines = lines[:-1] if len(start) == _START and len(lines) > 2 else lines  # the last one may go on
    return b"\0" not in start and _first_row(lines) is not None


def table(file: Path) -> RealArray:
    """Numbers of a text as an array (lines, columns).

    Between columns there are blanks, tabs, semicolons or commas. Decimal commas are accepted where
    the columns are separated by something else. Raises ValueError if a line does not hold as many
    numbers as the others.
    """
    lines = file.read_text(encoding="utf-8-sig", errors="replace").splitlines()
    first = _first_row(lines) or 0
    delimiter, comma = _separator(lines[first])
    rows = [line.replace(",", ".") if comma else line for line in lines[first:]]
    return np.loadtxt(rows, delimiter=delimiter, ndmin=2)


class TextEnd(NamedTuple):
    """How whole a text with a matrix is.

    ``broken``: number of the first line after the first row of numbers that begins as one but is
    none, 0 if there is none; ``lines``: number of lines of the map by the header of a text that
    asperity wrote, None in other texts; ``ended``: whether the last line has its line break.
    """

    broken: int
    lines: int | None
    ended: bool


def text_end(file: Path) -> TextEnd:
    """How whole the text in ``file`` is."""
    text = file.read_text(encoding="utf-8-sig", errors="replace")
    stated = _STATED_LINES.search(text, 0, _START)
    started, broken = False, 0
    for number, line in enumerate(text.splitlines(), start=1):
        cells = line.split()
        if cells and all(_is_number(cell) for cell in cells):
            started = True
        elif started and cells and cells[0][0] in "+-.0123456789":
            broken = number
            break
    return TextEnd(broken, int(stated[1]) if stated else None, text.endswith("\n"))


def gridded(points: RealArray) -> tuple[RealArray, None, tuple[float, float]]:
    """Heights [x, y] of a list of ``points`` (n, 3) on a regular grid, None, and its spacing; NaN
    where a point is missing.

    Raises InputError if the points do not lie on a regular grid, or two on one node.
    """
    (i, dx), (j, dy) = (_nodes(points[:, axis], "xy"[axis]) for axis in (0, 1))
    nx, ny = int(i.max()) + 1, int(j.max()) + 1
    if nx * ny > _SPARSE * len(points):
        raise InputError(
            f"its three columns are no regular grid of points x y z: {len(points)} of {nx} x {ny} nodes{_MAP}",
            subject=_COLUMNS,
        )
    if len(np.unique(i * ny + j)) < len(points):
        raise InputError(
            f"its three columns, taken as points x y z, give several heights at one node{_MAP}", subject=_COLUMNS
        )
    heights = np.full((nx, ny), np.nan)
    heights[i, j] = points[:, 2]
    return heights, None, (dx, dy)


_COLUMNS = "points x y z in three columns"
_MAP = "; resample scattered points first, and save a map of three columns as .npy"


def _nodes(coordinates: RealArray, axis: str) -> tuple[np.ndarray[tuple[int, ...], np.dtype[np.int64]], float]:
    """Node numbers of ``coordinates`` and their step."""
    if not np.isfinite(coordinates).all():
        raise InputError(
            f"its three columns, taken as points x y z, have a coordinate {axis} that is no number{_MAP}",
            subject=_COLUMNS,
        )
    places = np.unique(coordinates)
    extent = float(places[-1] - places[0])
    gaps = np.diff(places)
    gaps = gaps[gaps > 1e-6 * extent]
    steps = round(extent / float(np.median(gaps))) if gaps.size else 0
    if steps == 0:
        raise InputError(
            f"its three columns, taken as points x y z, have one value of {axis} only{_MAP}", subject=_COLUMNS
        )
    step = extent / steps
    numbers = np.rint((coordinates - places[0]) / step)
    if np.abs((coordinates - places[0]) / step - numbers).max() > _OFF_GRID:
        raise InputError(
            f"its three columns, taken as points x y z, are no regular grid: {places.size} values of {axis} from "
            f"{places[0]:g} to {places[-1]:g}{_MAP}",
            subject=_COLUMNS,
        )
    return numbers.astype(np.int64), step


def _first_row(lines: list[str]) -> int | None:
    """Number of the first line with numbers, if nothing but comments and column names stands before
    it."""
    names: str | None = None
    for number, line in enumerate(lines):
        if not line.strip():
            continue
        if line.startswith("#"):
            if ":" in line or "=" in line:  # a header that the reader of instrument files understands
                return None
            continue
        delimiter, comma = _separator(line)
        cells = line.strip(" \t,;").split(delimiter)
        if _is_number(cells[0].replace(",", ".") if comma else cells[0]):
            titles = [] if names is None else names.strip(" \t,;").split(delimiter)
            named = names is None or len(titles) == len(cells) or _is_title(titles, lines[number:], len(cells))
            return number if named else None
        if names is not None:
            return None
        names = line
    return None


_SAMPLE = 20  # rows behind a title that are compared; other formats have several lines of numbers of their own first


def _is_title(titles: list[str], rows: list[str], columns: int) -> bool:
    """Whether a line before the ``rows`` is their title: words without numbers, marks of a header
    or a cell for each column.

    Only where all of the first rows have ``columns`` numbers: the head of another format is no
    title.
    """
    if len(titles) >= columns or any(_is_number(cell) or set(cell) & set(':=[]{}"') for cell in titles):
        return False
    for row in [row for row in rows if row.strip()][:_SAMPLE]:
        delimiter, comma = _separator(row)
        cells = row.strip(" \t,;").split(delimiter)
        if len(cells) != columns or not all(_is_number(c.replace(",", ".") if comma else c) for c in cells):
            return False
    return True


def _separator(row: str) -> tuple[str | None, bool]:
    """Delimiter of a row of numbers (None for blanks), and whether its commas are decimal ones."""
    for mark in (";", "\t"):
        if mark in row:
            return mark, "," in row
    cells = row.split()
    if "," in row and len(cells) > 1 and all(_DECIMAL_COMMA.fullmatch(cell) or _is_number(cell) for cell in cells):
        return None, True
    return ("," if "," in row else None), False


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True
