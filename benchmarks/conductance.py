"""Conductance of a solved contact in units of one cold solve of it: clean, with a film, and beside
a gap that conducts a hundredth of the body: ``python benchmarks/conductance.py --sizes 512 1024``.

A self-affine surface as on the page of benchmarks, bare or coated. Times are those of the
processor, the least of several runs; both use the same number of threads. The aim is at most two
cold solves of the normal contact.
"""

from __future__ import annotations

import argparse
from functools import partial

from clock import timed
from surfaces import self_affine
from tables import add_option, made, show

import asperity as asp
from asperity.engines import CpuEngine
from asperity.physics.conductance.conductance import conductance
from asperity.physics.conductance.law import ConductingInterface
from asperity.solids import Conduction

PRESSURES = (0.01, 0.05, 0.2)
"""Over E* and the rms slope."""

BETWEEN = {
    "clean": ConductingInterface(),
    "film": ConductingInterface(film_resistance=5.0),
    "gap": ConductingInterface(gap_conductivity=0.01),
}


def joint(n: int, coated: bool) -> asp.ContactProblem:
    """A rough surface of rms slope one and unit contact modulus, bare or coated."""
    body: asp.Elastic | asp.Layered = asp.Elastic(0.91, 0.3, conduction=Conduction(1.0, 1.0))
    if coated:
        film = asp.Elastic(2.0, 0.3, conduction=Conduction(0.1, 0.1))
        body = asp.Layered([asp.Layer(film, 20.0)], body)
    return asp.ContactProblem(self_affine(n), body)


def row(n: int, coated: bool, pressure: float, threads: int, repeats: int) -> list[str]:
    """Row of one size, body and pressure."""
    problem, engine = joint(n, coated), CpuEngine(threads)
    result, solve = timed(lambda: asp.solve(problem, asp.MeanPressure(pressure), engine=engine), repeats, before=1)
    _ = result.gap, result.edges  # of the result, whatever follows
    numbers, apart = [], 0.0
    for interface in BETWEEN.values():
        answer, seconds = timed(partial(conductance, result, "thermal", interface, engine=engine), repeats, before=1)
        numbers += [f"{seconds:.2f}", f"{seconds / solve:.2f}"]
        apart = max(apart, answer.upper / answer.lower - 1.0)
    return [str(n), "coated" if coated else "bare", f"{pressure:g}", f"{solve:.2f}", *numbers, f"{apart:.0e}"]


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", type=int, nargs="+", default=[512, 1024])
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--repeats", type=int, default=3)
    add_option(parser)
    given = parser.parse_args()
    columns = ["n", "body", "p/E*", "solve (s)"]
    columns += [name for kind in BETWEEN for name in (f"{kind} (s)", f"{kind} / solve")]
    rows = [
        row(n, coated, pressure, given.threads, given.repeats)
        for n in given.sizes
        for coated in (False, True)
        for pressure in PRESSURES
    ]
    show(made("conductance", [*columns, "bounds apart"], rows), write=given.write)


if __name__ == "__main__":
    main()
