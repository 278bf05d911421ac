"""Names for the array types used in signatures, arrays over steps, and digests of content."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any, TypeAlias, cast

import numpy as np
from numpy.typing import NDArray

RealArray: TypeAlias = NDArray[np.floating[Any]]
"""Real floating-point array, SI values."""

ComplexArray: TypeAlias = NDArray[np.complexfloating[Any, Any]]
"""Complex array, usually a half spectrum of shape (nx, ny // 2 + 1)."""

BoolArray: TypeAlias = NDArray[np.bool_]
"""Boolean array, for masks and contact maps."""


class OfSteps:
    """Attribute of a history: an array (steps,) of the numbers that its ``steps`` have by the same
    name."""

    def __init__(self, text: str) -> None:
        self.__doc__ = text

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, history: Any, kind: type | None = None) -> RealArray:
        if history is None:
            return cast("RealArray", self)
        return np.array([getattr(step, self._name) for step in history.steps], dtype=float)


# Content digests, so that a result can name its inputs exactly.


def array_digest(array: RealArray | BoolArray) -> str:
    """SHA-256 (hex) of shape, type and content of ``array``, the same on every machine."""
    data = np.ascontiguousarray(array)
    little = data.astype(data.dtype.newbyteorder("<"), copy=False)
    text = f"{little.dtype.str}{data.shape}"
    return hashlib.sha256(text.encode() + little.tobytes()).hexdigest()


def content_digest(value: Any) -> str:
    """SHA-256 (hex) of nested dictionaries, lists, text and numbers, whatever the order of keys;
    exact in every float."""
    text = json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=True, allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()


def file_digest(path: str | Path) -> str:
    """SHA-256 (hex) of the bytes of the file at ``path``."""
    with Path(path).open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
