"""Derivatives of one number of a contact to all its parameters in units of one cold solve:
``python benchmarks/sensitivities.py --sizes 256 512``.

The self-affine surface of the page of benchmarks presses on six layers, whose 20 constants are the
parameters beside the load and every height. *Cold* is a solve from nothing, to the tolerance that
derivatives ask for; *all* are the derivatives to everything with a relative error of 1e-6, *some*
those to thickness and modulus of the first layer. The aim is at most one for all of them.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
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


def timed(work: Callable[[], Any], repeats: int) -> tuple[Any, float]:
    """What ``work`` gives, and its shortest time in s."""
    times, found = [], None
    for _ in range(repeats):
        start = time.perf_counter()
        found = work()
        times.append(time.perf_counter() - start)
    return found, min(times)


def rows(n: int, name: str, boundary: Any, threads: int, repeats: int) -> list[list[str]]:
    """Rows of one size and boundary."""
    asked, engine = problem(n, boundary), CpuEngine(threads)
    method = ActiveSet(tolerance=1e-8)
    result, cold = timed(lambda: asp.solve(asked, asp.MeanPressure(PRESSURE), solver=method, engine=engine), repeats)
    made_rows = []
    for words, of in OUTPUTS.items():
        if name == "free" and words.startswith("stress"):
            continue  # by differences of influence coefficients
        found, whole = timed(lambda of=of: sensitivities(result, of, tolerance=TOLERANCE, engine=engine), repeats)  # type: ignore[misc]
        _, some = timed(lambda of=of: sensitivities(result, of, FEW, tolerance=TOLERANCE, engine=engine), repeats)  # type: ignore[misc]
        made_rows.append(
            [
                str(n),
                name,
                words,
                str(len(found.values)),
                f"{result.area_fraction:.3f}",
                f"{np.sum(found.certificate.fft_pairs):.1f}",
                f"{cold:.3f}",
                f"{whole / cold:.2f}",
                f"{some / cold:.2f}",
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
