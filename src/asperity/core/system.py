"""What the operating system says about this process."""

from __future__ import annotations

import importlib.util
import math
import os
import sys
from pathlib import Path


def peak_memory() -> float:
    """Largest resident memory of the process so far in bytes; NaN where the system does not tell (Windows)."""
    if importlib.util.find_spec("resource") is None:
        return math.nan
    import resource

    unit = 1 if sys.platform == "darwin" else 1024
    return float(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit)


def free_memory() -> float:
    """Bytes of memory that new work may take; infinite where the system does not tell (Windows, macOS)."""
    try:
        lines = Path("/proc/meminfo").read_text(encoding="ascii").splitlines()
        return next(1024.0 * float(line.split()[1]) for line in lines if line.startswith("MemAvailable"))
    except (OSError, StopIteration):
        names = getattr(os, "sysconf_names", {})
        known = "SC_AVPHYS_PAGES" in names and "SC_PAGE_SIZE" in names
        return float(os.sysconf("SC_AVPHYS_PAGES")) * float(os.sysconf("SC_PAGE_SIZE")) if known else math.inf


def compiling() -> bool:
    """Whether this thread is inside the compiler of the passes: an exception raised there by a signal may crash it."""
    lock = sys.modules.get("numba.core.compiler_lock")
    return lock is not None and bool(lock.global_compiler_lock.is_locked())
