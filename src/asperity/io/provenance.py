"""Where a result comes from: software, machine, time, and inputs by content."""

from __future__ import annotations

import platform
from collections.abc import Mapping
from datetime import UTC, datetime
from importlib import metadata
from types import MappingProxyType
from typing import Any

from ..contact.result import ContactResult
from ..core.arrays import array_digest
from ..core.spectral import fft_library
from ..surfaces.surface import Surface


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
    """Provenance of ``result`` as it is written now: a dictionary of text, lists and dictionaries, fit for JSON.

    ``packages`` are versions of further software by its name.

    Keys: ``created`` (UTC, ISO 8601), ``software``, ``surface``, ``counter_surface`` (only if it is rough) and
    ``citation_keys``.
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


def _version(distribution: str) -> str:
    try:
        return metadata.version(distribution)
    except metadata.PackageNotFoundError:  # run from a source tree
        return "unknown"
