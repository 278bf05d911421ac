"""Fields on planes under a periodic load: multiplication in Fourier space, plane by plane.

The transforms of the tractions are made once; a plane costs its spectra and one inverse transform for each component.
A few lines of all spectra are made at a time and transformed along x while they are in the cache, then all along y.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any, TypeAlias

import numpy as np

from ..core.arrays import ComplexArray, RealArray
from ..core.engine.blocks import FEW, Blocks
from ..core.panels import Panels, panels
from ..core.spectral import SplitTransform, thread_count
from ..core.tensor import Displacement, StressTensor
from .mean_mode import mean_displacement, mean_stress
from .regions import Plane, stack
from .tractions import ShearTraction, Tractions
from .transfer import Transfers

_NEGLIGIBLE = 60.0  # depth times wavenumber from which exp(-αz) is below anything that counts
_LINES = 32  # made at a time: vector instructions are full, and the lines of all fields stay in the cache
_PRESSURE = ("tau_zz", "tau_Lz", "LL_z")
_SHEAR = ("tau_zL", "tau_LL", "LL_L", "tau_T", "LT")
_DISPLACEMENT = ("U_z", "W_z", "U_L", "W_L", "u_T")

_Maker: TypeAlias = Callable[[tuple[int, int], ComplexArray], None]
"""Writes lines (first, last + 1) of spectra into an array (fields, lines or more, nx or more)."""


class PeriodicPlanes:
    """Stress and displacement of ``body`` under periodic ``tractions``, one plane at a time.

    Buffers are kept between planes, so one object serves one caller at a time.

    Parameters
    ----------
    tractions, body
        Load and the body that carries it.
    dtype
        ``"float64"`` or ``"float32"``: precision of spectra and fields; amplitudes are always computed in double.
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
        self._loads = self._transformed()
        self._between = self._transform.between(0, self._loads[0].dtype)
        self._filled = 0  # lines that are not zero

    def stress(self, plane: Plane, out: StressTensor | None = None) -> StressTensor:
        """Stress (Pa) on ``plane``, written into the arrays of ``out`` if given."""
        functions = _PRESSURE + _SHEAR if self._sheared else _PRESSURE
        means = mean_stress(self._means, plane.region)
        make = self._maker("stress_spectra", plane, functions, plane.region.material.poisson_ratio)
        found = StressTensor(*self._fields(make, plane, means, None if out is None else list(vars(out).values())))
        if plane.side == "surface":  # exact, whatever the rounding of the transforms
            shear, pressure = self.tractions.shear, self.tractions.pressure
            fields = (shear.x, shear.y) if isinstance(shear, ShearTraction) else (pressure, pressure)
            factors = (1.0, 1.0) if isinstance(shear, ShearTraction) else shear.ratios
            loads = zip((pressure, *fields), (1.0, *factors), (found.zz, found.xz, found.yz), strict=True)
            for load, factor, component in loads:
                np.multiply(load, -factor, out=component, casting="same_kind")
        return found

    def displacement(self, plane: Plane, out: Displacement | None = None) -> Displacement:
        """Displacement (m) of ``plane``; the datum is that of ``mean_displacement``."""
        means = mean_displacement(self._means, self._given, plane)
        make = self._maker("displacement_spectra", plane, _DISPLACEMENT)
        return Displacement(*self._fields(make, plane, means, None if out is None else list(vars(out).values())))

    def _maker(self, kernel: str, plane: Plane, functions: tuple[str, ...], *constants: float) -> _Maker:
        """What writes some lines of the spectra of a plane into an array (any, any, nx and a few)."""
        found = self._transfers.to(plane)
        coefficients = self._panels.fitted(np.stack([getattr(found, name) for name in functions]))
        table, waves = (self._panels.breaks, coefficients, _limit(plane)), self._waves()
        run = getattr(import_module("..core.plane_kernels", __package__), kernel)
        return lambda lines, into: run(lines, waves, table, *constants, self._loads, into)

    def _fields(
        self, make: _Maker, plane: Plane, means: tuple[float, ...], out: list[RealArray] | None
    ) -> list[RealArray]:
        """Fields of the spectra that ``make`` writes, whose mean modes are set to ``means``."""
        shape = self.tractions.grid.shape
        lines = int(np.count_nonzero(self._waves()[0] < _limit(plane)))
        between = self._room(len(means), lines)
        fields = out or [np.empty(shape, self.dtype) for _ in means]
        alone = shape[0] * shape[1] < FEW
        self._blocks.share(self._first, lines, make, means, between, alone=alone)
        self._blocks.share(self._second, shape[0], between, fields, alone=alone)
        return fields

    def _room(self, count: int, lines: int) -> ComplexArray:
        """Room for as many fields between the steps, zero but for the first ``lines``, which are to be written."""
        if len(self._between) < count:
            self._between, self._filled = self._transform.between(count, self._between.dtype), self._between.shape[2]
        self._between[:, :, lines : self._filled] = 0.0
        self._filled = lines
        return self._between[:count]

    def _first(self, span: tuple[int, int], make: _Maker, means: tuple[float, ...], between: ComplexArray) -> None:
        """Make the lines ``span`` of the spectra and transform them along x."""
        shape = self.tractions.grid.shape
        made = self._transform.lines(len(means), _LINES, between.dtype)
        for start in range(*span, _LINES):
            here = start, min(span[1], start + _LINES)
            make(here, made)
            if start == 0:
                made[:, 0, 0] = np.multiply(means, shape[0] * shape[1])
            for lines, out in zip(made, between, strict=True):
                self._transform.lines_back(lines, here, out)

    def _second(self, span: tuple[int, int], between: ComplexArray, fields: list[RealArray]) -> None:
        """Transform along y to the rows ``span`` of the fields."""
        for lines, field in zip(between, fields, strict=True):
            self._transform.rows_back(lines, span, field)

    def _waves(self) -> tuple[RealArray, RealArray, RealArray, RealArray]:
        """Components of the wavevectors along y and x, not negative; each also with the highest of an even grid set to zero."""
        (nx, ny), (qx, qy) = self.tractions.grid.shape, self.tractions.grid.wavevector()
        xi, eta = np.abs(qx[: nx // 2 + 1, 0]), np.abs(qy[0])
        return eta, _without_highest(eta, ny), xi, _without_highest(xi, nx)

    def _transformed(self) -> tuple[Any, ...]:
        """Spectra of pressure and shear fields, with the ratios of the shear to the pressure where it follows it."""
        shear = self.tractions.shear
        fields = [self.tractions.pressure]
        ratios = (0.0, 0.0)
        if isinstance(shear, ShearTraction) and self._sheared:
            fields += [shear.x, shear.y]
        elif not isinstance(shear, ShearTraction):
            ratios = shear.ratios
        spectra = [self._transform.forward(f.astype(self.dtype), self._blocks.threads) for f in fields]
        x, y = spectra[1:] or (spectra[0], spectra[0])
        return spectra[0], *ratios, len(fields) > 1, x, y


def _limit(plane: Plane) -> float:
    """Wavenumber from which nothing reaches the plane."""
    return _NEGLIGIBLE / plane.depth if plane.depth > 0.0 else np.inf


def _without_highest(components: RealArray, n: int) -> RealArray:
    odd = components.copy()
    if n % 2 == 0:
        odd[-1] = 0.0
    return odd
