"""Flash temperature of a sliding contact in units of one cold solve of its normal contact:
``python benchmarks/heating.py --sizes 256 512``.

A self-affine surface as on the page of benchmarks, bare and coated, at a small and a large contact.
*Heating* is everything from the pressures to the temperatures of both bodies with the estimates
beside. The aim is at most one cold solve at 512² periodic.
"""

from __future__ import annotations

import argparse
import time

import numpy as np
from surfaces import self_affine
from tables import add_option, made, show

import asperity as asp
from asperity.engines import CpuEngine
from asperity.heating import Motion, flash_temperature
from asperity.solids import Conduction


def problem(n: int, coated: bool) -> asp.ContactProblem:
    """The surface between two bodies of unit contact modulus whose diffusivity is one."""
    body = asp.Elastic(1.82, 0.3, conduction=Conduction(1.0, volumetric_heat_capacity=1.0))
    film = asp.Elastic(1.82, 0.3, conduction=Conduction(0.1, volumetric_heat_capacity=0.8))
    spacing = self_affine(n).grid.spacing[0]
    counter = asp.Layered([asp.Layer(film, 4.0 * spacing)], body) if coated else body
    return asp.ContactProblem(self_affine(n), body, counter_body=counter)


def row(n: int, coated: bool, pressure: float, threads: int, repeats: int) -> list[str]:
    """Row of one size, body and mean pressure over the contact modulus."""
    asked, solves, heated = problem(n, coated), list[float](), list[float]()
    motion = Motion.of(0.5 / asked.grid.spacing[0])
    for _ in range(repeats):
        start = time.perf_counter()
        result = asp.solve(asked, asp.MeanPressure(pressure), engine=CpuEngine(threads))
        solves.append(time.perf_counter() - start)
        start = time.perf_counter()
        found = flash_temperature(result, motion, 0.3, threads=threads)
        heated.append(time.perf_counter() - start)
    solve, heat = min(solves), min(heated)
    close = f"{found.mismatch / found.maximum:.0e}"
    area = f"{np.count_nonzero(found.contact) / found.contact.size:.3f}"
    name = "coated" if coated else "bare"
    return [str(n), name, area, f"{solve:.2f}", f"{heat:.2f}", f"{heat / solve:.2f}", str(found.steps), close]


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", type=int, nargs="+", default=[256, 512, 1024])
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--repeats", type=int, default=3)
    add_option(parser)
    given = parser.parse_args()
    columns = (
        "n",
        "counter body",
        "contact",
        "solve (s)",
        "heating (s)",
        "heating / solve",
        "steps",
        "mismatch / maximum",
    )
    rows = [
        row(n, coated, pressure, given.threads, given.repeats)
        for n in given.sizes
        for coated in (False, True)
        for pressure in (0.01, 0.1)
    ]
    show(made("heating", columns, rows), write=given.write)


if __name__ == "__main__":
    main()
