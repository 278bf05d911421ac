"""Layered bodies against the homogeneous half-space: time, FFT pairs and set-up of the same solver
on the same surface.

Usage: python benchmarks/layered.py [--sizes 512 1024] [--load 0.05] [--threads 2] [--repeats 3]
[--surfaces 3] [--write]

All bodies are solved once in every round, so that all see the same disturbances; given are medians
over the rounds, and their means over some surfaces, for a pair more or less on one of them is
chance. ``cpu`` is processor time of all threads, the result's extras included, and less sensitive
to other work. Loads are chosen for about equal contact areas, since the work on the contact set
grows with it: a first solve of each body tells its area at the load of the homogeneous one, and
area is nearly proportional to load. A layered kernel is an array of the grid like any other; what
differs is the set-up and the number of pairs, which grows where a thin stiff film makes the problem
ill-conditioned.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Sequence
from dataclasses import astuple, dataclass, field

from surfaces import BODY, self_affine
from tables import add_option, made, show

import asperity as asp
from asperity.core.spectral import thread_count

_KEEP = asp.Keep(stiffness=False)
_COARSEST = 32


def bodies() -> dict[str, tuple[asp.Layered | asp.Elastic, asp.Layered | asp.Rigid]]:
    """Pairs of bodies by name; thicknesses in pixels, moduli over that of the base."""

    def coated(ratio: float, thickness: float) -> asp.Layered:
        return asp.Layered([asp.Layer(asp.Elastic(ratio * BODY.youngs_modulus, 0.3), thickness)], BODY)

    layer = asp.Elastic(2.0 * BODY.youngs_modulus, 0.3)
    rubber = asp.Elastic(BODY.youngs_modulus, 0.49)
    coating = asp.solids.graded(layer, BODY, 20.0, sublayers=32)
    single = {f"E {ratio:g}, h {h:g}": coated(ratio, h) for ratio in (0.5, 2.0, 10.0) for h in (4.0, 20.0, 100.0)}
    return {
        "homogeneous": (BODY, asp.Rigid()),
        **{name: (body, asp.Rigid()) for name, body in single.items()},
        "three layers": (
            asp.Layered([asp.Layer(layer, 4.0), asp.Layer(rubber, 8.0), asp.Layer(layer, 20.0)], BODY),
            asp.Rigid(),
        ),
        "graded, 32 sublayers": (asp.Layered(coating, BODY), asp.Rigid()),
        "both coated": (coated(2.0, 20.0), coated(0.5, 20.0)),
        "on a rigid base": (asp.Layered([asp.Layer(BODY, 50.0)], asp.RigidBase()), asp.Rigid()),
    }


@dataclass
class Row:
    """Rounds of one pair of bodies."""

    setup: list[float] = field(default_factory=list)
    total: list[float] = field(default_factory=list)
    cpu: list[float] = field(default_factory=list)
    pairs: float = 0.0
    area: float = 0.0


def setup_seconds(problem: asp.ContactProblem, engine: asp.engines.CpuEngine) -> float:
    """Time of the kernels of the grid and of all coarser grids of the nested start."""
    started = time.perf_counter()
    operator = asp.solvers.prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=engine)
    while min(operator.grid.shape) > _COARSEST:
        operator = operator.coarsened
    return time.perf_counter() - started


def once(row: Row, problem: asp.ContactProblem, load: float, tolerance: float, threads: int) -> None:
    """One round of ``problem``: set-up alone, then preparation and solve together."""
    engine, solver = asp.engines.CpuEngine(threads), asp.solvers.ActiveSet(tolerance=tolerance)
    row.setup.append(setup_seconds(problem, engine))
    started, worked = time.perf_counter(), time.process_time()
    operator = asp.solvers.prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=engine)
    prepared = time.perf_counter() - started
    result = asp.solve(problem, asp.MeanPressure(load), solver=solver, operator=operator, keep=_KEEP)
    row.total.append(prepared + result.certificate.wall_time)
    row.cpu.append(time.process_time() - worked)
    row.pairs, row.area = result.certificate.fft_pairs, result.area_fraction


@dataclass(frozen=True)
class Cost:
    """Medians of a row: seconds in all, of processors and of the set-up; FFT pairs; contact area
    over the nominal one."""

    total: float
    cpu: float
    setup: float
    pairs: float
    area: float

    @classmethod
    def of(cls, row: Row) -> Cost:
        """Medians of ``row``."""
        return cls(*(statistics.median(values) for values in (row.total, row.cpu, row.setup)), row.pairs, row.area)

    @classmethod
    def mean(cls, costs: Sequence[Cost]) -> Cost:
        """Mean over surfaces."""
        return cls(*(statistics.fmean(values) for values in zip(*(astuple(cost) for cost in costs), strict=True)))


def on_one_surface(surface: asp.Surface, load: float, tolerance: float, threads: int, repeats: int) -> dict[str, Cost]:
    """Cost of every pair of bodies on ``surface``, at loads for about equal areas."""
    problems = {
        name: asp.ContactProblem(surface, body, counter_body=counter) for name, (body, counter) in bodies().items()
    }
    rows = {name: Row() for name in problems}
    for name, problem in problems.items():
        first = Row()
        once(first, problem, load, tolerance, threads)
        rows[name].area = first.area
    loads = {name: load * rows["homogeneous"].area / rows[name].area for name in problems}
    for _ in range(repeats):
        for name, problem in problems.items():
            once(rows[name], problem, loads[name], tolerance, threads)
    return {name: Cost.of(row) for name, row in rows.items()}


COLUMNS = (
    "n",
    "body",
    "total (s)",
    "× homogeneous",
    "cpu ×",
    "pairs",
    "× pairs",
    "set-up (ms)",
    "share of a solve",
    "area",
)


def rows_of(n: int, found: list[dict[str, Cost]]) -> list[list[str]]:
    """Rows for n x n points, from the costs on some surfaces."""
    costs = {name: Cost.mean([one[name] for one in found]) for name in found[0]}
    base = costs["homogeneous"]
    return [
        [
            str(n),
            name,
            f"{cost.total:.3f}",
            f"{cost.total / base.total:.2f}",
            f"{cost.cpu / base.cpu:.2f}",
            f"{cost.pairs:.1f}",
            f"{cost.pairs / base.pairs:.2f}",
            f"{1e3 * cost.setup:.1f}",
            f"{100.0 * cost.setup / base.total:.1f} %",
            f"{cost.area:.3f}",
        ]
        for name, cost in costs.items()
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[512, 1024])
    parser.add_argument("--load", type=float, default=0.05, help="mean pressure over the contact modulus of the base")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--threads", type=int, default=thread_count())
    parser.add_argument("--tolerance", type=float, default=1e-6)
    parser.add_argument("--surfaces", type=int, default=3, help="number of surfaces, of seeds 1, 2, ...")
    add_option(parser)
    given = parser.parse_args()
    print(f"asperity {asp.__version__}, {given.threads} thread(s), tolerance {given.tolerance}, load {given.load}")
    problem = asp.ContactProblem(self_affine(128), BODY)
    once(Row(), problem, given.load, 1e-4, given.threads)  # compiles
    rows = []
    for n in given.sizes:
        surfaces = [self_affine(n, seed) for seed in range(1, given.surfaces + 1)]
        work = (given.load, given.tolerance, given.threads, given.repeats)
        rows += rows_of(n, [on_one_surface(surface, *work) for surface in surfaces])
    show(made("layers", COLUMNS, rows), write=given.write)


if __name__ == "__main__":
    main()
