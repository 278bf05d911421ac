"""Many motions of sliding blocks: apparent friction against speed or any other parameter, branches
of limit cycles, maps of stability."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, TypeAlias

import numpy as np

from ...core.arrays import RealArray
from ...core.errors import ConvergenceError, InputError, NoSolutionError
from .block import SlidingBlock
from .block_motion import BLOCK_SCALARS, TOLERANCE, move_block

Mapper: TypeAlias = Callable[..., Iterable[Any]]
"""``map``, or that of a pool of processes, for independent cases."""

LAW_AXES = ("friction", "damping_ratio")
"""What may vary beside the parameters of the block: the coefficient of friction, and the ratio of
the damping of the interface."""

SLIDES_FROM = 0.995
"""Spring force over the friction at rest from which a run of a sweep begins, so that it does not
spend its time on loading the spring."""


def varied(block: SlidingBlock, name: str, value: float) -> SlidingBlock:
    """``block`` with another value of a parameter of its own, or of ``LAW_AXES``.

    Raises
    ------
    InputError
        If there is no such parameter, or the value is out of its range.
    """
    if name == "friction":
        return replace(block, law=block.law.with_friction(value))
    if name == "damping_ratio":
        return replace(block, law=block.law.damped(value, block.mass / block.area, block.load / block.area))
    known = [item.name for item in fields(block) if item.name != "law"]
    if name not in known:
        raise InputError(f"axis must be one of {', '.join((*known, *LAW_AXES))}, but is {name!r}.")
    changed: Any = {name: value}
    return replace(block, **changed)


@dataclass(frozen=True, eq=False)
class BlockSweep:
    """Runs of a block over one of its parameters.

    Attributes
    ----------
    axis
        Name of the parameter.
    axis_values
        (n,) its values.
    numbers
        ``BLOCK_SCALARS`` by name, each (n,); NaN where the run failed.
    growth_rate
        (n,) largest growth rate of small motion about steady sliding in 1/s; NaN where there is
        none.
    failures
        Sentence of each run that failed, by its place.
    """

    axis: str
    axis_values: RealArray
    numbers: Mapping[str, RealArray]
    growth_rate: RealArray
    failures: Mapping[int, str]


@dataclass(frozen=True)
class _Run:
    """One run of a sweep, as a process takes it."""

    block: SlidingBlock
    axis: str
    duration: float
    window: float
    smoothing_speed: float | None
    tolerance: float

    def __call__(self, value: float) -> tuple[dict[str, float], float, str]:
        """Numbers, growth rate, and what went wrong, for one ``value``."""
        growth = np.nan
        try:
            block = varied(self.block, self.axis, value)
            growth = block.stability.margin
            steady = block.steady
            start = (SLIDES_FROM * steady.displacement, block.rest, 0.0, 0.0, 0.0, 0.0)
            run = move_block(
                block,
                self.duration,
                start=start,
                smoothing_speed=self.smoothing_speed,
                tolerance=self.tolerance,
            )
        except (NoSolutionError, ConvergenceError) as error:
            return {item.name: np.nan for item in BLOCK_SCALARS}, growth, str(error)
        return run.numbers(self.duration - self.window), growth, ""


def sweep_block(
    block: SlidingBlock,
    axis: str,
    values: Sequence[float],
    *,
    duration: float,
    window: float | None = None,
    smoothing_speed: float | None = None,
    tolerance: float = TOLERANCE,
    mapper: Mapper = map,
) -> BlockSweep:
    """Runs of ``block`` for ``values`` of the parameter ``axis``, each from just below sliding.

    Parameters
    ----------
    block
        The block, of which one parameter varies.
    axis
        Name of a parameter of the block (``"speed"``, ``"stiffness"``, ``"load"`` …),
        ``"friction"`` or ``"damping_ratio"``.
    values
        (n,) in SI units.
    duration
        Of each run in s.
    window
        Length in s of the end of the run that the numbers are taken from; half of the duration if
        not given.
    smoothing_speed, tolerance
        As for ``move_block``.
    mapper
        ``map``, or that of a pool, such as ``concurrent.futures.ProcessPoolExecutor().map``: the
        runs do not depend on each other.

    Returns
    -------
    BlockSweep

    Raises
    ------
    InputError
        If the axis is unknown, or a value is out of range.
    """
    late = 0.5 * duration if window is None else window
    if not 0.0 < late <= duration:
        raise InputError(f"window (s) must be above zero and at most the duration, {duration:g}, but is {window!r}.")
    points = [float(value) for value in values]
    for value in points:
        varied(block, axis, value)
    found = list(mapper(_Run(block, axis, duration, late, smoothing_speed, tolerance), points))
    numbers = {item.name: np.array([row[0][item.name] for row in found]) for item in BLOCK_SCALARS}
    failures = {place: row[2] for place, row in enumerate(found) if row[2]}
    return BlockSweep(axis, np.array(points), numbers, np.array([row[1] for row in found]), failures)


@dataclass(frozen=True, eq=False)
class Branches:
    """Extremes of a limit cycle along a parameter that grows and then falls again, each run from
    the end of the one before.

    Attributes
    ----------
    axis
        Name of the parameter.
    axis_values
        (n,) its values, ascending.
    lowest, highest
        (2, n) smallest and largest penetration over that at rest; first while the parameter grows,
        then while it falls. Where both differ, there are two motions, and which is seen depends on
        the past.
    """

    axis: str
    axis_values: RealArray
    lowest: RealArray
    highest: RealArray


def bifurcation(
    block: SlidingBlock,
    axis: str,
    values: Sequence[float],
    *,
    duration: float,
    smoothing_speed: float | None = None,
    tolerance: float = TOLERANCE,
    disturbance: float = 1e-3,
) -> Branches:
    """Extremes of the penetration in the second half of runs of ``duration`` (s) along ascending,
    then descending ``values`` of ``axis``.

    Every run but the first starts from the end of the one before, with the penetration off by
    ``disturbance`` times that at rest, so that what is unstable is left.

    Raises
    ------
    InputError
        If the axis is unknown, or a value is out of range.
    """
    points = np.sort(np.asarray(values, dtype=float))
    lowest, highest = np.full((2, points.size), np.nan), np.full((2, points.size), np.nan)
    state: tuple[float, ...] | None = None
    for branch, places in enumerate((range(points.size), reversed(range(points.size)))):
        for place in places:
            case = varied(block, axis, float(points[place]))
            if state is None:
                steady = case.steady
                state = (steady.displacement, steady.penetration, steady.tilt, 0.0, 0.0, 0.0)
            moved = (state[0], state[1] + disturbance * case.rest, *state[2:])
            run = move_block(case, duration, start=moved, smoothing_speed=smoothing_speed, tolerance=tolerance)
            late = run.motion.after(0.5 * duration)["penetration"] / case.rest
            lowest[branch, place], highest[branch, place] = late.min(), late.max()
            state = run.motion.end
    return Branches(axis, points, lowest, highest)


@dataclass(frozen=True, eq=False)
class StabilityMap:
    """Growth rates about steady sliding over two parameters.

    Attributes
    ----------
    axes
        Names of both parameters.
    axis_values
        (n,) and (m,) their values.
    growth_rate
        (n, m) in 1/s; above zero where steady sliding is unstable, NaN where the block topples.
    frequency
        (n, m) angular frequency in rad/s of the mode that grows most.
    """

    axes: tuple[str, str]
    axis_values: tuple[RealArray, RealArray]
    growth_rate: RealArray
    frequency: RealArray


def stability_map(block: SlidingBlock, axes: Mapping[str, Sequence[float]]) -> StabilityMap:
    """Growth rates of ``block`` for all pairs of the values of two ``axes``, parameters as for
    ``sweep_block``, in their order.

    Raises
    ------
    InputError
        If there are not two axes, one is unknown, or a value is out of range.
    """
    if len(axes) != 2:
        raise InputError(f"axes must be two parameters with their values, but are {', '.join(axes) or 'none'}.")
    (first, second), sides = tuple(axes), [np.asarray(list(values), dtype=float) for values in axes.values()]
    rows = []
    for a, b in itertools.product(*sides):
        case = varied(varied(block, first, float(a)), second, float(b))
        try:
            modes = case.stability
            rows.append((modes.margin, float(modes.frequencies[int(np.argmax(modes.growth_rates))])))
        except NoSolutionError:
            rows.append((np.nan, np.nan))
    growth, frequency = np.array(rows).T.reshape(2, sides[0].size, sides[1].size)
    return StabilityMap((first, second), (sides[0], sides[1]), growth, frequency)
