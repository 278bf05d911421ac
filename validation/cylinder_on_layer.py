"""Rigid cylinder on a coated half-space in plane strain: the problem of Cole & Sayles (1992), fig.
2.6 of Peng (2001).

Poisson's ratio 0.3. a_0 and p_0 are Hertz's half-width and peak pressure under the same load on the
base alone.
"""

from __future__ import annotations

import numpy as np
from side_by_side import Comparison, Pair, write

import asperity as asp

RATIOS = (0.25, 0.5, 2.0, 4.0)
"""E1/E2 of the columns."""

INDEPENDENT = {
    0.1: ((1.14238, 1.05867, 0.95579, 0.91860), (0.92748, 0.97171, 1.01926, 1.03361)),
    0.5: ((1.40194, 1.17705, 0.85276, 0.71627), (0.76663, 0.88490, 1.11679, 1.27029)),
    1.0: ((1.57720, 1.26091, 0.77463, 0.57441), (0.66586, 0.81109, 1.27635, 1.72322)),
    2.0: ((1.76376, 1.34195, 0.72757, 0.51877), (0.57716, 0.74919, 1.37310, 1.92649)),
    5.0: ((1.93362, 1.39792, 0.71055, 0.50298), (0.51792, 0.71554, 1.40732, 1.98810)),
    20.0: ((1.99506, 1.41311, 0.70732, 0.50019), (0.50124, 0.70766, 1.41378, 1.99926)),
}
"""h/a_0 -> a/a_0 and p_max/p_0 for each of ``RATIOS``: the mixed problem reduced to a Fredholm
equation, 6 digits."""

WIDTH = 2.3
BASE = asp.Elastic(200e9, 0.3)
HERTZ_WIDTH = 1e-6
RADIUS = 100e-6


def compare(pixels: int = 4097) -> Comparison:
    """Ours on ``pixels`` strips with the free line boundary."""
    rows = tuple(
        ((f"{thickness:g}", f"{ratio:g}"), _pairs(ratio, thickness, (width, peak), pixels))
        for thickness, (widths, peaks) in INDEPENDENT.items()
        for ratio, width, peak in zip(RATIOS, widths, peaks, strict=True)
    )
    size = WIDTH / pixels
    return Comparison(
        title="Rigid cylinder on a coated half-space, plane strain",
        about=(
            "Cole & Sayles (1992) in the form of Peng (2001, fig. 2.6): ν₁ = ν₂ = 0.3, no friction. "
            "Independent solution of our own: Fredholm equation of the second kind for the same problem, six "
            f"digits. Ours: `asperity.solve` with the boundary `FreeLine()` on {pixels} strips over {WIDTH:g} "
            "half-widths of the contact. The half-width comes from counting strips; the far field, a "
            "logarithm, is that of the base."
        ),
        cases=("h/a₀", "E₁/E₂"),
        quantities=("a/a₀", "pₘₐₓ/p₀"),
        rows=rows,
        agreement=(size, 0.25 * size**2 + 1e-5),
    )


def _pairs(ratio: float, thickness: float, expected: tuple[float, float], pixels: int) -> tuple[Pair, ...]:
    modulus = BASE.plane_strain_modulus
    force, p0 = 0.25 * np.pi * modulus * HERTZ_WIDTH**2 / RADIUS, 0.5 * HERTZ_WIDTH * modulus / RADIUS
    layer = asp.Layer(asp.Elastic(ratio * BASE.youngs_modulus, 0.3), thickness * HERTZ_WIDTH)
    pixel = WIDTH * expected[0] * HERTZ_WIDTH / pixels
    x, _ = asp.Grid((pixels, 1), (pixel, 1.0)).centred_coordinates()
    surface = asp.Surface(-(x**2) / (2.0 * RADIUS), pixel, 1.0)
    problem = asp.ContactProblem(surface, asp.Layered([layer], BASE), boundary=asp.FreeLine())
    result = asp.solve(problem, asp.Force(force), keep=asp.Keep(stiffness=False))
    width = 0.5 * result.area_fraction * pixels * pixel / HERTZ_WIDTH
    return Pair(width, expected[0]), Pair(result.max_pressure / p0, expected[1])


if __name__ == "__main__":
    write(compare(), __file__)
