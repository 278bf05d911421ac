"""What a contact solver asks of the machine it runs on: convolutions and fused passes over arrays.

Arrays of an engine are opaque to the solver: NumPy arrays on the CPU, arrays of an array-API library elsewhere.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol

from ..arrays import RealArray

NEAR_CAP = 1.0 - 1e-14
"""Share of its cap from which on a pressure that is scaled counts as being at the cap."""


@dataclass(frozen=True)
class Totals:
    """Sums over one iterate, with r = u - h: p; p·r; p and p·r strictly between the bounds; and bounds of the level.

    ``lowest`` is min r, ``highest_capped`` max r at the cap (or -inf), ``lowest_open`` min r at zero pressure (or inf);
    without a cap, where it matters only if nothing is loaded, min r.
    """

    pressure: float
    work: float
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


@dataclass(frozen=True)
class Load:
    """Sums over the points of a working set: p; p strictly between the bounds; and the number of points below the cap."""

    pressure: float
    movable: float
    below: int


class Products(NamedTuple):
    """Vector of a working set, its sum, and its products with two others."""

    vector: Any
    total: float
    first: float
    second: float


@dataclass(frozen=True)
class Merge:
    """How the cells of one level form those of the next: pairs along the axes that ``x`` and ``y`` name.

    ``offset_x`` and ``offset_y`` (0 or 1) say whether the first cell stands alone; ``weight`` is the deflection that a
    unit load on a merged cell adds to all of its points, over that of a point under its own load.
    """

    x: bool
    y: bool
    offset_x: int
    offset_y: int
    weight: float


@dataclass(frozen=True)
class Hierarchy:
    """Nested cells from single points up by ``merges``, of points moved by ``roll`` before; what leaves at one end enters at
    the other, so that cells reach over the borders of a periodic grid."""

    merges: tuple[Merge, ...]
    roll: tuple[int, int] = (0, 0)


@dataclass(frozen=True, eq=False)
class CellWaves:
    """True compliance of pressures constant on the cells of level ``depth``, in place of constants from there on up.

    ``kernel`` is the half spectrum, on the grid ``padded``, of a convolution of fields of the shape ``cells`` (at least
    that of the level): deflection by unit loads on cells, as in ``Merge``, beyond what the levels below give. It is not
    negative. On a periodic grid ``padded`` is ``cells``.
    """

    depth: int
    kernel: RealArray
    cells: tuple[int, int]
    padded: tuple[int, int]


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
        """Vector (level - r) / scale, freed of its mean if ``centred``."""

    def copied(self, vector: Any) -> Any:
        """Copy of ``vector`` that may be overwritten."""

    def zeros(self) -> Any:
        """Vector of zeros."""

    def lay(self, values: Any, field: Any, added: float | None = None) -> None:
        """Lay the vector ``values`` out in the field of the convolution; or add ``added`` times it to what lies there."""

    def press(self, p: Any, factor: float, scale: float) -> Any:
        """Set p on the face to factor times p where it is positive, else to 0; the change over ``scale`` as a vector.

        The residual vector may be overwritten.
        """

    def lay_change(self, old: Any, values: Any, r: Any, field: Any) -> tuple[Any, float]:
        """Vector ``values`` - ``old``, also laid out in the field, and its product with r.

        ``old`` is what ``pick`` gave of the array ``values`` before a change.
        """

    def gather(self, field: Any, a: Any, b: Any, out: Any) -> Products:
        """Vector of ``field``, in the memory of the vector ``out`` where that can be, and its products with a and b."""

    def direct(self, z: Any, mean: float, ratio: float, t: Any, r: Any, field: Any) -> tuple[Any, float]:
        """Vector (z - mean) + ratio t, laid out in the field, and its product with r; ``t`` may be overwritten."""

    def advance(self, length: float, t: Any, kt: Any, mean: float, d: Any, r: Any) -> tuple[Any, Any]:
        """Vectors d + length t and r - length (kt - mean); ``d`` and ``r`` may be overwritten."""

    def pick(self, values: Any) -> tuple[Any, float]:
        """Vector of the array ``values`` (pressure or deflection) in its precision, and its sum."""

    def blend(self, old: Any, share: float, values: Any) -> None:
        """Set the array ``values`` on the face to old + share (values - old)."""

    def shift(self, p: Any, d: Any, scale: float) -> tuple[int, float]:
        """p + scale d on the face, in place; the number of points then below 0, and by how much in all."""

    def move(self, p: Any, d: Any, scale: float, cap: Any) -> tuple[Load, int]:
        """p + scale d on the face, clipped to [0, cap], in place; the load, and the number of points clipped."""

    def scale(self, p: Any, factor: float, shift: float, cap: Any) -> Load:
        """factor p + shift where p is below the cap, clipped to it, in place; the load afterwards."""


class Cells(Protocol):
    """A compliance of nested cells and its inverse on a working set; the mean over two hierarchies.

    The inverse is exact without waves; with them but for the loads on their cells, found by one step of conjugate gradients.
    """

    def restrict(self, face: Face) -> None:
        """Prepare for the points of ``face``."""

    def solve(self, face: Face, r: Any, other: Any, out: Any) -> Products:
        """Vector z = inverse times r, z·r and z·other; in the memory of the vector ``out`` where that can be."""

    def relieved(self, face: Face, r: Any, loaded: Face, change: Any, factor: float) -> Any:
        """Vector r - factor times the deflection of the cells that the points of ``face`` lie in.

        ``change`` is the load, a vector of the face ``loaded``. What single points deflect under their own load is left out.
        Afterwards the inverse must be prepared again.
        """


class Survey(Protocol):
    """One iterate seen as a whole."""

    @property
    def totals(self) -> Totals:
        """Sums over it."""

    def face(self, level: float, scale: float, dtype: str) -> Face:
        """Working set at ``level``, with vectors of the precision ``dtype``.

        Its points are those strictly between the bounds, and those at a bound whose gap is on the wrong side of the
        level of their neighbourhood (see ``neighbourhood``). Negative pressures count as 0, but do not enter.
        """


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
        """Array of zeros."""

    def field(self, shape: tuple[int, int], dtype: str) -> Any:
        """Field of zeros for convolutions and faces, in whatever memory layout suits the transforms."""

    def convolution(self, kernel: RealArray, shape: tuple[int, int], dtype: str) -> Convolution:
        """Periodic convolution of fields of ``shape`` with the half-spectrum ``kernel``."""

    def padded_convolution(
        self, kernel: RealArray, shape: tuple[int, int], padded: tuple[int, int], dtype: str
    ) -> Convolution:
        """Free convolution: fields of ``shape`` zero-padded to ``padded``, where ``kernel`` lives."""

    def cells(
        self, shape: tuple[int, int], hierarchies: tuple[Hierarchy, Hierarchy], waves: CellWaves | None, dtype: str
    ) -> Cells:
        """Nested cells on points of ``shape``, for vectors of the precision ``dtype``."""

    def refined(self, coarse: RealArray, coarse_heights: RealArray, heights: RealArray, stiffness: float) -> RealArray:
        """Pressure on the points of ``heights`` from the one on half as many per side, all NumPy arrays.

        Where the ``coarse`` one is not zero, ``stiffness`` times what the coarse heights do not show is added, down to
        zero.
        """

    def survey(self, p: Any, u: Any, h: Any, cap: Any) -> Survey:
        """Survey of an iterate; ``cap`` is None for no cap."""

    def violation(self, p: Any, u: Any, h: Any, cap: Any, level: float) -> Violation:
        """How far an iterate is from the contact conditions at ``level``."""

    def add(self, field: Any, factor: float, values: Any) -> None:
        """Add ``factor`` times a field to the array ``values``."""

    def release(self, face: Face, field: Any) -> None:
        """Set ``field`` to zero on ``face`` again."""
