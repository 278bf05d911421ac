"""Cost of a step of time of a viscoelastic contact, in cold elastic solves of the same surface and
tolerance.

Usage: python benchmarks/viscoelastic.py [--size 512] [--load 0.05] [--threads 1] [--repeats 5]

A load at once, then a hold, in equal steps and in steps by their error; rejected ones count. Every
round solves the elastic contact of the moduli half-way through the relaxation and then every
viscoelastic one, so that all see the same disturbances; given are medians of processor time. A
first round, which compiles, does not count.
"""

from __future__ import annotations

import argparse
import statistics
import time

from surfaces import self_affine
from tables import add_option, made, show

import asperity as asp
from asperity.contact.solve import Prepared

RUBBER = asp.Viscoelastic.prony(1.0, ((9.0, 1.0),), 0.4)
POLYMER = asp.Viscoelastic.prony(1.0, ((2.0, 10.0), (3.0, 1.0), (4.0, 0.1)), 0.4)
BETWEEN, BASE = asp.Elastic(3.0, 0.4), asp.Elastic(20.0, 0.3)
HOLD = 2.0


def bodies() -> dict[str, tuple[asp.Elastic | asp.Layered, asp.Elastic | asp.Layered]]:
    """Viscoelastic body and the elastic one beside it, by name; thickness in pixels."""

    def coated(material: asp.Elastic) -> asp.Layered:
        return asp.Layered([asp.Layer(material, 20.0)], BASE)

    return {
        "half-space, 1 term": (RUBBER, BETWEEN),
        "half-space, 3 terms": (POLYMER, BETWEEN),
        "coating, 1 term": (coated(RUBBER), coated(BETWEEN)),
        "coating, 3 terms": (coated(POLYMER), coated(BETWEEN)),
    }


def prepared(problem: asp.ContactProblem, threads: int, settings: asp.TimeSteps) -> Prepared:
    """``problem`` with its operator."""
    operator = asp.solvers.prepare_operator(
        problem.compliance, problem.grid, problem.boundary, engine=asp.engines.CpuEngine(threads)
    )
    return Prepared(problem, operator=operator, time_steps=settings, keep=asp.Keep(stiffness=False))


def main() -> None:
    """Print one row for each body, boundary and kind of steps."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--size", type=int, default=512)
    parser.add_argument("--load", type=float, default=0.05, help="mean pressure over the modulus half-way")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--repeats", type=int, default=5)
    add_option(parser)
    args = parser.parse_args()
    load, surface = asp.MeanPressure(args.load * 3.0), self_affine(args.size)
    found = []
    for name, (body, elastic) in bodies().items():
        for boundary in (asp.Periodic(), asp.Free()):
            reference = prepared(asp.ContactProblem(surface, elastic, boundary=boundary), args.threads, asp.TimeSteps())
            problem = asp.ContactProblem(surface, body, boundary=boundary)
            for kind, settings in {"equal": asp.TimeSteps(number=12), "by error": asp.TimeSteps()}.items():
                march = prepared(problem, args.threads, settings)
                first = march.step(asp.Step(load))
                rows: list[tuple[float, float]] = []
                tries = 0
                for _ in range(args.repeats + 1):
                    started = time.process_time()
                    reference.step(asp.Step(load))
                    between = time.process_time()
                    held = march.step(asp.Step(load, duration=HOLD), first.state)
                    assert held.creep is not None
                    tries = held.creep.tries
                    rows.append((between - started, (time.process_time() - between) / tries))
                cold, each = (statistics.median(column) for column in zip(*rows[1:], strict=True))
                ratios = [after / before for before, after in rows[1:]]
                times = [f"{cold:.3f}", str(tries), f"{each:.3f}", f"{each / cold:.2f}"]
                place = type(boundary).__name__.lower()
                found.append([name, place, kind, *times, f"{min(ratios):.2f}–{max(ratios):.2f}"])
    columns = ("body", "boundary", "steps", "cold elastic solve (s)", "number", "s a step", "ratio", "range")
    show(made("viscoelastic", columns, found), write=args.write)


if __name__ == "__main__":
    main()
