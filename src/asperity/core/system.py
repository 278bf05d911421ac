"""What the operating system says about this process."""

from __future__ import annotations

import importlib.util
import math
import os
import sys


def peak_memory() -> float:
    """Largest resident memory of the process so far in bytes; NaN where the system does not tell (Windows)."""
    if importlib.util.find_spec("resource") is None:
        return math.nan
    import resource

    unit = 1 if sys.platform == "darwin" else 1024
    return float(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit)


def free_memory() -> float:
    """Free memory of the machine in bytes; infinite where the system does not tell (Windows, macOS)."""
    names = getattr(os, "sysconf_names", {})
    if "SC_AVPHYS_PAGES" not in names or "SC_PAGE_SIZE" not in names:
        return math.inf
    return float(os.sysconf("SC_AVPHYS_PAGES")) * float(os.sysconf("SC_PAGE_SIZE"))


def compiling() -> bool:
    """Whether this thread is inside the compiler of the passes: an exception raised there by a signal may crash it."""
    lock = sys.modules.get("numba.core.compiler_lock")
    return lock is not None and bool(lock.global_compiler_lock.is_locked())
