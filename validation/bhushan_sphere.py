"""A single asperity, smooth and rough, with friction and a layer: figs 4 to 9 and 21 to 24 of
Bhushan (1998)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from page import Claim, Page, Published, Table, write_page

import asperity as asp
from asperity.theories import JacksonGreenSphere
from asperity.theories.subsurface.sliding_yield import YieldOnset, sphere_yield_onset

POISSON = 0.3
BASE = asp.Elastic(200e9, POISSON)
THICKNESS = 1e-6
"""Thickness of the layer in m, and the contact radius a₀ on the base alone."""

RADIUS = 10.0 * THICKNESS
MODULUS = BASE.plane_strain_modulus
FORCE = 4.0 / 3.0 * MODULUS * THICKNESS**3 / RADIUS
HERTZ = 2.0 * MODULUS * THICKNESS / (math.pi * RADIUS)
"""p₀, Hertz's peak pressure on the base alone."""

RATIOS = (0.5, 1.0, 2.0)
FRICTIONS = (0.0, 0.25, 0.5)
SIDE = 3.6
"""Side of the grid over a₀."""

DEPTHS = (0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.48, 0.6, 0.8, 1.0, 1.3, 2.0, 3.0)
"""Depths over a₀."""

TABOR = 2.8
"""Hardness over Y, eq. 6."""

STRAIN, KRAL_LOAD = 685.0, 300.0
"""E/Y of the sphere of Kral et al. (1993), and its load over that at first yield where it is fully
plastic."""

ROUGHNESS, CORRELATION_LENGTH = 4e-9, 0.15 * THICKNESS
"""σ and 10 % length of the Gaussian autocorrelation of the rough sphere in m; theirs are not
stated."""

ABOUT = (
    "Bhushan (1998, figs 4 to 9, after O'Sullivan & King 1988, and figs 21 to 24, after Lee & Ren 1994): "
    "rigid sphere on a half-space with a layer, a₀ = h = 1 µm, R = 10 h, ν = 0.3, and a rough sphere on a "
    "half-space. The text prints few numbers and the figures have none that can be read here: what is printed "
    "is compared, of the rest the trends. Ours: closed forms (Hamilton 1983) for the homogeneous body, the "
    "free boundary on {points} × {points} points over 3.6 a₀ for the layers and the rough sphere, whose σ = 4 "
    "nm and 10 % length 0.15 a₀ are chosen freely."
)

WORDS = """* First yield under a sphere at 2.8 k, a mean pressure of 1.07 Y, and yield at the surface beyond
  µ ≈ 0.3 are the closed forms to the digits that are printed.
* So is the largest √J₂/p₀ of the smooth sphere under µ = 0.25, printed as 0.37.
* The rule pₘ = H/3 for first yield is 13 % below 1.07 Y over 2.8 Y. At 300 times the load of first yield,
  mean pressure and contact radius of a perfectly plastic sphere, by Jackson and Green's fits, are 11 and 8 %
  larger than those printed of finite elements with strain hardening; Tabor's 2.8 Y is the largest mean
  pressure of the fits.
* A stiffer layer raises the largest pressure, √J₂, the tension at the trailing edge and σₓ in the layer at
  the interface, which becomes tensile; a more compliant one lowers them and the largest τₓz on the interface,
  as published. Friction raises √J₂ and the tension. That a stiffer layer raises τₓz, too, is found near the
  surface and, at the interface, without friction only: with µ = 0.25 the largest value there is that of the
  homogeneous body within 2 %.
* Below the homogeneous contact σₓ has dropped below a hundredth of p₀ at 1.3 a₀, and σ_z is still a tenth of
  it at 3 a₀, as published.
* Roughness multiplies pressures, √J₂ near the surface and tension; at half a contact radius and below √J₂ is
  nearly that of the smooth sphere."""


@dataclass(frozen=True)
class Seen:
    """Stresses over p₀ under one contact: on the axis at ``DEPTHS`` (of the layer at the
    interface), and largest ones.

    ``xx``, ``zz``, ``xz`` (depths,) on the axis; ``root`` largest √J2 and ``root_by_depth`` that of
    every plane; ``shear`` largest shear τₓz on the interface; ``tension`` largest σ₁ on the
    surface, at the distance ``place`` over the contact radius, behind negative; ``peak`` largest
    pressure.
    """

    xx: np.ndarray
    zz: np.ndarray
    xz: np.ndarray
    root: float
    root_by_depth: np.ndarray
    shear: float
    tension: float
    place: float
    peak: float


def contact(ratio: float, points: int, roughness: float = 0.0, seed: int = 0) -> asp.ContactResult:
    """Rigid sphere of ``roughness`` σ in m on a layer whose modulus is ``ratio`` times that of the
    base."""
    spacing = SIDE * THICKNESS / points
    grid = asp.Grid((points, points), (spacing, spacing))
    heights = asp.generate.sphere(grid, radius=RADIUS).heights
    if roughness:
        spectrum = asp.generate.GaussianAutocorrelation(roughness, CORRELATION_LENGTH)
        heights = heights + asp.generate.gaussian(grid, spectrum, seed=seed, periodic=False).heights
    layer = asp.Layer(asp.Elastic(ratio * BASE.youngs_modulus, POISSON), THICKNESS)
    problem = asp.ContactProblem(
        asp.Surface(heights, spacing, spacing), asp.Layered([layer], BASE), boundary=asp.Free()
    )
    return asp.solve(problem, asp.Force(FORCE), keep=asp.Keep(stiffness=False))


def seen(result: asp.ContactResult, friction: float) -> Seen:
    """Stresses under a contact that slides with a ``friction`` coefficient; the counter body moves
    toward +x."""
    field = asp.stress(result, np.array(DEPTHS) * THICKNESS, friction=friction)
    layer = [int(np.flatnonzero(np.isclose(field.depth, z * THICKNESS))[0]) for z in DEPTHS]
    middle = result.pressure.shape[0] // 2
    on_axis = {
        name: getattr(field, name)[layer, middle, middle] / HERTZ for name in ("normal_xx", "normal_zz", "shear_xz")
    }
    surface = field.surface_maxima
    assert surface is not None
    x, y = (line[middle] for line in (field.x, field.y))
    away = math.copysign(math.hypot(surface.tension.x - x, surface.tension.y - y), surface.tension.x - x)
    radius = math.sqrt(result.contact_area / math.pi)
    by_depth = field.sqrt_J2[layer].max(axis=(1, 2)) / HERTZ
    by_depth[0] = surface.von_mises.value / math.sqrt(3.0) / HERTZ
    return Seen(
        *on_axis.values(),
        root=float(by_depth.max()),
        root_by_depth=by_depth,
        shear=float(np.abs(field.shear_xz[layer[DEPTHS.index(1.0)]]).max()) / HERTZ,
        tension=surface.tension.value / HERTZ,
        place=away / radius,
        peak=result.max_pressure / HERTZ,
    )


def compare(points: int = 193, count: int = 4) -> Page:
    """Ours on grids of ``points`` × ``points``, the rough sphere for ``count`` roughnesses."""
    smooth: dict[tuple[float, float], Seen] = {}
    for ratio in RATIOS:
        result = contact(ratio, points)
        smooth |= {(ratio, friction): seen(result, friction) for friction in FRICTIONS}
    rough = [seen(contact(1.0, points, ROUGHNESS, seed), FRICTIONS[1]) for seed in range(count)]
    onsets = {friction: sphere_yield_onset(POISSON, friction) for friction in (0.0, 0.25)}
    parts = (_layers(smooth), _axis(smooth), _rough(smooth[1.0, FRICTIONS[1]], rough), WORDS)
    about = ABOUT.format(points=points)
    return Page(
        "A single asperity, smooth and rough, with friction and a layer",
        about,
        parts,
        _claims(onsets, smooth, rough),
        _published(onsets),
    )


def surface_yield_from() -> float:
    """Least friction coefficient with which yield begins on the surface, by bisection to 1e-4."""
    low, high = 0.0, 1.0
    while high - low > 1e-4:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if sphere_yield_onset(POISSON, middle).at_surface else (middle, high)
    return high


def _published(onsets: dict[float, YieldOnset]) -> tuple[Published, ...]:
    review = "Bhushan 1998"
    return (
        Published(f"{review}, fig. 8", "p₀/k at first yield, µ = 0", "2.8", onsets[0.0].peak_over_k),
        Published(f"{review}, eq. 5a", "pₘ/Y at first yield, µ = 0", "1.07", 2.0 / 3.0 * onsets[0.0].peak_over_Y),
        Published(f"{review}, text", "µ beyond which yield begins on the surface, about", "0.3", surface_yield_from()),
        Published(
            f"{review}, fig. 23, after Lee & Ren 1994",
            "largest √J₂/p₀ of the smooth sphere, µ = 0.25",
            "0.37",
            onsets[0.25].root_J2,
        ),
        *_plastic(2.0 / 3.0 * onsets[0.0].peak_over_Y),
    )


def _plastic(onset: float) -> Iterator[Published]:
    """Beyond first yield, at the mean pressure ``onset`` over Y, by Jackson & Green's fits to
    finite elements."""
    review, fits = "Bhushan 1998", "ours: Jackson & Green's fits"
    law = JacksonGreenSphere(E_star=STRAIN / (1.0 - POISSON**2), radius=1.0, yield_stress=1.0, nu=POISSON)
    depth = np.geomspace(1.0, 300.0, 2001)
    load, area = law.load_ratio(depth), law.area_ratio(depth)
    mean = onset * load / area
    there = int(np.argmin(np.abs(load - KRAL_LOAD)))
    yield Published(
        f"{review}, eq. 5c", "pₘ/H at first yield, 1/3", "0.3333", onset / TABOR, reason=f"1.07 Y over {TABOR:g} Y"
    )
    yield Published(
        f"{review}, eq. 5b, after Tabor 1951", "pₘ/Y at full plasticity", "2.8", float(mean.max()), reason=fits
    )
    kral = f"{review}, sec. 2.3, after Kral, Komvopoulos & Bogy 1993"
    hardening = f"{fits}, without the strain hardening of theirs"
    yield Published(
        kral,
        "pₘ/Y at 300 times the load of first yield, E/Y = 685",
        "2.5",
        float(mean[there]),
        reason=hardening,
        shared="p_m of fig. 10",
    )
    yield Published(
        kral,
        "contact radius there over that at first yield, about",
        "10",
        math.sqrt(area[there]),
        reason=hardening,
        shared="radius of fig. 10",
    )


def _layers(smooth: dict[tuple[float, float], Seen]) -> Table:
    interface = DEPTHS.index(1.0)
    rows = [
        (
            f"{ratio:g}",
            f"{friction:g}",
            *(f"{value:.3f}" for value in (one.peak, one.root, one.tension)),
            f"{one.place:.2f}",
            *(f"{value[interface]:.3f}" for value in (one.xx, one.zz)),
            f"{one.shear:.3f}",
        )
        for (ratio, friction), one in smooth.items()
    ]
    head = (
        "E₁/E₂",
        "µ",
        "pₘₐₓ",
        "max √J₂",
        "max σ₁ on the surface",
        "at r/a",
        "σₓ at z = h",
        "σ_z at z = h",
        "max τₓz at z = h",
    )
    return Table(
        "Layer, figs 4 to 7; stresses over p₀, at the interface those of the layer below the middle:", head, tuple(rows)
    )


def _axis(smooth: dict[tuple[float, float], Seen]) -> Table:
    rows = []
    for index, depth in enumerate(DEPTHS):
        found = [smooth[ratio, FRICTIONS[1]] for ratio in RATIOS]
        rows.append(
            (f"{depth:g}", *(f"{one.xx[index]:.3f}; {one.zz[index]:.3f}; {one.xz[index]:.3f}" for one in found))
        )
    head = ("z/a₀", *(f"E₁/E₂ = {ratio:g}" for ratio in RATIOS))
    return Table("σₓ; σ_z; τₓz over p₀ below the middle, µ = 0.25 (fig. 5):", head, tuple(rows))


def _rough(smooth: Seen, rough: list[Seen]) -> Table:
    rows = [
        (f"{depth:g}", f"{smooth.root_by_depth[i]:.3f}", f"{np.mean([one.root_by_depth[i] for one in rough]):.3f}")
        for i, depth in enumerate(DEPTHS)
    ]
    peak, tension = (np.mean([getattr(one, name) for one in rough]) for name in ("peak", "tension"))
    about = (
        f"Rough sphere on the homogeneous body, µ = 0.25 (figs 21 to 24): pₘₐₓ/p₀ {peak:.2f} (smooth "
        f"{smooth.peak:.2f}), largest σ₁/p₀ on the surface {tension:.2f} (smooth {smooth.tension:.2f}); "
        "largest √J₂/p₀ on planes:"
    )
    return Table(about, ("z/a₀", "smooth", "rough"), tuple(rows))


def _claims(
    onsets: dict[float, YieldOnset], smooth: dict[tuple[float, float], Seen], rough: list[Seen]
) -> tuple[Claim, ...]:
    plain = smooth[1.0, 0.25]
    interface, deep, half = DEPTHS.index(1.0), DEPTHS.index(1.3), DEPTHS.index(0.48)
    by_ratio = {
        name: [_value(smooth[ratio, 0.25], name, interface) for ratio in RATIOS]
        for name in ("peak", "root", "tension", "xx", "shear")
    }
    by_friction = {
        name: [_value(smooth[1.0, friction], name, 0) for friction in FRICTIONS] for name in ("root", "tension")
    }
    below = np.mean([one.root_by_depth[half:] for one in rough], axis=0) / plain.root_by_depth[half:] - 1.0
    return (
        Claim("fig. 8: p₀/k at first yield without friction, printed 2.8", onsets[0.0].peak_over_k, 2.75, 2.85),
        Claim("eq. 5a: pₘ/Y at first yield, printed 1.07", 2.0 / 3.0 * onsets[0.0].peak_over_Y, 1.065, 1.08),
        Claim("µ beyond which yield begins on the surface, printed about 0.3", surface_yield_from(), 0.25, 0.35),
        Claim("fig. 23: largest √J₂/p₀ under µ = 0.25, printed 0.37", onsets[0.25].root_J2, 0.365, 0.375),
        Claim(
            "the same by the numerical solution, over the closed form", plain.root / onsets[0.25].root_J2, 0.98, 1.01
        ),
        *(
            Claim(f"smallest step of {text} with E₁/E₂", float(np.min(np.diff(by_ratio[name]))), 0.0)
            for name, text in (
                ("peak", "pₘₐₓ"),
                ("root", "√J₂"),
                ("tension", "the tension on the surface"),
                ("xx", "σₓ at the interface"),
            )
        ),
        Claim(
            "largest shear τₓz on the interface, compliant layer over homogeneous, µ = 0.25",
            by_ratio["shear"][0] / by_ratio["shear"][1],
            0.0,
            1.0,
        ),
        Claim("σₓ/p₀ in the stiff layer at the interface (tensile)", by_ratio["xx"][-1], 0.0),
        *(
            Claim(f"smallest step of {text} with µ", float(np.min(np.diff(by_friction[name]))), 0.0)
            for name, text in (("root", "√J₂"), ("tension", "the tension on the surface"))
        ),
        Claim("fig. 6: place of the largest tension over the contact radius, µ = 0.25", plain.place, -1.1, -0.9),
        Claim("fig. 5: size of σₓ/p₀ at 1.3 a₀, homogeneous", abs(float(plain.xx[deep])), 0.0, 0.02),
        Claim("fig. 5: size of σ_z/p₀ at 3 a₀, homogeneous", abs(float(plain.zz[-1])), 0.08),
        Claim("rough sphere: smallest largest pressure over p₀", min(one.peak for one in rough), 1.5),
        Claim(
            "rough sphere: smallest largest √J₂ over that of the smooth sphere",
            min(one.root for one in rough) / plain.root,
            1.2,
        ),
        Claim(
            "rough sphere: smallest largest tension over that of the smooth sphere",
            min(one.tension for one in rough) / plain.tension,
            1.0,
        ),
        Claim(
            "rough sphere: √J₂ at 0.48 a₀ and below differs from the smooth one by",
            float(np.abs(below).max()),
            0.0,
            0.1,
        ),
    )


def _value(one: Seen, name: str, interface: int) -> float:
    """A number of a contact; of what is given along the axis, that at the plane of number
    ``interface``."""
    found = getattr(one, name)
    return float(found if np.ndim(found) == 0 else found[interface])


if __name__ == "__main__":
    write_page(compare(), __file__)
