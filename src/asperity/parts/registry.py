"""Which parts there are: those of this package, and those that installed packages add by the entry
point ``asperity.parts``."""

from __future__ import annotations

import functools
import warnings
from collections.abc import Iterable
from importlib import metadata

from ..core.errors import InputError
from ..core.registry import GROUP, PARTS, home
from .part import Part


@functools.cache
def parts() -> tuple[Part, ...]:
    """All parts: the built-in ones, then those of other packages by name. One that cannot be used
    is left out with a warning."""
    found: list[Part] = [home(place)() for place in PARTS]
    for entry in sorted(metadata.entry_points(group=GROUP), key=lambda item: item.name):
        try:
            found.append(usable(entry.load(), found))
        except Exception as error:
            text = f"part {entry.name!r} of {_package(entry)} is left out: {' '.join(str(error).split())}"
            warnings.warn(text, stacklevel=2)
    return tuple(found)


def versions() -> dict[str, str]:
    """Version of every package that adds a part, by its name."""
    own = {type(part).__module__.partition(".")[0] for part in parts()} - {"asperity"}
    entries = metadata.entry_points(group=GROUP)
    used = {
        _package(entry): entry.dist.version for entry in entries if entry.dist and entry.module.partition(".")[0] in own
    }
    return dict(sorted(used.items()))


def with_own(own: Iterable[object]) -> tuple[Part, ...]:
    """All parts, and after them ``own`` ones that no package adds, each a ``Part``, the class or an
    instance of it.

    Raises
    ------
    InputError
        If one is no part, or has a name, a table or a quantity of another one.
    """
    found = list(parts())
    for item in own:
        try:
            found.append(usable(item, found))
        except ValueError as error:
            raise InputError(f"part of one's own must be usable, but of {item!r} {error}.") from None
    return tuple(found)


def usable(loaded: object, known: list[Part]) -> Part:
    """The part that ``loaded`` is.

    Raises
    ------
    ValueError
        If it is no part, or has a name that a ``known`` one has.
    """
    part = loaded() if isinstance(loaded, type) else loaded
    if not isinstance(part, Part) or not part.name.isidentifier():
        raise ValueError("it must be an asperity.parts.part.Part with a name that is an identifier")
    names = {name for item in known for name in (item.name, item.table) if name}
    if {part.name, part.table} & names:
        raise ValueError(f"there is another part with the name or table {part.name!r}")
    quantities = {item.name for other in known for item in other.quantities}
    taken = sorted(quantities & {item.name for item in part.quantities})
    if taken:
        raise ValueError(f"its quantity {taken[0]!r} is one of another part")
    return part


def _package(entry: metadata.EntryPoint) -> str:
    return entry.dist.name if entry.dist is not None else entry.module
