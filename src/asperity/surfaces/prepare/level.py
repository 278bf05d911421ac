"""Levelling, removal of spikes and of offsets between scan lines, filling of missing points, and
the codes that stand for them."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import Annotated, Any, Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.errors import InputError
from ...core.parameters import checked
from ...core.scipy_parts import ndimage, optimize, sparse, sparse_linalg
from ...core.status import Advice
from ...core.units import show
from ...core.values import Axis, Positive, Whole
from ..characterise.heights import rms_height
from ..profile import Profile
from ..surface import Surface, lines_too, maps_only

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


def usual_form(surface: Surface | Profile) -> str:
    """What is removed where no form is asked for: the ``mean`` of a periodic surface, whose plane
    is part of it, else the ``plane``."""
    return "mean" if surface.periodic else "plane"


@lines_too
def levelled(surface: Surface, form: str | int | None = None, *, robust: bool = False) -> Surface:
    """Surface less its least-squares ``form`` over the valid points.

    Of a line scan the form is a polynomial of x, ``line`` being that of degree 1, or the ``arc`` of
    a circle. Of a map the form is a polynomial Σ c_ab x^a y^b of total degree a + b <= 0
    (``mean``), 1 (``plane``), 2 (``quadratic``) or of any whole number up to 20, found by QR
    factorisation in products of Legendre polynomials on [-1, 1]². Levelling is a high-pass filter:
    it reduces the rms height of a surface with waves as long as the map, the more the higher the
    degree. A periodic surface stays periodic only if no more than the mean is removed. Raises
    InputError if the form is unknown or the valid points do not determine it (all on one line, for
    example).

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
    scan = surface.shape[1] == 1
    degrees = _DEGREES | ({"line": 1} if scan else {})
    if scan and form == "arc":
        arc = _arc(surface)
        removed = f"levelled: arc of radius {show(abs(arc.radius), 'm')} removed"
        return recorded(surface, surface.heights - arc.heights, removed, periodic=False)
    if isinstance(form, str):
        degree, name = degrees[require.one_of(form, (*degrees, "arc") if scan else degrees, "form to be removed")], form
    else:
        degree = require.integer(form, 0, "degree of the form to be removed")
        if degree > HIGHEST_DEGREE:
            raise InputError(
                f"degree of the form to be removed must be at most {HIGHEST_DEGREE}, but is {degree}; filter instead."
            )
        named = {known: name for name, known in _DEGREES.items()}
        name = named.get(degree, f"polynomial of degree {degree}")
    name = "line" if scan and degree == 1 else name
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
    across = 1 if surface.shape[1] == 1 else degree + 1  # along y there is nothing to fit on a single line
    powers = [(a, b) for a in range(degree + 1) for b in range(min(across, degree + 1 - a))]
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


class Arc(NamedTuple):
    """Circle fitted to a line: ``heights`` (n, 1) in m at all its points, and ``radius`` in m,
    negative if hollow."""

    heights: RealArray
    radius: float


def _arc(surface: Surface) -> Arc:
    """Least-squares circle through the valid points of a strip (n, 1).

    With slope tan θ and curvature κ at the middle, z = z0 + (2 u sin θ + κ u²)/(cos θ + sqrt(cos²
    θ - 2 κ u sin θ - κ² u²)), which is a line for κ = 0. Raises InputError if the points do not
    determine it.
    """
    used = ~surface.mask[:, 0]
    if np.count_nonzero(used) < 4:
        raise InputError(
            f"profile must have at least four valid points to fit an arc, but has {np.count_nonzero(used)}. "
            "Use a lower form."
        )
    u = (np.arange(surface.shape[0]) - 0.5 * (surface.shape[0] - 1)) * surface.dx
    heights = surface.heights[:, 0].astype(np.float64)

    def circle(values: RealArray) -> RealArray:
        z0, slope, kappa = (float(value) for value in values)
        sine, cosine = math.sin(math.atan(slope)), math.cos(math.atan(slope))
        root = cosine**2 - 2.0 * kappa * u * sine - np.square(kappa * u)
        return np.asarray(z0 + (2.0 * u * sine + kappa * u**2) / (cosine + np.sqrt(np.maximum(root, 1e-12))))

    parabola = np.polyfit(u[used], heights[used], 2)[::-1] * np.array([1.0, 1.0, 2.0])
    spread = float(np.std(heights[used])) or 1.0
    scales = np.array([spread, spread / surface.size[0], spread / surface.size[0] ** 2])

    def residual(scaled: RealArray) -> RealArray:
        return np.asarray((circle(scaled * scales)[used] - heights[used]) / spread)

    found = optimize.least_squares(residual, parabola / scales, xtol=1e-14, ftol=1e-14)
    kappa = float(found.x[2] * scales[2])
    return Arc(circle(found.x * scales)[:, None], -1.0 / kappa if kappa else math.inf)


# Spikes and scan lines.


_SORTED_TOGETHER = 1 << 18  # heights, to bound the memory


@lines_too
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
    step = f"despiked: {count} points more than {limit} from the median of {_near(surface, window)} points masked"
    heights = np.where(spikes, np.nan, surface.heights)
    return recorded(surface, heights, step, periodic=surface.periodic)


def _near(surface: Surface, window: int) -> str:
    return f"{window}" if surface.shape[1] == 1 else f"{window} x {window}"


@maps_only
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


@lines_too
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
        pad = [(n // 2, n // 2) for n in surface.shape] if surface.periodic else [(0, 0), (0, 0)]
        missing = np.pad(surface.mask, pad, mode="wrap") if surface.periodic else surface.mask
        indices = ndimage.distance_transform_edt(
            missing, sampling=surface.grid.spacing, return_distances=False, return_indices=True
        )
        window = tuple(slice(before, before + n) for (before, _), n in zip(pad, surface.shape, strict=True))
        rows, columns = ((indices[axis][window][surface.mask] - pad[axis][0]) % surface.shape[axis] for axis in (0, 1))
        heights[surface.mask] = surface.heights[rows, columns]
    else:
        heights[surface.mask] = _harmonic(surface)
    share = surface.n_missing / surface.grid.n_points
    hole = show(float(np.sqrt(surface.n_missing * surface.grid.pixel_area)), "m", 3) + " squared"
    if surface.shape[1] == 1:
        hole = show(surface.n_missing * surface.dx, "m", 3)
    step = f"filled: {surface.n_missing} points ({share:.2%}, {hole}) by {_METHODS[method]}"
    return surface.with_heights(heights, step)


def _harmonic(surface: Surface) -> RealArray:
    """Heights of the missing points from the five-point Laplace equation, in the order of the mask.

    Points beyond the border of a map that is not periodic have no weight.
    """
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
    matrix = sparse.coo_array(entries, shape=(missing.size, missing.size)).tocsc()
    return np.atleast_1d(np.asarray(sparse_linalg.spsolve(matrix, right), dtype=np.float64))


# Codes for missing points, clipping and spikes: rules of one repeated value far outside, and of
# different values.


Places: TypeAlias = np.ndarray[tuple[int, ...], np.dtype[np.intp]]
"""Whole numbers: places of points, and how often values occur."""

SPIKES = "spikes"
"""Criterion of findings on single points far outside."""

MISSING_CODE = "missing points"
"""Criterion of findings on codes for missing points."""

_FEW = 4  # times that a value occurs before it counts as repeated
_NEAR = 0.02  # of the 1-99 % range of the others: a gap up to it is none
_SPIKE = 6.0 * 1.4826  # times the median distance from the median of 5 x 5 points


@dataclass(frozen=True)
class Code:
    """What an extreme ``value`` is: ``"missing"``, ``"ask"`` or ``"clipped"``, and of how many
    points."""

    verdict: str
    value: float
    count: int


def codes(values: RealArray) -> tuple[Code, ...]:
    """What the smallest and largest of ``values`` (any shape, NaN missing) are, one after the
    other.

    A code is one repeated value far outside the others; maps of fewer than three distinct values
    are gratings.
    """
    found: list[Code] = []
    finite = values[np.isfinite(values)]
    if finite.size == 0 or max(int(np.count_nonzero(finite == end)) for end in (finite.min(), finite.max())) < _FEW:
        return ()
    distinct, counts = np.unique(finite, return_counts=True)
    while distinct.size >= 3:
        hit = _extreme(distinct, counts)
        if hit is None:
            break
        found.append(hit[0])
        distinct, counts = np.delete(distinct, hit[1]), np.delete(counts, hit[1])
    return tuple(found)


def _extreme(distinct: RealArray, counts: Places) -> tuple[Code, int] | None:
    """Verdict on the first extreme value that is none of the others, and its place; None if both
    are like the others."""
    n = int(counts.sum())
    for place in (0, distinct.size - 1):
        count = int(counts[place])
        if count < _FEW:
            continue
        others, times = np.delete(distinct, place), np.delete(counts, place)
        gap = float(abs(distinct[place] - others[0 if place == 0 else -1]))
        extent = float(others[-1] - others[0])
        share = np.cumsum(times) / times.sum()
        inner = float(others[np.searchsorted(share, 0.99)] - others[np.searchsorted(share, 0.01)])
        usual = float(np.median(times))
        if gap > 2.0 * extent and count <= n / 4:
            verdict = "missing"
        elif gap > 0.5 * extent or (usual == 1.0 and gap > _NEAR * inner):
            verdict = "ask"
        elif count >= max(_FEW, 10.0 * usual) and gap <= _NEAR * inner:
            verdict = "clipped"
        else:
            continue
        return Code(verdict, float(distinct[place]), count), place
    return None


_BLOCK = 1 << 20  # points that are compared with their neighbours at a time


def spikes(values: RealArray) -> BoolArray:
    """Where ``values`` (nx, ny) lie far from the median of their 5 x 5 neighbourhood.

    Only points that stick out of their neighbours two points away are compared; the scale is that
    of a sample.
    """
    marked = np.zeros(values.shape, dtype=bool)
    if min(values.shape) < 5:
        return marked
    padded = np.pad(values.astype(np.float64), 2, mode="reflect")
    sample = np.argwhere(np.isfinite(values))
    sample = sample[:: max(1, len(sample) // 20_000)]
    if len(sample) < 25:
        return marked
    usual = float(np.nanmedian(_outside(padded, sample[:, 0], sample[:, 1])))
    scale = float(np.nanmedian(_distances(padded, sample)))
    if not usual > 0.0 or not scale > 0.0:
        return marked
    (nx, ny), found = values.shape, []
    columns = np.arange(ny)[None, :]
    for start in range(0, nx, max(1, _BLOCK // ny)):
        lines = np.arange(start, min(nx, start + max(1, _BLOCK // ny)))[:, None]
        hit = np.argwhere(_outside(padded, lines, columns) > 0.5 * _SPIKE * usual)
        found.append(hit + np.array([start, 0]))
    outside = np.concatenate(found)
    if 0 < len(outside) <= 0.05 * values.size:
        far = _distances(padded, outside) > _SPIKE * scale
        marked[tuple(outside[far].T)] = True
    return marked


def _outside(padded: RealArray, i: Places, j: Places) -> RealArray:
    """How far the values at (i, j) stick out of the two middle ones of the four that are two points
    away."""
    around = np.stack([padded[i + di, j + dj] for di, dj in ((0, 2), (4, 2), (2, 0), (2, 4))])
    found: RealArray = np.abs(
        padded[i + 2, j + 2] - 0.5 * (around.sum(axis=0) - around.max(axis=0) - around.min(axis=0))
    )
    return found


def _distances(padded: RealArray, places: Places) -> RealArray:
    """Distance of the values at ``places`` from the median of the 5 x 5 values around them."""
    steps = np.arange(5)
    block = padded[places[:, 0, None, None] + steps[None, :, None], places[:, 1, None, None] + steps[None, None, :]]
    found: RealArray = np.abs(block[:, 2, 2] - np.nanmedian(block.reshape(len(places), 25), axis=1))
    return found


def value_findings(values: RealArray, unit: str) -> tuple[Advice, ...]:
    """Findings on ``values`` (nx, ny) as they stand in the file, in its ``unit``."""
    values = np.where(np.isfinite(values), values, np.nan)
    with np.errstate(all="ignore"):  # of numbers that are damaged
        return _value_findings(values, unit)


def _value_findings(values: RealArray, unit: str) -> tuple[Advice, ...]:
    made = []
    found = codes(values)
    for code in found:
        text = f"{code.count} points have the value {code.value:.6g} {unit}".rstrip()
        numbers = {"value": code.value, "points": float(code.count)}
        if code.verdict == "missing":
            fact = (
                f"{text}, far outside all others: it stands for missing points as it seems, and was taken for a height."
            )
            made.append(Advice("warning", MISSING_CODE, fact, f"State it ({{missing}}: {code.value:.6g}).", numbers))
        elif code.verdict == "ask":
            fact = f"{text}, outside all others: a flat floor or top, or a code for missing points."
            remedy = f"If it is a code, state it ({{missing}}: {code.value:.6g})."
            made.append(Advice("warning", MISSING_CODE, fact, remedy, numbers))
        else:
            fact = f"{text}, the end of the instrument's range: heights are clipped there."
            made.append(Advice("note", "clipped heights", fact, numbers=numbers))
    if not any(code.verdict in ("missing", "ask") for code in found) and (far := spikes(values)).any():
        made.append(_spikes_found(values, far, unit))
    return tuple(made)


_AS_CODES = 100.0
"""Standard deviations from the median beyond which a spike is taken for a code by those who look at
it."""


def _spikes_found(values: RealArray, far: BoolArray, unit: str) -> Advice:
    """The finding on ``values`` that are ``far`` from their neighbours."""
    count, lowest, highest = int(far.sum()), float(values[far].min()), float(values[far].max())
    rest, middle = float(np.nanstd(np.where(far, np.nan, values))), float(np.nanmedian(values))
    outside = max(lowest, highest, key=lambda value: abs(value - middle))
    worst = abs(outside - middle) / rest if rest > 0.0 else np.inf
    extent = f"{lowest:.6g} {unit}" if count == 1 else f"{lowest:.6g} to {highest:.6g} {unit}"
    fact = f"{count} point{'s stick' if count > 1 else ' sticks'} out of the neighbours: spikes ({extent.rstrip()})."
    numbers = {"points": float(count), "distance": worst}
    if worst <= _AS_CODES:
        return Advice("note", SPIKES, fact, "Mask them ({despike}).", numbers)
    fact += f" The farthest lies {worst:.0f} standard deviations off, as codes for missing points do."
    remedy = f"Mask them ({{despike}}), or if {outside:.6g} is a code, state it ({{missing}}: {outside:.6g})."
    return Advice("warning", SPIKES, fact, remedy, numbers)
