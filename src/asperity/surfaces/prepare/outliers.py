"""Spikes of an instrument are masked; offsets between its scan lines are removed."""

from __future__ import annotations

import numpy as np

from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.errors import InputError
from ...core.units import show
from ..surface import Surface
from .steps import recorded

_NORMAL = 1.482602218505602  # standard deviation of a normal distribution over its median absolute deviation
_BLOCK = 1 << 18  # nodes whose windows are sorted together, to bound the memory


def despiked(surface: Surface, threshold: float = 6.0, *, window: int = 5) -> Surface:
    """Surface whose spikes are missing points: nodes far from the median of their ``window`` x ``window`` neighbourhood.

    Far is more than ``threshold`` standard deviations of these distances, estimated from their median (1.4826 MAD), which
    spikes do not move. Fill the points afterwards, or leave them out. Heights are never clipped.

    Parameters
    ----------
    surface
        Surface; missing points take no part.
    threshold
        Standard deviations, greater than zero.
    window
        Odd number of nodes along a side, at least 3.

    Raises
    ------
    InputError
        If a value is out of range.
    """
    threshold = require.positive(threshold, "threshold of spikes (standard deviations)")
    window = require.integer(window, 3, "window of spikes (nodes)")
    if window % 2 == 0:
        raise InputError(f"window of spikes must be an odd number of nodes, but is {window}.")
    distance = np.abs(surface.heights.astype(np.float64) - _local_median(surface, window))
    valid = ~surface.mask
    scale = _NORMAL * float(np.median(distance[valid]))
    if scale == 0.0:  # more than half of the nodes are at their median, as on coarsely digitised maps
        scale = float(np.sqrt(np.mean(np.square(distance[valid]))))
    spikes = valid & (distance > threshold * scale)
    count = int(np.count_nonzero(spikes))
    limit = show(threshold * scale, "m", 3)
    step = f"despiked: {count} points more than {limit} from the median of {window} x {window} points masked"
    heights = np.where(spikes, np.nan, surface.heights)
    return recorded(surface, heights, step, periodic=surface.periodic)


def line_corrected(surface: Surface, axis: str = "x") -> Surface:
    """Surface without the offsets between scan lines: the lines run along the fast ``axis`` of the instrument.

    From each line the median of its differences to the line before is removed, summed up from the first line on. All that
    varies across the lines alone goes with the offsets; spectra and slopes along the lines are not touched.

    Raises
    ------
    InputError
        If the axis is not ``x`` or ``y``.
    """
    require.one_of(axis, ("x", "y"), "fast axis of the scan lines")
    lines = surface.heights.astype(np.float64)
    lines = lines if axis == "x" else lines.T  # lines[:, j] is one scan line
    steps = np.array([_median(lines[:, j] - lines[:, j - 1]) for j in range(1, lines.shape[1])])
    offsets = np.concatenate([[0.0], np.cumsum(steps)])
    offsets -= offsets.mean()
    corrected = lines - offsets[None, :]
    text = f"line-corrected: offsets between lines along {axis} (rms {show(float(offsets.std()), 'm', 3)}) removed"
    return recorded(surface, corrected if axis == "x" else corrected.T, text, periodic=surface.periodic)


def _median(values: RealArray) -> float:
    """Median of the numbers among ``values``, 0 if there are none."""
    numbers = values[~np.isnan(values)]
    return float(np.median(numbers)) if numbers.size else 0.0


def _local_median(surface: Surface, window: int) -> RealArray:
    """Median of the valid heights around every node (nx, ny) in m; NaN where there are none."""
    half = window // 2
    heights = surface.heights.astype(np.float64)
    mode = {"mode": "wrap"} if surface.periodic else {"mode": "constant", "constant_values": np.nan}
    padded = np.pad(heights, half, **mode)
    median = np.empty(heights.shape)
    rows = max(1, _BLOCK // (window**2 * heights.shape[1]))
    for start in range(0, heights.shape[0], rows):
        end = min(start + rows, heights.shape[0])
        block = np.lib.stride_tricks.sliding_window_view(padded[start : end + 2 * half], (window, window))
        values = np.sort(block.reshape(end - start, heights.shape[1], window**2), axis=-1)  # NaN last
        valid = np.count_nonzero(~np.isnan(values), axis=-1)
        median[start:end] = 0.5 * (_taken(values, (valid - 1) // 2) + _taken(values, valid // 2))
        median[start:end][valid == 0] = np.nan
    return median


def _taken(values: RealArray, index: RealArray | BoolArray) -> RealArray:
    at = np.clip(index, 0, values.shape[-1] - 1)[..., None].astype(np.intp)
    taken: RealArray = np.take_along_axis(values, at, axis=-1)[..., 0]
    return taken
