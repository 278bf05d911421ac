"""Where a solve spends its time: transforms, each compiled pass, and what is left.

Usage: python benchmarks/where_time_goes.py [--sizes 1024] [--load 0.05] [--threads 2] [--write]
"""

from __future__ import annotations

import argparse
import time
from collections import defaultdict
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from surfaces import BODY, self_affine
from tables import add_option, made, show

import asperity as asp
from asperity.core.engine.blocks import Blocks
from asperity.core.spectral import RealTransform, thread_count


@contextmanager
def watched(spent: dict[str, list[float]]) -> Iterator[None]:
    """Add the duration of every transform and compiled pass to ``spent`` by its name."""
    originals = [
        (RealTransform, "forward", lambda transform, *_: f"transform {transform.shape[0]}"),
        (RealTransform, "backward", lambda transform, *_: f"transform {transform.shape[0]}"),
        (Blocks, "share", lambda _, kernel, parts, *__: f"pass {kernel.__name__}"),
    ]
    saved = [(owner, name, getattr(owner, name)) for owner, name, _ in originals]
    for owner, name, label in originals:
        setattr(owner, name, _timed(getattr(owner, name), label, spent))
    try:
        yield
    finally:
        for owner, name, method in saved:
            setattr(owner, name, method)


def _timed(method: Callable[..., Any], label: Callable[..., str], spent: dict[str, list[float]]) -> Callable[..., Any]:
    def wrapper(*arguments: Any, **options: Any) -> Any:
        started = time.perf_counter()
        answer = method(*arguments, **options)
        spent[label(*arguments)].append(time.perf_counter() - started)
        return answer

    return wrapper


def shares(n: int, load: float, tolerance: float, threads: int) -> list[list[str]]:
    """Rows of one solve, the most expensive first."""
    problem, engine = asp.ContactProblem(self_affine(n), BODY), asp.engines.CpuEngine(threads)
    operator = asp.solvers.prepare_operator(problem.compliance, problem.grid, problem.boundary, engine=engine)
    solver, keep = asp.solvers.ActiveSet(tolerance=tolerance), asp.Keep(stiffness=False)
    spent: dict[str, list[float]] = defaultdict(list)
    asp.solve(problem, asp.MeanPressure(load), solver=solver, operator=operator, keep=keep)
    with watched(spent):
        result = asp.solve(problem, asp.MeanPressure(load), solver=solver, operator=operator, keep=keep)
    work = result.certificate
    print(f"{n}², load {load}: {work.wall_time:.3f} s, {work.fft_pairs:.1f} pairs, {work.iterations} iterations")
    spent["everything else"].append(work.wall_time - sum(map(sum, spent.values())))
    most = sorted(spent.items(), key=lambda item: -sum(item[1]))
    return [
        [str(n), name, str(len(seconds)), f"{1e3 * sum(seconds):.1f}", f"{100.0 * sum(seconds) / work.wall_time:.1f} %"]
        for name, seconds in most
        if sum(seconds) >= 0.01 * work.wall_time
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[1024])
    parser.add_argument("--load", type=float, default=0.05)
    parser.add_argument("--tolerance", type=float, default=1e-6)
    parser.add_argument("--threads", type=int, default=thread_count())
    add_option(parser)
    given = parser.parse_args()
    rows = [row for n in given.sizes for row in shares(n, given.load, given.tolerance, given.threads)]
    columns = ("n", "work, of at least one per cent", "calls", "ms", "share")
    show(made("where-time-goes", columns, rows), write=given.write)


if __name__ == "__main__":
    main()
