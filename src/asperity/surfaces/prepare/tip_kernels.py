"""Compiled pass of the estimate of a tip from a scan."""

from __future__ import annotations

from typing import Any

from ...core.engine.compile import passes

_compiled: Any = passes()

_MOST_ROUNDS = 1000


@_compiled
def sharpen(heights, peaks, shape, noise):  # type: ignore[no-untyped-def]
    """Raise ``shape`` (2 i + 1, 2 j + 1), the lower bound of a tip in m above its apex, to what the
    ``peaks`` (n, 2) of ``heights`` (nx, ny) in m tell, less ``noise`` (m), until nothing changes.

    Heights are known within twice the half width of the tip around every peak.
    """
    half_x, half_y = shape.shape[0] // 2, shape.shape[1] // 2
    for _ in range(_MOST_ROUNDS):
        changed = False
        for peak in range(peaks.shape[0]):
            x, y = peaks[peak, 0], peaks[peak, 1]
            top = heights[x, y]
            for vx in range(-half_x, half_x + 1):
                for vy in range(-half_y, half_y + 1):
                    before = shape[vx + half_x, vy + half_y]
                    if top + before <= heights[x + vx, y + vy] + noise:  # may have touched there: no higher bound
                        continue
                    least = before + noise
                    bound = top + shape[half_x, half_y] - heights[x - vx, y - vy]
                    for ux in range(-half_x, half_x + 1):
                        if bound <= least:
                            break
                        for uy in range(-half_y, half_y + 1):
                            lifted = top + shape[ux + half_x, uy + half_y]
                            if lifted <= heights[x + ux, y + uy] + noise:
                                bound = min(bound, lifted - heights[x + ux - vx, y + uy - vy])
                    if bound > least and not (vx == 0 and vy == 0):
                        shape[vx + half_x, vy + half_y] = bound - noise
                        changed = True
        if not changed:
            return
