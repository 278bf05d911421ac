"""What a contact solver asks of the machine it runs on: convolutions and fused passes over arrays.

Arrays of an engine are opaque to the solver: NumPy arrays on the CPU, arrays of an array-API library elsewhere.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

from ..arrays import RealArray


@dataclass(frozen=True)
class Totals:
    """Sums over one iterate, with r = u - h: p; p·r; p·h; p and p·r strictly between the bounds; and bounds of the level.

    ``lowest`` is min r, ``highest_capped`` max r at the cap (or -inf), ``lowest_open`` min r at zero pressure (or inf).
    """

    pressure: float
    work: float
    height: float
    weight: float
    weighted: float
    lowest: float
    highest_capped: float
    lowest_open: float


@dataclass(frozen=True)
class Violation:
    """Sums of (r - level)+ p and (level - r)+ (cap - p), and the largest level - r below the cap."""

    above: float
    below: float
    deepest: float


class Convolution(Protocol):
    """Prepared product with a real, even kernel in Fourier space; owns its buffers."""

    def apply(self, field: Any, out: Any) -> Any:
        """Convolve ``field`` into ``out`` and return it."""

    def solve(self, field: Any, out: Any) -> Any:
        """Divide by the kernel instead; the mean mode, whose kernel may be zero, by twice the largest entry."""


class Face(Protocol):
    """Working set: the points whose pressure may move. Vectors of a face are opaque to the solver."""

    @property
    def size(self) -> int:
        """Number of points."""

    @property
    def entering(self) -> int:
        """Number of points that enter from a bound."""

    def residual(self, *, centred: bool) -> Any:
        """Vector (level - r) / scale, freed of its mean if ``centred``; also laid out in the field."""

    def zeros(self) -> Any:
        """Vector of zeros."""

    def lay(self, values: Any) -> None:
        """Lay the vector ``values`` out in the field."""

    def copied(self, values: Any) -> Any:
        """Copy of the vector ``values`` that later calls leave alone (``gather`` reuses its memory)."""

    def product(self, a: Any, b: Any) -> float:
        """Sum of a b, two vectors."""

    def gather(self, field: Any, other: Any) -> tuple[Any, tuple[float, float]]:
        """Vector of ``field``, with its sum and its product with the vector ``other``."""

    def direct(self, z: Any, mean: float, ratio: float, t: Any) -> Any:
        """Vector (z - mean) + ratio t, laid out in the field."""

    def advance(self, length: float, t: Any, kt: Any, mean: float, d: Any, r: Any) -> tuple[Any, Any]:
        """Vectors d + length t and r - length (kt - mean), the latter laid out in the field."""

    def pressure(self, p: Any, d: Any, scale: float, cap: Any, out: Any) -> tuple[float, int]:
        """Write p + scale d, clipped to [0, cap], into ``out``; return the change of its sum and the points clipped."""


class Engine(Protocol):
    """A machine: arrays, convolutions, passes. Results of equal calls do not depend on its number of threads."""

    @property
    def name(self) -> str:
        """Name for provenance."""

    def array(self, values: RealArray | float, dtype: str) -> Any:
        """``values`` as an array of this engine of type ``float64`` or ``float32`` (a copy where needed)."""

    def numpy(self, values: Any) -> RealArray:
        """``values`` as a NumPy array."""

    def zeros(self, shape: tuple[int, int], dtype: str) -> Any:
        """Field of zeros."""

    def field(self, shape: tuple[int, int], dtype: str) -> Any:
        """Field of zeros for convolutions and faces, in whatever memory layout suits the transforms."""

    def convolution(self, kernel: RealArray, shape: tuple[int, int], dtype: str) -> Convolution:
        """Periodic convolution of fields of ``shape`` with the half-spectrum ``kernel``."""

    def padded_convolution(
        self, kernel: RealArray, shape: tuple[int, int], padded: tuple[int, int], dtype: str
    ) -> Convolution:
        """Free convolution: fields of ``shape`` zero-padded to ``padded``, where ``kernel`` lives."""

    def totals(self, p: Any, u: Any, h: Any, cap: Any) -> Totals:
        """Sums over an iterate; ``cap`` is None for no cap."""

    def violation(self, p: Any, u: Any, h: Any, cap: Any, level: float) -> Violation:
        """How far an iterate is from the contact conditions at ``level``."""

    def face(self, p: Any, u: Any, h: Any, cap: Any, level: float, scale: float, field: Any) -> Face:
        """Working set at ``level``; ``field`` (working precision) must be zero outside the previous face."""

    def release(self, face: Face, field: Any) -> None:
        """Set ``field`` to zero on ``face`` again."""

    def rescale(self, p: Any, factor: float) -> None:
        """p *= factor in place."""

    def copy(self, source: Any, out: Any) -> None:
        """out[...] = source."""

    def segment(self, p: Any, q: Any, u: Any, v: Any, h: Any) -> tuple[float, float]:
        """Slope (u - h)·(q - p) and curvature (v - u)·(q - p) of the energy from p to q."""

    def blend(self, a: Any, b: Any, weight: float) -> None:
        """b = a + weight (b - a) in place."""
