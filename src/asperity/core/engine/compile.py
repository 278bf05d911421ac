"""The decorator of compiled passes: their code is kept on disk, and processes that compile at once
do not mix it up."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

from numba import njit

REORDERED = frozenset({"reassoc", "contract", "nsz"})
"""Freedom of sums and products for vector instructions; NaN and infinity stay what they are."""


def passes(*, fastmath: frozenset[str] = frozenset(), **options: Any) -> Callable[[Any], Any]:
    """Decorator that compiles a function for each kind of its arguments and keeps the code beside
    the sources; ``fastmath`` and other options are those of ``numba.njit``.

    Numba numbers the files of a function in an index. Two processes that compile it at once for
    different arguments take the same number, and one of them finds the code of the other later, for
    arguments of another kind. With the number of the process in the names an entry of the index can
    be lost, which costs compiling it once more, and is never wrong.
    """
    decorate = njit(nogil=True, cache=True, error_model="numpy", fastmath=set(fastmath) or False, **options)

    def compiled(function: Any) -> Any:
        made = decorate(function)
        files = getattr(getattr(made, "_cache", None), "_cache_file", None)  # none where nothing is compiled
        if files is not None:
            pattern = files._data_name_pattern.removesuffix(".nbc")
            files._data_name = lambda number: f"{pattern.format(number=number)}-{os.getpid()}.nbc"
        return made

    return compiled
