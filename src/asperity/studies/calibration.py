"""What a calibration is: fitted parameters, how well the curve tells them, and the curve itself."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from ..core.units import percent, show
from ..core.words import printable
from ..io.tables import write_table
from .recorded import Recorded, plain


@dataclass(frozen=True)
class Fitted:
    """One fitted parameter.

    Attributes
    ----------
    name, path, unit
        Its name, the scalar of the problem, and its SI unit.
    value
        The best value.
    deviation
        Relative standard deviation, that of its logarithm.
    low, high
        Interval of 95 %: of the profile likelihood where the curve does not tell the parameter.
    """

    name: str
    path: str
    unit: str
    value: float
    deviation: float
    low: float
    high: float


@dataclass(frozen=True)
class CurvePoint:
    """A point of the curve, SI: the ``load`` at the scalar ``path``, the ``measured`` value of a
    ``quantity``, its standard ``deviation``, and that of the ``model``."""

    path: str
    quantity: str
    unit: str
    load: float
    measured: float
    deviation: float
    model: float


@dataclass(frozen=True, eq=False, repr=False)
class Calibration(Recorded):
    """Parameters of a contact from a measured curve, all SI.

    Attributes
    ----------
    title
        Of the study.
    parameters
        Values, deviations and intervals.
    correlation
        Correlation of their logarithms, (n, n).
    singular_values, directions
        Of the weighted Jacobian to the logarithms, the largest first, with the combination of
        parameters that each of them tells, (n, n): 1 over the former is the standard deviation of
        the latter.
    chi_squared, freedom
        Sum of the squares of the weighted residuals, and its degrees of freedom, to which it should
        be near.
    curve
        All points with the model beside them.
    profiles
        Values of the parameters that the curve does not tell well, with the rise of the sum of
        squares when all others are fitted to them.
    findings
        What should be known before the values are used.
    identifiable
        Whether the curve tells all parameters.
    converged
        Whether the least squares ended by their criterion.
    agreeing, starts
        How many of the fits end at the best one.
    solves, reused
        Contacts that were solved, and those that were kept from before.
    """

    title: str
    parameters: tuple[Fitted, ...]
    correlation: tuple[tuple[float, ...], ...]
    singular_values: tuple[float, ...]
    directions: tuple[tuple[float, ...], ...]
    chi_squared: float
    freedom: int
    curve: tuple[CurvePoint, ...]
    profiles: Mapping[str, tuple[tuple[float, float], ...]]
    findings: tuple[str, ...]
    identifiable: bool
    converged: bool
    agreeing: int
    starts: int
    solves: int
    reused: int

    def __getitem__(self, name: str) -> Fitted:
        """The parameter with this name or path.

        Raises
        ------
        KeyError
            If there is none.
        """
        for each in self.parameters:
            if name in (each.name, each.path):
                return each
        raise KeyError(name)

    @property
    def verdict(self) -> str:
        """One sentence on whether the values can be taken."""
        if not self.converged:
            return "The fit did not converge: the values are those of its last step."
        if not self.identifiable:
            return "The curve does not tell all parameters: take the intervals, not the values."
        return "The curve tells all parameters."

    def tables(self) -> Iterator[tuple[str, tuple[str, ...], list[tuple[str, ...]]]]:
        """Heading, headings of columns and rows of text of each table."""
        rows: list[tuple[str, ...]] = []
        for each in self.parameters:
            ends = f"{show(each.low, each.unit)} … {show(each.high, each.unit)}"
            deviation = percent(each.deviation, 2) if math.isfinite(each.deviation) else "–"
            rows.append((each.name, show(each.value, each.unit), deviation, ends))
        yield "Fitted", ("", "value", "standard deviation", "95 %"), rows
        names = tuple(each.name for each in self.parameters)
        if len(names) > 1:
            cells = [(name, *(f"{c:+.3f}" for c in row)) for name, row in zip(names, self.correlation, strict=True)]
            yield "Correlation", ("", *names), cells
            told = [
                (percent(1.0 / value, 2) if value > 0.0 else "–", *(f"{c:+.2f}" for c in row))
                for value, row in zip(self.singular_values, self.directions, strict=True)
            ]
            yield "What the curve tells: combinations of logarithms", ("standard deviation", *names), told

    def __repr__(self) -> str:
        told = (f"  {text}" for text in self.findings)
        lines = [printable(f"Calibration {self.title}".rstrip()), f"  {self.verdict}", *told]
        for heading, headings, rows in self.tables():
            widths = [max(len(row[n]) for row in (headings, *rows)) for n in range(len(headings))]
            lines += ["", f"  {heading}"]
            for row in (headings, *rows):
                text = "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True))
                lines.append(printable(f"    {text}".rstrip()))
        return "\n".join([*lines, "", f"  {self.work}"])

    @property
    def work(self) -> str:
        """Fit and work in words."""
        fit = f"Sum of squares {self.chi_squared:.3g} of {self.freedom} degrees of freedom"
        return f"{fit}; {self.solves} contacts solved, {self.reused} kept from before."

    def record(self) -> dict[str, Any]:
        """Everything as plain values, SI; what is not known is None."""
        found: dict[str, Any] = plain(asdict(self))
        return found | {"verdict": self.verdict}

    def save_csv(self, path: str | Path, *, overwrite: bool = False) -> None:
        """Write the curve with the model beside it to the CSV file ``path``, SI; errors as of
        ``save_json``."""
        names = ("load", "quantity", "unit", "measured", "deviation", "model")
        rows: list[tuple[Any, ...]] = [names]
        rows += [tuple(getattr(each, name) for name in names) for each in self.curve]
        write_table(rows, path, overwrite=overwrite)
