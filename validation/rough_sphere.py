"""Rough sphere on a coated half-space: figs 3.3 and 3.4 of Peng (2001), after Nogi & Kato (1997).

The profile is not published, so this compares the character; materials, layer and load are theirs.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from page import Claim, Page, Table, write_page

import asperity as asp

POISSON = 0.3
RADIUS = 13.7e-3
FORCE = 14.7
THICKNESS = 6e-6


def _material(shear_modulus: float, shear_strength: float) -> asp.Elastic:
    strength = asp.Strength(yield_stress=math.sqrt(3.0) * shear_strength)
    return asp.Elastic(2.0 * shear_modulus * (1.0 + POISSON), POISSON, strength)


BASE = _material(79.2e9, 0.929e9)
LAYER = _material(100e9, 4.11e9)
BODIES: dict[str, asp.Elastic | asp.Layered] = {
    "base": BASE,
    "layered": asp.Layered([asp.Layer(LAYER, THICKNESS)], BASE),
}

CONTACT_RADIUS = (0.75 * FORCE * RADIUS / BASE.plane_strain_modulus) ** (1.0 / 3.0)
"""a0: Hertz's contact radius on the base alone."""

HERTZ = 1.5 * FORCE / (math.pi * CONTACT_RADIUS**2)
"""p0: Hertz's peak pressure on the base alone."""

PUBLISHED = 6.37
"""Largest pressure over p0."""

SIDE = 3.0
"""Side of the grid over a0."""

CORRELATION_LENGTH = 0.1 * CONTACT_RADIUS
ROUGHNESS = (0.0, 8e-9, 16e-9, 32e-9, 64e-9)
"""σ in m."""

ALIKE = 32e-9
"""The σ of them with which our largest pressure is nearest to theirs."""

DEPTHS = (
    0.0,
    0.005,
    0.01,
    0.02,
    0.03,
    0.045,
    THICKNESS / CONTACT_RADIUS,
    0.1,
    0.15,
    0.2,
    0.3,
    0.4,
    0.48,
    0.6,
    0.8,
    1.0,
)
"""Depths over a0, the interface among them."""

ABOUT = (
    "Peng (2001, figs 3.3 and 3.4), after Nogi & Kato (1997): rigid rough sphere, R = 13.7 mm (the caption "
    "says µm), W = 14.7 N, on a layer of "
    "h = 6 µm with G₁ = 100 GPa, k₁ = 4.11 GPa on a base with G₂ = 79.2 GPa, k₂ = 0.929 GPa. Their largest pressure is "
    f"{PUBLISHED} times Hertz's. Ours: ν = 0.3, roughness with a Gaussian autocorrelation and a 10 % length of "
    "0.1 a₀, of several σ for "
    "want of theirs; free boundary, {points} × {points} points over 3 a₀; means over {count} surfaces. "
    f"On the base a₀ = {CONTACT_RADIUS * 1e6:.1f} µm, p₀ = {HERTZ * 1e-9:.3f} GPa."
)


@dataclass(frozen=True)
class Seen:
    """One contact; lengths over a0, stresses over p0.

    ``area`` over πa0²; ``root`` the largest √J2, at ``depth``; ``by_depth`` the largest √J2 of each
    of ``DEPTHS`` (the smaller of the two at the interface); ``yielded`` the volume beyond the shear
    strength over a0³; ``outside`` the displacement on the ring of 1.25 to 1.45 a0 over Hertz's
    approach.
    """

    peak: float
    area: float
    root: float
    depth: float
    by_depth: tuple[float, ...]
    yielded: float
    outside: float


def compare(count: int = 4, points: int = 384, roughness: Sequence[float] = ROUGHNESS) -> Page:
    """Ours on ``count`` surfaces for every σ, of which the first is zero, and for both bodies."""
    shapes = [unit_roughness(seed, points) for seed in range(count)]
    found = {
        (body, sigma): [seen(contact(body, sigma * shape)) for shape in (shapes if sigma else shapes[:1])]
        for body in BODIES
        for sigma in roughness
    }
    about = ABOUT.format(points=points, count=count)
    parts = (_table(found), _depths(found, roughness), WORDS)
    return Page("Rough sphere on a coated half-space", about, parts, _claims(found, roughness))


def grid(points: int) -> asp.Grid:
    """Pixels over ``SIDE`` a0."""
    return asp.Grid((points, points), (SIDE * CONTACT_RADIUS / points, SIDE * CONTACT_RADIUS / points))


def unit_roughness(seed: int, points: int) -> np.ndarray:
    """Roughness with σ = 1, a window of a larger surface."""
    spectrum = asp.generate.GaussianAutocorrelation(1.0, CORRELATION_LENGTH)
    return asp.generate.gaussian(grid(points), spectrum, seed=seed, periodic=False).heights


def contact(body: str, roughness: np.ndarray) -> asp.ContactResult:
    """Rough sphere under ``FORCE`` on the free boundary."""
    cell = grid(roughness.shape[0])
    heights = asp.generate.sphere(cell, radius=RADIUS).heights + roughness
    problem = asp.ContactProblem(asp.Surface(heights, *cell.spacing), BODIES[body], boundary=asp.Free())
    return asp.solve(problem, asp.Force(FORCE), keep=asp.Keep(stiffness=False))


def seen(result: asp.ContactResult) -> Seen:
    """What is seen of one contact."""
    largest: list[tuple[float, float]] = []

    def watched() -> Iterator[asp.stresses.StressField]:
        for field in asp.stresses.stress_planes(result, np.array(DEPTHS) * CONTACT_RADIUS):
            largest.append((float(field.sqrt_J2.max()) / HERTZ, field.planes[0].depth / CONTACT_RADIUS))
            yield field

    yielded = sum(part.yielded_volume for part in asp.first_yield(watched()).regions)
    root, depth = max(largest)
    x, y = result.problem.grid.centred_coordinates()
    radius = np.hypot(x, y) / CONTACT_RADIUS
    ring = (radius > 1.25) & (radius < 1.45)
    return Seen(
        peak=result.max_pressure / HERTZ,
        area=result.contact_area / (math.pi * CONTACT_RADIUS**2),
        root=root,
        depth=depth,
        by_depth=tuple(min(value for value, at in largest if math.isclose(at, z)) for z in DEPTHS),
        yielded=yielded / CONTACT_RADIUS**3,
        outside=float(result.displacement[ring].mean()) / (CONTACT_RADIUS**2 / RADIUS),
    )


def _mean(contacts: Sequence[Seen], name: str) -> float:
    return float(np.mean([getattr(one, name) for one in contacts]))


def _table(found: dict[tuple[str, float], list[Seen]]) -> Table:
    rows = []
    for (body, sigma), contacts in found.items():
        numbers = [_mean(contacts, name) for name in ("peak", "area", "root", "depth", "yielded", "outside")]
        digits = (2, 3, 3, 3, 5, 4)
        texts = (f"{number:.{places}f}" for number, places in zip(numbers, digits, strict=True))
        rows.append((body, f"{sigma * 1e9:g}", *texts))
    head = ("body", "σ (nm)", "pₘₐₓ/p₀", "area/πa₀²", "max √J2/p₀", "at z/a₀", "yielded/a₀³", "u_z outside/δ₀")
    about = (
        "Yielded is the volume where √J2 exceeds k; the last column is the mean displacement on the ring "
        "1.25 a₀ < r < 1.45 a₀:"
    )
    return Table(about, head, tuple(rows))


def _depths(found: dict[tuple[str, float], list[Seen]], roughness: Sequence[float]) -> Table:
    rows = []
    for number, depth in enumerate(DEPTHS):
        values = [np.mean([one.by_depth[number] for one in found["layered", sigma]]) for sigma in roughness]
        rows.append((f"{depth:.3f}", *(f"{value:.3f}" for value in values)))
    head = ("z/a₀", *(f"σ = {sigma * 1e9:g} nm" for sigma in roughness))
    return Table(
        "Largest √J2/p₀ on planes of the layered half-space (of the base at the interface, z = h):", head, tuple(rows)
    )


WORDS = f"""* The largest pressure is several times the Hertzian one and grows with the roughness; the
  published one is about that of σ = {ALIKE * 1e9:g} nm. That σ was chosen freely to be so, as theirs is not
  stated: this agreement proves nothing.
* Outside the contact the displacement hardly differs from that under the smooth sphere: the deformation is
  Hertzian on the large scale. The rougher the sphere, the wider the load is distributed, so both the
  displacement outside and the stresses far below deviate with σ.
* The largest √J2 lies just below the surface, under the asperities; at depths of half a contact radius and
  more it is nearly that under the smooth sphere.
* With G₁/G₂ = 1.26 the layer changes the stresses little, but since its yield stress is 4.4 times as large,
  much less of the body yields."""


def _claims(found: dict[tuple[str, float], list[Seen]], roughness: Sequence[float]) -> tuple[Claim, ...]:
    rough = roughness[1:]
    peaks = {body: np.array([_mean(found[body, sigma], "peak") for sigma in roughness]) for body in BODIES}
    smooth = found["base", 0.0][0]
    changes = [_changes(found[body, ALIKE], found[body, 0.0][0]) for body in BODIES]
    middle, deepest, outside = np.max(changes, axis=0)
    roots = [_mean(found["layered", sigma], "root") / _mean(found["base", sigma], "root") for sigma in roughness]
    yielded = [(_mean(found["layered", sigma], "yielded"), _mean(found["base", sigma], "yielded")) for sigma in rough]
    spared = max(coated / bare for coated, bare in yielded if bare > 0.0)
    depth = max(_mean(found[body, sigma], "depth") for body in BODIES for sigma in rough)
    name = f"σ = {ALIKE * 1e9:g} nm"
    return (
        Claim("smooth, base alone: pₘₐₓ/p₀", smooth.peak, 0.999, 1.001),
        Claim("smooth, base alone: largest √J2/p₀ (0.358 in closed form)", smooth.root, 0.357, 0.359),
        Claim("smooth, base alone: its depth over a₀ (0.481)", smooth.depth, 0.4, 0.6),
        Claim(
            "smallest step of pₘₐₓ/p₀ from one σ to the next",
            float(min(np.diff(values).min() for values in peaks.values())),
            0.2,
        ),
        Claim(f"{name}, layered: pₘₐₓ/p₀ over theirs", _mean(found["layered", ALIKE], "peak") / PUBLISHED, 0.8, 1.25),
        Claim("rough: greatest depth over a₀ of the largest √J2", depth, 0.0, 0.1),
        Claim(f"{name}: largest √J2 at z = 0.48 a₀ differs from the smooth one by", float(middle), 0.0, 0.1),
        Claim(f"{name}: largest √J2 at z = a₀ differs from the smooth one by", float(deepest), 0.0, 0.1),
        Claim(f"{name}: mean displacement outside differs from the smooth one by", float(outside), 0.0, 0.03),
        Claim("largest √J2, layered over base alone, largest ratio", max(roots), 1.0, 1.25),
        Claim("yielded volume, layered over base alone, largest ratio", spared, 0.0, 0.5),
    )


def _changes(rough: Sequence[Seen], smooth: Seen) -> tuple[float, float, float]:
    """Relative changes by the roughness: largest √J2 at 0.48 a0 and at a0, displacement outside."""
    by_depth = np.mean([one.by_depth for one in rough], axis=0) / np.array(smooth.by_depth)
    middle, deepest = abs(by_depth[DEPTHS.index(0.48)] - 1.0), abs(by_depth[-1] - 1.0)
    return float(middle), float(deepest), abs(_mean(rough, "outside") / smooth.outside - 1.0)


if __name__ == "__main__":
    write_page(compare(), __file__)
