"""What a person waits for: start-up, reading, a whole command, its pictures, as processor time and
by the clock, and the first compilation.

Every row is a fresh process, measured with all its children, in rounds that do all rows once; the
smallest of the rounds counts, of processor time (user and system) and of the clock. Pictures are
drawn by several processes, so that the clock shows less than the processors work. Python keeps its
compiled modules in a folder of the run, whatever the environment says, so that they are compiled
once, as in an installed package.

Usage: python benchmarks/whole_wait.py [SCAN] [--rounds 5] [--fresh 1] [--json FILE] [--write]
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from tables import add_option, made, show

BASE = "import numpy, scipy.fft, numba, h5py"
PICTURES = f"{BASE}, xarray, matplotlib.pyplot"
SPENT = """
import os, sys, time
def spent():
    return sum(os.times()[:4]), time.perf_counter()
def told(started):
    print(*(end - start for start, end in zip(started, spent())))
"""
READ = f"""{BASE}{SPENT}
import asperity as asp
asp.read  # the module, its own imports
started = spent()
asp.read(sys.argv[1])
told(started)
"""
DRAW = f"""{PICTURES}{SPENT}
import tempfile
from pathlib import Path
from asperity.plots.together import save_pictures
from asperity.report import write_report
from asperity.run.document import loads
from asperity.run.run import run
outcome = run(loads(Path(sys.argv[1]).read_text()), Path(sys.argv[1]).parent)
started = spent()
with tempfile.TemporaryDirectory() as folder:
    save_pictures(outcome.all_figures, Path(folder))
    write_report(outcome, Path(folder) / "report.html")
told(started)
"""
CONTACT = ("--body", "DLC", "--pressure", "50MPa")
COATED = ["--body", "DLC:5nm/steel", "--periodise", "--pressure", "50MPa", "--friction", "0.3", "--section", "y=max"]


class Wait(NamedTuple):
    """Processor time and time by the clock, in s."""

    processor: float
    clock: float

    def least(self, other: Wait) -> Wait:
        """The smaller of both times."""
        return Wait(min(self.processor, other.processor), min(self.clock, other.clock))


def waited(command: Sequence[str], variables: Mapping[str, str]) -> tuple[Wait, str]:
    """Time of ``command`` and its children, and what it prints."""
    with tempfile.TemporaryFile("w+") as printed:
        started = time.perf_counter()
        process = subprocess.Popen(command, stdout=printed, env=variables)
        _, status, usage = os.wait4(process.pid, 0)
        clock = time.perf_counter() - started
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            raise SystemExit(f"{' '.join(command)} ended with exit code {process.returncode}.")
        printed.seek(0)
        return Wait(usage.ru_utime + usage.ru_stime, clock), printed.read()


def write_scan(path: Path, n: int = 512) -> None:
    """A self-affine map of 20 nm rms on 10 µm in a format of instruments (BCR-STM)."""
    random = np.random.default_rng(1)
    q = np.hypot(np.fft.fftfreq(n)[:, None], np.fft.rfftfreq(n)[None, :])
    amplitude = np.where((q > 4 / n) & (q < 1 / 8), np.maximum(q, 1 / n) ** -1.8, 0.0)
    heights = np.fft.irfft2(amplitude * np.fft.rfft2(random.standard_normal((n, n))), (n, n))
    steps = np.round(20.0 / 0.01 * heights / heights.std()).astype("<i2")
    header = f"fileformat = bcrstm\nheadersize = 2048\nxpixels = {n}\nypixels = {n}\nxlength = 10000\nylength = 10000\n"
    header += "xunit = nm\nyunit = nm\nzunit = nm\nbit2nm = 0.01\nxoffset = 0\nyoffset = 0\nintelmode = 1\n"
    path.write_bytes(header.encode().ljust(2048, b" ") + steps.tobytes())


def rows(scan: Path, folder: Path) -> dict[str, tuple[list[str], bool]]:
    """Command of each row, and whether it prints its own time."""
    python, asperity = [sys.executable, "-c"], [sys.executable, "-m", "asperity"]
    document, out = str(folder / "problem.toml"), str(folder / "out")
    return {
        "imports": ([*python, BASE], False),
        "imports with pictures": ([*python, PICTURES], False),
        "info": ([*asperity, "info", str(scan)], False),
        "contact": ([*asperity, "contact", str(scan), *CONTACT], False),
        "coated contact, everything": ([*asperity, "contact", str(scan), *COATED, "--out", out, "--force"], False),
        "reading": ([*python, READ, str(scan)], True),
        "report and pictures": ([*python, DRAW, document], True),
    }


def environment(folder: Path, **more: str) -> dict[str, str]:
    """Variables of every process, whose compiled modules lie in ``folder``."""
    kept = {key: text for key, text in os.environ.items() if key != "PYTHONDONTWRITEBYTECODE"}
    return {**kept, "PYTHONPYCACHEPREFIX": str(folder), **more}


def measured(scan: Path, rounds: int, modules: Path) -> dict[str, Wait]:
    """Smallest times of each row, after a first round that is not counted."""
    best: dict[str, Wait] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        written = [sys.executable, "-m", "asperity", "contact", str(scan), *COATED]
        waited([*written, "--save-document", str(folder / "problem.toml")], environment(modules))
        for turn in range(rounds + 1):
            for row, (command, own) in rows(scan, folder).items():
                wait, printed = waited(command, environment(modules))
                wait = Wait(*map(float, printed.split())) if own else wait
                best[row] = wait.least(best[row]) if turn > 1 else wait
    return best


def first_result(scan: Path, modules: Path) -> float:
    """Time in s from the start to the end of a contact for which every kernel must be compiled, on
    two processes."""
    command = [sys.executable, "-m", "asperity", "contact", str(scan), *CONTACT]
    # the second process may still write there when the contact has ended
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as name:
        return waited(command, environment(modules, NUMBA_CACHE_DIR=name))[0].clock


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("scan", nargs="?", type=Path, help="file of an instrument; made by default")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--fresh", type=int, default=1, help="contacts with all kernels to compile")
    parser.add_argument("--json", type=Path, help="file for the seconds of each row")
    add_option(parser)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        scan = given.scan or Path(folder) / "scan.bcr"
        if given.scan is None:
            write_scan(scan)
        best = measured(scan, given.rounds, Path(folder))
        first = [first_result(scan, Path(folder)) for _ in range(given.fresh)]
    over = {"info": "imports", "contact": "imports", "coated contact, everything": "imports with pictures"}
    rows = []
    for row, wait in best.items():
        base = best[over[row]] if row in over else None
        ratios = [f"{own / other:.2f}" for own, other in zip(wait, base, strict=True)] if base else ["", ""]
        rows.append([row, f"{wait.processor:.2f}", f"{wait.clock:.2f}", *ratios, over.get(row, "")])
    if first:
        rows.append(["first contact, all compiled", "", f"{min(first):.2f}", "", "", ""])
    columns = ("what", "processor (s)", "clock (s)", "processor, over", "clock, over", "these")
    show(made("whole-wait", columns, rows), write=given.write)
    if given.json:
        found = {row: wait._asdict() for row, wait in best.items()} | {"first contact": {"clock": first}}
        given.json.write_text(json.dumps(found, indent=2) + "\n")


if __name__ == "__main__":
    main()
