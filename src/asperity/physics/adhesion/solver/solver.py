"""Minimum of the adhesive energy nearest downhill: majorise-minimise, then Newton's method with a
trust region."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Protocol

import numpy as np

from ....contact.solvers.active_set.solver import ActiveSet
from ....contact.solvers.protocol import ContactQP, FixedMean, FixedOffset, level, run
from ....core import require
from ....core.arrays import RealArray
from ....core.errors import NoSolutionError
from ....core.status import Outcome, Status
from ..law import Adhesion
from .problem import Adhered, AdhesiveProblem, Linearised


@dataclass(frozen=True, eq=False)
class AdhesiveSolution:
    """The last iterate and how it ended.

    Attributes
    ----------
    state
        The last iterate.
    energy
        Π in J.
    energies
        Π in J after every step; it never rises.
    steps, newton_steps
        Steps in all, and those of them by Newton's method.
    fft_pairs
        Work in FFT pairs of the size of the grid.
    status
        How it ended.
    """

    state: Adhered
    energy: float
    energies: tuple[float, ...]
    steps: int
    newton_steps: int
    fft_pairs: float
    status: Status


class AdhesiveSolver(Protocol):
    """Method for adhesive contacts; a frozen value holding only its settings. Fields are (nx, ny)
    arrays."""

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers of the method."""

    def solve(self, problem: AdhesiveProblem, pull: RealArray, pressure: RealArray | None = None) -> AdhesiveSolution:
        """Equilibrium that is reached from the attraction ``pull`` in Pa, started from this wall
        ``pressure``."""

    def miss(self, law: Adhesion, pull: RealArray, pressure: RealArray, gap: RealArray) -> float:
        """How far a contact of this wall ``pressure`` (Pa) and ``gap`` (m) is from asking for the
        ``pull`` (Pa) it was posed with."""

    def margin(self, problem: AdhesiveProblem, state: Adhered) -> float:
        """Margin of stability of ``state``, positive where it is stable."""


_SLOW = 0.6
"""Reduction of the miss per step of majorise-minimise above which Newton's method is tried: one of
its steps costs about ten of the others."""

_SAME = 1e-13
"""Share of the sum of the magnitudes of the energy by which rounding may make it rise."""


@dataclass(frozen=True)
class Stepwise:
    """Base of methods with a tolerance in (0, 1) and a largest number of steps; InputError names
    the wrong one."""

    tolerance: float
    max_steps: int
    name: ClassVar[str] = ""

    def __post_init__(self) -> None:
        require.between(self.tolerance, 0.0, 1.0, f"tolerance of the solver {self.name}")
        require.integer(self.max_steps, 1, f"largest number of steps of the solver {self.name}")

    def margin(self, problem: AdhesiveProblem, state: Adhered) -> float:
        """1 less the largest eigenvalue of the response of the free points, whose attraction falls
        with the gap."""
        return 1.0 - Linearised(problem, state).largest()


@dataclass(frozen=True)
class MajoriseMinimise(Stepwise):
    """Hard-wall contacts under a fixed pull, which bound the energy from above, until the pull is
    that of the gap.

    For an attraction that falls with the gap φ is concave, so that its tangent bounds it from
    above, and every step, a hard-wall problem with the pull σ(g) of the last gap, lowers the energy
    (Hunter & Lange 2004). Where that is slow a step of Newton's method in the trust radius of one
    range follows, truncated where the curvature is negative (Steihaug 1983); what it proposes is
    kept only if the step of majorise-minimise from there lowers the energy below that from here.

    Parameters
    ----------
    tolerance
        Largest difference of pull and attraction over the largest attraction at which it ends.
    max_steps
        Steps after which it gives up.
    newton
        Whether Newton's method is tried.
    """

    tolerance: float = 1e-6
    max_steps: int = 500
    newton: bool = True
    name: ClassVar[str] = "majorise-minimise"
    citation_keys: ClassVar[tuple[str, ...]] = ("Hunter2004", "Steihaug1983", "Rey2017")

    def solve(self, problem: AdhesiveProblem, pull: RealArray, pressure: RealArray | None = None) -> AdhesiveSolution:
        """Equilibrium that is reached downhill from the attraction ``pull`` (nx, ny) in Pa, started
        from this wall ``pressure``.

        Raises
        ------
        NoSolutionError
            If the load prescribed pulls the surfaces apart.
        """
        strength, pixel = problem.law.strength, problem.operator.grid.pixel_area
        work = Work()
        accuracy = _FIRST if self.max_steps > 1 else FINEST
        state = minimised(problem, pull, pressure, work, accuracy)
        energies, miss, newton_steps, rate = [problem.energy(state)], state.miss(strength), 0, 0.0
        count, range_ = 1, problem.law.range / (float(problem.profile.std()) or 1.0)
        while (miss > self.tolerance or accuracy > FINEST) and count < self.max_steps:
            count += 1
            expected = _SHARE * (rate or _BEST) * miss * range_  # of the gap, over the rms height
            loose = miss > self.tolerance and count < self.max_steps  # the last step is to be trusted
            accuracy = min(max(expected**2, FINEST), _FIRST) if loose else FINEST
            found = minimised(problem, state.attraction, state.pressure, work, accuracy)
            if self.newton and rate > _SLOW and count > 3:
                proposed = self._newton(problem, found, work)
                if proposed is not None and problem.energy(proposed) < problem.energy(found):
                    found, newton_steps = proposed, newton_steps + 1
            latest = found.miss(strength)
            rate, miss = latest / miss if miss > 0.0 else 0.0, latest
            state = found
            energies.append(problem.energy(state))
            if (
                len(energies) > 30
                and energies[-20] - energies[-1] <= _SAME * abs(energies[-1])
                and miss > self.tolerance
            ):
                break
        status = Status(Outcome.CONVERGED, f"Attraction and gap agree to {miss:.1e} after {count} steps.")
        if not miss <= self.tolerance:
            text = f"Attraction and gap still differ by {miss:.1e} of the strength after {count} steps."
            remedy = "Take smaller steps of the load or position, or a grid that resolves the adhesion."
            ended = Outcome.ITERATION_LIMIT if count >= self.max_steps else Outcome.STAGNATED
            status = Status(ended, text, remedy)
        scaled = tuple(value * pixel for value in energies)
        return AdhesiveSolution(state, scaled[-1], scaled, count, newton_steps, work.pairs, status)

    def miss(self, law: Adhesion, pull: RealArray, pressure: RealArray, gap: RealArray) -> float:
        """Largest difference of ``pull`` and the attraction at the ``gap`` over the largest
        attraction; fields (nx, ny)."""
        return float(np.abs(law.attraction(gap) - pull).max()) / law.strength

    def _newton(self, problem: AdhesiveProblem, state: Adhered, work: Work) -> Adhered | None:
        """Step of Newton's method from ``state`` followed by one of majorise-minimise; None where
        there is nothing to gain."""
        system = Linearised(problem, state)
        if not system.free.any():
            return None
        root = np.where(system.free, system.root, 1.0)
        r = np.where(system.free, (state.attraction - state.pull) / root, 0.0)
        z = _steihaug(system, r, radius=problem.law.range)
        work.pairs += system.pairs
        pull = np.clip(state.pull + root * z, 0.0, problem.law.strength)
        pull = np.where(system.free, pull, state.attraction)
        try:
            return minimised(problem, pull, state.pressure, work)
        except NoSolutionError:
            return None


@dataclass(eq=False)
class Work:
    """FFT pairs spent so far."""

    pairs: float = 0.0


FINEST, _FIRST = 1e-13, 1e-6
"""Errors of the normal solves at the end, and at the beginning."""

_SHARE, _BEST = 0.1, 0.1
"""Error of the gap over the miss that is expected next, and how far that falls at best before it is
known: the error of a normal solve goes with the square of that of the gap."""


def minimised(
    problem: AdhesiveProblem,
    pull: RealArray,
    pressure: RealArray | None,
    work: Work | None = None,
    tolerance: float = FINEST,
) -> Adhered:
    """Hard-wall contact under the fixed attraction ``pull`` (nx, ny) in Pa, started from this wall
    ``pressure``.

    The gap is that beyond the spacing of a law with a core.

    Raises
    ------
    NoSolutionError
        If the load prescribed is more tensile than the pull.
    """
    lowered = problem.operator.apply(pull)
    profile, constraint = problem.profile + lowered, problem.constraint
    none, spacing = np.zeros_like(profile), problem.law.spacing
    if isinstance(constraint, FixedMean):
        mean = constraint.mean_pressure + float(pull.mean())
        if mean <= 0.0:
            force = constraint.mean_pressure * problem.operator.grid.area
            raise NoSolutionError(
                f"force must be one that the adhesion bears, but {force:.6g} N is not: the surfaces part. "
                "Prescribe the position, with {grips}, to follow them.",
                subject="force",
            )
        wanted: FixedMean | FixedOffset = FixedMean(mean)
    else:
        wanted = constraint
        if float(profile.max()) <= constraint.offset:
            gap = constraint.offset - profile
            return Adhered(none, pull, -lowered, gap, problem.law.attraction(gap + spacing), constraint.offset)
    scale = float(profile.std()) or 1.0
    qp = ContactQP(problem.operator, profile, problem.cap, wanted, scale)
    start = pressure if pressure is not None and pressure.any() else None
    solution = run(ActiveSet(tolerance=tolerance), qp, start)
    if work is not None:
        work.pairs += solution.state.applications * problem.operator.pairs_per_application + solution.state.extra_pairs
    p, u = solution.state.pressure, solution.state.deflection
    offset = -level(qp, p, u - profile)
    gap = np.where(p > 0.0, 0.0, np.maximum(offset + u - profile, 0.0))
    return Adhered(p, pull, u - lowered, gap, problem.law.attraction(gap + spacing), offset)


def _steihaug(
    system: Linearised, r: RealArray, *, radius: float, tolerance: float = 0.05, steps: int = 12
) -> RealArray:
    """z with (1 - S) z = r to ``tolerance``, or where the gap would change by more than the
    ``radius`` (m) on the way."""
    z, residual = np.zeros_like(r), r
    direction, before = residual, float((residual * residual).sum())
    first, change = before, np.zeros_like(r)
    for _ in range(steps):
        if before <= tolerance**2 * first:
            break
        moved = system.response(system.root * direction, 1e-2)
        image = direction - system.root * moved
        curvature = float((direction * image).sum())
        step = before / curvature if curvature > 0.0 else np.inf
        # the largest step that stays within the radius at every point
        with np.errstate(divide="ignore", invalid="ignore"):
            room = np.where(moved > 0.0, radius - change, radius + change) / np.abs(moved)
        most = max(float(np.nanmin(np.where(moved == 0.0, np.inf, room))), 0.0)
        if step >= most:
            return z + most * direction
        z, change = z + step * direction, change + step * moved
        residual = residual - step * image
        now = float((residual * residual).sum())
        direction, before = residual + (now / before) * direction, now
    return z
