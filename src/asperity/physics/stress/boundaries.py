"""Stresses under tractions on a periodic and on a free surface."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from importlib import import_module
from typing import Any, TypeAlias

import numpy as np

from ...core.arrays import ComplexArray, RealArray
from ...core.engine.blocks import LONG_SERIAL_BELOW, Blocks
from ...core.errors import InputError
from ...core.interpolation import Panels, panels
from ...core.spectral import (
    PaddedTransform,
    RealTransform,
    SplitTransform,
    complex_lines,
    fast_length,
    real_lines,
    thread_count,
    wrapped,
)
from ...core.tensor import AXES, STRESSES, Displacement, StressTensor
from ...solids.layers import RigidBase
from .kernels.coefficients import LineCoefficients, PlaneCoefficients
from .kernels.patch import Load
from .kernels.transfer import Transfers
from .regions import Plane, Selection, regions, slips, stack
from .tractions import ShearTraction, Tractions

# The uniform part of a periodic load: uniaxial strain in every region, with shear that reaches
# through.
#
# No mean lateral strain; the mean displacement counts from the rigid base, or without one from that
# of the surface, since a half-space under uniform load sinks without bound.


_BALANCED = 1e-9  # mean over largest shear traction: rounding, in single precision that of a sum


def require_held(tractions: Tractions, body: object) -> None:
    """Refuse a mean shear traction on layers that nothing holds.

    At every other wavelength the layers above a frictionless interface carry shear as a sheet does.
    In a periodic cell the mean would push them away; without periodicity the unloaded parts of the
    layers hold them.

    InputError if the boundary is periodic and there is a mean shear traction above a frictionless
    interface.
    """
    x, y, _ = tractions.means
    mean = math.hypot(x, y)
    if tractions.boundary == "periodic" and stack(body).slips and tractions.sheared:
        largest = max(float(abs(tractions.shear_x).max()), float(abs(tractions.shear_y).max()))
        if mean > _BALANCED * largest:
            raise InputError(
                "mean shear traction must be zero on a periodic body with a frictionless interface, where "
                "nothing holds the layers above it, but is not. Use bonded interfaces, the free boundary "
                "({free}), whose unloaded parts hold the layers, a shear traction without its mean, or no "
                "friction."
            )


# Fields on planes under a periodic load: multiplication in Fourier space, plane by plane.
#
# The transforms of the tractions are made once; a plane costs its spectra and one inverse transform
# for each component. A few lines of all spectra are made at a time and transformed along x while
# they are in the cache, then all along y.


_NEGLIGIBLE = (
    42.0  # depth times wavenumber from which (1 + αz) exp(-αz) is below a fifth of the rounding of the traction
)
_LINES = 16  # made at a time: vector instructions are full, and the lines of all fields stay in the cache
_POINTS = 1 << 14  # of a plane that are read at a time: all components stay in the second-level cache
_PRESSURE = ("tau_zz", "tau_Lz", "LL_z")
_SHEAR = ("tau_zL", "tau_LL", "LL_L", "tau_T", "LT")
_DISPLACEMENT = ("U_z", "W_z", "U_L", "W_L", "u_T")

_Maker: TypeAlias = Callable[[tuple[int, int], ComplexArray], None]
"""Writes lines (first, last + 1) of spectra into an array (fields, lines or more, nx or more)."""

Rows: TypeAlias = Iterator[tuple[int, RealArray]]
"""First row, and components xx, yy, zz, xy, xz, yz of some rows, (6, rows, ny) in one piece, which
the next ones overwrite."""

Reader: TypeAlias = Callable[[Rows], None]
"""What is done with the rows of a plane; each thread calls it with those of its share."""

_ALL = (slice(0, 6),)
_NOT_GIVEN = (slice(0, 2), slice(3, 4))  # xx, yy and xy: the others are the tractions on the surface
_GIVEN = 2, 4, 5


class PeriodicPlanes:
    """Stress and displacement of ``body`` under periodic ``tractions``, one plane at a time.

    Buffers are kept between planes, so one object serves one caller at a time.

    Parameters
    ----------
    tractions, body
        Load and the body that carries it.
    dtype
        ``"float64"`` or ``"float32"``: precision of spectra and fields; amplitudes are always
        computed in double.
    threads
        See ``core.spectral.thread_count``.
    """

    def __init__(
        self, tractions: Tractions, body: object, *, dtype: str = "float64", threads: int | None = None
    ) -> None:
        self.tractions = tractions
        self.dtype = np.dtype(dtype)
        self._given = body
        self._blocks = Blocks(thread_count(threads))
        self._transform = SplitTransform(tractions.grid.shape)
        self._panels: Panels = panels(tractions.grid)
        self._transfers = Transfers(stack(body), self._panels.points)
        self._sheared = tractions.sheared
        self._means = tractions.means
        shear, fields, ratios = tractions.shear, [tractions.pressure], (0.0, 0.0)
        if isinstance(shear, ShearTraction) and self._sheared:
            fields += [shear.x, shear.y]
        elif not isinstance(shear, ShearTraction):  # it follows the pressure
            ratios = shear.ratios
        spectra = [self._transform.forward(f.astype(self.dtype), self._blocks.threads) for f in fields]
        x, y = spectra[1:] or (spectra[0], spectra[0])
        self._loads = spectra[0], *ratios, len(fields) > 1, x, y
        self._between = self._transform.between(0, self._loads[0].dtype)
        self._filled = 0  # lines that are not zero

    def stress(self, plane: Plane, out: StressTensor | None = None) -> StressTensor:
        """Stress (Pa) on ``plane``, written into the arrays of ``out`` if given."""
        make, means = self._stress_maker(plane)
        given = None if out is None else list(vars(out).values())
        fields = self._fields(make, plane, means, given, _needed(plane))
        if plane.side == "surface":
            self._impose(fields, (slice(None), slice(None)))
        return StressTensor(*fields)

    def read(self, plane: Plane, reader: Reader) -> None:
        """Give the stress (Pa) on ``plane`` to ``reader`` a few rows at a time, which stay in the
        cache."""
        make, means = self._stress_maker(plane)
        between = self._along_x(make, plane, means, _needed(plane))
        self._share(lambda span: reader(self._rows(span, between, plane)), self.tractions.grid.shape[0])

    def at(self, plane: Plane, places: Sequence[Selection]) -> list[RealArray]:
        """Stress (Pa) on ``plane`` at each of some ``places``, (6, …): waves are summed, and
        transformed along lines only."""
        make, means = self._stress_maker(plane)
        shape = self.tractions.grid.shape
        indices = [place.index for place in places]
        columns = sorted({j for _, j in indices if not isinstance(j, slice)})
        rows = sorted({i for i, j in indices if isinstance(j, slice) and not isinstance(i, slice)})
        sums = _WaveSums(columns, rows, shape, self._between.dtype)
        made = self._transform.lines(len(means), _LINES, self._between.dtype)
        for here in self._lines((0, self._reaching(plane)), make, means, made):
            sums.add(here, made[:, : here[1] - here[0], : shape[0]])
        along_x = sums.columns() if columns else np.zeros(0)
        along_y = sums.rows(shape[1]) if rows else np.zeros(0)
        found = []
        for i, j in indices:
            if isinstance(j, slice):
                assert not isinstance(i, slice)
                fields = along_y[:, rows.index(i)]
            else:
                fields = along_x[:, columns.index(j)][:, i].copy()
            if plane.side == "surface":
                self._impose(fields[:, None], (i, j))
            found.append(fields)
        return found

    def displacement(self, plane: Plane, out: Displacement | None = None) -> Displacement:
        """Displacement (m) of ``plane``; its mean is the mean load times the compliance down to the
        datum."""
        parts = regions(self._given)
        from_base = isinstance(stack(self._given).base, RigidBase)
        direct = shear = 0.0
        for region in parts:
            low, high = (
                (max(plane.depth, region.top), region.bottom)
                if from_base
                else (region.top, min(plane.depth, region.bottom))
            )
            if high > low:
                G, nu = region.material.shear_modulus, region.material.poisson_ratio
                if not math.isclose(nu, 0.5):  # 1/M = (1-2ν) / 2G(1-ν), the compliance in uniaxial strain
                    direct += (high - low) * (1.0 - 2.0 * nu) / (2.0 * G * (1.0 - nu))
                shear += (high - low) / G
        sign = 1.0 if from_base else -1.0
        means = tuple(sign * load * c for load, c in zip(self._means, (shear, shear, direct), strict=True))
        make = self._maker("displacement_spectra", plane, _DISPLACEMENT)
        given = None if out is None else list(vars(out).values())
        return Displacement(*self._fields(make, plane, means, given, (slice(0, 3),)))

    def _stress_maker(self, plane: Plane) -> tuple[_Maker, tuple[float, ...]]:
        """What makes the spectra of the stress on ``plane``, and its means: σ_xx = σ_yy = -ν/(1-ν)
        p under a mean pressure p."""
        functions, nu = _PRESSURE + _SHEAR if self._sheared else _PRESSURE, plane.region.material.poisson_ratio
        x, y, pressure = self._means
        lateral = -nu / (1.0 - nu) * pressure
        return self._maker("stress_spectra", plane, functions, nu), (lateral, lateral, -pressure, 0.0, -x, -y)

    def _maker(self, kernel: str, plane: Plane, functions: tuple[str, ...], *constants: float) -> _Maker:
        """What writes some lines of the spectra of a plane into an array (any, any, nx and a
        few)."""
        found = self._transfers.to(plane)
        coefficients = self._panels.fitted(np.stack([getattr(found, name) for name in functions]))
        table, waves = (self._panels.breaks, coefficients, _limit(plane)), self._waves
        run = getattr(import_module(".kernels.planes", __package__), kernel)
        return lambda lines, into: run(lines, waves, table, *constants, self._loads, into)

    def _impose(self, fields: Sequence[RealArray] | RealArray, where: tuple[Any, ...]) -> None:
        """Write the tractions at ``where`` on the surface into zz, xz and yz: exact, whatever the
        rounding of the transforms."""
        shear, pressure = self.tractions.shear, self.tractions.pressure
        loads = (shear.x, shear.y) if isinstance(shear, ShearTraction) else (pressure, pressure)
        factors = (1.0, 1.0) if isinstance(shear, ShearTraction) else shear.ratios
        for number, load, factor in zip(_GIVEN, (pressure, *loads), (1.0, *factors), strict=True):
            fields[number][...] = -factor * load[where]

    def _fields(
        self,
        make: _Maker,
        plane: Plane,
        means: tuple[float, ...],
        out: list[RealArray] | None,
        needed: tuple[slice, ...],
    ) -> list[RealArray]:
        """Fields of the spectra that ``make`` writes, whose mean modes are set to ``means``; only
        the ``needed`` are filled."""
        shape = self.tractions.grid.shape
        fields = out or [np.empty(shape, self.dtype) for _ in means]
        between = self._along_x(make, plane, means, needed)
        numbers = [number for some in needed for number in range(some.start, some.stop)]
        self._share(self._along_y, shape[0], between, fields, numbers)
        return fields

    def _share(self, work: Callable[..., None], parts: int, *arguments: Any) -> None:
        shape = self.tractions.grid.shape
        self._blocks.share(work, parts, *arguments, serial=shape[0] * shape[1] < LONG_SERIAL_BELOW)

    def _along_x(self, make: _Maker, plane: Plane, means: tuple[float, ...], needed: tuple[slice, ...]) -> ComplexArray:
        """Spectra that ``make`` writes after their transform along x, as far as ``needed``."""
        lines, count = self._reaching(plane), len(means)
        if len(self._between) < count:
            self._between, self._filled = self._transform.between(count, self._between.dtype), self._between.shape[2]
        self._between[:, :, lines : self._filled] = 0.0  # the first lines are to be written
        self._filled, between = lines, self._between[:count]
        self._share(self._first, lines, make, means, between, needed)
        return between

    def _reaching(self, plane: Plane) -> int:
        """Number of lines of waves that reach ``plane``."""
        return int(np.count_nonzero(self._waves[0] < _limit(plane)))

    def _lines(
        self, span: tuple[int, int], make: _Maker, means: tuple[float, ...], made: ComplexArray
    ) -> Iterator[tuple[int, int]]:
        """Write the lines ``span`` of the spectra into ``made``, as many as are made at a time;
        gives which those are."""
        for start in range(*span, _LINES):
            here = start, min(span[1], start + _LINES)
            make(here, made)
            if start == 0:
                made[:, 0, 0] = np.multiply(means, math.prod(self.tractions.grid.shape))
            yield here

    def _first(
        self,
        span: tuple[int, int],
        make: _Maker,
        means: tuple[float, ...],
        between: ComplexArray,
        needed: tuple[slice, ...],
    ) -> None:
        """Make the lines ``span`` of the spectra and transform them along x."""
        made = self._transform.lines(len(means), _LINES, between.dtype)
        for here in self._lines(span, make, means, made):
            for some in needed:
                self._transform.lines_back(made[some], here, between[some])

    def _along_y(
        self, span: tuple[int, int], between: ComplexArray, fields: list[RealArray], numbers: list[int]
    ) -> None:
        """Transform along y to the rows ``span`` of the fields with the ``numbers``."""
        for number in numbers:
            self._transform.rows_back(between[number], span, fields[number][slice(*span)])

    def _rows(self, span: tuple[int, int], between: ComplexArray, plane: Plane) -> Rows:
        """Transform along y, a few rows of the stress on ``plane`` at a time."""
        count = max(1, _POINTS // self.tractions.grid.shape[1])
        rows = np.empty((len(STRESSES), 0, 0), self.dtype)
        for start in range(*span, count):
            here = start, min(span[1], start + count)
            if rows.shape[1] != here[1] - start:
                rows = np.empty((len(STRESSES), here[1] - start, self.tractions.grid.shape[1]), self.dtype)
            for some in _needed(plane):
                self._transform.rows_back(between[some], here, rows[some])
            if plane.side == "surface":
                self._impose(rows, (slice(*here), slice(None)))
            yield start, rows

    @cached_property
    def _waves(self) -> tuple[RealArray, RealArray, RealArray, RealArray]:
        """Components of the wavevectors along y and x, not negative; each also with the highest of
        an even grid set to zero."""
        grid, half = self.tractions.grid, self.tractions.grid.shape[0] // 2 + 1
        (xi, eta), (xi_odd, eta_odd) = (
            (np.abs(qx[:half, 0]), np.abs(qy[0])) for qx, qy in (grid.wavevector(), grid.wavevector(odd=True))
        )
        return eta, eta_odd, xi, xi_odd


def _limit(plane: Plane) -> float:
    """Wavenumber from which nothing reaches the plane."""
    return _NEGLIGIBLE / plane.depth if plane.depth > 0.0 else np.inf


def _needed(plane: Plane) -> tuple[slice, ...]:
    """Components of the stress on ``plane`` that are not known beforehand."""
    return _NOT_GIVEN if plane.side == "surface" else _ALL


class _WaveSums:
    """Sums over waves, taken in line by line, that give the stress along some lines y =
    ``columns``·dy and x = ``rows``·dx."""

    def __init__(self, columns: list[int], rows: list[int], shape: tuple[int, int], dtype: Any) -> None:
        nx, ny = shape
        waves = np.arange(ny // 2 + 1)
        both = np.where((waves == 0) | (2 * waves == ny), 1.0, 2.0) / ny  # of each wave and its mirror image
        across = both * np.exp(2j * np.pi * np.outer(columns, waves) / ny)
        self._across = np.concatenate([across.real, across.imag]).astype(np.zeros(0, dtype).real.dtype)
        self._along = (np.exp(2j * np.pi * np.outer(np.arange(nx), rows) / nx) / nx).astype(dtype)
        self._columns = np.zeros((len(STRESSES), len(self._across), 2 * nx), self._across.dtype)
        self._rows = np.zeros((len(STRESSES), len(rows), waves.size), dtype)

    def add(self, span: tuple[int, int], lines: ComplexArray) -> None:
        """Take in the lines ``span`` of the spectra, (6, lines, nx)."""
        part = slice(*span)
        if len(self._across):  # as a product of real matrices, which takes half as long
            self._columns += self._across[:, part] @ lines.view(self._across.dtype)
        if self._along.size:
            self._rows[..., part] = np.swapaxes(lines @ self._along, 1, 2)

    def columns(self) -> RealArray:
        """Stress along the lines in x, (6, columns, nx)."""
        real, imaginary = np.split(self._columns.view(self._rows.dtype), 2, axis=1)
        return complex_lines(real + 1j * imaginary, 2, backward=True).real

    def rows(self, ny: int) -> RealArray:
        """Stress along the lines in y, (6, rows, ny)."""
        return real_lines(self._rows, ny)


# Fields on planes under a load with nothing outside the grid: exact discrete convolution (DC-FFT;
# Liu & Wang 2002).
#
# Of pixels in space, or of strips in plane strain.


class FreePlanes:
    """Stress and displacement of ``body`` under ``tractions`` that end at the grid, one plane at a
    time.

    Parameters as for ``PeriodicPlanes``. Constant traction on each pixel, fields at the middle of
    each; the convolution is exact, the coefficients are within 1e-8 of the largest of them
    (rounding only for a homogeneous body).
    """

    def __init__(
        self, tractions: Tractions, body: object, *, dtype: str = "float64", threads: int | None = None
    ) -> None:
        (nx, ny), threads = tractions.grid.shape, thread_count(threads)
        self.tractions = tractions
        self.dtype = np.dtype(dtype)
        self._body = stack(body)
        self._padded = fast_length(2 * nx - 1), fast_length(2 * ny - 1)
        self._whole = RealTransform(self._padded, threads)
        self._transform = PaddedTransform(tractions.grid.shape, self._padded, threads)
        shear = self.tractions.shear
        with_pressure: dict[Load, float] = {"z": 1.0}
        # spectra of the tractions, each with the loads it stands for and their ratios to it
        groups = [(self._forward(self.tractions.pressure), with_pressure)]
        if isinstance(shear, ShearTraction):
            if self.tractions.sheared:
                groups += [(self._forward(shear.x), {"x": 1.0}), (self._forward(shear.y), {"y": 1.0})]
        else:
            x, y = shear.ratios
            with_pressure |= {"x": x} if x != 0.0 else {}
            with_pressure |= {"y": y} if y != 0.0 else {}
        self._groups = groups

    def stress(self, plane: Plane, out: StressTensor | None = None) -> StressTensor:
        """Stress (Pa) on ``plane``, written into the arrays of ``out`` if given."""
        coefficients = self._coefficients(plane)
        by_load = {load: vars(coefficients.stress(load)) for load in self._loads}
        found = StressTensor(*self._convolved(STRESSES, by_load, None if out is None else list(vars(out).values())))
        if plane.side == "surface":  # exact, whatever the rounding of the transforms
            found.zz[...] = -self.tractions.pressure
            found.xz[...] = -self.tractions.shear_x
            found.yz[...] = -self.tractions.shear_y
        elif slips(self._body, plane):  # likewise
            found.xz[...] = found.yz[...] = 0.0
        return found

    def read(self, plane: Plane, reader: Reader) -> None:
        """Give the stress (Pa) on ``plane`` to ``reader``, all rows at once."""
        reader(iter([(0, self._whole_stress(plane))]))

    def at(self, plane: Plane, places: Sequence[Selection]) -> list[RealArray]:
        """Stress (Pa) on ``plane`` at each of some ``places``, (6, …)."""
        whole = self._whole_stress(plane)
        return [whole[(slice(None), *place.index)].copy() for place in places]

    def _whole_stress(self, plane: Plane) -> RealArray:
        """Stress on ``plane``, (6, nx, ny), which the next one overwrites."""
        self.stress(plane, StressTensor(*self._room))
        return self._room

    @cached_property
    def _room(self) -> RealArray:
        return np.empty((len(STRESSES), *self.tractions.grid.shape), self.dtype)

    def displacement(self, plane: Plane, out: Displacement | None = None) -> Displacement:
        """Displacement (m) of ``plane``, zero at infinity.

        InputError if it has no limit: of sheared layers that slip and are held at infinity only.
        """
        if self.tractions.sheared and self._body.slips:
            raise InputError(
                "displacement under shear traction must not be asked of a body with a Frictionless() "
                f"interface on the boundary {self.tractions.boundary}: its layers are held at infinity only "
                "and slip without end. Stresses are defined; use displacement=False."
            )
        coefficients = self._coefficients(plane)
        by_load = {load: vars(coefficients.displacement(load)) for load in self._loads}
        return Displacement(*self._convolved(AXES, by_load, None if out is None else list(vars(out).values())))

    def _coefficients(self, plane: Plane) -> PlaneCoefficients | LineCoefficients:
        grid = self.tractions.grid
        if self.tractions.boundary == "free line":
            return LineCoefficients(self._body, plane, grid, self.tractions.datum or grid.size[0])
        return PlaneCoefficients(self._body, plane, grid)

    @property
    def _loads(self) -> list[Load]:
        return list(dict.fromkeys(load for _, ratios in self._groups for load in ratios))

    def _forward(self, field: RealArray) -> ComplexArray:
        spectrum = np.empty(self._transform.spectrum_shape, np.result_type(self.dtype, np.complex64))
        return self._transform.forward(np.ascontiguousarray(field, self.dtype), spectrum)

    def _convolved(
        self, components: Sequence[str], by_load: dict[Load, dict[str, RealArray]], out: list[RealArray] | None
    ) -> list[RealArray]:
        fields = out or [np.empty(self.tractions.grid.shape, self.dtype) for _ in components]
        for component, field in zip(components, fields, strict=True):
            total: ComplexArray | None = None
            for spectrum, ratios in self._groups:
                kernel = np.zeros(self._padded)
                for load, ratio in ratios.items():
                    indices = component + load  # odd in each axis that they name an odd number of times
                    odd_x, odd_y = (indices.count(axis) % 2 == 1 for axis in "xy")
                    kernel += ratio * wrapped(by_load[load][component], self._padded, odd_x=odd_x, odd_y=odd_y)
                product = self._whole.forward(np.ascontiguousarray(kernel, self.dtype))
                product *= spectrum
                total = product if total is None else np.add(total, product, out=total)
            assert total is not None
            self._transform.backward(total, field)
        return fields
