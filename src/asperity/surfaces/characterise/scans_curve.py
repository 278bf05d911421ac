"""One curve of C1D through many scans, with weights and errors, and whether the scans agree."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...core.arrays import BoolArray, RealArray
from .scans_corners import Corner
from .whittle_lines import LineModes

FEWEST = 3
"""Independent lines or maps in a band from which their scatter tells an error."""


@dataclass(frozen=True, eq=False)
class CombinedCurve:
    """Mean of C1D over all scans in bands of equal ratio.

    ``q`` in rad/m (n,), rising; ``profile_psd`` C1D in m³; ``ratio`` to the fitted spectrum;
    ``error`` relative standard error; ``scatter`` τ, relative standard deviation between scans
    beyond what their modes explain; ``scans`` number of scans and ``lines`` of independent lines
    and maps in the band; ``few`` True where the error is that of the modes alone, since fewer than
    three lines or maps are there.
    """

    q: RealArray
    profile_psd: RealArray
    ratio: RealArray
    error: RealArray
    scatter: RealArray
    scans: NDArray[np.int_]
    lines: NDArray[np.int_]
    few: BoolArray


@dataclass(frozen=True)
class Agreement:
    """One scan against all others in one decade of wavenumbers they share.

    ``scan`` its number from 0; ``first`` and ``last`` wavenumber in rad/m; ``ratio`` of its power
    to that of the others; ``deviation`` of the logarithm in standard errors of their modes.
    """

    scan: int
    first: float
    last: float
    ratio: float
    deviation: float


@dataclass(frozen=True, eq=False)
class _Relative:
    """Power of the lines of one scan over the fitted spectrum: ``ratio`` (clusters, modes) and its
    number of independent modes ``weight`` (modes,) in each cluster."""

    q: RealArray
    ratio: RealArray
    weight: RealArray


def combined_curve(scans: Sequence[LineModes], model: Corner, *, per_decade: int = 10) -> CombinedCurve:
    """Mean of C1D over ``scans`` in ``per_decade`` bands per factor of ten, aligned to decades.

    Periodograms are divided by their expectation under the fitted ``model``, which takes window,
    aliases, noise and the width of a band out of the mean. Weights of lines are 1/(1/ν + τ²) with
    their number ν of independent modes in the band and the scatter τ between them (DerSimonian &
    Laird 1986). C is averaged, not its logarithm.
    """
    parts = [_relative(scan, model) for scan in scans]
    bands = [np.floor(per_decade * np.log10(part.q) + 1e-9).astype(int) for part in parts]
    rows = []
    for band in np.unique(np.concatenate(bands)):
        inside = [number == band for number in bands]
        found = [_of_band(part, here) for part, here in zip(parts, inside, strict=True) if here.any()]
        estimates = np.concatenate([ratios for ratios, _, _ in found])
        nu = np.concatenate([counts for _, counts, _ in found])
        squared = _scatter(estimates, nu)
        weights = 1.0 / (1.0 / nu + squared)
        mean, deviation = float(weights @ estimates / weights.sum()), float(weights.sum() ** -0.5)
        moment = sum(total for _, _, total in found) / sum(float(counts.sum()) for _, counts, _ in found)
        rows.append((math.exp(moment), mean, deviation, math.sqrt(squared), len(found), nu.size))
    q, ratio, error, scatter, number, lines = (np.array(column) for column in zip(*rows, strict=True))
    return CombinedCurve(q, ratio * model.profile_psd(q), ratio, error, scatter, number, lines, lines < FEWEST)


def agreements(scans: Sequence[LineModes], model: Corner) -> tuple[Agreement, ...]:
    """Each of the ``scans`` against all others in each decade of wavenumbers that it shares with
    them.

    A deviation at the short end of the larger scan is its resolution, at the long end of the
    smaller one tilt or window; a constant factor is the calibration of heights (squared), or a
    surface that is not the same everywhere.
    """
    parts, found = [_relative(scan, model) for scan in scans], []
    for number, part in enumerate(parts):
        others = [other for index, other in enumerate(parts) if index != number]
        for decade in np.unique(np.floor(np.log10(part.q)).astype(int)):
            low, high = 10.0**decade, 10.0 ** (decade + 1)
            low = max(low, min((float(other.q[0]) for other in others), default=math.inf))
            high = min(high, max((float(other.q[-1]) for other in others), default=0.0))
            here = _total(part, low, high)
            there = [_total(other, low, high) for other in others]
            power, count = sum(item[0] for item in there), sum(item[1] for item in there)
            if here[1] < FEWEST or count < FEWEST:
                continue
            ratio = (here[0] / here[1]) / (power / count)
            deviation = math.log(ratio) / math.sqrt(1.0 / here[1] + 1.0 / count)
            found.append(Agreement(number, low, high, ratio, deviation))
    return tuple(found)


def _relative(scan: LineModes, model: Corner) -> _Relative:
    expected = scan.expectation(model)
    signal = np.maximum(expected - scan.floor, 1e-3 * expected)  # what is noise alone tells nothing
    ratio = (scan.periodograms - scan.floor) / signal
    nu = scan.independent(model.hurst, model.corner) / scan.lost * np.square(signal / expected)
    if scan.is_map:
        return _Relative(scan.q, ratio.mean(axis=0)[None, :], nu)
    return _Relative(scan.q, ratio, nu / scan.lines)


def _of_band(part: _Relative, here: BoolArray) -> tuple[RealArray, RealArray, float]:
    """Mean ratio and number of independent modes of each cluster, and Σ ν ln q of all."""
    weight = part.weight[here]
    ratios = part.ratio[:, here] @ weight / weight.sum()
    count = np.full(ratios.size, weight.sum())
    return ratios, count, ratios.size * float(weight @ np.log(part.q[here]))


def _scatter(estimates: RealArray, nu: RealArray) -> float:
    """τ² of DerSimonian & Laird, relative to the mean of ``estimates`` with ``nu`` modes each."""
    if estimates.size < FEWEST:
        return 0.0
    mean = float(nu @ estimates / nu.sum())
    if not mean > 0.0:
        return 0.0
    excess = float(nu @ np.square(estimates / mean - 1.0)) - (estimates.size - 1)
    return max(0.0, excess / float(nu.sum() - np.square(nu).sum() / nu.sum()))


def _total(part: _Relative, low: float, high: float) -> tuple[float, float]:
    """Σ ν times ratio, and Σ ν, of all lines between two wavenumbers."""
    here = (part.q >= low) & (part.q <= high)
    clusters = part.ratio.shape[0]
    return float((part.ratio[:, here] @ part.weight[here]).sum()), clusters * float(part.weight[here].sum())
