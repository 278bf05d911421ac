"""Adhesive contact by a bound-constrained quasi-Newton method on the gap with a dense stiffness
matrix: slow, and independent."""

from __future__ import annotations

import numpy as np

from ....contact.solvers.protocol import FixedOffset
from ....core.arrays import RealArray
from ....core.errors import InputError
from .problem import AdhesiveProblem


def adhesive_gap(problem: AdhesiveProblem, start: RealArray, *, tolerance: float = 1e-12) -> RealArray:
    """Gap (nx, ny) in m that minimises ½ u·K⁻¹u + Σφ(g) over g >= 0, u = g + h - d (less z0 of a
    core), downhill from the gap ``start`` (nx, ny) in m.

    By L-BFGS-B (Byrd, Lu, Nocedal & Zhu 1995) in gaps over the range and energies over the work of
    adhesion.

    Raises
    ------
    InputError
        If the load and not the offset is prescribed, or a uniform pressure moves nothing: K must
        have an inverse.
    """
    if not isinstance(problem.constraint, FixedOffset) or problem.operator.zero_mean_mode:
        raise InputError(
            "constraint of the dense adhesive method must be a FixedOffset on a body with a mean mode, but is "
            f"{problem.constraint!r}. Use MajoriseMinimise()."
        )
    from scipy.linalg import cho_factor, cho_solve
    from scipy.optimize import Bounds, minimize

    law, factor = problem.law, cho_factor(problem.operator.matrix())
    flat = (problem.constraint.offset + law.spacing - problem.profile).ravel()

    def energy(x: RealArray) -> tuple[float, RealArray]:
        g = law.range * x
        u = g - flat
        traction = cho_solve(factor, u)
        value = 0.5 * float(u @ traction) + float(law.energy(g).sum())
        return value / law.work, (traction + law.attraction(g)) * law.range / law.work

    first = np.maximum(start.ravel(), 0.0) / law.range
    found = minimize(
        energy,
        first,
        jac=True,
        method="L-BFGS-B",
        bounds=Bounds(0.3 * law.spacing / law.range, np.inf),
        options={"ftol": 0.0, "gtol": tolerance, "maxiter": 50_000, "maxfun": 100_000, "maxcor": 30},
    )
    gap: RealArray = law.range * found.x.reshape(problem.profile.shape)
    return gap
