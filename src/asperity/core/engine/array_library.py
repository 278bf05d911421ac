"""An array-API library with the few operations that depend on the device."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import Any, cast

import numpy as np

from ..arrays import RealArray
from ..errors import InputError


@dataclass(frozen=True)
class Library:
    """Array-API namespace ``xp`` with the few operations that depend on the device."""

    xp: Any
    device: Any

    @classmethod
    def of(cls, namespace: Any, device: Any) -> Library:
        """Library of the module ``namespace``; its gaps to the standard are filled by
        array_api_compat."""
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

    def array(self, values: Any, dtype: str) -> Any:
        """``values`` on the device, where they may be already."""
        adapters = compat()
        if adapters.is_array_api_obj(values) and not adapters.is_numpy_array(values):
            return self.xp.astype(values, getattr(self.xp, dtype), copy=False)
        host = np.ascontiguousarray(values, dtype=dtype)
        return self.xp.asarray(host, dtype=getattr(self.xp, dtype), device=self.device)

    def numpy(self, values: Any) -> RealArray:
        """``values`` in the memory of the host."""
        adapters = compat()
        if adapters.is_numpy_array(values):
            return np.asarray(values)
        if adapters.is_cupy_array(values) or adapters.is_torch_array(values):
            return np.asarray(adapters.to_device(values, "cpu"))
        host = cast(RealArray, np.from_dlpack(values, device="cpu"))
        return host if host.flags.writeable else host.copy()  # numpy 2.1 gives an array that cannot be written to

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


def _unfit(what: str, namespace: Any) -> InputError:
    return InputError(
        f"namespace of ArrayEngine must be a library with {what}, but is {namespace.__name__}. Use for example cupy."
    )


def compat() -> Any:
    """array_api_compat; only who uses an array engine imports it."""
    return import_module("array_api_compat")
