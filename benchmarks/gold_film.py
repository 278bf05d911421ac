"""The gold film of examples/campaigns/gold_film_area.toml: what 1000 surfaces at 12 loads cost,
ours and other packages'.

Usage: python benchmarks/gold_film.py [--surfaces 3] [--peers tamaas contactmechanics]. One thread
each. Ours is the whole work of a worker on a surface (generated, solved along its loads, measured);
of the others one solve at the middle load is timed.
"""

from __future__ import annotations

import argparse
import time
import tomllib
from pathlib import Path

import numpy as np
from peers import installed, make
from tables import add_option, made, show

import asperity as asp
from asperity.run.build import Case, build
from asperity.run.document import checked

STUDY = Path(__file__).parents[1] / "examples" / "campaigns" / "gold_film_area.toml"
PIXEL = 1.5e-6 / 512
E_STAR = 100e9
LOADS = np.linspace(0.002, 0.024, 12)
SURFACES = 1000
PEERS = ("tamaas", "contactmechanics", "aspher")


def case(seed: int, tolerance: float) -> Case:
    """One surface of the study."""
    problem = tomllib.loads(STUDY.read_text(encoding="utf-8"))["problem"]
    problem["surface"]["seed"] = seed
    problem["solver"] = {"tolerance": tolerance}
    return build(checked(problem))


def ours(seed: int, tolerance: float) -> float:
    """Processor seconds for the surface ``seed`` with all its loads."""
    started = time.process_time()
    made = case(seed, tolerance)
    controls = [asp.MeanPressure(E_STAR * float(load)) for load in LOADS]
    asp.solve(made.problem, asp.History(controls), solver=made.solver, engine=asp.engines.CpuEngine(1))
    return time.process_time() - started


def theirs(peer: str, tolerance: float) -> float:
    """Processor seconds of ``peer`` for one solve at the middle load."""
    method = make(peer, 1)
    heights = np.array(case(1, tolerance).problem.profile()) / PIXEL
    method.solve(heights[::8, ::8].copy(), float(LOADS[5]), 1e-2)  # imports and plans
    started = time.process_time()
    method.solve(heights, float(LOADS[5]), tolerance)
    return time.process_time() - started


def minutes(seconds: float) -> float:
    """Minutes for the whole campaign on two cores at so many ``seconds`` for one surface."""
    return SURFACES * seconds / 2.0 / 60.0


def main() -> None:
    """Print one line for each tolerance and package."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--surfaces", type=int, default=3, help="of which the least time counts")
    parser.add_argument("--tolerances", type=float, nargs="+", default=[1e-7, 1e-5], help="the field's error")
    parser.add_argument("--peers", nargs="*", choices=PEERS, default=list(PEERS), help="other packages")
    add_option(parser)
    given = parser.parse_args()
    ours(0, 1e-2)
    rows = []
    for tolerance in given.tolerances:
        spent = min(ours(seed, tolerance) for seed in range(1, given.surfaces + 1))
        rows.append(["asperity", f"{tolerance:.0e}", f"{spent:.2f}", f"{minutes(spent):.0f}"])
        for peer in given.peers:
            if not installed(peer):
                print(f"{tolerance:.0e} {peer}: not installed (pip install 'asperity[bench]')")
                continue
            one = theirs(peer, tolerance)
            each, total = f"{LOADS.size} × {one:.2f}", f"{minutes(LOADS.size * one):.0f}"
            rows.append([peer, f"{tolerance:.0e}", each, total])
    columns = ("package", "tolerance", "one surface (s)", "1000 surfaces, two cores (min)")
    others = any(row[0] != "asperity" for row in rows)
    show(made("campaign-packages" if others else "campaign", columns, rows), write=given.write)


if __name__ == "__main__":
    main()
