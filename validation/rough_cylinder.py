"""Sliding contact of a rough cylinder on a coated half-space: figs 3.1 and 3.2 of Peng (2001),
after Mao et al. (1996).

Neither profile nor loads are published, so this compares the character: a Gaussian profile on a
rigid cylinder, plane strain.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from page import Claim, Page, Table, write_page

import asperity as asp

BASE = asp.Elastic(200e9, 0.3)
RADIUS = 10e-3
HALF_WIDTH = 100e-6
"""a0: Hertz's half-width on the base alone."""

FORCE = 0.25 * math.pi * BASE.plane_strain_modulus * HALF_WIDTH**2 / RADIUS
"""N per metre."""

HERTZ = 0.5 * BASE.plane_strain_modulus * HALF_WIDTH / RADIUS
"""p0: Hertz's peak pressure on the base alone."""

PERIOD = 128.0
"""Length of the periodic cell over a0."""

POINTS = 16384
RMS = 50e-9
CORRELATION_LENGTH = 10e-6
SOFT, STIFF = 1.0 / 3.2, 1.0 / 0.17
"""E1/E2 of the two layers."""

LAYERS = ((1.0, 0.0), (SOFT, 0.5), (SOFT, 2.0), (STIFF, 0.5), (STIFF, 2.0))
"""E1/E2 and h/a0; the first is the base alone."""

FRICTIONS = (0.0, 0.25, 0.5)

ABOUT = (
    "Peng (2001, figs 3.1 and 3.2), after Mao et al. (1996): a cylinder with a rough profile slides on a "
    "coated half-space. Ours: a rigid cylinder, Gaussian profile with σ = 50 nm and a 10 % length of 0.1 a₀ "
    "(Gaussian autocorrelation), R = 100 a₀, ν = 0.3, `asperity.solve` with `Coulomb` friction on a periodic "
    "line of 128 a₀; mean ± standard deviation over {count} profiles. a₀ and p₀ are Hertz's for the smooth "
    "cylinder on the base. The captions give E₁/E₂ = 3.2 for the layer that the text calls compliant and 0.17 "
    "for the stiff one, so we take them for E₂/E₁."
)


@dataclass(frozen=True)
class Seen:
    """One contact: width and zone of contact and offset of the pressure over a0, largest pressure
    over p0.

    ``width`` is the sum of all contacts, ``zone`` the distance from the first to the last over 2a0;
    ``offset`` is the centroid of the pressure; ``left`` the share of the load at x < 0.
    """

    width: float
    zone: float
    peak: float
    offset: float
    left: float


LayerOf: TypeAlias = tuple[float, float]
"""E1/E2 and h/a0."""

Contacts: TypeAlias = dict[tuple[LayerOf, float], list[Seen]]
"""What is seen for every layer and friction coefficient, profile by profile."""


def compare(count: int = 8, points: int = POINTS) -> Page:
    """Ours on ``count`` profiles of ``points`` strips."""
    rough = _contacts([profile(seed, points) for seed in range(count)])
    smooth = _contacts([np.zeros(points)])
    closed, closed_claims = _closed_form(smooth, PERIOD / points)
    parts = (closed, _table(rough, smooth), WORDS)
    claims = (*closed_claims, *_claims(rough))
    return Page("Rough cylinder sliding on a coated half-space", ABOUT.format(count=count), parts, claims)


def _contacts(profiles: Sequence[np.ndarray]) -> Contacts:
    return {
        (layer, friction): [seen(contact(layer, friction, one)) for one in profiles]
        for layer in LAYERS
        for friction in FRICTIONS
    }


def profile(seed: int, points: int = POINTS) -> np.ndarray:
    """Roughness (m) along the line: a row of a periodic surface."""
    grid = asp.Grid((points, 16), (PERIOD * HALF_WIDTH / points, CORRELATION_LENGTH))
    spectrum = asp.generate.GaussianAutocorrelation(RMS, CORRELATION_LENGTH)
    return asp.generate.gaussian(grid, spectrum, seed=seed).heights[:, 0]


def contact(layer: LayerOf, friction: float, roughness: np.ndarray) -> asp.ContactResult:
    """Sliding contact under ``FORCE``; the shear traction on the half-space is along +x."""
    ratio, thickness = layer
    grid = asp.Grid((roughness.size, 1), (PERIOD * HALF_WIDTH / roughness.size, 1.0))
    heights = asp.generate.cylinder(grid, radius=RADIUS).heights + roughness[:, None]
    surface = asp.Surface(heights, *grid.spacing, periodic=True)
    coating = asp.Layer(asp.Elastic(ratio * BASE.youngs_modulus, BASE.poisson_ratio), thickness * HALF_WIDTH)
    problem = asp.ContactProblem(surface, asp.Layered([coating], BASE), friction=asp.Coulomb(friction))
    return asp.solve(problem, asp.Force(FORCE), keep=asp.Keep(stiffness=False))


def seen(result: asp.ContactResult) -> Seen:
    """Width, zone, pressure and offset of one contact."""
    grid = result.problem.grid
    x = grid.centred_coordinates()[0][:, 0] / HALF_WIDTH
    pressure = result.pressure[:, 0]
    touching = x[pressure > 0.0]
    step = grid.spacing[0] / HALF_WIDTH
    return Seen(
        width=0.5 * touching.size * step,
        zone=0.5 * (touching[-1] - touching[0] + step),
        peak=float(pressure.max()) / HERTZ,
        offset=float((pressure * x).sum() / pressure.sum()),
        left=float((pressure[x < 0.0].sum() + 0.5 * pressure[x == 0.0].sum()) / pressure.sum()),
    )


def _closed_form(smooth: Contacts, pixel: float) -> tuple[Table, tuple[Claim, ...]]:
    """The smooth cylinder on the base against the closed form (Johnson 1985, sec. 8.2)."""
    rows, deviations = [], []
    for friction in FRICTIONS:
        found = smooth[LAYERS[0], friction][0]
        nu = BASE.poisson_ratio
        exponent = math.atan(friction * (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu))) / math.pi
        width = 1.0 / math.sqrt(1.0 - 4.0 * exponent**2)
        offset = -2.0 * exponent * width * (1.0 + 1.0 / 3.0)
        rows.append((f"{friction:g}", f"{found.width:.4f}", f"{width:.4f}", f"{found.offset:.4f}", f"{offset:.4f}"))
        deviations.append((abs(found.width - width), abs(found.offset - offset)))
    about = (
        "The smooth cylinder on the base against the closed form, p ∝ (a−t)^(½+ε)(a+t)^(½−ε) with tan πε = "
        "μ(1−2ν)/2(1−ν), the contact being off centre by −2εa (Johnson 1985, secs 2.8 and 8.2):"
    )
    head = ("μ", "a/a₀: ours", "closed form", "centroid of p over a₀: ours", "closed form")
    worst = np.max(deviations, axis=0)
    claims = (
        Claim("smooth, base alone: deviation of a/a₀ from the closed form", float(worst[0]), 0, pixel),
        # the mean displacement under the shear is missing in a periodic cell: a tilt that moves the
        # cylinder by about 1/L
        Claim("smooth, base alone: deviation of the centroid", float(worst[1]), 0, 0.5 / PERIOD),
    )
    return Table(about, head, tuple(rows)), claims


def _values(contacts: Sequence[Seen], name: str) -> np.ndarray:
    return np.array([getattr(one, name) for one in contacts])


def _table(rough: Contacts, smooth: Contacts) -> Table:
    rows = []
    for (layer, friction), found in rough.items():
        still, one = rough[layer, 0.0], smooth[layer, friction][0]
        numbers = [_values(found, name) for name in ("width", "zone", "peak")]
        rows.append(
            (
                f"{layer[0]:.3g}",
                f"{layer[1]:g}" if layer[1] else "–",
                f"{friction:g}",
                *(f"{values.mean():.3f} ± {values.std(ddof=1):.3f}" for values in numbers),
                f"{(_values(found, 'offset') - _values(still, 'offset')).mean():+.3f}",
                f"{one.offset:+.3f}",
                f"{(_values(found, 'left') - _values(still, 'left')).mean():+.3f}",
                f"{one.peak:.3f}",
            )
        )
    head = (
        "E₁/E₂",
        "h/a₀",
        "μ",
        "contact width/2a₀",
        "zone/2a₀",
        "pₘₐₓ/p₀",
        "shift/a₀",
        "shift/a₀, smooth",
        "load from right to left",
        "pₘₐₓ/p₀, smooth",
    )
    about = (
        "Width is the sum of all contacts, zone reaches from the first to the last; the shift of the centroid "
        "and of the load is that against μ = 0 of the same profile. The traction on the half-space points to "
        "+x, the cylinder moves there:"
    )
    return Table(about, head, tuple(rows))


WORDS = """* On the base alone roughness raises the largest pressure to several times the Hertzian one, on a
  smaller width.
* The compliant layer enlarges the contact and lowers the pressure, the stiff one does the reverse, the more
  the thicker it is.
* Friction shifts zone and load in the direction of the friction force on the cylinder, in proportion to μ:
  pressures decrease on one side and increase on the other. (Behind a tangential force the surface rises,
  before it the surface sinks, by reciprocity with a normal force that draws the surface towards itself. An
  elastic cylinder on a rigid half-space moves the other way.) On thick layers the shift is larger on the
  compliant one.
* Friction neither enlarges the contact nor lowers the pressure noticeably, in agreement with Peng's objection
  to Mao et al."""


def _claims(rough: Contacts) -> tuple[Claim, ...]:
    def value(layer: LayerOf, name: str, friction: float = 0.0) -> float:
        return float(_values(rough[layer, friction], name).mean())

    def shift(layer: LayerOf, friction: float = FRICTIONS[-1]) -> float:
        return value(layer, "offset", friction) - value(layer, "offset")

    base = LAYERS[0]
    claims = [Claim("rough on the base alone: pₘₐₓ/p₀", value(base, "peak"), 2.0)]
    for name, ratio, sign in (("compliant", SOFT, 1.0), ("stiff", STIFF, -1.0)):
        steps = [base, (ratio, 0.5), (ratio, 2.0)]
        width = np.diff([math.log(value(layer, "width")) for layer in steps])
        peak = np.diff([math.log(value(layer, "peak")) for layer in steps])
        claims += [
            Claim(f"{name} layer, base to h = a₀/2: change of ln(width)", float(sign * width[0]), 0.1),
            Claim(
                f"{name} layer, h = a₀/2 to 2a₀: change of ln(width), in the same direction",
                float(sign * width[1]),
                0.0,
            ),
            Claim(
                f"{name} layer, base to h = a₀/2: change of ln(pₘₐₓ), in the other direction",
                float(-sign * peak[0]),
                0.1,
            ),
            Claim(f"{name} layer, h = a₀/2 to 2a₀: change of ln(pₘₐₓ), the same", float(-sign * peak[1]), 0.0),
        ]
    changes = {
        name: max(abs(value(layer, name, FRICTIONS[-1]) / value(layer, name) - 1.0) for layer in LAYERS)
        for name in ("width", "peak")
    }
    claims += [
        Claim(
            "largest shift along the traction on the half-space (all are against it)",
            max(shift(layer) for layer in LAYERS),
            high=-0.01,
        ),
        Claim("shift at μ = 0.5 over that at 0.25, base alone", shift(base) / shift(base, 0.25), 1.9, 2.1),
        Claim(
            "shift on the compliant over that on the stiff layer, h = 2a₀",
            shift((SOFT, 2.0)) / shift((STIFF, 2.0)),
            1.1,
        ),
        Claim("largest relative change of the contact width by friction", changes["width"], 0, 0.05),
        Claim("largest relative change of pₘₐₓ by friction", changes["peak"], 0, 0.05),
    ]
    return tuple(claims)


if __name__ == "__main__":
    write_page(compare(), __file__)
