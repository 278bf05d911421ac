"""Contact whose islands have the hardness of the strain rate at which they pass."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ...contact.controls import Control
from ...contact.law import Hardness
from ...contact.measure import labelled
from ...contact.operators import prepare_operator
from ...contact.problem import ContactProblem
from ...contact.result import ContactResult
from ...contact.solve import solve
from ...contact.solvers.protocol import Solver
from ...core import require
from ...core.arrays import RealArray
from ...core.errors import ConvergenceError
from ...core.status import Progress
from ...theories.hardness.rate_hardness import RateHardness

_FROZEN = 3
"""Rounds after which islands keep their places: those that join and part would change for ever."""

_ROUNDS = 40

_SETTLED = 1e-3
"""Relative change of a hardness at which rounds end: that of a pixel at the rim of an island is
less."""


@dataclass(frozen=True, eq=False)
class ContactAtSpeed:
    """A contact whose islands have the hardness of their strain rate.

    Attributes
    ----------
    result
        The contact.
    hardness
        (nx, ny) in Pa, that of the island to which a pixel belongs; of single pixels elsewhere.
    diameter, island_hardness
        (n,) in m and Pa, of the islands of contact.
    rounds
        Solves that it took.
    """

    result: ContactResult
    hardness: RealArray
    diameter: RealArray
    island_hardness: RealArray
    rounds: int


def solve_at_speed(
    problem: ContactProblem,
    control: Control,
    law: RateHardness,
    speed: float,
    *,
    solver: Solver | None = None,
    progress: Progress | None = None,
) -> ContactAtSpeed:
    """Solve a contact limited by the hardness that ``law`` gives each island at the sliding
    ``speed`` in m/s, > 0.

    The strain rate of an island of the area A is v/d with d = 2 sqrt(A/π), so that the smallest are
    the hardest (Bhushan 1998, sec. 3.2.2). Islands and hardnesses are found in turn, from the
    hardness of slow loads on; after three rounds the islands keep their places, and pixels that
    come into contact beside them have the hardness of one pixel.

    Parameters
    ----------
    problem
        Its own law of the interface is replaced.
    control
        A single load, see ``solve``.
    law
        Hardness over the strain rate.
    speed
        Sliding speed in m/s.
    solver, progress
        See ``solve``.

    Raises
    ------
    InputError
        If the speed is not positive.
    ConvergenceError
        If a solve, or the hardness in 40 rounds, does not settle.
    """
    require.instance(law, RateHardness, "law of the hardness at a speed")
    velocity = require.positive(speed, "sliding speed (m/s)")
    grid, wraps = problem.grid, problem.boundary.wraps
    operator = prepare_operator(problem.compliance, grid, problem.boundary)
    alone = float(law.at_diameter(velocity, 2.0 * math.sqrt(grid.pixel_area / math.pi)))
    hardness = np.full(grid.shape, law.hardness)
    labels = np.zeros(grid.shape, dtype=np.int64)
    for number in range(1, _ROUNDS + 1):
        limited = replace(problem, law=Hardness(hardness))
        result = solve(limited, control, solver=solver, operator=operator, progress=progress)
        if number <= _FROZEN:
            labels = np.asarray(labelled(result.contact, wraps=wraps)[0], dtype=np.int64)
        pixels = np.bincount(labels[result.contact], minlength=int(labels.max()) + 1)[1:]
        diameter = 2.0 * np.sqrt(np.maximum(pixels, 1) * grid.pixel_area / math.pi)
        islands = law.at_diameter(velocity, diameter)
        found = np.where(labels > 0, np.concatenate([[alone], islands])[labels], alone)
        touching = result.contact
        change = float(np.max(np.abs(found / hardness - 1.0)[touching], initial=0.0))
        hardness = found
        if change <= _SETTLED:
            there = pixels > 0
            return ContactAtSpeed(result, hardness, diameter[there], islands[there], number)
    raise ConvergenceError(
        f"hardness at the sliding speed did not settle in {_ROUNDS} rounds: it changed by {change:.2g} in the last. "
        "Take a finer grid, on which islands are larger than a few pixels.",
        subject="hardness at the sliding speed",
    )
