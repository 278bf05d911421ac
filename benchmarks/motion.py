"""Sliding blocks: a sweep of many cases, and the energy of a long vibration:
``python benchmarks/motion.py --cases 1000 --workers 2``.

Each case of the sweep is a flutter of 60 ms (some 350 periods) of a block at another speed, from
just below sliding, in a pool of processes.
"""

from __future__ import annotations

import argparse
import math
import time
from concurrent.futures import ProcessPoolExecutor

import numpy as np
from tables import add_option, made, show

from asperity import dynamics as dyn
from asperity.theories import free_vibration

LAW = dyn.NormalCompliance.amontons(2.8e18, 2.0, friction=0.4, relative_damping=20.0)
BLOCK = dyn.SlidingBlock(LAW, 1.0, 0.1, 0.02, 0.05, 100.0, stiffness=2e5, speed=1e-3, damping=40.0)


def sweep(cases: int, workers: int) -> list[str]:
    """Time of a sweep over the speed."""
    speeds = np.geomspace(2e-4, 1e-2, cases)
    start = time.perf_counter()
    with ProcessPoolExecutor(workers) as pool:
        found = dyn.sweep_block(BLOCK, "speed", list(speeds), duration=0.06, mapper=pool.map)
    took, lowest = time.perf_counter() - start, float(np.nanmin(found.numbers["friction_reduction"]))
    state = f"{len(found.failures)} failed, lowest mean friction / μ {lowest:.3f}"
    return [f"{cases} blocks of 60 ms, {workers} processes", f"{took:.1f}", state]


def vibration() -> list[str]:
    """Energy error of a thousand periods."""
    joint = dyn.NormalOscillator(dyn.NormalCompliance.amontons(2.8e18, 2.0), 1.0, 2e-3, 100.0)
    period = float(free_vibration(2.0, 1.5).period_ratio) * 2.0 * math.pi / joint.natural_frequency
    start = time.process_time()
    motion = joint.move(1000.0 * period, start=(1.5 * joint.rest, 0.0), samples=7000, tolerance=1e-12)
    took, energy = time.process_time() - start, motion["kinetic_energy"] + motion["elastic_energy"]
    error = float(np.ptp(energy) / np.ptp(motion["kinetic_energy"]))
    return ["1000 periods of an undamped vibration", f"{took:.1f}", f"energy to {error:.1e}"]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=1000)
    parser.add_argument("--workers", type=int, default=2)
    add_option(parser)
    options = parser.parse_args()
    rows = [vibration(), sweep(options.cases, options.workers)]
    show(made("motion", ("work", "s", "outcome"), rows), write=options.write)
