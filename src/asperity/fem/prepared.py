"""Linear systems of many steps on one mesh: the elastic stiffness is factorised once and
preconditions those of flowing bodies."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy import sparse
from scipy.linalg import cho_factor, cho_solve
from scipy.sparse.linalg import LinearOperator, gmres

from ..core.arrays import BoolArray, RealArray
from ..core.errors import ConvergenceError
from .linear import factorised
from .mesh import IntArray
from .solid import Solid

MOST_STEPS = 70
"""Steps of conjugate gradients or minimal residuals with the elastic stiffness; where the body has
flowed far, more would cost more than a factorisation of the tangent."""


@dataclass(frozen=True, eq=False)
class Prepared:
    """Elastic stiffness of a ``solid`` whose ``fixed`` unknowns are zero, and its inverse for
    forces at ``pushed`` unknowns.

    A tangent stiffness K is never stiffer than the elastic one K_0 and differs where the body
    flows, so that conjugate gradients with K_0 converge in few steps. Prescribed displacements of
    some of the ``pushed`` unknowns are met exactly: the preconditioner subtracts the forces there.

    Attributes
    ----------
    reach
        (unknowns, pushed) displacement by a unit force at each of the ``pushed`` unknowns.
    """

    solid: Solid
    fixed: BoolArray
    pushed: IntArray
    reach: RealArray = field(init=False)

    def __post_init__(self) -> None:
        free = np.flatnonzero(~self.fixed)
        matrix = self.solid.elements.pattern.matrix(self.solid.entries)
        object.__setattr__(self, "_free", free)
        object.__setattr__(self, "_solve", factorised(sparse.csc_array(matrix[free][:, free])))
        unit = np.zeros((len(self.fixed), len(self.pushed)))
        unit[self.pushed, np.arange(len(self.pushed))] = 1.0
        object.__setattr__(self, "reach", self.elastic(unit))

    def elastic(self, forces: RealArray) -> RealArray:
        """Displacement (unknowns, …) of the elastic body under ``forces`` (unknowns, …)."""
        found = np.zeros_like(forces)
        found[self._free] = self._solve(forces[self._free])  # type: ignore[attr-defined]
        return found

    def solve(
        self,
        stiffness: sparse.csc_array,
        forces: RealArray,
        held: BoolArray,
        known: RealArray,
        tolerance: float,
        *,
        rows: Callable[[RealArray], RealArray] | None = None,
    ) -> RealArray:
        """Displacement (unknowns,) with ``stiffness`` times it equal to ``forces`` but at the
        ``held`` of the pushed unknowns, where it is ``known`` (held,).

        ``tolerance``: relative, in the energy of the elastic body; ``rows``: what combines the rows
        of stiffness, for unsymmetric systems, which are solved by minimal residuals.

        Raises
        ------
        ConvergenceError
            If the stiffness is singular.
        """
        try:
            return self._by_elastic(stiffness, forces, held, known, tolerance, rows)
        except _TooFar:
            return self._by_tangent(stiffness, forces, held, known, tolerance, rows)

    def _by_elastic(
        self,
        stiffness: sparse.csc_array,
        forces: RealArray,
        held: BoolArray,
        known: RealArray,
        tolerance: float,
        rows: Callable[[RealArray], RealArray] | None,
    ) -> RealArray:
        reach, places = self.reach[:, held], self.pushed[held]
        block = cho_factor(reach[places]) if len(places) else None

        def conditioned(left: RealArray) -> RealArray:
            found = self.elastic(left)
            if block is not None:
                found -= reach @ cho_solve(block, found[places])
                found[places] = 0.0
            return found

        start = reach @ cho_solve(block, known) if block is not None else np.zeros_like(forces)
        if block is not None:
            start[places] = known
        if rows is not None:
            return start + _minimal_residual(
                lambda u: conditioned(rows(stiffness @ u)), conditioned(forces - rows(stiffness @ start)), tolerance
            )
        left = forces - stiffness @ start
        turned = conditioned(left)
        size = whole = float(left @ turned)
        found, direction = start, turned
        for _ in range(MOST_STEPS):
            if size <= tolerance**2 * whole or whole <= 0.0:
                return found
            pulled = stiffness @ direction
            energy = float(direction @ pulled)
            if not energy > 0.0:
                raise _TooFar
            step = size / energy
            found = found + step * direction
            left = left - step * pulled
            turned = conditioned(left)
            before, size = size, float(left @ turned)
            direction = turned + (size / before) * direction
        raise _TooFar

    def _by_tangent(
        self,
        stiffness: sparse.csc_array,
        forces: RealArray,
        held: BoolArray,
        known: RealArray,
        tolerance: float,
        rows: Callable[[RealArray], RealArray] | None,
    ) -> RealArray:
        prescribed = self.fixed.copy()
        prescribed[self.pushed[held]] = True
        free = np.flatnonzero(~prescribed)
        start = np.zeros_like(forces)
        start[self.pushed[held]] = known
        inner = stiffness[free][:, free]
        solve = factorised(sparse.csc_array(inner if rows is None else 0.5 * (inner + inner.T)))

        def conditioned(left: RealArray) -> RealArray:
            found = np.zeros_like(left)
            found[free] = solve(left[free])
            return found

        if rows is None:
            return start + conditioned(forces - stiffness @ start)
        try:
            return start + _minimal_residual(
                lambda u: conditioned(rows(stiffness @ u)), conditioned(forces - rows(stiffness @ start)), tolerance
            )
        except _TooFar:
            raise ConvergenceError(
                "Friction and stiffness are not balanced. Take smaller steps, or give a little hardening."
            ) from None


class _TooFar(Exception):
    """The body has flowed too far for its elastic stiffness."""


def _minimal_residual(apply: Callable[[RealArray], RealArray], right: RealArray, tolerance: float) -> RealArray:
    """Solution of a linear equation near the identity by generalised minimal residuals (Saad and
    Schultz 1986)."""
    size = float(np.linalg.norm(right))
    if size == 0.0:
        return np.zeros_like(right)
    operator = LinearOperator((len(right), len(right)), matvec=apply, dtype=float)
    found, failed = gmres(operator, right / size, rtol=tolerance, atol=0.0, restart=MOST_STEPS, maxiter=1)
    if failed:
        raise _TooFar
    return np.asarray(found * size)
