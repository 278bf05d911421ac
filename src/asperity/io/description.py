"""What files say of things: bodies, laws, boundaries and controls as plain dictionaries and back,
exact; and where a result comes from."""

from __future__ import annotations

import functools
import math
import platform
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import fields, is_dataclass
from datetime import UTC, datetime
from importlib import metadata
from types import MappingProxyType
from typing import Any, TypeVar, get_args

import numpy as np

from ..contact.boundary import Boundary
from ..contact.controls import Control
from ..contact.couplings.driver import CouplingCheck
from ..contact.law import Hardness, HardWall
from ..contact.problem import Flat, Physics
from ..contact.result import ContactResult
from ..contact.tangential import Tangential
from ..core.arrays import RealArray, array_digest
from ..core.errors import FileFormatError, InputError
from ..core.registry import DESCRIBED, GROUP, PHYSICS, home
from ..core.spectral import fft_library
from ..solids.elastic import Conduction, Strength
from ..solids.layers import Body, Interface, Layer, RigidBase
from ..solids.plasticity import LinearHardening, Swift, Voce
from ..solids.viscoelastic import TemperatureShift, Viscoelastic
from ..surfaces.surface import Surface

Kind = TypeVar("Kind")

TYPES: tuple[type, ...] = (
    *get_args(Body),
    *get_args(Boundary),
    *get_args(Control),
    *get_args(Interface),
    *get_args(Tangential),
    *get_args(TemperatureShift),
    Conduction,
    CouplingCheck,
    Flat,
    Hardness,
    HardWall,
    Layer,
    LinearHardening,
    RigidBase,
    Strength,
    Swift,
    Viscoelastic,
    Voce,
)
"""Types that can be written beside those of the physics: frozen dataclasses of numbers, text,
arrays, tuples and one another."""

_PLAIN: Mapping[str, type] = MappingProxyType({kind.__name__: kind for kind in TYPES})


def _without_physics(name: str) -> Mapping[str, type]:
    """Types of which one has this ``name``, if that takes no import of all physics, a quarter of a
    second; else none."""
    if name in _PLAIN:
        return _PLAIN
    places = [place for place in DESCRIBED if place.partition(":")[2] == name]
    return {name: home(places[0])} if places else {}


def known_types() -> dict[str, type]:
    """All types that can be written by name, those of a physics of one's own by qualified name,
    once that has been imported."""
    own = (kind for known in PHYSICS.values() for kind in home(known.home).types)
    found = {kind.__name__: kind for kind in (*TYPES, *map(home, DESCRIBED), *own)}
    for physics in subclasses(Physics):
        if not physics.__module__.startswith("asperity."):
            found |= {kind_name(kind): kind for kind in (physics, *physics.types)}
    return found


def import_of_package(place: str) -> None:
    """Import the parts that an installed package adds, of which the type at this ``place`` is, such
    as ``hot_spots.law:Glue``; nothing if none is, or it cannot be imported."""
    package = place.partition(":")[0].partition(".")[0]
    for entry in metadata.entry_points(group=GROUP):
        if entry.module.partition(".")[0] == package:
            with suppress(Exception):  # what ``parts()`` warns of
                entry.load()


def kind_name(kind: type) -> str:
    """Qualified name of a type, by which files know those that are none of this package's."""
    return f"{kind.__module__}:{kind.__qualname__}"


def subclasses(kind: type[Kind]) -> Iterator[type[Kind]]:
    """All subclasses of ``kind`` that have been defined."""
    for below in kind.__subclasses__():
        yield below
        yield from subclasses(below)


ARRAY = "array"
"""Key that stands for an (nx, ny) array, which is kept beside the dictionary under the name it
holds."""

NUMBER = "number"
"""Key that stands for a number that JSON lacks: nan or an infinity, as text."""


def describe(value: object, arrays: dict[str, RealArray] | None = None, name: str = "") -> Any:
    """Plain dictionary ``{"type": ..., field: ...}`` of ``value``; arrays go into ``arrays`` under
    their field's name.

    Raises
    ------
    InputError
        If ``value`` is of a type that files do not know (for example an interface law of one's
        own).
    """
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return {NUMBER: repr(value)}
    if value is None or isinstance(value, str | bool | int | float):
        return value
    if isinstance(value, tuple | list):
        return [describe(item, arrays, name) for item in value]
    if isinstance(value, np.ndarray) and arrays is not None and name not in arrays:
        arrays[name] = value
        return {ARRAY: name}
    kinds = _without_physics(type(value).__name__)
    if kinds.get(type(value).__name__) is not type(value):
        kinds = known_types()
    for name_of in (type(value).__name__, kind_name(type(value))):
        if is_dataclass(value) and kinds.get(name_of) is type(value):
            entries = {f.name: getattr(value, f.name) for f in fields(value) if f.init}
            kind = type(value).__name__
            return {"type": name_of, **{key: describe(item, arrays, f"{kind}_{key}") for key, item in entries.items()}}
    raise InputError(
        f"every part of a result to be saved must be one of {', '.join(sorted(kinds))}, numbers "
        f"or text, but {name or 'one'} is {type(value).__name__}; export its fields instead. Of a physics of your own "
        "name its types in `types` of that."
    )


def rebuild(description: Any, arrays: Mapping[str, RealArray] | None = None) -> Any:
    """The value that ``describe`` made ``description`` and ``arrays`` from.

    Raises
    ------
    FileFormatError
        If it names an unknown type or lacks an array.
    """
    if isinstance(description, list):
        return tuple(rebuild(item, arrays) for item in description)
    if not isinstance(description, dict):
        return description
    if NUMBER in description:
        return float(description[NUMBER])
    if ARRAY in description:
        if arrays is None or description[ARRAY] not in arrays:
            raise FileFormatError(f"result file must hold the array {description[ARRAY]!r}, but does not.")
        return arrays[description[ARRAY]]
    name = description.get("type")
    kinds = _without_physics(name) if isinstance(name, str) else {}
    kinds = kinds or known_types()
    if isinstance(name, str) and name not in kinds and ":" in name:
        import_of_package(name)
        kinds = known_types()
    if not isinstance(name, str) or name not in kinds:
        raise FileFormatError(
            f"type in a result file must be one of {', '.join(sorted(kinds))}, but is {name!r}; import what defines "
            "it, or update asperity."
        )
    return kinds[name](**{key: rebuild(item, arrays) for key, item in description.items() if key != "type"})


# Where a result comes from: software, machine, time, and inputs by content.


def software() -> dict[str, str]:
    """Versions of asperity, Python and the numerical libraries, and the platform."""
    library = fft_library()
    return {
        "asperity": _version("asperity"),
        "python": platform.python_version(),
        "numpy": _version("numpy"),
        "scipy": _version("scipy"),
        "fft_library": f"{library} {_version(library)}",
        "platform": platform.platform(),
    }


def surface_provenance(surface: Surface) -> dict[str, Any]:
    """Origin of ``surface`` and the SHA-256 digest of its heights, as plain text and lists."""
    origin = surface.origin
    return {
        "source": origin.source,
        "channel": origin.channel,
        "instrument": {str(key): str(value) for key, value in origin.instrument.items()},
        "history": list(origin.history),
        "citation_keys": list(origin.citation_keys),
        "digest": array_digest(surface.heights),
    }


def provenance(result: ContactResult, packages: Mapping[str, str] = MappingProxyType({})) -> dict[str, Any]:
    """Provenance of ``result`` as it is written now: a dictionary of text, lists and dictionaries,
    fit for JSON.

    ``packages`` are versions of further software by its name.

    Keys: ``created`` (UTC, ISO 8601), ``software``, ``surface``, ``counter_surface`` (only if it is
    rough) and ``citation_keys``.
    """
    described: dict[str, Any] = {
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        "software": {**software(), **packages},
        "surface": surface_provenance(result.problem.surface),
    }
    counter = result.problem.counter_surface
    if isinstance(counter, Surface):
        described["counter_surface"] = surface_provenance(counter)
    return {**described, "citation_keys": list(result.citation_keys)}


@functools.cache
def _version(distribution: str) -> str:
    try:
        return metadata.version(distribution)
    except metadata.PackageNotFoundError:  # run from a source tree
        return "unknown"
