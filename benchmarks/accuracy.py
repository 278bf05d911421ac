"""Pressure error of our solvers at the default tolerance of the benchmark, for every arithmetic
they offer.

The reference is a solution at 1e-10 in double precision. Usage: python benchmarks/accuracy.py
[--sizes 256 512] [--write]
"""

from __future__ import annotations

import argparse

import numpy as np
from checks import contact_pixels, relative_l2
from surfaces import BODY, LOADS, self_affine
from tables import add_option, made, show

import asperity as asp

ARITHMETICS = ("single", "mixed", "double")
REFERENCE = 1e-10


def solved(problem: asp.ContactProblem, load: float, solver: object) -> asp.ContactResult:
    """Solve without extras; what did not converge comes back with its status."""
    return asp.solve(
        problem, asp.MeanPressure(load), solver=solver, keep=asp.Keep(stiffness=False), on_failure="return"
    )


COLUMNS = (
    "n",
    "load",
    "arithmetic",
    "error of the pressure (L2)",
    "pixels",
    "the field's error",
    "duality gap",
    "pairs",
)


def row(n: int, load: float, arithmetic: str, found: asp.ContactResult, reference: asp.ContactResult) -> list[str]:
    """One row of the table."""
    work = found.certificate
    pixels = contact_pixels(found.pressure) - contact_pixels(reference.pressure)
    state = "" if found.converged else f", {found.status.outcome.value}"
    error = f"{relative_l2(found.pressure, reference.pressure):.1e}{state}"
    numbers = [f"{pixels:+}", f"{work.field_error:.1e}", f"{work.duality_gap:.1e}", f"{work.fft_pairs:.0f}"]
    return [str(n), str(load), arithmetic, error, *numbers]


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[256, 512])
    parser.add_argument("--tolerance", type=float, default=1e-6)
    add_option(parser)
    given = parser.parse_args()
    rows = []
    print(f"asperity {asp.__version__}, tolerance {given.tolerance}, against {REFERENCE} in double precision")
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
                rows.append(row(n, load, arithmetic, solved(problem, load, solver), reference))
    show(made("accuracy", COLUMNS, rows), write=given.write)


if __name__ == "__main__":
    np.seterr(all="raise", under="ignore")
    main()
