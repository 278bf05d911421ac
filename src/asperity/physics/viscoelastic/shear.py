"""Memory of shear tractions in viscoelastic bodies that stick and slip.

The displacements (along the surface, and up and down) by shear tractions q and pressures p are a
sum over parts, each of which grows in time by one factor: u(t) = sum_i C_i [tau + sum_k s_ik xi_k],
tau = (q, p), lambda_k d(xi_k)/dt = tau - xi_k as for pressure alone (``couplings.creep``). A part
is a body, or layers, whose moduli all relax alike (of others see ``layered_shear``). The compliance
of a half-space with an elastic bulk has two: in 1/G, that of an incompressible solid, and in z =
3/2(3K + G), in which 1 - nu = G (1/2G + z).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from ...contact.problem import ContactProblem
from ...core.arrays import ComplexArray, RealArray
from ...core.engine import CpuEngine
from ...solids.compliance.creep import SharedCreep
from ...solids.elastic import Elastic, Rigid
from ...solids.layers import Body, deformable, materials_of
from ...solids.relaxation import Creep, Relaxation
from ...solids.viscoelastic import Viscoelastic, alike
from ..friction.operator import TangentialOperator
from ..friction.operator_sum import SummedTangential
from ..friction.stick_slip import Held
from .coupling import Past, Products, ShearPast, TimeWeights, over_size, second_difference

_EQUAL = 1e-6
"""Relative difference of retardation times that are one."""


@dataclass(frozen=True, eq=False)
class ShearPart:
    """``operator`` at the first instant of what grows by one factor, and the ``shares`` (terms,) by
    which it does."""

    operator: TangentialOperator = field(repr=False)
    shares: RealArray

    def left(self, xi: RealArray | ComplexArray, latest: RealArray, weights: TimeWeights) -> RealArray:
        """sum s_k (e_k xi_k + before_k times the ``latest``), in Pa: what displaces at the end of a
        step as much as the past does."""
        past = np.tensordot(self.shares * weights.e, xi.real, axes=1)
        return float(self.shares @ weights.before) * latest + past


@dataclass(frozen=True, eq=False)
class ShearMemory:
    """How shear is remembered; ``times`` (terms,) are those of the pressure."""

    parts: tuple[ShearPart, ...]
    times: RealArray

    @classmethod
    def prepared(cls, problem: ContactProblem, creep: SharedCreep, threads: int | None) -> ShearMemory:
        """For the bodies of ``problem``, whose normal compliance has this ``creep``."""
        bodies, engine = (problem.body, problem.counter_body), CpuEngine(threads)

        def operator(*pair: Body) -> TangentialOperator:
            return TangentialOperator(problem.grid, (pair[0], pair[1]), problem.boundary, engine=engine)

        materials = tuple(m for solid, _ in deformable(*bodies) for m in materials_of(solid))
        if alike(materials):
            return cls((ShearPart(operator(*bodies), creep.shares),), creep.times)
        found: list[ShearPart] = []
        for number, body in enumerate(bodies):
            if isinstance(body, Rigid):
                continue
            (solid,) = materials_of(body)

            def alone(material: Elastic, at: int = number) -> TangentialOperator:
                return operator(material, Rigid()) if at == 0 else operator(Rigid(), material)

            for made, growth in _compliances(solid, alone):
                found.append(ShearPart(made, _shares(growth, creep.times)))
        return cls(tuple(found), creep.times)

    @property
    def operators(self) -> tuple[TangentialOperator, ...]:
        """Those of all parts."""
        return tuple(part.operator for part in self.parts)

    def operator(self, weights: TimeWeights) -> TangentialOperator:
        """Operator of a step of time."""
        if len(self.parts) == 1 and not weights.after.any():
            return self.parts[0].operator
        return SummedTangential(self.operators, [1.0 + float(part.shares @ weights.after) for part in self.parts])

    def virgin(self, shape: tuple[int, ...]) -> ShearPast:
        """No shear so far, on a grid of this ``shape``."""
        count = self.times.size
        return ShearPast(np.zeros((count, 2, *shape)), np.zeros((len(self.parts), count)))

    def held(self, past: Past, traction: RealArray, weights: TimeWeights) -> Held:
        """What the ``past``, which ended with this ``traction`` (2, nx, ny) in Pa, displaces at the
        end of a step, and did before it."""
        at_once = TimeWeights.of(self.times, 0.0)
        left, lift = self._left(past, traction, weights)
        start, _ = self._left(past, traction, at_once)
        for part in self.parts:
            start = start + part.operator.displacement(traction) + part.operator.drawn(past.pressure)
        return Held(left, lift, start)

    def lifted(self, past: Past, traction: RealArray, weights: TimeWeights) -> RealArray:
        """Normal displacement (nx, ny) in m at the end of a step by the shear of a ``past`` that
        ended with this ``traction`` (2, nx, ny) in Pa."""
        shear = past.shear or self.virgin(past.pressure.shape)
        lift = np.zeros(past.pressure.shape)
        for part in self.parts:
            lift += part.operator.coupling.lift(part.left(shear.xi, traction, weights))
        return lift

    def _left(self, past: Past, traction: RealArray, weights: TimeWeights) -> tuple[RealArray, RealArray]:
        """Displacement along the surface and up by sum s_k (e_k xi_k + before_k tau)."""
        shear = past.shear or self.virgin(past.pressure.shape)
        along, lift = np.zeros(traction.shape), np.zeros(past.pressure.shape)
        for part in self.parts:
            if not (part.shares * weights.e).any() and not float(part.shares @ weights.before):
                continue
            q = part.left(shear.xi, traction, weights)
            p = part.left(past.xi, past.pressure, weights)
            along = along + part.operator.displacement(q) + part.operator.drawn(p)
            lift = lift + part.operator.lift(q)
        return along, lift

    def advanced(self, past: Past, before: RealArray, traction: RealArray, weights: TimeWeights) -> ShearPast:
        """The past of shear after a step from ``before`` to ``traction`` (2, nx, ny) in Pa, without
        its energies."""
        return (past.shear or self.virgin(past.pressure.shape)).advanced(before, traction, weights)

    def after(
        self, past: Past, before: RealArray, traction: RealArray, pressure: RealArray, weights: TimeWeights
    ) -> tuple[ShearPast, float, float]:
        """The past of shear after a step from ``before`` to ``traction`` (2, nx, ny) and
        ``pressure`` (nx, ny) in Pa, and the energy stored and the heat (J) of the step beyond those
        by pressure alone."""
        shear = past.shear or self.virgin(past.pressure.shape)
        solid, squares = np.isfinite(self.times), np.empty_like(shear.squares)
        area, loads = self.parts[0].operator.grid.pixel_area, ((before, past.pressure), (traction, pressure))
        xi = list(zip(shear.xi, past.xi.real, strict=True))

        def product(x: tuple[RealArray, RealArray], y: tuple[RealArray, RealArray]) -> float:
            """x·C y less that of the pressures alone, J."""
            return area * (float(np.einsum("kij,kij->", x[0], y[0])) + float(np.einsum("ij,ij->", x[1], y[1])))

        stored = heat = 0.0
        for number, part in enumerate(self.parts):
            operator = part.operator
            responses = [(operator.displacement(q) + operator.drawn(p), operator.lift(q)) for q, p in loads]
            with_0, with_1 = (np.array([product(each, response) for each in xi]) for response in responses)
            p00, p01, p11 = (product(loads[i], responses[j]) for i, j in ((0, 0), (0, 1), (1, 1)))
            products = Products(shear.squares[number], with_0, with_1, p00, p01, p11)
            squares[number] = weights.advanced(products)
            heat += weights.dissipated(part.shares, products)
            stored += 0.5 * float(products.p11) + 0.5 * float(part.shares[solid] @ squares[number][solid])
        return replace(shear.advanced(before, traction, weights), squares=squares), stored, heat

    def curvature(
        self, pasts: tuple[Past, Past, Past], tractions: tuple[RealArray, ...], weights: TimeWeights
    ) -> float:
        """Error of the displacement at the end of the last of two steps by the curvature of the
        ``tractions`` then, over that by traction and pressure."""
        curved = second_difference(pasts, tractions)
        sizes = [
            float(np.hypot(np.linalg.norm(traction), np.linalg.norm(past.pressure)))
            for traction, past in zip(tractions, pasts, strict=True)
        ]
        each = [
            float(part.shares @ weights.of_curvature) / (1.0 + float(part.shares @ weights.after))
            for part in self.parts
        ]
        return over_size(max(each) * float(np.linalg.norm(curved)), sizes)


def _compliances(
    solid: Elastic, alone: Callable[[Elastic], TangentialOperator]
) -> list[tuple[TangentialOperator, Creep | None]]:
    """Operators whose sum is that of a half-space of ``solid`` at the first instant, and how each
    of them creeps."""
    if not isinstance(solid, Viscoelastic) or not solid.spectrum:
        return [(alone(solid), None)]
    shear = solid.shear
    if not solid.elastic_bulk:
        return [(alone(solid.instantaneous), shear.creep)]
    G = solid.shear_modulus
    stiff = Relaxation(shear.relaxed + 3.0 * solid.bulk_modulus, shear.terms).creep
    M = 1.0 / (1.5 * stiff.instantaneous)  # 1/z at the first instant
    volume = SummedTangential([alone(Elastic(2.0 * M, 0.0)), alone(Elastic(3.0 * M, 0.5))], (2.0, -2.0))
    return [(alone(Elastic(3.0 * G, 0.5)), shear.creep), (volume, stiff)]


def _shares(creep: Creep | None, times: RealArray) -> RealArray:
    """Retarded over instantaneous compliance for each of the ``times``."""
    shares = np.zeros(times.size)
    if creep is None:
        return shares
    for strength, lam in creep.terms:
        at = int(np.argmin(np.abs(np.log(np.where(np.isinf(times), 1e300, times) / lam))))
        assert math.isclose(times[at], lam, rel_tol=_EQUAL)
        shares[at] += strength / creep.instantaneous
    if creep.fluidity:
        shares[-1] += creep.fluidity / creep.instantaneous
    return shares
