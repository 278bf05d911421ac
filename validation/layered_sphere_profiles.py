"""Pressure under a sphere on a coated half-space, and stresses along the axis with friction: figs
2.3 and 2.4 of Peng (2001), after O'Sullivan & King (1988), by data of an independent solution."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from page import Claim, Page, Stated, Table, statements, write_page

import asperity as asp

REFERENCE = Path(__file__).parents[1] / "tests" / "reference"
RATIOS = (0.25, 0.5, 1.0, 2.0, 4.0)
"""E1/E2 of fig. 2.3; fig. 2.4 has 0.5, 1 and 2."""

FRICTIONS = (0.0, 0.25, 0.5)
POISSON = 0.3
BASE = asp.Elastic(200e9, POISSON)
THICKNESS = 1e-6
"""Thickness of the layer in m, and the contact radius a₀ on the base alone."""

RADIUS = 10.0 * THICKNESS
MODULUS = BASE.plane_strain_modulus
FORCE = 4.0 / 3.0 * MODULUS * THICKNESS**3 / RADIUS
HERTZ = 2.0 * MODULUS * THICKNESS / (np.pi * RADIUS)
SIZES = {0.25: 1.447, 0.5: 1.207, 1.0: 1.0, 2.0: 0.819, 4.0: 0.659}
"""Contact radii over a₀, for the size of the grid alone."""

PLANES = np.array([0.0, 0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0])
"""Depths over h at which the largest shear below x = a₀/2 is sought."""

INNER = 0.9
"""Distances over the contact radius up to which pressures are compared between pixels; nearer to
the edge, where they fall as a square root, a pixel is a mean."""

ABOUT = (
    "Peng (2001, figs 2.3 and 2.4, after O'Sullivan & King 1988): rigid sphere on a layer, ν = 0.3, R = 10 h, under "
    "the load whose Hertzian contact radius a₀ on the base alone is h; the pressure, and σ_zz and σ_xx on the axis "
    "and σ_xz below x = a₀/2, under the friction μp toward +x on the body. The figures have curves and no numbers. "
    "Independent solution of our own: a Fredholm equation for the pressure (12 digits) and the transforms of the "
    "layer for the stresses (10 digits); `tests/reference/sphere_layered_*.csv`. Ours: `asperity.solve` with the "
    "free boundary, {across} pixels to a₀, and `asperity.stress`. No parameter was chosen freely. Stresses are over "
    "p₀, tension positive."
)

WORDS = (
    "Pressures differ most near the edge, where they fall as a square root and the pixels are means. Stresses are "
    "those of the independent solution on both sides of the interface, nearer with the power 3/2 of the pixel. On the "
    "axis friction adds nothing to σ_zz and σ_xx, because its share is odd in x, and there they are drawn; beside the "
    "axis its influence on σ_xx is not negligible (last row)."
)


@dataclass(frozen=True)
class Seen:
    """One contact: pressures over p₀ along x in contact radii, and stresses by friction, depth over
    h and side of the interface.

    ``stress[μ, z, region]`` holds σ_zz and σ_xx on the axis and σ_xz below x = a₀/2;
    ``deepest[μ]`` the depth over h of the largest σ_xz there; ``aside[μ]`` σ_zz and σ_xx below x =
    a₀/2 in the middle of the layer.
    """

    radius: float
    x: np.ndarray
    pressure: np.ndarray
    stress: dict[tuple[float, float, int], tuple[float, float, float]]
    deepest: dict[float, float]
    aside: dict[float, tuple[float, float]]


def rows(name: str) -> Iterator[dict[str, float]]:
    """Rows of the independent solution with h = a₀ and ν = 0.3 in both bodies."""
    with (REFERENCE / f"sphere_layered_{name}.csv").open(encoding="utf-8") as file:
        for row in csv.DictReader(file):
            found = {key: float(value) for key, value in row.items()}
            same = found["nu1"] == found["nu2"] == POISSON and found["h_over_a0"] == 1.0
            if same and found["E1_over_E2"] in RATIOS:
                yield found


def seen(ratio: float, across: int) -> Seen:
    """The contact on pixels of a₀/``across``, ``across`` even."""
    pixel = THICKNESS / across
    count = 2 * int(np.ceil(1.15 * SIZES[ratio] * across)) + 1
    surface = asp.generate.sphere(asp.Grid((count, count), (pixel, pixel)), radius=RADIUS)
    layer = asp.Layer(asp.Elastic(ratio * BASE.youngs_modulus, POISSON), THICKNESS)
    problem = asp.ContactProblem(surface, asp.Layered([layer], BASE), boundary=asp.Free())
    result = asp.solve(problem, asp.Force(FORCE), keep=asp.Keep(stiffness=False))
    asked = sorted({row["z_over_h"] for row in rows("stress") if row["E1_over_E2"] == ratio} | set(PLANES))
    middle, off = count // 2, count // 2 + across // 2
    stress: dict[tuple[float, float, int], tuple[float, float, float]] = {}
    deepest, aside = {}, {}
    for friction in FRICTIONS:
        field = asp.stress(result, np.array(asked) * THICKNESS, friction=friction)
        at = {}
        for index, depth in enumerate(field.depth):
            z = round(float(depth) / THICKNESS, 9)
            region = 2 if z > 1.0 or (z, 1) in at else 1
            at[z, region] = index
            values = (field.normal_zz[index, middle, middle], field.normal_xx[index, middle, middle])
            stress[friction, z, region] = (
                *(float(value) / HERTZ for value in values),
                float(field.shear_xz[index, off, middle]) / HERTZ,
            )
        deepest[friction] = max(PLANES, key=lambda z, f=friction: abs(stress[f, round(float(z), 9), 1][2]))
        half = at[0.5, 1]
        aside[friction] = (
            float(field.normal_zz[half, off, middle]) / HERTZ,
            float(field.normal_xx[half, off, middle]) / HERTZ,
        )
    radius = float(np.sqrt(result.contact_area / np.pi)) / THICKNESS
    x = (np.arange(count) - middle) / across
    return Seen(radius, x, result.pressure[:, middle] / HERTZ, stress, deepest, aside)


def compare(across: int = 64) -> Page:
    """The page, with pixels of a₀/``across``."""
    found = {ratio: seen(ratio, across) for ratio in RATIOS}
    pressures, worst = _pressures(found)
    axis, off = _stresses(found)
    shear = _shear(found)
    return Page(
        "Pressure and stresses under a sphere on a coated half-space",
        ABOUT.format(across=across),
        (pressures, axis, shear, _stated(found), WORDS),
        _claims(found, worst, off, across),
    )


def _pressures(found: dict[float, Seen]) -> tuple[Table, float]:
    """Table of fig. 2.3, and the largest difference up to ``INNER``."""
    lines, worst = [], 0.0
    for row in rows("pressure"):
        one, at, theirs = found[row["E1_over_E2"]], row["r_over_a0"], row["p_over_p0"]
        ours = float(np.interp(at, one.x, one.pressure))
        worst = max(worst, abs(ours - theirs) if row["r_over_a"] <= INNER else 0.0)
        ratio = f"{row['E1_over_E2']:g}"
        lines.append((ratio, f"{row['r_over_a']:g}", f"{at:.4f}", f"{ours:.5f}", f"{theirs:.5f}"))
    head = ("E₁/E₂", "r/a", "r/a₀", "p/p₀: ours", "independent")
    return Table("## Fig. 2.3\n\nPressure along a radius, between pixels by straight lines:", head, tuple(lines)), worst


def _stresses(found: dict[float, Seen]) -> tuple[Table, np.ndarray]:
    """Table of fig. 2.4, and the largest differences of σ_zz, σ_xx on the axis and σ_xz for each
    friction below x = a₀/2."""
    lines, off = [], np.zeros(5)
    for row in rows("stress"):
        one, z, region = found[row["E1_over_E2"]], round(row["z_over_h"], 9), int(row["region"])
        zz, xx, _ = one.stress[0.0, z, region]
        ours = (zz, xx, *(one.stress[friction, z, region][2] for friction in FRICTIONS))
        theirs = [row[name] for name in ("szz_axis", "sxx_axis", "sxz_x05_mu0", "sxz_x05_mu025", "sxz_x05_mu05")]
        off = np.maximum(off, np.abs(np.subtract(ours, theirs)))
        if row["E1_over_E2"] in (0.5, 1.0, 2.0):
            part = "layer" if region == 1 else "base"
            texts = (f"{a:.4f} ({b:.4f})" for a, b in zip(ours, theirs, strict=True))
            lines.append((f"{row['E1_over_E2']:g}", f"{z:g}", part, *texts))
    names = ("σ_zz", "σ_xx", *(f"σ_xz, μ = {friction:g}" for friction in FRICTIONS))
    about = "## Fig. 2.4\n\nσ_zz and σ_xx on the axis, σ_xz below x = a₀/2; ours (independent):"
    return Table(about, ("E₁/E₂", "z/h", "part", *names), tuple(lines)), off


def _shear(found: dict[float, Seen]) -> Table:
    lines = tuple(
        (f"{ratio:g}", *(f"{one.deepest[friction]:g}" for friction in FRICTIONS)) for ratio, one in found.items()
    )
    head = ("E₁/E₂", *(f"μ = {friction:g}" for friction in FRICTIONS))
    return Table("Depth over h of the largest σ_xz in the layer below x = a₀/2:", head, lines)


def _change(one: Seen) -> float:
    """Largest change by friction of σ_zz and σ_xx on the axis."""
    return max(
        abs(one.stress[friction, z, region][k] - one.stress[0.0, z, region][k])
        for friction, z, region in one.stress
        for k in range(2)
    )


def _stated(found: dict[float, Seen]) -> Table:
    radii = [one.radius for one in found.values()]
    peaks = [float(one.pressure.max()) for one in found.values()]
    at_top = {ratio: found[ratio].stress[0.0, 0.1, 1] for ratio in (0.5, 1.0, 2.0)}
    sizes = [abs(values[0]) for values in at_top.values()]
    decays = max(abs(one.stress[0.5, 5.0, 2][0]) for ratio, one in found.items() if (0.5, 5.0, 2) in one.stress)
    aside = max(
        abs(one.aside[0.5][k] - one.aside[0.0][k]) for ratio, one in found.items() for k in range(2) if ratio in at_top
    )
    first = [one.deepest[0.0] for one in found.values()]
    last = [one.deepest[0.5] for one in found.values()]
    return statements(
        "What the text states of both figures:",
        (
            Stated(
                "a stiffer layer makes the contact smaller and its pressure larger",
                f"a/a₀ {radii[0]:.2f} to {radii[-1]:.2f}, pₘₐₓ/p₀ {peaks[0]:.2f} to {peaks[-1]:.2f}",
                radii == sorted(radii, reverse=True) and peaks == sorted(peaks),
            ),
            Stated(
                "stresses are high near the surface and decay rapidly into the substrate",
                f"σ_zz at 5 h at most {decays:.3f} p₀",
                decays < 0.1,
            ),
            Stated(
                "a stiffer layer (E₁/E₂ = 2) increases them near the surface",
                "σ_zz at 0.1 h: " + ", ".join(f"{size:.2f}" for size in sizes),
                sizes == sorted(sizes),
            ),
            Stated(
                "friction moves the largest σ_xz closer to the surface",
                f"depth over h {min(first):g} to {max(first):g} without friction, at most {max(last):g} with μ = 0.5",
                max(last) < min(first),
            ),
            Stated(
                "friction has negligible influence on the other stresses",
                f"none on the axis; below x = a₀/2 in the middle of the layer up to {aside:.3f} p₀ with μ = 0.5",
                max(map(_change, found.values())) < 1e-6,
                "on the axis, where they are drawn",
            ),
        ),
    )


def _claims(found: dict[float, Seen], worst: float, off: np.ndarray, across: int) -> tuple[Claim, ...]:
    size = 1.0 / across
    names = ("σ_zz on the axis", "σ_xx on the axis", *(f"σ_xz, μ = {friction:g}" for friction in FRICTIONS))
    radii = [one.radius for one in found.values()]
    return (
        Claim(f"pressure up to {INNER:g} a, largest difference over p₀", worst, high=0.25 * size),
        *(
            Claim(f"{name}, largest difference over p₀", float(value), high=0.1 * size**1.5)
            for name, value in zip(names, off, strict=True)
        ),
        Claim("largest step of the contact radius from one E₁/E₂ to the next", float(np.diff(radii).max()), high=0.0),
        Claim(
            "depth of the largest σ_xz, μ = 0.5 over μ = 0, largest",
            max(one.deepest[0.5] / one.deepest[0.0] for one in found.values()),
            high=0.7,
        ),
        Claim("change of σ_zz and σ_xx on the axis by friction", max(map(_change, found.values())), high=1e-6),
    )


if __name__ == "__main__":
    write_page(compare(), __file__)
