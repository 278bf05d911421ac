"""All benchmarks, one after the other, each in a process of its own: tables and picture of
README.md anew.

Usage: python benchmarks/bench.py [NAME ...] [--full] [--list]; ``make bench`` runs it. A NAME is
that of a script. By default each has a size that takes seconds to a minute, ten minutes in all;
``--full`` measures as large as the tables are wanted, with other packages where they are installed,
for hours.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).parent

QUICK = (
    "run.py --sizes 256 512 1024 2048 4096 --threads 2 --peers",
    "accuracy.py",
    "memory.py",
    "paths.py",
    "around.py --sizes 512",
    "where_time_goes.py",
    "overheads.py --sizes 256 512 1024 --repeats 3",
    "layered.py --sizes 1024 --threads 2",
    "stress.py",
    "couplings.py",
    "viscoelastic.py --size 256",
    "frictional.py --sizes 512 --peer-sizes",
    "sealing.py --sizes 256 512",
    "heating.py --sizes 256 512",
    "conductance.py --sizes 512",
    "wear.py --sizes 256 512",
    "plastic_flow.py --points 128",
    "fem.py --across 40",
    "topography.py --sizes 512 1024",
    "generation.py --sizes 1024",
    "gold_film.py --peers",
    "motion.py --cases 100",
    "whole_wait.py --rounds 2",
    "explore.py",
    "output.py --rounds 1",
    "viewer.py",
)
"""Scripts and their options, in the order of README.md."""

FULL = (
    "run.py --sizes 256 512 1024 2048 4096 --threads 2 --peers",
    "run.py --sizes 256 512 1024 2048 --threads 2 --patience 2 --peers aspher aspher-matched",
    "run.py --sizes 512 1024 2048 --threads 1 --patience 2",
    "accuracy.py --sizes 512 1024",
    "memory.py --sizes 1024 2048 4096",
    "paths.py",
    "around.py",
    "where_time_goes.py --sizes 512 1024 2048",
    "overheads.py",
    "layered.py --sizes 512 1024 --repeats 7 --threads 2",
    "stress.py",
    "couplings.py",
    "viscoelastic.py",
    "frictional.py",
    "sealing.py",
    "heating.py",
    "conductance.py",
    "wear.py",
    "plastic_flow.py",
    "fem.py",
    "topography.py",
    "generation.py",
    "gold_film.py",
    "motion.py",
    "whole_wait.py",
    "explore.py --sizes 512 1024 2048",
    "output.py",
    "viewer.py",
)


def measured(command: str) -> bool:
    """Run a script, which writes its tables at its end; whether it ended well."""
    print(f"\n== python benchmarks/{command}", flush=True)
    began = time.perf_counter()
    script, *options = command.split()
    done = subprocess.run([sys.executable, str(HERE / script), *options, "--write"], cwd=HERE.parent, check=False)
    print(f"== {script}: {time.perf_counter() - began:.0f} s, exit code {done.returncode}", flush=True)
    return done.returncode == 0


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("names", nargs="*", help="scripts, with or without .py; all by default")
    parser.add_argument("--full", action="store_true", help="larger grids, and other packages where installed")
    parser.add_argument("--list", action="store_true", help="only show the commands")
    given = parser.parse_args()
    commands = FULL if given.full else QUICK
    known = {command.split(".py")[0] for command in commands}
    wanted = {name.removesuffix(".py") for name in given.names} or known
    if unknown := wanted - known:
        parser.error(f"no benchmark is called {', '.join(sorted(unknown))}; there are {', '.join(sorted(known))}.")
    chosen = [command for command in commands if command.split(".py")[0] in wanted]
    if given.list:
        print("\n".join(f"python benchmarks/{command}" for command in chosen))
        return 0
    os.environ.setdefault("MPLBACKEND", "Agg")
    failed = [command for command in chosen if not measured(command)]
    failed += (
        []
        if subprocess.run([sys.executable, str(HERE / "picture.py")], check=False).returncode == 0
        else ["picture.py"]
    )
    for command in failed:
        print(f"FAILED, its tables are those of before: python benchmarks/{command}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
