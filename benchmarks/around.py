"""What is solved around the plain contact, in cold periodic solves of the same surface:
``python benchmarks/around.py --sizes 512 1024``.

Self-affine surface of unit rms slope (``surfaces.self_affine``). *Free*: free boundary under the
same load. *Position*: the approach, and the mean gap, that the load gives. *Path*: 20 loads of
equal steps up to the load. *Adhesion*: exponential attraction of 50 mJ/m² and 1 nm on a surface of
2 nm rms height and slope 1/4, E* 100 GPa; its pairs are those after its first equilibrium. Times
are those of processors, the least of several runs; FFT pairs are pairs of the periodic grid and do
not depend on the machine.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator

import numpy as np
from clock import timed
from surfaces import BODY, LOADS, self_affine
from tables import add_option, made, show

import asperity as asp

COLUMNS = ("what", "n", "load", "cold (s)", "cold pairs", "pairs", "time over cold")
STEPS = 20


def cases(n: int, seed: int, loads: list[float], repeats: int) -> Iterator[list[str]]:
    """Rows of one surface."""
    surface = self_affine(n, seed)
    problem = asp.ContactProblem(surface, BODY)
    free = asp.ContactProblem(surface, BODY, boundary=asp.Free())
    timed(lambda: asp.solve(problem, asp.MeanPressure(loads[0])), 1)
    for load in loads:
        cold, second = timed(lambda load=load: asp.solve(problem, asp.MeanPressure(load)), repeats)
        prescribed = {
            "free boundary": (free, asp.MeanPressure(load)),
            "approach": (problem, asp.Approach(cold.approach)),
            "mean gap": (problem, asp.MeanGap(cold.mean_gap)),
        }
        for what, (posed, control) in prescribed.items():
            found, seconds = timed(lambda posed=posed, control=control: asp.solve(posed, control), repeats)
            assert found.converged
            yield row(what, n, load, cold, second, found.certificate.fft_pairs, seconds)
        path = asp.History([asp.MeanPressure(load * k / STEPS) for k in range(1, STEPS + 1)])
        found, seconds = timed(lambda path=path: asp.solve(problem, path), 1)
        pairs = float(np.mean([step.certificate.fft_pairs for step in found.steps]))
        yield row(f"step of {STEPS}", n, load, cold, second, pairs, seconds / STEPS)


def adhesive(n: int, repeats: int) -> list[str]:
    """Row of an adhesive contact under a load of 0.001 E*."""
    surface = self_affine(n)
    scale = 2e-9 / float(surface.heights.std())
    surface = asp.Surface(surface.heights * scale, 4.0 * scale, periodic=True)  # rms slope 1/4
    body = asp.Elastic(91e9, 0.3)
    control = asp.MeanPressure(100e6)
    cold, second = timed(lambda: asp.solve(asp.ContactProblem(surface, body), control), repeats)
    law = asp.adhesion.ExponentialAdhesion(work=0.05, range=1e-9)
    posed = asp.ContactProblem(surface, body, adhesion=law)
    found, seconds = timed(lambda: asp.solve(posed, control), repeats)
    assert found.converged
    return row("adhesion", n, 0.001, cold, second, found.certificate.fft_pairs, seconds)


def row(
    what: str, n: int, load: float, cold: asp.ContactResult, second: float, pairs: float, seconds: float
) -> list[str]:
    """Cells of the table."""
    own = f"{cold.certificate.fft_pairs:.1f}"
    return [what, str(n), f"{load:g}", f"{second:.3f}", own, f"{pairs:.1f}", f"{seconds / second:.2f}"]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", type=int, nargs="+", default=[512, 1024], metavar="N")
    parser.add_argument("--loads", type=float, nargs="+", default=list(LOADS), metavar="P", help="over E*")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--repeats", type=int, default=3)
    add_option(parser)
    options = parser.parse_args()
    rows = []
    for n in options.sizes:
        rows += cases(n, options.seed, options.loads, options.repeats)
        rows.append(adhesive(n, options.repeats))
    show(made("around", COLUMNS, rows), write=options.write)
