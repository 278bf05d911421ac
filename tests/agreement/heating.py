"""Rows of the agreement matrix: theories of frictional heating."""

from __future__ import annotations

import math

import numpy as np
from agreement.matrix import ROUNDING, Agreement, apart, make

from asperity.theories.heating.estimates import HERTZIAN_DISC, SQUARE, UNIFORM_DISC, Limits
from asperity.theories.heating.pixel import pixel_kernel

Q, A, K, KAPPA = 1e8, 1e-4, 46.0, 1.2e-5
"""Mean flux (W/m²), half length (m), conductivity and diffusivity."""

UNIT = Q * A / K
"""Temperature of θ = 1, K."""

SHAPES = {"ellipse": UNIFORM_DISC, "hertzian": HERTZIAN_DISC, "rectangle": SQUARE}


def speed(peclet: float) -> float:
    """v of a Péclet number."""
    return 2.0 * peclet * KAPPA / A


def source(shape: str, peclet: float, width: float = A):
    """A moving source."""
    return make("moving-source", Q, A, width, K, KAPPA, shape).at_speed(speed(peclet))


def at_rest(_: float) -> float:
    """Largest and mean temperature of discs, and the largest of a square."""
    found = [source(shape, 0.0) for shape in ("ellipse", "hertzian")]
    known = [UNIFORM_DISC, HERTZIAN_DISC]
    largest = apart([answer.max_temperature[0] / UNIT for answer in found], [limits.rest for limits in known])
    mean = apart([answer.mean_temperature[0] / UNIT for answer in found], [limits.rest_mean for limits in known])
    square = apart(source("rectangle", 0.0).max_temperature / UNIT, SQUARE.rest)
    return max(largest, mean, square)


def fast(peclet: float) -> float:
    """Largest and mean temperature of all shapes."""

    def one(shape: str, limits: Limits) -> float:
        found, scale = source(shape, peclet), math.sqrt(math.pi * peclet) / UNIT
        return max(
            apart(found.max_temperature * scale, limits.fast), apart(found.mean_temperature * scale, limits.fast_mean)
        )

    return max(one(shape, limits) for shape, limits in SHAPES.items())


def long_rectangle(width: float) -> float:
    """At Pe = 1, largest temperature and its place."""
    band = make("jaeger-band", Q, A, K, KAPPA).at_speed(speed(1.0))
    found = source("rectangle", 1.0, width * A)
    return max(apart(found.max_temperature, band.max_temperature), apart(found.hottest, band.hottest))


def interpolated(hertzian: bool) -> float:
    """Largest difference from rest to Pe = 100."""
    v = speed(1.0) * np.append(0.0, np.geomspace(1e-3, 100.0, 40))
    found = make("tian-kennedy", Q, A, K, KAPPA, hertzian).at_speed(v)
    exact = make("moving-source", Q, A, A, K, KAPPA, "hertzian" if hertzian else "ellipse").at_speed(v)
    return apart(found.max_temperature, exact.max_temperature)


def insulator(conductivity: float) -> float:
    """Body 1 of so little conductivity."""
    v = speed(3.0)
    flash = make("blok-flash", Q * math.pi * A**2 / v, 1.0, A, conductivity, K, KAPPA).at_speed(v)
    alone = source("hertzian", 3.0)
    return max(
        apart(flash.max_temperature, alone.max_temperature), apart(flash.mean_temperature, alone.mean_temperature)
    )


def slow(peclet: float) -> float:
    """Unlike bodies, share and largest temperature."""
    v = speed(peclet)
    flash = make("blok-flash", Q * math.pi * A**2 / v, 1.0, A, 28.0, K, KAPPA).at_speed(v)
    return max(
        apart(flash.share, 28.0 / (28.0 + K)), apart(flash.max_temperature, 0.375 * math.pi * Q * A / (28.0 + K))
    )


def pixels(count: float) -> float:
    """Mean over the disc, weighted with the flux, of a Hertzian flux on so many pixels across."""
    n = int(count)
    place = (np.arange(n) - 0.5 * (n - 1)) * 2.0 / n
    square = np.clip(1.0 - place[:, None] ** 2 - place[None, :] ** 2, 0.0, None)
    flux = np.sqrt(square)
    kernel = pixel_kernel((n, n), (2.0 * A / n, 2.0 * A / n), K, KAPPA, speed(3.0))
    shape = (3 * n - 2, 3 * n - 2)
    spread = np.fft.irfft2(np.fft.rfft2(kernel, shape) * np.fft.rfft2(flux, shape), shape)
    temperature = spread[n - 1 : 2 * n - 1, n - 1 : 2 * n - 1]
    mean_flux = flux.sum() * (2.0 / n) ** 2 / math.pi
    found = float((temperature * flux).sum() / flux.sum()) / mean_flux * Q
    return apart(found, source("hertzian", 3.0).flux_mean_temperature)


HEATING = (
    Agreement(
        "moving-source",
        "limits at rest",
        "speed 0",
        at_rest,
        (),
        ROUNDING,
        "closed forms of disc, Hertzian disc and square (Carslaw & Jaeger 1959)",
    ),
    Agreement(
        "moving-source",
        "fast limits",
        "Péclet number to infinity",
        fast,
        (10.0, 100.0, 1000.0),
        7e-3,
        "heat that flows out at the sides of the square, over a length of a/sqrt(Pe)",
    ),
    Agreement(
        "moving-source",
        "jaeger-band",
        "rectangle, width to infinity",
        long_rectangle,
        (4.0, 8.0, 16.0),
        1e-6,
        "the temperature of a far end falls exponentially with its distance times v/2κ",
    ),
    Agreement(
        "tian-kennedy",
        "moving-source",
        "uniform disc, Pe <= 100",
        lambda _: interpolated(False),
        (),
        0.0235,
        "the largest error of the interpolation, near Pe = 0.5",
    ),
    Agreement(
        "tian-kennedy",
        "moving-source",
        "Hertzian disc, Pe <= 100",
        lambda _: interpolated(True),
        (),
        0.0115,
        "the largest error of the interpolation, near Pe = 5",
    ),
    Agreement(
        "blok-flash",
        "moving-source",
        "conductivity of body 1 to zero",
        insulator,
        (1.0, 0.1, 0.01),
        1e-3,
        "the ratio of the temperatures of both bodies alone, below that of the conductivities",
    ),
    Agreement(
        "blok-flash",
        "k1/(k1 + k2)",
        "speed to zero",
        slow,
        (0.1, 0.01, 0.001),
        1e-3,
        "temperatures at rest are corrected in proportion to the Péclet number",
    ),
    Agreement(
        "moving-source",
        "sum of pixels (free)",
        "pixels to infinity",
        pixels,
        (16.0, 32.0, 64.0),
        5e-4,
        "of second order in the pixel but for the rim, where the flux falls as a root",
    ),
)
