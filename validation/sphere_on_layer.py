"""Rigid sphere on a coated half-space: the problem of O'Sullivan & King (1988), table 2.3 and figs
2.3 of Peng (2001).

Layer and base with Poisson's ratio 0.3, R = 10 h, and the load under which Hertz's radius on the
base alone, a_0, is the thickness of the layer. p_0 and delta_0 are Hertz's peak pressure and
approach under that load.
"""

from __future__ import annotations

import numpy as np
from side_by_side import Comparison, Pair, write

import asperity as asp

INDEPENDENT = {
    0.25: (1.446997391651, 0.507137611520, 1.544688967967, 0.421980645886),
    0.5: (1.206607645348, 0.704682272448, 1.227128046026, 0.599867795007),
    1.0: (1.0, 1.0, 1.0, 0.866025403784),
    2.0: (0.818477539647, 1.475436898863, 0.826869969166, 1.287694859733),
    4.0: (0.658087883353, 2.283465979044, 0.682063997775, 1.992005577513),
}
"""E1/E2 -> a/a_0, p_max/p_0, delta/delta_0, p(a/2)/p_0: the mixed problem reduced to a Fredholm
equation, 12 digits."""

WIDTH = 2.3
"""Side of the grid over the contact radius."""

BASE = asp.Elastic(200e9, 0.3)
THICKNESS = 1e-6
RADIUS = 10.0 * THICKNESS


def compare(pixels: int = 257) -> Comparison:
    """Ours on ``pixels`` x ``pixels`` with the free boundary; constant pressure on pixels errs by
    their square."""
    rows = tuple(((f"{ratio:g}",), _row(ratio, expected, pixels)) for ratio, expected in INDEPENDENT.items())
    size = WIDTH / pixels
    return Comparison(
        title="Rigid sphere on a coated half-space",
        about=(
            "O'Sullivan & King (1988) in the form of Peng (2001, fig. 2.3): ν₁ = ν₂ = 0.3, h = a₀, R = 10 h, "
            "no friction. Independent solution of our own: Fredholm equation of the second kind for the same "
            f"problem, 12 digits. Ours: `asperity.solve` with the free boundary on {pixels} x {pixels} pixels "
            f"over {WIDTH:g} contact radii. The radius comes from the counted contact area, the pressure at "
            "a/2 from a linear interpolation."
        ),
        cases=("E₁/E₂",),
        quantities=("a/a₀", "pₘₐₓ/p₀", "δ/δ₀", "p(a/2)/p₀"),
        rows=rows,
        agreement=(0.25 * size, 0.25 * size**2, 0.25 * size**2, 0.5 * size**2),
    )


def _row(ratio: float, expected: tuple[float, ...], pixels: int) -> tuple[Pair, ...]:
    a0 = THICKNESS
    modulus = BASE.plane_strain_modulus
    force = 4.0 / 3.0 * modulus * a0**3 / RADIUS
    p0, delta0 = 2.0 * a0 * modulus / (np.pi * RADIUS), a0**2 / RADIUS
    layer = asp.Layer(asp.Elastic(ratio * BASE.youngs_modulus, 0.3), THICKNESS)
    pixel = WIDTH * expected[0] * a0 / pixels
    surface = asp.generate.sphere(asp.Grid((pixels, pixels), (pixel, pixel)), radius=RADIUS)
    problem = asp.ContactProblem(surface, asp.Layered([layer], BASE), boundary=asp.Free())
    result = asp.solve(problem, asp.Force(force), keep=asp.Keep(stiffness=False))
    x, _ = problem.grid.centred_coordinates()
    middle = result.pressure[:, pixels // 2]
    half = float(np.interp(0.5 * expected[0] * a0, x[:, 0], middle))
    found = (
        float(np.sqrt(result.contact_area / np.pi)) / a0,
        result.max_pressure / p0,
        result.approach / delta0,
        half / p0,
    )
    return tuple(Pair(ours, theirs) for ours, theirs in zip(found, expected, strict=True))


if __name__ == "__main__":
    write(compare(), __file__)
