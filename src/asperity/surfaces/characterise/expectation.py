"""Expected mean of a periodogram over rings of modes, for a spectrum seen through a window and a
grid of points.

A window spreads each wave over neighbouring modes (leakage), and points cannot tell waves shorter
than two pixels from longer ones (aliasing). Both are linear in the spectrum, so that one matrix
holds them for any spectrum; fitting expectations removes the bias of a periodogram (Sykulski et al.
2019).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

import numpy as np

from ...core.arrays import RealArray
from ...core.grid import Grid
from ...core.spectral import multiplicity
from .spectrum import RadialSpectrum

_STEP = 0.015  # of ln q between nodes; linear in C q³ over such a step is exact to 4e-4 for q^-6.5
_COARSE = 0.1  # of ln q beyond the waves that are folded one by one
_MODES = 1500  # at most, of a ring, spread evenly over all its modes: its mean is then exact to 0.2 %
_NEAR = 10.0  # modes; closer to the mean all of the window counts, beyond only its second moment
_FOLDS = 2  # waves longer than 2/(2 _FOLDS + 1) pixels are folded one by one, the rest by an integral
_FARTHEST = 1e4  # of that integral, in largest wavenumbers folded one by one
_POWER = 3.0  # of q that makes usual spectra flat

_HALVES = np.array([-3.5, -2.5, -1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 2.5, 3.5])
_WHOLE = np.array([-1.0, 0.0, 1.0])
_RADIAL = 0.3627  # second moment of the transform of a radial Hann window along an axis, in squared modes


@dataclass(frozen=True, eq=False)
class RingExpectation:
    """Expected values of a ring mean: ``weights`` (rings, nodes) times C at the wavenumbers ``q``
    (nodes,) in rad/m."""

    q: RealArray
    weights: RealArray
    citation_keys: ClassVar[tuple[str, ...]] = ("Guillaumin2022", "Sykulski2019")


def ring_expectation(grid: Grid, rings: RadialSpectrum, *, folded: bool) -> RingExpectation:
    """Expectation of the ``rings`` of a spectrum on ``grid``.

    Parameters
    ----------
    grid
        Grid of the heights.
    rings
        Their bounds and the window; the values are not used.
    folded
        Whether heights are point values of a surface with waves shorter than two pixels, which
        appear as longer ones; otherwise the surface has no such waves, as one that was generated on
        the grid or whose pixels average.
    """
    mode_x, mode_y, ring, share = _sampled_modes(grid, rings)
    unit = tuple(2.0 * np.pi / side for side in grid.size)
    fold = tuple(2.0 * np.pi / d for d in grid.spacing)
    nodes = _nodes(grid, folded)
    weights = np.zeros((rings.q.size, nodes.size))

    def add(kx: RealArray, ky: RealArray, rows: RealArray, amount: RealArray) -> None:
        """``amount`` of C at the modes (kx, ky) to the ``rows``; nothing at the mean."""
        _accumulate(weights, nodes, np.hypot(kx * unit[0], ky * unit[1]), rows, amount)

    near = np.hypot(mode_x, mode_y) <= _NEAR
    for part, is_near in ((near, True), (~near, False)):
        x, y, rows, amount = mode_x[part], mode_y[part], ring[part], share[part]
        for du, weight_x in _kernel(rings.window, grid, 0, is_near):
            for dv, weight_y in _kernel(rings.window, grid, 1, is_near):
                add(x + du, y + dv, rows, amount * (weight_x * weight_y))
    if folded:
        axes = [range(-_FOLDS, _FOLDS + 1) if n > 1 else range(1) for n in grid.shape]
        for m, n in ((m, n) for m in axes[0] for n in axes[1] if (m, n) != (0, 0)):
            add(mode_x + m * grid.shape[0], mode_y + n * grid.shape[1], ring, share)
        if 1 not in grid.shape:
            weights += _rest(nodes, fold)
    return RingExpectation(nodes, weights)


def _sampled_modes(grid: Grid, rings: RadialSpectrum) -> tuple[RealArray, RealArray, RealArray, RealArray]:
    """Modes along x and y, the ring and the share in its mean of at most ``_MODES`` modes a
    ring."""
    q = grid.wavenumber()
    counted = np.broadcast_to(multiplicity(grid), q.shape).ravel()
    bounds = np.append(rings.low, rings.high[-1])
    number = np.searchsorted(bounds, q.ravel(), side="left") - 1
    number[(number >= rings.q.size) | (q.ravel() <= 0.0)] = -1
    order = np.argsort(number, kind="stable")
    starts = np.searchsorted(number[order], np.arange(rings.q.size + 1))
    chosen = []
    for first, last in pairwise(starts):
        count = min(_MODES, last - first)
        chosen.append(order[first + (np.arange(count) * (last - first)) // max(1, count)])
    index = np.concatenate(chosen)
    ring, weight = number[index], counted[index].astype(np.float64)
    share = weight / np.bincount(ring, weight, rings.q.size)[ring]
    mode_x = np.rint(grid.wavevector()[0].ravel() * grid.size[0] / (2.0 * np.pi))[index // q.shape[1]]
    return mode_x, (index % q.shape[1]).astype(np.float64), ring, share


def _nodes(grid: Grid, folded: bool) -> RealArray:
    """Wavenumbers (rad/m) between which C q³ is taken as linear in ln q."""
    first = 0.49 * 2.0 * np.pi / max(grid.size)
    corner = math.hypot(*(math.pi / d for d in grid.spacing))
    last = 1.2 * corner + 4.0 * 2.0 * np.pi / min(grid.size)
    last *= 2 * _FOLDS + 1 if folded else 1
    fine = np.geomspace(first, last, 2 + int(np.log(last / first) / _STEP))
    if not folded:
        return fine
    coarse = np.geomspace(last, _FARTHEST * last, 2 + int(np.log(_FARTHEST) / _COARSE))
    return np.concatenate([fine, coarse[1:]])


def _accumulate(weights: RealArray, nodes: RealArray, q: RealArray, rows: RealArray, amount: RealArray) -> None:
    """Add ``amount`` times C(q) to the ``rows`` of ``weights``, by interpolation of C q³ between
    the nodes."""
    inside = q > 0.0
    q, rows, amount = q[inside], rows[inside], amount[inside]
    at = np.clip(np.searchsorted(nodes, q) - 1, 0, nodes.size - 2)
    share = np.clip(np.log(q / nodes[at]) / np.log(nodes[at + 1] / nodes[at]), 0.0, 1.0)
    count, flat = nodes.size, weights.ravel()
    for node, part in ((at, 1.0 - share), (at + 1, share)):
        added = amount * part * (nodes[node] / q) ** _POWER
        flat += np.bincount(rows * count + node, added, flat.size)


def _kernel(window: str, grid: Grid, axis: int, near: bool) -> list[tuple[float, float]]:
    """Offsets in modes along ``axis`` and weights by which a window mixes modes.

    Those of a Hann window at half modes, which is the exact sum for a surface of twice the size, or
    at whole modes, which has the same second moment.
    """
    if window == "none" or grid.shape[axis] < 3:
        return [(0.0, 1.0)]
    if window == "radial hann":
        step = grid.size[axis] / min(grid.size)
        return [(-step, 0.5 * _RADIAL), (0.0, 1.0 - _RADIAL), (step, 0.5 * _RADIAL)]
    offsets = _HALVES if near else _WHOLE
    transform = np.sinc(offsets) + 0.5 * (np.sinc(offsets - 1.0) + np.sinc(offsets + 1.0))
    weights = np.square(transform)
    return list(zip(offsets.tolist(), (weights / weights.sum()).tolist(), strict=True))


def _rest(nodes: RealArray, fold: Sequence[float]) -> RealArray:
    """Weights of the waves beyond those folded one by one: the mean of C over all directions and
    wavenumbers."""
    half = [(_FOLDS + 0.5) * step for step in fold]
    log_q = np.arange(np.log(min(half)), np.log(nodes[-1]), _STEP)
    q = np.exp(log_q)
    inside = np.arcsin(np.minimum(1.0, half[1] / q)) - np.arccos(np.minimum(1.0, half[0] / q))
    angle = 2.0 * np.pi - 4.0 * np.maximum(0.0, inside)
    weights = np.zeros((1, nodes.size))
    _accumulate(weights, nodes, q, np.zeros(q.size, dtype=int), q**2 * angle * (_STEP / (fold[0] * fold[1])))
    return weights
