"""Measured moduli and compliances in text files, columns with their units in the headings, and the
solids fitted to them."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from ..core import units
from ..core.arrays import RealArray
from ..core.errors import FileFormatError, UnitError
from ..core.text import read_text
from .relaxation import creep_through, relaxation_through
from .viscoelastic import MasterCurve, MeasuredCurve, Viscoelastic, fitted_solid

COLUMNS = MappingProxyType(
    {
        "frequency": "Hz",
        "angular frequency": "rad/s",
        "storage": "Pa",
        "loss": "Pa",
        "time": "s",
        "relaxation": "Pa",
        "creep": "1/Pa",
    }
)
"""First words of the headings, and the SI unit of each column."""

KINDS: tuple[tuple[str, ...], ...] = (
    ("frequency", "storage", "loss"),
    ("angular frequency", "storage", "loss"),
    ("time", "relaxation"),
    ("time", "creep"),
)
"""Columns that go together."""

EXAMPLES = (
    "frequency (Hz), storage modulus (MPa), loss modulus (MPa)",
    "time (s), relaxation modulus (MPa)",
    "time (s), creep compliance (1/MPa)",
)

_HEADING = re.compile(rf"\s*({'|'.join(COLUMNS)})\b[^()\[\]]*[(\[]([^()\[\]]+)[)\]]\s*", re.IGNORECASE)


@dataclass(frozen=True, eq=False)
class Measured:
    """What a file holds: ``columns`` (n,) each, SI, of storage and loss moduli against frequency
    (Hz, Pa, Pa), or of a relaxation modulus (s, Pa) or a creep compliance (s, 1/Pa) against
    time."""

    kind: Literal["moduli", "relaxation", "creep"]
    columns: tuple[RealArray, ...]


def read_measured(path: str | Path) -> Measured:
    """Moduli or compliances of the table in the text file at ``path``.

    The first line that is no comment (#) has the headings, such as
    ``frequency (Hz), storage modulus (MPa), loss modulus (MPa)``,
    ``time (s), relaxation modulus (MPa)`` or ``time (s), creep compliance (1/MPa)``, in any order;
    an angular frequency (rad/s) may stand instead. Columns are separated by commas, semicolons or
    tabs; others are left out.

    FileFormatError if the file is missing, no text, or not such a table.
    """
    what, examples = "file of measured moduli", f"{', '.join(map(repr, EXAMPLES[:-1]))} or {EXAMPLES[-1]!r}"
    lines = [line for line in read_text(path, what).splitlines() if line.strip() and not line.lstrip().startswith("#")]
    if not lines:
        raise FileFormatError(f"{what} must hold a table such as {examples}, but {path} is empty.")
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
    kinds = [kind for kind in KINDS if {*kind} <= places.keys()]
    if len(kinds) != 1:
        raise FileFormatError(
            f"headings of the {what} must be such as {examples}, but {path} has {lines[0].strip()!r}."
        )
    taken = [places[name] for name in kinds[0]]
    rows = []
    for number, line in enumerate(lines[1:], start=1):
        cells = line.split(separator)
        try:
            rows.append([float(cells[place]) * factor for place, factor in taken])
        except (ValueError, IndexError):
            raise FileFormatError(
                f"row {number} of the {what} {path} must hold numbers in all columns, but is {cells!r}."
            ) from None
    first, *others = np.array(rows, dtype=float).reshape(-1, len(taken)).T
    if kinds[0][0] == "time":
        return Measured("relaxation" if kinds[0][1] == "relaxation" else "creep", (first, *others))
    return Measured("moduli", (first / (2.0 * math.pi) if kinds[0][0] == "angular frequency" else first, *others))


# Solids fitted to what was measured.


@dataclass(frozen=True, eq=False)
class TimeCurve(MeasuredCurve):
    """Fit of a Prony series to a relaxation modulus or a creep compliance.

    Attributes
    ----------
    solid
        The solid found.
    time
        Measured times, s.
    measured, fitted
        Moduli in Pa, or compliances in 1/Pa, at these times.
    """

    solid: Viscoelastic
    time: RealArray
    measured: RealArray
    fitted: RealArray

    @property
    def errors(self) -> RealArray:
        """|fitted - measured| / measured at every time."""
        return np.asarray(np.abs(self.fitted - self.measured) / self.measured)


def fitted_relaxation(
    time: ArrayLike,
    modulus: ArrayLike,
    *,
    poisson_ratio: float,
    per_decade: int = 4,
    fluid: bool = False,
    **more: Any,
) -> TimeCurve:
    """Viscoelastic solid through a relaxation modulus measured in time, with the error of the fit.

    Parameters
    ----------
    time
        (n,), s, > 0 and different from each other; n >= 2.
    modulus
        (n,), Young's modulus E(t) > 0 after a step of strain, Pa.
    poisson_ratio
        nu.
    per_decade
        Relaxation times a decade, from the shortest time to ten times the longest.
    fluid
        Whether all of it relaxes, so that the series has no constant.
    **more
        Further parameters of ``Viscoelastic``, such as ``name`` and ``sources``.

    Raises
    ------
    InputError
        If the columns differ in length or hold values outside their ranges, the modulus rises, or
        the series would have more than 400 terms.
    """
    series = relaxation_through(time, modulus, per_decade=per_decade, fluid=fluid)
    solid = Viscoelastic.prony(series.relaxed, series.terms, poisson_ratio, **more)
    t, values = (np.asarray(column, dtype=float) for column in (time, modulus))
    return TimeCurve(solid, t, values, series.at(t))


def fitted_creep(
    time: ArrayLike,
    compliance: ArrayLike,
    *,
    poisson_ratio: float,
    per_decade: int = 4,
    fluid: bool = False,
    **more: Any,
) -> TimeCurve:
    """Viscoelastic solid through a creep compliance measured in time, with the error of the fit.

    The creep is fitted and converted to its relaxation, which is exact.

    Parameters
    ----------
    time
        (n,), s, > 0 and different from each other; n >= 2.
    compliance
        (n,), strain over stress J(t) > 0 after a step of uniaxial stress, 1/Pa.
    poisson_ratio
        nu.
    per_decade
        Retardation times a decade, from the shortest time to ten times the longest.
    fluid
        Whether the compliance rises without limit, so that the creep has a fluidity.
    **more
        Further parameters of ``Viscoelastic``, such as ``name`` and ``sources``.

    Raises
    ------
    InputError
        If the columns differ in length or hold values outside their ranges, the compliance falls or
        has grown from zero, or the series would have more than 400 terms.
    """
    creep = creep_through(time, compliance, per_decade=per_decade, fluid=fluid)
    series = creep.relaxation
    solid = Viscoelastic.prony(series.relaxed, series.terms, poisson_ratio, **more)
    t, values = (np.asarray(column, dtype=float) for column in (time, compliance))
    return TimeCurve(solid, t, values, creep.at(t))


_FITS = MappingProxyType({"moduli": fitted_solid, "relaxation": fitted_relaxation, "creep": fitted_creep})


def fitted_file(path: str | Path, *, poisson_ratio: float, **more: Any) -> MasterCurve | TimeCurve:
    """Viscoelastic solid through what the text file at ``path`` holds, see :func:`read_measured`;
    ``more`` are further parameters of the fit.

    Raises as ``read_measured`` and the fits.
    """
    found = read_measured(path)
    fit: Any = _FITS[found.kind]
    made: MasterCurve | TimeCurve = fit(*found.columns, poisson_ratio=poisson_ratio, **more)
    return made
