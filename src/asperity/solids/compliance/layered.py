"""Normal compliance of a body of any number of layers on a half-space or a rigid base."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

from ...core.arrays import RealArray
from ...core.grid import Grid
from ...core.panels import covering_grid, log_table
from ..elastic import Elastic
from ..layers import Layered
from .hybrid import PlaneCompliance, interface_compliances
from .line_kernel import LineKernel, line_kernel, strip_coefficients
from .patch_average import patch_coefficients
from .point_kernel import PointKernel
from .samples import Samples, samples


@dataclass(frozen=True)
class LayerStack:
    """Compliance of ``body``, which has at least one layer of finite thickness; names and strengths are left out of it.

    The spectrum of a large map is interpolated between a few hundred wavenumbers, equal steps in their logarithm apart, with
    a relative error below 1e-13: a map of 1024² points costs about two Fourier transforms, whatever the number of layers.
    Influence coefficients come from the same spectrum, with a relative error below 1e-8.
    """

    body: Layered

    def __post_init__(self) -> None:
        object.__setattr__(self, "body", self.body.bare)

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Layered elasticity, the mixed layer matrices, the logarithmic Hankel transform."""
        return ("Burmister1945", "OSullivan1988", "Tan2006", "Hamilton2000")

    def spectral(self, wavenumber: RealArray) -> RealArray:
        """C_zz(q) in m/Pa at ``wavenumber`` q > 0 (rad/m)."""
        return self._interpolated(wavenumber, lambda c: (c.zz,))[0]

    def plane(self, wavenumber: RealArray) -> PlaneCompliance:
        """All components of C(q) in m/Pa at ``wavenumber`` q > 0 (rad/m)."""
        return PlaneCompliance(*self._interpolated(wavenumber, lambda c: (c.LL, c.zz, c.Lz, c.T)))

    def mean_mode(self) -> float:
        """Compression of the layers per pressure in m/Pa on a rigid base; 0 on a half-space, whose datum is the mean.

        Without lateral strain each layer gives h/M, M = 2G (1 - nu)/(1 - 2nu).
        """
        if isinstance(self.body.base, Elastic):
            return 0.0
        return sum(
            layer.thickness * (1.0 - 2.0 * nu) / (2.0 * layer.material.shear_modulus * (1.0 - nu))
            for layer in self.body.layers
            for nu in (layer.material.poisson_ratio,)
        )

    def influence(self, grid: Grid) -> RealArray:
        """Coefficients in m/Pa, shape (nx, ny), for constant pressure on each pixel."""
        return patch_coefficients(self._point, grid)

    def line_influence(self, grid: Grid, datum: float) -> RealArray:
        """Coefficients in m/Pa, shape (nx, 1), for constant pressure on strips of width dx (plane strain)."""
        return strip_coefficients(self._line, grid, datum)

    @cached_property
    def _samples(self) -> Samples:
        return samples(self.body, self.body.thickness)

    @cached_property
    def _point(self) -> PointKernel:
        return self._samples.kernel(lambda c: c.zz)

    @cached_property
    def _line(self) -> LineKernel:
        return line_kernel(self._samples.values.zz, self._samples.limits(lambda c: c.zz))

    def _interpolated(
        self, wavenumber: RealArray, components: Callable[[PlaneCompliance], tuple[RealArray, ...]]
    ) -> list[RealArray]:
        """Some ``components`` of C(q), from a table of q C where the array is larger than the table."""
        nodes = covering_grid(float(wavenumber.min()), float(wavenumber.max()))
        if wavenumber.size <= nodes.size:
            return list(components(interface_compliances(self.body, wavenumber)[0]))
        tables = [log_table(nodes[0], c) for c in components(interface_compliances(self.body, nodes)[0].scaled(nodes))]
        found = [table(wavenumber) for table in tables]
        for values in found:
            values /= wavenumber
        return found
