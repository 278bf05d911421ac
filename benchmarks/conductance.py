"""What the conductance of a solved contact costs beside the solve: FFT pairs, time, bounds.

A self-affine surface as on the page of benchmarks, 1024² points by default. The aim is at most two
cold solves of the normal contact.
"""

from __future__ import annotations

import argparse
import time

import numpy as np

import asperity as asp
from asperity.engines import CpuEngine
from asperity.physics.conductance.conductance import ContactConductance, conductance
from asperity.physics.conductance.law import ConductingInterface
from asperity.solids import Conduction


def joint(n: int, coated: bool) -> asp.ContactProblem:
    """A rough surface of rms slope one and unit contact modulus, bare or coated."""
    spectrum = asp.generate.SelfAffine(
        amplitude=asp.generate.RmsSlope(1.0), hurst=0.8, rolloff_wavelength=n / 4.0, shortest_wavelength=8.0
    )
    surface = asp.generate.gaussian(asp.Grid((n, n), (1.0, 1.0)), spectrum, seed=1)
    body: asp.Elastic | asp.Layered = asp.Elastic(0.91, 0.3, conduction=Conduction(1.0, 1.0))
    if coated:
        film = asp.Elastic(2.0, 0.3, conduction=Conduction(0.1, 0.1))
        body = asp.Layered([asp.Layer(film, 20.0)], body)
    return asp.ContactProblem(surface, body)


def timed(problem: asp.ContactProblem, pressure: float, threads: int, repeats: int) -> tuple[float, list[float]]:
    """Least time of a cold solve, and of the conductance of its result: clean, with a film, and
    with a gap that conducts a hundredth of the body."""
    solves, found = [], list[list[float]]()
    between = (
        ConductingInterface(),
        ConductingInterface(film_resistance=5.0),
        ConductingInterface(gap_conductivity=0.01),
    )
    for _ in range(repeats):
        start = time.perf_counter()
        result = asp.solve(problem, asp.MeanPressure(pressure), engine=CpuEngine(threads))
        solves.append(time.perf_counter() - start)
        _ = result.gap, result.edges  # of the result, whatever follows
        row = []
        for interface in between:
            start = time.perf_counter()
            answer: ContactConductance = conductance(result, "thermal", interface, engine=CpuEngine(threads))
            row.append(time.perf_counter() - start)
            assert answer.upper / answer.lower < 1.0 + 1e-4
        found.append(row)
    return min(solves), np.min(found, axis=0).tolist()


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, default=1024)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--repeats", type=int, default=3)
    given = parser.parse_args()
    print("| body | p/E* | solve (s) | clean | with film | with gap |")
    print("|---|---|---|---|---|---|")
    for coated in (False, True):
        problem = joint(given.points, coated)
        for pressure in (0.01, 0.05, 0.2):
            solve, rows = timed(problem, pressure, given.threads, given.repeats)
            shown = " | ".join(f"{row:.2f} s ({row / solve:.2f})" for row in rows)
            print(f"| {'coated' if coated else 'bare'} | {pressure:g} | {solve:.2f} | {shown} |")


if __name__ == "__main__":
    main()
