"""Content digests, so that a result can name its inputs exactly."""

from __future__ import annotations

import hashlib

import numpy as np

from .arrays import BoolArray, RealArray


def array_digest(array: RealArray | BoolArray) -> str:
    """SHA-256 (hex) of shape, type and content of ``array``, the same on every machine."""
    data = np.ascontiguousarray(array)
    little = data.astype(data.dtype.newbyteorder("<"), copy=False)
    text = f"{little.dtype.str}{data.shape}"
    return hashlib.sha256(text.encode() + little.tobytes()).hexdigest()
