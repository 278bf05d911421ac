"""Compliance of nested B-splines: a model of a body whose products, and an approximate inverse on
any set of points, cost no transform.

Points merge in pairs to cells, these to larger ones, and so on; the cells of level l carry
quadratic B-splines P_l, twice as wide as those below. The compliance

    B = own + sum over levels l of w_l P_l C_l P_l^T

is fitted to that of the body at all wavelengths, to 2 % on average and 8 % at most, on films of E
10 as on half-spaces. C_l averages over neighbouring cells (half of the own load and a quarter of
that beside it on either side, along the axes that merge; not on slender pixels), so that it hardly
matters where cells begin. As a model of the operator, not of its inverse, B holds on any set of
points: the eigenvalues of B^-1 K lie within a factor of 1.13 on self-affine surfaces, of 1.2 with
films of E 10 from 4 pixels on.

Its inverse on a set is approximated by the recursion of Sherman and Morrison from level to level,
with row sums T instead of the products of B-splines: g = 1 / (1 + w T), S = P^T g S and T = P^T g T
on the way up, d = g (w S + P d) on the way down, from S = r and T = 1 at the points of the set. In
full contact that is

    M = sum over levels l of (f_l - f_l+1) / s_l

with f_l the spectrum of the B-splines of level l and s_l = 1 + sum of w N up to it (N points a
cell). Row sums are not less than the products, so that M is positive definite on any set.
Differences between neighbours in the set, and curvatures, add a local stiffness. The eigenvalues of
M K lie within a factor of 1.5 on half-spaces, whatever the set.

Where c(q) q rises, as that of stiff films does at waves longer than they are thick, what row sums
leave of such waves counts for too much. There d is corrected at each level by c H d / T, H being
what the row sums T exceed the products by, a Laplacian between neighbouring cells, and the
deflection P d of the points counts by the row sums of their local stiffness. M is not quite
symmetric then.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any, NamedTuple, Protocol

import numpy as np

from ....core.arrays import RealArray
from ....core.engine import SplineModel
from ....core.grid import Grid
from ...boundary import Boundary
from ...operators import Operator
from ...operators.convolution import Octaves

# Levels of cells.


class Spectral(Protocol):
    """Compliance, or what is known of it."""

    def spectral(self, wavenumber: RealArray) -> RealArray:
        """Displacement per pressure c(q) in m/Pa at each ``wavenumber`` q > 0 (rad/m)."""


_SQUARE = 1.5
"""Ratio of sides up to which cells merge along both axes; beyond, only along the shorter side, so
that ratios stay below 2. It does not matter for square pixels."""


def merges_of(grid: Grid) -> list[tuple[bool, bool]]:
    """Axes along which the cells of each level merge in pairs, until one cell is left."""
    counts, sides = list(grid.shape), list(grid.spacing)
    merges: list[tuple[bool, bool]] = []
    while max(counts) > 1 or not merges:
        x = counts[0] > 1 and (counts[1] == 1 or sides[0] <= _SQUARE * sides[1])
        y = counts[1] > 1 and (counts[0] == 1 or sides[1] <= _SQUARE * sides[0])
        merges.append((x, y))
        for axis, pairs in enumerate((x, y)):
            if pairs:
                counts[axis], sides[axis] = -(-counts[axis] // 2), 2.0 * sides[axis]
    return merges


_SLENDER = 3.5
"""Ratio of the sides of a pixel from which on levels do not average. Eigenvalues of B^-1 K in full
contact: 0.61 to 1.31 with averages at 3, 0.13 to 1.29 at 5; without, 0.60 to 1.48 and 0.27 to
1.40."""


def averages_of(grid: Grid) -> tuple[tuple[bool, bool], ...]:
    """Axes along which each level of the model averages on ``grid``: those that merge, none where
    pixels are slender."""
    merges, sides = octaves(grid).merges, grid.pixels
    return merges if max(sides) < _SLENDER * min(sides) else ((False, False),) * len(merges)


class OctavesOfCells(NamedTuple):
    """Of every level of cells, from single points up: the axes along which they merge, their
    ``sides`` (m), and number of ``points``."""

    merges: tuple[tuple[bool, bool], ...]
    sides: RealArray
    points: RealArray


@lru_cache(maxsize=64)
def octaves(grid: Grid) -> OctavesOfCells:
    """Levels of cells on ``grid``; the side of a cell is that along the axes in which it merges."""
    merges = merges_of(grid)
    cell, points, sides, numbers = list(grid.spacing), 1.0, [], []
    for x, y in (*merges, merges[-1]):
        merged = [side for side, pairs in zip(cell, (x, y), strict=True) if pairs] or cell
        sides.append(math.prod(merged) ** (1.0 / len(merged)))
        numbers.append(points)
        for axis, pairs in enumerate((x, y)):
            if pairs:
                cell[axis], points = 2.0 * cell[axis], 2.0 * points
    return OctavesOfCells(tuple(merges), np.array(sides), np.array(numbers))


def pixel_compliance(compliance: Spectral, grid: Grid) -> float:
    """Displacement per pressure (m/Pa) at the wavelength of two points of ``grid``."""
    return float(np.asarray(compliance.spectral(np.pi / octaves(grid).sides[:1]))[0])


# The model of a body.


_PER_OCTAVE = 3
"""Wavenumbers in an octave at which compliances are compared."""

_ANGLES = np.pi / 8.0 * np.arange(5)
"""Directions in which they are."""

_ALIASES = 3
"""Multiples of the wavenumber of the grid whose waves count in the deflection at the centres of
uniformly loaded patches."""


class _Waves(NamedTuple):
    """Waves at which the compliance of an operator is looked at.

    ``wavenumbers`` (m,) in rad/m are those for which ``which`` (n,) says which a wave has. At the
    centres of uniformly loaded pixels a wave deflects by ``direct`` times the compliance, and by
    ``aliases`` (both (n,)) times c(q) q of the shortest waves.
    """

    wavenumbers: RealArray
    which: Any
    direct: RealArray
    aliases: RealArray

    @classmethod
    def of(cls, wavenumbers: RealArray, which: Any, waves: RealArray, spacing: tuple[float, float]) -> _Waves:
        """Waves with the phases ``waves`` (2, n) from point to point along x and y."""
        turns = 2.0 * np.pi * np.arange(-_ALIASES, _ALIASES + 1)
        x, y = (wave[:, None] + (turns if wave.any() else turns[_ALIASES : _ALIASES + 1]) for wave in waves)
        shares = np.sinc(x / (2.0 * np.pi))[:, :, None] * np.sinc(y / (2.0 * np.pi))[:, None, :]
        q = np.hypot(x[:, :, None] / spacing[0], y[:, None, :] / spacing[1])
        own = shares[:, x.shape[1] // 2, y.shape[1] // 2].copy()
        q[:, x.shape[1] // 2, y.shape[1] // 2] = np.inf
        return cls(wavenumbers, which, own, (shares / q).sum(axis=(1, 2)))

    def compliance(self, octaves: Octaves, boundary: Boundary, shortest: float) -> RealArray:
        """Compliance (n,) in m/Pa of the operator of these ``octaves`` and this ``boundary``, whose
        ``shortest`` waves have this c(q) q."""
        found: RealArray = np.asarray(octaves.spectral(self.wavenumbers), dtype=float)[self.which]
        if not all(boundary.wraps):
            found = found * self.direct + shortest * self.aliases
        return found


class _Samples(NamedTuple):
    """``waves`` at which the model on a grid is compared with a body, and its ``parts`` (parts, n)
    there; those along an axis that have ``octaves``, the shortest first.

    Parts are those of a point, its nearest along x and y and its diagonal ones (0 where there are
    none), and of each level.
    """

    waves: _Waves
    parts: RealArray
    octaves: _Waves


@lru_cache(maxsize=64)
def _samples(grid: Grid) -> _Samples:
    """Samples from the shortest waves of ``grid`` to those of twice its length."""
    merges, sides, _ = octaves(grid)
    lines = [axis for axis in (0, 1) if grid.shape[axis] > 1] or [0]
    shortest = math.pi / min(grid.spacing[axis] for axis in lines)
    longest = math.pi / max(grid.spacing[axis] * grid.shape[axis] for axis in lines)
    number = math.ceil(_PER_OCTAVE * (0.5 + math.log2(shortest / longest)))
    q = math.sqrt(2.0) * shortest * 2.0 ** (-np.arange(number + 1) / _PER_OCTAVE)
    directions = np.stack([np.cos(_ANGLES), np.sin(_ANGLES)]) if len(lines) == 2 else np.eye(2)[:, lines]
    spacing = np.array(grid.spacing)[:, None, None]
    phases = (spacing * q[:, None] * directions[:, None, :]).reshape(2, -1)
    resolved = (phases <= np.pi * (1.0 + 1e-9)).all(axis=0)
    which, phases = np.arange(q.size).repeat(directions.shape[1])[resolved], phases[:, resolved]
    cosines = np.cos(phases) * np.array([[float(axis in lines)] for axis in (0, 1)])
    parts = [np.ones(which.size), *cosines, cosines.prod(axis=0)]
    spline, waves = np.ones(which.size), list(phases)
    for merge, averages in zip(merges, averages_of(grid), strict=True):
        average = np.ones(which.size)
        for axis in (axis for axis in (0, 1) if merge[axis]):
            spline = spline * (0.75 * np.cos(0.5 * waves[axis]) + 0.25 * np.cos(1.5 * waves[axis])) ** 2
            waves[axis] = 2.0 * waves[axis]
            if averages[axis]:
                average = average * np.cos(0.5 * waves[axis]) ** 2
        parts.append(spline * average)
    axis = next(axis for axis in lines if merges[0][axis] or not any(merges[0]))
    along = np.zeros((2, len(sides)))
    along[axis] = grid.spacing[axis] * np.pi / sides
    return _Samples(
        _Waves.of(q, which, phases, grid.spacing),
        np.array(parts),
        _Waves.of(np.pi / sides, np.arange(len(sides)), along, grid.spacing),
    )


_TRUST = 0.001
"""Weight of the guess, an octave of the compliance for each level, in the fit of a level: where no
wave tells it, it is as guessed."""

_RELATIVE = 1.0, 1.8, 1.9, 1.6, 1.66, 2.6
"""Compliance of a level in the inverse over that of the body at pi over the side of its cells,
relative to single points; the last holds for all further levels. Of stiff bodies, whose inverse is
corrected, it is that of the model."""

_MIDDLE, _FALL, _BEND = 2.02, 0.34, 0.24
"""Middle of the eigenvalues of M K, in the compliance of a point at the shortest wavelength (they
are 1.6 to 2.4 on half-spaces), and shares of the local stiffness: for differences from the
neighbours in the set, and for the curvature along each axis."""

_STIFF = 1.5
"""Rise of c(q) q over that of the shortest waves, at any wavelength, from which on a body counts as
stiff: a film on a softer base."""

_STIFF_MIDDLE, _STIFF_FALL, _STIFF_BEND = 2.4, -0.1, 0.7
"""The same for stiff bodies, whose cells count by the row sums of the local stiffness: these are
larger at the rim of a contact."""

_CORRECTION = 0.75
"""Share in which row sums are corrected on stiff bodies, from the level on that lies ``_AHEAD``
below the first where c(q) q has risen by ``_RISEN``: without, conjugate gradients gain half as much
a step."""

_AHEAD, _RISEN = 3, 1.2
"""Levels, and the rise: waves of eight points are reproduced to three fifths by the row sums of
points that form cells, those of 16 to nine tenths."""

_OBLONG = 1.7
"""Share of the local stiffness along the longer side of a pixel, times the ratio of the sides."""

_NEAR = 3
"""Level of cells, of eight points, up to which a compliance is looked at for the number of steps on
the model."""

_STEEP = 10.0
"""Steepness from which on the inverse of nested splines is not good enough by itself, where points
form cells along both axes."""


OWN_YIELDING = 0.5
"""Deflection of a point under its own load, over that of any point in the inverse of nested
splines, where points yield unlike. FFT pairs of contacts that yield for 0.3, 0.7, 1: 1 %, 2 %,
230 % more; of beds of wear whose values differ by a factor of 3 for 0.25, 0.4, 0.7, 1: 28 %, 5 %,
2 %, 15 % more."""


class SplineCompliance(NamedTuple):
    """``model`` of a compliance, its steepness, by which factor c(q) q exceeds that of the shortest
    waves at waves of 16 points, more than 1 for stiff films thinner than that, and whether its
    inverse is ``refined`` by steps on the model, being not good enough by itself."""

    model: SplineModel
    steepness: float
    refined: bool


def spline_compliance(operator: Operator, scale: float) -> SplineCompliance:
    """Nested splines that follow the compliance of ``operator`` over ``scale``, fitted once for a
    body, boundary and grid.

    Coefficients of the inverse were found by searches: for the smallest spread of eigenvalues on
    half-spaces and soft films, and for the fastest conjugate gradients on the contact sets of films
    of E 10 to 100, 2 to 20 pixels thick.
    """
    return _fit(operator.octaves, operator.boundary, operator.grid, scale)


@lru_cache(maxsize=64)
def _fit(body: Octaves, boundary: Boundary, grid: Grid, scale: float) -> SplineCompliance:
    merges, _, points = octaves(grid)
    samples = _samples(grid)
    first, levels, steep = _levels(body, boundary, grid)
    parts = _fitted(samples.parts, samples.waves.compliance(body, boundary, first), np.diff(levels))
    steepness, near = float(steep[: _NEAR + 1].max()), _STEEP if all(merges[0]) else _STIFF
    wraps, finest = boundary.wraps, min(grid.spacing)
    # the inverse: rises of the compliance from level to level in m/Pa, that of a point being one
    corrections: tuple[float, ...] = ()
    if float(steep.max()) > _STIFF:
        middle, fall, bend = _STIFF_MIDDLE, _STIFF_FALL, _STIFF_BEND
        rises = parts[_LOCAL:] / middle
        ahead = np.minimum(np.arange(1, len(steep)) + _AHEAD, len(steep) - 1)
        corrected = np.maximum.accumulate(steep)[ahead] > _RISEN
        corrections = tuple(np.where(corrected, _CORRECTION, 0.0).tolist())
    else:
        middle, fall, bend = _MIDDLE, _FALL, _BEND
        relative = np.full(len(levels), _RELATIVE[-1])
        relative[: len(_RELATIVE)] = _RELATIVE[: len(levels)]
        relative[1:] = 1.0 + (relative[1:] - 1.0) * np.clip(levels[1:] / levels[:-1] - 1.0, 0.0, 1.0)
        rises = np.diff(relative * levels)
    local = [
        min(1.0, _OBLONG * finest / side) if n > 1 else 0.0 for side, n in zip(grid.spacing, grid.shape, strict=True)
    ]
    model = SplineModel(
        wraps=(wraps[0], wraps[1]),
        merges=merges,
        averages=averages_of(grid),
        weights=tuple((parts[_LOCAL:] / (points[1:] * scale)).tolist()),
        own=tuple((parts[:_LOCAL] / scale).tolist()),
        inverse_weights=tuple((rises / (points[1:] * levels[0])).tolist()),
        stiffness=scale / (middle * float(levels[0])),
        fall=(fall * local[0], fall * local[1]),
        bend=(bend * local[0], bend * local[1]),
        corrections=corrections,
    )
    return SplineCompliance(model, steepness, steepness > near)


def steepness(operator: Operator, level: int = _NEAR) -> float:
    """That of ``spline_compliance``, without the rest of it; or up to waves of twice the side of
    the cells of another ``level``."""
    steep = _levels(operator.octaves, operator.boundary, operator.grid)[2]
    return float(steep[: level + 1].max())


@lru_cache(maxsize=64)
def _levels(body: Octaves, boundary: Boundary, grid: Grid) -> tuple[float, RealArray, RealArray]:
    """c(q) q of the shortest waves of an operator, c of every level (levels + 1,), and by which
    factor c(q) q there exceeds the first."""
    sides = octaves(grid).sides
    first = float(body.spectral(np.pi / sides[:1])[0]) * np.pi / float(sides[0])
    levels = _samples(grid).octaves.compliance(body, boundary, first)
    return first, levels, levels * sides[0] / (levels[0] * sides)


_LOCAL = 4
"""Parts of the model that are not levels: a point, its nearest along x and y, its diagonal ones."""


def _fitted(parts: RealArray, of_body: RealArray, guess: RealArray) -> RealArray:
    """Factors of the ``parts`` (parts, n) that make their sum that ``of_body`` (n,); those of the
    levels near the ``guess``."""
    used = parts.any(axis=1)
    level = np.zeros((len(guess), len(parts)))
    level[:, _LOCAL:] = np.diag(
        _TRUST * math.sqrt(of_body.size) / np.maximum(np.abs(guess), 1e-6 * np.abs(guess).max())
    )
    rows = np.concatenate([(parts / of_body).T, level])[:, used]
    wanted = np.concatenate([np.ones(of_body.size), level[:, _LOCAL:] @ guess])
    found = np.zeros(len(parts))
    found[used] = np.linalg.lstsq(rows, wanted, rcond=None)[0]
    return found
