"""The command ``contact`` for notebooks and scripts: one call from a file of heights to everything
that is computed of the contact."""

from __future__ import annotations

import difflib
import os
import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any, Literal

from ..core.errors import InputError
from ..run.build import build
from ..run.document import checked
from ..run.execute import Outcome, execute
from .contact import asked_table, contact_options
from .declared import Given, part_names, with_parts


def press(
    surface: str | os.PathLike[str],
    *,
    compute: Iterable[str] = (),
    on_failure: Literal["raise", "return"] = "raise",
    **options: Any,
) -> Outcome:
    """Press the rough surface in a file against a body: the same as the command
    ``asperity contact``, by the same executor.

    Parameters
    ----------
    surface
        File with the heights.
    compute
        Parts to compute with their defaults: ``"stress"``, ``"plastic_load"``, …
    on_failure
        ``"raise"`` a ConvergenceError if the solve does not converge, or ``"return"`` the outcome
        with its status.
    options
        The options of ``asperity contact``, hyphens as underscores: ``body="DLC:5nm/steel"``,
        ``pressure="50 MPa"``, ``friction=0.3``, ``periodise=True``. Text with units, as there;
        numbers where there is no unit.

    Returns
    -------
    Outcome
        With ``verdict``, ``result``, ``path``, ``values`` and ``findings``; a card in notebooks.
        ``write_report(outcome, "report.html")`` writes its page.

    Raises
    ------
    InputError
        If an option does not exist, has a value that it cannot have, or the body or the load is not
        given.
    NoSolutionError
        If the load has no solution.
    ConvergenceError
        If the solve does not converge and ``on_failure`` is ``"raise"``.

    Examples
    --------
    >>> outcome = asp.press(  # doctest: +SKIP
    ...     "scan.di", body="DLC:5nm/steel", pressure="50 MPa", friction=0.3
    ... )
    >>> outcome.verdict.what  # doctest: +SKIP
    """
    offered = contact_options()
    known = {option.word: option for option in offered if option.path[0] not in ("output", "yes")}
    values = {}
    for name, value in options.items():
        if name not in known:
            near = difflib.get_close_matches(name, known, n=1)
            hint = f"; did you mean {near[0]}?" if near else ". The command `asperity contact --help` lists them."
            raise InputError(
                f"arguments of asperity.press must be options of `asperity contact`, but {name!r} is none{hint}"
            )
        values[known[name].path] = value if isinstance(value, bool | list | tuple) else str(value)
    given = Given(values, offered)
    try:
        table, names, base = asked_table(Path(surface), None, given)
        table = with_parts(table, given, (*compute, *given.under("asked").table()))
        document = checked(table, "asperity.press", names | part_names(given, everything=True))
        case = build(document, base)
    except InputError as error:  # arguments are called as the options, but for the hyphens
        error.args = tuple(_OPTION.sub(lambda found: found[1].replace("-", "_"), str(text)) for text in error.args)
        raise
    return execute(case, on_failure=on_failure)


_OPTION = re.compile(r"--([a-z][a-z-]*)")
