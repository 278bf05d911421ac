"""What the operating system says about this process."""

from __future__ import annotations

import importlib.util
import math
import sys


def peak_memory() -> float:
    """Largest resident memory of the process so far in bytes; NaN where the system does not tell (Windows)."""
    if importlib.util.find_spec("resource") is None:
        return math.nan
    import resource

    unit = 1 if sys.platform == "darwin" else 1024
    return float(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit)
