"""Adhesive contact beside the package Adhesion 0.93 in one run: the same rough periodic map,
exponential law and positions, values and processor time.

    python benchmarks/adhesive.py /path/to/an/environment/with/Adhesion/bin/python

Adhesion minimises the energy by L-BFGS-B; its periodic half-space holds the mean displacement by a
stiffness, here 3000 times that of the longest wave, so that forces agree to about 2e-4. Both start
from the displacement of the position before.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np
from tables import add_option, made, show

POINTS, SIZE, E_STAR, WORK, RANGE = 64, 6.4e-6, 9.2e6, 0.05, 45e-9
ONE_THREAD = {"PATH": "", "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
APPROACHES = (60e-9, 30e-9, 0.0, -30e-9, -60e-9, -90e-9)

THEIRS = """
import json, sys, time
import numpy as np
from ContactMechanics import PeriodicFFTElasticHalfSpace
from SurfaceTopography import Topography
from Adhesion.Interactions import Exponential
from Adhesion.System import BoundedSmoothContactSystem
heights, settings = np.load(sys.argv[1]), json.loads(sys.argv[2])
n, size, E, work, reach = (settings[key] for key in ("points", "size", "E_star", "work", "range"))
body = PeriodicFFTElasticHalfSpace((n, n), E, (size, size), stiffness_q0=3e3 * E * np.pi / size)
system = BoundedSmoothContactSystem(body, Exponential(work, reach), Topography(heights, (size, size), periodic=True))
start, found = None, []
for approach in settings["approaches"]:
    clock = time.process_time()
    options = dict(maxiter=3000, gtol=1e-5 * work / reach * (size / n) ** 2, ftol=0, maxcor=10)
    system.minimize_proxy(offset=approach - heights.max(), initial_displacements=start, lbounds="auto", options=options)
    start = np.asarray(system.disp).copy()
    found.append((float(system.compute_normal_force()), time.process_time() - clock))
print(json.dumps(found))
"""


def ours(heights: np.ndarray) -> list[tuple[float, float]]:
    """Force (N) and processor time (s) at each approach, each from the state before."""
    import asperity as asp

    body = asp.Elastic(E_STAR * (1.0 - 0.3**2), 0.3)
    law = asp.ExponentialAdhesion(WORK, RANGE)
    problem = asp.ContactProblem(asp.Surface(heights, SIZE / POINTS), body, adhesion=law)
    asp.solve(problem, asp.FixedGrips(APPROACHES[0]))  # compiles what is not compiled
    state, found = None, []
    for approach in APPROACHES:
        clock = time.process_time()
        result = asp.solve(problem, asp.FixedGrips(approach), state=state)
        state = result.state
        found.append((result.external_force, time.process_time() - clock))
    return found


def theirs(python: str, heights: np.ndarray) -> list[tuple[float, float]]:
    """The same by the package Adhesion under the interpreter ``python``."""
    settings = {"points": POINTS, "size": SIZE, "E_star": E_STAR, "work": WORK, "range": RANGE}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "heights.npy"
        np.save(path, heights)
        text = json.dumps(settings | {"approaches": APPROACHES})
        done = subprocess.run(
            [python, "-c", THEIRS, str(path), text], capture_output=True, text=True, check=True, env=ONE_THREAD
        )
    return [(force, seconds) for force, seconds in json.loads(done.stdout.splitlines()[-1])]


def main() -> None:
    """Both, ours once more after theirs."""
    import asperity as asp

    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("python", help="interpreter under which Adhesion is installed")
    add_option(parser)
    given = parser.parse_args()
    spectrum = asp.generate.GaussianAutocorrelation(45e-9, 1.1e-6)
    surface = asp.generate.gaussian(asp.Grid((POINTS, POINTS), (SIZE / POINTS, SIZE / POINTS)), spectrum, seed=3)
    heights = surface.heights - surface.heights.mean()
    first, peer, second = ours(heights), theirs(given.python, heights), ours(heights)
    rows = [
        [f"{approach * 1e9:.0f}", f"{force * 1e6:.5f}", f"{other * 1e6:.5f}", f"{force / other - 1.0:+.1e}"]
        + [f"{time:.3f}" for time in (seconds, again, took)]
        for approach, (force, seconds), (other, took), (_, again) in zip(APPROACHES, first, peer, second, strict=True)
    ]
    totals = (f"{sum(time for _, time in some):.2f}" for some in (first, second, peer))
    times = ("asperity (s)", "again (s)", "Adhesion (s)")
    columns = ("approach (nm)", "force, asperity (µN)", "force, Adhesion (µN)", "difference", *times)
    show(made("adhesive", columns, [*rows, ["all", "", "", "", *totals]]), write=given.write)


if __name__ == "__main__":
    main()
