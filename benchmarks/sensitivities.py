"""Derivatives of one number of a contact to all its parameters in units of one cold solve:
``python benchmarks/sensitivities.py --sizes 256 512``.

The self-affine surface of the page of benchmarks presses on six layers, whose 20 constants are the
parameters beside the load and every height. *Cold* is a solve from nothing, to the tolerance that
derivatives ask for; *all* are the derivatives to everything with a relative error of 1e-6, *some*
those to thickness and modulus of the first layer, in processor time, the shortest of all repeats
taken in turns. The aim is at most one for all of them.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from surfaces import self_affine
from tables import add_option, made, show

import asperity as asp
from asperity.engines import CpuEngine
from asperity.sensitivities import PressureNorm, StressNorm, sensitivities
from asperity.solvers import ActiveSet

PRESSURE = 0.003
"""Mean pressure over the modulus of the base."""

TOLERANCE = 1e-6
"""Relative residual of the linear systems."""

FEW = ("body.layers[0].thickness", "body.layers[0].youngs_modulus")


def problem(n: int, boundary: Any) -> asp.ContactProblem:
    """The surface on six layers, stiff and soft ones, of eight pixels each."""
    surface = self_affine(n)
    depth = 8.0 * surface.grid.spacing[0]
    layers = [asp.Layer(asp.Elastic(2.0 if k % 2 else 0.7, 0.2 + 0.02 * k), depth) for k in range(6)]
    return asp.ContactProblem(surface, asp.Layered(layers, asp.Elastic(1.0, 0.3)), boundary=boundary)


OUTPUTS: dict[str, Any] = {
    "approach": "approach",
    "peak pressure": PressureNorm(16.0),
    "elastic energy": "complementary_energy",
    "stress in a layer": StressNorm(0, (0.0, 0.5, 1.0)),
}
"""Numbers by the words of the table."""


def timed(works: Sequence[Callable[[], Any]], repeats: int) -> tuple[list[Any], list[float]]:
    """What the ``works`` give, and the shortest processor time in s of each, taken in turns: what
    else the machine does falls on all of them."""
    times, found = [[] for _ in works], []
    for _ in range(repeats):
        found = []
        for work, taken in zip(works, times, strict=True):
            start = time.process_time()
            found.append(work())
            taken.append(time.process_time() - start)
    return found, [min(each) for each in times]


def rows(n: int, name: str, boundary: Any, threads: int, repeats: int) -> list[list[str]]:
    """Rows of one size and boundary."""
    asked, engine = problem(n, boundary), CpuEngine(threads)
    method = ActiveSet(tolerance=1e-8)

    def cold() -> Any:
        return asp.solve(asked, asp.MeanPressure(PRESSURE), solver=method, engine=engine)

    result, made_rows = cold(), []
    for words, of in OUTPUTS.items():
        if name == "free" and words.startswith("stress"):
            continue  # by differences of influence coefficients

        def derived(to: Any, of: Any = of) -> Any:
            return sensitivities(result, of, to, tolerance=TOLERANCE, engine=engine)

        (_, found, _), (solve, whole, some) = timed([cold, lambda: derived("all"), lambda: derived(FEW)], repeats)
        made_rows.append(
            [
                str(n),
                name,
                words,
                str(len(found.values)),
                f"{result.area_fraction:.3f}",
                f"{np.sum(found.certificate.fft_pairs):.1f}",
                f"{solve:.3f}",
                f"{whole / solve:.2f}",
                f"{some / solve:.2f}",
                f"{found.certificate.adjoint_residual:.0e}",
            ]
        )
    return made_rows


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", type=int, nargs="+", default=[256, 512])
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--repeats", type=int, default=3)
    add_option(parser)
    given = parser.parse_args()
    columns = (
        "n",
        "boundary",
        "number",
        "parameters",
        "real area",
        "FFT pairs",
        "cold / s",
        "all / cold",
        "some / cold",
        "residual",
    )
    boundaries = {"periodic": asp.Periodic(), "free": asp.Free()}
    found = [
        row
        for n in given.sizes
        for name, boundary in boundaries.items()
        for row in rows(n, name, boundary, given.threads, given.repeats)
    ]
    show(made("sensitivities", columns, found), write=given.write)


if __name__ == "__main__":
    main()
