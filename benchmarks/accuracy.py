"""Pressure error of our solvers at the default tolerance of the benchmark, for every arithmetic
they offer.

The reference is a solution at 1e-10 in double precision. Usage: python benchmarks/accuracy.py
[--sizes 256 512]
"""

from __future__ import annotations

import argparse

import numpy as np
from checks import contact_pixels, relative_l2
from surfaces import BODY, LOADS, self_affine

import asperity as asp

ARITHMETICS = ("single", "mixed", "double")
REFERENCE = 1e-10


def solved(problem: asp.ContactProblem, load: float, solver: object) -> asp.ContactResult:
    """Solve without extras; what did not converge comes back with its status."""
    return asp.solve(
        problem, asp.MeanPressure(load), solver=solver, keep=asp.Keep(stiffness=False), on_failure="return"
    )


def line(n: int, load: float, arithmetic: str, found: asp.ContactResult, reference: asp.ContactResult) -> str:
    """One row of the table."""
    work = found.certificate
    pixels = contact_pixels(found.pressure) - contact_pixels(reference.pressure)
    state = "" if found.converged else f"  {found.status.outcome.value}"
    return (
        f"{n:>5} {load:>5} {arithmetic:<7} {relative_l2(found.pressure, reference.pressure):>9.1e} {pixels:>+7} "
        f"{work.field_error:>9.1e} {work.duality_gap:>9.1e} {work.fft_pairs:>6.0f} {work.wall_time:>8.3f}{state}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[256, 512])
    parser.add_argument("--tolerance", type=float, default=1e-6)
    given = parser.parse_args()
    print(f"asperity {asp.__version__}, tolerance {given.tolerance}, against {REFERENCE} in double precision")
    print("    n  load arith.      L2 err  pixels  field err  gap/V    pairs   time/s")
    for n in given.sizes:
        problem = asp.ContactProblem(self_affine(n), BODY)
        for load in LOADS:
            tight = asp.solvers.ActiveSet(tolerance=REFERENCE, precision="double")
            reference = solved(problem, load, tight)
            if not reference.converged:
                print(
                    f"{n:>5} {load:>5} reference {reference.status.outcome.value}: "
                    f"{reference.certificate.field_error:.1e}"
                )
            for arithmetic in ARITHMETICS:
                try:
                    solver = asp.solvers.ActiveSet(tolerance=given.tolerance, precision=arithmetic)
                except asp.InputError:
                    print(f"{n:>5} {load:>5} {arithmetic:<7} not offered")
                    continue
                print(line(n, load, arithmetic, solved(problem, load, solver), reference), flush=True)


if __name__ == "__main__":
    np.seterr(all="raise", under="ignore")
    main()
