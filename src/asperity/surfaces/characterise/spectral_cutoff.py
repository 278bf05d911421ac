"""The wavenumber beyond which a spectrum vanishes, as that of a generated or filtered surface does."""

from __future__ import annotations

import math

import numpy as np

from .spectrum import PowerSpectrum, RadialSpectrum

_RINGS = 8  # over which the spectrum is extrapolated
_DROP = 0.02  # share of the extrapolation below which all of the rest must lie


def short_cutoff(spectrum: PowerSpectrum, rings: RadialSpectrum) -> float:
    """Wavenumber in rad/m of the last mode before the spectrum drops to nothing; NaN if it does not.

    The drop is where all further rings lie below 2 % of the power law through the eight rings before: by the scatter of
    a periodogram, rings of some modes never do. The wavenumber is that of the last single mode above this level.
    """
    with np.errstate(divide="ignore"):
        log_q, log_c = np.log(rings.q), np.log(rings.psd)
    for ring in range(_RINGS, rings.q.size - 1):
        before = slice(ring - _RINGS, ring)
        slope, level = np.polyfit(log_q[before] - log_q[ring], log_c[before], 1)
        after = slice(ring + 1, None)  # the cut-off may lie within the ring itself
        if np.all(log_c[after] < level + slope * (log_q[after] - log_q[ring]) + math.log(_DROP)):
            return _last_mode(spectrum, rings, ring, (slope, level - slope * log_q[ring]))
    return math.nan


def _last_mode(spectrum: PowerSpectrum, rings: RadialSpectrum, ring: int, law: tuple[float, float]) -> float:
    q = spectrum.grid.wavenumber()
    near = (q > rings.low[ring - 1]) & (q <= rings.high[ring])
    expected = np.exp(law[1] + law[0] * np.log(q[near]))
    above = q[near][spectrum.psd[near] > _DROP * expected]
    return float(above.max(initial=rings.high[ring - 1]))
