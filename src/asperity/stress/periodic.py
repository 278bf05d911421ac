"""Fields on planes under a periodic load: multiplication in Fourier space, plane by plane.

The transforms of the tractions are made once; a plane costs its spectra and one inverse transform for each component.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

import numpy as np

from ..core.arrays import ComplexArray, RealArray
from ..core.engine.blocks import Blocks
from ..core.panels import Panels, panels
from ..core.spectral import RealTransform, thread_count
from ..core.tensor import AXES, STRESSES, Displacement, StressTensor
from .mean_mode import mean_displacement, mean_stress
from .regions import Plane, stack
from .tractions import ShearTraction, Tractions
from .transfer import Transfers

_NEGLIGIBLE = 60.0  # depth times wavenumber from which exp(-αz) is below anything that counts
_PRESSURE = ("tau_zz", "tau_Lz", "LL_z")
_SHEAR = ("tau_zL", "tau_LL", "LL_L", "tau_T", "LT")
_DISPLACEMENT = ("U_z", "W_z", "U_L", "W_L", "u_T")


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
        self._transform = RealTransform(tractions.grid.shape, self._blocks.threads)
        self._panels: Panels = panels(tractions.grid)
        self._transfers = Transfers(stack(body), self._panels.points)
        self._sheared = tractions.sheared
        self._means = tractions.means
        self._loads = self._transformed()
        self._buffer: ComplexArray = np.empty((0, 0, 0), np.result_type(self.dtype, np.complex64))

    def stress(self, plane: Plane, out: StressTensor | None = None) -> StressTensor:
        """Stress (Pa) on ``plane``, written into the arrays of ``out`` if given."""
        functions = _PRESSURE + _SHEAR if self._sheared else _PRESSURE
        spectra = self._spectra("stress_spectra", plane, functions, len(STRESSES), plane.region.material.poisson_ratio)
        means = mean_stress(self._means, plane.region)
        found = StressTensor(*self._backward(spectra, means, None if out is None else list(vars(out).values())))
        if plane.side == "surface":  # exact, whatever the rounding of the transforms
            found.zz[...] = -self.tractions.pressure
            found.xz[...] = -self.tractions.shear_x
            found.yz[...] = -self.tractions.shear_y
        return found

    def displacement(self, plane: Plane, out: Displacement | None = None) -> Displacement:
        """Displacement (m) of ``plane``; the datum is that of ``mean_displacement``."""
        spectra = self._spectra("displacement_spectra", plane, _DISPLACEMENT, len(AXES))
        means = mean_displacement(self._means, self._given, plane)
        return Displacement(*self._backward(spectra, means, None if out is None else list(vars(out).values())))

    def _spectra(self, kernel: str, plane: Plane, functions: tuple[str, ...], count: int, *constants: float) -> Any:
        """Spectra (count, nx, ny // 2 + 1) of a plane, in the buffer."""
        found = self._transfers.to(plane)
        coefficients = self._panels.fitted(np.stack([getattr(found, name) for name in functions]))
        limit = _NEGLIGIBLE / plane.depth if plane.depth > 0.0 else np.inf
        if self._buffer.shape[0] < count:
            self._buffer = np.empty((count, *self._transform.spectrum_shape), self._buffer.dtype)
        spectra = self._buffer[:count]
        parts = self.tractions.grid.shape[0] // 2 + 1
        table = (self._panels.breaks, coefficients, limit)
        run = getattr(import_module("..core.plane_kernels", __package__), kernel)
        self._blocks.share(run, parts, self._waves(), table, *constants, self._loads, spectra, alone=parts < 16)
        return spectra

    def _backward(self, spectra: Any, means: tuple[float, ...], out: list[RealArray] | None) -> list[RealArray]:
        """Fields of the ``spectra``, whose mean modes are set to ``means``."""
        shape = self.tractions.grid.shape
        fields = out or [np.empty(shape, self.dtype) for _ in means]
        for spectrum, mean, field in zip(spectra, means, fields, strict=True):
            spectrum[0, 0] = mean * shape[0] * shape[1]
            self._transform.backward(spectrum, field)
        return fields

    def _waves(self) -> tuple[RealArray, RealArray, RealArray, RealArray]:
        """Components of the wavevectors, not negative; each also with the highest of an even grid set to zero."""
        (nx, ny), (qx, qy) = self.tractions.grid.shape, self.tractions.grid.wavevector()
        xi, eta = np.abs(qx[: nx // 2 + 1, 0]), np.abs(qy[0])
        return xi, _without_highest(xi, nx), eta, _without_highest(eta, ny)

    def _transformed(self) -> tuple[Any, ...]:
        """Spectra of pressure and shear fields, with the ratios of the shear to the pressure where it follows it."""
        shear = self.tractions.shear
        fields = [self.tractions.pressure]
        ratios = (0.0, 0.0)
        if isinstance(shear, ShearTraction) and self._sheared:
            fields += [shear.x, shear.y]
        elif not isinstance(shear, ShearTraction):
            ratios = shear.ratios
        spectra = [self._transform.forward(np.ascontiguousarray(f, self.dtype)) for f in fields]
        x, y = spectra[1:] or (spectra[0], spectra[0])
        return spectra[0], *ratios, len(fields) > 1, x, y


def _without_highest(components: RealArray, n: int) -> RealArray:
    odd = components.copy()
    if n % 2 == 0:
        odd[-1] = 0.0
    return odd
