"""Norms of the stress inside a body, with their partial derivatives."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...contact.boundary import FreeLine, Periodic
from ...contact.problem import ContactProblem
from ...core import require
from ...core.arrays import ComplexArray, RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.interpolation import TERMS, panels
from ...core.spectral import RealTransform, multiplicity, thread_count, wrapped
from ...core.tensor import STRESSES, StressTensor, second_invariant
from ...solids.compliance.rates import Constant, constants
from ...solids.elastic import Elastic
from ...solids.layers import Layered
from ..stress.kernels.coefficients import LineCoefficients, PlaneCoefficients
from ..stress.regions import Plane, Side, regions, stack
from .outputs import Slopes, State
from .parameters import Parameter, changed_body, kept_layers
from .transfers import Amplitudes, Place, PressureTransfers, plain, rates_of, stepped

Measure: TypeAlias = Literal["von_mises", "tension"]
"""Equivalent stress √(3 J2), or the larger principal stress along the surface where it is tensile
(Peng 2001, eq. 3.34)."""

STEP = 2e-3
"""Relative step of the central differences of influence coefficients at given pressure, to moduli,
Poisson's ratios and thicknesses, on free boundaries: the derivatives of J at given pressure then
have errors of 1e-5 of J over the parameter."""

_NEGLIGIBLE = 42.0
"""Depth times wavenumber from which nothing reaches a plane, as of the stresses."""


@dataclass(frozen=True)
class StressNorm:
    """p-norm (mean of s^m over the pixels of all planes)^(1/m) of a stress s in one layer of a
    body, in Pa: a largest stress with a derivative.

    The planes move with the layer as thicknesses change: in a layer they stay at the same share of
    its thickness, in the half-space at the same distance below its top.

    InputError if a value is outside its range.

    Parameters
    ----------
    layer
        Number of the layer from 0 at the surface; that of the layers stands for the half-space, 0
        for a homogeneous body.
    planes
        Of a layer shares of its thickness from 0 at its upper to 1 at its lower face, of the
        half-space depths below its top in m.
    m
        Exponent, >= 1; 8 to 32 for a largest stress. Keep it and the planes fixed where norms are
        compared.
    measure
        ``"von_mises"`` for √(3 J2), ``"tension"`` for the larger principal stress along the
        surface, where it is positive.
    of
        ``"body"`` or ``"counter_body"``.
    """

    layer: int
    planes: tuple[float, ...]
    m: float = 16.0
    measure: Measure = "von_mises"
    of: Literal["body", "counter_body"] = "body"
    unit: str = "Pa"
    degree: float | None = 1.0

    def __post_init__(self) -> None:
        given = np.atleast_1d(np.asarray(self.planes, dtype=float)).tolist()
        object.__setattr__(self, "planes", tuple(given))
        require.integer(self.layer, 0, "layer of a norm of the stress")
        require.one_of(self.measure, ("von_mises", "tension"), "measure of a norm of the stress")
        require.one_of(self.of, ("body", "counter_body"), "body of a norm of the stress")
        if require.finite(self.m, "exponent of a norm of the stress") < 1.0:
            raise InputError(f"exponent of a norm of the stress must be at least 1, but is {self.m:g}.")
        if not given:
            raise InputError("planes of a norm of the stress must be one and more, but there are none.")
        for each in given:
            if require.finite(each, "plane of a norm of the stress") < 0.0:
                raise InputError(f"plane of a norm of the stress must be at least zero, but is {each:g}.")

    @property
    def name(self) -> str:
        """With body, layer and exponent."""
        side = "" if self.of == "body" else "counter_body_"
        return f"{self.measure}_norm_{self.m:g}_{side}layer_{self.layer}"

    def within(self, body: Elastic | Layered) -> tuple[Plane, ...]:
        """The planes in ``body``.

        Raises
        ------
        InputError
            If it has no such layer, or a plane is not in it.
        """
        parts = regions(body)
        numbers = [*kept_layers(body)][: len(parts)] if isinstance(body, Layered) else [0]
        if self.layer not in numbers:
            known = ", ".join(map(str, numbers))
            raise InputError(f"layer of a norm of the stress must be one of {known}, but is {self.layer}.")
        region, found = parts[numbers.index(self.layer)], list[Plane]()
        for each in self.planes:
            thickness = 1.0 if np.isinf(region.bottom) else region.bottom - region.top
            side: Side = ("below" if region.index else "surface") if each == 0.0 else "inside"
            if np.isfinite(region.bottom):
                if each > 1.0:
                    raise InputError(
                        f"plane of a norm of the stress in a layer must be a share of its thickness, at most 1, but "
                        f"is {each:g}."
                    )
                side = "above" if each == 1.0 else side
            found.append(Plane(region.top + each * thickness, region, side))
        return tuple(found)

    def at(self, state: State) -> Slopes:
        """Value and partial derivatives."""
        fields = self._fields(state)
        stresses = [fields.stress(number) for number in range(len(fields.planes))]
        values = [self._values(stress) for stress in stresses]
        top = max(float(value.max()) for value in values)
        if not top > 0.0:
            return Slopes(0.0, np.zeros(state.pressure.shape))
        count = sum(value.size for value in values)
        mean = sum(float(((value / top) ** self.m).sum()) for value in values) / count
        scale = mean ** (1.0 / self.m - 1.0) / count
        slopes, slope = [], np.zeros(state.pressure.shape)
        for number, (stress, value) in enumerate(zip(stresses, values, strict=True)):
            by_stress = self._slopes(stress, value, scale * (value / top) ** (self.m - 1.0))
            slope += fields.transposed(number, by_stress)
            slopes.append(by_stress)

        def direct(parameters: Sequence[Parameter]) -> Mapping[str, float]:
            own = [each for each in parameters if each.body == self.of]
            found = fields.rates(slopes, [each.constant for each in own])
            return dict(zip((each.name for each in own), found, strict=True))

        return Slopes(top * mean ** (1.0 / self.m), slope, direct=direct)

    def largest(self, state: State) -> float:
        """Largest value on the planes, in Pa."""
        fields = self._fields(state)
        return max(float(self._values(fields.stress(number)).max()) for number in range(len(fields.planes)))

    def _fields(self, state: State) -> Fields:
        body = deforming(state.problem, self.of)
        kind = SpectralFields if isinstance(state.problem.boundary, Periodic) else FreeFields
        return kind(state, body, self.within(body))

    def _values(self, stress: StressTensor) -> RealArray:
        """The measure, not negative, (nx, ny)."""
        if self.measure == "von_mises":
            return np.asarray(np.sqrt(3.0 * second_invariant(stress)))
        half = np.hypot(0.5 * (stress.xx - stress.yy), stress.xy)
        return np.asarray(np.maximum(0.5 * (stress.xx + stress.yy) + half, 0.0))

    def _slopes(self, s: StressTensor, value: RealArray, weight: RealArray) -> StressTensor:
        """Derivatives to each component, with the ``weight`` of each point."""
        if self.measure == "von_mises":
            factor = weight / np.where(value > 0.0, value, 1.0)
            mean = (s.xx + s.yy + s.zz) / 3.0
            normal = (1.5 * factor * (part - mean) for part in (s.xx, s.yy, s.zz))
            return StressTensor(*normal, *(3.0 * factor * part for part in (s.xy, s.xz, s.yz)))
        weight, difference = np.where(value > 0.0, weight, 0.0), 0.5 * (s.xx - s.yy)
        half = np.hypot(difference, s.xy)
        cosine, sine = (part / np.where(half > 0.0, half, 1.0) for part in (difference, s.xy))
        none = np.zeros_like(value)
        return StressTensor(
            0.5 * weight * (1.0 + cosine), 0.5 * weight * (1.0 - cosine), none, weight * sine, none, none
        )


class Fields:
    """Stress on ``planes`` of a body under the pressure of a contact, its transpose, and its
    derivatives at given pressure."""

    def __init__(self, state: State, body: Elastic | Layered, planes: tuple[Plane, ...]) -> None:
        self.problem, self.body, self.planes, self.pressure = state.problem, body, planes, state.pressure
        self.grid = Grid(state.operator.padded, state.operator.grid.spacing)
        self.transform = RealTransform(self.grid.shape, thread_count())
        self.spectrum = self.forward(state.pressure)

    def forward(self, field: RealArray) -> ComplexArray:
        """Transform of a ``field`` (nx, ny), with zeros around it."""
        whole = np.zeros(self.grid.shape)
        whole[: field.shape[0], : field.shape[1]] = field
        return self.transform.forward(whole)

    def backward(self, spectrum: ComplexArray) -> RealArray:
        """The field (nx, ny) of a ``spectrum``."""
        nx, ny = self.pressure.shape
        return self.transform.backward(spectrum)[:nx, :ny].copy()

    def stress(self, number: int) -> StressTensor:
        """Stress (Pa) on the plane of this ``number``, arrays (nx, ny)."""
        return StressTensor(*(self.backward(kernel * self.spectrum) for kernel in self.kernels(number)))

    def transposed(self, number: int, slopes: StressTensor) -> RealArray:
        """Derivative to the pressure of each pixel (nx, ny), from the ``slopes`` to the stress: by
        the conjugate kernels."""
        parts = zip(self.kernels(number), vars(slopes).values(), strict=True)
        total = np.zeros(self.transform.spectrum_shape, complex)
        for kernel, slope in parts:
            total += kernel.conj() * self.forward(slope)
        return self.backward(total)

    def kernels(self, number: int) -> Iterable[ComplexArray]:
        """Spectra of the stress under unit pressure, component by component."""
        raise NotImplementedError

    def rates(self, slopes: Sequence[StressTensor], wanted: Sequence[Constant]) -> list[float]:
        """Derivative to each of the ``wanted`` constants of the body at given pressure, from the
        ``slopes`` to the stress on each plane."""
        raise NotImplementedError


class SpectralFields(Fields):
    """On a periodic boundary: products with transfer functions (see ``stress.boundaries``)."""

    @cached_property
    def _directions(self) -> tuple[RealArray, ...]:
        """c, s, c², s² and c s of each wavevector, odd ones zero at the highest of even grids."""
        grid = self.grid
        q = np.where(grid.wavenumber() > 0.0, grid.wavenumber(), 1.0)
        (_, qy), (odd_x, odd_y) = grid.wavevector(), grid.wavevector(odd=True)
        c, s, ss = odd_x / q, odd_y / q, (qy / q) ** 2
        return c, s, 1.0 - ss, ss, c * s

    @cached_property
    def _stack(self) -> Layered:
        return stack(self.body)

    @cached_property
    def _panel(self) -> tuple[NDArray[np.intp], RealArray]:
        """Number of the panel of each wavenumber, and its place in it."""
        breaks, q = panels(self.grid).breaks, self.grid.wavenumber()
        q.flat[0] = breaks[0]
        number = np.clip(np.searchsorted(breaks, q, side="right") - 1, 0, breaks.size - 2)
        low, high = breaks[number], breaks[number + 1]
        return number, (2.0 * q - low - high) / (high - low)

    def _transfers(self, *, rates: bool = False) -> PressureTransfers:
        made = stepped(self._stack) if rates else plain(self._stack)
        return PressureTransfers(made, panels(self.grid).points, base=isinstance(self._stack.base, Elastic))

    @cached_property
    def _known(self) -> dict[int, Amplitudes]:
        return {}

    @cached_property
    def _of_slopes(self) -> dict[int, list[ComplexArray]]:
        return {}

    @cached_property
    def _plain(self) -> PressureTransfers:
        return self._transfers()

    def _reached(self, number: int) -> RealArray:
        """One where waves reach the plane of this ``number``, else zero; zero of the mean."""
        q = self.grid.wavenumber()
        return np.asarray((q > 0.0) & (q * self.planes[number].depth < _NEGLIGIBLE), dtype=float)

    def _amplitudes(self, number: int) -> Amplitudes:
        """Amplitudes of the plane of this ``number`` at all wavenumbers, which are kept."""
        if number not in self._known:
            self._known[number] = self._evaluated(number)
        return self._known[number]

    def _evaluated(self, number: int) -> Amplitudes:
        found = self._plain.to(Place.of(self.planes[number]))
        fitted, (panel, t) = panels(self.grid).fitted(np.stack([np.asarray(part) for part in found])), self._panel
        reached, values = self._reached(number), []
        for function in range(len(found)):
            value = fitted[panel, function, TERMS - 1]
            for power in range(TERMS - 2, -1, -1):
                value = value * t + fitted[panel, function, power]
            values.append(value * reached)
        return Amplitudes(*values)

    def kernels(self, number: int) -> Iterable[ComplexArray]:
        """Spectra of the stress under unit pressure; the mean is that of uniaxial strain."""
        (z, L, LL), nu = self._amplitudes(number), self.planes[number].region.material.poisson_ratio
        c, s, cc, ss, cs = self._directions
        across = nu * (LL - z)
        lateral = -nu / (1.0 - nu)
        for component, mean in (
            (cc * LL + ss * across, lateral),
            (ss * LL + cc * across, lateral),
            (-z, -1.0),
            (cs * (LL - across), 0.0),
            (-1j * c * L, 0.0),
            (-1j * s * L, 0.0),
        ):
            kernel = component.astype(complex)
            kernel[0, 0] = mean
            yield kernel

    def transposed(self, number: int, slopes: StressTensor) -> RealArray:
        """Derivative to the pressure (nx, ny): by the conjugate transfer functions."""
        self._of_slopes[number] = found = [self.forward(part) for part in vars(slopes).values()]
        xx, yy, zz, xy, xz, yz = found
        (z, L, LL), nu = self._amplitudes(number), self.planes[number].region.material.poisson_ratio
        c, s, cc, ss, cs = self._directions
        mixed = cs * xy
        total = LL * (cc * xx + ss * yy + mixed) + (nu * (LL - z)) * (ss * xx + cc * yy - mixed) - z * zz
        total += (1j * L) * (c * xz + s * yz)
        total[0, 0] = -nu / (1.0 - nu) * (xx[0, 0] + yy[0, 0]) - zz[0, 0]
        return self.backward(total)

    def rates(self, slopes: Sequence[StressTensor], wanted: Sequence[Constant]) -> list[float]:
        """By the complex step through the recursion and the transpose of the interpolation."""
        if not wanted:
            return []
        stepped_transfers, known = self._transfers(rates=True), constants(self._stack)
        alpha, totals = panels(self.grid).points, np.zeros(len(known))
        for number, plane in enumerate(self.planes):
            nu, (z, _, LL) = plane.region.material.poisson_ratio, self._amplitudes(number)
            c, s, cc, ss, cs = self._directions
            by = multiplicity(self.grid) / self.grid.n_points
            product = by * self.spectrum
            xx, yy, zz, xy, xz, yz = (part.conj() * product for part in self._of_slopes[number])
            lateral = (ss * xx + cc * yy - cs * xy).real
            weights = (
                -zz.real - nu * lateral,
                (c * xz + s * yz).imag,
                (cc * xx + ss * yy + cs * xy).real + nu * lateral,
            )
            changes = rates_of(stepped_transfers.to(Place.of(plane)), self._stack, alpha)
            moments = [self._moments(weight * self._reached(number)) for weight in weights]
            for which, each in enumerate(known):
                fitted = panels(self.grid).fitted(changes[which])
                totals[which] += sum(float((fitted[:, k] * moments[k]).sum()) for k in range(3))
                if each.kind == "poisson_ratio" and each.layer == plane.region.index:
                    totals[which] += float((lateral * (LL - z)).sum())
                    totals[which] -= float((xx[0, 0] + yy[0, 0]).real) / (1.0 - nu) ** 2
        by_constant = {(each.kind, each.layer): total for each, total in zip(known, totals, strict=True)}
        return [float(by_constant[each.kind, each.layer]) for each in wanted]

    def _moments(self, weight: RealArray) -> RealArray:
        """Sum of ``weight`` t^k over the wavenumbers of each panel, (panels, TERMS)."""
        panel, t = self._panel
        count, found, power = panels(self.grid).count, [], weight
        for _ in range(TERMS):
            found.append(np.bincount(panel.ravel(), power.ravel(), count))
            power = power * t
        return np.stack(found, axis=1)


class FreeFields(Fields):
    """On a free boundary: exact convolution with influence coefficients, as of the stresses."""

    def kernels(self, number: int, body: Elastic | Layered | None = None) -> Iterable[ComplexArray]:
        """Transforms of the influence coefficients, of another ``body`` where one is given."""
        plane, boundary, grid = self.planes[number], self.problem.boundary, self.problem.grid
        of = self.body if body is None else body
        at = plane if body is None else moved(plane, body)
        if isinstance(boundary, FreeLine):
            found = LineCoefficients(stack(of), at, grid, boundary.datum or grid.size[0]).stress("z")
        else:
            found = PlaneCoefficients(stack(of), at, grid).stress("z")
        for component in STRESSES:
            odd_x, odd_y = (component.count(axis) % 2 == 1 for axis in "xy")
            coefficients = getattr(found, component)
            if at.side == "surface" and component in ("zz", "xz", "yz"):
                coefficients = np.zeros_like(coefficients)
                coefficients[0, 0] = -1.0 if component == "zz" else 0.0
            yield self.transform.forward(wrapped(coefficients, self.grid.shape, odd_x=odd_x, odd_y=odd_y))

    def rates(self, slopes: Sequence[StressTensor], wanted: Sequence[Constant]) -> list[float]:
        """By central differences of the influence coefficients at given pressure."""
        found = []
        for each in wanted:
            step = STEP * (each.value or 1.0)
            ends = [changed_body(self.body, each, each.value + sign * step) for sign in (1.0, -1.0)]
            total = 0.0
            for number, slope in enumerate(slopes):
                for part, up, down in zip(
                    vars(slope).values(), *(self.kernels(number, end) for end in ends), strict=True
                ):
                    total += float((part * self.backward((up - down) * self.spectrum)).sum())
            found.append(total / (2.0 * step))
        return found


def moved(plane: Plane, body: Elastic | Layered) -> Plane:
    """``plane`` in a ``body`` of other constants: see ``Place``."""
    region, at = regions(body)[plane.region.index], Place.of(plane)
    if np.isinf(region.bottom):
        return Plane(region.top + at.depth, region, plane.side)
    return Plane(region.top + at.share * (region.bottom - region.top), region, plane.side)


def deforming(problem: ContactProblem, which: str) -> Elastic | Layered:
    """That body of ``problem``; InputError if it is rigid."""
    body = getattr(problem, which)
    stack(body)
    assert isinstance(body, Elastic | Layered)
    return body
