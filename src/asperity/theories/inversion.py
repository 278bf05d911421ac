"""The separation at which a theory carries a given pressure."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import InputError

PressureAndStiffness: TypeAlias = Callable[[RealArray], tuple[RealArray, RealArray]]
"""Pressure p and -dp/dh at separations h, all (n,)."""

_TABLE = 65  # separations at which the pressure is tabulated for a start
_STEPS = 60  # bisections alone would find a double in these
_SQUARED = 1e-8  # a Newton step so small leaves its square, which is rounding
_ROUNDING = 4e-15


def separation_at(pressure: RealArray, law: PressureAndStiffness, low: float, high: float, *, unit: float) -> RealArray:
    """Separations (n,) in m at which a falling ``law`` has the given ``pressure`` (n,) in Pa.

    Newton steps on ln p, which is nearly straight or parabolic for most theories, kept within brackets from a table.

    Parameters
    ----------
    pressure
        (n,) in Pa, positive.
    law
        Pressure and stiffness at given separations; the pressure must not rise with the separation.
    low, high
        Separations in m between which the answer is sought.
    unit
        Length in m on which the pressure changes; sets the accuracy.

    Raises
    ------
    InputError
        If a pressure lies beyond those at ``low`` and ``high``.
    """
    table = np.linspace(low, high, _TABLE)
    logs = _log(law(table)[0])
    wanted = np.log(pressure)
    if wanted.max() > logs[0] or wanted.min() < logs[-1]:
        raise InputError(
            f"pressures must lie between {np.exp(logs[-1]):.4g} and {np.exp(logs[0]):.4g} Pa, where this theory is "
            f"evaluated, but go from {pressure.min():.4g} to {pressure.max():.4g} Pa."
        )
    cell = np.clip(np.searchsorted(-logs, -wanted) - 1, 0, _TABLE - 2)
    below, above = table[cell], table[cell + 1]
    with np.errstate(divide="ignore", invalid="ignore"):
        share = (logs[cell] - wanted) / (logs[cell] - logs[cell + 1])
    h = below + np.where(np.isfinite(share), share, 0.5) * (above - below)
    for _ in range(_STEPS):
        p, stiffness = law(h)
        excess = _log(p) - wanted
        below, above = np.where(excess >= 0.0, h, below), np.where(excess <= 0.0, h, above)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = h + excess * p / stiffness
        inside = (step >= below) & (step <= above)
        new = np.where(inside, step, 0.5 * (below + above))
        change, h = np.abs(new - h), new
        if np.all((inside & (change <= _SQUARED * unit)) | (change <= _ROUNDING * (unit + np.abs(h)))):
            break
    return h


def _log(values: RealArray) -> RealArray:
    with np.errstate(divide="ignore"):
        logs: RealArray = np.log(values)
    return logs
