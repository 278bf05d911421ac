"""Fields on planes under a load with nothing outside the grid: exact discrete convolution (DC-FFT; Liu & Wang 2002).

Of pixels in space, or of strips in plane strain.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..core.arrays import ComplexArray, RealArray
from ..core.spectral import PaddedTransform, RealTransform, fast_length, thread_count, wrapped
from ..core.tensor import AXES, STRESSES, Displacement, StressTensor
from .coefficients import PlaneCoefficients
from .line_coefficients import LineCoefficients
from .mean_mode import require_displacement
from .patch import Load
from .regions import Plane, slips, stack
from .tractions import ShearTraction, Tractions


class FreePlanes:
    """Stress and displacement of ``body`` under ``tractions`` that end at the grid, one plane at a time.

    Parameters as for ``PeriodicPlanes``. Constant traction on each pixel, fields at the middle of each; the convolution is
    exact, the coefficients are within 1e-8 of the largest of them (rounding only for a homogeneous body).
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
        self._groups = self._transformed()

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

    def displacement(self, plane: Plane, out: Displacement | None = None) -> Displacement:
        """Displacement (m) of ``plane``, zero at infinity.

        Raises
        ------
        InputError
            If it has no limit, see ``require_displacement``.
        """
        require_displacement(self.tractions, self._body)
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

    def _transformed(self) -> list[tuple[ComplexArray, dict[Load, float]]]:
        """Spectra of the tractions, each with the loads it stands for and their ratios to it."""
        shear = self.tractions.shear
        with_pressure: dict[Load, float] = {"z": 1.0}
        groups = [(self._forward(self.tractions.pressure), with_pressure)]
        if isinstance(shear, ShearTraction):
            if self.tractions.sheared:
                groups += [(self._forward(shear.x), {"x": 1.0}), (self._forward(shear.y), {"y": 1.0})]
        else:
            x, y = shear.ratios
            with_pressure |= {"x": x} if x != 0.0 else {}
            with_pressure |= {"y": y} if y != 0.0 else {}
        return groups

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
