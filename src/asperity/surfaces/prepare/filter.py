"""Areal filters: waves shorter than one length and longer than another are removed."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, TypeAlias

import numpy as np

from ...core import require
from ...core.arrays import ComplexArray, RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.parameters import checked
from ...core.spectral import RealTransform, fast_length, thread_count
from ...core.units import show
from ...core.values import Length
from ..characterise.correlation import scale_dependence, tip_cutoff
from ..profile_spline import spline_smooth
from ..surface import Surface, lines_too, of_lines
from .level import recorded, require_complete

# Local regression with a Gaussian window (ISO 16610-61 and -71): at every node a polynomial of
# order 0, 1 or 2 in x and y is fitted with the weights s(x, y) = exp[-π (x/(γ λx))² - π (y/(γ
# λy))²]; its value there is the smooth surface. γ gives a wave of length λ the transmission one
# half: sqrt(ln 2/π) for order 0 and 1, 0.7309 for order 2.


_FIRST = math.log(2.0)  # transmission e^-t with t = π γ² at the cut-off
_SECOND = 1.6783469900166605  # (1 + t) e^-t = 1/2, the transmission of order 2 in any number of dimensions
_RIDGE = 1e-10  # of the trace, where the weights leave a coefficient undetermined
_NO_WEIGHT = 1e-13  # sum of weights that is no more than rounding: no valid node within reach
_ROWS = 1 << 15  # nodes whose equations are solved together, to bound the memory


def gamma(order: int) -> float:
    """Width γ of the window in units of the cut-off."""
    return math.sqrt((_SECOND if order == 2 else _FIRST) / math.pi)


def transmission(ratio: RealArray | float, order: int = 0) -> RealArray:
    """Amplitude transmission of a wave of length λ on an infinite surface; ``ratio`` λc/λ, both
    dimensionless."""
    t = (_SECOND if order == 2 else _FIRST) * np.square(np.asarray(ratio, dtype=float))
    return np.asarray((1.0 + t) * np.exp(-t) if order == 2 else np.exp(-t))


@dataclass(frozen=True, eq=False)
class LocalRegression:
    """Local regression on one grid: transfer functions of the moments of the window along x and y.

    ``along_x[a]`` (px, 1) and ``along_y[b]`` (1, py // 2 + 1) of s(u) (u/λ)^a; ``padded`` is the
    grid itself if it is periodic.
    """

    shape: tuple[int, int]
    padded: tuple[int, int]
    order: int
    along_x: tuple[ComplexArray, ...]
    along_y: tuple[ComplexArray, ...]

    def smooth(self, heights: RealArray, weights: RealArray) -> RealArray:
        """Fitted values (nx, ny) in m; ``weights`` (nx, ny) >= 0 of the nodes, 0 to exclude
        ``heights`` (m)."""
        transform = RealTransform(self.padded, thread_count())
        spectra = []
        for field in (weights, weights * heights):
            work = np.ascontiguousarray(field)
            if self.padded != self.shape:
                work = np.zeros(self.padded)
                work[: self.shape[0], : self.shape[1]] = field
            spectra.append(transform.forward(work))
        of_weights, of_heights = spectra
        powers = [(a, b) for a in range(self.order + 1) for b in range(self.order + 1 - a)]
        right = [self._moment(transform, of_heights, *power) for power in powers]
        if len(powers) == 1:
            total = self._moment(transform, of_weights, 0, 0)
            nothing = np.full(total.shape, np.nan)
            return np.asarray(np.divide(right[0], total, out=nothing, where=total > _NO_WEIGHT))
        sums = {
            (a, b): self._moment(transform, of_weights, a, b)
            for a in range(2 * self.order + 1)
            for b in range(2 * self.order + 1 - a)
        }
        return _solved(powers, sums, right)

    def _moment(self, transform: RealTransform, spectrum: ComplexArray, a: int, b: int) -> RealArray:
        """Σ s(x' - x) (x' - x)^a (y' - y)^b f(x') over all nodes x', for every node x."""
        field = transform.backward(spectrum * self.along_x[a] * self.along_y[b])
        return field[: self.shape[0], : self.shape[1]]


def local_regression(
    grid: Grid, cutoff: tuple[float, float], *, order: int, periodic: bool, reach: float
) -> LocalRegression:
    """Prepare the fit of ``order`` 0, 1 or 2 for the ``cutoff`` (λx, λy) in m.

    The window ends at |x| = ``reach`` λx for order 0, at the same share of its height for order 2.
    """
    width = gamma(order)
    counts = [math.floor(reach * width / gamma(0) * c / d + 1e-9) for c, d in zip(cutoff, grid.spacing, strict=True)]
    beyond = (0, 0) if periodic else (counts[0], counts[1])  # zero padding separates opposite borders
    nx, ny = (n if periodic else fast_length(n + k) for n, k in zip(grid.shape, beyond, strict=True))
    padded = (nx, ny)
    # exp(-π (u/γ)²) u^a, a = 0 … 2 order, at u = k d/λ, |k| <= count, periodic on n nodes
    windows = []
    for n, count, d, c in zip(padded, counts, grid.spacing, cutoff, strict=True):
        offsets = np.arange(-count, count + 1)
        u = offsets * (d / c)
        window = np.exp(-np.pi * (u / width) ** 2)
        window /= window.sum()
        powers = range(2 * order + 1)
        windows.append([np.bincount(offsets % n, window * u**a, n).astype(np.float64) for a in powers])
    # correlation, not convolution: the conjugate of the transform
    along_x = tuple(RealTransform((padded[0], 1)).forward(w[:, None]).conj() for w in windows[0])
    along_y = tuple(RealTransform((1, padded[1])).forward(w[None, :]).conj() for w in windows[1])
    return LocalRegression(grid.shape, padded, order, along_x, along_y)


def _solved(powers: list[tuple[int, int]], sums: dict[tuple[int, int], RealArray], right: list[RealArray]) -> RealArray:
    """Constant term of the fit at every node, from its normal equations."""
    shape, count = right[0].shape, len(powers)
    values = np.full(right[0].size, np.nan)
    flat = {power: field.ravel() for power, field in sums.items()}
    total = flat[0, 0]
    for start in range(0, values.size, _ROWS):
        part = slice(start, start + _ROWS)
        near = total[part] > _NO_WEIGHT
        matrix = np.empty((int(near.sum()), count, count))
        vector = np.empty((matrix.shape[0], count, 1))
        for i, (a, b) in enumerate(powers):
            vector[:, i, 0] = right[i].ravel()[part][near]
            for j, (c, d) in enumerate(powers):
                matrix[:, i, j] = flat[a + c, b + d][part][near]
        ridge = _RIDGE * np.trace(matrix, axis1=1, axis2=2)
        matrix[:, range(1, count), range(1, count)] += ridge[:, None]  # not applied to the constant term
        found = np.full(near.size, np.nan)
        found[near] = np.linalg.solve(matrix, vector)[:, 0, 0]
        values[part] = found
    return values.reshape(shape)


Cutoff: TypeAlias = float | tuple[float, float]
"""Wavelength in m, or one along x and one along y."""

KINDS = ("gaussian", "robust", "sharp")
"""Filters."""

LINE_KINDS = (*KINDS, "spline")
"""Filters of line scans."""

_LONGEST = {"short": 1.0, "long": 10.0}  # cut-offs in sides: beyond the first, hardly a wave of the map is left

FINEST = 4.0
"""Shortest cut-off in pixels: at 3 pixels the transmission at the cut-off would be 0.56 instead of
0.5."""

_BIWEIGHT = 4.4478  # times the median of |residual|: three standard deviations of normal residuals
_LEAST_WEIGHT = 1e-6  # of an outlier, so that every neighbourhood has some weight
_SETTLED = 1e-3  # relative change of the biweight's width at which the robust iteration ends
_MOST_PASSES = 50
_ROUNDING = 1e-9


@lines_too
def filtered(
    surface: Surface,
    *,
    short: Cutoff | None = None,
    long: Cutoff | None = None,
    kind: str = "gaussian",
    order: int = 0,
    reach: float = 1.0,
) -> Surface:
    """Surface without waves shorter than ``short`` (S-filter) and longer than ``long`` (L-filter);
    one or both.

    ``gaussian`` (ISO 16610-61): the transmission is one half at the cut-off and 2^-(short/λ)² at
    the wavelength λ; at borders and missing points the weights of the valid nodes within reach are
    normalised. ``robust`` (ISO 16610-71): nodes at the distance r from the smooth surface have the
    weight (1 - (r/c)²)² with c = 4.4478 times the median of |r|, iterated until c converges; spikes
    and deep valleys then do not distort their surroundings. Of line scans these are ISO 16610-21
    and -31, and ``spline`` (ISO 16610-22) runs to the ends, where a straight line passes exactly.
    ``sharp``: ideal band-pass between the cut-offs, for periodic surfaces only. Missing points stay
    missing. Raises InputError if no cut-off is given, one is out of range, they are out of order,
    or a sharp filter is applied to a surface that is not periodic or not complete.

    Parameters
    ----------
    surface
        Surface; level it first, since smoothing bends a tilt at the borders (not with ``order`` 1
        or 2).
    short, long
        Wavelengths in m, or pairs (along x, along y), of at least four pixels (two for ``sharp``),
        short < long; the short one at most the longer side of the surface, the long one ten times
        that.
    kind
        ``gaussian``, ``robust`` or ``sharp``; of line scans also ``spline``.
    order
        Order of the local polynomial: 0 as in ISO 16610-61; 1 preserves planes and 2 quadratic
        forms up to the borders.
    reach
        Half width of the window in cut-offs; 1 is exact to 2e-7, 0.5 to 1 %.
    """
    scan = surface.shape[1] == 1
    require.one_of(kind, LINE_KINDS if scan else KINDS, "kind of filter")
    if order not in (0, 1, 2):
        raise InputError(f"order of a filter must be 0, 1 or 2, but is {order!r}.")
    reach = require.positive(reach, "reach of a filter (cut-offs)")
    cutoffs = _cutoffs(surface, short, long, 2.0 if kind == "sharp" else FINEST)
    heights: RealArray = surface.heights.astype(np.float64)
    if kind == "sharp":
        require_complete(surface, "filtered sharply")
        if not surface.periodic:
            raise InputError(
                "surface must be periodic for a sharp filter, which acts across its borders, but is not. "
                "Use the gaussian filter, or periodised() first."
            )
        transform = RealTransform(surface.shape, thread_count())
        modes = transform.forward(heights)
        qx, qy = surface.grid.wavevector()
        for name, (along_x, along_y) in cutoffs.items():
            ratio = np.hypot(qx * along_x, qy * along_y) / (2.0 * np.pi)  # cut-off over wavelength
            # a long cut-off also removes the mean
            modes *= ratio <= 1.0 + _ROUNDING if name == "short" else ratio >= 1.0 - _ROUNDING
        heights = transform.backward(modes)
    else:
        valid = (~surface.mask).astype(np.float64)
        for name, cutoff in cutoffs.items():
            if kind == "spline":
                smooth = spline_smooth(heights[:, 0], surface.dx, cutoff[0], periodic=surface.periodic)[:, None]
                heights = smooth if name == "short" else heights - smooth
                continue
            fit = local_regression(surface.grid, cutoff, order=order, periodic=surface.periodic, reach=reach)
            known = np.where(surface.mask, 0.0, heights)
            smooth = _robust(known, valid, fit) if kind == "robust" else fit.smooth(known, valid)
            heights = smooth if name == "short" else heights - smooth
            heights[surface.mask] = np.nan
    words = []
    for name, (along_x, along_y) in cutoffs.items():
        lengths = show(along_x, "m") + ("" if along_x == along_y else f" along x and {show(along_y, 'm')} along y")
        words.append(f"{name} waves from {lengths}")
    what = kind if order == 0 else f"{kind} of order {order}"
    keys = {"gaussian": ("ISO16610-61",), "robust": ("ISO16610-71",), "sharp": ()}
    if scan:
        keys |= {"gaussian": ("ISO16610-21",), "robust": ("ISO16610-31",), "spline": ("ISO16610-22",)}
    return recorded(
        surface,
        heights,
        f"filtered: {', '.join(words)} on removed, {what}",
        periodic=surface.periodic,
        citation_keys=keys[kind],
    )


def _cutoffs(
    surface: Surface, short: Cutoff | None, long: Cutoff | None, finest: float
) -> dict[str, tuple[float, float]]:
    """The given cut-offs (along x, along y) by name, the short one first."""
    found: dict[str, tuple[float, float]] = {}
    for name, given in (("short", short), ("long", long)):
        if given is None:
            continue
        pair = given if isinstance(given, tuple) else (given, given)
        along = require.two(pair, f"{name} cut-off of a filter (m)", "Write one wavelength or (along x, along y).")
        lengths = [require.positive(c, f"{name} cut-off of a filter (m)") for c in along]
        for axis, n, length, d in zip("xy", surface.shape, lengths, surface.grid.spacing, strict=True):
            if n > 1 and length < finest * d * (1.0 - _ROUNDING):  # across a profile there is nothing to resolve
                raise InputError(
                    f"{name} cut-off of a filter must be at least {finest:g} pixels ({finest * d:g} m along {axis}), "
                    f"but is {length:g} m."
                )
        if min(lengths) > _LONGEST[name] * max(surface.size):
            raise InputError(
                f"{name} cut-off of a filter must be at most {_LONGEST[name]:g} times the longer side of the surface, "
                f"{show(max(surface.size), 'm')}, but is {show(min(lengths), 'm')}. Check its unit."
            )
        found[name] = (lengths[0], lengths[1])
    if not found:
        raise InputError("cut-off of a filter must be given, short or long or both, but neither is.")
    if len(found) == 2 and not all(a < b for a, b in zip(found["short"], found["long"], strict=True)):
        raise InputError(
            f"short cut-off of a filter must be below the long one, but they are {short!r} and {long!r} m."
        )
    return found


def _robust(values: RealArray, valid: RealArray, fit: LocalRegression) -> RealArray:
    """Smooth surface by iteratively reweighted fits (ISO 16610-71) of ``values``, which are
    ``valid`` where that is 1, not 0."""
    present = valid > 0.0
    weights, width = valid.copy(), np.inf
    smooth = values
    for _ in range(_MOST_PASSES):
        smooth = fit.smooth(values, weights)
        residual = np.where(present, values - smooth, 0.0)
        before, width = width, _BIWEIGHT * float(np.median(np.abs(residual[present])))
        if width == 0.0 or abs(before - width) <= _SETTLED * width:
            break
        biweight = np.square(np.maximum(1.0 - np.square(residual / width), 0.0))
        weights = valid * np.maximum(biweight, _LEAST_WEIGHT)
    return smooth


# Removal of waves distorted by the tip of an instrument.


_KEYS = ("Sanner2022",)


@of_lines
def reliability_cutoff(surface: Surface, tip_radius: float) -> float:
    """Wavelength in m below which a tip of ``tip_radius`` (m) may have distorted the map; may be 0
    or infinite.

    The longer of the stencil lengths along x and y at which the sharpest peak has the curvature
    1/(2 R) (Sanner et al. 2022, eq. 10). SurfaceTopography applies the same criterion along x
    alone. Raises InputError if the radius is not positive or the map too small for a stencil.
    """
    radius = require.positive(tip_radius, "radius of the tip (m)")
    axes = ("x",) if surface.shape[1] == 1 else ("x", "y")
    return max(tip_cutoff(scale_dependence(surface, axis=axis), radius) for axis in axes)


@lines_too
@checked
def tip_limited(surface: Surface, radius: Annotated[Length, "radius of the tip"]) -> Surface:
    """Surface without the waves that a tip of ``radius`` (m) may have shaped, by a Gaussian filter.

    If the tip was sharp enough for every peak at every length, or the cut-off is below four pixels,
    which a filter does not resolve, the heights are unchanged; the history records the cut-off in
    any case. Raises InputError if the tip is blunter than the surface at every length: no wave of
    the map is reliable.
    """
    cutoff = reliability_cutoff(surface, radius)
    if math.isinf(cutoff):
        raise InputError(
            f"radius of the tip must be small enough for the longest waves of the map, but with {radius:g} m the "
            "map may be distorted by the tip at every length. Check the radius and the units of the heights."
        )
    tip = f"tip of radius {show(radius, 'm', 3)}"
    if cutoff < FINEST * (surface.dx if surface.shape[1] == 1 else max(surface.grid.spacing)):
        reach = "no wave" if cutoff == 0.0 else f"waves below {show(cutoff, 'm', 3)}, less than four pixels,"
        limited, step = surface, f"tip-limited: {reach} shaped by a {tip}, nothing removed"
    else:
        limited = filtered(surface, short=cutoff)
        step = f"tip-limited: waves below {show(cutoff, 'm', 3)} shaped by a {tip}"
    origin = limited.origin.continued(step, _KEYS)
    return Surface(limited.heights, limited.dx, limited.dy, periodic=limited.periodic, origin=origin)
