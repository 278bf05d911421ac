"""Memory of shear tractions on viscoelastic layers that relax differently, on half spectra.

Displacements along the surface and up and down by tau = (q, p) are u = C_0 tau + sum C_k xi_k,
lambda_k d(xi_k)/dt = tau - xi_k, where each C_k is a positive semi-definite matrix for each wave:
one series of retardations for all directions (``solids.compliance.retardation_fit``). The internal
pressures are those of the normal direction (``couplings.creep.LayeredPast``), the internal shear
tractions stand here.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ...contact.problem import ContactProblem
from ...core.arrays import ComplexArray, RealArray
from ...core.engine import CpuEngine
from ...solids.compliance.creep import RetardedSurface
from ..friction.operator import TangentialOperator
from ..friction.operator_sum import SummedTangential
from ..friction.stick_slip import Held
from .coupling import LayeredPast, Past, Products, ShearPast, TimeWeights, over_size, second_difference


@dataclass(frozen=True, eq=False)
class LayeredShear:
    """How shear is remembered: operators of the ``first`` instant and of the retarded ``terms``,
    and how pressure is ``kept``."""

    first: TangentialOperator
    terms: tuple[TangentialOperator, ...] = field(repr=False)
    kept: LayeredPast = field(repr=False)
    _last: dict[float, TangentialOperator] = field(default_factory=dict, init=False, repr=False)

    @classmethod
    def prepared(cls, problem: ContactProblem, kept: LayeredPast, threads: int | None) -> LayeredShear:
        """For the bodies of ``problem``."""
        grid, boundary, engine = problem.grid, problem.boundary, CpuEngine(threads)
        first = TangentialOperator(grid, (problem.body, problem.counter_body), boundary, engine=engine)
        retarded = [RetardedSurface(kept.creep, number) for number in range(kept.times.size)]
        return cls(first, tuple(TangentialOperator(grid, each, boundary, engine=engine) for each in retarded), kept)

    @property
    def operators(self) -> tuple[TangentialOperator, ...]:
        """Those of the first instant and of all that is retarded."""
        return self.first, *self.terms

    def operator(self, weights: TimeWeights) -> TangentialOperator:
        """Operator of a step of time; the last one is kept."""
        if not weights.after.any():
            return self.first
        if weights.length not in self._last:
            self._last.clear()
            self._last[weights.length] = SummedTangential(self.operators, [1.0, *weights.after])
        return self._last[weights.length]

    def virgin(self, shape: tuple[int, ...]) -> ShearPast:
        """No shear so far, on a grid of this ``shape``."""
        count = self.kept.times.size
        spectrum = self.kept.spectrum(np.zeros(shape))
        return ShearPast(np.zeros((count, 2, *spectrum.shape), complex), np.zeros((1, count)))

    def held(self, past: Past, traction: RealArray, weights: TimeWeights) -> Held:
        """What the ``past``, which ended with this ``traction`` (2, nx, ny) in Pa, displaces at the
        end of a step, and did before it."""
        shear = past.shear or self.virgin(past.pressure.shape)
        q, start = self._spectra(traction), np.zeros_like(shear.xi[0])
        along, up = np.zeros_like(start), np.zeros_like(start[0])
        for term, xi, xi_p, e, before in zip(self.terms, shear.xi, past.xi, weights.e, weights.before, strict=True):
            start += _response(term, xi, xi_p)[0]
            found = _response(term, e * xi + before * q, e * xi_p + before * past.response)
            along += found[0]
            up += found[1]
        begun = self._fields(start) + self.first.displacement(traction) + self.first.drawn(past.pressure)
        return Held(self._fields(along), self.kept.field(up), begun)

    def lifted(self, past: Past, traction: RealArray, weights: TimeWeights) -> RealArray:
        """Normal displacement (nx, ny) in m at the end of a step by the shear of a ``past`` that
        ended with this ``traction`` (2, nx, ny) in Pa."""
        shear = past.shear or self.virgin(past.pressure.shape)
        q = self._spectra(traction)
        up = np.zeros_like(q[0])
        for term, xi, e, before in zip(self.terms, shear.xi, weights.e, weights.before, strict=True):
            up += _lift(term, e * xi + before * q)
        return self.kept.field(up)

    def advanced(self, past: Past, before: RealArray, traction: RealArray, weights: TimeWeights) -> ShearPast:
        """The past of shear after a step from ``before`` to ``traction`` (2, nx, ny) in Pa, without
        its energies."""
        shear = past.shear or self.virgin(past.pressure.shape)
        return shear.advanced(self._spectra(before), self._spectra(traction), weights)

    def after(
        self, past: Past, before: RealArray, traction: RealArray, pressure: RealArray, weights: TimeWeights
    ) -> tuple[ShearPast, float, float]:
        """The past of shear after a step from ``before`` to ``traction`` (2, nx, ny) and
        ``pressure`` (nx, ny) in Pa, and the energy stored and the heat (J) of the step beyond those
        by pressure alone."""
        shear = past.shear or self.virgin(past.pressure.shape)
        loads = (self._spectra(before), past.response), (self._spectra(traction), self.kept.spectrum(pressure))
        sums = np.empty((5, len(self.terms)))
        for number, (term, *xi) in enumerate(zip(self.terms, shear.xi, past.xi, strict=True)):
            first, last = (self._counted(*_response(term, *load)) for load in loads)
            pairs = (xi, first), (xi, last), (loads[0], first), (loads[0], last), (loads[1], last)
            sums[:, number] = [_product(*pair) for pair in pairs]
        products = Products(shear.squares[0], *sums)
        squares = weights.advanced(products)
        at_once = _product(loads[1], self._counted(*_response(self.first, *loads[1])))
        stored = 0.5 * at_once + 0.5 * float(squares[np.isfinite(weights.times)].sum())
        heat = weights.dissipated(np.ones(len(self.terms)), products)
        return replace(shear.advanced(loads[0][0], loads[1][0], weights), squares=squares[None]), stored, heat

    def curvature(
        self, pasts: tuple[Past, Past, Past], tractions: tuple[RealArray, ...], weights: TimeWeights
    ) -> float:
        """Error of the displacement at the end of the last of two steps by the curvature of the
        ``tractions`` then, over that by traction and pressure."""
        curved = self._spectra(second_difference(pasts, tractions).real)
        none = np.zeros_like(curved[0])
        change = np.zeros_like(curved)
        for term, factor in zip(self.terms, weights.of_curvature, strict=True):
            change += factor * _response(term, curved, none)[0]
        error, operator = float(np.linalg.norm(change)), self.operator(weights)

        def size(traction: RealArray, past: Past) -> float:
            along = _response(operator, self._spectra(traction), none)[0]
            normal = (self.kept.operator.kernel + self.kept.summed(weights)) * past.response
            return float(np.hypot(np.linalg.norm(along), np.linalg.norm(normal)))

        last = size(tractions[2], pasts[2])
        if not last and error:  # contact was lost
            return over_size(error, [*map(size, tractions[:2], pasts[:2]), last])
        return over_size(error, [last])

    def _spectra(self, fields: RealArray) -> ComplexArray:
        return np.stack([self.kept.spectrum(each) for each in fields])

    def _fields(self, spectra: ComplexArray) -> RealArray:
        return np.stack([self.kept.field(each) for each in spectra])

    def _counted(self, along: ComplexArray, up: ComplexArray) -> tuple[ComplexArray, ComplexArray]:
        """Displacements times the area by which their products count (Parseval)."""
        return along * self.kept.counted, up * self.kept.counted


def _response(
    operator: TangentialOperator, q: ComplexArray, p: RealArray | ComplexArray
) -> tuple[ComplexArray, ComplexArray]:
    """Spectra of the displacement along the surface (2, …) by shear ``q`` (2, …) and pressure
    ``p``, and up by ``q``."""
    xx, yy, xy = operator.entries
    zx, zy = operator.coupling.zx, operator.coupling.zy
    drawn = -1j * p
    along = np.stack([xx * q[0] + xy * q[1] + zx * drawn, xy * q[0] + yy * q[1] + zy * drawn])
    return along, _lift(operator, q)


def _lift(operator: TangentialOperator, q: ComplexArray) -> ComplexArray:
    return np.asarray(1j * (operator.coupling.zx * q[0] + operator.coupling.zy * q[1]))


def _product(load: Sequence[ComplexArray], response: tuple[ComplexArray, ComplexArray]) -> float:
    """Work of a ``load`` (q, p) on a counted ``response``, less that of its pressure on the
    displacement by pressure (J)."""
    return float(np.vdot(load[0], response[0]).real + np.vdot(load[1], response[1]).real)
