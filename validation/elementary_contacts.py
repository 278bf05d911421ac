"""Constants of elementary contacts that lectures, review and dissertation print, found by the
numerical solution alone."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from page import Claim, Page, Published, Table, write_page

import asperity as asp

BODY = asp.Elastic(1.0 - 0.3**2, 0.3)
"""E* = 1 Pa against a rigid indenter."""

RADIUS, CONTACT_RADIUS = 1.0, 0.01
"""Of the indenters in m, and about that of their contacts: loads are chosen to make it so."""

SIDE = 2.3 * CONTACT_RADIUS
SLOPE, QUARTIC = 0.05, 100.0
"""Slope of the cone; A₂ in 1/m³ of the profile A₂ r⁴."""

AMPLITUDE = 1e-3
"""Δ of waves of the length 1 m."""

SHARES = (0.1, 0.5, 0.9)
"""p̄/p* at which the sinusoid is compared."""

PIXEL_ERROR = 0.07
"""Error of a contact radius from counted pixels, in pixels; it enters the constant 64/15 five
times."""

ABOUT = (
    "Constants that the texts print in formulas: Yastrebov's lectures (2016: Hertz, Westergaard), the review "
    "chapter on rough contact (eqs 19 and 20: the contact of a profile A₁r² + A₂r⁴), Bhushan (1998: eqs 1 and "
    "3) and Peng (2001: sec. 3.2.1, app. C). Ours: `asperity.solve` on the bare shape, on {points} × {points} "
    "pixels over 2.3 contact radii with nothing around them (free boundary), {strips} strips (line contact) "
    "or one period of {waves} points; neither a closed form nor its area enters. Contact radii come from "
    "counted pixels. Where two texts print the same fact in another form (pₘ = 2p₀/3, δ = a²/R, 8/3 A₁, 2A₁) "
    "it stands here once. No parameter is chosen."
)

WORDS = """* Every printed constant is that of the numerical solution within the error of counting pixels.
* The ε = 0.72 of a cone is 2(π − 2)/π = 0.727 cut, not rounded, to two digits; 3.52 is 4 ln(1 + √2) = 3.5255, cut too.
* p* is found as the amount by which the least pressure lies below the mean where everything touches."""


@dataclass(frozen=True)
class Seen:
    """One contact of an indenter: load, counted contact radius, approach, largest pressure,
    stiffness in N/m."""

    load: float
    radius: float
    approach: float
    peak: float
    stiffness: float = math.nan

    @property
    def area(self) -> float:
        """πa²."""
        return math.pi * self.radius**2


def compare(points: int = 257, strips: int = 4097, waves: int = 128) -> Page:
    """Ours on ``points`` × ``points`` pixels, ``strips`` strips and waves of ``waves`` points."""
    numbers = (*_points(points), *_lines(strips), *_waves(waves))
    worst = max(abs(one.ours / value - 1.0) for one, value in zip(numbers, EXACT, strict=True))
    exact = Table(
        "Closed forms of the same constants:",
        ("number", "closed form", "ours"),
        tuple((one.what, f"{value:.4f}", f"{one.ours:.4f}") for one, value in zip(numbers, EXACT, strict=True)),
    )
    claims = (
        Claim("largest deviation from the closed forms", worst, high=10.0 * PIXEL_ERROR * 2.3 / points),
        Claim("printed constants that agree", sum(one.kept for one in numbers), len(numbers), len(numbers)),
    )
    about = ABOUT.format(points=points, strips=strips, waves=waves)
    return Page("Printed constants of elementary contacts", about, (exact, WORDS), claims, numbers)


EXACT = (
    *(0.75, 1.5 / math.pi, 0.5, 2.0 / 3.0, 64.0 / 15.0, 8.0 / 3.0, 2.0 - 4.0 / math.pi, 4.0 * math.asinh(1.0)),
    *(4.0 / math.pi, 2.0 / math.pi),
    *(2.0 / math.pi * math.asin(math.sqrt(share)) for share in SHARES),
    *(2.0 * math.sqrt(2.0), math.pi, 2.0 * math.pi),
)
"""Closed forms, in the order of the numbers."""


def indented(shape: asp.Surface, load: float, *, stiffness: bool = False) -> Seen:
    """A rigid indenter of this ``shape`` under ``load`` in N on the half-space."""
    problem = asp.ContactProblem(shape, BODY, boundary=asp.Free())
    result = asp.solve(problem, asp.Force(load), keep=asp.Keep(stiffness=stiffness))
    nominal = result.contact_area / result.area_fraction
    slope = result.normal_stiffness * nominal if stiffness else math.nan
    return Seen(load, math.sqrt(result.contact_area / math.pi), result.approach, result.max_pressure, slope)


def _grid(points: int) -> asp.Grid:
    return asp.Grid((points, points), (SIDE / points, SIDE / points))


def _points(points: int) -> Iterator[Published]:
    """Sphere, fourth power, cone and a square patch."""
    grid = _grid(points)
    r = np.hypot(*grid.centred_coordinates())
    load = 4.0 / 3.0 * CONTACT_RADIUS**3 / RADIUS
    sphere = asp.generate.sphere(grid, radius=RADIUS)
    ball, light = indented(sphere, load), indented(sphere, load / 8.0)
    spacing = grid.spacing
    quartic = indented(asp.Surface(-QUARTIC * r**4, *spacing), 64.0 / 15.0 * QUARTIC * CONTACT_RADIUS**5)
    cone = indented(asp.Surface(-SLOPE * r, *spacing), 0.5 * math.pi * SLOPE * CONTACT_RADIUS**2, stiffness=True)
    power = math.log(ball.area / light.area) / math.log(8.0)
    sink = (cone.approach - SLOPE * cone.radius) * cone.stiffness / cone.load
    patch = asp.ContactProblem(asp.generate.flat(asp.Grid((4, 4), (1.0, 1.0))), _in_layers(), boundary=asp.Free())
    centre = math.pi * float(patch.compliance.influence(patch.grid).max())
    lectures, bhushan, chapter, peng = "Yastrebov 2016, Hertz", "Bhushan 1998", "review chapter", "Peng 2001"
    yield Published(lectures, "a³E*/PR of a sphere, 3/4", "0.75", ball.radius**3 / (ball.load * RADIUS))
    yield Published(lectures, "p₀a²/P of a sphere, 3/2π", "0.4775", ball.peak * ball.radius**2 / ball.load)
    half = ball.area / (2.0 * math.pi * RADIUS * ball.approach)
    yield Published(f"{bhushan}, eq. 1b", "real area over 2πRδ, exactly half", "0.5", half)
    yield Published(f"{bhushan}, eq. 3", "power of the load in the area, 2/3", "0.6667", power)
    yield Published(f"{chapter}, eq. 19", "P/A₂E*a⁵, 64/15", "4.267", quartic.load / (QUARTIC * quartic.radius**5))
    yield Published(f"{chapter}, eq. 20", "ω/A₂a⁴, 8/3", "2.667", quartic.approach / (QUARTIC * quartic.radius**4))
    yield Published(f"{peng}, app. C", "ε of a cone in h_c = h − εW/S", "0.72", sink)
    yield Published(f"{peng}, sec. 3.2.1", "πE u_z/(1 − ν²)pΔ in the middle of a square patch", "3.52", centre)


def _in_layers() -> asp.Layered:
    """The half-space as a layer on a base of the same material: its kernels are quadratures, not
    Love's closed form."""
    return asp.Layered([asp.Layer(BODY, 0.3)], BODY)


def _lines(strips: int) -> Iterator[Published]:
    """A cylinder, per metre."""
    grid = asp.Grid((strips, 1), (SIDE / strips, 1.0))
    load = 0.25 * math.pi * CONTACT_RADIUS**2 / RADIUS
    problem = asp.ContactProblem(asp.generate.cylinder(grid, radius=RADIUS), BODY, boundary=asp.FreeLine())
    result = asp.solve(problem, asp.Force(load), keep=asp.Keep(stiffness=False))
    half = 0.5 * result.contact_area
    yield Published("Yastrebov 2016, Hertz", "a²E*/PR of a cylinder, 4/π", "1.273", half**2 / (load * RADIUS))
    yield Published("Yastrebov 2016, Hertz", "p₀a/P of a cylinder, 2/π", "0.6366", result.max_pressure * half / load)


def _waves(points: int) -> Iterator[Published]:
    """One sinusoid, and two that cross."""
    source = "Yastrebov 2016, Westergaard"
    line, crossed = sinusoid(16 * points), sinusoid(points, crossed=True)
    whole = math.pi * AMPLITUDE
    contacts = {share: pressed(line, share * whole) for share in SHARES}
    for share, result in contacts.items():
        printed = 2.0 / math.pi * math.asin(math.sqrt(share))
        yield Published(source, f"2a/λ at p̄/p* = {share:g}", f"{printed:.4f}", result.area_fraction)
    peak = contacts[0.5].max_pressure / (0.5 * whole)
    yield Published(source, "p₀/p̄ at p̄/p* = 0.5, 2√2", "2.828", peak)
    for shape, what, theirs in ((line, "one wave, π", "3.1416"), (crossed, "crossed waves, 2π", "6.2832")):
        pressure = pressed(shape, 3.0 * whole).pressure
        yield Published(source, f"p*λ/E*Δ of {what}", theirs, float(pressure.mean() - pressure.min()) / AMPLITUDE)


def sinusoid(points: int, *, crossed: bool = False) -> asp.Surface:
    """Δ(cos 2πx/λ − 1) on one period λ = 1 m, ``crossed`` by the same along y."""
    wave = AMPLITUDE * (np.cos(2.0 * np.pi * np.arange(points) / points) - 1.0)
    if crossed:
        return asp.Surface(wave[:, None] + wave[None, :], 1.0 / points, 1.0 / points, periodic=True)
    return asp.Surface(wave[:, None], 1.0 / points, 1.0, periodic=True)


def pressed(shape: asp.Surface, pressure: float) -> asp.ContactResult:
    """The periodic ``shape`` under a mean ``pressure`` in Pa."""
    return asp.solve(asp.ContactProblem(shape, BODY), asp.MeanPressure(pressure), keep=asp.Keep(stiffness=False))


if __name__ == "__main__":
    write_page(compare(), __file__)
