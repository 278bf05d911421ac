"""Stress in depth cells and displacement of the surface by tractions and eigenstrain, on a grid."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from typing import ClassVar, Self

import numpy as np

from ...core.arrays import ComplexArray, RealArray
from ...core.grid import Grid
from ...core.spectral import PaddedTransform, RealTransform, fast_length, thread_count
from ..elastic import Elastic
from .cells import DepthCells
from .tables import SweepTable

_ROWS = 8
"""Rows of wavevectors that a thread takes at a time."""

Slot = tuple[int, int]
"""Depth cell, component 0…5 of xx, yy, zz, xy, xz, yz."""


@dataclass(frozen=True, eq=False)
class Wavevectors:
    """Wavevectors ``q`` (4, rows, columns) in rad/m: x, y, and the same for odd functions of them,
    zero where the sign is undefined.

    ``rows`` (rows,) tells which row of ``alpha``, the wavenumbers > 0 that a table is made for,
    belongs to each. Where the wavevector vanishes any other stands in its place.
    """

    q: RealArray
    alpha: RealArray
    rows: RealArray

    @classmethod
    def single(cls, x: RealArray, y: RealArray) -> Self:
        """One row of any wavevectors but zero."""
        q = np.stack([x, y, x, y])[:, None, :]
        return cls(q, np.hypot(q[0], q[1]), np.zeros(1, dtype=np.int64))


def swept(
    table: SweepTable, waves: Wavevectors, loads: ComplexArray, fields: ComplexArray, threads: int = 1
) -> ComplexArray:
    """Displacement (3, rows, columns) of the surface by the eigenstrain ``fields`` and the
    tractions ``loads``; turns ``fields`` into mean stress.

    Parameters
    ----------
    table
        Coefficients at the wavenumbers of ``waves``.
    waves
        Wavevectors.
    loads
        (3, rows, columns): transforms of the tractions q_x, q_y, p in Pa.
    fields
        (cells, 6, rows, columns): transforms of the eigenstrain, xx, yy, zz, xy, xz, yz;
        overwritten by those of the mean stress in Pa.
    threads
        Number of threads.
    """
    from .kernels import sweep

    moved = np.empty((3, *waves.q.shape[1:]), dtype=complex)
    count, columns = fields.shape[0], fields.shape[3]

    def part(first: int) -> None:
        work = np.empty((count + 2, 3, columns), dtype=complex)
        span = (first, min(first + _ROWS, fields.shape[2]))
        sweep(span, waves.rows, waves.q, table.top, table.cells, table.solids, loads, fields, moved, work)

    shared(part, range(0, fields.shape[2], _ROWS), threads)
    return moved


def shared(task: Callable[[int], object], numbers: Iterable[int], threads: int) -> None:
    """Do ``task`` for all ``numbers``, in any order, by so many threads; what it returns is not
    kept."""
    if threads == 1:
        for number in numbers:
            task(number)
        return
    with ThreadPoolExecutor(threads) as pool:
        list(pool.map(task, numbers))


@dataclass(frozen=True, eq=False)
class MeanMode:
    """What a mean eigenstrain and mean tractions do, by depth cell.

    Without mean lateral strain (periodic); or in the limit of long wavelengths, averaged over
    directions, for a load that does not repeat: there the body below the cells stretches by c_s =
    (1 - 2ν)/2G of the base times the force along the surface (``stretch``), and what the images of
    the padded grid add is taken away (``images`` (cells,), see ``image_stress``).
    """

    solids: RealArray
    stretch: float
    images: RealArray | float = 0.0

    @property
    def normal(self) -> RealArray:
        """(cells,) u_z per ε_xx + ε_yy and thickness, less its sign: also -σ_xx per pressure."""
        shear, nu, _ = self.solids.T
        return np.asarray((nu + self.stretch * shear * (1.0 + nu)) / (1.0 - nu) - self.images)

    def stress(self, loads: RealArray, strain: RealArray) -> RealArray:
        """(cells, 6) in Pa by the mean ``loads`` (3,) and ``strain`` (cells, 6)."""
        shear, nu, _ = self.solids.T
        plate = -2.0 * shear / (1.0 - nu)
        found = np.zeros(strain.shape)
        found[:, 0] = plate * (strain[:, 0] + nu * strain[:, 1]) - self.normal * loads[2]
        found[:, 1] = plate * (strain[:, 1] + nu * strain[:, 0]) - self.normal * loads[2]
        found[:, 2], found[:, 4], found[:, 5] = -loads[2], -loads[0], -loads[1]
        found[:, 3] = -2.0 * shear * strain[:, 3]
        return found

    def displacement(self, strain: RealArray) -> RealArray:
        """(3,) in m by the mean ``strain``, relative to the base."""
        h = self.solids[:, 2]
        along = -2.0 * (h @ strain[:, 4:6])
        return np.array([*along, -h @ (strain[:, 2] + self.normal * (strain[:, 0] + strain[:, 1]))])


_LONG = 1e-4
"""Wavenumber times depth of the cells at which long waves are taken."""

_SUMMED = 40
"""Images on each side whose sum is taken one by one."""


def image_stress(cells: DepthCells, mean: MeanMode, size: tuple[float, float]) -> RealArray:
    """Lateral stress (cells,), less its sign, by the images of a pressure of unit mean on a grid of
    the ``size`` (m) that repeats.

    The mean of σ_xx and σ_yy under long waves of pressure is f0 + f1 |q|, of a half-space -(1/2 +
    ν) + (1 + ν) z |q|. Of the cusp the sum over wavevectors makes the field -f1/(2π r³) of a unit
    force at every image at the distance r, which is nearly the same all over the contact. By
    reciprocity it is also what the images of an eigenstrain do to the displacement.
    """
    depth = float(cells.edges[-1])
    wave = np.array([_LONG / depth])
    waves = Wavevectors.single(wave, np.zeros(1))
    loads, fields = np.zeros((3, 1, 1), dtype=complex), np.zeros((cells.count, 6, 1, 1), dtype=complex)
    loads[2] = 1.0
    swept(SweepTable.of(cells, waves.alpha), waves, loads, fields)
    slope = (0.5 * (fields[:, 0, 0, 0] + fields[:, 1, 0, 0]).real + mean.normal) / wave[0]
    number = np.arange(-_SUMMED, _SUMMED + 1)
    r = np.hypot(size[0] * number[:, None], size[1] * number)
    ends = _SUMMED * min(size)
    area = size[0] * size[1]
    inside = (r > 0.0) & (r <= ends)
    total = float((r[inside] ** -3.0).sum()) + 2.0 * np.pi / (area * ends)
    return np.asarray(slope * total * area / (2.0 * np.pi))


@dataclass(frozen=True, eq=False)
class EigenstrainOperator:
    """Linear response of a body on a ``grid``: stress by surface tractions and by eigenstrain that
    is constant in depth cells.

    Stresses are means over the cells, at the points of the grid; eigenstrain and tractions are
    trigonometric between them. Both are then adjoint: the work of any tractions on the displacement
    by an eigenstrain is that of the stress by these tractions on it.

    Parameters
    ----------
    grid
        Points (nx, ny).
    cells
        Body and its depth cells.
    padded
        Shape of the grid with zeros beyond ``grid``, for a contact that does not repeat; None for
        one that does.
    threads
        Number of threads.
    """

    grid: Grid
    cells: DepthCells
    padded: tuple[int, int] | None
    threads: int
    waves: Wavevectors = field(repr=False)
    table: SweepTable = field(repr=False)
    mean: MeanMode = field(repr=False)
    citation_keys: ClassVar[tuple[str, ...]] = ("Frerot2019", "Jacq2002", "Tan2006")

    @classmethod
    def prepared(cls, grid: Grid, cells: DepthCells, *, free: bool = False, threads: int | None = None) -> Self:
        """Operator on ``grid``; if ``free`` nothing repeats, up to images of the residual stress on
        a zero-padded grid of twice the length."""
        padded = None if not free else (fast_length(2 * grid.shape[0]), fast_length(2 * grid.shape[1]))
        wide = grid if padded is None else Grid(padded, grid.spacing)
        parts = [part for flag in (False, True) for part in wide.wavevector(odd=flag)]
        q = np.ascontiguousarray(np.stack(np.broadcast_arrays(*parts)))
        q[::2, 0, 0] = 2.0 * np.pi / wide.size[0]
        index = np.arange(wide.shape[0])
        half = wide.shape[0] // 2 + 1
        waves = Wavevectors(q, np.hypot(q[0], q[1])[:half], np.minimum(index, wide.shape[0] - index))
        table = SweepTable.of(cells, waves.alpha)
        base, stretch = cells.stack.base, 0.0
        if free and isinstance(base, Elastic):
            stretch = (0.5 - base.poisson_ratio) / base.shear_modulus
        mean = MeanMode(table.solids, stretch)
        if padded is not None:
            size = padded[0] * grid.spacing[0], padded[1] * grid.spacing[1]
            mean = replace(mean, images=image_stress(cells, mean, size))
        return cls(grid, cells, padded, thread_count(threads), waves, table, mean)

    @property
    def transform(self) -> RealTransform | PaddedTransform:
        """Transform of one field, by one thread."""
        return RealTransform(self.grid.shape) if self.padded is None else PaddedTransform(self.grid.shape, self.padded)

    @property
    def spectrum_shape(self) -> tuple[int, int]:
        """Shape of the half spectra."""
        return self.waves.q.shape[1], self.waves.q.shape[2]

    def spectra(self) -> ComplexArray:
        """Room for the transforms of a field, zero: (cells, 6, …)."""
        return np.zeros((self.cells.count, 6, *self.spectrum_shape), dtype=complex)

    def loads(self, pressure: RealArray, shear: RealArray | None = None) -> ComplexArray:
        """Transforms (3, …) of the tractions: ``pressure`` and ``shear`` (2, nx, ny) in Pa on the
        body."""
        found = np.zeros((3, *self.spectrum_shape), dtype=complex)
        for number, values in enumerate([*(() if shear is None else shear), pressure], 0 if shear is not None else 2):
            self.transform.forward(np.ascontiguousarray(values, dtype=float), found[number])
        return found

    def stress(
        self, strain: RealArray | None, pressure: RealArray | None = None, shear: RealArray | None = None
    ) -> tuple[RealArray, RealArray]:
        """Mean stress (cells, 6, nx, ny) in Pa, and displacement (3, nx, ny) of the surface in m, z
        into the body.

        Components are xx, yy, zz, xy, xz, yz. Without mean tractions the displacement is relative
        to the base.

        Parameters
        ----------
        strain
            (cells, 6, nx, ny): eigenstrain; None for none.
        pressure, shear
            (nx, ny) and (2, nx, ny) in Pa on the body; None for none.
        """
        fields = self.spectra()
        if strain is not None:
            self.forward(strain, fields, [(cell, part) for cell in range(self.cells.count) for part in range(6)])
        none = np.zeros(self.grid.shape)
        moved = self.respond(self.loads(none if pressure is None else pressure, shear), fields)
        found = np.empty((self.cells.count, 6, *self.grid.shape))
        self.backward(fields, found, [(cell, part) for cell in range(self.cells.count) for part in range(6)])
        displacement = np.empty((3, *self.grid.shape))
        for number in range(3):
            self.transform.backward(moved[number], displacement[number])
        return found, displacement

    def forward(self, strain: RealArray, fields: ComplexArray, slots: Iterable[Slot]) -> None:
        """Put the transforms of the ``slots`` of ``strain`` (cells, 6, nx, ny) into ``fields``."""
        pairs, transform = list(slots), self.transform
        shared(lambda n: transform.forward(strain[pairs[n]], fields[pairs[n]]), range(len(pairs)), self.threads)

    def backward(self, fields: ComplexArray, found: RealArray, slots: Iterable[Slot]) -> None:
        """Put the fields of the ``slots`` of ``fields``, which are overwritten, into ``found``
        (cells, 6, nx, ny)."""
        pairs, transform = list(slots), self.transform
        shared(lambda n: transform.backward(fields[pairs[n]], found[pairs[n]]), range(len(pairs)), self.threads)

    def respond(self, loads: ComplexArray, fields: ComplexArray) -> ComplexArray:
        """Displacement (3, …) of the surface; turns the eigenstrain ``fields`` into mean stress,
        all of them transforms."""
        strain, load = fields[:, :, 0, 0].real.copy(), loads[:, 0, 0].real.copy()
        moved = swept(self.table, self.waves, loads, fields, self.threads)
        fields[:, :, 0, 0] = self.mean.stress(load, strain)
        moved[:, 0, 0] = self.mean.displacement(strain)
        return moved

    def press(self, loads: ComplexArray, fields: ComplexArray) -> None:
        """Add the stress by ``loads`` to the ``fields``, and take the mean of xx, yy and zz away:
        transforms of the deviator remain."""
        from .kernels import press

        added = self.mean.stress(loads[:, 0, 0].real, np.zeros((self.cells.count, 6)))
        added += fields[:, :, 0, 0].real
        added[:, :3] -= added[:, :3].mean(axis=1)[:, None]
        table, waves = self.table, self.waves

        def part(first: int) -> None:
            work = np.empty((5, fields.shape[3]), dtype=complex)
            span = (first, min(first + _ROWS, fields.shape[2]))
            press(span, waves.rows, waves.q, table.top, table.cells, table.solids, loads, fields, work)

        shared(part, range(0, fields.shape[2], _ROWS), self.threads)
        fields[:, :, 0, 0] = added
