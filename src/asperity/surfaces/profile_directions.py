"""Two line scans in different directions of one surface: do they contradict its isotropy?"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.late import Shown
from ..core.units import show
from .characterise.correlation import DROP_1E, autocovariance
from .profile import Profile

_BLOCKS = 16  # consecutive parts of a scan whose scatter gives the error
_SHARES = (0.125, 0.25, 0.5)  # of the shorter correlation length: the lags
_LIMIT = 2.0  # standard errors that the logarithm of a ratio may be from zero
_SAME = 1e-3  # relative difference of spacings that are the same


@dataclass(frozen=True, eq=False)
class Directions(Shown):
    """Structure functions of two scans at three ``lag`` (m): ``ratio`` of the first to the second,
    and its relative ``error``.

    ``isotropic`` if no ratio is more than two errors from one; a failed test is proof of a lay, a
    passed one is not proof of isotropy.
    """

    lag: RealArray
    ratio: RealArray
    error: RealArray

    @property
    def isotropic(self) -> bool:
        """Whether the scans do not contradict isotropy."""
        return bool((np.abs(np.log(self.ratio)) <= _LIMIT * self.error).all())

    def in_words(self) -> tuple[str, list[tuple[str, str]]]:
        """Heading and the ratios."""
        rows = [
            (show(lag, "m", 3), f"{ratio:.3g} ± {ratio * error:.2g}")
            for lag, ratio, error in zip(self.lag, self.ratio, self.error, strict=True)
        ]
        return f"Two directions, {'no' if self.isotropic else 'a'} contradiction to isotropy", rows


def compared_directions(first: Profile, second: Profile) -> Directions:
    """Compare the structure functions of two scans in different directions at three lags within the
    correlation length.

    The errors are the scatter of sixteen consecutive parts of each scan, whose roughness should be
    much shorter than a part. Raises InputError if the spacings differ, or a scan is flat or too
    short.
    """
    if abs(first.spacing - second.spacing) > _SAME * first.spacing:
        raise InputError(
            f"scans to be compared must have the same spacing, but have {show(first.spacing, 'm')} and "
            f"{show(second.spacing, 'm')}. Resample one of them."
        )
    lengths = [autocovariance(scan).correlation_length(DROP_1E) for scan in (first, second)]
    known = [length for length in lengths if length > 0.0]
    longest = min(known, default=0.1 * min(first.length, second.length))
    steps = sorted({max(1, round(share * longest / first.spacing)) for share in _SHARES})
    found = [[_structure(scan, step) for step in steps] for scan in (first, second)]
    ratios = np.array([a[0] / b[0] for a, b in zip(*found, strict=True)])
    errors = np.array([math.hypot(a[1], b[1]) for a, b in zip(*found, strict=True)])
    return Directions(first.spacing * np.array(steps, dtype=float), ratios, errors)


def _structure(scan: Profile, step: int) -> tuple[float, float]:
    """Mean square difference over ``step`` points in m², and its relative standard error from the
    parts of the scan."""
    heights = scan.heights.astype(np.float64)
    squares = np.square(heights[step:] - heights[:-step])
    parts = [part[~np.isnan(part)] for part in np.array_split(squares, _BLOCKS)]
    means = np.array([part.mean() for part in parts if part.size])
    if means.size < _BLOCKS // 2 or not means.mean() > 0.0:
        raise InputError(
            f"scan to be compared must have at least {_BLOCKS} differences over {step} points that are not all "
            "zero, but has not. Take a longer one."
        )
    return float(means.mean()), float(means.std(ddof=1) / math.sqrt(means.size) / means.mean())
