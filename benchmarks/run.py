"""Our solvers, a bare FFT pair and other packages on the same surfaces in one interleaved run.

Usage: python benchmarks/run.py [--sizes 256 512 1024] [--threads 2] [--repeats 3] [--out folder]
[--write] Ends with an error if the solvers do not agree on contact area and pressure.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from measure import Rounds, Row, problem_rows
from ours import SOLVERS
from peers import PEERS, installed
from report import COLUMNS, HEADER, cells, line, machine, write
from surfaces import LOADS, self_affine
from tables import Table, add_option, made, show
from worker import Worker, start

from asperity.core.spectral import thread_count


def options() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=[256, 512, 1024], help="points per side")
    parser.add_argument("--loads", type=float, nargs="+", default=list(LOADS), help="mean pressure over E*")
    parser.add_argument("--threads", type=int, default=thread_count(), help="threads of every solver (all cores)")
    parser.add_argument("--repeats", type=int, default=3, help="rounds")
    parser.add_argument("--patience", type=float, default=20.0, help="do not repeat what took longer (s)")
    parser.add_argument("--tolerance", type=float, default=1e-6, help="the field's error")
    parser.add_argument("--peers", nargs="*", choices=PEERS, default=list(PEERS), help="other packages")
    parser.add_argument("--solvers", nargs="+", choices=list(SOLVERS), default=["asperity"], help="ours")
    parser.add_argument("--out", type=Path, help="folder for bench.json and bench.csv, with every time and count")
    add_option(parser)
    return parser.parse_args()


def workers(solvers: list[str], peers: list[str], threads: int) -> list[Worker]:
    """One process for each solver there is; the others are named, never left out in silence."""
    started = [start(kind, threads) for kind in solvers]
    for peer in peers:
        if installed(peer):
            started.append(start(peer, threads))
        else:
            print(f"{peer}: not installed (pip install 'asperity[bench]'; see benchmarks/README.md)")
    return started


def compare(given: argparse.Namespace, solvers: list[Worker], pair: Worker) -> list[Row]:
    """All problems, printed as they come."""
    rounds = Rounds(given.repeats, given.patience, given.tolerance)
    rows = []
    print(HEADER)
    for n in given.sizes:
        heights = np.array(self_affine(n).heights)
        for load in given.loads:
            new = problem_rows(solvers, pair, heights, load, rounds)
            rows += new
            print("\n".join(line(row) for row in new), flush=True)
        print(f"{n:>5}       bare FFT pair {1e3 * new[0].pair_seconds:.2f} ms", flush=True)
    return rows


def table(rows: list[Row], solvers: list[Worker], ours: int, threads: int) -> Table:
    """Everything as one table; that of asperity alone does not replace one with other packages."""
    others = [f"{worker.name} {worker.version}" for worker in solvers[ours:]]
    name = "solves" if not others else "packages" if threads > 1 else "packages-one-thread"
    found = made(name, COLUMNS, map(cells, rows))
    return replace(found, machine=", ".join([found.machine, *others]))


def main() -> int:
    given = options()
    about = machine() | {"tolerance": given.tolerance, "threads": given.threads}
    print(", ".join(f"{key} {value}" for key, value in about.items()))
    pair = start("fft pair", given.threads)
    solvers = workers(given.solvers, given.peers, given.threads)
    about["solvers"] = {worker.name: f"{worker.version}, {worker.threads} thread(s)" for worker in solvers}
    print("\n".join(f"{name}: {text}" for name, text in about["solvers"].items()))
    print(f"fft pair: {pair.version}, {pair.threads} thread(s)")
    rows = compare(given, solvers, pair)
    for worker in (pair, *solvers):
        worker.close()
    if given.out:
        write(given.out, rows, about)
    faults = [row for row in rows if row.fault]
    found = table(rows, solvers, len(given.solvers), given.threads)
    show(found, write=given.write and not faults)
    for row in faults:
        print(f"DISAGREES: {row.solver}, {row.n}², load {row.load}: {row.fault}", file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
