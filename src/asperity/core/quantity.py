"""What a number is: name, SI unit and words, stated once for files, tables, axes and studies."""

from __future__ import annotations

from dataclasses import MISSING, dataclass, field, fields
from typing import Any

WHAT, GIVEN, COLUMNS = "what", "given", "columns"
"""Keys of the metadata of fields: what a field is, that it was given with the problem, and what the
columns of its array are."""


@dataclass(frozen=True)
class Quantity:
    """A physical quantity that this package gives or takes.

    Parameters
    ----------
    name
        Name of the attribute, variable or column that holds it; with dots for an attribute of an
        attribute.
    unit
        SI unit, "1" for plain numbers, "" for text.
    label
        Short name in words, for tables and axes.
    dims
        Names of the axes of its array; none for a single number.
    description
        Exact definition in words or symbols.
    symbol
        Symbol of the literature.
    source
        Author and year, or standard, of the definition.
    costly
        Whether it takes about as long as a solve, so that it is computed on request only.
    """

    name: str
    unit: str
    label: str
    dims: tuple[str, ...] = ()
    description: str = ""
    symbol: str = ""
    source: str = ""
    costly: bool = False

    @property
    def title(self) -> str:
        """Label with a capital letter, for headings; a Greek symbol stays as it is."""
        return self.label if self.label.startswith("σ") else self.label[:1].upper() + self.label[1:]

    @property
    def attributes(self) -> dict[str, str]:
        """Attributes ``units`` and ``long_name`` of the variable in files and datasets."""
        return {"units": self.unit, "long_name": self.label}


@dataclass(frozen=True)
class Limit:
    """A limit of a quantity (SI): at most ``value``, or at ``least``."""

    value: float
    least: bool


@dataclass(frozen=True, eq=False)
class Labelled:
    """Numbers (SI) or text, and what they are."""

    quantity: Quantity
    values: Any


def measured(
    unit: str, label: str, *dims: str, default: Any = MISSING, columns: tuple[Quantity, ...] = (), repr: bool = True
) -> Any:
    """Field of a dataclass with what it is: SI unit ("1" for plain numbers, "" for text), words,
    and the names of the axes of an array.

    Files, tables and pictures take them from here. Axes ``x`` and ``y`` are those of the grid; an
    array that has none of them may have another length in every step of a history. ``columns`` are
    what the columns of an array with two axes are, where each is something else, or arrays by name.
    """
    return field(default=default, repr=repr, metadata={WHAT: (unit, label, dims), COLUMNS: columns})


def measured_as(quantity: Quantity) -> Any:
    """Field of a dataclass that is this ``quantity``."""
    return measured(quantity.unit, quantity.label, *quantity.dims)


def given(by: str = "", **options: Any) -> Any:
    """Field of a dataclass that was given with the problem, so that files take it from there:
    ``by`` this attribute of the problem, if it is one.

    ``options`` are those of ``dataclasses.field``.
    """
    return field(**options, metadata={GIVEN: by})


def stored_quantities(kind: type) -> tuple[Quantity, ...]:
    """What the stored fields of the dataclass ``kind`` are, in their order; one without words is
    called by its name."""
    found = []
    for item in fields(kind):
        if GIVEN not in item.metadata and item.init:
            unit, label, dims = item.metadata.get(WHAT, ("1", item.name.replace("_", " "), ()))
            found.append(Quantity(item.name, unit, label, dims))
    return tuple(found)
