"""Pressure to deflection on a periodic or free grid by transforms: prepared once, applied many
times."""

from __future__ import annotations

import math
from functools import cached_property, lru_cache
from threading import Lock
from typing import Any, Protocol

import numpy as np

from ...core.arrays import RealArray
from ...core.engine import Convolution, CpuEngine, Engine
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.spectral import RealTransform, fast_length, wrapped
from ...solids.compliance.halfspace import Compliance, HalfSpace
from ..boundary import Boundary, Free, FreeLine, Periodic

# What a solver may ask of an operator.


_OCTAVES_AHEAD = 8
"""Octaves computed in advance beyond the wavenumbers asked for: from the coarsest grid of 64²
points up to 16384²."""


class Spectral(Protocol):
    """A function of the wavenumber."""

    def spectral(self, wavenumber: RealArray) -> RealArray:
        """Displacement per traction in m/Pa at each ``wavenumber`` q > 0 (rad/m)."""


class Octaves:
    """Compliance at the few wavenumbers, an octave apart or in equal parts of one, that
    preconditioners of all grids need; values are kept.

    Few values cost as much as one: 3 to 10 ms for 32 sublayers, eight times in one solve at 512² if
    nothing is kept.
    """

    def __init__(self, compliance: Spectral) -> None:
        self._compliance = compliance
        self._known: dict[int, float] = {}
        self._adding = Lock()  # chains of a history ask from several threads

    def spectral(self, wavenumber: RealArray) -> RealArray:
        """Displacement per pressure (m/Pa) at each ``wavenumber`` (rad/m, one-dimensional), to 1e-9
        of it."""
        keys = [round(1e9 * math.log2(q)) for q in wavenumber.tolist()]  # equal where they differ by rounding
        with self._adding:
            if not all(key in self._known for key in keys):
                ahead = np.multiply.outer(2.0 ** np.arange(_OCTAVES_AHEAD + 1), wavenumber).ravel()
                missing = {key: q for q in ahead.tolist() if (key := round(1e9 * math.log2(q))) not in self._known}
                found = np.asarray(self._compliance.spectral(np.array(list(missing.values()))), dtype=float)
                self._known.update(zip(missing, found.tolist(), strict=True))
        return np.array([self._known[key] for key in keys])


@lru_cache(maxsize=16)
def octaves_of(compliance: Spectral) -> Octaves:
    """The same for all operators of a ``compliance``."""
    return Octaves(compliance)


class Operator(Protocol):
    """Linear, symmetric, positive semi-definite map from pressure (Pa) to normal displacement (m)
    on a grid."""

    @property
    def grid(self) -> Grid:
        """Grid of pressure and displacement."""

    @property
    def compliance(self) -> Compliance:
        """Solid it was prepared for."""

    @property
    def octaves(self) -> Octaves:
        """Its values at a few wavenumbers, shared with the operators of coarser grids."""

    @property
    def boundary(self) -> Boundary:
        """Boundary it was prepared for."""

    @property
    def zero_mean_mode(self) -> bool:
        """Whether a uniform pressure gives no displacement (periodic half-space: its datum is the
        mean)."""

    @property
    def translation_invariant(self) -> bool:
        """Whether a pressure displaces alike wherever it acts, so that the model by which methods
        are preconditioned has the right size everywhere."""

    @property
    def beside(self) -> RealArray | None:
        """What points yield (m/Pa, (nx, ny), >= 0) to their own load beside what ``octaves`` tell;
        None where it is nothing."""

    @property
    def pairs_per_application(self) -> float:
        """Cost of one application in real FFT pairs of the grid."""

    @property
    def engine(self) -> Engine:
        """Machine that applies it."""

    @property
    def kernel(self) -> RealArray:
        """Compliance (m/Pa) on the half spectrum of the grid or of its padded form."""

    @property
    def largest(self) -> float:
        """Largest entry of it (m/Pa), that of the longest waves; it sets the scale."""

    @property
    def smallest(self) -> float:
        """Compliance (m/Pa) of the wave of the grid that gives way least: p·Kp is at least this
        times p·p, which bounds the error of a pressure."""

    @property
    def padded(self) -> tuple[int, int]:
        """Shape of the grid whose half spectrum ``kernel`` holds."""

    @property
    def coarsened(self) -> Operator:
        """Operator of the same solid on half as many points per side."""

    def convolution(self, dtype: str, scale: float = 1.0) -> Convolution:
        """Prepared application, divided by ``scale``, on arrays of the engine in the precision
        ``dtype``."""

    def apply(self, pressure: RealArray) -> RealArray:
        """Displacement (nx, ny) in m under ``pressure`` (nx, ny) in Pa; a new array."""

    def matrix(self) -> RealArray:
        """Dense symmetric matrix (n, n) in m/Pa over the n = nx·ny points in C order; for small
        grids only."""


def prepare_operator(
    compliance: Compliance, grid: Grid, boundary: Boundary, *, engine: Engine | None = None
) -> Operator:
    """Pressure-displacement operator, to be held by the caller and reused in further solves of the
    same problem.

    ``compliance``, ``grid`` and ``boundary`` are those of the problem; ``engine`` is the machine to
    compute on, the CPU with ASPERITY_THREADS or all cores by default.

    Raises
    ------
    InputError
        If the boundary is none of them, or the grid is no line where it must be.
    """
    if isinstance(boundary, Periodic):
        return PeriodicOperator(compliance, grid, engine=engine)
    if isinstance(boundary, Free | FreeLine):
        return FreeOperator(compliance, grid, boundary, engine=engine)
    raise InputError(f"boundary of an operator must be Periodic(), Free() or FreeLine(), but is {boundary!r}.")


_LEAST_SHARE = 0.8
"""Least eigenvalue of the compliance of a free grid over that of its waves an octave apart."""


class PreparedOperator:
    """What periodic and free operators share: transforms and their buffers, prepared at first use
    and kept."""

    grid: Grid
    engine: Engine
    padded: tuple[int, int]
    kernel: RealArray
    octaves: Octaves
    zero_mean_mode: bool
    translation_invariant: bool = True
    beside: RealArray | None = None

    @cached_property
    def _resident(self) -> Any:
        """``kernel`` where the engine computes with it."""
        return self.engine.resident(self.kernel)

    @cached_property
    def largest(self) -> float:
        """Largest compliance (m/Pa)."""
        return float(self._resident.max())

    @cached_property
    def smallest(self) -> float:
        """Least compliance (m/Pa) of the waves on the grid, the mean mode aside where a uniform
        pressure moves nothing; infinite without waves.

        Periodic eigenvalues are the entries of ``kernel``. On padded grids its least is below all,
        but for coated bodies, whose influence is cut off, far below or negative; there waves an
        octave apart tell more: of random layered bodies the least eigenvalue was 0.90 to 1.32 of
        theirs.
        """
        entries = self._resident.ravel()[1:] if self.zero_mean_mode else self._resident.ravel()
        least = float(entries.min()) if entries.shape[0] else math.inf
        if self.padded == self.grid.shape:
            return least
        qx, qy = (float(abs(q).max()) for q in self.grid.wavevector())
        octaves = range(math.ceil(math.log2(max(self.grid.shape))) + 2)
        return _LEAST_SHARE * float(
            self.octaves.spectral(np.array([math.hypot(qx, qy) / 2.0**k for k in octaves])).min()
        )

    def convolution(self, dtype: str, scale: float = 1.0) -> Convolution:
        """Prepared product with the compliance over ``scale`` in the precision ``dtype``."""
        known: dict[tuple[str, float], Convolution] = vars(self).setdefault("_convolutions", {})
        if (dtype, scale) not in known:
            kernel, shape = self._resident if scale == 1.0 else self._resident / scale, self.grid.shape
            padded = None if self.padded == shape else self.padded
            known[dtype, scale] = self.engine.convolution(kernel, shape, dtype, padded)
        return known[dtype, scale]

    def apply(self, pressure: RealArray) -> RealArray:
        """Displacement (nx, ny) in m under ``pressure`` (nx, ny) in Pa in double precision, a new
        array.

        It is relative to its mean where the mean mode is zero; on a free grid zero at infinity
        (strips: at the datum).
        """
        field, out = self.engine.array(pressure, "float64"), self.engine.zeros(self.grid.shape, "float64")
        return self.engine.numpy(self.convolution("float64").apply(field, out))


# Periodic contact: multiplication by the compliance in Fourier space.


class PeriodicOperator(PreparedOperator):
    """u(q) = c(q) p(q) on a periodic grid (Stanley & Kato 1997), spectral discretisation.

    Transforms and their buffers are prepared at first use and kept, so one operator serves one
    solve at a time.

    ``kernel`` is the compliance (m/Pa) on the half spectrum of ``grid`` where it is known already,
    an array of the host or where the engine computes; ``octaves`` holds values of the compliance to
    share, from the operator of a finer grid.
    """

    pairs_per_application = 1.0

    def __init__(
        self,
        compliance: Compliance,
        grid: Grid,
        *,
        engine: Engine | None = None,
        kernel: RealArray | None = None,
        octaves: Octaves | None = None,
    ) -> None:
        self.grid = grid
        self.compliance = compliance
        self.octaves = octaves or octaves_of(compliance)
        self.boundary: Boundary = Periodic()
        self.engine: Engine = engine or CpuEngine()
        self._resident = (
            spectral_kernel(compliance, grid, self.engine) if kernel is None else self.engine.resident(kernel)
        )
        self.padded = grid.shape
        self.zero_mean_mode = bool(self._resident[0, 0] == 0.0)

    @cached_property
    def kernel(self) -> RealArray:  # type: ignore[override]
        """Compliance (m/Pa) on the half spectrum."""
        return self.engine.numpy(self._resident)

    @cached_property
    def coarsened(self) -> PeriodicOperator:
        """Operator on the grid of half as many points per side, whose waves are the longer half of
        those here."""
        grid = coarse_grid(self.grid)
        fine, (rows, columns) = self.grid.shape[0], grid.shape
        positive, longer = (rows + 1) // 2, self._resident[:, : columns // 2 + 1]
        kernel = np.concatenate([longer[:positive], longer[fine - rows + positive :]])
        return PeriodicOperator(self.compliance, grid, engine=self.engine, kernel=kernel, octaves=self.octaves)

    def matrix(self) -> RealArray:
        """Dense matrix in m/Pa, built from the response to one loaded point."""
        point = np.zeros(self.grid.shape)
        point[0, 0] = 1.0
        return convolution_matrix(self.apply(point), periodic=True)


def spectral_kernel(compliance: Compliance, grid: Grid, engine: Engine | None = None) -> Any:
    """Compliance (m/Pa) on the half spectrum of ``grid``, where the ``engine`` computes; negative
    frequencies along x are copies of positive ones.

    It is computed there if it is that of a half-space, which any array takes; a GPU does that in a
    hundredth of the time.
    """
    nx = grid.shape[0]
    rows = nx // 2 + 1
    waves = grid.wavevector()
    of_engine = engine is not None and isinstance(compliance, HalfSpace)
    if engine is not None and of_engine:
        waves = engine.resident(waves[0]), engine.resident(waves[1])
    qx, qy = waves[0][:rows], waves[1]
    if not of_engine and grid.shape[0] == grid.shape[1] and grid.size[0] == grid.size[1]:
        # the same along x and y: each wavenumber is looked up about once
        n, squares = qy.size, np.square(qy[0])
        strips = [(begin, min(begin + _STRIP, n)) for begin in range(0, n, _STRIP)]
        places = np.cumsum([(end - begin) * (n - begin) for begin, end in strips])
        sizes, kernel = np.empty(places[-1]), np.empty((nx, n))
        for (begin, end), part in zip(strips, np.split(sizes, places[:-1]), strict=True):
            np.add.outer(squares[begin:end], squares[begin:], out=part.reshape(-1, n - begin))
        np.sqrt(sizes, out=sizes)
        sizes[0] = sizes[-1] or 1.0  # any wavenumber of the grid: its value is replaced
        values = compliance.spectral(sizes)
        for (begin, end), part in zip(strips, np.split(values, places[:-1]), strict=True):
            strip = part.reshape(-1, n - begin)
            kernel[begin:end, begin:] = strip
            kernel[begin:n, begin:end] = strip.T
        kernel[n:] = kernel[nx - n : 0 : -1]
    else:
        q = np.sqrt(qx**2 + qy**2)
        q[0, 0] = float(q[-1, -1]) or 1.0  # any wavenumber of the grid: its value is replaced
        found = compliance.spectral(q)
        kernel = np.concatenate([found, found[nx - rows : 0 : -1]])
    kernel[0, 0] = compliance.mean_mode()
    return kernel if engine is None else engine.resident(kernel)


_STRIP = 64
"""Rows of a symmetric array that are mirrored at once. A layered kernel of 1024² points takes 5 ms
so, and 12 if every wavenumber is looked up; strips of 32 and 128 the same."""


# Free contact: exact discrete convolution with influence coefficients on a zero-padded grid.


class FreeOperator(PreparedOperator):
    """u = sum of influence coefficients times pressures, by DC-FFT (Liu, Wang & Liu 2000): no
    periodicity error.

    Transforms and their buffers are prepared at first use and kept, so one operator serves one
    solve at a time.

    ``boundary`` is ``Free()`` or, for strips in plane strain, ``FreeLine()``; ``octaves`` holds
    values of the compliance to share, from the operator of a finer grid.
    """

    zero_mean_mode = False

    def __init__(
        self,
        compliance: Compliance,
        grid: Grid,
        boundary: Free | FreeLine = Free(),
        *,
        engine: Engine | None = None,
        octaves: Octaves | None = None,
    ) -> None:
        nx, ny = grid.shape
        self.grid = grid
        self.compliance = compliance
        self.octaves = octaves or octaves_of(compliance)
        self.boundary: Free | FreeLine = boundary
        self.engine: Engine = engine or CpuEngine()
        self._influence = boundary.influence(compliance, grid)
        self.padded = fast_length(2 * nx - 1), fast_length(2 * ny - 1)
        self.pairs_per_application = 0.75 * self.padded[0] * self.padded[1] / grid.n_points  # pruned along y

    @cached_property
    def kernel(self) -> RealArray:  # type: ignore[override]
        """Transform of the influence coefficients (m/Pa) on the padded grid."""
        return RealTransform(self.padded).forward(wrapped(self._influence, self.padded)).real.copy()

    @cached_property
    def coarsened(self) -> FreeOperator:
        """Operator on the grid of half as many points per side."""
        grid = coarse_grid(self.grid)
        return FreeOperator(self.compliance, grid, self.boundary, engine=self.engine, octaves=self.octaves)

    def matrix(self) -> RealArray:
        """Dense matrix in m/Pa."""
        return convolution_matrix(self._influence, periodic=False)


# Coarser grids and the fields on them, for first guesses.


def coarse_grid(grid: Grid) -> Grid:
    """Grid of half as many points per side (rounded up) on the same area."""
    shape = (-(-grid.shape[0] // 2), -(-grid.shape[1] // 2))
    return Grid(shape, (grid.size[0] / shape[0], grid.size[1] / shape[1]))


def restricted(field: RealArray) -> RealArray:
    """Means of 2 x 2 points of ``field``; at an odd end the last point counts twice."""
    if field.shape[0] % 2:
        field = np.concatenate([field, field[-1:]])
    field = field[::2] + field[1::2]
    if field.shape[1] % 2:
        field = np.concatenate([field, field[:, -1:]], axis=1)
    return 0.25 * (field[:, ::2] + field[:, 1::2])


# Dense forms of the two convolutions, for small grids and as reference for the fast ones.


LARGEST_DENSE = 4096
"""Largest number of points for a dense matrix (134 MB); its factorisations take seconds."""


def convolution_matrix(kernel: RealArray, *, periodic: bool) -> RealArray:
    """Matrix (n, n) of the convolution with ``kernel`` (nx, ny): the response to a unit load at
    node (0, 0).

    If ``periodic`` it wraps around; else it is that at non-negative offsets, and even.

    Raises
    ------
    InputError
        If the grid has more than ``LARGEST_DENSE`` points.
    """
    nx, ny = kernel.shape
    if nx * ny > LARGEST_DENSE:
        raise InputError(
            f"grid of a dense method must have at most {LARGEST_DENSE} points, but has {nx} x {ny} = {nx * ny}. "
            "Use ConjugateGradient() on larger grids."
        )
    offsets = (np.arange(n)[:, None] - np.arange(n)[None, :] for n in (nx, ny))
    i, j = (offset % n if periodic else np.abs(offset) for offset, n in zip(offsets, (nx, ny), strict=True))
    matrix: RealArray = kernel[i[:, None, :, None], j[None, :, None, :]].reshape(nx * ny, nx * ny)
    return matrix
