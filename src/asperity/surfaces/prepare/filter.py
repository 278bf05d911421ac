"""Areal filters: waves shorter than one length and longer than another are removed."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.spectral import RealTransform, thread_count
from ...core.units import show
from ..surface import Surface
from .regression import LocalRegression, local_regression
from .steps import recorded, require_complete

Cutoff: TypeAlias = float | tuple[float, float]
"""Wavelength in m, or one along x and one along y."""

KINDS = ("gaussian", "robust", "sharp")
"""Filters."""

FINEST = 4.0
"""Shortest cut-off in pixels: at 3 pixels 56 % of the wave would pass instead of half."""

_BIWEIGHT = 4.4478  # times the median of |residual|: three standard deviations of normal residuals
_LEAST_WEIGHT = 1e-6  # of an outlier, so that no neighbourhood is without any weight
_SETTLED = 1e-3  # relative change of the biweight's width at which the robust iteration ends
_MOST_PASSES = 50
_ROUNDING = 1e-9


def filtered(
    surface: Surface,
    *,
    short: Cutoff | None = None,
    long: Cutoff | None = None,
    kind: str = "gaussian",
    order: int = 0,
    reach: float = 1.0,
) -> Surface:
    """Surface without waves shorter than ``short`` (S-filter) and longer than ``long`` (L-filter); one or both.

    ``gaussian`` (ISO 16610-61): a wave of the length of the cut-off passes by one half, one of λ by 2^-(short/λ)². Missing
    points and borders take no part: the weights of the valid nodes in reach are normalised. ``robust`` (ISO 16610-71): nodes
    far from the smooth surface lose weight, (1 - (r/c)²)² with c = 4.4478 times the median of |r|, until c settles; spikes
    and deep valleys then leave no halo. ``sharp``: all waves between the cut-offs pass whole and all others are removed, for
    periodic surfaces only. Missing points stay missing.

    Parameters
    ----------
    surface
        Surface; level it first, since smoothing bends a tilt at the borders (not with ``order`` 1 or 2).
    short, long
        Wavelengths in m, or pairs (along x, along y), of at least four pixels (two for ``sharp``), short < long.
    kind
        ``gaussian``, ``robust`` or ``sharp``.
    order
        Of the polynomial fitted around each node: 0 as in ISO 16610-61; 1 keeps tilts and 2 curved forms up to the borders.
    reach
        Half width of the window in cut-offs; 1 is exact to 2e-7, 0.5 to 1 %.

    Raises
    ------
    InputError
        If no cut-off is given, one is out of range, they are out of order, or a sharp filter is asked for where it cannot be.
    """
    require.one_of(kind, KINDS, "kind of filter")
    if order not in (0, 1, 2):
        raise InputError(f"order of a filter must be 0, 1 or 2, but is {order!r}.")
    reach = require.positive(reach, "reach of a filter (cut-offs)")
    cutoffs = _cutoffs(surface, short, long, 2.0 if kind == "sharp" else FINEST)
    heights: RealArray = surface.heights.astype(np.float64)
    if kind == "sharp":
        heights = _sharp(surface, cutoffs)
    else:
        for name, cutoff in cutoffs.items():
            fit = local_regression(surface.grid, cutoff, order=order, periodic=surface.periodic, reach=reach)
            smooth = _robust(heights, surface, fit) if kind == "robust" else fit.smooth(*_weighted(heights, surface))
            heights = smooth if name == "short" else heights - smooth
            heights[surface.mask] = np.nan
    words = ", ".join(f"{name} waves from {_text(cutoff)}" for name, cutoff in cutoffs.items())
    what = kind if order == 0 else f"{kind} of order {order}"
    keys = {"gaussian": ("ISO16610-61",), "robust": ("ISO16610-71",), "sharp": ()}[kind]
    return recorded(
        surface, heights, f"filtered: {words} on removed, {what}", periodic=surface.periodic, citation_keys=keys
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
        found[name] = (lengths[0], lengths[1])
    if not found:
        raise InputError("cut-off of a filter must be given, short or long or both, but neither is.")
    if len(found) == 2 and not all(a < b for a, b in zip(found["short"], found["long"], strict=True)):
        raise InputError(
            f"short cut-off of a filter must be below the long one, but they are {short!r} and {long!r} m."
        )
    return found


def _weighted(heights: RealArray, surface: Surface) -> tuple[RealArray, RealArray]:
    """Heights with 0 at missing points, and the weights 1 and 0."""
    weights = (~surface.mask).astype(np.float64)
    return np.where(surface.mask, 0.0, heights), weights


def _robust(heights: RealArray, surface: Surface, fit: LocalRegression) -> RealArray:
    """Smooth surface by iteratively reweighted fits (ISO 16610-71)."""
    values, valid = _weighted(heights, surface)
    weights, width = valid.copy(), np.inf
    smooth = values
    for _ in range(_MOST_PASSES):
        smooth = fit.smooth(values, weights)
        residual = np.where(surface.mask, 0.0, values - smooth)
        before, width = width, _BIWEIGHT * float(np.median(np.abs(residual[~surface.mask])))
        if width == 0.0 or abs(before - width) <= _SETTLED * width:
            break
        biweight = np.square(np.maximum(1.0 - np.square(residual / width), 0.0))
        weights = valid * np.maximum(biweight, _LEAST_WEIGHT)
    return smooth


def _sharp(surface: Surface, cutoffs: dict[str, tuple[float, float]]) -> RealArray:
    """Heights of the waves between the cut-offs; the mean passes a short cut-off alone."""
    require_complete(surface, "filtered sharply")
    if not surface.periodic:
        raise InputError(
            "surface must be periodic for a sharp filter, whose waves would run around its borders, but is not. "
            "Use the gaussian filter, or periodised() first."
        )
    transform = RealTransform(surface.shape, thread_count())
    modes = transform.forward(surface.heights.astype(np.float64))
    qx, qy = surface.grid.wavevector()
    for name, (along_x, along_y) in cutoffs.items():
        ratio = np.hypot(qx * along_x, qy * along_y) / (2.0 * np.pi)  # cut-off over wavelength
        modes *= ratio <= 1.0 + _ROUNDING if name == "short" else ratio >= 1.0 - _ROUNDING
    return transform.backward(modes)


def _text(cutoff: tuple[float, float]) -> str:
    along_x, along_y = (show(length, "m") for length in cutoff)
    return along_x if cutoff[0] == cutoff[1] else f"{along_x} along x and {along_y} along y"
