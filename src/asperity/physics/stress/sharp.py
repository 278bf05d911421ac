"""Largest stresses at the surface of a contact, which lie on its edges between the pixels, with
their errors.

Under shear traction μ p the stress along a surface is finite at the edge of a contact and falls
from there by 2 μ k √δ at a distance δ outside: values at pixels are low by the root of the pixel,
27 % of σ1 of a sphere of 8 pixels. What is singular in it is the slope of the undeformed surface,
which is known, since i k p/|k| = ½E* ∂u in Fourier space and ∂u = ∂h in contact. So the error of
the slope that the pixels give is taken out of the stress inside, and the stress on the edge is
found from the pixels on both sides: what remains is smooth but for parts that are in proportion to
the pressure or to the slope. Slopes at the edge are interpolated, never extrapolated.

The bars are those with which 402 contacts of 3 to 40 pixels, spheres and rough surfaces, held the
truth from 8 pixels in the shortest wave or radius on.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...core.arrays import RealArray
from ...core.grid import Grid
from ...core.spectral import PaddedTransform, RealTransform, fast_length, wrapped
from ...core.tensor import StressTensor
from ...solids.compliance.halfspace import HalfSpace
from .field import StressField
from .largest import EXACT, largest
from .peaks import Peak, SurfaceMaxima
from .regions import Plane
from .tractions import ShearTraction, Sliding, Tractions

LEAST_COSINE = 0.6
"""Least cosine of the normal of an edge with the axis of a pair: more oblique pairs do not tell
where it is."""

FACTOR, SPREAD, SECOND = 1.3, 0.1, 0.03
"""Of the bar: on all of it, pixels added to the spread of the place, share of the error of the
slope that was taken out."""

SINGLE = 0.3
"""The same share where the contact has no second pixel inwards."""

NORMAL, ROUNDING = 0.04, 0.01
"""Error of the stress by the pressure over the pressure at the last pixel: of its part across the
edge, times 1 - 2ν, and of the rest."""

INSIDE, SHARE = 0.1, 0.015
"""Of the bar inside: share of the error of the slope, and of the stress."""

SHEARED = 0.03
"""Added to the bar, over the stress, where the shear traction changes the pressure: the edge has
another exponent then."""

FEWEST_PIXELS = 28
"""Pixels in a spot, a radius of 3, below which errors reach 30 to 50 %."""

ROUGHEST, UNRESOLVED = 0.008, 0.2
"""Rms difference of slopes by sixth and fourth order over that of the slopes at the edges: more of
it than with about 6 pixels in the shortest wave; and that of surfaces whose slope, and so the
tension, has no limit as the grid is refined."""

_SIXTH = (45.0 / 60.0, -9.0 / 60.0, 1.0 / 60.0)
_FOURTH = (8.0 / 12.0, -1.0 / 12.0)


@dataclass(eq=False, repr=False)
class AtEdges:
    """Largest stresses at the surface of a ``body`` of a contact ``result`` under ``loads``, its
    tractions on that body; found at the first call.

    ``planes`` makes the planes of stress of a body under tractions, as ``compute.StressPlanes``;
    ``known`` are the components xx, yy, xy (nx, ny) in Pa of its surface under ``loads``, if
    somebody has computed them.
    """

    result: Any
    loads: Tractions
    body: object
    planes: Callable[..., Any]
    known: tuple[RealArray, RealArray, RealArray] | None = None

    def beside(self, field: StressField) -> AtEdges:
        """The same, which takes the stresses at the surface from a ``field`` under the same loads
        if that holds them in double precision."""
        numbers = [number for number, plane in enumerate(field.planes) if plane.side == "surface"]
        s = field.tensor
        if not numbers or field.dims != ("plane", "x", "y") or s.xx.dtype != np.float64:
            return self
        return replace(self, known=(s.xx[numbers[0]], s.yy[numbers[0]], s.xy[numbers[0]]))

    def __call__(self) -> SurfaceMaxima | None:
        """None where nothing is known of the edges: no contact, or attraction that holds them."""
        return self._found

    @cached_property
    def _found(self) -> SurfaceMaxima | None:
        answers = getattr(self.result, "answers", ())
        attracted = any(answer.traction_beside() is not None for answer in answers)
        if not self.result.pressure.any() or (attracted and not self.result.edges.two.any()):
            return None
        surface = _Surface.of(self)
        edge = _Edge.of(surface)
        return SurfaceMaxima(*(surface.peak(edge, name) for name in EXACT))


class _Fields(NamedTuple):
    """Components xx, yy, xy (3, …) in Pa by pressure and by shear traction."""

    by_pressure: RealArray
    by_shear: RealArray


@dataclass(frozen=True, eq=False)
class _Surface:
    """The surface of a body under a contact: ``fields`` at the pixels, errors ``wrong`` (2, nx, ny)
    of the slopes that they contain, ``ratio`` of shear traction to pressure."""

    result: Any
    loads: Tractions
    plane: Plane
    modulus: float
    fields: _Fields
    wrong: RealArray
    ratio: tuple[RealArray, RealArray]

    @classmethod
    def of(cls, asked: AtEdges) -> _Surface:
        """With the stresses computed and the errors of the slopes taken out of them in contact."""
        result, loads, grid, p = asked.result, asked.loads, asked.loads.grid, asked.loads.pressure
        bare = Tractions(grid, p, Sliding(0.0), loads.boundary, loads.datum)
        normal = next(asked.planes(bare, asked.body, [0.0]).each())
        by_pressure, plane = _in_plane(normal.tensor), normal.planes[0]
        del normal  # six fields, of which three are needed
        by_shear, wrong = np.zeros_like(by_pressure), np.zeros((2, *grid.shape))
        ratio = (np.zeros(grid.shape), np.zeros(grid.shape))
        modulus = float(result.problem.contact_modulus)
        if loads.sheared:
            shear = np.asarray(loads.shear_x), np.asarray(loads.shear_y)
            if asked.known is not None:
                np.subtract(asked.known, by_pressure, out=by_shear)
            else:
                sheared = Tractions(grid, np.zeros(grid.shape), ShearTraction(*shear), loads.boundary, loads.datum)
                by_shear = _in_plane(next(asked.planes(sheared, asked.body, [0.0]).each()).tensor)
            at = np.flatnonzero(p > 0.0)
            pressed = p.ravel()[at]
            for of, q in zip(ratio, shear, strict=True):
                of.ravel()[at] = q.ravel()[at] / pressed
            wrong.reshape(2, -1)[:, at] = _slope_errors(result).reshape(2, -1)[:, at]
            wrong_there, ratio_there = wrong.reshape(2, -1)[:, at], (ratio[0].ravel()[at], ratio[1].ravel()[at])
            nu = plane.region.material.poisson_ratio
            by_shear.reshape(3, -1)[:, at] += _by_slopes(wrong_there, ratio_there, nu, modulus)
        return cls(result, loads, plane, modulus, _Fields(by_pressure, by_shear), wrong, ratio)

    @property
    def nu(self) -> float:
        """Poisson's ratio at the surface."""
        return self.plane.region.material.poisson_ratio

    def peak(self, edge: _Edge, name: str) -> Peak:
        """The largest stress of this ``name``, at pixels or on the ``edge`` between them."""
        chosen, inside = largest(name, self._stress, SHARE, self._doubt.ravel())
        inside_bars = self._doubt.ravel()[chosen] + SHARE * np.abs(inside)
        best = int(np.argmax(inside))
        along = StressTensor(edge.stress[0], edge.stress[1], edge.none, edge.stress[2], edge.none, edge.none)
        values = EXACT[name](along)
        bars = edge.bars
        more = SHEARED if getattr(self.result, "sliding", None) is not None else 0.0
        at_edge = int(np.argmax(values)) if values.size else -1
        highest = max(float((inside + inside_bars).max()), float((values + bars).max(initial=-math.inf)))
        if at_edge < 0 or values[at_edge] <= inside[best]:
            value, bar, doubt = float(inside[best]), float(inside_bars[best]), ""
            place = np.unravel_index(int(chosen[best]), self.wrong.shape[1:])
            x, y = (float(int(k) * step) for k, step in zip(place, self.loads.grid.spacing, strict=True))
        else:
            value, bar, doubt = float(values[at_edge]), float(bars[at_edge]), edge.doubt(at_edge)
            x, y = edge.place(at_edge)
        if doubt := doubt or edge.roughness_doubt():
            # the largest stress of the pixels as they are
            chosen, values = largest(name, self._raw_stress)
            i, j = np.unravel_index(int(chosen[np.argmax(values)]), self.wrong.shape[1:])
            dx, dy = self.loads.grid.spacing
            value, x, y = float(values.max()), float(i * dx), float(j * dy)
        error = math.nan if doubt else max(bar, highest - value) + more * abs(value)
        return Peak(value, x, y, self.plane.depth, self.plane.region, self.plane.side, error, doubt)

    @cached_property
    def _doubt(self) -> RealArray:
        """Part (nx, ny) in Pa of the bars inside that follows from the errors of the slopes."""
        return np.asarray(INSIDE * self.modulus * np.hypot(*self.ratio) * np.hypot(*self.wrong))

    @cached_property
    def _stress(self) -> StressTensor:
        """Stress (n,) at all pixels, without the errors of the slopes."""
        return self._under(self.fields.by_pressure + self.fields.by_shear)

    @cached_property
    def _raw_stress(self) -> StressTensor:
        """The same as the pixels give it."""
        found = self.fields.by_pressure + self.fields.by_shear
        at = np.flatnonzero(self.loads.pressure > 0.0)
        wrong, ratio = self.wrong.reshape(2, -1)[:, at], (self.ratio[0].ravel()[at], self.ratio[1].ravel()[at])
        found.reshape(3, -1)[:, at] -= _by_slopes(wrong, ratio, self.nu, self.modulus)
        return self._under(found)

    def _under(self, plane: RealArray) -> StressTensor:
        """All components, of xx, yy, xy (3, nx, ny) and of the tractions."""
        xx, yy, xy = plane.reshape(3, -1)
        p = np.asarray(self.loads.pressure, dtype=np.float64).ravel()
        xz, yz = (-part.ravel() * p for part in self.ratio)
        return StressTensor(xx, yy, -p, xy, xz, yz)


class _Edge(NamedTuple):
    """Stress (3, n) on the edge at pairs of pixels, its ``bars`` (n,), and what to refuse it
    for."""

    edges: Any
    chosen: NDArray[np.intp]
    stress: RealArray
    bars: RealArray
    none: RealArray
    roughness: float

    @classmethod
    def of(cls, surface: _Surface) -> _Edge:
        """From the pixels on both sides of the edges of the contact."""
        edges, grid, result = surface.result.edges, surface.loads.grid, surface.result
        chosen = np.flatnonzero((edges.cosine >= LEAST_COSINE) & ~edges.beyond)
        inner, outer, normal = edges.inner[chosen], edges.outer[chosen], edges.normal[chosen].T
        d, spread = edges.distance[chosen], np.abs(edges.spread[chosen])
        p0 = surface.loads.pressure.ravel()[inner]
        flat = surface.fields.by_pressure.reshape(3, -1)
        along = 2.0 * surface.nu * np.array([[1.0], [1.0], [0.0]]) + (1.0 - 2.0 * surface.nu) * _product(normal, normal)
        inside, outside = flat[:, inner] + along * p0, flat[:, outer]
        stress = inside + np.clip(d, 0.0, 1.0) * (outside - inside)
        steepness = np.zeros(chosen.size)
        change = np.abs(outside - inside)
        heights = result.problem.profile() - result.permanent_indentation
        wraps = result.problem.boundary.wraps
        slopes = [_slopes(heights, at, grid, wraps, _SIXTH) for at in (inner, outer)]
        missing = np.hypot(*(slopes[0] - _slopes(heights, inner, grid, wraps, _FOURTH)))
        size = float(np.sum(np.hypot(*slopes[0]) ** 2))
        roughness = math.sqrt(float(np.sum(missing**2)) / size) if size > 0.0 else 0.0
        if surface.loads.sheared:
            ratio = surface.ratio[0].ravel()[inner], surface.ratio[1].ravel()[inner]
            m_in, m_out = (_by_slope(slope, ratio, normal, surface.nu, surface.modulus) for slope in slopes)
            stress = stress + surface.fields.by_shear.reshape(3, -1)[:, inner] + d * (m_out - m_in)
            change = change + np.abs(m_out - m_in)
            mu = np.hypot(*ratio)
            second = np.where(edges.deep[chosen], SECOND, SINGLE)
            wrong = np.hypot(*surface.wrong.reshape(2, -1)[:, inner])
            steepness = mu * surface.modulus * (2.0 * missing + second * wrong)
        normal_part = (NORMAL * (1.0 - 2.0 * surface.nu) + ROUNDING) * p0
        bars = FACTOR * ((spread + SPREAD) * change.max(axis=0, initial=0.0) + steepness + normal_part)
        return cls(edges, chosen, stress, bars, np.zeros(chosen.size), roughness)

    def doubt(self, number: int) -> str:
        """Why the stress of one pair cannot be trusted; empty if it can."""
        pair = int(self.chosen[number])
        if not self.edges.deep[pair] or (self.edges.spot_pixels[pair] < FEWEST_PIXELS and self.edges.grid.shape[1] > 1):
            return "its contact spot is less than 3 pixels in radius"
        return ""

    def roughness_doubt(self) -> str:
        """Why none can be trusted; empty if they can."""
        if self.roughness > UNRESOLVED:
            return "the slope of the surface, and with it the tension, grows as the grid is refined"
        if self.roughness > ROUGHEST:
            return "the shortest waves of the surface have fewer than 6 pixels"
        return ""

    def place(self, number: int) -> tuple[float, float]:
        """Where the edge is, x and y in m."""
        pair = int(self.chosen[number])
        grid: Grid = self.edges.grid
        at = [float(k) for k in np.unravel_index(int(self.edges.inner[pair]), grid.shape)]
        at[int(self.edges.axis[pair])] += float(self.edges.sign[pair] * self.edges.distance[pair])
        return at[0] * grid.spacing[0], at[1] * grid.spacing[1]


def _in_plane(tensor: StressTensor) -> RealArray:
    """Components xx, yy, xy (3, nx, ny) of the first plane."""
    return np.stack([tensor.xx[0], tensor.yy[0], tensor.xy[0]])


def _product(a: RealArray, b: RealArray) -> RealArray:
    """Symmetric part of the product of vectors (2, …): xx, yy, xy."""
    return np.stack([a[0] * b[0], a[1] * b[1], 0.5 * (a[0] * b[1] + a[1] * b[0])])


def _by_slope(
    slope: RealArray, ratio: tuple[RealArray, RealArray], normal: RealArray, nu: float, modulus: float
) -> RealArray:
    """Stress by shear traction of ``ratio`` to the pressure that is singular with a ``slope`` (2,
    …) of the surface, at an edge of this ``normal``."""
    along = slope[0] * ratio[0] + slope[1] * ratio[1]
    unit = np.stack([np.ones_like(along), np.ones_like(along), np.zeros_like(along)])
    return np.asarray(modulus * (_product(slope, np.stack(ratio)) + nu * along * (unit - _product(normal, normal))))


def _by_slopes(wrong: RealArray, ratio: tuple[RealArray, RealArray], nu: float, modulus: float) -> RealArray:
    """The same by an error of slopes, which is normal to the edge."""
    steep = np.hypot(*wrong)
    return _by_slope(wrong, ratio, wrong / np.where(steep > 0.0, steep, 1.0), nu, modulus)


def _slopes(heights: RealArray, at: Any, grid: Grid, wraps: tuple[bool, bool], factors: tuple[float, ...]) -> RealArray:
    """Slopes (2, n) of ``heights`` at pixels by number, by central differences; beyond a border
    that does not wrap heights stay as they are there."""
    flat, places = heights.ravel(), np.divmod(at, grid.shape[1])
    found = []
    for axis in (0, 1):
        total = np.zeros(len(at))
        for step, factor in enumerate(factors, start=1):
            for sign in (1, -1):
                moved = list(places)
                moved[axis] = places[axis] + sign * step
                size = grid.shape[axis]
                moved[axis] = moved[axis] % size if wraps[axis] else np.clip(moved[axis], 0, size - 1)
                total += sign * factor * flat[moved[0] * grid.shape[1] + moved[1]]
        found.append(total / grid.spacing[axis] if grid.shape[axis] > 1 else np.zeros(len(at)))
    return np.stack(found)


def _slope_errors(result: Any) -> RealArray:
    """Slope of the undeformed surface less that of the displacement as pixels give it, (2, nx, ny);
    right in contact, where the gap is zero."""
    problem = result.problem
    grid: Grid = problem.grid
    if problem.boundary.name == "periodic":
        transform = RealTransform(grid.shape)
        spectrum = transform.forward(np.asarray(result.gap, dtype=np.float64))
        return -np.stack([transform.backward(1j * q * spectrum) for q in grid.wavevector(odd=True)])
    heights = problem.profile() - result.permanent_indentation
    nx, ny = (1 if n == 1 else fast_length(2 * n - 1) for n in grid.shape)
    padded, whole = PaddedTransform(grid.shape, (nx, ny)), RealTransform((nx, ny))
    pressed = np.asarray(result.pressure, dtype=np.float64)
    loads = padded.forward(pressed, np.empty(padded.spectrum_shape, np.complex128))

    def convolved(coefficients: RealArray, *, odd_x: bool = False, odd_y: bool = False) -> RealArray:
        """Sum over pixels (nx, ny) of the pressure times ``coefficients`` at their offsets (0…nx-1,
        0…ny-1)."""
        spectrum = whole.forward(wrapped(coefficients, (nx, ny), odd_x=odd_x, odd_y=odd_y))
        return padded.backward(spectrum * loads, np.empty(padded.shape))

    if not isinstance(problem.compliance, HalfSpace) or getattr(result, "creep", None) is not None:
        smooth = HalfSpace(problem.contact_modulus)  # the rest of the displacement has no steep slope at edges
        own = smooth.influence(grid) if problem.boundary.name == "free" else smooth.line_influence(grid, grid.size[0])
        heights = heights - (result.displacement - convolved(own))
    slopes = _slopes(heights, np.arange(grid.n_points), grid, problem.boundary.wraps, _SIXTH).reshape(2, *grid.shape)
    for axis, kernel in enumerate(_patch_slopes(grid, line=problem.boundary.name == "free line")):
        if grid.shape[axis] > 1:
            slopes[axis] -= convolved(kernel / problem.contact_modulus, odd_x=axis == 0, odd_y=axis == 1)
    return slopes


def _patch_slopes(grid: Grid, *, line: bool) -> tuple[RealArray, RealArray]:
    """Slopes along x and y, times E*, at offsets from a pixel under unit pressure (Love 1929); of a
    strip along y if ``line``."""
    x, y = grid.coordinates()
    dx, dy = grid.spacing
    if line:
        return -2.0 / np.pi * np.log(np.abs((x + 0.5 * dx) / (x - 0.5 * dx))), np.zeros(grid.shape)

    def along(a: RealArray, b: RealArray, da: float, db: float) -> RealArray:
        def corner(s: RealArray) -> RealArray:
            return np.asarray(np.arcsinh((b + 0.5 * db) / np.abs(s)) - np.arcsinh((b - 0.5 * db) / np.abs(s)))

        return (corner(a + 0.5 * da) - corner(a - 0.5 * da)) / np.pi

    return along(x, y, dx, dy), along(y, x, dy, dx)
