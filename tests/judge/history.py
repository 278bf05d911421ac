"""Equations of what bodies remember: viscoelastic ones their pressures, plastic ones their
strain."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from judge.checks import EPS, ROUNDING, Check, norm, over

import asperity as asp
from asperity.contact.operators import Operator
from asperity.core.arrays import RealArray
from asperity.solids.eigenstrain.cells import DepthCells
from asperity.solids.plasticity import UNIT, WEIGHTS, PlasticState

NODES, GAUSS = np.polynomial.legendre.leggauss(12)
"""Rule for the heat of a step, whose integrand is a product of exponentials and straight lines in
time."""


@dataclass(frozen=True, eq=False)
class Remembered:
    """Internal pressures ξ_k (terms, nx, ny) in Pa of retardation times λ_k, λ dξ/dt = p - ξ, and
    the last pressure; ∫ p dt (Pa s) of a fluid."""

    times: RealArray
    shares: RealArray
    fluidity: float
    xi: RealArray
    flow: RealArray
    pressure: RealArray

    @classmethod
    def virgin(cls, body: asp.Viscoelastic, shape: tuple[int, int]) -> Remembered:
        """Those of a ``body`` that has borne nothing."""
        creep = body.contact_creep
        times = np.array([time for _, time in creep.terms])
        shares = np.array([strength / creep.instantaneous for strength, _ in creep.terms])
        none = np.zeros(shape)
        xi = np.zeros((times.size, *shape))
        return cls(times, shares, creep.fluidity / creep.instantaneous, xi, none, none)

    def at(self, time: float, rate: RealArray) -> RealArray:
        """ξ (terms, nx, ny) after ``time`` s in which the pressure grows by ``rate`` (Pa/s)."""
        lam = self.times[:, None, None]
        gone = -np.expm1(-time / lam)
        return np.asarray(self.xi + gone * (self.pressure - self.xi) + rate * (time - lam * gone))

    def factor(self, time: float) -> float:
        """Displacement by the pressure at the end of a step of ``time`` s in which it grew in a
        straight line, over that at once."""
        if time == 0.0:
            return 1.0
        grown = 1.0 - self.times * -np.expm1(-time / self.times) / time
        return 1.0 + float(self.shares @ grown) + 0.5 * time * self.fluidity

    def after(self, time: float, pressure: RealArray) -> Remembered:
        """The same after a step in which the pressure went to ``pressure`` in a straight line."""
        if time == 0.0:
            return Remembered(self.times, self.shares, self.fluidity, self.xi, self.flow, pressure)
        xi = self.at(time, (pressure - self.pressure) / time)
        flow = self.flow + 0.5 * time * (self.pressure + pressure)
        return Remembered(self.times, self.shares, self.fluidity, xi, flow, pressure)

    def summed(self) -> RealArray:
        """Pressure (nx, ny) in Pa that would displace as much at once as all before the last has
        done."""
        return np.asarray(np.tensordot(self.shares, self.xi, axes=1) + self.fluidity * self.flow)

    def stored(self, operator: Operator) -> float:
        """Energy per pixel area (Pa m): ½ p·K p + ½ Σ s ξ·K ξ."""
        total = float((self.pressure * operator.apply(self.pressure)).sum())
        for share, xi in zip(self.shares, self.xi, strict=True):
            total += share * float((xi * operator.apply(np.ascontiguousarray(xi))).sum())
        return 0.5 * total

    def heat(self, operator: Operator, time: float, pressure: RealArray) -> float:
        """Σ s/λ ∫ (p - ξ)·K (p - ξ) dt + φ ∫ p·K p dt per pixel area (Pa m) of such a step."""
        if time == 0.0:
            return 0.0
        rate, total = (pressure - self.pressure) / time, 0.0
        for node, weight in zip(NODES, GAUSS, strict=True):
            at = 0.5 * time * (1.0 + node)
            now, xi = self.pressure + rate * at, self.at(at, rate)
            power = self.fluidity * float((now * operator.apply(now)).sum())
            for share, lam, part in zip(self.shares, self.times, xi, strict=True):
                driven = np.ascontiguousarray(now - part)
                power += share / lam * float((driven * operator.apply(driven)).sum())
            total += 0.5 * time * weight * power
        return total


def in_time(
    operator: Operator, past: Remembered, result: asp.ContactResult, duration: float
) -> tuple[RealArray, Remembered, list[Check]]:
    """Retarded displacement (nx, ny) in m, what is remembered then, and equations of displacement,
    stored energy and heat of a step of time."""
    creep = result.creep
    assert creep is not None
    pressure = np.asarray(result.pressure, dtype=float)
    now = past.after(duration, pressure)
    whole = operator.apply(pressure + now.summed())
    size, pixel = norm(whole), result.problem.grid.pixel_area
    eps = 8.0 * float(np.finfo(result.pressure.dtype).eps) + 1e3 * ROUNDING
    stored, heat = now.stored(operator) * pixel, past.heat(operator, duration, pressure) * pixel
    scale = abs(stored) + abs(heat)
    checks = [
        Check("displacement in time", over(norm(np.asarray(result.displacement) - whole), size), eps),
        Check("stored energy", over(abs(stored - result.elastic_energy), scale), eps),
        Check("heat", over(abs(heat - creep.dissipated), scale), eps),
    ]
    return whole, now, checks


def energy_in_time(results: tuple[asp.ContactResult, ...]) -> list[Check]:
    """Work of the force over the approach by trapezia: what is stored and heat, to what the steps
    of time explain."""
    works, spread, heat = 0.0, 0.0, 0.0
    largest = 0.0
    for result in results:
        creep = result.creep
        assert creep is not None
        force, approach = creep.column("force"), creep.column("approach")
        moved = np.diff(approach)
        work = float((0.5 * (force[1:] + force[:-1]) * moved).sum())
        works, heat = works + work, heat + creep.dissipated
        spread += 0.5 * float(np.abs(np.diff(force) * moved).sum())
        largest = max(largest, abs(works))
    last = results[-1]
    assert last.creep is not None
    missed = abs(works - heat - last.elastic_energy)
    stated = (last.creep.energy_error + last.creep.explained_error) * max(last.creep.largest_work, largest) + spread
    return [Check("energy in time", missed, stated + EPS * largest)]


# Plastic flow.


def plastic_flow(result: asp.ContactResult, before: asp.ContactResult | None) -> list[Check]:
    """The return mapping of the stress under this pressure leaves the plastic strain as it is;
    plastic strain keeps the volume."""
    flow = result.require_plastic_flow()
    tolerance = max([check.tolerance for check in result.certificate.couplings], default=0.0)
    assert result.problem.plastic_flow is not None
    tolerance = max(tolerance, result.problem.plastic_flow.tolerance)
    if not flow.flowed.points.size:
        return []
    pressure = np.asarray(result.pressure, dtype=float)
    stress = np.moveaxis(flow.stress(pressure, _shear(result, pressure), threads=1), 1, -1)
    after = _state(flow)
    cut = "equal parts" in result.status.message
    start = after if cut else _aligned(None if before is None else before.require_plastic_flow(), flow)
    deviator = stress - np.multiply.outer(stress[..., :3].sum(axis=-1) / 3.0, UNIT)
    mapped = _mapped(flow, deviator, after, start)
    weights = np.diff(flow.flowed.edges)[:, None, None, None] * WEIGHTS
    change = float(((mapped - after.plastic_strain) ** 2 * weights).sum()) ** 0.5
    size = float((after.plastic_strain**2 * weights).sum()) ** 0.5
    traces = norm(after.plastic_strain[..., :3].sum(axis=-1))
    return [
        Check("return mapping", over(change, size), tolerance),
        Check("plastic strain keeps the volume", over(traces, norm(after.plastic_strain)), 1e3 * ROUNDING),
    ]


def _shear(result: asp.ContactResult, pressure: RealArray) -> RealArray | None:
    """Shear traction (2, nx, ny) in Pa where everything slides."""
    friction = result.problem.friction
    if not isinstance(friction, asp.Coulomb):
        return None
    way = np.array([np.cos(friction.direction), np.sin(friction.direction)])
    return np.asarray(way[:, None, None] * friction.bound(pressure))


def _mapped(
    flow: asp.plasticity.PlasticBody, deviator: RealArray, after: PlasticState, start: PlasticState
) -> RealArray:
    """Plastic strain (cells, nx, ny, 6) that the laws return from ``start`` to under the
    ``deviator`` of the stress with the strain ``after``."""
    found = after.plastic_strain.copy()
    regions = DepthCells(flow.body, flow.flowed.edges).regions
    for cell, region in enumerate(regions):
        law = flow.laws[region]
        if law is not None:
            strain = deviator[cell] / (2.0 * law.shear) + after.plastic_strain[cell]
            begun = PlasticState(start.plastic_strain[cell], start.back_stress[cell], start.accumulated[cell])
            found[cell] = law.step(strain, begun).state.plastic_strain
    return found


def _state(flow: asp.plasticity.PlasticBody) -> PlasticState:
    """Fields (cells, nx, ny, …) of the body."""
    strain = np.moveaxis(flow.plastic_strain, 1, -1)
    back = np.zeros_like(strain)
    flat = back.reshape(-1, 6)
    flat[flow.flowed.points] = flow.flowed.state.back_stress
    return PlasticState(strain, back, flow.accumulated)


def _aligned(before: asp.plasticity.PlasticBody | None, now: asp.plasticity.PlasticBody) -> PlasticState:
    """State before a step in the depth cells after it, of which there may be more."""
    shape = now.accumulated.shape
    found = PlasticState.virgin(shape)
    if before is None or not before.flowed.points.size:
        return found
    known = _state(before)
    count = known.accumulated.shape[0]
    for name in ("plastic_strain", "back_stress", "accumulated"):
        getattr(found, name)[:count] = getattr(known, name)
    return found
