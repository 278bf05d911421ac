"""What a person waits for: start-up, reading, a whole command, its pictures, as processor time, and the first compilation by the clock.

Every row is a fresh process, measured by the system with all its children (user and system time), in rounds that do all rows once; the
smallest of the rounds counts. Times inside a process are those of its own clock of processor time. Python keeps its compiled
modules in a folder of the run, whatever the environment says, so that they are compiled once, as in an installed package.

Usage: python benchmarks/whole_wait.py [SCAN] [--rounds 5] [--fresh 1] [--json FILE]
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

import numpy as np

BASE = "import numpy, scipy.fft, numba, h5py"
PICTURES = f"{BASE}, xarray, matplotlib.pyplot"
READ = f"""{BASE}
import sys, time
import asperity as asp
asp.read  # the module, its own imports
started = time.process_time()
asp.read(sys.argv[1])
print(time.process_time() - started)
"""
DRAW = f"""{PICTURES}
import itertools, sys, tempfile, time
from pathlib import Path
from asperity.report import write_report
from asperity.run.document import loads
from asperity.run.execute import run
outcome = run(loads(Path(sys.argv[1]).read_text()), Path(sys.argv[1]).parent)
started = time.process_time()
with tempfile.TemporaryDirectory() as folder:
    for figure in itertools.chain(outcome.pictures, *outcome.figures.values()):
        (Path(folder) / figure.name).write_bytes(figure.picture)
    write_report(outcome, Path(folder) / "report.html")
print(time.process_time() - started)
"""
CONTACT = ("--body", "DLC", "--pressure", "50MPa")
COATED = ["--body", "DLC:5nm/steel", "--periodise", "--pressure", "50MPa", "--friction", "0.3", "--section", "y=max"]


def processor_seconds(command: Sequence[str], variables: Mapping[str, str]) -> tuple[float, str]:
    """User and system time of ``command`` and its children, and what it prints."""
    with tempfile.TemporaryFile("w+") as printed:
        process = subprocess.Popen(command, stdout=printed, env=variables)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            raise SystemExit(f"{' '.join(command)} ended with exit code {process.returncode}.")
        printed.seek(0)
        return usage.ru_utime + usage.ru_stime, printed.read()


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


def measured(scan: Path, rounds: int, modules: Path) -> dict[str, float]:
    """Smallest processor time of each row in s, after a first round that is not counted."""
    best: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        written = [sys.executable, "-m", "asperity", "contact", str(scan), *COATED]
        processor_seconds([*written, "--save-document", str(folder / "problem.toml")], environment(modules))
        for turn in range(rounds + 1):
            for row, (command, own) in rows(scan, folder).items():
                seconds, printed = processor_seconds(command, environment(modules))
                seconds = float(printed) if own else seconds
                best[row] = min(best.get(row, seconds), seconds) if turn > 1 else seconds
    return best


def first_result(scan: Path, modules: Path) -> float:
    """Time in s from the start to the end of a contact for which every kernel must be compiled, on two processes."""
    command = [sys.executable, "-m", "asperity", "contact", str(scan), *CONTACT]
    # the second process may still write there when the contact has ended
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as name:
        started = time.perf_counter()
        processor_seconds(command, environment(modules, NUMBA_CACHE_DIR=name))
        return time.perf_counter() - started


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("scan", nargs="?", type=Path, help="file of an instrument; made by default")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--fresh", type=int, default=1, help="contacts with all kernels to compile")
    parser.add_argument("--json", type=Path, help="file for the seconds of each row")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        scan = given.scan or Path(folder) / "scan.bcr"
        if given.scan is None:
            write_scan(scan)
        best = measured(scan, given.rounds, Path(folder))
        if given.fresh:
            best["first contact, kernels compiled, by the clock"] = min(
                first_result(scan, Path(folder)) for _ in range(given.fresh)
            )
    over = {"info": "imports", "contact": "imports", "coated contact, everything": "imports with pictures"}
    for row, seconds in best.items():
        ratio = f"{seconds / best[over[row]]:8.2f} times the {over[row]}" if row in over else ""
        print(f"{row:<47}{seconds:8.3f} s{ratio}")
    if given.json:
        given.json.write_text(json.dumps(best, indent=2) + "\n")


if __name__ == "__main__":
    main()
