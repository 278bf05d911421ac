"""Contact of a meshed body with an indenter: Newton's method for plastic flow and for the set of
touching points at once, with cut steps.

Points of the surface may not enter the indenter, u_n >= approach - height, and are pushed, never
pulled; each touches or is free. Every iterate of Newton's method solves the linear contact problem
with the tangent stiffness by changing the sets of touching, sticking and slipping points until they
agree with its forces (primal-dual active set, a semi-smooth Newton method: Hintermüller, Ito and
Kunisch 2002). It starts from the points that touched in the last step.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy import sparse

from ..core.arrays import BoolArray, RealArray
from ..core.errors import ConvergenceError
from ..core.quantity import measured
from ..solids.plasticity import PlasticState
from .linear import factorised, without
from .mesh import IntArray
from .solid import Response, Solid

TOLERANCE = 1e-8
"""Largest unbalanced force over the largest contact force at which a step has converged."""

MOST_ITERATIONS = 30
"""Newton iterations before a step is cut; 5 to 12 are usual."""

MOST_SETS = 20
"""How often the sets of touching and slipping points may change within one iteration."""

MOST_CUTS = 10
"""How often a step may be halved."""


@dataclass(frozen=True, eq=False)
class ContactSurface:
    """Points that may touch the indenter, and what holds the body.

    Attributes
    ----------
    normal
        (points,) unknowns of displacement into the body.
    fixed
        (unknowns,) those that are zero.
    tangential
        (points, 0 to 2) unknowns of displacement along the surface; none without friction.
    friction
        Coefficient μ >= 0; ``inf``: whatever touches sticks.
    relative
        Matrix that gives the unknowns of the elements from those of the system, in which an elastic
        indenter moves with the body; None: they are the same.
    """

    normal: IntArray
    fixed: BoolArray
    tangential: IntArray
    friction: float = 0.0
    relative: sparse.csc_array | None = None


@dataclass(frozen=True, eq=False)
class Target:
    """Where a step leads.

    Attributes
    ----------
    heights
        (points,) gap in m under the undeformed indenter whose lowest point touches the undeformed
        surface; ``inf`` beyond its edge.
    approach
        How far the indenter moves into the surface, in m; None: it follows from the ``force``.
    force
        Sum of the contact forces in N where no approach is given.
    shift
        (0 to 2,) displacement of the indenter along the surface in m, in all.
    """

    heights: RealArray
    approach: float | None = None
    force: float = 0.0
    shift: RealArray | None = None


@dataclass(frozen=True, eq=False)
class Equilibrium:
    """Balance at the end of a step, from which the next one starts.

    Attributes
    ----------
    displacement
        (unknowns,) of the system in m.
    state
        Plastic state.
    touching, slipping
        (points,) of the surface.
    approach, shift
        Of the indenter in m.
    normal_force, tangential_force
        (points,) and (points, 0 to 2) on the body in N.
    forces
        (unknowns of the elements,) in N, those of supports included.
    stress
        (elements, points, 6) in Pa.
    residuals
        Unbalanced force over the contact force, for each iteration.
    cuts
        How often the step was divided.
    largest
        Largest contact force so far in N, which residuals are measured by.
    """

    displacement: RealArray = measured("m", "displacements, one for each unknown")
    state: PlasticState = measured("", "plastic state at the Gauss points")
    touching: BoolArray = measured("1", "whether a point of the surface touches")
    slipping: BoolArray = measured("1", "whether a point of the surface slips")
    approach: float = measured("m", "approach of the indenter")
    shift: RealArray = measured("m", "displacement of the indenter along the surface")
    normal_force: RealArray = measured("N", "forces into the body on the points of the surface")
    tangential_force: RealArray = measured("N", "forces along the surface on its points")
    forces: RealArray = measured("N", "forces on the elements, one for each unknown")
    stress: RealArray = measured("Pa", "stress at the Gauss points, rr, tt, zz, rt, rz, tz")
    residuals: tuple[float, ...] = measured("1", "unbalanced force over the contact force", "iteration", default=())
    cuts: int = measured("1", "how often the step was divided", default=0)
    largest: float = measured("N", "largest contact force so far", default=0.0)

    @property
    def force(self) -> float:
        """Sum of the normal forces in N."""
        return float(self.normal_force.sum())


@dataclass(frozen=True, eq=False)
class Pressed:
    """A body with its surface."""

    solid: Solid
    surface: ContactSurface

    def undeformed(self) -> Equilibrium:
        """State without load."""
        surface = self.surface
        points, directions = len(surface.normal), surface.tangential.shape[1]
        unknowns = self.solid.elements.size
        free = np.zeros(points, dtype=bool)
        return Equilibrium(
            np.zeros(unknowns),
            self.solid.virgin(),
            free,
            free,
            0.0,
            np.zeros(directions),
            np.zeros(points),
            np.zeros((points, directions)),
            np.zeros(unknowns),
            np.zeros((*self.solid.elements.shape, 6)),
        )

    def elements_move(self, displacement: RealArray) -> RealArray:
        """Displacement of the unknowns of the elements, from those of the system."""
        relative = self.surface.relative
        return displacement if relative is None else relative @ displacement

    def respond(self, displacement: RealArray, state: PlasticState) -> tuple[Response, RealArray, sparse.csc_array]:
        """Response of the body, with forces and stiffness of the unknowns of the system."""
        response = self.solid.respond(self.elements_move(displacement), state, stiffness=True)
        assert response.stiffness is not None
        relative = self.surface.relative
        if relative is None:
            return response, response.forces, response.stiffness
        return (
            response,
            relative.T @ response.forces,
            sparse.csc_array(relative.T @ response.stiffness @ relative),
        )

    def advance(self, start: Equilibrium, path: Callable[[float], Target]) -> Equilibrium:
        """Follow ``path`` from its part 0, at ``start``, to 1: at once, or in halves where Newton's
        method fails.

        Raises
        ------
        ConvergenceError
            If a step of 1/1024 of the path does not converge: near collapse, or the loads are far
            too large.
        """
        done, part, cuts = 0.0, 1.0, 0
        now = start
        while done < 1.0:
            upto = min(1.0, done + part)
            try:
                now = _Newton(self, now, path(upto)).solve()
            except ConvergenceError as error:
                cuts, part = cuts + 1, 0.5 * part
                if part < 0.5**MOST_CUTS:
                    raise ConvergenceError(
                        f"A step of the indenter is not found even in {2**MOST_CUTS} parts: {error} Take more "
                        "steps, or give a little hardening.",
                        now,
                    ) from error
                continue
            done = upto
        return replace(now, cuts=cuts)


class _Newton:
    """One step."""

    def __init__(self, body: Pressed, start: Equilibrium, target: Target) -> None:
        self.body, self.surface, self.start, self.target = body, body.surface, start, target
        self.u = start.displacement.copy()
        self.touching, self.slipping = (
            start.touching.copy(),
            np.zeros_like(start.slipping),
        )  # all that touches sticks at first
        self.approach = start.approach if target.approach is None else target.approach
        self.shift = np.zeros(self.surface.tangential.shape[1]) if target.shift is None else target.shift
        self.directions = np.zeros(self.surface.tangential.shape)
        if not self.touching.any():
            self._first_touch()

    def _first_touch(self) -> None:
        """The points that touch an elastic body, from those that are deepest in the indenter: one
        point alone would yield far too much."""
        gap = self.target.heights + self.u[self.surface.normal]
        self.touching = gap <= gap.min() + 1e-12 * np.ptp(gap[np.isfinite(gap)])
        if self.target.approach is not None:
            if gap.min() < self.approach:
                self._elastic(self.target)
            else:
                self.touching[:] = False
            return
        if self.target.force <= 0.0:
            self.touching[:] = False
            return
        self.approach = float(gap.min())
        if self.touching.sum() > 1:
            return
        depth = float(np.quantile(gap[np.isfinite(gap)], 0.25)) - self.approach
        for _ in range(MOST_ITERATIONS):  # until the elastic force is near enough for all points to be on their side
            found = self._elastic(replace(self.target, approach=float(gap.min()) + depth))
            if abs(found - self.target.force) < 0.2 * self.target.force:
                return
            depth *= min(max((self.target.force / max(found, 1e-300)) ** (2.0 / 3.0), 0.01), 100.0)

    def _elastic(self, target: Target) -> float:
        """Contact force in N at the approach of ``target`` if the body stayed elastic from here; it
        leaves displacement and touching points there."""
        wanted, self.target = self.target, target
        self.approach = float(target.approach or 0.0)
        self.u = self.start.displacement.copy()
        _, forces, stiffness = self.body.respond(self.u, self.start.state)
        pushed = self._settle(forces, stiffness)[self.surface.normal]
        self.target = wanted
        return float(pushed[self.touching].sum())

    def _settle(self, forces: RealArray, stiffness: sparse.csc_array) -> RealArray:
        """One step of Newton's method, with the sets that belong to its linear forces, which are
        given back in N."""
        base, approach, before = self.u, self.approach, forces
        for _ in range(MOST_SETS):
            self.u, self.approach = base.copy(), approach
            self._move(before, stiffness)
            forces = before + stiffness @ (self.u - base)
            if not self._sort(forces):
                break
        return forces

    def solve(self) -> Equilibrium:
        """Iterate until forces balance and no point changes its set."""
        surface = self.surface
        residuals: list[float] = []
        for count in range(MOST_ITERATIONS):
            response, forces, stiffness = self.body.respond(self.u, self.start.state)
            changed = self._sort(forces) if count else False
            rows = self._slip_rows()
            left = forces if rows is None else rows @ forces
            push = forces[surface.normal]
            pushed = push[self.touching]
            error = float(np.abs(left[~self._prescribed()]).max())
            scale = max(float(np.abs(pushed).sum()), self.start.largest)
            if self.target.approach is None:
                error = max(error, abs(float(pushed.sum()) - self.target.force))
                scale = max(scale, self.target.force)
            scale = max(scale, error * 1e-300)
            residuals.append(error / scale if scale > 0.0 else 0.0)
            # Touching points must lie on the indenter, and sticking ones move with it.
            near = 1e-9 * max(float(np.abs(self.u).max()), 1e-300)
            away = np.abs(self.u[surface.normal] - (self.approach - self.target.heights))[self.touching]
            loose = self._slid()[self.touching & ~self.slipping] if surface.friction else np.zeros(0)
            met = bool((away <= near).all() and (np.abs(loose) <= near).all())
            if not math.isfinite(residuals[-1]) or residuals[-1] > 1e12:
                raise ConvergenceError("Newton's method diverges.")
            if residuals[-1] <= TOLERANCE and not changed and met:
                return Equilibrium(
                    self.u,
                    response.state,
                    self.touching,
                    self.slipping & self.touching,
                    self.approach,
                    self.shift,
                    np.where(self.touching, push, 0.0),
                    np.where(self.touching[:, None], forces[surface.tangential], 0.0),
                    response.forces,
                    response.stress,
                    tuple(residuals),
                    largest=max(self.start.largest, float(pushed.sum())),
                )
            self._settle(forces, stiffness)
        raise ConvergenceError(f"Newton's method leaves an unbalanced force of {residuals[-1]:.1e} of the load.")

    # The sets.

    def _sort(self, forces: RealArray) -> bool:
        """Move points between the sets by the forces and displacements of the last iterate; whether
        one was moved."""
        surface, normal = self.surface, forces[self.surface.normal]
        depth = self.u[surface.normal] - (self.approach - self.target.heights)
        small = 1e-12 * max(float(np.abs(self.u).max()), 1e-300)
        weak = -1e-10 * float(np.abs(normal).max(initial=0.0))
        touching = np.where(self.touching, normal > weak, depth < -small)
        changed = bool((touching != self.touching).any())
        if surface.friction and surface.tangential.size and math.isfinite(surface.friction):
            pull = forces[surface.tangential]
            size = np.sqrt((pull**2).sum(axis=1))
            slid = self._slid()
            against = (slid * self.directions).sum(axis=1)
            pulled = size > surface.friction * np.maximum(normal, 0.0) * (1.0 + 1e-9)
            slipping = np.where(self.slipping, against <= small, self.touching & pulled)
            slipping = slipping & touching
            changed = changed or bool((slipping != self.slipping).any())
            fresh = slipping & ~self.slipping
            unit = pull / np.where(size > 0.0, size, 1.0)[:, None]
            self.directions[fresh] = unit[fresh]
            if surface.tangential.shape[1] == 2:
                moved = np.sqrt((slid**2).sum(axis=1))
                turned = slipping & ~fresh & (moved > small)
                self.directions[turned] = -slid[turned] / moved[turned, None]
            self.slipping = slipping
        self.touching = touching
        return changed

    def _slid(self) -> RealArray:
        """Motion (points, directions) of the surface against the indenter in this step."""
        tangential = self.surface.tangential
        found: RealArray = self.u[tangential] - self.start.displacement[tangential] - (self.shift - self.start.shift)
        return found

    # Balance.

    def _prescribed(self) -> BoolArray:
        found = self.surface.fixed.copy()
        found[self.surface.normal[self.touching]] = True
        if self.surface.friction:
            found[self.surface.tangential[self.touching & ~self.slipping].ravel()] = True
        return found

    def _slip_rows(self) -> sparse.csc_array | None:
        """What subtracts the friction μ p from the balance of slipping points; None if no point
        slips."""
        slipping = self.slipping & self.touching
        if not self.surface.friction or not slipping.any():
            return None
        tangential, unknowns = self.surface.tangential[slipping], len(self.u)
        normal = np.repeat(self.surface.normal[slipping][:, None], tangential.shape[1], axis=1)
        entries = -self.surface.friction * self.directions[slipping]
        moved = sparse.coo_array((entries.ravel(), (tangential.ravel(), normal.ravel())), shape=(unknowns, unknowns))
        return sparse.csc_array(sparse.eye_array(unknowns, format="csc") + moved)

    def _move(self, forces: RealArray, stiffness: sparse.csc_array) -> None:
        """One step of Newton's method, at a given approach or force."""
        surface, prescribed, rows = self.surface, self._prescribed(), self._slip_rows()
        symmetric = rows is None and self.body.solid.symmetric
        left, matrix = (forces, stiffness) if rows is None else (rows @ forces, sparse.csc_array(rows @ stiffness))
        if not symmetric:
            matrix.sort_indices()
        known = np.zeros((len(self.u), 1 if self.target.approach is not None else 2))
        normal = surface.normal[self.touching]
        known[normal, 0] = (self.approach - self.target.heights - self.u[surface.normal])[self.touching]
        if surface.friction:
            stuck = self.touching & ~self.slipping
            known[surface.tangential[stuck], 0] = -self._slid()[stuck]
        known[normal, 1:] = 1.0
        right = -(matrix @ known)
        right[:, 0] -= left
        right[prescribed] = 0.0
        found = factorised(without(matrix, prescribed), symmetric=symmetric)(right) + known
        if self.target.approach is not None:
            self.u += found[:, 0]
            return
        pushed = (stiffness @ found)[normal].sum(axis=0)
        if len(normal) == 0 or not pushed[1] > 0.0:
            raise ConvergenceError("No point of the surface bears the force.")
        further = (self.target.force - float(forces[normal].sum()) - pushed[0]) / pushed[1]
        self.approach += float(further)
        self.u += found[:, 0] + further * found[:, 1]
