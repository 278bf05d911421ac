"""The scalar quantities that a study can collect from a case: those of all parts."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

from ..core.errors import InputError
from ..core.quantity import Quantity
from ..parts.registry import parts
from ..run.document import ProblemDocument


def measures() -> dict[str, Quantity]:
    """Every quantity that a part finds, by its name, in the order of tables."""
    return {item.name: item for part in parts() for item in part.quantities if not item.dims}


def computed(document: ProblemDocument, asked: Iterable[str]) -> tuple[str, ...]:
    """Names of the quantities that are computed of each case: all that cost nothing, and the costly ones ``asked`` for.

    Raises
    ------
    InputError
        If one that is asked for is unknown, or needs a table that the document lacks.
    """
    wanted = tuple(asked)
    there: dict[str, bool] = {}
    for part in parts():
        given = part.settings_in(document) is not None
        for item in (item for item in part.quantities if not item.dims):
            there[item.name] = given
            if item.name in wanted and not given:
                raise InputError(
                    f"quantity {item.name} needs the table [{part.table}] in the problem, but it is missing; add it."
                )
    for name in wanted:
        if name not in there:
            near = difflib.get_close_matches(name, there, n=3, cutoff=0.4)
            hint = f"did you mean {' or '.join(near)}?" if near else f"known are {', '.join(there)}."
            raise InputError(f"quantities must be names of results, but {name!r} is none; {hint}")
    known = measures()
    return tuple(name for name, item in known.items() if there[name] and (not item.costly or name in wanted))
