"""Finite elements of plastic solids: ``python benchmarks/fem.py``: a sphere in 40 steps to 100
yield approaches, and one Newton iteration of 10⁴ elements.

Processor time of one process, for a perfectly plastic half-space (hardening of 3e-4 E), and loads
beside those of the reference.
"""

from __future__ import annotations

import argparse
import time

import numpy as np
from tables import add_option, made, show

import asperity as asp
from asperity import fem
from asperity.solids.plasticity import LinearHardening

E, NU, YIELD, RADIUS = 200e9, 0.3, 2e9, 1e-3
STEEL = asp.Elastic(E, NU)
E_STAR = STEEL.plane_strain_modulus
PEAK = 1.6128 * YIELD
APPROACH = RADIUS * (np.pi * PEAK / (2.0 * E_STAR)) ** 2
LOAD = np.pi**3 * RADIUS**2 / (6.0 * E_STAR**2) * PEAK**3
REFERENCE = {10.0: 25.3, 35.0: 124.6, 40.0: 147.2, 45.0: 170.0}
"""Load over the load of first yield, at approaches over that of first yield (error 0.5 % at 10, 1
to 1.5 % beyond)."""


def sphere(across: int, steps: int) -> list[str]:
    """Time of a history to 100 yield approaches, time of an iteration, and loads."""
    x = np.linspace(0.0, 100.0, steps + 1)[1:]
    start = time.process_time()
    found = fem.indentation(
        STEEL,
        fem.Paraboloid(RADIUS),
        x * APPROACH,
        plasticity=LinearHardening(YIELD, 3e-4 * E),
        resolution=fem.Resolution(across=across),
    )
    took = time.process_time() - start
    iterations, cuts = sum(step.iterations for step in found.steps), sum(step.cuts for step in found.steps)
    cells = len(found.fields[steps - 1].mesh.cells)
    numbers = [str(cells), str(steps), f"{took:.1f}", str(iterations), f"{took / iterations:.2f}", str(cuts)]
    return [*numbers, *(f"{np.interp(x, found.approach / APPROACH, found.load / LOAD):.1f}" for x in REFERENCE)]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=40)
    parser.add_argument("--across", type=int, nargs="+", default=[40, 56])
    add_option(parser)
    options = parser.parse_args()
    rows = [sphere(across, options.steps) for across in options.across]
    loads = [f"load at {x:g} (reference {load:g})" for x, load in REFERENCE.items()]
    columns = ("elements", "steps", "s", "iterations", "s an iteration", "cuts", *loads)
    show(made("finite-elements", columns, rows), write=options.write)
