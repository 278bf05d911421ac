"""Numbers in text: how a text is laid out, and the matrix of heights, list of points or line scan
that it holds.

Nothing is assumed in silence: what was understood of a text stands in one line
(``TextNumbers.understood``), and every part of it can be stated instead (:class:`TextLayout`).
"""

from __future__ import annotations

import csv
import re
from collections import Counter
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal, NamedTuple, TypedDict

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import InputError
from .text_header import Stated, stated_by

Axes = Literal["none", "row", "column", "both"]


class TextOptions(TypedDict, total=False):
    """How a text is laid out, where the reader does not see it; the attributes of
    :class:`TextLayout`."""

    delimiter: str
    decimal: str
    header_lines: int
    axes: Axes
    encoding: str


@dataclass(frozen=True)
class TextLayout:
    """How a text is laid out; None is found out by the reader.

    Attributes
    ----------
    delimiter
        What stands between columns: ``"comma"``, ``"semicolon"``, ``"tab"`` or ``"blank"``.
    decimal
        What stands before decimals: ``"point"`` or ``"comma"``.
    header_lines
        Number of lines before the first row of numbers, which are left out.
    axes
        Whether the first ``"row"``, the first ``"column"`` or ``"both"`` hold coordinates or
        numbers of points, no heights; ``"none"`` if neither does.
    encoding
        Name of the encoding, such as ``"utf-16"`` or ``"cp1252"``.
    missing
        Numbers and texts that stand for missing points, beside the usual texts (``nan``, ``---``,
        ``Bad``, nothing).
    """

    delimiter: str | None = None
    decimal: str | None = None
    header_lines: int | None = None
    axes: Axes | None = None
    encoding: str | None = None
    missing: tuple[float | str, ...] = ()

    def __post_init__(self) -> None:
        """Refuse words that are unknown."""
        for name, words in (("delimiter", tuple(DELIMITERS)), ("decimal", ("point", "comma")), ("axes", AXES)):
            value = getattr(self, name)
            if value is not None and value not in words:
                raise InputError(f"{name} of a text must be one of {', '.join(words)}, but is {value!r}.")
        if self.encoding is not None:
            try:
                "".encode(self.encoding)
            except LookupError:
                raise InputError(
                    f"encoding of a text must be a known one, such as utf-8 or cp1252, but is {self.encoding!r}."
                ) from None

    @property
    def stated(self) -> bool:
        """Whether anything is stated beside missing points."""
        return self != TextLayout(missing=self.missing)


DELIMITERS = {"comma": ",", "semicolon": ";", "tab": "\t", "blank": None}
AXES = ("none", "row", "column", "both")


@dataclass(frozen=True, eq=False)
class TextNumbers:
    """What a text holds.

    ``rows`` (lines, columns) without rows and columns of coordinates, NaN where a point is missing;
    ``names`` of the columns, if it has any; ``x`` and ``y`` the coordinates of columns and lines in
    the unit of the file, None without; ``stated`` what its header says of size and units;
    ``understood`` all of it in one line.
    """

    rows: RealArray
    understood: str
    names: tuple[str, ...] = ()
    x: RealArray | None = None
    y: RealArray | None = None
    stated: Stated = field(default_factory=Stated)


_START = 1 << 16  # bytes in which a table must begin
_DECIMAL_COMMA = re.compile(r"[-+]?\d*,\d+([eE][-+]?\d+)?")
_COMMENTS = ("#", "%", "//")
_MISSING = frozenset(
    ["", "nan", "-nan", "+nan", "---", "--", "-", "*", "**", "***", "****", "?", "bad", "n/a", "#n/a", "na", "null"]
).union(
    ["none", "invalid", "missing", "void", "masked", "nodata", "no data", "1.#qnan", "-1.#ind", "1.#ind", "#value!"]
)
"""Texts of missing points, in small letters; an empty cell is one too."""


# Bytes, lines and cells.


def decoded(content: bytes, encoding: str | None = None) -> tuple[str, str]:
    """Text of ``content`` and the name of its encoding, found from its marks or its bytes where
    none is stated.

    Raises InputError if the bytes are not of the encoding that is stated.
    """
    if encoding is None:
        encoding = next((name for mark, name in _MARKS if content.startswith(mark)), None)
    if encoding is None and (wide := _wide(content)):
        encoding = wide
    for name in [encoding] if encoding is not None else ["utf-8", "cp1252", "latin-1"]:
        try:
            return content.decode(name).removeprefix("\ufeff"), name.removesuffix("-sig")
        except UnicodeDecodeError as error:
            if encoding is not None:
                raise InputError(
                    f"encoding of the text must be that of its bytes, but byte {error.start + 1} is not of {name}; "
                    "state another ({encoding})"
                ) from None
    raise AssertionError("latin-1 takes every byte")


_MARKS = ((b"\xef\xbb\xbf", "utf-8-sig"), (b"\xff\xfe", "utf-16"), (b"\xfe\xff", "utf-16"))


def _wide(content: bytes) -> str:
    """UTF-16 without its mark: every second byte of a text of digits is zero."""
    start = content[:_START]
    even, odd = start[0::2].count(0), start[1::2].count(0)
    for zeros, others, name in ((odd, even, "utf-16-le"), (even, odd, "utf-16-be")):
        if len(start) > 8 and zeros > 0.4 * len(start) and others < 0.01 * len(start):
            return name
    return ""


def is_text(file: Path) -> bool:
    """Whether the file begins as a text does."""
    with file.open("rb") as stream:
        start = stream.read(_START)
    if start.startswith(tuple(mark for mark, _ in _MARKS)) or _wide(start):
        return True
    controls = start.translate(None, bytes(range(32, 256)) + b"\t\n\r\f\v")
    return not controls


class _Separator(NamedTuple):
    """What stands between columns (None for blanks), whether commas are decimal, and whether lines
    end with it."""

    mark: str | None
    comma: bool
    trailing: bool = False

    def cells(self, line: str) -> list[str]:
        """Cells of a line, as they are written."""
        if self.mark is None:
            return line.replace('"', " ").split()
        text = line.strip(" ") if self.mark == "\t" else line.strip()
        found = text.split(self.mark)
        if '"' in text:
            with suppress(csv.Error, StopIteration):  # what is no quoted cell
                found = next(csv.reader([text], delimiter=self.mark, skipinitialspace=True))
        parts = [cell.strip() for cell in found]
        return parts[:-1] if self.trailing and len(parts) > 1 and not parts[-1] else parts

    def number(self, cell: str) -> float | None:
        """The number that a cell is, None if it is none."""
        text = cell.replace(",", ".") if self.comma else cell
        try:
            return float(text) if "_" not in text else None
        except ValueError:
            return None

    def words(self) -> str:
        """The separator in words."""
        name = next(name for name, mark in DELIMITERS.items() if mark == self.mark)
        return f"{name} between columns, decimal {'comma' if self.comma else 'point'}"


def _is_numbers(cells: Sequence[str], separator: _Separator, missing: frozenset[str]) -> bool:
    """Whether ``cells`` are a row of numbers, of which some may be missing."""
    found = 0
    for cell in cells:
        if separator.number(cell) is not None:
            found += 1
        elif cell.lower() not in missing:
            return False
    return found > 0


def _is_comment(line: str) -> bool:
    return line.lstrip().startswith(_COMMENTS)


def _separator(lines: Sequence[str], layout: TextLayout, missing: frozenset[str]) -> _Separator:
    """How the columns of ``lines``, the last ones of a text, are separated; those with words do not
    count."""
    guessed = [(line, _Separator(*_guessed(line))) for line in lines]
    lines = [line for line, made in guessed if _is_numbers(made.cells(line), made, missing)] or lines
    mark: str | None = None
    if layout.delimiter is not None:
        mark = DELIMITERS[layout.delimiter]
        comma = any("," in line for line in lines) and mark != ","
        if mark is None:
            comma = comma and all(_DECIMAL_COMMA.search(line) for line in lines if "," in line)
    else:
        votes = Counter(_guessed(line) for line in lines)
        mark, comma = max(votes, key=lambda item: (votes[item], item[1])) if votes else (None, False)
        comma = comma or any(found == (mark, True) for found in votes)
    if layout.decimal is not None:
        comma = layout.decimal == "comma"
    ends = [line.rstrip(" \r").endswith(mark) for line in lines] if mark else [False]
    made = _Separator(mark, comma, all(ends) and bool(ends))
    if mark == "," and layout.delimiter is None and layout.decimal is None:
        if any('"' in line for line in lines) and _quoted_commas(lines, made):
            return replace_comma(made)
        _refuse_two_meanings(lines, made)
    return made


def replace_comma(separator: _Separator) -> _Separator:
    """The ``separator`` with decimal commas."""
    return separator._replace(comma=True)


def _quoted_commas(lines: Sequence[str], separator: _Separator) -> bool:
    """Whether quoted cells hold decimal commas: "1,5","2,3"."""
    cells = [cell for line in lines for cell in separator.cells(line)]
    return any(_DECIMAL_COMMA.fullmatch(cell) for cell in cells)


def _guessed(row: str) -> tuple[str | None, bool]:
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


def _refuse_two_meanings(lines: Sequence[str], separator: _Separator) -> None:
    """Refuse whole numbers between commas that look like decimals: 0,123,0,456.

    Every second cell is then a fraction: unsigned, all of one length of two or more digits, some
    with a leading zero.
    """
    rows = [separator.cells(line) for line in lines if line.strip()]
    if not rows or any(len(row) % 2 or not all(re.fullmatch(r"[-+]?\d+", cell) for cell in row) for row in rows):
        return
    fractions = [cell for row in rows for cell in row[1::2]]
    wholes = [cell for row in rows for cell in row[0::2]]
    if not all(cell.isdigit() for cell in fractions):
        return
    padded = any(len(cell) > 1 and cell[0] == "0" for cell in fractions)
    even = len({len(cell) for cell in fractions}) == 1 and len(fractions[0]) > 1
    if padded and (even or all(len(cell.lstrip("+-")) == 1 for cell in wholes)):
        raise InputError(
            f"commas of the text must have one meaning, but stand between columns and before decimals as it seems: "
            f"{lines[0].strip()[:60]!r}. Save it with another delimiter, or state both ({{delimiter}}, {{decimal}})"
        )


# The table.


def is_table(file: Path) -> bool:
    """Whether a text is a table of numbers that says nothing else: comments and one title or row of
    names before it."""
    with file.open("rb") as stream:
        start = stream.read(_START)
    text, _ = decoded(start[: len(start) // 2 * 2])
    lines = text.splitlines()
    lines = lines[:-1] if len(start) == _START and len(lines) > 2 else lines  # the last one may go on
    return _first_row(lines) is not None


def table(file: Path) -> RealArray:
    """Numbers of a text as an array (lines, columns), which may begin with comments and one title
    or row of names.

    Raises ValueError if a line does not hold as many numbers as the others.
    """
    return _parsed(decoded(file.read_bytes()), TextLayout(axes="none")).rows


def text_numbers(file: Path, layout: TextLayout) -> TextNumbers:
    """What the text in ``file`` holds.

    Raises
    ------
    InputError
        If rows have different numbers of cells, a cell is no number, or what stands before the
        first row may be meant for the heights; rows, columns and lines are counted from 1.
    """
    return _with_axes(_parsed(decoded(file.read_bytes(), layout.encoding), layout), layout)


_SAMPLE = 60  # last lines from which delimiter and number of columns are found


def _parsed(text: tuple[str, str], layout: TextLayout) -> TextNumbers:
    lines = text[0].splitlines()
    kept = [number for number, line in enumerate(lines) if line.strip() and not _is_comment(line)]
    kept = [number for number in kept if layout.header_lines is None or number >= layout.header_lines]
    missing = _MISSING | {word.strip().lower() for word in layout.missing if isinstance(word, str)}
    sample = [lines[number] for number in kept[-_SAMPLE:]]
    separator = _separator(sample, layout, missing)
    cells = [row for line in sample if _is_numbers(row := separator.cells(line), separator, missing)]
    columns = Counter(map(len, cells)).most_common(1)[0][0] if cells else 0
    first = _start(lines, kept, separator, missing, columns, layout)
    body = [number for number in kept if number >= first]
    if not body:
        raise InputError("its text must hold rows of numbers, but holds none")
    head = [lines[number] for number in range(first) if lines[number].strip()]
    try:
        rows = _quickly([lines[number] for number in body], separator)
        marks: Counter[str] = Counter()
    except ValueError:
        rows, marks = _slowly(lines, body, separator, missing)
    for code in layout.missing:
        if not isinstance(code, str):
            hit = rows == code
            marks[f"{code:g}"] += int(hit.sum())
            rows = np.where(hit, np.nan, rows)
    names = _names(head, separator, rows.shape[1])
    words = [text[1], separator.words()]
    if head:
        shown = "; ".join(line.strip()[:30] for line in head[:3]) + ("; …" if len(head) > 3 else "")
        words.append(f"{len(head)} header line{'s' if len(head) > 1 else ''} left out ({shown})")
    if marks:
        words.append("missing: " + ", ".join(f"{count} × {mark or 'empty'!r}" for mark, count in marks.items()))
    return TextNumbers(rows, ", ".join(words), names, stated=stated_by(head, separator.cells))


def _start(
    lines: Sequence[str],
    kept: Sequence[int],
    separator: _Separator,
    missing: frozenset[str],
    columns: int,
    layout: TextLayout,
) -> int:
    """Index of the first line with numbers; lines before it hold words, which are left out."""
    if layout.header_lines is not None:
        return layout.header_lines
    for number in kept:
        cells = separator.cells(lines[number])
        numeric = _is_numbers(cells, separator, missing)
        corner = len(cells) > 2 and len(cells) == columns and _is_numbers(cells[1:], separator, missing)
        if (numeric and len(cells) == columns) or (corner and _even(np.array(list(map(separator.number, cells[1:]))))):
            return number
        if separator.number(cells[0]) is not None and number < kept[-1]:
            raise InputError(
                f"line {number + 1} begins with a number, but has {len(cells)} cells where most rows have "
                f"{columns}: it belongs to a header, or the row is cut short. If it is a header, state its "
                f"lines ({{header_lines}}: {number + 1})"
            )
        if len(cells) > max(columns, 2) and separator.mark is not None:
            raise InputError(
                f"line {number + 1} has {len(cells)} cells, but the rows of numbers have {columns}. If it is "
                f"to be left out, state the lines of the header ({{header_lines}}: {number + 1})"
            )
    return len(lines)


def _quickly(body: Sequence[str], separator: _Separator) -> RealArray:
    """Numbers of rows that hold nothing else. Raises ValueError for others."""
    if separator.trailing and separator.mark:
        body = [line.rstrip().removesuffix(separator.mark) for line in body]
    if separator.comma:
        if '"' in body[0]:
            raise ValueError("quoted numbers are taken one by one")
        body = [line.replace(",", ".") for line in body]
    return np.loadtxt(body, delimiter=separator.mark, ndmin=2, quotechar='"', comments=None)


def _slowly(
    lines: Sequence[str], body: Sequence[int], separator: _Separator, missing: frozenset[str]
) -> tuple[RealArray, Counter[str]]:
    """Numbers of rows with missing points, and how often each text of a missing point occurs."""
    marks: Counter[str] = Counter()
    rows: list[list[float]] = []
    for row, number in enumerate(body, start=1):
        cells, values = separator.cells(lines[number]), []
        for column, cell in enumerate(cells, start=1):
            value = separator.number(cell)
            if value is None:
                # the corner of a row of coordinates may hold anything
                if cell.lower() not in missing and not (row == column == 1 and len(cells) > 2):
                    raise InputError(
                        f"row {row} (line {number + 1}), column {column} must be a number, but is "
                        f"{cell[:40]!r}. If it stands "
                        "for a missing point, say so ({missing})"
                    )
                marks[cell] += 1
                value = np.nan
            values.append(value)
        if rows and len(values) != len(rows[0]):
            raise InputError(
                f"row {row} (line {number + 1}) has {len(values)} numbers, but row 1 has {len(rows[0])}: the "
                "file is cut "
                "short, or its columns are separated by something else ({delimiter})"
            )
        rows.append(values)
    return np.array(rows), marks


def _names(head: Sequence[str], separator: _Separator, columns: int) -> tuple[str, ...]:
    """Names of the columns: the last line before the numbers, if it has as many words."""
    if not head:
        return ()
    cells = separator.cells(head[-1].lstrip("#% "))
    named = len(cells) == columns and not any(separator.number(cell) is not None for cell in cells)
    return tuple(cells) if named else ()


# Rows and columns of coordinates.

_EVEN = 1e-3  # of a step, beside the rounding of few digits


def _even(values: RealArray) -> bool:
    """Whether ``values`` rise or fall evenly, up to the digits that are written."""
    values = np.asarray(values, dtype=float)
    if values.size < 4 or not np.isfinite(values).all():
        return False
    steps = np.diff(values)
    step = float(np.median(steps))
    digits = 1.5e-4 * float(np.abs(values).max()) if np.abs(values).max() < 1e3 else 0.0
    return step != 0.0 and bool(np.all(np.abs(steps - step) <= max(_EVEN * abs(step), min(digits, 0.05 * abs(step)))))


def _with_axes(found: TextNumbers, layout: TextLayout) -> TextNumbers:
    """What is ``found`` without its row and column of coordinates, or numbers of points.

    A first row is one if it rises or falls evenly and the others do not do so by the same steps: a
    plane has none.
    """
    rows = found.rows
    if layout.axes is None:
        if min(rows.shape) < 4:
            return found
        row = _even(rows[0, 1:]) and not _alike(rows[:, 1:])
        column = _even(rows[1:, 0]) and not _alike(rows[1:, :].T)
        if row != column and not _labelled(found, rows[0] if row else rows[:, 0], row=row):
            row = column = False
    else:
        row, column = layout.axes in ("row", "both"), layout.axes in ("column", "both")
    if not row and not column:
        return found
    x = rows[0, 1 if column else 0 :] if row else None
    y = rows[1 if row else 0 :, 0] if column else None
    if x is None and found.names and column:
        numbers = [_float(name) for name in found.names[1:]]
        x = np.array(numbers, dtype=float) if None not in numbers else None
    where = "row 1 and column 1 hold" if row and column else "row 1 holds" if row else "column 1 holds"
    words = (
        f"{found.understood}, {where} coordinates "
        f"({' and '.join(_extent(axis) for axis in (x, y) if axis is not None)})"
    )
    inner = rows[1 if row else 0 :, 1 if column else 0 :]
    return replace(found, rows=inner, x=x, y=y, understood=words)


def _float(text: str) -> float | None:
    return float(text) if _is_number(text) else None


def _extent(axis: RealArray) -> str:
    return f"{axis[0]:g} to {axis[-1]:g}"


def _alike(rows: RealArray) -> bool:
    """Whether all ``rows`` rise by the steps of the first: it is no axis then."""
    others = np.diff(rows, axis=1)
    step = others[0].mean()
    return bool(np.all(np.abs(others - step) <= 1e-2 * abs(step)))


def is_count(line: RealArray) -> bool:
    """Whether a ``line`` counts points, from 0 or 1."""
    return any(np.array_equal(line, np.arange(first, first + line.size)) for first in (0, 1))


def _labelled(found: TextNumbers, line: RealArray, *, row: bool) -> bool:
    """Whether one row or column alone is known for coordinates: whole numbers from 0 or 1, or one
    that has a name or none.

    Without names, heights may begin with an even row by chance or by levelling.
    """
    whole = is_count(line)
    numbered = row and np.isnan(line[0]) and bool(np.array_equal(line[1:], np.arange(line.size - 1)))
    named = (
        not row
        and bool(found.names)
        and found.names[0].lower().split(" ")[0] in ("", "x", "y", "index", "row", "i", "n")
    )
    return bool(whole and line.size >= 4) or numbered or named or (line.size >= 16)


class TextEnd(NamedTuple):
    """How whole a text with a matrix is.

    ``broken``: number of the first line after the first row of numbers that begins as one but is
    none, 0 if there is none; ``lines``: number of lines of the map by the header of a text that
    asperity wrote, None in other texts; ``ended``: whether the last line has its line break.
    """

    broken: int
    lines: int | None
    ended: bool


_STATED_LINES = re.compile(r"^#\s*y-pixels: (\d+)\s*$", re.MULTILINE)  # in the files that asperity writes


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


def _first_row(lines: Sequence[str]) -> int | None:
    """Number of the first line with numbers, if nothing but comments and column names stands before
    it."""
    named = False
    for number, line in enumerate(lines):
        if not line.strip():
            continue
        if line.startswith("#"):
            if ":" in line or "=" in line:  # a header that the reader of instrument files understands
                return None
            continue
        mark, comma = _guessed(line)
        separator = _Separator(mark, comma)
        if _is_numbers(separator.cells(line), separator, _MISSING):
            return number
        if named or set(line) & set(":=[]{}") - (set("[]") if mark else set()):
            return None
        named = True
    return None
