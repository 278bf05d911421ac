"""Temperature of one source of heat on a body whose material moves by under it to +x, with the
surface adiabatic beside the source.

Discs and ellipses of uniform or Hertzian flux, rectangles and bands of uniform flux. With the half
length a along the motion results go by the Péclet number Pe = v a/2κ and θ = k T/(q̄ a) of the mean
flux q̄; k and κ are those of the base of a layered body.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.scipy_parts import optimize, special
from . import band, pixel, polar
from .impedance import HeatConductor, HeatLayer
from .layered import FromBelow, Transform

_THINNEST = 0.02
"""Thickness over half length of a first layer below which the sum over waves becomes too long."""


class Source(ABC):
    """Shape and distribution of a flux about the origin; in all methods lengths are in units of the
    half length along the motion, and temperatures are θ of a half-space."""

    length: float
    """Half length a along the motion, m."""

    @property
    @abstractmethod
    def area(self) -> float:
        """Over a²."""

    @abstractmethod
    def at(self, x: RealArray, y: RealArray, peclet: float, depth: float = 0.0, fourier: float = math.inf) -> RealArray:
        """θ at points ``x``, ``y`` of one shape at the ``depth``, at κ t/a² = ``fourier``."""

    @abstractmethod
    def mean(self, peclet: float, *, weighted: bool) -> float:
        """Mean of θ over the source, or ``weighted`` with the flux."""

    @abstractmethod
    def transform(self, *, uniform: bool) -> Transform:
        """Of the flux, or of a ``uniform`` one in its place, 1 at no wavevector."""


@dataclass(frozen=True)
class EllipticSource(Source):
    """Flux on an ellipse: a disc, if both half axes are one.

    Parameters
    ----------
    length, width
        Half axes along and across the motion in m, > 0.
    hertzian
        Whether the flux falls as sqrt(1 - ρ²) to the rim; uniform if not.
    """

    length: float
    width: float
    hertzian: bool = False

    def __post_init__(self) -> None:
        """InputError for values that cannot be."""
        _sizes(self.length, self.width)

    @property
    def area(self) -> float:
        """Over a²."""
        return math.pi * self.width / self.length

    def at(self, x: RealArray, y: RealArray, peclet: float, depth: float = 0.0, fourier: float = math.inf) -> RealArray:
        """θ at points."""
        source = polar.ScaledEllipse(self.width / self.length, self.hertzian, peclet, depth, fourier)
        return np.array([source.at(float(px), float(py)) for px, py in zip(x.ravel(), y.ravel(), strict=True)]).reshape(
            x.shape
        )

    def mean(self, peclet: float, *, weighted: bool) -> float:
        """Mean of θ."""
        return polar.ScaledEllipse(self.width / self.length, self.hertzian, peclet).mean(weighted=weighted)

    def transform(self, *, uniform: bool) -> Transform:
        """2 J1(Q)/Q, or 3 (sin Q - Q cos Q)/Q³, Q² = qx² + (b qy/a)²."""
        b = self.width / self.length

        def of(qx: RealArray, qy: RealArray) -> RealArray:
            Q = np.maximum(np.hypot(qx, b * qy), 1e-300)
            if uniform or not self.hertzian:
                return np.asarray(2.0 * special.j1(Q) / Q)
            return np.asarray(3.0 * special.spherical_jn(1, Q) / Q)

        return of


def disc_source(radius: float, *, hertzian: bool = False) -> EllipticSource:
    """Flux on a disc of the ``radius`` in m."""
    return EllipticSource(radius, radius, hertzian)


@dataclass(frozen=True)
class RectangularSource(Source):
    """Uniform flux on a rectangle.

    Parameters
    ----------
    length, width
        Half sides along and across the motion in m, > 0.
    """

    length: float
    width: float

    def __post_init__(self) -> None:
        """InputError for values that cannot be."""
        _sizes(self.length, self.width)

    @property
    def area(self) -> float:
        """Over a²."""
        return 4.0 * self.width / self.length

    def at(self, x: RealArray, y: RealArray, peclet: float, depth: float = 0.0, fourier: float = math.inf) -> RealArray:
        """θ at points."""
        half = (1.0, self.width / self.length)
        return pixel.rectangle(x, y, half, 1.0, 1.0, 2.0 * peclet, depth=depth, time=fourier)

    def mean(self, peclet: float, *, weighted: bool) -> float:
        """Mean of θ."""
        return pixel.rectangle_mean((1.0, self.width / self.length), 1.0, 1.0, 2.0 * peclet)

    def transform(self, *, uniform: bool) -> Transform:
        """sin qx/qx times the same across."""
        b = self.width / self.length
        return lambda qx, qy: np.sinc(qx / math.pi) * np.sinc(b * qy / math.pi)


@dataclass(frozen=True)
class BandSource(Source):
    """Uniform flux on a band across the motion; there is no steady state at rest.

    Parameters
    ----------
    length
        Half width l in m of the band, along the motion, > 0.
    """

    length: float

    def __post_init__(self) -> None:
        """InputError for values that cannot be."""
        _sizes(self.length, self.length)

    @property
    def area(self) -> float:
        """Of no use: the band has no end."""
        return math.inf

    def at(self, x: RealArray, y: RealArray, peclet: float, depth: float = 0.0, fourier: float = math.inf) -> RealArray:
        """θ at points, the same for every y."""
        if math.isfinite(fourier):
            raise InputError("time since the flux began (s) of a band must be infinite. Take a long RectangularSource.")
        x = np.copysign(1.0, peclet) * x
        speed = self._moving(peclet)
        return band.at_surface(x, speed) if depth == 0.0 else band.below(x, speed, depth)

    def mean(self, peclet: float, *, weighted: bool) -> float:
        """Mean of θ."""
        return band.mean(self._moving(peclet))

    def transform(self, *, uniform: bool) -> Transform:
        """InputError: layers under a band are not covered."""
        raise InputError("body under a band must not have layers or a sink. Take a long RectangularSource.")

    def _moving(self, peclet: float) -> float:
        if peclet == 0.0:
            raise InputError(
                "speed (m/s) of the material under a band must not be zero: at rest it has no steady state. Take a "
                "rectangle of its length."
            )
        return abs(peclet)


@dataclass(frozen=True)
class Hottest:
    """The hottest point of a source: ``temperature`` per mean flux in K m²/W, at ``x`` in m from
    its centre, downstream."""

    temperature: float
    x: float


class MovingSource:
    """A source on a body whose material moves by; temperatures are per mean flux, in K m²/W.

    Parameters
    ----------
    source
        Its shape.
    body
        Half-space, with or without layers.
    speed
        v of the material to +x in m/s.

    Raises
    ------
    InputError
        If the first layer is thinner than 0.02 half lengths; add its resistance instead.

    Examples
    --------
    Steel under a terawatt per square metre on a radius of 1 µm, at rest and at 10 m/s, in K:

    >>> steel = HeatConductor(46.0, 1.2e-5)
    >>> round(1e12 * MovingSource(disc_source(1e-6), steel).hottest().temperature)
    21739
    >>> round(1e12 * MovingSource(disc_source(1e-6), steel, 10.0).hottest().temperature)
    18476
    """

    def __init__(self, source: Source, body: HeatConductor, speed: float = 0.0) -> None:
        self.source, self.body = source, body
        self.speed = require.finite(speed, "speed (m/s)")
        a = source.length
        self.peclet = 0.5 * self.speed * a / body.diffusivity
        """v a/2κ of the base."""
        surface = body.layers[0] if body.layers else body
        self._own = 0.5 * self.speed * a / surface.diffusivity
        self._unit = a / surface.conductivity
        self._below: FromBelow | None = None
        if body.layers or math.isfinite(body.sink_depth):
            self._below = self._from_below(a)

    @property
    def unit(self) -> float:
        """Temperature per mean flux at θ = 1: a/k of the base, in K m²/W."""
        return self.source.length / self.body.conductivity

    def temperature(self, x: ArrayLike, y: ArrayLike = 0.0, *, depth: float = 0.0, time: float = math.inf) -> RealArray:
        """At points ``x``, ``y`` in m, broadcast, at the ``depth`` in m, the ``time`` in s after
        the flux began.

        Raises
        ------
        InputError
            If a depth or time is asked for below a layered body, or a time of a band.
        """
        a = self.source.length
        x, y = np.broadcast_arrays(np.asarray(x, dtype=float) / a, np.asarray(y, dtype=float) / a)
        z = require.not_negative(depth, "depth (m)") / a
        if not time > 0.0:
            raise InputError(f"time since the flux began (s) must be greater than zero, but is {time!r}.")
        if self._below is None:
            fourier = time * self.body.diffusivity / a**2
            return self._unit * self.source.at(x, y, self._own, z, fourier)
        if z or math.isfinite(time):
            raise InputError(
                "depth (m) and time (s) must be zero and infinite above layers or a sink. Take HeatConductor.below for "
                "single waves."
            )
        more = np.array([self._below.at(*point) for point in zip(x.ravel(), y.ravel(), strict=True)])
        return self._unit * self.source.at(x, y, self._own) + self.unit * more.reshape(x.shape)

    def hottest(self) -> Hottest:
        """Temperature and place of the hottest point, on the axis of the motion."""
        if self.speed == 0.0:
            return Hottest(float(self.temperature(0.0)), 0.0)
        a, sign = self.source.length, math.copysign(1.0, self.speed)
        found = optimize.minimize_scalar(
            lambda x: -float(self.temperature(sign * x * a)),
            bounds=(0.0, 1.0),
            method="bounded",
            options={"xatol": 1e-7},
        )
        return Hottest(-float(found.fun), sign * float(found.x) * a)

    def mean(self, *, weighted: bool = False) -> float:
        """Mean over the source, or ``weighted`` with its flux."""
        found = self._unit * self.source.mean(self._own, weighted=weighted)
        if self._below is not None:
            found += self.unit * self._below.mean(self.source.transform(uniform=not weighted))
        return found

    def _from_below(self, a: float) -> FromBelow:
        base, layers = self.body, self.body.layers
        scaled = HeatConductor(
            1.0,
            1.0,
            tuple(
                HeatLayer(
                    layer.conductivity / base.conductivity,
                    layer.diffusivity / base.diffusivity,
                    layer.thickness / a,
                    layer.resistance * base.conductivity / a,
                )
                for layer in layers
            ),
            base.sink_depth / a,
        )
        first = scaled.layers[0].thickness if layers else scaled.sink_depth
        if first < _THINNEST:
            raise InputError(
                f"thickness of the first layer (m) must be at least {_THINNEST * a:g} m for a source of this size, but "
                f"is {first * a:g} m. Leave it out: if it conducts poorly, it adds thickness over conductivity."
            )
        return FromBelow(scaled, 2.0 * self.peclet, self.source.area, self.source.transform(uniform=False), 2.0)


def _sizes(length: float, width: float) -> None:
    require.positive(length, "half length of a source (m)")
    require.positive(width, "half width of a source (m)")
