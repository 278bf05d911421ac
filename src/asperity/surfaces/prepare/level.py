"""Levelling, removal of spikes and of offsets between scan lines, filling of missing points."""

from __future__ import annotations

import itertools
from typing import Annotated, Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.errors import InputError
from ...core.parameters import checked
from ...core.units import show
from ...core.values import Axis, Positive, Whole
from ..characterise.heights import rms_height
from ..surface import Surface

# Used by all preparation steps.


def require_complete(surface: Surface, word: str) -> None:
    """Raise an error for missing points; ``word`` is the participle of the step, such as
    ``"tapered"``.

    Raises InputError if points are missing.
    """
    if surface.n_missing:
        raise InputError(
            f"surface must have no missing points to be {word}, but {surface.n_missing} are missing. "
            "Fill them first with filled()."
        )


def recorded(
    surface: Surface, heights: RealArray, step: str, *, periodic: bool, citation_keys: tuple[str, ...] = ()
) -> Surface:
    """``surface`` with other ``heights`` (nx, ny) in m; the history records ``step`` and both rms
    heights."""
    after = Surface(heights, surface.dx, surface.dy, periodic=periodic)
    change = f"{step} (rms {show(rms_height(surface), 'm', 3)} -> {show(rms_height(after), 'm', 3)})"
    origin = surface.origin.continued(change, citation_keys)
    return Surface(after.heights, surface.dx, surface.dy, periodic=periodic, origin=origin)


# Levelling.


_DEGREES = {"mean": 0, "plane": 1, "quadratic": 2}
HIGHEST_DEGREE = 20
"""Highest degree of a polynomial form: 231 coefficients."""

_NORMAL = 1.482602218505602  # standard deviation of a normal distribution over its median absolute deviation
_ROBUST_WIDTH = 3.0 * _NORMAL
_ROBUST_PASSES = 50
_FACTORISED_TOGETHER = 1 << 16  # points in one block of the orthogonal factorisation, to bound its memory


def usual_form(surface: Surface) -> str:
    """What is removed where no form is asked for: the ``mean`` of a periodic surface, whose plane
    is part of it, else the ``plane``."""
    return "mean" if surface.periodic else "plane"


def levelled(surface: Surface, form: str | int | None = None, *, robust: bool = False) -> Surface:
    """Surface less its least-squares ``form`` over the valid points.

    The form is a polynomial Σ c_ab x^a y^b of total degree a + b <= 0 (``mean``), 1 (``plane``), 2
    (``quadratic``) or of any whole number up to 20, found by QR factorisation in products of
    Legendre polynomials on [-1, 1]². Levelling is a high-pass filter: it reduces the rms height of
    a surface with waves as long as the map, the more the higher the degree. A periodic surface
    stays periodic only if no more than the mean is removed. Raises InputError if the form is
    unknown or the valid points do not determine it (all on one line, for example).

    Parameters
    ----------
    surface
        Surface; missing points have no weight.
    form
        ``mean``, ``plane``, ``quadratic`` or the total degree; by default the mean of a periodic
        surface and the plane of any other.
    robust
        Repeat the fit without the points more than three standard deviations (3 x 1.4826 MAD) from
        it, until the excluded points no longer change: for surfaces whose peaks or pits would tilt
        the plane.
    """
    form = usual_form(surface) if form is None else form
    if isinstance(form, str):
        degree, name = _DEGREES[require.one_of(form, _DEGREES, "form to be removed")], form
    else:
        degree = require.integer(form, 0, "degree of the form to be removed")
        if degree > HIGHEST_DEGREE:
            raise InputError(
                f"degree of the form to be removed must be at most {HIGHEST_DEGREE}, but is {degree}; filter instead."
            )
        named = {known: name for name, known in _DEGREES.items()}
        name = named.get(degree, f"polynomial of degree {degree}")
    used = ~surface.mask
    before: RealArray = surface.heights.astype(np.float64, copy=False)
    fit = _fitted(surface, used, degree, name)
    for _ in range(_ROBUST_PASSES if robust else 0):
        distance = np.abs(before - fit)
        width = _ROBUST_WIDTH * float(np.median(distance[~surface.mask]))
        kept = ~surface.mask & (distance <= width) if width > 0.0 else used
        if np.array_equal(kept, used):
            break
        used = kept
        fit = _fitted(surface, used, degree, name)
    how = f", robustly without {int(np.count_nonzero(~used & ~surface.mask))} points" if robust else ""
    return recorded(surface, before - fit, f"levelled: {name} removed{how}", periodic=surface.periodic and degree == 0)


def _fitted(surface: Surface, used: BoolArray, degree: int, form: str) -> RealArray:
    """Polynomial at all nodes, shape (nx, ny), m, by least squares over those ``used``."""
    along_x, along_y = (  # Legendre polynomials at equally spaced points on [-1, 1], (n, degree + 1)
        np.polynomial.legendre.legvander(np.linspace(-1.0, 1.0, n) if n > 1 else np.zeros(1), degree)
        for n in surface.shape
    )
    powers = [(a, b) for a in range(degree + 1) for b in range(degree + 1 - a)]
    offset = float(np.nanmean(surface.heights))
    triangle: RealArray = np.zeros((0, len(powers) + 1))
    rows = max(1, _FACTORISED_TOGETHER // surface.shape[1])
    for start in range(0, surface.shape[0], rows):
        part = slice(start, start + rows)
        valid = used[part]
        columns = [(along_x[part, None, a] * along_y[None, :, b])[valid] for a, b in powers]
        block = np.column_stack([*columns, surface.heights[part][valid].astype(np.float64) - offset])
        triangle = np.linalg.qr(np.vstack([triangle, block])).R
    unknowns = len(powers)
    diagonal = np.abs(np.diag(triangle))[:unknowns]
    if diagonal.size < unknowns or diagonal.min() < 1e-10 * diagonal.max():
        raise InputError(
            f"surface must have enough valid points, not all on one line, to fit a {form} ({unknowns} coefficients), "
            "but has not. Use a lower form or fill the missing points."
        )
    coefficients = np.zeros((degree + 1, degree + 1))
    solution = np.linalg.solve(triangle[:unknowns, :unknowns], triangle[:unknowns, unknowns])
    for (a, b), value in zip(powers, solution, strict=True):
        coefficients[a, b] = value
    return along_x @ coefficients @ along_y.T + offset


# Spikes and scan lines.


_SORTED_TOGETHER = 1 << 18  # heights, to bound the memory


@checked
def despiked(
    surface: Surface,
    threshold: Annotated[Positive, "standard deviations beyond which a point is a spike"] = 6.0,
    *,
    window: Annotated[int, Whole(3, odd=True), "nodes along a side of the neighbourhood"] = 5,
) -> Surface:
    """Surface whose spikes are missing points: nodes far from the median of their ``window`` x
    ``window`` neighbourhood.

    The limit is ``threshold`` standard deviations of these distances, estimated robustly from their
    median (1.4826 MAD). Fill the points afterwards, or leave them missing. Heights are never
    clipped.
    """
    half = window // 2
    heights: RealArray = surface.heights.astype(np.float64)
    mode: Any = {"mode": "wrap"} if surface.periodic else {"mode": "constant", "constant_values": np.nan}
    padded = np.pad(heights, half, **mode)
    median = np.empty(heights.shape)  # of the valid heights around every node, NaN where there are none
    rows = max(1, _SORTED_TOGETHER // (window**2 * heights.shape[1]))
    for start in range(0, heights.shape[0], rows):
        end = min(start + rows, heights.shape[0])
        block = np.lib.stride_tricks.sliding_window_view(padded[start : end + 2 * half], (window, window))
        values = np.sort(block.reshape(end - start, heights.shape[1], window**2), axis=-1)  # NaN last
        around = np.count_nonzero(~np.isnan(values), axis=-1)
        below, above = (
            np.take_along_axis(values, np.clip(at, 0, window**2 - 1)[..., None].astype(np.intp), axis=-1)[..., 0]
            for at in ((around - 1) // 2, around // 2)
        )
        median[start:end] = 0.5 * (below + above)
        median[start:end][around == 0] = np.nan
    distance = np.abs(heights - median)
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


@checked
def line_corrected(
    surface: Surface, axis: Annotated[Axis, "fast axis, along which the scan lines run"] = "x"
) -> Surface:
    """Surface without the offsets between scan lines: the lines run along the fast ``axis`` of the
    instrument.

    The offset of a line is the cumulative sum of the medians of the differences between successive
    lines. Height variations only across the lines are removed as well; spectra and slopes along the
    lines are unchanged.
    """
    lines = surface.heights.astype(np.float64)
    lines = lines if axis == "x" else lines.T  # lines[:, j] is one scan line
    differences = [line[~np.isnan(line)] for line in np.diff(lines, axis=1).T]
    steps = [float(np.median(numbers)) if numbers.size else 0.0 for numbers in differences]
    offsets = np.concatenate([[0.0], np.cumsum(steps)])
    offsets -= offsets.mean()
    corrected = lines - offsets[None, :]
    text = f"line-corrected: offsets between lines along {axis} (rms {show(float(offsets.std()), 'm', 3)}) removed"
    return recorded(surface, corrected if axis == "x" else corrected.T, text, periodic=surface.periodic)


# Filling of missing points.


_Indices: TypeAlias = NDArray[np.signedinteger[Any]]

FillMethod: TypeAlias = Literal["harmonic", "mean", "nearest"]
_METHODS = {"harmonic": "harmonic interpolation", "mean": "the mean height", "nearest": "the nearest valid height"}


@checked
def filled(surface: Surface, method: Annotated[FillMethod, "how missing points are filled"] = "harmonic") -> Surface:
    """Surface without missing points; valid points are unchanged and the history records how many
    were filled.

    ``harmonic`` solves ∇²h = 0 in every hole with the heights on its rim (zero normal slope at the
    border of the map), ``nearest`` takes the closest valid height and ``mean`` the mean of the
    valid heights. Fills are smooth: they reduce mean square slopes and curvatures near the holes.
    """
    if surface.n_missing == 0:
        return surface
    heights = surface.heights.astype(np.float64)
    if method == "mean":
        heights[surface.mask] = np.nanmean(surface.heights, dtype=np.float64)
    elif method == "nearest":
        from scipy.ndimage import distance_transform_edt

        pad = [(n // 2, n // 2) for n in surface.shape] if surface.periodic else [(0, 0), (0, 0)]
        missing = np.pad(surface.mask, pad, mode="wrap") if surface.periodic else surface.mask
        indices = distance_transform_edt(
            missing, sampling=surface.grid.spacing, return_distances=False, return_indices=True
        )
        window = tuple(slice(before, before + n) for (before, _), n in zip(pad, surface.shape, strict=True))
        rows, columns = ((indices[axis][window][surface.mask] - pad[axis][0]) % surface.shape[axis] for axis in (0, 1))
        heights[surface.mask] = surface.heights[rows, columns]
    else:
        heights[surface.mask] = _harmonic(surface)
    share = surface.n_missing / surface.grid.n_points
    hole = show(float(np.sqrt(surface.n_missing * surface.grid.pixel_area)), "m", 3)
    step = f"filled: {surface.n_missing} points ({share:.2%}, {hole} squared) by {_METHODS[method]}"
    return surface.with_heights(heights, step)


def _harmonic(surface: Surface) -> RealArray:
    """Heights of the missing points from the five-point Laplace equation, in the order of the mask.

    Points beyond the border of a map that is not periodic have no weight.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.linalg import spsolve

    missing = np.flatnonzero(surface.mask)
    number = np.full(surface.grid.n_points, -1)
    number[missing] = np.arange(missing.size)
    flat = surface.heights.ravel()
    rows, columns, values = [], [], []
    diagonal, right = np.zeros(missing.size), np.zeros(missing.size)
    points = np.unravel_index(missing, surface.shape)
    smallest = min(surface.grid.spacing)
    for axis, shift in itertools.product((0, 1), (-1, 1)):
        weight, n = (smallest / surface.grid.spacing[axis]) ** 2, surface.shape[axis]
        moved = [points[0], points[1]]
        moved[axis] = moved[axis] + shift
        inside = (moved[axis] >= 0) & (moved[axis] < n)
        if surface.periodic:
            moved[axis], inside = moved[axis] % n, np.ones(missing.size, dtype=bool)
        here = np.flatnonzero(inside)
        neighbour = moved[0][inside] * surface.shape[1] + moved[1][inside]
        diagonal += np.bincount(here, minlength=missing.size) * weight
        inner = number[neighbour] >= 0
        rows.append(here[inner])
        columns.append(number[neighbour[inner]])
        values.append(np.full(np.count_nonzero(inner), -weight))
        right += np.bincount(here[~inner], weights=weight * flat[neighbour[~inner]], minlength=missing.size)
    every = np.arange(missing.size)
    entries = (np.concatenate([*values, diagonal]), (np.concatenate([*rows, every]), np.concatenate([*columns, every])))
    matrix = coo_array(entries, shape=(missing.size, missing.size)).tocsc()
    return np.atleast_1d(np.asarray(spsolve(matrix, right), dtype=np.float64))
