"""The adhesive problem on a grid, its energy, and its linearisation at an equilibrium.

The net traction is t = p - σ(g) with the wall pressure p >= 0, the gap g = d + K t - h >= 0 and p
g = 0. Equilibria are stationary points of

    Π = ½ t·K t + Σ φ(g)   (+ P d where the load P is prescribed).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ....contact.measure import Response
from ....contact.operators import Operator
from ....contact.operators.convolution import spectral_kernel
from ....contact.solvers.active_set.linear_system import Stopping
from ....contact.solvers.protocol import Constraint, FixedMean
from ....core.arrays import BoolArray, RealArray
from ....core.spectral import RealTransform
from ..law import Adhesion


@dataclass(frozen=True, eq=False)
class AdhesiveProblem:
    """Find the wall pressure p and the attraction σ(g) of a contact.

    Parameters
    ----------
    operator
        K, from pressure (Pa) to displacement (m).
    profile
        h, composite heights (nx, ny) in m.
    law
        The attraction; with a core that repels the gap is d + z0 + K t - h, z0 its spacing, and t =
        -σ(g) everywhere.
    constraint
        ``FixedOffset`` of d in m, or ``FixedMean`` of t in Pa, of either sign.
    cap
        Largest wall pressure in Pa: a number, an (nx, ny) array, or infinity. Where it is reached
        the bodies may overlap.
    """

    operator: Operator
    profile: RealArray
    law: Adhesion
    constraint: Constraint
    cap: float | RealArray = np.inf

    @property
    def load_prescribed(self) -> bool:
        """Whether the load is."""
        return isinstance(self.constraint, FixedMean)

    def energy(self, state: Adhered) -> float:
        """Π over the area of a pixel, in Pa·m."""
        stored = 0.5 * float((state.traction * state.deflection).sum())
        found = stored + float(self.law.energy(state.gap).sum())
        if isinstance(self.constraint, FixedMean):
            found += self.constraint.mean_pressure * self.profile.size * state.offset
        return found


@dataclass(frozen=True, eq=False)
class Adhered:
    """An iterate: fields (nx, ny) and the offset d.

    Attributes
    ----------
    pressure
        Wall pressure p in Pa, >= 0.
    pull
        Attraction in Pa that it was solved with.
    deflection
        K t in m of the net traction.
    gap
        g in m, zero in contact with a wall.
    attraction
        σ(g) in Pa.
    offset
        d in m.
    """

    pressure: RealArray
    pull: RealArray
    deflection: RealArray
    gap: RealArray
    attraction: RealArray
    offset: float

    @property
    def traction(self) -> RealArray:
        """t = p - pull in Pa."""
        return self.pressure - self.pull

    def miss(self, strength: float) -> float:
        """Largest change of the attraction that the gap asks for, over its largest value."""
        return float(np.abs(self.attraction - self.pull).max()) / strength


_INNER = 1e-3
_INNER_STEPS = 60


def _length(values: RealArray) -> float:
    """Euclidean norm; a plain sum, for the threads of BLAS behind NumPy's norm wait for processors
    that other work keeps busy (14 ms at 512² beside a full load)."""
    return float(np.sqrt((values * values).sum()))


class Linearised:
    """Response of the gap on the free points to a change of their traction, at fixed contact: the
    compliance K less what the wall takes.

    A core that repels takes the place of the wall: its points give way by the traction on them over
    σ' > 0. With S = |σ'|^½ (K/C) |σ'|^½ the Hessian of Π on the free points is congruent to 1 - S:
    the number of its negative eigenvalues is the number of eigenvalues of S above 1 (Sylvester).
    """

    def __init__(self, problem: AdhesiveProblem, state: Adhered) -> None:
        self.problem, self.operator = problem, problem.operator
        self.wall: BoolArray = state.pressure > 0.0
        slope = problem.law.slope(state.gap)
        self.soft: RealArray | float = 0.0
        if problem.law.spacing > 0.0:
            self.wall = slope > 0.0
            self.soft = 1.0 / np.where(self.wall, slope, 1.0)
            held = self.wall
        else:
            held = self.wall & (state.pressure < problem.cap)
        self.contact: BoolArray = held
        slope = np.where(self.wall, 0.0, np.maximum(-slope, 0.0))
        self.root = np.sqrt(slope)
        self.free: BoolArray = slope > 0.0
        self.pairs = 0.0
        self._transform = RealTransform(problem.operator.grid.shape)

    @cached_property
    def _walls(self) -> Response:
        """Pressure that moves the points of the contact."""
        return Response.of(self.operator, self.contact)

    @cached_property
    def _inverse(self) -> RealArray:
        """1/c(q) on the half spectrum of the grid, the mean as the longest wave."""
        kernel: RealArray = spectral_kernel(self.operator.compliance, self.operator.grid)
        kernel[0, 0] = kernel.max()
        typical = float(np.median(self.soft[self.contact])) if isinstance(self.soft, np.ndarray) else 0.0
        return 1.0 / (kernel + typical)

    def _applied(self, traction: RealArray) -> RealArray:
        self.pairs += self.operator.pairs_per_application
        return self.operator.apply(traction)

    def response(self, traction: RealArray, tolerance: float = _INNER) -> RealArray:
        """Change of the gap (nx, ny) in m by ``traction`` (nx, ny) in Pa on the free points, the
        contact staying closed."""
        wall = np.zeros_like(traction)
        if self.problem.load_prescribed and self.contact.any():
            wall[self.contact] = -traction.sum() / np.count_nonzero(self.contact)
        u = self._applied(traction + wall)
        if not self.contact.any():
            return u - u.mean() if self.problem.load_prescribed else u
        rigid, r = self._open(u, wall)
        if not isinstance(self.soft, np.ndarray):  # a wall, with nothing beside the compliance
            found = self._walls.solved(
                r, zero_sum=self.problem.load_prescribed, stopping=Stopping(tolerance, _INNER_STEPS)
            )
            self.pairs += found.pairs
            if found.values is not None:
                u = u + self._applied(found.pressure)
                return u + self._open(u, wall)[0]
        first = _length(r)
        direction, before = np.zeros_like(r), 1.0
        for _ in range(_INNER_STEPS):
            if first == 0.0 or _length(r) <= tolerance * first:
                break
            self.pairs += 1.0
            z = self._transform.backward(self._transform.forward(r) * self._inverse)
            if self.problem.load_prescribed:  # without the mean over the contact
                z = z - z[self.contact].mean()
            z = np.where(self.contact, z, 0.0)
            rz = float((r * z).sum())
            if not rz > 0.0:
                break
            direction = z + (rz / before) * direction
            before = rz
            moved = self._applied(direction)
            step = rz / float((direction * (moved + self.soft * direction)).sum())
            u, wall = u + step * moved, wall + step * direction
            rigid, r = self._open(u, wall)
        return u + rigid

    def _open(self, u: RealArray, wall: RealArray) -> tuple[float, RealArray]:
        """Rigid displacement, and what the contact would open by under the traction ``wall``:
        nothing at a wall, soft·wall of a core."""
        ahead = u + self.soft * wall
        rigid = -float(ahead[self.contact].mean()) if self.problem.load_prescribed else 0.0
        return rigid, np.where(self.contact, -(ahead + rigid), 0.0)

    def product(self, z: RealArray, tolerance: float = _INNER) -> RealArray:
        """S z on the free points."""
        return self.root * self.response(self.root * z, tolerance)

    def largest(self, steps: int = 12) -> float:
        """Largest eigenvalue of S by Lanczos' method, from below; above 1 the state is no
        minimum."""
        from scipy.linalg import eigvalsh_tridiagonal

        if not self.free.any():
            return 0.0
        v = self.root / _length(self.root)
        v = v * (1.0 + 1e-3 * np.cos(np.arange(v.size, dtype=float)).reshape(v.shape))
        v /= _length(v)
        basis = [v]
        diagonal: list[float] = []
        beside: list[float] = []
        found = 0.0
        for _ in range(min(steps, int(np.count_nonzero(self.free)))):
            w = self.product(basis[-1])
            diagonal.append(float((w * basis[-1]).sum()))
            highest = float(eigvalsh_tridiagonal(np.array(diagonal), np.array(beside))[-1])
            settled = abs(highest - found) <= 1e-4 * abs(highest)
            found = highest
            for earlier in basis:
                w = w - float((w * earlier).sum()) * earlier
            size = _length(w)
            if settled or size <= 1e-10 * abs(found):
                break
            beside.append(size)
            basis.append(w / size)
        return found
