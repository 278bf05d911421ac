"""Viscoelastic memory as a coupling: what earlier pressures still displace, and what they will.

Internal pressures xi_k, lambda_k d(xi_k)/dt = p - xi_k, one for each retardation time of the
compliance, hold all that matters of the past: u = K_0 p + sum K_k xi_k. With a pressure that is
linear over a step they are known at its end, so that the step is an elastic contact with the
compliance K_0 + sum (1 - f_k) K_k and the rest of the displacement as a lift.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, ClassVar, Protocol

import numpy as np

from ...contact.boundary import Periodic
from ...contact.couplings.protocol import Coupling, Exchange, Memory, Posed, Share
from ...contact.operators.convolution import Operator, spectral_kernel
from ...core.arrays import ComplexArray, RealArray
from ...core.engine import CpuEngine
from ...core.engine.blocks import LONG_SERIAL_BELOW, Blocks
from ...core.errors import InputError
from ...core.spectral import PaddedTransform, RealTransform, wrapped
from ...solids.compliance.creep import AnyCreep, LayeredCreep, SharedCreep

_SERIES = 0.02
"""Relative length of a step below which differences of exponentials are summed as series."""


@dataclass(frozen=True, eq=False)
class TimeWeights:
    """Of one step of length dt: xi(end) = e xi(begin) + before p(begin) + after p(end), for each
    retardation time."""

    length: float
    times: RealArray
    e: RealArray
    before: RealArray
    after: RealArray

    @classmethod
    def of(cls, times: RealArray, length: float) -> TimeWeights:
        """Weights for ``times`` (terms,) in s, infinite for a fluid, whose term is the integral of
        the pressure, and ``length`` >= 0 in s."""
        r = length / times
        e = np.exp(-r)
        small = np.maximum(r, 1e-300)
        f = np.where(r > 0.0, -np.expm1(-r) / small, 1.0)
        after, before = 1.0 - f, f - e
        flows = np.isinf(times)
        half = 0.5 * length
        return cls(length, times, e, np.where(flows, half, before), np.where(flows, half, after))

    @property
    def of_curvature(self) -> RealArray:
        """Error (s²) of each xi at the end of the step by the second derivative of the pressure: ½
        ∫ x (dt - x) exp(-x/lambda) dx/lambda."""
        flows = np.isinf(self.times)
        lam = np.where(flows, 1.0, self.times)
        r = np.where(flows, 0.0, self.length / lam)
        exact = 0.5 * lam**2 * (r - 2.0 + np.exp(-r) * (r + 2.0))
        short = self.length**2 * r * (1.0 / 12.0 - r / 24.0)
        found = np.where(r < _SERIES, short, exact)
        return np.where(flows, self.length**3 / 12.0, found)

    @property
    def of_mean(self) -> tuple[TimeWeights, RealArray]:
        """Weights of the mean of each xi over the step: those of xi and of the pressure at its
        begin, and that of the pressure at its end."""
        flows = np.isinf(self.times)
        r = np.where(flows, 1.0, self.length / np.where(flows, 1.0, self.times))
        short, small = r < _SERIES, np.maximum(r, 1e-300)
        kept = np.where(r > 0.0, -np.expm1(-r) / small, 1.0)
        before = np.where(short, r / 3.0 - r**2 / 8.0 + r**3 / 30.0, 0.5 - self.before / small)
        after = np.where(short, r / 6.0 - r**2 / 24.0 + r**3 / 120.0, 0.5 - self.after / small)
        kept, before, after = (
            np.where(flows, fluid, solid)
            for fluid, solid in ((1.0, kept), (self.length / 3.0, before), (self.length / 6.0, after))
        )
        return replace(self, e=kept, before=before, after=after), after

    def dissipated(self, shares: RealArray, products: Products) -> float:
        """sum (c_k/lambda_k) ∫ (p - xi)·K (p - xi) dt over the step, and c_f ∫ p·K p dt of a fluid,
        in the unit of the ``products``."""
        flows = np.isinf(self.times)
        lam = np.where(flows, 1.0, self.times)
        r = np.where(flows, 1.0, self.length / lam)
        y = -np.expm1(-r)
        squares = 0.5 * lam * y * (2.0 - y)
        crossed = 0.5 * lam**2 * y**2
        series = sum(y**m / m for m in range(3, 9))
        ramps = lam**3 * np.where(r < _SERIES, series, r - y - 0.5 * y**2)
        p = products
        start = p.p00 - 2.0 * p.xi_0 + p.xi_xi  # (p - xi)·K (p - xi) at the begin
        change = p.p11 - 2.0 * p.p01 + p.p00
        across = p.p01 - p.p00 - (p.xi_1 - p.xi_0)
        dt = self.length or 1.0
        total = (start * squares + 2.0 * across * crossed / dt + change * ramps / dt**2) / lam
        fluid = self.length / 3.0 * (p.p00 + p.p01 + p.p11)
        return float((shares * np.where(flows, fluid, total)).sum()) if self.length else 0.0

    def advanced(self, products: Products) -> RealArray:
        """xi·K xi at the end of the step."""
        e, b, a, p = self.e, self.before, self.after, products
        return np.asarray(
            e**2 * p.xi_xi + b**2 * p.p00 + a**2 * p.p11 + 2.0 * (e * b * p.xi_0 + e * a * p.xi_1 + b * a * p.p01)
        )


@dataclass(frozen=True, eq=False)
class Products:
    """Products x·K y over the area (J): of xi with itself, with the pressure before and after a
    step, and of these; each for all terms."""

    xi_xi: RealArray
    xi_0: RealArray
    xi_1: RealArray
    p00: RealArray | float
    p01: RealArray | float
    p11: RealArray | float


@dataclass(frozen=True, eq=False)
class ShearPast:
    """Memory of shear tractions.

    ``xi`` are the internal tractions (terms, 2, nx, ny) in Pa or their half spectra, of a fluid in
    Pa s; ``squares`` (parts, terms) their energies and those of the coupling with the internal
    pressures, J, of a fluid in J s².
    """

    xi: RealArray | ComplexArray
    squares: RealArray

    def advanced(
        self, before: RealArray | ComplexArray, traction: RealArray | ComplexArray, weights: TimeWeights
    ) -> ShearPast:
        """The same after a step from ``before`` to ``traction``, as ``xi`` are, without its
        energies."""
        e, b, a = (values[:, None, None, None] for values in (weights.e, weights.before, weights.after))
        return ShearPast(e * self.xi + b * before + a * traction, self.squares)


@dataclass(frozen=True, eq=False)
class Past:
    """Memory of the pressures so far.

    Attributes
    ----------
    time
        s since the virgin state.
    pressure
        (nx, ny), Pa, at that time.
    response
        What it does by itself: K_0 p in m of a shared creep; the half spectrum of p of layers.
    xi
        Internal pressures, (terms, nx, ny) in Pa, or their half spectra; of a fluid in Pa s.
    squares
        xi·K xi of each term, J, of a fluid in J s².
    dissipated
        Heat so far, J.
    place
        Mean pressure (Pa), approach and mean gap (m) that were reached.
    shear
        Memory of shear tractions, where surfaces stick and slip.
    account
        Energies so far, numbers of an ``energy_in_time.Account``; empty where they are not known.
    """

    time: float
    pressure: RealArray
    response: RealArray | ComplexArray
    xi: RealArray | ComplexArray
    squares: RealArray
    dissipated: float
    place: tuple[float, float, float]
    shear: ShearPast | None = None
    account: tuple[float, ...] = ()

    @classmethod
    def of(cls, memory: Memory) -> Past:
        """The past in a ``memory``, response and xi as they are in it."""
        mean, approach, gap = (float(value) for value in memory["place"])
        fields = {name: memory[name] for name in ("pressure", "response", "xi", "squares")}
        place = mean, approach, gap
        shear = ShearPast(memory["shear_xi"], memory["shear_squares"]) if "shear_xi" in memory else None
        heat, account = float(memory["dissipated"]), tuple(map(float, memory.get("account", ())))
        return cls(float(memory["time"]), dissipated=heat, place=place, shear=shear, account=account, **fields)

    @property
    def memory(self) -> Memory:
        """Named real arrays; complex ones have a last axis of real and imaginary parts."""
        numbers = {"time": self.time, "dissipated": self.dissipated, "place": self.place}
        fields = {"pressure": self.pressure, "response": self.response, "xi": self.xi, "squares": self.squares}
        shear = (
            {} if self.shear is None else {"shear_xi": _real_view(self.shear.xi), "shear_squares": self.shear.squares}
        )
        known = {"account": np.array(self.account)} if self.account else {}
        return {
            **known,
            **{name: np.asarray(value, dtype=float) for name, value in numbers.items()},
            **{name: _real_view(value) for name, value in fields.items()},
            **shear,
        }


def _real_view(values: RealArray | ComplexArray) -> RealArray:
    if not np.iscomplexobj(values):
        return np.asarray(values)
    return np.ascontiguousarray(values)[..., None].view(float)


def _complex_view(values: RealArray) -> ComplexArray:
    return np.ascontiguousarray(values).view(complex)[..., 0]


class Remembering(Protocol):
    """How a past is kept and what it does, for one kind of creep."""

    @property
    def times(self) -> RealArray:
        """Retardation times, s."""

    def summed(self, weights: TimeWeights) -> RealArray | None:
        """Compliance (m/Pa) by which the pressure at the end of a step adds to that of the first
        instant, on the half spectrum of the operator; None where all terms are multiples of one."""

    def past(self, memory: Memory) -> Past:
        """The past in a ``memory``; a virgin one of an empty memory."""

    def lift(self, past: Past, weights: TimeWeights) -> RealArray:
        """Displacement (nx, ny) in m at the end of a step but for that by the pressure then."""

    def after(
        self,
        past: Past,
        weights: TimeWeights,
        pressure: RealArray,
        deflection: RealArray,
        place: tuple[float, float, float],
    ) -> tuple[Past, float]:
        """The past after a step that ended with ``pressure`` (Pa) and its ``deflection`` (m), and
        the energy (J) then stored."""

    def curvature(self, pasts: tuple[Past, Past, Past], weights: TimeWeights) -> float:
        """Error of the displacement at the end of the last of two steps by the curvature of the
        pressure, relative to it."""


@dataclass(frozen=True, eq=False)
class SharedPast:
    """One field for each retardation time: K_k = shares_k K_0."""

    creep: SharedCreep
    operator: Operator

    @property
    def times(self) -> RealArray:
        """Retardation times, s."""
        return self.creep.times

    def summed(self, weights: TimeWeights) -> None:
        """None: it is a multiple of the operator."""

    def past(self, memory: Memory) -> Past:
        """The past in a ``memory``; a virgin one of an empty memory."""
        if memory:
            return Past.of(memory)
        none, count = np.zeros(self.operator.grid.shape), self.times.size
        return Past(0.0, none, none, np.zeros((count, *none.shape)), np.zeros(count), 0.0, VIRGIN)

    def lift(self, past: Past, weights: TimeWeights) -> RealArray:
        """K_0 sum shares_k (e_k xi_k + before_k p)."""
        total = float(self.creep.shares @ weights.before) * past.pressure
        for share, e, xi in zip(self.creep.shares, weights.e, past.xi, strict=True):
            total += share * e * xi
        return self.operator.apply(total) if total.any() else total

    def after(
        self,
        past: Past,
        weights: TimeWeights,
        pressure: RealArray,
        deflection: RealArray,
        place: tuple[float, float, float],
    ) -> tuple[Past, float]:
        """The past after a step, and the energy stored: ½ p·K_0 p + sum ½ shares_k xi_k·K_0
        xi_k."""
        area, shares = self.operator.grid.pixel_area, self.creep.shares
        response = deflection / (1.0 + float(shares @ weights.after))

        def product(x: RealArray, y: RealArray) -> float:
            return area * float(np.einsum("ij,ij->", x, y))

        with_0 = np.array([product(xi, past.response) for xi in past.xi])  # type: ignore[arg-type]
        with_1 = np.array([product(xi, response) for xi in past.xi])
        p00, p11 = product(past.pressure, past.response), product(pressure, response)  # type: ignore[arg-type]
        products = Products(past.squares, with_0, with_1, p00, product(past.pressure, response), p11)
        xi = np.empty_like(past.xi)
        for number, (e, before, now) in enumerate(zip(weights.e, weights.before, weights.after, strict=True)):
            np.multiply(past.xi[number], e, out=xi[number])
            xi[number] += before * past.pressure
            xi[number] += now * pressure
        squares = weights.advanced(products)
        heat = past.dissipated + weights.dissipated(shares, products)
        solid = np.isfinite(self.times)
        stored = 0.5 * p11 + 0.5 * float(shares[solid] @ squares[solid])
        return Past(past.time + weights.length, pressure, response, xi, squares, heat, place), stored

    def curvature(self, pasts: tuple[Past, Past, Past], weights: TimeWeights) -> float:
        """|K_0 p''| sum shares_k G_k over |K_0 p| (1 + sum shares_k after_k)."""
        second = second_difference(pasts, tuple(past.response for past in pasts))
        sizes = [float(np.linalg.norm(past.response)) for past in pasts]
        found = float(np.linalg.norm(second)) * float(self.creep.shares @ weights.of_curvature)
        return over_size(found / (1.0 + float(self.creep.shares @ weights.after)), sizes)


_SHOWS = 1e-6
"""Share of the compliance at the first instant below which a retarded one is left out. Of seven to
ten terms of a coating three remain at most wavenumbers: those of its material alone; what stays out
is a hundredth of the error of the series."""


class Passes:
    """Compiled passes over half spectra on some threads, and the sums of compliances for the last
    step of time.

    ``cuts`` (terms, rows): number of columns beyond which a compliance is zero.
    """

    def __init__(self, threads: int, cuts: RealArray) -> None:
        self._blocks, self.cuts = Blocks(threads), cuts
        self._last: tuple[float, RealArray] | None = None

    @cached_property
    def _kernels(self) -> Any:
        from ...core.engine import retarded_kernels

        return retarded_kernels

    def run(self, kernel: str, spectrum: RealArray | ComplexArray, *arguments: Any) -> None:
        """Call ``kernel`` over all rows of a ``spectrum``."""
        serial = spectrum.size < LONG_SERIAL_BELOW
        self._blocks.share(getattr(self._kernels, kernel), len(spectrum), *arguments, serial=serial)

    def sums_of(self, kernels: RealArray, weights: TimeWeights) -> RealArray:
        """(3, …): sums of ``kernels`` (terms, …) times before, after and the errors by curvature of
        ``weights``; those of the last ones are kept."""
        if self._last is not None and self._last[0] == weights.length:
            return self._last[1]
        sums: RealArray = np.empty((3, *kernels.shape[1:]))
        factors = np.stack([weights.before, weights.after, weights.of_curvature])
        self.run("weighted", sums[0], self.cuts, factors, kernels, sums)
        self._last = weights.length, sums
        return sums


@dataclass(frozen=True, eq=False)
class LayeredPast:
    """One half spectrum for each retardation time; ``kernels`` (terms, …) and ``instantaneous`` are
    compliances (m/Pa) on it."""

    creep: LayeredCreep
    operator: Operator
    kernels: RealArray = field(repr=False)
    transform: RealTransform | PaddedTransform = field(repr=False)
    passes: Passes = field(repr=False)

    @classmethod
    def prepared(cls, creep: LayeredCreep, operator: Operator) -> LayeredPast:
        """Kernels of all terms on the grid of the ``operator`` at the first instant; those of
        pressure alone are cut where they do not show."""
        engine, grid = operator.engine, operator.grid
        threads = engine.threads_for(operator.padded) if isinstance(engine, CpuEngine) else 1
        boundary, transform = operator.boundary, RealTransform(operator.padded, threads)
        kernels = []
        for number in range(creep.times.size):
            if isinstance(boundary, Periodic):
                kernels.append(spectral_kernel(creep.term(number), grid))
            else:
                influence = wrapped(boundary.influence(creep.term(number), grid), operator.padded)
                kernels.append(transform.forward(influence, _spectrum(transform)).real.copy())
        free = None if isinstance(boundary, Periodic) else PaddedTransform(grid.shape, operator.padded, threads)
        stacked = np.stack(kernels)

        cuts = np.full(stacked.shape[:2], stacked.shape[2])
        if creep.shear is None:  # what pressure hardly feels may move along the surface
            columns = np.arange(1, stacked.shape[2] + 1)
            for each, cut in zip(stacked, cuts, strict=True):
                cut[:] = np.where(np.abs(each) > _SHOWS * operator.kernel, columns, 0).max(axis=1)
                each[columns > cut[:, None]] = 0.0
        return cls(creep, operator, stacked, free or transform, Passes(threads, cuts))

    @property
    def times(self) -> RealArray:
        """Retardation times, s."""
        return self.creep.times

    def summed(self, weights: TimeWeights) -> RealArray:
        """sum after_k c_k on the half spectrum."""
        return np.asarray(self.passes.sums_of(self.kernels, weights)[1])

    def past(self, memory: Memory) -> Past:
        """The past in a ``memory``; a virgin one of an empty memory."""
        if memory:
            past = Past.of(memory)
            # That of another series of retardations, as of the same layers without shear, would be
            # taken for what it is not.
            if len(past.squares) != self.times.size:
                raise InputError(
                    f"state of viscoelastic layers must remember {self.times.size} retardation times, those of "
                    f"the bodies of this problem, but remembers {len(past.squares)}. Begin with a state of the "
                    "same bodies, and of steps whose shear was solved for if it is solved for here."
                )
            shear = past.shear and replace(past.shear, xi=_complex_view(memory["shear_xi"]))
            return replace(
                past, response=_complex_view(memory["response"]), xi=_complex_view(memory["xi"]), shear=shear
            )
        count, none = self.times.size, np.zeros_like(_spectrum(self.transform))
        xi = np.zeros((count, *none.shape), dtype=complex)
        return Past(0.0, np.zeros(self.operator.grid.shape), none, xi, np.zeros(count), 0.0, VIRGIN)

    def lift(self, past: Past, weights: TimeWeights) -> RealArray:
        """Inverse transform of sum c_k (e_k xi_k + before_k p)."""
        if not past.time and not past.pressure.any():
            return np.zeros(self.operator.grid.shape)
        total = _spectrum(self.transform)
        before = self.passes.sums_of(self.kernels, weights)[0]
        fields = weights.e, self.kernels, _parts(past.xi), before, _parts(past.response), _parts(total)
        self.passes.run("retarded", total, self.passes.cuts, *fields)
        return self.field(total)

    def after(
        self,
        past: Past,
        weights: TimeWeights,
        pressure: RealArray,
        deflection: RealArray,
        place: tuple[float, float, float],
    ) -> tuple[Past, float]:
        """The past after a step, and the energy stored: ½ p·K_0 p + sum ½ xi_k·K_k xi_k."""
        response, xi = (
            self.spectrum(pressure),
            np.zeros(past.xi.shape, complex),
        )  # what is never written takes no memory
        own = np.zeros((len(response), self.times.size, 5))
        factors = np.stack([weights.e, weights.before, weights.after])
        fields = self.kernels, self.counted, _parts(past.response), _parts(response), _parts(past.xi), _parts(xi), own
        self.passes.run("advance", response, self.passes.cuts, factors, *fields)
        products = Products(past.squares, *own.sum(axis=0).T)
        squares, ones = weights.advanced(products), np.ones(self.times.size)
        heat = past.dissipated + weights.dissipated(ones, products)
        at_once = self.operator.grid.pixel_area * float(np.einsum("ij,ij->", pressure, deflection))
        stored = 0.5 * (at_once - float(weights.after @ products.p11))
        stored += 0.5 * float(squares[np.isfinite(self.times)].sum())
        return Past(past.time + weights.length, pressure, response, xi, squares, heat, place), stored

    def curvature(self, pasts: tuple[Past, Past, Past], weights: TimeWeights) -> float:
        """Norm of the displacement by p'' over that by p."""
        _, after, bent = self.passes.sums_of(self.kernels, weights)
        first, last = pasts[1].time - pasts[0].time, pasts[2].time - pasts[1].time
        factors = 2.0 / (first + last) * np.array([1.0 / first, -1.0 / first - 1.0 / last, 1.0 / last])
        spectra = [_parts(past.response) for past in pasts]

        def norms(factors: RealArray, *spectra: RealArray) -> tuple[float, float]:
            sums = np.zeros((len(after), 2))
            self.passes.run("curvature", pasts[2].response, bent, self.operator.kernel, after, factors, *spectra, sums)
            second, size = np.sqrt(sums.sum(axis=0))
            return float(second), float(size)

        second, size = norms(factors, *spectra)
        if not size and second:  # contact was lost
            return over_size(second, [*(norms(factors, each, each, each)[1] for each in spectra[:2]), size])
        return over_size(second, [size])

    def spectrum(self, values: RealArray) -> ComplexArray:
        """Half spectrum of ``values`` (nx, ny)."""
        return self.transform.forward(np.asarray(values, dtype=float), _spectrum(self.transform))

    def field(self, spectrum: ComplexArray) -> RealArray:
        """Field (nx, ny) of a half ``spectrum``, which is used up."""
        return self.transform.backward(spectrum, np.empty(self.operator.grid.shape))

    @cached_property
    def counted(self) -> RealArray:
        """Area (m²) by which the products of a half spectrum count, (columns,): twice where it
        stands for two waves (Parseval)."""
        (nx, ny), columns = self.operator.padded, self.kernels.shape[2]
        found = np.full(columns, 2.0)
        found[0] = 1.0
        if ny % 2 == 0 and ny > 1:
            found[-1] = 1.0
        return found * (self.operator.grid.pixel_area / (nx * ny))


def _parts(spectra: RealArray | ComplexArray) -> RealArray:
    """Complex ``spectra`` with real and imaginary parts in turn along the last axis."""
    return np.ascontiguousarray(spectra, dtype=complex).view(float)


VIRGIN = (0.0, 0.0, math.nan)
"""Place before any load; the mean gap is then that at first touch."""


def _spectrum(transform: RealTransform | PaddedTransform) -> ComplexArray:
    return np.empty(transform.spectrum_shape, np.complex128)


def second_difference(
    pasts: tuple[Past, Past, Past], values: tuple[RealArray | ComplexArray, ...]
) -> RealArray | ComplexArray:
    """Second derivative in time of what has these ``values`` in the three ``pasts``."""
    first, last = pasts[1].time - pasts[0].time, pasts[2].time - pasts[1].time
    return np.asarray(2.0 * ((values[2] - values[1]) / last - (values[1] - values[0]) / first) / (first + last))


def over_size(error: float, sizes: Sequence[float]) -> float:
    """``error`` over the last of the ``sizes`` of what displaces at some moments, over the largest
    of them where that is zero.

    Where contact was lost in the last step nothing presses at its end. A step that pulled a contact
    apart which it should have relaxed is as wrong as that contact was large; surfaces that part in
    truth do so within a step short enough for its error to be small beside what pressed before it.
    """
    size = sizes[-1] or max(sizes)
    if size > 0.0:
        return error / size
    return math.inf if error > 0.0 else 0.0


def remembering(creep: AnyCreep, operator: Operator) -> Remembering:
    """How the past is kept for ``creep`` on the grid of the ``operator`` at the first instant."""
    return SharedPast(creep, operator) if isinstance(creep, SharedCreep) else LayeredPast.prepared(creep, operator)


@dataclass(frozen=True, eq=False)
class CreepCoupling(Coupling):
    """The displacement that the past leaves, as a lift: passive, since the step's own creep is in
    the operator."""

    name: ClassVar[str] = "creep"
    feedback: ClassVar[bool] = False
    remedy: ClassVar[str] = ""

    def begin(self, posed: Posed, memory: Memory) -> Exchange:
        """The displacement, prepared with the operator of the step."""
        x = np.asarray(posed.retarded)
        return Exchange(x, x)

    def share(self, exchange: Exchange) -> Share:
        """The displacement as a lift, where there is any."""
        return Share(lift=exchange.x) if exchange.x.any() else Share()
