"""Adhesive contacts between the steps of a history: branches through their folds, stable or not,
and where jumps begin."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np

from ...contact.controls import FixedGrips
from ...contact.history import HistoryResult
from ...contact.law import HardWall
from ...contact.operators import prepare_operator
from ...contact.result import ContactResult
from ...contact.solve import solve
from ...contact.solvers.protocol import FixedOffset
from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.errors import InputError
from .solver.continuation import Continuation
from .solver.problem import AdhesiveProblem, Linearised


@dataclass(frozen=True, eq=False)
class Fold:
    """Point of a branch at which the approach turns back: rigid grips that go on jump from there.

    ``approach`` in m, external ``force`` in N, ``index`` of the point of the branch before it.
    """

    approach: float
    force: float
    index: int


@dataclass(frozen=True, eq=False)
class AdhesiveBranch:
    """Equilibria one after the other along a branch; arrays hold one number a point.

    Attributes
    ----------
    length
        Length along the branch in m, from the first point on.
    approach, force
        Approach of the bodies (m) and external force (N, negative pulls).
    turn
        Change of the offset of the bodies per length: zero at a fold, negative where the approach
        grows along the branch.
    margin
        1 less the largest eigenvalue of the response of the free points to the attraction: its sign
        is that of the smallest eigenvalue of the Hessian of the energy at a given approach,
        negative where rigid grips cannot hold the contact.
    energy
        Elastic energy and that of the interface in J.
    contact_fraction
        Area that touches over nominal area.
    fft_pairs
        Work in FFT pairs of the size of the grid.
    needed_pixel
        Largest pixel in m with which branches can be followed for sure; above it single points
        snap, and folds are those of the grid.
    """

    length: RealArray
    approach: RealArray
    force: RealArray
    turn: RealArray
    margin: RealArray
    energy: RealArray
    contact_fraction: RealArray
    fft_pairs: float
    needed_pixel: float

    @property
    def stable(self) -> BoolArray:
        """Where rigid grips hold the contact."""
        return self.margin > 0.0

    @property
    def stiffness(self) -> RealArray:
        """dF/dδ in N/m by differences along the branch, negative where a dead load cannot hold the
        contact, or rigid grips cannot."""
        return np.asarray(np.gradient(self.force, self.length) / np.gradient(self.approach, self.length))

    @cached_property
    def folds(self) -> tuple[Fold, ...]:
        """Folds in the order of the branch, by the cubic through two points and their slopes;
        forces by the cubic through four."""
        found = []
        for k in np.flatnonzero(np.sign(self.turn[:-1]) * np.sign(self.turn[1:]) < 0.0):
            # the cubic of both approaches, whose slopes are as the turns, negative; where it is
            # stationary
            length, turn, approach = (values[k : k + 2] for values in (self.length, self.turn, self.approach))
            step, rise = float(length[1] - length[0]), float(approach[1] - approach[0])
            share = float(turn[0] / (turn[0] - turn[1]))
            m0, m1 = -float(turn[0]) * step, -float(turn[1]) * step
            a, b = m0 + m1 - 2.0 * rise, 3.0 * rise - 2.0 * m0 - m1
            roots = [x.real for x in np.roots([3.0 * a, 2.0 * b, m0]) if abs(x.imag) < 1e-12 and 0.0 <= x.real <= 1.0]
            x = min(roots, key=lambda root: abs(root - share)) if roots else share
            at = float(length[0]) + x * step, float(approach[0]) + x * (m0 + x * (b + x * a))
            first = min(max(int(k) - 1, 0), max(self.length.size - 4, 0))
            near = slice(first, first + 4)
            force = float(np.polyval(np.polyfit(self.length[near] - at[0], self.force[near], 3), 0.0))
            found.append(Fold(at[1], force, int(k)))
        return tuple(found)

    @property
    def pull_off_force(self) -> float:
        """Largest tensile force in N along the branch, by the parabola through three points; zero
        where none was met."""
        k = int(np.argmin(self.force))
        if k in (0, self.force.size - 1):
            return max(-float(self.force[k]), 0.0)
        a, b, c = np.polyfit(self.length[k - 1 : k + 2] - self.length[k], self.force[k - 1 : k + 2], 2)
        return max(-float(c - 0.25 * b * b / a), 0.0)


def adhesive_branch(
    result: ContactResult,
    *,
    towards: Literal["parting", "approaching"] = "parting",
    farthest: float = -math.inf,
    deepest: float = math.inf,
    points: int = 200,
    step: float = 0.25,
) -> AdhesiveBranch:
    """Follow the branch that an adhesive contact lies on, through folds, by pseudo-arclength
    continuation (Keller 1977, Feng 2000).

    Parameters
    ----------
    result
        The contact to start from, stable at its position or not.
    towards
        Whether the bodies part or approach at first.
    farthest, deepest
        Approaches in m at which the branch is left, farthest < deepest.
    points
        Number of points at most, >= 2.
    step
        Length of a step over the range of the attraction, > 0. Halved where Newton's method does
        not follow.

    Raises
    ------
    InputError
        If the problem has no adhesion, or a hardness, film or friction beside it; or its law no
        range (JKR) or a step (Dugdale without smoothing); or a number is out of range.
    NoSolutionError
        If the contact is no equilibrium, or the branch cannot be followed; the message names the
        pixel needed where that is the reason.
    """
    problem, law = result.problem, result.require_adhesion().law
    if not isinstance(problem.law, HardWall) or len(problem.physics) > 1:
        raise InputError(
            "problem of a branch must have adhesion alone, but has a hardness, a film of liquid or friction "
            "beside it. Leave them out, or follow a history of {grips}."
        )
    if math.isinf(law.steepest):
        raise InputError(
            f"adhesion of a branch must change smoothly with the gap, but {law.name} has a step. Use a smooth "
            "one, such as "
            "{gentle_law}.",
            subject="adhesion",
        )
    require.one_of(towards, ("parting", "approaching"), "direction of a branch")
    require.integer(points, 2, "number of points of a branch")
    if not farthest < result.approach < deepest:
        raise InputError(
            f"approach of the contact must be between the farthest {farthest:g} m and the deepest {deepest:g} "
            f"m, but is {result.approach:g} m."
        )
    operator = prepare_operator(problem.compliance, problem.grid, problem.boundary)
    profile, pixel = problem.profile(), operator.grid.pixel_area
    top = float(profile.max())
    posed = AdhesiveProblem(operator, profile, law, FixedOffset(top - result.approach))
    way = Continuation(posed, step)
    found: list[tuple[float, ...]] = []
    direction = 1.0 if towards == "parting" else -1.0
    traction = np.asarray(result.pressure, dtype=float) - result.require_adhesion().attraction
    for point in way.points(traction, top - result.approach, direction=direction):
        approach = top - point.offset
        if found and not farthest <= approach <= deepest:
            break
        at, state = replace(posed, constraint=FixedOffset(point.offset)), point.adhered(posed)
        force, energy = float(point.traction.sum()) * pixel, at.energy(state) * pixel
        margin, touching = 1.0 - Linearised(at, state).largest(), float((state.pressure > 0.0).mean())
        found.append((point.length, approach, force, point.turn, margin, energy, touching))
        if len(found) >= points:
            break
    lengths, approaches, forces, turns, margins, energies, fractions = np.array(found).T
    return AdhesiveBranch(lengths, approaches, forces, turns, margins, energies, fractions, way.pairs, way.needed_pixel)


@dataclass(frozen=True, eq=False)
class Jump:
    """A jump between two steps of a history, closed in by bisection.

    Attributes
    ----------
    step
        Step of the history in which it happens.
    before, after
        Last contact before it, and the one after it at a position that lies ``width`` (m) beyond.
    """

    step: int
    before: ContactResult
    after: ContactResult

    @property
    def grips(self) -> float:
        """Approach in m of the grips in the middle of the last interval."""
        return 0.5 * (self.before.require_adhesion().grips + self.after.require_adhesion().grips)

    @property
    def width(self) -> float:
        """Width in m of that interval."""
        return abs(self.after.require_adhesion().grips - self.before.require_adhesion().grips)

    @property
    def lost(self) -> float:
        """Energy in J that the jump loses."""
        return self.after.require_adhesion().dissipated

    @property
    def lost_error(self) -> float:
        """Bound of the error of that energy in J."""
        return self.after.require_adhesion().dissipated_error


def adhesive_jumps(history: HistoryResult, tolerance: float) -> tuple[Jump, ...]:
    """Jumps of a history of grips, each closed in to a ``tolerance`` (m, > 0) of the approach of
    the grips.

    The interval of the step is halved, every time from the contact before it; about ten further
    solves for a thousandth of a step.

    Raises
    ------
    InputError
        If a step has no adhesion or is not under ``FixedGrips``, or the tolerance is not positive.
    """
    require.positive(tolerance, "tolerance of the jumps (m)")
    steps, found = history.steps, []
    for number, result in enumerate(steps):
        control, problem = result.control, result.problem
        if not isinstance(control, FixedGrips):
            raise InputError(
                f"control of a history whose jumps are sought must be FixedGrips(...), but is {control!r}."
            )
        if number == 0 or not result.require_adhesion().jumped:
            continue
        operator = prepare_operator(problem.compliance, problem.grid, problem.boundary)
        jump = Jump(number, steps[number - 1], result)
        while jump.width > tolerance:
            middle = FixedGrips(jump.grips, control.stiffness)
            solved = solve(problem, middle, state=jump.before.state, operator=operator)
            gone = solved.require_adhesion().jumped
            jump = replace(jump, after=solved) if gone else replace(jump, before=solved)
        last = solve(problem, jump.after.control, state=jump.before.state, operator=operator)
        found.append(replace(jump, after=last))  # what it loses from there
    return tuple(found)
