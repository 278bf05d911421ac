"""A rigorous lower bound of the energy of an adhesive contact, by a convex problem that lies below
it.

The energy Π = ½ u·K⁻¹u + Σ φ(g), g = d + u - h >= 0, is not convex: a contact that is found may be
one minimum of several. Every contact whose energy is not above that found has displacements within
±U, for u_i² <= K_ii u·K⁻¹u, K_ii the compliance of one point. There its gaps lie between L_i and
G_i, and φ, which is concave, above its chord. With the chords in place of φ the problem is a
contact with a hard wall under a fixed pull, whose dual gives a bound from below for any pressure p:
Π >= dual + ½ (u - u_p)·K⁻¹(u - u_p), u_p = K (p - pull). That in turn bounds the distance from u_p,
and with it the gaps. No contact at this approach has less energy.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...contact.law import HardWall
from ...contact.operators import Operator, prepare_operator
from ...contact.result import ContactResult
from ...contact.solvers.protocol import FixedOffset
from ...core import require
from ...core.errors import InputError
from .solver.problem import AdhesiveProblem
from .solver.solver import minimised

_GAIN = 0.01
"""Gain of a round over what is left between energy and bound below which it ends."""

_BOUNDS = 40
"""Rounds in which the bound of the displacement and that of the interface tighten each other."""


@dataclass(frozen=True)
class EnergyBound:
    """Energy of a contact, and what no contact at the same approach is below, in J.

    Attributes
    ----------
    energy
        Elastic energy and that of the interface of the contact found.
    lower
        Lower bound for every contact at this approach.
    available
        Work of adhesion times nominal area, by which the two are made comparable.
    displacement
        Largest difference in m of the displacements of a contact with no more energy from those of
        the convex problem.
    """

    energy: float
    lower: float
    available: float
    displacement: float

    @property
    def gap(self) -> float:
        """Energy by which another contact might at most be lower, over the work of adhesion times
        nominal area."""
        return (self.energy - self.lower) / self.available


def energy_bound(result: ContactResult, *, rounds: int = 8, operator: Operator | None = None) -> EnergyBound:
    """Bound for the adhesive contact of ``result``.

    Parameters
    ----------
    result
        The contact.
    rounds
        Normal solves at most, >= 1; each narrows the gaps between which the chords are drawn.
    operator
        That of its problem, if it is prepared already.

    Raises
    ------
    InputError
        If there is no adhesion, or a hardness, film or friction beside it, or its law has a core:
        the energy is then another.
    """
    problem, law = result.problem, result.require_adhesion().law
    if not isinstance(problem.law, HardWall) or len(problem.physics) > 1:
        raise InputError(
            "problem of a bound of the energy must have adhesion alone, but has a hardness, a film of liquid "
            "or friction beside it. Leave them out."
        )
    if law.spacing > 0.0:
        raise InputError(
            f"adhesion of a bound of the energy must be a law beside a hard wall, but {law.name} has a core "
            "that repels. Use "
            "another law ({gentle_law}) of the same work and strength.",
            subject="adhesion",
        )
    require.integer(rounds, 1, "number of rounds of a bound")
    operator = operator or prepare_operator(problem.compliance, problem.grid, problem.boundary)
    pixel, profile = operator.grid.pixel_area, problem.profile()
    flat = result.offset - profile
    found = result.require_adhesion()
    energy = found.elastic_energy + found.interface_energy
    one = np.zeros(operator.grid.shape)
    one[0, 0] = 1.0
    compliance = float(operator.apply(one)[0, 0])  # K_ii in m/Pa, the same for all points
    # U of every contact whose energy is not above that found
    reach = math.inf
    for _ in range(_BOUNDS):
        closest = np.zeros_like(flat) if math.isinf(reach) else np.maximum(flat - reach, 0.0)
        elastic = energy / pixel - float(law.energy(closest).sum())
        further = math.sqrt(2.0 * compliance * max(elastic, 0.0))
        if further >= reach * (1.0 - 1e-6):
            break
        reach = further
    nearest, farthest = np.maximum(flat - reach, 0.0), np.maximum(flat + reach, 0.0)
    posed = AdhesiveProblem(operator, profile, law, FixedOffset(result.offset))
    pressure, lower = np.asarray(result.pressure, dtype=float), -np.inf
    for _ in range(rounds):
        # chords of φ: slope (Pa), and value at no gap (J/m²)
        low, high, width = law.energy(nearest), law.energy(farthest), farthest - nearest
        slope = np.where(width > 0.0, np.maximum(high - low, 0.0) / np.where(width > 0.0, width, 1.0), 0.0)
        base = low - slope * nearest
        pressure = minimised(posed, slope, pressure).pressure
        traction = pressure - slope
        moved = operator.apply(traction)
        dual = -0.5 * float((traction * moved).sum()) - float((traction * flat).sum()) + float(base.sum())
        # every contact of no more energy is as near to this one as the energy between them allows
        reach = math.sqrt(2.0 * compliance * max(energy / pixel - dual, 0.0))
        nearest = np.maximum(nearest, flat + moved - reach)
        farthest = np.maximum(np.minimum(farthest, flat + moved + reach), nearest)
        gained, lower = dual - lower, max(lower, dual)
        if gained <= _GAIN * abs(energy / pixel - lower):
            break
    return EnergyBound(energy, lower * pixel, law.work * operator.grid.area, reach)
