"""An array-API library with the few operations that need to know the device."""

from __future__ import annotations

import math
from dataclasses import dataclass
from importlib import import_module
from typing import Any, cast

import numpy as np

from ..arrays import RealArray
from ..errors import InputError


@dataclass(frozen=True)
class Library:
    """Array-API namespace ``xp`` with the few operations that need to know the device."""

    xp: Any
    device: Any

    @classmethod
    def of(cls, namespace: Any, device: Any) -> Library:
        """Library of the module ``namespace``; its gaps to the standard are filled by array_api_compat."""
        if not hasattr(namespace, "zeros") or not hasattr(namespace, "__name__"):
            raise InputError(f"namespace of ArrayEngine must be a module such as cupy, but is {namespace!r}.")
        probe = namespace.zeros(1)
        xp = compat().array_namespace(probe)
        if not hasattr(xp, "fft"):
            raise _unfit("Fourier transforms", namespace)
        try:
            probe[...] = 1.0
        except TypeError:
            raise _unfit("writable arrays", namespace) from None
        return cls(xp, device)

    def array(self, values: RealArray | float, dtype: str) -> Any:
        """``values`` on the device."""
        host = np.ascontiguousarray(values, dtype=dtype)
        return self.xp.asarray(host, dtype=getattr(self.xp, dtype), device=self.device)

    def numpy(self, values: Any) -> RealArray:
        """``values`` in the memory of the host."""
        adapters = compat()
        if adapters.is_numpy_array(values):
            return np.asarray(values)
        if adapters.is_cupy_array(values) or adapters.is_torch_array(values):
            return np.asarray(adapters.to_device(values, "cpu"))
        return cast(RealArray, np.from_dlpack(values, device="cpu"))

    def zeros(self, shape: tuple[int, int], dtype: str) -> Any:
        """Field of zeros."""
        return self.xp.zeros(shape, dtype=getattr(self.xp, dtype), device=self.device)

    def numbers(self, scalars: list[Any]) -> list[float]:
        """Double-precision ``scalars`` of the device as Python numbers, in one transfer."""
        return [float(value) for value in self.numpy(self.xp.stack(scalars))]

    def select(self, mask: Any, values: Any, other: float = 0.0) -> Any:
        """``values`` where ``mask``, else ``other``."""
        return self.xp.where(mask, values, self.xp.full((), other, dtype=values.dtype, device=self.device))

    def count(self, mask: Any) -> Any:
        """Number of points of ``mask`` as a double."""
        return self.xp.sum(self.xp.astype(mask, self.xp.uint8), dtype=self.xp.float64)


def bound(library: Library, cap: Any, p: Any) -> Any:
    """Flat ``cap`` in a shape that fits ``p``: one number, or one for each point."""
    return library.xp.reshape(cap, p.shape if math.prod(cap.shape) > 1 else ())


def _unfit(what: str, namespace: Any) -> InputError:
    return InputError(
        f"namespace of ArrayEngine must be a library with {what}, but is {namespace.__name__}. Use for example cupy."
    )


def compat() -> Any:
    """array_api_compat; only who uses an array engine imports it."""
    return import_module("array_api_compat")
