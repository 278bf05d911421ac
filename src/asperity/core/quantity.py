"""What a number is: name, SI unit and words, stated once for files, tables, axes and studies."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Quantity:
    """A physical quantity that this package gives or takes.

    Parameters
    ----------
    name
        Name of the attribute, variable or column that holds it; with dots for an attribute of an attribute.
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


@dataclass(frozen=True, eq=False)
class Labelled:
    """Numbers (SI) or text, and what they are."""

    quantity: Quantity
    values: Any
