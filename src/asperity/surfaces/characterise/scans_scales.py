"""Height, slope and curvature of a surface against the length they are measured over, from many
scans."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.arrays import RealArray
from ...core.spectral import linear_autocorrelation
from .correlation import geometric_lags
from .scans_corners import Corner

QUANTITIES = ("height", "slope", "curvature")
"""Rms height (m) in windows less their line, rms slope, and rms curvature (1/m)."""

_ORDER = {"height": 0, "slope": 1, "curvature": 2}
_PER_DECADE = 10
_LONGEST = 4  # lengths of the longest stencil or window in a line
_FEWEST = 3  # independent lines or maps for an error
_LEAST_WINDOW = 8  # points


@dataclass(frozen=True, eq=False)
class ScaleCurve:
    """A rms quantity of profiles against the length ``length`` ℓ in m (n,), rising.

    ``quantity`` height, slope or curvature; ``value`` in m, 1 or 1/m; ``error`` relative standard
    error from the scatter of lines and maps, NaN where there are fewer than three; ``expected`` by
    the fitted spectrum of the scans, of point samples; ``lines`` number of lines and maps.
    """

    quantity: str
    length: RealArray
    value: RealArray
    error: RealArray
    expected: RealArray
    lines: RealArray
    citation_keys: ClassVar[tuple[str, ...]] = ("Sanner2022",)


@dataclass(frozen=True, eq=False)
class LevelLines:
    """Lines (lines, n) in m of one scan, levelled, ``spacing`` in m apart, reliable from the wave
    ``shortest`` in m; ``together`` if they are neighbours in a map, ``tilted`` if a line was
    removed from each."""

    heights: RealArray
    spacing: float
    shortest: float
    together: bool
    tilted: bool


def scale_curve(scans: Sequence[LevelLines], model: Corner, quantity: str) -> ScaleCurve:
    """``quantity`` against the length, in ten bands per factor of ten.

    Slope [h(x+ℓ) - h(x)]/ℓ, curvature [h(x+ℓ/2) - 2h(x) + h(x-ℓ/2)]/(ℓ/2)², height in windows of
    the length ℓ less their least-squares line. Scans count at lengths above the order of the
    derivative times their shortest reliable wave. Mean squares are divided by their expectation
    under ``model`` at their own length before they are averaged; that of the slope is less what
    levelling of a line takes.
    """
    rows: dict[int, list[tuple[float, RealArray, float]]] = {}
    for scan in scans:
        n = scan.heights.shape[1]
        tilt = _removed_tilt(model, n, scan.spacing) if scan.tilted else 0.0
        for step in geometric_lags(n // (_LONGEST * (2 if quantity == "curvature" else 1))):
            length = scan.spacing * step * (2 if quantity == "curvature" else 1)
            if length < max(1, _ORDER[quantity]) * scan.shortest or (quantity == "height" and step < _LEAST_WINDOW):
                continue
            found = _squares(scan.heights, step, scan.spacing, quantity)
            ratio = found / _expected(model, step, scan.spacing, quantity, tilt)
            one = np.array([ratio.mean()]) if scan.together else ratio
            band = math.floor(_PER_DECADE * math.log10(length) + 1e-9)
            rows.setdefault(band, []).append((length, one, n * scan.spacing / length))
    table = [_banded(rows[band], model, quantity) for band in sorted(rows)]
    return ScaleCurve(quantity, *(np.array(column) for column in zip(*table, strict=True)))


def _banded(
    found: list[tuple[float, RealArray, float]], model: Corner, quantity: str
) -> tuple[float, float, float, float, float]:
    """Length, value, error, expectation and number of lines in one band."""
    ratio = np.concatenate([ratios for _, ratios, _ in found])
    weight = np.concatenate([np.full(ratios.size, stretches) for _, ratios, stretches in found])
    length = math.exp(float(np.average([math.log(item[0]) for item in found], weights=[item[2] for item in found])))
    mean = float(weight @ ratio / weight.sum())
    error = math.nan
    if ratio.size >= _FEWEST:
        spread = float(np.square(weight) @ np.square(ratio - mean)) * ratio.size / (ratio.size - 1)
        error = 0.5 * math.sqrt(spread) / float(weight.sum()) / mean  # of the root of a mean square
    points = 64  # of a window, whose mean square hardly depends on them
    step, spacing = (points, length / points) if quantity == "height" else (1, length / max(1, _ORDER[quantity]))
    expected = math.sqrt(_expected(model, step, spacing, quantity, 0.0))
    return length, math.sqrt(mean) * expected, error, expected, float(ratio.size)


def _squares(heights: RealArray, step: int, spacing: float, quantity: str) -> RealArray:
    """Mean square of the ``quantity`` of every line, (lines,), over ``step`` points."""
    if quantity == "slope":
        return np.asarray(np.mean(np.square((heights[:, step:] - heights[:, :-step]) / (step * spacing)), axis=1))
    if quantity == "curvature":
        bend = heights[:, 2 * step :] - 2.0 * heights[:, step:-step] + heights[:, : -2 * step]
        return np.asarray(np.mean(np.square(bend / (step * spacing) ** 2), axis=1))
    count = heights.shape[1] // step
    windows = heights[:, : count * step].reshape(heights.shape[0], count, step)
    at = np.arange(step) - 0.5 * (step - 1)
    windows = windows - windows.mean(axis=2, keepdims=True)
    windows = windows - (windows @ at / (at @ at))[..., None] * at
    return np.asarray(np.mean(np.square(windows), axis=(1, 2)))


def _expected(model: Corner, step: int, spacing: float, quantity: str, tilt: float) -> float:
    """Expectation of a mean square under ``model``; ``tilt`` mean square slope that levelling
    removed."""
    if quantity == "height":
        R = model.autocovariance(spacing * np.arange(step))
        at = np.arange(step) - 0.5 * (step - 1)
        taken = sum(_form(R, basis) for basis in (np.full(step, step**-0.5), at / math.sqrt(at @ at)))
        return float(R[0] - taken / step)
    R = model.autocovariance(step * spacing * np.arange(3))
    if quantity == "slope":
        mean_square = 2.0 * float(R[0] - R[1]) / (step * spacing) ** 2
        return max(mean_square - tilt, 0.1 * mean_square)
    return float(6.0 * R[0] - 8.0 * R[1] + 2.0 * R[2]) / (step * spacing) ** 4


def _removed_tilt(model: Corner, n: int, spacing: float) -> float:
    """Expected mean square slope of the least-squares line through ``n`` points."""
    at = spacing * (np.arange(n) - 0.5 * (n - 1))
    return _form(model.autocovariance(spacing * np.arange(n)), at / (at @ at))


def _form(R: RealArray, basis: RealArray) -> float:
    """b' R b with the covariance R (n,) by lag and the vector ``basis`` b (n,)."""
    spread = linear_autocorrelation(basis)
    return float(spread[0] * R[0] + 2.0 * (spread[1:] @ R[1:]))
