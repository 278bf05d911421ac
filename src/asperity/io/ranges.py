"""Lists and ranges of quantities as text, such as ``1MPa,2MPa`` and ``1MPa..1GPa``."""

from __future__ import annotations

import numpy as np

from ..core import require, units
from ..core.arrays import RealArray
from ..core.errors import InputError

RANGE = ".."
"""Between the ends of a range."""


def parse_values(text: str, kind: str, what: str, *, count: int) -> RealArray:
    """SI values of a list with commas in its order, or ``count`` values on a logarithmic scale between the ends of a range.

    Parameters
    ----------
    text
        One quantity, several with commas between, or two with ``..`` between; every one with its unit.
    kind
        See ``units.parse``.
    what
        Name of the input, for the error message.
    count
        Values of a range, at least 2.

    Raises
    ------
    UnitError
        If a quantity is not one of this kind.
    InputError
        If a range has not two ends, both positive, or ``count`` is less than 2.
    """
    if RANGE not in text:
        return np.array([units.parse(part.strip(), kind, what) for part in text.split(",")])
    ends = text.split(RANGE)
    if len(ends) != 2:
        raise InputError(f"{what} must be a list, or one range of two ends such as 1MPa..1GPa, but is {text!r}.")
    first, last = (require.positive(units.parse(end.strip(), kind, what), f"end of {what}") for end in ends)
    return np.geomspace(first, last, require.integer(count, 2, f"number of values of {what}"))
